// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TEST_WIDE_H
#define RICCI_TEST_WIDE_H

#include "ricci/numerics/double_double.h"

#include <cmath>
#include <complex>
#include <limits>

/// Leaves out a test whose reference needs more digits than double has, where long double has no more
/// (MSVC, Apple silicon).
#define RICCI_NEEDS_WIDE_LONG_DOUBLE()                                                             \
	if (std::numeric_limits<long double>::digits <= std::numeric_limits<double>::digits)           \
	GTEST_SKIP() << "long double, in which the reference is computed, is double here"

namespace ricci::testing {

/// Extended numbers in the arithmetic that tests compare with.
inline long double wide(DoubleDouble x)
{
	return static_cast<long double>(x.high) + x.low;
}

inline std::complex<long double> wide(const ExtendedComplex& z)
{
	return {wide(z.real()), wide(z.imag())};
}

using WideComplex = std::complex<long double>;

/// Hyperbolic distance of two points of the Poincaré disk.
inline long double distanceInDisk(WideComplex z, WideComplex w)
{
	return 2 * std::atanh(std::abs((z - w) / (1.0L - std::conj(w) * z)));
}

/// Angle at p of the geodesic triangle pqr, in [0, pi].
inline long double angleInDisk(WideComplex p, WideComplex q, WideComplex r)
{
	const auto seen = [&](WideComplex z) { return (z - p) / (1.0L - std::conj(p) * z); };
	return std::abs(std::arg(seen(r) / seen(q)));
}

} // namespace ricci::testing

#endif
