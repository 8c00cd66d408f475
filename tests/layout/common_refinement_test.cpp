// SPDX-License-Identifier: GPL-3.0-or-later
// The overlay of the input's, the start's and the end's triangles after the flow.
#include "support/complex.h"
#include "support/flat_map.h"
#include "support/flipped_flow.h"
#include "support/implicit_surface.h"
#include "support/intrinsic.h"
#include "support/random.h"
#include "support/random_surface.h"
#include "support/refinement_check.h"
#include "support/shapes.h"

#include <ricci/layout/common_refinement.h>
#include <ricci/parametrize.h>
#include <ricci/surface/normal_coordinates.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

VertexVector logOf(const VertexArray<double>& radii)
{
	VertexVector logarithm(radii.size());
	for (const Vertex v : radii.indices())
		logarithm[v] = std::log(radii[v]);
	return logarithm;
}

struct Problem
{
	std::string name;
	SurfaceMesh mesh;
	TargetRequest request;
	double epsilon = 1e-10;
};

TargetRequest someCones(const SurfaceMesh& mesh, int count, Random& random)
{
	std::vector<int> cones;
	for (int i = 0; i < count; ++i)
		cones.push_back(random.index(static_cast<int>(mesh.positions.size())));
	return conesAt(mesh, cones);
}

std::vector<Problem> problems(std::uint64_t seed)
{
	Random random(500 + seed);
	std::vector<Problem> all;
	for (int genus : {0, 2}) {
		const SurfaceMesh mesh = implicitClosed(genus, 7, seed);
		all.push_back({"genus " + std::to_string(genus), mesh, someCones(mesh, 6, random)});
		const SurfaceMesh slab = shaken(perforatedSlab(genus, 2), 0.1, random);
		all.push_back(
			{"slab of genus " + std::to_string(genus),
			 slab,
			 prescribed(randomCurvature(
				 static_cast<int>(slab.positions.size()), 2 - 2 * genus, -3, 3, 1.0, random))});
	}
	const SurfaceMesh donut = implicitClosed(1, 8, seed);
	all.push_back({"torus", donut, requestOf(TargetCurvature::Flat)});
	all.push_back(
		{"torus with cones",
		 donut,
		 prescribed(
			 randomCurvature(static_cast<int>(donut.positions.size()), 0, -3, 3, 0.1, random))});
	all.push_back({"annulus", implicitAnnulus(16, seed), requestOf(TargetCurvature::Flat, false)});
	all.push_back(
		{"free annulus", implicitAnnulus(16, seed), requestOf(TargetCurvature::Automatic)});
	const SurfaceMesh disk = implicitDisk(16, seed);
	all.push_back({"free disk", disk, requestOf(TargetCurvature::Automatic)});
	all.push_back({"disk", disk, requestOf(TargetCurvature::Disk)});
	all.push_back({"rectangle", disk, requestOf(TargetCurvature::Rectangle)});
	const SurfaceMesh sliver = sliverDisk(9, 1.5, random);
	all.push_back({"sliver disk", sliver, requestOf(TargetCurvature::Disk)});
	all.push_back({"sliver rectangle", sliver, requestOf(TargetCurvature::Rectangle)});
	return all;
}

/// Points that are not vertices of the surface.
std::size_t crossingsIn(const SurfaceLayout& refinement, const FlippedFlow& flow)
{
	return refinement.refinement.source.values().size() - flow.mesh.positions.size();
}

std::vector<double> targetOf(const FlippedFlow& flow)
{
	const VertexVector& k = flow.result.target.curvature;
	return {k.data(), k.data() + k.size()};
}

void expectValid(const FlippedFlow& flow, const SurfaceLayout& refinement)
{
	const RefinementCheck check(flow.mesh, refinement.refinement, targetOf(flow));
	const SurfaceType& type = flow.surface().topology.type;
	check.expectValid(type.eulerCharacteristic(), type.boundaryLoops);
	EXPECT_LT(check.areaError, 1e-9);
	EXPECT_LT(check.angleError, 1e-8);
	EXPECT_NEAR(check.area / flow.result.area, 1.0, 1e-9);
	ASSERT_GE(refinement.refinement.source.values().size(), flow.mesh.positions.size());
	for (int v = 0; at(v) < flow.mesh.positions.size(); ++v) {
		EXPECT_EQ(refinement.refinement.source[v].vertex[0], v);
		EXPECT_EQ(refinement.refinement.source[v].weight[0], 1.0);
	}
}

