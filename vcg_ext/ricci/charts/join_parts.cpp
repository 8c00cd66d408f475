// SPDX-License-Identifier: GPL-3.0-or-later
#include "separate_charts.h"

#include "../base/task.h"
#include "movable_parts.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <queue>
#include <utility>

namespace ricci {

namespace {

/// Places at which a part is tried before it is divided: the round wall of a hole has as many as facets.
constexpr std::ptrdiff_t kMaxPlaces = 8;

/// Two motions are different if the two x to which they bring the middle of the chart differ by more than this
/// share of the chart's extent. It is far more than what is called one place, because the middle may lie far from the side
/// that gives the motion.
constexpr double kOneMotion = 1e-4;

/// A part that has this share of the largest is not a crumb: where there are very many parts, all are small.
constexpr double kCrumbOfLargest = 0.25;

/// What parts are left: the triangles of each in increasing order, the parts by their first.
Parts partsOf(const MovableParts& movable)
{
	Parts parts;
	for (int part = 0; part < movable.count(); ++part)
		if (!movable.isEmpty(part)) {
			parts.push_back(movable.trianglesOf(part));
			std::sort(parts.back().begin(), parts.back().end());
		}
	std::sort(parts.begin(), parts.end());
	return parts;
}

/// Puts the triangles where the parts are, and joins the sides that lie on each other there.
void take(const MovableParts& parts, FlatMesh& chart)
{
	numberPoints(
		[&](Corner c) { return parts.at(c.face())[c.index()]; },
		[&](Corner side, Corner) { return parts.isJoined(side); },
		chart);
}

/// Joins whole parts.
class PartJoiner
{
public:
	PartJoiner(const FlatMesh& chart, MovableParts& parts) :
			m_chart(chart), m_parts(parts), m_borders(parts.count())
	{
		for (const Point2& p : chart.place)
			m_box.add(p);
	}

	/// Two parts at a time, along the longest border at which the one with fewer triangles fits beside
	/// the other. Parts only grow: a border where they do not fit stays so.
	void run()
	{
		for (const int f : m_chart.points.indices())
			m_parts.forSides(f, [&](Corner side, Corner across) {
				const int part = m_parts.partOf(f), other = m_parts.partOf(across.face());
				if (part < other && m_parts.fits(m_parts.across(side), side))
					add({side, m_chart.lengths[side], part, other});
			});
		for (int part = 0; part < m_borders.size(); ++part)
			for (const auto& [other, borders] : m_borders[part])
				for (const auto& [x, border] : *borders)
					if (part < other)
						m_open.push(border);
		while (!m_open.empty()) {
			checkpoint();
			Border next = m_open.top();
			m_open.pop();
			if (!isPresent(next))
				continue;
			if (m_parts.size(next.part) > m_parts.size(next.other))
				std::swap(next.part, next.other);
			const Corner side = sideIn(next.part, next);
			const Place place{next.other, m_parts.across(side), next.length};
			if (!m_parts.covering(next.part, place, [](int) { return true; }))
				join(next.part, place);
		}
	}

private:
	/// Sides of two parts that one motion brings to those across.
	struct Border
	{
		Corner side;   ///< one of them
		double length; ///< of all, on the surface
		int part, other;
		double x = 0.0; ///< by which it is found

		/// The shorter one comes later; of two as long, that of the later side.
		bool operator<(const Border& b) const
		{
			return length != b.length ? length < b.length : side > b.side;
		}
	};

	Corner sideIn(int part, const Border& border) const
	{
		return m_parts.partOf(border.side.face()) == part ? border.side
														  : m_chart.across[border.side];
	}

	/// The borders of two parts, by the x to which their motions bring the middle of the chart.
	using Borders = std::multimap<double, Border>;

	/// Adds a border to what two parts have in common. \return the border that it has become
	Border add(const Border& added)
	{
		const int part = added.part, other = added.other;
		std::shared_ptr<Borders>& borders = m_borders[part][other];
		if (!borders)
			borders = m_borders[other][part] = std::make_shared<Borders>();
		const Corner side = sideIn(part, added);
		// By the motion of the part with the lower number.
		const Motion motion = m_parts.across(sideIn(std::min(part, other), added));
		const double x = motion(m_box.centre())[0], near = kOneMotion * m_box.extent();
		const auto end = borders->upper_bound(x + near);
		auto known = std::find_if(borders->lower_bound(x - near), end, [&](const auto& b) {
			return m_parts.fits(m_parts.across(sideIn(part, b.second)), side);
		});
		if (known == end)
			known = borders->emplace(x, Border{added.side, added.length, part, other, x});
		else {
			known->second.length += added.length;
			known->second.part = part;
			known->second.other = other;
		}
		return known->second;
	}

	/// Whether the parts still are two, with a border as long as it was.
	bool isPresent(const Border& border) const
	{
		const auto borders = m_borders[border.part].find(border.other);
		if (borders == m_borders[border.part].end())
			return false;
		const auto [first, end] = borders->second->equal_range(border.x);
		return std::any_of(first, end, [&](const auto& b) {
			return b.second.side == border.side && b.second.length == border.length;
		});
	}

	void join(int part, const Place& place)
	{
		const int whole = place.other;
		m_parts.move(m_parts.trianglesOf(part), place);
		m_parts.commit();
		m_borders[whole].erase(part);
		for (const auto& [other, borders] : m_borders[part]) {
			if (other == whole)
				continue;
			m_borders[other].erase(part);
			for (const auto& [x, border] : *borders)
				m_open.push(add({border.side, border.length, whole, other}));
		}
		m_borders[part].clear();
	}

