// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_MAP_CHECK_H
#define RICCI_TESTS_MAP_CHECK_H

#include <ricci/layout/parametrization.h>
#include <ricci/mesh/elements.h>
#include <ricci/mesh/surface_mesh.h>

#include <vector>

namespace ricci::testing {

/// Weight of a vertex of the input in a point; 0 where it has none.
inline double weightOf(const SurfacePoint& p, Vertex v)
{
	double weight = 0.0;
	for (std::size_t i = 0; i < 4; ++i)
		if (Vertex(p.vertex[i]) == v)
			weight += p.weight[i];
	return weight;
}

/// What can be seen of a map to the plane, of a mesh or its refinement, without knowing how it was made. All faces
/// of the mesh must be coherently oriented.
struct MapCheck
{
	double areaError = 0.0;   ///< relative: pieces of an input face against the face, in space
	double minWeight = 0.0;   ///< barycentric, in the input face of the piece; -1 if not in it
	double weightError = 0.0; ///< of the sum of the weights of a point
	int notPositive = 0;      ///< triangles of the plane that are not counter-clockwise, exactly
	int notPositiveByRounding = 0; ///< of these, so thin that the places' last digit decides
	/// Relative difference of an edge's lengths on its two sides, past what rounding of the places
	/// accounts for: an edge that is tiny in the map has no more digits.
	double seamMismatch = 0.0;
	int seamEdges = 0;       ///< whose two sides lie at different places
	int seamsInside = 0;     ///< edges whose sides lie apart and that are not part of an input edge
	double angleError = 0.0; ///< at inner points, against 2 pi less \p curvature there
	double area = 0.0;       ///< in the plane
	int eulerCharacteristic = 0;
	int boundaryLoops = 0;

	/// \param curvature [vertex of mesh]
	MapCheck(const SurfaceMesh& mesh, const FlatMesh& map, const std::vector<double>& curvature);

	MapCheck(const SurfaceMesh& mesh, const Parametrization& map) :
			MapCheck(mesh, map.mesh, map.targetCurvature)
	{
	}
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
straightLines(const SurfaceMesh& mesh, const FlatMesh& map, double angleTolerance);

} // namespace ricci::testing

#endif
