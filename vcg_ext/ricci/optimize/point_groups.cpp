// SPDX-License-Identifier: GPL-3.0-or-later
#include "point_groups.h"

#include "../base/graphs.h"
#include "../base/tolerances.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace ricci {

namespace {

using Complex = std::complex<double>;

/// What turns the side ab to the direction of cd.
Complex turnOf(Complex a, Complex b, Complex c, Complex d)
{
	return (d - c) * std::conj(b - a) / (std::abs(d - c) * std::abs(b - a));
}

/// Another copy of a point, and how it is turned, as a side of the seam tells.
struct Copy
{
	int point;
	Complex turn;
	double error; ///< of the turn by rounding; more than 1 where nothing is told
};

/// Calls \p visit(side) for every side on the border of a chart: that is not joined to another one.
template<class Visit>
void forBorders(const FlatMesh& flat, const Visit& visit)
{
	for (const Corner side : flat.across.indices())
		if (!flat.joined(side).isValid())
			visit(side);
}

/// Every point as a group; points of the boundary are fixed unless it moves there.
PointGroups withBoundary(const FlatMesh& flat, const BoundaryRule& boundaryMoves)
{
	PointGroups result;
	const int count = flat.place.size();
	result.turn.assign(count, 1.0);
	result.fixed.assign(count, 0);
	result.inside.assign(count, 1);
	for (int p = 0; p < count; ++p)
		result.group.push_back(p);
	result.first = result.group;
	forBorders(flat, [&](Corner side) {
		for (const Corner c : {side, side.next()}) {
			const int p = flat.points[c];
			result.inside[p] = 0;
			if (!flat.across[side].isValid() && !boundaryMoves(flat.vertices[c]))
				result.fixed[p] = 1;
		}
	});
	return result;
}

/// What both sides of the seams tell of the copies of points at their ends, those of the longest sides first.
/// \param points each a group by itself; those of sides that differ in length become fixed
std::vector<std::pair<int, Copy>> copiesOf(const FlatMesh& flat, PointGroups& points)
{
	const double rounding = kDiskRounding * flat.box().extent();
	std::vector<std::pair<int, Copy>> copies; // of points
	forBorders(flat, [&](Corner side) {
		const Corner across = flat.across[side];
		if (across <= side)
			return;
		const std::array<int, 2> one{flat.points[side], flat.points[side.next()]};
		const std::array<int, 2> other{flat.points[across.next()], flat.points[across]};
		const auto place = [&](int point) { return asComplex(flat.place[point]); };
		const Complex a = place(one[0]), b = place(one[1]);
		const Complex c = place(other[0]), d = place(other[1]);
		const double first = std::abs(b - a), second = std::abs(d - c);
		const double error = rounding / std::max(std::min(first, second), rounding);
		if (!(std::abs(first - second) <= (kSeamMatch + error) * (first + second))) {
			for (const int p : {one[0], one[1], other[0], other[1]})
				points.fixed[p] = 1;
			return;
		}
		const Complex turn = error < 1.0 ? turnOf(a, b, c, d) : 1.0;
		for (std::size_t i = 0; i < 2; ++i) {
			copies.push_back({one[i], {other[i], turn, error}});
			copies.push_back({other[i], {one[i], std::conj(turn), error}});
		}
	});
	std::stable_sort(copies.begin(), copies.end(), [](const auto& x, const auto& y) {
		return x.second.error < y.second.error;
	});
	return copies;
}

} // namespace

PointGroups allPoints(const FlatMesh& flat)
{
	return withBoundary(flat, [](int) { return true; });
}

PointGroups insidePoints(const FlatMesh& flat)
{
	PointGroups result = allPoints(flat);
	for (const int p : result.inside.indices())
		result.fixed[p] = !result.inside[p];
	return result;
}

PointGroups joinedPoints(const FlatMesh& flat, const BoundaryRule& boundaryMoves)
{
	PointGroups result = withBoundary(flat, boundaryMoves);
	const auto listed = copiesOf(flat, result);
	const int count = flat.place.size();
	const Adjacency<int, Copy> copies(count, [&](const auto& add) {
		for (const auto& [point, copy] : listed)
			add(point, copy);
	});
	const Array<char> isFixed = std::move(result.fixed); // [point]
	result.group.assign(count, -1);
	result.first.clear();
	result.fixed.clear();
	Array<double> error(count, 0.0);
	std::vector<int> members;
	for (int first = 0; first < count; ++first) {
		if (result.group[first] >= 0)
			continue;
		const int group = result.first.size();
		bool fixed = false;
		members.assign(1, first);
		result.group[first] = group;
		for (std::size_t i = 0; i < members.size(); ++i) {
			const int p = members[i];
			fixed = fixed || isFixed[p];
			for (const Copy& copy : copies[p]) {
				Complex turn = copy.turn * result.turn[p];
				turn /= std::abs(turn);
				if (result.group[copy.point] < 0) {
					result.group[copy.point] = group;
					result.turn[copy.point] = turn;
					error[copy.point] = error[p] + copy.error;
					members.push_back(copy.point);
					// A copy whose turn is less certain does not move.
					fixed = fixed || error[copy.point] > kSmall;
				}
				else if (!(std::abs(turn / result.turn[copy.point] - 1.0) <=
						   kSeamMatch + error[p] + copy.error + error[copy.point]))
					fixed = true; // another way round the vertex is another motion
			}
		}
		result.first.push_back(first);
		result.fixed.push_back(fixed);
	}
	return result;
}

} // namespace ricci
