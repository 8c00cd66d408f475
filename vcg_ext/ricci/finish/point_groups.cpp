// SPDX-License-Identifier: GPL-3.0-or-later
#include "point_groups.h"

#include "../base/tolerances.h"
#include "../math/adjacency.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace ricci {

namespace {

using Complex = std::complex<double>;

/// Rounding of a coordinate, relative to the extent.
constexpr double kCoordinateRounding = 8 * kUnitRoundoff;

/// Copies whose turn is less certain do not move.
constexpr double kMaxTurnError = 1e-6;

/// z -> turn z + something.
struct PlaneMotion
{
	Complex turn{1.0, 0.0};

	PlaneMotion inverse() const { return {std::conj(turn)}; }
	friend PlaneMotion operator*(const PlaneMotion& p, const PlaneMotion& q)
	{
		return {p.turn * q.turn / std::abs(p.turn * q.turn)};
	}
	Complex derivative(Complex) const { return turn; }
	void keep(PointGroups&) const {}

	static double length(Complex a, Complex b) { return std::abs(b - a); }

	/// Takes the side ab to cd, of the same length.
	PlaneMotion() = default;
	PlaneMotion(Complex t) : turn(t) {}
	PlaneMotion(Complex a, Complex b, Complex c, Complex d) :
			turn((d - c) * std::conj(b - a) / (std::abs(d - c) * std::abs(b - a)))
	{
	}
};

struct DiskMotion
{
	ExtendedIsometry isometry;

	DiskMotion inverse() const { return {isometry.inverse()}; }
	friend DiskMotion operator*(const DiskMotion& p, const DiskMotion& q)
	{
		return {(p.isometry * q.isometry).normalised()};
	}
	Complex derivative(Complex z) const
	{
		using Extended = ExtendedIsometry::Complex;
		const Extended root = conj(isometry.b) * Extended(z) + conj(isometry.a);
		return Complex(Extended(1) / (root * root));
	}
	void keep(PointGroups& groups) const { groups.isometry.push_back(rounded(isometry)); }

	static double length(Complex a, Complex b) { return chordLength(a, b); }

	DiskMotion() = default;
	DiskMotion(const ExtendedIsometry& i) : isometry(i) {}
	DiskMotion(Complex a, Complex b, Complex c, Complex d)
	{
		using Extended = ExtendedIsometry::Complex;
		const auto from = ExtendedIsometry::translationTo(Extended(a));
		const auto to = ExtendedIsometry::translationTo(Extended(c));
		const Extended x = from.inverse()(Extended(b)), y = to.inverse()(Extended(d));
		isometry = (to * ExtendedIsometry::rotation(arg(y) - arg(x)) * from.inverse()).normalised();
	}
};

/// Another copy of a point, and what takes the point to it, as a side of the seam tells.
template<class Motion>
struct Copy
{
	int point;
	Motion motion;
	double error; ///< that the derivative may have by rounding; more than 1 where nothing is told
};

/// Groups the copies of the seam vertices.
template<class Motion>
class CopyGroups
{
public:
	CopyGroups(const FlatMesh& flat, const std::function<bool(int)>& boundaryMoves) :
			m_points(flat.place), m_fixed(flat.place.size(), 0), m_inside(flat.place.size(), 1)
	{
		Box2 box;
		for (const Point2& p : m_points)
			box.add(p);
		const double rounding = kCoordinateRounding * box.extent();
		std::vector<std::pair<int, Copy<Motion>>> copies;
		forEdges(sidesByEdge(flat), [&](const FlatSide* side, int count) {
			if (isInside(side, count))
				return;
			for (int i = 0; i < count; ++i)
				m_inside[side[i].atLow] = m_inside[side[i].atHigh] = 0;
			if (count != 2) {
				for (int i = 0; i < count; ++i) {
					fixUnless(count == 1 && boundaryMoves(side[i].low), side[i].atLow);
					fixUnless(count == 1 && boundaryMoves(side[i].high), side[i].atHigh);
				}
				return;
			}
			const auto place = [&](int p) { return asComplex(m_points[p]); };
			const Complex a = place(side[0].atLow), b = place(side[0].atHigh);
			const Complex c = place(side[1].atLow), d = place(side[1].atHigh);
			const double first = Motion::length(a, b), second = Motion::length(c, d);
			const double error =
				rounding / std::max(std::min(std::abs(b - a), std::abs(d - c)), rounding);
			if (!(std::abs(first - second) <= (kSeamMatch + error) * (first + second))) {
				for (int i = 0; i < 2; ++i)
					m_fixed[side[i].atLow] = m_fixed[side[i].atHigh] = 1;
				return;
			}
			const Motion motion = error < 1.0 ? Motion(a, b, c, d) : Motion();
			const auto join = [&](int from, int to) {
				copies.push_back({from, {to, motion, error}});
				copies.push_back({to, {from, motion.inverse(), error}});
			};
			join(side[0].atLow, side[1].atLow);
			join(side[0].atHigh, side[1].atHigh);
		});
		// The longest sides are followed first.
		std::stable_sort(copies.begin(), copies.end(), [](const auto& x, const auto& y) {
			return x.second.error < y.second.error;
		});
		m_copies = Adjacency<int, Copy<Motion>>(flat.place.size(), [&](const auto& add) {
			for (const auto& [point, copy] : copies)
				add(point, copy);
		});
	}

