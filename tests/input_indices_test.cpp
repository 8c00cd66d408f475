// SPDX-License-Identifier: GPL-3.0-or-later
// Results have the input's vertices and faces, whatever had to be cut open or left out.
#include "support/bad_surfaces.h"
#include "support/flat_map.h"

#include <ricci/parametrize.h>

#include <gtest/gtest.h>

namespace ricci::testing {
namespace {

Parametrization mapOf(const SurfaceMesh& mesh, OutputTriangulation output)
{
	Options options;
	options.charts = Charts::OfTheFlow;
	options.output = output;
	return parametrizeEuclidean(mesh, {}, options);
}

/// The first vertex of both is one.
SurfaceMesh touching(const SurfaceMesh& a, const SurfaceMesh& b)
{
	SurfaceMesh image = b;
	for (Point3& p : image.positions)
		p = a.positions[0] - (p - b.positions[0]);
	SurfaceMesh mesh = sideBySide(a, image, 0.0);
	const int copy = static_cast<int>(a.positions.size());
	for (Triangle& t : mesh.triangles)
		for (int& v : t)
			v = v == copy ? 0 : v > copy ? v - 1 : v;
	mesh.positions.erase(mesh.positions.begin() + copy);
	return mesh;
}

/// A vertex at which two surfaces touch takes the mean of their values, weighted by the areas of its faces; u and the
/// target are those of its own surface. Pieces of a refinement meet at it.
TEST(InputIndices, VerticesTakeMeansWeightedByArea)
{
	const SurfaceMesh a = hill(6, 0.3), b = hill(5, 0.6), mesh = touching(a, b);
	for (const OutputTriangulation output : kOutputs) {
		const Parametrization map = mapOf(mesh, output), first = mapOf(a, output),
							  second = mapOf(b, output);
		EXPECT_EQ(map.report.splitVertices, 1);
		const int vertices = static_cast<int>(mesh.positions.size());
		const int points = map.report.refinementPoints;
		EXPECT_EQ(points, first.report.refinementPoints + second.report.refinementPoints);
		ASSERT_EQ(map.vertexQC.size(), at(vertices + points));
		ASSERT_EQ(map.u.size(), at(vertices));
		ASSERT_EQ(map.targetCurvature.size(), at(vertices));
		const auto areaAtFirst = [](const SurfaceMesh& surface) {
			double area = 0.0;
			for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
				const Triangle& t = surface.triangles[f];
				area += t[0] == 0 || t[1] == 0 || t[2] == 0 ? areaOf(surface, f) : 0.0;
			}
			return area;
		};
		const double areaA = areaAtFirst(a), areaB = areaAtFirst(b);
		EXPECT_NEAR(
			map.vertexQC[0],
			(areaA * first.vertexQC[0] + areaB * second.vertexQC[0]) / (areaA + areaB),
			1e-6);
		EXPECT_GT(std::abs(first.vertexQC[0] - second.vertexQC[0]), 1e-4);
		for (int v = 0; v < vertices; ++v) {
			const bool isA = at(v) < a.positions.size();
			const std::size_t own = at(isA ? v : v + 1 - static_cast<int>(a.positions.size()));
			const Parametrization& alone = isA ? first : second;
			EXPECT_NEAR(map.u[at(v)], alone.u[own], 1e-6);
			EXPECT_NEAR(map.targetCurvature[at(v)], alone.targetCurvature[own], 1e-6);
			if (v > 0) {
				EXPECT_NEAR(map.vertexQC[at(v)], alone.vertexQC[own], 1e-6);
			}
			EXPECT_EQ(map.mesh.source[v].vertex[0], v);
		}
		int atFirst = 0;
		for (const Triangle& t : map.mesh.vertices)
			atFirst += std::count(t.begin(), t.end(), 0) > 0;
		EXPECT_GE(atFirst, 2);
		for (const int piece : map.mesh.points.indices()) // in the order of its face
			for (const Corner c : cornersOf(piece))
				for (std::size_t i = 0; i < 4; ++i) {
					const SurfacePoint& p = map.mesh.source[map.mesh.vertices[c]];
					const Triangle& face = mesh.triangles[at(map.mesh.face[piece])];
					if (p.weight[i] != 0.0) {
						EXPECT_GT(std::count(face.begin(), face.end(), p.vertex[i]), 0);
					}
				}
	}
}

/// The input's order of corners, with what belongs to corners and sides.
TEST(InputIndices, ReversedFacesGetTheirOrderBack)
{
	const SurfaceMesh coherent = torus(2, 1, 8, 5);
	SurfaceMesh mesh = coherent;
	for (const std::size_t f : {3u, 4u, 17u})
		mesh.triangles[f] = reversed(mesh.triangles[f]);
	const Parametrization map = mapOf(mesh, OutputTriangulation::KeepMesh);
	const Parametrization plain = mapOf(coherent, OutputTriangulation::KeepMesh);
	EXPECT_EQ(map.mesh.vertices.values(), mesh.triangles);
	for (const int f : map.mesh.points.indices())
		for (std::size_t k = 0; k < 3; ++k) {
			const Triangle& t = mesh.triangles[at(f)];
			const auto own = static_cast<std::size_t>(
				std::find(
					coherent.triangles[at(f)].begin(), coherent.triangles[at(f)].end(), t[k]) -
				coherent.triangles[at(f)].begin());
			EXPECT_LT(distance(map.mesh.at(f)[k], plain.mesh.at(f)[own]), 1e-9);
			EXPECT_NEAR(
				map.mesh.lengths[f][k],
				distance(mesh.positions[at(t[k])], mesh.positions[at(t[(k + 1) % 3])]),
				1e-14);
		}
}

/// Faces without area lie on a side of a face with that edge, at a vertex, or nowhere, and in no chart. Whichever
/// corners have the same vertex, they lie at one point.
TEST(InputIndices, FacesWithoutAreaBecomeLines)
{
	SurfaceMesh mesh = rectangle(2, 2, 1, 1);
	const int faces = static_cast<int>(mesh.triangles.size());
	const auto [a, b, c] = mesh.triangles[3];
	for (double x : {5.0, 6.0, 7.0, 8.0})
		mesh.positions.push_back({x, 0.0, 0.0}); // 9, 10, 11, 12
	for (const Triangle& t :
		 {Triangle{b, c, c},
		  Triangle{c, b, c},
		  Triangle{c, c, b},
		  Triangle{c, c, c},
		  Triangle{a, 9, 9},
		  Triangle{9, 10, 11},
		  Triangle{12, 12, 12}})
		mesh.triangles.push_back(t);
	std::rotate(mesh.triangles.begin(), mesh.triangles.begin() + faces, mesh.triangles.end() - 6);
	for (const OutputTriangulation output : kOutputs) {
		const Parametrization map = mapOf(mesh, output);
		EXPECT_EQ(map.report.degenerateFaces, 7);
		const FlatMesh& flat = map.mesh;
		std::vector<int> degenerate{0};
		for (int f = faces + 1; f < faces + 7; ++f)
			degenerate.push_back(f);
		const auto isCornerOf = [&](const Point2& p, int v) { // of a face with area
			for (int k = 0; k < 3 * flat.size(); ++k)
				if (flat.chart[Corner(k).face()] >= 0 && flat.vertices[Corner(k)] == v &&
					flat.at(Corner(k)) == p)
					return true;
			return false;
		};
		int seen = 0;
		for (const int i : flat.points.indices()) {
			const int f = flat.face[i];
			const bool isFlat = std::count(degenerate.begin(), degenerate.end(), f) > 0;
			EXPECT_EQ(flat.chart[i], isFlat ? -1 : 0);
			if (!isFlat)
				continue;
			++seen;
			const Triangle t = mesh.triangles[at(f)];
			const Triangle2 p = flat.at(i);
			EXPECT_EQ(flat.vertices[i], t);
			EXPECT_EQ(doubledArea(p[0], p[1], p[2]), 0.0);
			for (std::size_t k = 0; k < 3; ++k)
				for (std::size_t j = 0; j < 3; ++j)
					if (t[k] == t[j]) {
						EXPECT_EQ(flat.points[i][k], flat.points[i][j]);
					}
			for (std::size_t k = 0; k < 3; ++k) {
				if (t[k] == b || t[k] == c || t[k] == a)
					EXPECT_TRUE(isCornerOf(p[k], t[k])) << f;
				else if (t[0] == a) // an edge that no face has
					EXPECT_EQ(p[k], p[0]);
				else
					EXPECT_EQ(p[k], (Point2{0.0, 0.0}));
			}
			if (std::count(t.begin(), t.end(), b) > 0) { // along the edge
				EXPECT_GT(std::max(distance(p[0], p[1]), distance(p[1], p[2])), 0.1);
			}
		}
		EXPECT_EQ(seen, 7);
	}
}

} // namespace
} // namespace ricci::testing
