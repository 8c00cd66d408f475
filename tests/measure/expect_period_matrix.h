// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_EXPECT_PERIOD_MATRIX_H
#define RICCI_TESTS_EXPECT_PERIOD_MATRIX_H

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

namespace ricci::testing {

inline void expectPeriodMatrix(const Eigen::MatrixXcd& omega, Eigen::Index genus)
{
	ASSERT_EQ(omega.rows(), genus);
	ASSERT_EQ(omega.cols(), genus);
	EXPECT_LT((omega - omega.transpose()).cwiseAbs().maxCoeff(), 1e-12);
	const Eigen::MatrixXd imaginary = omega.imag();
	EXPECT_EQ(imaginary.llt().info(), Eigen::Success);
}

} // namespace ricci::testing

#endif
