// SPDX-License-Identifier: GPL-3.0-or-later
// The remedy of paper 5.4 where the flow breaks the triangle inequality, seen in the map.
#include "support/expect.h"
#include "support/front_door.h"
#include "support/random_surface.h"

#include <ricci/error.h>

#include <gtest/gtest.h>

#include <optional>
#include <set>
#include <string>

namespace ricci::testing {
namespace {

/// The boundary keeps its metric; curvature is wanted inside.
FlatResult swapped(const SurfaceMesh& mesh, const std::vector<double>& curvature)
{
	const Options options = towards(TargetCurvature::Prescribed, Method::EdgeSwaps);
	return flattened(mesh, options, prescribing(curvature));
}

/// Every edge of the mesh by its ends, with the apexes of its faces.
std::map<std::pair<int, int>, std::vector<int>> edgesOf(const SurfaceMesh& mesh)
{
	std::map<std::pair<int, int>, std::vector<int>> edges;
	for (const Triangle& t : mesh.triangles)
		for (std::size_t k = 0; k < 3; ++k)
			edges[std::minmax(t[k], t[(k + 1) % 3])].push_back(t[(k + 2) % 3]);
	return edges;
}

/// Distance of two corners in the map, in the faces at the edge \p i \p j; none if a seam is between them.
std::optional<double>
distanceDrawn(const SurfaceMesh& mesh, const FlatResult& map, int i, int j, int from, int to)
{
	std::map<int, std::set<Point2>> places;
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
		const Triangle& t = mesh.triangles[f];
		if (std::count(t.begin(), t.end(), i) + std::count(t.begin(), t.end(), j) == 2)
			for (std::size_t k = 0; k < 3; ++k)
				places[t[k]].insert(map.uv[f][k]);
	}
	for (const auto& [vertex, where] : places)
		if (where.size() != 1)
			return std::nullopt;
	return length(*places[from].begin() - *places[to].begin());
}

/// The curvature that was wanted, by the angles that are drawn; the boundary's edges as long as before.
void expectCurvature(
	const SurfaceMesh& mesh, const FlatResult& map, const std::vector<double>& wanted)
{
	EXPECT_TRUE(map.report.converged);
	EXPECT_EQ(map.report.brokenTriangles, 0);
	EXPECT_LT(map.report.maxCurvatureError, 1e-8);
	EXPECT_EQ(map.u.size(), mesh.positions.size()); // new vertices stay inside
	const std::vector<FlowState>& states =
		map.report.flowStates; // the steps of all starts in one row
	EXPECT_TRUE(std::is_sorted(states.begin(), states.end(), [](const auto& a, const auto& b) {
		return a.step < b.step;
	}));
	EXPECT_EQ(states.back().step, map.report.iterations);
	EXPECT_LT(MapCheck(mesh, map).seamMismatch, 1e-7);
	expectDrawn(mesh, map, wanted, true);
	for (const auto& [ends, apexes] : edgesOf(mesh)) {
		const auto [i, j] = ends;
		const double inSpace = distance(mesh.positions[at(i)], mesh.positions[at(j)]);
		if (apexes.size() == 1 && map.report.boundarySplits == 0) {
			EXPECT_NEAR(distanceDrawn(mesh, map, i, j, i, j).value_or(0), inSpace, 1e-9);
		}
	}
}

/// The more negative the curvature asked of the middle, the nearer its vertex comes to the long side, whose
/// triangle breaks. A boundary edge cannot be swapped: it is split in its middle, and the flow starts again.
TEST(EdgeSwap, SplitsABoundaryEdgeThatWouldBreakItsTriangle)
{
	const SurfaceMesh fan = fanWithGap(100);
	std::vector<double> curvature(8, 0.0);
	for (const double K : {-1.0, -2.0, -3.0, -14.0}) {
		curvature[0] = K;
		const FlatResult map = swapped(fan, curvature);
		const int splits = map.report.boundarySplits;
		EXPECT_TRUE(K == -3.0 ? splits == 1 : K < -3.0 ? splits > 1 : splits == 0) << splits;
		EXPECT_EQ(map.report.edgeSwaps, 0);
		EXPECT_EQ(map.report.flippedFaces, 0);
		expectCurvature(fan, map, curvature);
		int starts = 0;
		for (const FlowState& state : map.report.flowStates)
			starts += state.residual > 0.9 * -K;
		EXPECT_GE(starts, K < -2.5 ? 2 : 1);
	}
}

/// On the edges that are there at the end Eqs 3 and 4 hold. A new one, between the apexes of the old one, has
/// the inversive distance of its distance in space and the initial radii (paper 5.4).
void expectPacking(const SurfaceMesh& mesh, const FlatResult& map, int& checked)
{
	const Circles circles(mesh);
	int changed = 0;
	for (const auto& [ends, apexes] : edgesOf(mesh)) {
		const auto [i, j] = ends;
		const double l = static_cast<double>(circles.lengthWith(map.u, i, j));
		const double drawn = distanceDrawn(mesh, map, i, j, i, j).value_or(l);
		if (std::abs(drawn / l - 1.0) < 1e-7)
			continue;
		++changed;
		ASSERT_EQ(apexes.size(), 2u);
		const auto across = distanceDrawn(mesh, map, i, j, apexes[0], apexes[1]);
		if (!across || map.report.edgeSwaps > 1)
			continue;
		const auto wanted = static_cast<double>(circles.lengthWith(map.u, apexes[0], apexes[1]));
		EXPECT_NEAR(*across / wanted, 1.0, 1e-7);
		++checked;
	}
	EXPECT_LE(changed, map.report.edgeSwaps);
}

TEST(EdgeSwap, EndsInAMetricOrWithAReason)
{
	int swappedOnly = 0, both = 0, broken = 0, checked = 0;
	for (std::uint64_t seed = 1; seed <= 600; ++seed) {
		SCOPED_TRACE("seed " + std::to_string(seed));
		Random random(seed);
		const SurfaceMesh mesh = randomPlanarDisk(3 + random.index(3), random);
		std::vector<double> curvature;
		for (const char isBoundary : boundaryOf(mesh)) {
			const double K = random.real(-7.0, 5.0);
			curvature.push_back(isBoundary ? 0.0 : K);
		}
		std::optional<FlatResult> map;
		const auto error = errorOf<NotConverged>([&] { map = swapped(mesh, curvature); });
		if (error) {
			++broken;
			if (error->problem != NotConverged::NoCut) {
				EXPECT_EQ(error->problem, NotConverged::BrokenTriangles) << error->what();
				EXPECT_GT(error->count, 0u);
				EXPECT_EQ(error->method, Method::EdgeSwaps);
				EXPECT_GE(error->swaps, 0);
			}
			continue;
		}
		expectCurvature(mesh, *map, curvature);
		if (map->report.edgeSwaps > 0)
			++(map->report.boundarySplits == 0 ? swappedOnly : both);
		if (map->report.boundarySplits == 0)
			expectPacking(mesh, *map, checked);
	}
	EXPECT_GT(swappedOnly, 20);
	EXPECT_GT(both, 20);
	EXPECT_GT(broken, 5);
	EXPECT_GT(checked, 5);
}

} // namespace
} // namespace ricci::testing
