// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_POINTS_H
#define RICCI_POINTS_H

#include "indexed.h"
#include "numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

namespace ricci {

using Point2 = std::array<double, 2>;
using Point3 = std::array<double, 3>;

/// Corners of a triangle in the plane.
using Triangle2 = std::array<Point2, 3>;

// Points as vectors.

inline Point2 operator+(const Point2& a, const Point2& b)
{
	return {a[0] + b[0], a[1] + b[1]};
}
inline Point2 operator-(const Point2& a, const Point2& b)
{
	return {a[0] - b[0], a[1] - b[1]};
}
inline Point2 operator*(double s, const Point2& a)
{
	return {s * a[0], s * a[1]};
}
inline Point2& operator+=(Point2& a, const Point2& b)
{
	return a = a + b;
}
inline Point2& operator-=(Point2& a, const Point2& b)
{
	return a = a - b;
}
inline Point2& operator*=(Point2& a, double s)
{
	return a = s * a;
}
inline double dot(const Point2& a, const Point2& b)
{
	return a[0] * b[0] + a[1] * b[1];
}
/// Of the parallelogram: positive if b is to the left of a.
inline double cross(const Point2& a, const Point2& b)
{
	return a[0] * b[1] - a[1] * b[0];
}
inline double length(const Point2& a)
{
	return std::hypot(a[0], a[1]);
}

inline Point3 operator+(const Point3& a, const Point3& b)
{
	return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point3 operator-(const Point3& a, const Point3& b)
{
	return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point3 operator*(double s, const Point3& a)
{
	return {s * a[0], s * a[1], s * a[2]};
}
inline Point3 operator/(const Point3& a, double s)
{
	return {a[0] / s, a[1] / s, a[2] / s};
}
inline Point3& operator+=(Point3& a, const Point3& b)
{
	return a = a + b;
}
inline double dot(const Point3& a, const Point3& b)
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point3 cross(const Point3& a, const Point3& b)
{
	return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double distance(const Point2& a, const Point2& b)
{
	return length(a - b);
}

/// Of three, std::hypot underflows in some libraries.
inline double length(const Point3& a)
{
	const double size = std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
	const Point3 unit = a / (size > 0.0 ? size : 1.0);
	return size * std::sqrt(dot(unit, unit));
}

inline double distance(const Point3& a, const Point3& b)
{
	return length(a - b);
}

/// Points sorted along a line that is parallel to nothing in particular, where few lie near any of them.
class PointsOnLine
{
public:
	/// \param points must outlive the object
	explicit PointsOnLine(const std::vector<Point3>& points);

	/// Calls \p visit(number of a point, its distance) for those within \p radius of a place, and for some others.
	template<class Visit>
	void visitNear(const Point3& place, double radius, const Visit& visit) const
	{
		const double at = along(place), reach = 2.0 * radius; // with room for rounding
		for (auto i = std::lower_bound(m_line.begin(), m_line.end(), std::pair(at - reach, 0));
			 i != m_line.end() && i->first <= at + reach;
			 ++i)
			visit(i->second, distance(m_points[positionOf(i->second)], place));
	}

private:
	static double along(const Point3& p) { return dot({0.5773, 0.2113, 0.7887}, p); }

	const std::vector<Point3>& m_points;
	std::vector<std::pair<double, int>> m_line;
};

/// Area of a flat triangle with these sides, by Heron's formula in the order of operations of [Kahan
/// 2014]; 0 where they break the triangle inequality.
double euclideanArea(const std::array<double, 3>& sides);

/// Area of one triangle of curvature -1 (pi less its angles) from its sides a, b, c and s, half
/// their sum, by the hyperbolic form of L'Huilier's formula:
///
///   tan^2(area / 4) = tanh(s / 2) tanh((s - a) / 2) tanh((s - b) / 2) tanh((s - c) / 2).
///
/// 0 where the sides break the triangle inequality.
double hyperbolicArea(const std::array<double, 3>& sides);

/// Where the point of the segment ab that is nearest to p lies: 0 at a, 1 at b; 0 where a = b.
inline double nearestOnSegment(const Point2& a, const Point2& b, const Point2& p)
{
	const Point2 d = b - a;
	const double square = dot(d, d);
	return square > 0.0 ? std::clamp(dot(p - a, d) / square, 0.0, 1.0) : 0.0;
}

/// a at share 0, b at 1, and the points of their line between.
inline Point2 between(const Point2& a, const Point2& b, double share)
{
	return a + share * (b - a);
}

/// Twice the area of the triangle abc as rounding finds it, positive if counter-clockwise. Its sign
/// is certain only from orientation().
inline double doubledArea(const Point2& a, const Point2& b, const Point2& c)
{
	return cross(b - a, c - a);
}
inline double doubledArea(const Triangle2& t)
{
	return doubledArea(t[0], t[1], t[2]);
}

inline std::complex<double> asComplex(const Point2& p)
{
	return {p[0], p[1]};
}

/// A triangle by its shape: its corners are at 0, \p base > 0 and \p apex, whose imaginary part is not negative.
struct TriangleShape
{
	double base = 1.0;
	std::complex<double> apex;

	double area() const { return 0.5 * base * apex.imag(); }
	double longestSide() const { return std::max({base, std::abs(apex), std::abs(apex - base)}); }
};

inline Point2 asPoint(std::complex<double> z)
{
	return {z.real(), z.imag()};
}

/// Smallest box along the axes round the points that were added.
struct Box2
{
	Point2 min{kInfinity, kInfinity};
	Point2 max{-kInfinity, -kInfinity};

	void add(const Point2& p)
	{
		for (std::size_t k = 0; k < 2; ++k) {
			min[k] = std::min(min[k], p[k]);
			max[k] = std::max(max[k], p[k]);
		}
	}
	void add(const Box2& box)
	{
		for (std::size_t k = 0; k < 2; ++k) {
			min[k] = std::min(min[k], box.min[k]);
			max[k] = std::max(max[k], box.max[k]);
		}
	}
	/// Whether the boxes have inner points in common.
	bool meets(const Box2& box) const
	{
		return min[0] < box.max[0] && box.min[0] < max[0] && min[1] < box.max[1] &&
			   box.min[1] < max[1];
	}
	bool contains(const Point2& p) const
	{
		return min[0] <= p[0] && p[0] <= max[0] && min[1] <= p[1] && p[1] <= max[1];
	}
	Point2 centre() const { return {(min[0] + max[0]) / 2, (min[1] + max[1]) / 2}; }
	double width() const { return max[0] - min[0]; }
	double height() const { return max[1] - min[1]; }
	double area() const { return width() * height(); }
	/// The longer side.
	double extent() const { return std::max(width(), height()); }
};

template<class Points>
Box2 boxAround(const Points& points)
{
	Box2 box;
	for (const Point2& p : points)
		box.add(p);
	return box;
}

/// Takes p to turn p + shift: a rotation and a translation where the absolute value of turn is 1.
struct Motion
{
	std::complex<double> turn = 1.0, shift = 0.0;

	Point2 operator()(const Point2& p) const
	{
		return {
			turn.real() * p[0] - turn.imag() * p[1] + shift.real(),
			turn.imag() * p[0] + turn.real() * p[1] + shift.imag()};
	}
	Triangle2 operator()(const Triangle2& p) const
	{
		return {(*this)(p[0]), (*this)(p[1]), (*this)(p[2])};
	}
	/// \pre a rotation and a translation
	Motion inverse() const { return {std::conj(turn), -std::conj(turn) * shift}; }
	/// First \p first.
	Motion after(const Motion& first) const
	{
		return {turn * first.turn, turn * first.shift + shift};
	}
};

/// Sign of the oriented area of the triangle abc: 1 counter-clockwise, -1 clockwise, 0 collinear.
///
/// Exact for the coordinates as given, by a floating-point filter and expansions behind it
/// [Shewchuk 1997], within the range of double: no absolute value is above 1e153, where products
/// overflow, and no product of two coordinates other than 0 is below 2^-970 (1e-292), where its
/// rounding error underflows. Underflow changes the doubled area by less than 2e-323, so that the
/// sign still holds for every triangle with a doubled area above that.
int orientation(const Point2& a, const Point2& b, const Point2& c);
inline int orientation(const Triangle2& t)
{
	return orientation(t[0], t[1], t[2]);
}

} // namespace ricci

#endif
