// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PARAMETRIZE_H
#define RICCI_PARAMETRIZE_H

#include "layout/parametrization.h"
#include "mesh/surface_mesh.h"
#include "options.h"
#include "progress.h"

namespace ricci {

/// Checks the options of a run by themselves, without a mesh. The functions below call it.
/// \throw InvalidOption
void checkOptions(const Options& options);
void checkOptions(const HyperbolicOptions& options);

/// The Euclidean generalized Ricci flow from a mesh to the plane, component by component: circle
/// packing (paper 4.1), flow (4.2), cut and layout (4.3), distortion (5.1). A chart keeps the area
/// of its component unless its boundary is free, which fixes the scale.
///
/// Any triangles may be given: openMesh() first cuts them open to oriented manifolds, and along the
/// seams that they are marked with. Each piece then is a component, with a boundary like any other, and
/// the result is in the numbers of the opened mesh.
///
/// Everywhere in this library the paper, with its sections and equations, is [Yang et al. 2009].
/// REFERENCES.md lists this and all other sources.
/// \throw InvalidMesh, InvalidOption, InadmissibleCurvature, NotConverged, SolverFailed, TooLarge,
/// Stopped; where the mesh has several components, with the failed one named
Parametrization
parametrizeEuclidean(const SurfaceMesh& mesh, const VertexInput& input, const Options& options);

/// The hyperbolic generalized Ricci flow from a mesh to the Poincaré disk, component by component.
/// The uv coordinates are points of the unit disk, the middle of each component at 0; u is
/// ln tanh(radius / 2). Distortion is that of the linear maps from the faces to the triangles of
/// their corners' chords in the hyperboloid model, with sides 2 sinh(l / 2): the disk's own picture
/// would add its distortion. A face counts as flipped if its geodesic triangle is.
/// \throw as parametrizeEuclidean()
Parametrization parametrizeHyperbolic(
	const SurfaceMesh& mesh, const VertexInput& input, const HyperbolicOptions& options);

} // namespace ricci

#endif
