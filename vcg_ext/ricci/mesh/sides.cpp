// SPDX-License-Identifier: GPL-3.0-or-later
#include "sides.h"

#include "../base/numbers.h"
#include "../base/tolerances.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ricci {

Sides::Sides(const std::vector<Triangle>& triangles)
{
	using Side = std::pair<int, Corner>; // with one of its ends
	m_across.resize(3 * triangles.size());
	m_sides.reserve(m_across.size());
	m_first.reserve(m_across.size() / 2 + 1);
	int count = 0;
	for (const Triangle& t : triangles)
		count = std::max(count, 1 + *std::max_element(t.begin(), t.end()));
	// By the lower end, of each by the higher one, of each by corner. The end is the one by which they are not sorted.
	const Adjacency<int, Side> byHigh(count, [&](const auto& add) {
		int corner = 0;
		for (const Triangle& t : triangles) {
			const auto [a, b, c] = t;
			add(std::max(a, b), Side{std::min(a, b), Corner(corner++)});
			add(std::max(b, c), Side{std::min(b, c), Corner(corner++)});
			add(std::max(c, a), Side{std::min(c, a), Corner(corner++)});
		}
	});
	const Adjacency<int, Side> byLow(count, [&](const auto& add) {
		for (int high = 0; high < count; ++high)
			for (const auto& [low, side] : byHigh[high])
				add(low, Side{high, side});
	});
	const auto start = [&](Corner c) { return triangles[positionOf(c.face())][c.index()]; };
	for (int low = 0; low < count; ++low) {
		const ItemRange<const Side> sides = byLow[low];
		for (const Side *first = sides.begin(), *last = first; first != sides.end(); first = last) {
			m_first.push_back(m_sides.size());
			for (; last != sides.end() && last->first == first->first; ++last)
				m_sides.push_back(last->second);
			const Corner side = first->second, other = last[-1].second;
			if (last - first == 2 && start(side) != start(other)) {
				m_across[side] = other;
				m_across[other] = side;
			}
		}
	}
	m_first.push_back(m_sides.size());
}

namespace {

/// Of length 1; 0 where a triangle is too thin.
Point3 normal(const Point3& a, const Point3& b, const Point3& c)
{
	const Point3 n = cross(b - a, c - a);
	const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
	const double size = length(n);
	if (!(size > kThinTriangle * longest * longest))
		return {0.0, 0.0, 0.0};
	return n / size;
}

/// Angle at a.
double angleAt(const Point3& a, const Point3& b, const Point3& c)
{
	return std::atan2(length(cross(b - a, c - a)), dot(b - a, c - a));
}

enum class At : char { Between, Crease, Boundary };

/// [triangle] Normals of length 1; 0 where a triangle is too thin to have one (kThinTriangle).
Array<Point3>
normalsOf(const std::vector<Point3>& positions, const std::vector<Triangle>& triangles)
{
	Array<Point3> normals;
	for (const Triangle& t : triangles)
		normals.push_back(normal(
			positions[positionOf(t[0])], positions[positionOf(t[1])], positions[positionOf(t[2])]));
	return normals;
}

} // namespace

Array<Point3> normalsOf(
	const std::vector<Point3>& positions,
	const std::vector<Triangle>& triangles,
	const CornerArray<Corner>& across)
{
	Array<Point3> normals = normalsOf(positions, triangles);
	const auto has = [&](int f) { return dot(normals[f], normals[f]) > 0.0; };
	const auto isLongest = [&](Corner side) {
		const std::array<double, 3> l = sideLengths(triangles[positionOf(side.face())], positions);
		return l[side.index()] == *std::max_element(l.begin(), l.end());
	};
	// Sides of triangles without a normal, across from one that has it.
	std::vector<Corner> longest, others;
	const auto reach = [&](Corner side) {
		const Corner other = across[side];
		if (other.isValid() && !has(other.face()))
			(isLongest(other) ? longest : others).push_back(other);
	};
	for (const int f : normals.indices())
		for (const Corner side : cornersOf(f))
			if (has(f))
				reach(side);
	while (!longest.empty() || !others.empty()) {
		std::vector<Corner>& sides = longest.empty() ? others : longest;
		const Corner side = sides.back(), from = across[side];
		sides.pop_back();
		const int f = side.face();
		if (has(f))
			continue;
		const auto start = [&](Corner c) { return triangles[positionOf(c.face())][c.index()]; };
		normals[f] = (start(side) == start(from) ? -1.0 : 1.0) * normals[from.face()];
		for (const Corner own : cornersOf(f))
			reach(own);
	}
	return normals;
}

bool isCrease(const Point3& m, const Point3& n, double cosine)
{
	return dot(m, m) > 0.0 && dot(n, n) > 0.0 && dot(m, n) < cosine;
}

Creases creases(
	const std::vector<Point3>& positions,
	const std::vector<Triangle>& triangles,
	const Sides& sides,
	double angle)
{
	const auto at = [&](int v) -> const Point3& { return positions[positionOf(v)]; };
	const Array<Point3> normals = normalsOf(positions, triangles);
	Creases result;
	result.sides.resize(triangles.size(), {0, 0, 0});
	Array<At> where(static_cast<int>(positions.size()), At::Between);
	const double cosine = std::cos(angle);
	sides.forEdges([&](const auto& edge) {
		const Corner side = edge[0];
		const Triangle& t = triangles[positionOf(side.face())];
		const auto mark = [&](At place) {
			for (const int v : {t[side.index()], t[side.next().index()]})
				where[v] = std::max(where[v], place);
		};
		if (edge.size() != 2)
			return mark(At::Boundary);
		if (!isCrease(normals[edge[0].face()], normals[edge[1].face()], cosine))
			return;
		result.sides[positionOf(side.face())][side.index()] = 1;
		++result.edges;
		mark(At::Crease);
	});
	if (result.edges == 0)
		return result;
	Array<double> curvature(where.size(), 2.0 * kPi);
	for (const Triangle& t : triangles)
		for (std::size_t k = 0; k < 3; ++k)
			curvature[t[k]] -= angleAt(at(t[k]), at(t[(k + 1) % 3]), at(t[(k + 2) % 3]));
	double between = 0.0, all = 0.0;
	for (const int v : where.indices())
		if (where[v] != At::Boundary) {
			all += std::abs(curvature[v]);
			between += where[v] == At::Between ? std::abs(curvature[v]) : 0.0;
		}
	result.curvatureBetween = all > 0.0 ? between / all : 0.0;
	return result;
}

std::function<bool(Corner, Corner)> jumpsOf(const std::vector<MappedFace>& map)
{
	Box2 box;
	for (const MappedFace& face : map)
		for (const Point2& p : face.uv)
			if (std::isfinite(p[0]) && std::isfinite(p[1]))
				box.add(p);
	const double bound = kSameCoordinate * std::max(0.0, box.extent());
	return [&map, bound](Corner a, Corner b) {
		const MappedFace &f = map[positionOf(a.face())], &g = map[positionOf(b.face())];
		const auto differ = [&](std::size_t k) {
			const double x = f.uv[a.index()][k], y = g.uv[b.index()][k];
			return !(std::abs(x - y) <= bound) && x != y && !(std::isnan(x) && std::isnan(y));
		};
		return f.picture != g.picture || differ(0) || differ(1);
	};
}

} // namespace ricci
