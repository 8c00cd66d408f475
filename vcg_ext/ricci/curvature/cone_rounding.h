// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONE_ROUNDING_H
#define RICCI_CONE_ROUNDING_H

#include <Eigen/Core>

#include <optional>

namespace ricci {

/// Multiples of pi / 2 near \p values with a low energy k.G k + 2 b.k, none above kMaxConeCurvature:
/// the values are rounded, corrected to the right sum, and changed by single steps of pi / 2, or by
/// exchanges between two of them, while that lowers the energy. This is a local search for the
/// closest vector of a lattice: it need not find the minimum.
/// \param gram G, symmetric
/// \param linear b
/// \param values the minimum among all real k, radians; at least one
/// \param total wanted sum, radians, where it is fixed; a multiple of pi / 2
Eigen::VectorXd roundToQuarterTurns(
	const Eigen::MatrixXd& gram,
	const Eigen::VectorXd& linear,
	const Eigen::VectorXd& values,
	std::optional<double> total);

} // namespace ricci

#endif
