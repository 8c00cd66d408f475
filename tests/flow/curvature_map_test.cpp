// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/flow/curvature_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ricci::testing {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

using Map = GeometricCurvatureMap<Euclidean>;

/// Closed, with boundaries, of several genera, and with angles down to 1e-3 degrees.
std::vector<Packed> surfaces()
{
	Random random(40);
	return {
		Packed(tetrahedron()),
		Packed(bumpyTorus(12, 8, random)),
		Packed(randomPlanarDisk(8, random)),
		Packed(sliverDisk(12, 3.0, random)),
		Packed(ring(1, 3, 12, 4)),
		Packed(shaken(perforatedSlab(3, 2), 0.05, random))};
}

VertexVector disturbed(VertexVector u, double spread, Random& random)
{
	for (double& x : u)
		x += random.real(-spread, spread);
	return u;
}

TEST(CurvatureMap, AnglesFollowTheLawOfCosines)
{
	Random random(41);
	int triangles = 0;
	for (const Packed& mesh : surfaces()) {
		Map map = mesh.map();
		const VertexVector u = disturbed(mesh.u(), 0.05, random);
		map.evaluate(u);
		const Triangulation& t = map.triangulation();
		for (const Face f : t.faces()) {
			const auto h = t.halfedges(f);
			std::array<long double, 3> l; // side k runs from corner k to k + 1
			for (std::size_t k = 0; k < 3; ++k) {
				const long double gi = std::exp(static_cast<long double>(u[t.origin(h[k])]));
				const long double gj = std::exp(static_cast<long double>(u[t.target(h[k])]));
				const long double I = 1.0L + map.delta()[h[k].edge()];
				l[k] = std::sqrt(gi * gi + gj * gj + 2 * I * gi * gj);
			}
			const long double longest = *std::max_element(l.begin(), l.end());
			const long double slack = l[0] + l[1] + l[2] - 2 * longest;
			if (slack < 1e-9L * longest)
				continue; // the extended precision of acos itself ends here
			++triangles;
			const long double shortest = *std::min_element(l.begin(), l.end());
			for (std::size_t k = 0; k < 3; ++k) {
				const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
				const long double cosine =
					(l[k] * l[k] + l[last] * l[last] - l[next] * l[next]) / (2 * l[k] * l[last]);
				// Rounding of u and of the sides, relative to the slack of the triangle inequality:
				// the angle is a quotient of square roots of such slacks. The reference's own is
				// last.
				const double amplification =
					static_cast<double>(longest / std::min(slack, shortest));
				const double reference = static_cast<double>(
					1e-18L * longest / shortest / std::sqrt(1 - cosine * cosine));
				EXPECT_NEAR(
					map.angles()[h[k]],
					static_cast<double>(std::acos(cosine)),
					32 * kEpsilon * (1 + amplification * std::abs(map.angles()[h[k]])) + reference);
			}
		}
	}
	EXPECT_GT(triangles, 500);
}

TEST(CurvatureMap, CurvatureIsTheAngleDefect)
{
	for (const Packed& mesh : surfaces()) {
		Map map = mesh.map();
		map.evaluate(mesh.u());
		const Triangulation& t = map.triangulation();
		const VertexArray<char> boundary = t.boundaryVertices();
		VertexVector defect(t.vertexCount());
		for (const Vertex v : t.vertices())
			defect[v] = boundary[v] ? kPi : 2 * kPi;
		for (const Halfedge h : t.halfedges()) {
			if (t.isExterior(h)) {
				EXPECT_EQ(map.angles()[h], 0.0);
			}
			defect[t.origin(h)] -= map.angles()[h];
		}
		EXPECT_LT((map.curvature() - defect).lpNorm<Eigen::Infinity>(), 1e-14);
	}
}

TEST(CurvatureMap, KnownCurvatures)
{
	Packed tetra(tetrahedron());
	Map map = tetra.map();
	map.evaluate(tetra.u());
	for (double K : map.curvature())
		EXPECT_NEAR(K, kPi, 1e-14);
	// The skin of a cube: pi/2 at 8 corners, 0 elsewhere (the slab 1 x 3 x 1 of genus 0).
	const SurfaceMesh slab = perforatedSlab(0, 1);
	const Packed packed(slab);
	Map flat = packed.map();
	flat.evaluate(packed.u());
	for (const Vertex v : packed.triangulation.vertices()) {
		const double y = slab.positions[at(v)][1];
		const bool corner = y == 0.0 || y == 3.0;
		EXPECT_NEAR(flat.curvature()[v], corner ? kPi / 2 : 0.0, 1e-14);
	}
}

TEST(CurvatureMap, GaussBonnet)
{
	Random random(42);
	for (const Packed& mesh : surfaces()) {
		Map map = mesh.map();
		for (double spread : {0.0, 0.1, 1.0, 5.0}) { // broken triangles keep the angle sum pi
			map.evaluate(disturbed(mesh.u(), spread, random));
			EXPECT_NEAR(
				map.curvature().sum(), 2 * kPi * map.triangulation().eulerCharacteristic(), 1e-10);
		}
	}
}

