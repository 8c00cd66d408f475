// SPDX-License-Identifier: GPL-3.0-or-later
#include "join_parts.h"

#include "../base/tolerances.h"
#include "../math/disjoint_sets.h"
#include "../math/orientation.h"
#include "../metric/area.h"
#include "chart_overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace ricci {

namespace {

/// Share of the area in space below which a part is no part of its own if that can be had; and up to
/// which it grows.
constexpr double kCrumb = 0.01, kGrown = 0.012;

class PartJoiner
{
public:
	PartJoiner(
		DrawnTriangles& drawn, const std::vector<std::vector<int>>& parts, const Tick& tick) :
			m_drawn(drawn),
			m_tick(tick), m_neighbour(drawn.corners.size(), {-1, -1, -1}), m_parts(parts),
			m_part(drawn.corners.size(), 0), m_area(parts.size(), 0.0),
			m_motion(drawn.corners.size(), RigidMotion())
	{
		Box2 box;
		for (const Point2& p : drawn.points)
			box.add(p);
		m_extent = box.extent();
		for (std::size_t i = 0; i < parts.size(); ++i)
			for (const int f : parts[i]) {
				m_part[f] = static_cast<int>(i);
				m_area[m_part[f]] += areaOf(f);
			}
		forEdges(sidesByEdge(drawn), [&](const DrawnSide* side, int count) {
			for (int i = 0; i < 2 && count == 2; ++i)
				m_neighbour[side[i].triangle][sideAt(side[i])] = side[1 - i].triangle;
		});
	}

	JoinedParts run()
	{
		JoinedParts result;
		measureSeams(-1, result.seams);
		joinWhole();
		const double total = std::accumulate(m_area.begin(), m_area.end(), 0.0);
		const auto isCrumb = [&](int part) {
			return !m_parts[positionOf(part)].empty() && m_area[part] < kCrumb * total;
		};
		for (int part = 0; part < m_area.size(); ++part)
			if (isCrumb(part))
				dissolve(part, kCrumb * total);
		for (int part = 0; part < m_area.size(); ++part)
			if (isCrumb(part))
				grow(part, kGrown * total);
		for (std::vector<int>& part : m_parts)
			if (!part.empty()) {
				std::sort(part.begin(), part.end());
				result.parts.push_back(part);
			}
		std::sort(result.parts.begin(), result.parts.end());
		measureSeams(1, result.seams);
		unite();
		result.motion = std::move(m_motion);
		return result;
	}

private:
	/// A side of a triangle in a part whose neighbour is in another one.
	struct Seam
	{
		int own, other;   ///< triangles
		std::size_t side; ///< of own
	};

	/// A place for a part beside another one.
	struct Place
	{
		int other; ///< part
		RigidMotion motion;
		double length; ///< of the common border, in space
	};

	std::size_t sideAt(const DrawnSide& side) const
	{
		const Triangle& t = m_drawn.vertices[side.triangle];
		std::size_t k = 0;
		while (std::min(t[k], t[(k + 1) % 3]) != side.low ||
			   std::max(t[k], t[(k + 1) % 3]) != side.high)
			++k;
		return k;
	}

	int pointAt(int triangle, int vertex) const
	{
		std::size_t k = 0;
		while (m_drawn.vertices[triangle][k] != vertex)
			++k;
		return m_drawn.corners[triangle][k];
	}

	const Point2& at(int triangle, int vertex) const
	{
		return m_drawn.points[pointAt(triangle, vertex)];
	}

	/// The ends of a seam on its own side and on the other one.
	struct Ends
	{
		std::array<Point2, 2> own, other;
		double gap() const
		{
			return std::max(distance(own[0], other[0]), distance(own[1], other[1]));
		}
	};

	Ends endsOf(const Seam& seam) const
	{
		const Triangle& t = m_drawn.vertices[seam.own];
		const int a = t[seam.side], b = t[(seam.side + 1) % 3];
		return {{at(seam.own, a), at(seam.own, b)}, {at(seam.other, a), at(seam.other, b)}};
	}

	/// Calls visit(seam) for the sides of \p triangle with a neighbour.
	template<class Visit>
	void forSides(int triangle, const Visit& visit) const
	{
		for (std::size_t k = 0; k < 3; ++k)
			if (const int other = m_neighbour[triangle][k]; other >= 0)
				visit(Seam{triangle, other, k});
	}

