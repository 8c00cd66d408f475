// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat_maps.h"

#include <ricci/finish/finish.h>
#include <ricci/measure/distortion.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace ricci::testing {
namespace {

constexpr int kMiddle = (kSide / 2) * (kSide + 1) + kSide / 2;

/// The square with its middle moved \p by cells to the right.
FlatMesh folded(double by)
{
	FlatMesh flat = square();
	flat.place[kMiddle][0] += by;
	return flat;
}

FinishCounts finishSquare(FlatMesh& flat, bool freeBoundary, Finish finish)
{
	const VertexArray<char> none(flat.vertexCount(), 0);
	return finishInPlane(flat, none, freeBoundary, {}, finish, true);
}

void expectBorderOf(const FlatMesh& wanted, const FlatMesh& flat)
{
	for (const int v : flat.place.indices())
		if (!isInside(v)) {
			EXPECT_EQ(flat.place[v], wanted.place[v]);
		}
}

TEST(FinishInPlane, LeavesAValidMapAsItIs)
{
	FlatMesh flat = square();
	const FinishCounts counts = finishSquare(flat, true, Finish::Repair);
	EXPECT_EQ(counts.moved, 0);
	EXPECT_EQ(flat.place, square().place);
}

TEST(FinishInPlane, RepairsAFlippedTriangleAndCountsWhatItMoved)
{
	FlatMesh flat = folded(1.6);
	ASSERT_GT(notCounterClockwise(flat), 0);
	const Array<Point2> before = flat.place;
	const FinishCounts counts = finishSquare(flat, false, Finish::Repair);
	EXPECT_EQ(notCounterClockwise(flat), 0);
	int moved = 0;
	for (const int p : before.indices())
		moved += flat.place[p] != before[p];
	EXPECT_EQ(counts.moved, moved);
	EXPECT_GT(moved, 0);
	expectBorderOf(square(), flat);
}

/// A sheared square has an isometric map of all its faces, which is that of no distortion: it is found
/// where the boundary moves. Where it is kept, distortion stays.
TEST(FinishInPlane, OfLeastDistortionIsConformalWhereTheSurfaceIsFlat)
{
	FlatMesh sheared = square();
	for (Point2& p : sheared.place)
		p[0] += 0.7 * p[1];
	const auto meanOf = [](const FlatMesh& flat) {
		const FlatMesh surface = square();
		double mean = 0.0;
		for (const int f : flat.points.indices()) {
			std::array<Point3, 3> corners;
			for (std::size_t k = 0; k < 3; ++k)
				corners[k] = {surface.at(f)[k][0], surface.at(f)[k][1], 0.0};
			mean += quasiConformalDistortion(corners, flat.at(f)) / flat.points.size();
		}
		return mean;
	};
	const double before = meanOf(sheared);
	for (const bool freeBoundary : {true, false}) {
		FlatMesh flat = sheared;
		finishSquare(flat, freeBoundary, Finish::LeastDistortion);
		if (freeBoundary) {
			EXPECT_LT(meanOf(flat) - 1.0, 0.01 * (before - 1.0));
		}
		else {
			EXPECT_GT(meanOf(flat) - 1.0, 0.1 * (before - 1.0));
			EXPECT_EQ(notCounterClockwise(flat), 0);
			expectBorderOf(sheared, flat);
		}
	}
}

} // namespace
} // namespace ricci::testing
