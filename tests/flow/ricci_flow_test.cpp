// SPDX-License-Identifier: GPL-3.0-or-later
// The flow with intrinsic flips, seen from its result alone.
#include "support/expect.h"
#include "support/flipped_flow.h"
#include "support/implicit_surface.h"
#include "support/intrinsic.h"
#include "support/random.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/base/numbers.h>
#include <ricci/error.h>
#include <ricci/surface/flow_domain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace ricci::testing {
namespace {

/// The target is reached, by the flow's word and by the lengths it gives.
void expectReached(const FlippedFlow& flow)
{
	expectTarget<MetricMeasure>(flow, 1e-8);
}

/// Least weight of an edge, relative to the terms it is made of, from lengths and radii alone: the
/// heights of the two power centres over the edge.
double minRelativeWeight(const FlowResult& r)
{
	const Triangulation& t = r.metric->triangulation();
	const auto& lengths = r.metric->lengths();
	const auto radius = [&](Vertex v) { return std::exp(static_cast<long double>(r.u[v])); };
	long double least = 0.0L;
	for (const Edge e : t.edges()) {
		if (t.isBoundary(e))
			continue;
		long double sum = 0.0L, magnitude = 0.0L;
		for (const Halfedge h : {e.halfedge(), e.halfedge().twin()}) {
			const long double l = lengths[e];
			const long double b = lengths[t.next(h).edge()];
			const long double a = lengths[t.previous(h).edge()];
			const long double gi = radius(t.origin(h)), gj = radius(t.target(h));
			const long double gk = radius(t.apex(h));
			const long double x = ((a - b) * (a + b) / l + l) / 2;
			const long double y =
				std::sqrt((l + a + b) * (l + a - b) * (l + b - a) * (a + b - l)) / (2 * l);
			const long double foot = (l + (gi - gj) * (gi + gj) / l) / 2;
			const long double plus = a * a + gi * gi, minus = gk * gk + 2 * foot * x;
			sum += (plus - minus) / (2 * y);
			// Heights are as uncertain as y is, which is the root of differences of lengths.
			magnitude += (plus + std::abs(minus)) / (2 * y) * std::max(1.0L, (l + a + b) / y);
		}
		least = std::min(least, sum / magnitude);
	}
	return static_cast<double>(least);
}

TEST(RicciFlow, SolvesWhatBreaksOnAFixedTriangulation)
{
	int refused = 0;
	for (const std::uint64_t seed : {1u, 2u, 3u})
		for (int genus : {0, 2, 3}) {
			SCOPED_TRACE("genus " + std::to_string(genus) + ", seed " + std::to_string(seed));
			Random random(400 + seed);
			const SurfaceMesh mesh = implicitClosed(genus, 7, seed);
			std::vector<int> cones;
			for (int i = 0; i < 6; ++i)
				cones.push_back(random.index(static_cast<int>(mesh.positions.size())));
			const TargetRequest request = conesAt(mesh, cones);
			const FlippedFlow flow(mesh, request);
			expectReached(flow);
			Options options;
			options.method = Method::FixedTriangles;
			try {
				runRicciFlow(
					flow.surface(),
					initialPacking(flow.surface(), options),
					flow.result.target,
					options);
			}
			catch (const NotConverged&) {
				++refused;
			}
		}
	EXPECT_GE(refused, 3);
}

TEST(RicciFlow, WeightsAreNotNegativeAtTheEnd)
{
	Random random(410);
	const SurfaceMesh meshes[] = {
		bumpyTorus(16, 10, random), implicitClosed(1, 8, 5), implicitClosed(1, 8, 6)};
	for (const SurfaceMesh& mesh : meshes) {
		const FlippedFlow flat(mesh, requestOf(TargetCurvature::Flat));
		expectReached(flat);
		EXPECT_GE(minRelativeWeight(flat.result), -1e-13);
		const FlippedFlow curved(
			mesh,
			prescribed(randomCurvature(
				static_cast<int>(mesh.positions.size()), 0, -3.0, 3.0, 0.3, random)));
		expectReached(curved);
		EXPECT_GT(curved.result.flips.size(), 0u);
		EXPECT_GE(minRelativeWeight(curved.result), -1e-13);
	}
}

/// Ends and length of every edge, in an order of its own.
struct NamedEdge
{
	int low, high;
	double length;
	bool operator<(const NamedEdge& other) const
	{
		return low != other.low     ? low < other.low
			   : high != other.high ? high < other.high
									: length < other.length;
	}
};

std::vector<NamedEdge> namedEdges(const FlowResult& r, const std::vector<int>& name)
{
	const Triangulation& t = r.metric->triangulation();
	std::vector<NamedEdge> edges;
	for (const Edge e : t.edges()) {
		const auto [low, high] =
			std::minmax(name[at(t.origin(e.halfedge()))], name[at(t.target(e.halfedge()))]);
		edges.push_back({low, high, r.metric->lengths()[e]});
	}
	std::sort(edges.begin(), edges.end());
	return edges;
}

/// Vertex v of \p b is vertex name[v] of \p a.
void expectSameMetric(const FlowResult& a, const FlowResult& b, const std::vector<int>& name)
{
	std::vector<int> own(name.size());
	std::iota(own.begin(), own.end(), 0);
	const double shift = b.u[Vertex(0)] - a.u[Vertex(name[0])];
	double difference = 0.0;
	for (const Vertex v : b.u.indices())
		difference = std::max(difference, std::abs(b.u[v] - a.u[Vertex(name[at(v)])] - shift));
	EXPECT_LT(difference, 1e-8);
	const auto edges = namedEdges(a, own), others = namedEdges(b, name);
	ASSERT_EQ(edges.size(), others.size());
	const double factor = std::exp(shift);
	std::size_t common = 0;
	auto other = others.begin();
	for (const NamedEdge& edge : edges) {
		while (other != others.end() &&
			   (other->low < edge.low || (other->low == edge.low && other->high < edge.high)))
			++other;
		if (other == others.end() || other->low != edge.low || other->high != edge.high)
			continue;
		EXPECT_NEAR(other->length / factor / edge.length, 1.0, 1e-8);
		++common;
		++other;
	}
	// All but ties are common.
	EXPECT_GE(static_cast<double>(common), 0.995 * static_cast<double>(edges.size()));
}

struct Problem
{
	const char* name;
	SurfaceMesh mesh;
	std::vector<double> curvature;
};

/// Generic meshes, so that the Delaunay triangulation is one alone.
std::vector<Problem> closedProblems()
{
	Random random(420);
	std::vector<Problem> problems;
	const auto add = [&](const char* name, const SurfaceMesh& mesh, int chi) {
		const int n = static_cast<int>(mesh.positions.size());
		problems.push_back({name, mesh, randomCurvature(n, chi, -2.0, 2.0, 0.5, random)});
	};
	add("sphere", shaken(perforatedSlab(0, 3), 0.05, random), 2);
	add("torus", bumpyTorus(12, 9, random), 0);
	add("genus 2", shaken(perforatedSlab(2, 2), 0.05, random), -2);
	return problems;
}

TEST(RicciFlow, DoesNotDependOnTheNumbersOfVerticesAndFaces)
{
	Random random(430);
	for (const Problem& p : closedProblems()) {
		SCOPED_TRACE(p.name);
		const FlippedFlow flow(p.mesh, prescribed(p.curvature));
		expectReached(flow);
		const Renumbered other = renumbered(p.mesh, random);
		std::vector<double> curvature;
		for (int v : other.vertex)
			curvature.push_back(p.curvature[at(v)]);
		const FlippedFlow same(other.mesh, prescribed(curvature));
		expectReached(same);
		expectSameMetric(flow.result, same.result, other.vertex);
	}
}

TEST(RicciFlow, DoesNotDependOnTheTriangulationOfTheInput)
{
	Random random(440);
	for (const Problem& p : closedProblems()) {
		SCOPED_TRACE(p.name);
		const FlippedFlow flow(p.mesh, prescribed(p.curvature));
		IntrinsicMesh metric = intrinsicMesh(p.mesh);
		const auto flips = flipIsometrically(metric, 400, random);
		EXPECT_GT(flips.size(), 60u);
		const FlippedFlow same(metric, prescribed(p.curvature));
		expectReached(same);
		std::vector<int> name(p.mesh.positions.size());
		std::iota(name.begin(), name.end(), 0);
		expectSameMetric(flow.result, same.result, name);
	}
}

TEST(RicciFlow, ReachesRandomCurvatures)
{
	for (int genus : {0, 1, 2})
		for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
			Random random(450 + 10 * seed);
			const SurfaceMesh meshes[] = {
				shaken(perforatedSlab(genus, 3), 0.08, random), implicitClosed(genus, 5, seed)};
			for (const SurfaceMesh& mesh : meshes) {
				const int n = static_cast<int>(mesh.positions.size()), chi = 2 - 2 * genus;
				SCOPED_TRACE(
					"genus " + std::to_string(genus) + ", seed " + std::to_string(seed) + ", " +
					std::to_string(n) + " vertices");
				expectReached(
					FlippedFlow(mesh, prescribed(randomCurvature(n, chi, -3, 3, 1.0, random))));
				expectReached(
					FlippedFlow(mesh, prescribed(randomCurvature(n, chi, -6, 6.2, 0.3, random))));
			}
		}
}

