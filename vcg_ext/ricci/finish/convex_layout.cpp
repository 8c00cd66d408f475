// SPDX-License-Identifier: GPL-3.0-or-later
#include "convex_layout.h"

#include "../base/numbers.h"
#include "../surface/sides.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <complex>
#include <cstddef>
#include <utility>

namespace ricci {

namespace {

/// The borders of a patch, each with the patch on its left; none where an edge has more than two sides or two
/// that run the same way, or a border meets itself.
std::vector<std::vector<int>> bordersOf(const Patch& patch, const Sides& sides)
{
	const std::size_t count = patch.points.size();
	std::vector<int> next(count, -1); // [local point]
	bool isManifold = true;
	sides.forEdges([&](ItemRange<const Corner> edge) {
		if (edge.size() > 1) {
			isManifold = isManifold && sides.across(edge[0]).isValid();
			return;
		}
		int& end = next[positionOf(patch.corners[edge[0]])];
		isManifold = isManifold && end < 0;
		end = patch.corners[edge[0].next()];
	});
	if (!isManifold)
		return {};
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
	const Sides sides(patch.corners.values());
	std::vector<std::vector<int>> borders = bordersOf(patch, sides);
	std::size_t edges = 0;
	sides.forEdges([&](const auto&) { ++edges; });
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
	sides.forEdges([&](ItemRange<const Corner> edge) {
		join(patch.corners[edge[0]], patch.corners[edge[0].next()]);
	});
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
