// SPDX-License-Identifier: GPL-3.0-or-later
#include "hole_seams.h"

#include "../numbers.h"

#include <numeric>

namespace ricci {

void dropSeamsToHoles(
	const Triangulation& t,
	const std::vector<double>& lengths,
	const std::vector<char>& closes,
	const std::vector<char>& marked,
	CutGraph& cut)
{
	// A boundary loop is one node of the cut, and so is every other vertex.
	std::vector<int> node(at(t.vertexCount()));
	std::iota(node.begin(), node.end(), 0);
	std::vector<char> terminal = marked;
	for (int first : t.boundaryLoops()) {
		const int own = t.origin(first);
		bool needed = !closes[at(own)];
		int h = first;
		do {
			node[at(t.origin(h))] = own;
			needed |= marked[at(t.origin(h))] != 0;
			h = t.next(h);
		} while (h != first);
		terminal[at(own)] = needed;
	}
	std::vector<std::vector<int>> edgesAt(at(t.vertexCount()));
	std::vector<int> degree(at(t.vertexCount()), 0);
	for (int e = 0; e < t.edgeCount(); ++e)
		if (cut.isCut[at(e)])
			for (int h : {2 * e, 2 * e + 1}) {
				edgesAt[at(node[at(t.origin(h))])].push_back(e);
				++degree[at(node[at(t.origin(h))])];
			}
	std::vector<int> ends;
	for (int n = 0; n < t.vertexCount(); ++n)
		if (degree[at(n)] == 1 && !terminal[at(n)])
			ends.push_back(n);
	while (!ends.empty()) {
		const int end = ends.back();
		ends.pop_back();
		for (int e : edgesAt[at(end)]) {
			if (!cut.isCut[at(e)])
				continue;
			cut.isCut[at(e)] = 0;
			--cut.edgeCount;
			cut.length -= lengths[at(e)];
			const int a = node[at(t.origin(2 * e))], b = node[at(t.target(2 * e))];
			const int other = a == end ? b : a;
			if (--degree[at(other)] == 1 && !terminal[at(other)])
				ends.push_back(other);
		}
		degree[at(end)] = 0;
	}
	if (cut.edgeCount == 0)
		cut.length = 0.0; // without the rounding of a sum taken back
}

} // namespace ricci
