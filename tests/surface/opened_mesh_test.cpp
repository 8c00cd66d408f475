// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/random.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/base/numbers.h>
#include <ricci/error.h>
#include <ricci/surface/component.h>
#include <ricci/surface/opened_mesh.h>
#include <ricci/surface/triangulation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

std::vector<SurfaceType> typesOf(const OpenedMesh& mesh)
{
	std::vector<SurfaceType> types;
	for (const Component& c : splitIntoComponents(mesh))
		types.push_back(topologyOf(Triangulation(c.positions.size(), c.triangles)).type);
	return types;
}

/// What openMesh() promises of any input.
void expectOpened(const SurfaceMesh& mesh)
{
	const OpenedMesh o = opened(mesh);
	const SurfaceMesh& cut = o.mesh;
	// Every face is there once, in order, with its own corners.
	ASSERT_EQ(cut.triangles.size(), o.face.size());
	EXPECT_EQ(o.face.size() + o.degenerate.size(), mesh.triangles.size());
	EXPECT_TRUE(std::is_sorted(o.face.begin(), o.face.end()));
	std::set<int> all(o.face.begin(), o.face.end());
	all.insert(o.degenerate.begin(), o.degenerate.end());
	EXPECT_EQ(all.size(), mesh.triangles.size());
	for (std::size_t f = 0; f < o.face.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k)
			EXPECT_EQ(o.vertex[at(cut.triangles[f][k])], mesh.triangles[at(o.face[f])][k]);
	// Vertices keep their numbers, copies lie where they do.
	ASSERT_EQ(cut.positions.size(), o.vertex.size());
	for (std::size_t v = 0; v < o.vertex.size(); ++v) {
		if (v < mesh.positions.size()) {
			EXPECT_EQ(o.vertex[v], static_cast<int>(v));
		}
		EXPECT_EQ(cut.positions[v], mesh.positions[at(o.vertex[v])]);
	}
	// An edge is determined by its vertices and has two faces at most, which differ in a vertex of the
	// input.
	std::map<std::pair<int, int>, std::vector<std::size_t>> edges;
	for (std::size_t f = 0; f < cut.triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k)
			edges[std::minmax(cut.triangles[f][k], cut.triangles[f][(k + 1) % 3])].push_back(f);
	for (const auto& [ends, faces] : edges) {
		ASSERT_LE(faces.size(), 2u);
		if (faces.size() == 2) {
			std::set<int> corners;
			for (const std::size_t f : faces)
				for (const int v : cut.triangles[f])
					corners.insert(o.vertex[at(v)]);
			EXPECT_EQ(corners.size(), 4u);
		}
	}
	// Coherent manifolds: Triangulation would refuse an incoherent edge, and every vertex is reached
	// round its fan.
	int vertices = 0;
	for (const Component& c : splitIntoComponents(o)) {
		const Triangulation t(c.positions.size(), c.triangles);
		std::vector<int> corners(at(t.vertexCount()), 0);
		for (const Triangle& f : c.triangles)
			for (const int v : f)
				++corners[at(v)];
		for (const Vertex v : t.vertices()) {
			int seen = 0;
			for (const Halfedge h : t.around(v))
				seen += !t.isExterior(h);
			EXPECT_EQ(seen, corners[at(v.number())]);
		}
		vertices += c.positions.size();
	}
	const std::set<int> used = [&] {
		std::set<int> result;
		for (const Triangle& t : cut.triangles)
			result.insert(t.begin(), t.end());
		return result;
	}();
	EXPECT_EQ(vertices, static_cast<int>(used.size()));
	std::map<int, int> copies;
	for (const int v : used)
		++copies[o.vertex[at(v)]];
	EXPECT_EQ(o.isAsGiven(), o.degenerate.empty() && o.vertex.size() == mesh.positions.size());
	if (!mesh.seam.empty())
		return; // copies at seams are not counted
	EXPECT_EQ(
		std::count_if(copies.begin(), copies.end(), [](const auto& c) { return c.second > 1; }),
		o.splitVertices);
}

