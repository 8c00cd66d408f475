// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PRECONDITIONER_H
#define RICCI_PRECONDITIONER_H

#include <Eigen/Core>
#include <functional>

namespace ricci {

/// A function in the form of a preconditioner of Eigen: what stands for the inverse of the matrix.
class Preconditioner
{
public:
	std::function<Eigen::VectorXd(const Eigen::VectorXd& residual)> solve;

	template<class Matrix>
	Preconditioner& compute(const Matrix&)
	{
		return *this;
	}
	Eigen::ComputationInfo info() { return Eigen::Success; }
};

} // namespace ricci

#endif
