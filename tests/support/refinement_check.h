// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_REFINEMENT_CHECK_H
#define RICCI_TESTS_REFINEMENT_CHECK_H

#include <ricci/layout/flat_mesh.h>
#include <ricci/mesh/elements.h>
#include <ricci/mesh/surface_mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
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

/// What can be seen of a refinement of a mesh in the plane without knowing how it was made. All faces of the
/// mesh must be coherently oriented.
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
		const SurfaceMesh& mesh, const FlatMesh& map, const std::vector<double>& curvature);

	/// Expects that the refinement is one of a surface of this kind, that its seams fit, and that no triangle is
	/// flipped.
	/// \param curvatureError radians, of the metric: an angle moves what is up to ten thousand edges away
	void expectValid(int chi, int loops, double curvatureError = 0.0) const
	{
		EXPECT_EQ(notPositive, 0);
		EXPECT_LT(seamMismatch, std::max(1e-9, 1e4 * curvatureError));
		EXPECT_GE(minWeight, -1e-12);
		EXPECT_LT(weightError, 1e-14);
		EXPECT_EQ(seamsInside, 0);
		EXPECT_EQ(eulerCharacteristic, chi);
		EXPECT_EQ(boundaryLoops, loops);
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
