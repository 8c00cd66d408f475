// SPDX-License-Identifier: GPL-3.0-or-later
#include "covered_twice.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>

namespace ricci::testing {

namespace {

/// Places in units of 2^-50: floats from 2^-27 to 1 have all their digits there, smaller ones are
/// rounded far below any float's neighbour in the square's middle.
using Place = std::array<std::int64_t, 2>;
using Corners = std::array<Place, 3>;

constexpr double kUnit = 1125899906842624.0; // 2^50
constexpr std::size_t kLeaf = 24;
constexpr int kDeepest = 40;

/// Twice the area of the triangle: positive to the left of ab. Exact.
__int128 area(const Place& a, const Place& b, const Place& c)
{
	return static_cast<__int128>(b[0] - a[0]) * (c[1] - a[1]) -
		   static_cast<__int128>(b[1] - a[1]) * (c[0] - a[0]);
}

/// How deep, in units of the square, \p b reaches over the side of \p a that it crosses least, and
/// whether it reaches over all of them at all.
double reach(const Corners& a, const Corners& b, bool& over)
{
	double least = 2.0;
	for (std::size_t k = 0; k < 3; ++k) {
		const Place &p = a[k], &q = a[(k + 1) % 3];
		__int128 most = 0;
		for (const Place& r : b)
			most = std::max(most, area(p, q, r));
		over &= most > 0;
		const double side =
			std::hypot(static_cast<double>(q[0] - p[0]), static_cast<double>(q[1] - p[1]));
		least = std::min(least, static_cast<double>(most) / (side * kUnit));
	}
	return least;
}

int find(std::vector<int>& parent, int i)
{
	while (parent[static_cast<std::size_t>(i)] != i)
		i = parent[static_cast<std::size_t>(i)] =
			parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(i)])];
	return i;
}

struct Box
{
	Place low, high;
};

/// Calls \p visit(i, j) once for each pair of boxes that meet, by a tree of squares.
template<class Visit>
void meetingPairs(
	const std::vector<Box>& boxes,
	const std::vector<int>& here,
	const Box& square,
	int depth,
	Visit visit)
{
	const auto box = [&](int i) -> const Box& { return boxes[static_cast<std::size_t>(i)]; };
	if (here.size() <= kLeaf || depth == kDeepest) {
		for (std::size_t x = 0; x < here.size(); ++x)
			for (std::size_t y = x + 1; y < here.size(); ++y) {
				const Box &a = box(here[x]), &b = box(here[y]);
				bool meet = true, counted = true;
				for (std::size_t k = 0; k < 2; ++k) {
					const std::int64_t low = std::max(a.low[k], b.low[k]);
					meet &= low < std::min(a.high[k], b.high[k]);
					// In the square that has the lowest point of the common part.
					counted &= square.low[k] <= low && low < square.high[k];
				}
				if (meet && counted)
					visit(here[x], here[y]);
			}
		return;
	}
	for (int quarter = 0; quarter < 4; ++quarter) {
		Box part = square;
		for (std::size_t k = 0; k < 2; ++k) {
			const std::int64_t middle = square.low[k] + (square.high[k] - square.low[k]) / 2;
			(quarter >> k & 1 ? part.low[k] : part.high[k]) = middle;
		}
		std::vector<int> inside;
		for (int i : here)
			if (box(i).low[0] < part.high[0] && box(i).high[0] >= part.low[0] &&
				box(i).low[1] < part.high[1] && box(i).high[1] >= part.low[1])
				inside.push_back(i);
		meetingPairs(
			boxes, inside, part, inside.size() == here.size() ? kDeepest : depth + 1, visit);
	}
}

} // namespace

CoveredTwice::CoveredTwice(const SurfaceMesh& mesh, const UV& uv, const std::vector<char>& reversed)
{
	const std::size_t count = mesh.triangles.size();
	std::vector<Corners> place(count);
	std::vector<int> chart(count), proper;
	std::iota(chart.begin(), chart.end(), 0);
	using Side = std::array<int, 2>;
	std::map<Side, std::array<int, 2>> sides; // vertices, low first: face, corner
	std::vector<Box> boxes(count);
	for (std::size_t f = 0; f < count; ++f) {
		for (std::size_t k = 0; k < 3; ++k)
			for (std::size_t x = 0; x < 2; ++x)
				place[f][k][x] =
					std::llround(kUnit * static_cast<double>(static_cast<float>(uv[f][k][x])));
		const Triangle& t = mesh.triangles[f];
		for (std::size_t k = 0; k < 3; ++k) {
			const int a = t[k], b = t[(k + 1) % 3];
			const auto [known, fresh] = sides.insert(
				{{std::min(a, b), std::max(a, b)}, {static_cast<int>(f), static_cast<int>(k)}});
			if (fresh)
				continue;
			const auto g = static_cast<std::size_t>(known->second[0]);
			const auto m = static_cast<std::size_t>(known->second[1]);
			const bool along = mesh.triangles[g][m] == a;
			const Place &p = place[g][along ? m : (m + 1) % 3],
						&q = place[g][along ? (m + 1) % 3 : m];
			if (p == place[f][k] && q == place[f][(k + 1) % 3])
				chart[static_cast<std::size_t>(find(chart, static_cast<int>(g)))] =
					find(chart, static_cast<int>(f));
		}
		boxes[f] = {place[f][0], place[f][0]};
		for (const Place& p : place[f])
			for (std::size_t x = 0; x < 2; ++x) {
				boxes[f].low[x] = std::min(boxes[f].low[x], p[x]);
				boxes[f].high[x] = std::max(boxes[f].high[x], p[x]);
			}
	}
	for (std::size_t f = 0; f < count; ++f) {
		charts += find(chart, static_cast<int>(f)) == static_cast<int>(f);
		if (reversed[f])
			std::swap(place[f][1], place[f][2]);
		if (area(place[f][0], place[f][1], place[f][2]) > 0)
			proper.push_back(static_cast<int>(f));
	}
	const auto end = static_cast<std::int64_t>(kUnit) + 1;
	meetingPairs(boxes, proper, {{0, 0}, {end, end}}, 0, [&](int i, int j) {
		const Corners &a = place[static_cast<std::size_t>(i)],
					  &b = place[static_cast<std::size_t>(j)];
		bool over = true;
		const double depth = std::min(reach(a, b, over), reach(b, a, over));
		if (!over)
			return;
		if (find(chart, i) != find(chart, j))
			++betweenCharts;
		else
			withinCharts += depth > kContact;
	});
}

} // namespace ricci::testing
