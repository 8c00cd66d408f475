// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_DELAUNAY_START_H
#define RICCI_DELAUNAY_START_H

#include "../surface/triangulation.h"

#include <vector>

namespace ricci {

/// A flat surface with cone points: the metric of a mesh carried by some triangulation of it.
struct IntrinsicMesh
{
	Triangulation triangulation;
	std::vector<double> lengths; ///< [edge]
};

/// Where the flow with flips starts: the mesh's own metric on its weighted Delaunay triangulation.
/// Starting anywhere else would keep a conformal class that is not the surface's: a conformal flip
/// is isometric only where the edge is both in and out of the weighted Delaunay triangulation.
struct DelaunayStart
{
	IntrinsicMesh mesh;
	std::vector<double> radii; ///< [vertex] half of initialRadii() or less: I > 1 on every edge
	std::vector<int> flips;    ///< edges flipped since the input, in order
	double lengthened = 0.0;   ///< what mollify() added to every edge
};

/// Where triangles are degenerate (they satisfy the triangle inequality by less than rounding can
/// tell, or have a side a million times shorter than another), adds one constant to all lengths, so
/// large that in those triangles every two sides exceed the third by 1e-5 of their longest
/// (intrinsic mollification, Sharp and Crane 2020). No face is lost, and no length changes by more
/// than the constant.
/// \return the constant, 0 where no triangle is degenerate
double mollify(const Triangulation& t, std::vector<double>& lengths);

/// Length of the other diagonal of the two plane triangles at edge \p e.
double flippedLength(const IntrinsicMesh& mesh, int e);

/// Flips to the intrinsic Delaunay triangulation of the metric, then, with half the initial
/// radii of that, to the weighted one. Degenerate triangles are given a little area first
/// (mollify()). Radii are lowered further where circles would touch.
/// \param mirror [vertex] the vertex whose radius must be the same (its image in a double, or
/// itself); may be empty
DelaunayStart delaunayStart(IntrinsicMesh mesh, const std::vector<int>& mirror);

} // namespace ricci

#endif
