// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_DOUBLE_DOUBLE_H
#define RICCI_DOUBLE_DOUBLE_H

#include "../base/numbers.h"

#include <cfloat>
#include <cmath>
#include <complex>

namespace ricci {

static_assert(
	FLT_EVAL_METHOD == 0,
	"double must not be evaluated in a wider type: 32-bit x86 needs -msse2 -mfpmath=sse");
#if defined(__FAST_MATH__)
#error "-ffast-math would undo the exact sums of DoubleDouble"
#endif

/// x y - p for the rounded product p, exactly: by a fused multiplication where that is an instruction, else
/// by halves.
inline double roundingOfProduct(double x, double y, double p)
{
#if defined(FP_FAST_FMA) || defined(__FMA__) || defined(__AVX2__) || defined(__aarch64__) ||       \
	defined(_M_ARM64)
	return std::fma(x, y, -p);
#else
	constexpr double kSplit = 134217729.0; // 2^27 + 1
	const double bigX = kSplit * x, bigY = kSplit * y;
	const double x1 = bigX - (bigX - x), x2 = x - x1, y1 = bigY - (bigY - y), y2 = y - y1;
	return ((x1 * y1 - p) + x1 * y2 + x2 * y1) + x2 * y2;
#endif
}

/// The unevaluated sum of two doubles, \p low at most half a unit in the last place of \p high: a
/// precision of 106 bits on every platform, where long double has 53, 64 or 113 [Dekker 1971].
/// Relative error of a product, quotient and root: 2^-101. Error of a sum: 2^-104 (|x| + |y|)
/// [Joldes Muller Popescu 2017]. The range is that of double; beyond 1e300 and below 1e-290 the low
/// part is lost. What is not finite becomes NaN.
struct DoubleDouble
{
	double high = 0.0, low = 0.0;

	constexpr DoubleDouble() = default;
	constexpr DoubleDouble(double x) : high(x) {}
	/// x + y, where |y| is at most half a unit in the last place of \p x.
	constexpr DoubleDouble(double x, double y) : high(x), low(y) {}

	/// The nearest double.
	explicit constexpr operator double() const { return high; }

	/// x + y, exactly.
	static DoubleDouble sum(double x, double y)
	{
		const double s = x + y, part = s - x;
		return {s, (x - (s - part)) + (y - part)};
	}

	/// The same where |x| >= |y|, or x is 0.
	static DoubleDouble orderedSum(double x, double y)
	{
		const double s = x + y;
		return {s, y - (s - x)};
	}

	/// x y, exactly.
	static DoubleDouble product(double x, double y)
	{
		const double p = x * y;
		return {p, roundingOfProduct(x, y, p)};
	}

	friend DoubleDouble operator-(DoubleDouble x) { return {-x.high, -x.low}; }

	friend DoubleDouble operator+(DoubleDouble x, DoubleDouble y)
	{
		const DoubleDouble s = sum(x.high, y.high);
		return orderedSum(s.high, s.low + (x.low + y.low));
	}

	friend DoubleDouble operator-(DoubleDouble x, DoubleDouble y) { return x + -y; }

	friend DoubleDouble operator*(DoubleDouble x, DoubleDouble y)
	{
		const DoubleDouble p = product(x.high, y.high);
		return orderedSum(p.high, p.low + (x.high * y.low + x.low * y.high));
	}

	friend DoubleDouble operator*(DoubleDouble x, double y)
	{
		const DoubleDouble p = product(x.high, y);
		return orderedSum(p.high, p.low + x.low * y);
	}

	friend DoubleDouble operator*(double x, DoubleDouble y) { return y * x; }

	friend DoubleDouble operator/(DoubleDouble x, DoubleDouble y)
	{
		const double q = x.high / y.high;
		return orderedSum(q, (x - y * q).high / y.high);
	}

	DoubleDouble& operator+=(DoubleDouble x) { return *this = *this + x; }
	DoubleDouble& operator-=(DoubleDouble x) { return *this = *this - x; }
	DoubleDouble& operator*=(DoubleDouble x) { return *this = *this * x; }
	DoubleDouble& operator/=(DoubleDouble x) { return *this = *this / x; }

