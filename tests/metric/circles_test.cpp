// SPDX-License-Identifier: GPL-3.0-or-later
// The circles that the flow ends with, against the formulas of the paper.
#include "support/front_door.h"
#include "support/random_surface.h"

#include <ricci/parametrize.h>

#include <gtest/gtest.h>

namespace ricci::testing {
namespace {

/// Closed, with boundaries, and with angles down to 1e-2 degrees.
std::vector<SurfaceMesh> surfaces()
{
	Random random(10);
	return {
		tetrahedron(),
		bumpyTorus(12, 8, random),
		randomPlanarDisk(8, random),
		sliverDisk(8, 2.0, random),
		withoutStars(shaken(perforatedSlab(1, 4), 0.03, random), {0}),
		shaken(perforatedSlab(2, 2), 0.03, random)};
}

/// The curvature of the mesh itself, some of it moved evenly to all vertices.
std::vector<double> smoothedCurvature(const SurfaceMesh& mesh, double share)
{
	Circles circles(mesh);
	std::vector<double> log, own;
	for (const auto r : circles.radius)
		log.push_back(static_cast<double>(std::log(r)));
	for (const auto K : circles.curvatureWith(log))
		own.push_back(static_cast<double>(K));
	const double mean = sum(own) / static_cast<double>(own.size());
	for (double& K : own)
		K = (1.0 - share) * K + share * mean;
	return own;
}

Options prescribed(Method method)
{
	Options options = towards(TargetCurvature::Prescribed, method);
	options.freeBoundary = false;
	return options;
}

/// Where the flow has nothing to do its radii are the least tangent lengths of the triangles at a vertex; with
/// flips half of them, so that no circles touch, here without a flip.
TEST(Circles, OfTheStartAreThoseOfThePaper)
{
	for (const SurfaceMesh& mesh : surfaces()) {
		const VertexInput own = prescribing(smoothedCurvature(mesh, 0.0));
		const FlatResult map = flattened(mesh, prescribed(Method::FixedTriangles), own);
		EXPECT_EQ(map.report.iterations, 0);
		const Circles circles(mesh);
		for (std::size_t v = 0; v < map.u.size(); ++v)
			EXPECT_NEAR(map.u[v], static_cast<double>(std::log(circles.radius[v])), 1e-10);
	}
	const SurfaceMesh mesh = tetrahedron();
	const VertexInput own = prescribing(smoothedCurvature(mesh, 0.0));
	const FlatResult map = flattened(mesh, prescribed(Method::IntrinsicFlips), own);
	EXPECT_EQ(map.report.flips, 0);
	for (const double u : map.u)
		EXPECT_NEAR(std::exp(u), static_cast<double>(0.5L * Circles(mesh).radius[0]), 1e-12);
}

/// The Delaunay triangles of points in the plane: no other point lies in their circles.
std::vector<Triangle> delaunay(const std::vector<Point3>& points)
{
	const int n = static_cast<int>(points.size());
	std::vector<Triangle> triangles;
	const auto inCircle = [&](const Triangle& t, int v) {
		double m[3][3];
		for (std::size_t k = 0; k < 3; ++k) {
			m[k][0] = points[at(t[k])][0] - points[at(v)][0];
			m[k][1] = points[at(t[k])][1] - points[at(v)][1];
			m[k][2] = m[k][0] * m[k][0] + m[k][1] * m[k][1];
		}
		return m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]) -
				   m[1][2] * (m[0][0] * m[2][1] - m[0][1] * m[2][0]) +
				   m[2][2] * (m[0][0] * m[1][1] - m[0][1] * m[1][0]) >
			   0.0;
	};
	for (int a = 0; a < n; ++a)
		for (int b = a + 1; b < n; ++b)
			for (int c = a + 1; c < n; ++c) { // counter-clockwise, the lowest first
				const Triangle t{a, b, c};
				const Point3 ab = points[at(b)] - points[at(a)], ac = points[at(c)] - points[at(a)];
				bool isEmpty = b != c && cross(ab, ac)[2] > 1e-9;
				for (int v = 0; v < n && isEmpty; ++v)
					isEmpty = v == a || v == b || v == c || !inCircle(t, v);
				if (isEmpty)
					triangles.push_back(t);
			}
	return triangles;
}

