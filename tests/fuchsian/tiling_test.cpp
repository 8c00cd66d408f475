// SPDX-License-Identifier: GPL-3.0-or-later
// Groups whose copies can be counted. A surface's group: bolza_surface_test.cpp.
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/base/tolerances.h>
#include <ricci/fuchsian/tiling.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace ricci::testing {
namespace {

/// Translation along the straight line through 0 of this direction.
DiskIsometry along(double direction, double length)
{
	return DiskIsometry::rotation(direction) * DiskIsometry::translation(length) *
		   DiskIsometry::rotation(-direction);
}

std::vector<DiskIsometry> withInverses(const std::vector<DiskIsometry>& generators)
{
	std::vector<DiskIsometry> sides;
	for (const DiskIsometry& g : generators) {
		sides.push_back(g);
		sides.push_back(g.inverse());
	}
	return sides;
}

std::vector<int> countByRing(const Tiling& tiles)
{
	std::vector<int> count;
	for (int ring : tiles.ring) {
		EXPECT_GE(ring + 1, static_cast<int>(count.size())); // ring by ring
		count.resize(at(ring + 1), 0);
		++count.back();
	}
	return count;
}

void expectDifferent(const Tiling& tiles)
{
	for (std::size_t i = 0; i < tiles.deck.size(); ++i)
		for (std::size_t j = 0; j < i; ++j)
			EXPECT_GT((tiles.deck[i].inverse() * tiles.deck[j]).distanceFromIdentity(), 0.1);
}

/// Images of 0 that no integer can number, and one that overflows.
TEST(Tiling, LeavesOutWhatIsBeyondAllNumbers)
{
	for (const double length : {100.0, 1000.0, 3000.0}) {
		const auto sides = withInverses({along(0.0, 2.5), along(kPi / 2, length)});
		const Tiling tiles = tiling(sides, 2, 1000);
		EXPECT_FALSE(tiles.complete);
		EXPECT_EQ(countByRing(tiles), (std::vector<int>{1, 2, 2})) << length;
	}
}

/// Two translations along perpendicular axes by lengths above 2 arsinh(1) play ping-pong: the group
/// is free, and ring n holds the 4 * 3^(n - 1) reduced words of n letters.
TEST(Tiling, OfAFreeGroupHasTheReducedWords)
{
	const auto sides = withInverses({along(0.0, 2.5), along(kPi / 2, 2.5)});
	const Tiling tiles = tiling(sides, 4, 1000);
	EXPECT_TRUE(tiles.complete);
	EXPECT_EQ(countByRing(tiles), (std::vector<int>{1, 4, 12, 36, 108}));
	expectDifferent(tiles);
	EXPECT_EQ(tiles.deck.front().distanceFromIdentity(), 0.0);
	// Every copy shares a side with one of the ring before.
	for (std::size_t i = 1; i < tiles.deck.size(); ++i) {
		bool found = false;
		for (std::size_t j = 0; j < i && !found; ++j)
			for (const DiskIsometry& side : sides)
				found |=
					tiles.ring[j] + 1 == tiles.ring[i] &&
					(tiles.deck[i].inverse() * tiles.deck[j] * side).distanceFromIdentity() < 1e-9;
		EXPECT_TRUE(found);
	}
}

/// A rotation of order n about a point: the ways round it both ways meet on the other side.
TEST(Tiling, RoundAConeClosesUp)
{
	const DiskIsometry toCone = DiskIsometry::translationTo({0.4, 0.2});
	for (int n : {3, 4, 5, 8}) {
		const DiskIsometry turn = toCone * DiskIsometry::rotation(2 * kPi / n) * toCone.inverse();
		const Tiling tiles = tiling(withInverses({turn}), 10, 1000);
		EXPECT_TRUE(tiles.complete);
		ASSERT_EQ(static_cast<int>(tiles.deck.size()), n);
		expectDifferent(tiles);
		for (std::size_t i = 0; i < tiles.ring.size(); ++i)
			EXPECT_EQ(tiles.ring[i], static_cast<int>(i + 1) / 2);
	}
}

TEST(Tiling, EndsWhereTheDiskOrTheCountDoes)
{
	const auto sides = withInverses({along(0.7, 1.25)});
	const int inReach = static_cast<int>(std::floor(kMaxTileDistance / 1.25)); // to either side
	const Tiling far = tiling(sides, 100, 1000);
	EXPECT_FALSE(far.complete);
	EXPECT_EQ(static_cast<int>(far.deck.size()), 1 + 2 * inReach);
	const Tiling near = tiling(sides, inReach, 1000);
	EXPECT_TRUE(near.complete);
	EXPECT_EQ(near.deck.size(), far.deck.size());
	const Tiling few = tiling(sides, inReach, 4);
	EXPECT_FALSE(few.complete);
	EXPECT_EQ(few.deck.size(), 4u);
	EXPECT_EQ(tiling(sides, 0, 1000).deck.size(), 1u);
	EXPECT_TRUE(tiling(sides, 0, 1000).complete);
	EXPECT_EQ(tiling({}, 5, 1000).deck.size(), 1u);
}

} // namespace
} // namespace ricci::testing
