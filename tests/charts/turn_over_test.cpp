// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/shapes.h"

#include <ricci/charts/turn_over.h>
#include <ricci/math/orientation.h>

#include <gtest/gtest.h>

#include <cmath>

namespace ricci::testing {
namespace {

/// A mesh over the plane as its own map, with one vertex elsewhere.
Parametrization mapWith(const SurfaceMesh& mesh, int vertex, const Point2& place)
{
	Parametrization map;
	for (const Triangle& t : mesh.triangles) {
		Triangle2 p;
		for (std::size_t k = 0; k < 3; ++k)
			p[k] = t[k] == vertex
					   ? place
					   : Point2{mesh.positions[at(t[k])][0], mesh.positions[at(t[k])][1]};
		map.uv.push_back(p);
	}
	map.reversed.assign(map.uv.size(), 0);
	map.charts.resize(1);
	for (std::size_t f = 0; f < map.uv.size(); ++f)
		map.charts[0].faces.push_back(static_cast<int>(f));
	return map;
}

int turnedIn(const Parametrization& map)
{
	int count = 0;
	for (std::size_t f = 0; f < map.uv.size(); ++f)
		count +=
			orientation(map.uv[f][0], map.uv[f][1], map.uv[f][2]) * (map.reversed[f] ? -1 : 1) <= 0;
	return count;
}

TEST(TurnOver, SidesKeepTheirLengthsAndSeamsAreCounted)
{
	// The vertex in the middle of 4 by 4 squares leaves the ring of its neighbours.
	const SurfaceMesh mesh = rectangle(4, 4, 4.0, 4.0);
	const Parametrization before = mapWith(mesh, 12, {3.3, 2.2});
	ASSERT_GT(turnedIn(before), 0);
	Parametrization map = before;
	turnOver(mesh, map);
	EXPECT_EQ(turnedIn(map), 0);
	int seams = 0;
	double length = 0.0;
	for (std::size_t f = 0; f < map.uv.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k) {
			const std::size_t next = (k + 1) % 3;
			EXPECT_NEAR(
				distance(map.uv[f][k], map.uv[f][next]),
				distance(before.uv[f][k], before.uv[f][next]),
				1e-14);
			for (std::size_t g = 0; g < f; ++g)
				for (std::size_t j = 0; j < 3; ++j) {
					const std::size_t after = (j + 1) % 3;
					if (mesh.triangles[f][k] != mesh.triangles[g][after] ||
						mesh.triangles[f][next] != mesh.triangles[g][j] ||
						(map.uv[f][k] == map.uv[g][after] && map.uv[f][next] == map.uv[g][j]))
						continue;
					++seams;
					length += distance(
						mesh.positions[at(mesh.triangles[f][k])],
						mesh.positions[at(mesh.triangles[f][next])]);
				}
		}
	EXPECT_GT(seams, 0);
	EXPECT_EQ(map.report.overlapCuts, seams);
	EXPECT_NEAR(map.report.seamLength, length, 1e-12);
}

TEST(TurnOver, ReversedFacesAreProperlyClockwise)
{
	const SurfaceMesh mesh = rectangle(4, 4, 4.0, 4.0);
	Parametrization map = mapWith(mesh, 12, {3.3, 2.2});
	for (std::size_t f = 0; f < map.uv.size(); ++f) {
		std::swap(map.uv[f][1], map.uv[f][2]);
		map.reversed[f] = 1;
	}
	SurfaceMesh reversed = mesh;
	for (Triangle& t : reversed.triangles)
		std::swap(t[1], t[2]);
	ASSERT_GT(turnedIn(map), 0);
	turnOver(reversed, map);
	EXPECT_EQ(turnedIn(map), 0);
}

TEST(TurnOver, LeavesWhatIsTurnedByNoMoreThanOnePlace)
{
	// The vertex at 0 is in front of the diagonal of a square from (1, 0) to (0, 1), or behind it.
	SurfaceMesh mesh;
	mesh.positions = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}};
	mesh.triangles = {{0, 1, 3}, {1, 2, 3}};
	for (const double scale : {1e-6, 1.0, 1e6})
		for (const double beyond : {1e-11, 1e-7}) {
			SCOPED_TRACE(scale);
			SCOPED_TRACE(beyond);
			Parametrization map = mapWith(mesh, 0, {0.5 + beyond, 0.5 + beyond});
			for (Triangle2& t : map.uv)
				for (Point2& p : t)
					p = {scale * p[0], scale * p[1]};
			ASSERT_EQ(turnedIn(map), 1);
			const auto before = map.uv;
			turnOver(mesh, map);
			EXPECT_EQ(map.uv == before, beyond < 1e-9);
			EXPECT_EQ(map.report.overlapCuts, 0); // at the border
		}
}

TEST(TurnOver, LeavesASoundMapAlone)
{
	const SurfaceMesh mesh = rectangle(4, 4, 4.0, 4.0);
	Parametrization map = mapWith(mesh, 12, {2.1, 1.9});
	const auto before = map.uv;
	turnOver(mesh, map);
	EXPECT_TRUE(map.uv == before);
	EXPECT_EQ(map.report.overlapCuts, 0);
}

} // namespace
} // namespace ricci::testing
