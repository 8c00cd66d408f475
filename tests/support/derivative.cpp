// SPDX-License-Identifier: GPL-3.0-or-later
#include "derivative.h"

#include "shapes.h"

#include <numeric>
#include <vector>

namespace ricci::testing {

Eigen::MatrixXd bothTriangles(const Hessian::Matrix& matrix)
{
	const Eigen::MatrixXd lower = matrix;
	return lower.selfadjointView<Eigen::Lower>();
}

Eigen::MatrixXd denseHessian(const CurvatureMap& map, double shift)
{
	const int n = map.triangulation().vertexCount();
	std::vector<int> unknown(at(n));
	std::iota(unknown.begin(), unknown.end(), 0);
	Hessian hessian;
	hessian.layOut(map, unknown, n);
	hessian.fill(map, shift);
	return bothTriangles(hessian.matrix());
}

Eigen::VectorXd
curvatureSlope(CurvatureMap& map, const Eigen::VectorXd& u, Eigen::Index j, double step)
{
	Eigen::VectorXd moved = u;
	moved[j] = u[j] + step;
	const double above = moved[j];
	map.evaluate(moved);
	Eigen::VectorXd K = map.curvature();
	moved[j] = u[j] - step;
	const double below = moved[j];
	map.evaluate(moved);
	K -= map.curvature();
	return K / (above - below);
}

} // namespace ricci::testing
