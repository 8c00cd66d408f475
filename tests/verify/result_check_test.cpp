// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
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
#include <numeric>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A plane mesh round 0 as its own map. Every second face is clockwise, and wanted so.
OutputTriangles sheet(double extent)
{
	Random random(640);
	const SurfaceMesh mesh = randomPlanarDisk(5, random);
	OutputTriangles output;
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
		Triangle t = mesh.triangles[f];
		output.reversed.push_back(f % 2 == 1);
		if (f % 2 == 1)
			std::swap(t[1], t[2]);
		Triangle2 corners;
		for (std::size_t k = 0; k < 3; ++k) {
			const Point3& p = mesh.positions[at(t[k])];
			corners[k] = {extent * (p[0] - 0.5), extent * (p[1] - 0.5)};
		}
		output.triangles.push_back(t);
		output.plane.push_back(corners);
	}
	return output;
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
OutputTriangles torn(OutputTriangles output, double factor)
{
	for (std::size_t f = output.plane.size() / 2; f < output.plane.size(); ++f)
		for (Point2& p : output.plane[f])
			p = {factor * p[0], factor * p[1]};
	return output;
}

TEST(ResultCheck, AMapsSeamsHaveToFit)
{
	const OutputTriangles good = sheet(1.0);
	EXPECT_NO_THROW(requireMap(good, flowThatMisses(0.0), false));
	EXPECT_NO_THROW(requireMap(torn(good, 1.0 + 1e-8), flowThatMisses(0.0), false));
	const OutputTriangles bad = torn(good, 1.001);
	for (bool bent : {false, true})
		expectFailure(
			[&] { requireMap(bad, flowThatMisses(0.0), bent); },
			{"seams ", "of the chart apart", "0 faces turned round"});
	// Curvature that is left open lets seams gape.
	EXPECT_NO_THROW(requireMap(bad, flowThatMisses(0.01), false));
}

TEST(ResultCheck, AMapTurnsNoTriangleUnlessTheyAreBent)
{
	OutputTriangles output = sheet(1.0);
	output.reversed[7] = !output.reversed[7];
	expectFailure(
		[&] { requireMap(output, flowThatMisses(0.0), false); }, {"1 faces turned round"});
	EXPECT_NO_THROW(requireMap(output, flowThatMisses(0.0), true));
}

TEST(ResultCheck, AMapConsistsOfNumbers)
{
	OutputTriangles output = sheet(1.0);
	output.plane[9][2][1] = kNaN;
	EXPECT_THROW(requireMap(output, flowThatMisses(0.0), true), NotConverged);
}

/// A chart in the disk with the layout that it comes from.
struct DiskChart
{
	OutputTriangles output;
	PlanarLayout layout;

	explicit DiskChart(OutputTriangles o) : output(std::move(o))
	{
		// Straight triangles of the Klein model are the geodesic ones.
		for (Triangle2& corners : output.plane)
			for (Point2& p : corners) {
				const double scale = 1.0 / (1.0 + std::sqrt(1.0 - p[0] * p[0] - p[1] * p[1]));
				p = {scale * p[0], scale * p[1]};
			}
		setLayout();
	}

	void setLayout()
	{
		layout.points.clear();
		for (const Triangle2& corners : output.plane)
			for (const Point2& p : corners)
				layout.points.push_back(p);
	}

	void require(double open, bool bent) const
	{
		requireDisk(output, layout, flowThatMisses(open), bent);
	}
};

TEST(ResultCheck, SeamsInTheDiskHaveToFit)
{
	DiskChart chart(sheet(1.2));
	EXPECT_NO_THROW(chart.require(0.0, false));
	// An isometry makes the border of the two halves a seam.
	const DiskIsometry move = DiskIsometry::translation(0.7) * DiskIsometry::rotation(2.0);
	for (std::size_t f = 0; f < chart.output.plane.size() / 2; ++f)
		for (Point2& p : chart.output.plane[f])
			p = asPoint(move(asComplex(p)));
	chart.setLayout();
	EXPECT_NO_THROW(chart.require(0.0, false));
	chart.output = torn(chart.output, 0.999);
	for (bool bent : {false, true})
		expectFailure(
			[&] { chart.require(0.0, bent); }, {"seams ", "apart in the disk", "0 faces turned"});
	EXPECT_NO_THROW(chart.require(0.01, false));
}

TEST(ResultCheck, TrianglesInTheDiskAreNotTurnedUnlessTheyAreBent)
{
	DiskChart chart(sheet(1.2));
	chart.output.reversed[7] = !chart.output.reversed[7];
	expectFailure([&] { chart.require(0.0, false); }, {"1 faces turned round"});
	EXPECT_NO_THROW(chart.require(0.0, true));
}

