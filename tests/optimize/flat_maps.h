// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_FLAT_MAPS_H
#define RICCI_TESTS_FLAT_MAPS_H

#include "support/flat_meshes.h"
#include "support/random.h"

#include <ricci/base/points.h>

#include <cstdint>

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

/// A square of kSide by kSide cells, two triangles each, laid out as it is.
inline FlatMesh square()
{
	return flatMesh(rectangle(kSide, kSide, kSide, kSide));
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
