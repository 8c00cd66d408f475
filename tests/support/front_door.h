// SPDX-License-Identifier: GPL-3.0-or-later
// What the public functions give, and what can be seen of it by the formulas of the paper alone.
#ifndef RICCI_TESTS_FRONT_DOOR_H
#define RICCI_TESTS_FRONT_DOOR_H

#include "flat_map.h"
#include "listener.h"
#include "shapes.h"

#include <ricci/error.h>
#include <ricci/parametrize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace ricci::testing {

/// parametrizeEuclidean() with the charts of the flow, at its scale and as it draws them.
inline FlatResult flattened(const SurfaceMesh& mesh, Options options, const VertexInput& input = {})
{
	options.normalizeUV = false;
	options.charts = Charts::OfTheFlow;
	options.finish = Finish::None;
	return withCorners(mesh, parametrizeEuclidean(mesh, input, options));
}

/// parametrizeHyperbolic() of one component, as the flow draws it in the unit disk.
inline FlatResult
inUnitDisk(const SurfaceMesh& mesh, HyperbolicOptions options, const VertexInput& input = {})
{
	options.finish = Finish::None;
	return runInDisk(mesh, options, input);
}

/// Options of a flow whose map is drawn on the mesh, with holes as boundaries.
inline Options towards(TargetCurvature target, Method method = Method::IntrinsicFlips)
{
	Options options;
	options.target = target;
	options.method = method;
	options.holes = Holes::Boundaries;
	return options;
}

/// Whether \p run gets as far as its flow: the target is accepted.
template<class Run>
bool reachesTheFlow(const Run& run)
{
	Listener listener(1, "Solving for the metric");
	try {
		withListener(listener, run);
	}
	catch (const Cancelled&) {
		return true;
	}
	return false;
}

inline VertexInput prescribing(std::vector<double> curvature)
{
	VertexInput input;
	input.targetCurvature = std::move(curvature);
	return input;
}

inline double sum(const std::vector<double>& values)
{
	double total = 0.0;
	for (const double x : values)
		total += x;
	return total;
}

/// [vertex] 1 on the boundary.
inline std::vector<char> boundaryOf(const SurfaceMesh& mesh)
{
	std::map<std::pair<int, int>, int> faces;
	for (const Triangle& t : mesh.triangles)
		for (std::size_t k = 0; k < 3; ++k)
			++faces[std::minmax(t[k], t[(k + 1) % 3])];
	std::vector<char> boundary(mesh.positions.size(), 0);
	for (const auto& [ends, count] : faces)
		if (count == 1)
			boundary[at(ends.first)] = boundary[at(ends.second)] = 1;
	return boundary;
}

/// [vertex] 2 pi, on the boundary pi.
template<class Number>
std::vector<Number> fullAngles(const SurfaceMesh& mesh)
{
	std::vector<Number> angles;
	for (const char isBoundary : boundaryOf(mesh))
		angles.push_back((isBoundary ? 1 : 2) * std::acos(Number(-1)));
	return angles;
}

/// The map has the curvature \p wanted, inside alone if the boundary is free: the angles of all triangles at a
/// vertex, those of flipped ones taken off, turn the plane, or in the unit disk its isometries, by what is left of
/// 2 pi; on the boundary of pi.
inline void expectDrawn(
	const SurfaceMesh& mesh,
	const Parametrization& map,
	const std::vector<double>& wanted,
	bool isFree = false,
	bool isDisk = false)
{
	const std::vector<char> boundary = boundaryOf(mesh);
	std::vector<double> missing = fullAngles<double>(mesh), rounding(missing.size(), 1e-8);
	double extent = 0.0;
	for (const Point2& p : map.mesh.place)
		extent = std::max({extent, std::abs(p[0]), std::abs(p[1])});
	for (int t = 0; t < map.mesh.size(); ++t)
		for (std::size_t k = 0; k < 3; ++k) {
			const std::size_t v = at(map.mesh.vertices[t][k]);
			const auto place = [&](std::size_t i) { return asComplex(map.mesh.at(t)[i % 3]); };
			const auto seen = [&](std::size_t i) {
				const std::complex<double> way = place(i) - place(k);
				return isDisk ? way / (1.0 - std::conj(place(k)) * place(i)) : way;
			};
			if (v >= missing.size())
				continue; // of a refinement
			missing[v] -= std::arg(seen(k + 2) / seen(k + 1));
			for (const std::size_t i : {k + 1, k + 2})
				rounding[v] += 8 * std::numeric_limits<double>::epsilon() * extent /
							   std::abs(place(i) - place(k));
		}
	for (std::size_t v = 0; v < missing.size(); ++v)
		if (!isFree || !boundary[v]) {
			EXPECT_NEAR(std::remainder(missing[v] - wanted[v], 2 * kPi), 0.0, rounding[v]) << v;
		}
}