TEST(CommonRefinement, IsTheSurfaceWithAMapWithoutFlips)
{
	std::size_t crossings = 0;
	for (std::uint64_t seed : {1u, 2u, 3u})
		for (const Problem& p : problems(seed)) {
			SCOPED_TRACE(p.name + ", seed " + std::to_string(seed));
			const FlippedFlow flow(p.mesh, p.request, p.epsilon);
			const SurfaceLayout refinement = flow.refinement(flow.cut());
			expectValid(flow, refinement);
			crossings += crossingsIn(refinement, flow);
		}
	EXPECT_GT(crossings, 5000u); // or the test says little
}

/// Every edge at the end of the flow is made of the refinement's edges, is straight in the plane
/// across all of them, and as long as the flow says.
TEST(CommonRefinement, EdgesOfTheEndAreStraight)
{
	int seen = 0;
	for (std::uint64_t seed : {1u, 2u})
		for (const Problem& p : problems(seed)) {
			SCOPED_TRACE(p.name + ", seed " + std::to_string(seed));
			const FlippedFlow flow(p.mesh, p.request, p.epsilon);
			if (flow.result.doubled)
				continue; // edges across the seam are cut in two
			const SurfaceLayout refinement = flow.refinement(flow.cut());
			const auto lines = straightLines(flow.mesh, refinement.refinement, 1e-3);
			const Triangulation& end = flow.result.metric->triangulation();
			int missing = 0;
			for (const Edge e : end.edges()) {
				const double length = flow.result.metric->lengths()[e];
				const auto [from, to] = end.ends(e);
				missing += std::none_of(
					lines.begin(),
					lines.end(),
					[&, from = from.number(), to = to.number()](const StraightLine& line) {
						return line.from == from && line.to == to &&
							   std::abs(line.length / length - 1.0) < 1e-9;
					});
			}
			EXPECT_EQ(missing, 0);
			++seen;
		}
	EXPECT_GT(seen, 12); // at least the six closed ones of each seed
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

/// Crossings of the input's edges with the end's that curves pulled tight would not have. Edges of
/// the two are straight in different metrics and can cross twice with no vertex between.
long crossingsTooMany(const FlippedFlow& flow, const SurfaceLayout& refinement)
{
	long crossings = 0;
	for (const StraightLine& line : straightLines(flow.mesh, refinement.refinement, 1e-6))
		for (int point : line.points)
			crossings += !inputEdgeAt(refinement.refinement.source[point]).empty();
	crossings /= 2; // a line is found from both its ends
	NormalCoordinates tight(flow.result.input);
	for (const auto* flips : {&flow.result.start.flips, &flow.result.flips})
		for (const Edge e : *flips)
			tight.flip(e);
	for (const Edge e : flow.base().edges())
		crossings -= tight.crossings(e);
	return crossings;
}

/// Where the cut enters an end triangle and leaves it through the same side, the parts that it
/// makes of the triangle behind that side have one place in the layout.
TEST(CommonRefinement, TheCutMayCrossAnEndEdgeTwice)
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
		const SurfaceLayout refinement = flow.refinement(flow.cutAnywhere(random));
		expectValid(flow, refinement);
		tooMany += crossingsTooMany(flow, refinement);
	}
	EXPECT_GT(tooMany, 20); // or the test says little
}

