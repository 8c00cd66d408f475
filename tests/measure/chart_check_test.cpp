// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/complex.h"
#include "support/expect.h"
#include "support/flat_meshes.h"
#include "support/random_surface.h"

#include <ricci/base/numbers.h>
#include <ricci/measure/map_check.h>
#include <ricci/numerics/disk_isometry.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ricci::testing {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A plane mesh round 0 as its own map, or straight triangles of the Klein model, which are the geodesic ones of
/// the Poincaré disk at k / (1 + sqrt(1 - |k|^2)).
struct Sheet
{
	SurfaceMesh mesh;
	std::vector<Triangle2> plane;
	bool inDisk;

	explicit Sheet(bool disk) : inDisk(disk)
	{
		Random random(640);
		mesh = randomPlanarDisk(5, random);
		for (Point3& p : mesh.positions)
			p = {1.2 * (p[0] - 0.5), 1.2 * (p[1] - 0.5), 0.0};
		plane = flatMesh(mesh).corners().values();
		if (inDisk)
			move(0, [](Complex k) { return k / (1.0 + std::sqrt(1.0 - std::norm(k))); });
	}

	/// Moves the triangles from \p first on.
	template<class Map>
	void move(std::size_t first, const Map& map)
	{
		for (std::size_t f = first; f < plane.size(); ++f)
			for (Point2& p : plane[f])
				p = asPoint(map(asComplex(p)));
	}
	/// Cut apart by a motion of a half: all its border becomes a seam.
	void cutApart()
	{
		const DiskIsometry g =
			DiskIsometry::translationTo({0.3, -0.4}) * DiskIsometry::rotation(2.0);
		move(plane.size() / 2, [&](Complex z) {
			return inDisk ? g(z) : Complex(3.0, 0.5) + std::polar(1.0, 0.7) * z;
		});
	}
	void enlargeHalf(double factor)
	{
		move(plane.size() / 2, [&](Complex z) { return factor * z; });
	}

	FlatMesh chart() const { return flatMesh(mesh, plane); }
	/// The same with some triangles in the other order.
	FlatMesh withFlipped(const std::vector<int>& faces) const
	{
		FlatMesh flat = chart();
		for (const int f : faces) {
			std::swap(flat.vertices[f][1], flat.vertices[f][2]);
			std::swap(flat.points[f][1], flat.points[f][2]);
		}
		connect(flat);
		return flat;
	}
	ChartCheck check(double tolerance = 1e-9) const { return checkOf(chart(), tolerance); }
	ChartCheck checkOf(const FlatMesh& flat, double tolerance = 1e-9) const
	{
		return inDisk ? checkDisk(flat, tolerance) : checkMap(flat, tolerance);
	}

	/// Of a flow that misses its target by \p open radians in all.
	void require(const FlatMesh& flat, double open, bool bent) const
	{
		FlowResult flow;
		flow.curvature = VertexVector::Zero(2);
		flow.target.curvature = VertexVector::Constant(2, 0.5 * open);
		flow.target.fixed = {0, 0};
		inDisk ? requireDisk(flat, flow, bent) : requireMap(flat, flow, bent);
	}
	/// It has to fail and to have found \p words.
	void expectFailure(const FlatMesh& flat, bool bent, const std::vector<std::string>& words) const
	{
		const auto error = refusalFor<NotConverged>(
			NotConverged::CheckFailed, {}, [&] { require(flat, 0.0, bent); });
		expectWords(error.finding, words);
	}
};

const SurfaceMesh kTriangle{std::vector<Point3>(3), {{0, 1, 2}}};
const SurfaceMesh kTwoTriangles{std::vector<Point3>(4), {{0, 1, 2}, {1, 0, 3}}};

