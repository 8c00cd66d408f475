// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/cut/cut_segments.h>
#include <ricci/layout/planar_layout.h>
#include <ricci/math/disjoint_sets.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <vector>

namespace ricci::testing {
namespace {

/// A torus of 7 columns and 5 rows of vertices, cut along a column and a row. Vertex 5 i + j lies
/// in column i and row j.
struct CrossedTorus
{
	Triangulation t = glued(torus(3, 1, 7, 5));
	VertexArray<char> marked = VertexArray<char>(t.vertexCount(), 0);
	EdgeArray<double> cost = EdgeArray<double>(t.edgeCount(), 1.0);
	EdgeArray<char> isCut = EdgeArray<char>(t.edgeCount(), 0);
	std::set<Edge> column, row;
	Vertex node = Vertex(13); // where they cross

	CrossedTorus()
	{
		for (const Edge e : t.edges()) {
			const int a = t.ends(e)[0].number(), b = t.ends(e)[1].number();
			if (a / 5 == 2 && b / 5 == 2)
				column.insert(e);
			if (a % 5 == 3 && b % 5 == 3)
				row.insert(e);
			isCut[e] = column.count(e) + row.count(e) > 0;
		}
	}

	CutSegments cut() { return CutSegments(t, cost, marked, isCut); }
};

std::set<Edge> setOf(const std::vector<Edge>& edges)
{
	return std::set<Edge>(edges.begin(), edges.end());
}

TEST(CutSegments, RunFromNodeToNode)
{
	CrossedTorus torus;
	CutSegments cut = torus.cut();
	EXPECT_EQ(cut.degree(torus.node), 4);
	EXPECT_EQ(cut.branchNodes(), std::vector<Vertex>{torus.node});
	const std::vector<Edge> segments = cut.segments();
	ASSERT_EQ(segments.size(), 2u);
	std::set<std::set<Edge>> found;
	for (const Edge e : segments) {
		const std::vector<Edge> edges = cut.segmentOf(e);
		found.insert(setOf(edges));
		EXPECT_EQ(setOf(edges).size(), edges.size());
	}
	EXPECT_EQ(found, (std::set<std::set<Edge>>{torus.column, torus.row}));
	const CutSegments::Star star = cut.starOf(torus.node);
	EXPECT_TRUE(star.hasLoop);
	EXPECT_EQ(star.segments, 4);
	EXPECT_EQ(setOf(star.edges).size(), torus.column.size() + torus.row.size());
	EXPECT_EQ(cut.labelCircles(), 1); // the opened torus is a disk

	// A mark divides a segment.
	torus.marked[Vertex(11)] = 1;
	CutSegments marked = torus.cut();
	EXPECT_EQ(marked.segments().size(), 3u);
	EXPECT_FALSE(marked.starOf(Vertex(11)).hasLoop);
	EXPECT_EQ(setOf(marked.starOf(Vertex(11)).edges), torus.column);
}

TEST(CutSegments, RemovingAnEdgeRemovesItsDeadEnds)
{
	CrossedTorus torus;
	const EdgeArray<char> before = torus.isCut;
	CutSegments cut = torus.cut();
	const std::vector<Edge> removed = cut.removeWithDeadEnds({*torus.column.begin()});
	EXPECT_EQ(setOf(removed), torus.column);
	for (const Edge e : torus.t.edges())
		EXPECT_EQ(torus.isCut[e] != 0, torus.row.count(e) > 0);
	// What is left has no node and opens the torus to an annulus.
	EXPECT_EQ(cut.segments().size(), 1u);
	EXPECT_EQ(setOf(cut.segmentOf(*torus.row.begin())), torus.row);
	EXPECT_TRUE(cut.branchNodes().empty());
	EXPECT_EQ(cut.labelCircles(), 2);
	cut.add(removed);
	EXPECT_EQ(torus.isCut, before);
	EXPECT_EQ(cut.labelCircles(), 1);

	// Dead ends with a mark stay: of the column 10, 11, ..., 14 the part from 11 to the node 13.
	torus.marked[Vertex(11)] = 1;
	CutSegments marked = torus.cut();
	EXPECT_EQ(
		setOf(marked.removeWithDeadEnds({edgeBetween(torus.t, Vertex(10), Vertex(11))})),
		(std::set<Edge>{
			edgeBetween(torus.t, Vertex(10), Vertex(11)),
			edgeBetween(torus.t, Vertex(10), Vertex(14)),
			edgeBetween(torus.t, Vertex(13), Vertex(14))}));
	EXPECT_EQ(marked.degree(Vertex(11)), 1);
	EXPECT_EQ(marked.labelCircles(), 2);
}

/// Numbers of the circles by the wedges into which the cut divides the corners, an independent way.
struct CirclesByWedges
{
	std::vector<int> ofWedge; // a representative; -1: no border there
	int count = 0;

