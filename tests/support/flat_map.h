// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_FLAT_MAP_H
#define RICCI_TESTS_FLAT_MAP_H

#include <ricci/parametrize.h>

#include <array>
#include <vector>

namespace ricci::testing {

using UV = std::vector<Triangle2>;

/// What can be seen of a map to the plane without knowing how it was made. Faces must be coherently
/// oriented.
struct FlatMap
{
	double seamMismatch =
		0.0; ///< worst relative difference of a seam's two lengths, beyond the coordinates' rounding
	int seamEdges = 0; ///< edges whose two sides lie at different places
	double area = 0.0;
	std::vector<double> curvature; ///< [vertex] 2 pi (boundary: pi) less the angles in the plane
	std::vector<char> boundary;    ///< [vertex]

	FlatMap(const SurfaceMesh& mesh, const UV& uv);

	/// Largest |curvature - target| over inner vertices, or over all.
	double insideError(const std::vector<double>& target) const;
	double error(const std::vector<double>& target) const;
};

/// A map before its charts are packed, in the indices of the input, with what it gives the input's faces.
struct FlatResult : Parametrization
{
	UV uv; ///< [face][corner]
};

/// quasiConformalDistortion() of a face of \p mesh.
double qcOf(const SurfaceMesh& mesh, const FlatResult& map, std::size_t face);

/// Pairs of triangles of one chart that cover a part of the plane together.
std::size_t overlapsIn(const FlatMesh& mesh);

/// Charts in the plane, each from the origin.
FlatResult run(const SurfaceMesh& mesh, const Options& options, const VertexInput& input = {});

/// Charts in the Poincaré disk.
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
