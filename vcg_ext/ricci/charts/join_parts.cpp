// SPDX-License-Identifier: GPL-3.0-or-later
#include "join_parts.h"

#include "../base/task.h"
#include "connected_pieces.h"

#include <algorithm>
#include <cstddef>
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
		FlatMesh& chart,
		const Sides& sides,
		const BoxTree& tree,
		const std::vector<std::vector<int>>& parts) :
			m_chart(chart),
			m_sides(sides), m_parts(chart, sides, tree, parts), m_mark(chart.size(), kNone),
			m_scratch(chart.size(), -1)
	{
	}

	JoinedParts run()
	{
		JoinedParts result;
		measureSeams(-1, result.seams);
		joinWhole();
		double total = 0.0;
		for (int part = 0; part < m_parts.count(); ++part)
			total += m_parts.area(part);
		const auto isCrumb = [&](int part) {
			return !m_parts.isEmpty(part) && m_parts.area(part) < kCrumb * total;
		};
		for (int part = 0; part < m_parts.count(); ++part)
			if (isCrumb(part))
				dissolve(part, kCrumb * total);
		for (int part = 0; part < m_parts.count(); ++part)
			if (isCrumb(part))
				grow(part, kGrown * total);
		for (int part = 0; part < m_parts.count(); ++part)
			if (!m_parts.isEmpty(part)) {
				result.parts.push_back(m_parts.trianglesOf(part));
				std::sort(result.parts.back().begin(), result.parts.back().end());
			}
		std::sort(result.parts.begin(), result.parts.end());
		measureSeams(1, result.seams);
		numberPoints(
			m_sides,
			[&](Corner c) { return m_parts.at(c.face())[c.index()]; },
			[&](Corner side, Corner) { return m_parts.isJoined(side); },
			m_chart);
		return result;
	}

