// SPDX-License-Identifier: GPL-3.0-or-later
// How triangles are divided by chords, and the pieces into triangles.
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/refinement/chord_arrangement.h>
#include <ricci/refinement/overlay_pieces.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

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
		for (int k = 0; k < places; ++k) {
			const double angle = 2 * kPi * (k + random.real(0.1, 0.9)) / places;
			node.push_back({std::cos(angle), std::sin(angle)});
		}
		for (const auto& x : arrangement.crossings()) {
			const auto &a = arrangement.line(x.first), &b = arrangement.line(x.second);
			const double before = twiceArea(b.from, b.to, a.from),
						 behind = twiceArea(b.from, b.to, a.to);
			node.push_back(between(node[at(a.from)], node[at(a.to)], before / (before - behind)));
		}
	}

	double twiceArea(int a, int b, int c) const
	{
		return doubledArea(node[at(a)], node[at(b)], node[at(c)]);
	}
};

/// Everything that makes it the arrangement of these chords.
/// \param arrangement has been used before: nothing of one polygon reaches the next
void expectArrangement(
	int places,
	const Chords& first,
	const Chords& second,
	ChordArrangement& arrangement,
	Random& random)
{
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

	// Lines: chords of both families with the same ends are one. Every line, and every crossing, makes one more
	// face.
	std::set<std::pair<int, int>> lines;
	for (const Chords* chords : {&first, &second})
		for (const auto& chord : *chords)
			lines.insert(std::minmax(chord.from, chord.to));
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

TEST(ChordArrangement, OfFewAndOfRandomChords)
{
	Random random(4);
	ChordArrangement kept;
	const struct
	{
		int places;
		Chords first, second;
	} cases[] = {
		{3, {}, {}},
		{17, {}, {}},
		{4, {{0, 2}}, {{1, 3}}},
		{4, {{2, 0}}, {{1, 3}}},
		{5, {{0, 2}}, {{3, 1}, {4, 1}}},
		{6, {{0, 3}}, {{3, 0}, {0, 2}}}};
	for (const auto& c : cases)
		expectArrangement(c.places, c.first, c.second, kept, random);
	for (int i = 0; i < 2000 && !HasFailure(); ++i) {
		const int places = 3 + random.index(i < 1000 ? 8 : 60);
		const Chords first = randomChords(places, random.index(3 * places), random);
		const Chords second = randomChords(places, random.index(3 * places), random);
		expectArrangement(places, first, second, kept, random);
	}
}

TEST(ChordArrangement, ChordsWithTheSameEndsAreOneLine)
{
	ChordArrangement arrangement;
	arrangement.divide(6, {{0, 3}, {0, 4}}, {{4, 0}, {0, 3}});
	EXPECT_EQ(arrangement.line(0).chord, (std::array<int, 2>{0, 1}));
	EXPECT_FALSE(arrangement.line(0).secondReversed);
	EXPECT_EQ(arrangement.line(1).chord, (std::array<int, 2>{1, 0}));
	EXPECT_TRUE(arrangement.line(1).secondReversed);
}

using Corners = std::array<std::size_t, 3>;

/// A convex polygon in the plane and in space.
struct Polygon
{
	std::vector<Point2> plane;
	std::vector<Point3> space;

	/// Corners on an ellipse, some of the sides divided, and their image by a projective map.
	Polygon(int corners, int onSides, Random& random)
	{
		const double stretch = random.real(0.05, 1.0);
		for (int k = 0; k < corners; ++k) {
			const double angle = 2 * kPi * (k + random.real(0.0, 0.9)) / corners;
			plane.push_back({std::cos(angle), stretch * std::sin(angle)});
		}
		for (int i = 0; i < onSides; ++i) {
			const int k = random.index(static_cast<int>(plane.size()));
			const Point2 next = plane[(at(k) + 1) % plane.size()];
			plane.insert(plane.begin() + k + 1, between(plane[at(k)], next, random.real(0.1, 0.9)));
		}
		std::array<double, 9> m;
		for (double& x : m)
			x = random.real(-1.0, 1.0);
		const double bend = random.real(-0.4, 0.4), tilt = random.real(-0.4, 0.4);
		for (const Point2& p : plane) {
			const double w = 1.0 + bend * p[0] + tilt * p[1];
			Point3 q;
			for (std::size_t k = 0; k < 3; ++k)
				q[k] = (m[3 * k] * p[0] + m[3 * k + 1] * p[1] + m[3 * k + 2]) / w;
			space.push_back(q);
		}
	}

	/// Twice the area over the square of the longest side, in the plane or in space, by Heron's formula.
	double quality(const Corners& t) const { return std::min(shape(plane, t), shape(space, t)); }

private:
	template<class Point>
	static double shape(const std::vector<Point>& points, const Corners& t)
	{
		const double a = distance(points[t[0]], points[t[1]]),
					 b = distance(points[t[1]], points[t[2]]),
					 c = distance(points[t[2]], points[t[0]]), longest = std::max({a, b, c});
		const double product = (a + b + c) * (a + b - c) * (a - b + c) * (-a + b + c);
		return std::sqrt(std::max(0.0, product)) / (2 * longest * longest);
	}
};

/// All ways to divide corners i .. j into triangles: each has one triangle at the side from i to j.
std::vector<std::vector<Corners>> allTriangulations(std::size_t i, std::size_t j)
{
	if (j - i < 2)
		return {{}};
	std::vector<std::vector<Corners>> all;
	for (std::size_t k = i + 1; k < j; ++k)
		for (const auto& left : allTriangulations(i, k))
			for (const auto& right : allTriangulations(k, j)) {
				std::vector<Corners> triangles{{i, k, j}};
				triangles.insert(triangles.end(), left.begin(), left.end());
				triangles.insert(triangles.end(), right.begin(), right.end());
				all.push_back(triangles);
			}
	return all;
}

double worst(const Polygon& polygon, const std::vector<Corners>& triangles)
{
	double quality = 1.0;
	for (const Corners& t : triangles)
		quality = std::min(quality, polygon.quality(t));
	return quality;
}

TEST(PieceTriangulation, IsTheBestOfAll)
{
	EXPECT_EQ(allTriangulations(0, 7).size(), 132u); // Catalan's number for 8 corners
	Random random(830);
	for (int trial = 0; trial < 300; ++trial) {
		const Polygon polygon(3 + random.index(4), random.index(3), random);
		double best = 0.0;
		for (const auto& triangles : allTriangulations(0, polygon.plane.size() - 1))
			best = std::max(best, worst(polygon, triangles));
		const auto triangles = triangulatePiece(polygon.plane, polygon.space);
		// Heron's formula knows the square of the area to rounding of the longest side's fourth power.
		EXPECT_NEAR(std::pow(worst(polygon, triangles), 2), best * best, 1e-13);
	}
	EXPECT_EQ(
		triangulatePiece(
			{{0, 0}, {1, 0}, {0, 1}}, {Point3{0, 0, 0}, Point3{1, 0, 0}, Point3{2, 0, 0}}),
		(std::vector<Corners>{{0, 1, 2}}));
}

} // namespace
} // namespace ricci::testing
