// SPDX-License-Identifier: GPL-3.0-or-later
// What the finish repairs.
#include "flat_maps.h"

#include <ricci/optimize/repair.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

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
	ASSERT_FALSE(badTriangles(flat, validity()).empty());
	const Repair result = mend(flat, validity());
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

/// Energy at a scale that does not change, and a twentieth of the length of the sides between triangles that are
/// counter-clockwise and those that are not, which are cut off.
double costWithCuts(const FlatMesh& flat)
{
	double energy = 0.0, cut = 0.0, area = 0.0;
	const FlatMesh surface = square();
	for (const int f : flat.points.indices()) {
		const auto side = [&](const FlatMesh& mesh, std::size_t k) {
			return asComplex(mesh.at(f)[k]) - asComplex(mesh.at(f)[0]);
		};
		// z -> alpha z + beta conj(z) has the singular values | |alpha| +- |beta| |.
		const std::complex<double> a = side(surface, 1), b = side(surface, 2);
		const std::complex<double> c = side(flat, 1), d = side(flat, 2);
		const std::complex<double> size = a * std::conj(b) - std::conj(a) * b;
		const double alpha = std::abs((c * std::conj(b) - d * std::conj(a)) / size);
		const double beta = std::abs((a * d - b * c) / size);
		const double sum = (alpha + beta) * (alpha + beta),
					 difference = (alpha - beta) * (alpha - beta);
		energy += 0.25 * std::abs(size) * (sum + difference + 1.0 / sum + 1.0 / difference);
		area += 0.25 * std::abs(size);
		for (const Corner own : cornersOf(f))
			if (const Corner other = flat.joined(own); other.isValid() &&
													   orientation(flat.at(f)) <= 0 &&
													   orientation(flat.at(other.face())) > 0)
				cut += flat.lengths[own];
	}
	return energy / area + 0.05 * cut / std::sqrt(area);
}

/// Where flipped triangles may be cut off, they are mended only if that costs less; else at any price.
TEST(FinishInPlane, RepairsWhatIsCheaperThanACut)
{
	Random random(7);
	int mended = 0, left = 0;
	for (int i = 0; i < 40; ++i) {
		const bool movesBorder = i % 2 > 0;
		const double cells = movesBorder ? 2.0 : 0.8;
		FlatMesh flat = square();
		for (const int v : flat.place.indices())
			if (movesBorder || isInside(v))
				flat.place[v] =
					flat.place[v] + Point2{random.real(-cells, cells), random.real(-cells, cells)};
		FlatMesh kept = flat;
		const double before = costWithCuts(flat);
		const int flipped = notCounterClockwise(flat);
		finishInPlane(flat, false, {}, Finish::Repair, true);
		mended += flipped - notCounterClockwise(flat);
		left += notCounterClockwise(flat);
		EXPECT_LE(costWithCuts(flat), before * (1.0 + 1e-9));
		finishInPlane(kept, false, {}, Finish::Repair, false);
		EXPECT_LE(notCounterClockwise(kept), movesBorder ? notCounterClockwise(flat) : 0);
	}
	EXPECT_GT(mended, 40);
	EXPECT_GT(left, 0);
}

} // namespace
} // namespace ricci::testing
