// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/numerics/double_double.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <string>

namespace ricci::testing {
namespace {

constexpr double kRounding = 0x1p-66; ///< of functions, relative
constexpr double kExact = 0x1p-100;   ///< of the four operations and roots

/// A decimal number, to the last place or two.
DoubleDouble number(const std::string& digits)
{
	DoubleDouble value, unit = 1;
	bool fraction = false;
	for (const char c : digits) {
		if (c == '.') {
			fraction = true;
			continue;
		}
		value = value * 10 + (c - '0');
		if (fraction)
			unit = unit * 10;
	}
	return value / unit;
}

double relative(DoubleDouble value, DoubleDouble wanted)
{
	return std::abs(static_cast<double>((value - wanted) / wanted));
}

/// Any two doubles of that size, with a low part.
DoubleDouble randomNumber(double low, double high, Random& random)
{
	const double x = random.real(low, high);
	return DoubleDouble::sum(x, 0x1p-54 * x * random.real(-1.0, 1.0));
}

/// A number with a sign, between 2^-exponent and 2^exponent.
DoubleDouble randomScale(double exponent, Random& random)
{
	const DoubleDouble x = randomNumber(0.5, 1.0, random);
	const double scale = std::exp2(std::floor(random.real(-exponent, exponent)));
	return x * (random.coin() ? scale : -scale);
}

/// Rest of a division of an integer in a double, which fmod gives exactly.
double modulo(double x, double divisor)
{
	const double rest = std::fmod(x, divisor);
	return rest < 0.0 ? rest + divisor : rest;
}

TEST(DoubleDouble, SumsAndProductsOfDoublesAreExact)
{
	Random random(1400);
	for (int i = 0; i < 20000; ++i) {
		// Of integers, which are compared by their rests of division by two primes.
		const double x = std::floor(random.real(-0x1p53, 0x1p53));
		const double y = std::floor(random.real(-0x1p53, 0x1p53) * std::exp2(-random.index(50)));
		const DoubleDouble sum = DoubleDouble::sum(x, y), product = DoubleDouble::product(x, y);
		for (const DoubleDouble& z : {sum, product}) {
			ASSERT_EQ(z.high + z.low, z.high);
		}
		for (const double prime : {67108859.0, 67108837.0}) { // below 2^26
			const double a = modulo(x, prime), b = modulo(y, prime);
			ASSERT_EQ(
				modulo(modulo(sum.high, prime) + modulo(sum.low, prime), prime),
				modulo(a + b, prime));
			ASSERT_EQ(
				modulo(modulo(product.high, prime) + modulo(product.low, prime), prime),
				modulo(a * b, prime));
		}
	}
}

TEST(DoubleDouble, ArithmeticIsThatOfAField)
{
	Random random(1401);
	for (int i = 0; i < 20000; ++i) {
		const DoubleDouble x = randomScale(60, random), y = randomScale(60, random);
		const DoubleDouble z = randomScale(60, random);
		EXPECT_LE(relative(x / y * y, x), kExact);
		EXPECT_LE(relative(sqrt(abs(x)) * sqrt(abs(x)), abs(x)), kExact);
		const double sizes = std::abs(x.high) + std::abs(y.high);
		EXPECT_LE(std::abs(((x + y) - y - x).high), kExact * sizes);
		EXPECT_LE(
			std::abs(((x + y) * z - (x * z + y * z)).high), kExact * sizes * std::abs(z.high));
		EXPECT_EQ(x - x, 0.0);
		EXPECT_EQ(x * 3, x * DoubleDouble(3));
		EXPECT_EQ(x<y, (y - x).high> 0.0);
		EXPECT_EQ(abs(x), abs(-x));
	}
	// A third and a tenth: the quotient's own digits are those of 3 x = 1 and 10 x = 1.
	EXPECT_LE(std::abs((DoubleDouble(1) / 3 * 3 - 1).high), kExact);
	EXPECT_LE(
		relative(sqrt(DoubleDouble(2)), number("1.41421356237309504880168872420969807857")),
		kExact);
}

TEST(DoubleDouble, ComparesByTheLowPartWhereTheHighOnesAreEqual)
{
	const DoubleDouble x(1.0, 0x1p-60), y(1.0, 0x1p-61);
	EXPECT_LT(y, x);
	EXPECT_GT(x, y);
	EXPECT_LE(y, x);
	EXPECT_GE(x, x);
	EXPECT_NE(x, y);
	EXPECT_EQ(static_cast<double>(x), 1.0);
}

TEST(DoubleDouble, FunctionsHaveTheirKnownValues)
{
	EXPECT_LE(relative(kExtendedPi, number("3.14159265358979323846264338327950288420")), kExact);
	EXPECT_LE(relative(kExtendedLog2, number("0.69314718055994530941723212145817656808")), kExact);
	const DoubleDouble small = 0x1p-10;
	const struct
	{
		DoubleDouble value;
		const char* digits;
	} known[] = {
		{exp(DoubleDouble(1)), "2.71828182845904523536028747135266249776"},
		{exp(DoubleDouble(-20)), "0.00000000206115362243855782796594038015582098"},
		{exp(DoubleDouble(-40)) * 1e10 * 1e10, "424.83542552915889953292347828586580179"},
		{expm1(small), "0.00097703949241653524284529261160650646585"},
		{sinh(DoubleDouble(1)), "1.17520119364380145688238185059560081516"},
		{sinh(small), "0.00097656265522043650406675150063853807332"},
		{cosh(DoubleDouble(1)), "1.54308063481524377847790562075706168260"},
		{asinh(DoubleDouble(1)), "0.88137358701954302523260932497979230903"},
		{atan2(DoubleDouble(1), DoubleDouble(2)), "0.46364760900080611621425623146121440203"},
		{turnBy(1.0).imag(), "0.84147098480789650665250232163029899962"},
		{turnBy(1.0).real(), "0.54030230586813971740093660744297660373"},
		{-turnBy(5.0).imag(), "0.95892427466313846889315440615599397335"},
		{turnBy(5.0).real(), "0.28366218546322626446663917151355730833"}};
	for (const auto& k : known)
		EXPECT_LE(relative(k.value, number(k.digits)), kRounding) << k.digits;
}

TEST(DoubleDouble, FunctionsAndTheirInversesFitTogether)
{
	Random random(1402);
	for (int i = 0; i < 20000; ++i) {
		const DoubleDouble x = randomNumber(-20.0, 20.0, random);
		const DoubleDouble small = randomScale(30, random) * 0x1p-30;
		EXPECT_LE(relative(exp(x) * exp(-x), 1), kRounding);
		const DoubleDouble large = x * 10; // its unit in the last place, too
		EXPECT_LE(relative(exp(large) * exp(-large), 1), kRounding);
		EXPECT_LE(relative(exp(-large - x) * exp(large), exp(-x)), kRounding);
		EXPECT_LE(relative(asinh(sinh(x)), x), 2 * kRounding);
		EXPECT_LE(relative(asinh(sinh(small)), small), 2 * kRounding);
		EXPECT_LE(relative((cosh(x) - sinh(x)) * exp(x), 1), kRounding * std::cosh(2 * x.high));
		const ExtendedComplex turn = turnBy(x), twice = turnBy(x * 2);
		EXPECT_LE(relative(turn.imag() * turn.imag() + turn.real() * turn.real(), 1), kRounding);
		EXPECT_LE(std::abs((2 * turn.imag() * turn.real() - twice.imag()).high), kRounding);
		const DoubleDouble angle = randomNumber(-3.14159, 3.14159, random);
		const ExtendedComplex at = turnBy(angle);
		const DoubleDouble radius = abs(randomScale(60, random));
		EXPECT_LE(relative(atan2(radius * at.imag(), radius * at.real()), angle), 2 * kRounding);
	}
	EXPECT_EQ(exp(DoubleDouble()), 1.0);
	EXPECT_EQ(expm1(DoubleDouble()), 0.0);
	EXPECT_EQ(sqrt(DoubleDouble()), 0.0);
	EXPECT_EQ(atan2(DoubleDouble(), DoubleDouble()), 0.0);
	const ExtendedComplex half = turnBy(kExtendedPi * 0.5);
	EXPECT_LE(std::abs(half.real().high), 0x1p-100);
	EXPECT_EQ(half.imag(), 1.0);
}

TEST(DoubleDouble, WhatIsNotANumberStaysSo)
{
	const double infinity = std::numeric_limits<double>::infinity();
	for (const double none : {infinity, std::numeric_limits<double>::quiet_NaN()}) {
		const DoubleDouble x = none;
		EXPECT_FALSE(isfinite(x));
		for (const DoubleDouble& y :
			 {x + 1, x * 2, x - x, 1 + expm1(x), asinh(x), turnBy(x).imag(), sqrt(-abs(x)), x / x})
			EXPECT_FALSE(isfinite(y));
		EXPECT_FALSE(x + 1 < 0.0);
	}
	EXPECT_FALSE(isfinite(DoubleDouble(1) / DoubleDouble()));
	EXPECT_FALSE(isfinite(sqrt(DoubleDouble(-1))));
	EXPECT_EQ(static_cast<double>(exp(DoubleDouble(-1e4))), 0.0);
	EXPECT_FALSE(isfinite(exp(DoubleDouble(1e4)) * 2));
}

TEST(ExtendedComplex, IsTheFieldOfComplexNumbers)
{
	Random random(1403);
	for (int i = 0; i < 5000; ++i) {
		const ExtendedComplex z(randomScale(20, random), randomScale(20, random));
		const ExtendedComplex w(randomScale(20, random), randomScale(20, random));
		const double size = static_cast<double>(abs(z));
		EXPECT_LE(static_cast<double>(abs(z / w * w - z)), kExact * size);
		EXPECT_LE(relative(abs(z * w), abs(z) * abs(w)), kExact);
		EXPECT_LE(relative(norm(z), (z * conj(z)).real()), kExact);
		EXPECT_LE(static_cast<double>(abs(polar(abs(z), arg(z)) - z)), 4 * kRounding * size);
		const auto rounded = std::complex<double>(z);
		EXPECT_EQ(rounded.real(), z.real().high);
		EXPECT_EQ(rounded.imag(), z.imag().high);
	}
}

} // namespace
} // namespace ricci::testing
