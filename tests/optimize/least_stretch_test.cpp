// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat_maps.h"

#include <ricci/optimize/least_distortion.h>
#include <ricci/optimize/patch_energy.h>
#include <ricci/optimize/patches.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ricci::testing {
namespace {

/// The square as \p surface(i, j) bends it in space, and its map as \p place(i, j) lays it out.
template<class Surface, class Place>
FlatMesh bentSquare(const Surface& surface, const Place& place)
{
	std::vector<Point2> places;
	for (int i = 0; i <= kSide; ++i)
		for (int j = 0; j <= kSide; ++j)
			places.push_back(place(i, j));
	return flatDisk(grid(kSide, kSide, Ends::Open, Ends::Open, surface), places);
}

/// Part of a cylinder, mapped with sheared and uneven cells.
FlatMesh cylinder()
{
	return bentSquare(
		[](int i, int j) {
			return Point3{2.0 * std::cos(0.3 * i), 2.0 * std::sin(0.3 * i), 0.7 * j};
		},
		[](int i, int j) {
			return Point2{std::pow(i, 1.4) + 0.5 * j, 2.0 * j + 0.05 * j * j};
		});
}

/// Waves that no plane is isometric to, as they are seen from above.
FlatMesh waves()
{
	return bentSquare(
		[](int i, int j) {
			return Point3{double(i), double(j), 2.0 * std::sin(0.6 * i) * std::cos(0.8 * j)};
		},
		[](int i, int j) {
			return Point2{double(i), double(j)};
		});
}

/// Mean of sigma1^2 + sigma2^2 + sigma1^-2 + sigma2^-2 by area, from the lengths of sides alone:
/// |J|^2 A of the metric g = J^T J is a sum over the sides with the cotangents of the opposite angles. Of the
/// triangles that are counter-clockwise, at the scale at which all have the area that they have on the surface.
double energyOf(FlatMesh flat)
{
	scaleToSurface(flat);
	double sum = 0.0, total = 0.0;
	for (const int f : flat.points.indices()) {
		const Triangle2 p = flat.at(f);
		if (orientation(p) <= 0)
			continue;
		const auto& [a, b, c] = flat.lengths[f];
		const double s = 0.5 * (a + b + c);
		const double area = std::sqrt(s * (s - a) * (s - b) * (s - c));
		const double det = 0.5 * doubledArea(p[0], p[1], p[2]) / area;
		const std::array<double, 3> square{a * a, b * b, c * c};
		double dirichlet = 0.0;
		for (std::size_t k = 0; k < 3; ++k) {
			const double opposite = square[(k + 1) % 3] + square[(k + 2) % 3] - square[k];
			const double side = distance(p[k], p[(k + 1) % 3]);
			dirichlet += opposite / (8.0 * area * area) * side * side;
		}
		sum += area * dirichlet * (1.0 + 1.0 / (det * det));
		total += area;
	}
	return sum / total;
}

Patch whole(const FlatMesh& flat)
{
	Patch patch;
	for (const int f : flat.points.indices())
		patch.triangles.push_back(f);
	for (const int p : flat.place.indices())
		patch.points.push_back(p);
	patch.corners = flat.points;
	patch.variable = Array<int>(patch.points);
	patch.variables = flat.place.size();
	return patch;
}

PatchEnergy stretchOf(const FlatMesh& flat, const Patch& patch)
{
	return PatchEnergy(
		flat,
		allPoints(flat),
		patch,
		restShapes(flat, patch, RestShapes::OfSurfaceEvenly, {}),
		PatchCost::SymmetricDirichlet);
}

TEST(SymmetricDirichlet, GradientIsThatOfDifferences)
{
	Random random(641);
	const FlatMesh flat = waves();
	const Patch patch = whole(flat);
	PatchEnergy energy = stretchOf(flat, patch);
	Eigen::VectorXd x(energy.size()), gradient, step;
	for (double& v : x)
		v = random.real(-0.1, 0.1);
	ASSERT_TRUE(std::isfinite(energy.value(x, 0.0)));
	ASSERT_TRUE(energy.newtonStep(x, 0.0, gradient, step));
	EXPECT_LT(gradient.dot(step), 0.0);
	constexpr double h = 1e-5;
	for (int i = 0; i < energy.size(); i += 7) {
		const auto at = [&](double by) {
			Eigen::VectorXd y = x;
			y[i] += by;
			return energy.value(y, 0.0);
		};
		EXPECT_NEAR(gradient[i], (at(h) - at(-h)) / (2 * h), 1e-7 * (1.0 + std::abs(gradient[i])));
	}
}

TEST(SymmetricDirichlet, IsInfiniteWhereATriangleIsFlippedUnlessItDoesNotCount)
{
	FlatMesh flat = square();
	const Triangle t = flat.points[40];
	const Patch patch = whole(flat);
	PatchEnergy energy = stretchOf(flat, patch);
	Eigen::VectorXd x = Eigen::VectorXd::Zero(energy.size());
	EXPECT_NEAR(energy.value(x, 0.0), 4.0, 1e-12);
	x[2 * t[0]] += 3.0;
	EXPECT_EQ(energy.value(x, 0.0), std::numeric_limits<double>::infinity());
	for (const int f : flat.points.indices())
		energy.stress(f, 0.0);
	EXPECT_EQ(energy.value(x, 0.0), 0.0);
}

/// Whatever the size of the map that it starts from.
TEST(LeastStretch, OfADevelopableSurfaceIsAnIsometry)
{
	for (const double size : {1.0, 1e-3}) {
		FlatMesh flat = cylinder();
		for (Point2& p : flat.place)
			p = size * p;
		ASSERT_EQ(notCounterClockwise(flat), 0);
		EXPECT_GT(energyOf(flat), 4.5);
		scaleToSurface(flat);
		EXPECT_FALSE(leastStretch(flat, allPoints(flat)));
		EXPECT_NEAR(energyOf(flat), 4.0, 1e-10);
		for (const int f : flat.points.indices())
			for (const Corner side : cornersOf(f)) {
				const auto ends = flat.ends(side);
				EXPECT_NEAR(distance(ends[0], ends[1]), flat.lengths[side], 1e-5);
			}
	}
}

TEST(LeastStretch, LowersTheEnergyAndFlipsNothing)
{
	const FlatMesh start = waves();
	FlatMesh flat = start;
	EXPECT_FALSE(leastStretch(flat, allPoints(flat)));
	const double after = energyOf(flat);
	EXPECT_LT(after, energyOf(start));
	EXPECT_GT(after, 4.0);
	EXPECT_EQ(notCounterClockwise(flat), 0);
	// It is nearly a minimum: another run gains little more than what ends a run.
	leastStretch(flat, allPoints(flat));
	EXPECT_LT(after - energyOf(flat), 0.01 * (after - 4.0));
}

TEST(LeastStretch, ATriangleThatIsFlippedDoesNotCount)
{
	FlatMesh flat = waves();
	const int middle = vertexAt(kSide / 2, kSide / 2);
	flat.place[middle][0] += 1.6;
	const int flipped = notCounterClockwise(flat);
	ASSERT_GT(flipped, 0);
	const double before = energyOf(flat);
	leastStretch(flat, allPoints(flat));
	EXPECT_LT(energyOf(flat), before);
	EXPECT_LE(notCounterClockwise(flat), flipped);
}

} // namespace
} // namespace ricci::testing
