// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/math/points.h>
#include <ricci/overlay/chord_arrangement.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

using Chords = std::vector<ChordArrangement::Chord>;

bool cross(const ChordArrangement::Chord& a, const ChordArrangement::Chord& b)
{
	const auto within = [&](int x) {
		return x > std::min(a.from, a.to) && x < std::max(a.from, a.to);
	};
	const auto shared = [&](int x) { return x == a.from || x == a.to; };
	return !shared(b.from) && !shared(b.to) && within(b.from) != within(b.to);
}

/// Chords that do not cross and are no sides of the polygon, in random order and direction.
Chords randomChords(int places, int attempts, Random& random)
{
	Chords chords;
	for (int i = 0; i < attempts; ++i) {
		const ChordArrangement::Chord chord{random.index(places), random.index(places)};
		const int gap = std::abs(chord.from - chord.to);
		bool fits = gap > 1 && gap < places - 1;
		for (const auto& other : chords)
			fits = fits && !cross(other, chord) &&
				   std::minmax(other.from, other.to) != std::minmax(chord.from, chord.to);
		if (fits)
			chords.push_back(chord);
	}
	return chords;
}

/// Places at random on the unit circle, and crossings by intersecting straight lines.
struct Drawing
{
	std::vector<Point2> node;

	Drawing(const ChordArrangement& arrangement, int places, Random& random)
	{
		std::vector<double> angles;
		for (int k = 0; k < places; ++k)
			angles.push_back(2 * kPi * (k + random.real(0.1, 0.9)) / places);
		for (double a : angles)
			node.push_back({std::cos(a), std::sin(a)});
		for (const auto& x : arrangement.crossings()) {
			const auto &a = arrangement.line(x.first), &b = arrangement.line(x.second);
			const Point2 &p = node[at(a.from)], &q = node[at(a.to)];
			const Point2 &r = node[at(b.from)], &s = node[at(b.to)];
			const double d = (q[0] - p[0]) * (s[1] - r[1]) - (q[1] - p[1]) * (s[0] - r[0]);
			const double t = ((r[0] - p[0]) * (s[1] - r[1]) - (r[1] - p[1]) * (s[0] - r[0])) / d;
			node.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])});
		}
	}

	double twiceArea(int a, int b, int c) const
	{
		return doubledArea(node[at(a)], node[at(b)], node[at(c)]);
	}
};

/// Everything that makes it the arrangement of these chords.
void expectArrangement(int places, const Chords& first, const Chords& second, Random& random)
{
	ChordArrangement arrangement;
	arrangement.divide(places, first, second);

	// The pairs that cross, each once.
	std::set<std::pair<int, int>> wanted, found;
	for (std::size_t i = 0; i < first.size(); ++i)
		for (std::size_t j = 0; j < second.size(); ++j)
			if (cross(first[i], second[j]))
				wanted.insert({static_cast<int>(i), static_cast<int>(j)});
	for (const auto& x : arrangement.crossings())
		found.insert({arrangement.line(x.first).chord[0], arrangement.line(x.second).chord[1]});
	ASSERT_EQ(found, wanted);
	ASSERT_EQ(arrangement.crossings().size(), wanted.size());

	// Lines: chords of both families with the same ends are one.
	std::set<std::pair<int, int>> lines;
	for (const Chords* chords : {&first, &second})
		for (const auto& chord : *chords)
			lines.insert(std::minmax(chord.from, chord.to));
	// Every line, and every crossing, makes one more face.
	ASSERT_EQ(
		arrangement.faceCount(),
		1 + static_cast<int>(lines.size()) + static_cast<int>(wanted.size()));
	ASSERT_EQ(arrangement.segmentCount(), static_cast<int>(lines.size() + 2 * wanted.size()));

	// Faces are convex, run counter-clockwise along one line each side, and fill the polygon.
	const Drawing drawing(arrangement, places, random);
	double area = 0.0, whole = 0.0;
	for (int k = 1; k + 1 < places; ++k)
		whole += drawing.twiceArea(0, k, k + 1);
	std::map<int, std::set<bool>> uses; // by name
	for (int face = 0; face < arrangement.faceCount(); ++face) {
		const int begin = arrangement.firstSide(face), n = arrangement.firstSide(face + 1) - begin;
		ASSERT_GE(n, 3);
		const auto side = [&](int i) { return arrangement.side(begin + i % n); };
		for (int i = 0; i < n; ++i) {
			ASSERT_TRUE(uses[side(i).name].insert(side(i).forward).second);
			EXPECT_GT(drawing.twiceArea(side(i).node, side(i + 1).node, side(i + 2).node), -1e-12);
			if (side(i).line < 0) {
				EXPECT_EQ(side(i + 1).node, (side(i).node + 1) % places);
				EXPECT_EQ(arrangement.rank(side(i)), -1);
				continue;
			}
			const auto& line = arrangement.line(side(i).line);
			const int from = side(i).forward ? line.from : line.to;
			const int to = side(i).forward ? line.to : line.from;
			for (int node : {side(i).node, side(i + 1).node})
				EXPECT_NEAR(drawing.twiceArea(from, to, node), 0.0, 1e-12);
			if (side(i).node < places) {
				EXPECT_EQ(side(i).node, from);
				const auto here = arrangement.linesAt(from);
				EXPECT_EQ(here[arrangement.rank(side(i))], side(i).line);
			}
		}
		for (int i = 1; i + 1 < n; ++i)
			area += drawing.twiceArea(side(0).node, side(i).node, side(i + 1).node);
	}
	EXPECT_NEAR(area, whole, 1e-10);
	EXPECT_EQ(static_cast<int>(uses.size()), places + arrangement.segmentCount());
	for (const auto& [name, directions] : uses)
		EXPECT_EQ(directions.size(), name < places ? 1u : 2u);
}

