// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_FLAT_MAPS_H
#define RICCI_TESTS_FLAT_MAPS_H

#include "support/random.h"
#include "support/shapes.h"

#include <ricci/base/points.h>
#include <ricci/layout/flat_mesh.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace ricci::testing {

constexpr int kSide = 12; // cells of a square

inline int vertexAt(int i, int j)
{
	return i * (kSide + 1) + j;
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

/// The vertices of a mesh as they are seen from above.
inline std::vector<Point2> fromAbove(const SurfaceMesh& mesh)
{
	std::vector<Point2> places;
	for (const Point3& p : mesh.positions)
		places.push_back({p[0], p[1]});
	return places;
}

/// A square of kSide by kSide cells, two triangles each, laid out as it is.
inline FlatMesh square()
{
	const SurfaceMesh mesh = rectangle(kSide, kSide, kSide, kSide);
	return flatDisk(mesh, fromAbove(mesh));
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
