// SPDX-License-Identifier: GPL-3.0-or-later
#include "hole_seams.h"

#include "../numbers.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ricci {

namespace {

/// Sides of a seam that are this near to each other, relative to the layout's size, differ by
/// rounding.
constexpr double kOnePlace = 1e-9;

} // namespace

std::vector<char>
loopsThatClose(const Triangulation& t, const PlanarLayout& layout, const std::vector<char>& isCut)
{
	double size = 0.0;
	for (const Point2& p : layout.position)
		size = std::max({size, std::abs(p[0]), std::abs(p[1])});
	const auto apart = [&](const Point2& p, const Point2& q) {
		return !(std::hypot(p[0] - q[0], p[1] - q[1]) <= kOnePlace * size);
	};
	std::vector<char> opens(at(t.vertexCount()), 0); // at an edge whose sides lie apart
	for (int e = 0; e < t.edgeCount(); ++e) {
		if (!isCut[at(e)] || t.isBoundaryEdge(e))
			continue;
		const int h = 2 * e, g = h + 1;
		if (apart(layout.at(h), layout.at(t.next(g))) || apart(layout.at(t.next(h)), layout.at(g)))
			opens[at(t.origin(h))] = opens[at(t.origin(g))] = 1;
	}
	std::vector<char> closes(at(t.vertexCount()), 0);
	for (int first : t.boundaryLoops()) {
		bool all = true;
		int h = first;
		do {
			all &= !opens[at(t.origin(h))];
			h = t.next(h);
		} while (h != first);
		do {
			closes[at(t.origin(h))] = all;
			h = t.next(h);
		} while (h != first);
	}
	return closes;
}

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