TEST(ChartCheck, SeamsHaveToFit)
{
	for (const bool inDisk : {false, true}) {
		SCOPED_TRACE(inDisk);
		Sheet sheet(inDisk);
		for (const bool isCut : {false, true}) {
			if (isCut)
				sheet.cutApart();
			EXPECT_EQ(sheet.check().outside, 0u);
			EXPECT_LT(sheet.check().seamGap, 1e-13);
			EXPECT_EQ(sheet.check().flipped, 0);
			EXPECT_NO_THROW(sheet.require(sheet.chart(), 0.0, false));
		}
		Sheet nearly(inDisk), torn(inDisk);
		nearly.enlargeHalf(1.0 - 1e-8);
		EXPECT_NO_THROW(nearly.require(nearly.chart(), 0.0, false));
		torn.enlargeHalf(0.999);
		for (bool bent : {false, true})
			torn.expectFailure(torn.chart(), bent, {"seams ", "apart", "0 faces flipped"});
		// Curvature that is left open lets seams gape.
		EXPECT_NO_THROW(torn.require(torn.chart(), 0.01, false));
	}
}

/// Relative to the extent of the chart in the plane; two triangles on one diameter of the disk, whose common sides
/// have the lengths 1 and 1.01.
TEST(ChartCheck, SeamGapsHaveTheirTrueSize)
{
	Sheet sheet(false);
	for (Point2& p : sheet.plane[20]) // all of its sides are inside
		p = {1.001 * p[0], 1.001 * p[1]};
	Box2 box;
	for (const Triangle2& t : sheet.plane)
		for (const Point2& p : t)
			box.add(p);
	const Triangle2& p = sheet.plane[20];
	const double longest = std::max({sideLength(p, 0), sideLength(p, 1), sideLength(p, 2)});
	EXPECT_NEAR(sheet.check().seamGap, longest * (1 - 1 / 1.001) / box.extent(), 1e-14);

	const auto on = [](double distance) { return std::tanh(0.5 * distance); };
	const Point2 origin{0.0, 0.0};
	const ChartCheck check = checkDisk(
		flatMesh(
			kTwoTriangles,
			{{{origin, {on(1.0), 0.0}, {0.0, 0.5}}}, {{{on(1.01), 0.0}, origin, {0.0, -0.5}}}}),
		1e-9);
	EXPECT_NEAR(check.seamGap, 0.01, 1e-13);
	EXPECT_EQ(check.flipped, 0);
}

/// The same side twice, at 0 and where one unit in the last place is a distance of 1e-11: what the sides differ by
/// there is rounding, whichever triangle comes first.
TEST(ChartCheck, AllowsForTheRoundingOfBothSidesOfASeam)
{
	Random random(621);
	double largest = 0.0;
	for (int trial = 0; trial < 200; ++trial) {
		const DiskIsometry away =
			DiskIsometry::rotation(random.real(-3.0, 3.0)) * DiskIsometry::translation(12.0);
		const Complex p(random.real(-0.4, 0.4), random.real(-0.4, 0.4)),
			q(random.real(-0.4, 0.4), random.real(-0.4, 0.4)), x = away(p), y = away(q);
		std::array<Complex, 4> ends{p, q, x, y};
		if (trial % 2 == 1)
			ends = {x, y, p, q};
		const Point2 apex{0.0, 0.0};
		const ChartCheck check = checkDisk(
			flatMesh(
				kTwoTriangles,
				{{{asPoint(ends[0]), asPoint(ends[1]), apex}},
				 {{asPoint(ends[3]), asPoint(ends[2]), apex}}}),
			1.0);
		EXPECT_LE(check.seamGap, 0.0);
		largest = std::max(largest, std::abs(chordLength(x, y) - chordLength(p, q)));
	}
	EXPECT_GT(largest, 1e-12); // or there is nothing to allow for
}

