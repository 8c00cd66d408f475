// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart_division.h"

#include "../math/adjacency.h"
#include "../math/min_cut.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace ricci {

namespace {

/// Units of capacity for the longest edge of a cut.
constexpr double kCapacity = 1e6;

/// For each side 3 i + k of each triangle i the side that it is joined to, or -1.
Array<int> joinedSides(const DrawnChart& chart)
{
	struct Side
	{
		int low, high, index; // lower and higher vertex
	};
	std::vector<Side> sides;
	for (int i = 0; i < chart.triangles.size(); ++i)
		for (int k = 0; k < 3; ++k) {
			const Triangle& t = chart.triangles[i];
			const int a = t[positionOf(k)], b = t[positionOf((k + 1) % 3)];
			sides.push_back({std::min(a, b), std::max(a, b), 3 * i + k});
		}
	std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
		return a.low != b.low     ? a.low < b.low
			   : a.high != b.high ? a.high < b.high
								  : a.index < b.index;
	});
	Array<int> joined(sides.size(), -1);
	for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
		const Side &s = sides[i], &t = sides[i + 1];
		if (s.low != t.low || s.high != t.high)
			continue;
		const auto end = [&](int side, int k) -> const Point2& {
			return chart.plane[side / 3][positionOf((side % 3 + k) % 3)];
		};
		if (end(s.index, 0) == end(t.index, 1) && end(s.index, 1) == end(t.index, 0)) {
			joined[s.index] = t.index;
			joined[t.index] = s.index;
		}
	}
	return joined;
}

class ChartDivider
{
public:
	ChartDivider(
		const DrawnChart& chart,
		const std::vector<TrianglePair>& pairs,
		const Array<std::array<double, 3>>& edgeLength) :
			m_chart(chart),
			m_edgeLength(edgeLength), m_joined(joinedSides(chart)),
			m_part(chart.triangles.size(), 0),
			m_rivals(chart.triangles.size(), [&](const auto& add) {
				for (const TrianglePair& pair : pairs) {
					add(pair[0], pair[1]);
					add(pair[1], pair[0]);
				}
			})
	{
	}

	std::vector<std::vector<int>> run(ChartCuts& cuts)
	{
		std::vector<int> whole(positionOf(m_part.size()));
		std::iota(whole.begin(), whole.end(), 0);
		std::vector<std::vector<int>> open{std::move(whole)};
		while (!open.empty()) {
			const std::vector<int> part = std::move(open.back());
			open.pop_back();
			const int seed = largestWithRival(part);
			if (seed < 0)
				continue;
			cut(part, seed);
			for (std::vector<int>& piece : connectedPieces(part))
				open.push_back(std::move(piece));
		}
		rejoin();
		std::map<int, std::vector<int>> byNumber;
		for (const int i : m_part.indices())
			byNumber[m_part[i]].push_back(i);
		std::vector<std::vector<int>> parts;
		parts.reserve(byNumber.size());
		for (auto& part : byNumber)
			parts.push_back(std::move(part.second));
		std::sort(parts.begin(), parts.end());
		cuts = ChartCuts();
		for (const int side : m_joined.indices())
			if (m_joined[side] > side && m_part[side / 3] != m_part[m_joined[side] / 3]) {
				++cuts.edges;
				cuts.length += lengthOf(side);
			}
		return parts;
	}

private:
	using PartPair = std::array<int, 2>; // numbers of parts, the lower first

	double lengthOf(int side) const { return m_edgeLength[side / 3][positionOf(side % 3)]; }

