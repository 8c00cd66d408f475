// SPDX-License-Identifier: GPL-3.0-or-later
#include "metric_check.h"

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

/// An angle, and the error that the rounding of the three lengths may cause in it.
struct Angle
{
	Real value, rounding;
};

/// The angle opposite to \p a, between \p b and \p c. \p product: S(b) S(c)
Angle angleOf(Background background, Real a, Real b, Real c, Real product)
{
	const Real overB = (a + c - b) / 2, overC = (a + b - c) / 2;
	const Real sine2 =
		lengthFunction(background, overC) * lengthFunction(background, overB) / product;
	if (!(overB > 0) || !(overC > 0) || !(sine2 < 1))
		return {sine2 < 1 ? Real(0) : kLongPi, kLongPi};
	const Real sum = a + b + c;
	// sinh magnifies relative errors by l coth(l).
	const Real growth = background == Background::EuclideanPlane ? 1 : 1 + sum;
	const Real relative =
		kLengthRounding * kUnitRoundoff * (sum / overB + sum / overC + 2 * growth);
	const Real tangent = std::sqrt(sine2 / (1 - sine2));
	return {2 * std::asin(std::sqrt(sine2)), std::min(relative * tangent, 2 * std::sqrt(relative))};
}

/// Relative error of a length that the rounding of \p ui and \p uj explains. A unit in the last
/// place of u is a relative one of a radius; in the hyperbolic plane a large circle (u near 0)
/// magnifies it.
double explainedError(Background background, double ui, double uj)
{
	const double slope = background == Background::EuclideanPlane
							 ? 1.0
							 : std::max({1.0, -1.0 / std::sinh(ui), -1.0 / std::sinh(uj)});
	return kLengthRounding * kUnitRoundoff * (1.0 + std::max(std::abs(ui), std::abs(uj))) * slope;
}

} // namespace

MetricCheck checkMetric(
	Background background,
	const Triangulation& t,
	const EdgeArray<double>& delta,
	const VertexVector& u,
	const EdgeArray<double>& lengths,
	const VertexVector& target,
	const Tick& tick)
{
	MetricCheck check;
	VertexArray<Real> radius(t.vertexCount());
	for (const Vertex v : t.vertices())
		radius[v] = radiusOf(background, u[v]);
	EdgeArray<Real> ofLength(t.edgeCount());
	for (const Edge e : t.edges()) {
		tickNowAndThen(tick, positionOf(e));
		ofLength[e] = lengthFunction(background, lengths[e]);
		const Vertex i = t.origin(e.halfedge()), j = t.target(e.halfedge());
		const double ui = u[i], uj = u[j];
		const Real wanted = lengthOf(background, radius[i], radius[j], delta[e]);
		const double explained = explainedError(background, ui, uj);
		const auto difference = static_cast<double>(std::abs(Real(lengths[e]) - wanted) / wanted);
		if (!(difference <= explained)) // NaN counts
			check.lengthError = std::isfinite(difference)
									? std::max(check.lengthError, difference - explained)
									: std::numeric_limits<double>::infinity();
	}

	const VertexArray<char> boundary = t.boundaryVertices();
	VertexArray<Real> curvature(t.vertexCount()), rounding(t.vertexCount(), 0);
	for (const Vertex v : t.vertices())
		curvature[v] = boundary[v] ? kLongPi : 2 * kLongPi;
	for (const Face f : t.faces()) {
		tickNowAndThen(tick, positionOf(f));
		const std::array<Halfedge, 3> h = t.halfedges(f);
		std::array<Real, 3> l;
		for (std::size_t k = 0; k < 3; ++k)
			l[k] = lengths[h[k].edge()];
		check.broken += !(2 * std::max({l[0], l[1], l[2]}) < l[0] + l[1] + l[2]);
		for (std::size_t k = 0; k < 3; ++k) {
			const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
			const Real product = ofLength[h[k].edge()] * ofLength[h[last].edge()];
			const Angle angle = angleOf(background, l[next], l[k], l[last], product);
			curvature[t.origin(h[k])] -= angle.value;
			rounding[t.origin(h[k])] += angle.rounding;
		}
	}
	for (const Vertex v : t.vertices()) {
		if (std::isnan(target[v]))
			continue;
		const auto error = static_cast<double>(std::abs(curvature[v] - target[v]) - rounding[v]);
		if (!(error <= check.curvatureError)) {
			check.curvatureError =
				std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
			check.vertex = v;
		}
	}
	return check;
}

} // namespace ricci