/// Ends of the edges of the input that are not edges of the start.
std::set<std::pair<int, int>> flippedInputEdges(const FlippedFlow& flow)
{
	NormalCoordinates coordinates(flow.result.input);
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

double crossRatio(double a, double b, double c, double d)
{
	return (c - a) * (d - b) / ((c - b) * (d - a));
}

/// A map of [0,1] to itself that keeps both ends and takes x to y is the projective
/// t -> r t / (1 - t + r t); this is r.
double projectiveFactor(double x, double y)
{
	return y * (1.0 - x) / ((1.0 - y) * x);
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
		for (std::size_t i = 1; i + 2 < line.points.size(); ++i) {
			if (!isInside(i) || !isInside(i + 1))
				continue;
			double least = 1.0;
			for (std::size_t k = i - 1; k < i + 2; ++k)
				least = std::min(
					{least,
					 (s[k + 1] - s[k]) / (s[i + 2] - s[i - 1]),
					 (u[k + 1] - u[k]) / (u[i + 2] - u[i - 1])});
			if (least > 1e-4)
				worst = std::max(
					worst,
					std::abs(
						crossRatio(u[i - 1], u[i], u[i + 1], u[i + 2]) /
							crossRatio(s[i - 1], s[i], s[i + 1], s[i + 2]) -
						1.0));
		}
		return worst;
	}

	/// Product of the projective factors of the line's parts in the start triangles; 0 if one of
	/// them has no point well inside. \p parts receives their number.
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
					found = projectiveFactor(x, y);
				}
			}
			product *= found;
			++parts;
		}
		return product;
	}
};

/// Inside a start triangle an edge of the end is straight on the surface as well as in the plane,
/// and the map between the two is projective: it keeps the cross-ratio of any four points there.
/// Along the whole edge ab its factors multiply to exp(-(du_b - du_a)), du being the change of the
/// logarithmic radii: the decorated discrete conformal map.
TEST(CommonRefinement, TheMapIsTheProjectiveOneOfTheRadii)
{
	int crossRatios = 0, factors = 0;
	double largest = 0.0;
	for (std::uint64_t seed : {1u, 2u, 3u})
		for (const Problem& p : problems(seed)) {
			SCOPED_TRACE(p.name + ", seed " + std::to_string(seed));
			const FlippedFlow flow(p.mesh, p.request, p.epsilon);
			const FlowResult& result = flow.result;
			const SurfaceLayout r = flow.refinement(flow.cut());
			const auto flipped = flippedInputEdges(flow);
			const VertexVector change = result.u - logOf(result.start.radii);
			const Triangulation& end = result.metric->triangulation();
			std::map<std::pair<int, int>, std::vector<double>> lengths;
			for (const Halfedge h : end.halfedges())
				lengths[{end.origin(h).number(), end.target(h).number()}].push_back(
					result.metric->lengths()[h.edge()]);
			for (const StraightLine& line : straightLines(p.mesh, r.refinement, 1e-3)) {
				const auto& known = lengths[{line.from, line.to}];
				if (std::none_of(known.begin(), known.end(), [&](double length) {
						return std::abs(line.length / length - 1.0) < 1e-9;
					}))
					continue;
				// An edge of the input that is kept, or as good as straight, is no test.
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
				const double expected =
					std::exp(change[Vertex(line.from)] - change[Vertex(line.to)]);
				EXPECT_NEAR(factor / expected, 1.0, 1e-7) << parts << " parts";
				factors += parts > 1;
				if (parts > 1)
					largest = std::max(largest, std::abs(std::log(expected)));
			}
		}
	EXPECT_GT(crossRatios, 100);
	EXPECT_GT(factors, 30);
	EXPECT_GT(largest, 0.3); // where an affine map would fail
}

/// The layout of the input's corners is that of the pieces at them, off the cut as well as on it.
TEST(CommonRefinement, LayoutOfTheInputIsThatOfItsPieces)
{
	for (const Problem& p : problems(4)) {
		SCOPED_TRACE(p.name);
		const FlippedFlow flow(p.mesh, p.request, p.epsilon);
		const SurfaceLayout r = flow.refinement(flow.cut());
		int seen = 0;
		for (const int piece : r.refinement.points.indices()) {
			const auto h = flow.base().halfedges(Face(r.refinement.face[piece]));
			for (std::size_t k = 0; k < 3; ++k)
				for (const Halfedge side : h)
					if (flow.base().origin(side) == Vertex(r.refinement.vertices[piece][k])) {
						EXPECT_EQ(r.corners[side], r.refinement.at(piece)[k]);
						++seen;
					}
		}
		EXPECT_GE(seen, 3 * flow.base().faceCount());
	}
}

