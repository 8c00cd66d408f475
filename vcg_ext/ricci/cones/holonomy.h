// SPDX-License-Identifier: GPL-3.0-or-later
// The holonomy of a flat metric with cones: how far directions turn on a walk round a loop.
#ifndef RICCI_HOLONOMY_H
#define RICCI_HOLONOMY_H

#include "../flow/curvature_map.h"
#include "../flow/hessian.h"
#include "../mesh/elements.h"
#include "../mesh/triangulation.h"

#include <vector>

namespace ricci {

/// A closed walk from triangle to triangle: the halfedges by which they are left, in order.
using FaceLoop = std::vector<Halfedge>;

/// Loops on which the homology of the surface is based: two for each handle, from a spanning tree of
/// the triangles and one of the vertices [Erickson Whittlesey 2005]. Each passes no triangle twice.
/// \param roundHoles also one round each boundary loop but one
std::vector<FaceLoop> homologyLoops(const Triangulation& t, bool roundHoles);

/// Flips \p e in \p t, and in \p loops, which stay what they are up to homotopy.
void flip(Triangulation& t, std::vector<FaceLoop>& loops, Edge e);

/// The corners round which \p loop turns: 1 where they are on its left, -1 on its right; 0 elsewhere.
/// The sum of their angles is the holonomy of the loop, in radians: the angle by which a direction that
/// goes along with the walk has turned against the walk's own. Across a vertex with curvature K it
/// changes by K, so that loops of one homology class have one holonomy up to sums of curvatures.
HalfedgeArray<double> turnedCorners(const Triangulation& t, const FaceLoop& loop);

/// Sum of \p weights times \p angles, both at the halfedges' origins.
double sumOfAngles(const HalfedgeArray<double>& weights, const HalfedgeArray<double>& angles);

/// The derivative of sumOfAngles() by the logarithms of the lengths, in flat triangles.
EdgeArray<double> derivativeByLengths(
	const Triangulation& t,
	const HalfedgeArray<double>& weights,
	const HalfedgeArray<double>& angles);

/// [vertex] The derivative of the holonomy of a loop by the curvature that the flow is to reach there: u
/// follows the curvature, and the holonomy follows u. 0 where u is fixed.
/// \param corners turnedCorners()
/// \param u where \p map was evaluated
/// \param hessian factorised there
VertexVector holonomyByCurvature(
	const CurvatureMap& map,
	const VertexVector& u,
	FactoredHessian& hessian,
	const HalfedgeArray<double>& corners);

} // namespace ricci

#endif
