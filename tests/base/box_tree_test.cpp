// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/base/box_tree.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace ricci::testing {
namespace {

/// Boxes on a lattice, so that many of them touch, coincide, or have no width or height.
std::vector<Box2> randomBoxes(int n, Random& random)
{
	std::vector<Box2> boxes;
	for (int i = 0; i < n; ++i) {
		Box2 box;
		const int x = random.index(20), y = random.index(20);
		box.add(Point2{x * 0.5, y * 0.5});
		box.add(Point2{(x + random.index(4)) * 0.5, (y + random.index(4)) * 0.5});
		boxes.push_back(box);
	}
	return boxes;
}

/// No node is left out.
constexpr auto kEverywhere = [](int) { return false; };
constexpr auto kNoneApart = [](int, int) { return false; };

TEST(BoxTree, FindsEachPairOfBoxesThatMeetOnce)
{
	Random random(350);
	for (int n : {0, 1, 2, 4, 5, 9, 40, 150, 400}) {
		const std::vector<Box2> boxes = randomBoxes(n, random);
		std::vector<std::array<int, 2>> expected, found;
		for (int i = 0; i < n; ++i)
			for (int j = i + 1; j < n; ++j) {
				const Box2 &a = boxes[positionOf(i)], &b = boxes[positionOf(j)];
				if (a.min[0] < b.max[0] && b.min[0] < a.max[0] && a.min[1] < b.max[1] &&
					b.min[1] < a.max[1])
					expected.push_back({i, j});
			}
		BoxTree(boxes).meetingPairs(
			[&](int i, int j) {
				found.push_back({std::min(i, j), std::max(i, j)});
			},
			kNoneApart);
		std::sort(found.begin(), found.end());
		EXPECT_EQ(found, expected);
		EXPECT_EQ(expected.empty(), n < 40) << n;
	}
}

TEST(BoxTree, FindsTheBoxesRoundAPoint)
{
	Random random(351);
	for (int n : {0, 1, 5, 60, 300}) {
		const std::vector<Box2> boxes = randomBoxes(n, random);
		const BoxTree tree(boxes);
		int count = 0;
		for (int trial = 0; trial < 300; ++trial) {
			const Point2 p = trial % 2 == 0 ? Point2{random.index(24) * 0.5, random.index(24) * 0.5}
											: Point2{random.real(-1, 12), random.real(-1, 12)};
			std::vector<int> expected, found;
			for (int i = 0; i < n; ++i)
				if (boxes[positionOf(i)].contains(p))
					expected.push_back(i);
			tree.boxesAround(
				p, [&](int i) { found.push_back(i); }, kEverywhere);
			std::sort(found.begin(), found.end());
			EXPECT_EQ(found, expected);
			count += static_cast<int>(expected.size());
		}
		EXPECT_GE(count, n > 5 ? n : 0);
	}
}

TEST(BoxTree, OfManyEqualBoxes)
{
	// No direction divides them: the tree must do with their numbers.
	Box2 box;
	box.add(Point2{1.0, 2.0});
	box.add(Point2{4.0, 3.0});
	const BoxTree tree(std::vector<Box2>(100, box));
	int pairs = 0;
	tree.meetingPairs([&](int, int) { ++pairs; }, kNoneApart);
	EXPECT_EQ(pairs, 100 * 99 / 2);
	EXPECT_EQ(tree.extent(), 3.0);
	EXPECT_EQ(BoxTree({}).extent(), 0.0);
}

} // namespace
} // namespace ricci::testing
