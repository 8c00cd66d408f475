// SPDX-License-Identifier: GPL-3.0-or-later
// What a mirror takes to what, and where no cut is its own image.
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/cut/cut_graph.h>
#include <ricci/mesh/component.h>

#include <gtest/gtest.h>

#include <cmath>

namespace ricci::testing {
namespace {

/// mirror_test.cpp has the cuts that there are.
TEST(MirroredCut, IsNoneWhereConesHaveNoImages)
{
	const SurfaceMesh ball = sphere(12, 16);
	for (const SurfaceMesh& mesh :
		 {ball, withoutStars(ball, {0}), torus(2.0, 0.7, 20, 12), perforatedSlab(2, 2)}) {
		const EmbeddedSurface surface =
			embeddedSurface(VertexArray<Point3>(mesh.positions), mesh.triangles);
		const Triangulation& t = surface.triangulation;
		const auto mirror = findMirror(surface);
		ASSERT_TRUE(mirror);
		VertexArray<char> cones(t.vertexCount(), 0);
		for (const Vertex v : t.vertices())
			cones[v] = mirror->isAbove[v] && !surface.topology.boundary[v] && v.number() % 7 == 0;
		EXPECT_FALSE(mirroredCut(t, *mirror, surface.lengths, cones));
	}
}

TEST(Mirror, ImagesAreReflectionsAndPartsOnOneSideHaveNone)
{
	SurfaceMesh mesh = sphere(12, 16);
	Random random(5);
	// One vertex off the plane has moved.
	const std::size_t moved = 1 + 16 * 5 + 1;
	mesh.positions[moved] = 1.05 * mesh.positions[moved];
	const EmbeddedSurface surface =
		embeddedSurface(VertexArray<Point3>(mesh.positions), mesh.triangles);
	const auto mirror = findMirror(surface);
	ASSERT_TRUE(mirror);
	// Ways to the images have one direction, and their middles lie in one plane.
	int missing = 0;
	Point3 normal{0, 0, 0};
	for (const Vertex v : mirror->image.indices())
		if (const Vertex w = mirror->image[v]; w.isValid() && length(normal) < 1.0 && v != w)
			normal = surface.positions[w] - surface.positions[v];
	normal = normal / length(normal);
	for (const Vertex v : mirror->image.indices()) {
		const Vertex w = mirror->image[v];
		missing += !w.isValid();
		if (!w.isValid())
			continue;
		EXPECT_EQ(mirror->image[w], v);
		const Point3 &p = surface.positions[v], &q = surface.positions[w];
		EXPECT_NEAR(length(cross(normal, p - q)), 0.0, 1e-12);
		EXPECT_NEAR(dot(normal, p + q), 0.0, 1e-12);
		EXPECT_EQ(v == w, std::abs(dot(normal, p)) < 1e-12);
	}
	EXPECT_EQ(missing, 2);
	for (Point3& p : mesh.positions)
		for (double& x : p)
			x += random.real(-0.05, 0.05);
	EXPECT_FALSE(findMirror(embeddedSurface(VertexArray<Point3>(mesh.positions), mesh.triangles)));
}

/// Vertices round a can of needles lie closer together than a thousandth of its long sides.
TEST(Mirror, OfNeedlesIsNoneWhereOneRimIsTurned)
{
	const int around = 4000;
	SurfaceMesh can = revolved({{0.0, 0.0}, {1.0, 0.0}, {1.0, 3.0}, {0.0, 3.0}}, around);
	const auto hasMirror = [&] {
		return findMirror(embeddedSurface(VertexArray<Point3>(can.positions), can.triangles)) !=
			   nullptr;
	};
	EXPECT_TRUE(hasMirror());
	for (int j = 0; j < around; ++j) {
		const double a = 2 * kPi * (j + 0.25) / around;
		can.positions[positionOf(1 + around + j)] = {std::cos(a), std::sin(a), 3.0};
	}
	EXPECT_FALSE(hasMirror());
}

} // namespace
} // namespace ricci::testing
