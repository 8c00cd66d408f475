// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/flat_meshes.h"
#include "support/random_surface.h"
#include "support/shapes.h"

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
