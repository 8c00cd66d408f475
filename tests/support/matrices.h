// SPDX-License-Identifier: GPL-3.0-or-later
// Solvers of Eigen that take the compiler seconds, compiled once, and what is found of period matrices with them.
#ifndef RICCI_TESTS_MATRICES_H
#define RICCI_TESTS_MATRICES_H

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

namespace ricci::testing {

/// The x of least norm with \p matrix x = \p right, or nearest to it.
Eigen::MatrixXd leastNormSolution(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right);

/// Of a symmetric matrix, in increasing order.
Eigen::VectorXd symmetricEigenvalues(const Eigen::MatrixXd& matrix);

inline void expectPeriodMatrix(const Eigen::MatrixXcd& omega, Eigen::Index genus)
{
	ASSERT_EQ(omega.rows(), genus);
	ASSERT_EQ(omega.cols(), genus);
	EXPECT_LT((omega - omega.transpose()).cwiseAbs().maxCoeff(), 1e-12);
	const Eigen::MatrixXd imaginary = omega.imag();
	EXPECT_EQ(imaginary.llt().info(), Eigen::Success);
}

/// The least distance of two period matrices in the Siegel upper half space, over all bases, that is over
/// Sp(2g,Z): of the logarithms of the eigenvalues of one energy against the other the largest. Infinity where it
/// is above \p radius. A search: an energy within the radius leaves few vectors of the lattice for each vector of
/// the basis.
double classDistance(const Eigen::MatrixXcd& one, const Eigen::MatrixXcd& two, double radius);

/// The period matrix of the regular polygon of 4 g or 4 g + 2 sides with opposite sides glued, of genus g: the curve
/// y^2 = x^(2g+1) - x or y^2 = x^(2g+1) - 1. Let cj be the closed path from the centre across side j. The rotation by
/// one side, by pi / m, takes cj to c(j+1) and dz to z^k dz e^(i pi (k + 1) / m), so that x^k dx / y for some powers
/// of the rotation has the periods e^(i pi (2 k + 1) j / m) on cj, and the cj meet once each in the
/// centre. From them, ai = c(2i) + s and bi = c(2i+1) + s with s = c0 - c1 + c2 - ... - c(2i-1) are
/// canonical.
Eigen::MatrixXcd omegaOfPolygon(int sides);

} // namespace ricci::testing

#endif
