// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_JOIN_PARTS_H
#define RICCI_JOIN_PARTS_H

#include "../finish/drawn_triangles.h"
#include "../progress.h"
#include "chart_division.h"

#include <complex>
#include <vector>

namespace ricci {

/// A rotation and a translation of the plane.
struct RigidMotion
{
	std::complex<double> turn = 1.0, shift = 0.0;

	Point2 operator()(const Point2& p) const { return asPoint(turn * asComplex(p) + shift); }
};

/// Parts of a drawing after joinParts().
struct JoinedParts
{
	std::vector<std::vector<int>>
		parts;                 ///< triangles, in increasing order, the parts by their first
	Array<RigidMotion> motion; ///< [triangle] how it was moved
	ChartCuts seams;           ///< what they have more than before, or less
};

/// Joins parts of a drawing across seams: the sides of a seam are isometric, so that a part can be
/// moved to the other side of it, where it often has room. Of all parts the smallest is moved first,
/// along the longest border where it covers nothing, until none can be moved. What is smaller than a
/// hundredth of all then is divided among the parts round it, if they have room for all of it. Ends of sides that come
/// to lie on each other are the same points then, bit by bit.
/// \param drawn its points are moved
/// \param parts no part covers itself
/// \param tick see overlappingPairs()
JoinedParts
joinParts(DrawnTriangles& drawn, const std::vector<std::vector<int>>& parts, const Tick& tick);

} // namespace ricci

#endif
