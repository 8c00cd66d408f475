// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/listener.h"
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/cut/coarse_surface.h>
#include <ricci/cut/cut_graph.h>
#include <ricci/error.h>
#include <ricci/surface/triangulation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace ricci::testing {
namespace {

std::vector<SurfaceMesh> surfaces(Random& random)
{
	std::vector<SurfaceMesh> meshes = surfacesOfEveryKind(random);
	for (int genus : {0, 1, 4})
		meshes.push_back(shaken(perforatedSlab(genus, 4), 0.03, random));
	meshes.push_back(withoutStars(perforatedSlab(2, 4), {0, 40, 90}));
	meshes.push_back(bumpyTorus(60, 4, random)); // thinner than the parts of a coarse surface
	return meshes;
}

VertexArray<char> randomMarks(const Triangulation& t, int count, Random& random)
{
	VertexArray<char> marked(t.vertexCount(), 0);
	for (int i = 0; i < count; ++i)
		marked[Vertex(random.index(t.vertexCount()))] = 1;
	return marked;
}

/// Drawing trees together, and every boundary loop to a vertex, leaves the closed surface of the genus.
TEST(CoarseSurface, IsTheClosedSurfaceOfTheSameGenus)
{
	Random random(740);
	int coarser = 0;
	for (const SurfaceMesh& mesh : surfaces(random)) {
		const Packed p(mesh);
		const Triangulation& t = p.triangulation;
		const Topology topology = topologyOf(t);
		SCOPED_TRACE(topology.type.name());
		for (int count : {8, 40, 10000}) {
			const VertexArray<char> marked = randomMarks(t, 3, random);
			const CoarseSurface coarse(t, p.lengths, marked, count);
			const Triangulation& c = coarse.triangulation();
			if (c.faceCount() == 0)
				continue;
			coarser += c.vertexCount() < t.vertexCount() / 4;
			EXPECT_TRUE(c.boundaryLoops().empty());
			EXPECT_EQ(topologyOf(c).type.genus, topology.type.genus);
			int marks = topology.type.boundaryLoops;
			for (const Vertex v : t.vertices())
				marks += marked[v] && !topology.boundary[v];
			EXPECT_EQ(std::count(coarse.marked().begin(), coarse.marked().end(), 1), marks);
			for (const Vertex v : c.vertices())
				EXPECT_TRUE(c.halfedge(v).isValid());
			for (const Vertex v : t.vertices()) {
				ASSERT_TRUE(coarse.centreOf(v).isValid());
				EXPECT_TRUE(!marked[v] || coarse.marked()[coarse.centreOf(v)]);
			}
		}
	}
	EXPECT_GT(coarser, 10);
}

TEST(CoarseSurface, ItsCutsOpenTheGivenSurface)
{
	Random random(741);
	int tried = 0;
	for (const SurfaceMesh& mesh : surfaces(random)) {
		const Packed p(mesh);
		const Triangulation& t = p.triangulation;
		SCOPED_TRACE(topologyOf(t).type.name());
		for (int count : {8, 40, 10000}) {
			const VertexArray<char> marked = randomMarks(t, 4, random);
			const CoarseSurface coarse(t, p.lengths, marked, count);
			if (coarse.triangulation().faceCount() == 0)
				continue;
			const CutGraph cut = cutToDisk(coarse.triangulation(), coarse.cost(), coarse.marked());
			if (cut.edgeCount == 0)
				continue;
			++tried;
			const EdgeArray<char> isCut = coarse.lifted(cut.isCut);
			expectOpensToADisk(t, isCut);
			VertexArray<char> reached = t.boundaryVertices();
			double length = 0.0;
			for (const Edge e : t.edges())
				if (isCut[e]) {
					length += p.lengths[e];
					for (const Vertex v : t.ends(e))
						reached[v] = 1;
				}
			EXPECT_LE(length, cut.length * (1 + 1e-12)); // paths may share edges
			for (const Vertex v : t.vertices())
				EXPECT_TRUE(!marked[v] || reached[v]) << "vertex " << v.number();
		}
	}
	EXPECT_GT(tried, 20);
}

/// With every vertex for a centre nothing is drawn together.
TEST(CoarseSurface, OfMarkedVerticesIsTheSurfaceItself)
{
	Random random(742);
	const Packed p(bumpyTorus(12, 9, random));
	const Triangulation& t = p.triangulation;
	const CoarseSurface coarse(t, p.lengths, VertexArray<char>(t.vertexCount(), 1), 8);
	EXPECT_EQ(coarse.triangulation().vertexCount(), t.vertexCount());
	EXPECT_EQ(coarse.triangulation().edgeCount(), t.edgeCount());
	EXPECT_EQ(coarse.triangulation().faceCount(), t.faceCount());
	EXPECT_EQ(coarse.lifted(EdgeArray<char>(t.edgeCount(), 1)), EdgeArray<char>(t.edgeCount(), 1));
}

TEST(CoarseSurface, CanBeCancelled)
{
	Random random(743);
	const Packed p(bumpyTorus(80, 60, random));
	const VertexArray<char> unmarked(p.triangulation.vertexCount(), 0);
	Listener impatient(1);
	EXPECT_THROW(
		heard(impatient, [&] { CoarseSurface(p.triangulation, p.lengths, unmarked, 200); }),
		Cancelled);
}

} // namespace
} // namespace ricci::testing
