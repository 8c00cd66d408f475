// SPDX-License-Identifier: GPL-3.0-or-later
#include "turn_over.h"

#include "../base/tolerances.h"
#include "../layout/flat_mesh.h"
#include "../math/orientation.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace ricci {

namespace {

/// Corner \p k of the triangle reflected in the opposite side.
Point2 reflected(const Triangle2& p, std::size_t k)
{
	const std::complex<double> a = asComplex(p[(k + 1) % 3]), b = asComplex(p[(k + 2) % 3]);
	return asPoint(a + (b - a) * std::conj((asComplex(p[k]) - a) / (b - a)));
}

std::size_t oppositeLongest(const Triangle2& p)
{
	std::size_t best = 0;
	for (std::size_t k = 1; k < 3; ++k)
		if (distance(p[(k + 1) % 3], p[(k + 2) % 3]) >
			distance(p[(best + 1) % 3], p[(best + 2) % 3]))
			best = k;
	return best;
}

/// Seams of the map as it is: their number, and their length in space.
std::pair<int, double> seams(const SurfaceMesh& mesh, const Parametrization& map)
{
	FlatMesh flat = flatMeshOf(
		Array<Triangle>(mesh.triangles),
		Array<Triangle2>(map.uv),
		Array<int>(mesh.triangles.size(), 0),
		Array<std::array<double, 3>>(mesh.triangles.size()));
	int count = 0;
	double length = 0.0;
	forEdges(sidesByEdge(flat), [&](const FlatSide* side, int sides) {
		if (sides != 2 || isInside(side, sides))
			return;
		++count;
		length +=
			distance(mesh.positions[positionOf(side->low)], mesh.positions[positionOf(side->high)]);
	});
	return {count, length};
}

} // namespace

void turnOver(const SurfaceMesh& mesh, Parametrization& map)
{
	std::vector<std::size_t> turned;
	for (const Chart& chart : map.charts) {
		Box2 box;
		for (const int f : chart.faces)
			for (const Point2& p : map.uv[positionOf(f)])
				box.add(p);
		const double onePlace = kOnePlace * box.extent();
		for (const int face : chart.faces) {
			const std::size_t f = positionOf(face);
			const Triangle2& p = map.uv[f];
			if (orientation(p[0], p[1], p[2]) * (map.reversed[f] ? -1 : 1) >= 0)
				continue;
			const std::size_t k = oppositeLongest(p);
			if (distance(reflected(p, k), p[k]) > onePlace)
				turned.push_back(f);
		}
	}
	if (turned.empty())
		return;
	const auto before = seams(mesh, map);
	for (const std::size_t f : turned) {
		Triangle2& p = map.uv[f];
		const std::size_t k = oppositeLongest(p);
		p[k] = reflected(p, k);
	}
	const auto after = seams(mesh, map);
	map.report.overlapCuts += after.first - before.first;
	map.report.seamLength += after.second - before.second;
}

} // namespace ricci
