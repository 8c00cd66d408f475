// SPDX-License-Identifier: GPL-3.0-or-later
#include "double_double.h"

#include <array>
#include <cstddef>
#include <limits>

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

/// 2^(n / kSteps), from a table.
DoubleDouble powerOfTwo(int n)
{
	static const auto table = [] {
		std::array<DoubleDouble, kSteps> power;
		power[0] = 1;
		const DoubleDouble factor = 1 + series<false>(kExtendedLog2 / kSteps);
		for (std::size_t i = 1; i < kSteps; ++i)
			power[i] = power[i - 1] * factor;
		return power;
	}();
	const int index = ((n % kSteps) + kSteps) % kSteps;
	return scaled(table[static_cast<std::size_t>(index)], (n - index) / kSteps);
}

/// exp(i n / kSteps) for 0 <= n < kSteps, from a table.
const ExtendedComplex& turnBySteps(int n)
{
	static const auto table = [] {
		std::array<ExtendedComplex, kSteps> turn;
		turn[0] = 1.0;
		const DoubleDouble sine = series<true>(1.0 / kSteps);
		const DoubleDouble cosine = sqrt(1 - sine * sine);
		for (std::size_t i = 1; i < kSteps; ++i) {
			const ExtendedComplex& last = turn[i - 1];
			turn[i] = {
				last.real() * cosine - last.imag() * sine,
				last.imag() * cosine + last.real() * sine};
		}
		return turn;
	}();
	return table[static_cast<std::size_t>(n)];
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

/// exp(x) - \p less, for |x| below 700.
DoubleDouble expLess(DoubleDouble x, double less)
{
	const double step = std::round(x.high * (kSteps / kExtendedLog2.high));
	const DoubleDouble power = powerOfTwo(static_cast<int>(step));
	return (power - less) + power * smallExpm1(x - kExtendedLog2 * (step / kSteps));
}

/// exp(i x) - 1 for |x| below 1 / 64.
ExtendedComplex smallTurnLess1(DoubleDouble x)
{
	const double y = x.high * x.high;
	const double sine = -x.high * y / 6 * (1 - y / 20 * (1 - y / 42 * (1 - y / 72)));
	const double cosine = y * y / 24 * (1 - y / 30 * (1 - y / 56 * (1 - y / 90)));
	return {x * x * -0.5 + cosine, x + sine};
}

} // namespace

DoubleDouble exp(DoubleDouble x)
{
	if (!(std::abs(x.high) < 700.0)) // the range ends, or x is NaN
		return std::exp(x.high);
	return expLess(x, 0.0);
}

DoubleDouble expm1(DoubleDouble x)
{
	if (!(std::abs(x.high) < 700.0))
		return std::expm1(x.high);
	return expLess(x, 1.0);
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
	const ExtendedComplex turn = turnBy(angle);
	const double ahead = (x * turn.real() + y * turn.imag()).high;
	if (!(ahead > 0.0))
		return angle;
	return DoubleDouble(angle) + (y * turn.real() - x * turn.imag()).high / ahead;
}

ExtendedComplex turnBy(DoubleDouble x)
{
	if (!(std::abs(x.high) < 1e3)) {
		const double none = std::numeric_limits<double>::quiet_NaN();
		return {none, none};
	}
	const double quarters = std::round(x.high / (0.5 * kExtendedPi.high));
	const DoubleDouble y = x - kExtendedPi * (0.5 * quarters);
	const double step = std::round(y.high * kSteps);
	const ExtendedComplex small = smallTurnLess1(y - step / kSteps);
	const ExtendedComplex& at = turnBySteps(static_cast<int>(std::abs(step)));
	const DoubleDouble atSine = step < 0.0 ? -at.imag() : at.imag();
	const DoubleDouble sine = atSine + (atSine * small.real() + at.real() * small.imag());
	const DoubleDouble cosine = at.real() + (at.real() * small.real() - atSine * small.imag());
	switch (((static_cast<int>(quarters) % 4) + 4) % 4) {
	case 0:
		return {cosine, sine};
	case 1:
		return {-sine, cosine};
	case 2:
		return {-cosine, -sine};
	default:
		return {sine, -cosine};
	}
}

} // namespace ricci
