// SPDX-License-Identifier: GPL-3.0-or-later
#include "double_double.h"

#include <array>
#include <cstddef>

namespace ricci {

namespace {

constexpr int kSteps = 64; // of the tables: to a factor of 2, and to an angle of 1

DoubleDouble scaled(DoubleDouble x, int exponent)
{
	return {std::ldexp(x.high, exponent), std::ldexp(x.low, exponent)};
}

/// exp(x) - 1 and sin(x) by their series.
template<bool alternating>
DoubleDouble series(DoubleDouble x)
{
	const DoubleDouble factor = alternating ? -(x * x) : x;
	DoubleDouble sum = x, term = x;
	for (int n = 2; std::abs(term.high) > 0x1p-120; n += alternating ? 2 : 1) {
		term = term * factor / DoubleDouble(alternating ? n * (n + 1) : n);
		sum += term;
	}
	return sum;
}

struct Tables
{
	std::array<DoubleDouble, kSteps> power; ///< 2^(i / kSteps)
	std::array<SineAndCosine, kSteps> turn; ///< of i / kSteps

	Tables()
	{
		const DoubleDouble factor = 1 + series<false>(kExtendedLog2 / kSteps);
		const DoubleDouble sine = series<true>(1.0 / kSteps);
		const DoubleDouble cosine = sqrt(1 - sine * sine);
		power[0] = 1;
		turn[0] = {0, 1};
		for (std::size_t i = 1; i < kSteps; ++i) {
			power[i] = power[i - 1] * factor;
			const SineAndCosine& last = turn[i - 1];
			turn[i] = {
				last.sine * cosine + last.cosine * sine, last.cosine * cosine - last.sine * sine};
		}
	}
};

const Tables& tables()
{
	static const Tables result;
	return result;
}

/// exp(x) - 1 for |x| below 1 / 64: the first terms exactly, the rest, less than 2^-14 of them, in
/// double.
DoubleDouble smallExpm1(DoubleDouble x)
{
	const double y = x.high;
	const double rest =
		y * y * y / 6 * (1 + y / 4 * (1 + y / 5 * (1 + y / 6 * (1 + y / 7 * (1 + y / 8)))));
	return x + (x * x * 0.5 + rest);
}

/// exp(x) as a power of 2 times 1 plus a rest, for |x| below 700.
struct Reduced
{
	DoubleDouble power, rest;

	explicit Reduced(DoubleDouble x)
	{
		const double step = std::round(x.high * (kSteps / kExtendedLog2.high));
		const int n = static_cast<int>(step), index = ((n % kSteps) + kSteps) % kSteps;
		power = scaled(tables().power[static_cast<std::size_t>(index)], (n - index) / kSteps);
		rest = smallExpm1(x - kExtendedLog2 * (step / kSteps));
	}
};

/// Sine, and cosine less 1, for |x| below 1 / 64.
SineAndCosine smallTurn(DoubleDouble x)
{
	const double y = x.high * x.high;
	const double sine = -x.high * y / 6 * (1 - y / 20 * (1 - y / 42 * (1 - y / 72)));
	const double cosine = y * y / 24 * (1 - y / 30 * (1 - y / 56 * (1 - y / 90)));
	return {x + sine, x * x * -0.5 + cosine};
}

} // namespace

DoubleDouble exp(DoubleDouble x)
{
	if (!(std::abs(x.high) < 700.0)) // the range ends, or x is NaN
		return std::exp(x.high);
	const Reduced r(x);
	return r.power + r.power * r.rest;
}

DoubleDouble expm1(DoubleDouble x)
{
	if (!(std::abs(x.high) < 700.0))
		return std::expm1(x.high);
	const Reduced r(x);
	return (r.power - 1) + r.power * r.rest;
}

DoubleDouble sinh(DoubleDouble x)
{
	const DoubleDouble e = expm1(abs(x)), result = (e + e / (1 + e)) * 0.5;
	return x.high < 0.0 ? -result : result;
}

DoubleDouble cosh(DoubleDouble x)
{
	const DoubleDouble e = exp(abs(x));
	return (e + 1 / e) * 0.5;
}

DoubleDouble asinh(DoubleDouble x)
{
	const double y = std::asinh(x.high);
	if (!std::isfinite(y))
		return y;
	// One step of Newton's method for sinh(y) = x.
	return DoubleDouble(y) + (x - sinh(y)).high / std::hypot(1.0, x.high);
}

DoubleDouble atan2(DoubleDouble y, DoubleDouble x)
{
	const double angle = std::atan2(y.high, x.high);
	const SineAndCosine turn = sineAndCosine(angle);
	const double ahead = (x * turn.cosine + y * turn.sine).high;
	if (!(ahead > 0.0))
		return angle;
	return DoubleDouble(angle) + (y * turn.cosine - x * turn.sine).high / ahead;
}

SineAndCosine sineAndCosine(DoubleDouble x)
{
	if (!(std::abs(x.high) < 1e3)) {
		const double none = std::numeric_limits<double>::quiet_NaN();
		return {none, none};
	}
	const double quarters = std::round(x.high / (0.5 * kExtendedPi.high));
	const DoubleDouble y = x - kExtendedPi * (0.5 * quarters);
	const double step = std::round(y.high * kSteps);
	const SineAndCosine small = smallTurn(y - step / kSteps);
	const SineAndCosine& at = tables().turn[static_cast<std::size_t>(std::abs(step))];
	const DoubleDouble atSine = step < 0.0 ? -at.sine : at.sine;
	const DoubleDouble sine = atSine + (atSine * small.cosine + at.cosine * small.sine);
	const DoubleDouble cosine = at.cosine + (at.cosine * small.cosine - atSine * small.sine);
	switch (((static_cast<int>(quarters) % 4) + 4) % 4) {
	case 0:
		return {sine, cosine};
	case 1:
		return {cosine, -sine};
	case 2:
		return {-sine, -cosine};
	default:
		return {-cosine, sine};
	}
}

} // namespace ricci
