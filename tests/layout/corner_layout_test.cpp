// SPDX-License-Identifier: GPL-3.0-or-later
// Layouts of a flow along any cut, against its lengths and scale factors. common_refinement_test.cpp has what the
// result shows.
#include "support/complex.h"
#include "support/expect.h"
#include "support/flipped_flow.h"
#include "support/implicit_surface.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/layout/corner_layout.h>
#include <ricci/mesh/normal_coordinates.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace ricci::testing {
namespace {

/// Flows on closed surfaces of genus 0, 1 and 2 that flip many edges, before the first step and after
/// it. Every vertex has a curvature of its own.
std::vector<FlippedFlow> closedFlows(Random& random)
{
	const std::vector<SurfaceMesh> meshes{
		shaken(perforatedSlab(0, 3), 0.15, random),
		bumpyTorus(12, 9, random),
		foldedTorus(3, 3, 0.1, random),
		shaken(perforatedSlab(2, 2), 0.15, random)};
	const int chi[] = {2, 0, 0, -2};
	std::vector<FlippedFlow> flows;
	for (std::size_t i = 0; i < meshes.size(); ++i) {
		const int vertices = static_cast<int>(meshes[i].positions.size());
		flows.emplace_back(
			meshes[i], prescribed(randomCurvature(vertices, chi[i], -4.0, 3.0, 1.0, random)));
	}
	return flows;
}

/// Closed, and with a boundary, on whose double some of them run.
std::vector<FlippedFlow> flows(std::uint64_t seed)
{
	Random random(610 + seed);
	std::vector<FlippedFlow> all = closedFlows(random);
	const SurfaceMesh ball = implicitClosed(0, 7, seed), annulus = implicitAnnulus(14, seed);
	std::vector<int> cones;
	for (int i = 0; i < 6; ++i)
		cones.push_back(random.index(static_cast<int>(ball.positions.size())));
	all.emplace_back(ball, conesAt(ball, cones));
	all.emplace_back(annulus, requestOf(TargetCurvature::Flat, false));
	all.emplace_back(annulus, requestOf(TargetCurvature::Automatic));
	for (const SurfaceMesh& disk : {implicitDisk(14, seed), sliverDisk(9, 1.5, random)})
		for (const TargetCurvature target :
			 {TargetCurvature::Disk, TargetCurvature::Rectangle, TargetCurvature::Automatic})
			all.emplace_back(disk, requestOf(target));
	return all;
}

/// Both are one figure, except for a motion without reflection.
void expectCongruent(const PlanarLayout& a, const PlanarLayout& b)
{
	ASSERT_EQ(a.points.size(), b.points.size());
	EXPECT_EQ(a.wedge, b.wedge);
	const auto from = [](const PlanarLayout& layout, int i) {
		return asComplex(layout.points[i]) - asComplex(layout.points[0]);
	};
	int far = 0;
	for (const int i : a.points.indices())
		far = std::abs(from(a, i)) > std::abs(from(a, far)) ? i : far;
	const Complex side = from(a, far), turn = from(b, far) / side;
	EXPECT_NEAR(std::abs(turn), 1.0, 1e-9);
	for (const int i : a.points.indices())
		EXPECT_LT(std::abs(turn * from(a, i) - from(b, i)), 1e-9 * std::abs(side));
}

/// The refinement is one of the surface, with the target's metric. At the input's corners it is the layout of
/// the corners alone, which is another way to the same points, off the cut as well as on it.
void expectValid(const FlippedFlow& flow, const CutGraph& cut, const SurfaceLayout& r)
{
	const VertexVector& k = flow.result.target.curvature;
	const MapCheck check(flow.mesh, r.refinement, {k.data(), k.data() + k.size()});
	const SurfaceType& type = flow.surface().topology.type;
	expectSurface(check, type.eulerCharacteristic(), type.boundaryLoops);
	EXPECT_LT(check.areaError, 1e-9);
	EXPECT_LT(check.angleError, 1e-8);
	EXPECT_NEAR(check.area / flow.result.area, 1.0, 1e-9);
	expectCongruent(layOutCorners(flow.domain, flow.result, cut.isCut).corners, r.corners);
	int seen = 0;
	for (const int piece : r.refinement.points.indices())
		for (const Corner c : cornersOf(piece))
			for (const Halfedge side : flow.base().halfedges(Face(r.refinement.face[piece])))
				if (flow.base().origin(side) == Vertex(r.refinement.vertices[c])) {
					EXPECT_EQ(r.corners[side], r.refinement.at(c));
					++seen;
				}
	EXPECT_GE(seen, 3 * flow.base().faceCount());
}

/// The support of a point on an edge of the input; empty elsewhere.
std::vector<int> inputEdgeAt(const SurfacePoint& x)
{
	std::vector<int> support;
	for (std::size_t i = 0; i < 4; ++i)
		if (x.weight[i] != 0.0)
			support.push_back(x.vertex[i]);
	std::sort(support.begin(), support.end());
	return support.size() == 2 ? support : std::vector<int>();
}

/// Where the cut enters an end triangle and leaves it through the same side, the parts that it
/// makes of the triangle behind that side have one place in the layout. Edges of input and end are straight in
/// different metrics and can cross twice with no vertex between: more often than curves pulled tight.
TEST(CornerLayout, TheCutMayCrossAnEndEdgeTwice)
{
	long tooMany = 0;
	for (std::uint64_t seed = 1; seed <= 40; ++seed) {
		SCOPED_TRACE(seed);
		Random random(seed);
		const SurfaceMesh mesh = foldedTorus(3, 3, 0.1, random);
		const FlippedFlow flow(
			mesh,
			prescribed(randomCurvature(
				static_cast<int>(mesh.positions.size()), 0, -12.0, 6.0, 0.4, random)));
		const CutGraph cut = flow.cutAnywhere(random);
		const SurfaceLayout r = flow.refinement(cut);
		expectValid(flow, cut, r);
		long crossings = 0;
		for (const StraightLine& line : straightLines(mesh, r.refinement, 1e-6))
			for (int point : line.points)
				crossings += !inputEdgeAt(r.refinement.source[point]).empty();
		tooMany += crossings / 2; // a line is found from both its ends
		NormalCoordinates tight(flow.result.input(flow.surface()));
		for (const auto* flips : {&flow.result.start.flips, &flow.result.flips})
			for (const Edge e : *flips)
				tight.flip(e);
		for (const Edge e : flow.base().edges())
			tooMany -= tight.crossings(e);
	}
	EXPECT_GT(tooMany, 20); // or the test says little
}

/// Ends of the edges of the input that are not edges of the start.
std::set<std::pair<int, int>> flippedInputEdges(const FlippedFlow& flow)
{
	NormalCoordinates coordinates(flow.result.input(flow.surface()));
	for (const Edge e : flow.result.start.flips)
		coordinates.flip(e);
	const auto curves = coordinates.trace();
	std::set<std::pair<int, int>> flipped;
	for (const Edge e : flow.base().edges())
		if (!curves[e].crossings.empty()) {
			const auto [from, to] = flow.base().ends(e);
			flipped.insert(std::minmax({from.number(), to.number()}));
		}
	return flipped;
}

double crossRatio(const std::vector<double>& x, std::size_t i)
{
	return (x[i + 2] - x[i]) * (x[i + 3] - x[i + 1]) / ((x[i + 2] - x[i + 1]) * (x[i + 3] - x[i]));
}

/// What is seen along one edge of the end.
struct AlongEndEdge
{
	const StraightLine& line;
	const Array<SurfacePoint>& points;
	const std::set<std::pair<int, int>>& flipped;

