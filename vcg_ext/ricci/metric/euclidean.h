// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_EUCLIDEAN_H
#define RICCI_EUCLIDEAN_H

#include <cmath>

namespace ricci {

/// Euclidean background geometry (Definition 3.1): what the flow needs to know of a circle and of
/// an edge. The struct Hyperbolic has the same members, so that the flow is written once.
///
/// Everything is a function of u (log-radius) and delta = I - 1 (inversive distance less one; no
/// cancellation for nearly tangent circles).
struct Euclidean
{
	/// A metric is determined up to one common scale: the Hessian maps constants to 0.
	static constexpr bool scaleInvariant = true;

	struct Circle
	{
		double radius;
		double s;     ///< factor of the length formula: the radius
		double kappa; ///< curvature of the circle: 1 / radius
	};

	/// u + \p low = ln radius (Eq. 6); \p low is at most a unit in the last place of \p u.
	static Circle circle(double u, double low = 0.0)
	{
		const double whole = std::exp(u), radius = whole + whole * low;
		return {radius, radius, 1 / radius};
	}

	struct Edge
	{
		double length;      ///< Eq. 4; NaN if the circles are nested (I < -1)
		double excess;      ///< length less the sum of the radii, without cancellation
		double sine2;       ///< square of the length function of the law of sines: length^2
		double cosineLess1; ///< cosh(length) - 1 in the hyperbolic plane; 0 here
	};

	/// Eq. 4 written with delta: l^2 = (gi + gj)^2 + 2 delta gi gj.
	static Edge edge(const Circle& i, const Circle& j, double delta)
	{
		const double sum = i.radius + j.radius, p = 2 * delta * i.radius * j.radius;
		const double length2 = sum * sum + p, length = std::sqrt(length2);
		return {length, p / (length + sum), length2, 0};
	}

	/// delta of an edge of length \p l between circles of radii \p gi, \p gj (Eq. 3 less one).
	static double delta(double l, double gi, double gj)
	{
		return (l - gi - gj) * (l + gi + gj) / (2.0 * gi * gj);
	}

	/// Length function of Heron's formula: the identity; sinh in the hyperbolic plane.
	static double heron(double x) { return x; }
};

} // namespace ricci

#endif
