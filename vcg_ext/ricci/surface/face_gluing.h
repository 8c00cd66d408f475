// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FACE_GLUING_H
#define RICCI_FACE_GLUING_H

#include "surface_mesh.h"

#include <cstddef>
#include <vector>

namespace ricci {

/// One side of a triangle, sortable so that the sides of an edge become neighbours.
struct Side
{
	int low, high; ///< the vertices, low < high
	int face, corner;
	bool ascending; ///< whether corner \p corner is \p low

	int index() const { return 3 * face + corner; }
};

/// The sides of all triangles, those of an edge one after the other in the order of their faces.
/// \pre no triangle uses a vertex twice
std::vector<Side> sortedSides(const std::vector<Triangle>& triangles);

/// Calls \p visit(sides, count) for every edge: \p count of them from \p sides on.
template<class Visit>
void forEachEdge(const std::vector<Side>& sorted, Visit visit)
{
	for (std::size_t first = 0, last; first < sorted.size(); first = last) {
		for (last = first; last < sorted.size() && sorted[last].low == sorted[first].low &&
						   sorted[last].high == sorted[first].high;)
			++last;
		visit(&sorted[first], last - first);
	}
}

/// Which sides of triangles are glued to each other.
struct FaceGluing
{
	/// [3 f + k] the side, numbered alike, that is glued to the one from corner k of triangle f to the
	/// next corner; -1 on a boundary.
	std::vector<int> glued;
	int cutEdges = 0;       ///< edges with more than two sides, or with two of equal vertices
	int duplicateFaces = 0; ///< triangles with the vertices of one before them
};

/// Glues triangles to surfaces in which no edge has more than two sides.
///
/// The two sides of an ordinary edge are glued, whatever their directions. Where more meet, they are
/// paired along the smoothest continuation, where their orientation is coherent and no surface becomes
/// one-sided by it; what is left over becomes boundary. Triangles with the same
/// three vertices are never glued to each other: they belong to different sheets, in the order of
/// their numbers.
/// \pre no triangle uses a vertex twice
FaceGluing glueFaces(const std::vector<Point3>& positions, const std::vector<Triangle>& triangles);

} // namespace ricci

#endif
