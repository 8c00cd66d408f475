// SPDX-License-Identifier: GPL-3.0-or-later
#include "linearised.h"

#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/curvature/cone_tree.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

namespace ricci::testing {
namespace {

std::vector<Vertex> conesOf(const ConeModel& model)
{
	std::vector<Vertex> vertices;
	for (int i = 0; i < model.size(); ++i)
		vertices.push_back(model.vertex(i));
	return vertices;
}

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

TEST(ConeTree, IsShortenedMoreThanTheDistortionGrows)
{
	Linearised linear({"", sphere(), ConeBoundary::Fixed});
	const ConeSites sites(linear.surface, -1);
	const auto distance = distances(linear.surface);
	const int n = linear.flow.vertexCount();
	bool hasMoved = false;
	for (const int step : {7, 13, 19}) {
		ConeModel model(linear.flow, 4 * kPi);
		for (int i = 0; i < 5; ++i)
			model.append(Vertex(i * step % n));
		model.fit();
		const double distortion = model.distortion(), length = treeLength(distance, conesOf(model));
		for (const double allowed : {1.05, 1.5}) {
			ConeModel shorter(linear.flow, 4 * kPi);
			shorter.append(conesOf(model));
			shorter.fit();
			shortenConeTree(shorter, sites, allowed * distortion);
			const double now = treeLength(distance, conesOf(shorter));
			EXPECT_EQ(shorter.size(), 5);
			EXPECT_LE(shorter.distortion(), allowed * distortion * (1 + 1e-9));
			if (conesOf(shorter) == conesOf(model))
				continue;
			hasMoved = true;
			// Each move lowers the product by half a percent.
			EXPECT_LE(
				now * std::sqrt(shorter.distortion()),
				0.995 * length * std::sqrt(distortion) + 1e-9);
		}
	}
	EXPECT_TRUE(hasMoved);
}

/// A move is taken only if it lowers the product; where no place does, nothing moves.
TEST(ConeTree, EndsWhereNoMoveOfOneConeIsWorthIt)
{
	Linearised linear({"", sphere(), ConeBoundary::Fixed});
	const ConeSites sites(linear.surface, -1);
	const auto distance = distances(linear.surface);
	ConeModel model(linear.flow, 4 * kPi);
	model.append({Vertex(0), Vertex(60), Vertex(100), Vertex(30)});
	model.fit();
	const double allowed = 1.3 * model.distortion();
	for (int i = 0; i < 4; ++i)
		shortenConeTree(model, sites, allowed);
	const std::vector<Vertex> still = conesOf(model);
	shortenConeTree(model, sites, allowed);
	EXPECT_EQ(conesOf(model), still);
	// A cone beside another shortens the tree, but adds too much distortion.
	const double product = treeLength(distance, still) * std::sqrt(model.distortion());
	int worse = 0, count = 0;
	for (int i = 0; i < model.size(); ++i)
		for (const Vertex v : model.area().indices()) {
			if (model.isCone(v))
				continue;
			std::vector<Vertex> there = still;
			there[at(i)] = v;
			const double length = treeLength(distance, there);
			ConeModel trial = model;
			worse += !trial.tryMove(i, v, [&](double energy) {
				const double moved = 2.0 * std::sqrt(energy);
				return moved <= allowed && length * std::sqrt(moved) <= 0.98 * product;
			});
			++count;
		}
	EXPECT_GE(worse, 0.97 * count);
}

TEST(ConeTree, StaysWhereNoDistortionMayBeAdded)
{
	Linearised linear({"", sphere(), ConeBoundary::Fixed});
	const ConeSites sites(linear.surface, -1);
	ConeModel model(linear.flow, 4 * kPi);
	model.append({Vertex(0), Vertex(60), Vertex(100), Vertex(30)});
	model.fit();
	const std::vector<Vertex> before = conesOf(model);
	shortenConeTree(model, sites, 0.9 * model.distortion());
	EXPECT_EQ(conesOf(model), before);
}

TEST(ConeTree, MovesToAllowedPlacesOnly)
{
	Linearised linear({"", sphere(), ConeBoundary::Fixed});
	const int allowed = 40;
	const ConeSites sites(linear.surface, allowed);
	ConeModel model(linear.flow, 4 * kPi);
	model.append({Vertex(0), Vertex(13), Vertex(26), Vertex(39)});
	model.fit();
	shortenConeTree(model, sites, 3.0 * model.distortion());
	for (const Vertex v : conesOf(model))
		EXPECT_LT(v.number(), allowed);
}

/// Nothing joins one cone to.
TEST(ConeTree, OfOneConeIsNone)
{
	Random random(921);
	Linearised linear({"", shaken(perforatedSlab(2, 2), 0.05, random), ConeBoundary::Fixed});
	const ConeSites sites(linear.surface, -1);
	ConeModel model(linear.flow, -4 * kPi);
	model.append(Vertex(5));
	model.fit();
	shortenConeTree(model, sites, 2.0 * model.distortion());
	EXPECT_EQ(conesOf(model), std::vector<Vertex>{Vertex(5)});
}

} // namespace
} // namespace ricci::testing