	/// Whether an input edge, but no start edge, crosses at point i of the line.
	bool isInside(std::size_t i) const
	{
		const auto edge = inputEdgeAt(points[line.points[i]]);
		return !edge.empty() && flipped.count({edge[0], edge[1]}) > 0;
	}

	/// Largest change of the cross-ratio of four points in one start triangle; -1 without such.
	double crossRatioChange() const
	{
		double worst = -1.0;
		const auto &s = line.inSpace, &u = line.inPlane;
		for (std::size_t i = 0; i + 3 < line.points.size(); ++i) {
			double least = isInside(i + 1) && isInside(i + 2) ? 1.0 : 0.0;
			for (std::size_t k = i; k < i + 3; ++k)
				least = std::min(
					{least,
					 (s[k + 1] - s[k]) / (s[i + 3] - s[i]),
					 (u[k + 1] - u[k]) / (u[i + 3] - u[i])});
			if (least > 1e-4)
				worst = std::max(worst, std::abs(crossRatio(u, i) / crossRatio(s, i) - 1.0));
		}
		return worst;
	}

	/// A map of [0,1] to itself that keeps both ends and takes x to y is the projective
	/// t -> r t / (1 - t + r t). The product of these r over the line's parts in the start triangles; 0 if one
	/// of them has no point well inside. \p parts receives their number.
	double factor(int& parts) const
	{
		const auto &s = line.inSpace, &u = line.inPlane;
		double product = 1.0;
		parts = 0;
		for (std::size_t from = 0, to; from + 1 < s.size(); from = to) {
			double best = 1e-3, found = 0.0;
			for (to = from + 1; to + 1 < s.size() && isInside(to);)
				++to;
			for (std::size_t i = from + 1; i < to; ++i) {
				const double x = (s[i] - s[from]) / (s[to] - s[from]);
				const double y = (u[i] - u[from]) / (u[to] - u[from]);
				if (x * (1 - x) * y * (1 - y) > best) {
					best = x * (1 - x) * y * (1 - y);
					found = y * (1.0 - x) / ((1.0 - y) * x);
				}
			}
			product *= found;
			++parts;
		}
		return product;
	}
};

/// Every edge at the end of the flow is made of the refinement's edges, is straight in the plane across all of
/// them, and as long as the flow says. Inside a start triangle it is straight on the surface as well, and the map
/// between the two is projective: it keeps the cross-ratio of any four points there. Along the whole edge ab its
/// factors multiply to exp(-(du_b - du_a)), du being the change of the logarithmic radii: the decorated discrete
/// conformal map.
TEST(CommonRefinement, MapsEndEdgesByTheProjectiveMapOfTheRadii)
{
	int edges = 0, crossRatios = 0, factors = 0;
	double largest = 0.0;
	for (std::uint64_t seed : {1u, 2u, 3u})
		for (const FlippedFlow& flow : flows(seed)) {
			const FlowResult& result = flow.result;
			const SurfaceLayout r = flow.refinement(flow.cut());
			const auto flipped = flippedInputEdges(flow);
			VertexVector change = result.u;
			for (const Vertex v : result.start.radii.indices())
				change[v] -= std::log(result.start.radii[v]);
			const Triangulation& end = result.metric->triangulation();
			std::multimap<std::pair<int, int>, StraightLine> lines;
			for (const StraightLine& line : straightLines(flow.mesh, r.refinement, 1e-3))
				lines.insert({{line.from, line.to}, line});
			for (const Edge e : end.edges()) {
				const auto [from, to] = end.ends(e);
				const auto [first, last] = lines.equal_range({from.number(), to.number()});
				const auto found = std::find_if(first, last, [&](const auto& line) {
					return std::abs(line.second.length / result.metric->lengths()[e] - 1.0) < 1e-9;
				});
				if (found == last) {
					EXPECT_TRUE(result.doubled); // edges across the seam are cut in two
					continue;
				}
				++edges;
				const StraightLine& line = found->second;
				// An edge of the input that is kept, or as good as straight, is not a test.
				bool inInputEdge = false;
				for (std::size_t i = 1; i + 1 < line.points.size(); ++i)
					inInputEdge |= inputEdgeAt(r.refinement.source[line.points[i]]) ==
								   std::vector<int>{
									   std::min(line.from, line.to), std::max(line.from, line.to)};
				if (inInputEdge)
					continue;
				const AlongEndEdge along{line, r.refinement.source, flipped};
				const double ratio = along.crossRatioChange();
				EXPECT_LT(ratio, 1e-7);
				crossRatios += ratio >= 0.0;
				int parts = 0;
				const double factor = along.factor(parts);
				if (factor == 0.0)
					continue;
				const double expected = std::exp(change[from] - change[to]);
				EXPECT_NEAR(factor / expected, 1.0, 1e-7) << parts << " parts";
				factors += parts > 1;
				if (parts > 1)
					largest = std::max(largest, std::abs(std::log(expected)));
			}
		}
	EXPECT_GT(edges, 5000);
	EXPECT_GT(crossRatios, 50);
	EXPECT_GT(factors, 15);
	EXPECT_GT(largest, 0.3); // where an affine map would fail
}

} // namespace
} // namespace ricci::testing
