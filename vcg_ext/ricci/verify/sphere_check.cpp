// SPDX-License-Identifier: GPL-3.0-or-later
#include "sphere_check.h"

#include "../base/indexed.h"
#include "../base/numbers.h"
#include "../base/tolerances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace ricci {

namespace {

using Real = long double;
using Vector = std::array<Real, 3>;

Real dot(const Vector& a, const Vector& b)
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector cross(const Vector& a, const Vector& b)
{
	return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

} // namespace

SphereCheck checkSphere(const std::vector<Triangle>& triangles, const std::vector<Point3>& sphere)
{
	SphereCheck check;
	Real sum = 0;
	for (const Triangle& t : triangles) {
		std::array<Vector, 3> p;
		for (std::size_t k = 0; k < 3; ++k) {
			const Point3& point = sphere[positionOf(t[k])];
			p[k] = {Real(point[0]), Real(point[1]), Real(point[2])};
			const Real norm = std::sqrt(dot(p[k], p[k]));
			const auto error = static_cast<double>(std::abs(norm - 1));
			if (!(error <= check.radiusError))
				check.radiusError =
					std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
			for (Real& x : p[k])
				x /= norm;
		}
		const Real det = dot(p[0], cross(p[1], p[2]));
		sum += 2 * std::atan2(det, 1 + dot(p[0], p[1]) + dot(p[1], p[2]) + dot(p[2], p[0]));
		check.turned += det < -kSphereRounding;
	}
	check.degree = static_cast<double>(sum / (4 * kLongPi));
	return check;
}

} // namespace ricci
