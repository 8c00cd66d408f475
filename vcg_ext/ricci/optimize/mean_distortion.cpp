// SPDX-License-Identifier: GPL-3.0-or-later
#include "mean_distortion.h"

#include "../base/numbers.h"
#include "../base/parallel.h"
#include "../base/points.h"
#include "../base/tolerances.h"
#include "../metric/area.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ricci {

namespace {

using Complex = std::complex<double>;

/// Parts of the three means in the weights.
constexpr double kVertexPart = 0.8, kAreaPart = 0.15, kFacePart = 0.05;

/// The root of |mu|^2 has no derivative at 0; that of |mu|^2 + kSmoothing, which is the same up to
/// a dilatation of 1.002, has.
constexpr double kSmoothing = 1e-6;

/// The stiffness of a triangle that does not count, in place of its weight: the Laplacian needs some.
constexpr double kUncountedStiffness = 1e-4;

/// See MeanDistortion::stiffness().
constexpr double kMaxBend = 4.0;

/// Products by parts: those of std::complex look for infinities behind every result.
Complex product(Complex a, Complex b)
{
	return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

Complex conjugateProduct(Complex a, Complex b) // conj(a) b
{
	return {a.real() * b.real() + a.imag() * b.imag(), a.real() * b.imag() - a.imag() * b.real()};
}

/// A triangle with its first corner at 0, its longest side scaled to about 1.
struct PlacedTriangle
{
	Complex second, third;
	double scale;
	double area; ///< positive if counter-clockwise

	/// By its sides, from the first corner on.
	explicit PlacedTriangle(const std::array<double, 3>& sides) :
			scale(*std::max_element(sides.begin(), sides.end()))
	{
		const double a = sides[0] / scale, b = sides[1] / scale, c = sides[2] / scale;
		area = euclideanArea({a, b, c});
		second = a;
		third = {0.5 * (a + (c - b) * (c + b) / a), 2.0 * area / a};
	}

	/// As it lies in the plane.
	explicit PlacedTriangle(const Triangle2& corners) :
			second(asComplex(corners[1] - corners[0])), third(asComplex(corners[2] - corners[0])),
			scale(std::max({std::abs(second), std::abs(third), std::abs(third - second)}))
	{
		second /= scale;
		third /= scale;
		area = 0.5 * conjugateProduct(second, third).imag();
	}

	/// Reflected, with the second and the third corner exchanged.
	PlacedTriangle reflected() const
	{
		PlacedTriangle other = *this;
		other.second = std::conj(third);
		other.third = std::conj(second);
		return other;
	}

	bool hasShape() const
	{
		return area > 0.5 * kMinIntrinsicHeight && second != 0.0 && std::isfinite(scale);
	}
};

Point2 centreOf(const Array<Point2>& points)
{
	Point2 centre{0.0, 0.0};
	for (const Point2& p : points)
		for (std::size_t k = 0; k < 2; ++k)
			centre[k] += p[k] / static_cast<double>(points.size());
	return centre;
}

int farthestFrom(const Point2& from, const Array<Point2>& points)
{
	int farthest = 0;
	for (const int p : points.indices())
		if (distance(from, points[p]) > distance(from, points[farthest]))
			farthest = p;
	return farthest;
}

/// The vertices of a flat mesh in the order of a walk (see NumberedPoints).
std::vector<int> walk(const FlatMesh& flat)
{
	const Point2 centre = centreOf(flat.place);
	const int count = flat.vertexCount();
	Array<double> reach(count, -1.0); // from the centre
	for (int c = 0; c < 3 * flat.points.size(); ++c) {
		double& known = reach[flat.vertices[Corner(c)]];
		known = std::max(known, distance(centre, flat.place[flat.points[Corner(c)]]));
	}
	const auto isBefore = [&](int a, int b) {
		return reach[a] != reach[b] ? reach[a] > reach[b] : a < b;
	};
	const Adjacency<int, int> neighbours(count, [&](const auto& add) {
		for (const Triangle& t : flat.vertices)
			for (std::size_t k = 0; k < 3; ++k) {
				add(t[k], t[(k + 1) % 3]);
				add(t[k], t[(k + 2) % 3]);
			}
	});
	std::vector<int> walk;
	Array<char> seen(count, 0);
	const auto visit = [&](int v) {
		if (!seen[v])
			walk.push_back(v);
		seen[v] = 1;
	};
	int farthest = 0;
	for (int v = 1; v < count; ++v)
		if (isBefore(v, farthest))
			farthest = v;
	visit(farthest);
	for (std::size_t i = 0; i < walk.size(); ++i) {
		const std::size_t first = walk.size();
		for (const int next : neighbours[walk[i]])
			visit(next);
		std::sort(walk.begin() + static_cast<std::ptrdiff_t>(first), walk.end(), isBefore);
	}
	return walk;
}

} // namespace

NumberedPoints::NumberedPoints(const FlatMesh& flat, const PointGroups& groups) :
		number(flat.place.size(), -1)
{
	const int count = number.size();
	Array<char> fixed = groups.fixed, stays(count);
	if (std::find(fixed.begin(), fixed.end(), 1) == fixed.end()) {
		const int first = farthestFrom(centreOf(flat.place), flat.place);
		for (const int p : {first, farthestFrom(flat.place[first], flat.place)})
			fixed[groups.group[p]] = 1;
	}
	for (const int p : stays.indices())
		stays[p] = fixed[groups.group[p]];
	Array<int> firstAt(flat.vertexCount(), -1); // [vertex] first point of a group that moves
	for (int c = 0; c < 3 * flat.points.size(); ++c)
		if (const int p = flat.points[Corner(c)]; !stays[p] && groups.first[groups.group[p]] == p)
			firstAt[flat.vertices[Corner(c)]] = p;
	if (std::find(stays.begin(), stays.end(), 0) != stays.end())
		for (const int v : walk(flat))
			if (firstAt[v] >= 0)
				number[firstAt[v]] = unknowns++;
	moving = unknowns;
	for (const int p : number.indices())
		if (!stays[p] && number[p] < 0)
			number[p] = moving++;
	int next = moving;
	for (int& n : number)
		if (n < 0)
			n = next++;
	unknown.assign(count, -1);
	turn.assign(count, 1.0);
	for (const int p : number.indices())
		if (!stays[p]) {
			unknown[number[p]] = number[groups.first[groups.group[p]]];
			turn[number[p]] = groups.turn[p];
		}
}

MeanDistortion::MeanDistortion(
	const FlatMesh& flat, const PointGroups& groups, bool countsFlipped) :
		m_points(flat, groups),
		m_shape(flat.points.size()), m_corners(flat.points.size()),
		m_energy(flat.points.size(), 0.0), m_stiffness(flat.points.size(), 0.0),
		m_pull(flat.points.size())
{
	Array<int> side(flat.points.size()); // 0: it does not count
	for (const int f : side.indices()) {
		side[f] = orientation(flat.at(f));
		if (side[f] < 0 && !countsFlipped)
			side[f] = 0;
		for (std::size_t k = 0; k < 3; ++k)
			m_corners[f][k] = m_points.number[flat.points[f][k]];
		if (side[f] < 0)
			std::swap(m_corners[f][1], m_corners[f][2]);
	}
	setShapes(flat, side);
	m_cornersOf = Adjacency<int, Corner>(m_points.moving, [&](const auto& add) {
		for (int c = 0; c < 3 * m_corners.size(); ++c)
			if (const int p = m_corners[Corner(c)]; p < m_points.moving)
				add(p, Corner(c));
	});
}

void MeanDistortion::setShapes(const FlatMesh& flat, const Array<int>& side)
{
	Array<double> area(flat.points.size(), 0.0), ring(flat.vertexCount(), 0.0);
	double total = 0.0;
	for (const int f : area.indices()) {
		Triangle2 corners = flat.at(f);
		if (side[f] < 0)
			std::swap(corners[1], corners[2]);
		PlacedTriangle placed(flat.lengths[f]);
		if (placed.hasShape()) {
			area[f] = placed.area * placed.scale * placed.scale;
			total += area[f];
			for (const int v : flat.vertices[f])
				ring[v] += area[f];
			if (side[f] < 0)
				placed = placed.reflected();
		}
		else
			placed = PlacedTriangle(corners);
		const Complex over(0.0, 0.25 / placed.area);
		m_shape[f] = {-over * placed.third, over * placed.second, 0.0};
	}
	const auto vertices = static_cast<double>(
		std::count_if(ring.begin(), ring.end(), [](double a) { return a > 0.0; }));
	for (const int f : area.indices()) {
		if (side[f] == 0)
			continue;
		double& weight = m_shape[f].weight = kFacePart / size();
		if (!(area[f] > 0.0))
			continue;
		weight += kAreaPart * area[f] / total;
		for (const int v : flat.vertices[f])
			weight += kVertexPart * area[f] / (ring[v] * vertices);
	}
}

/// With s = kSmoothing, m^2 = (|f_zbar|^2 / |f_z|^2 + s) / (1 + s) < 1 and k = K - 1 = 2 m / (1 -
/// m), dE / d|f_zbar|^2 = weight 5/4 k^(1/4) / ((1 - m)^2 m (1 + s) |f_z|^2), and dE / d|f_z|^2 is
/// -|f_zbar|^2 / |f_z|^2 times that.
void MeanDistortion::evaluate(int f, const Eigen::VectorXcd& position)
{
	const Triangle& corners = m_corners[f];
	const Complex origin = position[corners[0]];
	const Complex e1 = position[corners[1]] - origin, e2 = position[corners[2]] - origin;
	const Shape& s = m_shape[f];
	if (s.weight == 0.0) {
		const double square = std::norm(s.first * e1 + s.second * e2) +
							  std::norm(std::conj(s.first) * e1 + std::conj(s.second) * e2);
		m_energy[f] = 0.0;
		m_stiffness[f] =
			kUncountedStiffness / (size() * (square + std::numeric_limits<double>::min()));
		m_pull[f] = {};
		return;
	}
	const double left = e1.real() * e2.imag(), right = e1.imag() * e2.real();
	m_energy[f] = kInfinity;
	// What is far from 0 for its terms, and for underflow, has the right sign, see orientation().
	if (!(left - right > 4.0 * kUnitRoundoff * (std::abs(left) + std::abs(right)) +
							 std::numeric_limits<double>::min()) &&
		orientation(
			asPoint(origin), asPoint(position[corners[1]]), asPoint(position[corners[2]])) != 1)
		return;
	// The four sums that f_zbar, f_z and the quotient of the areas are made of.
	const double rr = s.first.real() * e1.real() + s.second.real() * e2.real();
	const double ii = s.first.imag() * e1.imag() + s.second.imag() * e2.imag();
	const double ri = s.first.real() * e1.imag() + s.second.real() * e2.imag();
	const double ir = s.first.imag() * e1.real() + s.second.imag() * e2.real();
	const Complex fzbar(rr - ii, ri + ir), fz(rr + ii, ri - ir);
	const double square = std::norm(fz), muSquare = std::norm(fzbar) / square;
	const double m = std::sqrt((muSquare + kSmoothing) / (1.0 + kSmoothing));
	const double gap =
		4.0 * (rr * ii - ri * ir) / square / ((1.0 + kSmoothing) * (1.0 + m)); // 1 - m
	if (!(gap > 0.0))
		return;
	const double k = 2.0 * m / gap, fourthRoot = std::sqrt(std::sqrt(k));
	m_energy[f] = s.weight * k * fourthRoot;
	const double stiffness =
		1.25 * s.weight * fourthRoot / (gap * gap * m * (1.0 + kSmoothing) * square);
	m_stiffness[f] = stiffness;
	const Complex byFzbar = stiffness * fzbar, byFz = (stiffness * muSquare) * fz;
	m_pull[f] = {
		conjugateProduct(s.first, byFzbar) - product(s.first, byFz),
		conjugateProduct(s.second, byFzbar) - product(s.second, byFz)};
}

double MeanDistortion::evaluate(const Eigen::VectorXcd& position)
{
	inParallel(size(), defaultThreads(), [&](int first, int last) {
		for (int f = first; f < last; ++f)
			evaluate(f, position);
	});
	double sum = 0.0; // in the same order with any number of threads
	for (const double energy : m_energy)
		sum += energy;
	return sum;
}

/// By k = K - 1 = (E / weight)^(4/5), 1 / (1 - m) = 1 + k / 2. The second derivative of k^(5/4) by m is
/// that of the square times (2 m + 1/4) / (1 - m), and f_z, which falls, may double it: from m = 0 to 1,
/// (1 - m)^(-3/2), and in the end 4 / (1 - m), is of that size.
double MeanDistortion::stiffness(int f) const
{
	const double weight = m_shape[f].weight;
	if (weight == 0.0)
		return m_stiffness[f];
	const double over = 1.0 + 0.5 * std::pow(m_energy[f] / weight, 0.8);
	return m_stiffness[f] * over * std::min(std::sqrt(over), kMaxBend);
}

/// dE / d conj(point).
MeanDistortion::Complex MeanDistortion::pull(int point) const
{
	Complex sum = 0.0;
	for (const Corner corner : m_cornersOf[point]) {
		const std::array<Complex, 2>& pull = m_pull[corner.face()];
		sum += corner.index() == 0 ? -(pull[0] + pull[1]) : pull[corner.index() - 1];
	}
	return sum;
}

void MeanDistortion::gradient(Eigen::VectorXcd& gradient) const
{
	gradient.resize(m_points.unknowns);
	inParallel(m_points.unknowns, defaultThreads(), [&](int first, int last) {
		for (int i = first; i < last; ++i)
			gradient[i] = pull(i);
	});
	for (int i = m_points.unknowns; i < m_points.moving; ++i)
		gradient[m_points.unknown[i]] += conjugateProduct(m_points.turn[i], pull(i));
}

} // namespace ricci
