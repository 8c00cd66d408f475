// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_INITIAL_PACKING_H
#define RICCI_INITIAL_PACKING_H

#include "../options.h"
#include "../surface/triangulation.h"

#include <vector>

namespace ricci {

/// A flat surface with cone points: the metric of a mesh carried by some triangulation of it.
struct IntrinsicMesh
{
	Triangulation triangulation;
	EdgeArray<double> lengths;
};

/// Where the flow starts (paper 4.1): the mesh's own metric on a triangulation of it, and the
/// circle packing whose metric it is (with Method::Thurston, nearly).
struct InitialPacking
{
	IntrinsicMesh mesh;
	VertexArray<double> radii;
	EdgeArray<double> delta; ///< inversive distance less one
	std::vector<Edge> flips; ///< edges flipped since the input, in order
	bool isDelaunay = false; ///< from delaunayPacking()
	double lengthened = 0.0; ///< what mollify() added to every edge
};

/// Where triangles are degenerate (they satisfy the triangle inequality by less than rounding can
/// tell, or have a side a million times shorter than another), adds one constant to all lengths, so
/// large that in those triangles every two sides exceed the third by 1e-5 of their longest
/// (intrinsic mollification [Sharp Crane 2020]). No face is lost, and no length changes by more
/// than the constant.
/// \return the constant, 0 where no triangle is degenerate
double mollify(const Triangulation& t, EdgeArray<double>& lengths);

/// Length of the other diagonal of the two plane triangles at edge \p e.
/// \pre \p e is flippable
double flippedLength(const IntrinsicMesh& mesh, Edge e);

/// The start with intrinsic flips: flips to the intrinsic Delaunay triangulation of the metric,
/// then, with half the initial radii of that, to the weighted one. Starting anywhere else would
/// keep a conformal class that is not the surface's: a conformal flip is isometric only where the
/// edge is both in and out of the weighted Delaunay triangulation. Degenerate triangles are given a
/// little area first (mollify()). Radii are lowered further where circles would touch: I > 1 on
/// every edge. That ends: it halves a radius each time that is at least half of an edge, and no edge
/// is shorter than the shortest geodesic between vertices.
/// \param mirror [vertex] the vertex whose radius must be the same (its image in a double, or
/// itself); may be empty
/// \throw InternalError where an edge is left without a length; NotConverged (FlipsUsedUp) where
/// rounding keeps the flips from ending
InitialPacking delaunayPacking(IntrinsicMesh mesh, const VertexArray<Vertex>& mirror);

/// The start on the mesh's own triangles, with the radii of paper 4.1 (initialRadii()).
/// \pre every triangle satisfies the strict triangle inequality
InitialPacking inputPacking(IntrinsicMesh mesh);

} // namespace ricci

#endif
