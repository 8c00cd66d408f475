// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/flat_meshes.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/error.h>
#include <ricci/math/disk_isometry.h>
#include <ricci/verify/chart_check.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

/// A plane mesh as its own map.
struct MapSheet
{
	SurfaceMesh mesh;
	std::vector<Triangle2> plane;

	MapSheet()
	{
		Random random(610);
		mesh = randomPlanarDisk(5, random);
		plane = flatMesh(mesh).corners().values();
	}

	ChartCheck check(double tolerance = 1e-9) const
	{
		return checkMap(flatMesh(mesh, plane), tolerance);
	}
};

TEST(ChartCheckInPlane, AcceptsAMapWithAndWithoutSeams)
{
	MapSheet s;
	ChartCheck check = s.check();
	EXPECT_EQ(check.outside, 0u);
	EXPECT_EQ(check.seamGap, 0.0);
	EXPECT_EQ(check.flipped, 0);
	// Cut apart by a motion of a half: all its border becomes a seam.
	for (std::size_t f = 0; f < s.plane.size() / 2; ++f)
		for (Point2& p : s.plane[f])
			p = {3.0 - p[1], p[0]};
	check = s.check();
	EXPECT_LT(check.seamGap, 1e-15);
	EXPECT_EQ(check.flipped, 0);
}

TEST(ChartCheckInPlane, SeesSeamsOfDifferentLengths)
{
	MapSheet s;
	for (Point2& p : s.plane[20])
		p = {1.001 * p[0], 1.001 * p[1]};
	Box2 box;
	for (const Point3& p : s.mesh.positions)
		box.add(Point2{p[0], p[1]});
	const Triangle2& p = s.plane[20]; // all of its sides are inside
	const double longest =
		std::max({distance(p[0], p[1]), distance(p[1], p[2]), distance(p[2], p[0])});
	EXPECT_NEAR(s.check().seamGap, longest * (1 - 1 / 1.001) / box.extent(), 1e-14);
}

TEST(ChartCheckInPlane, SeesFlippedAndFlatFaces)
{
	MapSheet s;
	for (const std::size_t f : {7u, 8u})
		std::swap(s.mesh.triangles[f][1], s.mesh.triangles[f][2]);
	for (const std::size_t f : {7u, 8u})
		std::swap(s.plane[f][1], s.plane[f][2]);
	EXPECT_EQ(s.check().flipped, 2);
	for (const std::size_t f : {7u, 8u}) {
		std::swap(s.mesh.triangles[f][1], s.mesh.triangles[f][2]);
		std::swap(s.plane[f][1], s.plane[f][2]);
	}
	// A face flipped by less than the tolerance is left to rounding.
	auto& p = s.plane[4];
	const double x = p[1][0] - p[0][0], y = p[1][1] - p[0][1], l = std::hypot(x, y);
	p[2] = {p[0][0] + 0.5 * x + 1e-10 * y / l, p[0][1] + 0.5 * y - 1e-10 * x / l};
	EXPECT_EQ(s.check(1e-9).flipped, 0);
	EXPECT_EQ(s.check(1e-11).flipped, 1);
}

TEST(ChartCheckInPlane, SeesWhatIsNoNumber)
{
	MapSheet s;
	s.plane[9][2][1] = std::numeric_limits<double>::quiet_NaN();
	EXPECT_EQ(s.check().outside, 1u);
	s.plane[9][2][1] = std::numeric_limits<double>::infinity();
	EXPECT_EQ(s.check().outside, 1u);
}

/// Straight triangles of the Klein model, which are the geodesic ones of the Poincaré disk at
/// k / (1 + sqrt(1 - |k|^2)).
struct KleinSheet
{
	SurfaceMesh mesh;
	std::vector<Triangle2> plane;

