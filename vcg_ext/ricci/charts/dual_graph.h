// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_DUAL_GRAPH_H
#define RICCI_DUAL_GRAPH_H

#include "../layout/flat_mesh.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace ricci {

/// The dual graph of charts that fall into parts: triangles with joined sides are neighbours. An edge
/// weighs what it costs to cut it: its length, times the mean price of its two triangles.
class DualGraph
{
public:
	explicit DualGraph(const FlatMesh& chart) : part(chart.size(), 0), m_chart(chart)
	{
		for (const auto& lengths : chart.lengths)
			m_longest = std::max({m_longest, lengths[0], lengths[1], lengths[2]});
	}

	Corner joined(Corner side) const { return m_chart.joined(side); }

	/// joined(), if it is in the same part; else none.
	Corner neighbour(Corner side) const
	{
		const Corner other = joined(side);
		return other.isValid() && part[other.face()] == part[side.face()] ? other : Corner();
	}

	/// In units of 1e-9 of the longest edge, at least 1.
	/// \pre the side is joined
	std::int64_t weight(Corner side) const
	{
		constexpr double kUnits = 1e9;
		if (!(m_longest > 0.0))
			return 1;
		double cost = m_chart.lengths[side] / m_longest;
		if (!price.empty())
			cost *= 0.5 * (price[side.face()] + price[joined(side).face()]);
		return static_cast<std::int64_t>(cost * kUnits) + 1;
	}

	/// The connected pieces of all parts: the triangles of each, in increasing order.
	std::vector<std::vector<int>> connectedPieces() const
	{
		return connectedPieces(part.indices());
	}

	/// Those that have some of these triangles.
	template<class Triangles>
	std::vector<std::vector<int>> connectedPieces(const Triangles& triangles) const
	{
		Array<int> number(part.size(), -1); // of its piece
		std::vector<std::vector<int>> pieces;
		std::vector<int> next;
		for (const int first : triangles) {
			if (number[first] >= 0)
				continue;
			const int piece = number[first] = static_cast<int>(pieces.size());
			pieces.emplace_back();
			for (next.push_back(first); !next.empty();) {
				const int f = next.back();
				next.pop_back();
				for (const Corner side : cornersOf(f))
					if (const Corner other = neighbour(side);
						other.isValid() && number[other.face()] < 0) {
						number[other.face()] = piece;
						next.push_back(other.face());
					}
			}
		}
		for (const int f : number.indices())
			if (number[f] >= 0)
				pieces[positionOf(number[f])].push_back(f);
		return pieces;
	}

	Array<int> part;     ///< [triangle] number
	Array<double> price; ///< [triangle] of a unit of length; empty: 1 everywhere

private:
	const FlatMesh& m_chart;
	double m_longest = 0.0; // edge, on the surface
};

} // namespace ricci

#endif
