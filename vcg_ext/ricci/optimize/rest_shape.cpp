// SPDX-License-Identifier: GPL-3.0-or-later
#include "rest_shape.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ricci {

namespace {

using Complex = std::complex<double>;

/// The least height, and the least side, over the longest side of a shape of the surface.
constexpr double kMinRatio = 1e-6;

/// From the lengths of the sides 0-1, 1-2 and 2-0.
RestShape shapeOf(const std::array<double, 3>& sides)
{
	const double longest = std::max({sides[0], sides[1], sides[2]});
	if (!(longest > 0.0))
		return {1.0, {0.5, std::sqrt(0.75)}};
	double a = std::max(sides[0], kMinRatio * longest);
	double b = std::max(sides[1], kMinRatio * longest);
	double c = std::max(sides[2], kMinRatio * longest);
	const double x = (a * a + c * c - b * b) / (2.0 * a);
	const double height = kMinRatio * longest * longest / a; // over side a
	return {a, {x, std::max(std::sqrt(std::max(c * c - x * x, 0.0)), height)}};
}

double areaOf(const RestShape& s)
{
	return 0.5 * s.base * s.apex.imag();
}

RestShape scaled(const RestShape& s, double factor)
{
	return {factor * s.base, factor * s.apex};
}

/// A shape with a right height over its longest side, both at least \p height.
RestShape heightened(const RestShape& s, double height)
{
	Complex corner[3] = {0.0, s.base, s.apex};
	std::size_t first = 0; // of the longest side
	for (std::size_t k = 1; k < 3; ++k)
		if (std::abs(corner[(k + 1) % 3] - corner[k]) >
			std::abs(corner[(first + 1) % 3] - corner[first]))
			first = k;
	const Complex side = corner[(first + 1) % 3] - corner[first];
	const double length = std::abs(side), old = 2.0 * areaOf(s) / length;
	if (old >= height)
		return s;
	const double along = std::max(length, 1.2 * height) / length, across = height / old;
	for (Complex& z : corner) {
		const Complex w = z / side; // in the frame of the longest side
		z = side * Complex(along * w.real(), across * w.imag());
	}
	const Complex base = corner[1] - corner[0];
	return {std::abs(base), (corner[2] - corner[0]) / base * std::abs(base)};
}

RestShape shapeOf(const Triangle2& p)
{
	const Complex base = asComplex(p[1]) - asComplex(p[0]);
	return {std::abs(base), (asComplex(p[2]) - asComplex(p[0])) * std::conj(base) / std::abs(base)};
}

double longestSide(const Triangle2& p)
{
	return std::max({distance(p[0], p[1]), distance(p[1], p[2]), distance(p[2], p[0])});
}

double longestSide(const RestShape& s)
{
	return std::max({s.base, std::abs(s.apex), std::abs(s.apex - s.base)});
}

/// How much the map scales the surface round each triangle of a patch: the root of the quotient
/// of areas over the triangles at its corners, or \p evenly over all. Where a triangle has no area on
/// the surface, the squares of its longest sides stand for the areas.
std::vector<double>
scales(const FlatMesh& flat, const Patch& patch, const std::vector<RestShape>& shapes, bool evenly)
{
	Array<double> plane(static_cast<int>(patch.points.size()), 0.0), surface = plane;
	double planeSum = 0.0, surfaceSum = 0.0;
	for (std::size_t i = 0; i < shapes.size(); ++i) {
		const Triangle2 p = flat.at(patch.triangles[i]);
		double a = 0.5 * std::abs(doubledArea(p)), b = areaOf(shapes[i]);
		if (const double side = longestSide(shapes[i]); b <= kMinRatio * side * side) {
			a = longestSide(p) * longestSide(p);
			b = side * side;
		}
		planeSum += a, surfaceSum += b;
		for (const int q : patch.corners[static_cast<int>(i)])
			plane[q] += a, surface[q] += b;
	}
	const double mean = planeSum > 0.0 ? std::sqrt(planeSum / surfaceSum) : 1.0;
	if (evenly)
		return std::vector<double>(shapes.size(), mean);
	std::vector<double> result;
	for (std::size_t i = 0; i < shapes.size(); ++i) {
		double a = 0.0, b = 0.0;
		for (const int q : patch.corners[static_cast<int>(i)])
			a += plane[q], b += surface[q];
		result.push_back(a > 0.0 ? std::sqrt(a / b) : mean);
	}
	return result;
}

} // namespace

std::vector<RestShape>
restShapes(const FlatMesh& flat, const Patch& patch, RestShapes from, const Validity& validity)
{
	std::vector<RestShape> shapes;
	for (const int f : patch.triangles)
		shapes.push_back(shapeOf(flat.lengths[f]));
	const std::vector<double> scale =
		scales(flat, patch, shapes, from == RestShapes::OfSurfaceEvenly);
	for (std::size_t i = 0; i < shapes.size(); ++i) {
		const Triangle2 p = flat.at(patch.triangles[i]);
		shapes[i] = from == RestShapes::OfDrawing && doubledArea(p) > 0.0
						? shapeOf(p)
						: scaled(shapes[i], scale[i]);
		shapes[i] = heightened(shapes[i], validity.wanted);
	}
	return shapes;
}

} // namespace ricci
