// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_FLAT_MAPS_H
#define RICCI_TESTS_FLAT_MAPS_H

#include "support/random.h"
#include "support/shapes.h"

#include <ricci/layout/flat_mesh.h>
#include <ricci/math/orientation.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace ricci::testing {

constexpr int kSide = 12; // cells of a square

inline int vertexAt(int i, int j)
{
	return j * (kSide + 1) + i;
}

inline bool isInside(int vertex)
{
	const int i = vertex % (kSide + 1), j = vertex / (kSide + 1);
	return i > 0 && i < kSide && j > 0 && j < kSide;
}

/// A disk whose vertices lie at \p places in the plane.
inline FlatMesh flatDisk(const SurfaceMesh& mesh, std::vector<Point2> places)
{
	FlatMesh flat;
	flat.vertices = flat.points = Array<Triangle>(mesh.triangles);
	flat.place = Array<Point2>(std::move(places));
	for (const Triangle& t : mesh.triangles) {
		const auto length = [&](std::size_t i, std::size_t j) {
			return distance(mesh.positions[at(t[i])], mesh.positions[at(t[j])]);
		};
		flat.lengths.push_back({length(0, 1), length(1, 2), length(2, 0)});
	}
	connect(flat);
	return flat;
}

/// A square of kSide by kSide cells, two triangles each, laid out as it is.
inline FlatMesh square()
{
	SurfaceMesh mesh;
	std::vector<Point2> places;
	for (int v = 0; v < (kSide + 1) * (kSide + 1); ++v) {
		places.push_back({double(v % (kSide + 1)), double(v / (kSide + 1))});
		mesh.positions.push_back({places.back()[0], places.back()[1], 0.0});
	}
	for (int j = 0; j < kSide; ++j) {
		for (int i = 0; i < kSide; ++i) {
			const int a = vertexAt(i, j), b = vertexAt(i + 1, j);
			const int c = vertexAt(i + 1, j + 1), d = vertexAt(i, j + 1);
			mesh.triangles.push_back({a, b, c});
			mesh.triangles.push_back({a, c, d});
		}
	}
	return flatDisk(mesh, places);
}

/// The square with \p count points inside moved up to two cells away.
inline FlatMesh tangled(int count, std::uint64_t seed)
{
	FlatMesh flat = square();
	Random random(seed);
	for (int moved = 0; moved < count;) {
		const int v = random.index((kSide + 1) * (kSide + 1));
		if (!isInside(v))
			continue;
		flat.place[v][0] += random.real(-2, 2);
		flat.place[v][1] += random.real(-2, 2);
		++moved;
	}
	return flat;
}

inline int notCounterClockwise(const FlatMesh& flat)
{
	int count = 0;
	for (const int f : flat.points.indices()) {
		const Triangle2 p = flat.at(f);
		count += orientation(p[0], p[1], p[2]) != 1;
	}
	return count;
}

} // namespace ricci::testing

#endif
