// SPDX-License-Identifier: GPL-3.0-or-later
#include "seam_cost.h"

#include "../base/tolerances.h"
#include "../error.h"
#include "../metric/laplacian.h"
#include "../numerics/sparse_cholesky.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ricci {

namespace {

/// Cost factor at exposure 1, less 1.
constexpr double kMaxFactor = 9.0;

/// Cost factor of diagonals.
constexpr double kDiagonalFactor = 1.01;

/// Time of the smoothing step as a share of the area: features up to sqrt(this) of the size go.
constexpr double kSmoothing = 1.0 / 400.0;

/// The places after one implicit step of mean curvature flow, by rows: the solution x of
/// (M + L) x = M place, with the masses M and the Laplacian L with the \p weights of the edges.
Eigen::MatrixX3d smoothedPlaces(
	const Triangulation& t,
	const EdgeArray<double>& weights,
	const VertexVector& mass,
	const Eigen::MatrixX3d& place)
{
	VertexArray<int> row(t.vertexCount());
	std::iota(row.begin(), row.end(), 0);
	SparseCholesky cholesky;
	if (!cholesky.factorize(laplacian(t, weights, row, mass)))
		throw SolverFailed(SolverFailed::SeamCost);
	Eigen::MatrixX3d smooth(place.rows(), 3);
	for (int k = 0; k < 3; ++k)
		smooth.col(k) = cholesky.solve(mass.cwiseProduct(place.col(k)));
	return smooth;
}

} // namespace

VertexArray<double> exposure(
	const Triangulation& t, const EdgeArray<double>& lengths, const VertexArray<Point3>& positions)
{
	VertexArray<double> result(t.vertexCount(), 0.5);
	VertexVector mass = vertexAreas(t, lengths);
	const double area = mass.sum();
	if (!(area > 0.0))
		return result;
	mass.array() += kMassShare * area / static_cast<double>(t.vertexCount());
	EdgeArray<double> weights = cotangentWeights(t, lengths, kMaxCotangent);
	for (double& w : weights)
		w = kSmoothing * area * std::max(w, kMinCotangentWeight);
	Eigen::MatrixX3d place(t.vertexCount(), 3), normal = Eigen::MatrixX3d::Zero(t.vertexCount(), 3);
	for (const Vertex v : t.vertices())
		place.row(v.number()) = Eigen::RowVector3d::Map(positions[v].data());
	for (const Face f : t.faces()) { // sum of the faces' normals, twice as long as their areas
		const auto [a, b, c] = t.vertices(f);
		const Eigen::RowVector3d p = place.row(a.number());
		const Eigen::RowVector3d twice =
			(place.row(b.number()) - p).cross(place.row(c.number()) - p);
		for (const Vertex v : {a, b, c})
			normal.row(v.number()) += twice;
	}
	const Eigen::MatrixX3d smooth = smoothedPlaces(t, weights, mass, place);
	VertexArray<double> height(t.vertexCount(), 0.0);
	double square = 0.0;
	for (const Vertex v : t.vertices()) {
		const auto n = normal.row(v.number());
		const double length = n.norm();
		if (length > 0.0)
			height[v] = (place.row(v.number()) - smooth.row(v.number())).dot(n) / length;
		square += mass[v] * height[v] * height[v];
	}
	const double typical = std::sqrt(square / area);
	// A sphere stands out everywhere alike; a plane not at all but for rounding.
	if (typical > kFlatness * std::sqrt(area))
		for (const Vertex v : t.vertices())
			result[v] = 0.5 * (1.0 + std::tanh(height[v] / typical));
	return result;
}

EdgeArray<double> seamCost(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const VertexArray<Point3>& positions,
	double hiding)
{
	EdgeArray<double> cost = lengths;
	if (hiding == 0.0)
		return cost;
	const VertexArray<double> exposed = exposure(t, lengths, positions);
	for (const Edge e : t.edges()) {
		const auto [a, b] = t.ends(e);
		cost[e] *= 1.0 + 0.5 * kMaxFactor * hiding * (exposed[a] + exposed[b]);
	}
	return cost;
}

void avoidDiagonals(const EdgeArray<char>& isDiagonal, EdgeArray<double>& cost)
{
	for (const Edge e : isDiagonal.indices())
		if (isDiagonal[e])
			cost[e] *= kDiagonalFactor;
}

} // namespace ricci
