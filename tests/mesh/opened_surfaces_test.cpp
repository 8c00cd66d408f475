// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces that are cut open before the flow, as the report and the map show them.
#include "support/bad_surfaces.h"
#include "support/expect.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/error.h>
#include <ricci/parametrize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

/// One chart for each component.
Parametrization mapOf(const SurfaceMesh& mesh, Holes holes = Holes::Boundaries)
{
	Options options;
	options.charts = Charts::OfTheFlow;
	options.holes = holes;
	options.cones.distortion = 100.0; // no cones where there is a boundary
	return parametrizeEuclidean(mesh, {}, options);
}

struct Case
{
	std::string name;
	SurfaceMesh mesh;
	int components = 1, genus = 0, loops = 0; ///< sums over the components
	int cutEdges = 0, splitVertices = 0, duplicates = 0, oneSided = 0, degenerate = 0;
};

std::vector<Case> cases()
{
	std::vector<Case> all{
		{"tetrahedron", tetrahedron(), 1, 0, 0},
		{"rectangle", rectangle(2, 3, 1, 1), 1, 0, 1},
		{"genus 2", perforatedSlab(2, 1), 1, 2, 0},
		{"torus", torus(2, 1, 8, 6), 1, 1, 0},
		{"two surfaces", sideBySide(perforatedSlab(2, 1), ring(1, 2, 9, 3), 10), 2, 2, 2},
		{"square with fin", squareWithFin(), 2, 0, 2, 1, 2},
		{"bow tie", bowTie(), 2, 0, 2, 0, 1},
		{"touching tetrahedra", touchingTetrahedra(), 2, 0, 0, 0, 1},
		{"pinched sphere", pinchedSphere(), 1, 0, 0, 0, 1, 0, 0, 24},
		{"pillow", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}}, 2, 0, 2, 3, 3, 1},
		{"doubled torus", doubled(torus(2, 1, 9, 7), false), 2, 2, 0, 189, 63, 126},
		{"doubled, turned torus", doubled(torus(2, 1, 9, 7), true), 2, 2, 0, 189, 63, 126},
		{"doubled rectangle", doubled(rectangle(3, 2, 1, 1), false), 2, 0, 2, 23, 12, 12},
		{"doubled tetrahedron", doubled(tetrahedron(), true), 2, 0, 0, 6, 4, 4},
		// Across, from border to border. The projective plane becomes a disk, with Euler characteristic 1
		// as before, and the Klein bottle, with 0, an annulus.
		{"Moebius band", moebiusBand(9), 1, 0, 1, 0, 2, 0, 1},
		{"two bands", sideBySide(moebiusBand(9), moebiusBand(8), 10), 2, 0, 2, 0, 4, 0, 2},
		{"projective plane", projectivePlane(8), 1, 0, 1, 0, -1, 0, 1},
		{"Klein bottle", figureEightBottle(24, 16), 1, 0, 2, 0, -1, 0, 1}};
	for (int sheets = 3; sheets <= 90; sheets = sheets < 8 ? sheets + 1 : 3 * sheets) {
		const int pairs = (sheets + 1) / 2;
		all.push_back({std::to_string(sheets) + " sheets", book(sheets, 3), pairs, 0, pairs, 3, 4});
	}
	// The two edges that the crossing makes have the same ends, and so have the two sides of each once they
	// are cut: one side more is cut in each tetrahedron, which opens it to a disk. No face comes off.
	for (int first = 0; first < 3; ++first)
		all.push_back({"crossing tetrahedra", crossingTetrahedra(first), 2, 0, 2, 1, 2});
	SurfaceMesh line = rectangle(1, 1, 1, 1); // and a component on a line
	for (const Triangle& t : {Triangle{0, 1, 1}, Triangle{2, 2, 2}, Triangle{4, 5, 6}})
		line.triangles.push_back(t);
	for (double x : {5.0, 6.0, 7.0})
		line.positions.push_back({x, 0.0, 0.0});
	all.push_back({"faces without area", line, 1, 0, 1, 0, 0, 0, 0, 3});
	return all;
}

