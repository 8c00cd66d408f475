// SPDX-License-Identifier: GPL-3.0-or-later
#include "linearised.h"

#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/curvature/cone_search.h>
#include <ricci/metric/area.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

namespace ricci::testing {
namespace {

/// Lengths of shortest paths along edges between all vertices, by the algorithm of Floyd and Warshall.
std::vector<std::vector<double>> distances(const EmbeddedSurface& surface)
{
	const std::size_t n = at(surface.triangulation.vertexCount());
	std::vector<std::vector<double>> d(
		n, std::vector<double>(n, std::numeric_limits<double>::infinity()));
	for (std::size_t i = 0; i < n; ++i)
		d[i][i] = 0.0;
	for (const Edge e : surface.triangulation.edges()) {
		const auto ends = surface.triangulation.ends(e);
		for (std::size_t k = 0; k < 2; ++k)
			d[at(ends[k])][at(ends[1 - k])] =
				std::min(d[at(ends[k])][at(ends[1 - k])], surface.lengths[e]);
	}
	for (std::size_t k = 0; k < n; ++k)
		for (std::size_t i = 0; i < n; ++i)
			for (std::size_t j = 0; j < n; ++j)
				d[i][j] = std::min(d[i][j], d[i][k] + d[k][j]);
	return d;
}

/// Length of the minimum spanning tree of some vertices: edges by length, each that joins two parts,
/// by Kruskal's algorithm.
double
treeLength(const std::vector<std::vector<double>>& distance, const std::vector<Vertex>& vertices)
{
	std::vector<std::tuple<double, std::size_t, std::size_t>> edges;
	std::vector<std::size_t> part;
	for (std::size_t i = 0; i < vertices.size(); ++i) {
		part.push_back(i);
		for (std::size_t j = 0; j < i; ++j)
			edges.emplace_back(distance[at(vertices[i])][at(vertices[j])], i, j);
	}
	std::sort(edges.begin(), edges.end());
	double length = 0.0;
	for (const auto& [d, i, j] : edges)
		if (part[i] != part[j]) {
			length += d;
			std::replace(part.begin(), part.end(), std::size_t(part[i]), std::size_t(part[j]));
		}
	return length;
}

SurfaceMesh sphere()
{
	Random random(920);
	return shaken(perforatedSlab(0, 3), 0.05, random);
}

/// Units of length of the surface in one of its sites.
double unit(const EmbeddedSurface& surface)
{
	return std::sqrt(euclideanArea(surface.triangulation, surface.lengths));
}

std::vector<Vertex> places(int step, int n)
{
	std::vector<Vertex> vertices;
	for (int i = 0; i < 5; ++i)
		vertices.emplace_back(i * step % n);
	return vertices;
}

/// On a sphere, where there are no other seams, paths that may begin on one another are no longer than those
/// between the cones alone, and no shorter than half of them.
TEST(SeamTree, IsNoLongerThanTheMinimumSpanningTree)
{
	Linearised linear({"", sphere(), ConeBoundary::Fixed});
	const ConeSites sites(linear.surface, -1);
	const auto distance = distances(linear.surface);
	const double whole = unit(linear.surface);
	for (const int step : {7, 13, 19}) {
		ConeModel model(linear.flow, 4 * kPi);
		model.append(places(step, linear.flow.vertexCount()));
		model.fit();
		const SeamTree tree(sites, model.vertices());
		const double spanning = treeLength(distance, model.vertices()) / whole;
		EXPECT_LE(tree.length(), spanning * (1 + 1e-12));
		EXPECT_GE(tree.length(), 0.5 * spanning);
		for (const Vertex v : model.vertices())
			EXPECT_EQ(tree.distance(v), 0.0);
		for (const Vertex v : model.area().indices())
			for (const Vertex cone : model.vertices())
				EXPECT_LE(tree.distance(v), distance[at(v)][at(cone)] / whole + 1e-12);
	}
}

/// Each cone in turn that is nearest to what is there.
TEST(SeamTree, TakesTheNearestConesFirst)
{
	Random random(921);
	for (const int genus : {0, 1}) {
		Linearised linear(
			{"", shaken(perforatedSlab(genus, 3), 0.05, random), ConeBoundary::Fixed});
		const ConeSites sites(linear.surface, -1);
		std::vector<Vertex> left = places(13, linear.flow.vertexCount());
		const SeamTree tree(sites, left);
		SeamTree wanted(sites);
		while (!left.empty()) {
			const auto nearest =
				std::min_element(left.begin(), left.end(), [&](Vertex a, Vertex b) {
					return wanted.distance(a) < wanted.distance(b);
				});
			wanted.add(*nearest);
			left.erase(nearest);
		}
		EXPECT_NEAR(tree.length(), wanted.length(), 1e-12);
		for (const Vertex v : linear.surface.triangulation.vertices()) {
			EXPECT_NEAR(tree.distance(v), wanted.distance(v), 1e-12);
			EXPECT_NEAR(tree.ownLength(v), wanted.ownLength(v), 1e-12);
		}
	}
}

/// Taking a cone out leaves the tree as if it had never been there.
TEST(SeamTree, ForgetsConesThatAreTakenOut)
{
	Random random(922);
	for (const int genus : {0, 1, 2}) {
		Linearised linear(
			{"", shaken(perforatedSlab(genus, 3), 0.05, random), ConeBoundary::Fixed});
		const ConeSites sites(linear.surface, -1);
		EXPECT_EQ(sites.cutLength() > 0.0, genus > 0);
		const std::vector<Vertex> cones = places(17, linear.flow.vertexCount());
		for (std::size_t out = 1; out < cones.size(); ++out) {
			SeamTree tree(sites);
			for (const Vertex v : cones)
				if (v != cones[out])
					tree.add(v);
			SeamTree other = tree;
			const double longer = tree.distance(cones[out]);
			other.add(cones[out]);
			EXPECT_NEAR(other.length(), tree.length() + longer, 1e-12);
			EXPECT_NEAR(other.ownLength(cones[out]), longer, 1e-12);
			EXPECT_NEAR(other.remove(cones[out]), longer, 1e-12);
			EXPECT_NEAR(other.length(), tree.length(), 1e-12);
			for (const Vertex v : linear.surface.triangulation.vertices())
				EXPECT_NEAR(other.distance(v), tree.distance(v), 1e-12);
		}
	}
}

/// The seams without cones open a surface to a disk: 2 g + b - 1 loops or paths are in them.
TEST(ConeSites, SeamsWithoutConesBeginOnTheBoundary)
{
	const SurfaceMesh cylinder = revolved({{1.0, 0.0}, {1.0, 0.5}, {1.0, 1.0}, {1.0, 1.5}}, 16);
	Linearised linear({"", cylinder, ConeBoundary::Fixed});
	const ConeSites sites(linear.surface, -1);
	EXPECT_NEAR(sites.cutLength(), 1.5 / unit(linear.surface), 1e-9);
	for (const Vertex v : linear.surface.triangulation.vertices())
		if (linear.surface.topology.boundary[v]) {
			EXPECT_EQ(sites.toCut()[v], 0.0);
		}
	Linearised ball({"", sphere(), ConeBoundary::Fixed});
	EXPECT_EQ(ConeSites(ball.surface, -1).cutLength(), 0.0);
}

double cost(const ConeModel& model, const SeamTree& tree)
{
	return kEnergyPrice * model.energy() + kSeamPrice * tree.length();
}

TEST(ConeTree, MovesLowerEnergyAndPriceOfSeams)
{
	Linearised linear({"", sphere(), ConeBoundary::Fixed});
	const ConeSites sites(linear.surface, -1);
	int moved = 0;
	for (const int step : {7, 13, 19})
		for (const double allowed : {1.0, 1.05, 1e9}) {
			ConeModel model(linear.flow, 4 * kPi);
			model.append(places(step, linear.flow.vertexCount()));
			model.fit();
			const double distortion = model.distortion();
			const std::vector<Vertex> before = model.vertices();
			SeamTree tree(sites, model.vertices());
			const double least = cost(model, tree);
			shortenConeTree(model, tree, sites, allowed * distortion);
			EXPECT_EQ(model.size(), 5);
			EXPECT_LE(model.distortion(), allowed * distortion * (1 + 1e-9));
			EXPECT_LE(cost(model, tree), least + 1e-12);
			moved += model.vertices() != before;
			if (model.vertices() != before) {
				EXPECT_LT(cost(model, tree), least - 9e-5);
			}
		}
	EXPECT_GT(moved, 0);
}

TEST(ConeTree, MovesToAllowedPlacesOnly)
{
	Linearised linear({"", sphere(), ConeBoundary::Fixed});
	const int allowed = 40;
	const ConeSites sites(linear.surface, allowed);
	ConeModel model(linear.flow, 4 * kPi);
	model.append({Vertex(0), Vertex(13), Vertex(26), Vertex(39)});
	model.fit();
	SeamTree tree(sites, model.vertices());
	shortenConeTree(model, tree, sites, 3.0 * model.distortion());
	for (const Vertex v : model.vertices())
		EXPECT_LT(v.number(), allowed);
}

} // namespace
} // namespace ricci::testing
