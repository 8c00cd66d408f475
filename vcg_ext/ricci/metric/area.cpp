// SPDX-License-Identifier: GPL-3.0-or-later
#include "area.h"

#include "../numbers.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ricci {

namespace {

/// \p area(s, s - a, s - b, s - c) of a triangle, s half the perimeter.
template<class Area>
double ofSides(std::array<double, 3> l, Area area)
{
	std::sort(l.begin(), l.end());
	// Kahan's order of operations: nothing cancels but the sides themselves.
	const double twiceLeast = std::max(0.0, l[0] - (l[2] - l[1]));
	return area(
		0.5 * (l[2] + (l[1] + l[0])),
		0.5 * twiceLeast,
		0.5 * (l[0] + (l[2] - l[1])),
		0.5 * (l[2] + (l[1] - l[0])));
}

/// Sum of \p area(sides) over the triangles.
template<class Area>
double sumOverTriangles(const Triangulation& t, const std::vector<double>& lengths, Area area)
{
	double sum = 0.0;
	for (int f = 0; f < t.faceCount(); ++f) {
		std::array<double, 3> l;
		for (std::size_t k = 0; k < 3; ++k)
			l[k] = lengths[at(Triangulation::edge(t.halfedges(f)[k]))];
		sum += area(l);
	}
	return sum;
}

} // namespace

double euclideanArea(const Triangulation& t, const std::vector<double>& lengths)
{
	return sumOverTriangles(t, lengths, [](const std::array<double, 3>& sides) {
		return ofSides(
			sides, [](double s, double a, double b, double c) { return std::sqrt(s * a * b * c); });
	});
}

double hyperbolicArea(const Triangulation& t, const std::vector<double>& lengths)
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
