// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/metric/conformal_flip.h>

#include <gtest/gtest.h>

namespace ricci::testing {
namespace {

TEST(CirclePacking, ThurstonClampsTheInversiveDistance)
{
	// Equilateral triangle: I = 1 / (2 r^2) - 1 for circles of equal radius r.
	const Triangulation t(3, {{0, 1, 2}});
	for (const double r : {0.4, 0.5, 0.6, 0.7, 0.8}) {
		const double clamped = std::clamp(0.5 / (r * r) - 1.0, 0.0, 1.0);
		for (const double delta : thurstonDistancesLessOne(t, {1, 1, 1}, {r, r, r}))
			EXPECT_NEAR(1.0 + delta, clamped, 1e-15);
	}
}

/// Sides of length 1, and as wound round a torus of this \p height so many \p turns.
IntrinsicMesh wound(double turns, double height)
{
	IntrinsicMesh mesh{oneVertexTorus(), EdgeArray<double>(3)};
	const auto h = mesh.triangulation.halfedges(Face(0));
	mesh.lengths[h[0].edge()] = 1.0;
	mesh.lengths[h[1].edge()] = std::hypot(turns, height);
	mesh.lengths[h[2].edge()] = std::hypot(turns + 1.0, height);
	return mesh;
}

TEST(DelaunayPacking, UnwindsANeedleOfManyTurns)
{
	// A torus of one vertex, 1 by 30, whose triangles are wound round it: every flip takes one turn off,
	// however few edges there are.
	for (const double turns : {10.0, 1000.0, 20000.0}) {
		const auto start = delaunayPacking(wound(turns, 30.0), {});
		EXPECT_EQ(start.lengthened.largest, 0.0);
		EXPECT_GE(start.flips.size(), static_cast<std::size_t>(turns) - 1);
		std::vector<double> lengths = start.mesh.lengths.values();
		std::sort(lengths.begin(), lengths.end());
		EXPECT_NEAR(lengths[0], 1.0, 1e-4);
		EXPECT_NEAR(lengths[1], 30.0, 1e-2);
		EXPECT_NEAR(lengths[2], std::hypot(1.0, 30.0), 1e-2);
	}
	for (const double length : {std::nan(""), HUGE_VAL})
		EXPECT_THROW(delaunayPacking({oneVertexTorus(), {1.0, length, 1.0}}, {}), InternalError);
}

/// Sum of the two sides at the origin of h less the third.
double excessAt(const Triangulation& t, const EdgeArray<double>& lengths, Halfedge h)
{
	const double next = lengths[t.next(h).edge()], own = lengths[h.edge()];
	return (own - next) + lengths[t.previous(h).edge()];
}

/// What mollify() does to lengths: every corner then has the excess it had and twice what its vertex got, and
/// edges what their ends got.
struct Mollified
{
	Triangulation t;
	EdgeArray<double> before, after;
	Lengthening added;

	Mollified(const Triangulation& triangulation, const EdgeArray<double>& lengths) :
			t(triangulation), before(lengths), after(lengths), added(mollify(t, after))
	{
		double largest = 0.0;
		for (const Edge e : t.edges()) {
			EXPECT_EQ(after[e], added.lengthOf(t, e, before[e]));
			largest = std::max(largest, (after[e] - before[e]) / after[e]);
		}
		EXPECT_EQ(added.largest, largest);
		for (const Face f : t.faces())
			for (const Halfedge h : t.halfedges(f)) {
				const double sides = after[h.edge()] + after[t.previous(h).edge()];
				const double excess = excessAt(t, before, h) + 2 * addedAt(t.origin(h));
				EXPECT_NEAR(excessAt(t, after, h), excess, 1e-15 * sides);
				EXPECT_GT(excessAt(t, after, h), 1e-12 * sides);
			}
	}
	explicit Mollified(const SurfaceMesh& mesh) :
			Mollified(glued(mesh), edgeLengths(glued(mesh), mesh))
	{
	}

	double addedAt(Vertex v) const { return added.atVertex.empty() ? 0.0 : added.atVertex[v]; }
};

/// Of one triangle.
Mollified mollified(const std::array<double, 3>& sides)
{
	const Triangulation t(3, {{0, 1, 2}});
	EdgeArray<double> lengths(3);
	for (std::size_t k = 0; k < 3; ++k)
		lengths[t.halfedges(Face(0))[k].edge()] = sides[k];
	return {t, lengths};
}

TEST(Mollify, GivesATriangleTheExcessThatIsMissing)
{
	// Needles: two sides longer than the third by 2e-7, by nothing, and shorter by 1e-3. Both corners at the
	// short side get an excess of 1e-4 of the longest where they have less, the third nothing.
	const auto corners = Triangulation(3, {{0, 1, 2}}).halfedges(Face(0));
	for (const double third : {1.0 - 3e-7, 1.0 - 5e-7, 0.999 - 5e-7}) {
		const Mollified m = mollified({1.0, third, 5e-7});
		EXPECT_NEAR(excessAt(m.t, m.after, corners[0]), std::max(1e-4, 1.0 - third + 5e-7), 1e-15);
		EXPECT_EQ(m.addedAt(m.t.origin(corners[1])), 0.0);
		EXPECT_NEAR(excessAt(m.t, m.after, corners[2]), 1e-4, 1e-15);
	}
	// 1e-5 of the shorter side at a flat corner, however long the others are; no other corner changes.
	for (const double shorter : {0.5, 1e-3, 1e-5})
		for (const double excess : {0.0, -1e-6}) {
			const Mollified m = mollified({1.0, 1.0 - shorter, shorter + excess});
			const double wanted = 1e-5 * std::min(1 - shorter, shorter + excess);
			EXPECT_NEAR(excessAt(m.t, m.after, corners[2]), wanted, 1e-15);
			EXPECT_EQ(m.addedAt(m.t.origin(corners[0])), 0.0);
			EXPECT_EQ(m.addedAt(m.t.origin(corners[1])), 0.0);
		}
}

TEST(Mollify, VerticesAtOnePlaceGetTheSame)
{
	SurfaceMesh mesh = rectangle(12, 12, 1, 1);
	const auto isOne = [](int v) { return v % 13 > 3 && v % 13 < 9 && v / 13 > 3 && v / 13 < 9; };
	for (int v = 0; v < 13 * 13; ++v)
		if (isOne(v))
			mesh.positions[at(v)] = {0.5, 0.5, 0.0};
	const Mollified m(mesh);
	const double there = m.addedAt(Vertex(6 * 13 + 6));
	EXPECT_GT(there, 0.0);
	for (const Vertex v : m.t.vertices())
		EXPECT_TRUE(!isOne(v.number()) || m.addedAt(v) == there);
}

} // namespace
} // namespace ricci::testing
