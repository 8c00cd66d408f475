// SPDX-License-Identifier: GPL-3.0-or-later
#include "creases.h"

#include "../base/numbers.h"

#include <algorithm>
#include <cmath>

namespace ricci {

namespace {

/// A triangle whose height is a smaller share of its longest side is too thin to have a normal: its
/// corners are rounded in files to about 1e-6 of their size.
constexpr double kMinHeight = 1e-4;

/// Of length 1; 0 where a triangle is too thin.
Point3 normal(const Point3& a, const Point3& b, const Point3& c)
{
	const Point3 n = cross(b - a, c - a);
	const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
	const double size = length(n);
	if (!(size > kMinHeight * longest * longest))
		return {0.0, 0.0, 0.0};
	return n / size;
}

/// Angle at a.
double angleAt(const Point3& a, const Point3& b, const Point3& c)
{
	return std::atan2(length(cross(b - a, c - a)), dot(b - a, c - a));
}

enum class At : char { Between, Crease, Boundary };

} // namespace

Creases creases(
	const std::vector<Point3>& positions,
	const std::vector<Triangle>& triangles,
	const Sides& sides,
	double angle)
{
	const auto at = [&](int v) -> const Point3& { return positions[positionOf(v)]; };
	Array<Point3> normals;
	for (const Triangle& t : triangles)
		normals.push_back(normal(at(t[0]), at(t[1]), at(t[2])));
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
		const Point3 &m = normals[edge[0].face()], &n = normals[edge[1].face()];
		if (!(dot(m, m) > 0.0 && dot(n, n) > 0.0 && dot(m, n) < cosine))
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

} // namespace ricci
