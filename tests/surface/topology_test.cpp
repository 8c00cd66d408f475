// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/surface/topology.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ricci::testing {
namespace {

TEST(Topology, OfSurfacesWithAndWithoutBoundary)
{
	const struct
	{
		SurfaceMesh mesh;
		int genus;
		std::size_t loops;
		const char* name;
	} cases[] = {
		{perforatedSlab(0, 2), 0, 0, "a closed surface of genus 0 (a sphere)"},
		{torus(3, 1, 9, 7), 1, 0, "a closed surface of genus 1 (a torus)"},
		{perforatedSlab(2, 1), 2, 0, "a closed surface of genus 2"},
		{rectangle(5, 4, 5, 4), 0, 1, "a disk"},
		{ring(1, 2, 9, 3), 0, 2, "an annulus"},
		{withoutStars(torus(3, 1, 9, 9), {0}), 1, 1, "a surface of genus 1 with 1 boundary loop"}};
	for (const auto& c : cases) {
		const Triangulation t = glued(c.mesh);
		const Topology topology = topologyOf(t);
		EXPECT_EQ(topology.type.genus, c.genus);
		EXPECT_EQ(topology.loops.size(), c.loops);
		EXPECT_EQ(topology.type.boundaryLoops, static_cast<int>(c.loops));
		EXPECT_EQ(topology.type.name(), c.name);
		EXPECT_EQ(topology.type.eulerCharacteristic(), t.eulerCharacteristic());
		EXPECT_EQ(topology.boundary, t.boundaryVertices());
	}
}

TEST(Topology, LoopsHaveTheSurfaceOnTheirLeft)
{
	// Shoelace: the outer loop of a ring runs counter-clockwise, the inner one clockwise.
	const SurfaceMesh annulus = ring(1, 2, 9, 3);
	std::vector<double> areas;
	for (const std::vector<Vertex>& loop : topologyOf(glued(annulus)).loops) {
		double area = 0.0;
		for (std::size_t i = 0; i < loop.size(); ++i) {
			const Point3& p = annulus.positions[at(loop[i])];
			const Point3& q = annulus.positions[at(loop[(i + 1) % loop.size()])];
			area += 0.5 * (p[0] * q[1] - p[1] * q[0]);
		}
		areas.push_back(area);
	}
	std::sort(areas.begin(), areas.end());
	ASSERT_EQ(areas.size(), 2u);
	const double unitPolygon = 4.5 * std::sin(2 * kPi / 9);
	EXPECT_NEAR(areas[0], -unitPolygon, 1e-12);
	EXPECT_NEAR(areas[1], 4 * unitPolygon, 1e-12);
}

} // namespace
} // namespace ricci::testing