/// Equal shares of the total curvature, each rounded, add up to it as well as they can.
TEST(RicciFlow, TakesEqualSharesOfTheTotalCurvature)
{
	for (int subdivision : {3, 7, 12, 17, 25}) {
		const SurfaceMesh mesh = perforatedSlab(5, subdivision);
		const EmbeddedSurface surface =
			embeddedSurface(VertexArray<Point3>(mesh.positions), mesh.triangles);
		const auto n = mesh.positions.size();
		const double share = -16 * kPi / static_cast<double>(n);
		TargetRequest request = prescribed(std::vector<double>(n, share));
		request.prescribedPrecision = std::numeric_limits<double>::epsilon();
		InitialPacking start; // a prescribed target does not ask for it
		EXPECT_NO_THROW(chooseTarget(surface, start, request));
	}
}

TEST(RicciFlow, ReachesConesNearTheBound)
{
	Random random(460);
	const SurfaceMesh sphere = shaken(perforatedSlab(0, 3), 0.05, random);
	const SurfaceMesh donut = bumpyTorus(12, 9, random);
	for (double gap : {0.1, 0.01}) {
		SCOPED_TRACE(gap);
		const double strong = 2 * kPi - gap;
		std::vector<double> curvature(sphere.positions.size(), 0.0);
		curvature[3] = curvature[20] = strong;
		curvature[11] = 4 * kPi - 2 * strong;
		expectReached(FlippedFlow(sphere, prescribed(curvature)));

		curvature.assign(donut.positions.size(), 0.0);
		curvature[5] = strong;
		curvature[70] = -strong;
		expectReached(FlippedFlow(donut, prescribed(curvature)));

		// The strongest negative cone that the rest of the surface can pay for with such cones.
		curvature.assign(sphere.positions.size(), 0.0);
		for (int v = 0; v < 10; ++v)
			curvature[at(5 * v)] = strong;
		curvature[3] = 4 * kPi - 10 * strong;
		expectReached(FlippedFlow(sphere, prescribed(curvature)));
	}
}

