// SPDX-License-Identifier: GPL-3.0-or-later
#include "edge_swap.h"

#include "../metric/euclidean.h"
#include "../numbers.h"

#include <algorithm>
#include <utility>

namespace ricci {

namespace {

/// An edge that is swapped this often is left alone: the remedy has no proof that it ends.
constexpr int kMostSwapsOfOneEdge = 4;

} // namespace

EdgeSwapper::EdgeSwapper(const std::vector<Point3>& positions, std::vector<double> initialRadii) :
		m_positions(positions), m_initialRadii(std::move(initialRadii))
{
}

bool EdgeSwapper::operator()(CurvatureMap& map)
{
	const Triangulation& t = map.triangulation();
	m_swapped.resize(at(t.edgeCount()), 0);
	m_timesSwapped.resize(at(t.edgeCount()), 0);
	m_toSplit.clear();
	if (map.brokenTriangles() == 0)
		return false;

	m_touched.assign(at(t.faceCount()), 0);
	std::vector<int> longestEdges;
	for (int f = 0; f < t.faceCount(); ++f) {
		const auto h = t.halfedges(f);
		const auto length = [&](int g) { return map.lengths()[at(Triangulation::edge(g))]; };
		const int longest = *std::max_element(
			h.begin(), h.end(), [&](int a, int b) { return length(a) < length(b); });
		// The angle opposite the longest edge of a broken triangle is the constant pi, its others
		// 0.
		if (map.angles()[at(t.next(longest))] == 0.0 && map.angles()[at(longest)] == 0.0)
			longestEdges.push_back(longest);
	}
	bool changed = false;
	for (int h : longestEdges) {
		const int e = Triangulation::edge(h);
		if (t.isBoundaryEdge(e)) {
			m_toSplit.push_back(e);
			continue;
		}
		const int k = t.origin(t.previous(2 * e)), l = t.origin(t.previous(2 * e + 1));
		if (!t.isFlippable(e) || k == l || m_timesSwapped[at(e)] >= kMostSwapsOfOneEdge)
			continue;
		// Two broken triangles may share their longest edge, or one may just have been changed.
		char &left = m_touched[at(t.face(2 * e))], &right = m_touched[at(t.face(2 * e + 1))];
		if (left || right)
			continue;
		left = right = 1;
		// Circles that overlap by more than a right angle (I < 0) would end the convexity.
		const double delta = Euclidean::delta(
			distance(m_positions[at(k)], m_positions[at(l)]),
			m_initialRadii[at(k)],
			m_initialRadii[at(l)]);
		map.swapEdge(e, std::max(delta, -1.0));
		m_swapped[at(e)] = 1;
		++m_timesSwapped[at(e)];
		++m_swaps;
		changed = true;
	}
	return changed;
}

} // namespace ricci
