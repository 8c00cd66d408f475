// SPDX-License-Identifier: GPL-3.0-or-later
#include "cone_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ricci {

namespace {

/// Rounds in which every cone may move.
constexpr int kMaxRounds = 6;

/// Trials of one cone's move.
constexpr int kMaxAttempts = 3;

/// Exponent of the mean square in the product with the length that moves lower: distortion counts
/// half as much as length.
constexpr double kDistortionWeight = 0.25;

/// A move must lower the product by this share.
constexpr double kMinGain = 0.005;

/// Branches of the tree at one cone for which moves are bounded without building the tree: short
/// trees have no more.
constexpr int kMaxBranches = 5;

/// What moves lower.
double cost(double energy, double length)
{
	return std::pow(energy, kDistortionWeight) * length;
}

class TreeShortener
{
public:
	TreeShortener(ConeModel& model, const ConeSites& sites, double maxEnergy) :
			m_model(model), m_sites(sites), m_maxEnergy(maxEnergy)
	{
		for (int i = 0; i < model.size(); ++i)
			m_distance.push_back(sites.distancesFrom(model.vertex(i)));
	}

	/// Moves cone \p i where that lowers the cost. \return whether it has moved
	bool move(int i)
	{
		const double present = m_model.energy();
		const double length = treeLength(-1, Vertex());
		const double aim = (1.0 - kMinGain) * cost(present, length);
		VertexVector phi = m_model.gradient();
		for (const Vertex v : phi.indices())
			phi[v] = m_model.gradientOfOthers(i, v);
		// Where the prediction of the energy was too good, the next one gets half the room.
		double room = m_maxEnergy - present;
		for (int attempt = 0; attempt < kMaxAttempts && room > 0.0; ++attempt, room *= 0.5) {
			const Place place = bestPlace(i, phi, length, aim, room);
			if (!place.vertex.isValid())
				return false;
			if (m_model.tryMove(i, place.vertex, [&](double energy) {
					return energy <= m_maxEnergy && cost(energy, place.length) < aim;
				})) {
				m_distance[i] = m_sites.distancesFrom(place.vertex);
				return true;
			}
		}
		return false;
	}

private:
	/// A vertex for a cone, and the length of the tree there.
	struct Place
	{
		Vertex vertex;
		double length = 0.0;
	};

	/// Where cone \p i is predicted to cost least, among the vertices at which it costs less than
	/// \p aim and raises the energy by \p room at most; an invalid vertex if there is none.
	/// \param phi gradient of the others: the cone's own field is about the same around every place
	/// \param length of the tree as it is
	Place bestPlace(int i, const VertexVector& phi, double length, double aim, double room) const
	{
		const double own = m_model.curvature(i), present = m_model.energy();
		const Vertex old = m_model.vertex(i);
		Place best;
		for (const Vertex v : phi.indices()) {
			const double energy = present + 2.0 * own * (phi[v] - phi[old]);
			if (m_model.isCone(v) || !m_sites.isAllowed(v) || energy > present + room)
				continue;
			// A prediction below the present energy is not trusted.
			const double trusted = std::max(energy, present);
			// A branch at the cone becomes shorter by no more than the way that the cone goes.
			if (cost(trusted, length - kMaxBranches * m_distance[i][v]) >= aim)
				continue;
			const double there = treeLength(i, v);
			if (cost(trusted, there) < aim) {
				aim = cost(trusted, there);
				best = {v, there};
			}
		}
		return best;
	}

	/// Length of the minimum spanning tree of the cones by paths along edges [Prim 1957], with cone \p
	/// moved at \p to (-1: all as they are).
	double treeLength(int moved, Vertex to) const
	{
		const int count = m_model.size();
		Array<double> nearest(count, std::numeric_limits<double>::infinity());
		Array<char> isJoined(count, 0);
		int last = 0;
		double length = 0.0;
		while (true) {
			isJoined[last] = 1;
			int next = -1;
			for (int k = 0; k < count; ++k) {
				if (isJoined[k])
					continue;
				const double d = last == moved
									 ? m_distance[k][to]
									 : m_distance[last][k == moved ? to : m_model.vertex(k)];
				nearest[k] = std::min(nearest[k], d);
				if (next < 0 || nearest[k] < nearest[next])
					next = k;
			}
			if (next < 0)
				return length;
			length += nearest[next];
			last = next;
		}
	}

	ConeModel& m_model;
	const ConeSites& m_sites;
	double m_maxEnergy;
	Array<VertexArray<double>> m_distance; // from each cone
};

} // namespace

void shortenConeTree(ConeModel& model, const ConeSites& sites, double maxDistortion)
{
	TreeShortener shortener(model, sites, 0.25 * maxDistortion * maxDistortion);
	for (int round = 0; round < kMaxRounds; ++round) {
		bool hasMoved = false;
		for (int i = 0; i < model.size(); ++i)
			hasMoved |= shortener.move(i);
		if (!hasMoved)
			return;
	}
}

} // namespace ricci
