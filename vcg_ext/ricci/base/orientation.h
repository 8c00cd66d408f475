// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_ORIENTATION_H
#define RICCI_ORIENTATION_H

#include "points.h"

namespace ricci {

/// Sign of the oriented area of the triangle abc: 1 counter-clockwise, -1 clockwise, 0 collinear.
///
/// Exact for the coordinates as given, by a floating-point filter and expansions behind it
/// [Shewchuk 1997], within the range of double: no absolute value is above 1e153, where products
/// overflow, and no product of two coordinates other than 0 is below 2^-970 (1e-292), where its
/// rounding error underflows. Underflow changes the doubled area by less than 2e-323, so that the
/// sign still holds for every triangle with a doubled area above that.
int orientation(const Point2& a, const Point2& b, const Point2& c);
inline int orientation(const Triangle2& t)
{
	return orientation(t[0], t[1], t[2]);
}

} // namespace ricci

#endif
