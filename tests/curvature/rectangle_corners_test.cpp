// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/random.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/curvature/rectangle_corners.h>
#include <ricci/surface/triangulation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace ricci::testing {
namespace {

std::vector<Vertex> boundaryLoop(const SurfaceMesh& mesh)
{
	return topologyOf(glued(mesh)).loops.front();
}

std::array<Vertex, 4> cornersOf(const SurfaceMesh& mesh)
{
	return rectangleCorners(boundaryLoop(mesh), VertexArray<Point3>(mesh.positions));
}

/// Where the corners are in the loop.
std::array<std::ptrdiff_t, 4>
placesIn(const std::vector<Vertex>& loop, const std::array<Vertex, 4>& corners)
{
	std::array<std::ptrdiff_t, 4> place;
	for (std::size_t k = 0; k < 4; ++k)
		place[k] = std::find(loop.begin(), loop.end(), corners[k]) - loop.begin();
	return place;
}

TEST(RectangleCorners, ByShape)
{
	// A rectangular patch, turned in space, bent a little, shuffled: its own four corners.
	Random random(90);
	for (int trial = 0; trial < 20; ++trial) {
		const int nx = 4 + random.index(8), ny = 4 + random.index(8);
		SurfaceMesh patch = rectangle(nx, ny, random.real(1, 4), random.real(1, 4));
		const std::set<int> expected{0, ny, nx * (ny + 1), nx * (ny + 1) + ny};
		for (Point3& p : patch.positions)
			p[2] = 0.1 * std::sin(p[0] + 2 * p[1]);
		patch = turned(patch, {random.real(-3, 3), random.real(-3, 3), random.real(-3, 3)});
		const Renumbered other = renumbered(patch, random);
		const std::array<Vertex, 4> corners = cornersOf(other.mesh);
		std::set<int> found;
		for (const Vertex v : corners)
			found.insert(other.vertex[at(v)]);
		EXPECT_EQ(found, expected);
		// Boundary order.
		const auto place = placesIn(boundaryLoop(other.mesh), corners);
		EXPECT_TRUE(std::is_sorted(place.begin(), place.end()));
	}
}

TEST(RectangleCorners, OfARoundPatchAreFourDifferentVertices)
{
	for (int n : {4, 5, 7, 30}) { // every boundary vertex is like the others
		const std::array<Vertex, 4> corners = cornersOf(fan(n, 0.0));
		EXPECT_EQ(std::set<Vertex>(corners.begin(), corners.end()).size(), 4u);
	}
}

TEST(RectangleCorners, QuartersWhereTwoCornersOfTheRectangleAreNearestToOneVertex)
{
	// A flat triangle: the nearest vertex to the upper corners of its rectangle is the lower one.
	std::vector<Point3> outline;
	const auto side = [&](const Point3& a, const Point3& b, int parts) {
		for (int i = 0; i < parts; ++i) {
			const double s = static_cast<double>(i) / parts;
			outline.push_back({a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), 0.0});
		}
	};
	const Point3 left{0.0, 0.0, 0.0}, right{4.0, 0.0, 0.0}, apex{2.0, 0.5, 0.0};
	side(left, right, 8);
	side(right, apex, 4);
	side(apex, left, 4);
	const double perimeter = 4.0 + 2 * std::hypot(2.0, 0.5), longest = std::hypot(2.0, 0.5) / 4;
	const int n = static_cast<int>(outline.size());
	for (int shift = 0; shift < n; ++shift) {
		std::vector<Vertex> loop;
		for (int i = 0; i < n; ++i)
			loop.push_back(Vertex((i + shift) % n));
		const VertexArray<Point3> positions(outline);
		const auto place = placesIn(loop, rectangleCorners(loop, positions));
		EXPECT_EQ(place[0], 0);
		double along = 0.0;
		std::size_t k = 1;
		for (std::size_t i = 0; i + 1 < loop.size() && k < 4; ++i) {
			along += distance(positions[loop[i]], positions[loop[i + 1]]);
			if (place[k] != static_cast<std::ptrdiff_t>(i) + 1)
				continue;
			const double wanted = 0.25 * perimeter * static_cast<double>(k);
			EXPECT_GE(along, wanted - 1e-12);
			EXPECT_LT(along, wanted + longest + 1e-12);
			++k;
		}
		EXPECT_EQ(k, 4u); // all of them, in order
	}
}

TEST(RectangleCorners, FourVerticesAreTheCorners)
{
	const VertexArray<Point3> positions{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}};
	const std::vector<Vertex> loop{Vertex(0), Vertex(1), Vertex(2), Vertex(3)};
	EXPECT_EQ(
		placesIn(loop, rectangleCorners(loop, positions)),
		(std::array<std::ptrdiff_t, 4>{0, 1, 2, 3}));
}

} // namespace
} // namespace ricci::testing