	static PartPair inOrder(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

	/// Whether \p i overlaps a triangle of its own part.
	bool hasRival(int i) const
	{
		for (const int rival : m_rivals[i])
			if (m_part[rival] == m_part[i])
				return true;
		return false;
	}

	/// By area in the plane; -1 if the part has no overlap.
	int largestWithRival(const std::vector<int>& part) const
	{
		int best = -1;
		double maxArea = -1.0;
		for (const int i : part) {
			if (!hasRival(i))
				continue;
			const Triangle2& p = m_chart.plane[i];
			const double area = doubledArea(p[0], p[1], p[2]);
			if (area > maxArea) {
				maxArea = area;
				best = i;
			}
		}
		return best;
	}

	/// Calls visit(j, side) for each triangle j of the same part that is joined to \p i, across the
	/// side of i.
	template<class Visit>
	void neighbours(int i, const Visit& visit) const
	{
		for (int side = 3 * i; side < 3 * i + 3; ++side) {
			const int across = m_joined[side];
			if (across >= 0 && m_part[across / 3] == m_part[i])
				visit(across / 3, side);
		}
	}

	/// Gives the sheet of \p seed, with what the minimum cut leaves to it, a new number of its own.
	void cut(const std::vector<int>& part, int seed)
	{
		enum { kOther, kSheet, kCovered };
		Array<int> node(m_part.size(), kOther);
		std::vector<int> sheet{seed};
		const auto claim = [&](int i) {
			node[i] = kSheet;
			for (const int rival : m_rivals[i])
				if (m_part[rival] == m_part[seed])
					node[rival] = kCovered;
		};
		claim(seed);
		for (std::size_t head = 0; head < sheet.size(); ++head)
			neighbours(sheet[head], [&](int i, int) {
				if (node[i] == kOther && hasRival(i)) {
					claim(i);
					sheet.push_back(i);
				}
			});
		double longest = 0.0;
		for (const int i : part)
			for (const double length : m_edgeLength[i])
				longest = std::max(longest, length);
		// Node 0 of the graph is the sheet, node 1 what it covers, and each other triangle has one.
		int count = 2;
		for (const int i : part)
			node[i] = node[i] != kOther ? node[i] - kSheet : count++;
		MinCut minCut(count);
		for (const int i : part)
			neighbours(i, [&](int j, int side) {
				if (i > j || node[i] == node[j])
					return;
				const double share = longest > 0.0 ? lengthOf(side) / longest : 0.0;
				const auto capacity = static_cast<std::int64_t>(share * kCapacity) + 1;
				minCut.join(node[i], node[j], capacity, capacity);
			});
		const Array<char> isOnSheetSide = minCut.run(0, 1);
		++m_partCount;
		for (const int i : part)
			if (isOnSheetSide[node[i]])
				m_part[i] = m_partCount;
	}

	/// Joins neighbouring parts that do not cover each other again, those with the longest common
	/// border first: a later cut can make an earlier one needless.
	void rejoin()
	{
		std::set<PartPair> rivals;
		for (const int i : m_part.indices())
			for (const int rival : m_rivals[i])
				rivals.insert(inOrder(m_part[i], m_part[rival]));
		for (;;) {
			std::map<PartPair, double> borders;
			for (const int side : m_joined.indices()) {
				if (m_joined[side] <= side)
					continue;
				const PartPair pair = inOrder(m_part[side / 3], m_part[m_joined[side] / 3]);
				if (pair[0] != pair[1] && !rivals.count(pair))
					borders[pair] += lengthOf(side);
			}
			if (borders.empty())
				return;
			const PartPair longest =
				std::max_element(borders.begin(), borders.end(), [](const auto& x, const auto& y) {
					return x.second < y.second;
				})->first;
			const auto renamed = [&](int part) { return part == longest[1] ? longest[0] : part; };
			for (int& part : m_part)
				part = renamed(part);
			std::set<PartPair> remaining;
			for (const PartPair& pair : rivals)
				remaining.insert(inOrder(renamed(pair[0]), renamed(pair[1])));
			rivals.swap(remaining);
		}
	}

	/// Connected pieces of \p part; each gets a number of its own.
	std::vector<std::vector<int>> connectedPieces(const std::vector<int>& part)
	{
		std::vector<std::vector<int>> pieces;
		Array<char> seen(m_part.size(), 0);
		for (const int first : part) {
			if (seen[first])
				continue;
			std::vector<int> piece{first};
			seen[first] = 1;
			for (std::size_t head = 0; head < piece.size(); ++head)
				neighbours(piece[head], [&](int i, int) {
					if (!seen[i]) {
						seen[i] = 1;
						piece.push_back(i);
					}
				});
			std::sort(piece.begin(), piece.end());
			pieces.push_back(std::move(piece));
		}
		for (const std::vector<int>& piece : pieces) {
			++m_partCount;
			for (const int i : piece)
				m_part[i] = m_partCount;
		}
		return pieces;
	}

	const DrawnChart& m_chart;
	const Array<std::array<double, 3>>& m_edgeLength;
	Array<int> m_joined; // [side 3 i + k]
	Array<int> m_part;   // [triangle] number
	int m_partCount = 0;
	Adjacency<int, int> m_rivals; // triangles that overlap a triangle
};

} // namespace

std::vector<std::vector<int>> divideChart(
	const DrawnChart& chart,
	const std::vector<TrianglePair>& pairs,
	const Array<std::array<double, 3>>& edgeLength,
	ChartCuts& cuts)
{
	return ChartDivider(chart, pairs, edgeLength).run(cuts);
}

} // namespace ricci