Triangle reversed(const Triangle& t)
{
	return {t[0], t[2], t[1]};
}

SurfaceMesh doubled(const SurfaceMesh& mesh, bool turn)
{
	SurfaceMesh result = mesh;
	for (const Triangle& t : mesh.triangles)
		result.triangles.push_back(turn ? reversed(t) : t);
	return result;
}

/// The figure-eight immersion.
SurfaceMesh figureEightBottle(int nu, int nv)
{
	return kleinBottle(nu, nv, [&](int i, int j) {
		const double u = 2 * kPi * i / nu, v = 2 * kPi * j / nv;
		const double c = std::cos(u / 2), s = std::sin(u / 2);
		const double r = 3 + c * std::sin(v) - s * std::sin(2 * v);
		return Point3{r * std::cos(u), r * std::sin(u), s * std::sin(v) + c * std::sin(2 * v)};
	});
}

/// The projective plane: half of a cube of n^2 cells on each side, opposite points identified.
SurfaceMesh projectivePlane(int n)
{
	std::map<std::array<int, 3>, int> number;
	SurfaceMesh mesh;
	const auto vertex = [&](std::array<int, 3> p) { // coordinates from -n to n, step 2
		const std::array<int, 3> opposite{-p[0], -p[1], -p[2]};
		p = std::max(p, opposite);
		const auto [place, isNew] = number.insert({p, static_cast<int>(number.size())});
		if (isNew) {
			const double x = double(p[0]) / n, y = double(p[1]) / n, z = double(p[2]) / n;
			mesh.positions.push_back({x * x + 0.3 * y * z, x * y - 0.1 * z * z, y * z + z * x});
		}
		return place->second;
	};
	for (std::size_t axis = 0; axis < 3; ++axis)
		for (int i = -n; i < n; i += 2)
			for (int j = -n; j < n; j += 2) {
				const auto point = [&](int a, int b) {
					std::array<int, 3> p{};
					p[axis] = n;
					p[(axis + 1) % 3] = a;
					p[(axis + 2) % 3] = b;
					return vertex(p);
				};
				const int a = point(i, j), b = point(i + 2, j), c = point(i + 2, j + 2),
						  d = point(i, j + 2);
				mesh.triangles.push_back({a, b, c});
				mesh.triangles.push_back({a, c, d});
			}
	return mesh;
}

TEST(OpenedMesh, LeavesManifoldsAsTheyAre)
{
	for (const SurfaceMesh& mesh :
		 {tetrahedron(), rectangle(2, 3, 1, 1), perforatedSlab(2, 1), torus(2, 1, 8, 6)}) {
		expectOpened(mesh);
		const OpenedMesh o = opened(mesh);
		EXPECT_TRUE(o.isAsGiven());
		EXPECT_EQ(o.mesh.triangles, mesh.triangles);
		EXPECT_EQ(o.mesh.positions, mesh.positions);
		EXPECT_EQ(o.cutEdges + o.duplicateFaces + o.oneSidedComponents, 0);
	}
}

TEST(OpenedMesh, AFinLeavesItsSheetWhole)
{
	SurfaceMesh mesh = rectangle(4, 4, 1, 1);
	const int a = mesh.triangles[14][0], b = mesh.triangles[14][1];
	mesh.positions.push_back({0.5, 0.5, 1.0});
	mesh.triangles.insert(
		mesh.triangles.begin(), {b, a, static_cast<int>(mesh.positions.size()) - 1});
	expectOpened(mesh);
	const OpenedMesh o = opened(mesh);
	EXPECT_EQ(o.cutEdges, 1);
	EXPECT_EQ(o.splitVertices, 2);
	const std::vector<Component> pieces = splitIntoComponents(o);
	ASSERT_EQ(pieces.size(), 2u);
	EXPECT_EQ(pieces[0].triangles.size(), 1u);
	EXPECT_EQ(pieces[1].triangles.size(), 32u);
	for (const SurfaceType& type : typesOf(o))
		EXPECT_TRUE(type.isDisk());
}

