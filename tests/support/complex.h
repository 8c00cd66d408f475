// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_COMPLEX_H
#define RICCI_TESTS_COMPLEX_H

#include <ricci/layout/planar_layout.h>

#include <complex>

namespace ricci::testing {

using Complex = std::complex<double>;

inline Complex asComplex(const Point2& p)
{
	return {p[0], p[1]};
}

} // namespace ricci::testing

#endif