TEST(CommonRefinement, IsTheInputWhereNothingFlips)
{
	// Equilateral triangles are Delaunay with room, and flat already.
	const SurfaceMesh mesh = grid(6, 5, Ends::Open, Ends::Open, [](int i, int j) {
		// The grid's diagonal is the third direction of the lattice.
		return Point3{0.5 * (i + j), (i - j) * -0.5 * std::sqrt(3.0), 0.0};
	});
	const FlippedFlow flow(mesh, requestOf(TargetCurvature::Automatic));
	ASSERT_TRUE(flow.result.start.flips.empty());
	ASSERT_TRUE(flow.result.flips.empty());
	const SurfaceLayout r = flow.refinement(flow.cut());
	EXPECT_EQ(crossingsIn(r, flow), 0u);
	ASSERT_EQ(r.refinement.vertices.values().size(), mesh.triangles.size());
	std::vector<char> met(mesh.triangles.size(), 0);
	for (const int piece : r.refinement.points.indices()) {
		Triangle t = r.refinement.vertices[piece];
		const Face f = Face(r.refinement.face[piece]);
		const Triangle& face = mesh.triangles[at(f)];
		for (int turn = 0; turn < 3 && t != face; ++turn)
			std::rotate(t.begin(), t.begin() + 1, t.end());
		EXPECT_EQ(t, face);
		met[at(f)] = 1;
	}
	EXPECT_EQ(std::count(met.begin(), met.end(), 1), static_cast<long>(met.size()));
}

/// A plane surface with a free boundary is mapped to itself, at every crossing too.
TEST(CommonRefinement, APlaneIsMappedToItself)
{
	Random random(510);
	for (int i = 0; i < 4; ++i) {
		SurfaceMesh mesh = randomPlanarDisk(9, random);
		if (i == 3)
			for (Point3& p : mesh.positions)
				p[0] *= 30.0; // needles
		const FlippedFlow flow(mesh, requestOf(TargetCurvature::Automatic));
		EXPECT_GT(flow.result.start.flips.size(), 10u);
		const SurfaceLayout r = flow.refinement(flow.cut());
		EXPECT_GT(crossingsIn(r, flow), 10u);
		expectValid(flow, r);
		const auto source = [&](int point) {
			const Point3 p = placeOnSurface(r.refinement.source[point], mesh.positions);
			return Complex(p[0], p[1]);
		};
		const auto image = [&](int piece, std::size_t k) {
			return asComplex(r.refinement.at(piece)[k]);
		};
		// The similarity that fits best: through the two corners farthest apart.
		Complex a, b, fa, fb;
		for (const int piece : r.refinement.points.indices())
			for (std::size_t k = 0; k < 3; ++k) {
				const Complex z = source(r.refinement.vertices[piece][k]);
				if ((piece == 0 && k == 0) || z.real() + z.imag() < a.real() + a.imag())
					a = z, fa = image(piece, k);
				if ((piece == 0 && k == 0) || z.real() + z.imag() > b.real() + b.imag())
					b = z, fb = image(piece, k);
			}
		const Complex factor = (fb - fa) / (b - a);
		double error = 0.0;
		for (const int piece : r.refinement.points.indices())
			for (std::size_t k = 0; k < 3; ++k)
				error = std::max(
					error,
					std::abs(
						fa + factor * (source(r.refinement.vertices[piece][k]) - a) -
						image(piece, k)));
		EXPECT_LT(error / std::abs(fb - fa), 1e-9);
	}
}

