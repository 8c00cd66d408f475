// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TEST_WIDE_H
#define RICCI_TEST_WIDE_H

#include "ricci/math/extended_complex.h"

#include <complex>

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
