// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flat_meshes.h"

#include <ricci/charts/flipped_triangles.h>
#include <ricci/math/orientation.h>

#include <gtest/gtest.h>

#include <cmath>

namespace ricci::testing {
namespace {

TEST(ReflectFlipped, SidesKeepTheirLengthsAndSeamsAreCounted)
{
	// The vertex in the middle of 4 by 4 squares leaves the ring of its neighbours.
	const SurfaceMesh mesh = rectangle(4, 4, 4.0, 4.0);
	const Parametrization before = mapWith(flatMesh(mesh, 12, {3.3, 2.2}));
	ASSERT_GT(flippedIn(before.mesh), 0);
	Parametrization map = before;
	reflectFlipped(map);
	EXPECT_EQ(flippedIn(map.mesh), 0);
	int seams = 0;
	double length = 0.0;
	for (const int f : map.mesh.points.indices())
		for (const Corner c : cornersOf(f)) {
			EXPECT_NEAR(
				distance(map.mesh.at(c), map.mesh.at(c.next())),
				distance(before.mesh.at(c), before.mesh.at(c.next())),
				1e-14);
			const Corner other = map.mesh.across[c];
			if (other > c && (map.mesh.at(c) != map.mesh.at(other.next()) ||
							  map.mesh.at(c.next()) != map.mesh.at(other))) {
				EXPECT_FALSE(map.mesh.joined(c).isValid());
				++seams;
				length += map.mesh.lengths[c];
			}
		}
	EXPECT_GT(seams, 0);
	EXPECT_EQ(map.report.overlapCuts, seams);
	EXPECT_NEAR(map.report.seamLength, length, 1e-12);
}

TEST(ReflectFlipped, LeavesWhatIsFlippedByNoMoreThanOnePlace)
{
	// The vertex at 0 is in front of the diagonal of a square from (1, 0) to (0, 1), or behind it.
	SurfaceMesh mesh;
	mesh.positions = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}};
	mesh.triangles = {{0, 1, 3}, {1, 2, 3}};
	for (const double scale : {1e-6, 1.0, 1e6})
		for (const double beyond : {1e-11, 1e-7}) {
			SCOPED_TRACE(scale);
			SCOPED_TRACE(beyond);
			Parametrization map = mapWith(flatMesh(mesh, 0, {0.5 + beyond, 0.5 + beyond}));
			for (Point2& p : map.mesh.place)
				p = scale * p;
			ASSERT_EQ(flippedIn(map.mesh), 1);
			const auto before = map.mesh.corners();
			reflectFlipped(map);
			EXPECT_EQ(map.mesh.corners() == before, beyond < 1e-9);
			EXPECT_EQ(map.report.overlapCuts, 0); // at the border
		}
}

TEST(ReflectFlipped, LeavesAValidMapAlone)
{
	const SurfaceMesh mesh = rectangle(4, 4, 4.0, 4.0);
	Parametrization map = mapWith(flatMesh(mesh, 12, {2.1, 1.9}));
	const auto before = map.mesh.corners();
	reflectFlipped(map);
	EXPECT_TRUE(map.mesh.corners() == before);
	EXPECT_EQ(map.report.overlapCuts, 0);
}

} // namespace
} // namespace ricci::testing
