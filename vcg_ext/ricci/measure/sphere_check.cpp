// SPDX-License-Identifier: GPL-3.0-or-later
#include "sphere_check.h"

#include "../base/indexed.h"
#include "../base/numbers.h"
#include "../base/tolerances.h"
#include "../numerics/double_double.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace ricci {

namespace {

// What cancels is computed exactly, the rest in double.

DoubleDouble exactDot(const Point3& a, const Point3& b)
{
	DoubleDouble sum;
	for (std::size_t k = 0; k < 3; ++k)
		sum += DoubleDouble::product(a[k], b[k]);
	return sum;
}

double determinant(const Point3& a, const Point3& b, const Point3& c)
{
	DoubleDouble sum;
	for (std::size_t k = 0; k < 3; ++k) {
		const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
		sum += (DoubleDouble::product(b[i], c[j]) - DoubleDouble::product(b[j], c[i])) * a[k];
	}
	return static_cast<double>(sum);
}

} // namespace

SphereCheck checkSphere(const std::vector<Triangle>& triangles, const std::vector<Point3>& sphere)
{
	SphereCheck check;
	DoubleDouble sum;
	for (const Triangle& t : triangles) {
		std::array<Point3, 3> p;
		std::array<double, 3> norm;
		for (std::size_t k = 0; k < 3; ++k) {
			p[k] = sphere[positionOf(t[k])];
			const DoubleDouble square = exactDot(p[k], p[k]);
			norm[k] = std::sqrt(static_cast<double>(square));
			const double error = std::abs(static_cast<double>(square - 1)) / (norm[k] + 1.0);
			if (!(error <= check.radiusError))
				check.radiusError =
					std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
		}
		const double size = norm[0] * norm[1] * norm[2], det = determinant(p[0], p[1], p[2]);
		double cosines = size;
		for (std::size_t k = 0; k < 3; ++k)
			cosines += norm[k] * static_cast<double>(exactDot(p[(k + 1) % 3], p[(k + 2) % 3]));
		sum += 2.0 * std::atan2(det, cosines);
		check.turned += det < -kSphereRounding * size;
	}
	check.degree = static_cast<double>(sum) / (4.0 * kPi);
	return check;
}

} // namespace ricci