	CirclesByWedges(
		const Triangulation& t, const VertexArray<char>& marked, const EdgeArray<char>& isCut)
	{
		const PlanarLayout wedges = cornerWedges(t, isCut);
		const VertexArray<char> boundary = t.boundaryVertices();
		VertexArray<int> degree(t.vertexCount(), 0);
		for (const Halfedge h : t.halfedges())
			degree[t.origin(h)] += isCut[h.edge()];
		// A border side joins the wedges at its two ends.
		DisjointSets joined(wedges.points.size());
		std::vector<char> isBorder(at(wedges.points.size()), 0);
		for (const Halfedge h : t.interiorHalfedges()) {
			const int wedge = wedges.wedge[h];
			if (isCut[h.edge()] || t.isBoundary(h.edge())) {
				const int next = wedges.wedge[t.next(h)];
				joined.merge(wedge, next);
				isBorder[at(wedge)] = isBorder[at(next)] = 1;
			}
			const Vertex v = t.origin(h);
			if (marked[v] && degree[v] == 0 && !boundary[v])
				isBorder[at(wedge)] = 1;
		}
		std::set<int> circles;
		for (int w = 0; w < wedges.points.size(); ++w) {
			ofWedge.push_back(isBorder[at(w)] ? joined.find(w) : -1);
			if (isBorder[at(w)])
				circles.insert(joined.find(w));
		}
		count = static_cast<int>(circles.size());
		of = wedges.wedge;
	}