	KleinSheet()
	{
		Random random(620);
		mesh = randomPlanarDisk(5, random);
		double largest = 0.0;
		Point2 middle{0.0, 0.0};
		for (const Point3& p : mesh.positions)
			for (std::size_t k = 0; k < 2; ++k)
				middle[k] += p[k] / static_cast<double>(mesh.positions.size());
		for (const Point3& p : mesh.positions)
			largest = std::max(largest, std::hypot(p[0] - middle[0], p[1] - middle[1]));
		for (const Triangle& t : mesh.triangles) {
			Triangle2 corners;
			for (std::size_t k = 0; k < 3; ++k) {
				const Point3& p = mesh.positions[at(t[k])];
				const double x = 0.99 * (p[0] - middle[0]) / largest;
				const double y = 0.99 * (p[1] - middle[1]) / largest;
				const double scale = 1.0 / (1.0 + std::sqrt(1.0 - x * x - y * y));
				corners[k] = {scale * x, scale * y};
			}
			plane.push_back(corners);
		}
	}

	/// Moves the first half of the triangles.
	template<class Map>
	void moveHalf(Map map)
	{
		for (std::size_t f = 0; f < plane.size() / 2; ++f)
			for (Point2& p : plane[f])
				p = asPoint(map(asComplex(p)));
	}

	ChartCheck check(double tolerance = 1e-9) const
	{
		return checkDisk(flatMesh(mesh, plane), tolerance);
	}
};

TEST(ChartCheckInDisk, AcceptsAMapWithAndWithoutSeams)
{
	KleinSheet s;
	ChartCheck check = s.check();
	EXPECT_EQ(check.outside, 0u);
	EXPECT_LE(check.seamGap, 0.0);
	EXPECT_EQ(check.flipped, 0);
	// Cut apart by an isometry, all of the border between the halves becomes a seam.
	s.moveHalf(DiskIsometry::translationTo({0.3, -0.4}) * DiskIsometry::rotation(2.0));
	check = s.check();
	EXPECT_LT(check.seamGap, 1e-13);
	EXPECT_EQ(check.flipped, 0);
}

const SurfaceMesh kTwoTriangles{std::vector<Point3>(4), {{0, 1, 2}, {1, 0, 3}}};

TEST(ChartCheckInDisk, SeesASeamThatDoesNotFit)
{
	// Two triangles on one diameter: their common sides have the lengths 1 and 1.01.
	const auto on = [](double distance) { return std::tanh(0.5 * distance); };
	const Point2 origin{0.0, 0.0};
	const ChartCheck check = checkDisk(
		flatMesh(
			kTwoTriangles,
			{{{origin, {on(1.0), 0.0}, {0.0, 0.5}}}, {{{on(1.01), 0.0}, origin, {0.0, -0.5}}}}),
		1e-9);
	EXPECT_NEAR(check.seamGap, 0.01, 1e-13);
	EXPECT_NEAR(check.radius, 2.0 * std::atanh(0.5), 1e-14);
	EXPECT_EQ(check.flipped, 0);
	// A similarity of the plane is no isometry of the disk.
	KleinSheet s;
	s.moveHalf([](std::complex<double> z) { return 0.9 * z; });
	EXPECT_GT(s.check().seamGap, 0.01);
}

TEST(ChartCheckInDisk, AllowsForTheRoundingOfBothSidesOfASeam)
{
	// The same side twice, at 0 and where one unit in the last place is a distance of 1e-11: what the
	// sides differ by there is rounding, whichever triangle comes first.
	Random random(621);
	double largest = 0.0;
	for (int trial = 0; trial < 200; ++trial) {
		const DiskIsometry away =
			DiskIsometry::rotation(random.real(-3.0, 3.0)) * DiskIsometry::translation(12.0);
		const std::complex<double> p(random.real(-0.4, 0.4), random.real(-0.4, 0.4)),
			q(random.real(-0.4, 0.4), random.real(-0.4, 0.4));
		const std::complex<double> x = away(p), y = away(q);
		const Point2 near[] = {asPoint(p), asPoint(q)};
		const Point2 far[] = {asPoint(x), asPoint(y)};
		const Point2 apex{0.0, 0.0};
		const bool swapped = trial % 2 == 1;
		const auto& first = swapped ? far : near;
		const auto& second = swapped ? near : far;
		const ChartCheck check = checkDisk(
			flatMesh(kTwoTriangles, {{{first[0], first[1], apex}}, {{second[1], second[0], apex}}}),
			1.0);
		EXPECT_LE(check.seamGap, 0.0);
		largest = std::max(largest, std::abs(chordLength(x, y) - chordLength(p, q)));
	}
	EXPECT_GT(largest, 1e-12); // or there is nothing to allow for
}

