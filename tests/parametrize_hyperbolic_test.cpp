// SPDX-License-Identifier: GPL-3.0-or-later
// Complete runs from a mesh to the Poincaré disk.
#include "support/complex.h"
#include "support/flat_map.h"
#include "support/implicit_surface.h"
#include "support/listener.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

HyperbolicOptions refinedInDisk()
{
	HyperbolicOptions options;
	options.output = OutputTriangulation::CommonRefinement;
	return options;
}

SurfaceMesh genusTwo(std::uint64_t seed = 700, int subdivision = 3)
{
	Random random(seed);
	return shaken(perforatedSlab(2, subdivision), 0.06, random);
}

/// The largest hyperbolic distance of a corner from 0.
double radius(const Parametrization& map)
{
	double largest = 0.0;
	for (const Triangle2& face : map.mesh.corners())
		for (const Point2& p : face)
			largest = std::max(largest, 2.0 * std::atanh(std::hypot(p[0], p[1])));
	return largest;
}

double length(const Point2& p, const Point2& q)
{
	return 2.0 * std::asinh(0.5 * chordLength(asComplex(p), asComplex(q)));
}

/// \p p seen from \p from, which is moved to the middle.
Complex seenFrom(const Point2& from, const Point2& p)
{
	return (asComplex(p) - asComplex(from)) / (1.0 - std::conj(asComplex(from)) * asComplex(p));
}

/// Angles of a geodesic triangle, negative where it is flipped.
std::array<double, 3> angles(const Triangle2& t)
{
	std::array<double, 3> angle;
	for (std::size_t k = 0; k < 3; ++k)
		angle[k] = std::arg(seenFrom(t[k], t[(k + 2) % 3]) / seenFrom(t[k], t[(k + 1) % 3]));
	return angle;
}

/// A seam's two sides are as long as each other, on the mesh and on the refinement; the latter's
/// pieces fill every face.
TEST(ParametrizeHyperbolic, KeptFacesAndTheRefinementAgreeAtTheVertices)
{
	const SurfaceMesh mesh = genusTwo();
	const FlatResult kept = runInDisk(mesh, {}), exact = runInDisk(mesh, refinedInDisk());
	// One figure except for a motion of the disk: seen from one corner in the direction of the next.
	const auto seen = [](const FlatResult& map, const Point2& p) {
		const Complex towards = seenFrom(map.uv[0][0], map.uv[0][1]);
		return seenFrom(map.uv[0][0], p) * std::abs(towards) / towards;
	};
	ASSERT_EQ(kept.uv.size(), exact.uv.size());
	for (std::size_t f = 0; f < kept.uv.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k)
			EXPECT_LT(std::abs(seen(kept, kept.uv[f][k]) - seen(exact, exact.uv[f][k])), 1e-10);
	EXPECT_EQ(kept.u, exact.u);
	EXPECT_GT(exact.report.refinementPoints, 0);
	EXPECT_EQ(kept.report.hyperbolicArea, exact.report.hyperbolicArea);
	EXPECT_EQ(
		at(exact.mesh.source.size()), mesh.positions.size() + at(exact.report.refinementPoints));
	// Corners of pieces at input vertices are corners of their input face.
	for (const int f : exact.mesh.points.indices()) {
		const std::size_t face = at(exact.mesh.face[f]);
		EXPECT_GT(angles(exact.mesh.at(f))[0], 0.0);
		for (std::size_t k = 0; k < 3; ++k)
			for (std::size_t j = 0; j < 3; ++j)
				if (exact.mesh.vertices[f][k] == mesh.triangles[face][j]) {
					EXPECT_LT(
						std::abs(asComplex(exact.mesh.at(f)[k]) - asComplex(exact.uv[face][j])),
						1e-12);
				}
	}
	EXPECT_GE(kept.report.qcMean, 1.0);
}

TEST(ParametrizeHyperbolic, WhatLiesOnItselfIsCountedAndDivided)
{
	// A strip that goes round an axis: in the disk its second turn meets the first.
	const auto strip = [](int steps) {
		return grid(3, steps, Ends::Open, Ends::Open, [](int i, int j) -> Point3 {
			const double r = 0.01 * (3 + i), a = 2 * kPi * j / 24;
			return {r * std::cos(a), r * std::sin(a), 0.001 * a};
		});
	};
	HyperbolicOptions options;
	options.freeBoundary = true;
	const Parametrization half = parametrizeHyperbolic(strip(12), {}, options);
	EXPECT_EQ(half.report.overlappingFaces, 0);
	EXPECT_EQ(half.report.overlappingCharts, 0);
	const Parametrization divided = parametrizeHyperbolic(strip(48), {}, options);
	EXPECT_EQ(divided.report.overlappingFaces, 0);
	EXPECT_EQ(divided.report.flippedFaces, 0);
	EXPECT_EQ(divided.report.unequalSeams, 0);
	EXPECT_GT(divided.report.charts, 1);
	options.finish = Finish::None;
	const Parametrization twice = parametrizeHyperbolic(strip(48), {}, options);
	EXPECT_GT(twice.report.overlappingFaces, 0);
	EXPECT_EQ(twice.report.overlappingCharts, 1);
	EXPECT_EQ(twice.report.flippedFaces, 0);
}

