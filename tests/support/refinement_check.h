// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_REFINEMENT_CHECK_H
#define RICCI_TESTS_REFINEMENT_CHECK_H

#include <ricci/surface/surface_mesh.h>

#include <array>
#include <vector>

namespace ricci::testing {

/// A refinement of a mesh with a map to the plane, by whichever part of the core it was handed
/// over. All faces of \p mesh must be coherently oriented.
struct RefinedMap
{
	const std::vector<SurfacePoint>& points;
	const std::vector<Triangle>& triangles;
	const std::vector<int>& inputFace;
	const std::vector<Triangle2>& uv;
};

/// What can be seen of it without knowing how it was made.
struct RefinementCheck
{
	double areaError = 0.0;   ///< relative: pieces of an input face against the face, in space
	double minWeight = 0.0;   ///< barycentric, in the input face of the piece; -1 if not in it
	double weightError = 0.0; ///< of the sum of the weights of a point
	int notPositive = 0;      ///< triangles of the plane that are not counter-clockwise, exactly
	int notPositiveByRounding = 0; ///< of these, so thin that the places' last digit decides
	/// Relative difference of an edge's lengths on its two sides, past what rounding of the places
	/// accounts for: an edge that is tiny in the map has no more digits.
	double seamMismatch = 0.0;
	int seamEdges = 0;
	int seamsInside = 0;     ///< edges whose sides lie apart and that are not part of an input edge
	double angleError = 0.0; ///< at inner points, against 2 pi less \p curvature there
	double area = 0.0;       ///< in the plane
	int eulerCharacteristic = 0;
	int boundaryLoops = 0;

	/// \param curvature [vertex of mesh]
	RefinementCheck(
		const SurfaceMesh& mesh, const RefinedMap& map, const std::vector<double>& curvature);
};

/// Edges of the plane metric of a refinement that go straight on at every point which is not a
/// vertex of the input, from vertex to vertex.
struct StraightLine
{
	int from, to;
	double length;
	std::vector<int> points;     ///< of the refinement, both ends included
	std::vector<double> inPlane; ///< [point] way from the beginning
	std::vector<double> inSpace; ///< the same on the surface
};
std::vector<StraightLine>
straightLines(const SurfaceMesh& mesh, const RefinedMap& map, double angleTolerance);

} // namespace ricci::testing

#endif
