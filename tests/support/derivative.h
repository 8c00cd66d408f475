// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_DERIVATIVE_H
#define RICCI_TESTS_DERIVATIVE_H

#include <ricci/flow/curvature_map.h>

#include <Eigen/Dense>

namespace ricci::testing {

/// A symmetric matrix from its lower triangle.
Eigen::MatrixXd bothTriangles(const Hessian::Matrix& matrix);

/// The whole Hessian with all vertices unknown, both triangles.
Eigen::MatrixXd denseHessian(const CurvatureMap& map, double shift = 0.0);

/// Central difference of the curvature by u_j at \p u. Leaves the map at another u.
VertexVector curvatureSlope(CurvatureMap& map, const VertexVector& u, Vertex j, double step);

} // namespace ricci::testing

#endif
