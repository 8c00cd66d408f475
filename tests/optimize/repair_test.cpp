// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat_maps.h"
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/base/orientation.h>
#include <ricci/optimize/repair.h>

#include <gtest/gtest.h>

#include <cstdint>

namespace ricci::testing {
namespace {

Validity validity()
{
	return {1e-4, 1e-2, false};
}

Repair mend(FlatMesh& flat, const Validity& wanted)
{
	WorkLimit limit(flat.points.size());
	return repairInStages(
		flat, [](int) { return false; }, {RestShapes::OfSurface, wanted}, limit);
}

TEST(Repair, MendsEveryTriangleAndMovesNoBoundaryWithoutNeed)
{
	for (std::uint64_t seed = 1; seed <= 20; ++seed) {
		SCOPED_TRACE(seed);
		FlatMesh flat = tangled(6, seed);
		const FlatMesh before = flat;
		ASSERT_FALSE(badTriangles(flat, validity()).empty());
		const Repair result = mend(flat, validity());
		EXPECT_EQ(result.left, 0);
		for (const int f : flat.points.indices()) {
			const Triangle2 p = flat.at(f);
			EXPECT_EQ(orientation(p[0], p[1], p[2]), 1) << f;
		}
		EXPECT_TRUE(badTriangles(flat, validity()).empty());
		for (const int p : flat.place.indices()) {
			const bool isSame = flat.place[p] == before.place[p];
			EXPECT_TRUE(isSame || isInside(p)) << p;
			EXPECT_EQ(isSame, result.moved[p] == 0) << p;
		}
	}
}

/// Decimal fractions on one line, which as doubles mostly are on none, and next to it.
TEST(Repair, SixDecimalsAreJudgedExactly)
{
	constexpr double kStep = 1e-6;
	const Validity text{1e-12, 1e-6, true, kStep};
	Random random(17);
	int bent = 0;
	for (int trial = 0; trial < 1000; ++trial) {
		const int x = random.index(500000), y = random.index(500000);
		const int dx = 1 + random.index(2000), dy = 1 + random.index(2000);
		const auto place = [&](int i, int off) {
			return Point2{(x + i * dx) * kStep, (y + i * dy + off) * kStep};
		};
		const Triangle2 flat{place(0, 0), place(1, 0), place(2, 0)};
		bent += orientation(flat[0], flat[1], flat[2]) != 0;
		EXPECT_FALSE(text.isUpright(flat));
		EXPECT_FALSE(text.isUpright({flat[0], flat[2], flat[1]}));
		EXPECT_TRUE(text.isUpright({place(0, 0), place(2, 0), place(1, 1)}));
		EXPECT_FALSE(text.isUpright({place(0, 0), place(2, 0), place(1, -1)}));
	}
	EXPECT_GT(bent, 0);
}

TEST(Repair, TheBoundaryMovesWhereNothingElseMends)
{
	FlatMesh flat = square();
	// A corner triangle whose three points are on the boundary, flipped.
	const int corner = vertexAt(kSide, 0);
	flat.place[corner] = {kSide - 2.0, 2.0};
	const Repair result = mend(flat, validity());
	EXPECT_GT(result.bad, 0);
	EXPECT_EQ(result.left, 0);
	EXPECT_TRUE(badTriangles(flat, validity()).empty());
	EXPECT_EQ(result.moved[corner], 1);
}

/// A corner that stays cannot be mended, however much is spent on it.
TEST(Repair, EndsWhenItsLimitIsSpent)
{
	struct Spent
	{
		std::int64_t work;
		int left;
	};
	const auto repairWith = [](std::int64_t allowed) {
		FlatMesh flat = tangled(20, 3);
		flat.place[vertexAt(kSide, 0)] = {kSide - 2.0, 2.0};
		WorkLimit limit(flat.points.size());
		if (allowed >= 0)
			limit.spend(limit.left() - allowed);
		const std::int64_t before = limit.left();
		const Repair result =
			repair(flat, insidePoints(flat), {RestShapes::OfSurface, validity()}, limit);
		EXPECT_EQ(result.left, static_cast<int>(badTriangles(flat, validity()).size()));
		return Spent{before - limit.left(), result.left};
	};
	const Spent all = repairWith(-1), half = repairWith(all.work / 2), none = repairWith(0);
	EXPECT_GT(all.left, 0);
	EXPECT_LE(half.work, all.work / 2);
	EXPECT_GT(half.work, 0);
	EXPECT_GE(half.left, all.left);
	EXPECT_EQ(none.work, 0);
	EXPECT_GT(none.left, all.left);
}

} // namespace
} // namespace ricci::testing
