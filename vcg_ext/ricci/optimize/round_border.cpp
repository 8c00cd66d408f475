// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair.h"

#include "../base/tolerances.h"

#include <cmath>
#include <complex>
#include <utility>

namespace ricci {

namespace {

using Complex = std::complex<double>;

/// Fewer points always lie on one.
constexpr std::size_t kLeastOnCircle = 5;

/// What lies behind a chord with more arcs has room there.
constexpr std::size_t kSmallPocket = 64;

/// Share of its neighbour that an arc is given, so that triangles across both are not torn.
constexpr double kGrading = 0.5;

/// A loop round a chart, and the circle that it lies on or near.
struct Loop
{
	std::vector<Corner> sides; ///< counter-clockwise
	Complex centre;
	double radius = 0.0;
	std::vector<double> arcs, least; ///< [side] see findArcs()

	std::size_t size() const { return sides.size(); }

	/// The unit vector from the centre to where a side begins.
	Complex direction(const FlatMesh& flat, std::size_t side) const
	{
		const Complex r = asComplex(flat.at(sides[side % size()])) - centre;
		return r / std::abs(r);
	}

	/// Puts the point at the beginning of a side on the circle.
	/// \param turn radians from where it is
	void place(std::size_t side, double turn, FlatMesh& flat) const
	{
		flat.place[flat.points[sides[side]]] =
			asPoint(centre + radius * direction(flat, side) * std::polar(1.0, turn));
	}

	/// Finds the circle through three points far from each other.
	void findCircle(const FlatMesh& flat)
	{
		const auto farthest = [&](const auto& far) {
			double most = -1.0;
			Complex found;
			for (const Corner side : sides) {
				const Complex p = asComplex(flat.at(side));
				if (const double d = far(p); d > most) {
					most = d;
					found = p;
				}
			}
			return found;
		};
		const Complex a = asComplex(flat.at(sides.front()));
		const Complex u = farthest([&](Complex p) { return std::norm(p - a); }) - a;
		const auto doubledArea = [&](Complex v) { return (std::conj(u) * v).imag(); };
		const Complex v = farthest([&](Complex p) { return std::abs(doubledArea(p - a)); }) - a;
		const Complex toCentre =
			Complex(0.0, 0.5) * (std::norm(v) * u - std::norm(u) * v) / doubledArea(v);
		centre = a + toCentre;
		radius = std::abs(toCentre);
	}

