// SPDX-License-Identifier: GPL-3.0-or-later
// The overlay of the input's and the flow's triangles, where the map on it is known. corner_layout_test.cpp and
// sliver_surfaces_test.cpp have what else it is.
#include "support/complex.h"
#include "support/expect.h"
#include "support/front_door.h"
#include "support/intrinsic.h"
#include "support/random_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace ricci::testing {
namespace {

/// With the curvature \p wanted, or a free boundary.
Parametrization refined(const SurfaceMesh& mesh, const std::vector<double>& wanted = {})
{
	Options options =
		towards(wanted.empty() ? TargetCurvature::Automatic : TargetCurvature::Prescribed);
	options.freeBoundary = wanted.empty();
	options.epsilon = 1e-10;
	options.output = OutputTriangulation::CommonRefinement;
	options.finish = Finish::None;
	options.charts = Charts::OfTheFlow;
	options.normalizeUV = false;
	return parametrizeEuclidean(mesh, prescribing(wanted), options);
}

/// A surface of the input's kind, whose metric in the plane is flat except for the cones.
void expectValid(const SurfaceMesh& mesh, const Parametrization& map)
{
	const MapCheck check(mesh, map);
	expectSurface(
		check,
		map.report.eulerCharacteristic,
		map.report.boundaryLoops,
		map.report.maxCurvatureError);
	EXPECT_LT(check.areaError, 1e-9);
	EXPECT_LT(check.angleError, 1e-8);
	if (map.report.boundaryRatioMin) { // free boundaries keep their lengths
		EXPECT_NEAR(*map.report.boundaryRatioMin, 1.0, 1e-9);
		EXPECT_NEAR(map.report.boundaryRatioMax.value_or(0.0), 1.0, 1e-9);
	}
	else { // others the surface its area
		EXPECT_NEAR(check.area / map.mesh.area(), 1.0, 1e-9);
	}
}

/// Equilateral triangles are Delaunay with room, and flat already.
TEST(CommonRefinement, IsTheInputWhereNothingFlips)
{
	const SurfaceMesh mesh = grid(6, 5, Ends::Open, Ends::Open, [](int i, int j) {
		// The grid's diagonal is the third direction of the lattice.
		return Point3{0.5 * (i + j), (i - j) * -0.5 * std::sqrt(3.0), 0.0};
	});
	const Parametrization map = refined(mesh);
	EXPECT_EQ(map.report.refinementPoints, 0);
	EXPECT_EQ(map.report.flips, 0);
	ASSERT_EQ(map.mesh.vertices.values().size(), mesh.triangles.size());
	std::set<int> met;
	for (const int piece : map.mesh.points.indices()) {
		Triangle t = map.mesh.vertices[piece];
		const Triangle& face = mesh.triangles[at(map.mesh.face[piece])];
		for (int turn = 0; turn < 3 && t != face; ++turn)
			std::rotate(t.begin(), t.begin() + 1, t.end());
		EXPECT_EQ(t, face);
		met.insert(map.mesh.face[piece]);
	}
	EXPECT_EQ(met.size(), mesh.triangles.size());
}

/// A plane surface with a free boundary is mapped to itself, at every crossing too.
TEST(CommonRefinement, APlaneIsMappedToItself)
{
	Random random(510);
	for (int i = 0; i < 4; ++i) {
		SurfaceMesh mesh = randomPlanarDisk(9, random);
		if (i == 3)
			mesh = stretched(mesh, {30, 1, 1}); // needles
		const Parametrization map = refined(mesh);
		EXPECT_GT(map.report.refinementPoints, 10);
		expectValid(mesh, map);
		const std::vector<Point3> source = map.mesh.onSurface(mesh.positions);
		const auto place = [&](Corner c) {
			const Point3& q = source[at(map.mesh.vertices[c])];
			return Complex(q[0], q[1]);
		};
		// The similarity that fits best: through the two corners farthest apart.
		Corner a(0), b(0);
		for (int c = 0; c < 3 * map.mesh.size(); ++c) {
			const auto along = [&](Corner x) { return place(x).real() + place(x).imag(); };
			a = along(Corner(c)) < along(a) ? Corner(c) : a;
			b = along(Corner(c)) > along(b) ? Corner(c) : b;
		}
		const Complex from = asComplex(map.mesh.at(a)), to = asComplex(map.mesh.at(b));
		const Complex factor = (to - from) / (place(b) - place(a));
		EXPECT_NEAR(std::abs(factor), 1.0, 1e-9);
		for (int c = 0; c < 3 * map.mesh.size(); ++c)
			EXPECT_LT(
				std::abs(
					from + factor * (place(Corner(c)) - place(a)) -
					asComplex(map.mesh.at(Corner(c)))),
				1e-9 * std::abs(to - from));
	}
}

/// With the surface's own curvature as target the flow stands still: the map is the development of
/// the surface, straight and isometric on every face of the input.
TEST(CommonRefinement, IsTheDevelopmentWhereTheMetricStays)
{
	Random random(520);
	std::vector<SurfaceMesh> meshes{
		shaken(tetrahedron(), 0.4, random),
		shaken(fan(6, 0.3), 0.3, random),
		shaken(bipyramid(5, 0.2), 0.3, random),
		shaken(bipyramid(3, 0.1), 0.1, random),
		shaken(perforatedSlab(0, 1), 0.3, random),
		shaken(rectangle(2, 2, 1, 1), 0.3, random)};
	int crossings = 0;
	for (int round = 0; round < 15; ++round)
		for (const SurfaceMesh& original : meshes) {
			SCOPED_TRACE("round " + std::to_string(round));
			const SurfaceMesh mesh = shaken(original, 0.2, random);
			const Parametrization map = refined(mesh, curvatureInSpace(mesh));
			expectValid(mesh, map);
			crossings += map.report.refinementPoints;
			const std::vector<Point3> source = map.mesh.onSurface(mesh.positions);
			std::vector<std::vector<Corner>> cornersIn(mesh.triangles.size());
			for (const int piece : map.mesh.points.indices())
				for (const Corner c : cornersOf(piece))
					cornersIn[at(map.mesh.face[piece])].push_back(c);
			for (const std::vector<Corner>& corners : cornersIn)
				for (const Corner c : corners)
					for (const Corner d : corners)
						EXPECT_NEAR(
							distance(map.mesh.at(c), map.mesh.at(d)),
							distance(
								source[at(map.mesh.vertices[c])], source[at(map.mesh.vertices[d])]),
							1e-8);
		}
	EXPECT_GT(crossings, 100);
}

} // namespace
} // namespace ricci::testing
