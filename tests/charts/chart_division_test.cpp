// SPDX-License-Identifier: GPL-3.0-or-later
// Charts that cover a part of the plane more than once become several that do not.
#include "support/flat_map.h"
#include "support/shapes.h"

#include <ricci/parametrize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace ricci::testing {
namespace {

Parametrization
mapOf(const SurfaceMesh& mesh, Charts charts, Finish finish = Finish::LeastDistortion)
{
	Options options;
	options.charts = charts;
	options.finish = finish;
	options.cones.distortion = 100.0; // none
	return parametrizeEuclidean(mesh, {}, options);
}

/// The report says nothing overlaps, and nothing does.
void expectNothingTwice(const SurfaceMesh& mesh, const Parametrization& map)
{
	EXPECT_EQ(map.report.overlappingFaces, 0);
	EXPECT_EQ(map.report.overlappingCharts, 0);
	EXPECT_EQ(map.report.flippedFaces + map.report.flippedByRounding, 0);
	const CoveredTwice covered(mesh, map.mesh.corners().values());
	EXPECT_EQ(covered.charts, map.report.charts);
	EXPECT_EQ(covered.betweenCharts + covered.withinCharts, 0);
}

/// Rings in the plane are their own maps. They overlap past a full turn, and are divided straight across, by as many
/// cuts as it takes.
TEST(ChartDivision, OfARingTakesAsManyPartsAsTurns)
{
	for (const double turns : {0.3, 0.999, 1.001, 1.2, 1.7, 2.5, 3.3, 20.0}) {
		SCOPED_TRACE(turns);
		const int across = 3, least = static_cast<int>(std::ceil(turns));
		const SurfaceMesh mesh = screw(turns, static_cast<int>(40 * turns) + 8, across);
		const Parametrization whole = mapOf(mesh, Charts::OfTheFlow);
		EXPECT_EQ(whole.report.charts, 1);
		EXPECT_EQ(whole.report.overlappingCharts, turns > 1.0 ? 1 : 0);
		EXPECT_EQ(whole.report.overlappingFaces > 0, turns > 1.0);
		const Parametrization map = mapOf(mesh, Charts::WithoutOverlap);
		expectNothingTwice(mesh, map);
		EXPECT_GE(map.report.charts, least);
		EXPECT_LE(map.report.charts, turns > 1.0 ? least + 1 + least / 4 : 1);
		const int cuts = map.report.charts - 1;
		EXPECT_EQ(map.report.overlapCuts, across * cuts);
		EXPECT_GE(map.report.seamLength, cuts - 1e-9); // the ring is 1 wide
		EXPECT_LE(map.report.seamLength, 1.05 * cuts);
		EXPECT_NEAR(map.report.qcMax, 1.0, 1e-6);
		EXPECT_NEAR(map.report.areaDistortionSpread, 0.0, 1e-6); // one scale for all parts
	}
}

/// Two turns that are joined by a narrow neck opposite to the place where they meet.
TEST(ChartDivision, CutsWhereItIsShortest)
{
	const int around = 80, across = 6;
	const SurfaceMesh neck = partOf(screw(1.25, around, across), [](std::size_t f) {
		const int cell = static_cast<int>(f / 2);
		return cell % around != around / 2 || cell / around == 0;
	});
	const Parametrization map = mapOf(neck, Charts::WithoutOverlap);
	expectNothingTwice(neck, map);
	ASSERT_EQ(map.report.charts, 2);
	EXPECT_EQ(map.report.overlapCuts, 1);
	EXPECT_NEAR(map.report.seamLength, 1.0 / across, 1e-9);
	const auto triangles = map.mesh.trianglesByChart(2);
	EXPECT_NEAR(
		static_cast<double>(triangles[0].size()) / static_cast<double>(triangles[1].size()),
		1.0,
		0.05);
}

/// Pairs of triangles, each a quadrilateral, that are not side by side in the map.
int dividedCells(const Parametrization& map)
{
	int count = 0;
	for (int f = 0; f < map.mesh.size(); f += 2) {
		bool isWhole = true;
		for (std::size_t k = 0; k < 3; ++k)
			for (std::size_t l = 0; l < 3; ++l)
				isWhole = isWhole && (map.mesh.vertices[f][k] != map.mesh.vertices[f + 1][l] ||
									  map.mesh.points[f][k] == map.mesh.points[f + 1][l]);
		count += isWhole ? 0 : 1;
	}
	return count;
}

/// A ring of sheared quadrilaterals, whose diagonals of one direction are the shortest way across.
TEST(ChartDivision, KeepsPolygonsWhole)
{
	const int around = 60, across = 4;
	int divided = 0;
	for (const double shear : {-1.0, 1.0}) {
		SurfaceMesh mesh = grid(across, around, Ends::Open, Ends::Open, [=](int i, int j) {
			const double r = 1.0 + static_cast<double>(i) / across;
			const double a = 2.5 * kPi * (j + shear * i) / around;
			return Point3{r * std::cos(a), r * std::sin(a), 0.0};
		});
		divided += dividedCells(mapOf(mesh, Charts::WithoutOverlap));
		for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
			const Triangle &own = mesh.triangles[f], &other = mesh.triangles[f ^ 1u];
			const auto isShared = [&](int v) {
				return std::find(other.begin(), other.end(), v) != other.end();
			};
			mesh.diagonal.emplace_back();
			for (std::size_t k = 0; k < 3; ++k)
				mesh.diagonal.back()[k] = isShared(own[k]) && isShared(own[(k + 1) % 3]);
		}
		const Parametrization map = mapOf(mesh, Charts::WithoutOverlap);
		expectNothingTwice(mesh, map);
		EXPECT_GE(map.report.charts, 2);
		EXPECT_EQ(dividedCells(map), 0);
	}
	EXPECT_GT(divided, 0);
}

