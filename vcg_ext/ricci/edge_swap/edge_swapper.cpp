// SPDX-License-Identifier: GPL-3.0-or-later
#include "edge_swapper.h"

#include "../metric/euclidean.h"

#include <algorithm>
#include <utility>

namespace ricci {

namespace {

/// An edge that is swapped this often is left alone: nothing proves that the swaps end.
constexpr int kMaxSwapsOfOneEdge = 4;

} // namespace

EdgeSwapper::EdgeSwapper(const VertexArray<Point3>& positions, VertexArray<double> initialRadii) :
		m_positions(positions), m_initialRadii(std::move(initialRadii))
{
}

bool EdgeSwapper::operator()(CurvatureMap& map)
{
	const Triangulation& t = map.triangulation();
	m_swapped.resize(t.edgeCount(), 0);
	m_timesSwapped.resize(t.edgeCount(), 0);
	m_toSplit.clear();
	if (map.brokenTriangles() == 0)
		return false;

	m_touched.assign(t.faceCount(), 0);
	std::vector<Halfedge> longestEdges;
	for (const Face f : t.faces()) {
		const auto h = t.halfedges(f);
		const auto length = [&](Halfedge g) { return map.lengths()[g.edge()]; };
		const Halfedge longest = *std::max_element(
			h.begin(), h.end(), [&](Halfedge a, Halfedge b) { return length(a) < length(b); });
		// The angle opposite the longest edge of a broken triangle is the constant pi, its others
		// 0.
		if (map.angles()[t.next(longest)] == 0.0 && map.angles()[longest] == 0.0)
			longestEdges.push_back(longest);
	}
	bool changed = false;
	for (const Halfedge h : longestEdges) {
		const Edge e = h.edge();
		if (t.isBoundary(e)) {
			m_toSplit.push_back(e);
			continue;
		}
		const Vertex k = t.apex(e.halfedge()), l = t.apex(e.halfedge().twin());
		if (!t.isFlippable(e) || k == l || m_timesSwapped[e] >= kMaxSwapsOfOneEdge)
			continue;
		// Two broken triangles may share their longest edge, or one may just have been changed.
		char& left = m_touched[t.face(e.halfedge())];
		char& right = m_touched[t.face(e.halfedge().twin())];
		if (left || right)
			continue;
		left = right = 1;
		// Circles that overlap by more than a right angle (I < 0) would end the convexity.
		const double delta = Euclidean::delta(
			distance(m_positions[k], m_positions[l]), m_initialRadii[k], m_initialRadii[l]);
		map.swapEdge(e, std::max(delta, -1.0));
		m_swapped[e] = 1;
		++m_timesSwapped[e];
		++m_swaps;
		changed = true;
	}
	return changed;
}

} // namespace ricci
