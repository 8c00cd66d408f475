// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/cut/cut_graph.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ricci::testing {
namespace {

/// A prism over a star whose corners are at the distances R + d and R - d from its axis in turn: the
/// sum of two eigenvectors of its Laplacian, which smoothing shrinks to 1 / (1 + t e) for the
/// eigenvalue e. Its faces are vertical, so that the heights depend on nothing else.
TEST(SeamCost, ExposureOfAStarIsThatOfItsTwoModes)
{
	constexpr int n = 16, rows = 8;
	constexpr double R = 2.0, d = 0.3, turn = 2 * kPi / n;
	const double outer = R + d, inner = R - d;
	const double side =
		std::sqrt(outer * outer + inner * inner - 2 * outer * inner * std::cos(turn));
	const double storey = 0.9 * side;
	const SurfaceMesh mesh = grid(n, rows, Ends::Joined, Ends::Open, [&](int i, int j) {
		const double r = i % 2 == 0 ? outer : inner;
		return Point3{r * std::cos(i * turn), r * std::sin(i * turn), j * storey};
	});
	const Packed p(mesh);
	const double time = n * rows * side * storey / 400.0; // of the area
	const auto lost = [&](double cosine) {
		const double e = 2 * (1 - cosine) / (side * side);
		return time * e / (1 + time * e);
	};
	const double ofCircle = lost(std::cos(turn)) * R, ofTeeth = lost(-std::cos(turn)) * d;
	// Two of three triangles at a vertex of the first and last row are on one side of it.
	const auto tilt = [&](double r, double neighbour) {
		const double along = (r - neighbour * std::cos(turn)) / side; // sine of half the exterior
		const double cosine = neighbour * std::sin(turn) / side;      // angle, and cosine
		return 3 * cosine / std::hypot(3 * cosine, along);
	};
	const double heights[] = {ofCircle + ofTeeth, ofCircle - ofTeeth};
	const double tilted[] = {heights[0] * tilt(outer, inner), heights[1] * tilt(inner, outer)};
	double square = 0.0;
	for (int k : {0, 1})
		square += ((rows - 1) * heights[k] * heights[k] + tilted[k] * tilted[k]) / (2.0 * rows);
	const VertexArray<double> exposed =
		exposure(p.triangulation, p.lengths, VertexArray<Point3>(mesh.positions));
	for (const Vertex v : exposed.indices()) {
		const Point3& q = mesh.positions[at(v)];
		const int k = std::hypot(q[0], q[1]) > R ? 0 : 1;
		const bool atEnd = q[2] < 0.5 * storey || q[2] > (rows - 0.5) * storey;
		const double height = atEnd ? tilted[k] : heights[k];
		// The diagonals of the cells, which are rectangles, have a weight of 1e-6.
		EXPECT_NEAR(exposed[v], 0.5 * (1 + std::tanh(height / std::sqrt(square))), 1e-5);
	}
	EXPECT_LT(heights[1], 0.0); // or one mode alone decides
}

/// An octahedron folded shut: two opposite corners a and c of its equator lie in one place. Faces
/// lie on each other in pairs, so that the normals of every other vertex cancel, and those of a and
/// c, which have a third of the area, are opposite: their heights are h and -h, 3^(1/2) times the
/// root mean square.
TEST(SeamCost, ExposureWithoutANormalIsThatOfAPlane)
{
	SurfaceMesh mesh;
	mesh.positions = {{0, 0, 0.25}, {-1, 0, 0}, {0, 0, 0.25}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
	for (int k = 0; k < 4; ++k) {
		mesh.triangles.push_back({4, k, (k + 1) % 4});
		mesh.triangles.push_back({5, (k + 1) % 4, k});
	}
	const Packed p(mesh);
	const VertexArray<double> exposed =
		exposure(p.triangulation, p.lengths, VertexArray<Point3>(mesh.positions));
	for (int v : {1, 3, 4, 5})
		EXPECT_EQ(exposed[Vertex(v)], 0.5);
	EXPECT_NEAR(exposed[Vertex(0)] + exposed[Vertex(2)], 1.0, 1e-12);
	EXPECT_NEAR(std::abs(exposed[Vertex(0)] - exposed[Vertex(2)]), std::tanh(std::sqrt(3.0)), 1e-9);
}

TEST(SeamCost, IsTheLengthWhereNothingIsToBeHidden)
{
	Random random(724);
	const SurfaceMesh mesh = bumpyTorus(14, 9, random);
	const Packed p(mesh);
	const VertexArray<Point3> positions(mesh.positions);
	EXPECT_EQ(seamCost(p.triangulation, p.lengths, positions, 0.0), p.lengths);
	const EdgeArray<double> hidden = seamCost(p.triangulation, p.lengths, positions, 1.0);
	for (const Edge e : hidden.indices()) {
		EXPECT_GE(hidden[e], p.lengths[e]);
		EXPECT_LE(hidden[e], 10.0 * p.lengths[e]);
	}
}

/// A cut along diagonals is shorter, but the cut takes the sides.
TEST(SeamCost, KeepsSeamsOffDiagonals)
{
	const SurfaceMesh mesh = torus(2, 1, 12, 9);
	const Packed p(mesh);
	const Triangulation& t = p.triangulation;
	EdgeArray<char> isDiagonal(t.edgeCount(), 0);
	for (const Edge e : t.edges()) { // vertices are numbered (i nv + j): a diagonal steps both ways
		const auto [a, b] = t.ends(e);
		isDiagonal[e] = a.number() / 9 != b.number() / 9 && a.number() % 9 != b.number() % 9;
	}
	EXPECT_EQ(std::count(isDiagonal.begin(), isDiagonal.end(), 1), 12 * 9);
	EdgeArray<double> cost(t.edgeCount(), 1.0);
	VertexArray<char> marked(t.vertexCount(), 0);
	for (int v : {0, 40, 67, 100})
		marked[Vertex(v)] = 1;
	const CutGraph any = cutToDisk(t, cost, marked);
	avoidDiagonals(isDiagonal, cost);
	const CutGraph cut = cutToDisk(t, cost, marked);
	int before = 0, after = 0;
	for (const Edge e : t.edges()) {
		before += isDiagonal[e] && any.isCut[e];
		after += isDiagonal[e] && cut.isCut[e];
	}
	EXPECT_GE(cut.edgeCount(), any.edgeCount());
	EXPECT_GT(before, 0);
	EXPECT_EQ(after, 0);
	// Diagonals are what they were without any polygon.
	avoidDiagonals({}, cost);
}

} // namespace
} // namespace ricci::testing
