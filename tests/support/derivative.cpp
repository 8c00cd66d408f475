// SPDX-License-Identifier: GPL-3.0-or-later
#include "derivative.h"

#include <numeric>

namespace ricci::testing {

Eigen::MatrixXd bothTriangles(const Hessian::Matrix& matrix)
{
	const Eigen::MatrixXd lower = matrix;
	return lower.selfadjointView<Eigen::Lower>();
}

Eigen::MatrixXd denseHessian(const CurvatureMap& map, double shift)
{
	const int n = map.triangulation().vertexCount();
	VertexArray<int> unknown(n);
	std::iota(unknown.begin(), unknown.end(), 0);
	Hessian hessian;
	hessian.layOut(map, unknown, n);
	hessian.fill(map, shift);
	return bothTriangles(hessian.matrix());
}

VertexVector curvatureSlope(CurvatureMap& map, const VertexVector& u, Vertex j, double step)
{
	VertexVector moved = u;
	moved[j] = u[j] + step;
	const double above = moved[j];
	map.evaluate(moved);
	VertexVector K = map.curvature();
	moved[j] = u[j] - step;
	const double below = moved[j];
	map.evaluate(moved);
	K -= map.curvature();
	return K / (above - below);
}

} // namespace ricci::testing
