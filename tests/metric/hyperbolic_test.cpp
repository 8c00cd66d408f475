// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"
#include "support/wide.h"

#include <ricci/metric/euclidean.h>
#include <ricci/metric/hyperbolic.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ricci::testing {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// u from -50 to -1e-3, on a logarithmic scale of the two ends.
std::vector<double> valuesOfU(Random& random)
{
	std::vector<double> u{-50.0, -1e-3, -1.0};
	for (int i = 0; i < 2000; ++i)
		u.push_back(-std::pow(10.0, random.real(-3.0, std::log10(50.0))));
	return u;
}

/// Relative difference.
double relative(long double value, long double reference)
{
	return static_cast<double>(std::abs(value - reference) / std::abs(reference));
}

TEST(Hyperbolic, CircleIsTheInverseOfTheLogarithmOfTanh)
{
	RICCI_NEEDS_WIDE_LONG_DOUBLE();
	Random random(60);
	for (double u : valuesOfU(random)) {
		const auto circle = Hyperbolic::circle(u);
		const long double x = u, radius = -std::log(std::tanh(-x / 2));
		// ln tanh(radius / 2) = u is symmetric in -u and radius.
		EXPECT_LT(relative(circle.radius, 2 * std::atanh(std::exp(x))), 6 * kEpsilon) << u;
		if (u > -15) { // below, the logarithm of what is near 1
			EXPECT_LT(relative(circle.radius, radius), 1e-12) << u;
		}
		EXPECT_LT(relative(circle.s, -1 / std::sinh(x)), 6 * kEpsilon) << u;
		EXPECT_LT(relative(circle.kappa, std::cosh(x)), 6 * kEpsilon) << u;
	}
}

TEST(Hyperbolic, CurvatureAndCircumferenceOfACircleBelongToItsRadius)
{
	Random random(61);
	for (double u : valuesOfU(random)) {
		const auto circle = Hyperbolic::circle(u);
		const long double radius = circle.radius, s = circle.s, kappa = circle.kappa;
		// sinh and coth amplify the rounding of the radius by radius coth(radius) <= 1 + radius.
		const double rounding = 8 * kEpsilon * (1 + circle.radius);
		EXPECT_LT(relative(s, std::sinh(radius)), rounding) << u;
		EXPECT_LT(relative(kappa, 1 / std::tanh(radius)), rounding) << u;
		EXPECT_LT(
			static_cast<double>(std::abs(kappa * kappa - 1 / (s * s) - 1)),
			24 * kEpsilon * circle.kappa * circle.kappa)
			<< u;
	}
}

TEST(Hyperbolic, CircleKnowsWhatTheLastPlaceOfUCannotHold)
{
	RICCI_NEEDS_WIDE_LONG_DOUBLE();
	Random random(62);
	int seen = 0;
	for (double u : valuesOfU(random)) {
		const double unit = std::nextafter(u, -100.0) - u;
		for (double share : {-0.49, -0.25, 0.25, 0.49}) {
			const double low = share * unit;
			const auto circle = Hyperbolic::circle(u, low);
			const long double x = static_cast<long double>(u) + low;
			EXPECT_LT(relative(circle.radius, 2 * std::atanh(std::exp(x))), 6 * kEpsilon) << u;
			EXPECT_LT(relative(circle.s, -1 / std::sinh(x)), 6 * kEpsilon) << u;
			EXPECT_LT(relative(circle.kappa, std::cosh(x)), 6 * kEpsilon) << u;
			const long double t = std::exp(x), root = std::sqrt(-std::expm1(2 * x));
			EXPECT_LT(relative(circle.sinhHalf, t / root), 6 * kEpsilon) << u;
			EXPECT_LT(relative(circle.coshHalf, 1 / root), 6 * kEpsilon) << u;
			// Without it s would be off by this:
			seen += relative(-1 / std::sinh(static_cast<long double>(u)), -1 / std::sinh(x)) >
					8 * kEpsilon;
		}
	}
	EXPECT_GT(seen, 100);
}

/// The derivatives by which the low part of u moves a circle: of the radius s, of s s^2 kappa,
/// of kappa -1 / s.
TEST(Hyperbolic, DerivativesOfACircleByU)
{
	for (double u : {-20.0, -5.0, -1.0, -0.3, -0.01}) {
		const double h = 1e-4 * std::min(1.0, -u);
		const auto here = Hyperbolic::circle(u);
		const auto above = Hyperbolic::circle(u + h), below = Hyperbolic::circle(u - h);
		const double step = (u + h) - (u - h);
		EXPECT_LT(relative((above.radius - below.radius) / step, here.s), 1e-7) << u;
		EXPECT_LT(relative((above.s - below.s) / step, here.s * here.s * here.kappa), 1e-7) << u;
		EXPECT_LT(relative((above.kappa - below.kappa) / step, -1 / here.s), 1e-7) << u;
	}
}

