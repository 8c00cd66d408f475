// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_UNFOLD_H
#define RICCI_UNFOLD_H

#include "../math/points.h"
#include "../surface/normal_coordinates.h"

#include <vector>

namespace ricci {

/// The strip of plane triangles that a curve runs through, unfolded from the beginning of the curve
/// at the origin of the plane.
struct Strip
{
	struct Side
	{
		Point2 from, to; ///< ends of the crossed halfedge
	};
	std::vector<Side> sides; ///< of every crossing, in order
	Point2 end{0.0, 0.0};    ///< of the curve
};

/// Unfolds \p curve in the flat metric of these \p lengths on \p t, on which the curve was traced.
/// Directions are carried as angles, which rounding changes less than coordinates where triangles
/// are thin. \p strip is overwritten.
/// \pre the curve has at least one crossing
void unfold(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const NormalCoordinates::Curve& curve,
	Strip& strip);

} // namespace ricci

#endif
