// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/intrinsic.h"
#include "support/packed.h"
#include "support/random.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/base/task.h>
#include <ricci/edge_swap/swapped_flow.h>
#include <ricci/error.h>
#include <ricci/math/points.h>
#include <ricci/measure/distortion.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

namespace ricci::testing {
namespace {

/// A triangle over each side of a broken one: corners 0 1 2, outer vertices 3 4 5.
SurfaceMesh star()
{
	return {
		{{0, 0, 0}, {1, 0, 0}, {0.5, 0.8, 0}, {0.5, -0.8, 0.1}, {1.4, 0.8, 0.2}, {-0.4, 0.8, 0.3}},
		{{0, 1, 2}, {1, 0, 3}, {2, 1, 4}, {0, 2, 5}}};
}

/// The map of the mesh with the ends of one edge put so far apart that its triangles break.
GeometricCurvatureMap<Euclidean> breaking(const Packed& mesh, Edge e)
{
	CirclePacking packing = mesh.packing;
	packing.delta[e] = 100.0;
	GeometricCurvatureMap<Euclidean> map(packing);
	map.evaluate(mesh.u());
	return map;
}

TEST(EdgeSwap, DoesNothingWhereNothingIsBroken)
{
	const SurfaceMesh mesh = star();
	const Packed packed(mesh);
	auto map = packed.map();
	map.evaluate(packed.u());
	const VertexArray<Point3> positions(mesh.positions);
	EdgeSwapper swapper(positions, packed.radii);
	EXPECT_FALSE(swapper(map));
	EXPECT_EQ(swapper.swaps(), 0);
	EXPECT_TRUE(swapper.boundaryEdgesToSplit().empty());
}

TEST(EdgeSwap, SwapsTheLongestEdgeAndMeasuresTheNewOneInSpace)
{
	const SurfaceMesh mesh = star();
	const Packed packed(mesh);
	const Edge e = edgeBetween(packed.triangulation, Vertex(0), Vertex(1));
	auto map = breaking(packed, e);
	ASSERT_EQ(map.brokenTriangles(), 2); // on both sides of it
	const VertexArray<Point3> positions(mesh.positions);
	EdgeSwapper swapper(positions, packed.radii);
	EXPECT_TRUE(swapper(map));
	EXPECT_EQ(swapper.swaps(), 1);
	const Triangulation& t = map.triangulation();
	EXPECT_EQ(
		std::minmax(t.origin(e.halfedge()), t.target(e.halfedge())),
		std::minmax(Vertex(2), Vertex(3)));
	// Paper 5.4: the inversive distance follows from the distance in space and the initial radii.
	const double l = distance(mesh.positions[2], mesh.positions[3]);
	const double gi = packed.radii[Vertex(2)], gj = packed.radii[Vertex(3)];
	EXPECT_NEAR(1 + map.delta()[e], (l * l - gi * gi - gj * gj) / (2 * gi * gj), 1e-12);
	for (const Edge edge : t.edges())
		EXPECT_EQ(swapper.swapped()[edge], edge == e);
}

TEST(EdgeSwap, AsksForASplitOnTheBoundary)
{
	const SurfaceMesh mesh = star();
	const Packed packed(mesh);
	const Edge e = edgeBetween(packed.triangulation, Vertex(1), Vertex(3));
	auto map = breaking(packed, e);
	ASSERT_EQ(map.brokenTriangles(), 1);
	const VertexArray<Point3> positions(mesh.positions);
	EdgeSwapper swapper(positions, packed.radii);
	swapper(map);
	EXPECT_EQ(swapper.boundaryEdgesToSplit(), std::vector<Edge>{e});
	EXPECT_FALSE(swapper.swapped()[e]);
}

TEST(EdgeSwap, AnEdgeIsNotSwappedForEver)
{
	// Made to break again after each swap, an edge is given up in the end.
	const SurfaceMesh mesh = star();
	const Packed packed(mesh);
	const Edge e = edgeBetween(packed.triangulation, Vertex(0), Vertex(1));
	auto map = breaking(packed, e);
	const VertexArray<Point3> positions(mesh.positions);
	EdgeSwapper swapper(positions, packed.radii);
	int rounds = 0;
	while (rounds < 100 && swapper(map)) {
		++rounds;
		const Triangulation& t = map.triangulation();
		CirclePacking packing{t, map.delta()};
		packing.delta[e] = 1e4;
		map = GeometricCurvatureMap<Euclidean>(packing);
		map.evaluate(packed.u());
	}
	EXPECT_GT(rounds, 0);
	EXPECT_LT(rounds, 50);
}

Triangulation triangulationOf(const SplitMesh& mesh)
{
	return Triangulation(mesh.positions().size(), mesh.triangles());
}

using Corners = std::array<Point3, 3>;

Corners cornersOf(const VertexArray<Point3>& positions, const Triangle& t)
{
	return {positions[Vertex(t[0])], positions[Vertex(t[1])], positions[Vertex(t[2])]};
}

/// Normal times twice the area.
Point3 normalOf(const Corners& p)
{
	return cross(p[1] - p[0], p[2] - p[0]);
}

/// Shares of \p p in the corners of a triangle in whose plane it lies.
std::array<double, 3> weightsOf(const Point3& p, const Corners& triangle)
{
	const Point3 n = normalOf(triangle);
	std::array<double, 3> weights;
	for (std::size_t k = 0; k < 3; ++k) {
		Corners part = triangle;
		part[k] = p;
		weights[k] = dot(normalOf(part), n) / dot(n, n);
	}
	return weights;
}

/// Whether \p part lies in \p whole and is turned the same way.
bool isPartOf(const Corners& part, const Corners& whole)
{
	if (!(dot(normalOf(part), normalOf(whole)) > 0.0))
		return false;
	for (const Point3& p : part) {
		const auto w = weightsOf(p, whole);
		Point3 inPlane{};
		for (std::size_t k = 0; k < 3; ++k)
			for (std::size_t x = 0; x < 3; ++x)
				inPlane[x] += w[k] * whole[k][x];
		if (*std::min_element(w.begin(), w.end()) < -1e-12 || distance(p, inPlane) > 1e-12)
			return false;
	}
	return true;
}

TEST(SplitMesh, IsTheComponentBeforeASplit)
{
	Random random(600);
	const Component component = onlyComponent(randomPlanarDisk(4, random));
	const SplitMesh mesh(component);
	EXPECT_EQ(mesh.splits(), 0);
	EXPECT_EQ(mesh.positions(), component.positions);
	EXPECT_EQ(mesh.triangles(), component.triangles);
	const Triangulation t = triangulationOf(mesh);
	for (const Face f : t.faces())
		for (const Corner c : ricci::cornersOf(f.number()))
			EXPECT_EQ(mesh.corner(t, c), t.halfedges(f)[c.index()]);
}

TEST(SplitMesh, SplitsOneEdgeOfATriangleAtOnce)
{
	const Component component = onlyComponent(rectangle(1, 1, 1, 1));
	SplitMesh mesh(component);
	const Triangulation t = triangulationOf(mesh);
	std::vector<Edge> edges;
	for (const Edge e : t.edges())
		if (t.isBoundary(e))
			edges.insert(edges.begin(), 2, e); // every one twice, the last first
	ASSERT_EQ(edges.size(), 8u);
	mesh.split(t, edges);
	EXPECT_EQ(mesh.splits(), 2);
	EXPECT_EQ(mesh.positions().size(), 6);
	EXPECT_EQ(mesh.triangles().size(), 4u);
}

TEST(SplitMesh, CornersAndFacesStayFindableAfterManySplits)
{
	Random random(601);
	const SurfaceMesh surfaces[] = {
		randomPlanarDisk(4, random),
		sliverDisk(4, 1.0, random),
		ring(1, 2, 7, 1),
		withoutStars(shaken(perforatedSlab(1, 2), 0.05, random), {0})};
	int refound = 0; // corners that lie in a triangle of another number than at first
	for (const SurfaceMesh& surface : surfaces) {
		const Component component = onlyComponent(surface);
		SplitMesh mesh(component);
		for (int round = 0; round < 8; ++round) {
			const Triangulation before = triangulationOf(mesh);
			std::vector<Edge> edges;
			for (const Edge e : before.edges())
				if (before.isBoundary(e) && random.index(3) == 0)
					edges.push_back(e);
			random.shuffle(edges);
			const int splits = mesh.splits();
			mesh.split(before, edges);
			const Triangulation t = triangulationOf(mesh);
			ASSERT_EQ(t.eulerCharacteristic(), before.eulerCharacteristic());
			ASSERT_EQ(t.boundaryLoops().size(), before.boundaryLoops().size());
			ASSERT_EQ(t.faceCount(), before.faceCount() + mesh.splits() - splits);
			ASSERT_EQ(t.vertexCount(), before.vertexCount() + mesh.splits() - splits);

			std::vector<double> area(component.triangles.size(), 0.0);
			for (const Triangle& triangle : mesh.triangles()) {
				const Corners part = cornersOf(mesh.positions(), triangle);
				int faces = 0;
				for (std::size_t f = 0; f < component.triangles.size(); ++f) {
					const Corners whole = cornersOf(component.positions, component.triangles[f]);
					if (!isPartOf(part, whole))
						continue;
					++faces;
					area[f] += triangleArea(part);
				}
				ASSERT_EQ(faces, 1);
			}
			for (std::size_t f = 0; f < component.triangles.size(); ++f) {
				const Corners whole = cornersOf(component.positions, component.triangles[f]);
				EXPECT_NEAR(area[f] / triangleArea(whole), 1.0, 1e-13);
				for (std::size_t k = 0; k < 3; ++k) {
					const Halfedge h =
						mesh.corner(t, Corner(static_cast<int>(f), static_cast<int>(k)));
					ASSERT_TRUE(t.face(h).isValid());
					ASSERT_EQ(t.origin(h), Vertex(component.triangles[f][k]));
					const Triangle& part = mesh.triangles()[positionOf(t.face(h))];
					EXPECT_TRUE(isPartOf(cornersOf(mesh.positions(), part), whole));
					refound += t.face(h) != Face(f);
				}
			}
		}
		EXPECT_GT(mesh.splits(), 10);
	}
	EXPECT_GT(refound, 100);
}

/// Seven triangles round vertex 0, one of them far wider than the others: that of vertices 0, 7, 1.
SurfaceMesh fanWithAWideTriangle()
{
	SurfaceMesh fan;
	fan.positions.push_back({0, 0, 0});
	for (int i = 0; i < 7; ++i) {
		const double angle = (100 + 260 * i / 6.0) * kPi / 180;
		fan.positions.push_back({std::cos(angle), std::sin(angle), 0});
		fan.triangles.push_back({0, i + 1, (i + 1) % 7 + 1});
	}
	return fan;
}

/// Runs flowWithEdgeSwaps() with the boundary kept, and notes what it tells.
struct SwapRun : Progress
{
	Component component;
	VertexArray<double> curvature; ///< wanted at the component's inner vertices
	Options options;
	std::function<void()> atStep = [] {};

