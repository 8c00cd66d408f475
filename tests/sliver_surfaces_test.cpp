// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces of marching cubes: 6 % of their triangles have an angle below 5 degrees. On a fixed
// triangulation some have no solution; then the flow must say so, and the remedies must work.
#include "support/expect.h"
#include "support/flat_map.h"
#include "support/implicit_surface.h"
#include "support/random.h"

namespace ricci::testing {
namespace {

VertexInput randomCones(const SurfaceMesh& mesh, int count, Random& random)
{
	VertexInput input;
	input.selected.assign(mesh.positions.size(), 0);
	for (int i = 0; i < count; ++i)
		input.selected[at(random.index(static_cast<int>(mesh.positions.size())))] = 1;
	return input;
}

struct Case
{
	std::string name;
	SurfaceMesh mesh;
	Options options;
	VertexInput input;
	int genus, loops;
};

std::vector<Case> cases(std::uint64_t seed)
{
	Random random(seed);
	std::vector<Case> all;
	for (int genus : {0, 2, 3}) {
		const SurfaceMesh mesh = implicitClosed(genus, 9, seed);
		all.push_back(
			{"genus " + std::to_string(genus),
			 mesh,
			 fixedTriangulation(TargetCurvature::SelectedCones),
			 randomCones(mesh, 8, random),
			 genus,
			 0});
	}
	all.push_back({"torus", implicitClosed(1, 10, seed), fixedTriangulation(), {}, 1, 0});
	all.push_back({"annulus", implicitAnnulus(24, seed), fixedTriangulation(), {}, 0, 2});
	const SurfaceMesh disk = implicitDisk(24, seed);
	all.push_back({"free disk", disk, fixedTriangulation(), {}, 0, 1});
	all.push_back({"disk", disk, fixedTriangulation(TargetCurvature::Disk), {}, 0, 1});
	all.push_back({"rectangle", disk, fixedTriangulation(TargetCurvature::Rectangle), {}, 0, 1});
	return all;
}

/// The prescribed metric, seen in the plane.
void expectFlat(const Case& c, const FlatResult& flat)
{
	const Report& report = flat.report;
	EXPECT_TRUE(report.converged);
	EXPECT_EQ(report.genus, c.genus);
	EXPECT_EQ(report.boundaryLoops, c.loops);
	EXPECT_EQ(report.brokenTriangles, 0);
	EXPECT_LT(report.maxCurvatureError, 1e-8);
	EXPECT_EQ(report.flippedFaces, 0);
	const MapCheck map(c.mesh, flat);
	EXPECT_EQ(map.seamEdges, report.seamEdges + report.overlapCuts);
	EXPECT_LT(map.seamMismatch, 1e-9);
	EXPECT_LT(map.angleError, 1e-8);
}

TEST(SliverSurfaces, EndInAFlatMetricOrAReason)
{
	int solved = 0, refused = 0;
	for (std::uint64_t seed : {1u, 3u})
		for (const Case& c : cases(seed)) {
			SCOPED_TRACE(c.name + ", seed " + std::to_string(seed));
			try {
				expectFlat(c, run(c.mesh, c.options, c.input));
				++solved;
			}
			catch (const NotConverged& error) {
				EXPECT_EQ(error.problem, NotConverged::BrokenTriangles) << error.what();
				EXPECT_GT(error.count, 0u);
				EXPECT_EQ(error.method, Method::FixedTriangles);
				expectWords(error.what(), {"the triangle inequality at the end"});
				++refused;
			}
		}
	EXPECT_GT(solved, refused);
	EXPECT_GT(refused, 0); // or the next test says nothing
}

TEST(SliverSurfaces, EdgeSwapsMendWhatBreaks)
{
	int whole = 0, mended = 0, swapped = 0, refused = 0;
	for (std::uint64_t seed : {1u, 3u})
		for (Case& c : cases(seed)) {
			if (reason(c.mesh, c.options, c.input).empty()) {
				++whole;
				continue;
			}
			SCOPED_TRACE(c.name + ", seed " + std::to_string(seed));
			c.options.method = Method::EdgeSwaps;
			try {
				const FlatResult flat = run(c.mesh, c.options, c.input);
				++mended;
				swapped += flat.report.edgeSwaps > 0;
				EXPECT_GT(flat.report.edgeSwaps + flat.report.boundarySplits, 0);
				EXPECT_TRUE(flat.report.converged);
				EXPECT_EQ(flat.report.brokenTriangles, 0);
				EXPECT_LT(flat.report.maxCurvatureError, 1e-8);
				// The cut runs on edges that were not swapped: both its sides are still equal.
				EXPECT_LT(MapCheck(c.mesh, flat).seamMismatch, 1e-8);
			}
			catch (const NotConverged& error) {
				// All of them ask for a remesh (tests/bridge/error_sentences_test.cpp).
				EXPECT_TRUE(
					error.problem == NotConverged::BrokenTriangles ||
					error.problem == NotConverged::SplitsUsedUp)
					<< error.what();
				EXPECT_GT(error.count, 0u);
				++refused;
			}
		}
	EXPECT_GT(mended, 3);
	EXPECT_GT(swapped, 3);
	EXPECT_GT(mended, refused);
	EXPECT_EQ(whole + mended + refused, 2 * 8);
}

TEST(SliverSurfaces, IntrinsicFlipsSolveAll)
{
	for (std::uint64_t seed : {2u, 3u})
		for (Case& c : cases(seed)) {
			SCOPED_TRACE(c.name + ", seed " + std::to_string(seed));
			c.options.method = Method::IntrinsicFlips;
			c.options.output = OutputTriangulation::CommonRefinement;
			c.options.finish = Finish::None;
			c.options.charts = Charts::OfTheFlow;
			const FlatResult flat = run(c.mesh, c.options, c.input);
			EXPECT_TRUE(flat.report.converged);
			EXPECT_EQ(flat.report.brokenTriangles, 0);
			EXPECT_LT(flat.report.maxCurvatureError, 1e-8);
			EXPECT_EQ(flat.report.flippedFaces, 0);
			EXPECT_GT(flat.report.flips, 0);
			// The refinement is the same surface, whole and flat off the cones.
			const MapCheck check(c.mesh, flat);
			expectSurface(check, flat.report.eulerCharacteristic, c.loops);
			EXPECT_LT(check.angleError, 1e-6);
			EXPECT_LT(check.areaError, 1e-9);
		}
}

TEST(SliverSurfaces, EdgeSwapChangesNothingWhereNothingBreaks)
{
	int compared = 0;
	for (const Case& c : cases(2)) {
		if (c.name != "torus" && c.name != "annulus" && c.name != "free disk")
			continue;
		++compared;
		Options options = c.options;
		const FlatResult own = run(c.mesh, options, c.input);
		options.method = Method::EdgeSwaps;
		const FlatResult other = run(c.mesh, options, c.input);
		EXPECT_EQ(other.report.edgeSwaps, 0);
		EXPECT_EQ(other.u, own.u);
		EXPECT_EQ(other.uv, own.uv);
	}
	EXPECT_EQ(compared, 3);
}

/// Some faces are divided at a point of a side that the face across keeps whole: a face without area lies between.
/// Some are there twice.
SurfaceMesh withFlatAndDoubledFaces(const SurfaceMesh& mesh, Random& random)
{
	SurfaceMesh result{mesh.positions, {}};
	for (const Triangle& t : mesh.triangles) {
		if (random.real(0, 1) < 0.2) {
			const int p = static_cast<int>(result.positions.size());
			const double share = random.real(0, 1);
			const Point3 &a = mesh.positions[at(t[0])], &b = mesh.positions[at(t[1])];
			result.positions.push_back(a + share * (b - a));
			result.triangles.insert(
				result.triangles.end(), {{t[0], p, t[2]}, {p, t[1], t[2]}, {t[0], t[1], p}});
			continue;
		}
		result.triangles.push_back(t);
		if (random.real(0, 1) < 0.01)
			result.triangles.push_back(t);
	}
	return result;
}

/// Faces without area have pieces, too, which rounding may give some. They do not decide what the map is worth.
TEST(SliverSurfaces, TheRefinementOfFacesWithoutAreaIsAsGoodAsThatOfTheOthers)
{
	for (const std::uint64_t seed : {1, 2, 3}) {
		Random random(seed);
		const SurfaceMesh clean = perforatedSlab(2, 2);
		const SurfaceMesh mesh = withFlatAndDoubledFaces(clean, random);
		Options options;
		options.output = OutputTriangulation::CommonRefinement;
		const double expected = *parametrizeEuclidean(clean, {}, options).report.stretch;
		const Report report = parametrizeEuclidean(mesh, {}, options).report;
		EXPECT_EQ(report.flippedFaces + report.flippedByRounding + report.overlappingFaces, 0);
		EXPECT_NEAR(*report.stretch, expected, 0.05 * expected) << "seed " << seed;
	}
}

} // namespace
} // namespace ricci::testing