TEST(ChartCheck, TrianglesAreNotFlippedUnlessTheyAreBent)
{
	for (const bool inDisk : {false, true}) {
		SCOPED_TRACE(inDisk);
		const Sheet sheet(inDisk);
		const FlatMesh chart = sheet.withFlipped({7, 8});
		EXPECT_EQ(sheet.checkOf(chart).flipped, 2);
		sheet.expectFailure(chart, false, {"2 faces flipped"});
		EXPECT_NO_THROW(sheet.require(chart, 0.0, true));
	}
	// A face flipped by less than the tolerance is left to rounding.
	Sheet sheet(false);
	auto& p = sheet.plane[4];
	const Point2 side = p[1] - p[0];
	const double l = std::hypot(side[0], side[1]);
	p[2] = p[0] + Point2{0.5 * side[0] + 1e-10 * side[1] / l, 0.5 * side[1] - 1e-10 * side[0] / l};
	EXPECT_EQ(sheet.check(1e-9).flipped, 0);
	EXPECT_EQ(sheet.check(1e-11).flipped, 1);
	// The third corner lies at the distance 0.25 from a diameter, on the wrong side, anywhere in the disk.
	const double height = 0.25, y = -std::tanh(0.5 * height);
	for (double place : {0.0, 0.9, 0.999}) {
		const DiskIsometry move =
			DiskIsometry::translationTo({place, 0.0}) * DiskIsometry::rotation(0.7);
		Triangle2 t = {Point2{-0.5, 0.0}, Point2{0.5, 0.0}, Point2{0.0, y}};
		for (Point2& q : t)
			q = asPoint(move(asComplex(q)));
		EXPECT_EQ(checkDisk(flatMesh(kTriangle, {t}), 0.9 * height).flipped, 1) << place;
		EXPECT_EQ(checkDisk(flatMesh(kTriangle, {t}), 1.1 * height).flipped, 0) << place;
		std::swap(t[0], t[1]);
		EXPECT_EQ(checkDisk(flatMesh(kTriangle, {t}), 0.0).flipped, 0) << place;
	}
}

TEST(ChartCheck, PointsHaveToBeNumbersAndInTheDisk)
{
	for (const double x : {kNaN, std::numeric_limits<double>::infinity()}) {
		Sheet sheet(false);
		sheet.plane[9][2][1] = x;
		EXPECT_EQ(sheet.check().outside, 1u);
		EXPECT_THROW(sheet.require(sheet.chart(), 0.0, true), NotConverged);
	}
	for (const Point2& bad : {Point2{1.0, 0.0}, Point2{0.8, 0.8}, Point2{kNaN, 0.0}}) {
		Sheet sheet(true);
		sheet.plane[3][1] = bad;
		EXPECT_EQ(sheet.check().outside, 1u);
		if (std::isnan(bad[0])) {
			sheet.expectFailure(sheet.chart(), true, {"1 points lie outside the disk"});
			continue;
		}
		for (bool bent : {false, true}) { // what rounding has put on the border
			const auto error =
				refusalFor<NotConverged>(NotConverged::OutsideDisk, {"1 corners of faces"}, [&] {
					sheet.require(sheet.chart(), 0.0, bent);
				});
			EXPECT_EQ(error.count, 1u);
		}
	}
}

using Counts = std::array<int, 2>; ///< faces and charts

/// Faces and charts that overlap of two unit squares, one chart each, whose left sides lie at these x.
Counts overlapsOfSquares(double one, double other)
{
	const SurfaceMesh square = rectangle(1, 1, 1.0, 1.0);
	FlatMesh flat = flatMesh(sideBySide(sideBySide({}, square, one), square, other));
	for (const int f : flat.chart.indices())
		flat.chart[f] = f / 2;
	return overlapsInFloats(flat);
}

/// The strip of a ring, turning by \p angle: it overlaps itself where that is more than 2 pi, except for its
/// ends, which lie beside each other.
FlatMesh strip(double angle)
{
	return flatMesh(grid(40, 2, Ends::Open, Ends::Open, [&](int i, int j) {
		const double a = angle * i / 40, r = 2.0 - 0.5 * j + 0.5 * a / (2 * kPi);
		return Point3{r * std::cos(a), r * std::sin(a), 0.0};
	}));
}

