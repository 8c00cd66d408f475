// SPDX-License-Identifier: GPL-3.0-or-later
#include "convex_layout.h"

#include "../base/numbers.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <complex>
#include <cstddef>
#include <set>
#include <utility>

namespace ricci {

namespace {

using Side = std::pair<int, int>; // local points

/// The borders of a patch, each with the patch on its left; none where two sides run the same way
/// between the same points, or a border meets itself.
std::vector<std::vector<int>> bordersOf(const Patch& patch, const std::set<Side>& sides)
{
	const std::size_t count = patch.points.size();
	std::vector<int> next(count, -1);
	for (const auto& [a, b] : sides)
		if (sides.count({b, a}) == 0) {
			if (next[positionOf(a)] >= 0)
				return {};
			next[positionOf(a)] = b;
		}
	std::vector<std::vector<int>> borders;
	for (std::size_t first = 0; first < count; ++first) {
		std::vector<int> border;
		for (int p = static_cast<int>(first); next[positionOf(p)] >= 0;) {
			border.push_back(p);
			p = std::exchange(next[positionOf(p)], -1);
		}
		if (!border.empty())
			borders.push_back(std::move(border));
	}
	return borders;
}

} // namespace

std::vector<Point2> convexLayout(const Patch& patch)
{
	std::set<Side> sides;
	std::size_t inside = 0; // edges of two triangles
	for (const Triangle& t : patch.corners)
		for (std::size_t k = 0; k < 3; ++k) {
			const Side side{t[k], t[(k + 1) % 3]};
			if (!sides.insert(side).second)
				return {};
			inside += sides.count({side.second, side.first});
		}
	std::vector<std::vector<int>> borders = bordersOf(patch, sides);
	const std::size_t edges = sides.size() - inside;
	if (borders.empty() ||
		patch.points.size() + patch.triangles.size() + borders.size() != edges + 2)
		return {};
	const auto outer =
		std::max_element(borders.begin(), borders.end(), [](const auto& a, const auto& b) {
			return a.size() < b.size();
		});
	// Of the points and the holes; -1 on the circle.
	std::vector<int> unknown(patch.points.size() + borders.size() - 1, 0);
	std::vector<Point2> layout(patch.points.size(), Point2{0.0, 0.0});
	for (std::size_t i = 0; i < outer->size(); ++i) {
		const std::size_t p = positionOf((*outer)[i]);
		unknown[p] = -1;
		layout[p] = asPoint(std::polar(1.0, 2.0 * kPi * double(i) / double(outer->size())));
	}
	int unknowns = 0;
	for (int& number : unknown)
		if (number >= 0)
			number = unknowns++;
	std::vector<Eigen::Triplet<double>> entries;
	Eigen::MatrixX2d sum = Eigen::MatrixX2d::Zero(unknowns, 2);
	const auto pull = [&](int p, int towards) {
		const int row = unknown[positionOf(p)];
		if (row < 0)
			return;
		entries.emplace_back(row, row, 1.0);
		if (const int column = unknown[positionOf(towards)]; column >= 0)
			entries.emplace_back(row, column, -1.0);
		else
			for (int i = 0; i < 2; ++i)
				sum(row, i) += layout[positionOf(towards)][positionOf(i)];
	};
	const auto join = [&](int a, int b) {
		pull(a, b);
		pull(b, a);
	};
	for (const auto& [a, b] : sides)
		if (a < b || sides.count({b, a}) == 0)
			join(a, b);
	int centre = static_cast<int>(patch.points.size());
	for (auto hole = borders.begin(); hole != borders.end(); ++hole)
		if (hole != outer) {
			for (const int p : *hole)
				join(p, centre);
			++centre;
		}
	Eigen::SparseMatrix<double> laplacian(unknowns, unknowns);
	laplacian.setFromTriplets(entries.begin(), entries.end());
	const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(laplacian);
	if (solver.info() != Eigen::Success)
		return {};
	const Eigen::MatrixX2d solution = solver.solve(sum);
	for (std::size_t p = 0; p < layout.size(); ++p)
		if (unknown[p] >= 0)
			layout[p] = {solution(unknown[p], 0), solution(unknown[p], 1)};
	return layout;
}

} // namespace ricci