TEST(OpenedSurfaces, HaveTheTopologyThatTheirCutsLeave)
{
	Random random(9);
	for (const Case& c : cases()) {
		SCOPED_TRACE(c.name);
		std::vector<SurfaceMesh> meshes{c.mesh};
		if (c.name.find_first_of("13579") == std::string::npos) // or its pairs are not clear
			meshes.push_back(renumbered(c.mesh, random).mesh);
		for (const SurfaceMesh& mesh : meshes) {
			const Parametrization map = mapOf(mesh);
			const Report& r = map.report;
			EXPECT_EQ(r.components, c.components);
			EXPECT_EQ(r.charts, c.components);
			EXPECT_EQ(r.genus, c.genus);
			EXPECT_EQ(r.boundaryLoops, c.loops);
			EXPECT_EQ(r.eulerCharacteristic, 2 * c.components - 2 * c.genus - c.loops);
			EXPECT_EQ(r.cutNonmanifoldEdges, c.cutEdges);
			EXPECT_EQ(r.duplicateFaces, c.duplicates);
			EXPECT_EQ(r.oneSidedComponents, c.oneSided);
			EXPECT_EQ(r.degenerateFaces, c.degenerate);
			if (c.splitVertices >= 0) {
				EXPECT_EQ(r.splitVertices, c.splitVertices);
			}
			EXPECT_EQ(r.flippedFaces, 0);
			// Every face is drawn once, with its own vertices.
			ASSERT_EQ(at(map.mesh.size()), mesh.triangles.size());
			for (const int f : map.mesh.face.indices()) {
				EXPECT_EQ(map.mesh.face[f], f);
				EXPECT_EQ(map.mesh.vertices[f], mesh.triangles[at(f)]);
			}
		}
	}
}

/// Straight on where that is possible: pairs of opposite sheets, and an odd one left over.
TEST(OpenedSurfaces, PairTheSheetsOfABookStraightOn)
{
	for (const int sheets : {3, 4, 6, 7, 20, 24}) {
		SCOPED_TRACE(sheets);
		const int n = 3, faces = 2 * n * n;
		const Parametrization map = mapOf(book(sheets, n));
		std::map<int, std::set<int>> sheetsOf; // [chart]
		for (const int f : map.mesh.chart.indices())
			sheetsOf[map.mesh.chart[f]].insert(f / faces);
		ASSERT_EQ(sheetsOf.size(), at((sheets + 1) / 2));
		int alone = 0;
		for (const auto& [chart, pair] : sheetsOf) {
			alone += pair.size() == 1;
			if (sheets % 2 == 0) {
				EXPECT_EQ(*pair.rbegin() - *pair.begin(), sheets / 2);
			}
		}
		EXPECT_EQ(alone, sheets % 2);
	}
}

/// Whether two faces have two points of the map in common.
bool areJoined(const Parametrization& map, int f, int g)
{
	int shared = 0;
	for (const int p : map.mesh.points[f])
		shared += std::count(map.mesh.points[g].begin(), map.mesh.points[g].end(), p) > 0;
	return shared == 2;
}

/// 1 at the faces that the map draws clockwise.
std::vector<int> clockwiseFaces(const Parametrization& map)
{
	std::vector<int> clockwise;
	for (const Triangle2& t : map.mesh.corners())
		clockwise.push_back(doubledArea(t[0], t[1], t[2]) < 0.0);
	return clockwise;
}

/// Most triangles of a strip decide its orientation.
TEST(OpenedSurfaces, PairCoherentSheetsThatAreNearlyAsSmooth)
{
	for (std::size_t turned = 0; turned < 4; ++turned) {
		SCOPED_TRACE(turned);
		SurfaceMesh mesh = threeStrips();
		if (turned < 3)
			mesh.triangles[turned] = reversed(mesh.triangles[turned]);
		const Parametrization map = mapOf(mesh);
		EXPECT_EQ(map.report.cutNonmanifoldEdges, 1);
		EXPECT_TRUE(areJoined(map, 0, 6));
		EXPECT_FALSE(areJoined(map, 0, 3));
		EXPECT_FALSE(areJoined(map, 3, 6));
		std::vector<int> expected(9, 0);
		if (turned < 3)
			expected[turned] = 1;
		EXPECT_EQ(clockwiseFaces(map), expected);
	}
}