/// Straight on where that is possible: pairs of opposite sheets, and an odd one left over.
TEST(OpenedMesh, PairsTheSheetsOfABookStraightOn)
{
	for (int sheets = 3; sheets <= 90; sheets = sheets < 8 ? sheets + 1 : 3 * sheets) {
		SCOPED_TRACE(sheets);
		const int n = 3;
		const SurfaceMesh mesh = book(sheets, n);
		expectOpened(mesh);
		const OpenedMesh o = opened(mesh);
		EXPECT_EQ(o.cutEdges, n);
		const std::vector<Component> pieces = splitIntoComponents(o);
		EXPECT_EQ(pieces.size(), at((sheets + 1) / 2));
		int straight = 0;
		for (const Component& c : pieces) {
			EXPECT_EQ(c.triangles.size() % (2 * n * n), 0u);
			if (c.triangles.size() != 4 * n * n)
				continue;
			// The directions of the two sheets: their vertices farthest from the spine.
			std::vector<Point3> far;
			for (const Point3& p : c.positions)
				if (p[2] == 0.0 && std::hypot(p[0], p[1]) > n - 0.5)
					far.push_back(p);
			ASSERT_EQ(far.size(), 2u);
			straight += std::hypot(far[0][0] + far[1][0], far[0][1] + far[1][1]) < 1e-9;
		}
		EXPECT_EQ(straight, sheets % 2 == 0 ? sheets / 2 : 0);
	}
}

