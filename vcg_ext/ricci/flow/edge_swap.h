// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_EDGE_SWAP_H
#define RICCI_EDGE_SWAP_H

#include "../surface/surface_mesh.h"
#include "curvature_map.h"

#include <vector>

namespace ricci {

/// The remedy of paper 5.4 where the flow breaks the triangle inequality: the longest edge of the
/// broken triangle is swapped; the radii of the new edge's ends are kept and its inversive distance
/// comes from their 3D distance and their initial radii. This leaves the discrete conformal class,
/// and the energy jumps; see conformal_flip.h for flips that do neither.
class EdgeSwapper
{
public:
	/// \p positions, \p initialRadii: by vertex, at the start of the flow.
	EdgeSwapper(const std::vector<Point3>& positions, std::vector<double> initialRadii);

	/// Swaps the longest edge of every triangle that is broken in the present state of \p map.
	/// \return whether an edge was swapped
	bool operator()(CurvatureMap& map);

	int swaps() const { return m_swaps; }

	/// [edge] 1 where the edge is no longer one of the input.
	const std::vector<char>& swapped() const { return m_swapped; }

	/// Boundary edges that are the longest of a triangle broken at the last call.
	const std::vector<int>& boundaryEdgesToSplit() const { return m_toSplit; }

private:
	const std::vector<Point3>& m_positions;
	std::vector<double> m_initialRadii;
	std::vector<char> m_swapped;
	std::vector<int> m_timesSwapped;
	std::vector<char> m_touched; // [face] in the present call
	std::vector<int> m_toSplit;
	int m_swaps = 0;
};

} // namespace ricci

#endif
