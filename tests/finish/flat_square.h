// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_FLAT_SQUARE_H
#define RICCI_TESTS_FLAT_SQUARE_H

#include "support/random.h"

#include <ricci/layout/flat_mesh.h>

#include <cstdint>

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

/// A square of kSide by kSide cells, two triangles each, laid out as it is.
inline FlatMesh square()
{
	FlatMesh flat;
	for (int v = 0; v < (kSide + 1) * (kSide + 1); ++v)
		flat.place.push_back({double(v % (kSide + 1)), double(v / (kSide + 1))});
	for (int j = 0; j < kSide; ++j) {
		for (int i = 0; i < kSide; ++i) {
			const int a = vertexAt(i, j), b = vertexAt(i + 1, j);
			const int c = vertexAt(i + 1, j + 1), d = vertexAt(i, j + 1);
			for (const Triangle& t : {Triangle{a, b, c}, Triangle{a, c, d}}) {
				const Triangle2 p{flat.place[t[0]], flat.place[t[1]], flat.place[t[2]]};
				flat.vertices.push_back(t);
				flat.points.push_back(t);
				flat.lengths.push_back(
					{distance(p[0], p[1]), distance(p[1], p[2]), distance(p[2], p[0])});
			}
		}
	}
	return flat;
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

} // namespace ricci::testing

#endif