TEST(OpenedMesh, EqualFacesAreSeparateSheets)
{
	for (const SurfaceMesh& mesh : {torus(2, 1, 9, 7), rectangle(3, 2, 1, 1), tetrahedron()})
		for (const bool turn : {false, true}) {
			const SurfaceMesh twice = doubled(mesh, turn);
			expectOpened(twice);
			const OpenedMesh o = opened(twice);
			EXPECT_EQ(o.duplicateFaces, static_cast<int>(mesh.triangles.size()));
			const auto types = typesOf(o);
			ASSERT_EQ(types.size(), 2u);
			const SurfaceType own = typesOf(opened(mesh))[0];
			for (const SurfaceType& type : types) {
				EXPECT_EQ(type.genus, own.genus);
				EXPECT_EQ(type.boundaryLoops, own.boundaryLoops);
			}
		}
	// A pillow of two faces has no third triangle to tell what its inside is: two sheets.
	const SurfaceMesh pillow{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
	expectOpened(pillow);
	EXPECT_EQ(typesOf(opened(pillow)).size(), 2u);
}

TEST(OpenedMesh, SplitsVerticesOfSeveralFans)
{
	SurfaceMesh bowTie;
	for (int i = 0; i < 5; ++i)
		bowTie.positions.push_back({double(i % 3), double(i / 3), double(i * i)});
	bowTie.triangles = {{0, 1, 2}, {0, 3, 4}};
	expectOpened(bowTie);
	EXPECT_EQ(opened(bowTie).splitVertices, 1);
	EXPECT_EQ(opened(bowTie).componentCount, 2);
	// A sphere whose poles touch stays a sphere.
	SurfaceMesh pinched = torus(1, 1, 12, 8);
	const int pole = 4; // at v = pi, where the rings have the radius 0
	for (Triangle& t : pinched.triangles)
		for (int& v : t)
			if (std::hypot(pinched.positions[at(v)][0], pinched.positions[at(v)][1]) < 1e-9)
				v = pole;
	expectOpened(pinched);
	const OpenedMesh o = opened(pinched);
	EXPECT_EQ(o.splitVertices, 1);
	ASSERT_EQ(o.componentCount, 1);
	EXPECT_TRUE(typesOf(o)[0].isSphere());
	EXPECT_EQ(o.degenerate.size(), 24u); // the ring of sides of length 0 at the pole
}

/// The shortest one-sided loop of the band is its border but for one side across, which opens it to a
/// disk. The projective plane becomes a disk, with Euler characteristic 1 as before, and the Klein
/// bottle, with 0, an annulus.
TEST(OpenedMesh, CutsOneSidedSurfacesAlongShortLoops)
{
	const auto typeOf = [](const SurfaceMesh& mesh) {
		expectOpened(mesh);
		EXPECT_EQ(opened(mesh).oneSidedComponents, 1);
		EXPECT_EQ(typesOf(opened(mesh)).size(), 1u);
		return typesOf(opened(mesh)).front();
	};
	const SurfaceMesh band = moebiusBand(9), bottle = figureEightBottle(24, 16);
	EXPECT_TRUE(typeOf(band).isDisk()); // across, from border to border
	EXPECT_TRUE(typeOf(projectivePlane(8)).isDisk());
	EXPECT_EQ(typeOf(bottle).eulerCharacteristic(), 0);
	EXPECT_EQ(typeOf(bottle).boundaryLoops, 2);
	EXPECT_EQ(opened(sideBySide(band, band, 10)).oneSidedComponents, 2);
	EXPECT_EQ(opened(sideBySide(tetrahedron(), bottle, 10)).oneSidedComponents, 1);
}

TEST(OpenedMesh, LeavesOutFacesWithoutArea)
{
	SurfaceMesh mesh = rectangle(1, 1, 1, 1);
	mesh.triangles.insert(mesh.triangles.begin(), {0, 1, 1});
	mesh.triangles.push_back({2, 2, 2});
	for (double x : {5.0, 6.0, 7.0}) // a component on a line
		mesh.positions.push_back({x, 0.0, 0.0});
	mesh.triangles.push_back({4, 5, 6});
	expectOpened(mesh);
	const OpenedMesh o = opened(mesh);
	EXPECT_EQ(o.degenerate, (std::vector<int>{0, 3, 4}));
	EXPECT_EQ(o.face, (std::vector<int>{1, 2}));
	EXPECT_EQ(o.componentCount, 1);
}

/// A triangle of a chain that is pinched along an edge: two edges with the same ends.
TEST(OpenedMesh, AnEdgeIsDeterminedByItsVertices)
{
	// A tube of four strips round a square whose opposite edges 0-1 are one.
	SurfaceMesh mesh = torus(3, 1, 6, 4);
	std::map<int, int> joined; // rings of four: the first edge of one ring becomes that of another
	for (const auto& [from, to] : {std::pair(12, 0), std::pair(13, 1)})
		joined[from] = to;
	for (Triangle& t : mesh.triangles)
		for (int& v : t)
			if (joined.count(v) > 0)
				v = joined[v];
	expectOpened(mesh);
	EXPECT_GT(opened(mesh).splitVertices, 0);
}

/// Two tetrahedra touch along an edge in such a way that their sheets cross straight on there. The two
/// edges that this makes have the same ends, and so have the two sides of each once they are cut: one
/// side more is cut in each tetrahedron, which opens it to a disk. No face comes off.
TEST(OpenedMesh, ASlitIsProlongedByOneSide)
{
	SurfaceMesh mesh;
	mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0.5}, {-1, 0, 0.5}, {0, -1, 0.5}, {0, 1, 0.5}};
	const std::vector<Triangle> outward = {{0, 1, 2}, {1, 0, 5}, {1, 5, 2}, {0, 2, 5}};
	for (int first = 0; first < 3; ++first) { // whichever side of a face the edge is
		mesh.triangles.clear();
		const auto add = [&](const Triangle& t) {
			mesh.triangles.push_back(
				{t[at(first)], t[at((first + 1) % 3)], t[at((first + 2) % 3)]});
		};
		for (const Triangle& t : outward)
			add(t);
		for (Triangle t : outward) { // its image under half a turn, inward
			for (int& v : t)
				v = v == 2 ? 3 : v == 5 ? 4 : v;
			add(reversed(t));
		}
		expectOpened(mesh);
		const OpenedMesh o = opened(mesh);
		EXPECT_EQ(o.cutEdges, 1);
		ASSERT_EQ(o.componentCount, 2);
		for (const SurfaceType& type : typesOf(o))
			EXPECT_TRUE(type.isDisk());
		// A path of two edges is open in each: one vertex on it and both of its ends.
		EXPECT_EQ(o.mesh.positions.size(), 2u * 5u);
	}
}

