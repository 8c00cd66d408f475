// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_BORDER_FLOW_H
#define RICCI_BORDER_FLOW_H

#include "dual_graph.h"

#include <cstdint>
#include <vector>

namespace ricci {

/// What a triangle is for a cut.
enum Terminal : char { kNoTerminal, kSource, kSink };

/// A feasible flow from sources to sinks through a part of a chart, found by duality: the difference
/// of a function of the vertices across each edge is a flow without sources but where the function
/// has no single value. With the distance from one place where the rim of the sources meets the
/// border of the part, cut off at the distance of the other one, this is the maximum flow if the
/// sinks lie at the border too [Hassin 1981]. In other cases something is left to be found.
class BorderFlow
{
public:
	explicit BorderFlow(const DualGraph& graph);

	/// Finds the flow between triangles of one part.
	/// \param terminal [triangle]
	void find(
		const std::vector<int>& sources,
		const std::vector<int>& sinks,
		const Array<Terminal>& terminal);

	/// The flow that leaves its triangle across a side, at most its weight.
	std::int64_t across(Corner side) const { return excessAt(side.next()) - excessAt(side); }

private:
	struct Node
	{
		Corner corner;
		int path = -1;
		std::int64_t distance = 0;
	};
	struct Path
	{
		std::int64_t sign, length;
	};

	int
	findFrom(const std::vector<int>& triangles, std::int64_t sign, const Array<Terminal>& terminal);
	Corner besideOnRim(Corner side, bool isNext, const Array<Terminal>& terminal) const;
	void measure(Corner from, Corner to, const Array<Terminal>& terminal);
	int nodeAt(Corner corner);
	std::int64_t excessAt(Corner corner) const;
	template<class Visit>
	void forCorners(Corner corner, const Visit& visit) const;

	const DualGraph& m_graph;
	CornerArray<int> m_nodeAt;   // -1 where no path has been
	std::vector<Corner> m_known; // corners where one has been
	Array<Node> m_nodes;         // vertices of the part
	Array<Path> m_paths;
	std::size_t m_mostNodes = 0; // that a path looks at,
	std::size_t m_spareNodes;    // and these beyond, of all paths: as many as corners
};

} // namespace ricci

#endif
