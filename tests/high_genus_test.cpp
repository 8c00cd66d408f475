// SPDX-License-Identifier: GPL-3.0-or-later
// The whole way to the Poincaré disk where the layout reaches far out: many handles, many holes; and
// cones so weak that the seam need not reach them.
#include "support/complex.h"
#include "support/flat_map.h"
#include "support/implicit_surface.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/math/disk_isometry.h>
#include <ricci/metric/area.h>
#include <ricci/parametrize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

FlatResult run(const SurfaceMesh& mesh, const VertexInput& input = {})
{
	HyperbolicOptions options;
	options.output = OutputTriangulation::CommonRefinement;
	options.target = input.targetCurvature.empty() ? HyperbolicTarget::HyperbolicMetric
												   : HyperbolicTarget::Prescribed;
	return runInDisk(mesh, options, input);
}

/// The skin round the edges of a graph with corners in space. Of genus edges - corners + 1.
SurfaceMesh skinOf(
	const std::vector<Point3>& corners,
	const std::vector<std::array<std::size_t, 2>>& edges,
	double radius,
	int cells)
{
	const auto distance = [&](const Point3& p) {
		double least = std::numeric_limits<double>::infinity();
		for (const auto& [i, j] : edges) {
			const Point3 &a = corners[i], &b = corners[j];
			double along = 0.0, length = 0.0, gap = 0.0;
			for (std::size_t k = 0; k < 3; ++k) {
				along += (p[k] - a[k]) * (b[k] - a[k]);
				length += (b[k] - a[k]) * (b[k] - a[k]);
			}
			const double t = std::clamp(along / length, 0.0, 1.0);
			for (std::size_t k = 0; k < 3; ++k)
				gap += std::pow(p[k] - a[k] - t * (b[k] - a[k]), 2);
			least = std::min(least, gap);
		}
		return std::sqrt(least) - radius;
	};
	const double size = 1.0 + 2.0 * radius;
	return marchingCubes(
		distance, {-size, -size, -size}, {size, size, size}, {cells, cells, cells});
}

/// Round the edges of a cube (genus 5), of an octahedron (7), or of a cube whose corners are joined to
/// its middle (12).
SurfaceMesh skeleton(int genus)
{
	std::vector<Point3> corners;
	std::vector<std::array<std::size_t, 2>> edges;
	if (genus == 7)
		for (std::size_t k = 0; k < 3; ++k)
			for (const double side : {-1.0, 1.0}) {
				corners.push_back({0.0, 0.0, 0.0});
				corners.back()[k] = side;
			}
	else
		for (const double x : {-1.0, 1.0})
			for (const double y : {-1.0, 1.0})
				for (const double z : {-1.0, 1.0})
					corners.push_back({x, y, z});
	for (std::size_t i = 0; i < corners.size(); ++i)
		for (std::size_t j = 0; j < i; ++j) {
			int other = 0; // coordinates that differ
			for (std::size_t k = 0; k < 3; ++k)
				other += corners[i][k] != corners[j][k];
			if (other == (genus == 7 ? 2 : 1))
				edges.push_back({i, j});
		}
	if (genus == 12) { // 8 edges and one corner more
		for (std::size_t i = 0; i < 8; ++i)
			edges.push_back({i, 8});
		corners.push_back({0.0, 0.0, 0.0});
	}
	return skinOf(corners, edges, 0.23, 26);
}

double radiusOf(const Parametrization& map)
{
	double largest = 0.0;
	for (const Triangle2& triangle : map.mesh.corners())
		for (const Point2& p : triangle)
			largest = std::max(largest, std::abs(asComplex(p)));
	return 2.0 * std::atanh(largest);
}

double length(const Point2& p, const Point2& q)
{
	return 2.0 * std::asinh(0.5 * chordLength(asComplex(p), asComplex(q)));
}