/// Largest |\p a - \p b|.
inline double largestDifference(const std::vector<double>& a, const std::vector<double>& b)
{
	EXPECT_EQ(a.size(), b.size());
	double largest = 0.0;
	for (std::size_t v = 0; v < a.size(); ++v)
		largest = std::max(largest, std::abs(a[v] - b[v]));
	return largest;
}

/// Circles at the vertices of a mesh, by the formulas as the paper prints them, in extended precision: the
/// radii of 4.1, their inversive distances (Eq. 3), and the metric of other radii (Eqs 1, 2, 4, 6).
struct Circles
{
	using Wide = long double;

	const SurfaceMesh& mesh;
	std::vector<Wide> radius; ///< [vertex]
	bool isThurston = false;  ///< inversive distances are clamped to [0, 1]
	bool isHyperbolic = false;

	explicit Circles(const SurfaceMesh& m) : mesh(m), radius(m.positions.size(), HUGE_VALL)
	{
		for (const Triangle& t : mesh.triangles)
			for (std::size_t k = 0; k < 3; ++k) {
				const int i = t[k], j = t[(k + 1) % 3], l = t[(k + 2) % 3];
				const Wide sides = distanceInSpace(i, j) + distanceInSpace(l, i);
				radius[at(i)] = std::min(radius[at(i)], (sides - distanceInSpace(j, l)) / 2);
			}
	}

	Wide distanceInSpace(int i, int j) const
	{
		Wide square = 0;
		for (std::size_t k = 0; k < 3; ++k) {
			const Wide d = static_cast<Wide>(mesh.positions[at(i)][k]) - mesh.positions[at(j)][k];
			square += d * d;
		}
		return std::sqrt(square);
	}

	Wide inversiveDistance(int i, int j) const
	{
		const Wide l = distanceInSpace(i, j), gi = radius[at(i)], gj = radius[at(j)];
		const Wide I = (l * l - gi * gi - gj * gj) / (2 * gi * gj);
		return isThurston ? std::clamp<Wide>(I, 0, 1) : I;
	}

	/// Of the edge between two vertices with these \p u.
	Wide lengthWith(const std::vector<double>& u, int i, int j) const
	{
		const Wide I = inversiveDistance(i, j), ui = u[at(i)], uj = u[at(j)];
		if (!isHyperbolic) {
			const Wide gi = std::exp(ui), gj = std::exp(uj);
			return std::sqrt(gi * gi + gj * gj + 2 * I * gi * gj);
		}
		const Wide gi = 2 * std::atanh(std::exp(ui)), gj = 2 * std::atanh(std::exp(uj));
		return std::acosh(std::cosh(gi) * std::cosh(gj) + I * std::sinh(gi) * std::sinh(gj));
	}

	/// By the law of cosines.
	Wide angle(Wide opposite, Wide left, Wide right) const
	{
		if (!isHyperbolic)
			return std::acos(
				(left * left + right * right - opposite * opposite) / (2 * left * right));
		return std::acos(
			(std::cosh(left) * std::cosh(right) - std::cosh(opposite)) /
			(std::sinh(left) * std::sinh(right)));
	}

	std::vector<Wide> curvatureWith(const std::vector<double>& u) const
	{
		std::vector<Wide> curvature = fullAngles<Wide>(mesh);
		for (const Triangle& t : mesh.triangles)
			for (std::size_t k = 0; k < 3; ++k) {
				const int i = t[k], j = t[(k + 1) % 3], l = t[(k + 2) % 3];
				curvature[at(i)] -=
					angle(lengthWith(u, j, l), lengthWith(u, i, j), lengthWith(u, l, i));
			}
		return curvature;
	}
};

} // namespace ricci::testing

#endif
