// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/complex.h"
#include "support/listener.h"
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/sphere_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

namespace ricci::testing {
namespace {

SphereMap toSphere(const SurfaceMesh& mesh)
{
	return mapToSphere(mesh, Options());
}

/// Icosahedron with every face cut into 4^level, on the unit sphere.
SurfaceMesh icosphere(int level)
{
	const double g = 0.5 * (1.0 + std::sqrt(5.0));
	SurfaceMesh mesh;
	mesh.positions = {
		{-1, g, 0},
		{1, g, 0},
		{-1, -g, 0},
		{1, -g, 0},
		{0, -1, g},
		{0, 1, g},
		{0, -1, -g},
		{0, 1, -g},
		{g, 0, -1},
		{g, 0, 1},
		{-g, 0, -1},
		{-g, 0, 1}};
	mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
					  {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
					  {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
					  {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
	const auto toUnit = [&] {
		for (Point3& p : mesh.positions)
			p = p / length(p);
	};
	toUnit();
	for (int l = 0; l < level; ++l, toUnit()) {
		std::map<std::pair<int, int>, int> middle;
		std::vector<Triangle> finer;
		const auto between = [&](int a, int b) {
			const auto found = middle.insert(
				{{std::min(a, b), std::max(a, b)}, static_cast<int>(mesh.positions.size())});
			if (found.second) {
				const Point3 p = mesh.positions[at(a)], q = mesh.positions[at(b)];
				mesh.positions.push_back(p + q);
			}
			return found.first->second;
		};
		for (const Triangle& t : mesh.triangles) {
			const int a = between(t[0], t[1]), b = between(t[1], t[2]), c = between(t[2], t[0]);
			finer.push_back({t[0], a, c});
			finer.push_back({t[1], b, a});
			finer.push_back({t[2], c, b});
			finer.push_back({a, b, c});
		}
		mesh.triangles = finer;
	}
	return mesh;
}

Complex crossRatioOf(const std::vector<Point3>& p, const std::array<std::size_t, 4>& i)
{
	return crossRatio(p[i[0]], p[i[1]], p[i[2]], p[i[3]]);
}

TEST(SphereMap, LeavesAnIcosphereInPlace)
{
	for (int level : {0, 1, 3}) {
		const SurfaceMesh mesh = icosphere(level);
		for (const SurfaceMesh& moved : {mesh, scaled(turned(mesh, {0.4, 1.0, -2.0}), 30.0)}) {
			const SphereMap map = toSphere(moved);
			EXPECT_EQ(map.flippedFaces, 0);
			EXPECT_LT(map.offset, 1e-12);
			EXPECT_NEAR(map.qcMax, 1.0, 1e-8);
			EXPECT_NEAR(map.areaDistortionMean, 1.0, 1e-8);
			const double size = length(moved.positions[0]);
			for (std::size_t v = 0; v < moved.positions.size(); ++v)
				for (std::size_t k = 0; k < 3; ++k)
					EXPECT_NEAR(map.positions[v][k], moved.positions[v][k] / size, 1e-9);
		}
	}
}

TEST(SphereMap, ChangesAnInscribedPolyhedronByAMoebiusTransformation)
{
	// The faces of a convex polyhedron in the sphere are Delaunay, and stay so under Moebius
	// transformations, so that the polyhedron of the moved vertices has the same faces.
	Random random(421);
	int compared = 0;
	for (int trial = 0; trial < 5; ++trial) {
		SurfaceMesh mesh = turned(icosphere(2), {0.3, 0.2, 0.1});
		const Complex shift(random.real(-1, 1), random.real(-1, 1));
		const double scale = std::exp(random.real(-1.0, 1.0));
		for (Point3& p : mesh.positions)
			p = onSphere(scale * inPlane(p) + shift);
		const SphereMap map = toSphere(mesh);
		EXPECT_EQ(map.flippedFaces, 0);
		EXPECT_LT(map.offset, 1e-12);
		for (const Triangle& t : mesh.triangles) {
			const std::size_t other = at(random.index(static_cast<int>(mesh.positions.size())));
			if (at(t[0]) == other || at(t[1]) == other || at(t[2]) == other)
				continue;
			++compared;
			const std::array<std::size_t, 4> four{at(t[0]), at(t[1]), at(t[2]), other};
			const Complex was = crossRatioOf(mesh.positions, four);
			EXPECT_LT(
				std::abs(crossRatioOf(map.positions, four) - was), 1e-7 * (1 + std::abs(was)));
		}
	}
	EXPECT_GT(compared, 5 * 300); // of 5 * 320 triangles
}

/// An ellipsoid of revolution with half axes 1, 1 and \p c.
SurfaceMesh spheroid(int level, double c)
{
	return stretched(turned(icosphere(level), {0.2, 0.5, 0.0}), {1, 1, c});
}

TEST(SphereMap, OfASpheroidConvergesToTheConformalLatitude)
{
	for (const double c : {0.5, 0.8}) {
		const double e = std::sqrt(1 - c * c);
		std::vector<double> errors, qc;
		for (int level : {2, 3, 4}) {
			const SurfaceMesh mesh = spheroid(level, c);
			const SphereMap map = toSphere(mesh);
			EXPECT_EQ(map.flippedFaces, 0);
			double square = 0.0;
			for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
				const Point3& p = mesh.positions[v];
				// Geodetic latitude, then the conformal one by the isometric latitude.
				const double rho = std::hypot(p[0], p[1]);
				const double s = std::sin(std::atan2(p[2] / (c * c), rho));
				const double psi = std::atanh(std::min(s, 1.0 - 1e-15)) - e * std::atanh(e * s);
				const double z = std::tanh(psi), r = 1.0 / std::cosh(psi);
				const Point3 expected{
					rho > 0 ? r * p[0] / rho : 0.0, rho > 0 ? r * p[1] / rho : 0.0, z};
				square += std::pow(distance(map.positions[v], expected), 2);
			}
			errors.push_back(std::sqrt(square / static_cast<double>(mesh.positions.size())));
			qc.push_back(map.qcAreaMean - 1.0);
		}
		// Second order in the positions, first in the distortion.
		for (std::size_t i = 1; i < errors.size(); ++i) {
			EXPECT_GT(std::log2(errors[i - 1] / errors[i]), 1.7) << errors[i];
			EXPECT_GT(std::log2(qc[i - 1] / qc[i]), 0.8) << qc[i];
		}
		EXPECT_LT(errors.back(), 2e-3);
	}
}

TEST(SphereMap, IsOrientedAndCentredForCoarseAndAwkwardSurfaces)
{
	const SurfaceMesh inside = withReversedFaces(icosphere(2), 1); // faces seen from inside
	const SurfaceMesh bar = stretched(icosphere(3), {4, 1, 1});
	for (const SurfaceMesh& mesh : {tetrahedron(), perforatedSlab(0, 3), bar, inside}) {
		const SphereMap map = toSphere(mesh);
		EXPECT_EQ(map.flippedFaces, 0);
		EXPECT_LT(map.offset, 1e-9);
		for (const Point3& p : map.positions)
			EXPECT_NEAR(length(p), 1.0, 1e-12);
	}
}

/// Areas change by far more than Automatic would leave without cones, which a map to the sphere must
/// not have.
TEST(SphereMap, IsConformalWhateverAreasDo)
{
	const SurfaceMesh mesh = sphereWithTube(0.2, 2.0, 0.0, 40, 24);
	const SphereMap map = toSphere(mesh);
	EXPECT_EQ(map.flippedFaces, 0);
	EXPECT_LT(map.qcAreaMean, 1.08);
	EXPECT_LT(map.qcMax, 1.6);
	EXPECT_GT(map.areaDistortionMean, 5.0);
}

/// On the sphere a face of this solid spans more than a hemisphere. Drawn straight it lies on the other
/// side, flipped, so that the faces cover the sphere no times in sum.
TEST(SphereMap, CountsFacesThatSpanMoreThanAHemisphere)
{
	SurfaceMesh mesh;
	mesh.positions = {{1, -3, -2}, {1, -2, -2}, {-2, 1, 2}, {-2, -3, 0}, {-1, -1, -2}};
	mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {1, 3, 2}, {3, 1, 4}, {1, 0, 4}};
	const SphereMap map = toSphere(mesh);
	EXPECT_LT(map.offset, 1e-9);
	int turned = 0;
	double area = 0.0;
	for (const Triangle& t : mesh.triangles) {
		// Girard: angles between the planes of the sides, less pi; negative where flipped.
		std::array<Point3, 3> p;
		for (std::size_t k = 0; k < 3; ++k)
			p[k] = map.positions[at(t[k])];
		double excess = -kPi;
		for (std::size_t k = 0; k < 3; ++k) {
			const Point3 a = cross(p[k], p[(k + 1) % 3]), b = cross(p[k], p[(k + 2) % 3]);
			excess += std::atan2(length(cross(a, b)), dot(a, b));
		}
		const bool isTurned = dot(p[0], cross(p[1], p[2])) < 0.0;
		turned += isTurned;
		area += isTurned ? -excess : excess;
	}
	EXPECT_NEAR(area, 0.0, 1e-9);
	EXPECT_GT(turned, 0);
	EXPECT_EQ(map.flippedFaces, turned);
}

/// A spheroid so long that doubles hold no picture of its middle beside its ends. Before, some faces are flipped,
/// which is said.
TEST(SphereMap, OfALongSurfaceIsRefusedOrSaysWhatItLost)
{
	int refused = 0, told = 0;
	for (const double length : {1.0, 5.0, 10.0, 15.0, 20.0, 30.0, 50.0}) {
		const SurfaceMesh mesh = stretched(icosphere(3), {1, 1, length});
		Listener listener;
		const Task task(listener);
		try {
			const SphereMap map = toSphere(mesh);
			EXPECT_EQ(refused, 0) << "of a shorter one";
			const bool isTold =
				std::any_of(listener.lines.begin(), listener.lines.end(), [&](const auto& line) {
					return line.find("flipped") != std::string::npos &&
						   line.find(std::to_string(map.flippedFaces)) == 0;
				});
			EXPECT_EQ(isTold, map.flippedFaces > 0);
			told += isTold;
			EXPECT_LT(map.flippedFaces, static_cast<int>(mesh.triangles.size() / 2));
		}
		catch (const NotConverged& refusal) {
			EXPECT_EQ(refusal.problem, NotConverged::LostInRounding);
			EXPECT_GT(refusal.count, mesh.triangles.size() / 4);
			EXPECT_GE(length, 20.0);
			++refused;
		}
	}
	EXPECT_GT(refused, 0);
	EXPECT_GT(told, 0);
}

} // namespace
} // namespace ricci::testing