TEST(OpenedSurfaces, TurnTheMinorityOfAComponent)
{
	Random random(3);
	SurfaceMesh mixed = perforatedSlab(1, 2);
	std::vector<int> turned;
	for (Triangle& t : mixed.triangles) {
		turned.push_back(random.real(0, 1) < 0.3);
		if (turned.back())
			t = reversed(t);
	}
	const Parametrization map = mapOf(mixed);
	EXPECT_EQ(clockwiseFaces(map), turned);
	EXPECT_EQ(map.report.flippedFaces, 0);
	ASSERT_FALSE(map.notes.empty());
	expectWords(
		map.notes[0],
		{std::to_string(std::count(turned.begin(), turned.end(), 1)) +
		 " faces were turned over for the map"});

	SurfaceMesh mesh = tetrahedron();
	mesh.triangles[0] = reversed(mesh.triangles[0]); // where the search starts
	EXPECT_EQ(clockwiseFaces(mapOf(mesh)), (std::vector<int>{1, 0, 0, 0}));
	mesh.triangles[2] = reversed(mesh.triangles[2]); // half of them: the first stays
	const std::vector<int> half = clockwiseFaces(mapOf(mesh));
	EXPECT_EQ(std::count(half.begin(), half.end(), 1), 2);
	EXPECT_EQ(half[0], 0);
}

/// The edges of the input by their ends; for each of its sides the points of the map at the lower and the higher one.
std::map<std::pair<int, int>, std::vector<std::pair<int, int>>>
pointsOfEdges(const SurfaceMesh& mesh, const Parametrization& map)
{
	std::map<std::pair<int, int>, std::vector<std::pair<int, int>>> points;
	for (const int f : map.mesh.points.indices())
		for (std::size_t k = 0; k < 3; ++k) {
			const std::size_t l = (k + 1) % 3;
			const Triangle &t = mesh.triangles[at(f)], &p = map.mesh.points[f];
			points[std::minmax(t[k], t[l])].push_back(
				t[k] < t[l] ? std::pair(p[k], p[l]) : std::pair(p[l], p[k]));
		}
	return points;
}

/// Edges of the input whose sides lie apart in the map.
int openEdges(const SurfaceMesh& mesh, const Parametrization& map)
{
	int open = 0;
	for (const auto& [ends, sides] : pointsOfEdges(mesh, map))
		open += sides.size() == 2 && sides[0] != sides[1];
	return open;
}

/// Nothing but the marked edges and the flow's own cuts comes apart, and what has to so that a seam has two sides.
TEST(OpenedSurfaces, AreOpenAlongSeamsAndNowhereElse)
{
	Random random(11);
	for (SurfaceMesh mesh :
		 {tetrahedron(),
		  torus(3.0, 1.0, 7, 6),
		  rectangle(5, 4, 5.0, 4.0),
		  perforatedSlab(2, 1),
		  ring(1.0, 2.0, 9, 3)})
		for (const double share : {0.005, 0.02, 0.1, 0.3, 1.0})
			for (int run = 0; run < 4; ++run) {
				mesh.seam.assign(mesh.triangles.size(), {0, 0, 0});
				std::set<std::pair<int, int>> marked;
				for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
					for (std::size_t k = 0; k < 3; ++k)
						if (random.real(0.0, 1.0) < share) {
							mesh.seam[f][k] = 1;
							const Triangle& t = mesh.triangles[f];
							marked.insert(std::minmax(t[k], t[(k + 1) % 3]));
						}
				const Parametrization map = mapOf(mesh);
				int chosen = 0;
				for (const auto& [ends, sides] : pointsOfEdges(mesh, map))
					if (sides.size() == 2 && marked.count(ends) > 0) {
						++chosen;
						EXPECT_FALSE(sides[0] == sides[1]);
					}
				EXPECT_GE(map.report.chosenSeamEdges, chosen);
				EXPECT_LE(
					map.report.chosenSeamEdges, 2 * chosen); // a lone edge goes on along one more
				EXPECT_EQ(openEdges(mesh, map), map.report.chosenSeamEdges + map.report.seamEdges);
				EXPECT_EQ(map.report.splitVertices, 0);
				EXPECT_EQ(map.report.cutNonmanifoldEdges, 0);
			}
}

