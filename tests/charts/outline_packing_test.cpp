// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/listener.h"
#include "support/random.h"

#include <ricci/charts/outline_packing.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ricci::testing {
namespace {

Outline polygon(const std::vector<Point2>& corners)
{
	Outline outline;
	for (std::size_t i = 0; i < corners.size(); ++i)
		outline.push_back({corners[i], corners[(i + 1) % corners.size()]});
	return outline;
}

Outline rectangle(double width, double height)
{
	return polygon({{0, 0}, {width, 0}, {width, height}, {0, height}});
}

/// Round a point, with corners at random distances.
Outline star(double size, Random& random)
{
	std::vector<Point2> corners;
	const int n = 3 + random.index(20);
	for (int i = 0; i < n; ++i) {
		const double angle = 2.0 * 3.141592653589793 * i / n, r = size * random.real(0.2, 1.0);
		corners.push_back({3.0 + r * std::cos(angle), -5.0 + r * std::sin(angle)});
	}
	return polygon(corners);
}

std::vector<Motion>
pack(const std::vector<Outline>& outlines, double side, double padding, ChartTurns turns)
{
	return packOutlines(outlines, std::vector<ChartTurns>(outlines.size(), turns), side, padding);
}

std::vector<Outline> moved(std::vector<Outline> outlines, const std::vector<Motion>& motions)
{
	EXPECT_EQ(outlines.size(), motions.size());
	for (std::size_t i = 0; i < motions.size(); ++i)
		for (auto& side : outlines[i])
			for (Point2& p : side)
				p = motions[i](p);
	return outlines;
}

void expectInSquare(const std::vector<Outline>& outlines, double side, double padding)
{
	for (const Outline& outline : outlines)
		for (const auto& ends : outline)
			for (double x : ends[0]) {
				EXPECT_GE(x, 0.5 * padding * (1 - 1e-9));
				EXPECT_LE(x, side - 0.5 * padding * (1 - 1e-9));
			}
	EXPECT_TRUE(keepApart(outlines, padding * (1 - 1e-9)));
}

TEST(PackOutlines, KeepsTheRoomAndTheShapes)
{
	Random random(380);
	for (int trial = 0; trial < 12; ++trial) {
		std::vector<Outline> outlines;
		for (int i = 0; i <= trial; ++i)
			outlines.push_back(star(random.real(0.1, 1.0), random));
		const double side = 1.2 * (2.0 + trial), padding = trial % 3 == 0 ? 0.0 : 0.03 * trial;
		for (ChartTurns turns : {ChartTurns::None, ChartTurns::Quarter, ChartTurns::Free}) {
			const std::vector<Motion> motions = pack(outlines, side, padding, turns);
			ASSERT_EQ(motions.size(), outlines.size());
			expectInSquare(moved(outlines, motions), side, padding);
			for (const Motion& motion : motions) {
				EXPECT_NEAR(std::abs(motion.turn), 1.0, 1e-15);
				if (turns == ChartTurns::None) {
					EXPECT_EQ(motion.turn, 1.0);
				}
				if (turns == ChartTurns::Quarter) {
					EXPECT_EQ(motion.turn.real() * motion.turn.imag(), 0.0);
				}
			}
		}
	}
}

TEST(PackOutlines, UsesHolesAndNotches)
{
	// A frame of side 3 with a hole of side 2, clockwise, and squares that fit in.
	Outline frame = rectangle(3.0, 3.0);
	const Outline hole = polygon({{0.5, 0.5}, {0.5, 2.5}, {2.5, 2.5}, {2.5, 0.5}});
	frame.insert(frame.end(), hole.begin(), hole.end());
	const std::vector<Outline> outlines{rectangle(0.9, 0.9), frame, rectangle(0.9, 0.9)};
	const double side = 3.05;
	const std::vector<Motion> motions = pack(outlines, side, 0.01, ChartTurns::Free);
	ASSERT_EQ(motions.size(), outlines.size());
	expectInSquare(moved(outlines, motions), side, 0.01);
	// Two L of three squares each fill a rectangle of two by three, with a turn by two right angles.
	const Outline corner = polygon({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
	for (ChartTurns turns : {ChartTurns::Quarter, ChartTurns::Free})
		EXPECT_EQ(pack({corner, corner}, 3.05, 0.0, turns).size(), 2u);
	EXPECT_TRUE(pack({corner, corner}, 2.9, 0.0, ChartTurns::Free).empty());
}

TEST(PackOutlines, TurnsWhatFitsInNoOtherWay)
{
	// A strip of 1 by 0.1 has a square of side 1.1 / sqrt(2) round it, turned by half a right angle.
	const std::vector<Outline> strips{rectangle(1.0, 0.1), rectangle(0.3, 0.3)};
	const double least = 1.1 * std::sqrt(0.5);
	EXPECT_TRUE(pack(strips, 0.99, 0.0, ChartTurns::Quarter).empty());
	EXPECT_TRUE(pack(strips, 0.99 * least, 0.0, ChartTurns::Free).empty());
	EXPECT_EQ(pack(strips, 1.03 * least, 0.0, ChartTurns::Free).size(), 2u);
}

TEST(PackOutlines, IsHeardWhileItRuns)
{
	Random random(381);
	std::vector<Outline> outlines;
	for (int i = 0; i < 30; ++i)
		outlines.push_back(star(0.3, random));
	Listener ticks;
	heard(ticks, [&] { return pack(outlines, 6.0, 0.0, ChartTurns::Free); });
	EXPECT_GT(ticks.calls(), 100);
}

} // namespace
} // namespace ricci::testing
