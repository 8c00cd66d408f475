// SPDX-License-Identifier: GPL-3.0-or-later
#include "linearised.h"

#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/curvature/cone_sites.h>
#include <ricci/curvature/linear_flow.h>
#include <ricci/math/shortest_paths.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace ricci::testing {
namespace {

std::vector<LinearCase> cases()
{
	Random random(810);
	const SurfaceMesh sphere = shaken(perforatedSlab(0, 12), 0.01, random);
	const SurfaceMesh genus1 = shaken(perforatedSlab(1, 9), 0.01, random);
	return {
		{"sphere", sphere, ConeBoundary::Fixed},
		{"genus 1", genus1, ConeBoundary::Fixed},
		{"disk, fixed boundary", withoutStars(sphere, {0}), ConeBoundary::Fixed},
		{"two holes, prescribed", withoutStars(genus1, {0, 40}), ConeBoundary::Prescribed}};
}

/// u for a unit of curvature at \p v; where the sum is fixed, less one by area.
VertexVector factorOfCone(LinearFlow& flow, Vertex v)
{
	VertexVector rhs = VertexVector::Zero(flow.vertexCount());
	if (flow.hasFixedSum())
		rhs -= flow.area();
	rhs[v] += 1.0;
	return flow.solve(rhs);
}

TEST(LinearSystem, HasTheSolutionsOfItsFlow)
{
	for (const LinearCase& c : cases()) {
		SCOPED_TRACE(c.name);
		Linearised fine(c);
		VertexArray<Vertex> vertices;
		LinearFlow same(fine.flow.system(vertices));
		EXPECT_EQ(same.hasFixedSum(), fine.flow.hasFixedSum());
		EXPECT_NEAR(same.area().sum(), 1.0, 1e-12);
		const Vertex cone(vertices.size() / 2);
		const VertexVector u = factorOfCone(fine.flow, vertices[cone]);
		const VertexVector own = factorOfCone(same, cone);
		// Without the vertex that is left out of a closed surface, or without the boundary's area.
		double sum = 0.0;
		for (const Vertex v : own.indices())
			sum += same.area()[v] * u[vertices[v]];
		for (const Vertex v : own.indices())
			EXPECT_NEAR(own[v], u[vertices[v]] - sum, 0.01) << v.number();
	}
}

TEST(CoarseFlow, KeepsAreaAndCurvature)
{
	for (const LinearCase& c : cases()) {
		SCOPED_TRACE(c.name);
		Linearised fine(c);
		const CoarseFlow coarse(fine.flow, 300);
		EXPECT_LE(coarse.roots.size(), 300);
		EXPECT_GE(coarse.roots.size(), 40);
		EXPECT_NEAR(coarse.flow.area().sum(), 1.0, 1e-12);
		EXPECT_GT(coarse.flow.area().minCoeff(), 0.0);
		double expected = fine.flow.curvature().sum();
		const auto& boundary = fine.surface.topology.boundary;
		for (const Vertex v : boundary.indices())
			if (c.boundary == ConeBoundary::Fixed && boundary[v])
				expected -= fine.flow.curvature()[v];
		EXPECT_NEAR(coarse.flow.curvature().sum(), expected, 1e-9);
		for (const Vertex root : coarse.roots)
			EXPECT_FALSE(c.boundary == ConeBoundary::Fixed && boundary[root]);
	}
}

TEST(CoarseFlow, HasTheFactorsOfTheSurface)
{
	for (const LinearCase& c : cases()) {
		SCOPED_TRACE(c.name);
		Linearised fine(c);
		CoarseFlow coarse(fine.flow, 1500);
		const VertexVector& area = coarse.flow.area();
		for (const int k : {coarse.roots.size() / 5, coarse.roots.size() / 2}) {
			// The adjoint field of a cone, by which cones are placed.
			const VertexVector u = factorOfCone(fine.flow, coarse.roots[Vertex(k)]);
			const VertexVector phi = fine.flow.gradient(u);
			VertexVector own = coarse.flow.gradient(factorOfCone(coarse.flow, Vertex(k)));
			VertexVector wanted(own.size());
			for (const Vertex v : own.indices())
				wanted[v] = phi[coarse.roots[v]];
			wanted.array() -= area.dot(wanted);
			own.array() -= area.dot(own);
			const double ownSize = std::sqrt(coarse.flow.meanSquare(own));
			const double size = std::sqrt(coarse.flow.meanSquare(wanted));
			const double product = area.dot(own.cwiseProduct(wanted));
			EXPECT_GT(product, 0.995 * ownSize * size);
			EXPECT_NEAR(ownSize, size, 0.2 * size);
		}
	}
}

/// Lengths of the shortest paths from \p v to every site.
VertexArray<double> distancesFrom(const ConeSites& sites, Vertex v)
{
	return shortestPaths<Vertex, Vertex>(
			   sites.toCut().size(),
			   {v},
			   [&](Vertex from, const auto& visit) {
				   for (const ConeSites::Way& way : sites.ways(from))
					   visit(way.to, way.length, from);
			   })
		.distance;
}

/// Length of the minimum spanning tree of \p roots by the distances of \p sites between them.
double treeLength(const ConeSites& sites, const std::vector<Vertex>& roots)
{
	std::vector<double> nearest = {};
	nearest.assign(roots.size(), 1e300);
	std::vector<char> isJoined(roots.size(), 0);
	std::size_t last = 0;
	double length = 0.0;
	for (std::size_t joined = 1; joined < roots.size(); ++joined) {
		isJoined[last] = 1;
		const VertexArray<double> distance = distancesFrom(sites, roots[last]);
		std::size_t next = roots.size();
		for (std::size_t i = 0; i < roots.size(); ++i) {
			if (isJoined[i])
				continue;
			nearest[i] = std::min(nearest[i], distance[roots[i]]);
			if (next == roots.size() || nearest[i] < nearest[next])
				next = i;
		}
		length += nearest[next];
		last = next;
	}
	return length;
}

TEST(ConeSites, ChosenOnesKeepTheirSpanningTree)
{
	Random random(811);
	const Packed p(shaken(perforatedSlab(2, 6), 0.05, random));
	const EmbeddedSurface surface = surfaceOf(p);
	const ConeSites fine(surface, -1);
	VertexArray<Vertex> chosen;
	std::vector<Vertex> inFine, inCoarse;
	for (int v = 3; v < surface.triangulation.vertexCount(); v += 1 + random.index(40)) {
		inCoarse.push_back(Vertex(chosen.size()));
		inFine.push_back(Vertex(v));
		chosen.push_back(Vertex(v));
	}
	const ConeSites coarse(fine, chosen);
	EXPECT_EQ(coarse.count(), chosen.size());
	const double length = treeLength(fine, inFine);
	EXPECT_NEAR(treeLength(coarse, inCoarse), length, 1e-12 * length);
	for (std::size_t i = 0; i < inFine.size(); i += 7) {
		const VertexArray<double> exact = distancesFrom(fine, inFine[i]);
		const VertexArray<double> longer = distancesFrom(coarse, inCoarse[i]);
		for (std::size_t k = 0; k < inFine.size(); ++k)
			EXPECT_GE(longer[inCoarse[k]], exact[inFine[k]] - 1e-12);
	}
}

} // namespace
} // namespace ricci::testing
