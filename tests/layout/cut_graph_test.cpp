// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/error.h>
#include <ricci/flow/target_curvature.h>
#include <ricci/layout/cut_graph.h>
#include <ricci/layout/planar_layout.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ricci::testing {
namespace {

/// The cut opens the surface to a disk and knows how many edges it has.
void expectCutToADisk(const Triangulation& t, const CutGraph& cut)
{
	expectOpensToADisk(t, cut.isCut);
	EXPECT_EQ(cut.edgeCount, std::count(cut.isCut.begin(), cut.isCut.end(), 1));
}

double lengthOf(const CutGraph& cut, const std::vector<double>& lengths)
{
	double sum = 0.0;
	for (std::size_t e = 0; e < lengths.size(); ++e)
		sum += cut.isCut[e] ? lengths[e] : 0.0;
	return sum;
}

TEST(CutGraph, OpensSurfacesOfEveryKindToADisk)
{
	Random random(130);
	std::vector<SurfaceMesh> meshes = surfacesOfEveryKind(random);
	meshes.push_back(randomPlanarDisk(6, random));
	for (const SurfaceMesh& mesh : meshes) {
		const Packed packed(mesh);
		const Topology topology = topologyOf(packed.triangulation);
		SCOPED_TRACE(topology.name());
		for (int cones : {0, 1, 4}) {
			std::vector<char> marked(mesh.positions.size(), 0);
			for (int i = 0; i < cones; ++i)
				marked[at(random.index(static_cast<int>(marked.size())))] = 1;
			const CutGraph cut = cutToDisk(packed.triangulation, packed.lengths, marked, {});
			const bool isSphere = topology.isClosed() && topology.genus == 0;
			if (isSphere && std::count(marked.begin(), marked.end(), 1) < 2)
				continue; // a sphere without two cones needs no cut and has no flat metric
			expectCutToADisk(packed.triangulation, cut);
			EXPECT_EQ(static_cast<int>(cut.generators.size()), 2 * topology.genus);
			for (int e : cut.generators)
				EXPECT_TRUE(cut.isCut[at(e)]);
			EXPECT_NEAR(cut.length, lengthOf(cut, packed.lengths), 1e-12 * (1 + cut.length));
			// Every marked vertex is on the cut or on the boundary.
			for (std::size_t v = 0; v < marked.size(); ++v) {
				bool reached = !marked[v] || topology.boundary[v];
				for (int h = 0; h < packed.triangulation.halfedgeCount() && !reached; ++h)
					reached = packed.triangulation.origin(h) == static_cast<int>(v) &&
							  cut.isCut[at(Triangulation::edge(h))];
				EXPECT_TRUE(reached) << "vertex " << v;
			}
		}
	}
}

TEST(CutGraph, LeavesADiskAlone)
{
	Random random(131);
	const Packed packed(randomPlanarDisk(6, random));
	const auto cut = cutToDisk(
		packed.triangulation, packed.lengths, std::vector<char>(packed.radii.size(), 0), {});
	EXPECT_EQ(cut.edgeCount, 0);
	EXPECT_EQ(cut.length, 0.0);
}

TEST(CutGraph, HasNoDeadEnds)
{
	Random random(132);
	for (int genus : {1, 2, 3}) {
		const Packed packed(shaken(perforatedSlab(genus, 3), 0.03, random));
		const auto cut = cutToDisk(
			packed.triangulation, packed.lengths, std::vector<char>(packed.radii.size(), 0), {});
		std::vector<int> degree(packed.radii.size(), 0);
		for (int h = 0; h < packed.triangulation.halfedgeCount(); ++h)
			degree[at(packed.triangulation.origin(h))] += cut.isCut[at(Triangulation::edge(h))];
		EXPECT_EQ(std::count(degree.begin(), degree.end(), 1), 0);
	}
}

TEST(CutGraph, IsShortestAcrossAnAnnulus)
{
	// On a planar ring the least cut is one radial line of edges.
	const Packed packed(ring(1, 4, 12, 5));
	const auto cut = cutToDisk(
		packed.triangulation, packed.lengths, std::vector<char>(packed.radii.size(), 0), {});
	EXPECT_EQ(cut.edgeCount, 5);
	EXPECT_NEAR(cut.length, 3.0, 1e-12);
}

TEST(CutGraph, OnATorusIsNoLongerThanTheTwoObviousLoops)
{
	// A flat torus, 9 x 20 units: one loop of edges round each way, which are shortest.
	const Packed torusGrid(torus(3, 1, 20, 9));
	for (double width : {0.2, 1.0, 3.0}) {
		std::vector<double> lengths;
		const Triangulation& t = torusGrid.triangulation;
		for (int e = 0; e < t.edgeCount(); ++e) {
			const int a = t.origin(2 * e), b = t.target(2 * e);
			const bool sameColumn = a / 9 == b / 9, sameRow = a % 9 == b % 9;
			lengths.push_back(sameColumn ? 1.0 : sameRow ? width : std::hypot(1.0, width));
		}
		const auto cut = cutToDisk(t, lengths, std::vector<char>(torusGrid.radii.size(), 0), {});
		expectCutToADisk(t, cut);
		EXPECT_LE(cut.length, 9.0 + 20.0 * width + 1e-9);
		// Two generating loops are at least as long as the two shortest of the lattice, less what
		// they share: a cut graph contains a loop of each class that a generator crosses.
		EXPECT_GE(cut.length, std::max(9.0, 20.0 * width) - 1e-9);
	}
}

TEST(CutGraph, IsDeterministic)
{
	Random random(133);
	const Packed packed(shaken(perforatedSlab(2, 3), 0.03, random));
	const std::vector<char> unmarked(packed.radii.size(), 0);
	const auto first = cutToDisk(packed.triangulation, packed.lengths, unmarked, {});
	for (int i = 0; i < 3; ++i) {
		const auto again = cutToDisk(packed.triangulation, packed.lengths, unmarked, {});
		EXPECT_EQ(again.isCut, first.isCut);
		EXPECT_EQ(again.generators, first.generators);
	}
}

TEST(CutGraph, KeepsOffForbiddenEdges)
{
	Random random(134);
	const Packed packed(bumpyTorus(14, 9, random));
	const std::vector<char> unmarked(packed.radii.size(), 0);
	std::vector<char> forbidden(packed.lengths.size(), 0);
	const auto free = cutToDisk(packed.triangulation, packed.lengths, unmarked, forbidden);
	for (std::size_t e = 0; e < forbidden.size(); e += 2)
		forbidden[e] = free.isCut[e];
	ASSERT_GT(std::count(forbidden.begin(), forbidden.end(), 1), 3);
	const auto cut = cutToDisk(packed.triangulation, packed.lengths, unmarked, forbidden);
	expectCutToADisk(packed.triangulation, cut);
	for (std::size_t e = 0; e < forbidden.size(); ++e)
		EXPECT_FALSE(forbidden[e] && cut.isCut[e]);
	// Not where the forbidden edges leave no way.
	std::fill(forbidden.begin(), forbidden.end(), 1);
	EXPECT_THROW(cutToDisk(packed.triangulation, packed.lengths, unmarked, forbidden), Error);
}

} // namespace
} // namespace ricci::testing
