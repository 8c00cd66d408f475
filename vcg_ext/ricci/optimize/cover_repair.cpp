// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair.h"

#include "../base/task.h"
#include "../base/tolerances.h"
#include "../layout/hyperbolic_layout.h"
#include "../numerics/disk_isometry.h"

#include <cstddef>
#include <limits>
#include <utility>

namespace ricci {

namespace {

/// Rings of the patches, one size after another.
constexpr int kCoverRings[] = {1, 2, 3, 5};

/// Takes the geodesic from \p a to \p b to that from \p c to \p d, of the same length.
ExtendedIsometry taking(const Point2& a, const Point2& b, const Point2& c, const Point2& d)
{
	const auto from = ExtendedIsometry::translationTo(asComplex(a));
	const auto to = ExtendedIsometry::translationTo(asComplex(c));
	const auto x = from.inverse()(asComplex(b)), y = to.inverse()(asComplex(d));
	return (to * ExtendedIsometry::rotation(arg(y) - arg(x)) * from.inverse()).normalised();
}

/// Some triangles of the charts laid out side by side.
struct CoverPatch
{
	std::vector<int> triangles;          ///< of the charts
	std::vector<ExtendedIsometry> place; ///< [triangle of the patch] takes its chart to the layout
	FlatMesh flat;                       ///< the layout
	PointGroups groups;                  ///< each point; fixed where the patch ends
	Patch whole;
};

class CoverRepair
{
public:
	CoverRepair(FlatMesh& flat, const RepairRules& rules, bool boundaryMoves) :
			m_flat(flat), m_rules(rules), m_corners(flat.vertexCount(), 0),
			m_stays(flat.vertexCount(), 0), m_local(flat.size(), -1)
	{
		for (const Triangle& t : flat.vertices)
			for (const int v : t)
				++m_corners[v];
		for (const Corner side : flat.across.indices())
			if (!flat.across[side].isValid() && !boundaryMoves)
				m_stays[flat.vertices[side]] = m_stays[flat.vertices[side.next()]] = 1;
	}

	Repair run(WorkLimit& limit)
	{
		Repair result;
		const std::vector<int> bad = badTriangles(m_flat, m_rules.validity);
		result.moved.assign(m_flat.place.size(), 0);
		std::int64_t work = limit.left();
		const std::int64_t before = work;
		for (const int f : bad) {
			checkpoint();
			for (const bool atMiddle : {false, true})
				for (const int rings : kCoverRings)
					if (work > 0 && !m_rules.validity.isValid(m_flat.at(f)))
						mend(f, rings, atMiddle, work, result.moved);
		}
		limit.spend(before - std::max(work, std::int64_t(0)));
		result.left = static_cast<int>(badTriangles(m_flat, m_rules.validity).size());
		return result;
	}

private:
	void mend(int seed, int rings, bool atMiddle, std::int64_t& work, Array<char>& moved)
	{
		CoverPatch patch = lay(seed, rings, atMiddle);
		const auto size = static_cast<std::int64_t>(patch.triangles.size());
		work -= size;
		if (patch.whole.variables == 0)
			return;
		const int maxSteps = static_cast<int>(std::clamp(
			work / size, std::int64_t(0), std::int64_t(std::numeric_limits<int>::max())));
		const Untangled found =
			untangle({patch.flat, patch.groups, m_rules}, patch.whole, maxSteps);
		work -= found.steps * size;
		if (found.points.empty())
			return;
		std::vector<std::pair<int, Point2>> places; // new ones of points of the charts
		for (std::size_t i = 0; i < patch.triangles.size(); ++i)
			for (std::size_t k = 0; k < 3; ++k) {
				const int local = patch.flat.points[static_cast<int>(i)][k];
				if (patch.groups.fixed[local] == 0)
					places.emplace_back(
						m_flat.points[patch.triangles[i]][k],
						ricci::moved(patch.place[i].inverse(), found.points[positionOf(local)]));
			}
		const auto exchange = [&] {
			for (auto& [p, place] : places)
				std::swap(m_flat.place[p], place);
		};
		std::sort(places.begin(), places.end());
		places.erase(
			std::unique(
				places.begin(),
				places.end(),
				[](const auto& x, const auto& y) { return x.first == y.first; }),
			places.end());
		const int wrong = countWrong(patch.triangles);
		exchange();
		if (countWrong(patch.triangles) >= wrong)
			exchange();
		else
			for (const auto& [p, place] : places)
				moved[p] = 1;
	}