/// Charts that are a step of a double apart may be stored at one place, and overlap by what is stored.
TEST(OverlapsInFloats, GoesByTheCoordinatesAsFloats)
{
	const double step = std::ldexp(1.0, -23); // of a float above 1
	EXPECT_EQ(overlapsOfSquares(0, 1 - 2 * step), (Counts{0, 0}));
	EXPECT_GT(overlapsOfSquares(0, 1 - 40 * step)[0], 0);
	EXPECT_EQ(overlapsOfSquares(1e6, 1e6 + 0.999), (Counts{0, 0}));
	EXPECT_GT(overlapsOfSquares(1e3, 1e3 + 0.99)[0], 0);
}

/// Two squares whose common side is a seam, the right one wider and higher by the factor \p scale.
int unequalSeamsAt(double scale)
{
	FlatMesh flat = flatMesh(
		{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}},
		 {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}}});
	flat.chart = Array<int>(std::vector<int>{0, 0, 1, 1});
	splitPoints(flat);
	const Array<int> chart = flat.chartOfPoints();
	for (const int p : chart.indices())
		if (chart[p] == 1)
			flat.place[p] = scale * flat.place[p];
	return unequalSeams(flat);
}

TEST(UnequalSeams, ComparesTheSidesOfEachEdgeOfASeam)
{
	EXPECT_EQ(unequalSeamsAt(1.0), 0);
	EXPECT_EQ(unequalSeamsAt(1.0 + 0.9 * kUnequalShare), 0);
	EXPECT_EQ(unequalSeamsAt(1.0 + 1.1 * kUnequalShare), 1);
	EXPECT_EQ(unequalSeamsAt(1.0 / (1.0 + 1.1 * kUnequalShare)), 1);
	EXPECT_EQ(unequalSeams(strip(1.5 * kPi)), 0); // no edge inside, and no boundary
}

SurfaceMesh octahedron()
{
	return {
		{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
		{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

void expectSphere(const SurfaceMesh& mesh, double degree, int turned)
{
	const SphereCheck check = checkSphere(mesh.triangles, mesh.positions);
	EXPECT_EQ(check.radiusError, 0.0);
	EXPECT_NEAR(check.degree, degree, 1e-15);
	EXPECT_EQ(check.turned, turned);
}

TEST(SphereCheck, CountsHowOftenAndWhichWayTheSphereIsCovered)
{
	SurfaceMesh mesh = octahedron();
	expectSphere(mesh, 1.0, 0);
	expectSphere(withReversedFaces(mesh, 1), -1.0, 8);
	mesh.triangles.resize(4);
	expectSphere(mesh, 0.5, 0);
	// A vertex inside the first face, drawn across the face's side on the equator: the sphere is still
	// covered once in all, but a part of it three times.
	mesh = octahedron();
	mesh.positions.push_back({0.6, 0.75, -std::sqrt(1.0 - 0.36 - 0.5625)});
	mesh.triangles[0] = {0, 2, 6};
	mesh.triangles.push_back({2, 4, 6});
	mesh.triangles.push_back({4, 0, 6});
	const SphereCheck check = checkSphere(mesh.triangles, mesh.positions);
	EXPECT_NEAR(check.degree, 1.0, 1e-15);
	EXPECT_EQ(check.turned, 1);
	for (double angle : {0.1, 0.7, 1.3}) { // on a great circle
		const double c = std::cos(angle), s = std::sin(angle);
		const std::vector<Point3> points = {{1, 0, 0}, {c, s, 0}, {c * c - s * s, 2 * s * c, 0}};
		EXPECT_EQ(checkSphere({{0, 1, 2}}, points).turned, 0);
		EXPECT_EQ(checkSphere({{0, 2, 1}}, points).turned, 0);
	}
}

TEST(SphereCheck, MeasuresTheRadii)
{
	SurfaceMesh mesh = octahedron();
	mesh.positions[3] = {0.0, -1.0 - 1e-6, 0.0};
	EXPECT_NEAR(checkSphere(mesh.triangles, mesh.positions).radiusError, 1e-6, 1e-15);
	mesh.positions[3][0] = kNaN;
	EXPECT_FALSE(std::isfinite(checkSphere(mesh.triangles, mesh.positions).radiusError));
}

} // namespace
} // namespace ricci::testing