TEST(OpenedMesh, HoldsForAnyTriangles)
{
	Random random(7);
	for (int run = 0; run < 400; ++run) {
		SCOPED_TRACE(run);
		SurfaceMesh mesh;
		const int vertices = 4 + run % 23, faces = 4 + 3 * (run % 40);
		for (int v = 0; v < vertices; ++v)
			mesh.positions.push_back({random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)});
		for (int f = 0; f < faces; ++f)
			mesh.triangles.push_back(
				{random.index(vertices), random.index(vertices), random.index(vertices)});
		mesh.triangles.push_back({0, 1, 2});
		expectOpened(mesh);
		if (HasFailure())
			return;
	}
}

/// The same triangles in another order, with other vertex numbers and first corners, are cut as often.
TEST(OpenedMesh, NumbersDoNotMatterWherePairsAreClear)
{
	const SurfaceMesh original = book(6, 4);
	Random random(9);
	const SurfaceMesh mesh = renumbered(original, random).mesh;
	expectOpened(mesh);
	EXPECT_EQ(opened(mesh).componentCount, opened(original).componentCount);
	EXPECT_EQ(opened(mesh).splitVertices, opened(original).splitVertices);
}

TEST(OpenedMesh, TellsWhatWasDone)
{
	SurfaceMesh mesh = book(3, 2);
	mesh.positions.push_back({9, 9, 9});
	mesh.triangles.push_back({0, 0, 1});
	std::vector<std::string> notes;
	openMesh(mesh, notes);
	ASSERT_EQ(notes.size(), 4u);
	EXPECT_EQ(notes[0].rfind("1 vertex belongs to no face", 0), 0u);
	EXPECT_EQ(notes[1].rfind("2 edges of more than two faces were cut", 0), 0u);
	EXPECT_EQ(notes[2].rfind("3 vertices have more than one fan", 0), 0u);
	EXPECT_EQ(notes[3].rfind("1 face has no area", 0), 0u);
}

TEST(OpenedMesh, WhatIsLeftOutTakesNothingAlong)
{
	// A flat component, a face with a vertex twice and one at a single point, round a square whose two
	// triangles are glued.
	SurfaceMesh mesh;
	mesh.positions = {
		{0, 0, 0},
		{1, 0, 0},
		{2, 0, 0},
		{3, 0, 0}, // on a line
		{0, 5, 0},
		{1, 5, 0},
		{1, 6, 0},
		{0, 6, 0}, // the square
		{9, 9, 9},
		{9, 9, 9},
		{9, 9, 9},  // one point
		{7, 7, 7}}; // stands for nothing
	mesh.absent = 1;
	mesh.triangles = {{0, 1, 2}, {4, 5, 6}, {1, 2, 3}, {4, 4, 5}, {8, 9, 10}, {4, 6, 7}};
	mesh.diagonal.assign(mesh.triangles.size(), {0, 0, 0});
	mesh.diagonal[1] = {0, 0, 1};
	mesh.diagonal[5] = {1, 0, 0};
	expectOpened(mesh);
	const OpenedMesh o = opened(mesh);
	EXPECT_EQ(o.face, (std::vector<int>{1, 5}));
	EXPECT_EQ(o.degenerate, (std::vector<int>{0, 2, 3, 4}));
	ASSERT_EQ(typesOf(o).size(), 1u);
	EXPECT_EQ(typesOf(o)[0].boundaryLoops, 1);
	EXPECT_EQ(o.mesh.absent, 1u);
	EXPECT_EQ(
		o.mesh.diagonal, (std::vector<std::array<char, 3>>{mesh.diagonal[1], mesh.diagonal[5]}));
}