	int circle(Halfedge h) const { return ofWedge[at(of[h])]; }

private:
	HalfedgeArray<int> of;
};

/// The same halfedges leave the same circles.
void expectCircles(const Triangulation& t, const CutSegments& cut, const CirclesByWedges& expected)
{
	std::map<int, int> there, back;
	for (const Halfedge h : t.interiorHalfedges()) {
		const int found = cut.circle(h), wanted = expected.circle(h);
		ASSERT_EQ(found < 0, wanted < 0);
		if (found < 0)
			continue;
		EXPECT_LT(found, expected.count);
		EXPECT_EQ(there.try_emplace(found, wanted).first->second, wanted);
		EXPECT_EQ(back.try_emplace(wanted, found).first->second, found);
	}
}

/// 1 at so many vertices.
VertexArray<char> someVertices(const Triangulation& t, double share, Random& random)
{
	VertexArray<char> marked(t.vertexCount(), 0);
	for (char& mark : marked)
		mark = random.real(0.0, 1.0) < share;
	return marked;
}

/// 1 at so many edges inside.
EdgeArray<char> someEdges(const Triangulation& t, double share, Random& random)
{
	EdgeArray<char> isCut(t.edgeCount(), 0);
	for (const Edge e : t.edges())
		isCut[e] = !t.isBoundary(e) && random.real(0.0, 1.0) < share;
	return isCut;
}

TEST(CutSegments, CirclesAreTheBoundariesOfTheOpenedSurface)
{
	Random random(780);
	for (const SurfaceMesh& mesh : surfacesOfEveryKind(random)) {
		const Triangulation t = glued(mesh);
		for (double share : {0.0, 0.02, 0.2, 0.6}) {
			const VertexArray<char> marked = someVertices(t, 0.05, random);
			EdgeArray<char> isCut = someEdges(t, share, random);
			const EdgeArray<double> cost(t.edgeCount(), 1.0);
			CutSegments cut(t, cost, marked, isCut);
			const CirclesByWedges expected(t, marked, isCut);
			for (int again = 0; again < 2; ++again)
				EXPECT_EQ(cut.labelCircles(), expected.count);
			expectCircles(t, cut, expected);
			// Once along every side of the border, each followed by the next one of its circle.
			int sides = 0;
			for (const Halfedge h : t.interiorHalfedges())
				if (isCut[h.edge()] || t.isBoundary(h.edge())) {
					++sides;
					EXPECT_EQ(cut.sides()[at(cut.place(h))], h);
				}
			EXPECT_EQ(cut.sides().size(), at(sides));
		}
	}
}

/// What becomes of the circles without some edges is known from those with them, again and again.
TEST(CutSegments, SplitCirclesAreTheBoundariesWithoutWhatWasRemoved)
{
	Random random(782);
	for (const SurfaceMesh& mesh : surfacesOfEveryKind(random)) {
		const Triangulation t = glued(mesh);
		for (double share : {0.02, 0.2, 0.6}) {
			const VertexArray<char> marked = someVertices(t, 0.1, random);
			EdgeArray<char> isCut = someEdges(t, share, random);
			const EdgeArray<double> cost(t.edgeCount(), 1.0);
			CutSegments cut(t, cost, marked, isCut);
			cut.labelCircles();
			for (double part : {0.0, 0.1, 0.5, 1.0}) {
				std::vector<Edge> removed;
				for (const Edge e : t.edges())
					if (isCut[e] && random.real(0.0, 1.0) < part)
						removed.push_back(e);
				cut.remove(removed);
				const CirclesByWedges expected(t, marked, isCut);
				EXPECT_EQ(cut.splitCircles(removed), expected.count);
				expectCircles(t, cut, expected);
				cut.add(removed);
			}
		}
	}
}

/// Changes one after another: the circles are those that independent wedges tell, with and without edges that
/// are taken out for a while, and every side is in one place.
TEST(CutSegments, UpdatedCirclesAreTheBoundariesAfterEveryChange)
{
	Random random(783);
	for (const SurfaceMesh& mesh : surfacesOfEveryKind(random)) {
		const Triangulation t = glued(mesh);
		const VertexArray<char> marked = someVertices(t, 0.1, random);
		EdgeArray<char> isCut = someEdges(t, 0.2, random);
		const EdgeArray<double> cost(t.edgeCount(), 1.0);
		CutSegments cut(t, cost, marked, isCut);
		cut.labelCircles();
		const auto some = [&](bool areCut, double share) {
			std::vector<Edge> edges;
			for (const Edge e : t.edges())
				if (!t.isBoundary(e) && (isCut[e] != 0) == areCut && random.real(0.0, 1.0) < share)
					edges.push_back(e);
			return edges;
		};
		for (int change = 0; change < 8; ++change) {
			const std::vector<Edge> removed = some(true, 0.1), added = some(false, 0.03);
			cut.remove(removed);
			cut.add(added);
			const auto firstNew = at(cut.update(removed, added));
			EXPECT_EQ(cut.sides().size(), firstNew + 2 * added.size());
			for (const Halfedge h : t.interiorHalfedges())
				if (isCut[h.edge()] || t.isBoundary(h.edge())) {
					EXPECT_EQ(cut.sides()[at(cut.place(h))], h);
				}
			for (const double share : {0.0, 0.2}) {
				const std::vector<Edge> out = some(true, share);
				cut.remove(out);
				const CirclesByWedges expected(t, marked, isCut);
				EXPECT_EQ(cut.splitCircles(out), expected.count);
				expectCircles(t, cut, expected);
				cut.add(out);
			}
		}
		EXPECT_TRUE(cut.isFragmented());
		cut.labelCircles();
	}
}

TEST(CutSegments, KnowsAfterEveryChangeWhatANewOneKnows)
{
	Random random(781);
	for (const SurfaceMesh& mesh : surfacesOfEveryKind(random)) {
		const Triangulation t = glued(mesh);
		VertexArray<char> marked(t.vertexCount(), 0);
		for (int i = 0; i < 4; ++i)
			marked[Vertex(random.index(t.vertexCount()))] = 1;
		EdgeArray<double> cost(t.edgeCount(), 1.0);
		for (double& c : cost)
			if (random.real(0.0, 1.0) < 0.1)
				c = std::numeric_limits<double>::infinity();
		EdgeArray<char> isCut(t.edgeCount(), 0);
		CutSegments cut(t, cost, marked, isCut);
		for (int step = 0; step < 6; ++step) {
			std::vector<Edge> edges;
			for (const Edge e : t.edges())
				if (!t.isBoundary(e) && (isCut[e] != 0) == (step % 2 == 1) && random.coin())
					edges.push_back(e);
			if (step % 2 == 0)
				cut.add(edges);
			else if (step == 1)
				cut.remove(edges);
			else
				cut.removeWithDeadEnds(edges);
			EdgeArray<char> copy = isCut;
			CutSegments fresh(t, cost, marked, copy);
			EXPECT_EQ(cut.segments(), fresh.segments());
			EXPECT_EQ(cut.branchNodes(), fresh.branchNodes());
			EXPECT_EQ(cut.labelCircles(), fresh.labelCircles());
			EXPECT_EQ(cut.sides(), fresh.sides());
			const VertexArray<char> boundary = t.boundaryVertices();
			for (const Vertex v : t.vertices()) {
				EXPECT_EQ(cut.degree(v), fresh.degree(v));
				EXPECT_EQ(cut.isOnGraph(v), cut.degree(v) > 0 || marked[v] || boundary[v]);
			}
			for (const Edge e : t.edges())
				EXPECT_EQ(cut.isFree(e), !isCut[e] && !t.isBoundary(e) && cost[e] == 1.0);
		}
	}
}

TEST(CutSegments, GoAroundAVertexFromTheLowestHalfedge)
{
	Random random(782);
	for (const SurfaceMesh& mesh : surfacesOfEveryKind(random)) {
		const Triangulation t = glued(mesh);
		const VertexArray<char> marked(t.vertexCount(), 0);
		const EdgeArray<double> cost(t.edgeCount(), 1.0);
		EdgeArray<char> isCut(t.edgeCount(), 0);
		const CutSegments cut(t, cost, marked, isCut);
		for (const Vertex v : t.vertices()) {
			std::set<Halfedge> expected, found;
			Halfedge lowest;
			for (const Halfedge h : t.halfedges())
				if (t.origin(h) == v) {
					expected.insert(h);
					if (!lowest.isValid() && !t.isExterior(h))
						lowest = h;
				}
			EXPECT_EQ(*cut.around(v).begin(), lowest);
			for (const Halfedge h : cut.around(v))
				found.insert(h);
			EXPECT_EQ(found, expected);
		}
	}
}

} // namespace
} // namespace ricci::testing
