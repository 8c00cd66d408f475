// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CHORD_ARRANGEMENT_H
#define RICCI_CHORD_ARRANGEMENT_H

#include "../numbers.h"

#include <array>
#include <vector>

namespace ricci {

/// The faces into which two families of straight chords divide a convex polygon. No two chords of
/// one family cross, though they may share ends; a chord of the one crosses a chord of the other at
/// most once. All that is needed are the places where chords end: on the border, counted
/// counter-clockwise. Time and memory are in proportion to the places and crossings, but for the
/// logarithms of sorting; the arrays are kept from one polygon to the next.
class ChordArrangement
{
public:
	struct Chord
	{
		int from, to; ///< different places
	};

	/// Chords that join the same two places are one line.
	struct Line
	{
		int from, to;
		std::array<int, 2> chord{-1, -1}; ///< [family] or -1
		bool secondReversed = false;      ///< the second family's chord runs from 'to' to 'from'
		int firstCrossing = 0, crossingCount = 0;
		int firstSegment = 0;
		int rankAtFrom = 0, rankAtTo = 0; ///< in linesAt()
	};

	/// A line of the first family meets one of the second.
	struct Crossing
	{
		int first, second;     ///< lines
		int onFirst, onSecond; ///< index along either, from its 'from'
	};

	/// A side of a face, which lies on its left.
	struct Side
	{
		int node; ///< where it begins: a place, or the number of places plus that of a crossing
		/// The place where a side of the border begins; else the number of places plus that of the
		/// line's segment, common to the two faces there.
		int name;
		int line; ///< -1: on the border
		bool forward;
	};

	/// \p places >= 3 border places, and the chords of both families.
	void divide(int places, const std::vector<Chord>& first, const std::vector<Chord>& second);

	int faceCount() const { return static_cast<int>(m_firstSide.size()) - 1; }
	/// Sides of a face, counter-clockwise, are numbers firstSide(face) .. firstSide(face + 1) - 1.
	int firstSide(int face) const { return m_firstSide[at(face)]; }
	const Side& side(int i) const { return m_sides[at(i)]; }
	const Line& line(int i) const { return m_lines[at(i)]; }
	const std::vector<Crossing>& crossings() const { return m_crossings; }
	int segmentCount() const { return m_segments; }

	/// The lines that end at a place, counter-clockwise, beginning at the border's side that leaves
	/// it.
	struct LineRange
	{
		const int *first, *last;
		const int* begin() const { return first; }
		const int* end() const { return last; }
		int size() const { return static_cast<int>(last - first); }
	};
	LineRange linesAt(int place) const
	{
		return {
			m_lineAt.data() + m_firstLineAt[at(place)],
			m_lineAt.data() + m_firstLineAt[at(place + 1)]};
	}

	/// Index of the side's line in linesAt() the place where it begins; -1 on the border.
	int rank(const Side& side) const
	{
		return side.line < 0  ? -1
			   : side.forward ? m_lines[at(side.line)].rankAtFrom
							  : m_lines[at(side.line)].rankAtTo;
	}

private:
	int offset(int place, int from) const
	{
		return place >= from ? place - from : place - from + m_places;
	}
	static bool isFirst(const Line& line) { return line.chord[0] >= 0; }
	int far(int line, int place) const
	{
		return m_lines[at(line)].from == place ? m_lines[at(line)].to : m_lines[at(line)].from;
	}

	void makeLines(const std::vector<Chord>& first, const std::vector<Chord>& second);
	void gatherLinesAtPlaces();
	void findCrossings();
	void findCrossingsOf(int line);
	void orderCrossingsOnSecond();
	void traceFaces();
	Side after(const Side& side) const;
	Side leaving(int place, int rank) const;

	int m_places = 0, m_segments = 0;
	std::vector<Line> m_lines; // of the first family, then of the second alone
	std::vector<int> m_firstLineAt, m_lineAt;
	std::vector<int> m_secondEnds, m_nextSecondEnd; // places where lines of the second alone end
	std::vector<Crossing> m_crossings;              // in order along the lines of the first family
	std::vector<int> m_onSecond;                    // the same along those of the second
	std::vector<int> m_fill;
	std::vector<Side> m_sides;
	std::vector<int> m_firstSide;
	std::vector<char> m_traced;
};

} // namespace ricci

#endif
