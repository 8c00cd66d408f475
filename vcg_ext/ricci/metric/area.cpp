// SPDX-License-Identifier: GPL-3.0-or-later
#include "area.h"

namespace ricci {

namespace {

/// \p area(s, s - a, s - b, s - c) of a triangle with the sides a <= b <= c, s half the perimeter.
template<class Area>
double ofSides(const std::array<double, 3>& l, Area area)
{
	// Without branches: no processor could predict them.
	const double low = std::min(l[0], l[1]), high = std::max(l[0], l[1]);
	const double a = std::min(low, l[2]), c = std::max(high, l[2]);
	const double b = std::max(low, std::min(high, l[2]));
	// Kahan's order of operations: nothing cancels but the sides themselves.
	const double twiceShortest = std::max(0.0, a - (c - b)); // 2 (s - c)
	return area(0.5 * (c + (b + a)), 0.5 * twiceShortest, 0.5 * (a + (c - b)), 0.5 * (c + (b - a)));
}

/// Sum of \p area(sides) over the triangles.
template<class Area>
double sumOverTriangles(const Triangulation& t, const EdgeArray<double>& lengths, Area area)
{
	double sum = 0.0;
	for (const Face f : t.faces())
		sum += area(sidesOf(t, lengths, f));
	return sum;
}

} // namespace

double euclideanArea(const std::array<double, 3>& sides)
{
	return ofSides(
		sides, [](double s, double a, double b, double c) { return std::sqrt(s * a * b * c); });
}

double euclideanArea(const Triangulation& t, const EdgeArray<double>& lengths)
{
	return sumOverTriangles(
		t, lengths, [](const std::array<double, 3>& sides) { return euclideanArea(sides); });
}

double hyperbolicArea(const Triangulation& t, const EdgeArray<double>& lengths)
{
	return sumOverTriangles(
		t, lengths, [](const std::array<double, 3>& sides) { return hyperbolicArea(sides); });
}

double hyperbolicArea(std::array<double, 3> sides)
{
	return ofSides(sides, [](double s, double a, double b, double c) {
		return 4.0 * std::atan(std::sqrt(
						 std::tanh(0.5 * s) * std::tanh(0.5 * a) * std::tanh(0.5 * b) *
						 std::tanh(0.5 * c)));
	});
}

} // namespace ricci
