// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/random_surface.h"

#include <ricci/layout/planar_layout.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace ricci::testing {
namespace {

/// Units of rounding that the direction of an edge loses: the longest side of its triangles over it.
double loss(const Triangulation& t, const EdgeArray<double>& lengths, Edge e)
{
	double longest = 0.0;
	for (const Halfedge h : {e.halfedge(), e.halfedge().twin()})
		for (const Halfedge side : t.halfedges(t.face(h)))
			longest = std::max(longest, lengths[side.edge()]);
	return longest / lengths[e];
}

/// The least loss on a way from the root to every triangle is relaxed edge by edge until nothing changes
/// (Bellman and Ford).
TEST(LayoutTree, ReachesEveryTriangleByTheWayThatLosesLeast)
{
	constexpr double kNever = std::numeric_limits<double>::infinity();
	Random random(840);
	int unreached = 0;
	std::vector<SurfaceMesh> meshes = surfacesOfEveryKind(random);
	// A spoke of a wheel is short: its two triangles are neighbours, but directions keep more digits on the way
	// round the hub through all others.
	meshes.push_back(fan(6, 0.0));
	meshes.back().positions[0] = {0.001, 0.0, 0.0};
	for (const SurfaceMesh& mesh : meshes)
		for (double share : {0.0, 0.2, 0.6}) {
			const IntrinsicMesh metric = intrinsicMesh(mesh);
			const Triangulation& t = metric.triangulation;
			EdgeArray<char> isCut(t.edgeCount(), 0);
			for (char& cut : isCut)
				cut = random.real(0.0, 1.0) < share;
			const Face root(random.index(t.faceCount()));
			FaceArray<double> least(t.faceCount(), kNever), lost = least;
			least[root] = lost[root] = 0.0;
			for (bool changed = true; changed;) {
				changed = false;
				for (const Edge e : t.edges())
					for (const Halfedge h : {e.halfedge(), e.halfedge().twin()})
						if (!isCut[e] && !t.isBoundary(e)) {
							const double way = least[t.face(h)] + loss(t, metric.lengths, e);
							double& known = least[t.face(h.twin())];
							changed |= way < known * (1.0 - 1e-12);
							known = std::min(known, way);
						}
			}
			const std::vector<Halfedge> order = layoutTree(t, metric.lengths, isCut, root);
			for (const Halfedge h : order) {
				EXPECT_FALSE(isCut[h.edge()]);
				ASSERT_FALSE(t.isBoundary(h.edge()));
				EXPECT_EQ(lost[t.face(h)], kNever);        // each once
				ASSERT_LT(lost[t.face(h.twin())], kNever); // from one that is reached
				lost[t.face(h)] = lost[t.face(h.twin())] + loss(t, metric.lengths, h.edge());
			}
			for (const Face f : t.faces()) {
				unreached += least[f] == kNever;
				if (least[f] == kNever)
					EXPECT_EQ(lost[f], kNever);
				else
					EXPECT_NEAR(lost[f], least[f], 1e-12 * (1.0 + least[f]));
			}
			EdgeArray<double> larger = metric.lengths;
			for (double& length : larger)
				length *= 0x1p40;
			EXPECT_EQ(layoutTree(t, larger, isCut, root), order);
		}
	EXPECT_GT(unreached, 100); // random cuts isolate triangles
}

} // namespace
} // namespace ricci::testing