	PointGroups groups() const
	{
		PointGroups result;
		const int count = m_points.size();
		result.group.assign(count, -1);
		result.turn.assign(count, 1.0);
		result.inside = m_inside;
		Array<Motion> motion(count); // from the first point of the group
		Array<double> error(count, 0.0);
		std::vector<int> members;
		for (int first = 0; first < count; ++first) {
			if (result.group[first] >= 0)
				continue;
			const Complex place = asComplex(m_points[first]);
			const int group = result.first.size();
			bool fixed = false;
			members.assign(1, first);
			result.group[first] = group;
			for (std::size_t i = 0; i < members.size(); ++i) {
				const int p = members[i];
				fixed = fixed || m_fixed[p];
				for (const Copy<Motion>& copy : m_copies[p]) {
					const Motion next = copy.motion * motion[p];
					const Complex turn = next.derivative(place);
					if (result.group[copy.point] < 0) {
						result.group[copy.point] = group;
						result.turn[copy.point] = turn;
						motion[copy.point] = next;
						error[copy.point] = error[p] + copy.error;
						members.push_back(copy.point);
						fixed = fixed || error[copy.point] > kMaxTurnError;
					}
					else if (!(std::abs(turn / result.turn[copy.point] - 1.0) <=
							   kSeamMatch + error[p] + copy.error + error[copy.point]))
						fixed = true; // another way round the vertex is another motion
				}
			}
			result.first.push_back(first);
			result.fixed.push_back(fixed);
		}
		for (const Motion& m : motion)
			m.keep(result);
		return result;
	}

private:
	void fixUnless(bool moves, int point)
	{
		if (!moves)
			m_fixed[point] = 1;
	}

	const Array<Point2>& m_points;
	Array<char> m_fixed, m_inside; // [point]
	Adjacency<int, Copy<Motion>> m_copies;
};

} // namespace

PointGroups allPoints(const FlatMesh& flat)
{
	PointGroups result;
	const int count = flat.place.size();
	result.inside.assign(count, 1);
	forEdges(sidesByEdge(flat), [&](const FlatSide* side, int sides) {
		if (!isInside(side, sides))
			for (int i = 0; i < sides; ++i)
				result.inside[side[i].atLow] = result.inside[side[i].atHigh] = 0;
	});
	result.turn.assign(count, 1.0);
	result.fixed.assign(count, 0);
	for (int p = 0; p < count; ++p)
		result.group.push_back(p);
	result.first = result.group;
	return result;
}

PointGroups insidePoints(const FlatMesh& flat)
{
	PointGroups result = allPoints(flat);
	for (const int p : result.inside.indices())
		result.fixed[p] = !result.inside[p];
	return result;
}

PointGroups joinedPoints(
	const FlatMesh& flat,
	SeamGeometry geometry,
	const std::function<bool(int vertex)>& boundaryMoves)
{
	return geometry == SeamGeometry::Plane ? CopyGroups<PlaneMotion>(flat, boundaryMoves).groups()
										   : CopyGroups<DiskMotion>(flat, boundaryMoves).groups();
}

} // namespace ricci
