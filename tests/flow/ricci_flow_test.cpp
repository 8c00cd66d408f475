// SPDX-License-Identifier: GPL-3.0-or-later
// The flow to a flat metric with prescribed curvature, seen in the map.
#include "support/flipped_flow.h"
#include "support/front_door.h"
#include "support/implicit_surface.h"
#include "support/map_check.h"
#include "support/random_surface.h"

#include <gtest/gtest.h>

#include <string>

namespace ricci::testing {
namespace {

/// The map has the curvature asked for: by the flow's word, as it is drawn, and by Gauss-Bonnet.
/// \param isFree whether the boundary keeps its metric
void expectReached(const SurfaceMesh& mesh, const FlatResult& map, bool isFree = false)
{
	const Report& report = map.report;
	EXPECT_TRUE(report.converged);
	EXPECT_LE(report.residualFloor, 1e-8);
	EXPECT_LE(report.maxCurvatureError, std::max(1e-8, report.residualFloor));
	EXPECT_EQ(report.brokenTriangles, 0);
	expectDrawn(mesh, map, map.targetCurvature, isFree);
	EXPECT_LT(MapCheck(mesh, map).seamMismatch, 1e-7);
	if (!isFree) {
		EXPECT_NEAR(sum(map.targetCurvature), 2 * kPi * report.eulerCharacteristic, 1e-10);
	}
}

void expectReaches(const SurfaceMesh& mesh, const std::vector<double>& curvature)
{
	Options options = towards(TargetCurvature::Prescribed);
	options.freeBoundary = false;
	const FlatResult map = flattened(mesh, options, prescribing(curvature));
	EXPECT_LT(largestDifference(map.targetCurvature, curvature), 1e-12);
	EXPECT_FALSE(map.report.torusTauRe); // not flat: no period lattice
	expectReached(mesh, map);
}

/// Values uniform in [low, high) at a random \p share of the vertices, 0 elsewhere, then moved
/// together so that they add up to 2 pi chi, with \p high as a bound.
std::vector<double>
curvatures(const SurfaceMesh& mesh, int chi, double low, double high, double share, Random& random)
{
	return randomCurvature(static_cast<int>(mesh.positions.size()), chi, low, high, share, random);
}

TEST(RicciFlow, ReachesRandomCurvatures)
{
	Random random(460);
	for (const int genus : {0, 1, 2})
		for (const SurfaceMesh& mesh :
			 {shaken(perforatedSlab(genus, 3), 0.08, random), implicitClosed(genus, 5, 1)}) {
			SCOPED_TRACE("genus " + std::to_string(genus));
			const int chi = 2 - 2 * genus;
			expectReaches(mesh, curvatures(mesh, chi, -3, 3, 1.0, random));
			expectReaches(mesh, curvatures(mesh, chi, -6, 6.2, 0.3, random));
		}
}

TEST(RicciFlow, ReachesConesNearTheBound)
{
	Random random(460);
	const SurfaceMesh sphere = shaken(perforatedSlab(0, 3), 0.05, random);
	const SurfaceMesh donut = bumpyTorus(12, 9, random);
	for (const double gap : {0.1, 0.01}) {
		SCOPED_TRACE(gap);
		const double strong = 2 * kPi - gap;
		std::vector<double> curvature(sphere.positions.size(), 0.0);
		curvature[3] = curvature[20] = strong;
		curvature[11] = 4 * kPi - 2 * strong;
		expectReaches(sphere, curvature);

		curvature.assign(donut.positions.size(), 0.0);
		curvature[5] = strong;
		curvature[70] = -strong;
		expectReaches(donut, curvature);

		// The strongest negative cone that the rest of the surface can pay for with such cones.
		curvature.assign(sphere.positions.size(), 0.0);
		for (std::size_t v = 0; v < 10; ++v)
			curvature[5 * v] = strong;
		curvature[3] = 4 * kPi - 10 * strong;
		expectReaches(sphere, curvature);
	}
}

/// Newton's method: residuals fall, in the end quadratically; as many steps on fine meshes as on coarse ones; and
/// what is asked for is reached, and far more.
TEST(RicciFlow, ConvergesQuadratically)
{
	std::vector<int> iterations;
	int quadratic = 0;
	for (const int n : {24, 48, 96}) {
		const SurfaceMesh mesh = torus(2.0, 1.0, 2 * n, n);
		const FlatResult map =
			flattened(mesh, towards(TargetCurvature::Flat, Method::FixedTriangles));
		expectReached(mesh, map);
		const std::vector<FlowState>& states = map.report.flowStates;
		EXPECT_EQ(states.back().step, map.report.iterations);
		for (std::size_t i = 1; i < states.size(); ++i) {
			const double before = states[i - 1].residual, after = states[i].residual;
			EXPECT_EQ(states[i].step, states[i - 1].step + 1);
			EXPECT_LT(after, before);
			if (before < 0.1 && after > 1e-11) {
				EXPECT_LT(after, 10 * before * before);
				++quadratic;
			}
		}
		iterations.push_back(map.report.iterations);
		EXPECT_LE(iterations.back(), 10);
	}
	EXPECT_GE(quadratic, 3);
	EXPECT_LE(std::abs(iterations[2] - iterations[0]), 1);

	Random random(78);
	const SurfaceMesh mesh = bumpyTorus(16, 10, random);
	for (const double epsilon : {1e-3, 1e-5, 1e-12}) {
		Options options = towards(TargetCurvature::Flat);
		options.epsilon = epsilon;
		const FlatResult map = flattened(mesh, options);
		expectReached(mesh, map);
		// Steps go on to the rounding floor.
		EXPECT_LT(map.report.maxCurvatureError, std::min(epsilon, 20 * map.report.residualFloor));
	}
}

/// The flow's metric is one for every triangulation of a metric. In the plane any diagonals of convex quads
/// are one.
TEST(RicciFlow, DoesNotDependOnTheTriangulationOfTheInput)
{
	Random random(440);
	const SurfaceMesh plane = grid(9, 9, Ends::Open, Ends::Open, [&](int i, int j) {
		return Point3{i + random.real(-0.2, 0.2), j + random.real(-0.2, 0.2), 0.0};
	});
	SurfaceMesh other = plane;
	swapDiagonalsAtRandom(other, random);
	for (const TargetCurvature target : {TargetCurvature::Disk, TargetCurvature::Rectangle}) {
		const FlatResult a = flattened(plane, towards(target)),
						 b = flattened(other, towards(target));
		expectReached(plane, a);
		expectReached(other, b);
		EXPECT_GT(largestDifference(a.u, std::vector<double>(a.u.size(), a.u[0])), 0.1);
		EXPECT_LT(largestDifference(a.u, b.u), 1e-8);
	}
}

TEST(RicciFlow, FreeBoundaryKeepsItsLengths)
{
	Random random(470);
	for (const SurfaceMesh& mesh :
		 {sliverDisk(10, 1.0, random),
		  implicitDisk(12, 3),
		  implicitAnnulus(12, 3),
		  withoutStars(torus(3, 1, 16, 12), {0, 50, 100})})
		for (const Method method : {Method::FixedTriangles, Method::IntrinsicFlips}) {
			const std::vector<double> flat(mesh.positions.size(), 0.0);
			Options options = towards(TargetCurvature::Prescribed, method);
			const FlatResult map = flattened(mesh, options, prescribing(flat));
			expectReached(mesh, map, true);
			EXPECT_GT(map.report.iterations, 0);
			EXPECT_NEAR(map.report.boundaryRatioMin.value_or(0), 1.0, 1e-9);
			EXPECT_NEAR(map.report.boundaryRatioMax.value_or(0), 1.0, 1e-9);
			const std::vector<char> boundary = boundaryOf(mesh);
			const Circles circles(mesh);
			for (std::size_t v = 0; v < flat.size(); ++v)
				if (boundary[v] && method == Method::FixedTriangles) {
					EXPECT_NEAR(map.u[v], static_cast<double>(std::log(circles.radius[v])), 1e-10);
				}
		}
}

/// Boundaries that ask for more than edges which may not flip can give: the flow runs on the double of the
/// surface then. The map is straight, or round, and has its corners, wherever the boundary was.
TEST(RicciFlow, ReachesTheCurvatureOfRaggedBoundaries)
{
	for (const std::uint64_t seed : {1u, 2u, 3u}) {
		Random random(480 + seed);
		const struct
		{
			const char* name;
			SurfaceMesh mesh;
			TargetCurvature target;
		} cases[] = {
			{"disk", implicitDisk(14, seed), TargetCurvature::Disk},
			{"rectangle", implicitDisk(14, seed), TargetCurvature::Rectangle},
			{"annulus", implicitAnnulus(14, seed), TargetCurvature::Flat},
			{"sliver disk", sliverDisk(9, 1.5, random), TargetCurvature::Disk},
			{"sliver rectangle", sliverDisk(9, 1.5, random), TargetCurvature::Rectangle},
			{"ragged rectangle",
			 shaken(rectangle(8, 3, 8, 1), 0.2, random),
			 TargetCurvature::Rectangle},
			{"ragged disk", shaken(rectangle(6, 6, 1, 1), 0.08, random), TargetCurvature::Disk}};
		for (const auto& c : cases) {
			SCOPED_TRACE(std::string(c.name) + ", seed " + std::to_string(seed));
			Options options = towards(c.target);
			options.output = OutputTriangulation::CommonRefinement;
			const FlatResult map = flattened(c.mesh, options);
			expectReached(c.mesh, map);
			EXPECT_EQ(map.report.flippedFaces, 0);
			double inPlane = 0.0;
			for (const Triangle2& p : map.mesh.corners())
				inPlane += 0.5 * cross(p[1] - p[0], p[2] - p[0]);
			EXPECT_NEAR(inPlane / areaOf(c.mesh), 1.0, 1e-9);
		}
	}
}

/// Equal shares of the total curvature, each rounded, add up to it as well as they can.
TEST(RicciFlow, TakesEqualSharesOfTheTotalCurvature)
{
	for (const int subdivision : {3, 7, 12, 17, 25}) {
		const SurfaceMesh mesh = perforatedSlab(5, subdivision);
		const auto n = mesh.positions.size();
		const std::vector<double> shares(n, -16 * kPi / static_cast<double>(n));
		EXPECT_TRUE(reachesTheFlow([&] {
			return flattened(mesh, towards(TargetCurvature::Prescribed), prescribing(shares));
		}));
	}
}

} // namespace
} // namespace ricci::testing
