// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flat_meshes.h"
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/charts/movable_parts.h>
#include <ricci/math/orientation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <set>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

FlatMesh square(int size)
{
	return flatMesh(rectangle(size, size, 1.0, 1.0));
}

Array<Triangle2> placesOf(const MovableParts& parts, int triangleCount)
{
	Array<Triangle2> places;
	for (int f = 0; f < triangleCount; ++f)
		places.push_back(parts.at(f));
	return places;
}

/// Parts of consecutive triangles.
std::vector<std::vector<int>> stripes(int triangleCount, int count)
{
	std::vector<std::vector<int>> parts(at(count));
	for (int i = 0; i < triangleCount; ++i)
		parts[at(i * count / triangleCount)].push_back(i);
	return parts;
}

Motion randomMotion(Random& random)
{
	return {
		std::polar(1.0, random.real(0, 2 * kPi)), {random.real(-0.5, 0.5), random.real(-0.5, 0.5)}};
}

/// A part at random, and some of its triangles for another one.
void moveSome(MovableParts& parts, Random& random)
{
	const int from = random.index(parts.count()), to = random.index(parts.count());
	std::vector<int> some;
	for (const int f : parts.trianglesOf(from))
		if (random.coin())
			some.push_back(f);
	if (from != to && !some.empty())
		parts.move(some, {to, randomMotion(random), 0.0});
}

TEST(MovableParts, UndoRestoresAll)
{
	Random random(1230);
	for (int trial = 0; trial < 30; ++trial) {
		const FlatMesh chart = square(6);
		const int n = chart.size();
		MovableParts parts(chart, stripes(n, 4));
		for (int i = 0; i < 5; ++i)
			moveSome(parts, random);
		parts.commit();
		const Array<Triangle2> before = placesOf(parts, n);
		std::vector<std::vector<int>> lists;
		std::vector<double> areas;
		for (int part = 0; part < 4; ++part) {
			lists.push_back(parts.trianglesOf(part));
			areas.push_back(parts.area(part));
		}

		parts.addPart();
		for (int i = random.index(8); i > 0; --i)
			moveSome(parts, random);
		parts.undo();
		EXPECT_EQ(parts.count(), 4);
		EXPECT_EQ(placesOf(parts, n), before);
		for (int part = 0; part < 4; ++part) {
			EXPECT_EQ(parts.trianglesOf(part), lists[at(part)]);
			EXPECT_EQ(parts.area(part), areas[at(part)]);
			for (const int f : lists[at(part)])
				EXPECT_EQ(parts.partOf(f), part);
		}
	}
}

/// All pairs of triangles are compared, after some moves; with a tree of all triangles, or one for each part.
TEST(MovableParts, FindsWhatCoversAPart)
{
	Random random(1231);
	const FlatMesh chart = square(5);
	const BoxTree all = boxTreeOf(chart.corners());
	int found = 0;
	for (int trial = 0; trial < 200; ++trial) {
		MovableParts parts(chart, stripes(chart.size(), 3), trial % 2 == 0 ? &all : nullptr);
		for (int i = random.index(4); i > 0; --i)
			moveSome(parts, random);
		const Place place{1, randomMotion(random), 0.0};
		const MovableParts::Groups near = parts.groupsNear(0, place);
		std::multiset<int> wanted, covered;
		for (const int f : parts.trianglesOf(0)) {
			const std::size_t before = wanted.size();
			for (const int g : parts.trianglesOf(1))
				if (overlap(place.motion(parts.at(f)), parts.at(g), 1e-9))
					wanted.insert(g);
			EXPECT_EQ(parts.covers(f, place.motion, near), wanted.size() > before);
		}
		EXPECT_FALSE(parts.covering(0, place, [&](int g) {
			covered.insert(g);
			return false;
		}));
		EXPECT_EQ(covered, wanted);
		EXPECT_EQ(parts.covering(0, place, [](int) { return true; }), !wanted.empty());
		found += !wanted.empty();
	}
	EXPECT_GT(found, 20);
}

} // namespace
} // namespace ricci::testing
