// SPDX-License-Identifier: GPL-3.0-or-later
// What whole runs cannot show of a mesh that is cut open: opened_surfaces_test.cpp has the rest.
#include "support/bad_surfaces.h"
#include "support/intrinsic.h"
#include "support/random.h"

#include <ricci/mesh/component.h>
#include <ricci/mesh/face_gluing.h>
#include <ricci/mesh/opened_mesh.h>
#include <ricci/mesh/triangulation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace ricci::testing {
namespace {

using Ends = std::pair<int, int>;

std::map<Ends, std::vector<Corner>> sidesByEnds(const std::vector<Triangle>& triangles)
{
	std::map<Ends, std::vector<Corner>> sides;
	for (int f = 0; f < static_cast<int>(triangles.size()); ++f)
		for (const Corner c : cornersOf(f))
			sides[std::minmax({triangles[at(f)][c.index()], triangles[at(f)][c.next().index()]})]
				.push_back(c);
	return sides;
}

/// What openMesh() promises of any input.
void expectOpened(const SurfaceMesh& mesh)
{
	const OpenedMesh o = opened(mesh);
	const SurfaceMesh& cut = o.mesh;
	// Every face is there once, in order, with its own corners.
	ASSERT_EQ(cut.triangles.size(), o.face.size());
	EXPECT_TRUE(std::is_sorted(o.face.begin(), o.face.end()));
	std::set<int> all(o.face.begin(), o.face.end());
	all.insert(o.degenerate.begin(), o.degenerate.end());
	EXPECT_EQ(all.size(), mesh.triangles.size());
	EXPECT_EQ(o.face.size() + o.degenerate.size(), mesh.triangles.size());
	for (std::size_t f = 0; f < o.face.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k)
			EXPECT_EQ(o.vertex[at(cut.triangles[f][k])], mesh.triangles[at(o.face[f])][k]);
	// Vertices keep their numbers, copies lie where they do.
	ASSERT_EQ(cut.positions.size(), o.vertex.size());
	for (std::size_t v = 0; v < o.vertex.size(); ++v) {
		EXPECT_TRUE(v >= mesh.positions.size() || at(o.vertex[v]) == v);
		EXPECT_EQ(cut.positions[v], mesh.positions[at(o.vertex[v])]);
	}
	// An edge is determined by its vertices and has two faces at most, which differ in a vertex of the
	// input.
	for (const auto& [ends, sides] : sidesByEnds(cut.triangles)) {
		ASSERT_LE(sides.size(), 2u);
		std::set<int> corners;
		for (const Corner side : sides)
			for (const int v : cut.triangles[at(side.face())])
				corners.insert(o.vertex[at(v)]);
		EXPECT_EQ(corners.size(), 2 + sides.size());
	}
	// Coherent manifolds: Triangulation would refuse an incoherent edge, and every vertex is reached
	// round its fan.
	int vertices = 0;
	for (const Component& c : splitIntoComponents(o)) {
		const Triangulation t(c.positions.size(), c.triangles);
		VertexArray<int> corners(t.vertexCount(), 0);
		for (const Triangle& f : c.triangles)
			for (const int v : f)
				++corners[Vertex(v)];
		for (const Vertex v : t.vertices()) {
			for (const Halfedge h : t.around(v))
				corners[v] -= !t.isExterior(h);
			EXPECT_EQ(corners[v], 0);
		}
		vertices += c.positions.size();
	}
	std::set<int> used;
	for (const Triangle& t : cut.triangles)
		used.insert(t.begin(), t.end());
	EXPECT_EQ(vertices, static_cast<int>(used.size()));
	EXPECT_EQ(o.isAsGiven(), o.degenerate.empty() && o.vertex.size() == mesh.positions.size());
	if (!mesh.seam.empty())
		return; // copies at seams are not counted
	std::map<int, int> copies;
	for (const int v : used)
		++copies[o.vertex[at(v)]];
	EXPECT_EQ(
		std::count_if(copies.begin(), copies.end(), [](const auto& c) { return c.second > 1; }),
		o.splitVertices);
}

/// Marks each side with this probability.
void markSeams(SurfaceMesh& mesh, double share, Random& random)
{
	mesh.seam.assign(mesh.triangles.size(), {0, 0, 0});
	for (auto& sides : mesh.seam)
		for (char& side : sides)
			side = random.real(0.0, 1.0) < share;
}

TEST(OpenedMesh, HoldsForAnyTriangles)
{
	Random random(7);
	std::vector<SurfaceMesh> meshes{
		squareWithFin(),
		book(27, 3),
		pinchedSphere(),
		tubePinchedAlongAnEdge(),
		crossingTetrahedra(0),
		crossingTetrahedra(1),
		crossingTetrahedra(2),
		figureEightBottle(24, 16),
		projectivePlane(8),
		threeStrips()};
	for (const SurfaceMesh& mesh : {torus(2, 1, 9, 7), rectangle(3, 2, 1, 1), tetrahedron()})
		for (const bool turn : {false, true})
			meshes.push_back(doubled(mesh, turn));
	for (int run = 0; run < 400; ++run) {
		SurfaceMesh mesh;
		const int vertices = 4 + run % 23, faces = 4 + 3 * (run % 40);
		for (int v = 0; v < vertices; ++v)
			mesh.positions.push_back({random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)});
		for (int f = 0; f < faces; ++f)
			mesh.triangles.push_back(
				{random.index(vertices), random.index(vertices), random.index(vertices)});
		mesh.triangles.push_back({0, 1, 2});
		meshes.push_back(mesh);
	}
	for (std::size_t i = 0; i < meshes.size() && !HasFailure(); ++i) {
		SCOPED_TRACE(i);
		expectOpened(meshes[i]);
	}
}

