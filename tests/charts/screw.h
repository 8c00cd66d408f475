// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_SCREW_H
#define RICCI_TESTS_SCREW_H

#include "support/shapes.h"

#include <cmath>

namespace ricci::testing {

/// A ring between radii 1 and 2 that goes round by \p turns, in the plane or along a screw of this \p pitch.
inline SurfaceMesh screw(double turns, int around, int across, double pitch = 0.0)
{
	return grid(across, around, Ends::Open, Ends::Open, [=](int i, int j) {
		const double r = 1.0 + static_cast<double>(i) / across;
		const double a = 2.0 * 3.14159265358979323846 * turns * j / around;
		return Point3{r * std::cos(a), r * std::sin(a), pitch * a};
	});
}

} // namespace ricci::testing

#endif
