// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/front_door.h"
#include "support/random.h"

#include <array>
#include <map>

namespace ricci::testing {
namespace {

/// A bumpy square of n x n cells without the stars of some inner vertices.
SurfaceMesh perforated(int n, double height)
{
	const auto vertex = [&](int i, int j) { return i * (n + 1) + j; };
	return withoutStars(hill(n, height), {vertex(3, 3), vertex(n - 3, 4), vertex(n / 2, n - 3)});
}

Options capped()
{
	Options options;
	options.holes = Holes::Capped;
	return options;
}

/// Every vertex has one place in the plane.
void expectOnePlaceEach(const SurfaceMesh& mesh, const UV& uv)
{
	std::map<int, Point2> place;
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k)
			EXPECT_EQ(place.emplace(mesh.triangles[f][k], uv[f][k]).first->second, uv[f][k]);
}

TEST(HoleSeams, AreLeftOutWhereTheMetricCloses)
{
	// A plane is flat as it is, and goes round its holes in one piece; a bumpy surface does not.
	for (const Method method : {Method::IntrinsicFlips, Method::FixedTriangles})
		for (const double height : {0.0, 0.3}) {
			const SurfaceMesh mesh = perforated(16, height);
			Options options;
			options.method = method;
			options.holes = Holes::Boundaries;
			const FlatResult flat = run(mesh, options);
			EXPECT_EQ(flat.report.cappedHoles, 0);
			EXPECT_EQ(flat.report.seamEdges == 0, height == 0.0);
			EXPECT_EQ(flat.report.flippedFaces, 0);
			EXPECT_LT(MapCheck(mesh, flat).seamMismatch, 1e-10);
			if (height > 0.0)
				continue;
			EXPECT_NEAR(flat.report.qcMax, 1.0, 1e-9);
			expectOnePlaceEach(mesh, flat.uv);
		}
}

TEST(CappedHoles, OfAPlaneDoNotMoveIt)
{
	const SurfaceMesh mesh = perforated(16, 0.0);
	for (const OutputTriangulation output : kOutputs) {
		Options options = capped();
		options.output = output;
		const FlatResult flat = run(mesh, options);
		EXPECT_EQ(flat.report.cappedHoles, 3);
		EXPECT_EQ(flat.report.boundaryLoops, 4);
		EXPECT_EQ(flat.report.seamEdges, 0);
		EXPECT_EQ(flat.report.overlappingFaces, 0);
		EXPECT_NEAR(flat.report.qcMax, 1.0, 1e-10);
		EXPECT_NEAR(flat.report.areaDistortionSpread, 0.0, 1e-6);
		EXPECT_EQ(flat.uv.size(), mesh.triangles.size());
		for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
			for (std::size_t k = 0; k < 3; ++k)
				EXPECT_NEAR(sideLength(flat.uv[f], k), sideLength(mesh, f, k), 1e-11);
	}
}

TEST(CappedHoles, GiveOneChartWithoutSeamsForEveryTargetOfADisk)
{
	const SurfaceMesh mesh = perforated(16, 0.3);
	for (const TargetCurvature target :
		 {TargetCurvature::Automatic, TargetCurvature::Disk, TargetCurvature::Rectangle})
		for (const bool freeBoundary : {true, false}) {
			Options options = capped();
			options.target = target;
			options.freeBoundary = freeBoundary;
			options.cones.distortion = 1.0; // none are needed then
			options.charts = Charts::WithoutOverlap;
			const FlatResult flat = run(mesh, options);
			EXPECT_EQ(flat.report.seamEdges, 0);
			EXPECT_EQ(flat.report.flippedFaces, 0);
			EXPECT_EQ(flat.report.overlappingFaces, 0);
			ASSERT_EQ(flat.charts.size(), 1u);
			// Holes close by rotation and translation.
			expectOnePlaceEach(mesh, flat.uv);
			// The chart is flat inside, and its boundary keeps its lengths where it is free.
			EXPECT_LT(MapCheck(mesh, flat.mesh, {}).angleError, 1e-9);
		}
}

TEST(CappedHoles, TurnAnAnnulusIntoADisk)
{
	// Removing a disk from the middle of a disk and closing it again is not a change of the conformal
	// structure in the limit: the ring becomes the plane ring that it is.
	const SurfaceMesh mesh = ring(0.2, 1.0, 48, 12);
	Options options = capped();
	const FlatResult flat = run(mesh, options);
	EXPECT_EQ(flat.report.genus, 0);
	EXPECT_EQ(flat.report.boundaryLoops, 2);
	EXPECT_EQ(flat.report.seamEdges, 0);
	EXPECT_FALSE(flat.report.annulusModulus);
	EXPECT_NEAR(flat.report.qcMax, 1.0, 1e-9);
	options.target = TargetCurvature::Disk;
	const FlatResult disk = run(mesh, options);
	EXPECT_NEAR(disk.report.qcMax, 1.0, 1e-7);
}

TEST(CappedHoles, CarryConesOnTheirRim)
{
	const SurfaceMesh mesh = perforated(16, 0.2);
	const auto vertex = [](int i, int j) { return i * 17 + j; };
	const int rim = vertex(3, 3); // the number of the removed vertex's next one, on the rim
	ASSERT_TRUE(boundaryOf(mesh)[at(rim)]);
	VertexInput input = selecting(mesh, {rim});
	Options options = capped();
	options.target = TargetCurvature::SelectedCones;
	options.freeBoundary = false;
	// The whole curvature of the disk in one cone would be 2 pi: too much, and for an inner vertex,
	// which the rim becomes.
	const auto error = refusalOf<InadmissibleCurvature>([&] { run(mesh, options, input); });
	EXPECT_EQ(error.problem, InadmissibleCurvature::TooLargeInside);
	EXPECT_NEAR(error.value, 2 * kPi, 1e-12);
	EXPECT_EQ(error.bound, 2 * kPi);
	EXPECT_EQ(error.count, 1u);
	expectWords(error.what(), {"6.28318531", "at an interior vertex (1 "});
	input.selected[at(vertex(8, 8))] = 1;
	const FlatResult flat = run(mesh, options, input);
	// The seam goes from the cone on the rim to the other one, and to no other hole.
	EXPECT_GT(flat.report.seamEdges, 0);
	EXPECT_LE(
		flat.report.seamLength,
		1.1 * distance(mesh.positions[at(rim)], mesh.positions[at(vertex(8, 8))]));
	EXPECT_NEAR(flat.targetCurvature[at(rim)], kPi, 1e-12);
}

/// A bumpy square of 80 x 80 cells without single vertices.
SurfaceMesh withPinHoles()
{
	const auto vertex = [](int i, int j) { return i * 81 + j; };
	return withoutStars(
		hill(80, 0.15), {vertex(20, 20), vertex(40, 60), vertex(63, 17), vertex(9, 71)});
}

TEST(ShortHoles, AreCappedByDefault)
{
	const SurfaceMesh mesh = withPinHoles();
	const FlatResult flat = run(mesh, Options());
	EXPECT_EQ(flat.report.boundaryLoops, 5);
	EXPECT_EQ(flat.report.cappedHoles, 4);
	EXPECT_EQ(flat.report.seamEdges, 0);
	EXPECT_EQ(flat.charts.size(), 1u);
	EXPECT_EQ(flat.report.flippedFaces, 0);
	EXPECT_EQ(run(mesh, capped()).uv, flat.uv);
	Options open;
	open.holes = Holes::Boundaries;
	EXPECT_EQ(run(mesh, open).report.cappedHoles, 0);
}

/// A wall with windows, rough everywhere: what is enclosed by a window is nearly flat, so that seams to it save nothing.
TEST(CheaperHoles, AreCappedWhereSeamsToThemSaveNothing)
{
	Random random(60);
	const int nu = 40, nv = 30;
	const SurfaceMesh wall = grid(nu, nv, Ends::Open, Ends::Open, [&](int i, int j) {
		return Point3{0.5 * i, 0.5 * j, random.real(-0.05, 0.05)};
	});
	const SurfaceMesh mesh = partOf(wall, [&](std::size_t f) {
		const int cell = static_cast<int>(f / 2), i = cell / nv, j = cell % nv;
		return i % 10 < 4 || i % 10 > 6 || j % 10 < 3 || j % 10 > 6;
	});
	Options open;
	open.holes = Holes::Boundaries;
	const Report seams = run(mesh, open).report, report = run(mesh, Options()).report;
	EXPECT_EQ(report.boundaryLoops, 13);
	EXPECT_EQ(report.cappedHoles, 12);
	EXPECT_EQ(report.charts, 1);
	EXPECT_EQ(report.seamEdges, 0);
	EXPECT_LT(*report.objective, 4.02);
	EXPECT_LT(*report.objective, *seams.objective);
	// The ends of a tube enclose half a sphere each: a cap would have to hold its curvature.
	std::vector<std::array<double, 2>> tube;
	for (int i = 0; i <= 20; ++i)
		tube.push_back({1.0, 0.2 * i});
	EXPECT_EQ(run(revolved(tube, 24), Options()).report.cappedHoles, 0);
}

TEST(ShortHoles, AreBoundariesWhereTheyCannotBeCapped)
{
	// Without flips, and where the target is one for the surface's own boundary.
	SurfaceMesh mesh = withPinHoles();
	Options options;
	options.method = Method::FixedTriangles;
	EXPECT_EQ(run(mesh, options).report.cappedHoles, 0);
	options = Options();
	options.target = TargetCurvature::Prescribed;
	VertexInput input;
	input.targetCurvature.assign(mesh.positions.size(), 0.0);
	EXPECT_EQ(run(mesh, options, input).report.cappedHoles, 0);
	options.target = TargetCurvature::Flat;
	const FlatResult annulus =
		run(withoutStars(rectangle(80, 80, 1.0, 1.0), {40 * 81 + 40}), options);
	EXPECT_EQ(annulus.report.cappedHoles, 0);
	EXPECT_TRUE(annulus.report.annulusModulus);
}

TEST(ShortHoles, ThatAreAllThereIsLeaveAClosedSurface)
{
	// The cones add up to 4 pi, and none is lost in the hole: all vertices of the mesh have the curvature
	// that the sphere has there, those on the rim too.
	std::vector<std::array<double, 2>> profile;
	for (int i = 0; i <= 120; ++i)
		profile.push_back(
			{std::sin(kPi * i / 120) * (1 + 0.3 * std::sin(kPi * i / 40)),
			 -3 * std::cos(kPi * i / 120)});
	profile.front()[0] = profile.back()[0] = 0.0;
	const SurfaceMesh mesh = withoutStars(revolved(profile, 90), {1000, 3000});
	const FlatResult flat = run(mesh, Options());
	EXPECT_EQ(flat.report.boundaryLoops, 2);
	EXPECT_EQ(flat.report.cappedHoles, 2);
	EXPECT_NEAR(sum(flat.targetCurvature), 4 * kPi, 1e-9);
	EXPECT_EQ(flat.report.flippedFaces, 0);
	EXPECT_EQ(flat.report.overlappingFaces, 0);
	EXPECT_LT(MapCheck(mesh, flat).seamMismatch, 1e-6);
}

} // namespace
} // namespace ricci::testing
