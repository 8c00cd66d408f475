// SPDX-License-Identifier: GPL-3.0-or-later
// Hyperbolic results on the common refinement, where they are exact.
#include "hyperbolic_check.h"
#include "support/flat_map.h"
#include "support/implicit_surface.h"
#include "support/random_surface.h"

#include <ricci/parametrize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace ricci::testing {
namespace {

struct Problem
{
	std::string name;
	SurfaceMesh mesh;
	std::vector<std::pair<int, double>> cones; ///< vertices and their curvature
	bool freeBoundary = false;
};

std::vector<Problem> problems()
{
	Random random(600);
	const SurfaceMesh sphere = shaken(perforatedSlab(0, 3), 0.05, random);
	const SurfaceMesh donut = bumpyTorus(12, 9, random);
	const SurfaceMesh holes =
		withoutStars(shaken(perforatedSlab(0, 5), 0.04, random), {0, 60, 120});
	return {
		{"genus 2", shaken(perforatedSlab(2, 3), 0.06, random), {}},
		{"genus 2, slivers", implicitClosed(2, 4, 3), {}},
		{"genus 3", shaken(perforatedSlab(3, 2), 0.06, random), {}},
		{"one hole", withoutStars(shaken(perforatedSlab(1, 4), 0.04, random), {0}), {}},
		{"three holes", holes, {}},
		{"free boundary", holes, {}, true},
		{"sphere with cones", sphere, {{3, 5.0}, {20, 5.0}, {40, 4.0}, {11, -1.0}}},
		{"torus with cones", donut, {{5, 4.0}, {60, -2.0}}}};
}

Parametrization solve(const Problem& p, OutputTriangulation output)
{
	HyperbolicOptions options;
	options.epsilon = 1e-12;
	options.output = output;
	options.finish = Finish::None;
	options.freeBoundary = p.freeBoundary;
	options.target = HyperbolicTarget::Prescribed;
	VertexInput input;
	input.targetCurvature.assign(p.mesh.positions.size(), 0.0);
	for (const auto& [v, curvature] : p.cones)
		input.targetCurvature[at(v)] = curvature;
	return parametrizeHyperbolic(p.mesh, input, options);
}

/// The map of the only component, in the unit disk.
FlatMesh inDisk(const Parametrization& map)
{
	FlatMesh mesh = map.mesh;
	const Box2& box = map.charts.at(0).box;
	for (Point2& p : mesh.place)
		p = (2.0 / box.width()) * (p + Point2{-box.centre()[0], -box.centre()[1]});
	return mesh;
}

/// The triangles tile a surface whose only curvature is prescribed; its area is that of Gauss and Bonnet, and the
/// sides of every seam differ by one of the side pairings that are reported.
TEST(HyperbolicRefinement, IsAMetricOfCurvatureMinusOneOnTheInput)
{
	int crossings = 0;
	for (const Problem& p : problems()) {
		SCOPED_TRACE(p.name);
		const Parametrization map = solve(p, OutputTriangulation::CommonRefinement);
		crossings += map.report.refinementPoints;
		const HyperbolicCheck check(inDisk(map));
		check.expectCurvature(map.targetCurvature);
		double sum = 0.0;
		for (const double k : map.targetCurvature)
			sum += k;
		const double area = sum - 2 * kPi * map.report.eulerCharacteristic;
		EXPECT_NEAR(static_cast<double>(check.area) / area, 1.0, 1e-9);
		EXPECT_NEAR(map.report.hyperbolicArea.value_or(0.0) / area, 1.0, 1e-9);
		EXPECT_LT(map.report.relationError.value_or(1.0), 1e-10);
		EXPECT_GE(static_cast<int>(check.seams.size()), map.report.seamEdges);
		EXPECT_GT(map.report.seamEdges, 0);
		for (const auto& [here, there] : check.seams) {
			double nearest = 1.0;
			for (const DiskIsometry& side : map.charts[0].group.sides)
				nearest = std::min(
					nearest,
					std::max(
						std::abs(side(there[0]) - here[0]), std::abs(side(there[1]) - here[1])));
			EXPECT_LT(nearest, 1e-9);
		}

		// The layout of the corners alone is the same figure.
		const Parametrization kept = solve(p, OutputTriangulation::KeepMesh);
		const FlatMesh a = inDisk(kept), b = inDisk(map);
		std::vector<std::pair<Complex, Complex>> places;
		for (const int piece : b.points.indices())
			for (const Corner c : cornersOf(piece))
				for (const Corner own : cornersOf(b.face[piece]))
					if (a.vertices[own] == b.vertices[c])
						places.push_back({asComplex(a.at(own)), asComplex(b.at(c))});
		ASSERT_GE(places.size(), 3 * p.mesh.triangles.size());
		for (const auto& [z, w] : places) {
			const auto fromFirst = [&](Complex x, Complex first) {
				return static_cast<double>(distanceInDisk(x, first));
			};
			const double rounding = 2e-14 / (1.0 - std::norm(z)) + 2e-14 / (1.0 - std::norm(w));
			EXPECT_NEAR(
				fromFirst(z, places[0].first), fromFirst(w, places[0].second), 1e-9 + 2 * rounding);
		}
	}
	EXPECT_GT(crossings, 200);
}

} // namespace
} // namespace ricci::testing
