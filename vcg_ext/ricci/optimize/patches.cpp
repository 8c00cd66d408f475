// SPDX-License-Identifier: GPL-3.0-or-later
#include "patches.h"

#include "../base/tolerances.h"

#include <cstddef>
#include <numeric>
#include <utility>

namespace ricci {

Patch wholePatch(const FlatMesh& flat, const PointGroups& groups)
{
	Patch patch;
	patch.triangles.resize(positionOf(flat.size()));
	patch.points.resize(positionOf(flat.place.size()));
	std::iota(patch.triangles.begin(), patch.triangles.end(), 0);
	std::iota(patch.points.begin(), patch.points.end(), 0);
	patch.corners = flat.points;
	patch.variable.assign(flat.place.size(), -1);
	Array<int> number(groups.fixed.size(), -1);
	for (const int p : flat.place.indices()) {
		const int g = groups.group[p];
		if (!groups.fixed[g] && number[g] < 0)
			number[g] = patch.variables++;
		patch.variable[p] = number[g];
	}
	return patch;
}

PatchFinder::PatchFinder(const FlatMesh& flat, const PointGroups& groups) :
		m_flat(flat), m_groups(groups), m_trianglesOf(
											groups.fixed.size(),
											[&](const auto& add) {
												for (const int f : flat.points.indices())
													for (const int p : flat.points[f])
														add(groups.group[p], f);
											}),
		m_taken(flat.points.size(), 0), m_local(flat.place.size(), -1),
		m_number(groups.fixed.size(), -1), m_count(groups.fixed.size(), 0)
{
}

std::vector<Patch> PatchFinder::patches(const std::vector<int>& seeds, int rings)
{
	std::vector<int> taken;
	const auto take = [&](int f) {
		if (!m_taken[f])
			taken.push_back(f);
		m_taken[f] = 1;
	};
	for (const int f : seeds)
		for (const int p : m_flat.points[f])
			if (!m_groups.fixed[m_groups.group[p]])
				take(f);
	int groups = 0;
	std::vector<int> reached; // [number of a group]
	const auto isNew = [&](int group) {
		if (m_number[group] >= 0)
			return false;
		m_number[group] = groups++;
		reached.push_back(group);
		return true;
	};
	for (std::size_t first = 0; rings > 0; --rings) {
		const std::size_t end = taken.size();
		for (; first < end; ++first)
			for (const int p : m_flat.points[taken[first]])
				if (const int group = m_groups.group[p]; isNew(group))
					for (const int f : m_trianglesOf[group])
						take(f);
	}
	std::sort(taken.begin(), taken.end());

	for (const int f : taken)
		for (const int p : m_flat.points[f])
			isNew(m_groups.group[p]);
	const auto numberOf = [&](int p) { return m_number[m_groups.group[p]]; };
	DisjointSets sets(groups);
	for (const int f : taken)
		for (const int p : m_flat.points[f])
			sets.merge(numberOf(m_flat.points[f][0]), numberOf(p));
	Array<int> partOf(reached.size(), -1); // [set]
	std::vector<std::vector<int>> parts;
	for (const int f : taken) {
		int& part = partOf[sets.find(numberOf(m_flat.points[f][0]))];
		if (part < 0) {
			part = static_cast<int>(parts.size());
			parts.emplace_back();
		}
		parts[positionOf(part)].push_back(f);
		m_taken[f] = 0;
	}
	for (const int group : reached)
		m_number[group] = -1;
	std::vector<Patch> result;
	for (std::vector<int>& part : parts) {
		Patch patch = makePatch(std::move(part));
		if (patch.variables > 0)
			result.push_back(std::move(patch));
	}
	return result;
}

Patch PatchFinder::makePatch(std::vector<int> triangles)
{
	Patch patch;
	patch.triangles = std::move(triangles);
	for (const int f : patch.triangles) {
		Triangle local{};
		for (std::size_t k = 0; k < 3; ++k) {
			const int p = m_flat.points[f][k];
			if (m_local[p] < 0) {
				m_local[p] = static_cast<int>(patch.points.size());
				patch.points.push_back(p);
			}
			local[k] = m_local[p];
			++m_count[m_groups.group[p]];
		}
		patch.corners.push_back(local);
	}
	// A group is inside if the patch has all its triangles.
	for (const int p : patch.points) {
		const int group = m_groups.group[p];
		if (!m_groups.fixed[group] && m_number[group] < 0 &&
			m_count[group] == m_trianglesOf[group].size())
			m_number[group] = patch.variables++;
		patch.variable.push_back(m_number[group]);
	}
	for (const int p : patch.points) {
		m_local[p] = -1;
		m_count[m_groups.group[p]] = 0;
		m_number[m_groups.group[p]] = -1;
	}
	return patch;
}

namespace {

using Complex = std::complex<double>;

/// From the lengths of the sides 0-1, 1-2 and 2-0.
TriangleShape shapeOf(const std::array<double, 3>& sides)
{
	const double longest = std::max({sides[0], sides[1], sides[2]});
	if (!(longest > 0.0))
		return {1.0, {0.5, std::sqrt(0.75)}};
	double a = std::max(sides[0], kMinIntrinsicHeight * longest);
	double b = std::max(sides[1], kMinIntrinsicHeight * longest);
	double c = std::max(sides[2], kMinIntrinsicHeight * longest);
	const double x = (a * a + c * c - b * b) / (2.0 * a);
	const double height = kMinIntrinsicHeight * longest * longest / a; // over side a
	return {a, {x, std::max(std::sqrt(std::max(c * c - x * x, 0.0)), height)}};
}

TriangleShape scaled(const TriangleShape& s, double factor)
{
	return {factor * s.base, factor * s.apex};
}

/// A shape with a right height over its longest side, both at least \p height.
TriangleShape heightened(const TriangleShape& s, double height)
{
	Complex corner[3] = {0.0, s.base, s.apex};
	std::size_t first = 0; // of the longest side
	for (std::size_t k = 1; k < 3; ++k)
		if (std::abs(corner[(k + 1) % 3] - corner[k]) >
			std::abs(corner[(first + 1) % 3] - corner[first]))
			first = k;
	const Complex side = corner[(first + 1) % 3] - corner[first];
	const double length = std::abs(side), old = 2.0 * s.area() / length;
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

TriangleShape shapeOf(const Triangle2& p)
{
	const Complex base = asComplex(p[1]) - asComplex(p[0]);
	return {std::abs(base), (asComplex(p[2]) - asComplex(p[0])) * std::conj(base) / std::abs(base)};
}

double longestSide(const Triangle2& p)
{
	return std::max({distance(p[0], p[1]), distance(p[1], p[2]), distance(p[2], p[0])});
}

/// How much the map scales the surface round each triangle of a patch: the root of the quotient
/// of areas over the triangles at its corners, or \p evenly over all. Where a triangle has no area on
/// the surface, the squares of its longest sides stand for the areas.
std::vector<double> scales(
	const FlatMesh& flat, const Patch& patch, const std::vector<TriangleShape>& shapes, bool evenly)
{
	Array<double> plane(static_cast<int>(patch.points.size()), 0.0), surface = plane;
	double planeSum = 0.0, surfaceSum = 0.0;
	for (std::size_t i = 0; i < shapes.size(); ++i) {
		const Triangle2 p = flat.at(patch.triangles[i]);
		double a = 0.5 * std::abs(doubledArea(p)), b = shapes[i].area();
		if (const double side = shapes[i].longestSide(); b <= kMinIntrinsicHeight * side * side) {
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

std::vector<TriangleShape>
restShapes(const FlatMesh& flat, const Patch& patch, RestShapes from, const Validity& validity)
{
	std::vector<TriangleShape> shapes;
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

TriangleShape
restShape(const FlatMesh& flat, int triangle, RestShapes from, const Validity& validity)
{
	Patch alone;
	alone.triangles = {triangle};
	alone.points.assign(flat.points[triangle].begin(), flat.points[triangle].end());
	alone.corners.push_back({0, 1, 2});
	return restShapes(flat, alone, from, validity).front();
}

} // namespace ricci
