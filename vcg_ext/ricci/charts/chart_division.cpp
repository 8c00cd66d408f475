// SPDX-License-Identifier: GPL-3.0-or-later
#include "separate_charts.h"

#include "../base/graphs.h"
#include "../base/task.h"
#include "../numerics/min_cut.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace ricci {

namespace {

/// What a triangle is for a cut.
enum Terminal : char { kNoTerminal, kSource, kSink };

/// The least cut round a sheet that is far from what it covers is looked for among the triangles nearest to it: at least so
/// many, and so many for each of its own. Of 79 meshes two are cut elsewhere than with all triangles, and the objective is
/// 0.005 % more; a plate with a thousand slits takes half the time, a statue in few large sheets a tenth less.
constexpr std::size_t kNear = 1000, kNearForEach = 4;

/// Divides a chart so that no part contains both triangles of a pair.
class ChartDivider
{
public:
	ChartDivider(const FlatMesh& chart, const std::vector<TrianglePair>& pairs) :
			m_chart(chart), m_graph(chart), m_minCut(chart.size()),
			m_terminal(chart.size(), kNoTerminal), m_scratch(chart.size(), -1),
			m_rivals(chart.size(), [&](const auto& add) {
				for (const TrianglePair& pair : pairs) {
					add(pair[0], pair[1]);
					add(pair[1], pair[0]);
				}
			})
	{
		// A flipped triangle that was reflected may have cut a piece off.
		for (const std::vector<int>& piece : m_graph.connectedPieces())
			renumber(piece);
	}

	Parts run()
	{
		// A cut makes no overlaps: each of these triangles is the largest of its part in turn.
		for (const int i : overlappingByArea())
			if (hasRival(i))
				cut(i);
		return m_graph.connectedPieces();
	}

private:
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
			if (!m_rivals[i].empty())
				byArea.push_back({-doubledArea(m_chart.at(i)), i});
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

	/// Gives a new number to one side of the least cut between the sheet of \p seed and what it
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
		const std::vector<int> side = sideOfCut(sheet, covered);
		for (const std::vector<int>* marked : {&sheet, &covered})
			for (const int i : *marked)
				m_terminal[i] = kNoTerminal;
		renumber(side);
		std::vector<int> ends, otherEnds;
		for (const int i : side)
			for (const Corner own : cornersOf(i))
				if (const Corner other = m_graph.joined(own);
					other.isValid() && m_part[other.face()] == whole) {
					ends.push_back(i);
					otherEnds.push_back(other.face());
				}
		separate(ends);
		separate(otherEnds);
	}

	/// One side of the least cut between triangles that are marked as sources and others that are as sinks; of
	/// the least one round either, where they are far from each other: the way between them is not looked at.
	std::vector<int> sideOfCut(const std::vector<int>& sources, const std::vector<int>& sinks)
	{
		const std::optional<Surroundings> ofSources = surroundings(sources);
		const std::optional<Surroundings> ofSinks = ofSources ? surroundings(sinks) : std::nullopt;
		if (!ofSinks)
			return minCut(sources, sinks, [](int) { return true; }).nodes;
		MinCut::Side first = cutRound(sources, *ofSources), second = cutRound(sinks, *ofSinks);
		return first.capacity <= second.capacity ? std::move(first.nodes) : std::move(second.nodes);
	}

	template<class IsIn>
	MinCut::Side
	minCut(const std::vector<int>& sources, const std::vector<int>& sinks, const IsIn& isIn)
	{
		return m_minCut.run(sources, sinks, [&](int i, const MinCut::AddEdge& add) {
			neighbours(i, [&](int j, Corner across) {
				if ((m_terminal[i] == kNoTerminal || m_terminal[i] != m_terminal[j]) && isIn(j))
					add(j, m_graph.weight(across), m_graph.weight(across));
			});
		});
	}

	/// Triangles around others: inner ones, all of whose neighbours are such or on the rim, and the rim.
	using Surroundings = std::array<std::vector<int>, 2>;

	/// Those nearest to marked triangles.
	/// \return none if they reach triangles that are marked otherwise
	std::optional<Surroundings> surroundings(const std::vector<int>& triangles)
	{
		const std::size_t most = std::max(kNear, kNearForEach * triangles.size());
		const Terminal own = m_terminal[triangles.front()];
		std::vector<int> near = triangles;
		for (const int i : near)
			m_scratch[i] = 0;
		bool isMet = false;
		std::size_t head = 0;
		for (; head < near.size() && (head < triangles.size() || near.size() < most) && !isMet;
			 ++head)
			neighbours(near[head], [&](int i, Corner) {
				isMet |= m_terminal[i] != kNoTerminal && m_terminal[i] != own;
				if (m_scratch[i] < 0) {
					m_scratch[i] = 0;
					near.push_back(i);
				}
			});
		for (const int i : near)
			m_scratch[i] = -1;
		if (isMet)
			return std::nullopt;
		const auto rim = near.begin() + static_cast<std::ptrdiff_t>(head);
		return Surroundings{std::vector<int>(near.begin(), rim), std::vector<int>(rim, near.end())};
	}