TEST(RicciFlow, FreeBoundaryKeepsItsLengths)
{
	Random random(470);
	const SurfaceMesh meshes[] = {
		sliverDisk(10, 1.5, random), implicitDisk(12, 3), implicitAnnulus(12, 3)};
	for (const SurfaceMesh& mesh : meshes) {
		const FlippedFlow flow(mesh, requestOf(TargetCurvature::Prescribed));
		expectReached(flow);
		ASSERT_FALSE(flow.result.doubled);
		for (const Vertex v : flow.base().vertices())
			if (flow.surface().topology.boundary[v]) {
				EXPECT_EQ(flow.result.u[v], std::log(flow.result.start.radii[v]));
			}
		for (const Edge e : flow.base().edges())
			if (flow.base().isBoundary(e)) {
				EXPECT_DOUBLE_EQ(
					flow.result.metric->lengths()[e], flow.result.start.mesh.lengths[e]);
				EXPECT_EQ(flow.result.start.mesh.lengths[e], flow.surface().lengths[e]);
			}
	}
}

TEST(RicciFlow, DoubledSolutionIsSymmetric)
{
	int doubled = 0;
	for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
		Random random(480 + seed);
		const struct
		{
			const char* name;
			SurfaceMesh mesh;
			TargetCurvature target;
		} cases[] = {
			{"disk", implicitDisk(14, seed), TargetCurvature::Disk},
			{"rectangle", implicitDisk(14, seed), TargetCurvature::Rectangle},
			{"annulus", implicitAnnulus(14, seed), TargetCurvature::Flat},
			{"sliver disk", sliverDisk(9, 1.5, random), TargetCurvature::Disk},
			{"sliver rectangle", sliverDisk(9, 1.5, random), TargetCurvature::Rectangle},
			{"ragged rectangle",
			 shaken(rectangle(8, 3, 8, 1), 0.2, random),
			 TargetCurvature::Rectangle},
			{"ragged disk", shaken(rectangle(6, 6, 1, 1), 0.08, random), TargetCurvature::Disk}};
		for (const auto& c : cases) {
			SCOPED_TRACE(std::string(c.name) + ", seed " + std::to_string(seed));
			const FlippedFlow flow(c.mesh, requestOf(c.target, false));
			expectReached(flow);
			if (!flow.result.doubled)
				continue;
			++doubled;
			const DoubleSurface twice = doubleOf(flow.base());
			double asymmetry = 0.0;
			for (const Vertex v : twice.mirror.indices())
				asymmetry = std::max(
					asymmetry, std::abs(flow.result.u[v] - flow.result.u[twice.mirror[v]]));
			EXPECT_LT(asymmetry, 1e-9);
			// The copies have the curvature of the surface.
			const MetricMeasure measure(
				flow.result.metric->triangulation(), flow.result.metric->lengths());
			for (const Vertex v : twice.mirror.indices())
				EXPECT_NEAR(
					static_cast<double>(measure.curvature[v] - measure.curvature[twice.mirror[v]]),
					0.0,
					1e-8);
			EXPECT_NEAR(static_cast<double>(measure.area / 2) / flow.result.area, 1.0, 1e-9);
		}
	}
	EXPECT_GE(doubled, 3);
}

