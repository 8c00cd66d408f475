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

	PlaneMotion() = default;
	PlaneMotion(Complex t) : turn(t) {}
	/// Takes the side ab to cd, of the same length.
	PlaneMotion(Complex a, Complex b, Complex c, Complex d) :
			turn((d - c) * std::conj(b - a) / (std::abs(d - c) * std::abs(b - a)))
	{
		turn /= std::abs(turn);
	}

	/// The motion that takes points to those paired with them, nearly, and how far it misses one at most.
	static std::pair<PlaneMotion, double> fitting(const std::vector<std::array<Complex, 2>>& pairs)
	{
		std::array<Complex, 2> mean{};
		for (const auto& pair : pairs)
			for (std::size_t k = 0; k < 2; ++k)
				mean[k] += pair[k] / static_cast<double>(pairs.size());
		Complex product = 0.0;
		for (const auto& [a, b] : pairs)
			product += (b - mean[1]) * std::conj(a - mean[0]);
		const Complex turn = product / std::abs(product);
		double gap = 0.0;
		for (const auto& [a, b] : pairs)
			gap = std::max(gap, std::abs((b - mean[1]) - turn * (a - mean[0])));
		return {turn, gap};
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

/// Calls \p visit(sides) for every edge that is on the border of a chart: whose sides are not two that
/// are joined.
template<class Visit>
void forBorders(const FlatMesh& flat, const Sides& sides, const Visit& visit)
{
	sides.forEdges([&](ItemRange<const Corner> edge) {
		if (edge.size() != 2 || !isJoined(flat, edge[0], edge[1]))
			visit(edge);
	});
}

/// Groups the copies of the seam vertices.
template<class Motion>
class CopyGroups
{
public:
	CopyGroups(const FlatMesh& flat, const Sides& sides, const BoundaryRule& boundaryMoves) :
			m_flat(flat), m_sides(sides), m_extent(flat.box().extent()),
			m_fixed(flat.place.size(), 0), m_inside(flat.place.size(), 1),
			m_isImage(flat.place.size(), 0)
	{
		forBorders(flat, sides, [&](ItemRange<const Corner> edge) {
			for (const Corner side : edge)
				for (const Corner c : {side, side.next()}) {
					const int p = flat.points[c];
					m_inside[p] = 0;
					if (!sides.across(side).isValid() &&
						!(edge.size() == 1 && boundaryMoves(flat.vertices[c])))
						m_fixed[p] = 1;
				}
		});
	}

	/// Joins the two sides of every edge of a seam.
	void joinEdges()
	{
		const double rounding = kCoordinateRounding * m_extent;
		forBorders(m_flat, m_sides, [&](ItemRange<const Corner> edge) {
			if (!m_sides.across(edge[0]).isValid())
				return;
			// From the lower vertex to the higher one.
			std::array<int, 2> one = pointsOf(edge[0]), other = pointsOf(edge[1]);
			if (m_flat.vertices[edge[0]] < m_flat.vertices[edge[1]])
				std::swap(other[0], other[1]);
			else
				std::swap(one[0], one[1]);
			const Complex a = place(one[0]), b = place(one[1]);
			const Complex c = place(other[0]), d = place(other[1]);
			const double first = Motion::length(a, b), second = Motion::length(c, d);
			const double error =
				rounding / std::max(std::min(std::abs(b - a), std::abs(d - c)), rounding);
			if (!(std::abs(first - second) <= (kSeamMatch + error) * (first + second))) {
				for (const int p : {one[0], one[1], other[0], other[1]})
					m_fixed[p] = 1;
				return;
			}
			const Motion motion = error < 1.0 ? Motion(a, b, c, d) : Motion();
			join(one[0], other[0], motion, error);
			join(one[1], other[1], motion, error);
		});
		// The longest sides are followed first.
		std::stable_sort(m_copies.begin(), m_copies.end(), [](const auto& x, const auto& y) {
			return x.second.error < y.second.error;
		});
	}

	/// Joins the two sides of every seam as a whole, from one of its ends to the other or round it.
	void joinSeams(const VertexArray<char>& cones)
	{
		const Adjacency<Vertex, Corner> leaving(cones.size(), [&](const auto& add) {
			forBorders(m_flat, m_sides, [&](ItemRange<const Corner> edge) {
				for (const Corner side : edge)
					add(Vertex(m_flat.vertices[side]), side);
			});
		});
		VertexArray<char> isOnSeam(cones.size()), seen(cones.size(), 0);
		for (const Vertex v : cones.indices()) {
			int seams = 0;
			for (const Corner side : leaving[v])
				seams += m_sides.across(side).isValid();
			isOnSeam[v] = !cones[v] && seams == 2 && leaving[v].size() == 2;
			if (cones[v] || (seams > 0 && !isOnSeam[v]))
				for (const Corner side : leaving[v])
					m_fixed[m_flat.points[side]] = 1;
		}
		const auto end = [&](Corner side) { return Vertex(m_flat.vertices[side.next()]); };
		const auto onward = [&](Corner side) {
			const ItemRange<const Corner> out = leaving[end(side)];
			return out[out[0] == m_sides.across(side)];
		};
		for (const Vertex v : cones.indices()) {
			if (!isOnSeam[v] || seen[v])
				continue;
			const ItemRange<const Corner> out = leaving[v];
			Corner first = out[m_flat.points[out[1]] < m_flat.points[out[0]]];
			while (isOnSeam[end(first)] && end(first) != v)
				first = onward(first);
			const bool closed = isOnSeam[end(first)];
			std::vector<Corner> seam{closed ? onward(first) : m_sides.across(first)};
			while (isOnSeam[end(seam.back())] && !(closed && end(seam.back()) == v)) {
				seam.push_back(onward(seam.back()));
				seen[Vertex(m_flat.vertices[seam.back()])] = 1;
			}
			join(seam, closed);
		}
	}

	PointGroups groups() const
	{
		PointGroups result;
		const int count = m_flat.place.size();
		const Adjacency<int, Copy<Motion>> copies(count, [&](const auto& add) {
			for (const auto& [point, copy] : m_copies)
				add(point, copy);
		});
		result.group.assign(count, -1);
		result.turn.assign(count, 1.0);
		result.inside = m_inside;
		Array<Motion> motion(count); // from the first point of the group
		Array<double> error(count, 0.0);
		std::vector<int> members;
		for (int first = 0; first < count; ++first) {
			if (result.group[first] >= 0 || m_isImage[first])
				continue;
			const int group = result.first.size();
			bool fixed = false;
			members.assign(1, first);
			result.group[first] = group;
			for (std::size_t i = 0; i < members.size(); ++i) {
				const int p = members[i];
				fixed = fixed || m_fixed[p];
				for (const Copy<Motion>& copy : copies[p]) {
					const Motion next = i == 0 ? copy.motion : copy.motion * motion[p];
					const Complex turn = next.derivative(place(first));
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
	Complex place(int point) const { return asComplex(m_flat.place[point]); }

	std::array<int, 2> pointsOf(Corner side) const
	{
		return {m_flat.points[side], m_flat.points[side.next()]};
	}

	void join(int from, int to, const Motion& motion, double error)
	{
		m_copies.push_back({from, {to, motion, error}});
		m_copies.push_back({to, {from, motion.inverse(), error}});
	}

	/// Joins the points on the right of a seam, given by its sides on the left, to those on its left.
	void join(const std::vector<Corner>& seam, bool closed)
	{
		const auto copies = [&](Corner side) {
			return std::array<int, 2>{
				m_flat.points[side], m_flat.points[m_sides.across(side).next()]};
		};
		const Corner last = seam.back();
		std::vector<std::array<Complex, 2>> pairs{
			{place(m_flat.points[last.next()]), place(m_flat.points[m_sides.across(last)])}};
		for (const Corner side : seam)
			pairs.push_back({place(copies(side)[0]), place(copies(side)[1])});
		const auto [motion, gap] = Motion::fitting(pairs);
		const bool fits = gap <= kCheckedGap * m_extent; // not if the turn is no number
		for (std::size_t i = closed ? 0 : 1; i < seam.size(); ++i) {
			const auto [left, right] = copies(seam[i]);
			m_isImage[right] = 1;
			m_fixed[left] = m_fixed[right] = !fits;
			join(left, right, motion, 0.0);
		}
	}

	const FlatMesh& m_flat;
	const Sides& m_sides;
	double m_extent;
	Array<char> m_fixed, m_inside; // [point]
	Array<char> m_isImage;         // [point] 1 on the right of a seam that moves as a whole
	std::vector<std::pair<int, Copy<Motion>>> m_copies; // [i] of a point
};

} // namespace

PointGroups allPoints(const FlatMesh& flat)
{
	PointGroups result;
	const int count = flat.place.size();
	result.inside.assign(count, 1);
	forBorders(flat, Sides(flat.vertices.values()), [&](ItemRange<const Corner> edge) {
		for (const Corner side : edge)
			result.inside[flat.points[side]] = result.inside[flat.points[side.next()]] = 0;
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

PointGroups
joinedPoints(const FlatMesh& flat, SeamGeometry geometry, const BoundaryRule& boundaryMoves)
{
	const Sides sides(flat.vertices.values());
	const auto groups = [&](auto copies) {
		copies.joinEdges();
		return copies.groups();
	};
	return geometry == SeamGeometry::Plane
			   ? groups(CopyGroups<PlaneMotion>(flat, sides, boundaryMoves))
			   : groups(CopyGroups<DiskMotion>(flat, sides, boundaryMoves));
}

PointGroups joinedPoints(
	const FlatMesh& flat, const VertexArray<char>& cones, const BoundaryRule& boundaryMoves)
{
	const Sides sides(flat.vertices.values());
	CopyGroups<PlaneMotion> copies(flat, sides, boundaryMoves);
	copies.joinSeams(cones);
	return copies.groups();
}

} // namespace ricci
