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
	const FaceGluing gluing = glueFaces(mesh.positions, triangles);
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
