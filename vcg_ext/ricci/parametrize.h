// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PARAMETRIZE_H
#define RICCI_PARAMETRIZE_H

#include "layout/common_refinement.h"
#include "layout/fuchsian_group.h"
#include "layout/planar_layout.h"
#include "options.h"
#include "progress.h"
#include "report.h"
#include "surface/surface_mesh.h"

#include <array>
#include <string>
#include <vector>

namespace ricci {

/// Values at the vertices of the mesh that some targets read. Empty where the mode has no use for
/// them.
struct VertexInput
{
	std::vector<char> selected;          ///< Rectangle, SelectedCones
	std::vector<double> targetCurvature; ///< Prescribed, radians
	double precision = 2.3e-16;          ///< relative rounding error of targetCurvature
};

/// One component laid out by its own metric, not yet packed beside the others.
struct Chart
{
	std::vector<int> faces;   ///< indices into SurfaceMesh::triangles
	std::vector<int> refined; ///< indices into RefinedMesh::triangles
	FuchsianGroup group;      ///< hyperbolic flow
};

/// The common refinement of the input with the triangles on which the map was found.
struct RefinedMesh
{
	std::vector<SurfacePoint> points;      ///< the input's vertices first, in order
	std::vector<Triangle> triangles;       ///< into points, in the input's orientation
	std::vector<int> inputFace;            ///< [triangle] index into SurfaceMesh::triangles
	std::vector<std::array<Point2, 3>> uv; ///< [triangle][corner]
	std::vector<double> faceQC;            ///< sigma1 / sigma2
	std::vector<double> vertexQC;          ///< [point]
};

/// A map of the whole mesh to the plane.
struct Parametrization
{
	Report report;
	std::vector<std::string> notes; ///< what was done or chosen without being asked
	std::vector<Chart> charts;
	std::vector<std::array<Point2, 3>> uv; ///< [face][corner]; each chart with its least bounding
										   ///< rectangle along the axes, from the origin
	std::vector<char> reversed;            ///< [face] 1 if the face was turned round
	std::vector<double> faceQC;            ///< sigma1 / sigma2
	std::vector<double> vertexQC;          ///< area-weighted mean over the faces at the vertex
	std::vector<double> u;                 ///< [vertex] Eq. 6; 0 at unused vertices
	std::vector<double> targetCurvature;   ///< [vertex] radians, as reached
	RefinedMesh refined;                   ///< filled for OutputTriangulation::CommonRefinement;
		///< the report's qc fields and flippedFaces then are its own
};

/// The Euclidean generalized Ricci flow from a mesh to the plane, component by component: circle
/// packing (paper 4.1), flow (4.2), cut and layout (4.3), distortion (5.1). A chart keeps the area
/// of its component unless its boundary is free, which fixes the scale.
/// \throw InvalidMesh, InvalidOption, InadmissibleCurvature, NotConverged, Cancelled
Parametrization parametrizeEuclidean(
	const SurfaceMesh& mesh, const VertexInput& input, const Options& options, Progress& progress);

/// The hyperbolic generalized Ricci flow from a mesh to the Poincaré disk, component by component.
/// The uv coordinates are points of the unit disk, the middle of each component at 0; u is
/// ln tanh(radius / 2). Distortion is that of the linear maps from the faces to the triangles of
/// their corners' chords in the hyperboloid model, with sides 2 sinh(l / 2): the disk's own picture
/// would add its distortion. A face counts as flipped if its geodesic triangle is.
/// \throw InvalidMesh, InvalidOption, InadmissibleCurvature, NotConverged, Cancelled
Parametrization parametrizeHyperbolic(
	const SurfaceMesh& mesh,
	const VertexInput& input,
	const HyperbolicOptions& options,
	Progress& progress);

} // namespace ricci

#endif
