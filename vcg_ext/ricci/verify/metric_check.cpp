// SPDX-License-Identifier: GPL-3.0-or-later
#include "metric_check.h"

#include "../numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ricci {

namespace {

using Real = long double;

constexpr double kUnit = std::numeric_limits<double>::epsilon();

constexpr Real kExactPi = 3.14159265358979323846264338327950288L;

/// Units of rounding that one operation of the flow may have left in a length.
constexpr double kLengthRounding = 16.0;

Real radiusOf(Background background, double u)
{
	return background == Background::EuclideanPlane ? std::exp(Real(u))
													: 2 * std::atanh(std::exp(Real(u)));
}

Real lengthFunction(Background background, Real x)
{
	return background == Background::EuclideanPlane ? x : std::sinh(x);
}

/// Length of an edge by Eq. 4 with I = 1 + delta.
Real lengthOf(Background background, Real gi, Real gj, double delta)
{
	const Real half = lengthFunction(background, (gi - gj) / 2);
	const Real product =
		lengthFunction(background, gi) * lengthFunction(background, gj) * (2 + Real(delta)) / 2;
	const Real root = std::sqrt(half * half + product);
	return 2 * (background == Background::EuclideanPlane ? root : std::asinh(root));
}

/// An angle, and what rounding of the three lengths may make of it.
struct Angle
{
	Real value, rounding;
};

/// Opposite to \p a, between \p b and \p c.
Angle angleOf(Background background, Real a, Real b, Real c)
{
	const Real overB = (a + c - b) / 2, overC = (a + b - c) / 2;
	const Real product = lengthFunction(background, b) * lengthFunction(background, c);
	const Real sine2 =
		lengthFunction(background, overC) * lengthFunction(background, overB) / product;
	if (!(overB > 0) || !(overC > 0) || !(sine2 < 1))
		return {sine2 < 1 ? Real(0) : kExactPi, kExactPi};
	const Real sum = a + b + c;
	// sinh magnifies relative errors by l coth(l).
	const Real growth = background == Background::EuclideanPlane ? 1 : 1 + sum;
	const Real relative = kLengthRounding * kUnit * (sum / overB + sum / overC + 2 * growth);
	const Real tangent = std::sqrt(sine2 / (1 - sine2));
	return {2 * std::asin(std::sqrt(sine2)), std::min(relative * tangent, 2 * std::sqrt(relative))};
}

} // namespace

MetricCheck checkMetric(
	Background background,
	const Triangulation& t,
	const std::vector<double>& delta,
	const Eigen::VectorXd& u,
	const std::vector<double>& lengths,
	const Eigen::VectorXd& target)
{
	MetricCheck check;
	for (int e = 0; e < t.edgeCount(); ++e) {
		const double ui = u[t.origin(2 * e)], uj = u[t.target(2 * e)];
		const Real wanted =
			lengthOf(background, radiusOf(background, ui), radiusOf(background, uj), delta[at(e)]);
		// A unit in the last place of u is that much, relative, of a radius. In the hyperbolic plane
		// a large circle (u near 0) magnifies it.
		const double slope = background == Background::EuclideanPlane
								 ? 1.0
								 : std::max({1.0, -1.0 / std::sinh(ui), -1.0 / std::sinh(uj)});
		const double rounding =
			kLengthRounding * kUnit * (1.0 + std::max(std::abs(ui), std::abs(uj))) * slope;
		const auto difference =
			static_cast<double>(std::abs(Real(lengths[at(e)]) - wanted) / wanted);
		if (!(difference <= rounding)) // NaN counts
			check.lengthError = std::isfinite(difference)
									? std::max(check.lengthError, difference - rounding)
									: std::numeric_limits<double>::infinity();
	}

	const std::vector<char> boundary = t.boundaryVertices();
	std::vector<Real> curvature(at(t.vertexCount())), rounding(at(t.vertexCount()), 0);
	for (std::size_t v = 0; v < curvature.size(); ++v)
		curvature[v] = boundary[v] ? kExactPi : 2 * kExactPi;
	for (int f = 0; f < t.faceCount(); ++f) {
		const std::array<int, 3> h = t.halfedges(f);
		std::array<Real, 3> l;
		for (std::size_t k = 0; k < 3; ++k)
			l[k] = lengths[at(Triangulation::edge(h[k]))];
		check.broken += !(2 * std::max({l[0], l[1], l[2]}) < l[0] + l[1] + l[2]);
		for (std::size_t k = 0; k < 3; ++k) {
			const Angle angle = angleOf(background, l[(k + 1) % 3], l[k], l[(k + 2) % 3]);
			curvature[at(t.origin(h[k]))] -= angle.value;
			rounding[at(t.origin(h[k]))] += angle.rounding;
		}
	}
	for (std::size_t v = 0; v < curvature.size(); ++v) {
		const double wanted = target[static_cast<Eigen::Index>(v)];
		if (std::isnan(wanted))
			continue;
		const auto error = static_cast<double>(std::abs(curvature[v] - wanted) - rounding[v]);
		if (!(error <= check.curvatureError)) {
			check.curvatureError =
				std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
			check.vertex = static_cast<int>(v);
		}
	}
	return check;
}

} // namespace ricci
