// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_UNFOLD_H
#define RICCI_UNFOLD_H

#include "../surface/normal_coordinates.h"
#include "planar_layout.h"

#include <vector>

namespace ricci {

/// The strip of plane triangles that a curve runs through, unfolded from the curve's beginning at
/// the origin of the plane.
struct Strip
{
	struct Side
	{
		Point2 from, to; ///< ends of the crossed halfedge
	};
	std::vector<Side> sides; ///< of every crossing
	Point2 end{0.0, 0.0};
};

/// Unfolds \p curve (with at least one crossing) in a flat metric. Directions are carried as
/// angles, as in layOutInPlane(). \p strip is overwritten.
void unfold(
	const Triangulation& t,
	const std::vector<double>& lengths,
	const NormalCoordinates::Curve& curve,
	Strip& strip);

} // namespace ricci

#endif
