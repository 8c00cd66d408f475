// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/surface/double_surface.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace ricci::testing {
namespace {

struct Surface
{
	const char* name;
	Triangulation triangulation;
};

std::vector<Surface> surfaces()
{
	Random random(340);
	return {
		{"disk", glued(randomPlanarDisk(6, random))},
		{"ring", glued(ring(1, 2, 9, 3))},
		{"pierced torus", glued(withoutStars(torus(3, 1, 9, 9), {0, 40}))},
		{"triangle", Triangulation(3, {{0, 1, 2}})},
		{"two triangles, their edge between two boundary vertices",
		 Triangulation(4, {{0, 1, 2}, {0, 2, 3}})},
		{"triangle glued to itself", Triangulation(2, {{0, 1, 0}}, {1, 0, -1})}};
}

int boundaryVertexCount(const Triangulation& t)
{
	const auto boundary = t.boundaryVertices();
	return static_cast<int>(std::count(boundary.begin(), boundary.end(), 1));
}

TEST(DoubleSurface, IsClosedWithTwiceTheEulerCharacteristic)
{
	for (const Surface& s : surfaces()) {
		SCOPED_TRACE(s.name);
		const Triangulation& t = s.triangulation;
		const DoubleSurface d = doubleOf(t);
		const Triangulation& closed = d.triangulation;
		EXPECT_TRUE(closed.boundaryLoops().empty());
		EXPECT_EQ(closed.faceCount(), 2 * t.faceCount());
		EXPECT_EQ(closed.vertexCount(), 2 * t.vertexCount() - boundaryVertexCount(t));
		// The boundary is made of circles, whose characteristic is 0.
		EXPECT_EQ(closed.eulerCharacteristic(), 2 * t.eulerCharacteristic());
		for (int h = 0; h < closed.halfedgeCount(); ++h) {
			ASSERT_FALSE(closed.isOuter(h));
			ASSERT_EQ(closed.next(closed.next(closed.next(h))), h);
			ASSERT_EQ(closed.origin(closed.next(h)), closed.target(h));
		}
	}
}

TEST(DoubleSurface, FirstCopyKeepsItsNumbers)
{
	for (const Surface& s : surfaces()) {
		SCOPED_TRACE(s.name);
		const Triangulation& t = s.triangulation;
		const DoubleSurface d = doubleOf(t);
		for (int h = 0; h < t.halfedgeCount(); ++h) {
			EXPECT_EQ(d.triangulation.origin(h), t.origin(h));
			EXPECT_EQ(d.edgeOf[at(Triangulation::edge(h))], Triangulation::edge(h));
			if (t.isOuter(h)) {
				EXPECT_GE(d.triangulation.face(h), t.faceCount());
				continue;
			}
			EXPECT_EQ(d.triangulation.face(h), t.face(h));
			EXPECT_EQ(d.triangulation.next(h), t.next(h));
		}
		for (int f = 0; f < t.faceCount(); ++f)
			EXPECT_EQ(d.triangulation.halfedges(f), t.halfedges(f));
	}
}

TEST(DoubleSurface, MirrorIsAnInvolutionThatFixesTheBoundary)
{
	for (const Surface& s : surfaces()) {
		SCOPED_TRACE(s.name);
		const Triangulation& t = s.triangulation;
		const DoubleSurface d = doubleOf(t);
		const auto boundary = t.boundaryVertices();
		ASSERT_EQ(static_cast<int>(d.mirror.size()), d.triangulation.vertexCount());
		for (std::size_t v = 0; v < d.mirror.size(); ++v) {
			EXPECT_EQ(d.mirror[at(d.mirror[v])], static_cast<int>(v));
			EXPECT_EQ(d.mirror[v] == static_cast<int>(v), v < boundary.size() && boundary[v]);
		}
	}
}

TEST(DoubleSurface, EveryEdgeIsItsOwnOrMirrorsOne)
{
	for (const Surface& s : surfaces()) {
		SCOPED_TRACE(s.name);
		const Triangulation& t = s.triangulation;
		const DoubleSurface d = doubleOf(t);
		std::vector<int> copies(at(t.edgeCount()), 0);
		ASSERT_EQ(static_cast<int>(d.edgeOf.size()), d.triangulation.edgeCount());
		for (int e = 0; e < d.triangulation.edgeCount(); ++e) {
			const int original = d.edgeOf[at(e)];
			ASSERT_GE(original, 0);
			ASSERT_LT(original, t.edgeCount());
			++copies[at(original)];
			if (e == original)
				continue;
			const int a = d.triangulation.origin(2 * e), b = d.triangulation.target(2 * e);
			const std::vector<int> mirrored{d.mirror[at(a)], d.mirror[at(b)]};
			std::vector<int> own{t.origin(2 * original), t.target(2 * original)};
			EXPECT_TRUE(std::is_permutation(mirrored.begin(), mirrored.end(), own.begin()));
		}
		for (int e = 0; e < t.edgeCount(); ++e)
			EXPECT_EQ(copies[at(e)], t.isBoundaryEdge(e) ? 1 : 2);
	}
}

/// The second copy of each face is the mirror image of the first.
TEST(DoubleSurface, SecondCopyIsTurnedRound)
{
	for (const Surface& s : surfaces()) {
		SCOPED_TRACE(s.name);
		const DoubleSurface d = doubleOf(s.triangulation);
		const int faces = s.triangulation.faceCount();
		for (int f = 0; f < faces; ++f) {
			const auto h = d.triangulation.halfedges(f), g = d.triangulation.halfedges(faces + f);
			std::vector<int> backward, image;
			for (std::size_t k = 0; k < 3; ++k) {
				image.push_back(d.triangulation.origin(g[k]));
				backward.push_back(d.mirror[at(d.triangulation.origin(h[(3 - k) % 3]))]);
			}
			bool found = false;
			for (int turn = 0; turn < 3; ++turn) {
				found |= image == backward;
				std::rotate(image.begin(), image.begin() + 1, image.end());
			}
			EXPECT_TRUE(found) << "face " << f;
		}
	}
}

/// The edge of an ear joins two boundary vertices inside the surface: its two copies join the same
/// two vertices and must stay two edges.
TEST(DoubleSurface, EdgeBetweenTwoBoundaryVerticesStaysTwoEdges)
{
	const Triangulation t(4, {{0, 1, 2}, {0, 2, 3}});
	const DoubleSurface d = doubleOf(t);
	std::vector<int> diagonals;
	for (int e = 0; e < d.triangulation.edgeCount(); ++e) {
		const int a = d.triangulation.origin(2 * e), b = d.triangulation.target(2 * e);
		if (std::min(a, b) == 0 && std::max(a, b) == 2)
			diagonals.push_back(e);
	}
	ASSERT_EQ(diagonals.size(), 2u);
	for (int e : diagonals) {
		const bool first = d.triangulation.face(2 * e) < 2;
		EXPECT_EQ(d.triangulation.face(2 * e + 1) < 2, first);
		EXPECT_TRUE(d.triangulation.isFlippable(e));
	}
	EXPECT_EQ(d.triangulation.vertexCount(), 4);
}

TEST(DoubleSurface, SingleTriangleBecomesASphereOfTwo)
{
	const DoubleSurface d = doubleOf(Triangulation(3, {{0, 1, 2}}));
	EXPECT_EQ(d.triangulation.vertexCount(), 3);
	EXPECT_EQ(d.triangulation.edgeCount(), 3);
	EXPECT_EQ(d.triangulation.faceCount(), 2);
	EXPECT_EQ(d.triangulation.eulerCharacteristic(), 2);
	EXPECT_EQ(d.mirror, (std::vector<int>{0, 1, 2}));
	for (int e = 0; e < 3; ++e)
		EXPECT_TRUE(d.triangulation.isFlippable(e));
}

} // namespace
} // namespace ricci::testing