/// With the surface's own curvature as target the flow stands still: the map is the development of
/// the surface, straight on every face of the input.
TEST(CommonRefinement, IsTheDevelopmentWhereTheMetricStays)
{
	Random random(520);
	std::vector<SurfaceMesh> meshes{
		shaken(tetrahedron(), 0.4, random),
		shaken(fan(6, 0.3), 0.3, random),
		shaken(bipyramid(5, 0.2), 0.3, random),
		shaken(bipyramid(3, 0.1), 0.1, random),
		shaken(perforatedSlab(0, 1), 0.3, random),
		shaken(rectangle(2, 2, 1, 1), 0.3, random)};
	int flips = 0;
	for (int round = 0; round < 30; ++round)
		for (const SurfaceMesh& original : meshes) {
			SCOPED_TRACE("round " + std::to_string(round));
			const SurfaceMesh mesh = shaken(original, 0.2, random);
			const FlippedFlow flow(mesh, prescribed(curvatureInSpace(mesh)));
			const FlowResult& result = flow.result;
			if (result.doubled)
				continue;
			flips += static_cast<int>(result.start.flips.size());
			const SurfaceLayout r = flow.refinement(flow.cut());
			ASSERT_LT((result.u - logOf(result.start.radii)).lpNorm<Eigen::Infinity>(), 1e-9);
			expectValid(flow, r);
			for (const int piece : r.refinement.points.indices()) {
				const auto h = flow.base().halfedges(Face(r.refinement.face[piece]));
				std::array<Point3, 3> p;
				for (std::size_t k = 0; k < 3; ++k) {
					const SurfacePoint& point =
						r.refinement.source[r.refinement.vertices[piece][k]];
					p[k] = placeOnSurface(point, mesh.positions);
					Point2 developed{0.0, 0.0};
					for (const Halfedge side : h)
						for (std::size_t i = 0; i < 4; ++i)
							if (point.weight[i] != 0.0 &&
								Vertex(point.vertex[i]) == flow.base().origin(side))
								for (std::size_t x = 0; x < 2; ++x)
									developed[x] += point.weight[i] * r.corners[side][x];
					EXPECT_NEAR(developed[0], r.refinement.at(piece)[k][0], 1e-8);
					EXPECT_NEAR(developed[1], r.refinement.at(piece)[k][1], 1e-8);
				}
				for (std::size_t k = 0; k < 3; ++k)
					EXPECT_NEAR(
						distance(r.refinement.at(piece)[k], r.refinement.at(piece)[(k + 1) % 3]),
						distance(p[k], p[(k + 1) % 3]),
						1e-8);
			}
		}
	EXPECT_GT(flips, 100);
}

/// The same surface through the whole algorithm: what it hands over is the same refinement, scaled.
TEST(CommonRefinement, AreaIsThatOfTheSurfaceInTheResult)
{
	int seen = 0;
	for (const Problem& p : problems(5)) {
		if (p.request.options.target == TargetCurvature::Prescribed)
			continue;
		SCOPED_TRACE(p.name);
		Options options;
		options.target = p.request.options.target;
		options.freeBoundary = p.request.options.freeBoundary;
		options.epsilon = p.epsilon;
		options.output = OutputTriangulation::CommonRefinement;
		VertexInput input;
		input.selected = p.request.selected.values();
		const FlatResult flat = run(p.mesh, options, input);
		const FlatMesh& r = flat.mesh;
		const RefinementCheck check(p.mesh, r, flat.targetCurvature);
		EXPECT_EQ(check.notPositive, 0);
		EXPECT_EQ(flat.report.flippedFaces, 0);
		EXPECT_LT(check.seamMismatch, 1e-9);
		EXPECT_LT(check.angleError, 1e-8);
		EXPECT_LT(check.areaError, 1e-9);
		const FlippedFlow flow(p.mesh, p.request, p.epsilon);
		const bool free = flow.result.target.hasFixed();
		double area = flow.result.area;
		if (!free) {
			area = 0.0;
			const MetricMeasure measure(flow.base(), flow.surface().lengths);
			area = static_cast<double>(measure.area);
		}
		EXPECT_NEAR(check.area / area, 1.0, 1e-9);
		EXPECT_EQ(
			flat.report.refinementPoints,
			r.source.size() - static_cast<int>(p.mesh.positions.size()));
		++seen;
	}
	EXPECT_EQ(seen, 10); // all but the three with prescribed curvature
}

} // namespace
} // namespace ricci::testing
