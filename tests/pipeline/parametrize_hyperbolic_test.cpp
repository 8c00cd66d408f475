// SPDX-License-Identifier: GPL-3.0-or-later
// The whole way from a mesh to the Poincaré disk.
#include "../support/complex.h"
#include "../support/expect.h"
#include "../support/flat_map.h"
#include "../support/flipped_flow.h"
#include "../support/listener.h"
#include "../support/random_surface.h"
#include "../support/shapes.h"
#include "../support/transform.h"

#include <ricci/base/numbers.h>
#include <ricci/error.h>
#include <ricci/fuchsian/tiling.h>
#include <ricci/layout/hyperbolic_layout.h>
#include <ricci/parametrize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <string>
#include <vector>

namespace ricci::testing {
namespace {

FlatResult
run(const SurfaceMesh& mesh, const HyperbolicOptions& options = {}, const VertexInput& input = {})
{
	return runInDisk(mesh, options, input);
}

HyperbolicOptions refined()
{
	HyperbolicOptions options;
	options.output = OutputTriangulation::CommonRefinement;
	return options;
}

/// The error with which run() ends.
template<class E>
E refusal(const SurfaceMesh& mesh, const HyperbolicOptions& options, const VertexInput& input = {})
{
	return refusalOf<E>([&] { run(mesh, options, input); });
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

std::vector<double> sideTraces(const Parametrization& map, std::size_t chart = 0)
{
	std::vector<double> traces, spectrum;
	for (const DiskIsometry& m : tiling(map.charts[chart].group.sides, 4, 20000).deck)
		if (m.distanceFromIdentity() > 1e-3)
			traces.push_back(std::abs(m.trace()));
	std::sort(traces.begin(), traces.end());
	for (double x : traces)
		if (spectrum.size() < 6 && (spectrum.empty() || x > spectrum.back() * (1 + 1e-7)))
			spectrum.push_back(x);
	return spectrum;
}

TEST(ParametrizeHyperbolic, ClosedSurfacesLieInTheDisk)
{
	Random random(701);
	for (int genus : {2, 3}) {
		const SurfaceMesh mesh = shaken(perforatedSlab(genus, 3), 0.06, random);
		const FlatResult map = run(mesh, refined());
		const Report& report = map.report;
		EXPECT_TRUE(report.converged);
		EXPECT_LE(report.maxCurvatureError, std::max(1e-8, report.residualFloor));
		EXPECT_EQ(report.genus, genus);
		EXPECT_EQ(report.charts, 1);
		EXPECT_EQ(report.flippedFaces, 0);
		EXPECT_EQ(report.brokenTriangles, 0);
		ASSERT_TRUE(report.hyperbolicArea && report.relationError);
		EXPECT_NEAR(*report.hyperbolicArea / (4 * kPi * (genus - 1)), 1.0, 1e-8);
		EXPECT_LT(*report.relationError, 1e-8);
		EXPECT_GT(report.seamEdges, 0);
		ASSERT_EQ(map.charts.size(), 1u);
		for (const UV& uv : {map.uv, map.mesh.corners().values()})
			for (const auto& corners : uv)
				for (const Point2& p : corners)
					EXPECT_LT(std::abs(asComplex(p)), 1.0);
		// Near the middle, where its own area is nearly that of the disk's picture.
		double least = 1.0;
		for (const auto& corners : map.uv)
			least = std::min(least, std::abs(asComplex(corners[0])));
		EXPECT_LT(least, 0.1);
		for (double u : map.u)
			EXPECT_LT(u, 0.0);
	}
}

/// A seam's two sides are as long as each other, on the mesh and on the refinement; the latter's
/// pieces fill every face.
TEST(ParametrizeHyperbolic, KeptFacesAndTheRefinementAgreeAtTheVertices)
{
	const SurfaceMesh mesh = genusTwo();
	const FlatResult kept = run(mesh), exact = run(mesh, refined());
	// One figure but for a motion of the disk: seen from one corner in the direction of the next.
	const auto seen = [](const FlatResult& map, const Point2& p) {
		const auto moved = [&](const Point2& q) {
			const auto from = asComplex(map.uv[0][0]);
			return (asComplex(q) - from) / (1.0 - std::conj(from) * asComplex(q));
		};
		const auto towards = moved(map.uv[0][1]);
		return moved(p) * std::abs(towards) / towards;
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
		EXPECT_EQ(
			hyperbolicOrientation(
				asComplex(exact.mesh.at(f)[0]),
				asComplex(exact.mesh.at(f)[1]),
				asComplex(exact.mesh.at(f)[2])),
			1);
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

TEST(ParametrizeHyperbolic, SurfacesWithBoundary)
{
	Random random(702);
	const SurfaceMesh meshes[] = {
		withoutStars(shaken(perforatedSlab(1, 4), 0.03, random), {0}),
		withoutStars(shaken(perforatedSlab(0, 5), 0.03, random), {0, 60, 120})};
	for (const SurfaceMesh& mesh : meshes) {
		const FlatResult map = run(mesh, refined());
		EXPECT_EQ(map.report.eulerCharacteristic, -1);
		EXPECT_NEAR(*map.report.hyperbolicArea / (2 * kPi), 1.0, 1e-8);
		EXPECT_LT(*map.report.relationError, 1e-8); // lengths of the boundaries included
		EXPECT_EQ(map.report.flippedFaces, 0);
		EXPECT_EQ(map.charts[0].group.peripheral.size(), at(map.report.boundaryLoops));
		HyperbolicOptions options = refined();
		options.freeBoundary = true;
		const FlatResult free = run(mesh, options);
		EXPECT_EQ(free.report.flippedFaces, 0);
		EXPECT_LE(free.report.maxCurvatureError, 1e-8);
	}
}

/// The disk and the annulus have hyperbolic metrics as soon as their boundary is free. That of a
/// round disk of area 2 pi is the disk of radius asinh(sqrt(2)); a cylinder of period 2 pi and height
/// w has a closed geodesic of length 2 pi k, sqrt(w) k = cos(k w / 2): see hyperbolic_flow_test.cpp.
TEST(ParametrizeHyperbolic, DiskAndAnnulusWithFreeBoundary)
{
	HyperbolicOptions options = refined();
	options.freeBoundary = true;
	std::vector<std::array<double, 2>> round, straight;
	const int n = 48;
	const double height = 1.7, error = 2 * std::pow(2 * kPi / n, 2); // second order
	for (int i = 0; i <= n / 4; ++i)
		round.push_back({4.0 * i / n, 0.0});
	for (int i = 0; i <= n / 3; ++i)
		straight.push_back({1.0, 3.0 * i / n * height});
	for (const OutputTriangulation output :
		 {OutputTriangulation::KeepMesh, OutputTriangulation::CommonRefinement}) {
		options.output = output;
		const FlatResult disk = run(revolved(round, n), options);
		EXPECT_EQ(disk.report.flippedFaces, 0);
		EXPECT_EQ(disk.report.relationError, 0.0);
		EXPECT_TRUE(disk.charts[0].group.sides.empty());
		EXPECT_NEAR(*disk.report.hyperbolicArea, 2 * kPi * (std::sqrt(3.0) - 1.0), error);
		EXPECT_NEAR(radius(disk), std::asinh(std::sqrt(2.0)), error);
		const FlatResult annulus = run(revolved(straight, n), options);
		EXPECT_EQ(annulus.report.flippedFaces, 0);
		EXPECT_LT(*annulus.report.relationError, 1e-9);
		double k = 1.0;
		for (int i = 0; i < 200; ++i)
			k = std::cos(0.5 * k * height) / std::sqrt(height);
		ASSERT_EQ(annulus.charts[0].group.peripheral.size(), 2u);
		for (const DiskIsometry& m : annulus.charts[0].group.peripheral)
			EXPECT_NEAR(2.0 * std::acosh(0.5 * std::abs(m.trace())), 2 * kPi * k, error);
	}
}

TEST(ParametrizeHyperbolic, WhatLiesOnItselfIsCounted)
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
	const Parametrization twice = parametrizeHyperbolic(strip(48), {}, options);
	EXPECT_GT(twice.report.overlappingFaces, 0);
	EXPECT_EQ(twice.report.overlappingCharts, 1);
	EXPECT_EQ(twice.report.flippedFaces, 0);
}

TEST(ParametrizeHyperbolic, ConesAtSelectedVertices)
{
	Random random(703);
	const SurfaceMesh sphere = shaken(perforatedSlab(0, 3), 0.05, random);
	HyperbolicOptions options = refined();
	options.target = HyperbolicTarget::SelectedCones;
	options.coneAngle = kPi / 2;
	const FlatResult map = run(sphere, options, selecting(sphere, {3, 20, 40}));
	EXPECT_NEAR(*map.report.hyperbolicArea / (0.5 * kPi), 1.0, 1e-8);
	EXPECT_LT(*map.report.relationError, 1e-8);
	EXPECT_EQ(map.report.flippedFaces, 0);
	EXPECT_EQ(map.charts[0].group.peripheral.size(), 3u);
	// The same from vertex quality.
	VertexInput input;
	input.targetCurvature.assign(sphere.positions.size(), 0.0);
	for (std::size_t v : {3u, 20u, 40u})
		input.targetCurvature[v] = 1.5 * kPi;
	options.target = HyperbolicTarget::Prescribed;
	const FlatResult same = run(sphere, options, input);
	for (std::size_t v = 0; v < map.u.size(); ++v)
		EXPECT_NEAR(same.u[v], map.u[v], 1e-10);
}

TEST(ParametrizeHyperbolic, ASurfaceOfHardlyAnyArea)
{
	// The area is what the curvatures add up to on a torus: far below the rounding of the angles of
	// one triangle. The disk then is a picture of the flat metric with the same cones.
	Random random(706);
	const SurfaceMesh mesh = bumpyTorus(8, 6, random);
	HyperbolicOptions options = refined();
	options.target = HyperbolicTarget::Prescribed;
	VertexInput input;
	input.targetCurvature.assign(mesh.positions.size(), 0.0);
	input.targetCurvature[5] = 1.0 + 0x1p-51;
	input.targetCurvature[30] = -1.0;
	const FlatResult map = run(mesh, options, input);
	EXPECT_EQ(map.report.flippedFaces, 0);
	EXPECT_GT(radius(map), 0.0);
	EXPECT_LT(radius(map), 2e-6); // half of it in the disk's own lengths
}

TEST(ParametrizeHyperbolic, ResultDoesNotDependOnTheScale)
{
	const SurfaceMesh mesh = genusTwo();
	const FlatResult reference = run(mesh);
	for (double factor : {0.25, 1024.0}) { // exact in binary: every step is the same
		const FlatResult same = run(scaled(mesh, factor));
		EXPECT_EQ(same.uv, reference.uv);
		EXPECT_EQ(same.u, reference.u);
	}
	for (double factor : {1e-8, 3.0, 1e8}) {
		const FlatResult same = run(scaled(mesh, factor));
		double gap = 0.0;
		for (std::size_t f = 0; f < same.uv.size(); ++f)
			for (std::size_t k = 0; k < 3; ++k)
				gap = std::max(
					gap, std::abs(asComplex(same.uv[f][k]) - asComplex(reference.uv[f][k])));
		EXPECT_LT(gap, 1e-7);
		EXPECT_NEAR(same.report.qcMean, reference.report.qcMean, 1e-8);
	}
}

TEST(ParametrizeHyperbolic, ResultDoesNotDependOnTheNumbersOfVerticesAndFaces)
{
	Random random(704);
	const SurfaceMesh mesh = genusTwo(705, 2);
	HyperbolicOptions options;
	options.epsilon = 1e-12;
	const FlatResult reference = run(mesh, options);
	const std::vector<double> wanted = sideTraces(reference);
	ASSERT_EQ(wanted.size(), 6u);
	for (int trial = 0; trial < 2; ++trial) {
		const Renumbered other = renumbered(mesh, random);
		const FlatResult map = run(other.mesh, options);
		EXPECT_NEAR(*map.report.hyperbolicArea, *reference.report.hyperbolicArea, 1e-9);
		EXPECT_EQ(map.report.genus, 2);
		for (std::size_t v = 0; v < other.vertex.size(); ++v)
			EXPECT_NEAR(map.u[v], reference.u[at(other.vertex[v])], 1e-9);
		const std::vector<double> traces = sideTraces(map);
		ASSERT_EQ(traces.size(), wanted.size());
		for (std::size_t i = 0; i < traces.size(); ++i)
			EXPECT_NEAR(traces[i] / wanted[i], 1.0, 1e-8);
		EXPECT_NEAR(map.report.qcMean, reference.report.qcMean, 1e-8);
		for (std::size_t v = 0; v < other.vertex.size(); ++v)
			EXPECT_NEAR(map.vertexQC[v], reference.vertexQC[at(other.vertex[v])], 1e-7);
	}
}

TEST(ParametrizeHyperbolic, TheSameRunGivesTheSameBits)
{
	const SurfaceMesh mesh = genusTwo();
	const FlatResult a = run(mesh, refined()), b = run(mesh, refined());
	EXPECT_EQ(a.uv, b.uv);
	EXPECT_EQ(a.u, b.u);
	EXPECT_EQ(a.mesh.corners(), b.mesh.corners());
}

TEST(ParametrizeHyperbolic, SeveralComponentsAreSolvedOneByOne)
{
	Random random(706);
	const SurfaceMesh a = genusTwo(707, 2), b = shaken(perforatedSlab(3, 1), 0.05, random);
	const FlatResult pair = run(sideBySide(a, b, 20.0), refined());
	const FlatResult first = run(a, refined()), second = run(b, refined());
	EXPECT_EQ(pair.report.components, 2);
	ASSERT_EQ(pair.charts.size(), 2u);
	EXPECT_EQ(pair.report.eulerCharacteristic, -6);
	EXPECT_EQ(pair.report.genus, 5);
	EXPECT_NEAR(*pair.report.hyperbolicArea / (12 * kPi), 1.0, 1e-8);
	EXPECT_EQ(pair.report.iterations, first.report.iterations + second.report.iterations);
	EXPECT_LT(*pair.report.relationError, 1e-8);
	for (std::size_t f = 0; f < a.triangles.size(); ++f)
		EXPECT_EQ(pair.uv[f], first.uv[f]);
	const SurfaceMesh donut = torus(2, 1, 8, 6); // has no hyperbolic metric
	const auto error = refusal<InadmissibleCurvature>(sideBySide(a, donut, 20.0), {});
	EXPECT_EQ(error.componentFace, static_cast<int>(a.triangles.size()));
	EXPECT_EQ(error.componentFaces, donut.triangles.size());
	EXPECT_EQ(error.problem, InadmissibleCurvature::HyperbolicSurface);
	EXPECT_TRUE(error.surface.isTorus());
}

TEST(ParametrizeHyperbolic, FacesOfTheOtherOrientationAreMappedLikeTheRest)
{
	const SurfaceMesh mesh = genusTwo(708, 2);
	const SurfaceMesh mixed = withReversedFaces(mesh, 5);
	const FlatResult straight = run(mesh, refined()), map = run(mixed, refined());
	EXPECT_EQ(map.report.flippedFaces, 0);
	EXPECT_NEAR(map.report.qcMean, straight.report.qcMean, 1e-9);
	for (std::size_t f = 0; f < mixed.triangles.size(); ++f) {
		for (std::size_t k = 0; k < 3; ++k) {
			const std::size_t j = f % 5 == 0 ? (3 - k) % 3 : k;
			EXPECT_LT(std::abs(asComplex(map.uv[f][j]) - asComplex(straight.uv[f][k])), 1e-9);
		}
	}
	ASSERT_FALSE(map.notes.empty());
	expectWords(map.notes[0], {"oriented against"});
	// Reversed throughout it is a surface of the other orientation: the mirror image.
	const FlatResult image = run(withReversedFaces(mesh, 1), refined());
	EXPECT_EQ(image.report.flippedFaces, 0);
	for (std::size_t v = 0; v < image.u.size(); ++v)
		EXPECT_NEAR(image.u[v], straight.u[v], 1e-9);
}

TEST(ParametrizeHyperbolic, RefusesASurfaceWithoutHyperbolicMetric)
{
	const auto torusRefused = refusal<InadmissibleCurvature>(torus(2, 1, 12, 8), {});
	EXPECT_EQ(torusRefused.problem, InadmissibleCurvature::HyperbolicSurface);
	EXPECT_TRUE(torusRefused.surface.isTorus());
	expectWords(torusRefused.what(), {"closed surface of genus 1", "Euler characteristic 0"});
	const auto diskRefused = refusal<InadmissibleCurvature>(rectangle(4, 4, 1, 1), {});
	EXPECT_EQ(diskRefused.problem, InadmissibleCurvature::HyperbolicSurface);
	EXPECT_TRUE(diskRefused.surface.isDisk());
	expectWords(diskRefused.what(), {"disk", "Euler characteristic 1"});
	// With a cone the torus has one.
	const SurfaceMesh mesh = torus(2, 1, 12, 8);
	HyperbolicOptions options = refined();
	options.target = HyperbolicTarget::SelectedCones;
	options.coneAngle = kPi;
	const FlatResult map = run(mesh, options, selecting(mesh, {5}));
	EXPECT_NEAR(*map.report.hyperbolicArea / kPi, 1.0, 1e-8);
	EXPECT_EQ(map.report.flippedFaces, 0);
	const auto without = refusal<InvalidOption>(mesh, options, selecting(mesh, {}));
	EXPECT_EQ(without.problem, InvalidOption::NothingSelected);
	expectWords(without.what(), {"none is selected"});
}

/// A cone of nearly no angle is nearly a cusp: sides of its triangles are about 20 long, and all digits
/// of cosh and sinh are the same there.
TEST(ParametrizeHyperbolic, ConesThatAreNearlyCusps)
{
	HyperbolicOptions options;
	options.target = HyperbolicTarget::SelectedCones;
	options.coneAngle = 1e-8;
	for (const SurfaceMesh& mesh : {perforatedSlab(2, 1), torus(2, 1, 8, 8)})
		EXPECT_EQ(run(mesh, options, selecting(mesh, {0})).report.flippedFaces, 0);
	// The circumference at the distance r from a tip is the angle times sinh r: of a thousandth of
	// the angle the tip lies ln 1000 farther away.
	Random random(9);
	const SurfaceMesh mesh = bumpyTorus(12, 9, random);
	const VertexInput input = selecting(mesh, {5, 20, 33, 40});
	const double far = radius(run(mesh, options, input));
	options.coneAngle = 1e-5;
	EXPECT_NEAR(far - radius(run(mesh, options, input)), std::log(1e3), 1e-3);
}

/// The smaller its angle, the farther away a cone lies, and the more there are, the more of them lie
/// behind others; the doubles of the disk reach to 37.
TEST(ParametrizeHyperbolic, TellsWhenTheDiskIsTooSmallForTheLayout)
{
	Random random(9);
	const SurfaceMesh mesh = bumpyTorus(12, 9, random);
	const VertexInput input = selecting(mesh, {5, 20, 33, 40});
	HyperbolicOptions options;
	options.target = HyperbolicTarget::SelectedCones;
	options.coneAngle = 1e-5;
	EXPECT_LT(*run(mesh, options, input).report.relationError, 1e-8);
	options.coneAngle = 1e-12;
	EXPECT_EQ(run(mesh, options, input).report.flippedFaces, 0);
	std::vector<int> many;
	for (int v = 5; v < static_cast<int>(mesh.positions.size()); v += 3)
		many.push_back(v);
	const auto error = refusal<NotConverged>(mesh, options, selecting(mesh, many));
	EXPECT_EQ(error.problem, NotConverged::OutsideDisk);
	EXPECT_GT(error.count, 0u);
	expectWords(
		error.what(),
		{std::to_string(error.count), "so far from the middle of the layout", "Poincaré disk"});
}

TEST(ParametrizeHyperbolic, RefusesOptionsOutOfRange)
{
	const SurfaceMesh mesh = genusTwo(709, 1);
	for (double epsilon : {0.0, -1e-9, std::numeric_limits<double>::quiet_NaN()}) {
		HyperbolicOptions options;
		options.epsilon = epsilon;
		const auto error = refusal<InvalidOption>(mesh, options);
		EXPECT_EQ(error.problem, InvalidOption::Epsilon);
		EXPECT_TRUE(error.value == epsilon || (std::isnan(error.value) && std::isnan(epsilon)));
		expectWords(error.what(), {"must be greater than 0 radians"});
	}
	HyperbolicOptions options;
	for (const Method method : {Method::EdgeSwaps, Method::Thurston}) {
		options.method = method;
		const auto error = refusal<InvalidOption>(mesh, options);
		EXPECT_EQ(error.problem, InvalidOption::HyperbolicMethod);
		expectWords(error.what(), {"no edge swaps and no Thurston packing"});
	}
	options = refined();
	options.method = Method::FixedTriangles;
	const auto withoutFlips = refusal<InvalidOption>(mesh, options);
	EXPECT_EQ(withoutFlips.problem, InvalidOption::WithoutFlips);
	expectWords(withoutFlips.what(), {"common refinement", "intrinsic flips"});
}

TEST(ParametrizeHyperbolic, TheGivenTriangulationCanBeKept)
{
	const SurfaceMesh mesh = perforatedSlab(2, 3); // no triangle breaks
	HyperbolicOptions options;
	options.method = Method::FixedTriangles;
	const FlatResult map = run(mesh, options);
	EXPECT_EQ(map.report.flips, 0);
	EXPECT_EQ(map.report.flippedFaces, 0);
	EXPECT_NEAR(*map.report.hyperbolicArea / (4 * kPi), 1.0, 1e-8);
	EXPECT_LT(*map.report.relationError, 1e-8);
	// Geodesic triangles of the disk, glued without gaps: curvature and area of the picture.
	std::vector<double> defect(mesh.positions.size(), 2 * kPi);
	double area = 0.0;
	for (std::size_t f = 0; f < map.uv.size(); ++f) {
		area += kPi;
		for (std::size_t k = 0; k < 3; ++k) {
			const Complex p = asComplex(map.uv[f][k]);
			const auto seen = [&](const Point2& q) {
				return (asComplex(q) - p) / (1.0 - std::conj(p) * asComplex(q));
			};
			const double angle =
				std::abs(std::arg(seen(map.uv[f][(k + 2) % 3]) / seen(map.uv[f][(k + 1) % 3])));
			defect[at(mesh.triangles[f][k])] -= angle;
			area -= angle;
		}
	}
	for (double K : defect)
		EXPECT_NEAR(K, 0.0, 1e-8);
	EXPECT_NEAR(area / (4 * kPi), 1.0, 1e-8);
}

/// Everything else is the same with canonical generators and without, one set for each component.
TEST(ParametrizeHyperbolic, CanonicalGeneratorsAreFoundOnRequest)
{
	Random random(712);
	const SurfaceMesh mesh =
		sideBySide(genusTwo(713, 2), shaken(perforatedSlab(3, 1), 0.05, random), 20.0);
	HyperbolicOptions options;
	const FlatResult without = run(mesh, options);
	options.canonicalGenerators = true;
	const FlatResult with = run(mesh, options);
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

/// A slab of many handles is so long that canonical generators leave floating point.
TEST(ParametrizeHyperbolic, SaysWhyThereAreNoCanonicalGenerators)
{
	HyperbolicOptions options;
	options.canonicalGenerators = true;
	Listener patient;
	const Parametrization map =
		heard(patient, [&] { return parametrizeHyperbolic(perforatedSlab(12, 2), {}, options); });
	EXPECT_FALSE(map.charts[0].group.isCanonical());
	EXPECT_EQ(patient.count("no canonical generators"), 1);
}

TEST(ParametrizeHyperbolic, DistortionIsThatOfTheChords)
{
	// A fine mesh of equilateral-like triangles is mapped nearly conformally; the disk's own picture
	// would add the distortion of straight lines to curves, which does not vanish there.
	Random random(711);
	const SurfaceMesh coarse = perforatedSlab(2, 2), fine = perforatedSlab(2, 8);
	const double first = run(coarse, refined()).report.qcAreaMean;
	const double second = run(fine, refined()).report.qcAreaMean;
	EXPECT_GT(first, 1.0);
	EXPECT_LT(second - 1.0, 0.5 * (first - 1.0));
}

/// With seams as short as can be these slabs reach farther out in the disk than floats do.
TEST(ParametrizeHyperbolic, AMapThatIsTooWideIsCutAroundItsMiddle)
{
	for (const int genus : {14, 16}) {
		Listener listener;
		const FlatResult map = heard(listener, [&] { return run(perforatedSlab(genus, 2)); });
		EXPECT_GT(listener.count("around the middle"), 0);
		EXPECT_LT(radius(map), 12.5);
		EXPECT_EQ(map.report.flippedFaces, 0);
		EXPECT_NEAR(map.report.hyperbolicArea.value_or(0), 4 * kPi * (genus - 1), 1e-9);
	}
}

} // namespace
} // namespace ricci::testing
