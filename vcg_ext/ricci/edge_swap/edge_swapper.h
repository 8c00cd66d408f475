// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_EDGE_SWAPPER_H
#define RICCI_EDGE_SWAPPER_H

#include "../flow/curvature_map.h"
#include "../math/points.h"
#include "../surface/elements.h"

#include <vector>

namespace ricci {

/// The remedy of paper 5.4 where the flow breaks the triangle inequality: the longest edge of the
/// broken triangle is swapped; the radii of the new edge's ends are kept and its inversive distance
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

} // namespace ricci

#endif
