// SPDX-License-Identifier: GPL-3.0-or-later
#include "cone_tree.h"

#include "../base/numbers.h"
#include "../flow/map_cost.h"
#include "../math/shortest_paths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ricci {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// Rounds in which every cone may move.
constexpr int kMaxRounds = 4;

/// Trials of one cone's move, and how far it goes at once: not far beyond the next ones, where there are many.
constexpr std::size_t kMaxAttempts = 3;
constexpr double kMaxStep = 0.25, kMaxStepOfMany = 2.0; // this over the root of their number

/// A move must lower energy and price of seams together by this.
constexpr double kMinGain = 1e-4;

/// Moves cone \p i to a place around where energy and price of seams are lower.
/// \param tree without the cone, \p own shorter than with it
/// \return whether it has moved
bool moveNearby(
	ConeModel& model,
	const SeamTree& tree,
	const ConeSites& sites,
	int i,
	double own,
	double maxEnergy)
{
	const double present = model.energy(), curvature = model.curvature(i);
	const Vertex old = model.vertex(i);
	const VertexVector& phi = model.gradient();
	std::vector<std::pair<double, Vertex>> places; // change that is predicted
	SearchFront<Vertex, Vertex> front(static_cast<int>(phi.size()));
	front.offer(old, 0.0);
	const double far = std::min(kMaxStep, kMaxStepOfMany / std::sqrt(model.size()));
	for (Vertex v = front.next(far); v.isValid(); v = front.next(far)) {
		for (const ConeSites::Way& way : sites.ways(v))
			front.offer(way.to, front[v] + way.length, v);
		if (model.isCone(v) || !sites.isAllowed(v))
			continue;
		// The factor of curvature that goes the distance r is that of a dipole, with the mean square
		// r^2 (ln(1 / r) + 1 / 2) / (4 pi) in a flat disk of radius 1.
		const double r = front[v];
		const double dipole = curvature * curvature * r * r * (0.5 - std::log(r)) / (8.0 * kPi);
		const double rise = 2.0 * curvature * (phi[v] - phi[old]) + dipole;
		const double change = coneCost(rise, tree.distance(v) - own, 0);
		if (change < -kMinGain && present + rise <= maxEnergy)
			places.emplace_back(change, v);
	}
	std::sort(places.begin(), places.end());
	for (std::size_t k = 0; k < places.size() && k < kMaxAttempts; ++k) {
		const Vertex v = places[k].second;
		const double most = std::min(
			maxEnergy, present + (kSeamPrice * (own - tree.distance(v)) - kMinGain) / kEnergyPrice);
		if (model.tryMove(i, v, [&](double energy) { return energy <= most; }))
			return true;
	}
	return false;
}

} // namespace

SeamTree::SeamTree(const ConeSites& sites) :
		m_sites(&sites), m_length(sites.cutLength()), m_distance(sites.toCut()),
		m_next(sites.toCut().size()), m_uses(sites.toCut().size(), 0)
{
	std::vector<Vertex> cut;
	for (const Vertex v : m_distance.indices())
		if (m_distance[v] < kFar)
			cut.push_back(v);
	spread(cut);
}

SeamTree::SeamTree(const ConeSites& sites, std::vector<Vertex> cones) : SeamTree(sites)
{
	while (!cones.empty()) {
		const auto nearest = std::min_element(cones.begin(), cones.end(), [&](Vertex a, Vertex b) {
			return m_distance[a] < m_distance[b];
		});
		add(*nearest);
		cones.erase(nearest);
	}
}

void SeamTree::add(Vertex cone)
{
	std::vector<Vertex> path;
	for (Vertex v = cone; v.isValid(); v = m_next[v]) {
		if (m_uses[v]++ > 0)
			break;
		m_length += lengthOfStep(v);
		m_distance[v] = 0.0;
		path.push_back(v);
	}
	spread(path);
}

double SeamTree::ownLength(Vertex cone) const
{
	double length = 0.0;
	for (Vertex v = cone; v.isValid() && m_uses[v] == 1; v = m_next[v])
		length += lengthOfStep(v);
	return length;
}

double SeamTree::remove(Vertex cone)
{
	std::vector<Vertex> loose;
	double length = 0.0;
	for (Vertex v = cone; v.isValid() && --m_uses[v] == 0; v = m_next[v]) {
		length += lengthOfStep(v);
		m_distance[v] = kFar;
		loose.push_back(v);
	}
	// All whose shortest way led there look for another.
	for (std::size_t i = 0; i < loose.size(); ++i)
		for (const ConeSites::Way& way : m_sites->ways(loose[i]))
			if (m_next[way.to] == loose[i] && m_distance[way.to] < kFar) {
				m_distance[way.to] = kFar;
				loose.push_back(way.to);
			}
	for (const Vertex v : loose) {
		m_distance[v] = m_sites->toCut()[v];
		m_next[v] = Vertex();
		for (const ConeSites::Way& way : m_sites->ways(v))
			if (m_distance[way.to] + way.length < m_distance[v]) {
				m_distance[v] = m_distance[way.to] + way.length;
				m_next[v] = way.to;
			}
	}
	spread(loose);
	m_length -= length;
	return length;
}

/// From \p v on the way to the tree; nothing where the tree begins.
double SeamTree::lengthOfStep(Vertex v) const
{
	if (!m_next[v].isValid())
		return m_sites->toCut()[v] < kFar ? m_sites->toCut()[v] : 0.0;
	double shortest = kFar;
	for (const ConeSites::Way& way : m_sites->ways(v))
		if (way.to == m_next[v])
			shortest = std::min(shortest, way.length);
	return shortest;
}

/// Makes the distances shorter that are so by those of \p from.
void SeamTree::spread(const std::vector<Vertex>& from)
{
	DistanceQueue<Vertex> queue;
	for (const Vertex v : from)
		if (m_distance[v] < kFar)
			queue.push(m_distance[v], v);
	while (!queue.empty()) {
		const auto [distance, v] = queue.pop();
		if (distance != m_distance[v])
			continue;
		for (const ConeSites::Way& way : m_sites->ways(v))
			if (distance + way.length < m_distance[way.to]) {
				m_distance[way.to] = distance + way.length;
				m_next[way.to] = v;
				queue.push(m_distance[way.to], way.to);
			}
	}
}

void shortenConeTree(ConeModel& model, SeamTree& tree, const ConeSites& sites, double maxDistortion)
{
	const double maxEnergy = 0.25 * maxDistortion * maxDistortion;
	for (int round = 0; round < kMaxRounds; ++round) {
		bool hasMoved = false;
		for (int i = 0; i < model.size(); ++i) {
			const double own = tree.remove(model.vertex(i));
			hasMoved |= moveNearby(model, tree, sites, i, own, maxEnergy);
			tree.add(model.vertex(i));
		}
		if (!hasMoved)
			return;
	}
}

} // namespace ricci
