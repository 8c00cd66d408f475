// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/shapes.h"

#include <ricci/surface/hole_caps.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace ricci::testing {
namespace {

/// A square of n x n cells without the stars of some inner vertices.
SurfaceMesh squareWithHoles(int n)
{
	const auto vertex = [&](int i, int j) { return i * (n + 1) + j; };
	return withoutStars(
		rectangle(n, n, 1.0, 1.0), {vertex(2, 2), vertex(n - 2, 3), vertex(n / 2, n - 2)});
}

TEST(HoleCaps, CloseAllLoopsButTheLongest)
{
	const SurfaceMesh mesh = squareWithHoles(9);
	const Triangulation t(static_cast<int>(mesh.positions.size()), mesh.triangles);
	ASSERT_EQ(t.boundaryLoops().size(), 4u);
	const CappedSurface capped = capInnerLoops(t, mesh.positions);
	EXPECT_EQ(capped.holes, 3);
	EXPECT_EQ(capped.triangulation.boundaryLoops().size(), 1u);
	EXPECT_EQ(capped.triangulation.eulerCharacteristic(), t.eulerCharacteristic() + 3);
	EXPECT_EQ(capped.triangulation.vertexCount(), t.vertexCount() + 3);
	// The rims of the holes, and nothing else, are marked.
	const std::vector<char> before = t.boundaryVertices();
	const std::vector<char> after = capped.triangulation.boundaryVertices();
	for (int v = 0; v < t.vertexCount(); ++v) {
		EXPECT_EQ(before[at(v)] != 0, after[at(v)] != 0 || capped.onHole[at(v)] != 0);
		EXPECT_FALSE(after[at(v)] && capped.onHole[at(v)]);
	}
	for (int v = t.vertexCount(); v < capped.triangulation.vertexCount(); ++v)
		EXPECT_FALSE(after[at(v)]);
}

TEST(HoleCaps, KeepTheNumbersOfTheSurface)
{
	const SurfaceMesh mesh = squareWithHoles(8);
	const Triangulation t(static_cast<int>(mesh.positions.size()), mesh.triangles);
	const CappedSurface capped = capInnerLoops(t, mesh.positions);
	const Triangulation& c = capped.triangulation;
	for (int h = 0; h < t.halfedgeCount(); ++h) {
		EXPECT_EQ(c.origin(h), t.origin(h));
		if (!t.isOuter(h)) {
			EXPECT_EQ(c.face(h), t.face(h));
			EXPECT_EQ(c.next(h), t.next(h));
		}
		else if (capped.onHole[at(t.origin(h))]) {
			EXPECT_GE(c.face(h), t.faceCount());
		}
	}
	for (std::size_t v = 0; v < mesh.positions.size(); ++v)
		EXPECT_EQ(capped.positions[v], mesh.positions[v]);
}

TEST(HoleCaps, LeaveASurfaceWithOneLoopOrNoneAlone)
{
	for (const SurfaceMesh& mesh : {rectangle(3, 3, 1.0, 1.0), tetrahedron()}) {
		const Triangulation t(static_cast<int>(mesh.positions.size()), mesh.triangles);
		const CappedSurface capped = capInnerLoops(t, mesh.positions);
		EXPECT_EQ(capped.holes, 0);
		EXPECT_EQ(capped.triangulation.faceCount(), t.faceCount());
		EXPECT_EQ(std::count(capped.onHole.begin(), capped.onHole.end(), 1), 0);
	}
}

} // namespace
} // namespace ricci::testing
