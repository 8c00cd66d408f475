// SPDX-License-Identifier: GPL-3.0-or-later
// The flow to a metric of curvature -1 with prescribed cones, seen in the disk.
#include "support/front_door.h"
#include "support/implicit_surface.h"
#include "support/random_surface.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace ricci::testing {
namespace {

HyperbolicOptions options(HyperbolicTarget target, bool isFree = false)
{
	HyperbolicOptions options;
	options.target = target;
	options.freeBoundary = isFree;
	return options;
}

/// The map has the curvature asked for: by the flow's word, as it is drawn, and by
/// Gauss-Bonnet, which knows the area; inside alone if the boundary is free.
void expectReachedInDisk(const SurfaceMesh& mesh, const FlatResult& map, bool isFree = false)
{
	const Report& report = map.report;
	EXPECT_TRUE(report.converged);
	EXPECT_LE(report.residualFloor, 1e-9);
	EXPECT_LE(report.maxCurvatureError, std::max(1e-8, report.residualFloor));
	EXPECT_EQ(report.brokenTriangles, 0);
	for (const double u : map.u)
		EXPECT_LT(u, 0.0);
	expectDrawn(mesh, map, map.targetCurvature, isFree, true);
	ASSERT_TRUE(report.hyperbolicArea && report.relationError);
	EXPECT_LT(*report.relationError, 1e-8);
	const double area = sum(map.targetCurvature) - 2 * kPi * report.eulerCharacteristic;
	if (!isFree) {
		// Every curvature is rounded to the last place of 2 pi.
		EXPECT_NEAR(*report.hyperbolicArea, area, 1e-10 * area + 1e-13);
	}
}

FlatResult reached(const SurfaceMesh& mesh, const std::vector<double>& curvature)
{
	FlatResult map =
		inUnitDisk(mesh, options(HyperbolicTarget::Prescribed), prescribing(curvature));
	EXPECT_LT(largestDifference(map.targetCurvature, curvature), 1e-12);
	expectReachedInDisk(mesh, map);
	return map;
}

TEST(HyperbolicFlow, FindsTheMetricOfCurvatureMinusOne)
{
	Random random(500);
	for (const int genus : {2, 3})
		for (const SurfaceMesh& mesh :
			 {perforatedSlab(genus, 2),
			  shaken(perforatedSlab(genus, 3), 0.08, random),
			  implicitClosed(genus, 5, 1)}) {
			SCOPED_TRACE(mesh.positions.size());
			const FlatResult map = inUnitDisk(mesh, options(HyperbolicTarget::HyperbolicMetric));
			expectReachedInDisk(mesh, map);
			EXPECT_EQ(map.targetCurvature, std::vector<double>(mesh.positions.size(), 0.0));
			EXPECT_NEAR(*map.report.hyperbolicArea / (4 * kPi * (genus - 1)), 1.0, 1e-10);
		}
}

TEST(HyperbolicFlow, ReachesRandomCones)
{
	for (const int genus : {0, 1, 2})
		for (const std::uint64_t seed : {1u, 2u, 3u}) {
			SCOPED_TRACE("genus " + std::to_string(genus) + ", seed " + std::to_string(seed));
			Random random(510 + seed);
			const SurfaceMesh mesh = seed == 3 ? implicitClosed(genus, 5, seed)
											   : shaken(perforatedSlab(genus, 3), 0.08, random);
			std::vector<double> curvature(mesh.positions.size(), 0.0);
			for (int i = 0; i < 12; ++i)
				curvature[at(random.index(static_cast<int>(curvature.size())))] =
					random.real(-4.0, 5.0);
			for (std::size_t v = 0; sum(curvature) <= 4 * kPi * (1 - genus) + 0.1; ++v)
				curvature[v] = 3.0;
			reached(mesh, curvature);
		}
}

/// Cones of nearly no angle, whose circles grow beyond all bounds, u to 0, while the others have far to go; and one
/// so wide that little area is left.
TEST(HyperbolicFlow, ReachesSharpAndWideCones)
{
	Random random(520);
	const SurfaceMesh sphere = shaken(perforatedSlab(0, 3), 0.05, random);
	const SurfaceMesh genus2 = shaken(perforatedSlab(2, 3), 0.05, random);
	for (const double angle : {0.3, 0.05, 1e-2, 1e-4}) {
		SCOPED_TRACE(angle);
		for (const SurfaceMesh& mesh : {sphere, genus2}) {
			std::vector<double> curvature(mesh.positions.size(), 0.0);
			for (const std::size_t v : {3u, 20u, 40u})
				curvature[v] = 2 * kPi - angle;
			EXPECT_LE(reached(mesh, curvature).report.iterations, 20);
		}
	}
	std::vector<double> curvature(genus2.positions.size(), 0.0);
	curvature[7] = -4 * kPi + 0.5;
	reached(genus2, curvature);
}

/// Without curvature at its vertices a boundary is a closed geodesic. A free one keeps its circles, at the scale
/// at which the flat surface has the area 2 pi max(1, |chi|), whatever the curvature inside is to be.
TEST(HyperbolicFlow, BoundariesAreGeodesicOrKeepTheirCircles)
{
	Random random(530);
	for (const SurfaceMesh& mesh :
		 {withoutStars(shaken(perforatedSlab(1, 4), 0.03, random), {0}),
		  withoutStars(shaken(perforatedSlab(0, 5), 0.03, random), {0, 60, 120}),
		  withoutStars(shaken(perforatedSlab(2, 3), 0.03, random), {5, 70}),
		  withoutStars(shaken(perforatedSlab(0, 5), 0.03, random), {0}),
		  ring(1, 3, 24, 8)}) {
		SCOPED_TRACE(mesh.positions.size());
		const std::vector<char> boundary = boundaryOf(mesh);
		std::vector<std::size_t> inside;
		for (std::size_t v = 0; v < boundary.size(); ++v)
			if (!boundary[v])
				inside.push_back(v);
		const Circles circles(mesh);
		for (const double K : {0.0, 2.0, -2.0}) {
			SCOPED_TRACE(K);
			std::vector<double> curvature(mesh.positions.size(), 0.0);
			curvature[inside[inside.size() / 2]] = K;
			HyperbolicOptions free = options(HyperbolicTarget::Prescribed, true);
			const FlatResult map = inUnitDisk(mesh, free, prescribing(curvature));
			expectReachedInDisk(mesh, map, true);
			const int chi = map.report.eulerCharacteristic;
			if (chi < 0 && K >= 0.0)
				reached(mesh, curvature);
			// On the mesh's own triangles the circles are those of the paper.
			free.method = Method::FixedTriangles;
			const FlatResult fixed = inUnitDisk(mesh, free, prescribing(curvature));
			expectReachedInDisk(mesh, fixed, true);
			const double scale = std::sqrt(2 * kPi * std::max(1, std::abs(chi)) / areaOf(mesh));
			for (std::size_t v = 0; v < boundary.size(); ++v)
				if (boundary[v]) {
					const double radius = 2 * std::atanh(std::exp(fixed.u[v]));
					EXPECT_NEAR(
						radius / static_cast<double>(circles.radius[v]) / scale, 1.0, 1e-11);
				}
		}
	}
}

/// The limits of values whose error is of second order in the width of the triangles: the error falls
/// to a quarter with half of the width, and two of them tell the limit to fourth order.
void expectSecondOrder(const std::vector<double>& values, double limit)
{
	ASSERT_EQ(values.size(), 3u);
	const auto error = [&](std::size_t i) { return values[i] - limit; };
	EXPECT_NEAR(error(0) / error(1), 4.0, 0.4);
	EXPECT_NEAR(error(1) / error(2), 4.0, 0.1);
	EXPECT_NEAR((4.0 * values[2] - values[1]) / 3.0, limit, std::abs(error(2)) / 20.0);
}

/// Areas, and total lengths of the boundaries, of flat surfaces of revolution with free boundaries.
/// \param profile (n) of triangles as wide as 2 pi / n
template<class Profile>
void expectAreaAndLength(const Profile& profile, double area, double boundaryLength)
{
	std::vector<double> areas, lengths;
	for (const int n : {24, 48, 96}) {
		const SurfaceMesh mesh = revolved(profile(n), n);
		HyperbolicOptions free = options(HyperbolicTarget::HyperbolicMetric, true);
		const FlatResult map = inUnitDisk(mesh, free);
		areas.push_back(map.report.hyperbolicArea.value_or(0));
		lengths.push_back(0.0);
		std::map<std::pair<int, int>, double> sides;
		for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
			for (std::size_t k = 0; k < 3; ++k) {
				const auto p = asComplex(map.uv[f][k]), q = asComplex(map.uv[f][(k + 1) % 3]);
				const int i = mesh.triangles[f][k], j = mesh.triangles[f][(k + 1) % 3];
				sides[{i, j}] = 2 * std::atanh(std::abs((q - p) / (1.0 - std::conj(p) * q)));
			}
		for (const auto& [ends, length] : sides)
			if (sides.count({ends.second, ends.first}) == 0)
				lengths.back() += length;
	}
	expectSecondOrder(areas, area);
	expectSecondOrder(lengths, boundaryLength);
}

/// A flat round disk of area 2 pi has a circumference of 2 pi sqrt(2). In the hyperbolic plane a
/// circle of that length, 2 pi sinh R, holds the area 2 pi (cosh R - 1) = 2 pi (sqrt(3) - 1).
TEST(HyperbolicFlow, ADiskWithFreeBoundaryIsThatOfTheHyperbolicPlane)
{
	const auto profile = [](int n) {
		std::vector<std::array<double, 2>> radii;
		for (int i = 0; i <= n / 4; ++i)
			radii.push_back({4.0 * i / n, 0.0});
		return radii;
	};
	expectAreaAndLength(profile, 2 * kPi * (std::sqrt(3.0) - 1.0), 2 * kPi * std::sqrt(2.0));
}

/// On a flat cylinder of period 2 pi and height w the metrics of curvature -1 that are symmetric in
/// both directions are k^2 / cos^2(k x) (dx^2 + dy^2), |x| <= w / 2. Scaled to the area 2 pi both
/// boundaries are 2 pi / sqrt(w) long, which is 2 pi k / cos(k w / 2). The core is a closed geodesic
/// of length 2 pi k, and the area 4 pi k tan(k w / 2).
TEST(HyperbolicFlow, ACylinderWithFreeBoundaryIsAHyperbolicCollar)
{
	const double height = 1.7; // radius 1
	const auto profile = [&](int n) {
		std::vector<std::array<double, 2>> wall;
		for (int i = 0; i <= n / 3; ++i)
			wall.push_back({1.0, 3.0 * i / n * height});
		return wall;
	};
	double k = 1.0;
	for (int i = 0; i < 200; ++i)
		k = std::cos(0.5 * k * height) / std::sqrt(height);
	expectAreaAndLength(
		profile, 4 * kPi * k * std::tan(0.5 * k * height), 4 * kPi / std::sqrt(height));
}

/// On a torus whose curvatures leave the area \p s the metric is the Euclidean flow's except for the
/// scale, up to the order of s.
TEST(HyperbolicFlow, BothBackgroundsAgreeWhereTheAreaVanishes)
{
	Random random(570);
	const SurfaceMesh mesh = bumpyTorus(14, 10, random);
	std::vector<double> curvature(mesh.positions.size(), 0.0);
	curvature[17] = 0.5;
	curvature[91] = -0.5;
	Options euclidean = towards(TargetCurvature::Prescribed);
	euclidean.epsilon = 1e-12;
	const FlatResult flat = flattened(mesh, euclidean, prescribing(curvature));
	std::vector<double> errors;
	for (const double s : {1e-2, 1e-3, 1e-4}) {
		curvature[17] = 0.5 + s;
		HyperbolicOptions hyperbolic = options(HyperbolicTarget::Prescribed);
		hyperbolic.epsilon = 1e-12;
		const FlatResult curved = inUnitDisk(mesh, hyperbolic, prescribing(curvature));
		EXPECT_NEAR(*curved.report.hyperbolicArea / s, 1.0, 1e-8);
		double least = HUGE_VAL, most = -HUGE_VAL; // of the quotient of radii
		for (std::size_t v = 0; v < flat.u.size(); ++v) {
			const double x = std::log(2 * std::atanh(std::exp(curved.u[v]))) - flat.u[v];
			least = std::min(least, x);
			most = std::max(most, x);
		}
		errors.push_back(most - least);
	}
	for (std::size_t i = 1; i < errors.size(); ++i)
		EXPECT_NEAR(errors[i - 1] / errors[i], 10.0, 0.5);
	EXPECT_LT(errors.back(), 1e-3);
}

} // namespace
} // namespace ricci::testing