	/// The least cut between triangles and the rim around them. \return the side of the triangles
	MinCut::Side cutRound(const std::vector<int>& triangles, const Surroundings& near)
	{
		const auto& [inner, rim] = near;
		const Terminal own = m_terminal[triangles.front()];
		for (const int i : inner)
			m_scratch[i] = 0;
		for (const int i : rim) {
			m_scratch[i] = 0;
			m_terminal[i] = own == kSource ? kSink : kSource;
		}
		MinCut::Side side = minCut(triangles, rim, [&](int i) { return m_scratch[i] >= 0; });
		if (!side.isOfSources) {
			for (const int i : side.nodes)
				m_scratch[i] = -1;
			side.nodes.clear();
			for (const int i : inner)
				if (m_scratch[i] >= 0)
					side.nodes.push_back(i);
		}
		for (const int i : inner)
			m_scratch[i] = -1;
		for (const int i : rim) {
			m_scratch[i] = -1;
			m_terminal[i] = kNoTerminal;
		}
		return side;
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

	const FlatMesh& m_chart;
	DualGraph m_graph;
	Array<int>& m_part = m_graph.part;
	int m_partCount = 0;
	MinCut m_minCut;
	Array<Terminal> m_terminal;   // [triangle] kNoTerminal between cuts
	Array<int> m_scratch;         // [triangle] -1 between uses
	Adjacency<int, int> m_rivals; // triangles that overlap a triangle
};

/// The triangles of a connected chart, those last that are farthest from the first, over the fewest others.
std::vector<int> breadthFirst(int first, const DualGraph& graph)
{
	Array<char> isIn(graph.part.size(), 0);
	std::vector<int> order{first};
	isIn[first] = 1;
	for (std::size_t head = 0; head < order.size(); ++head)
		for (const Corner side : cornersOf(order[head]))
			if (const Corner other = graph.neighbour(side);
				other.isValid() && !isIn[other.face()]) {
				isIn[other.face()] = 1;
				order.push_back(other.face());
			}
	return order;
}

/// The connected pieces of a chart, of a connected one those on both sides of the least cut across the
/// middle tenth of what lies between its ends.
Parts halves(const FlatMesh& chart)
{
	DualGraph graph(chart);
	Parts pieces = graph.connectedPieces();
	if (pieces.size() > 1)
		return pieces;
	const std::vector<int> order = breadthFirst(breadthFirst(0, graph).back(), graph);
	const auto end = static_cast<std::ptrdiff_t>(0.45 * static_cast<double>(order.size()));
	graph.part =
		leastCut(graph, {order.begin(), order.begin() + end}, {order.end() - end, order.end()});
	return graph.connectedPieces();
}

} // namespace

Array<int>
leastCut(const DualGraph& graph, const std::vector<int>& from, const std::vector<int>& to)
{
	Array<Terminal> terminal(graph.part.size(), kNoTerminal);
	for (const int i : from)
		terminal[i] = kSource;
	for (const int i : to)
		terminal[i] = kSink;
	const auto forEdges = [&](int i, const auto& visit) {
		for (const Corner own : cornersOf(i))
			if (const Corner other = graph.joined(own);
				other.isValid() &&
				(terminal[i] == kNoTerminal || terminal[i] != terminal[other.face()]))
				visit(other.face(), own);
	};
	const auto rimOf = [&](const std::vector<int>& triangles) {
		std::vector<int> rim;
		for (const int i : triangles) {
			bool isOnRim = false;
			forEdges(i, [&](int, Corner) { isOnRim = true; });
			if (isOnRim)
				rim.push_back(i);
		}
		return rim;
	};
	const MinCut::Side side =
		MinCut(terminal.size()).run(rimOf(from), rimOf(to), [&](int i, const MinCut::AddEdge& add) {
			forEdges(i, [&](int j, Corner own) {
				const std::int64_t weight = graph.weight(own);
				add(j, weight, weight);
			});
		});
	Array<int> part(terminal.size(), 0);
	for (const int i : side.nodes)
		part[i] = 1;
	for (const int i : side.isOfSources ? from : to)
		part[i] = 1;
	return part;
}

Parts divideChart(const FlatMesh& chart, const OverlapSearch& overlaps)
{
	if (!overlaps.isComplete()) {
		Parts parts;
		for (const std::vector<int>& half : halves(chart)) {
			checkpoint();
			const FlatMesh own = chart.part(half);
			for (std::vector<int>& part : divideChart(own, OverlapSearch(own))) {
				for (int& i : part)
					i = half[positionOf(i)];
				parts.push_back(std::move(part));
			}
		}
		std::sort(parts.begin(), parts.end());
		return parts;
	}
	std::vector<TrianglePair> pairs = overlaps.pairs();
	for (;;) {
		Parts parts = ChartDivider(chart, pairs).run();
		Array<int> partOf(chart.size());
		for (std::size_t p = 0; p < parts.size(); ++p)
			for (const int i : parts[p])
				partOf[i] = static_cast<int>(p);
		const auto more = overlaps.uncovered(partOf);
		if (more.empty())
			return parts;
		pairs.insert(pairs.end(), more.begin(), more.end());
	}
}

} // namespace ricci
