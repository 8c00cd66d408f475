// SPDX-License-Identifier: GPL-3.0-or-later
#include "hole_caps.h"

#include <utility>

namespace ricci {

namespace {

/// Centre of mass of a closed line; the mean of its points where it has no length.
Point3 centreOf(const std::vector<Vertex>& loop, const VertexArray<Point3>& positions)
{
	Point3 centre{0, 0, 0}, mean{0, 0, 0};
	double length = 0.0;
	for (std::size_t i = 0; i < loop.size(); ++i) {
		const Point3 &p = positions[loop[i]], &q = positions[loop[(i + 1) % loop.size()]];
		const double side = distance(p, q);
		length += side;
		centre += 0.5 * side * (p + q);
		mean += p / static_cast<double>(loop.size());
	}
	return length > 0.0 ? centre / length : mean;
}

} // namespace

CappedSurface capHoles(
	const Triangulation& t, const VertexArray<Point3>& positions, const EdgeArray<char>& isHole)
{
	CappedSurface capped;
	capped.positions = positions;
	capped.onHole.assign(t.vertexCount(), 0);
	for (const Face f : t.faces()) {
		const auto [a, b, c] = t.vertices(f);
		capped.triangles.push_back({a.number(), b.number(), c.number()});
	}
	// An exterior halfedge has the direction of the side of the cap there.
	std::vector<std::vector<Vertex>> loops;
	std::vector<char> isClosed; // [loop]
	std::size_t longest = 0;
	double maxLength = -1.0;
	for (const Halfedge first : t.boundaryLoops()) {
		std::vector<Vertex> loop;
		double length = 0.0;
		bool all = true;
		for (const Halfedge h : t.loop(first)) {
			all &= isHole.empty() || isHole[h.edge()];
			loop.push_back(t.origin(h));
			length += distance(positions[t.origin(h)], positions[t.target(h)]);
		}
		if (length > maxLength) {
			maxLength = length;
			longest = loops.size();
		}
		isClosed.push_back(all);
		loops.push_back(std::move(loop));
	}
	if (isHole.empty() && !loops.empty())
		isClosed[longest] = 0;
	for (std::size_t l = 0; l < loops.size(); ++l) {
		if (!isClosed[l])
			continue;
		const std::vector<Vertex>& loop = loops[l];
		const int centre = capped.positions.size();
		capped.positions.push_back(centreOf(loop, positions));
		for (std::size_t i = 0; i < loop.size(); ++i) {
			capped.onHole[loop[i]] = 1;
			capped.triangles.push_back(
				{loop[i].number(), loop[(i + 1) % loop.size()].number(), centre});
		}
		++capped.holes;
	}
	return capped;
}

} // namespace ricci
