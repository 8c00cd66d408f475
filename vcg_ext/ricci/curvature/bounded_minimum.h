// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_BOUNDED_MINIMUM_H
#define RICCI_BOUNDED_MINIMUM_H

#include <Eigen/Core>

#include <optional>

namespace ricci {

/// The lowest k.G k + 2 b.k with no entry of k above \p max: a primal active set method
/// [Nocedal Wright 2006, 16.5], which ends at the minimum where G is positive definite (on vectors
/// of sum 0 where the sum is fixed).
/// \param gram G, symmetric
/// \param linear b
/// \param total sum of the entries, where it is fixed
/// \param start where to begin, best near the minimum; of no effect where it breaks a condition
/// \return k; all entries are \p max where the sum is out of their reach
Eigen::VectorXd boundedMinimum(
	const Eigen::MatrixXd& gram,
	const Eigen::VectorXd& linear,
	double max,
	std::optional<double> total,
	const Eigen::VectorXd& start = {});

} // namespace ricci

#endif
