// SPDX-License-Identifier: GPL-3.0-or-later
#include "outline_packing.h"

#include "../base/box_tree.h"
#include "../base/numbers.h"
#include "../base/task.h"

#include <algorithm>
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

Box2 boxOf(const Segment& s, double padding)
{
	Box2 box;
	for (const Point2& p : s) {
		box.add(Point2{p[0] - padding, p[1] - padding});
		box.add(Point2{p[0] + padding, p[1] + padding});
	}
	return box;
}

} // namespace

Outline outlineOf(const FlatMesh& mesh, const std::vector<int>& triangles)
{
	const auto isFlipped = [&](int f) {
		const Triangle2 t = mesh.at(f);
		return doubledArea(t) < 0.0;
	};
	Outline outline;
	for (const int f : triangles)
		for (const Corner side : cornersOf(f)) {
			const auto [a, b] = mesh.ends(side);
			const Corner other = mesh.joined(side);
			if (a != b && !(other.isValid() && isFlipped(f) == isFlipped(other.face())))
				outline.push_back(isFlipped(f) ? Segment{b, a} : Segment{a, b});
		}
	std::sort(outline.begin(), outline.end());
	return outline;
}

std::complex<double> uprightTurn(const Outline& outline)
{
	constexpr int kDegrees = 90; // directions modulo a right angle
	// Fourth powers of directions: those at right angles are one.
	std::vector<std::complex<double>> fourth;
	std::array<double, kDegrees> lengths{};
	double total = 0.0;
	for (const Segment& s : outline) {
		const std::complex<double> side = asComplex(s[1] - s[0]);
		const double length = std::abs(side);
		const std::complex<double> square = length > 0.0 ? side / length * (side / length) : 0.0;
		fourth.push_back(length * square * square);
		total += length;
		const double angle = kDegrees * (0.5 + std::arg(fourth.back()) / (2.0 * kPi));
		lengths[positionOf(std::clamp(static_cast<int>(angle), 0, kDegrees - 1))] += length;
	}
	const auto around = [&](int degree) {
		return lengths[positionOf((degree + kDegrees - 1) % kDegrees)] +
			   lengths[positionOf(degree)] + lengths[positionOf((degree + 1) % kDegrees)];
	};
	int best = 0;
	for (int degree = 1; degree < kDegrees; ++degree)
		if (around(degree) > around(best))
			best = degree;
	std::complex<double> mean = std::polar(1.0, 2.0 * kPi * ((best + 0.5) / kDegrees - 0.5));
	double straight = 0.0;
	for (const double degrees : {2.0, 1.0}) { // about the middle of these three, then their mean
		const std::complex<double> middle = mean / std::abs(mean);
		mean = 0.0;
		straight = 0.0;
		for (const std::complex<double>& side : fourth)
			if ((side * std::conj(middle)).real() >
				std::cos(4.0 * degrees * kPi / 180.0) * std::abs(side)) {
				mean += side;
				straight += std::abs(side);
			}
		if (!(2.0 * straight > total))
			return 0.0;
	}
	return std::conj(std::sqrt(std::sqrt(mean / std::abs(mean))));
}

bool keepApart(const std::vector<Outline>& outlines, double padding)
{
	std::vector<BoxTree> sides;
	std::vector<Box2> charts;
	for (const Outline& outline : outlines) {
		std::vector<Box2> boxes;
		Box2 whole;
		for (const Segment& s : outline) {
			boxes.push_back(boxOf(s, 0.5 * padding));
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
			return sides[many].meetsAny(boxOf(s, 0.5 * padding), [&](int side) {
				return distance(s, b[positionOf(side)]) < padding;
			});
		};
		// Where the sides keep apart, a chart that meets another lies in it.
		apart = apart && std::none_of(a.begin(), a.end(), isNear) && !contains(a, b.front()[0]) &&
				!contains(b, a.front()[0]);
	});
	return apart;
}

} // namespace ricci
