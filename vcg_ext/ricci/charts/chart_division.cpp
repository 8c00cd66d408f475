// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart_division.h"

#include "../math/adjacency.h"
#include "../math/min_cut.h"
#include "border_flow.h"
#include "connected_pieces.h"
#include "dual_graph.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace ricci {

namespace {

class ChartDivider
{
public:
	ChartDivider(
		const FlatMesh& chart, const Sides& sides, const std::vector<TrianglePair>& pairs) :
			m_chart(chart),
			m_graph(chart, sides), m_flow(m_graph), m_minCut(chart.size()),
			m_terminal(chart.size(), kNoTerminal), m_scratch(chart.size(), -1), m_pairs(pairs),
			m_rivals(chart.size(), [&](const auto& add) {
				for (const TrianglePair& pair : pairs) {
					add(pair[0], pair[1]);
					add(pair[1], pair[0]);
				}
			})
	{
		numberPieces();
	}

	std::vector<std::vector<int>> run()
	{
		// A cut makes no overlaps: each of these triangles is the largest of its part in turn.
		for (const int i : overlappingByArea())
			if (hasRival(i))
				cut(i);
		std::sort(m_cutSides.begin(), m_cutSides.end());
		rejoin();
		Array<std::vector<int>> byNumber(m_partCount + 1);
		for (const int i : m_part.indices())
			byNumber[m_part[i]].push_back(i);
		std::vector<std::vector<int>> parts;
		for (std::vector<int>& part : byNumber)
			if (!part.empty())
				parts.push_back(std::move(part));
		std::sort(parts.begin(), parts.end());
		return parts;
	}

private:
	using PartPair = std::array<int, 2>; // numbers of parts, the lower first

