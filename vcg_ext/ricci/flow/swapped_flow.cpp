// SPDX-License-Identifier: GPL-3.0-or-later
// The remedy of paper 5.4 where the flow breaks the triangle inequality.
#include "ricci_flow.h"

#include "../base/points.h"
#include "../base/task.h"
#include "../error.h"
#include "../metric/geometry.h"
#include "flow_run.h"

#include <algorithm>
#include <array>
#include <string>

namespace ricci {

namespace {

/// An edge that is swapped this often is left alone: nothing proves that the swaps end.
constexpr int kMaxSwapsOfOneEdge = 4;

/// Starts of the flow that the splitting of boundary edges may ask for.
constexpr int kMaxStarts = 20;

/// Edges of the flow's triangulation that are not edges of the component: swapped, or at a vertex
/// that a split has added.
EdgeArray<char>
foreignEdges(const Triangulation& beforeSwaps, EdgeArray<char> swapped, int componentVertices)
{
	swapped.resize(beforeSwaps.edgeCount(), 0);
	for (const Edge e : beforeSwaps.edges()) {
		const auto [i, j] = beforeSwaps.ends(e);
		if (std::max(i, j).number() >= componentVertices)
			swapped[e] = 1;
	}
	return swapped;
}

/// The remedy inside: the longest edge of the broken triangle is swapped; the radii of the new edge's ends are
/// kept, and its inversive distance comes from their 3D distance and their initial radii (Eq. 3, Euclidean). This
/// leaves the discrete conformal class, and the energy jumps; see conformal_flip.h for flips that do neither.
class EdgeSwapper
{
public:
	/// Positions, which must live as long as the swapper, and radii at the start of the flow.
	EdgeSwapper(const VertexArray<Point3>& positions, VertexArray<double> initialRadii) :
			m_positions(positions), m_initialRadii(std::move(initialRadii))
	{
	}

	/// Swaps the longest edge of every triangle that is broken in the present state of \p map, at
	/// most one edge of each triangle.
	/// \return whether an edge was swapped
	bool operator()(CurvatureMap& map)
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

	int swaps() const { return m_swaps; }

	/// 1 where the edge is no longer one of the input. Empty before the first call.
	const EdgeArray<char>& swapped() const { return m_swapped; }

	/// Boundary edges that are the longest of a triangle broken at the last call; a triangle that
	/// is broken with its longest edge on the boundary needs this edge split.
	const std::vector<Edge>& boundaryEdgesToSplit() const { return m_toSplit; }

private:
	const VertexArray<Point3>& m_positions;
	VertexArray<double> m_initialRadii;
	EdgeArray<char> m_swapped;
	EdgeArray<int> m_timesSwapped;
	FaceArray<char> m_touched; // in the present call
	std::vector<Edge> m_toSplit;
	int m_swaps = 0;
};

/// The remedy on the boundary: a component whose boundary edges may be split at their middles, with the way
/// back to the corners of its own faces.
class SplitMesh
{
public:
	explicit SplitMesh(const Component& component) :
			m_positions(component.positions), m_triangles(component.triangles),
			m_corner(3 * component.triangles.size())
	{
		for (const Corner c : m_corner.indices())
			m_corner[c] = c;
	}

	const VertexArray<Point3>& positions() const { return m_positions; }
	const std::vector<Triangle>& triangles() const { return m_triangles; }
	int splits() const { return m_splits; }

	/// Splits boundary edges of \p t, the triangulation of triangles(): at most one of each triangle.
	void split(const Triangulation& t, std::vector<Edge> edges)
	{
		sortUnique(edges);
		FaceArray<char> touched(t.faceCount(), 0);
		for (const Edge e : edges) {
			const Halfedge h = t.isExterior(e.halfedge()) ? e.halfedge().twin() : e.halfedge();
			const Face f = t.face(h);
			if (touched[f])
				continue;
			touched[f] = 1;
			const Triangle& corners = m_triangles[positionOf(f)];
			const auto side = std::find(corners.begin(), corners.end(), t.origin(h).number());
			splitSide(f.number(), static_cast<int>(side - corners.begin()));
			++m_splits;
		}
	}

