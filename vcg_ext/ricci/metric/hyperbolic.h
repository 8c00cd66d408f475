// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_HYPERBOLIC_H
#define RICCI_HYPERBOLIC_H

#include <cmath>

namespace ricci {

/// Hyperbolic background geometry of curvature -1, with the members of EuclideanGeometry.
///
/// The derivative of the angle at i by u_j (Lemma 3.8) has one closed form in both backgrounds,
///   s_i^2 s_j^2 s_k [kappa_i (I_ik + I_ij I_jk) + kappa_j (I_jk + I_ij I_ik)
///                    - kappa_k (I_ij^2 - 1)] / (A S_ij^2),
/// with s = sinh(radius), kappa = coth(radius), S = sinh(length), and A the product of two sides'
/// S and the sine between them. It is Eq. 9 without its cancellations, and the geometric meaning
/// that the paper leaves open is the Euclidean one (Eq. 7): with i, j, k and the circle orthogonal
/// to all three circles seen as vectors of R^{3,1}, the bracket is proportional to the height of
/// that circle's centre over the side ij, negative where the centre lies beyond the side. The
/// diagonal is minus the sum of the other entries weighted by cosh(length) instead of 1, because a
/// hyperbolic plane has area to gain: the Hessian is strictly positive definite.
template<class T>
struct HyperbolicGeometry
{
	using Real = T;

	/// Curvature -1 fixes the scale.
	static constexpr bool scaleInvariant = false;

	struct Circle
	{
		Real radius;
		Real s;     ///< sinh(radius)
		Real kappa; ///< geodesic curvature of the circle: coth(radius)
	};

	/// u + \p rest = ln tanh(radius / 2) < 0 (Eq. 6); \p rest is at most a unit in the last place of
	/// \p u. Written so that small circles keep their relative accuracy. For u >= 0 no circle exists,
	/// and everything that follows is not finite.
	static Circle circle(double u, double rest = 0.0)
	{
		using std::cosh, std::exp, std::expm1, std::log1p, std::sinh;
		const Real x = Real(u) + Real(rest);
		// x holds rest in the wider type alone; in double its effect is added to first order.
		const Real lost = Real(rest) - (x - Real(u));
		const Real s0 = -1 / sinh(x), kappa0 = cosh(x);
		// d radius / du = s, ds / du = s^2 kappa, d kappa / du = sinh(u) = -1 / s.
		const Real radius = log1p(2 * exp(x) / -expm1(x)) + s0 * lost;
		return {radius, s0 + s0 * s0 * kappa0 * lost, kappa0 - lost / s0};
	}

	struct Edge
	{
		Real length;      ///< Eq. 4
		Real excess;      ///< length less the sum of the radii, without cancellation
		Real sine2;       ///< sinh^2(length)
		Real cosineLess1; ///< cosh(length) - 1
	};

	/// Eq. 4, cosh l = cosh gi cosh gj + I sinh gi sinh gj, written for half the length:
	/// sinh^2(l / 2) = sinh^2((gi + gj) / 2) + delta sinh gi sinh gj / 2.
	static Edge edge(const Circle& i, const Circle& j, double delta)
	{
		using std::asinh, std::sinh, std::sqrt;
		const Real sum = i.radius + j.radius, q = Real(delta) * i.s * j.s / 2;
		const Real half = sinh(sum / 2), sine2 = half * half + q;
		const Real length = 2 * asinh(sqrt(sine2));
		const Real excess = 2 * asinh(q / sinh((length + sum) / 2));
		return {length, excess, 4 * sine2 * (1 + sine2), 2 * sine2};
	}

	/// delta of an edge of hyperbolic length \p l between circles of radii \p gi, \p gj (Eq. 3 less
	/// one).
	static double delta(double l, double gi, double gj)
	{
		return 2.0 * std::sinh(0.5 * (l - gi - gj)) * std::sinh(0.5 * (l + gi + gj)) /
			   (std::sinh(gi) * std::sinh(gj));
	}

	/// Length function of Heron's formula.
	static Real heron(Real x)
	{
		using std::sinh;
		return sinh(x);
	}
};

using Hyperbolic = HyperbolicGeometry<double>;

} // namespace ricci

#endif
