// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TRIANGLE_H
#define RICCI_TRIANGLE_H

#include <algorithm>
#include <cmath>

namespace ricci {

/// Place of the apex of a plane triangle over its base, which runs from 0 along the x axis:
///
///            apex
///           /    \           .
///     left / height \ right  .
///         /        \         .
///        0 --------- base
///          along
struct TriangleApex
{
	double along, height;
};

/// Apex from the lengths of the sides, by Heron's formula. Where the sides break the triangle
/// inequality, the height is 0.
/// \pre \p base > 0
inline TriangleApex triangleApex(double base, double left, double right)
{
	const double heron = (base + left + right) * (base + left - right) * (base + right - left) *
						 (left + right - base);
	return {
		0.5 * ((left - right) * (left + right) / base + base),
		std::sqrt(std::max(0.0, heron)) / (2 * base)};
}

} // namespace ricci

#endif