/// With flips the circles are those of the intrinsic Delaunay triangulation of the mesh, whatever its own.
TEST(Circles, OfTheStartBelongToTheDelaunayTriangulation)
{
	Random random(161);
	for (int trial = 0; trial < 5; ++trial) {
		SurfaceMesh mesh = grid(6, 6, Ends::Open, Ends::Open, [&](int i, int j) {
			const bool isX = i % 6 != 0, isY = j % 6 != 0; // the border stays straight
			return Point3{
				i + (isX ? random.real(-0.2, 0.2) : 0.0),
				j + (isY ? random.real(-0.2, 0.2) : 0.0),
				0.0};
		});
		swapDiagonalsAtRandom(mesh, random);
		const SurfaceMesh other{mesh.positions, delaunay(mesh.positions)};
		ASSERT_EQ(other.triangles.size(), mesh.triangles.size());
		const FlatResult map = flattened(
			mesh,
			towards(TargetCurvature::Prescribed),
			prescribing(std::vector<double>(mesh.positions.size(), 0.0)));
		EXPECT_EQ(map.report.iterations, 0);
		EXPECT_GT(map.report.flips, 5);
		const Circles circles(other);
		for (std::size_t v = 0; v < map.u.size(); ++v)
			EXPECT_NEAR(std::exp(map.u[v]), static_cast<double>(0.5L * circles.radius[v]), 1e-12);
	}
}

/// Radii change, inversive distances stay: every edge of the map is as long as Eq. 4 says, and the curvature of
/// these lengths is the target.
TEST(Circles, HaveTheLengthsOfTheMapAndItsCurvature)
{
	for (const SurfaceMesh& mesh : surfaces())
		for (const Method method : {Method::FixedTriangles, Method::Thurston}) {
			SCOPED_TRACE(static_cast<int>(method));
			Circles circles(mesh);
			circles.isThurston = method == Method::Thurston;
			const std::vector<double> target = smoothedCurvature(mesh, 0.5);
			const FlatResult map = flattened(mesh, prescribed(method), prescribing(target));
			EXPECT_LE(map.report.maxCurvatureError, 1e-8);
			EXPECT_LT(largestDifference(map.targetCurvature, target), 1e-12);
			expectDrawn(mesh, map, target);
			const auto curvature = circles.curvatureWith(map.u);
			for (std::size_t v = 0; v < target.size(); ++v)
				EXPECT_NEAR(static_cast<double>(curvature[v]), target[v], 1e-8);
			for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
				for (std::size_t k = 0; k < 3; ++k) {
					const int i = mesh.triangles[f][k], j = mesh.triangles[f][(k + 1) % 3];
					const auto l = static_cast<double>(circles.lengthWith(map.u, i, j));
					const Point2 side = map.uv[f][(k + 1) % 3] - map.uv[f][k];
					EXPECT_NEAR(std::hypot(side[0], side[1]) / l, 1.0, 1e-9);
				}
		}
}

TEST(Circles, HaveTheLengthsOfTheMapInTheDiskAndItsCurvature)
{
	const SurfaceMesh mesh = perforatedSlab(2, 3); // no triangle breaks
	Circles circles(mesh);
	circles.isHyperbolic = true;
	HyperbolicOptions options;
	options.method = Method::FixedTriangles;
	const FlatResult map = inUnitDisk(mesh, options);
	EXPECT_EQ(map.report.flips, 0);
	for (const auto K : circles.curvatureWith(map.u))
		EXPECT_NEAR(static_cast<double>(K), 0.0, 1e-8);
	expectDrawn(mesh, map, map.targetCurvature, false, true);
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k) {
			const int i = mesh.triangles[f][k], j = mesh.triangles[f][(k + 1) % 3];
			const auto p = asComplex(map.uv[f][k]), q = asComplex(map.uv[f][(k + 1) % 3]);
			const double length = 2.0 * std::atanh(std::abs((q - p) / (1.0 - std::conj(p) * q)));
			EXPECT_NEAR(length / static_cast<double>(circles.lengthWith(map.u, i, j)), 1.0, 1e-8);
		}
}

} // namespace
} // namespace ricci::testing
