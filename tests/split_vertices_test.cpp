// SPDX-License-Identifier: GPL-3.0-or-later
// Vertices that a format has split: what is joined, what stays apart, and that results are for the vertices given.
#include "support/calls.h"
#include "support/flat_map.h"
#include "support/random.h"
#include "support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <utility>

namespace ricci::testing {
namespace {

/// Each face with vertices of its own.
SurfaceMesh soup(const SurfaceMesh& mesh)
{
	SurfaceMesh result;
	for (const Triangle& t : mesh.triangles) {
		const int first = static_cast<int>(result.positions.size());
		for (const int v : t)
			result.positions.push_back(mesh.positions[at(v)]);
		result.triangles.push_back({first, first + 1, first + 2});
	}
	return result;
}

SurfaceMesh together(const SurfaceMesh& a, const SurfaceMesh& b)
{
	return sideBySide(a, b, 0.0);
}

SurfaceMesh moved(SurfaceMesh mesh, const Point3& shift)
{
	for (Point3& p : mesh.positions)
		p += shift;
	return mesh;
}

/// A unit cube with 8 vertices.
SurfaceMesh cube()
{
	SurfaceMesh mesh;
	for (int i = 0; i < 8; ++i)
		mesh.positions.push_back({double(i % 2), double(i / 2 % 2), double(i / 4)});
	mesh.triangles = {
		{0, 2, 3},
		{0, 3, 1},
		{4, 5, 7},
		{4, 7, 6},
		{0, 1, 5},
		{0, 5, 4},
		{2, 6, 7},
		{2, 7, 3},
		{0, 4, 6},
		{0, 6, 2},
		{1, 3, 7},
		{1, 7, 5}};
	return mesh;
}

/// Cells of a block.
constexpr int kBlock = 6;
using Block = std::array<std::array<std::array<int, kBlock + 2>, kBlock + 2>, kBlock + 2>;
constexpr std::array<std::array<int, 3>, 6> kSteps = {
	{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

template<class Visit>
void forCells(const Visit& visit)
{
	for (int i = 1; i <= kBlock; ++i)
		for (int j = 1; j <= kBlock; ++j)
			for (int k = 1; k <= kBlock; ++k)
				visit(std::array<int, 3>{i, j, k});
}

int& in(Block& block, const std::array<int, 3>& cell)
{
	return block[at(cell[0])][at(cell[1])][at(cell[2])];
}

std::array<int, 3> beside(const std::array<int, 3>& cell, const std::array<int, 3>& step)
{
	return {cell[0] + step[0], cell[1] + step[1], cell[2] + step[2]};
}

/// Full cells at random, with a number that those share that hang together across squares; 0: empty.
Block randomBlock(std::uint64_t seed)
{
	Random random(seed);
	Block block{};
	int count = 0;
	forCells(
		[&](const auto& cell) { in(block, cell) = random.real(0.0, 1.0) < 0.4 ? ++count : 0; });
	for (bool isChanged = true; isChanged;) {
		isChanged = false;
		forCells([&](const auto& cell) {
			int& own = in(block, cell);
			for (const auto& step : kSteps)
				if (const int other = in(block, beside(cell, step)); own != 0 && other > own) {
					own = other;
					isChanged = true;
				}
		});
	}
	return block;
}

/// The squares between full cells and empty ones, each with vertices of its own, seen from outside.
SurfaceMesh surfaceOf(Block block)
{
	SurfaceMesh mesh;
	forCells([&](const auto& cell) {
		for (const auto& step : kSteps) {
			if (in(block, cell) == 0 || in(block, beside(cell, step)) != 0)
				continue;
			const std::size_t axis = step[0] != 0 ? 0 : step[1] != 0 ? 1 : 2;
			const int first = static_cast<int>(mesh.positions.size());
			for (const auto& [a, b] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
				Point3 p{double(cell[0]), double(cell[1]), double(cell[2])};
				p[axis] += 0.5 * step[axis];
				p[(axis + 1) % 3] += 0.5 * a * step[axis];
				p[(axis + 2) % 3] += 0.5 * b;
				mesh.positions.push_back(p);
			}
			mesh.triangles.push_back({first, first + 1, first + 2});
			mesh.triangles.push_back({first, first + 2, first + 3});
		}
	});
	return mesh;
}

/// A unit cube with 24 vertices: each square has its own.
SurfaceMesh cubeOfSquares()
{
	Block one{};
	one[1][1][1] = 1;
	return surfaceOf(one);
}

/// \p mesh and its other side, each with vertices of its own.
SurfaceMesh doubleSided(const SurfaceMesh& mesh)
{
	return together(mesh, withReversedFaces(mesh, 1));
}

struct Joining
{
	std::string name;
	SurfaceMesh mesh;
	int components, eulerCharacteristic, boundaryLoops;
};

std::ostream& operator<<(std::ostream& out, const Joining& joining)
{
	return out << joining.name;
}

class JoinedVertices : public ::testing::TestWithParam<Joining>
{
};

Parametrization mapOf(const SurfaceMesh& mesh, JoinSplitVertices join)
{
	Options options;
	options.join = join;
	return parametrizeEuclidean(mesh, {}, options);
}

/// A closed surface has components, of genus 0 each here but the torus; a sheet has one loop.
TEST_P(JoinedVertices, MakeTheSurfaceThatIsMeant)
{
	const Joining& joining = GetParam();
	const Report report = mapOf(joining.mesh, JoinSplitVertices::Always).report;
	EXPECT_EQ(report.components, joining.components);
	EXPECT_EQ(report.eulerCharacteristic, joining.eulerCharacteristic);
	EXPECT_EQ(report.boundaryLoops, joining.boundaryLoops);
	EXPECT_EQ(report.cutNonmanifoldEdges, 0);
	EXPECT_EQ(report.splitVertices, 0);
	EXPECT_EQ(report.degenerateFaces, 0);
	EXPECT_EQ(report.flippedFaces + report.flippedByRounding, 0);
}

std::vector<Joining> joinings()
{
	const SurfaceMesh box = cube(), next = moved(cube(), {1, 0, 0}),
					  diagonal = moved(cube(), {1, 1, 0});
	const std::array<double, 3> angles{0.7, 1.9, 0.4};
	SurfaceMesh many;
	for (int i = 0; i < 27; ++i)
		many = i == 0
				   ? box
				   : together(many, moved(box, {double(i % 3), double(i / 3 % 3), double(i / 9)}));
	SurfaceMesh split = box; // four corners have a second vertex, on the other side of a seam
	for (int v = 0; v < 4; ++v)
		split.positions.push_back(box.positions[at(v)]);
	for (std::size_t f = 0; f < 4; ++f)
		for (int& v : split.triangles[f])
			v += v < 4 ? 8 : 0;
	const SurfaceMesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
	const SurfaceMesh three{
		{{0, 0, 0},
		 {0, 1, 0},
		 {1, 0, 0},
		 {0, 0, 0},
		 {0, 1, 0},
		 {0, 0, 1},
		 {0, 0, 0},
		 {0, 1, 0},
		 {-1, 0, 0}},
		{{0, 1, 2}, {4, 3, 5}, {6, 7, 8}}};
	const SurfaceMesh turnedOver{
		{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, -1, 0}},
		{{0, 1, 2}, {3, 4, 5}}};
	SurfaceMesh crossed =
		rectangle(1, 1, 1, 1); // the other side of a square, along the other diagonal
	crossed.triangles = {{0, 1, 2}, {1, 3, 2}};
	SurfaceMesh negativeZero = soup(box);
	for (std::size_t v = 0; v < negativeZero.positions.size(); v += 2)
		for (double& x : negativeZero.positions[v])
			x = x == 0.0 ? -0.0 : x;
	return {
		{"SoupOfASphere", soup(sphere(8, 12)), 1, 2, 0},
		{"SoupOfASphereInFloats", inFloats(soup(sphere(8, 12))), 1, 2, 0},
		{"BoxOfSquares", cubeOfSquares(), 1, 2, 0},
		{"SoupOfABox", soup(box), 1, 2, 0},
		{"ZerosOfBothSigns", negativeZero, 1, 2, 0},
		{"BoxWithASeam", split, 1, 2, 0},
		{"SoupOfATorus", soup(torus(3, 1, 12, 8)), 1, 0, 0},
		{"SoupOfAThinSlab", soup(stretched(box, {1, 1, 1e-4})), 1, 2, 0},
		{"SoupOfABoxHalfOfItTurned", soup(withReversedFaces(box, 2)), 1, 2, 0},
		{"TouchingBoxes", together(box, next), 2, 4, 0},
		{"TouchingBoxesAsSoup", soup(together(box, next)), 2, 4, 0},
		{"TouchingBoxesOfSquares",
		 together(cubeOfSquares(), moved(cubeOfSquares(), {1, 0, 0})),
		 2,
		 4,
		 0},
		{"TouchingBoxesTurned", inFloats(soup(turned(together(box, next), angles))), 2, 4, 0},
		{"ABoxTouchesSoup", together(box, soup(next)), 2, 4, 0},
		{"BoxesInABlock", soup(many), 27, 54, 0},
		{"BoxesWithACommonEdge", together(box, diagonal), 2, 4, 0},
		{"BoxesWithACommonEdgeAsSoup", soup(together(box, diagonal)), 2, 4, 0},
		{"Leaf", doubleSided(triangle), 2, 2, 2},
		{"SquareLeaf", doubleSided(rectangle(1, 1, 1, 1)), 2, 2, 2},
		{"SquareLeafAsSoup", soup(doubleSided(rectangle(1, 1, 1, 1))), 2, 2, 2},
		{"CrossedLeaf", together(rectangle(1, 1, 1, 1), crossed), 2, 2, 2},
		{"DoubleSidedSphere", doubleSided(sphere(8, 12)), 2, 4, 0},
		{"DoubleSidedSphereAsSoup", soup(doubleSided(sphere(8, 12))), 2, 4, 0},
		{"BookOfThreePages", three, 2, 2, 2},
		{"SheetHalfOfItTurned", turnedOver, 1, 1, 1}};
}

INSTANTIATE_TEST_SUITE_P(Tried, JoinedVertices, ::testing::ValuesIn(joinings()), CallName());

/// Halves of a soup that are parts of their own are joined within themselves, as each by itself.
TEST(SplitVertices, OfDifferentPartsStayApart)
{
	SurfaceMesh mesh = soup(torus(3, 1, 12, 8));
	const std::size_t half = mesh.positions.size() / 2;
	const auto report = [&](JoinSplitVertices join) { return mapOf(mesh, join).report; };
	const int joined = report(JoinSplitVertices::Always).joinedEdges;
	EXPECT_EQ(joined, static_cast<int>(3 * mesh.triangles.size() / 2));
	mesh.part.assign(mesh.positions.size(), 5);
	EXPECT_EQ(report(JoinSplitVertices::Always).joinedEdges, joined);
	std::fill(mesh.part.begin() + static_cast<std::ptrdiff_t>(half), mesh.part.end(), -1);
	for (const JoinSplitVertices join : {JoinSplitVertices::Automatic, JoinSplitVertices::Always}) {
		const Report r = report(join);
		EXPECT_EQ(r.components, 2); // two tubes
		EXPECT_EQ(r.boundaryLoops, 4);
		EXPECT_EQ(r.joinedEdges, joined - 2 * 8);
		EXPECT_EQ(r.piecesApart, 0);
	}
	// Beside a part that shares its vertices, but for cuts that may be meant.
	SurfaceMesh other = cube();
	for (int v = 0; v < 4; ++v)
		other.positions.push_back(other.positions[at(v)]);
	for (std::size_t f = 0; f < 2; ++f)
		for (int& v : other.triangles[f])
			v += 8;
	for (int i = 0; i < 40; ++i)
		other = sideBySide(other, cube(), 2.0 + 2 * i);
	const std::size_t count = mesh.positions.size();
	mesh = sideBySide(mesh, other, 10.0);
	mesh.part.assign(mesh.positions.size(), 0);
	const Report whole = report(JoinSplitVertices::Automatic);
	std::fill(mesh.part.begin() + static_cast<std::ptrdiff_t>(count), mesh.part.end(), 1);
	const Report parts = report(JoinSplitVertices::Automatic);
	EXPECT_EQ(whole.joinedEdges, 0);
	EXPECT_EQ(whole.piecesApart, static_cast<int>(count) / 3 - 1 + 1);
	EXPECT_EQ(parts.joinedEdges, joined);
	EXPECT_EQ(parts.piecesApart, 1);
}

/// As many closed surfaces as bodies that cells make across their squares, whatever other bodies touch them. Two
/// edges of one body that have the same ends are opened, as those of any mesh.
TEST(SplitVertices, ArePairedInsideTheBodies)
{
	int closed = 0;
	for (std::uint64_t seed = 1; seed <= 8; ++seed) {
		Block block = randomBlock(seed);
		std::set<int> bodies;
		forCells([&](const auto& cell) {
			if (in(block, cell) != 0)
				bodies.insert(in(block, cell));
		});
		const Report report = mapOf(surfaceOf(block), JoinSplitVertices::Always).report;
		if (report.cutNonmanifoldEdges > 0)
			continue;
		++closed;
		EXPECT_EQ(report.boundaryLoops, 0);
		EXPECT_EQ(report.splitVertices, 0);
		EXPECT_EQ(report.components, static_cast<int>(bodies.size()));
		EXPECT_GT(report.components, 5);
	}
	EXPECT_GE(closed, 4);
}

/// The corners of the map do not depend on how vertices are shared, nor on what the mesh is mapped to.
TEST(SplitVertices, GiveTheMapOfTheMeshThatSharesThem)
{
	for (const SurfaceMesh& mesh : {sphere(8, 12), torus(3, 1, 12, 8), cube()}) {
		const SurfaceMesh split = soup(mesh);
		for (const OutputTriangulation output : kOutputs) {
			Options options;
			options.output = output;
			const Parametrization shared = parametrizeEuclidean(mesh, {}, options),
								  map = parametrizeEuclidean(split, {}, options);
			EXPECT_EQ(2 * map.report.joinedEdges, static_cast<int>(split.positions.size()));
			EXPECT_EQ(map.mesh.corners(), shared.mesh.corners());
			EXPECT_EQ(map.mesh.face, shared.mesh.face);
			const std::vector<Point3> place = map.mesh.onSurface(split.positions);
			for (const int f : map.mesh.face.indices()) {
				const std::size_t face = at(map.mesh.face[f]);
				for (const Corner c : cornersOf(f)) {
					const int v = map.mesh.vertices[c], w = shared.mesh.vertices[c];
					if (at(w) < mesh.positions.size()) {
						const auto& own = split.triangles[face];
						EXPECT_NE(std::find(own.begin(), own.end(), v), own.end());
						EXPECT_EQ(place[at(v)], mesh.positions[at(w)]);
						EXPECT_EQ(map.u[at(v)], shared.u[at(w)]);
						EXPECT_EQ(map.targetCurvature[at(v)], shared.targetCurvature[at(w)]);
						EXPECT_NEAR(map.vertexQC[at(v)], shared.vertexQC[at(w)], 1e-12);
					}
				}
			}
		}
	}
}

TEST(SplitVertices, GiveTheSphereOfTheMeshThatSharesThem)
{
	const SurfaceMesh mesh = sphere(8, 12), split = soup(mesh);
	const SphereMap shared = mapToSphere(mesh, {}), map = mapToSphere(split, {});
	EXPECT_EQ(map.triangles, split.triangles);
	ASSERT_EQ(map.positions.size(), split.positions.size());
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k)
			EXPECT_EQ(
				map.positions[at(split.triangles[f][k])],
				shared.positions[at(mesh.triangles[f][k])]);
}

TEST(SplitVertices, AreJoinedForTheDisk)
{
	const SurfaceMesh mesh = perforatedSlab(2, 2), split = soup(mesh);
	const Parametrization shared = parametrizeHyperbolic(mesh, {}, {}),
						  map = parametrizeHyperbolic(split, {}, {});
	EXPECT_EQ(map.report.genus, 2);
	EXPECT_EQ(map.mesh.corners(), shared.mesh.corners());
}

/// A vertex is selected where one that is given for it is.
TEST(SplitVertices, AreSelectedTogether)
{
	const SurfaceMesh split = soup(cube());
	VertexInput input;
	input.selected.assign(split.positions.size(), 0);
	std::set<Point3> places;
	for (std::size_t v = 0; v < split.positions.size(); ++v)
		input.selected[v] = places.insert(split.positions[v]).second;
	Options options;
	options.target = TargetCurvature::SelectedCones;
	const Parametrization map = parametrizeEuclidean(split, input, options);
	for (const double k : map.targetCurvature)
		EXPECT_NEAR(k, 4.0 * kPi / 8.0, 1e-12);
}

/// By itself only what shares next to nothing is joined; what could be is counted and told.
TEST(SplitVertices, OfMeshesThatShareOthersStayApart)
{
	const SurfaceMesh mesh = cubeOfSquares(); // a third of its sides is shared
	const Parametrization map = mapOf(mesh, JoinSplitVertices::Automatic);
	EXPECT_EQ(map.report.joinedEdges, 0);
	EXPECT_EQ(map.report.components, 6);
	EXPECT_EQ(map.report.piecesApart, 5);
	EXPECT_TRUE(std::any_of(map.notes.begin(), map.notes.end(), [](const std::string& note) {
		return note.find("5 pieces touch others along edges without sharing vertices and") == 0;
	}));
	const Parametrization never = mapOf(soup(cube()), JoinSplitVertices::Never);
	EXPECT_EQ(never.report.components, 12);
	EXPECT_EQ(never.report.piecesApart, 0);
	EXPECT_EQ(mapOf(mesh, JoinSplitVertices::Always).report.joinedEdges, 12);
	EXPECT_EQ(mapOf(soup(cube()), JoinSplitVertices::Automatic).report.components, 1);
	EXPECT_EQ(mapOf(together(cube(), moved(cube(), {1, 0, 0})), {}).report.piecesApart, 0);
}

/// Seams are opened where vertices are joined, too.
TEST(SplitVertices, AreCutAtChosenSeams)
{
	SurfaceMesh mesh = cubeOfSquares();
	mesh.seam.assign(mesh.triangles.size(), {0, 0, 0});
	for (std::size_t f = 0; f < 2; ++f) // round the first square
		for (std::size_t k = 0; k < 3; ++k) {
			const Point3 &p = mesh.positions[at(mesh.triangles[f][k])],
						 &q = mesh.positions[at(mesh.triangles[f][(k + 1) % 3])];
			mesh.seam[f][k] = distance(p, q) < 1.1;
		}
	const Report report = mapOf(mesh, JoinSplitVertices::Always).report;
	EXPECT_EQ(report.components, 2);
	EXPECT_EQ(report.chosenSeamEdges, 4);
	EXPECT_EQ(report.boundaryLoops, 2);
}

/// Slivers on an edge are joined to both their neighbours: a soup of a square with a vertex on its diagonal.
TEST(SplitVertices, OfFacesWithoutAreaAreJoined)
{
	const SurfaceMesh mesh = soup(
		{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}},
		 {{0, 1, 2}, {0, 2, 4}, {0, 4, 3}, {4, 2, 3}}});
	const Report report = mapOf(mesh, JoinSplitVertices::Automatic).report;
	EXPECT_EQ(report.components, 1);
	EXPECT_EQ(report.joinedEdges, 4);
	EXPECT_EQ(report.eulerCharacteristic, 1);
}

} // namespace
} // namespace ricci::testing
