// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_FLAT_MAP_H
#define RICCI_TESTS_FLAT_MAP_H

#include <ricci/parametrize.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace ricci::testing {

using UV = std::vector<Triangle2>;

constexpr OutputTriangulation kOutputs[] = {
	OutputTriangulation::KeepMesh, OutputTriangulation::CommonRefinement};

/// A map in the indices of the input, with what it gives the input's faces.
struct FlatResult : Parametrization
{
	UV uv; ///< [face][corner]; of a refinement at those corners that a piece has
};

/// A map with the places that it gives the corners of the input's faces.
FlatResult withCorners(const SurfaceMesh& mesh, Parametrization map);

/// The triangles of a map of \p mesh, where they lie on it.
std::vector<std::array<Point3, 3>> inSpace(const SurfaceMesh& mesh, const Parametrization& map);

/// What the linear maps of triangles to their images do, by formulas of its own: ratio of the singular values,
/// and areas at the scale at which the total area stays.
struct Distortion
{
	std::vector<double> qc, area; ///< [triangle] area in space
	double qcMean = 0.0, qcAreaMean = 0.0, qcMax = 1.0;
	double areaMean = 0.0;   ///< of max(s, 1/s), weighted by area
	double areaSpread = 0.0; ///< standard deviation of ln s
	double stretch = 0.0;    ///< symmetric Dirichlet energy at the best scale, 4 of an isometry

	/// \param from triangles in space, \param to their images
	Distortion(const std::vector<std::array<Point3, 3>>& from, const UV& to);
	/// Of the triangles of a map of \p mesh.
	Distortion(const SurfaceMesh& mesh, const Parametrization& map);
};

/// What lies on each other in a finished texture, found without knowing how it was made: charts are
/// faces joined by edges that have the same place on both sides.
struct CoveredTwice
{
	int charts = 0;
	long betweenCharts = 0; ///< pairs of faces of different charts with a common inner point
	long withinCharts = 0;  ///< pairs of one chart whose common part is wider than kContact

	/// Rounding of texture coordinates, which are floats, on both sides of a seam.
	static constexpr double kContact = 3e-7;

	/// \param uv in the unit square; taken as floats. Faces that are flipped, or have no area,
	/// are left out.
	/// \param reversed [face]; empty: none
	CoveredTwice(const SurfaceMesh& mesh, const UV& uv, const std::vector<char>& reversed = {});
};

/// Pairs of triangles of one chart that cover a part of the plane together.
std::size_t overlapsIn(FlatMesh mesh);

/// Charts in the plane, one beside the other, at the scale of the mesh.
FlatResult run(const SurfaceMesh& mesh, const Options& options, const VertexInput& input = {});

/// Charts in the Poincaré disk, parts of divided disks at their places in it.
FlatResult
runInDisk(const SurfaceMesh& mesh, const HyperbolicOptions& options, const VertexInput& input = {});

/// These vertices selected.
VertexInput selecting(const SurfaceMesh& mesh, const std::vector<int>& vertices);

/// Options of the flow on the given triangulation.
Options fixedTriangulation(TargetCurvature target = TargetCurvature::Automatic);

/// The sentence with which run() ends; empty if it succeeds.
std::string reason(const SurfaceMesh& mesh, const Options& options, const VertexInput& input = {});

} // namespace ricci::testing

#endif
