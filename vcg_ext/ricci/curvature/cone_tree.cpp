// SPDX-License-Identifier: GPL-3.0-or-later
#include "cone_tree.h"

#include "../math/shortest_paths.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ricci {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// Rounds in which every cone may move.
constexpr int kMaxRounds = 4;

/// Trials of one cone's move.
constexpr int kMaxAttempts = 3;

/// A move must lower energy and price of seams together by this.
constexpr double kMinGain = 5e-4;

/// Moves cone \p i, which the tree ends at, nearer to the rest of the tree if that is worth it.
/// \param tree without the cone, \p own as long as it was with it
/// \return whether it has moved
bool moveTowards(
	ConeModel& model, const SeamTree& tree, const ConeSites& sites, int i, double own, double room)
{
	const double present = model.energy(), curvature = model.curvature(i);
	const Vertex old = model.vertex(i);
	// The cone's own field is about the same around every place.
	const double oldField = model.gradientOfOthers(i, old);
	for (int attempt = 0; attempt < kMaxAttempts && room > 0.0; ++attempt, room *= 0.5) {
		Vertex best;
		double aim = kSeamPrice * own - kMinGain;
		for (const Vertex v : model.area().indices()) {
			const double price = kSeamPrice * tree.distance(v);
			if (price >= aim || model.isCone(v) || !sites.isAllowed(v))
				continue;
			// A prediction below the present energy is not trusted.
			const double rise = std::max(
				0.0, 2.0 * curvature * (model.gradientOfOthers(i, v) - oldField));
			if (rise <= room && price + kEnergyPrice * rise < aim) {
				aim = price + kEnergyPrice * rise;
				best = v;
			}
		}
		if (!best.isValid())
			return false;
		const double most = std::min(
			present + room,
			present + (kSeamPrice * (own - tree.distance(best)) - kMinGain) / kEnergyPrice);
		if (model.tryMove(i, best, [&](double energy) { return energy <= most; }))
			return true;
		// The prediction was too good.
		room = std::min(room, most - present);
	}
	return false;
}

} // namespace

SeamTree::SeamTree(const ConeSites& sites) :
		m_sites(sites), m_length(sites.cutLength()), m_distance(sites.toCut()),
		m_next(sites.toCut().size()), m_uses(sites.toCut().size(), 0)
{
	std::vector<Vertex> cut;
	for (const Vertex v : m_distance.indices())
		if (m_distance[v] < kFar)
			cut.push_back(v);
	spread(cut);
}

SeamTree::SeamTree(const ConeSites& sites, const ConeModel& model) : SeamTree(sites)
{
	std::vector<Vertex> cones;
	for (int i = 0; i < model.size(); ++i)
		cones.push_back(model.vertex(i));
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
		for (const ConeSites::Way& way : m_sites.ways(loose[i]))
			if (m_next[way.to] == loose[i] && m_distance[way.to] < kFar) {
				m_distance[way.to] = kFar;
				loose.push_back(way.to);
			}
	for (const Vertex v : loose) {
		m_distance[v] = m_sites.toCut()[v];
		m_next[v] = Vertex();
		for (const ConeSites::Way& way : m_sites.ways(v))
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
		return m_sites.toCut()[v] < kFar ? m_sites.toCut()[v] : 0.0;
	double shortest = kFar;
	for (const ConeSites::Way& way : m_sites.ways(v))
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
		for (const ConeSites::Way& way : m_sites.ways(v))
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
			if (tree.ownLength(model.vertex(i)) * kSeamPrice <= kMinGain)
				continue;
			const double own = tree.remove(model.vertex(i));
			hasMoved |= moveTowards(model, tree, sites, i, own, maxEnergy - model.energy());
			tree.add(model.vertex(i));
		}
		if (!hasMoved)
			return;
	}
}

} // namespace ricci
