// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/complex.h"
#include "support/flat_meshes.h"
#include "support/random.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/base/numbers.h>
#include <ricci/math/disk_isometry.h>
#include <ricci/measure/distortion.h>

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace ricci::testing {
namespace {

using Plane = Triangle2;
using Space = std::array<Point3, 3>;

/// The corners of each face under a linear map of x and y.
std::vector<Plane> mapped(const SurfaceMesh& mesh, const Eigen::Matrix2d& A)
{
	std::vector<Plane> plane;
	for (const Triangle& t : mesh.triangles) {
		Plane p;
		for (std::size_t k = 0; k < 3; ++k) {
			const Eigen::Vector2d q =
				A * Eigen::Vector2d(mesh.positions[at(t[k])][0], mesh.positions[at(t[k])][1]);
			p[k] = {q[0], q[1]};
		}
		plane.push_back(p);
	}
	return plane;
}

TEST(Distortion, OfLinearMapsIsTheQuotientOfTheirSingularValues)
{
	Random random(110);
	int seen = 0;
	for (int trial = 0; trial < 200; ++trial) {
		Eigen::Matrix2d A;
		for (double& x : A.reshaped())
			x = random.real(-1, 1);
		const Eigen::JacobiSVD<Eigen::Matrix2d> svd(A);
		const double expected = svd.singularValues()[0] / svd.singularValues()[1];
		if (expected > 1e6)
			continue;
		Space surface;
		for (Point3& p : surface)
			p = {random.real(-1, 1), random.real(-1, 1), 0.0};
		SurfaceMesh mesh{{surface[0], surface[1], surface[2]}, {{0, 1, 2}}};
		if (triangleArea(surface) < 0.01)
			continue;
		const Plane plane = mapped(mesh, A)[0];
		const double error = 1e-12 * expected * expected;
		EXPECT_NEAR(quasiConformalDistortion(surface, plane), expected, error);
		// Where the triangle lies in space, how large it is and how it is turned does not matter.
		mesh = turned(scaled(mesh, 1e7), {1.0, -2.0, 0.5});
		const Space other{mesh.positions[0], mesh.positions[1], mesh.positions[2]};
		EXPECT_NEAR(quasiConformalDistortion(other, plane), expected, error);
		// Nor which corner comes first.
		EXPECT_NEAR(
			quasiConformalDistortion(
				{surface[1], surface[2], surface[0]}, {plane[1], plane[2], plane[0]}),
			expected,
			error);
		++seen;
	}
	EXPECT_GT(seen, 150);
}

TEST(Distortion, SimilaritiesHaveNone)
{
	Random random(111);
	for (double scale : {1e-8, 1.0, 1e8})
		for (int mirror : {1, -1}) {
			const double angle = random.real(-3, 3);
			Eigen::Matrix2d A;
			A << std::cos(angle), -std::sin(angle) * mirror, std::sin(angle),
				std::cos(angle) * mirror;
			const SurfaceMesh mesh = randomPlanarDisk(5, random);
			const auto plane = mapped(mesh, scale * A);
			for (std::size_t f = 0; f < plane.size(); ++f) {
				const Triangle& t = mesh.triangles[f];
				EXPECT_NEAR(
					quasiConformalDistortion(
						{mesh.positions[at(t[0])],
						 mesh.positions[at(t[1])],
						 mesh.positions[at(t[2])]},
						plane[f]),
					1.0,
					1e-13);
			}
		}
}

TEST(Distortion, DegenerateTriangles)
{
	const Space good{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
	const Plane unit{{{0, 0}, {1, 0}, {0, 1}}};
	for (const Space& flat :
		 {Space{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}},
		  Space{{{1, 2, 3}, {1, 2, 3}, {0, 0, 0}}},
		  Space{{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}}}) {
		EXPECT_TRUE(std::isnan(quasiConformalDistortion(flat, unit)));
		EXPECT_EQ(triangleArea(flat), 0.0);
	}
	for (const Plane& flat :
		 {Plane{{{0, 0}, {1, 0}, {3, 0}}},
		  Plane{{{0, 0}, {0, 0}, {1, 1}}},
		  Plane{{{0, 0}, {0, 0}, {0, 0}}}})
		EXPECT_EQ(quasiConformalDistortion(good, flat), std::numeric_limits<double>::infinity());
}

TEST(Distortion, TriangleAreaIsHalfTheCrossProduct)
{
	EXPECT_NEAR(triangleArea({{{1, 1, 1}, {4, 1, 1}, {1, 5, 1}}}), 6.0, 1e-14);
	EXPECT_NEAR(triangleArea({{{0, 0, 0}, {0, 2, 0}, {0, 0, 3}}}), 3.0, 1e-15);
}

TEST(Distortion, MeansByFaceAreaAndVertex)
{
	// A strip of a unit square and a 1 x 3 rectangle, stretched 1 : 1 and 2 : 1.
	const SurfaceMesh mesh{
		{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {4, 0, 0}, {4, 1, 0}},
		{{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}}};
	std::vector<Plane> plane;
	for (const Triangle& t : mesh.triangles) {
		Plane p;
		for (std::size_t k = 0; k < 3; ++k) {
			const Point3& q = mesh.positions[at(t[k])];
			p[k] = {q[0] <= 1 ? q[0] : 1 + 2 * (q[0] - 1), q[1]};
		}
		plane.push_back(p);
	}
	Report report;
	const std::vector<double> vertexQC = measured(mesh, plane, report);
	// Areas 1/2, 1/2, 3/2, 3/2.
	const double vertex[] = {
		1.0,
		(0.5 * 1 + 1.5 * 2 + 1.5 * 2) / 3.5,
		(0.5 * 1 + 0.5 * 1 + 1.5 * 2) / 2.5,
		1.0,
		2.0,
		2.0};
	double vertexMean = 0.0;
	for (std::size_t v = 0; v < 6; ++v) {
		EXPECT_NEAR(vertexQC[v], vertex[v], 1e-14);
		vertexMean += vertex[v] / 6;
	}
	EXPECT_NEAR(report.qcMean, 1.5, 1e-14);
	EXPECT_NEAR(report.qcAreaMean, (1 * 1 + 3 * 2) / 4.0, 1e-14);
	EXPECT_NEAR(report.qcVertexMean, vertexMean, 1e-14);
	EXPECT_NEAR(report.qcMax, 2.0, 1e-14);
	EXPECT_NEAR(report.qcP99, 2.0, 1e-14);
	EXPECT_EQ(report.flippedFaces, 0);
}

TEST(Distortion, ValuesAreThoseOfTheVerticesThatHaveFaces)
{
	SurfaceMesh mesh = rectangle(3, 3, 1, 1);
	const std::size_t vertices = mesh.positions.size();
	mesh.positions.push_back({9, 9, 9}); // in no face
	const Eigen::Matrix2d stretch = Eigen::Vector2d(1.5, 1.0).asDiagonal();
	const auto plane = mapped(mesh, stretch);
	Report report;
	measured(mesh, plane, report);
	EXPECT_EQ(report.qcValues.size(), vertices);
	for (const double qc : report.qcValues)
		EXPECT_NEAR(qc, 1.5, 1e-12);
	ASSERT_EQ(report.areaFactors.size(), mesh.triangles.size());
	for (const double factor : report.areaFactors)
		EXPECT_NEAR(factor, 0.0, 1e-12);
}

TEST(Distortion, ThePercentileLeavesItsShareOfTheValuesBelow)
{
	std::vector<double> values(1000);
	std::iota(values.begin(), values.end(), 1.0);
	std::reverse(values.begin(), values.end());
	EXPECT_EQ(percentile(values, 0.99), 990.0);
	EXPECT_EQ(percentile(values, 1.0), 1000.0);
	EXPECT_EQ(percentile({7.0}, 0.01), 7.0);
	EXPECT_TRUE(std::isnan(percentile({}, 0.5)));
}

TEST(Distortion, PercentileIsTheValueThat99PercentDoNotExceed)
{
	// 200 faces with distortions 1, 2, ..., 200.
	SurfaceMesh mesh;
	std::vector<Plane> plane;
	for (int i = 0; i < 200; ++i) {
		for (const Point3& p : {Point3{0, 0, 0}, Point3{1, 0, 0}, Point3{0, 1, 0}})
			mesh.positions.push_back(p);
		mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
		plane.push_back({{{0, 0}, {1.0 + i, 0}, {0, 1}}});
	}
	Report report;
	measured(mesh, plane, report);
	EXPECT_NEAR(report.qcP99, 198.0, 1e-11);
	EXPECT_NEAR(report.qcMax, 200.0, 1e-11);
	EXPECT_NEAR(report.qcMean, 100.5, 1e-11);
}

TEST(Distortion, CountsFacesWithTheWrongOrNoOrientation)
{
	const SurfaceMesh mesh = rectangle(2, 1, 2, 1);
	auto plane = mapped(mesh, Eigen::Matrix2d::Identity());
	Report report;
	measured(mesh, plane, report);
	EXPECT_EQ(report.flippedFaces, 0);
	plane[2][1] = plane[2][0]; // no area
	measured(mesh, plane, report);
	EXPECT_EQ(report.flippedFaces, 1);
	EXPECT_NEAR(report.qcMax, 1.0, 1e-14); // it is kept out of the means
	EXPECT_NEAR(report.qcMean, 1.0, 1e-14);
}

TEST(StretchEnergy, OfAStretchHasAClosedForm)
{
	FlatMesh flat = flatMesh(rectangle(4, 3, 1.0, 1.0));
	EXPECT_NEAR(stretchEnergy(flat), 4.0, 1e-13);
	for (Point2& p : flat.place)
		p = {5.0 * p[0], 10.0 * p[1]};
	EXPECT_NEAR(stretchEnergy(flat), 2.0 * (2.0 + 1.0 / 2.0), 1e-13);
}

TEST(StretchEnergy, IsInfiniteWhereATriangleBecomesALineOrAPoint)
{
	const FlatMesh whole = flatMesh(rectangle(4, 3, 1.0, 1.0));
	for (const std::size_t corners : {2U, 3U}) {
		FlatMesh flat = whole;
		for (std::size_t k = 0; k < corners; ++k)
			flat.place[flat.points[5][k]] = whole.at(5)[0];
		EXPECT_EQ(stretchEnergy(flat), std::numeric_limits<double>::infinity());
	}
}

TEST(AreaDistortion, OfASimilarityIsOneAndOfALinearMapToo)
{
	Random random(118);
	const SurfaceMesh mesh = randomPlanarDisk(8, random);
	int seen = 0;
	for (int trial = 0; trial < 20; ++trial) {
		Eigen::Matrix2d A;
		for (double& x : A.reshaped())
			x = random.real(-1, 1);
		if (std::abs(A.determinant()) < 0.1)
			continue;
		Report report;
		measured(mesh, mapped(mesh, A), report);
		EXPECT_NEAR(report.areaDistortionMean, 1.0, 1e-6);
		EXPECT_NEAR(report.areaDistortionSpread, 0.0, 1e-6);
		++seen;
	}
	EXPECT_GT(seen, 10);
}

TEST(AreaDistortion, OfTwoScalesHasAClosedForm)
{
	// Shares p and 1 - p of the area; the second part grows by q. The factors relative to the total
	// are 1 / (p + q - p q) and q times that.
	for (const double p : {0.2, 0.5, 0.9})
		for (const double q : {0.1, 1.0, 3.0, 1e6}) {
			const double first = 1.0 / (p + (1 - p) * q), second = q * first;
			const AreaDistortion a = areaDistortion({3 * p, 3 * (1 - p)}, {p, (1 - p) * q});
			EXPECT_NEAR(
				a.mean / (p * std::max(first, 1 / first) + (1 - p) * std::max(second, 1 / second)),
				1.0,
				1e-13);
			EXPECT_NEAR(a.spread, std::sqrt(p * (1 - p)) * std::abs(std::log(q)), 1e-12);
			// A common scale changes nothing, parts without area are left out.
			const AreaDistortion b =
				areaDistortion({p, 0.0, 1 - p, 7.0}, {5 * p, 2.0, 5 * (1 - p) * q, 0.0});
			EXPECT_NEAR(b.mean / a.mean, 1.0, 1e-13);
			EXPECT_NEAR(b.spread, a.spread, 1e-12);
		}
	// A share that no number holds is as good as none.
	const AreaDistortion c = areaDistortion({10.0, 5e-324, 10.0}, {1.0, 1e-6, 3.0});
	EXPECT_NEAR(c.mean, 0.5 * 2.0 + 0.5 * 1.5, 1e-5);
}

TEST(Distortion, FacesThatRoundingToFloatFlips)
{
	// Corners that differ by less than a unit in the last place of a float, and one that does not.
	const double ulp = 0x1p-24;
	const Triangle2 thin{Point2{0.5, 0.25}, {0.5 + 0.3 * ulp, 0.25}, {0.25, 0.75}},
		wide{Point2{0.5, 0.25}, {0.5 + 4 * ulp, 0.25}, {0.25, 0.75}},
		flipped{thin[0], thin[2], thin[1]};
	const auto count = [&](const std::vector<Triangle2>& plane) {
		const SurfaceMesh mesh{std::vector<Point3>(9), {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}};
		Report report;
		countFlipped(flatMesh(mesh, plane), report);
		return std::make_pair(report.flippedFaces, report.flippedByRounding);
	};
	EXPECT_EQ(count({thin, wide, flipped}), std::make_pair(1, 1));
	EXPECT_EQ(count({thin, wide, thin}), std::make_pair(0, 2));
	EXPECT_EQ(count({flipped, flipped, flipped}), std::make_pair(3, 0));
}

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

std::vector<double>
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
	const std::vector<double> vertexQC = measuredInDisk(mesh, drawn.plane, report);
	for (const double qc : vertexQC)
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
	const std::vector<double> vertexQC = measuredInDisk(mesh, drawn.plane, report);
	for (const double qc : vertexQC)
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
	const std::vector<double> a = measuredInDisk(mesh, drawn.plane, here);
	const std::vector<double> b = measuredInDisk(mesh, moved.plane, there);
	for (std::size_t v = 0; v < a.size(); ++v) // of one triangle each
		EXPECT_NEAR(a[v] / b[v], 1.0, 1e-9);
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
