// SPDX-License-Identifier: GPL-3.0-or-later
// The curvatures k of cones at which an energy k.G k + 2 b.k is low, with G symmetric.
#ifndef RICCI_CONE_CURVATURES_H
#define RICCI_CONE_CURVATURES_H

#include <Eigen/Core>

#include <optional>

namespace ricci {

/// The largest curvature of a placed cone, 3 pi / 2 in radians: its angle is at least a right one.
constexpr double kMaxConeCurvature = 4.71238898038468985769;
constexpr int kMaxQuarterTurns = 3; ///< the same

/// The lowest energy with no entry of k above \p max: a primal active set method
/// [Nocedal Wright 2006, 16.5], which ends at the minimum where G is positive definite (on vectors
/// of sum 0 where the sum is fixed).
/// \param gram G
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

/// Multiples of pi / 2 near \p values with a low energy, none above kMaxConeCurvature: the values
/// are rounded, corrected to the right sum, and changed by single steps of pi / 2, or by exchanges
/// between two of them, while that lowers the energy. This is a local search for the closest vector
/// of a lattice: it need not find the minimum.
/// \param values the minimum among all real k, radians; at least one
/// \param total wanted sum, radians, where it is fixed; a multiple of pi / 2
Eigen::VectorXd roundToQuarterTurns(
	const Eigen::MatrixXd& gram,
	const Eigen::VectorXd& linear,
	const Eigen::VectorXd& values,
	std::optional<double> total);

} // namespace ricci

#endif
