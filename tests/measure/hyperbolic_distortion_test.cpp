// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/complex.h"
#include "support/flat_meshes.h"
#include "support/random.h"
#include "support/transform.h"

#include <ricci/base/numbers.h>
#include <ricci/math/disk_isometry.h>
#include <ricci/measure/hyperbolic_distortion.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace ricci::testing {
namespace {

Complex randomPoint(Random& random)
{
	return std::polar(std::sqrt(random.real(0.0, 0.9)), random.real(-kPi, kPi));
}

/// Chord of two points on the hyperboloid in R^{2,1}: its length there is real, as it is spacelike.
double chord(Complex z, Complex w)
{
	const auto lift = [](Complex p) {
		const double gap = 1.0 - std::norm(p);
		return Point3{2 * p.real() / gap, 2 * p.imag() / gap, (1.0 + std::norm(p)) / gap};
	};
	const Point3 a = lift(z), b = lift(w);
	return std::sqrt(
		std::pow(a[0] - b[0], 2) + std::pow(a[1] - b[1], 2) - std::pow(a[2] - b[2], 2));
}

DistortionField
measuredInDisk(const SurfaceMesh& mesh, const std::vector<Triangle2>& plane, Report& report)
{
	return measureHyperbolicDistortion(flatMesh(mesh, plane), mesh.positions, report);
}

/// Triangles with corners at random in the disk, and a mesh of separate flat ones with the chords as
/// sides.
struct Drawn
{
	SurfaceMesh mesh;
	std::vector<Triangle2> plane;

	Drawn(int count, Random& random)
	{
		while (static_cast<int>(plane.size()) < count) {
			Complex p = randomPoint(random), q = randomPoint(random);
			const Complex r = randomPoint(random);
			// Geodesics are straight in the Klein model.
			const auto klein = [](Complex z) { return asPoint(2.0 * z / (1.0 + std::norm(z))); };
			if (doubledArea(klein(p), klein(q), klein(r)) < 0.0)
				std::swap(p, q);
			const double base = chord(p, q), left = chord(p, r), right = chord(q, r);
			const double x = (base * base + left * left - right * right) / (2 * base);
			const double height2 = left * left - x * x;
			if (height2 < 1e-2 * std::pow(std::max({base, left, right}), 2))
				continue; // no good triangle
			const int n = static_cast<int>(mesh.positions.size());
			mesh.positions.push_back({0, 0, 0});
			mesh.positions.push_back({base, 0, 0});
			mesh.positions.push_back({x, std::sqrt(height2), 0});
			mesh.triangles.push_back({n, n + 1, n + 2});
			plane.push_back({asPoint(p), asPoint(q), asPoint(r)});
		}
	}
};

TEST(HyperbolicDistortion, OfTheTrianglesOfTheChordsIsOne)
{
	Random random(860);
	const Drawn drawn(200, random);
	const SurfaceMesh mesh = turned(scaled(drawn.mesh, 1e3), {0.3, -1.0, 2.0});
	Report report;
	const DistortionField field = measuredInDisk(mesh, drawn.plane, report);
	for (const double qc : field.face)
		EXPECT_NEAR(qc, 1.0, 1e-9);
	EXPECT_NEAR(report.qcMax, 1.0, 1e-9);
	EXPECT_NEAR(report.areaDistortionSpread, 0.0, 1e-6);
	EXPECT_EQ(report.flippedFaces, 0);
}

TEST(HyperbolicDistortion, OfAStretchIsItsFactor)
{
	Random random(861);
	const Drawn drawn(200, random);
	SurfaceMesh mesh = drawn.mesh;
	for (Point3& p : mesh.positions)
		p[1] *= 1.75;
	Report report;
	const DistortionField field = measuredInDisk(mesh, drawn.plane, report);
	for (const double qc : field.face)
		EXPECT_NEAR(qc, 1.75, 1e-9);
	EXPECT_NEAR(report.qcAreaMean, 1.75, 1e-9);
}

TEST(HyperbolicDistortion, DoesNotChangeByIsometriesOfTheDisk)
{
	Random random(862);
	const Drawn drawn(100, random);
	Drawn moved = drawn;
	const DiskIsometry g = DiskIsometry::translationTo({0.3, -0.4}) * DiskIsometry::rotation(1.0);
	for (Triangle2& t : moved.plane)
		for (Point2& p : t)
			p = asPoint(g(asComplex(p)));
	SurfaceMesh mesh = drawn.mesh;
	for (Point3& p : mesh.positions)
		p[1] *= random.real(1.0, 3.0);
	Report here, there;
	const DistortionField a = measuredInDisk(mesh, drawn.plane, here);
	const DistortionField b = measuredInDisk(mesh, moved.plane, there);
	for (std::size_t f = 0; f < a.face.size(); ++f)
		EXPECT_NEAR(a.face[f] / b.face[f], 1.0, 1e-9);
	EXPECT_EQ(here.flippedFaces, 0);
	EXPECT_EQ(there.flippedFaces, 0);
}

/// Two corners near the circle and one between their geodesic, which bends towards 0, and their
/// straight line: the two pictures have opposite orientations.
TEST(HyperbolicDistortion, CountsGeodesicTrianglesOfTheWrongOrientation)
{
	const double angle = 0.6;
	const Complex p = std::polar(0.99, -angle), q = std::polar(0.99, angle);
	const Complex r(0.5 * (p.real() + 1.0 / std::cos(angle) - std::tan(angle)), 0.0);
	// The geodesic of p and q crosses the real axis before that of the ends of their radii, which
	// does at 1/cos - tan.
	ASSERT_LT(r.real(), p.real());
	ASSERT_GT(r.real(), 1.0 / std::cos(angle) - std::tan(angle));
	const std::vector<Triangle2> uv{{asPoint(p), asPoint(q), asPoint(r)}};
	ASSERT_GT(doubledArea(uv[0][0], uv[0][1], uv[0][2]), 0.0); // straight: counter-clockwise
	const SurfaceMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
	Report report;
	measuredInDisk(mesh, uv, report);
	EXPECT_EQ(report.flippedFaces, 1);
	measuredInDisk(mesh, {{asPoint(q), asPoint(p), asPoint(r)}}, report);
	EXPECT_EQ(report.flippedFaces, 0);
	// Without area it is neither.
	measuredInDisk(mesh, {{asPoint(p), asPoint(p), asPoint(r)}}, report);
	EXPECT_EQ(report.flippedFaces, 1);
}

} // namespace
} // namespace ricci::testing