/// Whether two faces share two vertices.
bool shareAnEdge(const OpenedMesh& o, std::size_t f, std::size_t g)
{
	int shared = 0;
	for (const int v : o.mesh.triangles[f])
		shared += std::count(o.mesh.triangles[g].begin(), o.mesh.triangles[g].end(), v) > 0;
	return shared == 2;
}

TEST(OpenedMesh, PairsCoherentSheetsThatAreNearlyAsSmooth)
{
	// Three strips of three triangles at an edge from 0 to 1. The first and the second go straight on
	// but have the edge in the same direction; the third is coherent with the first, at 120 degrees.
	for (std::size_t turned = 0; turned < 4; ++turned) {
		SCOPED_TRACE(turned);
		SurfaceMesh mesh;
		mesh.positions = {{0, 0, 0}, {0, 0, 1}};
		for (const double degrees : {0.0, 180.0, 120.0}) {
			const double angle = degrees * kPi / 180.0;
			const int first = static_cast<int>(mesh.positions.size());
			for (const auto& [r, z] :
				 {std::pair(1.0, 0.5), std::pair(1.0, 1.5), std::pair(2.0, 1.0)})
				mesh.positions.push_back({r * std::cos(angle), r * std::sin(angle), z});
			std::vector<Triangle> strip = {
				{0, 1, first}, {1, first + 1, first}, {first, first + 1, first + 2}};
			if (degrees == 120.0)
				for (Triangle& t : strip)
					t = reversed(t);
			mesh.triangles.insert(mesh.triangles.end(), strip.begin(), strip.end());
		}
		// Most triangles of a strip decide its orientation.
		if (turned < 3)
			mesh.triangles[turned] = reversed(mesh.triangles[turned]);
		const OpenedMesh o = opened(mesh);
		EXPECT_EQ(o.cutEdges, 1);
		EXPECT_TRUE(shareAnEdge(o, 0, 6));
		EXPECT_FALSE(shareAnEdge(o, 0, 3));
		EXPECT_FALSE(shareAnEdge(o, 3, 6));
		for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
			EXPECT_EQ(o.reversed[Face(static_cast<int>(f))] == 1, turned < 3 && f == turned) << f;
	}
}

/// Sides that are glued, as pairs of the input's.
std::set<std::pair<int, int>> gluedSides(const OpenedMesh& o)
{
	std::map<std::pair<int, int>, std::vector<int>> sides;
	for (std::size_t f = 0; f < o.mesh.triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k) {
			const Triangle& t = o.mesh.triangles[f];
			sides[std::minmax(t[k], t[(k + 1) % 3])].push_back(3 * o.face[f] + static_cast<int>(k));
		}
	std::set<std::pair<int, int>> pairs;
	for (const auto& [ends, all] : sides)
		if (all.size() == 2)
			pairs.insert({all[0], all[1]});
	return pairs;
}

/// Marks each side with this probability.
void markSeams(SurfaceMesh& mesh, double share, Random& random)
{
	mesh.seam.assign(mesh.triangles.size(), {0, 0, 0});
	for (auto& sides : mesh.seam)
		for (char& side : sides)
			side = random.real(0.0, 1.0) < share;
}