	/// In space.
	double areaOf(int triangle) const { return euclideanArea(m_drawn.sides[triangle]); }

	double lengthOf(const Seam& seam) const { return m_drawn.sides[seam.own][seam.side]; }

	/// Whether its two sides are at one place in one part.
	bool isJoined(const Seam& seam) const
	{
		return m_part[seam.own] == m_part[seam.other] && fits({}, endsOf(seam));
	}

	/// Adds the seams as they are, \p sign times.
	void measureSeams(int sign, ChartCuts& cuts) const
	{
		for (const int f : m_part.indices())
			forSides(f, [&](const Seam& seam) {
				if (f > seam.other || isJoined(seam))
					return;
				cuts.edges += sign;
				cuts.length += sign * lengthOf(seam);
			});
	}

	/// The motion of its own side of a seam to the other one.
	static RigidMotion across(const Ends& ends)
	{
		const auto vector = [](const std::array<Point2, 2>& p) {
			return asComplex(p[1]) - asComplex(p[0]);
		};
		const auto middle = [](const std::array<Point2, 2>& p) {
			return 0.5 * (asComplex(p[1]) + asComplex(p[0]));
		};
		const std::complex<double> turn = vector(ends.other) * std::conj(vector(ends.own));
		RigidMotion motion;
		if (const double size = std::abs(turn); size > 0.0)
			motion.turn = turn / size;
		motion.shift = middle(ends.other) - motion.turn * middle(ends.own);
		return motion;
	}

	bool fits(const RigidMotion& motion, Ends ends) const
	{
		for (Point2& p : ends.own)
			p = motion(p);
		return ends.gap() <= kOnePlace * m_extent;
	}

