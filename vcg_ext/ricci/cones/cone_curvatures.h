// SPDX-License-Identifier: GPL-3.0-or-later
// The curvatures k of cones at which an energy k.G k + 2 b.k is low, with G symmetric.
#ifndef RICCI_CONE_CURVATURES_H
#define RICCI_CONE_CURVATURES_H

#include "../base/numbers.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace ricci {

/// The largest curvature of a placed cone where the surface itself has no more, 3 pi / 2 in radians: its angle is at
/// least a right one.
constexpr double kMaxQuarterTurns = 3.0, kMaxConeCurvature = kMaxQuarterTurns * kQuarterTurn;

/// The multipliers m that hold entries of a minimum k at given values: k - H m has them.
/// \param inverse H: of G or, where the sum of the entries is fixed, of G with a row and a column of ones
/// more, of which H is the part beside them
/// \param held the entries
/// \param excess of k over the values
/// \return m, 0 at all other entries
Eigen::VectorXd multipliers(
	const Eigen::Ref<const Eigen::MatrixXd>& inverse,
	const std::vector<int>& held,
	const Eigen::VectorXd& excess);

/// The lowest energy with no entry of k above a bound, by the multipliers m of the bounds: a dual active set
/// method [Lawson Hanson 1974, 23.3].
/// \param inverse H, see multipliers()
/// \param excess of the minimum without bounds over the bound
/// \param start multipliers to begin with, best near the result; none below 0
/// \return m with k - H m as the minimum: 0 where that is below the bound, else half of what the energy falls by
/// as the bound rises
/// \pre the bound leaves room for the sum
Eigen::VectorXd boundMultipliers(
	const Eigen::Ref<const Eigen::MatrixXd>& inverse,
	const Eigen::VectorXd& excess,
	Eigen::VectorXd start);

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
