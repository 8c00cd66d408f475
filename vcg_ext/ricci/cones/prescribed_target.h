// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PRESCRIBED_TARGET_H
#define RICCI_PRESCRIBED_TARGET_H

#include "../base/points.h"
#include "../flow/target.h"
#include "../mesh/elements.h"
#include "../mesh/surface_mesh.h"
#include "../mesh/triangulation.h"
#include "../options.h"

#include <array>
#include <vector>

namespace ricci {

/// The target with K = 0 at every vertex of a surface, and no u fixed.
Target zeroTarget(const Topology& topology);

/// The vertices that are selected, in order.
std::vector<Vertex> selectedVertices(const std::vector<char>& selected);

/// The same for cones, which have to be somewhere.
/// \throw InvalidOption (NothingSelected) if there is none
std::vector<Vertex> selectedCones(const std::vector<char>& selected);

/// Copies prescribed curvatures to the target. Values of the size of rounding are not cones and
/// become 0.
/// \throw InadmissibleCurvature (NotFinite) if a value is NaN or infinite
void setPrescribed(const VertexInput& input, Target& target);

/// Checks what holds for the curvature at each vertex of any metric, flat or hyperbolic, because its
/// angles are positive: K < 2 pi inside and K < pi on the boundary. Vertices where u is fixed are
/// left out, and so is a circular target, whose boundary is yet to be adapted.
/// \throw InadmissibleCurvature (TooLargeInside, TooLargeOnBoundary) with the largest violation
void checkVertexBounds(const Topology& topology, const Target& target);

/// Checks what Gauss-Bonnet asks of the curvature inside where the boundary is free: its n vertices
/// take what is left, each less than pi, and a hyperbolic area is positive, so that in both geometries
/// sum K > 2 pi chi - pi n over the vertices inside. Nothing is asked where no u is fixed.
/// \throw InadmissibleCurvature (FreeBoundary) with both numbers
void checkFreeBoundary(const Topology& topology, const Target& target);

/// Four vertices of the boundary \p loop for the corners of a rectangle, in the order of the loop:
/// those nearest to the corners of the rectangle of minimum area around the loop, in the plane that
/// fits the loop best, so that a patch with a four-cornered outline gets its own corners. Where these
/// are not four different vertices in order, the loop is divided into quarters of equal length.
/// \pre \p loop has at least four vertices
std::array<Vertex, 4>
rectangleCorners(const std::vector<Vertex>& loop, const VertexArray<Point3>& positions);

/// Chooses the target of the hyperbolic flow and checks that a metric with that curvature can exist:
/// K < 2 pi inside, K < pi on the boundary, and sum K > 2 pi chi, because the difference is the area
/// (Gauss-Bonnet). Smooth metrics with these cones then do exist on closed surfaces
/// [Troyanov 1991]. Where the boundary is free the sum over the vertices inside needs to be above
/// 2 pi chi - pi n only, for n vertices on the boundary: see checkFreeBoundary(). The scale at which
/// its circles keep their radii is freeBoundaryArea().
/// \throw InvalidOption if a cone's angle is not positive, or nothing is selected for cones
/// \throw InadmissibleCurvature otherwise, with the numbers that contradict each other
Target chooseHyperbolicTarget(
	const Topology& topology, const HyperbolicTargetOptions& options, const VertexInput& input);

} // namespace ricci

#endif
