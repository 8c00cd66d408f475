// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PARAMETRIZATION_H
#define RICCI_PARAMETRIZATION_H

#include "../math/points.h"
#include "../fuchsian/fuchsian_group.h"
#include "../report.h"
#include "../surface/opened_mesh.h"
#include "../surface/surface_point.h"

#include <string>
#include <vector>

namespace ricci {

/// One component laid out by its own metric, or a part of one; not yet packed beside the others.
struct Chart
{
	std::vector<int> faces;   ///< of the opened mesh
	std::vector<int> refined; ///< indices into RefinedMesh::triangles
	FuchsianGroup group;      ///< hyperbolic flow
	Box2 box;                 ///< the room that packCharts() has given it
};

/// The common refinement of the input with the triangles on which the map was found.
struct RefinedMesh
{
	std::vector<SurfacePoint> points; ///< the vertices of the opened mesh first, in order
	std::vector<Triangle> triangles;  ///< into points, in the input's orientation
	std::vector<int> inputFace;       ///< [triangle] face of the opened mesh
	std::vector<Triangle2> uv;        ///< [triangle][corner]
	std::vector<double> faceQC;       ///< sigma1 / sigma2
	std::vector<double> vertexQC;     ///< [point]
};

/// A map of the whole mesh to the plane. Numbers are those of the opened mesh, which are those of the
/// input unless it had to be cut; toInputNumbers() (input_numbers.h) makes them the input's.
struct Parametrization
{
	OpenedMesh opened;
	Report report;
	std::vector<std::string> notes; ///< what was done or chosen without being asked
	std::vector<Chart> charts;
	/// [face][corner] in the plane each chart from the origin, with its smallest bounding rectangle along
	/// the axes unless turns by right angles only are kept; in the disk as the group acts
	std::vector<Triangle2> uv;
	std::vector<char> reversed;          ///< [face] 1 if the face was turned round
	std::vector<double> faceQC;          ///< sigma1 / sigma2
	std::vector<double> vertexQC;        ///< area-weighted mean over the faces at the vertex
	std::vector<double> u;               ///< [vertex] Eq. 6; 0 at unused vertices
	std::vector<double> targetCurvature; ///< [vertex] radians, as reached
	/// Filled for OutputTriangulation::CommonRefinement; the report's qc fields and flippedFaces then
	/// are its own.
	RefinedMesh refined;

	bool isRefined() const { return !refined.triangles.empty(); }
};

} // namespace ricci

#endif
