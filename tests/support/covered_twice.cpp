// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat_map.h"
#include "shapes.h"

#include <ricci/base/box_tree.h>
#include <ricci/base/graphs.h>
#include <ricci/mesh/sides.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace ricci::testing {

namespace {

/// Places in units of 2^-50: floats from 2^-27 to 1 have all their digits there, smaller ones are
/// rounded far below any float's neighbour in the square's middle.
using Place = std::array<std::int64_t, 2>;
using Corners = std::array<Place, 3>;

constexpr double kUnit = 1125899906842624.0; // 2^50

/// Twice the area of the triangle: positive to the left of ab. Exact.
__int128 area(const Place& a, const Place& b, const Place& c)
{
	return static_cast<__int128>(b[0] - a[0]) * (c[1] - a[1]) -
		   static_cast<__int128>(b[1] - a[1]) * (c[0] - a[0]);
}

/// How deep, in units of the square, \p b reaches over the side of \p a that it crosses least, and
/// whether it reaches over all of them at all.
double reach(const Corners& a, const Corners& b, bool& over)
{
	double least = 2.0;
	for (std::size_t k = 0; k < 3; ++k) {
		const Place &p = a[k], &q = a[(k + 1) % 3];
		__int128 most = 0;
		for (const Place& r : b)
			most = std::max(most, area(p, q, r));
		over &= most > 0;
		const double side =
			std::hypot(static_cast<double>(q[0] - p[0]), static_cast<double>(q[1] - p[1]));
		least = std::min(least, static_cast<double>(most) / (side * kUnit));
	}
	return least;
}

} // namespace

CoveredTwice::CoveredTwice(const SurfaceMesh& mesh, const UV& uv, const std::vector<char>& reversed)
{
	std::vector<Corners> place(mesh.triangles.size());
	for (std::size_t f = 0; f < place.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k)
			for (std::size_t x = 0; x < 2; ++x)
				place[f][k][x] =
					std::llround(kUnit * static_cast<double>(static_cast<float>(uv[f][k][x])));
	DisjointSets chart(static_cast<int>(place.size()));
	Sides(mesh.triangles).forEdges([&](const auto& edge) {
		const auto ends = [&](Corner side) { // the lower vertex first
			const Triangle& t = mesh.triangles[at(side.face())];
			const bool isForward = t[side.index()] < t[side.next().index()];
			const Corners& p = place[at(side.face())];
			return std::array<Place, 2>{
				p[(isForward ? side : side.next()).index()],
				p[(isForward ? side.next() : side).index()]};
		};
		for (const Corner side : edge)
			if (ends(side) == ends(edge[0]))
				chart.merge(side.face(), edge[0].face());
	});
	std::vector<int> proper; // triangles
	std::vector<Box2> boxes;
	for (std::size_t f = 0; f < place.size(); ++f) {
		const int face = static_cast<int>(f);
		charts += chart.find(face) == face;
		if (!reversed.empty() && reversed[f])
			std::swap(place[f][1], place[f][2]);
		if (area(place[f][0], place[f][1], place[f][2]) <= 0)
			continue;
		proper.push_back(face);
		boxes.emplace_back();
		for (const Place& p : place[f])
			boxes.back().add(Point2{static_cast<double>(p[0]), static_cast<double>(p[1])});
	}
	const auto compare = [&](int i, int j) {
		const int f = proper[at(i)], g = proper[at(j)];
		bool over = true;
		const double depth = std::min(
			reach(place[at(f)], place[at(g)], over), reach(place[at(g)], place[at(f)], over));
		if (!over)
			return;
		if (chart.find(f) != chart.find(g))
			++betweenCharts;
		else
			withinCharts += depth > kContact;
	};
	BoxTree(boxes).meetingPairs(compare, [](int, int) { return false; });
}

} // namespace ricci::testing
