// SPDX-License-Identifier: GPL-3.0-or-later
#include "../support/flat_map.h"
#include "../support/listener.h"
#include "../support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/parametrize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <utility>

namespace ricci::testing {
namespace {

/// The largest distance of the rotation between the two images of an edge from a multiple of pi / 2.
double seamError(const SurfaceMesh& mesh, const FlatResult& map)
{
	std::map<std::pair<int, int>, std::complex<double>> image;
	double error = 0.0;
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k) {
			const int i = mesh.triangles[f][k], j = mesh.triangles[f][(k + 1) % 3];
			const Point2 &p = map.uv[f][k], &q = map.uv[f][(k + 1) % 3];
			const std::complex<double> side(q[0] - p[0], q[1] - p[1]);
			image[{i, j}] = side;
			if (const auto other = image.find({j, i}); other != image.end()) {
				const double turn = std::arg(-side / other->second);
				error = std::max(error, std::abs(std::remainder(turn, 0.5 * kPi)));
			}
		}
	return error;
}

/// The slab, bent, so that its handles differ.
SurfaceMesh bentSlab(int genus, int subdivision)
{
	SurfaceMesh mesh = perforatedSlab(genus, subdivision);
	for (Point3& p : mesh.positions) {
		p[2] *= 1.0 + 0.11 * p[0];
		p[1] += 0.07 * p[0] * p[0] + 0.2 * std::sin(1.3 * p[0]);
		p[0] += 0.15 * std::sin(p[1]);
	}
	return mesh;
}

Options seamless(Finish finish)
{
	Options options;
	options.target = TargetCurvature::PlacedCones;
	options.cones.rounding = ConeRounding::QuarterTurns;
	options.finish = finish;
	return options;
}

void expectCones(const Parametrization& map, int eulerCharacteristic)
{
	double sum = 0.0;
	for (const double k : map.targetCurvature) {
		EXPECT_NEAR(std::remainder(k, 0.5 * kPi), 0.0, 1e-12);
		sum += k;
	}
	EXPECT_NEAR(sum, 2 * kPi * eulerCharacteristic, 1e-9);
}

TEST(MakeSeamless, RotatesByQuarterTurnsOnEveryGenus)
{
	for (int genus = 0; genus <= 5; ++genus)
		for (const Finish finish : {Finish::Repair, Finish::LeastDistortion}) {
			SCOPED_TRACE(genus);
			const SurfaceMesh mesh = bentSlab(genus, 4);
			const FlatResult map = run(mesh, seamless(finish));
			EXPECT_LT(seamError(mesh, map), 1e-9);
			ASSERT_TRUE(map.report.holonomyError);
			EXPECT_LT(*map.report.holonomyError, 1e-9);
			EXPECT_EQ(map.report.flippedFaces, 0);
			EXPECT_LT(map.report.maxCurvatureError, 1e-8);
			expectCones(map, 2 - 2 * genus);
		}
}

TEST(MakeSeamless, CostsLittleOfTheAngles)
{
	// On this surface the rotations with free cones would be up to an eighth of a turn off.
	const SurfaceMesh mesh = bentSlab(2, 8);
	Options free = seamless(Finish::LeastDistortion);
	free.cones.rounding = ConeRounding::Free;
	free.cones.distortion = 0.25;
	const FlatResult before = run(mesh, free);
	Options rounded = seamless(Finish::LeastDistortion);
	rounded.cones.distortion = 0.25;
	const FlatResult after = run(mesh, rounded);
	EXPECT_FALSE(before.report.holonomyError);
	EXPECT_GT(seamError(mesh, before), 0.01);
	EXPECT_LT(seamError(mesh, after), 1e-9);
	EXPECT_LT(after.report.qcAreaMean - 1.0, 1.5 * (before.report.qcAreaMean - 1.0));
}

TEST(MakeSeamless, RoundsHolesWithAFreeBoundary)
{
	for (int genus = 0; genus <= 2; ++genus) {
		SCOPED_TRACE(genus);
		const SurfaceMesh mesh = withoutStars(bentSlab(genus, 6), {0, 200, 400});
		Options options = seamless(Finish::LeastDistortion);
		options.cones.count = 6;
		const FlatResult map = run(mesh, options);
		ASSERT_EQ(map.report.boundaryLoops, 3);
		EXPECT_LT(seamError(mesh, map), 1e-9);
		EXPECT_EQ(map.report.flippedFaces, 0);
	}
}

TEST(MakeSeamless, LeavesPrescribedBoundaries)
{
	const SurfaceMesh mesh = withoutStars(bentSlab(1, 6), {0});
	Options options = seamless(Finish::LeastDistortion);
	options.freeBoundary = false;
	options.cones.count = 6;
	const FlatResult map = run(mesh, options);
	EXPECT_LT(map.report.maxCurvatureError, 1e-8);
	EXPECT_EQ(map.report.flippedFaces, 0);
	double sum = 0.0;
	for (const double k : map.targetCurvature)
		sum += k;
	EXPECT_NEAR(sum, 2 * kPi * map.report.eulerCharacteristic, 1e-9);
}

TEST(MakeSeamless, AddsNoConesToANumberThatIsAskedFor)
{
	for (const int count : {4, 7}) {
		Options options = seamless(Finish::LeastDistortion);
		options.cones.count = count;
		const SurfaceMesh mesh = bentSlab(2, 4);
		const FlatResult map = run(mesh, options);
		EXPECT_LE(map.report.cones, count);
		EXPECT_LT(seamError(mesh, map), 1e-9);
	}
}

TEST(MakeSeamless, ChangesNothingOnASphere)
{
	const SurfaceMesh mesh = bentSlab(0, 4);
	const FlatResult map = run(mesh, seamless(Finish::None));
	// The rotations across a tree of cones are sums of their curvatures.
	EXPECT_LT(map.report.holonomyError.value_or(1.0), 1e-12);
}

TEST(MakeSeamless, GivesTheSameTwice)
{
	const SurfaceMesh mesh = bentSlab(2, 4);
	const Options options = seamless(Finish::LeastDistortion);
	EXPECT_EQ(run(mesh, options).uv, run(mesh, options).uv);
}

TEST(MakeSeamless, HoldsOnTheCommonRefinement)
{
	Options options = seamless(Finish::LeastDistortion);
	options.output = OutputTriangulation::CommonRefinement;
	const FlatResult map = run(bentSlab(2, 4), options);
	EXPECT_LT(map.report.holonomyError.value_or(1.0), 1e-9);
	EXPECT_EQ(map.report.flippedFaces, 0);
}

TEST(MakeSeamless, CanBeCancelledAtAnyCall)
{
	const SurfaceMesh mesh = bentSlab(1, 4);
	const auto callsUntil = [&](int last) {
		Listener listener(last, "Rounding the rotations");
		heard(listener, [&] { return parametrizeEuclidean(mesh, {}, seamless(Finish::None)); });
		return listener.calls();
	};
	const int calls = callsUntil(std::numeric_limits<int>::max());
	ASSERT_GT(calls, 3);
	for (int last = 1; last <= calls; last += std::max(1, calls / 8))
		EXPECT_THROW(callsUntil(last), Cancelled);
}

} // namespace
} // namespace ricci::testing
