// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/random.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/edge_swap/boundary_split.h>
#include <ricci/math/points.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace ricci::testing {
namespace {

Component componentOf(const SurfaceMesh& mesh)
{
	std::vector<std::string> notes;
	std::vector<Component> components = splitIntoComponents(openMesh(mesh, notes));
	EXPECT_EQ(components.size(), 1u);
	return components.front();
}

Triangulation triangulationOf(const SplitMesh& mesh)
{
	return Triangulation(mesh.positions().size(), mesh.triangles());
}

using Corners = std::array<Point3, 3>;

Corners cornersOf(const VertexArray<Point3>& positions, const Triangle& t)
{
	return {positions[Vertex(t[0])], positions[Vertex(t[1])], positions[Vertex(t[2])]};
}

/// Normal times twice the area.
Point3 normalOf(const Corners& p)
{
	Point3 a, b;
	for (std::size_t x = 0; x < 3; ++x) {
		a[x] = p[1][x] - p[0][x];
		b[x] = p[2][x] - p[0][x];
	}
	return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Point3& a, const Point3& b)
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double areaOf(const Corners& p)
{
	const Point3 n = normalOf(p);
	return 0.5 * std::sqrt(dot(n, n));
}

/// Shares of \p p in the corners of a triangle in whose plane it lies.
std::array<double, 3> weightsOf(const Point3& p, const Corners& triangle)
{
	const Point3 n = normalOf(triangle);
	std::array<double, 3> weights;
	for (std::size_t k = 0; k < 3; ++k) {
		Corners part = triangle;
		part[k] = p;
		weights[k] = dot(normalOf(part), n) / dot(n, n);
	}
	return weights;
}

/// Whether \p part lies in \p whole and is turned the same way.
bool isPartOf(const Corners& part, const Corners& whole)
{
	if (!(dot(normalOf(part), normalOf(whole)) > 0.0))
		return false;
	for (const Point3& p : part) {
		const auto w = weightsOf(p, whole);
		Point3 inPlane{};
		for (std::size_t k = 0; k < 3; ++k)
			for (std::size_t x = 0; x < 3; ++x)
				inPlane[x] += w[k] * whole[k][x];
		if (*std::min_element(w.begin(), w.end()) < -1e-12 || distance(p, inPlane) > 1e-12)
			return false;
	}
	return true;
}

Edge edgeBetween(const Triangulation& t, Vertex a, Vertex b)
{
	for (const Edge e : t.edges())
		if (std::minmax(t.ends(e)[0], t.ends(e)[1]) == std::minmax(a, b))
			return e;
	return Edge();
}

TEST(SplitMesh, IsTheComponentBeforeASplit)
{
	Random random(600);
	const Component component = componentOf(randomPlanarDisk(4, random));
	const SplitMesh mesh(component);
	EXPECT_EQ(mesh.splits(), 0);
	EXPECT_EQ(mesh.positions(), component.positions);
	EXPECT_EQ(mesh.triangles(), component.triangles);
	const Triangulation t = triangulationOf(mesh);
	for (const Face f : t.faces())
		for (std::size_t k = 0; k < 3; ++k)
			EXPECT_EQ(mesh.corner(t, f, k), t.halfedges(f)[k]);
}

TEST(SplitMesh, SplitsATriangleIntoTwoHalves)
{
	// Each side of the first triangle in turn; the other triangle lies behind its side 1 - 2.
	const SurfaceMesh square{
		{{0, 0, 0}, {2, 0, 1}, {0, 3, 0}, {2, 3, 0.5}}, {{0, 1, 2}, {2, 1, 3}}};
	const Component component = componentOf(square);
	for (const int side : {0, 2}) {
		SplitMesh mesh(component);
		const Vertex i(side), j((side + 1) % 3), apex((side + 2) % 3);
		const Triangulation before = triangulationOf(mesh);
		mesh.split(before, {edgeBetween(before, i, j)});
		EXPECT_EQ(mesh.splits(), 1);
		ASSERT_EQ(mesh.positions().size(), 5);
		const Point3 &a = component.positions[i], &b = component.positions[j];
		EXPECT_EQ(
			mesh.positions()[Vertex(4)],
			(Point3{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])}));
		ASSERT_EQ(mesh.triangles().size(), 3u);
		EXPECT_EQ(mesh.triangles()[1], component.triangles[1]);
		const Triangulation t = triangulationOf(mesh);
		EXPECT_EQ(t.eulerCharacteristic(), 1);
		const Edge cut = edgeBetween(t, Vertex(4), apex);
		ASSERT_TRUE(cut.isValid());
		EXPECT_FALSE(t.isBoundary(cut));
		EXPECT_TRUE(t.isBoundary(edgeBetween(t, i, Vertex(4))));
		EXPECT_TRUE(t.isBoundary(edgeBetween(t, Vertex(4), j)));
		EXPECT_FALSE(edgeBetween(t, i, j).isValid());
		const Corners whole = cornersOf(component.positions, component.triangles[0]);
		for (const std::size_t half : {0u, 2u}) {
			const Corners part = cornersOf(mesh.positions(), mesh.triangles()[half]);
			EXPECT_TRUE(isPartOf(part, whole));
			EXPECT_NEAR(areaOf(part) / areaOf(whole), 0.5, 1e-15);
		}
	}
}