double curvatureSum(const SurfaceMesh& mesh)
{
	const Packed packed(mesh);
	Map map = packed.map();
	map.evaluate(packed.u());
	long double sum = 0.0L;
	for (double K : map.curvature())
		sum += K;
	return static_cast<double>(sum);
}

TEST(CurvatureMap, TheLowPartOfPiIsNotLostOnTheBoundary)
{
	// Left out or taken back, what a double of pi lacks would add up to 1e-12 and more over so many
	// boundary vertices; the rounding of their angles cancels in the sum but for its root.
	Random random(47);
	const int n = 10000;
	SurfaceMesh ring = grid(1, n, Ends::Open, Ends::Joined, [&](int i, int j) {
		const double a = 2 * kPi * (j + random.real(-0.2, 0.2)) / n;
		const double r = 1.0 + 2 * kPi / n * (i + random.real(-0.2, 0.2));
		return Point3{r * std::cos(a), r * std::sin(a), 0.0};
	});
	EXPECT_LT(std::abs(curvatureSum(ring)), 5e-13);
}

TEST(CurvatureMap, TheLowPartOfPiIsNotLostInside)
{
	Random random(48);
	EXPECT_LT(std::abs(curvatureSum(bumpyTorus(120, 100, random))), 1e-12); // left out: 2.9e-12
}

TEST(CurvatureMap, ScaleChangesLengthsAndNothingElse)
{
	for (const Packed& mesh : surfaces()) {
		Map original = mesh.map(), other = mesh.map();
		original.evaluate(mesh.u());
		const double shift = 3.0 * std::log(10.0);
		other.evaluate((mesh.u().array() + shift).matrix());
		for (const Edge e : original.lengths().indices())
			EXPECT_NEAR(other.lengths()[e] / original.lengths()[e], 1000.0, 1e-11);
		const double amplification = 100 * kEpsilon * original.needleRatio();
		for (const Halfedge h : original.angles().indices())
			EXPECT_NEAR(other.angles()[h], original.angles()[h], 1e-12 + amplification);
		EXPECT_TRUE(original.scaleInvariant());
	}
}

TEST(CurvatureMap, BrokenTrianglesHaveTheAnglesPiZeroZeroAndNoDerivative)
{
	Random random(43);
	int broken = 0, checked = 0;
	for (const Packed& mesh : surfaces()) {
		Map map = mesh.map();
		const VertexVector u = disturbed(mesh.u(), 3.0, random);
		map.evaluate(u);
		const Triangulation& t = map.triangulation();
		FaceArray<char> weighed(t.faceCount(), 1);
		int count = 0;
		for (const Face f : t.faces()) {
			const auto h = t.halfedges(f);
			std::array<double, 3> l, angle;
			for (std::size_t k = 0; k < 3; ++k) {
				l[k] = map.lengths()[h[k].edge()];
				angle[k] = map.angles()[h[k]];
			}
			const std::size_t longest =
				static_cast<std::size_t>(std::max_element(l.begin(), l.end()) - l.begin());
			const double slack = l[0] + l[1] + l[2] - 2 * l[longest];
			if (std::abs(slack) < 1e-12 * l[longest])
				continue;
			++checked;
			EXPECT_NEAR(angle[0] + angle[1] + angle[2], kPi, 1e-14);
			if (slack > 0) {
				EXPECT_LT(*std::max_element(angle.begin(), angle.end()), kPi);
				continue;
			}
			++count;
			EXPECT_EQ(angle[(longest + 2) % 3], kPi);
			weighed[f] = 0;
			EXPECT_EQ(angle[longest], 0.0);
			EXPECT_EQ(angle[(longest + 1) % 3], 0.0);
		}
		EXPECT_EQ(map.brokenTriangles(), count);
		broken += count;
		const auto hasWeight = [&](Halfedge h) { return !t.isExterior(h) && weighed[t.face(h)]; };
		for (const Edge e : t.edges())
			if (!hasWeight(e.halfedge()) && !hasWeight(e.halfedge().twin())) {
				EXPECT_EQ(map.weights()[e], 0.0);
			}
	}
	EXPECT_GT(broken, 100);
	EXPECT_GT(checked, 1000);
}

