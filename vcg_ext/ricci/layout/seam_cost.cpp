// SPDX-License-Identifier: GPL-3.0-or-later
#include "seam_cost.h"

#include "../error.h"
#include "../flow/sparse_cholesky.h"
#include "../numbers.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ricci {

namespace {

/// Cost factor at exposure 1, less 1.
constexpr double kMostFactor = 9.0;

/// Time of the smoothing step as a share of the area: features up to sqrt(this) of the size go.
constexpr double kSmoothing = 1.0 / 400.0;

/// Cotangents are kept within this, so that needles do not spoil the matrix.
constexpr double kMostCotangent = 1e3;

Eigen::Vector3d toEigen(const Point3& p)
{
	return {p[0], p[1], p[2]};
}

} // namespace

std::vector<double> exposure(
	const Triangulation& t,
	const std::vector<double>& lengths,
	const std::vector<Point3>& positions)
{
	const auto n = static_cast<Eigen::Index>(t.vertexCount());
	Eigen::MatrixX3d normal = Eigen::MatrixX3d::Zero(n, 3), place(n, 3);
	for (Eigen::Index v = 0; v < n; ++v)
		place.row(v) = toEigen(positions[at(v)]);
	Eigen::VectorXd mass = Eigen::VectorXd::Zero(n);
	std::vector<double> weight(at(t.edgeCount()), 0.0);
	for (int f = 0; f < t.faceCount(); ++f) {
		const auto h = t.halfedges(f);
		const Eigen::Vector3d a = place.row(t.origin(h[0])), b = place.row(t.origin(h[1])),
							  c = place.row(t.origin(h[2]));
		const Eigen::Vector3d twice = (b - a).cross(c - a);
		const double area = 0.5 * twice.norm();
		for (int k : h) {
			normal.row(t.origin(k)) += twice;
			mass[t.origin(k)] += area / 3.0;
			const double side = lengths[at(Triangulation::edge(k))];
			const double left = lengths[at(Triangulation::edge(t.next(k)))];
			const double right = lengths[at(Triangulation::edge(t.previous(k)))];
			const double cotangent =
				(left * left + right * right - side * side) / std::max(4.0 * area, 1e-300);
			weight[at(Triangulation::edge(k))] +=
				0.5 * std::clamp(cotangent, -kMostCotangent, kMostCotangent);
		}
	}
	const double total = mass.sum();
	std::vector<double> result(at(n), 0.5);
	if (!(total > 0.0))
		return result;
	// Vertices whose faces have no area would have empty rows.
	mass.array() += 1e-9 * total / static_cast<double>(n);
	std::vector<Eigen::Triplet<double>> entries;
	Eigen::VectorXd diagonal = mass;
	for (int e = 0; e < t.edgeCount(); ++e) {
		const int a = t.origin(2 * e), b = t.target(2 * e);
		const double w = kSmoothing * total * std::max(weight[at(e)], 1e-6);
		diagonal[a] += w;
		diagonal[b] += w;
		if (a != b)
			entries.emplace_back(std::max(a, b), std::min(a, b), -w);
	}
	for (Eigen::Index v = 0; v < n; ++v)
		entries.emplace_back(static_cast<int>(v), static_cast<int>(v), diagonal[v]);
	SparseCholesky::Matrix matrix(n, n);
	std::vector<int> rowOf(at(n));
	std::iota(rowOf.begin(), rowOf.end(), 0);
	const auto layOut = [&] {
		std::vector<Eigen::Triplet<double>> placed = entries;
		for (Eigen::Triplet<double>& entry : placed) {
			const int a = rowOf[at(entry.row())], b = rowOf[at(entry.col())];
			entry = {std::max(a, b), std::min(a, b), entry.value()};
		}
		matrix.setFromTriplets(placed.begin(), placed.end());
	};
	layOut();
	SparseCholesky cholesky;
	cholesky.analyze(matrix, rowOf, layOut);
	if (!cholesky.factorize(matrix))
		throw Error("The linear solver failed: its matrix is not positive definite. Set "
					"seam_hiding to 0, or "
					"remesh the worst triangles.");
	Eigen::MatrixX3d smooth(n, 3);
	for (int k = 0; k < 3; ++k) {
		Eigen::VectorXd rhs(n), solution(n);
		for (int v = 0; v < n; ++v)
			rhs[rowOf[at(v)]] = mass[v] * place(v, k);
		cholesky.solve(rhs, solution);
		for (int v = 0; v < n; ++v)
			smooth(v, k) = solution[rowOf[at(v)]];
	}
	Eigen::VectorXd height = Eigen::VectorXd::Zero(n);
	double square = 0.0;
	for (Eigen::Index v = 0; v < n; ++v) {
		const double length = normal.row(v).norm();
		if (length > 0.0)
			height[v] = (place.row(v) - smooth.row(v)).dot(normal.row(v)) / length;
		square += mass[v] * height[v] * height[v];
	}
	const double typical = std::sqrt(square / total);
	// A sphere stands out everywhere alike; a plane not at all but for rounding.
	if (typical > 1e-9 * std::sqrt(total))
		for (Eigen::Index v = 0; v < n; ++v)
			result[at(v)] = 0.5 * (1.0 + std::tanh(height[v] / typical));
	return result;
}

std::vector<double> seamCost(
	const Triangulation& t,
	const std::vector<double>& lengths,
	const std::vector<Point3>& positions,
	double hiding)
{
	std::vector<double> cost = lengths;
	if (hiding == 0.0)
		return cost;
	const std::vector<double> exposed = exposure(t, lengths, positions);
	for (int e = 0; e < t.edgeCount(); ++e)
		cost[at(e)] *= 1.0 + 0.5 * kMostFactor * hiding *
								 (exposed[at(t.origin(2 * e))] + exposed[at(t.target(2 * e))]);
	return cost;
}

} // namespace ricci
