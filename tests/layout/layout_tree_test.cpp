// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/layout/planar_layout.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace ricci::testing {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Units of rounding that the direction of an edge loses: the longest side of its triangles over it.
double loss(const Triangulation& t, const EdgeArray<double>& lengths, Edge e)
{
	double longest = 0.0;
	for (const Halfedge h : {e.halfedge(), e.halfedge().twin()})
		for (const Halfedge side : t.halfedges(t.face(h)))
			longest = std::max(longest, lengths[side.edge()]);
	return longest / lengths[e];
}

/// Least loss on a way from the root to every triangle, infinite where there is none: relaxed edge by
/// edge until nothing changes (Bellman and Ford).
FaceArray<double> minLoss(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const EdgeArray<char>& isCut,
	Face root)
{
	FaceArray<double> least(t.faceCount(), kNever);
	least[root] = 0.0;
	for (bool changed = true; changed;) {
		changed = false;
		for (const Edge e : t.edges()) {
			if (isCut[e] || t.isBoundary(e))
				continue;
			for (const Halfedge h : {e.halfedge(), e.halfedge().twin()}) {
				const double way = least[t.face(h)] + loss(t, lengths, e);
				double& known = least[t.face(h.twin())];
				changed |= way < known * (1.0 - 1e-12);
				known = std::min(known, way);
			}
		}
	}
	return least;
}

TEST(LayoutTree, ReachesEveryTriangleByTheWayThatLosesLeast)
{
	Random random(840);
	int unreached = 0;
	for (const SurfaceMesh& mesh : surfacesOfEveryKind(random))
		for (double share : {0.0, 0.2, 0.6}) {
			const IntrinsicMesh metric = intrinsicMesh(mesh);
			const Triangulation& t = metric.triangulation;
			EdgeArray<char> isCut(t.edgeCount(), 0);
			for (char& cut : isCut)
				cut = random.real(0.0, 1.0) < share;
			const Face root(random.index(t.faceCount()));
			const FaceArray<double> least = minLoss(t, metric.lengths, isCut, root);
			FaceArray<double> lost(t.faceCount(), kNever);
			lost[root] = 0.0;
			for (const Halfedge h : layoutTree(t, metric.lengths, isCut, root)) {
				EXPECT_FALSE(isCut[h.edge()]);
				ASSERT_FALSE(t.isBoundary(h.edge()));
				EXPECT_EQ(lost[t.face(h)], kNever);        // each once
				ASSERT_LT(lost[t.face(h.twin())], kNever); // from one that is reached
				lost[t.face(h)] = lost[t.face(h.twin())] + loss(t, metric.lengths, h.edge());
			}
			for (const Face f : t.faces())
				if (least[f] == kNever) {
					EXPECT_EQ(lost[f], kNever);
					++unreached;
				}
				else
					EXPECT_NEAR(lost[f], least[f], 1e-12 * (1.0 + least[f]));
		}
	EXPECT_GT(unreached, 100); // random cuts isolate triangles
}

/// A spoke of a wheel is short: its two triangles are neighbours, but directions keep more digits on
/// the way round the hub through all others.
TEST(LayoutTree, GoesRoundAShortEdge)
{
	SurfaceMesh mesh = fan(6, 0.0);
	mesh.positions[0] = {0.001, 0.0, 0.0};
	const IntrinsicMesh metric = intrinsicMesh(mesh);
	const Triangulation& t = metric.triangulation;
	const EdgeArray<char> noCut(t.edgeCount(), 0);
	for (const Face root : t.faces()) {
		const auto order = layoutTree(t, metric.lengths, noCut, root);
		ASSERT_EQ(order.size(), 5u);
		for (const Halfedge h : order)
			EXPECT_GT(metric.lengths[h.edge()], 0.1);
	}
}

TEST(LayoutTree, DoesNotDependOnTheScale)
{
	Random random(841);
	const IntrinsicMesh metric = intrinsicMesh(bumpyTorus(9, 7, random));
	const Triangulation& t = metric.triangulation;
	const EdgeArray<char> isCut(t.edgeCount(), 0);
	EdgeArray<double> scaled = metric.lengths;
	for (double& length : scaled)
		length *= 0x1p40;
	EXPECT_EQ(layoutTree(t, scaled, isCut, Face(5)), layoutTree(t, metric.lengths, isCut, Face(5)));
}

} // namespace
} // namespace ricci::testing