	friend bool operator==(DoubleDouble x, DoubleDouble y)
	{
		return x.high == y.high && x.low == y.low;
	}
	friend bool operator!=(DoubleDouble x, DoubleDouble y) { return !(x == y); }
	friend bool operator<(DoubleDouble x, DoubleDouble y)
	{
		return x.high < y.high || (x.high == y.high && x.low < y.low);
	}
	friend bool operator>(DoubleDouble x, DoubleDouble y) { return y < x; }
	friend bool operator<=(DoubleDouble x, DoubleDouble y) { return x < y || x == y; }
	friend bool operator>=(DoubleDouble x, DoubleDouble y) { return y < x || x == y; }
};

/// pi, log(2).
constexpr DoubleDouble kExtendedPi{kPi, kPiLow};
constexpr DoubleDouble kExtendedLog2{6.931471805599452862e-01, 2.319046813846299558e-17};

inline DoubleDouble abs(DoubleDouble x)
{
	return x.high < 0.0 ? -x : x;
}

inline bool isfinite(DoubleDouble x)
{
	return std::isfinite(x.high) && std::isfinite(x.low);
}

inline DoubleDouble sqrt(DoubleDouble x)
{
	const double root = std::sqrt(x.high);
	if (!(root > 0.0))
		return root; // 0, or NaN
	return DoubleDouble::orderedSum(
		root, (x - DoubleDouble::product(root, root)).high / (2.0 * root));
}

/// The functions of <cmath>, with a relative error of 2^-67.
DoubleDouble exp(DoubleDouble x);
DoubleDouble expm1(DoubleDouble x);
DoubleDouble sinh(DoubleDouble x);
DoubleDouble cosh(DoubleDouble x);
DoubleDouble asinh(DoubleDouble x);
DoubleDouble atan2(DoubleDouble y, DoubleDouble x);

/// A complex number in extended precision, with the functions of std::complex, which is not specified
/// for such types.
class ExtendedComplex
{
public:
	constexpr ExtendedComplex() = default;
	constexpr ExtendedComplex(double real) : m_real(real) {}
	constexpr ExtendedComplex(DoubleDouble real, DoubleDouble imag = 0.0) :
			m_real(real), m_imag(imag)
	{
	}
	constexpr ExtendedComplex(std::complex<double> z) : m_real(z.real()), m_imag(z.imag()) {}

	explicit operator std::complex<double>() const
	{
		return {static_cast<double>(m_real), static_cast<double>(m_imag)};
	}

	constexpr DoubleDouble real() const { return m_real; }
	constexpr DoubleDouble imag() const { return m_imag; }

	friend ExtendedComplex operator-(const ExtendedComplex& z) { return {-z.m_real, -z.m_imag}; }

	friend ExtendedComplex operator+(const ExtendedComplex& z, const ExtendedComplex& w)
	{
		return {z.m_real + w.m_real, z.m_imag + w.m_imag};
	}

	friend ExtendedComplex operator-(const ExtendedComplex& z, const ExtendedComplex& w)
	{
		return {z.m_real - w.m_real, z.m_imag - w.m_imag};
	}

	friend ExtendedComplex operator*(const ExtendedComplex& z, const ExtendedComplex& w)
	{
		return {
			z.m_real * w.m_real - z.m_imag * w.m_imag, z.m_real * w.m_imag + z.m_imag * w.m_real};
	}

	friend ExtendedComplex operator*(DoubleDouble x, const ExtendedComplex& z)
	{
		return {x * z.m_real, x * z.m_imag};
	}

	friend ExtendedComplex operator*(double x, const ExtendedComplex& z)
	{
		return {x * z.m_real, x * z.m_imag};
	}

	friend ExtendedComplex operator/(const ExtendedComplex& z, DoubleDouble x)
	{
		return {z.m_real / x, z.m_imag / x};
	}

	friend ExtendedComplex operator/(const ExtendedComplex& z, const ExtendedComplex& w)
	{
		return z * conj(w) / norm(w);
	}

	ExtendedComplex& operator+=(const ExtendedComplex& z) { return *this = *this + z; }

	friend bool operator==(const ExtendedComplex& z, const ExtendedComplex& w)
	{
		return z.m_real == w.m_real && z.m_imag == w.m_imag;
	}

	friend ExtendedComplex conj(const ExtendedComplex& z) { return {z.m_real, -z.m_imag}; }

	/// The square of the absolute value.
	friend DoubleDouble norm(const ExtendedComplex& z)
	{
		return z.m_real * z.m_real + z.m_imag * z.m_imag;
	}

	friend DoubleDouble abs(const ExtendedComplex& z) { return sqrt(norm(z)); }

	friend DoubleDouble arg(const ExtendedComplex& z) { return atan2(z.m_imag, z.m_real); }

private:
	DoubleDouble m_real, m_imag;
};

/// exp(i \p angle), for angles below 1e3, with an absolute error of 2^-67 of its two parts.
ExtendedComplex turnBy(DoubleDouble angle);

/// The complex number \p r exp(i \p angle), as std::polar.
inline ExtendedComplex polar(DoubleDouble r, DoubleDouble angle)
{
	const ExtendedComplex turn = turnBy(angle);
	return {r * turn.real(), r * turn.imag()};
}

} // namespace ricci

#endif