	const FlatMesh& m_chart;
	MovableParts& m_parts;
	Box2 m_box;
	Array<std::map<int, std::shared_ptr<Borders>>> m_borders; // [part] with each other part
	std::priority_queue<Border> m_open;
};

/// Area below which a part is too small to stay.
double maxCrumb(const MovableParts& parts)
{
	double total = 0.0, largest = 0.0;
	for (int part = 0; part < parts.count(); ++part) {
		total += parts.area(part);
		largest = std::max(largest, parts.area(part));
	}
	return std::min(kCrumb * total, kCrumbOfLargest * largest);
}

/// The parts that are too small, the smallest first.
std::vector<int> crumbs(const MovableParts& parts)
{
	const double most = maxCrumb(parts);
	std::vector<int> small;
	for (int part = 0; part < parts.count(); ++part)
		if (!parts.isEmpty(part) && parts.area(part) < most)
			small.push_back(part);
	std::stable_sort(
		small.begin(), small.end(), [&](int a, int b) { return parts.area(a) < parts.area(b); });
	return small;
}

/// Divides crumbs among others.
class CrumbDivider
{
public:
	CrumbDivider(const FlatMesh& chart, MovableParts& parts) :
			m_chart(chart), m_parts(parts), m_isMarked(chart.size(), 0), m_scratch(chart.size(), -1)
	{
	}

	void run()
	{
		const double most = maxCrumb(m_parts);
		for (const int part : crumbs(m_parts))
			dissolve(part, most);
	}

private:
	/// Those with the longest borders, the longest first.
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
		if (static_cast<std::ptrdiff_t>(places.size()) > kMaxPlaces)
			places.erase(places.begin() + kMaxPlaces, places.end());
		return places;
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
	/// \return whether nothing is left of it, seams are no longer, and the rest of the part there hangs together,
	/// which takes longest to see
	bool displace(int part, const Place& place, double maxArea)
	{
		std::vector<int> covered;
		double area = 0.0;
		m_parts.covering(part, place, [&](int g) {
			if (!std::exchange(m_isMarked[g], 1)) {
				covered.push_back(g);
				area += m_parts.areaOf(g);
			}
			return area > maxArea;
		});
		unmark(covered);
		if (covered.empty() || area > maxArea)
			return false;
		std::sort(covered.begin(), covered.end());
		const std::vector<int> moved = m_parts.trianglesOf(part);
		std::vector<int> both = covered;
		both.insert(both.end(), moved.begin(), moved.end());
		std::sort(both.begin(), both.end());
		const double before = seamsAt(both);
		const int displaced = m_parts.addPart();
		m_parts.move(covered, {displaced, Motion(), 0.0});
		m_parts.move(moved, place);
		return divide(displaced) && seamsAt(both) <= before &&
			   hangsTogether(place.other, covered, moved);
	}

	/// Length of the seams at \p triangles, which are in increasing order.
	double seamsAt(const std::vector<int>& triangles) const
	{
		double length = 0.0;
		for (const int f : triangles)
			m_parts.forSides(f, [&](Corner side, Corner across) {
				if (m_parts.isJoined(side))
					return;
				const bool isInside =
					std::binary_search(triangles.begin(), triangles.end(), across.face());
				length += (isInside ? 0.5 : 1.0) * m_chart.lengths[side];
			});
		return length;
	}

	/// Does away with a part if seams get no longer by it, or leaves all as it is.
	void dissolve(int part, double maxArea)
	{
		std::vector<int> triangles = m_parts.trianglesOf(part);
		std::sort(triangles.begin(), triangles.end());
		const double before = seamsAt(triangles);
		bool isDone = divide(part) && seamsAt(triangles) <= before;
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

	/// Whether a part is in one piece round the triangles \p removed, without these and those \p added.
	bool hangsTogether(int part, const std::vector<int>& removed, const std::vector<int>& added)
	{
		for (const std::vector<int>* triangles : {&removed, &added})
			for (const int f : *triangles)
				m_isMarked[f] = 1;
		const auto isIn = [&](int f) { return m_parts.partOf(f) == part && !m_isMarked[f]; };
		std::vector<int> ends;
		for (const int f : removed)
			m_parts.forSides(f, [&](Corner, Corner across) {
				if (isIn(across.face()))
					ends.push_back(across.face());
			});
		const auto forNeighbours = [&](int f, const auto& visit) {
			m_parts.forSides(f, [&](Corner side, Corner across) {
				if (isIn(across.face()) && m_parts.isJoined(side))
					visit(across.face());
			});
		};
		const bool isOne = smallerPieces(ends, forNeighbours, m_scratch).empty();
		unmark(removed);
		unmark(added);
		return isOne;
	}

	/// The triangles of the part that cover nothing at its new place, as far as they hang together
	/// with the common border.
	std::vector<int> freeAt(int part, const Place& place)
	{
		std::vector<int> covering, free;
		const MovableParts::ByBox near = m_parts.groupsNear(part, place);
		const auto take = [&](int f) {
			if (m_parts.partOf(f) == part && !std::exchange(m_isMarked[f], 1))
				(m_parts.covers(f, place.motion, near) ? covering : free).push_back(f);
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
		unmark(covering);
		unmark(free);
		return free;
	}

	void unmark(const std::vector<int>& triangles)
	{
		for (const int f : triangles)
			m_isMarked[f] = 0;
	}

	const FlatMesh& m_chart;
	MovableParts& m_parts;
	Array<char> m_isMarked; // [triangle] 0 between uses
	Array<int> m_scratch;   // [triangle] -1 between uses
};

} // namespace

Parts joinParts(FlatMesh& chart, const Parts& parts)
{
	MovableParts movable(chart, parts);
	PartJoiner(chart, movable).run();
	CrumbDivider(chart, movable).run();
	take(movable, chart);
	return partsOf(movable);
}

} // namespace ricci
