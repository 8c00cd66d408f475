// SPDX-License-Identifier: GPL-3.0-or-later
// The remedy of paper 5.4 where the flow breaks the triangle inequality.
#ifndef RICCI_SWAPPED_FLOW_H
#define RICCI_SWAPPED_FLOW_H

#include "../mesh/component.h"
#include "../mesh/flow_domain.h"
#include "curvature_map.h"
#include "ricci_flow.h"

#include <array>
#include <functional>
#include <vector>

namespace ricci {

/// The remedy inside: the longest edge of the broken triangle is swapped; the radii of the new edge's ends are kept and its inversive distance
/// comes from their 3D distance and their initial radii (Eq. 3, Euclidean). This leaves the
/// discrete conformal class, and the energy jumps; see conformal_flip.h for flips that do neither.
class EdgeSwapper
{
public:
	/// Positions, which must live as long as the swapper, and radii at the start of the flow.
	EdgeSwapper(const VertexArray<Point3>& positions, VertexArray<double> initialRadii);

	/// Swaps the longest edge of every triangle that is broken in the present state of \p map, at
	/// most one edge of each triangle.
	/// \return whether an edge was swapped
	bool operator()(CurvatureMap& map);

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
	explicit SplitMesh(const Component& component);

	const VertexArray<Point3>& positions() const { return m_positions; }
	const std::vector<Triangle>& triangles() const { return m_triangles; }
	int splits() const { return m_splits; }

	/// Splits boundary edges of \p t, the triangulation of triangles(): at most one of each triangle.
	void split(const Triangulation& t, std::vector<Edge> edges);

	/// The halfedge of \p t, the triangulation of triangles(), at corner \p c of the component.
	Halfedge corner(const Triangulation& t, Corner c) const;

private:
	void splitSide(int triangle, int side);

	VertexArray<Point3> m_positions;
	std::vector<Triangle> m_triangles;
	CornerArray<Corner> m_corner; ///< [corner of the component] of m_triangles
	int m_splits = 0;
};

/// A flow with the remedy of paper 5.4 for triangles that break: inner edges are swapped, boundary
/// edges are split, after which the flow starts again.
struct SwappedFlow
{
	FlowDomain domain; ///< with the boundary edges split, before any swap
	FlowResult
		flow; ///< its iterations are those of all starts, the triangulation of its metric is swapped
	int swaps = 0; ///< over all starts
	int splits = 0;
};

/// Chooses the target of one start of the flow.
using ChooseTarget = std::function<Target(const EmbeddedSurface&, InitialPacking&)>;

/// \param states those before each Newton step of all starts are appended
/// \throw NotConverged, what \p chooseTarget throws
SwappedFlow flowWithEdgeSwaps(
	const Component& component,
	const FlowOptions& options,
	const ChooseTarget& chooseTarget,
	std::vector<FlowState>& states);

} // namespace ricci

#endif
