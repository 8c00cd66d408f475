// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flat_meshes.h"
#include "support/intrinsic.h"
#include "support/random_surface.h"

#include <ricci/layout/flat_mesh.h>
#include <ricci/layout/planar_layout.h>
#include <ricci/mesh/sides.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace ricci::testing {
namespace {

constexpr int kSide = 4;

/// A square whose upper half lies elsewhere.
FlatMesh withSeam(const Point2& shift)
{
	const SurfaceMesh mesh = rectangle(kSide, kSide, 1.0, 1.0);
	std::vector<Triangle2> plane = flatMesh(mesh).corners().values();
	for (Triangle2& t : plane)
		if (std::any_of(t.begin(), t.end(), [](const Point2& p) { return p[1] > 0.5; }))
			for (Point2& p : t)
				p += shift;
	return flatMesh(mesh, plane);
}

TEST(FlatMesh, IsJoinedWhereSidesLieOnEachOther)
{
	for (const double shift : {0.0, 2.0}) {
		const FlatMesh mesh = withSeam({shift, 0.0});
		const int seamEdges = shift > 0.0 ? kSide : 0;
		EXPECT_EQ(mesh.place.size(), (kSide + 1) * (kSide + 1 + (shift > 0.0)));
		const Sides sides(mesh.vertices.values());
		int open = 0;
		for (const Corner side : mesh.across.indices()) {
			const Corner other = mesh.across[side], joined = mesh.joined(side);
			EXPECT_EQ(other, sides.across(side));
			if (!other.isValid()) {
				EXPECT_FALSE(joined.isValid());
				continue;
			}
			EXPECT_EQ(mesh.joined(other), joined.isValid() ? side : Corner());
			open += other > side && joined != other;
		}
		EXPECT_EQ(open, seamEdges);
		EXPECT_EQ(seams(mesh).edges.size(), at(seamEdges));
		EXPECT_NEAR(seams(mesh).length, shift > 0.0 ? 1.0 : 0.0, 1e-14);
	}
}

TEST(FlatMesh, SplitPointsBelongToOneChartAndOneFan)
{
	FlatMesh mesh = withSeam({0.0, 0.0});
	const Array<Triangle2> before = mesh.corners();
	for (const int f : mesh.chart.indices())
		mesh.chart[f] = f % 2;
	splitPoints(mesh);
	EXPECT_EQ(mesh.corners(), before);
	// Triangles of one kind meet in points alone.
	EXPECT_EQ(mesh.place.size(), 3 * mesh.size());
	const Array<int> chart = mesh.chartOfPoints();
	for (const int f : mesh.points.indices())
		for (const int p : mesh.points[f])
			EXPECT_EQ(chart[p], mesh.chart[f]);
}

/// A chart that is cut in two: the points of the other stay, those along the cut are two.
TEST(FlatMesh, PointsOfSomeTrianglesAreSplitAsThoseOfAll)
{
	Random random(77);
	for (int trial = 0; trial < 50; ++trial) {
		FlatMesh mesh = withSeam({2.0, 0.0});
		mesh.chart.assign(mesh.size(), random.index(2));
		std::vector<int> all(at(mesh.size()));
		std::iota(all.begin(), all.end(), 0);
		for (const int f : all)
			if (random.index(4) == 0)
				mesh.chart[f] = 2;
		FlatMesh some = mesh;
		splitPoints(mesh);
		splitPoints(all, some);
		EXPECT_EQ(some.corners(), mesh.corners());
		ASSERT_EQ(some.place.size(), mesh.place.size());
		Array<int> pointOf(mesh.place.size(), -1);
		for (const int f : all)
			for (const Corner c : cornersOf(f)) {
				int& point = pointOf[mesh.points[c]];
				EXPECT_TRUE(point < 0 || point == some.points[c]);
				point = some.points[c];
			}
	}
}

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
