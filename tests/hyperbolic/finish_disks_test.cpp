// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/complex.h"

#include <ricci/hyperbolic/finish_disks.h>
#include <ricci/measure/map_check.h>

#include <gtest/gtest.h>

namespace ricci::testing {
namespace {

/// A band along the real axis of the disk, between two curves at the distance \p halfWidth from it, of \p n
/// quadrilaterals with sides \p step along it, each of two triangles; the middle of the band lies at 0.
Parametrization band(int n, double step, double halfWidth)
{
	Parametrization map;
	FlatMesh& mesh = map.mesh;
	for (int i = 0; i <= n; ++i)
		for (const double side : {-1.0, 1.0}) {
			const ExtendedIsometry at = ExtendedIsometry::translation(step * (i - 0.5 * n)) *
										ExtendedIsometry::rotation(side * 0.5 * M_PI) *
										ExtendedIsometry::translation(halfWidth);
			mesh.place.push_back(asPoint(Complex(at.origin())));
		}
	for (int i = 0; i < n; ++i) {
		mesh.points.push_back({2 * i, 2 * i + 2, 2 * i + 3});
		mesh.points.push_back({2 * i, 2 * i + 3, 2 * i + 1});
	}
	mesh.vertices = mesh.points;
	connect(mesh);
	mesh.source.assign(mesh.place.size(), {});
	mesh.lengths.assign(mesh.points.size(), {1.0, 1.0, 1.0});
	mesh.chart.assign(mesh.points.size(), 0);
	mesh.face = mesh.chart;
	map.charts.emplace_back();
	return map;
}

TEST(DivideDisks, TellsWhereThereAreTooManyDisks)
{
	Parametrization map = band(160, 0.2, 0.1);
	const Array<Point2> before = map.mesh.place;
	map.charts.resize(kMaxDisks);
	EXPECT_FALSE(divideDisks(map));
	EXPECT_EQ(map.report.endedEarly, 1);
	EXPECT_EQ(map.mesh.place.values(), before.values());
	// What is divided before there are too many stays divided.
	map = band(160, 0.2, 0.1);
	map.charts.resize(kMaxDisks - 1);
	EXPECT_TRUE(divideDisks(map));
	EXPECT_EQ(map.report.endedEarly, 1);
	EXPECT_GE(static_cast<int>(map.charts.size()), kMaxDisks);
	map = band(40, 0.2, 0.1); // needs no more
	map.charts.resize(kMaxDisks);
	EXPECT_FALSE(divideDisks(map));
	EXPECT_EQ(map.report.endedEarly, 0);
}

/// A band that reaches 16 out: floats end at about 14.
TEST(DivideDisks, MovesFarPartsByIsometries)
{
	const Parametrization whole = band(160, 0.2, 0.1);
	Parametrization map = whole;
	ASSERT_TRUE(divideDisks(map));
	ASSERT_GT(map.charts.size(), 1U);
	for (const int f : map.mesh.points.indices()) {
		const Chart& chart = map.charts[positionOf(map.mesh.chart[f])];
		EXPECT_EQ(chart.middle, map.mesh.chart[f] == 0 ? -1 : 0);
		for (std::size_t k = 0; k < 3; ++k) {
			const Point2 moved = asPoint(Complex(chart.place(asComplex(whole.mesh.at(f)[k]))));
			EXPECT_LT(distance(map.mesh.at(f)[k], moved), 1e-15);
		}
	}
	// The parts lie about their middles: half a part of the band is the farthest.
	const double half = 0.5 * 160 * 0.2;
	for (const Point2& p : map.mesh.place)
		EXPECT_LT(2.0 * std::atanh(std::hypot(p[0], p[1])), 0.75 * half);
	const ChartCheck parts = checkDisk(map.mesh, 1e-6);
	EXPECT_EQ(parts.flipped, 0);
	// The triangles of neighbouring parts keep the lengths of their common sides: at 16 a double tells 1e-9.
	EXPECT_LT(parts.seamGap, 1e-8);
	// Each cut across the band is one edge.
	const EdgeSet cuts = seams(map.mesh);
	EXPECT_EQ(map.report.overlapCuts, static_cast<int>(cuts.sides.size()));
	EXPECT_EQ(cuts.sides.size(), map.charts.size() - 1);
	EXPECT_DOUBLE_EQ(map.report.seamLength, cuts.length);
}

} // namespace
} // namespace ricci::testing