	static PartPair inOrder(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

	/// Whether \p i overlaps a triangle of its own part.
	bool hasRival(int i) const
	{
		for (const int rival : m_rivals[i])
			if (m_part[rival] == m_part[i])
				return true;
		return false;
	}

	/// The triangles that overlap another one, the largest in the plane first.
	std::vector<int> overlappingByArea() const
	{
		std::vector<std::pair<double, int>> byArea;
		for (const int i : m_part.indices())
			if (!m_rivals[i].empty()) {
				const Triangle2 p = m_chart.at(i);
				byArea.push_back({-doubledArea(p[0], p[1], p[2]), i});
			}
		std::sort(byArea.begin(), byArea.end());
		std::vector<int> triangles;
		triangles.reserve(byArea.size());
		for (const auto& [area, i] : byArea)
			triangles.push_back(i);
		return triangles;
	}

	/// Calls visit(j, side) for each triangle j of the same part that is joined to \p i, across the
	/// side of i.
	template<class Visit>
	void neighbours(int i, const Visit& visit) const
	{
		for (const Corner side : cornersOf(i))
			if (const Corner other = m_graph.neighbour(side); other.isValid())
				visit(other.face(), side);
	}

	/// Gives a new number to one side of the minimum cut between the sheet of \p seed and what it
	/// covers, and to all pieces but one into which each side falls.
	void cut(int seed)
	{
		const int whole = m_part[seed];
		std::vector<int> sheet, covered;
		const auto claim = [&](int i) {
			sheet.push_back(i);
			m_terminal[i] = kSource;
			for (const int rival : m_rivals[i])
				if (m_part[rival] == whole && m_terminal[rival] != kSink) {
					m_terminal[rival] = kSink;
					covered.push_back(rival);
				}
		};
		claim(seed);
		for (std::size_t head = 0; head < sheet.size(); ++head)
			neighbours(sheet[head], [&](int i, Corner) {
				if (m_terminal[i] == kNoTerminal && hasRival(i))
					claim(i);
			});
		m_flow.find(sheet, covered, m_terminal);
		const MinCut::Side side =
			m_minCut.run(sheet, covered, [&](int i, const MinCut::AddEdge& add) {
				neighbours(i, [&](int j, Corner across) {
					if (m_terminal[i] != kNoTerminal && m_terminal[i] == m_terminal[j])
						return;
					const std::int64_t weight = m_graph.weight(across),
									   flow = m_flow.across(across);
					add(j, weight - flow, weight + flow);
				});
			});
		for (const std::vector<int>* marked : {&sheet, &covered})
			for (const int i : *marked)
				m_terminal[i] = kNoTerminal;
		renumber(side.nodes);
		std::vector<int> ends, otherEnds;
		for (const int i : side.nodes)
			for (const Corner own : cornersOf(i))
				if (const Corner other = m_graph.joined(own);
					other.isValid() && m_part[other.face()] == whole) {
					m_cutSides.push_back(std::min(own, other));
					ends.push_back(i);
					otherEnds.push_back(other.face());
				}
		separate(ends);
		separate(otherEnds);
	}

	/// Gives a number to each connected piece of the chart: a flipped triangle that was reflected may
	/// have cut one off.
	void numberPieces()
	{
		for (const std::vector<int>& piece : m_graph.connectedPieces())
			renumber(piece);
	}

	/// Gives a new number to triangles.
	void renumber(const std::vector<int>& triangles)
	{
		++m_partCount;
		for (const int i : triangles)
			m_part[i] = m_partCount;
	}

	/// Gives new numbers to all connected pieces of a part but the largest.
	/// \param ends triangles of each piece
	void separate(const std::vector<int>& ends)
	{
		const auto ownNeighbours = [&](int i, const auto& visit) {
			neighbours(i, [&](int j, Corner) { visit(j); });
		};
		for (const std::vector<int>& piece : smallerPieces(ends, ownNeighbours, m_scratch))
			renumber(piece);
	}

	/// Joins neighbouring parts that do not cover each other again, those with the longest common
	/// border first: a later cut can make an earlier one needless.
	void rejoin()
	{
		std::set<PartPair> rivals;
		for (const TrianglePair& pair : m_pairs)
			rivals.insert(inOrder(m_part[pair[0]], m_part[pair[1]]));
		Array<int> name(m_partCount + 1);
		std::iota(name.begin(), name.end(), 0);
		for (;;) {
			std::map<PartPair, double> borders;
			for (const Corner side : m_cutSides) {
				const PartPair pair =
					inOrder(name[m_part[side.face()]], name[m_part[m_graph.joined(side).face()]]);
				if (pair[0] != pair[1] && !rivals.count(pair))
					borders[pair] += m_chart.lengths[side];
			}
			if (borders.empty())
				break;
			const PartPair longest =
				std::max_element(borders.begin(), borders.end(), [](const auto& x, const auto& y) {
					return x.second < y.second;
				})->first;
			const auto renamed = [&](int part) { return part == longest[1] ? longest[0] : part; };
			for (int& part : name)
				part = renamed(part);
			std::set<PartPair> remaining;
			for (const PartPair& pair : rivals)
				remaining.insert(inOrder(renamed(pair[0]), renamed(pair[1])));
			rivals.swap(remaining);
		}
		for (int& part : m_part)
			part = name[part];
	}

	const FlatMesh& m_chart;
	DualGraph m_graph;
	Array<int>& m_part = m_graph.part;
	int m_partCount = 0;
	BorderFlow m_flow;
	MinCut m_minCut;
	Array<Terminal> m_terminal;     // [triangle] kNoTerminal between cuts
	Array<int> m_scratch;           // [triangle] -1 between uses
	std::vector<Corner> m_cutSides; // the lower one of each two
	const std::vector<TrianglePair>& m_pairs;
	Adjacency<int, int> m_rivals; // triangles that overlap a triangle
};

} // namespace

std::vector<std::vector<int>>
divideChart(const FlatMesh& chart, const Sides& sides, const std::vector<TrianglePair>& pairs)
{
	return ChartDivider(chart, sides, pairs).run();
}

} // namespace ricci