/// Nothing but the marked edges comes apart, and what has to so that a seam has two sides; on a manifold
/// every other pair of sides stays glued.
TEST(OpenedMesh, IsOpenAlongSeamsAndNowhereElse)
{
	Random random(11);
	for (SurfaceMesh mesh :
		 {tetrahedron(),
		  torus(3.0, 1.0, 7, 6),
		  rectangle(5, 4, 5.0, 4.0),
		  perforatedSlab(2, 1),
		  ring(1.0, 2.0, 9, 3)})
		for (const double share : {0.005, 0.02, 0.1, 0.3, 1.0})
			for (int run = 0; run < 8; ++run) {
				mesh.seam.clear();
				const auto whole = gluedSides(opened(mesh));
				markSeams(mesh, share, random);
				expectOpened(mesh);
				const OpenedMesh o = opened(mesh);
				const auto left = gluedSides(o);
				EXPECT_TRUE(std::includes(whole.begin(), whole.end(), left.begin(), left.end()));
				int chosen = 0;
				for (const auto& pair : whole) {
					const auto isMarked = [&](int side) {
						return mesh.seam[at(side / 3)][at(side % 3)] != 0;
					};
					if (isMarked(pair.first) || isMarked(pair.second)) {
						++chosen;
						EXPECT_EQ(left.count(pair), 0u);
					}
				}
				EXPECT_EQ(o.seamEdges, chosen);
				EXPECT_EQ(whole.size() - left.size(), at(o.seamEdges + o.seamEdgesAdded));
				EXPECT_EQ(o.splitVertices, 0);
				EXPECT_EQ(o.cutEdges, 0);
				EXPECT_EQ(o.hasSeam.size(), at(o.componentCount));
				if (chosen == 0) {
					EXPECT_TRUE(o.isAsGiven());
				}
			}
}

/// What is no manifold is cut in the same way with seams and without.
TEST(OpenedMesh, CountsWithoutSeamsWhatHadToBeCut)
{
	Random random(12);
	std::vector<SurfaceMesh> meshes = {book(5, 3), doubled(torus(3.0, 1.0, 6, 5), true)};
	SurfaceMesh touching = tetrahedron(); // two of them at a vertex
	for (const Triangle& t : tetrahedron().triangles) {
		Triangle other = t;
		for (int& v : other)
			v = v == 0 ? 0 : v + 3;
		touching.triangles.push_back(other);
	}
	for (int v = 1; v < 4; ++v)
		touching.positions.push_back({2.0 + v, v * 0.3, v == 2 ? 1.0 : 0.0});
	meshes.push_back(touching);
	for (SurfaceMesh& mesh : meshes)
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

/// Of each component the longest loop of the mesh itself is no hole, however long a seam is.
TEST(OpenedMesh, KnowsHolesFromSeams)
{
	const auto vertex = [](int i, int j) { return i * 11 + j; };
	SurfaceMesh mesh = withoutStars(rectangle(10, 10, 10.0, 10.0), {vertex(3, 3), vertex(7, 6)});
	EXPECT_TRUE(opened(mesh).hole.empty());
	mesh.seam.assign(mesh.triangles.size(), {1, 1, 1});
	const OpenedMesh o = opened(mesh);
	ASSERT_EQ(o.hole.size(), o.face.size());
	std::map<std::pair<int, int>, int> faces;
	for (const Triangle& t : mesh.triangles)
		for (std::size_t k = 0; k < 3; ++k)
			++faces[std::minmax(t[k], t[(k + 1) % 3])];
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k) {
			const Triangle& t = mesh.triangles[f];
			const int a = t[k], b = t[(k + 1) % 3];
			const auto inside = [&](int v) {
				const Point3& p = mesh.positions[at(v)];
				return p[0] > 0.0 && p[0] < 10.0 && p[1] > 0.0 && p[1] < 10.0;
			};
			EXPECT_EQ(o.hole[f][k] != 0, faces[std::minmax(a, b)] == 1 && inside(a));
		}
}

TEST(OpenedMesh, TurnsTheMinorityOfAComponent)
{
	SurfaceMesh mesh = tetrahedron();
	mesh.triangles[0] = reversed(mesh.triangles[0]); // where the search starts
	EXPECT_EQ(opened(mesh).reversed.values(), (std::vector<char>{1, 0, 0, 0}));
	mesh.triangles[2] = reversed(mesh.triangles[2]); // half of them: the first stays
	const std::vector<char> half = opened(mesh).reversed.values();
	EXPECT_EQ(std::count(half.begin(), half.end(), 1), 2);
	EXPECT_EQ(half[0], 0);
}

} // namespace
} // namespace ricci::testing
