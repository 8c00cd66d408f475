// SPDX-License-Identifier: GPL-3.0-or-later
// The overlay of the input's and the flow's triangles, on which the map is exact.
#include "support/complex.h"
#include "support/flat_map.h"
#include "support/flipped_flow.h"
#include "support/implicit_surface.h"
#include "support/intrinsic.h"
#include "support/random_surface.h"
#include "support/refinement_check.h"
#include "support/shapes.h"

#include <ricci/parametrize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

struct Problem
{
	std::string name;
	SurfaceMesh mesh;
	Options options;
	VertexInput input;

	Problem(std::string n, SurfaceMesh m, TargetCurvature target, VertexInput values = {}) :
			name(std::move(n)), mesh(std::move(m)), input(std::move(values))
	{
		options.target = target;
		options.freeBoundary = target == TargetCurvature::Automatic;
		options.epsilon = 1e-10;
		options.output = OutputTriangulation::CommonRefinement;
		options.finish = Finish::None;
		options.holes = Holes::Boundaries;
		options.charts = Charts::OfTheFlow;
		options.normalizeUV = false;
	}

	Parametrization solve() const { return parametrizeEuclidean(mesh, input, options); }
};

Problem withCurvature(std::string name, const SurfaceMesh& mesh, std::vector<double> curvature)
{
	VertexInput input;
	input.targetCurvature = std::move(curvature);
	return {std::move(name), mesh, TargetCurvature::Prescribed, input};
}

Problem withRandomCurvature(
	std::string name, const SurfaceMesh& mesh, int chi, double share, Random& random)
{
	const int vertices = static_cast<int>(mesh.positions.size());
	return withCurvature(
		std::move(name), mesh, randomCurvature(vertices, chi, -3, 3, share, random));
}

std::vector<Problem> problems(std::uint64_t seed)
{
	Random random(500 + seed);
	std::vector<Problem> all;
	for (int genus : {0, 2}) {
		const std::string name = "genus " + std::to_string(genus);
		const SurfaceMesh mesh = implicitClosed(genus, 7, seed);
		std::vector<int> cones;
		for (int i = 0; i < 6; ++i)
			cones.push_back(random.index(static_cast<int>(mesh.positions.size())));
		all.emplace_back(name, mesh, TargetCurvature::SelectedCones, selecting(mesh, cones));
		const SurfaceMesh slab = shaken(perforatedSlab(genus, 2), 0.1, random);
		all.push_back(withRandomCurvature("slab of " + name, slab, 2 - 2 * genus, 1.0, random));
	}
	const SurfaceMesh donut = implicitClosed(1, 8, seed);
	all.emplace_back("torus", donut, TargetCurvature::Flat);
	all.push_back(withRandomCurvature("torus with cones", donut, 0, 0.1, random));
	const SurfaceMesh annulus = implicitAnnulus(16, seed), disk = implicitDisk(16, seed);
	all.emplace_back("annulus", annulus, TargetCurvature::Flat);
	all.emplace_back("free annulus", annulus, TargetCurvature::Automatic);
	all.emplace_back("free disk", disk, TargetCurvature::Automatic);
	const SurfaceMesh sliver = sliverDisk(9, 1.5, random);
	for (const auto& [name, mesh] : {std::pair("disk", disk), std::pair("sliver disk", sliver)}) {
		all.emplace_back(name, mesh, TargetCurvature::Disk);
		all.emplace_back(std::string(name) + " as rectangle", mesh, TargetCurvature::Rectangle);
	}
	return all;
}

/// A surface of the input's kind, whose metric in the plane is flat but for the cones.
void expectValid(const Problem& p, const Parametrization& map)
{
	const RefinementCheck check(p.mesh, map.mesh, map.targetCurvature);
	check.expectValid(
		map.report.eulerCharacteristic, map.report.boundaryLoops, map.report.maxCurvatureError);
	EXPECT_LT(check.areaError, 1e-9);
	EXPECT_LT(check.angleError, 1e-8);
	if (map.report.boundaryRatioMin) { // free boundaries keep their lengths
		EXPECT_NEAR(*map.report.boundaryRatioMin, 1.0, 1e-9);
		EXPECT_NEAR(map.report.boundaryRatioMax.value_or(0.0), 1.0, 1e-9);
	}
	else { // others the surface its area
		EXPECT_NEAR(check.area / map.mesh.area(), 1.0, 1e-9);
	}
	const std::size_t vertices = p.mesh.positions.size();
	ASSERT_EQ(at(map.mesh.source.size()), vertices + at(map.report.refinementPoints));
	for (int v = 0; at(v) < vertices; ++v) {
		EXPECT_EQ(map.mesh.source[v].vertex[0], v);
		EXPECT_EQ(map.mesh.source[v].weight[0], 1.0);
	}
}

/// The flow's triangles have 3 (V - chi) edges, if the surface is closed, which go from vertex to vertex straight
/// on.
void expectStraightLines(const Problem& p, const Parametrization& map)
{
	const std::size_t lines = straightLines(p.mesh, map.mesh, 1e-6).size(); // from both their ends
	const int edges =
		3 * (static_cast<int>(p.mesh.positions.size()) - map.report.eulerCharacteristic);
	EXPECT_GE(lines / 2, at(edges));
}

