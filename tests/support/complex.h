// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_COMPLEX_H
#define RICCI_TESTS_COMPLEX_H

#include <ricci/base/points.h>

#include <complex>

namespace ricci::testing {

using Complex = std::complex<double>;

using ricci::asComplex;

/// A point of the unit sphere seen in the plane from its north pole, and back.
inline Complex inPlane(const Point3& p)
{
	return Complex(p[0], p[1]) / (1.0 - p[2]);
}

inline Point3 onSphere(Complex z)
{
	const double s = std::norm(z);
	return {2 * z.real() / (1 + s), 2 * z.imag() / (1 + s), (s - 1) / (1 + s)};
}

inline Complex crossRatio(const Point3& p, const Point3& q, const Point3& r, const Point3& s)
{
	const Complex a = inPlane(p), b = inPlane(q), c = inPlane(r), d = inPlane(s);
	return (a - c) * (b - d) / ((a - d) * (b - c));
}

} // namespace ricci::testing

#endif
