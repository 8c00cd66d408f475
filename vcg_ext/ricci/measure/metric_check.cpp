// SPDX-License-Identifier: GPL-3.0-or-later
#include "metric_check.h"

#include "../base/numbers.h"
#include "../base/task.h"
#include "../base/tolerances.h"
#include "../error.h"
#include "../numerics/double_double.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace ricci {

namespace {

// What cancels is computed exactly. The rest may round as doubles do: what is checked is allowed more.

double radiusOf(Background background, double u)
{
	return background == Background::EuclideanPlane ? std::exp(u) : 2.0 * std::atanh(std::exp(u));
}

double lengthFunction(Background background, double x)
{
	return background == Background::EuclideanPlane ? x : std::sinh(x);
}

/// Length of an edge by Eq. 4 with I = 1 + delta.
double lengthOf(Background background, double gi, double gj, double delta)
{
	const double half = lengthFunction(background, 0.5 * (gi - gj));
	const double product =
		0.5 * lengthFunction(background, gi) * lengthFunction(background, gj) * (2.0 + delta);
	const double root = std::sqrt(half * half + product);
	return 2.0 * (background == Background::EuclideanPlane ? root : std::asinh(root));
}

/// a + b - c
double excessOf(double a, double b, double c)
{
	return static_cast<double>(DoubleDouble::sum(a, b) - c);
}

/// An angle, and the error that the rounding of the three lengths may cause in it.
struct Angle
{
	double value, rounding;
};

/// The angle opposite to \p a, between \p b and \p c. \p product: S(b) S(c)
Angle angleOf(Background background, double a, double b, double c, double product)
{
	const double overB = 0.5 * excessOf(a, c, b), overC = 0.5 * excessOf(a, b, c);
	const double sine2 =
		lengthFunction(background, overC) * lengthFunction(background, overB) / product;
	if (!(overB > 0) || !(overC > 0) || !(sine2 < 1))
		return {sine2 < 1 ? 0.0 : kPi, kPi};
	const double sum = a + b + c;
	// sinh magnifies relative errors by l coth(l).
	const double growth = background == Background::EuclideanPlane ? 1.0 : 1.0 + sum;
	const double relative =
		kLengthRounding * kUnitRoundoff * (sum / overB + sum / overC + 2.0 * growth);
	const double tangent = std::sqrt(sine2 / (1.0 - sine2));
	return {
		2.0 * std::asin(std::sqrt(sine2)), std::min(relative * tangent, 2.0 * std::sqrt(relative))};
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
	const CurvatureMap& metric,
	const VertexVector& u,
	const EdgeArray<double>& lengths,
	const VertexVector& target)
{
	const Triangulation& t = metric.triangulation();
	MetricCheck check;
	VertexArray<double> radius(t.vertexCount());
	for (const Vertex v : t.vertices())
		radius[v] = radiusOf(background, u[v]);
	EdgeArray<double> ofLength(t.edgeCount());
	for (const Edge e : t.edges()) {
		checkpointNowAndThen(positionOf(e));
		ofLength[e] = lengthFunction(background, lengths[e]);
		const Vertex i = t.origin(e.halfedge()), j = t.target(e.halfedge());
		const double ui = u[i], uj = u[j];
		const double wanted = lengthOf(background, radius[i], radius[j], metric.delta()[e]);
		const double explained = explainedError(background, ui, uj);
		const double difference = std::abs(lengths[e] - wanted) / wanted;
		if (!(difference <= explained)) // NaN counts
			check.lengthError = std::isfinite(difference)
									? std::max(check.lengthError, difference - explained)
									: kInfinity;
	}

	const VertexArray<char> boundary = t.boundaryVertices();
	VertexArray<double> curvature(t.vertexCount()), rounding(t.vertexCount(), 0.0);
	for (const Vertex v : t.vertices())
		curvature[v] = boundary[v] ? kPi : 2.0 * kPi;
	for (const Face f : t.faces()) {
		checkpointNowAndThen(positionOf(f));
		const std::array<Halfedge, 3> h = t.halfedges(f);
		std::array<double, 3> l;
		for (std::size_t k = 0; k < 3; ++k)
			l[k] = lengths[h[k].edge()];
		std::array<double, 3> sorted = l;
		std::sort(sorted.begin(), sorted.end());
		check.broken += !(excessOf(sorted[0], sorted[1], sorted[2]) > 0);
		for (std::size_t k = 0; k < 3; ++k) {
			const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
			const double product = ofLength[h[k].edge()] * ofLength[h[last].edge()];
			const Angle angle = angleOf(background, l[next], l[k], l[last], product);
			curvature[t.origin(h[k])] -= angle.value;
			rounding[t.origin(h[k])] += angle.rounding;
		}
	}
	for (const Vertex v : t.vertices()) {
		if (std::isnan(target[v]))
			continue;
		const double error = std::abs(curvature[v] - target[v]) - rounding[v];
		if (!(error <= check.curvatureError)) {
			check.curvatureError = std::isnan(error) ? kInfinity : error;
			check.vertex = v;
		}
	}
	return check;
}

void requireMetric(const FlowResult& flow, const VertexArray<char>& boundary)
{
	const CurvatureMap& metric = *flow.metric;
	VertexVector target = VertexVector::Constant(
		metric.triangulation().vertexCount(), std::numeric_limits<double>::quiet_NaN());
	for (const Vertex v : flow.target.curvature.indices())
		if (!flow.target.fixed[v])
			target[v] = flow.target.curvature[v] * (flow.doubled && boundary[v] ? 2.0 : 1.0);
	const MetricCheck check =
		checkMetric(flow.target.background, metric, flow.u, metric.lengths(), target);
	// On the boundary of a double the residual counts twice.
	const bool exact =
		check.lengthError <= kTiny && check.curvatureError <= 2.0 * flow.residual + kMaxFloor;
	if (exact && check.broken > 0)
		throw NotConverged(NotConverged::FlatTriangles, static_cast<std::size_t>(check.broken));
	if (!exact)
		throw NotConverged(
			"curvature " + numberText(check.curvatureError, 3) + " off at one vertex, lengths " +
			numberText(check.lengthError, 3) + ", " + std::to_string(check.broken) +
			" broken triangles");
}

double openCurvature(const FlowResult& flow)
{
	double sum = 0.0;
	for (const Vertex v : flow.target.curvature.indices())
		if (!flow.target.fixed[v])
			sum += std::abs(flow.curvature[v] - flow.target.curvature[v]);
	return sum;
}

} // namespace ricci