/// The layout of the input's corners alone is that of the refinement's at them, up to a similarity.
void expectCornersOfKeptMesh(const Problem& p, const Parametrization& refined)
{
	Problem kept = p;
	kept.options.output = OutputTriangulation::KeepMesh;
	const Parametrization map = kept.solve();
	std::vector<std::pair<Complex, Complex>> places;
	for (const int piece : refined.mesh.points.indices())
		for (const Corner c : cornersOf(piece))
			for (const Corner own : cornersOf(refined.mesh.face[piece]))
				if (map.mesh.vertices[own] == refined.mesh.vertices[c])
					places.push_back({asComplex(map.mesh.at(own)), asComplex(refined.mesh.at(c))});
	ASSERT_GE(places.size(), 3 * p.mesh.triangles.size());
	const auto far = *std::max_element(places.begin(), places.end(), [&](auto& a, auto& b) {
		return std::abs(a.first - places[0].first) < std::abs(b.first - places[0].first);
	});
	const Complex side = far.first - places[0].first;
	const Complex turn = (far.second - places[0].second) / side;
	for (const auto& [a, b] : places)
		EXPECT_LT(
			std::abs(places[0].second + turn * (a - places[0].first) - b),
			1e-8 * std::abs(turn * side));
}

TEST(CommonRefinement, IsTheSurfaceWithAMapThatIsExactAndWithoutFlips)
{
	int crossings = 0;
	for (std::uint64_t seed : {1u, 2u, 3u})
		for (const Problem& p : problems(seed)) {
			SCOPED_TRACE(p.name + ", seed " + std::to_string(seed));
			const Parametrization map = p.solve();
			expectValid(p, map);
			if (map.report.boundaryLoops == 0)
				expectStraightLines(p, map);
			if (seed == 3)
				expectCornersOfKeptMesh(p, map);
			crossings += map.report.refinementPoints;
		}
	EXPECT_GT(crossings, 5000); // or the test says little
}

/// Equilateral triangles are Delaunay with room, and flat already.
TEST(CommonRefinement, IsTheInputWhereNothingFlips)
{
	const SurfaceMesh mesh = grid(6, 5, Ends::Open, Ends::Open, [](int i, int j) {
		// The grid's diagonal is the third direction of the lattice.
		return Point3{0.5 * (i + j), (i - j) * -0.5 * std::sqrt(3.0), 0.0};
	});
	const Parametrization map = Problem("lattice", mesh, TargetCurvature::Automatic).solve();
	EXPECT_EQ(map.report.refinementPoints, 0);
	EXPECT_EQ(map.report.flips, 0);
	ASSERT_EQ(map.mesh.vertices.values().size(), mesh.triangles.size());
	std::set<int> met;
	for (const int piece : map.mesh.points.indices()) {
		Triangle t = map.mesh.vertices[piece];
		const Triangle& face = mesh.triangles[at(map.mesh.face[piece])];
		for (int turn = 0; turn < 3 && t != face; ++turn)
			std::rotate(t.begin(), t.begin() + 1, t.end());
		EXPECT_EQ(t, face);
		met.insert(map.mesh.face[piece]);
	}
	EXPECT_EQ(met.size(), mesh.triangles.size());
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
		const Problem p("plane", mesh, TargetCurvature::Automatic);
		const Parametrization map = p.solve();
		EXPECT_GT(map.report.refinementPoints, 10);
		expectValid(p, map);
		const std::vector<Point3> source = map.mesh.onSurface(mesh.positions);
		const auto place = [&](Corner c) {
			const Point3& q = source[at(map.mesh.vertices[c])];
			return Complex(q[0], q[1]);
		};
		// The similarity that fits best: through the two corners farthest apart.
		Corner a(0), b(0);
		for (int c = 0; c < 3 * map.mesh.size(); ++c) {
			const auto along = [&](Corner x) { return place(x).real() + place(x).imag(); };
			a = along(Corner(c)) < along(a) ? Corner(c) : a;
			b = along(Corner(c)) > along(b) ? Corner(c) : b;
		}
		const Complex from = asComplex(map.mesh.at(a)), to = asComplex(map.mesh.at(b));
		const Complex factor = (to - from) / (place(b) - place(a));
		EXPECT_NEAR(std::abs(factor), 1.0, 1e-9);
		for (int c = 0; c < 3 * map.mesh.size(); ++c)
			EXPECT_LT(
				std::abs(
					from + factor * (place(Corner(c)) - place(a)) -
					asComplex(map.mesh.at(Corner(c)))),
				1e-9 * std::abs(to - from));
	}
}

/// With the surface's own curvature as target the flow stands still: the map is the development of
/// the surface, straight and isometric on every face of the input.
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
	int crossings = 0;
	for (int round = 0; round < 15; ++round)
		for (const SurfaceMesh& original : meshes) {
			SCOPED_TRACE("round " + std::to_string(round));
			const SurfaceMesh mesh = shaken(original, 0.2, random);
			const Problem p = withCurvature("own", mesh, curvatureInSpace(mesh));
			const Parametrization map = p.solve();
			expectValid(p, map);
			crossings += map.report.refinementPoints;
			const std::vector<Point3> source = map.mesh.onSurface(mesh.positions);
			std::vector<std::vector<Corner>> cornersIn(mesh.triangles.size());
			for (const int piece : map.mesh.points.indices())
				for (const Corner c : cornersOf(piece))
					cornersIn[at(map.mesh.face[piece])].push_back(c);
			for (const std::vector<Corner>& corners : cornersIn)
				for (const Corner c : corners)
					for (const Corner d : corners)
						EXPECT_NEAR(
							distance(map.mesh.at(c), map.mesh.at(d)),
							distance(
								source[at(map.mesh.vertices[c])], source[at(map.mesh.vertices[d])]),
							1e-8);
		}
	EXPECT_GT(crossings, 100);
}

} // namespace
} // namespace ricci::testing