	int starts = 0, steps = 0;
	std::vector<int> splits;
	std::vector<int> startVertices; ///< [start] of the surface
	std::vector<FlowState> states;

	SwapRun(const SurfaceMesh& mesh, double everywhere) : component(onlyComponent(mesh))
	{
		curvature.assign(component.positions.size(), everywhere);
		options.method = Method::EdgeSwaps;
	}

	SwappedFlow operator()()
	{
		const Task task(*this);
		const auto choose = [&](const EmbeddedSurface& surface, InitialPacking& start) {
			EXPECT_EQ(start.radii.size(), surface.positions.size());
			++starts;
			const int n = surface.triangulation.vertexCount();
			startVertices.push_back(n);
			Target target;
			target.curvature = VertexVector::Zero(n);
			for (const Vertex v : curvature.indices())
				target.curvature[v] = curvature[v];
			target.fixed = surface.topology.boundary;
			return target;
		};
		return flowWithEdgeSwaps(component, options, choose, states);
	}

	void log(const std::string& line) override
	{
		if (line.find("boundary edges split") != std::string::npos)
			splits.push_back(std::stoi(line));
		else if (line.find("Newton step") == 0) {
			++steps;
			atStep();
		}
	}
};

/// The number of steps never falls, and ends with that of the flow.
void expectCounted(const std::vector<FlowState>& states, const FlowResult& flow)
{
	EXPECT_TRUE(
		std::is_sorted(states.begin(), states.end(), [](const FlowState& a, const FlowState& b) {
			return a.step < b.step;
		}));
	EXPECT_EQ(states.back().step, flow.iterations);
}

/// The wanted curvature, by the lengths alone.
void expectCurvature(const SwappedFlow& swapped, const VertexArray<double>& wanted)
{
	const CurvatureMap& metric = *swapped.flow.metric;
	const MetricMeasure measure(metric.triangulation(), metric.lengths());
	EXPECT_EQ(measure.broken, 0);
	int checked = 0;
	for (const Vertex v : wanted.indices()) {
		if (swapped.domain.surface.topology.boundary[v])
			continue;
		++checked;
		EXPECT_NEAR(static_cast<double>(measure.curvature[v]), wanted[v], 1e-7);
	}
	EXPECT_GT(checked, 0);
}

TEST(SwappedFlow, ChangesNoEdgeWhereNothingBreaks)
{
	SwapRun run(fanWithAWideTriangle(), -1.0);
	const SwappedFlow swapped = run();
	EXPECT_EQ(run.starts, 1);
	EXPECT_TRUE(run.splits.empty());
	EXPECT_EQ(swapped.swaps, 0);
	EXPECT_EQ(swapped.splits, 0);
	EXPECT_TRUE(swapped.domain.isForeign.empty());
	expectCounted(run.states, swapped.flow);
	expectCurvature(swapped, run.curvature);
}

TEST(SwappedFlow, StartsAgainOnASplitBoundary)
{
	SwapRun run(fanWithAWideTriangle(), -3.0);
	const SwappedFlow swapped = run();
	EXPECT_EQ(run.starts, 2);
	EXPECT_EQ(run.splits, std::vector<int>{1});
	EXPECT_EQ(run.startVertices, (std::vector<int>{8, 9}));
	EXPECT_EQ(swapped.swaps, 0);
	EXPECT_EQ(swapped.splits, 1);
	expectCurvature(swapped, run.curvature);
	expectCounted(run.states, swapped.flow); // the steps of both starts in one row
	EXPECT_EQ(swapped.domain.corners.size(), 7);
	// The new vertex is the middle of the edge between vertices 7 and 1 of the mesh.
	const Triangulation& t = swapped.domain.surface.triangulation;
	ASSERT_EQ(t.vertexCount(), 9);
	const Point3 &a = run.component.positions[Vertex(7)], &b = run.component.positions[Vertex(1)];
	EXPECT_LT(
		distance(
			swapped.domain.surface.positions[Vertex(8)],
			Point3{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.0}),
		1e-15);
	ASSERT_EQ(swapped.domain.isForeign.size(), t.edgeCount());
	for (const Edge e : t.edges()) {
		const auto [i, j] = t.ends(e);
		EXPECT_EQ(swapped.domain.isForeign[e], i == Vertex(8) || j == Vertex(8));
	}
}

TEST(SwappedFlow, EndsInAMetricOrWithAReason)
{
	int swappedOnly = 0, both = 0, broken = 0;
	for (std::uint64_t seed = 1; seed <= 400; ++seed) {
		SCOPED_TRACE("seed " + std::to_string(seed));
		Random random(seed);
		SwapRun run(randomPlanarDisk(3 + random.index(3), random), 0.0);
		for (double& K : run.curvature)
			K = random.real(-7.0, 5.0);
		try {
			const SwappedFlow swapped = run();
			EXPECT_EQ(static_cast<int>(run.splits.size()), run.starts - 1);
			EXPECT_EQ(swapped.splits, run.splits.empty() ? 0 : run.splits.back());
			expectCounted(run.states, swapped.flow);
			expectCurvature(swapped, run.curvature);
			if (swapped.swaps == 0) {
				EXPECT_EQ(swapped.domain.isForeign.empty(), swapped.splits == 0);
				continue;
			}
			++(swapped.splits == 0 ? swappedOnly : both);
			// A cut may run on the component's own edges alone.
			const Triangulation& before = swapped.domain.surface.triangulation;
			const Triangulation& after = swapped.flow.metric->triangulation();
			ASSERT_EQ(swapped.domain.isForeign.size(), before.edgeCount());
			int forbidden = 0;
			for (const Edge e : before.edges()) {
				forbidden += swapped.domain.isForeign[e];
				if (swapped.domain.isForeign[e])
					continue;
				const auto [i, j] = after.ends(e);
				EXPECT_EQ(after.ends(e), before.ends(e));
				EXPECT_LT(std::max(i, j).number(), run.curvature.size());
			}
			if (swapped.splits == 0) {
				EXPECT_GT(forbidden, 0);
				EXPECT_LE(forbidden, swapped.swaps); // an edge may be swapped again
			}
		}
		catch (const NotConverged& error) {
			++broken;
			EXPECT_EQ(error.problem, NotConverged::BrokenTriangles) << error.what();
			EXPECT_GT(error.count, 0u);
			EXPECT_EQ(error.method, Method::EdgeSwaps);
			EXPECT_GE(error.swaps, 0);
		}
	}
	EXPECT_GT(swappedOnly, 20);
	EXPECT_GT(both, 20);
	EXPECT_GT(broken, 5);
}

TEST(SwappedFlow, GivesUpAfterTwentyStarts)
{
	SwapRun run(fanWithAWideTriangle(), -1e4);
	try {
		run();
		ADD_FAILURE() << "no error";
	}
	catch (const NotConverged& error) {
		EXPECT_EQ(error.problem, NotConverged::SplitsUsedUp);
		EXPECT_EQ(run.starts, 20);
		ASSERT_EQ(run.splits.size(), 20u);
		EXPECT_EQ(error.count, static_cast<std::size_t>(run.splits.back()));
		expectWords(error.what(), {"kept breaking", std::to_string(run.splits.back())});
	}
}

/// Ends the first start at step \p last with \p error.
template<class E>
SwapRun stoppedAt(int last, const E& error)
{
	SwapRun run(fanWithAWideTriangle(), -3.0);
	run.atStep = [last, error, calls = 0]() mutable {
		if (calls++ == last)
			throw error;
	};
	return run;
}

TEST(SwappedFlow, ACircleThatDoesNotSettleIsNotSplit)
{
	// The error of a circular boundary may come while a triangle on the boundary is broken. Others
	// that come then lead to a split.
	SwapRun patient(fanWithAWideTriangle(), -3.0);
	int stepsOfFirst = 0, atABrokenTriangle = 0;
	patient.atStep = [&] { stepsOfFirst += patient.starts == 1; };
	patient();
	for (int last = 0; last < stepsOfFirst; ++last) {
		SCOPED_TRACE("step " + std::to_string(last));
		SwapRun circle = stoppedAt(last, NotConverged(NotConverged::CircleUnsettled, 0, 0.25));
		try {
			circle();
			ADD_FAILURE() << "no error";
		}
		catch (const NotConverged& error) {
			EXPECT_EQ(error.problem, NotConverged::CircleUnsettled);
			EXPECT_EQ(error.value, 0.25);
		}
		EXPECT_TRUE(circle.splits.empty());
		EXPECT_EQ(circle.starts, 1);

		SwapRun other = stoppedAt(last, NotConverged(NotConverged::BrokenTriangles, 1));
		try {
			other();
		}
		catch (const NotConverged& error) {
			EXPECT_EQ(error.problem, NotConverged::BrokenTriangles);
			EXPECT_TRUE(other.splits.empty());
		}
		atABrokenTriangle += !other.splits.empty();
	}
	EXPECT_GT(atABrokenTriangle, 0);
}

TEST(SwappedFlow, CanBeCancelledAtEveryStep)
{
	SwapRun patient(fanWithAWideTriangle(), -3.0);
	patient();
	ASSERT_GT(patient.steps, 5);
	for (int last = 0; last < patient.steps; ++last) {
		SwapRun impatient = stoppedAt(last, Cancelled());
		EXPECT_THROW(impatient(), Cancelled);
		EXPECT_EQ(impatient.steps, last + 1);
	}
}

TEST(SwappedFlow, ErrorsOfTheTargetPassThrough)
{
	SwapRun run(fanWithAWideTriangle(), -1.0);
	const auto choose = [](const EmbeddedSurface&, InitialPacking&) -> Target {
		throw InvalidOption(InvalidOption::NothingSelected);
	};
	EXPECT_THROW(flowWithEdgeSwaps(run.component, run.options, choose, run.states), InvalidOption);
}

} // namespace
} // namespace ricci::testing
