// SPDX-License-Identifier: GPL-3.0-or-later
// The Poincaré disk in extended precision.
#ifndef RICCI_TESTS_DISK_H
#define RICCI_TESTS_DISK_H

#include <cmath>
#include <complex>

namespace ricci::testing {

using WideComplex = std::complex<long double>;

/// Hyperbolic distance of two points.
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
