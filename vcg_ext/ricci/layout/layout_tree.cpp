// SPDX-License-Identifier: GPL-3.0-or-later
#include "layout_tree.h"

#include "../math/shortest_paths.h"

#include <algorithm>

namespace ricci {

std::vector<Halfedge> layoutTree(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const EdgeArray<char>& isCut,
	Face root)
{
	const auto loss = [&](Halfedge across) {
		double longest = 0.0;
		for (const Halfedge h : {across, across.twin()})
			for (const Halfedge side : t.loop(h))
				longest = std::max(longest, lengths[side.edge()]);
		return longest / lengths[across.edge()];
	};
	// Ways into triangles by their loss. Of equal ones the lowest halfedge comes first, whichever
	// triangle it enters.
	DistanceQueue<Halfedge> queue;
	FaceArray<char> seen(t.faceCount(), 0);
	const auto leave = [&](Face f, double lost) {
		seen[f] = 1;
		for (const Halfedge h : t.halfedges(f)) {
			const Halfedge across = h.twin();
			if (!isCut[h.edge()] && !t.isExterior(across) && !seen[t.face(across)])
				queue.push(lost + loss(across), across);
		}
	};
	std::vector<Halfedge> order;
	leave(root, 0.0);
	while (!queue.empty()) {
		const auto [lost, h] = queue.pop();
		if (seen[t.face(h)])
			continue;
		order.push_back(h);
		leave(t.face(h), lost);
	}
	return order;
}

} // namespace ricci
