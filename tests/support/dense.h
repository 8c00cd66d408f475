// SPDX-License-Identifier: GPL-3.0-or-later
// Solvers of Eigen that take the compiler seconds, compiled once.
#ifndef RICCI_TESTS_DENSE_H
#define RICCI_TESTS_DENSE_H

#include <Eigen/Core>

namespace ricci::testing {

/// The x of least norm with \p matrix x = \p right, or nearest to it.
Eigen::MatrixXd leastNormSolution(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right);

/// Of a symmetric matrix, in increasing order.
Eigen::VectorXd symmetricEigenvalues(const Eigen::MatrixXd& matrix);

} // namespace ricci::testing

#endif
