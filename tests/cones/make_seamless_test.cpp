// SPDX-License-Identifier: GPL-3.0-or-later
// Cones of quarter turns, with rotations across all seams that are such.
#include "support/front_door.h"

#include <ricci/parametrize.h>

#include <gtest/gtest.h>

#include <map>
#include <string>
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
			const std::complex<double> side = asComplex(map.uv[f][(k + 1) % 3] - map.uv[f][k]);
			image[{i, j}] = side;
			if (const auto other = image.find({j, i}); other != image.end())
				error = std::max(
					error, std::abs(std::remainder(std::arg(-side / other->second), 0.5 * kPi)));
		}
	return error;
}

/// The slab, bent, so that its handles differ.
SurfaceMesh bentSlab(int genus, int subdivision, const std::vector<int>& holes = {})
{
	SurfaceMesh mesh = perforatedSlab(genus, subdivision);
	for (Point3& p : mesh.positions) {
		p[2] *= 1.0 + 0.11 * p[0];
		p[1] += 0.07 * p[0] * p[0] + 0.2 * std::sin(1.3 * p[0]);
		p[0] += 0.15 * std::sin(p[1]);
	}
	return withoutStars(mesh, holes);
}

Options seamless(Finish finish = Finish::LeastDistortion, int count = 0)
{
	Options options;
	options.target = TargetCurvature::PlacedCones;
	options.cones.rounding = ConeRounding::QuarterTurns;
	options.cones.count = count;
	options.finish = finish;
	options.charts = Charts::OfTheFlow;
	return options;
}

FlatResult mapped(const SurfaceMesh& mesh, const Options& options)
{
	FlatResult map = withCorners(mesh, parametrizeEuclidean(mesh, {}, options));
	EXPECT_EQ(map.report.flippedFaces, 0);
	EXPECT_LT(map.report.maxCurvatureError, 1e-8);
	return map;
}

/// Rotations and the curvature of every cone inside are multiples of pi / 2.
void expectSeamless(const SurfaceMesh& mesh, const FlatResult& map, double tolerance = 1e-9)
{
	EXPECT_LT(seamError(mesh, map), tolerance);
	EXPECT_LT(map.report.holonomyError.value_or(1.0), tolerance);
	const std::vector<char> boundary = boundaryOf(mesh);
	double total = 0.0;
	for (std::size_t v = 0; v < boundary.size(); ++v) {
		const double K = map.targetCurvature[v];
		EXPECT_TRUE(boundary[v] || std::abs(std::remainder(K, 0.5 * kPi)) < 1e-12);
		total += K;
	}
	if (map.report.boundaryLoops == 0) {
		EXPECT_NEAR(total, 2 * kPi * map.report.eulerCharacteristic, 1e-9);
	}
}

TEST(MakeSeamless, RotatesByQuarterTurnsOnEveryGenus)
{
	for (int genus = 0; genus <= 5; ++genus)
		for (const Finish finish : {Finish::None, Finish::Repair, Finish::LeastDistortion}) {
			SCOPED_TRACE("genus " + std::to_string(genus));
			if (finish != Finish::LeastDistortion && genus > 1)
				continue;
			const SurfaceMesh mesh = bentSlab(genus, 4);
			// The rotations across a tree of cones are sums of their curvatures.
			expectSeamless(
				mesh, mapped(mesh, seamless(finish)), finish == Finish::None ? 1e-12 : 1e-9);
		}
	Options refined = seamless();
	refined.output = OutputTriangulation::CommonRefinement;
	expectSeamless(bentSlab(2, 4), mapped(bentSlab(2, 4), refined));
}

TEST(MakeSeamless, CostsLittleOfTheAngles)
{
	// On this surface the rotations with free cones would be up to an eighth of a turn off.
	const SurfaceMesh mesh = bentSlab(2, 8);
	Options options = seamless();
	options.cones.distortion = 0.25;
	const FlatResult after = mapped(mesh, options);
	expectSeamless(mesh, after);
	options.cones.rounding = ConeRounding::Free;
	const FlatResult before = mapped(mesh, options);
	EXPECT_FALSE(before.report.holonomyError);
	EXPECT_GT(seamError(mesh, before), 0.01);
	EXPECT_LT(after.report.qcAreaMean - 1.0, 1.5 * (before.report.qcAreaMean - 1.0));
	// What is expected of the cones is said again once they have moved, with the seams to their new places.
	EXPECT_GT(after.notes.size(), before.notes.size());
	for (const std::string& note : after.notes)
		EXPECT_EQ(note.find("seams 0 "), std::string::npos) << note;
}

/// A boundary that is free; one that is prescribed takes the rest of the curvature, and may be turned anyhow.
TEST(MakeSeamless, RoundsHolesWithAFreeBoundaryAndLeavesPrescribedOnes)
{
	for (int genus = 0; genus <= 2; ++genus) {
		SCOPED_TRACE("genus " + std::to_string(genus));
		const SurfaceMesh mesh = bentSlab(genus, 6, {0, 200, 400});
		const FlatResult map = mapped(mesh, seamless(Finish::LeastDistortion, 6));
		ASSERT_EQ(map.report.boundaryLoops, 3);
		expectSeamless(mesh, map);
	}
	const SurfaceMesh mesh = bentSlab(1, 6, {0});
	Options options = seamless(Finish::LeastDistortion, 6);
	options.freeBoundary = false;
	const FlatResult map = mapped(mesh, options);
	EXPECT_NEAR(sum(map.targetCurvature), 2 * kPi * map.report.eulerCharacteristic, 1e-9);
}

TEST(MakeSeamless, AddsNoConesToANumberThatIsAskedFor)
{
	const SurfaceMesh mesh = bentSlab(2, 4);
	for (const int count : {4, 7}) {
		const FlatResult map = mapped(mesh, seamless(Finish::LeastDistortion, count));
		EXPECT_LE(map.report.cones, count);
		expectSeamless(mesh, map);
	}
}

} // namespace
} // namespace ricci::testing
