// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include "support/listener.h"

#include <ricci/texture/nearest_fill.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace ricci::testing {
namespace {

TEST(NearestFill, IsTheNearestByTryingAll)
{
	Random random(731);
	for (int n : {0, 1, 2, 7, 40, 400}) {
		const int width = 37, height = 23;
		std::vector<unsigned short> rgba(static_cast<std::size_t>(4 * width * height), 0);
		std::vector<char> covered(static_cast<std::size_t>(width * height), 0);
		std::vector<int> places;
		for (int i = 0; i < n; ++i) {
			const int at = random.index(width * height);
			covered[static_cast<std::size_t>(at)] = 1;
			rgba[static_cast<std::size_t>(4 * at)] = static_cast<unsigned short>(at + 1);
			places.push_back(at);
		}
		const PictureView<unsigned short> view{width, height, rgba.data()};
		fillFromNearest(covered, view, 1);
		for (int at = 0; at < width * height; ++at) {
			const auto square = [&](int other) {
				const int dx = other % width - at % width, dy = other / width - at / width;
				return dx * dx + dy * dy;
			};
			int least = std::numeric_limits<int>::max();
			for (int other : places)
				least = std::min(least, square(other));
			const int taken = rgba[static_cast<std::size_t>(4 * at)] - 1;
			if (n == 0)
				EXPECT_EQ(taken, -1);
			else
				ASSERT_EQ(square(taken), least);
		}
	}
}

TEST(NearestFill, IsTheSameWithManyThreads)
{
	Random random(732);
	const int size = 700;
	std::vector<unsigned char> one(static_cast<std::size_t>(4 * size * size), 0);
	std::vector<char> covered(static_cast<std::size_t>(size * size), 0);
	for (int i = 0; i < 900; ++i) {
		const std::size_t at = static_cast<std::size_t>(random.index(size * size));
		covered[at] = 1;
		one[4 * at] = static_cast<unsigned char>(random.index(256));
	}
	std::vector<unsigned char> many = one;
	fillFromNearest(covered, PictureView<unsigned char>{size, size, one.data()}, 1);
	fillFromNearest(covered, PictureView<unsigned char>{size, size, many.data()}, 5);
	EXPECT_EQ(one, many);
}

TEST(NearestFill, CanBeCancelled)
{
	std::vector<unsigned char> rgba(4 * 64 * 64, 0);
	const std::vector<char> covered(64 * 64, 0);
	Listener impatient(1);
	const Task task(impatient);
	EXPECT_THROW(
		fillFromNearest(covered, PictureView<unsigned char>{64, 64, rgba.data()}, 2), Cancelled);
}

} // namespace
} // namespace ricci::testing
