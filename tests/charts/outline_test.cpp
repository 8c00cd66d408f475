// SPDX-License-Identifier: GPL-3.0-or-later
// Outlines, their distances and places. packing_test.cpp has the texture coordinates that come of it.
#include "support/flat_meshes.h"

#include <ricci/base/numbers.h>
#include <ricci/base/tolerances.h>
#include <ricci/charts/outline_packing.h>
#include <ricci/charts/pack.h>
#include <ricci/charts/pack_items.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ricci::testing {
namespace {

Outline polygon(const std::vector<Point2>& corners)
{
	Outline outline;
	for (std::size_t i = 0; i < corners.size(); ++i)
		outline.push_back({corners[i], corners[(i + 1) % corners.size()]});
	return outline;
}

Outline box(double width, double height, const Point2& corner = {0, 0})
{
	const double x = corner[0], y = corner[1];
	return polygon({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}});
}

/// Whether an outline goes round a point.
bool contains(const Outline& outline, const Point2& p)
{
	int turns = 0;
	for (const auto& s : outline)
		if ((s[0][1] <= p[1]) != (s[1][1] <= p[1])) {
			const bool up = s[0][1] <= p[1];
			if ((doubledArea(s[0], s[1], p) > 0.0) == up)
				turns += up ? 1 : -1;
		}
	return turns != 0;
}

/// Whether no corner of an outline is nearer than \p padding to another one, and none lies in another.
bool keepApart(const std::vector<Outline>& outlines, double padding)
{
	for (std::size_t i = 0; i < outlines.size(); ++i)
		for (std::size_t j = 0; j < outlines.size(); ++j) {
			if (i == j)
				continue;
			if (contains(outlines[i], outlines[j].front()[0]))
				return false;
			for (const auto& s : outlines[i])
				for (const auto& t : outlines[j]) {
					const double share = nearestOnSegment(s[0], s[1], t[0]);
					if (distance(t[0], between(s[0], s[1], share)) < padding)
						return false;
				}
		}
	return true;
}

std::vector<Motion>
pack(const std::vector<Outline>& outlines, double side, double padding, ChartTurns turns)
{
	return packOutlines(outlines, std::vector<ChartTurns>(outlines.size(), turns), side, padding);
}

void expectPacked(std::vector<Outline> outlines, double side, double padding, ChartTurns turns)
{
	const std::vector<Motion> motions = pack(outlines, side, padding, turns);
	ASSERT_EQ(motions.size(), outlines.size());
	for (std::size_t i = 0; i < motions.size(); ++i) {
		const std::complex<double> turn = motions[i].turn;
		EXPECT_NEAR(std::abs(turn), 1.0, 1e-15);
		EXPECT_TRUE(turns != ChartTurns::None || turn == 1.0);
		EXPECT_TRUE(turns != ChartTurns::Quarter || turn.real() * turn.imag() == 0.0);
		for (auto& ends : outlines[i])
			for (Point2& p : ends) {
				p = motions[i](p);
				for (double x : p) {
					EXPECT_GE(x, 0.5 * padding * (1 - 1e-9));
					EXPECT_LE(x, side - 0.5 * padding * (1 - 1e-9));
				}
			}
	}
	EXPECT_TRUE(keepApart(outlines, padding * (1 - 1e-9)));
}