TEST(ChartCheckInDisk, CountsFlippedTrianglesByTheirHeight)
{
	// The third corner lies at the distance 0.25 from a diameter, on the wrong side, anywhere in
	// the disk.
	const double height = 0.25, y = -std::tanh(0.5 * height);
	const SurfaceMesh triangle{std::vector<Point3>(3), {{0, 1, 2}}};
	for (double place : {0.0, 0.9, 0.999}) {
		const DiskIsometry move =
			DiskIsometry::translationTo({place, 0.0}) * DiskIsometry::rotation(0.7);
		Triangle2 p = {Point2{-0.5, 0.0}, Point2{0.5, 0.0}, Point2{0.0, y}};
		for (Point2& q : p)
			q = asPoint(move(asComplex(q)));
		EXPECT_EQ(checkDisk(flatMesh(triangle, {p}), 0.9 * height).flipped, 1) << place;
		EXPECT_EQ(checkDisk(flatMesh(triangle, {p}), 1.1 * height).flipped, 0) << place;
		std::swap(p[0], p[1]);
		EXPECT_EQ(checkDisk(flatMesh(triangle, {p}), 0.0).flipped, 0) << place;
	}
}

TEST(ChartCheckInDisk, CountsPointsThatAreNotInTheDisk)
{
	const double nan = std::numeric_limits<double>::quiet_NaN();
	for (const Point2& bad : {Point2{1.0, 0.0}, Point2{0.8, 0.8}, Point2{nan, 0.0}}) {
		KleinSheet s;
		s.plane[3][1] = bad;
		EXPECT_EQ(s.check().outside, 1u);
	}
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Triangles over the plane.
struct Sheet
{
	SurfaceMesh mesh;
	std::vector<Triangle2> plane;

	FlatMesh chart() const { return flatMesh(mesh, plane); }
	/// The same with one triangle in the other order.
	FlatMesh withFlipped(int face) const
	{
		FlatMesh flat = chart();
		std::swap(flat.vertices[face][1], flat.vertices[face][2]);
		std::swap(flat.points[face][1], flat.points[face][2]);
		connect(flat);
		return flat;
	}
};

/// A plane mesh round 0 as its own map.
Sheet sheet(double extent)
{
	Random random(640);
	Sheet sheet{randomPlanarDisk(5, random), {}};
	for (Point3& p : sheet.mesh.positions)
		p = {extent * (p[0] - 0.5), extent * (p[1] - 0.5), 0.0};
	sheet.plane = flatMesh(sheet.mesh).corners().values();
	return sheet;
}

/// The result of a flow that misses its target by \p open radians in all.
FlowResult flowThatMisses(double open)
{
	FlowResult flow;
	flow.curvature = VertexVector::Zero(2);
	flow.target.curvature = VertexVector::Constant(2, 0.5 * open);
	flow.target.fixed = {0, 0};
	return flow;
}

/// The error with which a check ends, which has to be a failed check that has found \p words.
template<class Call>
void expectFailure(const Call& call, const std::vector<std::string>& words)
{
	const auto error = refusalOf<NotConverged>(call);
	EXPECT_EQ(error.problem, NotConverged::CheckFailed);
	expectWords(error.finding, words);
}

/// The second half of the triangles moved apart and made larger.
Sheet torn(Sheet sheet, double factor)
{
	for (std::size_t f = sheet.plane.size() / 2; f < sheet.plane.size(); ++f)
		for (Point2& p : sheet.plane[f])
			p = {factor * p[0], factor * p[1]};
	return sheet;
}

TEST(ChartCheck, AMapsSeamsHaveToFit)
{
	const Sheet good = sheet(1.0);
	EXPECT_NO_THROW(requireMap(good.chart(), flowThatMisses(0.0), false));
	EXPECT_NO_THROW(requireMap(torn(good, 1.0 + 1e-8).chart(), flowThatMisses(0.0), false));
	const FlatMesh bad = torn(good, 1.001).chart();
	for (bool bent : {false, true})
		expectFailure(
			[&] { requireMap(bad, flowThatMisses(0.0), bent); },
			{"seams ", "of the chart apart", "0 faces flipped"});
	// Curvature that is left open lets seams gape.
	EXPECT_NO_THROW(requireMap(bad, flowThatMisses(0.01), false));
}

TEST(ChartCheck, AMapFlipsNoTriangleUnlessTheyAreBent)
{
	const FlatMesh chart = sheet(1.0).withFlipped(7);
	expectFailure([&] { requireMap(chart, flowThatMisses(0.0), false); }, {"1 faces flipped"});
	EXPECT_NO_THROW(requireMap(chart, flowThatMisses(0.0), true));
}

TEST(ChartCheck, AMapConsistsOfNumbers)
{
	Sheet s = sheet(1.0);
	s.plane[9][2][1] = kNaN;
	EXPECT_THROW(requireMap(s.chart(), flowThatMisses(0.0), true), NotConverged);
}

/// A chart in the disk: straight triangles of the Klein model are the geodesic ones.
Sheet diskSheet()
{
	Sheet s = sheet(1.2);
	for (Triangle2& corners : s.plane)
		for (Point2& p : corners) {
			const double scale = 1.0 / (1.0 + std::sqrt(1.0 - p[0] * p[0] - p[1] * p[1]));
			p = {scale * p[0], scale * p[1]};
		}
	return s;
}

void require(const FlatMesh& chart, double open, bool bent)
{
	requireDisk(chart, flowThatMisses(open), bent);
}

TEST(ChartCheck, SeamsInTheDiskHaveToFit)
{
	Sheet s = diskSheet();
	EXPECT_NO_THROW(require(s.chart(), 0.0, false));
	// An isometry makes the border of the two halves a seam.
	const DiskIsometry move = DiskIsometry::translation(0.7) * DiskIsometry::rotation(2.0);
	for (std::size_t f = 0; f < s.plane.size() / 2; ++f)
		for (Point2& p : s.plane[f])
			p = asPoint(move(asComplex(p)));
	EXPECT_NO_THROW(require(s.chart(), 0.0, false));
	const FlatMesh bad = torn(s, 0.999).chart();
	for (bool bent : {false, true})
		expectFailure(
			[&] { require(bad, 0.0, bent); }, {"seams ", "apart in the disk", "0 faces flipped"});
	EXPECT_NO_THROW(require(bad, 0.01, false));
}

TEST(ChartCheck, TrianglesInTheDiskAreNotFlippedUnlessTheyAreBent)
{
	const FlatMesh chart = diskSheet().withFlipped(7);
	expectFailure([&] { require(chart, 0.0, false); }, {"1 faces flipped"});
	EXPECT_NO_THROW(require(chart, 0.0, true));
}

TEST(ChartCheck, PointsOnTheBorderOfTheDiskAreRounding)
{
	Sheet s = diskSheet();
	s.plane[3][1] = {1.0, 0.0};
	for (bool bent : {false, true}) {
		const auto error = refusalOf<NotConverged>([&] { require(s.chart(), 0.0, bent); });
		EXPECT_EQ(error.problem, NotConverged::OutsideDisk);
		EXPECT_EQ(error.count, 1u);
		expectWords(error.what(), {"1 corners of faces"});
	}
	s.plane[3][1] = {kNaN, 0.0};
	expectFailure([&] { require(s.chart(), 0.0, true); }, {"1 points lie outside the disk"});
}

} // namespace
} // namespace ricci::testing
