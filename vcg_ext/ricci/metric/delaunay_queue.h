// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_DELAUNAY_QUEUE_H
#define RICCI_DELAUNAY_QUEUE_H

#include "../surface/triangulation.h"

#include <cstdint>
#include <vector>

namespace ricci {

/// Flips end by themselves in exact arithmetic; this bounds them where rounding decides, or where
/// values run out of range.
constexpr std::int64_t kMaxFlipsPerEdge = 1000;

/// Edges that wait for their test, and the work space of the searches that flip them.
struct DelaunayQueue
{
	std::vector<Edge> edges; ///< a stack
	EdgeArray<char> queued;  ///< 1 where the edge waits, on the stack or for its turn by number

	/// Tests \p first and, last come first served, the sides of the quad of every edge that is
	/// flipped, until no edge is left on the stack. \p isGood(e) tells whether edge e stays, \p
	/// flip(e) flips it in \p t and in what belongs to it.
	/// \param flips counts the flips; none is made from \p maxFlips on
	/// \pre the stack is empty, queued[first] is 0; edges that are queued wait for a later call
	template<class IsGood, class Flip>
	void flipFrom(
		Edge first,
		const Triangulation& t,
		std::int64_t& flips,
		std::int64_t maxFlips,
		IsGood isGood,
		Flip flip)
	{
		edges.push_back(first);
		while (!edges.empty()) {
			const Edge e = edges.back();
			edges.pop_back();
			queued[e] = 0;
			if (flips >= maxFlips || isGood(e))
				continue;
			const auto quad = t.quad(e);
			flip(e);
			++flips;
			for (const Halfedge side : quad)
				if (!queued[side.edge()]) {
					queued[side.edge()] = 1;
					edges.push_back(side.edge());
				}
		}
	}
};

} // namespace ricci

#endif
