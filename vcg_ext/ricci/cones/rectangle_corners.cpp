// SPDX-License-Identifier: GPL-3.0-or-later
#include "rectangle_corners.h"

#include "../base/convex_hull.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <limits>

namespace ricci {

namespace {

/// The loop's points in the plane through their mean that fits them best (principal components).
std::vector<Point2>
projectToBestPlane(const std::vector<Vertex>& loop, const VertexArray<Point3>& positions)
{
	const auto position = [&](Vertex v) {
		return Eigen::Map<const Eigen::Vector3d>(positions[v].data());
	};
	Eigen::Vector3d mean = Eigen::Vector3d::Zero();
	for (const Vertex v : loop)
		mean += position(v);
	mean /= static_cast<double>(loop.size());
	Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
	for (const Vertex v : loop) {
		const Eigen::Vector3d p = position(v) - mean;
		covariance += p * p.transpose();
	}
	const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance);
	std::vector<Point2> points;
	for (const Vertex v : loop) {
		const Eigen::Vector3d p = position(v) - mean;
		points.push_back({axes.eigenvectors().col(2).dot(p), axes.eigenvectors().col(1).dot(p)});
	}
	return points;
}

/// Vertices that divide the loop into quarters of about the same length, from its first.
std::array<Vertex, 4>
quartersByLength(const std::vector<Vertex>& loop, const VertexArray<Point3>& positions)
{
	const std::size_t n = loop.size();
	std::vector<double> along(n + 1, 0.0);
	for (std::size_t i = 0; i < n; ++i)
		along[i + 1] = along[i] + distance(positions[loop[i]], positions[loop[(i + 1) % n]]);
	std::array<Vertex, 4> corners;
	std::size_t previous = 0;
	for (std::size_t k = 0; k < 4; ++k) {
		const double wanted = along[n] * static_cast<double>(k) / 4;
		const auto above = std::lower_bound(along.begin(), along.end() - 1, wanted);
		std::size_t i = static_cast<std::size_t>(above - along.begin());
		i = std::min(std::max(i, k == 0 ? 0 : previous + 1), n - 4 + k); // all four different
		corners[k] = loop[i];
		previous = i;
	}
	return corners;
}

} // namespace

std::array<Vertex, 4>
rectangleCorners(const std::vector<Vertex>& loop, const VertexArray<Point3>& positions)
{
	const std::vector<Point2> points = projectToBestPlane(loop, positions);
	const OrientedRectangle r = minAreaRectangle(points);
	const std::array<Point2, 4> wanted{
		{{r.min[0], r.min[1]}, {r.max[0], r.min[1]}, {r.max[0], r.max[1]}, {r.min[0], r.max[1]}}};
	std::array<std::size_t, 4> nearest{};
	for (std::size_t k = 0; k < 4; ++k) {
		double min = std::numeric_limits<double>::infinity();
		for (std::size_t i = 0; i < points.size(); ++i) {
			const double d = distance(r.inFrame(points[i]), wanted[k]);
			if (d < min) {
				min = d;
				nearest[k] = i;
			}
		}
	}
	// In order along the loop in either direction: the cyclic sequence falls once, or rises once.
	int rises = 0, falls = 0;
	for (std::size_t k = 0; k < 4; ++k) {
		rises += nearest[(k + 1) % 4] > nearest[k];
		falls += nearest[(k + 1) % 4] < nearest[k];
	}
	if (rises + falls != 4 || (rises != 1 && falls != 1))
		return quartersByLength(loop, positions);
	std::sort(nearest.begin(), nearest.end());
	return {loop[nearest[0]], loop[nearest[1]], loop[nearest[2]], loop[nearest[3]]};
}

} // namespace ricci
