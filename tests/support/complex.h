// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_COMPLEX_H
#define RICCI_TESTS_COMPLEX_H

#include <ricci/math/points.h>

#include <complex>

namespace ricci::testing {

using Complex = std::complex<double>;

using ricci::asComplex;

} // namespace ricci::testing

#endif