	/// Triangles that are not valid; more than there are where one has left the disk.
	int countWrong(const std::vector<int>& triangles) const
	{
		int count = 0;
		for (const int f : triangles) {
			const Triangle2 p = m_flat.at(f);
			if (!std::all_of(p.begin(), p.end(), [](const Point2& x) {
					return std::norm(asComplex(x)) < 1.0;
				}))
				return std::numeric_limits<int>::max();
			count += !m_rules.validity.isValid(p);
		}
		return count;
	}

	/// Lays out \p rings rings round the seed, each triangle once.
	CoverPatch lay(int seed, int rings, bool atMiddle)
	{
		CoverPatch patch;
		patch.triangles.push_back(seed);
		patch.place.push_back(atMiddle ? toMiddle(m_flat, {seed}) : ExtendedIsometry());
		m_local[seed] = 0;
		const auto add = [&](int f, Corner side) { // across the side
			if (m_local[f] >= 0)
				return;
			m_local[f] = static_cast<int>(patch.triangles.size());
			patch.triangles.push_back(f);
			patch.place.push_back(placeAcross(side, patch.place[positionOf(m_local[side.face()])]));
		};
		std::size_t first = 0;
		for (int ring = 0; ring < rings; ++ring) {
			const std::size_t end = patch.triangles.size();
			for (; first < end; ++first)
				for (const Corner start : cornersOf(patch.triangles[first])) {
					// Round its vertex one way and, where that ends at the boundary, the other way.
					Corner c = start, other;
					bool isClosed = false;
					while (!isClosed && (other = m_flat.across[c]).isValid()) {
						add(other.face(), c);
						c = other.next();
						isClosed = c == start;
					}
					for (c = start.previous(); !isClosed && (other = m_flat.across[c]).isValid();
						 c = other.previous())
						add(other.face(), c);
				}
		}
		layOut(patch);
		for (const int f : patch.triangles)
			m_local[f] = -1;
		return patch;
	}

	/// What takes the chart across a side to the layout, where \p place takes that of the side.
	ExtendedIsometry placeAcross(Corner side, const ExtendedIsometry& place) const
	{
		if (m_flat.joined(side).isValid())
			return place;
		const auto own = m_flat.ends(side), other = m_flat.ends(m_flat.across[side]);
		return (place * taking(other[1], other[0], own[0], own[1])).normalised();
	}

	/// Makes the flat mesh of the patch: sides that lie on each other are joined.
	void layOut(CoverPatch& patch) const
	{
		patch.flat = m_flat.part(patch.triangles);
		FlatMesh& flat = patch.flat;
		CornerArray<Point2> laid;
		for (const int f : flat.points.indices())
			for (const Point2& p : flat.at(f))
				laid.push_back(moved(patch.place[positionOf(f)], p));
		const auto place = [&](Corner c) { return laid[c]; };
		numberPoints(
			place,
			[&](Corner side, Corner across) {
				const Point2 a = place(side), b = place(side.next());
				const double most = kSmall * distance(a, b);
				return distance(a, place(across.next())) <= most &&
					   distance(b, place(across)) <= most;
			},
			flat);
		patch.groups = allPoints(flat);
		Array<int> corners(flat.place.size(), 0);
		for (const Triangle& t : flat.points)
			for (const int p : t)
				++corners[p];
		for (const int f : flat.points.indices())
			for (std::size_t k = 0; k < 3; ++k) {
				const int p = flat.points[f][k], v = flat.vertices[f][k];
				patch.groups.fixed[p] = m_stays[v] || corners[p] < m_corners[v];
			}
		patch.whole = wholePatch(flat, patch.groups);
	}

	FlatMesh& m_flat;
	const RepairRules& m_rules;
	Array<int> m_corners; // [vertex] of triangles
	Array<char> m_stays;  // [vertex] 1 on a boundary that does not move
	Array<int> m_local;   // [triangle] its number in the patch, -1 between uses
};

} // namespace

Repair repairInCover(FlatMesh& flat, const RepairRules& rules, bool boundaryMoves, WorkLimit& limit)
{
	return CoverRepair(flat, rules, boundaryMoves).run(limit);
}

} // namespace ricci