TEST(SplitMesh, SplitsOneEdgeOfATriangleAtOnce)
{
	const Component component = componentOf(rectangle(1, 1, 1, 1));
	SplitMesh mesh(component);
	const Triangulation t = triangulationOf(mesh);
	std::vector<Edge> edges;
	for (const Edge e : t.edges())
		if (t.isBoundary(e))
			edges.insert(edges.begin(), 2, e); // every one twice, the last first
	ASSERT_EQ(edges.size(), 8u);
	mesh.split(t, edges);
	EXPECT_EQ(mesh.splits(), 2);
	EXPECT_EQ(mesh.positions().size(), 6);
	EXPECT_EQ(mesh.triangles().size(), 4u);
}

TEST(SplitMesh, CornersAndFacesStayFindableAfterManySplits)
{
	Random random(601);
	const SurfaceMesh surfaces[] = {
		randomPlanarDisk(4, random),
		sliverDisk(4, 1.0, random),
		ring(1, 2, 7, 1),
		withoutStars(shaken(perforatedSlab(1, 2), 0.05, random), {0})};
	int refound = 0; // corners that lie in a triangle of another number than at first
	for (const SurfaceMesh& surface : surfaces) {
		const Component component = componentOf(surface);
		SplitMesh mesh(component);
		for (int round = 0; round < 8; ++round) {
			const Triangulation before = triangulationOf(mesh);
			std::vector<Edge> edges;
			for (const Edge e : before.edges())
				if (before.isBoundary(e) && random.index(3) == 0)
					edges.push_back(e);
			random.shuffle(edges);
			const int splits = mesh.splits();
			mesh.split(before, edges);
			const Triangulation t = triangulationOf(mesh);
			ASSERT_EQ(t.eulerCharacteristic(), before.eulerCharacteristic());
			ASSERT_EQ(t.boundaryLoops().size(), before.boundaryLoops().size());
			ASSERT_EQ(t.faceCount(), before.faceCount() + mesh.splits() - splits);
			ASSERT_EQ(t.vertexCount(), before.vertexCount() + mesh.splits() - splits);

			std::vector<double> area(component.triangles.size(), 0.0);
			for (const Triangle& triangle : mesh.triangles()) {
				const Corners part = cornersOf(mesh.positions(), triangle);
				int faces = 0;
				for (std::size_t f = 0; f < component.triangles.size(); ++f) {
					const Corners whole = cornersOf(component.positions, component.triangles[f]);
					if (!isPartOf(part, whole))
						continue;
					++faces;
					area[f] += areaOf(part);
				}
				ASSERT_EQ(faces, 1);
			}
			for (std::size_t f = 0; f < component.triangles.size(); ++f) {
				const Corners whole = cornersOf(component.positions, component.triangles[f]);
				EXPECT_NEAR(area[f] / areaOf(whole), 1.0, 1e-13);
				for (std::size_t k = 0; k < 3; ++k) {
					const Halfedge h = mesh.corner(t, Face(f), k);
					ASSERT_TRUE(t.face(h).isValid());
					ASSERT_EQ(t.origin(h), Vertex(component.triangles[f][k]));
					const Triangle& part = mesh.triangles()[positionOf(t.face(h))];
					EXPECT_TRUE(isPartOf(cornersOf(mesh.positions(), part), whole));
					refound += t.face(h) != Face(f);
				}
			}
		}
		EXPECT_GT(mesh.splits(), 10);
	}
	EXPECT_GT(refound, 100);
}

} // namespace
} // namespace ricci::testing
