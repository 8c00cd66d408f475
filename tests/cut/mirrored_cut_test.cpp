// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts that a mirror takes to themselves.
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/base/graphs.h>
#include <ricci/cut/cut_graph.h>
#include <ricci/layout/planar_layout.h>
#include <ricci/mesh/component.h>

#include <gtest/gtest.h>

#include <vector>

namespace ricci::testing {
namespace {

/// The corners between cut edges are the vertices of the opened surface, which is connected and has V - E + F = 1.
void expectDisk(const Triangulation& t, const EdgeArray<char>& isCut)
{
	DisjointSetsOf<Face> faces(t.faceCount());
	int parts = t.faceCount(), edges = t.edgeCount();
	for (const Edge e : t.edges()) {
		edges += isCut[e];
		if (!t.isBoundary(e) && !isCut[e])
			parts -= faces.merge(t.face(e.halfedge()), t.face(e.halfedge().twin()));
	}
	EXPECT_EQ(parts, 1);
	EXPECT_EQ(cornerWedges(t, isCut).points.size() - edges + t.faceCount(), 1);
}

/// Random cones and their images, some of them in the plane.
VertexArray<char>
someCones(const EmbeddedSurface& surface, const MirrorSymmetry& mirror, Random& random)
{
	VertexArray<char> cones(surface.triangulation.vertexCount(), 0);
	for (int i = 0; i < 4; ++i) {
		const Vertex v(random.index(cones.size()));
		if (!surface.topology.boundary[v] && mirror.image[v].isValid())
			cones[v] = cones[mirror.image[v]] = 1;
	}
	for (const Vertex v : cones.indices())
		if (mirror.image[v] == v && !surface.topology.boundary[v] && random.index(20) == 0)
			cones[v] = 1;
	return cones;
}

TEST(MirroredCut, LeavesADiskAndIsItsOwnImage)
{
	Random random(977);
	const SurfaceMesh ball = sphere(12, 16);
	for (const SurfaceMesh& mesh :
		 {ball,
		  withoutStars(ball, {0}),
		  withoutStars(ball, {0, 1 + 16 * 6 + 4}),
		  withoutStars(ball, {1 + 16 * 6 + 2, 1 + 16 * 6 + 6}),
		  torus(2.0, 0.7, 20, 12),
		  perforatedSlab(2, 2)}) {
		const EmbeddedSurface surface =
			embeddedSurface(VertexArray<Point3>(mesh.positions), mesh.triangles);
		const Triangulation& t = surface.triangulation;
		const auto mirror = findMirror(surface);
		ASSERT_TRUE(mirror);
		int found = 0;
		for (int round = 0; round < 20; ++round) {
			const VertexArray<char> cones = someCones(surface, *mirror, random);
			const auto cut = mirroredCut(t, *mirror, surface.lengths, cones);
			if (!cut)
				continue;
			++found;
			expectDisk(t, cut->isCut);
			VertexArray<char> reached(t.vertexCount(), 0);
			double length = 0.0;
			for (const Edge e : t.edges())
				if (cut->isCut[e]) {
					ASSERT_TRUE(mirror->edgeImage[e].isValid());
					EXPECT_TRUE(cut->isCut[mirror->edgeImage[e]]);
					length += surface.lengths[e];
					for (const Vertex v : t.ends(e))
						reached[v] = 1;
				}
			EXPECT_NEAR(cut->length, length, 1e-12 * length);
			for (const Vertex v : t.vertices())
				EXPECT_LE(cones[v], reached[v]);
			EXPECT_EQ(static_cast<int>(cut->generators.size()), 2 * surface.topology.type.genus);
		}
		EXPECT_GT(found, 15);
		// Cones without their images.
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

/// One vertex far away, with long edges, does not make vertices images of others that are not.
TEST(Mirror, ALongEdgeIsNoMeasure)
{
	SurfaceMesh mesh = sphere(12, 16);
	mesh.positions[0] = {0.0, 0.0, -1e5};
	const auto find = [&] {
		return findMirror(embeddedSurface(VertexArray<Point3>(mesh.positions), mesh.triangles));
	};
	const auto mirror = find();
	ASSERT_TRUE(mirror);
	for (const Vertex v : mirror->image.indices())
		EXPECT_TRUE(mirror->image[v].isValid());
	Random random(6);
	for (std::size_t v = 1; v < mesh.positions.size(); ++v)
		for (double& x : mesh.positions[v])
			x += random.real(-0.01, 0.01);
	EXPECT_FALSE(find());
}

TEST(Mirror, VerticesOfAHoleThatIsClosedAreImagesOfSuch)
{
	constexpr int kAround = 16, kEye = 1 + kAround * 6 + 2;
	const SurfaceMesh ball = withoutStars(sphere(12, kAround), {kEye, kEye + 4});
	const EmbeddedSurface surface =
		embeddedSurface(VertexArray<Point3>(ball.positions), ball.triangles);
	ASSERT_EQ(surface.topology.type.boundaryLoops, 2);
	VertexArray<char> onHole(surface.positions.size(), 0);
	for (const Vertex v : onHole.indices())
		onHole[v] = surface.topology.boundary[v] && surface.positions[v][0] < 0.0;
	const auto both = findMirror(surface), one = findMirror(surface, onHole);
	ASSERT_TRUE(both);
	ASSERT_TRUE(one);
	int otherwise = 0;
	for (const Vertex v : onHole.indices()) {
		if (const Vertex w = both->image[v]; w.isValid())
			otherwise += onHole[v] != onHole[w];
		if (const Vertex w = one->image[v]; w.isValid()) {
			EXPECT_EQ(onHole[v], onHole[w]);
		}
	}
	EXPECT_GT(otherwise, 0);
}

} // namespace
} // namespace ricci::testing