/// Cut along one loop through each crosscap the surface is a disk with as many holes. Three edges go
/// round a crosscap, a loop from a vertex beside it may take a few more. Each loop takes time in proportion to
/// the surface: after 64 of them what is left is cut at once, wherever an orientation does not fit, along
/// curves from one crosscap to the next.
TEST(OpenedSurfaces, AreCutAlongALoopThroughEachCrosscap)
{
	Random random(951);
	for (const int count : {1, 2, 7, 20, 64, 70}) {
		SCOPED_TRACE(count);
		SurfaceMesh mesh = crosscaps(count);
		for (Triangle& t : mesh.triangles) // so that their orders say nothing of the surface
			if (random.index(2) == 0)
				t = reversed(t);
		const Parametrization map = mapOf(mesh);
		EXPECT_EQ(map.report.oneSidedComponents, 1);
		EXPECT_EQ(map.report.genus, 0);
		if (count > 64) {
			EXPECT_LT(map.report.boundaryLoops, 1 + count);
			EXPECT_GT(map.report.boundaryLoops, 64);
			continue;
		}
		EXPECT_EQ(map.report.boundaryLoops, 1 + count);
		const int cut = openEdges(mesh, map) - map.report.seamEdges;
		EXPECT_GE(cut, 3 * count);
		EXPECT_LE(cut, 6 * count);
	}
}

TEST(OpenedSurfaces, HaveTheirComponentsInTheOrderOfTheLowestFaces)
{
	const SurfaceMesh both = sideBySide(tetrahedron(), rectangle(2, 2, 1, 1), 5);
	Random random(4);
	const Renumbered other = renumbered(both, random);
	const Parametrization map = mapOf(other.mesh);
	ASSERT_EQ(map.charts.size(), 2u);
	const bool isTetrahedron = other.face[0] < 4;
	for (const int f : map.mesh.chart.indices())
		EXPECT_EQ(map.mesh.chart[f], (other.face[at(f)] < 4) == isTetrahedron ? 0 : 1);
}

/// A square of 1 with a hole: a smaller square less two opposite corners, cut off from the middles of sides. It
/// is short if its length is below a tenth of the root of the area.
TEST(OpenedSurfaces, ShortHolesAreThoseBelowATenthOfTheRootOfTheArea)
{
	for (const double scale : {1.0, 1e6})
		for (const double side : {0.0280, 0.0292, 0.0294, 0.04}) {
			SurfaceMesh mesh = withoutStars(rectangle(6, 6, 1.0, 1.0), {16});
			const Point3 centre{2.0 / 6, 2.0 / 6, 0.0};
			for (Point3& p : mesh.positions) {
				const Point3 d = p - centre;
				const double far = std::max(std::abs(d[0]), std::abs(d[1]));
				if (far < 0.2)
					p = centre + (0.5 * side / far) * d;
			}
			const bool isShort =
				(2 + std::sqrt(2.0)) * side < 0.1 * std::sqrt(1.0 - 0.75 * side * side);
			const Parametrization map = mapOf(scaled(mesh, scale), Holes::ShortCapped);
			EXPECT_EQ(map.report.cappedHoles, isShort ? 1 : 0) << side;
			EXPECT_EQ(map.report.boundaryLoops, 2);
			EXPECT_EQ(map.report.seamEdges > 0, !isShort); // from the hole to the border
		}
}

/// refusals_test.cpp has what else is refused. Boundary edges run upwards and downwards in their faces.
TEST(OpenedSurfaces, AreRefusedWithTheNumberOfEdgesWithoutLength)
{
	const SurfaceMesh square = rectangle(1, 1, 1, 1), inside = rectangle(3, 3, 1, 1);
	const struct
	{
		SurfaceMesh mesh;
		std::vector<int> moved;
		int to;
		std::size_t count;
	} cases[] = {
		{square, {1}, 0, 1}, {square, {2}, 0, 1}, {inside, {5}, 6, 1}, {inside, {5, 10}, 6, 3}};
	Options options;
	options.method = Method::FixedTriangles;
	for (const auto& c : cases) {
		SurfaceMesh mesh = c.mesh;
		for (const int v : c.moved)
			mesh.positions[at(v)] = mesh.positions[at(c.to)];
		const auto error = refusalFor<InvalidMesh>(
			InvalidMesh::EdgesWithoutLength, {}, [&] { parametrizeEuclidean(mesh, {}, options); });
		EXPECT_EQ(error.count, c.count);
	}
	for (const double size : {3.4e38, 1e-38}) // what single precision has
		EXPECT_NO_THROW(parametrizeEuclidean(scaled(square, size), {}, options)) << size;
}

} // namespace
} // namespace ricci::testing
