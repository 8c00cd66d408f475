// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_DELAUNAY_QUEUE_H
#define RICCI_DELAUNAY_QUEUE_H

#include "../base/task.h"
#include "../error.h"
#include "../surface/triangulation.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ricci {

/// Flips end by themselves in exact arithmetic: each one raises the function whose creases the edges
/// are, so that no triangulation comes twice. But their number has no bound by that of the edges: a
/// strip of triangles wound k times round a torus of one vertex takes k flips, and k may be about
/// kNeedleRatio. More than this many are rounding's, which goes round in circles.
inline std::int64_t maxFlips(int edgeCount)
{
	constexpr std::int64_t kWindings = 10000000, kPerEdge = 1000;
	return std::max(kWindings, kPerEdge * edgeCount);
}

/// Edges that wait for their test, and the work space of the searches that flip them.
struct DelaunayQueue
{
	std::vector<Edge> edges; ///< a stack
	EdgeArray<char> queued;  ///< 1 where the edge waits, on the stack or for its turn by number

	/// Tests \p first and, last come first served, the sides of the quad of every edge that is
	/// flipped, until no edge is left on the stack. \p isGood(e) tells whether edge e stays, \p
	/// flip(e) flips it in \p t and in what belongs to it.
	/// \param flips counts the flips of all calls
	/// \pre the stack is empty, queued[first] is 0; edges that are queued wait for a later call
	/// \throw NotConverged (FlipsUsedUp) beyond maxFlips()
	template<class IsGood, class Flip>
	void flipFrom(Edge first, const Triangulation& t, std::int64_t& flips, IsGood isGood, Flip flip)
	{
		edges.push_back(first);
		while (!edges.empty()) {
			const Edge e = edges.back();
			edges.pop_back();
			queued[e] = 0;
			if (isGood(e))
				continue;
			if (flips >= maxFlips(t.edgeCount()))
				throw NotConverged(NotConverged::FlipsUsedUp, static_cast<std::size_t>(flips));
			checkpointNowAndThen(static_cast<std::size_t>(flips));
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