private:
	/// Adds the seams as they are, \p sign times.
	void measureSeams(int sign, ChartCuts& cuts) const
	{
		for (const int f : m_chart.points.indices())
			m_parts.forSides(f, [&](Corner side, Corner across) {
				if (across > side && !m_parts.isJoined(side)) {
					cuts.edges += sign;
					cuts.length += sign * m_chart.lengths[side];
				}
			});
	}

	/// Those with the longest borders first.
	std::vector<Place> placesOf(int part) const
	{
		std::vector<Place> places;
		for (const int f : m_parts.trianglesOf(part))
			m_parts.forSides(f, [&](Corner side, Corner across) {
				const int other = m_parts.partOf(across.face());
				if (other == part)
					return;
				const auto known = std::find_if(places.begin(), places.end(), [&](const Place& p) {
					return p.other == other && m_parts.fits(p.motion, side);
				});
				if (known != places.end())
					known->length += m_chart.lengths[side];
				else if (const auto motion = m_parts.across(side); m_parts.fits(motion, side))
					places.push_back({other, motion, m_chart.lengths[side]});
			});
		std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
			return a.length > b.length;
		});
		return places;
	}

	/// Moves all parts that have room elsewhere, the smallest first.
	void joinWhole()
	{
		std::set<std::pair<double, int>> open; // by area
		for (int part = 0; part < m_parts.count(); ++part)
			open.insert({m_parts.area(part), part});
		while (open.size() > 1) {
			const int part = open.begin()->second;
			open.erase(open.begin());
			for (const Place& place : placesOf(part)) {
				checkpoint();
				if (m_parts.covering(part, place, [](int, int) { return true; }))
					continue;
				// A part that has no room stays without.
				const bool isOpen = open.erase({m_parts.area(place.other), place.other}) > 0;
				m_parts.move(m_parts.trianglesOf(part), place);
				m_parts.commit();
				if (isOpen)
					open.insert({m_parts.area(place.other), place.other});
				break;
			}
		}
	}

	/// Divides a part among others. \return whether nothing is left of it
	bool divide(int part)
	{
		bool isMoved = true;
		while (isMoved && !m_parts.isEmpty(part)) {
			isMoved = false;
			for (const Place& place : placesOf(part)) {
				checkpoint();
				const std::vector<int> free = freeAt(part, place);
				if (free.empty())
					continue;
				m_parts.move(free, place);
				isMoved = true;
				break;
			}
		}
		return m_parts.isEmpty(part);
	}

	/// Moves a part where it covers something, and divides that among others.
	/// \return whether nothing is left of it
	bool displace(int part, const Place& place, double maxArea)
	{
		std::vector<int> covered;
		m_parts.covering(part, place, [&](int, int g) {
			covered.push_back(g);
			return false;
		});
		std::sort(covered.begin(), covered.end());
		covered.erase(std::unique(covered.begin(), covered.end()), covered.end());
		double area = 0.0;
		for (const int g : covered)
			area += m_parts.areaOf(g);
		if (covered.empty() || area > maxArea)
			return false;
		const int displaced = m_parts.addPart();
		m_parts.move(covered, {displaced, RigidMotion(), 0.0});
		if (!smallerPiecesRound(covered, place.other).empty())
			return false;
		m_parts.move(m_parts.trianglesOf(part), place);
		return divide(displaced);
	}

	/// Does away with a part, or leaves all as it is.
	void dissolve(int part, double maxArea)
	{
		bool isDone = divide(part);
		if (!isDone) {
			m_parts.undo();
			for (const Place& place : placesOf(part)) {
				checkpoint();
				isDone = displace(part, place, maxArea);
				if (isDone)
					break;
				m_parts.undo();
			}
		}
		m_parts.commit();
	}

	/// The pieces but the largest into which what is left of a part falls without \p triangles, which
	/// are marked as taken or in another part.
	std::vector<std::vector<int>> smallerPiecesRound(const std::vector<int>& triangles, int part)
	{
		const auto isIn = [&](int f) { return m_parts.partOf(f) == part && m_mark[f] != kTaken; };
		std::vector<int> ends;
		for (const int f : triangles)
			m_parts.forSides(f, [&](Corner, Corner across) {
				if (isIn(across.face()))
					ends.push_back(across.face());
			});
		return smallerPieces(
			ends,
			[&](int f, const auto& visit) {
				m_parts.forSides(f, [&](Corner side, Corner across) {
					if (isIn(across.face()) && m_parts.isJoined(side))
						visit(across.face());
				});
			},
			m_scratch);
	}

	/// The triangles of the part that cover nothing at its new place, as far as they hang together
	/// with the common border.
	std::vector<int> freeAt(int part, const Place& place)
	{
		std::vector<int> marked, free;
		m_parts.covering(part, place, [&](int f, int) {
			marked.push_back(f);
			m_mark[f] = kCovering;
			return false;
		});
		const auto take = [&](int f) {
			if (m_parts.partOf(f) == part && m_mark[f] == kNone) {
				m_mark[f] = kTaken;
				free.push_back(f);
			}
		};
		for (const int f : m_parts.trianglesOf(part))
			m_parts.forSides(f, [&](Corner side, Corner across) {
				if (m_parts.partOf(across.face()) == place.other &&
					m_parts.fits(place.motion, side))
					take(f);
			});
		for (std::size_t i = 0; i < free.size(); ++i)
			m_parts.forSides(free[i], [&](Corner side, Corner across) {
				if (m_parts.isJoined(side))
					take(across.face());
			});
		unmark(marked);
		unmark(free);
		return free;
	}

	/// Gives a part triangles of another one, up to an area that the other has twice.
	void grow(int part, double area)
	{
		for (const Place& place : placesOf(part)) {
			checkpoint();
			if (m_parts.area(place.other) < 2.0 * area)
				continue;
			const std::vector<int> given = nextTo(part, place, area);
			if (given.empty())
				continue;
			m_parts.move(given, {part, place.motion.inverse(), 0.0});
			m_parts.commit();
			return;
		}
	}

	/// Triangles of the other part, from the common border on, that cover nothing of the part at its
	/// new place and leave the other one in one piece. None if they do not have the area with the part.
	std::vector<int> nextTo(int part, const Place& place, double area)
	{
		std::vector<int> marked, taken;
		m_parts.covering(part, place, [&](int, int g) {
			marked.push_back(g);
			m_mark[g] = kCovering;
			return false;
		});
		double sum = m_parts.area(part);
		const auto take = [&](int f) {
			if (m_parts.partOf(f) != place.other || m_mark[f] != kNone)
				return;
			m_mark[f] = kTaken;
			taken.push_back(f);
			sum += m_parts.areaOf(f);
		};
		for (const int f : m_parts.trianglesOf(part))
			m_parts.forSides(f, [&](Corner side, Corner across) {
				if (m_parts.fits(place.motion, side))
					take(across.face());
			});
		for (std::size_t i = 0; i < taken.size() && sum < area; ++i)
			m_parts.forSides(taken[i], [&](Corner side, Corner across) {
				if (m_parts.isJoined(side))
					take(across.face());
			});
		// What is cut off by it goes with it.
		bool isWhole = sum >= area;
		for (const std::vector<int>& piece : smallerPiecesRound(taken, place.other))
			for (const int f : piece) {
				isWhole = isWhole && m_mark[f] == kNone;
				take(f);
			}
		unmark(marked);
		unmark(taken);
		return isWhole ? taken : std::vector<int>();
	}

	void unmark(const std::vector<int>& triangles)
	{
		for (const int f : triangles)
			m_mark[f] = kNone;
	}

	enum Mark : char { kNone, kCovering, kTaken };

	FlatMesh& m_chart;
	const Sides& m_sides;
	MovableParts m_parts;
	Array<char> m_mark;   // [triangle] Mark, kNone between uses
	Array<int> m_scratch; // [triangle] -1 between uses
};

} // namespace

JoinedParts joinParts(
	FlatMesh& chart,
	const Sides& sides,
	const BoxTree& tree,
	const std::vector<std::vector<int>>& parts)
{
	return PartJoiner(chart, sides, tree, parts).run();
}

} // namespace ricci
