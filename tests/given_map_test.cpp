// SPDX-License-Identifier: GPL-3.0-or-later
// Maps that meshes have: Automatic keeps one that is right unless it finds a better one without further seams, and
// Charts::AsGiven only packs.
#include "support/expect.h"
#include "support/shapes.h"

#include <ricci/error.h>
#include <ricci/parametrize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>

namespace ricci::testing {
namespace {

/// The map of a result, whose triangles are the mesh's faces.
std::vector<MappedFace> mapIn(const Parametrization& map)
{
	std::vector<MappedFace> faces;
	for (const int f : map.mesh.face.indices()) {
		EXPECT_EQ(map.mesh.face[f], f);
		faces.push_back({map.mesh.at(f), 0});
	}
	return faces;
}

using Placing = std::function<Point2(const Point3&)>;

SurfaceMesh withMap(SurfaceMesh mesh, const Placing& placing)
{
	mesh.map.clear();
	for (const Triangle& t : mesh.triangles) {
		MappedFace face;
		for (std::size_t k = 0; k < 3; ++k)
			face.uv[k] = placing(mesh.positions[at(t[k])]);
		mesh.map.push_back(face);
	}
	return mesh;
}

/// A closed surface with bumps, whose map needs cones.
SurfaceMesh bumpySphere()
{
	SurfaceMesh mesh = sphere(24, 36);
	for (Point3& p : mesh.positions)
		p = (1.0 + 0.35 * std::sin(4.0 * p[0]) * std::cos(3.0 * p[1] + p[2])) * p;
	return mesh;
}

/// How much longer the sides of a triangle are in one map than in another one: the least and the most.
std::array<double, 2> scales(const Triangle2& before, const Triangle2& after)
{
	std::array<double, 2> range{std::numeric_limits<double>::infinity(), 0.0};
	for (std::size_t k = 0; k < 3; ++k) {
		const double scale =
			distance(after[k], after[(k + 1) % 3]) / distance(before[k], before[(k + 1) % 3]);
		range = {std::min(range[0], scale), std::max(range[1], scale)};
	}
	return range;
}

std::array<double, 2>
scales(const std::vector<MappedFace>& before, const Parametrization& after, int chart = -1)
{
	std::array<double, 2> all{std::numeric_limits<double>::infinity(), 0.0};
	for (const int f : after.mesh.face.indices())
		if (chart < 0 || after.mesh.chart[f] == chart) {
			const auto [least, most] = scales(before[at(after.mesh.face[f])].uv, after.mesh.at(f));
			all = {std::min(all[0], least), std::max(all[1], most)};
		}
	return all;
}

void expectNoFault(const Report& report)
{
	EXPECT_EQ(report.flippedFaces + report.flippedByRounding, 0);
	EXPECT_EQ(report.overlappingFaces, 0);
}

Options packedOnly()
{
	Options options;
	options.charts = Charts::AsGiven;
	return options;
}

/// What has been mapped is mapped as well again, with the same charts and no other seam.
TEST(GivenMap, IsNotCutFurther)
{
	SurfaceMesh tube = sphereWithTube(0.15, 3.0, 0.5, 24, 24);
	for (SurfaceMesh mesh : {bumpySphere(), torus(3, 1, 30, 14), perforatedSlab(1, 3), tube}) {
		const Parametrization first = parametrizeEuclidean(mesh, {}, {});
		mesh.map = mapIn(first);
		const Parametrization second = parametrizeEuclidean(mesh, {}, {});
		const Report &a = first.report, &b = second.report;
		EXPECT_EQ(b.charts, a.charts);
		EXPECT_EQ(b.chosenSeamEdges, a.seamEdges + a.overlapCuts);
		EXPECT_EQ(b.seamEdges + b.overlapCuts, 0);
		EXPECT_NEAR(b.chosenSeamLength, a.seamLength, 1e-9 * a.seamLength);
		EXPECT_LE(*b.objective, *a.objective + 1e-6);
		expectNoFault(b);
	}
}

/// Of a sheet whose given map is sheared the flow finds the isometry.
TEST(GivenMap, IsLeftForABetterOne)
{
	SurfaceMesh mesh = withMap(rectangle(8, 6, 4, 3), [](const Point3& p) {
		return Point2{p[0] + p[1], p[1]};
	});
	const Parametrization map = parametrizeEuclidean(mesh, {}, {});
	EXPECT_EQ(map.report.targetUsed, TargetUsed::FreeBoundary);
	EXPECT_NEAR(*map.report.objective, 4.0, 1e-9);
	EXPECT_EQ(map.report.seamEdges, 0);
}

/// A cylinder open along a line costs nothing as given.
TEST(GivenMap, IsKeptWhereItIsBest)
{
	SurfaceMesh mesh = grid(24, 6, Ends::Joined, Ends::Open, [](int i, int j) {
		return Point3{std::cos(2 * kPi * i / 24), std::sin(2 * kPi * i / 24), 0.25 * j};
	});
	const double side = 2.0 * std::sin(kPi / 24);
	for (const Triangle& t : mesh.triangles) {
		std::array<double, 3> turn; // of a corner, in cells
		for (std::size_t k = 0; k < 3; ++k) {
			const Point3& p = mesh.positions[at(t[k])];
			turn[k] = std::round(std::atan2(p[1], p[0]) / (2 * kPi) * 24);
		}
		const double most = *std::max_element(turn.begin(), turn.end());
		MappedFace face;
		for (std::size_t k = 0; k < 3; ++k)
			face.uv[k] = {
				side * (most - turn[k] > 12 ? turn[k] + 24 : turn[k]), mesh.positions[at(t[k])][2]};
		mesh.map.push_back(face);
	}
	const Parametrization map = parametrizeEuclidean(mesh, {}, {});
	EXPECT_NEAR(*map.report.stretch, 4.0, 1e-9);
	EXPECT_EQ(map.report.chosenSeamEdges, 6);
	EXPECT_EQ(map.report.seamEdges, 0);
	EXPECT_EQ(map.report.charts, 1);
	expectNoFault(map.report);
}

/// Flipped or overlapping charts are mapped again, mirrored ones are turned over.
TEST(GivenMap, IsMappedAnewWhereItIsWrong)
{
	const SurfaceMesh sheet = rectangle(8, 6, 4, 3);
	const auto mapOf = [&](const Placing& placing) {
		return parametrizeEuclidean(withMap(sheet, placing), {}, {});
	};
	const Parametrization mirrored = mapOf([](const Point3& p) { return Point2{-p[0], p[1]}; });
	EXPECT_EQ(mirrored.report.targetUsed, TargetUsed::GivenMap);
	const Parametrization folded = mapOf([](const Point3& p) {
		return Point2{std::abs(p[0] - 2.0), p[1]};
	});
	EXPECT_NE(folded.report.targetUsed, TargetUsed::GivenMap);
	const Parametrization wound = mapOf([](const Point3& p) { // twice round, at nearly one radius
		return asPoint(std::polar(1.0 + 0.3 * p[1], kPi * p[0]));
	});
	EXPECT_NE(wound.report.targetUsed, TargetUsed::GivenMap);
	const Parametrization unknown = mapOf([](const Point3& p) {
		return Point2{p[0] > 3.9 ? std::numeric_limits<double>::quiet_NaN() : p[0], p[1]};
	});
	EXPECT_NE(unknown.report.targetUsed, TargetUsed::GivenMap);
	for (const Parametrization* map : {&mirrored, &folded, &wound, &unknown}) {
		EXPECT_NEAR(*map->report.stretch, 4.0, 1e-9);
		expectNoFault(map->report);
	}
}

/// The edges at which the map jumps are seams like those that are marked.
TEST(GivenMap, HasSeamsWhereItJumps)
{
	const SurfaceMesh sheet = rectangle(8, 6, 4, 3);
	SurfaceMesh torn = withMap(
					sheet,
					[](const Point3&p) {
						return Point2{p[0], p[1]};
					}),
				pictures = torn, marked = sheet;
	marked.seam.assign(sheet.triangles.size(), {0, 0, 0});
	for (std::size_t f = 0; f < sheet.triangles.size(); ++f) {
		const Triangle& t = sheet.triangles[f];
		double middle = 0.0;
		for (const int v : t)
			middle += sheet.positions[at(v)][0] / 3.0;
		pictures.map[f].picture = middle > 2.0;
		for (Point2& p : torn.map[f].uv)
			p[0] += middle > 2.0 ? 1.0 : 0.0;
		for (std::size_t k = 0; k < 3; ++k)
			marked.seam[f][k] = std::abs(sheet.positions[at(t[k])][0] - 2.0) < 1e-9 &&
								std::abs(sheet.positions[at(t[(k + 1) % 3])][0] - 2.0) < 1e-9;
	}
	for (const SurfaceMesh* mesh : {&torn, &pictures, &marked}) {
		const Report report = parametrizeEuclidean(*mesh, {}, {}).report;
		EXPECT_EQ(report.chosenSeamEdges, 6);
		EXPECT_NEAR(report.chosenSeamLength, 3.0, 1e-12);
		EXPECT_EQ(report.charts, 2);
	}
}

/// Islands of another shape than the flow would give them, two of them on top of each other.
TEST(GivenMap, IsOnlyPackedWhereThatIsAskedFor)
{
	const auto sheared = [](const Point3& p) { return Point2{p[0] + 0.5 * p[1], 2.0 * p[1]}; };
	const auto mirrored = [](const Point3& p) { return Point2{-0.5 * p[0], p[1]}; };
	const SurfaceMesh a = withMap(rectangle(8, 6, 4, 3), sheared),
					  b = withMap(rectangle(5, 5, 1, 2), mirrored),
					  c = withMap(rectangle(5, 5, 1, 2), sheared);
	SurfaceMesh mesh = sideBySide(sideBySide(a, b, 5.0), c, 8.0);
	mesh.map.clear();
	for (const SurfaceMesh* part : {&a, &b, &c})
		mesh.map.insert(mesh.map.end(), part->map.begin(), part->map.end());
	Options options = packedOnly();
	options.chartMargin = 0.02;
	const Parametrization map = parametrizeEuclidean(mesh, {}, options);
	EXPECT_EQ(map.report.charts, 3);
	EXPECT_EQ(map.report.seamEdges + map.report.overlapCuts, 0);
	EXPECT_EQ(map.report.overlappingFaces, 0);
	EXPECT_EQ(map.report.flippedFaces, static_cast<int>(b.triangles.size()));
	const auto [least, most] = scales(mesh.map, map);
	EXPECT_NEAR(most / least, 1.0, 1e-9);
	for (int chart = 0; chart < 3; ++chart) {
		const Box2& own = map.charts[at(chart)].box;
		for (std::size_t k = 0; k < 2; ++k) {
			EXPECT_GE(own.min[k], 0.02 - 1e-9);
			EXPECT_LE(own.max[k], 0.98 + 1e-9);
		}
	}
	for (const int f : map.mesh.face.indices()) // nothing is turned over
		EXPECT_EQ(
			doubledArea(map.mesh.at(f)) > 0.0,
			doubledArea(mesh.map[at(map.mesh.face[f])].uv) > 0.0);

	options.turns = ChartTurns::None; // then it is the same picture except for its place and scale
	const Parametrization upright = parametrizeEuclidean(mesh, {}, options);
	const Point2 side = mesh.map[0].uv[1] - mesh.map[0].uv[0];
	const double scale = distance(upright.mesh.at(0)[0], upright.mesh.at(0)[1]) / length(side);
	for (const int f : upright.mesh.face.indices())
		for (std::size_t k = 1; k < 3; ++k) {
			const Triangle2 &before = mesh.map[at(f)].uv, after = upright.mesh.at(f);
			EXPECT_LT(distance(after[k] - after[0], scale * (before[k] - before[0])), 1e-9);
		}

	options.normalizeUV = false; // then areas are those of the surface, all together
	const Parametrization large = parametrizeEuclidean(mesh, {}, options);
	double doubled = 0.0;
	for (const Triangle2& t : large.mesh.corners())
		doubled += std::abs(doubledArea(t));
	EXPECT_NEAR(0.5 * doubled, areaOf(mesh), 1e-9 * areaOf(mesh));
}

/// Vertices that are split inside an island do not tear it.
TEST(GivenMap, KeepsIslandsWhoseVerticesAreSplit)
{
	SurfaceMesh mesh = withMap(rectangle(6, 5, 3, 2), [](const Point3& p) {
		return Point2{p[0] + 0.3 * p[1] * p[1], p[1]};
	});
	const std::size_t count = mesh.positions.size();
	for (std::size_t v = 0; v < count; ++v)
		mesh.positions.push_back(Point3(mesh.positions[v]));
	for (std::size_t f = 0; f < mesh.triangles.size(); f += 3)
		for (int& v : mesh.triangles[f])
			v += static_cast<int>(count);
	const Parametrization map = parametrizeEuclidean(mesh, {}, packedOnly());
	EXPECT_EQ(map.report.charts, 1);
	EXPECT_GT(map.report.joinedEdges, 0);
	const auto [least, most] = scales(mesh.map, map);
	EXPECT_NEAR(most / least, 1.0, 1e-9);
}

/// Two turns of a spiral, drawn as they are seen from above and from below.
TEST(GivenMap, CoversItselfAsOftenAsItsMirrorImage)
{
	SurfaceMesh spiral = rectangle(100, 3, 1, 1);
	for (Point3& p : spiral.positions) {
		const double turn = 4 * kPi * p[0], radius = 1.0 + p[1];
		p = {radius * std::cos(turn), radius * std::sin(turn), 3.0 * p[0]};
	}
	const int faces = static_cast<int>(spiral.triangles.size());
	for (const double side : {1.0, -1.0}) {
		const auto draw = [&](const Point3& p) { return Point2{side * p[0], p[1]}; };
		const Report report = parametrizeEuclidean(withMap(spiral, draw), {}, packedOnly()).report;
		EXPECT_EQ(report.overlappingFaces, faces);
		EXPECT_EQ(report.overlappingCharts, 1);
		EXPECT_EQ(report.flippedFaces % faces, 0);
	}
}

TEST(GivenMap, HasToBeThereToBePacked)
{
	const auto missing = [](const SurfaceMesh& mesh) -> std::size_t {
		try {
			parametrizeEuclidean(mesh, {}, packedOnly());
		}
		catch (const InvalidOption& error) {
			EXPECT_EQ(error.problem, InvalidOption::NoMap);
			return error.count;
		}
		return 0;
	};
	SurfaceMesh mesh = rectangle(2, 2, 1, 1);
	EXPECT_EQ(missing(mesh), 8u);
	mesh = withMap(mesh, [](const Point3& p) { return Point2{p[0], p[1]}; });
	EXPECT_EQ(missing(mesh), 0u);
	mesh.map[3].uv[1][0] = std::numeric_limits<double>::quiet_NaN();
	EXPECT_EQ(missing(mesh), 1u);
	for (const bool isLine : {false, true}) {
		mesh = withMap(mesh, [&](const Point3& p) { return Point2{isLine ? p[0] : 0.0, 0.0}; });
		EXPECT_EQ(
			refusalOf<InvalidOption>([&] { parametrizeEuclidean(mesh, {}, packedOnly()); }).problem,
			InvalidOption::MapWithoutArea);
	}
	mesh.map.pop_back();
	EXPECT_THROW(parametrizeEuclidean(mesh, {}, {}), InvalidMesh);
}

} // namespace
} // namespace ricci::testing
