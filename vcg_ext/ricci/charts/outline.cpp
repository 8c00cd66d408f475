// SPDX-License-Identifier: GPL-3.0-or-later
#include "outline.h"

#include "../base/task.h"
#include "../math/box_tree.h"
#include "../math/bucket_sort.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

namespace ricci {

namespace {

using Segment = std::array<Point2, 2>;

double distanceFrom(const Segment& s, const Point2& p)
{
	return distance(p, between(s[0], s[1], nearestOnSegment(s[0], s[1], p)));
}

bool cross(const Segment& s, const Segment& t)
{
	const auto isBetween = [](const Segment& line, const Segment& ends) {
		return (doubledArea(line[0], line[1], ends[0]) > 0.0) !=
			   (doubledArea(line[0], line[1], ends[1]) > 0.0);
	};
	return isBetween(s, t) && isBetween(t, s);
}

double distance(const Segment& s, const Segment& t)
{
	if (cross(s, t))
		return 0.0;
	return std::min(
		{distanceFrom(s, t[0]),
		 distanceFrom(s, t[1]),
		 distanceFrom(t, s[0]),
		 distanceFrom(t, s[1])});
}

/// Whether an outline goes round a point.
bool contains(const Outline& outline, const Point2& p)
{
	int turns = 0;
	for (const Segment& s : outline)
		if ((s[0][1] <= p[1]) != (s[1][1] <= p[1])) {
			const bool up = s[0][1] <= p[1];
			if ((doubledArea(s[0], s[1], p) > 0.0) == up)
				turns += up ? 1 : -1;
		}
	return turns != 0;
}

/// Different for nearly all points.
std::uint64_t pointKey(const Point2& p)
{
	std::uint64_t key = 0;
	for (const double x : p) {
		const double unsignedZero = x + 0.0;
		std::uint64_t bits = 0;
		std::memcpy(&bits, &unsignedZero, sizeof bits);
		key = (key ^ bits) * 0x9e3779b97f4a7c15U; // 2^64 over the golden ratio
		key ^= key >> 29;
	}
	return key;
}

Box2 boxOf(const Segment& s, double room)
{
	Box2 box;
	for (const Point2& p : s) {
		box.add(Point2{p[0] - room, p[1] - room});
		box.add(Point2{p[0] + room, p[1] + room});
	}
	return box;
}

} // namespace

Outline outlineOf(const std::vector<Triangle2>& triangles)
{
	struct Side
	{
		std::uint64_t key; // of both ends, in any order
		std::size_t number;
	};
	// From the lower end.
	const auto endsOf = [&](const Side& side) {
		const Triangle2& t = triangles[side.number / 3];
		const Point2 &a = t[side.number % 3], &b = t[(side.number + 1) % 3];
		return a < b ? Segment{a, b} : Segment{b, a};
	};
	std::vector<Side> sides;
	sides.reserve(3 * triangles.size());
	for (std::size_t i = 0; i < triangles.size(); ++i)
		for (std::size_t k = 0; k < 3; ++k) {
			const Point2 &a = triangles[i][k], &b = triangles[i][(k + 1) % 3];
			if (a != b)
				sides.push_back({pointKey(a) + pointKey(b), 3 * i + k});
		}
	const std::uint64_t buckets = std::max<std::size_t>(sides.size(), 1);
	bucketSort(
		sides,
		[&](const Side& s) { return static_cast<int>(s.key % buckets); },
		[&](const Side& s, const Side& t) {
			return s.key != t.key ? s.key < t.key : endsOf(s) < endsOf(t);
		});
	Outline outline;
	for (auto first = sides.begin(), last = first; first != sides.end(); first = last) {
		const Segment ends = endsOf(*first);
		int count = 0; // upwards, less those downwards
		for (; last != sides.end() && last->key == first->key && endsOf(*last) == ends; ++last) {
			const Triangle2& t = triangles[last->number / 3];
			const bool isUpwards = t[last->number % 3] == ends[0];
			count += isUpwards == !(doubledArea(t[0], t[1], t[2]) < 0.0) ? 1 : -1;
		}
		for (; count > 0; --count)
			outline.push_back(ends);
		for (; count < 0; ++count)
			outline.push_back({ends[1], ends[0]});
	}
	std::sort(outline.begin(), outline.end());
	return outline;
}

bool keepApart(const std::vector<Outline>& outlines, double room)
{
	std::vector<BoxTree> sides;
	std::vector<Box2> charts;
	for (const Outline& outline : outlines) {
		std::vector<Box2> boxes;
		Box2 whole;
		for (const Segment& s : outline) {
			boxes.push_back(boxOf(s, 0.5 * room));
			whole.add(boxes.back());
		}
		sides.emplace_back(boxes);
		charts.push_back(whole);
	}
	std::size_t steps = 0;
	bool apart = true;
	BoxTree(charts).meetingPairs([&](int i, int j) {
		std::size_t few = positionOf(i), many = positionOf(j);
		if (outlines[few].size() > outlines[many].size())
			std::swap(few, many);
		const Outline &a = outlines[few], &b = outlines[many];
		const auto isNear = [&](const Segment& s) {
			checkpointNowAndThen(1024 * steps++);
			return sides[many].meetsAny(boxOf(s, 0.5 * room), [&](int side) {
				return distance(s, b[positionOf(side)]) < room;
			});
		};
		// Where the sides keep apart, a chart that meets another lies in it.
		apart = apart && std::none_of(a.begin(), a.end(), isNear) && !contains(a, b.front()[0]) &&
				!contains(b, a.front()[0]);
	});
	return apart;
}

} // namespace ricci
