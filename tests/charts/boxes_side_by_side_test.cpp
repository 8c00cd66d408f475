// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/charts/pack_items.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <vector>

namespace ricci::testing {
namespace {

using Box = Box2;

/// Extents over \p orders powers of ten, at random places.
std::vector<Box> randomBoxes(int n, double orders, std::uint64_t seed)
{
	Random random(seed);
	std::vector<Box> boxes;
	for (int i = 0; i < n; ++i) {
		const double x = random.real(-9, 9), y = random.real(-9, 9);
		const Point2 corner{x, y};
		const double width = std::pow(10.0, random.real(-orders, 0));
		const double height = std::pow(10.0, random.real(-orders, 0));
		boxes.push_back({corner, {corner[0] + width, corner[1] + height}});
	}
	return boxes;
}

std::vector<Box> moved(std::vector<Box> boxes, double padding)
{
	const auto shifts = sideBySide(boxes, padding);
	EXPECT_EQ(shifts.size(), boxes.size());
	for (std::size_t i = 0; i < boxes.size(); ++i) {
		boxes[i].min = boxes[i].min + shifts[i];
		boxes[i].max = boxes[i].max + shifts[i];
	}
	return boxes;
}

/// Pairs nearer than \p padding in both directions.
int pairsTooNear(std::vector<Box> boxes, double padding)
{
	std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) {
		return std::make_tuple(a.min[0], a.min[1], a.max[0]) <
			   std::make_tuple(b.min[0], b.min[1], b.max[0]);
	});
	int pairs = 0;
	for (std::size_t i = 0; i < boxes.size(); ++i)
		for (std::size_t j = i + 1; j < boxes.size() && boxes[j].min[0] < boxes[i].max[0] + padding;
			 ++j)
			pairs += boxes[j].min[1] < boxes[i].max[1] + padding &&
					 boxes[i].min[1] < boxes[j].max[1] + padding;
	return pairs;
}

double squareOf(const std::vector<Box>& boxes)
{
	Box whole;
	for (const Box& box : boxes)
		whole.add(box);
	const double side = whole.extent();
	return side * side;
}

TEST(BoxesSideBySide, NoTwoOverlapAndTheRoomIsKept)
{
	const double rounding = 1e-9;
	for (int n : {2, 9, 200, 513, 10000})
		for (double orders : {0.0, 0.5, 3.0, 12.0})
			for (double padding : {0.0, 0.001, 0.3}) {
				const auto boxes = moved(randomBoxes(n, orders, 7), padding);
				EXPECT_EQ(pairsTooNear(boxes, std::max(0.0, padding - rounding)), 0)
					<< n << " boxes over " << orders << " orders, padding " << padding;
			}
}

TEST(BoxesSideBySide, FillTwoThirdsOfTheSquare)
{
	std::vector<std::vector<Box>> cases{randomBoxes(4000, 0.5, 9)};
	for (std::size_t n : {16u, 100u, 512u, 513u, 2500u, 10000u})
		cases.emplace_back(n, Box{{5, 5}, {6, 6}});
	for (const std::vector<Box>& boxes : cases) {
		double area = 0.0;
		for (const Box& box : boxes)
			area += box.width() * box.height();
		EXPECT_LT(squareOf(moved(boxes, 0.0)), 1.5 * area) << boxes.size();
	}
}

/// Also boxes that differ by rounding: the first one comes first.
TEST(BoxesSideBySide, EqualBoxesHaveTheOrderThatTheyAreGivenIn)
{
	for (const std::size_t n : {40u, 600u}) {
		std::vector<Box> equal(n, Box{{0, 0}, {0.1, 0.3}}), nearly = equal;
		for (std::size_t i = 0; i < n; ++i)
			nearly[i].max[1] += 1e-16 * static_cast<double>(i % 7);
		const auto a = sideBySide(equal, 0.01), b = sideBySide(nearly, 0.01);
		for (std::size_t i = 0; i < n; ++i)
			EXPECT_LT(distance(a[i], b[i]), 1e-12) << i;
	}
}

TEST(BoxesSideBySide, OneBoxStays)
{
	const auto boxes = randomBoxes(1, 0.0, 10);
	EXPECT_EQ(moved(boxes, 0.5).front().min, boxes.front().min);
	EXPECT_TRUE(sideBySide({}, 0.5).empty());
}

} // namespace
} // namespace ricci::testing
