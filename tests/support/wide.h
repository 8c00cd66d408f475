// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TEST_WIDE_H
#define RICCI_TEST_WIDE_H

#include "ricci/numerics/double_double.h"

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

} // namespace ricci::testing

#endif
