// SPDX-License-Identifier: GPL-3.0-or-later
#include "seam_cost.h"

#include "../base/tolerances.h"
#include "../error.h"
#include "../math/sparse_cholesky.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ricci {

namespace {

/// Cost factor at exposure 1, less 1.
constexpr double kMaxFactor = 9.0;

/// Cost factor of diagonals.
constexpr double kDiagonalFactor = 1.01;

/// Time of the smoothing step as a share of the area: features up to sqrt(this) of the size go.
constexpr double kSmoothing = 1.0 / 400.0;

/// A surface in space as its smoothing sees it.
struct SpatialSurface
{
	Eigen::MatrixX3d place;   ///< by rows
	Eigen::MatrixX3d normal;  ///< by rows; sum of the faces' normals, twice as long as their areas
	VertexVector mass;        ///< a third of the area of the faces at the vertex
	EdgeArray<double> weight; ///< half the sum of the cotangents of the opposite angles
};

SpatialSurface spatialSurface(
	const Triangulation& t, const EdgeArray<double>& lengths, const VertexArray<Point3>& positions)
{
	const int n = t.vertexCount();
	SpatialSurface s;
	s.place.resize(n, 3);
	for (const Vertex v : t.vertices()) {
		const Point3& p = positions[v];
		s.place.row(v.number()) = Eigen::Vector3d(p[0], p[1], p[2]);
	}
	s.normal = Eigen::MatrixX3d::Zero(n, 3);
	s.mass = Eigen::VectorXd::Zero(n);
	s.weight.assign(t.edgeCount(), 0.0);
	for (const Face f : t.faces()) {
		const auto corner = t.vertices(f);
		const Eigen::Vector3d a = s.place.row(corner[0].number()),
							  b = s.place.row(corner[1].number()),
							  c = s.place.row(corner[2].number());
		const Eigen::Vector3d twice = (b - a).cross(c - a);
		const double area = 0.5 * twice.norm();
		for (const Halfedge h : t.halfedges(f)) {
			s.normal.row(t.origin(h).number()) += twice;
			s.mass[t.origin(h)] += area / 3.0;
			const double side = lengths[h.edge()];
			const double left = lengths[t.next(h).edge()], right = lengths[t.previous(h).edge()];
			const double cotangent =
				(left * left + right * right - side * side) / std::max(4.0 * area, kNoArea);
			s.weight[h.edge()] += 0.5 * std::clamp(cotangent, -kMaxCotangent, kMaxCotangent);
		}
	}
	return s;
}

/// The places after one implicit step of mean curvature flow, by rows: the solution x of
/// (M + time L) x = M place, with the masses M and the cotangent Laplacian L.
Eigen::MatrixX3d
smoothedPlaces(const Triangulation& t, const SpatialSurface& s, double time, const Tick& tick)
{
	const int n = t.vertexCount();
	std::vector<Eigen::Triplet<double>> entries; // lower triangle, numbered by vertices
	VertexVector diagonal = s.mass;
	for (const Edge e : t.edges()) {
		const auto [a, b] = t.ends(e);
		const double w = time * std::max(s.weight[e], kMinCotangentWeight);
		diagonal[a] += w;
		diagonal[b] += w;
		if (a != b)
			entries.emplace_back(std::max(a, b).number(), std::min(a, b).number(), -w);
	}
	for (const Vertex v : t.vertices())
		entries.emplace_back(v.number(), v.number(), diagonal[v]);
	SparseCholesky::Matrix matrix(n, n);
	VertexArray<int> rowOf(n);
	for (const Vertex v : t.vertices())
		rowOf[v] = v.number();
	const auto layOut = [&] {
		std::vector<Eigen::Triplet<double>> placed = entries;
		for (Eigen::Triplet<double>& entry : placed) {
			const int a = rowOf[Vertex(entry.row())], b = rowOf[Vertex(entry.col())];
			entry = {std::max(a, b), std::min(a, b), entry.value()};
		}
		matrix.setFromTriplets(placed.begin(), placed.end());
	};
	layOut();
	SparseCholesky cholesky;
	cholesky.analyze(matrix, rowOf, layOut);
	if (!cholesky.factorize(matrix, tick))
		throw SolverFailed(SolverFailed::SeamCost);
	Eigen::MatrixX3d smooth(n, 3);
	Eigen::VectorXd rhs(n), solution(n); // by rows of the matrix
	for (int k = 0; k < 3; ++k) {
		for (const Vertex v : t.vertices())
			rhs[rowOf[v]] = s.mass[v] * s.place(v.number(), k);
		cholesky.solve(rhs, solution);
		for (const Vertex v : t.vertices())
			smooth(v.number(), k) = solution[rowOf[v]];
	}
	return smooth;
}

} // namespace

VertexArray<double> exposure(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const VertexArray<Point3>& positions,
	const Tick& tick)
{
	VertexArray<double> result(t.vertexCount(), 0.5);
	SpatialSurface s = spatialSurface(t, lengths, positions);
	const double area = s.mass.sum();
	if (!(area > 0.0))
		return result;
	s.mass.array() += kMassShare * area / static_cast<double>(t.vertexCount());
	const Eigen::MatrixX3d smooth = smoothedPlaces(t, s, kSmoothing * area, tick);
	VertexArray<double> height(t.vertexCount(), 0.0);
	double square = 0.0;
	for (const Vertex v : t.vertices()) {
		const auto normal = s.normal.row(v.number());
		const double length = normal.norm();
		if (length > 0.0)
			height[v] = (s.place.row(v.number()) - smooth.row(v.number())).dot(normal) / length;
		square += s.mass[v] * height[v] * height[v];
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
	double hiding,
	const Tick& tick)
{
	EdgeArray<double> cost = lengths;
	if (hiding == 0.0)
		return cost;
	const VertexArray<double> exposed = exposure(t, lengths, positions, tick);
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