/// What is no manifold is cut in the same way with seams and without.
TEST(OpenedMesh, CountsWithoutSeamsWhatHadToBeCut)
{
	Random random(12);
	for (SurfaceMesh mesh :
		 {book(5, 3), doubled(torus(3.0, 1.0, 6, 5), true), touchingTetrahedra()})
		for (const double share : {0.03, 0.3, 1.0}) {
			mesh.seam.clear();
			const OpenedMesh whole = opened(mesh);
			markSeams(mesh, share, random);
			expectOpened(mesh);
			const OpenedMesh o = opened(mesh);
			EXPECT_EQ(o.splitVertices, whole.splitVertices);
			EXPECT_EQ(o.cutEdges, whole.cutEdges);
			EXPECT_EQ(o.duplicateFaces, whole.duplicateFaces);
		}
}

/// A flat component, a face with a vertex twice and one at a single point, round a square whose two
/// triangles are glued.
TEST(OpenedMesh, WhatIsLeftOutTakesNothingAlong)
{
	SurfaceMesh mesh;
	mesh.positions = {
		{0, 0, 0},
		{1, 0, 0},
		{2, 0, 0},
		{3, 0, 0},
		{0, 5, 0},
		{1, 5, 0},
		{1, 6, 0},
		{0, 6, 0},
		{9, 9, 9},
		{9, 9, 9},
		{9, 9, 9},
		{7, 7, 7}};
	mesh.absent = 1; // the last one stands for nothing
	mesh.triangles = {{0, 1, 2}, {4, 5, 6}, {1, 2, 3}, {4, 4, 5}, {8, 9, 10}, {4, 6, 7}};
	mesh.diagonal.assign(mesh.triangles.size(), {0, 0, 0});
	mesh.diagonal[1] = {0, 0, 1};
	mesh.diagonal[5] = {1, 0, 0};
	expectOpened(mesh);
	const OpenedMesh o = opened(mesh);
	EXPECT_EQ(o.face, (std::vector<int>{1, 5}));
	EXPECT_EQ(o.degenerate, (std::vector<int>{0, 2, 3, 4}));
	EXPECT_EQ(o.mesh.absent, 1u);
	EXPECT_EQ(o.mesh.diagonal, (SideMarks{mesh.diagonal[1], mesh.diagonal[5]}));
}

