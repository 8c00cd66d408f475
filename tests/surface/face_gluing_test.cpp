// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/surface/component.h>
#include <ricci/surface/face_gluing.h>
#include <ricci/surface/opened_mesh.h>
#include <ricci/surface/triangulation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

SurfaceType typeOf(const OpenedMesh& mesh)
{
	const std::vector<Component> components = splitIntoComponents(mesh);
	EXPECT_EQ(components.size(), 1u);
	const Component& c = components.front();
	return topologyOf(Triangulation(c.positions.size(), c.triangles)).type;
}

/// Sides without another, and their length.
std::pair<int, double> border(const SurfaceMesh& mesh)
{
	std::map<std::pair<int, int>, int> sides;
	for (const Triangle& t : mesh.triangles)
		for (std::size_t k = 0; k < 3; ++k)
			++sides[std::minmax(t[k], t[(k + 1) % 3])];
	std::pair<int, double> sum{0, 0.0};
	for (const auto& [ends, count] : sides)
		if (count == 1) {
			++sum.first;
			sum.second += distance(mesh.positions[at(ends.first)], mesh.positions[at(ends.second)]);
		}
	return sum;
}

/// Turns faces by chance, so that their orders say nothing of the surface.
void shuffleOrders(SurfaceMesh& mesh, Random& random)
{
	for (Triangle& t : mesh.triangles)
		if (random.index(2) == 0)
			std::swap(t[1], t[2]);
}

/// Length of the edges at which both faces run the same way.
double incoherentLength(const SurfaceMesh& mesh)
{
	std::map<std::pair<int, int>, int> runs;
	for (const Triangle& t : mesh.triangles)
		for (std::size_t k = 0; k < 3; ++k)
			++runs[{t[k], t[(k + 1) % 3]}];
	double length = 0.0;
	for (const auto& [ends, count] : runs)
		if (count == 2)
			length += distance(mesh.positions[at(ends.first)], mesh.positions[at(ends.second)]);
	return length;
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
		shuffleOrders(mesh, random);
		const double shortest = shortestOneSidedLoop(mesh, rootsOf(mesh));
		const OpenedMesh result = opened(mesh);
		EXPECT_EQ(result.oneSidedComponents, 1);
		const auto [sides, length] = border(result.mesh);
		const double incoherent = incoherentLength(mesh);
		// Where the orders change is another set of edges that can be cut.
		if (incoherent <= 2.0 * shortest) {
			EXPECT_NEAR(0.5 * length, incoherent, 1e-12);
			continue;
		}
		++cutByLoop;
		EXPECT_EQ(sides, 6);
		EXPECT_NEAR(0.5 * length, shortest, 1e-12);
		EXPECT_TRUE(typeOf(result).isDisk());
	}
	EXPECT_GT(cutByLoop, 100);
}

/// A row of \p count crosscaps in a rectangle: stars of vertices are taken out, and opposite points of
/// each hole identified, which leaves three edges round it.
SurfaceMesh crosscaps(int count)
{
	const int apart = 8, nx = apart * count;
	SurfaceMesh mesh = rectangle(nx, apart, nx, apart);
	std::vector<int> joined(mesh.positions.size());
	for (std::size_t v = 0; v < joined.size(); ++v)
		joined[v] = static_cast<int>(v);
	const auto vertexAt = [&](int x, int y) {
		for (std::size_t v = 0; v < mesh.positions.size(); ++v)
			if (mesh.positions[v][0] == x && mesh.positions[v][1] == y)
				return static_cast<int>(v);
		return -1;
	};
	std::set<int> centres;
	for (int i = 0; i < count; ++i) {
		const int x = apart * i + apart / 2, y = apart / 2;
		centres.insert(vertexAt(x, y));
		// The diagonals of the cells run from (x, y) to (x + 1, y + 1).
		for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)})
			joined[at(vertexAt(x - dx, y - dy))] = vertexAt(x + dx, y + dy);
	}
	std::vector<Triangle> kept;
	for (Triangle t : mesh.triangles) {
		if (std::any_of(t.begin(), t.end(), [&](int v) { return centres.count(v) > 0; }))
			continue;
		for (int& v : t)
			v = joined[at(v)];
		kept.push_back(t);
	}
	mesh.triangles = kept;
	return mesh;
}

/// Cut along one loop through each crosscap the surface is a disk with as many holes. Three edges go
/// round a crosscap, a loop from a vertex beside it may take a few more.
TEST(OneSided, EachCrosscapIsCutAlongALoopOfItsOwn)
{
	Random random(951);
	for (const int count : {1, 2, 7, 20, 64}) {
		SurfaceMesh mesh = crosscaps(count);
		const int outside = 2 * (8 * count + 8);
		ASSERT_EQ(border(mesh).first, outside);
		shuffleOrders(mesh, random);
		const OpenedMesh result = opened(mesh);
		EXPECT_EQ(result.oneSidedComponents, 1);
		const SurfaceType type = typeOf(result);
		EXPECT_EQ(type.genus, 0);
		EXPECT_EQ(type.boundaryLoops, 1 + count);
		const int cut = (border(result.mesh).first - outside) / 2;
		EXPECT_GE(cut, 3 * count);
		EXPECT_LE(cut, 6 * count);
	}
}

/// Each loop takes time in proportion to the surface. After 64 of them what is left is cut at once,
/// wherever an orientation does not fit: along curves from one crosscap to the next.
TEST(OneSided, ThereIsAnEndToLoops)
{
	Random random(952);
	SurfaceMesh mesh = crosscaps(70);
	shuffleOrders(mesh, random);
	const OpenedMesh result = opened(mesh);
	EXPECT_EQ(result.oneSidedComponents, 1);
	EXPECT_LT(typeOf(result).boundaryLoops, 1 + 70);
	EXPECT_GT(typeOf(result).boundaryLoops, 64);
}

} // namespace
} // namespace ricci::testing
