// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces that are their own mirror images.
#include "support/front_door.h"
#include "support/random_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

/// A surface that x -> -x takes to itself, and its image.
struct Mirrored
{
	SurfaceMesh mesh;
	std::vector<int> image; ///< [vertex]

	explicit Mirrored(SurfaceMesh m) : mesh(std::move(m))
	{
		std::map<std::array<long, 3>, int> vertex;
		const auto key = [](const Point3& p, double sign) {
			return std::array<long, 3>{
				std::lround(1e6 * sign * p[0]), std::lround(1e6 * p[1]), std::lround(1e6 * p[2])};
		};
		for (std::size_t v = 0; v < mesh.positions.size(); ++v)
			vertex[key(mesh.positions[v], 1.0)] = static_cast<int>(v);
		for (const Point3& p : mesh.positions)
			image.push_back(vertex.at(key(p, -1.0)));
	}
};

/// \p mesh, of about the size 1, with a nose and two pairs of ears. Its diagonals are not mirrored.
Mirrored withEars(SurfaceMesh mesh, double height = 1.0)
{
	for (Point3& p : mesh.positions) {
		const auto bump = [&](double x, double y, double z, double width) {
			return std::exp(-std::pow(distance(p, Point3{x, y, z}) / width, 2));
		};
		const double size =
			1.0 + height * (0.7 * bump(0.0, 1.0, 0.1, 0.3) +
							0.9 * (bump(0.8, 0.1, 0.6, 0.25) + bump(-0.8, 0.1, 0.6, 0.25)) +
							0.8 * (bump(0.5, 0.3, -0.8, 0.3) + bump(-0.5, 0.3, -0.8, 0.3)));
		p = size * p;
	}
	return Mirrored(std::move(mesh));
}

/// Ends of the edges that lie at two places.
std::set<std::pair<int, int>> seamsOf(const SurfaceMesh& mesh, const UV& uv)
{
	std::map<std::pair<int, int>, std::vector<std::array<Point2, 2>>> places;
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k) {
			const int i = mesh.triangles[f][k], j = mesh.triangles[f][(k + 1) % 3];
			const Point2 &a = uv[f][k], &b = uv[f][(k + 1) % 3];
			places[std::minmax(i, j)].push_back(
				i < j ? std::array<Point2, 2>{a, b} : std::array<Point2, 2>{b, a});
		}
	std::set<std::pair<int, int>> seams;
	for (const auto& [ends, at] : places)
		if (at.size() == 2 && at[0] != at[1])
			seams.insert(ends);
	return seams;
}

/// Share of the seams that are images of seams.
double mirroredShare(const Mirrored& surface, const FlatResult& map)
{
	const auto seams = seamsOf(surface.mesh, map.uv);
	EXPECT_FALSE(seams.empty());
	const auto mirrored = std::count_if(seams.begin(), seams.end(), [&](const auto& ends) {
		return seams.count(
			std::minmax(surface.image[at(ends.first)], surface.image[at(ends.second)]));
	});
	return static_cast<double>(mirrored) / static_cast<double>(seams.size());
}

/// The same surface without its symmetry: vertices on one side are moved by a thousandth of its size.
SurfaceMesh withoutMirror(SurfaceMesh mesh)
{
	Random random(31);
	for (Point3& p : mesh.positions)
		if (p[0] > 0.01)
			for (double& x : p)
				x += random.real(-1e-3, 1e-3);
	return mesh;
}

/// Cones lie at images of cones of the same curvature, and seams at images of seams. Together they cost at most 3 % of
/// the objective.
void expectMirrored(const Mirrored& surface)
{
	for (const bool isTurned : {false, true}) {
		SCOPED_TRACE(isTurned);
		const SurfaceMesh mesh = isTurned ? turned(surface.mesh, {0.3, 0.5, 0.7}) : surface.mesh;
		Options options;
		options.charts = Charts::OfTheFlow;
		const FlatResult map = run(mesh, options);
		EXPECT_EQ(mirroredShare(surface, map), 1.0);
		const std::vector<char> boundary = boundaryOf(mesh);
		int cones = 0;
		for (std::size_t v = 0; v < surface.image.size(); ++v) {
			if (boundary[v])
				continue;
			const double k = map.targetCurvature[v];
			cones += k != 0.0;
			EXPECT_NEAR(k, map.targetCurvature[at(surface.image[v])], 1e-9) << v;
		}
		EXPECT_GT(cones, 0);
		EXPECT_LT(
			*map.report.objective,
			1.03 * *run(withoutMirror(surface.mesh), options).report.objective);
	}
}

TEST(Mirror, SeamsOfAHeadAreMirrored)
{
	expectMirrored(withEars(sphere(24, 32)));
}

/// A block of cells of a sphere, and its image, are holes.
TEST(Mirror, SeamsOfAHeadWithEyesAreMirrored)
{
	constexpr int kAround = 32;
	const auto isInEye = [](int v) {
		const int ring = (v - 1) / kAround, place = (v - 1) % kAround;
		return ring >= 12 && ring <= 15 &&
			   ((place >= 3 && place <= 6) || (place >= 10 && place <= 13));
	};
	const SurfaceMesh whole = sphere(24, kAround);
	const SurfaceMesh mesh = partOf(whole, [&](std::size_t f) {
		const Triangle& t = whole.triangles[f];
		return !std::all_of(t.begin(), t.end(), isInEye);
	});
	for (const std::vector<int>& neck : {std::vector<int>(), {0}}) {
		const SurfaceMesh head = withoutStars(mesh, neck);
		EXPECT_EQ(
			head.triangles.size(), at(2 * (24 - 1) * kAround - 2 * 18) - kAround * neck.size());
		expectMirrored(withEars(head));
	}
}

/// The plane meets it in two loops.
TEST(Mirror, SeamsOfARingAreMirrored)
{
	expectMirrored(withEars(torus(0.9, 0.35, 40, 24)));
}

/// A body that charts do not cover twice.
TEST(Mirror, SeamsOfFinishedChartsAreMirrored)
{
	const Mirrored surface = withEars(sphere(24, 32), 0.3);
	const FlatResult map = run(surface.mesh, Options());
	EXPECT_EQ(map.report.overlapCuts, 0);
	EXPECT_GE(mirroredShare(surface, map), 0.9);
}

/// Half a torus, whose ends are images of each other: of two holes as long one is capped, and the other one is boundary.
TEST(Mirror, OneOfTwoEqualHolesIsCapped)
{
	const SurfaceMesh whole = torus(1.0, 0.4, 18, 8);
	const SurfaceMesh mesh = partOf(whole, [&](std::size_t f) {
		const Triangle& t = whole.triangles[f];
		return std::all_of(
			t.begin(), t.end(), [&](int v) { return whole.positions[at(v)][0] >= 0.0; });
	});
	Options options;
	options.target = TargetCurvature::PlacedCones;
	options.holes = Holes::Capped;
	const FlatResult map = run(mesh, options);
	EXPECT_EQ(map.report.boundaryLoops, 2);
	EXPECT_EQ(map.report.cappedHoles, 1);
	EXPECT_EQ(map.report.flippedFaces, 0);
}

} // namespace
} // namespace ricci::testing