/// Flips that lead to the start, undone in the input's metric, give the input's lengths.
TEST(RicciFlow, StartFlippedBackIsTheInput)
{
	for (const Problem& p : closedProblems()) {
		SCOPED_TRACE(p.name);
		const FlippedFlow flow(p.mesh, prescribed(p.curvature));
		EXPECT_GT(flow.result.start.flips.size(), 0u);
		const MetricMeasure before(flow.base(), flow.surface().lengths);
		const MetricMeasure start(
			flow.result.start.mesh.triangulation, flow.result.start.mesh.lengths);
		EXPECT_NEAR(static_cast<double>(start.area / before.area), 1.0, 1e-13);
		for (const Vertex v : before.curvature.indices())
			EXPECT_NEAR(static_cast<double>(start.curvature[v] - before.curvature[v]), 0.0, 1e-12);
		IntrinsicMesh metric = flow.result.start.mesh;
		for (auto e = flow.result.start.flips.rbegin(); e != flow.result.start.flips.rend(); ++e) {
			metric.lengths[*e] = flippedLength(metric, *e);
			metric.triangulation.unflip(*e);
		}
		for (const Halfedge h : flow.base().halfedges())
			ASSERT_EQ(metric.triangulation.next(h), flow.base().next(h));
		for (const Edge e : flow.surface().lengths.indices())
			EXPECT_NEAR(metric.lengths[e] / flow.surface().lengths[e], 1.0, 1e-10);
		Triangulation end = flow.result.start.mesh.triangulation;
		for (const Edge e : flow.result.flips)
			end.flip(e);
		for (const Halfedge h : end.halfedges())
			ASSERT_EQ(end.next(h), flow.result.metric->triangulation().next(h));
	}
}

} // namespace
} // namespace ricci::testing
