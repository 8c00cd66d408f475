// SPDX-License-Identifier: GPL-3.0-or-later
#include "../base/numbers.h"
#include "component.h"

#include <algorithm>
#include <map>

namespace ricci {

namespace {

/// What sides of a component may differ by from those of a copy: coordinates that are all floats have been rounded to
/// floats, others to doubles, and a motion has some more roundings. Nothing where lengths are given.
double lengthNoise(const Component& component)
{
	double largest = 0.0;
	bool areFloats = true;
	for (const Point3& p : component.positions)
		for (const double x : p) {
			largest = std::max(largest, std::abs(x));
			areFloats = areFloats && roundedToFloat(x) == x;
		}
	return component.lengths.empty() ? largest * (areFloats ? 0x1p-22 : 0x1p-50) : 0.0;
}

/// But by no larger share of the side, where coordinates are far from 0.
constexpr double kMaxNoise = 1e-4;

/// A component is compared with so many others of its size: more kinds of one size are hardly copies.
constexpr std::size_t kMaxKinds = 100;

/// Whether a rigid motion takes the vertices of one to those of the other: they are as far from four corners of a large
/// tetrahedron, of the same orientation where it is not flat, or of the other one if the motion reflects.
bool isCongruent(const Component& a, const Component& b, double noise, bool reflects)
{
	std::array<Vertex, 4> corner{Vertex(0), Vertex(0), Vertex(0), Vertex(0)};
	const auto volume = [&](const Component& c, Vertex v) {
		const Point3 x = c.positions[corner[1]] - c.positions[corner[0]];
		const Point3 y = c.positions[corner[2]] - c.positions[corner[0]];
		return dot(cross(x, y), c.positions[v] - c.positions[corner[0]]);
	};
	const auto farthest = [&](const auto& size) {
		Vertex best(0);
		for (const Vertex v : a.positions.indices())
			if (size(v) > size(best))
				best = v;
		return best;
	};
	corner[1] =
		farthest([&](Vertex v) { return distance(a.positions[v], a.positions[corner[0]]); });
	corner[2] = farthest([&](Vertex v) {
		const Point3 from = a.positions[corner[0]];
		return length(cross(a.positions[corner[1]] - from, a.positions[v] - from));
	});
	corner[3] = farthest([&](Vertex v) { return std::abs(volume(a, v)); });
	const double own = volume(a, corner[3]), other = volume(b, corner[3]);
	const double size = distance(a.positions[corner[1]], a.positions[corner[0]]);
	if (std::abs(own) > noise * size * size && ((own > 0.0) == (other > 0.0)) == reflects)
		return false;
	for (const Vertex v : a.positions.indices())
		for (const Vertex c : corner)
			if (!(std::abs(
					  distance(a.positions[v], a.positions[c]) -
					  distance(b.positions[v], b.positions[c])) <= noise))
				return false;
	return true;
}

/// \param noise of the lengths of both
/// \param reflects whether \p b is turned over
bool isCopy(const Component& a, const Component& b, double noise, bool reflects)
{
	const auto hasSameSides = [&](Face f) {
		const std::array<double, 3> own = a.sides(f), other = b.sides(f);
		return std::equal(own.begin(), own.end(), other.begin(), [&](double x, double y) {
			return std::abs(x - y) <= std::min(noise, kMaxNoise * x);
		});
	};
	if (!hasSameSides(Face(0)) || a.triangles != b.triangles || a.diagonal != b.diagonal ||
		a.hole != b.hole || a.hasSeam != b.hasSeam || a.map != b.map)
		return false;
	for (const Face f : a.face.indices())
		if (!hasSameSides(f))
			return false;
	return !a.lengths.empty() || isCongruent(a, b, noise, reflects);
}

/// Whether two components, whose vertices are in one order, have the same \p values [vertex of the opened mesh].
template<class T>
bool hasSame(const std::vector<T>& values, const Component& a, const Component& b)
{
	return values.empty() ||
		   std::equal(
			   a.vertex.begin(),
			   a.vertex.end(),
			   b.vertex.begin(),
			   b.vertex.end(),
			   [&](int v, int w) { return values[positionOf(v)] == values[positionOf(w)]; });
}

} // namespace

std::vector<Original> originals(
	const std::vector<Component>& components,
	const std::vector<char>& selected,
	const std::vector<double>& targetCurvature,
	bool mayMirror)
{
	std::vector<Original> originals;
	std::vector<double> noise;
	std::map<std::array<std::size_t, 2>, std::vector<int>> bySize;
	for (const Component& component : components) {
		Original original;
		noise.push_back(lengthNoise(component));
		std::vector<int>& others =
			bySize[{component.triangles.size(), positionOf(component.vertex.size())}];
		const auto find = [&](const Component& copy, bool reflects) {
			const auto found = std::find_if(others.begin(), others.end(), [&](int i) {
				const Component& other = components[positionOf(i)];
				return isCopy(other, copy, noise[positionOf(i)] + noise.back(), reflects) &&
					   hasSame(selected, other, copy) && hasSame(targetCurvature, other, copy);
			});
			if (found != others.end())
				original.number = *found;
			return found != others.end();
		};
		bool isFound = find(component, false);
		// A reflection may list the corners of the triangles in any order.
		for (const CornerOrder& order : {CornerOrder{2, 1, 0}, {0, 2, 1}, {1, 0, 2}}) {
			if (isFound || !mayMirror || others.empty() || !component.map.empty())
				break;
			Component image = turnedOver(component, order);
			isFound = find(image, true);
			if (isFound) {
				original.mirrored = std::move(image);
				original.order = order;
			}
		}
		if (!isFound) {
			original.number = static_cast<int>(originals.size());
			if (others.size() < kMaxKinds)
				others.push_back(original.number);
		}
		originals.push_back(std::move(original));
	}
	return originals;
}

} // namespace ricci
