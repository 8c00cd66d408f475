// SPDX-License-Identifier: GPL-3.0-or-later
#include "map_check.h"

#include "../base/indexed.h"
#include "../base/numbers.h"
#include "../base/task.h"
#include "../charts/chart_overlap.h"
#include "../error.h"
#include "../numerics/disk_isometry.h"
#include "../numerics/double_double.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

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

/// The angle opposite to \p a, between \p b and \p c, and the error that the rounding of the three lengths may cause
/// in it. \p product: S(b) S(c)
std::pair<double, double>
angleOf(Background background, double a, double b, double c, double product)
{
	const double overB = 0.5 * excessOf(a, c, b), overC = 0.5 * excessOf(a, b, c);
	const double sine2 =
		lengthFunction(background, overC) * lengthFunction(background, overB) / product;
	if (!(overB > 0) || !(overC > 0) || !(sine2 < 1))
		return {sine2 < 1 ? 0.0 : kPi, kPi};
	const double sum = a + b + c;
	// sinh magnifies relative errors by l coth(l).
	const double growth = background == Background::EuclideanPlane ? 1.0 : 1.0 + sum;
	const double relative = kLengthRounding * (sum / overB + sum / overC + 2.0 * growth);
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
	return kLengthRounding * (1.0 + std::max(std::abs(ui), std::abs(uj))) * slope;
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
			const auto [angle, error] = angleOf(background, l[next], l[k], l[last], product);
			curvature[t.origin(h[k])] -= angle;
			rounding[t.origin(h[k])] += error;
		}
	}
	for (const Vertex v : t.vertices()) {
		if (std::isnan(target[v]))
			continue;
		const double error = std::abs(curvature[v] - target[v]) - rounding[v];
		if (!(error <= check.curvatureError))
			check.curvatureError = std::isnan(error) ? kInfinity : error;
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

namespace {

/// Over the longest side.
double heightOf(const Triangle2& p)
{
	double longest = 0.0;
	for (std::size_t k = 0; k < 3; ++k)
		longest = std::max(longest, distance(p[(k + 1) % 3], p[k]));
	return longest > 0.0 ? std::abs(doubledArea(p)) / longest : 0.0;
}

// In the disk, what cancels is computed exactly, the rest in double.

/// |p|^2.
DoubleDouble square(const Point2& p)
{
	return DoubleDouble::product(p[0], p[0]) + DoubleDouble::product(p[1], p[1]);
}

/// 1 - |p|^2.
double gap(const Point2& p)
{
	return static_cast<double>(1 - square(p));
}

/// Distance by which rounding may have moved \p p.
double rounding(const Point2& p)
{
	return 2 * kDiskRounding / std::max(gap(p), kDiskRounding);
}

double distanceOf(const Point2& p, const Point2& q)
{
	const double chord = std::hypot(p[0] - q[0], p[1] - q[1]);
	return 2 *
		   std::asinh(chord / std::sqrt(std::max(gap(p) * gap(q), kDiskRounding * kDiskRounding)));
}

/// det(X, Y, Z) of the points on the hyperboloid, X = (1 + |p|^2, 2 p) / (1 - |p|^2). X is
/// subtracted from Y and Z first, in terms of the differences of the points, which are exact where
/// these are near each other.
double determinant(const Point2& p, const Point2& q, const Point2& r)
{
	const auto difference = [&](const Point2& x, std::size_t k) {
		return DoubleDouble::sum(x[k], -p[k]);
	};
	const DoubleDouble ax = difference(q, 0), ay = difference(q, 1);
	const DoubleDouble bx = difference(r, 0), by = difference(r, 1);
	const DoubleDouble a0 = ax * DoubleDouble::sum(q[0], p[0]) + ay * DoubleDouble::sum(q[1], p[1]);
	const DoubleDouble b0 = bx * DoubleDouble::sum(r[0], p[0]) + by * DoubleDouble::sum(r[1], p[1]);
	const DoubleDouble minor = (1 + square(p)) * (ax * by - ay * bx) - p[0] * (a0 * by - ay * b0) +
							   p[1] * (a0 * bx - ax * b0);
	return 4.0 * static_cast<double>(minor) / (gap(p) * gap(q) * gap(r));
}

} // namespace

ChartCheck checkMap(const FlatMesh& chart, double tolerance)
{
	ChartCheck check;
	Box2 box;
	for (const Point2& p : chart.place) {
		check.outside += !(std::isfinite(p[0]) && std::isfinite(p[1]));
		box.add(p);
	}
	if (check.outside > 0 || chart.size() == 0)
		return check;
	const double extent = box.extent();
	const auto lengthOf = [&](Corner side) {
		return distance(chart.at(side), chart.at(side.next()));
	};
	for (const int f : chart.points.indices()) {
		const Triangle2 p = chart.at(f);
		check.flipped += orientation(p) <= 0 && heightOf(p) > tolerance * extent;
		for (const Corner side : cornersOf(f))
			if (const Corner other = chart.across[side]; other > side && extent > 0.0)
				check.seamGap =
					std::max(check.seamGap, std::abs(lengthOf(side) - lengthOf(other)) / extent);
	}
	return check;
}

ChartCheck checkDisk(const FlatMesh& chart, double tolerance)
{
	ChartCheck check;
	for (const Triangle& triangle : chart.points)
		for (const int point : triangle)
			check.outside += !(gap(chart.place[point]) > 0);
	if (check.outside > 0)
		return check;
	CornerArray<double> length(3 * chart.size()); // of the side
	for (const Corner side : length.indices())
		length[side] = distanceOf(chart.at(side), chart.at(side.next()));
	const auto roundingOf = [&](Corner side) {
		return rounding(chart.at(side)) + rounding(chart.at(side.next()));
	};
	for (const int f : chart.points.indices()) {
		checkpointNowAndThen(positionOf(f));
		const Triangle2 p = chart.at(f);
		double longest = 0.0, allowed = tolerance;
		for (const Corner side : cornersOf(f)) {
			longest = std::max(longest, length[side]);
			allowed += rounding(chart.at(side));
			if (const Corner other = chart.across[side]; other > side)
				check.seamGap = std::max(
					check.seamGap,
					std::abs(length[side] - length[other]) - roundingOf(side) - roundingOf(other));
		}
		const double det = determinant(p[0], p[1], p[2]);
		check.flipped += det <= 0 && -det > std::sinh(allowed) * std::sinh(longest);
	}
	return check;
}

void requireMap(const FlatMesh& chart, const FlowResult& flow, bool bent, bool seamsFit)
{
	const double tolerance = kCheckedGap + openCurvature(flow);
	const ChartCheck check = checkMap(chart, tolerance);
	if (check.outside > 0 || (seamsFit && !(check.seamGap <= tolerance)) ||
		(check.flipped > 0 && !bent))
		throw NotConverged(
			"seams " + numberText(check.seamGap, 3) + " of the chart apart, " +
			std::to_string(check.flipped) + " faces flipped");
}

void requireDisk(const FlatMesh& chart, const FlowResult& flow, bool bent)
{
	// The gap that an open angle leaves grows like sinh of the distance across the layout.
	double radius = 0.0;
	bool finite = true;
	for (const Point2& p : chart.place) {
		const double r = std::hypot(p[0], p[1]);
		finite = finite && std::isfinite(r);
		radius = std::max(radius, 2.0 * std::atanh(std::min(1.0, r)));
	}
	const double tolerance = kCheckedGap + openCurvature(flow) * std::sinh(2.0 * radius);
	const ChartCheck check = checkDisk(chart, tolerance);
	if (check.outside > 0 && finite) // the doubles of the disk end at a distance of about 37
		throw NotConverged(NotConverged::OutsideDisk, check.outside);
	if (check.outside > 0)
		throw NotConverged(std::to_string(check.outside) + " points lie outside the disk");
	if (!(check.seamGap <= tolerance) || (check.flipped > 0 && !bent))
		throw NotConverged(
			"seams " + numberText(check.seamGap, 3) + " apart in the disk, " +
			std::to_string(check.flipped) + " faces flipped");
}

namespace {

/// Coordinates rounded to float. \param step receives that of the largest one
Array<Point2> inFloats(Array<Point2> places, double& step)
{
	double largest = 0.0;
	for (Point2& p : places)
		for (double& x : p) {
			x = roundedToFloat(x);
			largest = std::max(largest, std::abs(x));
		}
	step = floatStep(largest);
	return places;
}

/// Edges of seams whose sides differ by more than kUnequalShare and the \p rounding of their four ends.
template<class Length, class Rounding>
int countUnequal(const FlatMesh& mesh, const Length& length, const Rounding& rounding)
{
	int count = 0;
	for (const Corner side : seams(mesh).sides) {
		const Corner other = mesh.across[side];
		const double own = length(side), across = length(other);
		const double allowed =
			rounding(side) + rounding(side.next()) + rounding(other) + rounding(other.next());
		count += std::abs(own - across) > std::max(kUnequalShare * std::max(own, across), allowed);
	}
	return count;
}

} // namespace

std::array<int, 2> overlapsInFloats(const FlatMesh& mesh)
{
	checkpoint();
	double step = 0.0;
	FlatMesh stored = mesh;
	stored.place = inFloats(std::move(stored.place), step);
	Array<Triangle2> corners = stored.corners();
	std::map<int, double> areas; // [chart]
	for (const int f : corners.indices())
		areas[stored.chart[f]] += doubledArea(corners[f]);
	areas[-1] = 0.0; // faces without area
	const auto isMirrored = [&](int f) { return areas[stored.chart[f]] < 0.0; };
	bool hasMirrored = false;
	for (const int f : corners.indices())
		if (isMirrored(f)) {
			hasMirrored = true;
			std::swap(corners[f][1], corners[f][2]);
		}
	const double touching = kTouchingSteps * step;
	const Array<char> overlaps = (hasMirrored ? OverlapSearch(std::move(corners), touching)
											  : OverlapSearch(stored, touching))
									 .overlapping();
	int faces = 0;
	std::set<int> charts;
	for (const int f : overlaps.indices())
		if (overlaps[f]) {
			++faces;
			charts.insert(stored.chart[f]);
		}
	return {faces, static_cast<int>(charts.size())};
}

int unequalSeams(const FlatMesh& mesh)
{
	double step = 0.0;
	const Array<Point2> stored = inFloats(mesh.place, step);
	const auto length = [&](Corner side) {
		return distance(stored[mesh.points[side]], stored[mesh.points[side.next()]]);
	};
	return countUnequal(mesh, length, [&](Corner) { return 0.25 * kTouchingSteps * step; });
}

int unequalSeamsInDisk(const Parametrization& map)
{
	double step = 0.0;
	const Array<Point2> stored = inFloats(map.mesh.place, step);
	const auto square = [&](Corner c) -> const Box2& {
		return map.charts[positionOf(map.mesh.chart[c.face()])].box;
	};
	const auto inDisk = [&](Corner c) {
		const Point2 fromCentre = stored[map.mesh.points[c]] - square(c).centre();
		return asComplex(fromCentre) / (0.5 * square(c).width());
	};
	const auto length = [&](Corner side) {
		return distanceInDisk(inDisk(side), inDisk(side.next()));
	};
	// The metric is 2 |dz| / (1 - |z|^2).
	const auto rounding = [&](Corner end) {
		const double moved = 0.25 * kTouchingSteps * step / (0.5 * square(end).width());
		return 2.0 * moved / std::max(1.0 - std::norm(inDisk(end)), 0.0);
	};
	return countUnequal(map.mesh, length, rounding);
}

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
				check.radiusError = std::isnan(error) ? kInfinity : error;
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
