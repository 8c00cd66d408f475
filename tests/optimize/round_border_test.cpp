// SPDX-License-Identifier: GPL-3.0-or-later
#include "../support/random.h"
#include "../support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/optimize/repair.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace ricci::testing {
namespace {

using Complex = std::complex<double>;

constexpr double kRadius = 3.0;
const Complex kCentre(5.0, -2.0);

/// A polygon with its corners on a circle at these angles and, in the middle, a point that all sides are joined to,
/// except that the sides at \p ears make triangles of their own.
FlatMesh wheel(const std::vector<double>& angles, const std::vector<int>& ears)
{
	const int n = static_cast<int>(angles.size());
	std::vector<Point3> positions;
	for (const double angle : angles) {
		const Complex p = kCentre + std::polar(kRadius, angle);
		positions.push_back({p.real(), p.imag(), 0.0});
	}
	positions.push_back({kCentre.real(), kCentre.imag(), 0.0});
	Array<Triangle> triangles;
	const auto isEar = [&](int i) { return std::count(ears.begin(), ears.end(), i % n) > 0; };
	for (int i = 0; i < n; ++i)
		if (isEar(i))
			triangles.push_back({(i + n - 1) % n, i, (i + 1) % n});
		else
			triangles.push_back({i, isEar(i + 1) ? (i + 2) % n : (i + 1) % n, n});
	Array<Triangle2> plane;
	for (const Triangle& t : triangles) {
		plane.push_back({});
		for (std::size_t k = 0; k < 3; ++k)
			plane.back()[k] = {positions[at(t[k])][0], positions[at(t[k])][1]};
	}
	return flatMeshOf(triangles, plane, positions);
}

/// [vertex of the wheel] its angle
std::vector<double> anglesOf(const FlatMesh& flat, int n)
{
	std::vector<double> angles(at(n));
	for (const Corner c : flat.across.indices())
		if (const int v = flat.vertices[c]; v < n) {
			const Complex p = asComplex(flat.at(c)) - kCentre;
			EXPECT_NEAR(std::abs(p), kRadius, 1e-13);
			angles[at(v)] = std::arg(p);
		}
	return angles;
}

double heightOf(const Triangle2& p)
{
	return doubledArea(p) /
		   std::max({distance(p[0], p[1]), distance(p[1], p[2]), distance(p[2], p[0])});
}

/// Ears on arcs of any size become as high as they should be; the points stay on the circle and in their order, the
/// centre stays, and where no ear is near, all do.
TEST(RoundBorder, SlidesUntilTrianglesAreHighEnough)
{
	Random random(7);
	const double height = 1e-5;
	const Validity validity{height, 2 * height};
	for (int run = 0; run < 50; ++run) {
		const int n = 40;
		std::vector<double> angles;
		for (int i = 0; i < n; ++i)
			angles.push_back(2 * kPi * (i + random.real(0.0, 0.5)) / n);
		const double arc = std::pow(10.0, -random.real(3.0, 9.0));
		angles[9] = angles[10] - arc; // an ear at 10
		angles[11] = angles[10] + arc;
		FlatMesh flat = wheel(angles, {10, 30});
		ASSERT_EQ(flat.place.size(), n + 1);
		const FlatMesh before = flat;
		Array<char> moved(flat.place.size(), 0);
		const Array<char> isRound = slideOnCircles(validity, flat, moved);
		EXPECT_EQ(std::count(isRound.begin(), isRound.end(), 1), n);
		EXPECT_EQ(isRound[n], 0);
		for (const int f : flat.points.indices())
			EXPECT_GT(heightOf(flat.at(f)), height);
		const std::vector<double> old = anglesOf(before, n), now = anglesOf(flat, n);
		for (int i = 0; i < n; ++i) {
			const double next = std::remainder(now[at((i + 1) % n)] - now[at(i)], 2 * kPi);
			EXPECT_GT(next, 0.0);
			const double turn = std::remainder(now[at(i)] - old[at(i)], 2 * kPi);
			EXPECT_LT(std::abs(turn), 0.02);
			if (i < 5 || i > 15) {
				EXPECT_EQ(turn, 0.0);
			}
		}
		// What is high enough already does not move.
		const FlatMesh high = flat;
		moved.assign(flat.place.size(), 0);
		slideOnCircles(validity, flat, moved);
		EXPECT_EQ(std::count(moved.begin(), moved.end(), 1), 0);
		EXPECT_EQ(flat.place, high.place);
	}
}

/// More ears than fit on the circle at these heights stay in their order on it.
TEST(RoundBorder, KeepsTheOrderWhereHeightsDoNotFit)
{
	const int n = 64;
	std::vector<double> angles;
	std::vector<int> ears;
	for (int i = 0; i < n; ++i) {
		angles.push_back(2 * kPi * i / n - (i % 2 == 0 ? 0.0 : 0.09));
		if (i % 2 == 1)
			ears.push_back(i);
	}
	FlatMesh flat = wheel(angles, ears);
	Array<char> moved(flat.place.size(), 0);
	slideOnCircles({0.5, 1.0}, flat, moved);
	const std::vector<double> now = anglesOf(flat, n);
	for (int i = 0; i < n; ++i)
		EXPECT_GT(std::remainder(now[at((i + 1) % n)] - now[at(i)], 2 * kPi), 0.0);
}

/// What is no circle stays as it is, and a border near one is put on it.
TEST(RoundBorder, KnowsCircles)
{
	std::vector<double> angles;
	for (int i = 0; i < 12; ++i)
		angles.push_back(0.5 * i);
	FlatMesh flat = wheel(angles, {});
	Array<char> moved(flat.place.size(), 0);
	const Point2 place = flat.place[4];
	flat.place[4] += Point2{1e-6, 1e-6};
	const FlatMesh dented = flat;
	Array<char> isRound = slideOnCircles({0.5, 1.0}, flat, moved);
	EXPECT_EQ(std::count(isRound.begin(), isRound.end(), 1), 0);
	EXPECT_EQ(flat.place, dented.place);
	flat.place[4] = place + Point2{1e-11, 1e-11};
	makeRound(flat);
	anglesOf(flat, 12);
	isRound = slideOnCircles({1e-9, 1e-9}, flat, moved);
	EXPECT_EQ(std::count(isRound.begin(), isRound.end(), 1), 12);
}

} // namespace
} // namespace ricci::testing