TEST(ParametrizeHyperbolic, ASurfaceOfHardlyAnyArea)
{
	// The area is what the curvatures add up to on a torus: far below the rounding of the angles of
	// one triangle. The disk then is a picture of the flat metric with the same cones.
	Random random(706);
	const SurfaceMesh mesh = bumpyTorus(8, 6, random);
	HyperbolicOptions options = refinedInDisk();
	options.finish = Finish::None; // floats cannot hold it
	options.target = HyperbolicTarget::Prescribed;
	VertexInput input;
	input.targetCurvature.assign(mesh.positions.size(), 0.0);
	input.targetCurvature[5] = 1.0 + 0x1p-51;
	input.targetCurvature[30] = -1.0;
	const FlatResult map = runInDisk(mesh, options, input);
	EXPECT_EQ(map.report.flippedFaces, 0);
	EXPECT_GT(radius(map), 0.0);
	EXPECT_LT(radius(map), 2e-6); // half of it in the disk's own lengths
}

/// A cone of nearly no angle is nearly a cusp: sides of its triangles are about 20 long, and all digits
/// of cosh and sinh are the same there.
TEST(ParametrizeHyperbolic, ConesThatAreNearlyCusps)
{
	HyperbolicOptions options;
	options.target = HyperbolicTarget::SelectedCones;
	options.coneAngle = 1e-8;
	for (const SurfaceMesh& mesh : {perforatedSlab(2, 1), torus(2, 1, 8, 8)})
		EXPECT_EQ(runInDisk(mesh, options, selecting(mesh, {0})).report.flippedFaces, 0);
	// The circumference at the distance r from a tip is the angle times sinh r: of a thousandth of
	// the angle the tip lies ln 1000 farther away.
	Random random(9);
	const SurfaceMesh mesh = bumpyTorus(12, 9, random);
	const VertexInput input = selecting(mesh, {5, 20, 33, 40});
	const double far = radius(runInDisk(mesh, options, input));
	options.coneAngle = 1e-5;
	const FlatResult map = runInDisk(mesh, options, input);
	EXPECT_NEAR(far - radius(map), std::log(1e3), 1e-3);
	EXPECT_LT(*map.report.relationError, 1e-8);
	options.coneAngle = 1e-12;
	EXPECT_EQ(runInDisk(mesh, options, input).report.flippedFaces, 0);
}

/// Everything else is the same with canonical generators and without, one set for each component.
TEST(ParametrizeHyperbolic, CanonicalGeneratorsAreFoundOnRequest)
{
	Random random(712);
	const SurfaceMesh mesh =
		sideBySide(genusTwo(713, 2), shaken(perforatedSlab(3, 1), 0.05, random), 20.0);
	HyperbolicOptions options;
	const FlatResult without = runInDisk(mesh, options);
	options.canonicalGenerators = true;
	const FlatResult with = runInDisk(mesh, options);
	EXPECT_EQ(with.uv, without.uv);
	EXPECT_EQ(with.report.relationError, without.report.relationError);
	ASSERT_EQ(with.charts.size(), 2u);
	for (std::size_t i = 0; i < 2; ++i) {
		EXPECT_FALSE(without.charts[i].group.isCanonical());
		EXPECT_TRUE(without.charts[i].group.handles.empty());
		EXPECT_TRUE(with.charts[i].group.isCanonical());
		EXPECT_EQ(with.charts[i].group.handles.size(), 4 + 2 * i);
		EXPECT_EQ(with.charts[i].group.sides.size(), without.charts[i].group.sides.size());
	}
}

/// The figures of the report are those of the coordinates that are given back, measured on the hyperboloid: flat
/// triangles with its chords for sides.
TEST(ParametrizeHyperbolic, TheReportMeasuresTheOutput)
{
	const SurfaceMesh mesh = genusTwo();
	for (const HyperbolicOptions& options : {HyperbolicOptions(), refinedInDisk()}) {
		const FlatResult map = runInDisk(mesh, options);
		UV chords;
		for (const Triangle2& t : map.mesh.corners()) {
			const double a = chordLength(asComplex(t[0]), asComplex(t[1]));
			const double b = chordLength(asComplex(t[0]), asComplex(t[2]));
			const double c = chordLength(asComplex(t[1]), asComplex(t[2]));
			const double x = (a * a + b * b - c * c) / (2 * a);
			chords.push_back({Point2{0, 0}, Point2{a, 0}, Point2{x, std::sqrt(b * b - x * x)}});
		}
		const Distortion found(inSpace(mesh, map), chords);
		EXPECT_NEAR(map.report.qcMean, found.qcMean, 1e-6);
		EXPECT_NEAR(map.report.qcAreaMean, found.qcAreaMean, 1e-6);
		EXPECT_NEAR(map.report.areaDistortionMean, found.areaMean, 1e-6);
		EXPECT_NEAR(map.report.areaDistortionSpread, found.areaSpread, 1e-6);
	}
}