	/// Those with the longest borders first.
	std::vector<Place> placesOf(int part) const
	{
		std::vector<Place> places;
		for (const int f : m_parts[positionOf(part)])
			forSides(f, [&](const Seam& seam) {
				const int other = m_part[seam.other];
				if (other == part)
					return;
				const Ends ends = endsOf(seam);
				const auto known = std::find_if(places.begin(), places.end(), [&](const Place& p) {
					return p.other == other && fits(p.motion, ends);
				});
				if (known != places.end())
					known->length += lengthOf(seam);
				else if (const RigidMotion motion = across(ends); fits(motion, ends))
					places.push_back({other, motion, lengthOf(seam)});
			});
		std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
			return a.length > b.length;
		});
		return places;
	}

	/// The triangles of the part and of the other one that cover each other at the part's new place,
	/// those that are turned round left out.
	std::vector<int> covering(int part, const Place& place) const
	{
		DrawnChart both;
		std::vector<int> triangles;
		const auto add = [&](int f, const Triangle2& p) {
			if (orientation(p[0], p[1], p[2]) <= 0)
				return;
			both.triangles.push_back(m_drawn.vertices[f]);
			both.plane.push_back(p);
			triangles.push_back(f);
		};
		Box2 box;
		for (const int f : m_parts[positionOf(part)]) {
			Triangle2 p = m_drawn.at(f);
			for (Point2& corner : p) {
				corner = place.motion(corner);
				box.add(corner);
			}
			add(f, p);
		}
		for (const int f : m_parts[positionOf(place.other)]) {
			const Triangle2 p = m_drawn.at(f);
			Box2 own;
			for (const Point2& corner : p)
				own.add(corner);
			if (own.meets(box))
				add(f, p);
		}
		std::vector<int> found;
		for (const TrianglePair& pair : overlappingPairs(both, m_tick, m_extent)) {
			const int f = triangles[positionOf(pair[0])], g = triangles[positionOf(pair[1])];
			if (m_part[f] != m_part[g])
				found.insert(found.end(), {f, g});
		}
		return found;
	}

	/// Moves all parts that have room elsewhere, the smallest first.
	void joinWhole()
	{
		std::set<std::pair<double, int>> open; // by area
		for (const int part : m_area.indices())
			open.insert({m_area[part], part});
		while (open.size() > 1) {
			const int part = open.begin()->second;
			open.erase(open.begin());
			m_tick();
			for (const Place& place : placesOf(part)) {
				if (!covering(part, place).empty())
					continue;
				// A part that has no room stays without.
				const bool isOpen = open.erase({m_area[place.other], place.other}) > 0;
				move(std::vector<int>(m_parts[positionOf(part)]), place);
				if (isOpen)
					open.insert({m_area[place.other], place.other});
				break;
			}
		}
	}

	/// Everything that moves change.
	struct State
	{
		Array<Point2> points;
		Array<Triangle> corners;
		std::vector<std::vector<int>> parts;
		Array<int> part;
		Array<double> area;
		Array<RigidMotion> motion;
	};

	State state() const
	{
		return {m_drawn.points, m_drawn.corners, m_parts, m_part, m_area, m_motion};
	}

	void restore(State&& before)
	{
		m_drawn.points = std::move(before.points);
		m_drawn.corners = std::move(before.corners);
		m_parts = std::move(before.parts);
		m_part = std::move(before.part);
		m_area = std::move(before.area);
		m_motion = std::move(before.motion);
	}

	/// Divides a part among others. \return whether nothing is left of it
	bool divide(int part)
	{
		bool isMoved = true;
		while (isMoved && !m_parts[positionOf(part)].empty()) {
			m_tick();
			isMoved = false;
			for (const Place& place : placesOf(part)) {
				const std::vector<int> free = freeAt(part, place);
				if (free.empty())
					continue;
				move(free, place);
				isMoved = true;
				break;
			}
		}
		return m_parts[positionOf(part)].empty();
	}

	/// Moves a part where it covers something, and divides that among others.
	/// \return whether nothing is left of it
	bool displace(int part, const Place& place, double maxArea)
	{
		std::vector<int> covered;
		double area = 0.0;
		for (const int f : covering(part, place))
			if (m_part[f] == place.other)
				covered.push_back(f);
		std::sort(covered.begin(), covered.end());
		covered.erase(std::unique(covered.begin(), covered.end()), covered.end());
		for (const int f : covered)
			area += areaOf(f);
		if (covered.empty() || area > maxArea)
			return false;
		const int displaced = m_area.size();
		m_parts.emplace_back();
		m_area.push_back(0.0);
		move(covered, {displaced, RigidMotion(), 0.0});
		if (pieces(place.other, [](int) { return true; }).size() > 1)
			return false;
		move(std::vector<int>(m_parts[positionOf(part)]), place);
		return divide(displaced);
	}

	/// Does away with a part, or leaves all as it is.
	void dissolve(int part, double maxArea)
	{
		State before = state();
		if (divide(part))
			return;
		restore(State(before));
		for (const Place& place : placesOf(part)) {
			if (displace(part, place, maxArea))
				return;
			restore(State(before));
		}
	}

	/// The connected pieces of what \p isIn(triangle) leaves of a part.
	template<class IsIn>
	std::vector<std::vector<int>> pieces(int part, const IsIn& isIn) const
	{
		std::vector<std::vector<int>> found;
		Array<char> seen(m_part.size(), 0);
		for (const int first : m_parts[positionOf(part)]) {
			if (seen[first] || !isIn(first))
				continue;
			std::vector<int> piece{first};
			seen[first] = 1;
			for (std::size_t i = 0; i < piece.size(); ++i)
				forSides(piece[i], [&](const Seam& seam) {
					if (isJoined(seam) && !seen[seam.other] && isIn(seam.other)) {
						seen[seam.other] = 1;
						piece.push_back(seam.other);
					}
				});
			found.push_back(std::move(piece));
		}
		return found;
	}

	/// The triangles of the part that cover nothing at its new place, as far as they hang together
	/// with the common border.
	std::vector<int> freeAt(int part, const Place& place) const
	{
		Array<char> isTaken(m_part.size(), 0);
		for (const int f : covering(part, place))
			isTaken[f] = 1;
		std::vector<int> free;
		const auto take = [&](int f) {
			if (m_part[f] == part && !isTaken[f]) {
				isTaken[f] = 1;
				free.push_back(f);
			}
		};
		for (const int f : m_parts[positionOf(part)])
			forSides(f, [&](const Seam& seam) {
				if (m_part[seam.other] == place.other && fits(place.motion, endsOf(seam)))
					take(f);
			});
		for (std::size_t i = 0; i < free.size(); ++i)
			forSides(free[i], [&](const Seam& seam) {
				if (isJoined(seam))
					take(seam.other);
			});
		return free;
	}

	/// Gives a part triangles of another one, up to an area that the other has twice.
	void grow(int part, double area)
	{
		for (const Place& place : placesOf(part)) {
			if (m_area[place.other] < 2.0 * area)
				continue;
			const std::vector<int> given = nextTo(part, place, area);
			if (given.empty())
				continue;
			RigidMotion back;
			back.turn = std::conj(place.motion.turn);
			back.shift = -back.turn * place.motion.shift;
			move(given, {part, back, 0.0});
			return;
		}
	}

	/// Triangles of the other part, from the common border on, that cover nothing of the part at its
	/// new place and leave the other one in one piece. None if they do not have the area with the part.
	std::vector<int> nextTo(int part, const Place& place, double area) const
	{
		enum : char { kOther, kFree, kCovering, kTaken };
		Array<char> state(m_part.size(), kOther);
		for (const int f : m_parts[positionOf(place.other)])
			state[f] = kFree;
		for (const int f : covering(part, place))
			if (state[f] == kFree)
				state[f] = kCovering;
		std::vector<int> taken;
		double sum = m_area[part];
		const auto take = [&](int f) {
			if (state[f] != kFree)
				return;
			state[f] = kTaken;
			taken.push_back(f);
			sum += areaOf(f);
		};
		for (const int f : m_parts[positionOf(part)])
			forSides(f, [&](const Seam& seam) {
				if (m_part[seam.other] == place.other && fits(place.motion, endsOf(seam)))
					take(seam.other);
			});
		for (std::size_t i = 0; i < taken.size() && sum < area; ++i)
			forSides(taken[i], [&](const Seam& seam) {
				if (isJoined(seam))
					take(seam.other);
			});
		// What is cut off by it goes with it.
		auto rest = pieces(place.other, [&](int f) { return state[f] != kTaken; });
		std::sort(rest.begin(), rest.end(), [](const auto& x, const auto& y) {
			return x.size() < y.size();
		});
		if (!rest.empty())
			rest.pop_back(); // the largest stays
		bool isWhole = sum >= area;
		for (const std::vector<int>& piece : rest)
			for (const int f : piece) {
				isWhole = isWhole && state[f] == kFree;
				take(f);
			}
		return isWhole ? taken : std::vector<int>();
	}

	/// Moves triangles of one part to another.
	void move(const std::vector<int>& triangles, const Place& place)
	{
		const int from = m_part[triangles.front()];
		std::map<int, int> copies; // of points, as other triangles may stay there
		for (const int f : triangles) {
			m_area[from] -= areaOf(f);
			m_area[place.other] += areaOf(f);
			for (int& corner : m_drawn.corners[f]) {
				const auto [copy, isNew] = copies.try_emplace(corner, m_drawn.points.size());
				if (isNew)
					m_drawn.points.push_back(place.motion(m_drawn.points[corner]));
				corner = copy->second;
			}
			m_motion[f].turn *= place.motion.turn;
			m_motion[f].shift = place.motion.turn * m_motion[f].shift + place.motion.shift;
			m_part[f] = place.other;
		}
		std::vector<int>& left = m_parts[positionOf(from)];
		left.erase(
			std::remove_if(left.begin(), left.end(), [&](int f) { return m_part[f] != from; }),
			left.end());
		std::vector<int>& others = m_parts[positionOf(place.other)];
		others.insert(others.end(), triangles.begin(), triangles.end());
	}

	/// Gives points at one place the same coordinates, to the last bit.
	void unite()
	{
		DisjointSets sets(m_drawn.points.size());
		for (const int f : m_part.indices())
			forSides(f, [&](const Seam& seam) {
				if (!isJoined(seam))
					return;
				const Triangle& t = m_drawn.vertices[f];
				for (const int v : {t[seam.side], t[(seam.side + 1) % 3]})
					sets.merge(pointAt(f, v), pointAt(seam.other, v));
			});
		const Array<Point2> points = m_drawn.points;
		for (const int p : points.indices())
			m_drawn.points[p] = points[sets.find(p)];
	}

	DrawnTriangles& m_drawn;
	const Tick& m_tick;
	Array<std::array<int, 3>> m_neighbour; // [triangle][side] triangle across it, or -1
	std::vector<std::vector<int>> m_parts;
	Array<int> m_part;    // [triangle]
	Array<double> m_area; // [part]
	Array<RigidMotion> m_motion;
	double m_extent = 0.0;
};

} // namespace

JoinedParts
joinParts(DrawnTriangles& drawn, const std::vector<std::vector<int>>& parts, const Tick& tick)
{
	return PartJoiner(drawn, parts, tick).run();
}

} // namespace ricci