TEST(ChordArrangement, WithoutChordsIsThePolygon)
{
	Random random(1);
	for (int places : {3, 4, 17})
		expectArrangement(places, {}, {}, random);
}

TEST(ChordArrangement, OneCrossing)
{
	Random random(2);
	expectArrangement(4, {{0, 2}}, {{1, 3}}, random);
	expectArrangement(4, {{2, 0}}, {{1, 3}}, random);
	expectArrangement(5, {{0, 2}}, {{3, 1}, {4, 1}}, random);
}

TEST(ChordArrangement, ChordsWithTheSameEndsAreOneLine)
{
	Random random(3);
	expectArrangement(6, {{0, 3}}, {{3, 0}, {0, 2}}, random);
	ChordArrangement arrangement;
	arrangement.divide(6, {{0, 3}, {0, 4}}, {{4, 0}, {0, 3}});
	EXPECT_EQ(arrangement.line(0).chord, (std::array<int, 2>{0, 1}));
	EXPECT_FALSE(arrangement.line(0).secondReversed);
	EXPECT_EQ(arrangement.line(1).chord, (std::array<int, 2>{1, 0}));
	EXPECT_TRUE(arrangement.line(1).secondReversed);
}

TEST(ChordArrangement, RandomChords)
{
	Random random(4);
	for (int i = 0; i < 2000; ++i) {
		const int places = 3 + random.index(i < 1000 ? 8 : 60);
		const Chords first = randomChords(places, random.index(3 * places), random);
		const Chords second = randomChords(places, random.index(3 * places), random);
		expectArrangement(places, first, second, random);
		if (HasFailure())
			return;
	}
}

/// As a fan of triangles makes them: bundles of parallel chords, and others that leave one corner.
TEST(ChordArrangement, BundlesRoundCorners)
{
	Random random(5);
	const int n = 40, places = 3 * (n + 1);
	const auto place = [&](int side, int k) { return (side * (n + 1) + k) % places; };
	Chords bundles[3], fan, both;
	for (int k = 1; k <= n / 2; ++k)
		for (int corner = 0; corner < 3; ++corner) {
			const ChordArrangement::Chord chord{
				place(corner, k), place((corner + 2) % 3, n + 1 - k)};
			bundles[corner].push_back(chord);
			both.push_back(chord);
		}
	for (int k = 1; k <= n; ++k)
		fan.push_back({place(0, 0), place(1, k)});
	for (const Chords& bundle : bundles) {
		expectArrangement(places, bundle, fan, random);
		expectArrangement(places, fan, bundle, random);
		for (const Chords& other : bundles)
			expectArrangement(places, bundle, other, random);
	}
	expectArrangement(places, both, fan, random);
	expectArrangement(places, both, both, random);
}

/// The arrays are kept, and nothing of one polygon reaches the next.
TEST(ChordArrangement, SecondUseIsAsTheFirst)
{
	Random random(6);
	ChordArrangement kept;
	for (int i = 0; i < 200; ++i) {
		const int places = 3 + random.index(30);
		const Chords first = randomChords(places, 40, random);
		const Chords second = randomChords(places, 40, random);
		ChordArrangement once;
		once.divide(places, first, second);
		kept.divide(places, first, second);
		ASSERT_EQ(kept.faceCount(), once.faceCount());
		for (int k = 0; k < once.firstSide(once.faceCount()); ++k) {
			ASSERT_EQ(kept.side(k).name, once.side(k).name);
			ASSERT_EQ(kept.side(k).node, once.side(k).node);
			ASSERT_EQ(kept.side(k).forward, once.side(k).forward);
		}
	}
}

} // namespace
} // namespace ricci::testing