TEST(CurvatureMap, CurvatureIsContinuousWhereATriangleBreaks)
{
	// Equilateral triangle of touching circles with delta = 2 on one edge: growing that edge's ends
	// breaks it. Angles approach pi and 0 like the square root of the distance to the break.
	const Triangulation t(3, {{0, 1, 2}});
	CirclePacking packing{t, {0.0, 0.0, 0.0}};
	for (const Edge e : t.edges())
		if (t.origin(e.halfedge()) != Vertex(2) && t.target(e.halfedge()) != Vertex(2))
			packing.delta[e] = 2.0;
	Map map(packing);
	const auto brokenAt = [&](double x) {
		VertexVector u(3);
		u << x, x, 0.0;
		map.evaluate(u);
		return map.brokenTriangles() == 1;
	};
	double whole = 0.0, broken = 5.0;
	ASSERT_FALSE(brokenAt(whole));
	ASSERT_TRUE(brokenAt(broken));
	while (broken - whole > 1e-14) {
		const double middle = 0.5 * (whole + broken);
		(brokenAt(middle) ? broken : whole) = middle;
	}
	// Radii g, g, 1 and sides sqrt(8) g, g + 1, g + 1.
	EXPECT_NEAR(std::exp(broken), 1.0 + std::sqrt(2.0), 1e-12);
	double previous = 0.0;
	for (int k = 3; k <= 9; ++k) {
		VertexVector u(3);
		u << broken - std::pow(10.0, -k), broken - std::pow(10.0, -k), 0.0;
		map.evaluate(u);
		ASSERT_EQ(map.brokenTriangles(), 0);
		const double defect = map.curvature()[Vertex(2)]; // pi less an angle that is not yet pi
		EXPECT_GT(defect, 0.0);
		if (k > 3) {
			EXPECT_NEAR(previous / defect, std::sqrt(10.0), 0.02);
		}
		previous = defect;
	}
	EXPECT_TRUE(brokenAt(broken + 1e-9));
	// The angle pi is the double next to it.
	EXPECT_NEAR(map.curvature()[Vertex(2)], 0.0, std::numeric_limits<double>::epsilon());
	EXPECT_EQ(map.curvature()[Vertex(0)], kPi);
	EXPECT_EQ(map.curvature()[Vertex(1)], kPi);
}

TEST(CurvatureMap, GradientIsMonotone)
{
	// The energy is convex on all of R^n if and only if (K(u) - K(v)) (u - v) >= 0 everywhere,
	// broken triangles included.
	Random random(44);
	int brokenPairs = 0;
	for (const Packed& mesh : surfaces()) {
		Map map = mesh.map();
		for (int trial = 0; trial < 200; ++trial) {
			const double spread = std::pow(10.0, random.real(-2, 1));
			const VertexVector u = disturbed(mesh.u(), spread, random);
			const VertexVector v = disturbed(u, spread, random);
			map.evaluate(u);
			brokenPairs += map.brokenTriangles() > 0;
			const VertexVector Ku = map.curvature();
			map.evaluate(v);
			const double rounding = 1e-12 * map.needleRatio() * (u - v).lpNorm<1>();
			EXPECT_GE((Ku - map.curvature()).dot(u - v), -rounding);
		}
	}
	EXPECT_GT(brokenPairs, 300);
}

TEST(CurvatureMap, NeedleRatioIsTheLargestQuotientOfTwoSides)
{
	for (const Packed& mesh : surfaces()) {
		Map map = mesh.map();
		map.evaluate(mesh.u());
		double largest = 1.0;
		for (const Face f : mesh.triangulation.faces())
			for (const Halfedge g : mesh.triangulation.halfedges(f))
				for (const Halfedge h : mesh.triangulation.halfedges(f))
					largest = std::max(largest, mesh.lengths[g.edge()] / mesh.lengths[h.edge()]);
		EXPECT_NEAR(map.needleRatio() / largest, 1.0, 1e-13);
	}
}

TEST(CurvatureMap, SwapEdgeChangesTheConnectivityAndTheRevision)
{
	Packed mesh(rectangle(1, 1, 1, 1));
	Map map = mesh.map();
	const int before = map.revision();
	Edge e(0);
	while (!mesh.triangulation.isFlippable(e))
		e = Edge(e.number() + 1);
	map.swapEdge(e, 0.75);
	EXPECT_NE(map.revision(), before);
	EXPECT_EQ(map.delta()[e], 0.75);
	Triangulation expected = mesh.triangulation;
	expected.flip(e);
	for (const Halfedge h : expected.halfedges())
		EXPECT_EQ(map.triangulation().next(h), expected.next(h));
}

TEST(CurvatureMap, NumberOfThreadsChangesNoBit)
{
	// Large enough for several parts, and so far from the start that edges flip.
	Random random(90);
	const Packed mesh(bumpyTorus(300, 150, random));
	const VertexVector u = disturbed(mesh.u(), 0.3, random);
	const auto evaluated = [&](int threads) {
		FlippingCurvatureMap<Euclidean> map(mesh.packing);
		map.useThreads(threads);
		map.evaluate(u);
		map.accept();
		return map;
	};
	const auto one = evaluated(1);
	EXPECT_GT(one.flips().size(), 1000u);
	for (int threads : {2, 3, 5}) {
		const auto several = evaluated(threads);
		EXPECT_EQ(several.flips(), one.flips());
		EXPECT_EQ(several.curvature(), one.curvature());
		EXPECT_EQ(several.weights(), one.weights());
		EXPECT_EQ(several.angles(), one.angles());
		EXPECT_EQ(several.lengths(), one.lengths());
		EXPECT_EQ(several.needleRatio(), one.needleRatio());
	}
}

} // namespace
} // namespace ricci::testing