TEST(ResultCheck, PointsOnTheBorderOfTheDiskAreRounding)
{
	DiskChart chart(sheet(1.2));
	chart.output.plane[3][1] = {1.0, 0.0};
	chart.setLayout();
	for (bool bent : {false, true}) {
		const auto error = errorOf<NotConverged>([&] { chart.require(0.0, bent); });
		ASSERT_TRUE(error);
		EXPECT_EQ(error->problem, NotConverged::OutsideDisk);
		EXPECT_EQ(error->count, 1u);
		expectWords(error->what(), {"1 corners of faces"});
	}
	chart.output.plane[3][1] = {kNaN, 0.0};
	chart.setLayout();
	expectFailure([&] { chart.require(0.0, true); }, {"1 points lie outside the disk"});
}

/// The strip of a ring, turning by \p angle: it overlaps itself where that is more than 2 pi,
/// unless the first and the second half are charts of their own.
struct Strip
{
	SurfaceMesh mesh;
	Parametrization map;

	Strip(double angle, int charts)
	{
		mesh = grid(40, 2, Ends::Open, Ends::Open, [&](int i, int j) {
			const double a = angle * i / 40, r = 2.0 - 0.5 * j + 0.5 * a / (2 * kPi);
			return Point3{r * std::cos(a), r * std::sin(a), 0.0};
		});
		const std::size_t n = mesh.triangles.size();
		for (const Triangle& t : mesh.triangles) {
			Triangle2 corners;
			for (std::size_t k = 0; k < 3; ++k)
				corners[k] = {mesh.positions[at(t[k])][0], mesh.positions[at(t[k])][1]};
			map.uv.push_back(corners);
		}
		map.reversed.assign(n, 0);
		map.charts.resize(static_cast<std::size_t>(charts));
		for (std::size_t f = 0; f < n; ++f)
			map.charts[f * map.charts.size() / n].faces.push_back(static_cast<int>(f));
	}

	void require() const { requireSeparateCharts(mesh, map); }

	/// The same triangles as pieces of a refinement, two of which lie in the first face.
	void refine()
	{
		map.refined.triangles = mesh.triangles;
		map.refined.uv = map.uv;
		map.refined.inputFace.resize(mesh.triangles.size());
		std::iota(map.refined.inputFace.begin(), map.refined.inputFace.end(), 0);
		map.refined.inputFace[1] = 0;
		for (Chart& chart : map.charts)
			chart.refined.swap(chart.faces);
		map.uv.clear();
	}
};

TEST(ResultCheck, AChartDoesNotOverlapItself)
{
	for (bool refined : {false, true}) {
		Strip short1(1.5 * kPi, 1), long1(2.3 * kPi, 1), long2(2.3 * kPi, 2);
		if (refined)
			for (Strip* strip : {&short1, &long1, &long2})
				strip->refine();
		EXPECT_NO_THROW(short1.require());
		expectFailure([&] { long1.require(); }, {"2 crossings", "should not overlap"});
		EXPECT_NO_THROW(long2.require());
		// A chart with a turned triangle may.
		long1.map.reversed[5] = 1;
		EXPECT_NO_THROW(long1.require());
	}
}

/// Parts of one layout may differ in scale by more than rounding lets them resolve.
TEST(ResultCheck, AChartSmallerThanATexelMayOverlapItself)
{
	for (const double scale : {1e-2, 1e-8}) {
		Strip strip(1.5 * kPi, 1), tiny(2.3 * kPi, 1);
		const int n = static_cast<int>(strip.mesh.positions.size());
		const int faces = static_cast<int>(strip.mesh.triangles.size());
		for (const Triangle& t : tiny.mesh.triangles)
			strip.mesh.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
		for (Triangle2 corners : tiny.map.uv) {
			for (Point2& p : corners)
				p = {scale * p[0], scale * p[1]};
			strip.map.uv.push_back(corners);
		}
		strip.map.reversed.resize(strip.map.uv.size(), 0);
		strip.map.charts.push_back(tiny.map.charts[0]);
		for (int& f : strip.map.charts[1].faces)
			f += faces;
		if (scale > 1e-6)
			expectFailure([&] { strip.require(); }, {"2 crossings", "should not overlap"});
		else
			EXPECT_NO_THROW(strip.require());
	}
}

TEST(ResultCheck, ChartsContainEveryTriangleOnce)
{
	for (bool refined : {false, true}) {
		Strip missing(1.5 * kPi, 2), twice(1.5 * kPi, 2);
		if (refined)
			for (Strip* strip : {&missing, &twice})
				strip->refine();
		const auto facesOf = [&](Strip& strip, std::size_t chart) -> std::vector<int>& {
			return refined ? strip.map.charts[chart].refined : strip.map.charts[chart].faces;
		};
		facesOf(missing, 0).pop_back();
		expectFailure([&] { missing.require(); }, {"0 crossings"});
		facesOf(twice, 0).push_back(facesOf(twice, 1).front());
		EXPECT_THROW(twice.require(), NotConverged);
	}
}

} // namespace
} // namespace ricci::testing
