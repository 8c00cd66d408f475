// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_EUCLIDEAN_H
#define RICCI_EUCLIDEAN_H

#include <cmath>

namespace ricci {

/// Euclidean background geometry (Definition 3.1): what the flow needs to know of a circle and of
/// an edge. HyperbolicGeometry has the same members, so that the flow is written once.
///
/// Everything is a function of u (log-radius) and delta = I - 1 (inversive distance less one; no
/// cancellation for nearly tangent circles), evaluated in the precision of \p T.
template<class T>
struct EuclideanGeometry
{
	using Real = T;

	/// A metric is determined up to one common scale: the Hessian maps constants to 0.
	static constexpr bool scaleInvariant = true;

	struct Circle
	{
		Real radius;
		Real s;     ///< factor of the length formula: the radius
		Real kappa; ///< curvature of the circle: 1 / radius
	};

	/// u + \p low = ln radius (Eq. 6); \p low is at most a unit in the last place of \p u.
	static Circle circle(double u, double low = 0.0)
	{
		using std::exp;
		const Real whole = exp(Real(u)), radius = whole + whole * Real(low);
		return {radius, radius, 1 / radius};
	}

	struct Edge
	{
		Real length;      ///< Eq. 4; NaN if the circles are nested (I < -1)
		Real excess;      ///< length less the sum of the radii, without cancellation
		Real sine2;       ///< square of the length function of the law of sines: length^2
		Real cosineLess1; ///< cosh(length) - 1 in the hyperbolic plane; 0 here
	};

	/// Eq. 4 written with delta: l^2 = (gi + gj)^2 + 2 delta gi gj.
	static Edge edge(const Circle& i, const Circle& j, double delta)
	{
		using std::sqrt;
		const Real sum = i.radius + j.radius, p = 2 * Real(delta) * i.radius * j.radius;
		const Real length2 = sum * sum + p, length = sqrt(length2);
		return {length, p / (length + sum), length2, 0};
	}

	/// delta of an edge of length \p l between circles of radii \p gi, \p gj (Eq. 3 less one).
	static double delta(double l, double gi, double gj)
	{
		return (l - gi - gj) * (l + gi + gj) / (2.0 * gi * gj);
	}

	/// Length function of Heron's formula: the identity; sinh in the hyperbolic plane.
	static double heron(Real x) { return static_cast<double>(x); }
};

using Euclidean = EuclideanGeometry<double>;

} // namespace ricci

#endif
