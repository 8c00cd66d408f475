// SPDX-License-Identifier: GPL-3.0-or-later
#include "numbered_points.h"

#include "../math/adjacency.h"

#include <algorithm>

namespace ricci {

namespace {

Point2 centreOf(const Array<Point2>& points)
{
	Point2 centre{0.0, 0.0};
	for (const Point2& p : points)
		for (std::size_t k = 0; k < 2; ++k)
			centre[k] += p[k] / static_cast<double>(points.size());
	return centre;
}

int farthestFrom(const Point2& from, const Array<Point2>& points)
{
	int farthest = 0;
	for (const int p : points.indices())
		if (distance(from, points[p]) > distance(from, points[farthest]))
			farthest = p;
	return farthest;
}

/// The vertices of a flat mesh in the order of a walk (see NumberedPoints).
std::vector<int> walk(const FlatMesh& flat)
{
	const Point2 centre = centreOf(flat.place);
	const int count = flat.vertexCount();
	Array<double> reach(count, -1.0); // from the centre
	for (int c = 0; c < 3 * flat.points.size(); ++c) {
		double& known = reach[flat.vertices[Corner(c)]];
		known = std::max(known, distance(centre, flat.place[flat.points[Corner(c)]]));
	}
	const auto isBefore = [&](int a, int b) {
		return reach[a] != reach[b] ? reach[a] > reach[b] : a < b;
	};
	const Adjacency<int, int> neighbours(count, [&](const auto& add) {
		for (const Triangle& t : flat.vertices)
			for (std::size_t k = 0; k < 3; ++k) {
				add(t[k], t[(k + 1) % 3]);
				add(t[k], t[(k + 2) % 3]);
			}
	});
	std::vector<int> walk;
	Array<char> seen(count, 0);
	const auto visit = [&](int v) {
		if (!seen[v])
			walk.push_back(v);
		seen[v] = 1;
	};
	int farthest = 0;
	for (int v = 1; v < count; ++v)
		if (isBefore(v, farthest))
			farthest = v;
	visit(farthest);
	for (std::size_t i = 0; i < walk.size(); ++i) {
		const std::size_t first = walk.size();
		for (const int next : neighbours[walk[i]])
			visit(next);
		std::sort(walk.begin() + static_cast<std::ptrdiff_t>(first), walk.end(), isBefore);
	}
	return walk;
}

} // namespace

NumberedPoints::NumberedPoints(const FlatMesh& flat, const PointGroups& groups) :
		number(flat.place.size(), -1)
{
	const int count = number.size();
	Array<char> stays(count);
	for (const int p : stays.indices())
		stays[p] = groups.fixed[groups.group[p]];
	if (std::find(stays.begin(), stays.end(), 1) == stays.end()) {
		const int first = farthestFrom(centreOf(flat.place), flat.place);
		stays[first] = stays[farthestFrom(flat.place[first], flat.place)] = 1;
	}
	Array<int> firstAt(flat.vertexCount(), -1); // [vertex] first point of a group that moves
	for (int c = 0; c < 3 * flat.points.size(); ++c)
		if (const int p = flat.points[Corner(c)]; !stays[p] && groups.first[groups.group[p]] == p)
			firstAt[flat.vertices[Corner(c)]] = p;
	for (const int v : walk(flat))
		if (firstAt[v] >= 0)
			number[firstAt[v]] = unknowns++;
	moving = unknowns;
	for (const int p : number.indices())
		if (!stays[p] && number[p] < 0)
			number[p] = moving++;
	int next = moving;
	for (int& n : number)
		if (n < 0)
			n = next++;
	unknown.assign(count, -1);
	turn.assign(count, 1.0);
	for (const int p : number.indices())
		if (!stays[p]) {
			unknown[number[p]] = number[groups.first[groups.group[p]]];
			turn[number[p]] = groups.turn[p];
		}
}

} // namespace ricci