struct RandomEdge
{
	double ui, uj, delta;

	explicit RandomEdge(Random& random) :
			ui(-std::pow(10.0, random.real(-2.0, 1.0))),
			uj(-std::pow(10.0, random.real(-2.0, 1.0))), delta(std::pow(10.0, random.real(-12, 6)))
	{
	}
};

TEST(Hyperbolic, LengthIsTheLawOfCosinesWithTheInversiveDistance)
{
	RICCI_NEEDS_WIDE_LONG_DOUBLE();
	Random random(63);
	for (int i = 0; i < 2000; ++i) {
		const RandomEdge e(random);
		const auto a = Hyperbolic::circle(e.ui), b = Hyperbolic::circle(e.uj);
		const auto edge = Hyperbolic::edge(a, b, e.delta);
		// Eq. 4 as printed, with radii from Eq. 6.
		const long double gi = 2 * std::atanh(std::exp(static_cast<long double>(e.ui)));
		const long double gj = 2 * std::atanh(std::exp(static_cast<long double>(e.uj)));
		const long double cosine =
			std::cosh(gi) * std::cosh(gj) + (1.0L + e.delta) * std::sinh(gi) * std::sinh(gj);
		const long double lessOne = cosine - 1;
		// 80 bits less what the difference cancels.
		const double reference = 1e-18 * static_cast<double>(cosine / lessOne);
		const double rounding = 16 * kEpsilon * (1 + edge.length) + reference;
		EXPECT_LT(relative(edge.cosineLess1, lessOne), rounding);
		EXPECT_LT(relative(edge.sine2, lessOne * (cosine + 1)), rounding);
		const long double half = std::sinh(static_cast<long double>(edge.length) / 2);
		EXPECT_LT(relative(2 * half * half, lessOne), rounding);
		// cosh(l) - 1 by half the sum of the radii, without cancellation: only the difference of length
		// and radii cancels, and the wider type leaves it this exact.
		const long double halfSum = std::sinh((gi + gj) / 2);
		const long double exactLessOne =
			2 * halfSum * halfSum + e.delta * std::sinh(gi) * std::sinh(gj);
		const long double length = 2 * std::asinh(std::sqrt(exactLessOne / 2));
		const long double excess = length - gi - gj;
		EXPECT_LT(
			relative(edge.excess, excess),
			16 * kEpsilon * (1 + edge.length) + 1e-18 * static_cast<double>(length / excess));
	}
}

TEST(Hyperbolic, DeltaInvertsTheLength)
{
	Random random(64);
	for (int i = 0; i < 2000; ++i) {
		const double ui = -std::pow(10.0, random.real(-1.0, 1.0));
		const double uj = -std::pow(10.0, random.real(-1.0, 1.0));
		const auto a = Hyperbolic::circle(ui), b = Hyperbolic::circle(uj);
		const double l = (a.radius + b.radius) * random.real(1.0, 4.0);
		const auto edge = Hyperbolic::edge(a, b, Hyperbolic::delta(l, a.radius, b.radius));
		EXPECT_NEAR(edge.length / l, 1.0, 16 * kEpsilon * (1 + l));
	}
}

/// Circles of radius 2 exp(u) lie like Euclidean ones, up to the square of their size.
TEST(Hyperbolic, SmallCirclesAreEuclidean)
{
	Random random(65);
	int seen = 0;
	for (int i = 0; i < 200; ++i) {
		const double wi = random.real(-1, 1), wj = random.real(-1, 1);
		const double delta = std::pow(10.0, random.real(-3, 1));
		const auto error = [&](double shift) {
			const auto edge = Hyperbolic::edge(
				Hyperbolic::circle(shift + wi), Hyperbolic::circle(shift + wj), delta);
			const auto flat = Euclidean::edge(
				Euclidean::circle(shift + wi + std::log(2.0)),
				Euclidean::circle(shift + wj + std::log(2.0)),
				delta);
			const double l = flat.length;
			EXPECT_NEAR(edge.cosineLess1 / (0.5 * l * l), 1.0, l * l + 32 * kEpsilon * -shift);
			return edge.length / flat.length - 1.0;
		};
		EXPECT_LT(std::abs(error(-20.0)), 64 * kEpsilon);
		const double coarse = error(-7.0), fine = error(-8.0);
		if (std::abs(fine) > 1e-9) {
			++seen;
			EXPECT_NEAR(coarse / fine, std::exp(2.0), 0.05);
		}
	}
	EXPECT_GT(seen, 100);
}

} // namespace
} // namespace ricci::testing
