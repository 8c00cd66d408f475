// SPDX-License-Identifier: GPL-3.0-or-later
// The formulas of both geometries, under the same names.
#ifndef RICCI_GEOMETRY_H
#define RICCI_GEOMETRY_H

#include <cmath>

namespace ricci {

/// An edge between two circles.
struct PackedEdge
{
	double length;      ///< Eq. 4; NaN if the circles are nested (I < -1)
	double excess;      ///< length less the sum of the radii, without cancellation
	double sine2;       ///< square of the function of the law of sines: length^2, or sinh^2(length)
	double cosineLess1; ///< cosh(length) - 1; 0 in the Euclidean plane
};

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

	/// Eq. 4 written with delta: l^2 = (gi + gj)^2 + 2 delta gi gj.
	static PackedEdge edge(const Circle& i, const Circle& j, double delta)
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

/// Hyperbolic background geometry of curvature -1, with the members of the struct Euclidean.
///
/// The derivative of the angle at i by u_j (Lemma 3.8) has one closed form in both backgrounds,
///   s_i^2 s_j^2 s_k [kappa_i (I_ik + I_ij I_jk) + kappa_j (I_jk + I_ij I_ik)
///                    - kappa_k (I_ij^2 - 1)] / (A S_ij^2),
/// with s = sinh(radius), kappa = coth(radius), S = sinh(length), and A the product of two sides' S
/// and the sine between them. It is Eq. 9 without its cancellations. Its geometric meaning, which
/// the paper leaves open, is the Euclidean one (Eq. 7): if the circles i, j, k and the circle
/// orthogonal to all three are seen as vectors of R^{3,1}, the bracket is proportional to the
/// height of the centre of that circle over the side ij, negative where the centre lies beyond the
/// side. The diagonal is minus the sum of the other entries, each weighted by cosh(length) instead
/// of 1, because larger triangles have more area and smaller angles: the Hessian is strictly
/// positive definite.
struct Hyperbolic
{
	/// Curvature -1 fixes the scale.
	static constexpr bool scaleInvariant = false;

	struct Circle
	{
		double radius;
		double s;                  ///< sinh(radius)
		double kappa;              ///< geodesic curvature of the circle: coth(radius)
		double sinhHalf, coshHalf; ///< of half the radius
	};

	/// u + \p low = ln tanh(radius / 2) < 0 (Eq. 6); \p low is at most a unit in the last place of
	/// \p u. Written so that small circles keep their relative accuracy. For u >= 0 no circle
	/// exists, and members of the result are infinite or NaN.
	static Circle circle(double u, double low = 0.0)
	{
		const double t = std::exp(u), less = -std::expm1(u); // tanh(radius / 2), and 1 less that
		const double gap = less * (1 + t);                   // 1 / cosh^2(radius / 2)
		const double s = 2 * t / gap, kappa = (1 + t * t) / (2 * t);
		const double coshHalf = 1 / std::sqrt(gap), sinhHalf = t * coshHalf;
		// The effect of low is added to first order: d radius / du = s, ds / du = s^2 kappa, d kappa / du = sinh(u) = -1 / s.
		return {
			std::log1p(2 * t / less) + s * low,
			s + s * s * kappa * low,
			kappa - low / s,
			sinhHalf + coshHalf * s * low / 2,
			coshHalf + sinhHalf * s * low / 2};
	}

	/// Eq. 4, cosh l = cosh gi cosh gj + I sinh gi sinh gj, written for half the length: with
	/// q = delta sinh gi sinh gj / 2 and S = sinh(l / 2),
	/// S^2 - sinh^2((gi + gj) / 2) = q = sinh((l - gi - gj) / 2) sinh((l + gi + gj) / 2).
	static PackedEdge edge(const Circle& i, const Circle& j, double delta)
	{
		const double q = delta * i.s * j.s / 2;
		const double sinhSum = i.sinhHalf * j.coshHalf + i.coshHalf * j.sinhHalf;
		const double coshSum = i.coshHalf * j.coshHalf + i.sinhHalf * j.sinhHalf;
		const double sine2 = sinhSum * sinhSum + q, cosine2 = 1 + sine2;
		const double sinhBoth = std::sqrt(sine2) * coshSum + std::sqrt(cosine2) * sinhSum;
		const double excess = 2 * std::asinh(q / sinhBoth);
		return {i.radius + j.radius + excess, excess, 4 * sine2 * cosine2, 2 * sine2};
	}

	/// delta of an edge of hyperbolic length \p l between circles of radii \p gi, \p gj (Eq. 3 less
	/// one).
	static double delta(double l, double gi, double gj)
	{
		return 2.0 * std::sinh(0.5 * (l - gi - gj)) * std::sinh(0.5 * (l + gi + gj)) /
			   (std::sinh(gi) * std::sinh(gj));
	}

	/// Length function of Heron's formula: sinh. The triangles of a mesh are small, where the
	/// series is exact to a double and several times faster than the library.
	static double heron(double x)
	{
		if (!(std::abs(x) < 0.25)) // below, x^12 / 13! < 1e-17
			return std::sinh(x);
		const double y = x * x;
		return x + x * y / 6 * (1 + y / 20 * (1 + y / 42 * (1 + y / 72 * (1 + y / 110))));
	}
};

} // namespace ricci

#endif
