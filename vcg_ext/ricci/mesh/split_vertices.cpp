// SPDX-License-Identifier: GPL-3.0-or-later
#include "face_gluing.h"

#include "../base/numbers.h"
#include "../base/tolerances.h"
#include "sides.h"

#include <algorithm>
#include <cstdint>
#include <map>

namespace ricci {

namespace {

/// Numbers of places from 1 on, in their order: vertices of one part with equal coordinates (0 = -0) have one; 0 for
/// other vertices.
Array<int> placesOf(
	const std::vector<Point3>& positions,
	const std::vector<int>& part,
	const std::vector<int>& vertices)
{
	const auto partOf = [&](int v) { return part.empty() ? 0 : part[positionOf(v)]; };
	const auto at = [&](int v) { return positions[positionOf(v)]; };
	std::vector<int> order = vertices;
	std::sort(order.begin(), order.end(), [&](int a, int b) {
		if (at(a) != at(b))
			return at(a) < at(b);
		return partOf(a) != partOf(b) ? partOf(a) < partOf(b) : a < b;
	});
	Array<int> place(static_cast<int>(positions.size()), 0);
	int last = -1, count = 0;
	for (const int v : order) {
		count += last < 0 || at(v) != at(last) || partOf(v) != partOf(last);
		place[v] = count;
		last = v;
	}
	return place;
}

/// Puts pages in the order in which they are met when one turns round their edge from above to below, those that lie
/// on one another by \p runsUp: a page that runs up has its inner side behind it, one that runs down before it.
/// \param layer receives [page] a number that those share that lie on one another
template<class RunsUp>
void sortRound(const RunsUp& runsUp, std::vector<Page>& pages, std::vector<int>& layer)
{
	std::stable_sort(
		pages.begin(), pages.end(), [](const Page& p, const Page& q) { return p.angle > q.angle; });
	const auto gapBefore = [&](std::size_t i) {
		return i > 0 ? pages[i - 1].angle - pages[i].angle
					 : pages.back().angle + 2.0 * kPi - pages[0].angle;
	};
	std::size_t start = 0; // behind a gap
	while (start + 1 < pages.size() && !(gapBefore(start) > kSmall))
		++start;
	layer.assign(pages.size(), 0);
	for (std::size_t i = start + 1; i < start + pages.size(); ++i) {
		const std::size_t at = i % pages.size();
		layer[i - start] = layer[i - start - 1] + (gapBefore(at) > kSmall);
	}
	std::rotate(pages.begin(), pages.begin() + static_cast<std::ptrdiff_t>(start), pages.end());
	for (std::size_t first = 0, last; first < pages.size(); first = last) {
		for (last = first; last < pages.size() && layer[last] == layer[first];)
			++last;
		const auto begin = pages.begin();
		std::stable_partition(
			begin + static_cast<std::ptrdiff_t>(first),
			begin + static_cast<std::ptrdiff_t>(last),
			[&](const Page& p) { return !runsUp(p.side); });
	}
}

} // namespace

std::array<std::vector<Corner>, 2> sidesToJoin(
	const Array<Triangle>& triangles,
	const std::vector<Corner>& alone,
	const std::vector<int>& part,
	bool all)
{
	const auto partOf = [&](int v) { return part.empty() ? 0 : part[positionOf(v)]; };
	std::map<int, std::int64_t> excess; // [part] tenths of sides over nine tenths
	for (const Triangle& t : triangles.values())
		excess[partOf(t[0])] -= 9 * 3;
	for (const Corner side : alone)
		excess[partOf(triangles[side])] += 10;
	std::array<std::vector<Corner>, 2> divided;
	for (const Corner side : alone)
		divided[!all && excess[partOf(triangles[side])] < 0].push_back(side);
	return divided;
}

std::vector<std::array<Corner, 2>> findSplitVertices(
	const std::vector<Point3>& positions,
	const Array<Triangle>& triangles,
	const std::vector<Corner>& alone,
	const std::vector<int>& part,
	DisjointSets& vertices)
{
	CornerArray<char> isAlone(3 * triangles.size(), 0);
	std::vector<int> faces, ends; // of these sides
	for (const Corner side : alone) {
		isAlone[side] = 1;
		faces.push_back(side.face());
		ends.push_back(triangles[side]);
		ends.push_back(triangles[side.next()]);
	}
	sortUnique(faces);
	sortUnique(ends);
	const Array<int> place = placesOf(positions, part, ends);
	std::vector<Triangle> byPlace; // of the faces
	for (const int f : faces) {
		const Triangle& t = triangles[f];
		byPlace.push_back({place[t[0]], place[t[1]], place[t[2]]});
	}
	std::vector<std::array<Corner, 2>> joined;
	std::vector<Corner> sides;
	std::vector<int> layer;
	Sides(byPlace).forEdges([&](const auto& edge) {
		sides.clear();
		for (const Corner c : edge)
			if (const Corner side(faces[positionOf(c.face())], static_cast<int>(c.index()));
				isAlone[side] && place[triangles[side]] != place[triangles[side.next()]])
				sides.push_back(side);
		if (sides.size() < 2)
			return;
		const int low = std::min(triangles[sides[0]], triangles[sides[0].next()]);
		const auto runsUp = [&](Corner s) { return place[triangles[s]] == place[low]; };
		std::vector<Page> pages =
			pagesOf(positions, triangles, {sides.data(), sides.data() + sides.size()});
		sortRound(runsUp, pages, layer);
		const std::size_t count = pages.size();
		for (std::size_t i = 0; i < count; ++i) {
			const Page &p = pages[i], &q = pages[(i + 1) % count];
			const bool isPair = count == 2 ? i == 0 : runsUp(p.side) && !runsUp(q.side);
			const bool lieOnEachOther =
				layer[i] == layer[(i + 1) % count] && !p.isThin && !q.isThin;
			if (!isPair || lieOnEachOther)
				continue;
			const bool sameWay = runsUp(p.side) == runsUp(q.side);
			vertices.merge(triangles[p.side], triangles[sameWay ? q.side : q.side.next()]);
			vertices.merge(triangles[p.side.next()], triangles[sameWay ? q.side.next() : q.side]);
			joined.push_back({p.side, q.side});
		}
	});
	return joined;
}

} // namespace ricci
