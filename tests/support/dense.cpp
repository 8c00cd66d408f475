// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace ricci::testing {

Eigen::MatrixXd leastNormSolution(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right)
{
	return matrix.completeOrthogonalDecomposition().solve(right);
}

Eigen::VectorXd symmetricEigenvalues(const Eigen::MatrixXd& matrix)
{
	return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly)
		.eigenvalues();
}

} // namespace ricci::testing