/// The projective plane of six vertices, all of which are neighbours: half of an icosahedron, its
/// opposite points identified.
const std::vector<Triangle> kSixVertices = {
	{0, 1, 2},
	{0, 2, 3},
	{0, 3, 4},
	{0, 4, 5},
	{0, 5, 1},
	{1, 2, 4},
	{2, 3, 5},
	{3, 4, 1},
	{4, 5, 2},
	{5, 1, 3}};

/// The shortest one-sided loop through any of \p roots, without what its two ways to the root share.
/// Of the loops of three vertices those round a face are two-sided, the ten others one-sided. A longer
/// loop is not shorter: of the two parts into which an edge divides it one is one-sided, too.
double shortestOneSidedLoop(const SurfaceMesh& mesh, const std::set<int>& roots)
{
	std::set<std::set<int>> faces;
	for (const Triangle& t : mesh.triangles)
		faces.insert({t[0], t[1], t[2]});
	const auto length = [&](int v, int w) {
		return distance(mesh.positions[at(v)], mesh.positions[at(w)]);
	};
	std::pair<double, double> shortest(std::numeric_limits<double>::infinity(), 0.0);
	for (int a = 0; a < 6; ++a)
		for (int b = 0; b < a; ++b)
			for (int c = 0; c < b; ++c)
				for (const int root : roots)
					if (faces.count({a, b, c}) == 0) {
						const double loop = length(a, b) + length(b, c) + length(c, a);
						const double way =
							std::min({length(root, a), length(root, b), length(root, c)});
						shortest = std::min(shortest, {loop + 2.0 * way, loop});
					}
	return shortest.second;
}

/// Where the orientation that a walk over the faces gives them does not fit.
std::set<int> rootsOf(const SurfaceMesh& mesh)
{
	std::set<int> roots;
	const Array<Triangle> triangles(mesh.triangles);
	const FaceGluing gluing = glueFaces(Array<Point3>(mesh.positions), triangles);
	const FacePartition partition = partitionFaces(triangles, gluing.glued);
	EXPECT_LE(partition.contradicted.size(), 16); // all of them are tried
	for (const Corner side : partition.contradicted)
		roots.insert(triangles[side]);
	return roots;
}

TEST(OneSided, TheProjectivePlaneIsCutAlongAShortestOneSidedLoop)
{
	Random random(950);
	int cutByLoop = 0;
	for (int trial = 0; trial < 300; ++trial) {
		SurfaceMesh mesh{{}, kSixVertices};
		for (int v = 0; v < 6; ++v)
			mesh.positions.push_back({random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)});
		for (Triangle& t : mesh.triangles) // so that their orders say nothing of the surface
			if (random.index(2) == 0)
				t = reversed(t);
		const double shortest = shortestOneSidedLoop(mesh, rootsOf(mesh));
		const OpenedMesh result = opened(mesh);
		EXPECT_EQ(result.oneSidedComponents, 1);
		int sides = 0;
		double cut = 0.0, incoherent = 0.0;
		for (const auto& [ends, open] : sidesByEnds(result.mesh.triangles))
			if (open.size() == 1) {
				++sides;
				cut += 0.5 * distance(
								 result.mesh.positions[at(ends.first)],
								 result.mesh.positions[at(ends.second)]);
			}
		for (const auto& [ends, both] : sidesByEnds(mesh.triangles))
			if (mesh.triangles[at(both[0].face())][both[0].index()] ==
				mesh.triangles[at(both[1].face())][both[1].index()])
				incoherent +=
					distance(mesh.positions[at(ends.first)], mesh.positions[at(ends.second)]);
		// Where the orders change is another set of edges that can be cut.
		if (incoherent <= 2.0 * shortest) {
			EXPECT_NEAR(cut, incoherent, 1e-12);
			continue;
		}
		++cutByLoop;
		EXPECT_EQ(sides, 6);
		EXPECT_NEAR(cut, shortest, 1e-12);
	}
	EXPECT_GT(cutByLoop, 100);
}

} // namespace
} // namespace ricci::testing
