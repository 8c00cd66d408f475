// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TARGET_H
#define RICCI_TARGET_H

#include "../base/numbers.h"
#include "../options.h"
#include "../report.h"
#include "../surface/elements.h"
#include "map_cost.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace ricci {

/// A target curvature that Gauss-Bonnet allows.
struct Target
{
	Background background = Background::EuclideanPlane;
	VertexVector curvature;  ///< radians; meaningless where fixed
	VertexArray<char> fixed; ///< 1 where u keeps its value (free boundary, du = 0 in paper 5.3)
	bool circular = false;   ///< boundary curvature to be adapted to a round disk
	std::optional<std::array<Vertex, 4>> corners; ///< of a rectangle, in boundary order
	std::optional<double> maxSpread; ///< of the logarithm of the area factor, where the target was
									 ///< chosen to keep areas so far
	std::optional<MapCost> expected; ///< where it was chosen to cost least
	bool isSeamless = false;         ///< cones were placed with multiples of pi / 2
	TargetUsed used = TargetUsed::Prescribed;
	std::optional<double> expectedSpread; ///< see Report
	std::string choice;                   ///< see Report
	std::vector<std::string> notes;       ///< what was chosen, in sentences

	bool hasFixed() const { return std::find(fixed.begin(), fixed.end(), 1) != fixed.end(); }
};

/// The area to which a surface of Euler characteristic \p chi is scaled before the circles of a free
/// boundary are taken over into the hyperbolic plane, whose metrics have no scale of their own:
/// 2 pi max(1, |chi|). Where chi < 0 that is the area of the surface with geodesic boundary.
inline double freeBoundaryArea(int chi)
{
	return 2 * kPi * std::max(1, std::abs(chi));
}

} // namespace ricci

#endif
