// SPDX-License-Identifier: GPL-3.0-or-later
#include "hole_caps.h"

#include "../numbers.h"

namespace ricci {

namespace {

/// Centre of mass of a closed line; the mean of its points where it has no length.
Point3 centreOf(const std::vector<int>& loop, const std::vector<Point3>& positions)
{
	Point3 centre{0, 0, 0}, mean{0, 0, 0};
	double length = 0.0;
	for (std::size_t i = 0; i < loop.size(); ++i) {
		const Point3 &p = positions[at(loop[i])], &q = positions[at(loop[(i + 1) % loop.size()])];
		const double side = distance(p, q);
		length += side;
		for (std::size_t x = 0; x < 3; ++x) {
			centre[x] += 0.5 * side * (p[x] + q[x]);
			mean[x] += p[x] / static_cast<double>(loop.size());
		}
	}
	for (double& x : centre)
		x /= length;
	return length > 0.0 ? centre : mean;
}

} // namespace

CappedSurface capInnerLoops(const Triangulation& t, const std::vector<Point3>& positions)
{
	CappedSurface capped;
	capped.positions = positions;
	capped.onHole.assign(at(t.vertexCount()), 0);
	std::vector<Triangle> triangles(at(t.faceCount()));
	for (int f = 0; f < t.faceCount(); ++f) {
		const auto h = t.halfedges(f);
		triangles[at(f)] = {t.origin(h[0]), t.origin(h[1]), t.origin(h[2])};
	}
	// An outer halfedge runs as the side of the cap there does.
	std::vector<std::vector<int>> loops;
	std::size_t longest = 0;
	double most = -1.0;
	for (int first : t.boundaryLoops()) {
		std::vector<int> loop;
		double length = 0.0;
		int h = first;
		do {
			loop.push_back(t.origin(h));
			length += distance(positions[at(t.origin(h))], positions[at(t.target(h))]);
			h = t.next(h);
		} while (h != first);
		if (length > most) {
			most = length;
			longest = loops.size();
		}
		loops.push_back(std::move(loop));
	}
	for (std::size_t l = 0; l < loops.size(); ++l) {
		if (l == longest)
			continue;
		for (int v : loops[l])
			capped.onHole[at(v)] = 1;
		const int centre = static_cast<int>(capped.positions.size());
		capped.positions.push_back(centreOf(loops[l], positions));
		for (std::size_t i = 0; i < loops[l].size(); ++i)
			triangles.push_back({loops[l][i], loops[l][(i + 1) % loops[l].size()], centre});
		++capped.holes;
	}
	capped.triangulation = Triangulation(static_cast<int>(capped.positions.size()), triangles);
	return capped;
}

} // namespace ricci
