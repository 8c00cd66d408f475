// SPDX-License-Identifier: GPL-3.0-or-later
#include "chord_arrangement.h"

#include <algorithm>
#include <numeric>

namespace ricci {

void ChordArrangement::divide(
	int places, const std::vector<Chord>& first, const std::vector<Chord>& second)
{
	m_places = places;
	makeLines(first, second);
	findCrossings();
	traceFaces();
}

void ChordArrangement::makeLines(const std::vector<Chord>& first, const std::vector<Chord>& second)
{
	m_lines.clear();
	const auto add = [&](const Chord& chord, std::size_t family, std::size_t index) {
		Line line;
		line.from = chord.from;
		line.to = chord.to;
		line.chord[family] = static_cast<int>(index);
		m_lines.push_back(line);
	};
	for (std::size_t i = 0; i < first.size(); ++i)
		add(first[i], 0, i);
	gatherLinesAtPlaces();
	for (std::size_t i = 0; i < second.size(); ++i) {
		const Chord& chord = second[i];
		int same = -1;
		const LineRange here = linesAt(chord.from), there = linesAt(chord.to);
		if (here.size() <= there.size()) {
			for (int line : here)
				same = far(line, chord.from) == chord.to ? line : same;
		}
		else
			for (int line : there)
				same = far(line, chord.to) == chord.from ? line : same;
		if (same < 0) {
			add(chord, 1, i);
			continue;
		}
		m_lines[at(same)].chord[1] = static_cast<int>(i);
		m_lines[at(same)].secondReversed = m_lines[at(same)].from != chord.from;
	}
	if (!second.empty())
		gatherLinesAtPlaces();
}

void ChordArrangement::gatherLinesAtPlaces()
{
	m_firstLineAt.assign(at(m_places) + 1, 0);
	for (const Line& line : m_lines) {
		++m_firstLineAt[at(line.from) + 1];
		++m_firstLineAt[at(line.to) + 1];
	}
	std::partial_sum(m_firstLineAt.begin(), m_firstLineAt.end(), m_firstLineAt.begin());
	m_fill.assign(m_firstLineAt.begin(), m_firstLineAt.end());
	m_lineAt.resize(2 * m_lines.size());
	for (std::size_t i = 0; i < m_lines.size(); ++i)
		for (int place : {m_lines[i].from, m_lines[i].to})
			m_lineAt[at(m_fill[at(place)]++)] = static_cast<int>(i);
	for (int place = 0; place < m_places; ++place) {
		const int begin = m_firstLineAt[at(place)], end = m_firstLineAt[at(place + 1)];
		if (end - begin > 1)
			std::sort(m_lineAt.begin() + begin, m_lineAt.begin() + end, [&](int a, int b) {
				return offset(far(a, place), place) < offset(far(b, place), place);
			});
		for (int k = begin; k < end; ++k) {
			Line& line = m_lines[at(m_lineAt[at(k)])];
			(line.from == place ? line.rankAtFrom : line.rankAtTo) = k - begin;
		}
	}
}

void ChordArrangement::findCrossings()
{
	m_crossings.clear();
	// Next place, from each on, where a line of the second family alone ends.
	m_nextSecondEnd.assign(at(m_places) + 1, m_places);
	for (int place = m_places - 1; place >= 0; --place) {
		m_nextSecondEnd[at(place)] = m_nextSecondEnd[at(place + 1)];
		for (int line : linesAt(place))
			if (!isFirst(m_lines[at(line)]))
				m_nextSecondEnd[at(place)] = place;
	}
	for (std::size_t i = 0; i < m_lines.size(); ++i) {
		m_lines[i].firstCrossing = static_cast<int>(m_crossings.size());
		m_lines[i].crossingCount = 0;
		if (isFirst(m_lines[i])) {
			findCrossingsOf(static_cast<int>(i));
			m_lines[i].crossingCount =
				static_cast<int>(m_crossings.size()) - m_lines[i].firstCrossing;
		}
	}
	orderCrossingsOnSecond();
	m_segments = 0;
	for (Line& line : m_lines) {
		line.firstSegment = m_segments;
		m_segments += line.crossingCount + 1;
	}
}

/// Walks along the border on one side of a line of the first family and gathers the lines of the
/// second that end there and beyond it. Lines that end twice on the way enclose places from where
/// no other can leave, so these are passed over.
void ChordArrangement::findCrossingsOf(int index)
{
	const Line& line = m_lines[at(index)];
	const bool shorter = offset(line.to, line.from) <= offset(line.from, line.to);
	const int begin = shorter ? line.from : line.to, end = shorter ? line.to : line.from;
	const int span = offset(end, begin);
	const std::size_t firstFound = m_crossings.size();
	for (int reached = 1; reached < span;) {
		const int from = begin + reached < m_places ? begin + reached : begin + reached - m_places;
		int place = m_nextSecondEnd[at(from)];
		if (place == m_places)
			place = m_nextSecondEnd[0];
		if (place == m_places)
			break;
		const int here = offset(place, begin);
		if (here < reached || here >= span) // beyond the line
			break;
		reached = here + 1;
		const std::size_t found = m_crossings.size();
		for (int other : linesAt(place)) {
			const int there = offset(far(other, place), begin);
			if (isFirst(m_lines[at(other)]) || there < here)
				continue;
			if (there > span)
				m_crossings.push_back({index, other, 0, 0});
			else
				reached = there;
		}
		// From one place they spread beyond the line against the direction of the walk.
		std::reverse(m_crossings.begin() + static_cast<std::ptrdiff_t>(found), m_crossings.end());
	}
	const auto own = m_crossings.begin() + static_cast<std::ptrdiff_t>(firstFound);
	if (!shorter)
		std::reverse(own, m_crossings.end());
	for (std::size_t k = firstFound; k < m_crossings.size(); ++k)
		m_crossings[k].onFirst = static_cast<int>(k - firstFound);
}

void ChordArrangement::orderCrossingsOnSecond()
{
	for (const Crossing& x : m_crossings)
		++m_lines[at(x.second)].crossingCount;
	int sum = 0;
	for (Line& line : m_lines)
		if (!isFirst(line)) {
			line.firstCrossing = sum;
			sum += line.crossingCount;
			line.crossingCount = 0;
		}
	m_onSecond.resize(m_crossings.size());
	for (std::size_t k = 0; k < m_crossings.size(); ++k) {
		Line& line = m_lines[at(m_crossings[k].second)];
		m_onSecond[at(line.firstCrossing + line.crossingCount++)] = static_cast<int>(k);
	}
	for (const Line& line : m_lines) {
		if (isFirst(line) || line.crossingCount == 0)
			continue;
		const int span = offset(line.to, line.from);
		// Ends of a crossing line, on either side of this one, as distances from its beginning.
		const auto ends = [&](int crossing) {
			const Line& other = m_lines[at(m_crossings[at(crossing)].first)];
			const int a = offset(other.from, line.from), b = offset(other.to, line.from);
			return a < span ? std::array<int, 2>{a, -b} : std::array<int, 2>{b, -a};
		};
		const auto begin = m_onSecond.begin() + line.firstCrossing;
		std::sort(
			begin, begin + line.crossingCount, [&](int a, int b) { return ends(a) < ends(b); });
		for (int k = 0; k < line.crossingCount; ++k)
			m_crossings[at(m_onSecond[at(line.firstCrossing + k)])].onSecond = k;
	}
}

ChordArrangement::Side ChordArrangement::leaving(int place, int rank) const
{
	if (rank < 0)
		return {place, place, -1, true};
	const int index = m_lineAt[at(m_firstLineAt[at(place)] + rank)];
	const Line& line = m_lines[at(index)];
	const bool forward = line.from == place;
	const int segment = line.firstSegment + (forward ? 0 : line.crossingCount);
	return {place, m_places + segment, index, forward};
}

/// The next side of the same face: the leftmost turn.
ChordArrangement::Side ChordArrangement::after(const Side& side) const
{
	if (side.line < 0) {
		const int place = side.node + 1 == m_places ? 0 : side.node + 1;
		return leaving(place, linesAt(place).size() - 1);
	}
	const Line& line = m_lines[at(side.line)];
	const int segment = side.name - m_places - line.firstSegment;
	const int crossing = side.forward ? segment : segment - 1; // at the side's end
	if (crossing < 0 || crossing == line.crossingCount)
		return side.forward ? leaving(line.to, line.rankAtTo - 1)
							: leaving(line.from, line.rankAtFrom - 1);
	const int number = isFirst(line) ? line.firstCrossing + crossing
									 : m_onSecond[at(line.firstCrossing + crossing)];
	const Crossing& x = m_crossings[at(number)];
	const int next = isFirst(line) ? x.second : x.first;
	const int index = isFirst(line) ? x.onSecond : x.onFirst;
	const Line& other = m_lines[at(next)];
	// On the left are the places from where this way leads to where it comes from.
	const int to = side.forward ? line.to : line.from, from = side.forward ? line.from : line.to;
	const bool forward = offset(other.to, to) < offset(from, to);
	return {
		m_places + number,
		m_places + other.firstSegment + (forward ? index + 1 : index),
		next,
		forward};
}

void ChordArrangement::traceFaces()
{
	m_sides.clear();
	m_firstSide.assign(1, 0);
	m_traced.assign(at(m_places) + 2 * at(m_segments), 0);
	const auto mark = [&](const Side& side) -> char& {
		return m_traced
			[side.line < 0 ? at(side.name)
						   : at(m_places) + 2 * at(side.name - m_places) + (side.forward ? 0 : 1)];
	};
	const auto trace = [&](const Side& begin) {
		if (mark(begin))
			return;
		for (Side side = begin; !mark(side); side = after(side)) {
			mark(side) = 1;
			m_sides.push_back(side);
		}
		m_firstSide.push_back(static_cast<int>(m_sides.size()));
	};
	for (int place = 0; place < m_places; ++place)
		trace({place, place, -1, true});
	for (std::size_t i = 0; i < m_lines.size(); ++i) {
		const Line& line = m_lines[i];
		for (int k = 0; k <= line.crossingCount; ++k) {
			const int name = m_places + line.firstSegment + k;
			const auto node = [&](int crossing) {
				return m_places + (isFirst(line) ? line.firstCrossing + crossing
												 : m_onSecond[at(line.firstCrossing + crossing)]);
			};
			trace({k == 0 ? line.from : node(k - 1), name, static_cast<int>(i), true});
			trace({k == line.crossingCount ? line.to : node(k), name, static_cast<int>(i), false});
		}
	}
}

} // namespace ricci