	bool isRound(const FlatMesh& flat) const
	{
		return size() >= kLeastOnCircle && std::all_of(sides.begin(), sides.end(), [&](Corner c) {
				   return std::abs(std::abs(asComplex(flat.at(c)) - centre) - radius) <=
						  kCancelled * radius;
			   });
	}
};

/// Those round holes, which run clockwise, are left out, and those at which seams end.
std::vector<Loop> outerLoops(const FlatMesh& flat)
{
	std::vector<Loop> loops;
	CornerArray<char> seen(flat.across.size(), 0);
	for (const Corner first : flat.across.indices()) {
		Loop loop;
		double area = 0.0;
		bool hasSeam = false;
		for (Corner side = first; !flat.across[side].isValid() && !seen[side];) {
			seen[side] = 1;
			loop.sides.push_back(side);
			area += cross(flat.at(side) - flat.at(first), flat.at(side.next()) - flat.at(first));
			for (side = side.next(); flat.across[side].isValid(); side = flat.across[side].next())
				hasSeam = hasSeam || !flat.joined(side).isValid();
		}
		if (hasSeam || !(area > 0.0))
			continue;
		loop.findCircle(flat);
		loops.push_back(std::move(loop));
	}
	return loops;
}

/// Finds the arcs of the loops, and the least ones that let triangles be as high as they should be.
void findArcs(const FlatMesh& flat, const Validity& validity, std::vector<Loop>& loops)
{
	Array<Loop*> loopOf(flat.place.size(), nullptr); // [point]
	Array<std::size_t> number(flat.place.size(), 0); // [point] in its loop
	for (Loop& loop : loops)
		for (std::size_t i = 0; i < loop.size(); ++i) {
			const int point = flat.points[loop.sides[i]];
			loopOf[point] = &loop;
			number[point] = i;
			loop.arcs.push_back(std::arg(loop.direction(flat, i + 1) / loop.direction(flat, i)));
			loop.least.push_back(0.0);
		}
	for (const Corner side : flat.across.indices()) {
		Loop* loop = loopOf[flat.points[side]];
		if (!loop || loop != loopOf[flat.points[side.next()]])
			continue;
		const std::size_t n = loop->size(), first = number[flat.points[side]];
		const std::size_t count = (number[flat.points[side.next()]] + n - first) % n;
		if (count > kSmallPocket)
			continue;
		// Behind a chord lie about as many rows of triangles, one over the other, as half the arcs there.
		const double height = validity.wanted / loop->radius;
		const double each =
			count == 1 ? height : 2.0 * std::sqrt(height / static_cast<double>(count));
		double own = 0.0;
		for (std::size_t i = first; i < first + count; ++i)
			own += loop->arcs[i % n];
		if (own < (1.0 - kTiny) * each * static_cast<double>(count))
			for (std::size_t i = first; i < first + count; ++i)
				loop->least[i % n] = std::max(loop->least[i % n], each);
	}
	for (Loop& loop : loops) {
		const std::size_t n = loop.size();
		for (std::size_t i = 0; i < 2 * n; ++i) {
			double& next = loop.least[(i + 1) % n];
			next = std::max(next, kGrading * loop.least[i % n]);
		}
		for (std::size_t i = 2 * n; i-- > 0;)
			loop.least[i % n] = std::max(loop.least[i % n], kGrading * loop.least[(i + 1) % n]);
	}
}

/// The numbers in increasing order that are nearest to \p values, by least squares, found by pooling adjacent
/// violators.
std::vector<double> nearestIncreasing(const std::vector<double>& values)
{
	std::vector<std::pair<double, std::size_t>> pools; // sum and count
	const auto mean = [](const auto& pool) {
		return pool.first / static_cast<double>(pool.second);
	};
	for (const double value : values) {
		std::pair<double, std::size_t> pool{value, 1};
		for (; !pools.empty() && mean(pools.back()) > mean(pool); pools.pop_back())
			pool = {pool.first + pools.back().first, pool.second + pools.back().second};
		pools.push_back(pool);
	}
	std::vector<double> nearest;
	for (const auto& pool : pools)
		nearest.insert(nearest.end(), pool.second, mean(pool));
	return nearest;
}

/// [side] By how much its beginning has to turn so that no arc is less than its least one. Where not all of them fit
/// on the circle, these are halved until they do.
std::vector<double> turnsFor(const Loop& loop)
{
	const std::size_t n = loop.size();
	std::vector<double> room(n), values(n), turns(n);
	for (double share = 1.0; share > kTiny; share *= 0.5) {
		for (std::size_t i = 0; i < n; ++i)
			room[i] = loop.arcs[i] - share * loop.least[i];
		const auto widest = std::max_element(room.begin(), room.end());
		const std::size_t first = positionOf(static_cast<int>(widest - room.begin())) + 1;
		double sum = 0.0;
		for (std::size_t i = 0; i < n; ++i) {
			values[i] = sum;
			sum += room[(first + i) % n];
		}
		const std::vector<double> nearest = nearestIncreasing(values);
		for (std::size_t i = 0; i < n; ++i)
			turns[(first + i) % n] = nearest[i] - values[i];
		if (nearest.back() - nearest.front() <= sum)
			return turns;
	}
	return std::vector<double>(n, 0.0);
}

} // namespace

void makeRound(FlatMesh& flat)
{
	for (const Loop& loop : outerLoops(flat))
		for (std::size_t i = 0; i < loop.size(); ++i)
			loop.place(i, 0.0, flat);
}

Array<char> slideOnCircles(const Validity& validity, FlatMesh& flat, Array<char>& moved)
{
	std::vector<Loop> loops = outerLoops(flat);
	loops.erase(
		std::remove_if(
			loops.begin(), loops.end(), [&](const Loop& loop) { return !loop.isRound(flat); }),
		loops.end());
	findArcs(flat, validity, loops);
	Array<char> isRound(flat.vertexCount(), 0);
	for (const Loop& loop : loops) {
		const std::vector<double> turns = turnsFor(loop);
		for (std::size_t i = 0; i < loop.size(); ++i) {
			isRound[flat.vertices[loop.sides[i]]] = 1;
			if (turns[i] == 0.0)
				continue;
			loop.place(i, turns[i], flat);
			moved[flat.points[loop.sides[i]]] = 1;
		}
	}
	return isRound;
}

} // namespace ricci
