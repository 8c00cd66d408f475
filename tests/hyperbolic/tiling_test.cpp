// SPDX-License-Identifier: GPL-3.0-or-later
// Copies of fundamental domains that can be counted, and the canonical polygon.
#include "support/complex.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/base/tolerances.h>
#include <ricci/hyperbolic/group_of_cut.h>
#include <ricci/layout/hyperbolic_layout.h>
#include <ricci/parametrize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

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
	EXPECT_TRUE(std::is_sorted(tiles.ring.begin(), tiles.ring.end()));
	std::vector<int> count(at(tiles.ring.back() + 1), 0);
	for (int ring : tiles.ring)
		++count[at(ring)];
	return count;
}

/// Of two tilings whose centres are at least \p apart.
void expectDifferent(const Tiling& tiles, double apart)
{
	for (std::size_t i = 0; i < tiles.deck.size(); ++i)
		for (std::size_t j = 0; j < i; ++j)
			EXPECT_GT(
				(tiles.deck[i].inverse() * tiles.deck[j]).distanceFromIdentity(),
				apart * (1.0 - 1e-8));
}

/// Two translations along perpendicular axes by lengths above 2 arsinh(1) play ping-pong: the group
/// is free, and ring n holds the 4 * 3^(n - 1) reduced words of n letters.
TEST(Tiling, OfAFreeGroupHasTheReducedWords)
{
	const auto sides = withInverses({along(0.0, 2.5), along(kPi / 2, 2.5)});
	const Tiling tiles = tiling(sides, 4, 1000);
	EXPECT_TRUE(tiles.complete);
	EXPECT_EQ(countByRing(tiles), (std::vector<int>{1, 4, 12, 36, 108}));
	expectDifferent(tiles, 0.1);
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

/// The Bolza surface, of the regular octagon with opposite sides glued. Every number is that of reduced words of a
/// length in the group with eight generators and one relation of eight letters: 8 * 7^(n - 1), until the tiles
/// opposite at a corner (4 letters) meet. Octagons do not overlap: their centres are two inradii apart.
TEST(Tiling, HasEveryCopyOfTheOctagonOnce)
{
	const double inradius = std::acosh(1.0 + std::sqrt(2.0));
	std::vector<DiskIsometry> sides;
	for (int side = 0; side < 4; ++side)
		for (const double turn : {0.0, kPi})
			sides.push_back(along(side * kPi / 4 + turn, 2 * inradius));
	const Tiling tiles = tiling(sides, 3, 100000);
	EXPECT_TRUE(tiles.complete);
	EXPECT_EQ(countByRing(tiles), (std::vector<int>{1, 8, 56, 392}));
	expectDifferent(tiles, std::sinh(inradius));
	const Tiling few = tiling(sides, 3, 20);
	EXPECT_FALSE(few.complete);
	EXPECT_EQ(few.deck.size(), 20u);
	EXPECT_FALSE(tiling(sides, 5, 1000).complete); // far rings are too small to be seen
	EXPECT_EQ(tiling(sides, 0, 1000).deck.size(), 1u);
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
	EXPECT_TRUE(tiling(sides, 0, 1000).complete);
	EXPECT_EQ(tiling({}, 5, 1000).deck.size(), 1u);
	// Images of 0 that no integer can number, and one that overflows.
	for (const double length : {100.0, 1000.0, 3000.0}) {
		const Tiling tiles =
			tiling(withInverses({along(0.0, 2.5), along(kPi / 2, length)}), 2, 1000);
		EXPECT_FALSE(tiles.complete);
		EXPECT_EQ(countByRing(tiles), (std::vector<int>{1, 2, 2})) << length;
	}
}

/// Sum of cosh d(p, g p) over the canonical generators.
double sumOfCosh(const FuchsianGroup& group, Complex p)
{
	const DiskIsometry toPoint = DiskIsometry::translationTo(p);
	double sum = 0.0;
	for (const DiskIsometry& g : group.handles)
		sum += std::cosh((toPoint.inverse() * g * toPoint).displacement());
	return sum;
}

/// Sum of the angles inside a polygon that runs counter-clockwise.
double sumOfAngles(const std::vector<Complex>& corners)
{
	double sum = 0.0;
	const std::size_t n = corners.size();
	for (std::size_t i = 0; i < n; ++i) {
		const DiskIsometry toCorner = DiskIsometry::translationTo(corners[i]).inverse();
		const double angle =
			std::arg(toCorner(corners[(i + n - 1) % n]) / toCorner(corners[(i + 1) % n]));
		sum += angle < 0.0 ? angle + 2.0 * kPi : angle;
	}
	return sum;
}

TEST(CanonicalPolygon, IsAFundamentalPolygonWithPairedSides)
{
	Random random(652);
	HyperbolicOptions options;
	options.canonicalGenerators = true;
	for (int genus : {2, 3})
		for (int trial = 0; trial < 3; ++trial) {
			SCOPED_TRACE(genus);
			const SurfaceMesh mesh =
				renumbered(shaken(perforatedSlab(genus, 2), 0.06, random), random).mesh;
			const FuchsianGroup group = parametrizeHyperbolic(mesh, {}, options).charts[0].group;
			const CanonicalPolygon polygon = canonicalPolygon(group);
			const auto& corners = polygon.corners;
			ASSERT_EQ(corners.size(), at(4 * genus));
			EXPECT_TRUE(polygon.isSimple);
			// The rounding of the generators, as it is seen from the base point, in products that
			// reach the corners.
			const Complex base = corners[corners.size() / 2];
			const DiskIsometry toBase = DiskIsometry::translationTo(base);
			double largest = 1.0, farthest = 1.0;
			for (const DiskIsometry& g : group.handles)
				largest = std::max(largest, std::abs(g.a));
			for (const Complex& z : corners)
				farthest = std::max(farthest, 0.5 * chordLength(base, z));
			const double tolerance = 16.0 * genus * std::numeric_limits<double>::epsilon() *
									 largest * std::norm(toBase.a) * farthest * farthest;
			EXPECT_LT(tolerance, 1e-3);
			EXPECT_LT(polygon.gap, tolerance);
			EXPECT_NEAR(sumOfAngles(corners), 2.0 * kPi, tolerance);
			const auto side = [&](std::size_t k) {
				return chordLength(corners[k], corners[(k + 1) % corners.size()]);
			};
			for (std::size_t k = 0; k < corners.size(); k += 4)
				for (std::size_t letter : {k, k + 1})
					EXPECT_NEAR(side(letter), side(letter + 2), tolerance * side(letter));
			for (int k = 0; k < 8; ++k) // the base point cannot be improved
				EXPECT_LT(
					sumOfCosh(group, base),
					sumOfCosh(group, toBase(std::polar(1e-3, 0.25 * kPi * k))));
		}
}

/// Two handles of a group whose relation does not hold, and far isometries, which no double can hold.
TEST(CanonicalPolygon, HasNoCornersWhereTheSidesDoNotCloseUp)
{
	EXPECT_TRUE(canonicalPolygon(FuchsianGroup()).corners.empty());
	for (double length : {0.5, 3.0, 40.0, 80.0, 700.0}) {
		SCOPED_TRACE(length);
		FuchsianGroup group;
		group.handles = {
			along(0.1, length), along(1.3, length), along(2.1, length), along(2.9, length)};
		for (std::size_t i = 0; i < 4; i += 2) {
			const DiskIsometry &a = group.handles[i], &b = group.handles[i + 1];
			for (const DiskIsometry& g : {a, b, a.inverse(), b.inverse()})
				group.relation.push_back({g.a, g.b});
		}
		const CanonicalPolygon polygon = canonicalPolygon(group);
		EXPECT_FALSE(polygon.gap <= kMaxPolygonGap);
		EXPECT_TRUE(polygon.corners.empty());
		EXPECT_FALSE(polygon.isSimple);
	}
}

/// Signed area of the geodesic triangle: with p at 0, tan(area / 2) = Im(conj(x) y) / (1 - Re(conj(x)
/// y)).
double signedArea(Complex p, Complex q, Complex r)
{
	const DiskIsometry toOrigin = DiskIsometry::translationTo(p).inverse();
	const Complex product = std::conj(toOrigin(q)) * toOrigin(r);
	return 2.0 * std::atan2(product.imag(), 1.0 - product.real());
}

/// Any isometries whose product is the identity spell a closed polygon. Its crossings are known from the
/// orientations of triangles of corners, its angles from its area.
TEST(CanonicalPolygon, CrossingsAndAnglesAreThoseOfAnyClosedPolygon)
{
	Random random(653);
	int simple = 0, clockwise = 0;
	for (int trial = 0; trial < 400; ++trial) {
		SCOPED_TRACE(trial);
		FuchsianGroup group;
		ExtendedIsometry product;
		const auto append = [&](const ExtendedIsometry& g) {
			group.relation.push_back(g);
			group.peripheral.push_back(rounded(g));
			product = product * g;
		};
		for (int i = 3 + random.index(4); i > 0; --i)
			append(
				ExtendedIsometry::rotation(random.real(-kPi, kPi)) *
				ExtendedIsometry::translation(random.real(0.2, 3.0)) *
				ExtendedIsometry::rotation(random.real(-kPi, kPi)));
		append(product.inverse());
		const CanonicalPolygon polygon = canonicalPolygon(group);
		const auto& z = polygon.corners;
		const std::size_t n = group.relation.size();
		ASSERT_EQ(z.size(), n);
		EXPECT_LT(polygon.gap, 1e-12);
		bool crosses = false;
		for (std::size_t i = 0; i < n; ++i)
			for (std::size_t j = i + 2; j < n; ++j) {
				const Complex a = z[i], b = z[i + 1], c = z[j], d = z[(j + 1) % n];
				if (j + 1 < n || i > 0)
					crosses |=
						hyperbolicOrientation(a, b, c) * hyperbolicOrientation(a, b, d) < 0 &&
						hyperbolicOrientation(c, d, a) * hyperbolicOrientation(c, d, b) < 0;
			}
		EXPECT_EQ(polygon.isSimple, !crosses);
		double area = 0.0;
		for (std::size_t k = 1; k + 1 < n; ++k)
			area += signedArea(z[0], z[k], z[k + 1]);
		if (crosses)
			continue;
		++simple;
		// Clockwise ones are seen from outside.
		const double sides = static_cast<double>(n) + (area > 0.0 ? -2.0 : 2.0);
		EXPECT_NEAR(sumOfAngles(z), sides * kPi - area, 1e-9);
		clockwise += area < 0.0;
	}
	EXPECT_GT(simple, 50);
	EXPECT_LT(simple, 350);
	EXPECT_GT(clockwise, 10);
}

} // namespace
} // namespace ricci::testing