	/// The halfedges of \p t, the triangulation of triangles(), at the corners of a face of the component.
	std::array<Halfedge, 3> corners(const Triangulation& t, Face f) const
	{
		std::array<Halfedge, 3> result;
		for (const Corner c : cornersOf(f.number()))
			result[c.index()] = t.halfedges(Face(m_corner[c].face()))[m_corner[c].index()];
		return result;
	}

private:
	void splitSide(int triangle, int side)
	{
		Triangle& t = m_triangles[positionOf(triangle)];
		const int i = t[positionOf(side)], j = t[positionOf((side + 1) % 3)];
		const int apex = t[positionOf((side + 2) % 3)];
		const int middle = m_positions.size(), added = static_cast<int>(m_triangles.size());
		const Point3 &a = m_positions[Vertex(i)], &b = m_positions[Vertex(j)];
		m_positions.push_back(0.5 * (a + b));
		t = {i, middle, apex};
		m_triangles.push_back({middle, j, apex});
		// The triangle now starts at i; its corner at j is one of the added triangle.
		const Corner first(triangle, side);
		for (Corner& c : m_corner)
			if (c.face() == triangle)
				c = c == first.next() ? Corner(added, 1) : Corner(triangle, c == first ? 0 : 2);
	}

	VertexArray<Point3> m_positions;
	std::vector<Triangle> m_triangles;
	CornerArray<Corner> m_corner; // [corner of the component] of m_triangles
	int m_splits = 0;
};

} // namespace

FlowResult flowWithEdgeSwaps(
	const Component& component,
	const FlowOptions& options,
	const ChooseTarget& chooseTarget,
	FlowDomain& domain,
	std::vector<FlowState>& states)
{
	SplitMesh mesh(component);
	FlowResult flow;
	int swaps = 0;
	for (int attempt = 0; attempt < kMaxStarts; ++attempt) {
		domain = {};
		EmbeddedSurface& surface = domain.surface;
		surface = embeddedSurface(mesh.positions(), mesh.triangles());
		const Triangulation& t = surface.triangulation;
		InitialPacking start = initialPacking(surface, options);
		const Target target = chooseTarget(surface, start);
		EdgeSwapper swapper(surface.positions, start.radii);
		const FlowProgress progress = flowProgress(options.epsilon, states);
		FlowRun run(surface, std::move(start), target, options, progress);
		run.operate([&](CurvatureMap& map) { return swapper(map); });
		try {
			if (!run.solve())
				throw run.failure();
			flow = run.result();
		}
		catch (NotConverged& error) {
			error.swaps = swapper.swaps();
			// A boundary that does not settle on a circle asks for no split.
			if (error.problem == NotConverged::CircleUnsettled ||
				swapper.boundaryEdgesToSplit().empty())
				throw;
		}
		swaps += swapper.swaps();
		// Also where the target is reached: a swap beside the broken triangle may have mended it.
		if (!swapper.boundaryEdgesToSplit().empty()) {
			mesh.split(t, swapper.boundaryEdgesToSplit());
			logLine(
				std::to_string(mesh.splits()) + " boundary edges split; the flow starts again.");
			continue;
		}
		flow.swaps = swaps;
		flow.splits = mesh.splits();
		if (flow.swaps > 0 || flow.splits > 0)
			domain.isForeign = foreignEdges(t, swapper.swapped(), component.positions.size());
		if (flow.splits > 0)
			for (const Face f : component.face.indices())
				domain.corners.push_back(mesh.corners(t, f));
		return flow;
	}
	throw NotConverged(NotConverged::SplitsUsedUp, positionOf(mesh.splits()));
}

} // namespace ricci