/// What any hyperbolic map of a closed surface is: its pieces tile a polygon of the area that
/// Gauss-Bonnet gives the surface, whose sides are paired by isometries of the group.
void expectHyperbolicMap(const Parametrization& map, int genus)
{
	const Report& report = map.report;
	EXPECT_EQ(report.genus, genus);
	EXPECT_EQ(report.boundaryLoops, 0);
	EXPECT_TRUE(report.converged);
	EXPECT_LE(report.maxCurvatureError, std::max(1e-8, report.residualFloor));
	EXPECT_EQ(report.flippedFaces, 0);
	EXPECT_EQ(report.brokenTriangles, 0);
	const double wanted = 4 * kPi * (genus - 1);
	EXPECT_NEAR(*report.hyperbolicArea / wanted, 1.0, 1e-9);

	// What the layout misses is the curvature that the flow has left, and the steps of doubles, which
	// are longer by e^d / 4 at the distance d from 0.
	const double left = static_cast<double>(map.u.size()) * report.maxCurvatureError;
	const double step = kEpsilon * std::exp(radiusOf(map)), slack = left + step;
	EXPECT_LT(slack, 1e-6);
	EXPECT_LT(*report.relationError, 4 * genus * slack); // of a product of so many
	double area = 0.0;
	std::map<std::pair<int, int>, std::vector<std::pair<Point2, Point2>>> sides;
	for (const int f : map.mesh.points.indices()) {
		const Triangle2 p = map.mesh.at(f);
		area += hyperbolicArea(
			std::array<double, 3>{length(p[0], p[1]), length(p[1], p[2]), length(p[2], p[0])});
		for (std::size_t k = 0; k < 3; ++k) {
			const int i = map.mesh.vertices[f][k], j = map.mesh.vertices[f][(k + 1) % 3];
			const Point2 &from = p[k], &to = p[(k + 1) % 3];
			sides[std::minmax(i, j)].push_back(i < j ? std::pair(from, to) : std::pair(to, from));
		}
	}
	EXPECT_NEAR(area / wanted, 1.0, slack);
	int seams = 0;
	for (const auto& [edge, drawn] : sides) {
		ASSERT_EQ(drawn.size(), 2u);
		if (drawn[0] == drawn[1])
			continue;
		++seams;
		EXPECT_NEAR(
			length(drawn[0].first, drawn[0].second),
			length(drawn[1].first, drawn[1].second),
			16 * slack);
		double least = std::numeric_limits<double>::infinity();
		for (const DiskIsometry& m : map.charts[0].group.sides) {
			const auto gap = [&](const Point2& p, const Point2& q) {
				return chordLength(m(asComplex(p)), asComplex(q));
			};
			least = std::min(
				least, gap(drawn[0].first, drawn[1].first) + gap(drawn[0].second, drawn[1].second));
		}
		// Its matrix multiplies steps by as much again.
		EXPECT_LT(least, 1e-9 + 16 * slack * std::exp(radiusOf(map)));
	}
	EXPECT_GE(seams, report.seamEdges);
	EXPECT_GT(report.seamEdges, 4 * genus);
}

TEST(HighGenus, SlabsWithManyHandles)
{
	Random random(910);
	for (const int genus : {5, 6, 9, 14, 20}) {
		SCOPED_TRACE("genus " + std::to_string(genus));
		expectHyperbolicMap(run(shaken(perforatedSlab(genus, 2), 0.06, random)), genus);
	}
}

TEST(HighGenus, SkeletonsOfSolids)
{
	for (const int genus : {5, 7, 12}) {
		SCOPED_TRACE("genus " + std::to_string(genus));
		expectHyperbolicMap(run(skeleton(genus)), genus);
	}
}

/// As many relations as there are holes, each seen from its own place.
TEST(HighGenus, ManyHoles)
{
	Random random(911);
	const SurfaceMesh whole = shaken(perforatedSlab(3, 4), 0.03, random);
	for (const std::size_t count : {10u, 40u}) {
		std::vector<int> stars;
		for (std::size_t i = 0; i < count; ++i)
			stars.push_back(static_cast<int>(i * (whole.positions.size() / count)));
		const FlatResult map = run(withoutStars(whole, stars));
		const int holes = map.report.boundaryLoops;
		EXPECT_GE(holes, static_cast<int>(count) * 3 / 4);
		EXPECT_EQ(map.report.flippedFaces, 0);
		EXPECT_NEAR(*map.report.hyperbolicArea / (2 * kPi * (4 + holes)), 1.0, 1e-9);
		EXPECT_LT(*map.report.relationError, 1e-10 + 16 * kEpsilon * std::exp(radiusOf(map)));
		EXPECT_EQ(map.charts[0].group.peripheral.size(), static_cast<std::size_t>(holes));
	}
}

/// The seam need not reach a cone of less than 1e-9. Its curvature then remains on the way round
/// another vertex, and that is what the relation error says, at any genus.
TEST(HighGenus, WeakConesAreLeftInTheRelation)
{
	Random random(912);
	for (const int genus : {2, 3, 10}) {
		SCOPED_TRACE("genus " + std::to_string(genus));
		const SurfaceMesh mesh = shaken(perforatedSlab(genus, 3), 0.06, random);
		VertexInput input;
		input.targetCurvature.assign(mesh.positions.size(), 0.0);
		for (const double K : {1e-11, 1e-10, 9e-10}) {
			input.targetCurvature[40] = K;
			const FlatResult map = run(mesh, input);
			EXPECT_EQ(map.report.cones, 0);
			EXPECT_EQ(map.report.flippedFaces, 0);
			EXPECT_GE(*map.report.relationError, K / (4 * genus - 2) - 1e-12);
			EXPECT_LE(*map.report.relationError, 10 * K + 1e-12);
		}
		input.targetCurvature[40] = 1.1e-9;
		const FlatResult map = run(mesh, input);
		EXPECT_EQ(map.report.cones, 1);
		EXPECT_LT(*map.report.relationError, 1e-11);
	}
}

} // namespace
} // namespace ricci::testing