/// On a screw the flow has something to do. Parts move, but nothing else changes, on the mesh or on its refinement.
TEST(ChartDivision, OfAScrewSurfaceOnlyMovesItsParts)
{
	const SurfaceMesh mesh = screw(1.6, 70, 5, 0.3);
	for (const OutputTriangulation output : kOutputs) {
		Options options;
		options.output = output;
		options.charts = Charts::OfTheFlow;
		const Parametrization whole = parametrizeEuclidean(mesh, {}, options);
		options.charts = Charts::WithoutOverlap;
		const Parametrization map = parametrizeEuclidean(mesh, {}, options);
		EXPECT_EQ(whole.report.charts, 1);
		EXPECT_EQ(whole.report.overlappingCharts, 1);
		EXPECT_GT(whole.report.overlappingFaces, 0);
		EXPECT_GT(overlapsIn(whole.mesh), 0u);
		EXPECT_EQ(map.report.charts, 2);
		EXPECT_EQ(map.report.overlappingFaces, 0);
		EXPECT_EQ(overlapsIn(map.mesh), 0u);
		EXPECT_GT(map.report.overlapCuts, 0);
		EXPECT_NEAR(map.report.qcAreaMean, whole.report.qcAreaMean, 1e-9);
		EXPECT_NEAR(map.report.stretch.value_or(0.0), whole.report.stretch.value_or(1.0), 1e-9);
		ASSERT_EQ(map.mesh.size(), whole.mesh.size());
		EXPECT_EQ(map.mesh.face, whole.mesh.face);
		EXPECT_EQ(
			std::set<int>(map.mesh.chart.begin(), map.mesh.chart.end()), (std::set<int>{0, 1}));
	}
}

/// A plane is its own map. Rounding is not an overlap, a thousandth of its size is one.
TEST(ChartDivision, TouchingIsNoOverlap)
{
	const auto overlaps = [](const SurfaceMesh& mesh) {
		return mapOf(mesh, Charts::OfTheFlow).report.overlappingCharts > 0;
	};
	// Two sides of a slit from the centre of a square, which are different vertices at one place.
	SurfaceMesh slit = rectangle(4, 4, 1.0, 1.0);
	for (Triangle& t : slit.triangles)
		for (int& v : t) {
			const Point3 p = slit.positions[at(v)];
			double low = 1.0;
			for (int w : t)
				low = std::min(low, slit.positions[at(w)][1]);
			if (p[1] == 0.5 && p[0] > 0.6 && low < 0.5) {
				slit.positions.push_back(p);
				v = static_cast<int>(slit.positions.size()) - 1;
			}
		}
	ASSERT_GT(slit.positions.size(), 25u);
	for (const double gap : {0.0, 1e-12, 1e-3}) {
		SurfaceMesh closed = slit;
		for (std::size_t v = 25; v < closed.positions.size(); ++v)
			closed.positions[v][1] += gap;
		EXPECT_EQ(overlaps(closed), gap > 1e-9) << gap;
	}
}

} // namespace
} // namespace ricci::testing