/// With seams as short as can be these slabs reach farther out in the disk than floats do.
TEST(ParametrizeHyperbolic, AMapThatIsTooWideIsCutAroundItsMiddle)
{
	for (const int genus : {14, 16}) {
		Listener listener;
		const FlatResult map =
			withListener(listener, [&] { return runInDisk(perforatedSlab(genus, 2), {}); });
		EXPECT_GT(listener.count("around the centre"), 0);
		EXPECT_LT(radius(map), 12.5);
		EXPECT_EQ(map.report.flippedFaces, 0);
		EXPECT_NEAR(map.report.hyperbolicArea.value_or(0), 4 * kPi * (genus - 1), 1e-9);
	}
}

// Where the layout reaches far out: many handles, many holes; and cones so weak that the seam need not reach them.

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

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
			const Point3 way = p - corners[i], edge = corners[j] - corners[i];
			const double t = std::clamp(dot(way, edge) / dot(edge, edge), 0.0, 1.0);
			least = std::min(least, ricci::length(way - t * edge));
		}
		return least - radius;
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

/// The refinement's geodesic triangles, before floats have a part in it.
FlatResult asFound(const SurfaceMesh& mesh, const VertexInput& input = {})
{
	HyperbolicOptions options = refinedInDisk();
	options.finish = Finish::None;
	options.target = input.targetCurvature.empty() ? HyperbolicTarget::HyperbolicMetric
												   : HyperbolicTarget::Prescribed;
	return runInDisk(mesh, options, input);
}

/// Of a hyperbolic triangle, as Heron's formula is for a flat one.
double areaOfSides(double a, double b, double c)
{
	const double s = 0.5 * (a + b + c);
	return 4.0 * std::atan(std::sqrt(std::max(
					 0.0,
					 std::tanh(s / 2) * std::tanh((s - a) / 2) * std::tanh((s - b) / 2) *
						 std::tanh((s - c) / 2))));
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
	const double step = kEpsilon * std::exp(radius(map)), slack = left + step;
	EXPECT_LT(slack, 1e-6);
	EXPECT_LT(*report.relationError, 4 * genus * slack); // of a product of so many
	double area = 0.0;
	std::map<std::pair<int, int>, std::vector<std::pair<Point2, Point2>>> sides;
	for (const int f : map.mesh.points.indices()) {
		const Triangle2 p = map.mesh.at(f);
		area += areaOfSides(length(p[0], p[1]), length(p[1], p[2]), length(p[2], p[0]));
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
		EXPECT_LT(least, 1e-9 + 16 * slack * std::exp(radius(map)));
	}
	EXPECT_GE(seams, report.seamEdges);
	EXPECT_GT(report.seamEdges, 4 * genus);
}

TEST(HighGenus, SlabsWithManyHandles)
{
	Random random(910);
	for (const int genus : {5, 9, 20}) {
		SCOPED_TRACE("genus " + std::to_string(genus));
		expectHyperbolicMap(asFound(shaken(perforatedSlab(genus, 2), 0.06, random)), genus);
	}
}

TEST(HighGenus, SkeletonsOfSolids)
{
	for (const int genus : {7, 12}) {
		SCOPED_TRACE("genus " + std::to_string(genus));
		expectHyperbolicMap(asFound(skeleton(genus)), genus);
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
		const FlatResult map = asFound(withoutStars(whole, stars));
		const int holes = map.report.boundaryLoops;
		EXPECT_GE(holes, static_cast<int>(count) * 3 / 4);
		EXPECT_EQ(map.report.flippedFaces, 0);
		EXPECT_NEAR(*map.report.hyperbolicArea / (2 * kPi * (4 + holes)), 1.0, 1e-9);
		EXPECT_LT(*map.report.relationError, 1e-10 + 16 * kEpsilon * std::exp(radius(map)));
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
			const FlatResult map = asFound(mesh, input);
			EXPECT_EQ(map.report.cones, 0);
			EXPECT_EQ(map.report.flippedFaces, 0);
			EXPECT_GE(*map.report.relationError, K / (4 * genus - 2) - 1e-12);
			EXPECT_LE(*map.report.relationError, 10 * K + 1e-12);
		}
		input.targetCurvature[40] = 1.1e-9;
		const FlatResult map = asFound(mesh, input);
		EXPECT_EQ(map.report.cones, 1);
		EXPECT_LT(*map.report.relationError, 1e-11);
	}
}

} // namespace
} // namespace ricci::testing
