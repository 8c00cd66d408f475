// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat_mesh.h"

#include "../math/bucket_sort.h"
#include "../math/disjoint_sets.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace ricci {

namespace {

/// \param at [triangle] the number that each corner has
std::vector<FlatSide> sidesOf(const Array<Triangle>& vertices, const Array<Triangle>& at)
{
	std::vector<FlatSide> sides;
	sides.reserve(3 * vertices.values().size());
	for (const int f : vertices.indices())
		for (std::size_t k = 0; k < 3; ++k) {
			const std::size_t next = (k + 1) % 3;
			const int a = vertices[f][k], b = vertices[f][next];
			sides.push_back(
				a < b ? FlatSide{a, b, at[f][k], at[f][next], f}
					  : FlatSide{b, a, at[f][next], at[f][k], f});
		}
	bucketSort(
		sides,
		[](const FlatSide& s) { return s.low; },
		[](const FlatSide& a, const FlatSide& b) {
			return a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
		});
	return sides;
}

} // namespace

int FlatMesh::vertexCount() const
{
	int count = 0;
	for (const Triangle& t : vertices)
		count = std::max({count, t[0] + 1, t[1] + 1, t[2] + 1});
	return count;
}

Box2 FlatMesh::box() const
{
	Box2 box;
	for (const Point2& p : place)
		box.add(p);
	return box;
}

std::vector<FlatSide> sidesByEdge(const FlatMesh& mesh)
{
	return sidesOf(mesh.vertices, mesh.points);
}

bool isInside(const FlatSide* sides, int count)
{
	return count == 2 && sides[0].atLow == sides[1].atLow && sides[0].atHigh == sides[1].atHigh;
}

FlatMesh flatMeshOf(
	Array<Triangle> vertices,
	const Array<Triangle2>& plane,
	Array<int> chart,
	Array<std::array<double, 3>> lengths)
{
	const auto place = [&](int corner) -> const Point2& {
		return plane[corner / 3][positionOf(corner % 3)];
	};
	FlatMesh mesh;
	for (const int f : vertices.indices())
		mesh.points.push_back({3 * f, 3 * f + 1, 3 * f + 2});
	DisjointSets sets(3 * vertices.size());
	forEdges(sidesOf(vertices, mesh.points), [&](const FlatSide* side, int count) {
		if (count == 2 && chart[side[0].triangle] == chart[side[1].triangle] &&
			place(side[0].atLow) == place(side[1].atLow) &&
			place(side[0].atHigh) == place(side[1].atHigh)) {
			sets.merge(side[0].atLow, side[1].atLow);
			sets.merge(side[0].atHigh, side[1].atHigh);
		}
	});
	Array<int> number(sets.size(), -1);
	for (int corner = 0; corner < sets.size(); ++corner) {
		const int first = sets.find(corner); // never above the corner
		if (first == corner) {
			number[corner] = mesh.place.size();
			mesh.place.push_back(place(corner));
		}
		mesh.points[corner / 3][positionOf(corner % 3)] = number[first];
	}
	mesh.vertices = std::move(vertices);
	mesh.lengths = std::move(lengths);
	mesh.chart = std::move(chart);
	return mesh;
}

} // namespace ricci