TEST(PackOutlines, UsesHolesNotchesAndTurns)
{
	// A frame of side 3 with a hole of side 2, clockwise, and squares that fit in.
	Outline holed = box(3.0, 3.0);
	const Outline hole = polygon({{0.5, 0.5}, {0.5, 2.5}, {2.5, 2.5}, {2.5, 0.5}});
	holed.insert(holed.end(), hole.begin(), hole.end());
	expectPacked({box(0.9, 0.9), holed, box(0.9, 0.9)}, 3.05, 0.01, ChartTurns::Free);
	// Two L of three squares each fill a rectangle of two by three, with a turn by two right angles.
	const Outline corner = polygon({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
	for (ChartTurns turns : {ChartTurns::Quarter, ChartTurns::Free})
		expectPacked({corner, corner}, 3.05, 0.0, turns);
	EXPECT_TRUE(pack({corner, corner}, 2.9, 0.0, ChartTurns::Free).empty());
	// A strip of 1 by 0.1 has a square of side 1.1 / sqrt(2) round it, turned by half a right angle.
	const std::vector<Outline> strips{box(1.0, 0.1), box(0.3, 0.3)};
	const double least = 1.1 * std::sqrt(0.5);
	EXPECT_TRUE(pack(strips, 0.99, 0.0, ChartTurns::Quarter).empty());
	EXPECT_TRUE(pack(strips, 0.99 * least, 0.0, ChartTurns::Free).empty());
	expectPacked(strips, 1.03 * least, 0.0, ChartTurns::Free);
}

/// Charts of two triangles each, which fill the boxes from the origin with these sizes.
Parametrization boxCharts(const std::vector<Point2>& sizes)
{
	SurfaceMesh all;
	Array<int> chart;
	for (const auto& [x, y] : sizes) {
		all = sideBySide(all, rectangle(1, 1, x, y), 0.0);
		chart.push_back(chart.size() / 2);
		chart.push_back(chart.back());
	}
	FlatMesh mesh = flatMesh(all);
	mesh.chart = chart;
	return mapWith(mesh);
}

/// A chart that is thinner than what floats show keeps its box, upright. Triangles at the border of a small chart may
/// have to be pushed outward to be given a height.
TEST(PackCharts, ThinAndSmallChartsHaveRoomOfTheirOwn)
{
	const std::vector<std::vector<Point2>> cases{
		{{1.0, 1e-9}},
		{{1.0, 1e-9}, {1.0, 0.1}, {0.5, 0.5}, {0.2, 0.9}},
		{{2.0, 1.0}, {1.5, 1e-9}, {1e-9, 1.2}, {1e-9, 1e-9}},
		{{1.0, 1.0}, {2.0 * kBoxRoom, 3.0 * kBoxRoom}}};
	constexpr double kMinHeightInText = 2e-6; // a height in six decimals, and as much again
	for (const std::vector<Point2>& sizes : cases)
		for (const double margin : {0.0, 0.05})
			for (const ChartTurns turns : {ChartTurns::None, ChartTurns::Free}) {
				Parametrization map = boxCharts(sizes);
				packCharts(map, {true, margin, ChartTurns::Free, {}}, turns);
				for (std::size_t i = 0; i < sizes.size(); ++i) {
					const Box2& room = map.charts[i].box;
					Box2 own;
					for (const int f : {0, 1})
						for (const Point2& p : map.mesh.at(static_cast<int>(2 * i) + f))
							own.add(p);
					EXPECT_TRUE(room.contains(own.min) && room.contains(own.max));
					EXPECT_GE(std::min(room.width(), room.height()), kMinHeightInText);
					const double thin = std::min(sizes[i][0], sizes[i][1]);
					if (thin < 1e-8) { // upright
						EXPECT_LT(std::min(own.width(), own.height()), 1e-8);
					}
					if (sizes.size() == 1) {
						EXPECT_GE(std::min(room.width(), room.height()), 0.5 * kBoxRoom);
					}
					for (std::size_t k = 0; k < 2; ++k) {
						EXPECT_GE(room.min[k], 0.0);
						EXPECT_LE(room.max[k], 1.0);
						if (thin <= 2.0 * kBoxRoom) { // in the middle
							EXPECT_NEAR(room.min[k] + room.max[k], own.min[k] + own.max[k], 1e-15);
							EXPECT_GT(
								own.min[k] - room.min[k], thin > 1e-8 ? 0.25 * kBoxRoom : -1e-15);
						}
					}
				}
			}
	Parametrization wide = boxCharts({{2.0, 1.0}}); // its own box
	packCharts(wide, {false, 0.0, ChartTurns::Free, {}}, ChartTurns::None);
	EXPECT_EQ(wide.charts[0].box.min, (Point2{0.0, 0.0}));
	EXPECT_EQ(wide.charts[0].box.max, (Point2{2.0, 1.0}));
}

/// Of a chart of any shape, the turn that lays it along the axes is found to rounding; of a round one there is none.
TEST(Upright, IsAnOutlineOfRightAngles)
{
	const std::vector<Point2> corners{
		{0, 0}, {4, 0}, {4, 1}, {3, 1}, {3, 2.5}, {2, 2.5}, {2, 1}, {0, 1}};
	for (const double angle : {0.0, 0.02, 0.7, 0.785, 1.5, -1.2}) {
		const std::complex<double> own = std::polar(1.0, angle);
		Outline outline;
		for (std::size_t i = 0; i < corners.size(); ++i)
			outline.push_back(
				{asPoint(own * asComplex(corners[i])),
				 asPoint(own * asComplex(corners[(i + 1) % corners.size()]))});
		const std::complex<double> turn = uprightTurn(outline), whole = turn * own;
		EXPECT_NEAR(std::abs(turn), 1.0, 1e-14);
		EXPECT_NEAR(
			std::abs(whole.real() * whole.imag()), 0.0, 1e-14); // by right angles from upright
		// A round bay of less than half the outline does not matter, a larger one does.
		for (const double radius : {1.5, 4.0}) {
			Outline round = outline;
			for (int i = 0; i < 60; ++i) {
				const auto at = [&](int k) {
					return asPoint(own * std::polar(radius, 2.0 * kPi * k / 60) + 9.0);
				};
				round.push_back({at(i + 1), at(i)});
			}
			EXPECT_EQ(uprightTurn(round) != 0.0, radius < 2.0);
		}
	}
}

/// n squares of no extent with the margin m round each, side by side in a square of side 1: the
/// margins between them are shared, so sqrt(n) + 1 of them fit.
TEST(PackCharts, MarginsMayFitAgreesWithPointsOnAGrid)
{
	for (int k = 1; k < 60; ++k) {
		const double bound = 1.0 / (k + 1);
		EXPECT_TRUE(marginsMayFit(positionOf(k * k), 0.999999 * bound));
		EXPECT_FALSE(marginsMayFit(positionOf(k * k), 1.000001 * bound));
	}
}

} // namespace
} // namespace ricci::testing
