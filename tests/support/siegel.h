// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_SIEGEL_H
#define RICCI_TESTS_SIEGEL_H

#include <Eigen/Core>

namespace ricci::testing {

/// Energies of the real harmonic forms of a surface with this period matrix, in the basis of their
/// periods along a1, ..., ag, b1, ..., bg: symmetric, positive definite and symplectic.
Eigen::MatrixXd energyOf(const Eigen::MatrixXcd& omega);

/// Distance of two points of the Siegel upper half space: of the logarithms of the eigenvalues of one
/// energy against the other the largest.
double siegelDistance(const Eigen::MatrixXd& one, const Eigen::MatrixXd& two);

/// The least distance of two period matrices over all bases, that is over Sp(2g,Z); infinity where it is
/// above \p radius. A search: an energy within the radius leaves few vectors of the lattice for each
/// vector of the basis.
double classDistance(const Eigen::MatrixXcd& one, const Eigen::MatrixXcd& two, double radius);

} // namespace ricci::testing

#endif
