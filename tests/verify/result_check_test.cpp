// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/flat_meshes.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/error.h>
#include <ricci/math/disk_isometry.h>
#include <ricci/verify/result_check.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

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
	const auto error = errorOf<NotConverged>(call);
	ASSERT_TRUE(error) << "accepted";
	EXPECT_EQ(error->problem, NotConverged::CheckFailed);
	expectWords(error->finding, words);
}

/// The second half of the triangles moved apart and made larger.
Sheet torn(Sheet sheet, double factor)
{
	for (std::size_t f = sheet.plane.size() / 2; f < sheet.plane.size(); ++f)
		for (Point2& p : sheet.plane[f])
			p = {factor * p[0], factor * p[1]};
	return sheet;
}

TEST(ResultCheck, AMapsSeamsHaveToFit)
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

TEST(ResultCheck, AMapFlipsNoTriangleUnlessTheyAreBent)
{
	const FlatMesh chart = sheet(1.0).withFlipped(7);
	expectFailure([&] { requireMap(chart, flowThatMisses(0.0), false); }, {"1 faces flipped"});
	EXPECT_NO_THROW(requireMap(chart, flowThatMisses(0.0), true));
}

TEST(ResultCheck, AMapConsistsOfNumbers)
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

TEST(ResultCheck, SeamsInTheDiskHaveToFit)
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

TEST(ResultCheck, TrianglesInTheDiskAreNotFlippedUnlessTheyAreBent)
{
	const FlatMesh chart = diskSheet().withFlipped(7);
	expectFailure([&] { require(chart, 0.0, false); }, {"1 faces flipped"});
	EXPECT_NO_THROW(require(chart, 0.0, true));
}

TEST(ResultCheck, PointsOnTheBorderOfTheDiskAreRounding)
{
	Sheet s = diskSheet();
	s.plane[3][1] = {1.0, 0.0};
	for (bool bent : {false, true}) {
		const auto error = errorOf<NotConverged>([&] { require(s.chart(), 0.0, bent); });
		ASSERT_TRUE(error);
		EXPECT_EQ(error->problem, NotConverged::OutsideDisk);
		EXPECT_EQ(error->count, 1u);
		expectWords(error->what(), {"1 corners of faces"});
	}
	s.plane[3][1] = {kNaN, 0.0};
	expectFailure([&] { require(s.chart(), 0.0, true); }, {"1 points lie outside the disk"});
}

/// The strip of a ring, turning by \p angle: it overlaps itself where that is more than 2 pi, unless the
/// first and the second half are charts of their own.
Parametrization strip(double angle, int charts, double scale = 1.0)
{
	SurfaceMesh mesh = grid(40, 2, Ends::Open, Ends::Open, [&](int i, int j) {
		const double a = angle * i / 40, r = 2.0 - 0.5 * j + 0.5 * a / (2 * kPi);
		return Point3{scale * r * std::cos(a), scale * r * std::sin(a), 0.0};
	});
	FlatMesh flat = flatMesh(mesh);
	for (const int f : flat.chart.indices())
		flat.chart[f] = f * charts / flat.size();
	splitPoints(flat);
	return mapWith(flat);
}

TEST(ResultCheck, AChartDoesNotOverlapItself)
{
	EXPECT_NO_THROW(requireSeparateCharts(strip(1.5 * kPi, 1)));
	Parametrization overlapping = strip(2.3 * kPi, 1);
	expectFailure(
		[&] { requireSeparateCharts(overlapping); }, {"2 crossings", "should not overlap"});
	EXPECT_NO_THROW(requireSeparateCharts(strip(2.3 * kPi, 2)));
	// A chart with a flipped triangle may.
	std::swap(overlapping.mesh.points[5][1], overlapping.mesh.points[5][2]);
	EXPECT_NO_THROW(requireSeparateCharts(overlapping));
}

/// Parts of one layout may differ in scale by more than rounding lets them resolve.
TEST(ResultCheck, AChartSmallerThanATexelMayOverlapItself)
{
	for (const double scale : {1e-2, 1e-8}) {
		Parametrization both = strip(1.5 * kPi, 1);
		const FlatMesh tiny = strip(2.3 * kPi, 1, scale).mesh;
		const int vertices = both.mesh.source.size(), points = both.mesh.place.size();
		for (const Point2& p : tiny.place)
			both.mesh.place.push_back(p);
		for (const int f : tiny.points.indices()) {
			const Triangle &v = tiny.vertices[f], &p = tiny.points[f];
			both.mesh.vertices.push_back({v[0] + vertices, v[1] + vertices, v[2] + vertices});
			both.mesh.points.push_back({p[0] + points, p[1] + points, p[2] + points});
			both.mesh.lengths.push_back(tiny.lengths[f]);
			both.mesh.chart.push_back(1);
			both.mesh.face.push_back(both.mesh.face.size());
		}
		both.charts.emplace_back();
		if (scale > 1e-6)
			expectFailure(
				[&] { requireSeparateCharts(both); }, {"2 crossings", "should not overlap"});
		else
			EXPECT_NO_THROW(requireSeparateCharts(both));
	}
}

} // namespace
} // namespace ricci::testing
