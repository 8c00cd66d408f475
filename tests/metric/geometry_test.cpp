// SPDX-License-Identifier: GPL-3.0-or-later
// The two background geometries.
#include "support/random.h"
#include "support/wide.h"

#include <ricci/metric/geometry.h>

#include <gtest/gtest.h>

#include <cmath>

namespace ricci::testing {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// Relative difference.
double relative(long double value, long double reference)
{
	return static_cast<double>(std::abs(value - reference) / std::abs(reference));
}

/// Between 10^low and 10^high.
double powerOfTen(double low, double high, Random& random)
{
	return std::pow(10.0, random.real(low, high));
}

template<class Geometry>
void expectDeltaInvertsTheLength(double ui, double uj, double share)
{
	const auto a = Geometry::circle(ui), b = Geometry::circle(uj);
	const double l = (a.radius + b.radius) * share;
	const auto edge = Geometry::edge(a, b, Geometry::delta(l, a.radius, b.radius));
	EXPECT_NEAR(edge.length / l, 1.0, 16 * kEpsilon * (1 + l));
}

TEST(Geometry, DeltaInvertsTheLength)
{
	Random random(21);
	for (int i = 0; i < 2000; ++i) {
		const double share = random.real(1.0, 4.0);
		expectDeltaInvertsTheLength<Euclidean>(random.real(-3, 3), random.real(-3, 3), share);
		expectDeltaInvertsTheLength<Hyperbolic>(
			-powerOfTen(-1, 1, random), -powerOfTen(-1, 1, random), share);
	}
}

/// ln tanh(radius / 2) = u is symmetric in -u and radius; u has a low part below its last place.
TEST(Hyperbolic, CircleIsTheInverseOfTheLogarithmOfTanh)
{
	RICCI_NEEDS_WIDE_LONG_DOUBLE();
	Random random(60);
	int seen = 0;
	for (int i = 0; i < 2000; ++i) {
		const double u = i == 0   ? -50.0
						 : i == 1 ? -1e-3
								  : -powerOfTen(-3, std::log10(50.0), random);
		for (const double share : {0.0, -0.49, -0.25, 0.25, 0.49}) {
			const double low = share * (std::nextafter(u, -100.0) - u);
			const auto circle = Hyperbolic::circle(u, low);
			const long double x = static_cast<long double>(u) + low;
			EXPECT_LT(relative(circle.radius, 2 * std::atanh(std::exp(x))), 6 * kEpsilon) << u;
			if (u > -15) { // below, the logarithm of what is near 1
				EXPECT_LT(relative(circle.radius, -std::log(std::tanh(-x / 2))), 1e-12) << u;
			}
			EXPECT_LT(relative(circle.s, -1 / std::sinh(x)), 6 * kEpsilon) << u;
			EXPECT_LT(relative(circle.kappa, std::cosh(x)), 6 * kEpsilon) << u;
			const long double t = std::exp(x), root = std::sqrt(-std::expm1(2 * x));
			EXPECT_LT(relative(circle.sinhHalf, t / root), 6 * kEpsilon) << u;
			EXPECT_LT(relative(circle.coshHalf, 1 / root), 6 * kEpsilon) << u;
			// Without the low part s would be off by this:
			seen += relative(-1 / std::sinh(static_cast<long double>(u)), -1 / std::sinh(x)) >
					8 * kEpsilon;
			// sinh and coth amplify the rounding of the radius by radius coth(radius) <= 1 + radius.
			const long double radius = circle.radius, s = circle.s, kappa = circle.kappa;
			const double rounding = 8 * kEpsilon * (1 + circle.radius);
			EXPECT_LT(relative(s, std::sinh(radius)), rounding) << u;
			EXPECT_LT(relative(kappa, 1 / std::tanh(radius)), rounding) << u;
			EXPECT_LT(relative(kappa * kappa, 1 + 1 / (s * s)), 24 * kEpsilon) << u;
		}
	}
	EXPECT_GT(seen, 100);
}

/// Eq. 4 with radii from Eq. 6: cosh l - 1, in the plane l^2 / 2, without a difference.
template<class Geometry>
void expectLawOfCosines(double ui, double uj, double delta)
{
	using Wide = long double;
	constexpr bool isFlat = Geometry::scaleInvariant;
	const auto radius = [](Wide u) { return isFlat ? std::exp(u) : 2 * std::atanh(std::exp(u)); };
	const auto s = [](Wide x) { return isFlat ? x : std::sinh(x); };
	const auto a = Geometry::circle(ui), b = Geometry::circle(uj);
	const auto edge = Geometry::edge(a, b, delta);
	const Wide gi = radius(ui), gj = radius(uj), half = s((gi + gj) / 2);
	const Wide lessOne = 2 * half * half + delta * s(gi) * s(gj);
	const Wide length = isFlat ? std::sqrt(2 * lessOne) : 2 * std::asinh(std::sqrt(lessOne / 2));
	const double rounding = 16 * kEpsilon * (1 + (isFlat ? 0.0 : edge.length));
	EXPECT_LT(relative(edge.length, length), rounding);
	EXPECT_LT(relative(edge.sine2, lessOne * (isFlat ? 2 : lessOne + 2)), rounding);
	if (isFlat) {
		EXPECT_EQ(edge.cosineLess1, 0.0);
	}
	else {
		EXPECT_LT(relative(edge.cosineLess1, lessOne), rounding);
	}
	// The difference of length and radii: half of it, by that of the hyperbolic cosines.
	const Wide x = delta * s(gi) * s(gj) / (2 * s((length + gi + gj) / 2));
	EXPECT_LT(relative(edge.excess, 2 * (isFlat ? x : std::asinh(x))), rounding);
	EXPECT_LT(relative(a.radius, gi), rounding);
	EXPECT_LT(relative(a.s, s(gi)), rounding);
	EXPECT_LT(relative(a.kappa, isFlat ? 1 / gi : 1 / std::tanh(gi)), rounding);
}

/// Down to hyperbolic circles so small that they lie like Euclidean ones.
TEST(Geometry, LengthIsTheLawOfCosinesWithTheInversiveDistance)
{
	RICCI_NEEDS_WIDE_LONG_DOUBLE();
	Random random(63);
	for (int i = 0; i < 2000; ++i) {
		const double delta = powerOfTen(-12, 6, random);
		expectLawOfCosines<Euclidean>(random.real(-9, 9), random.real(-9, 9), delta);
		expectLawOfCosines<Hyperbolic>(
			-powerOfTen(-2, 1.5, random), -powerOfTen(-2, 1.5, random), delta);
	}
}

} // namespace
} // namespace ricci::testing
