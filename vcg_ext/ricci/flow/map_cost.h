// SPDX-License-Identifier: GPL-3.0-or-later
// What cones, cuts along creases and Automatic are chosen by.
#ifndef RICCI_MAP_COST_H
#define RICCI_MAP_COST_H

#include <cmath>
#include <limits>

namespace ricci {

/// What a seam as long as the square root of the area costs.
constexpr double kSeamPrice = 0.05;

/// What one more cone must save beyond the price of its seam: charts with more cones overlap themselves
/// more often, and are divided there by seams that no tree of cones foretells.
constexpr double kConePrice = 0.001;

/// Of the mean square of u in the energy, see expectedEnergy().
constexpr double kEnergyPrice = 8.0;

/// What a map costs, or is expected to.
struct MapCost
{
	/// The symmetric Dirichlet energy |J|^2 + |J^-1|^2 for the derivative J, as mean by the area in space,
	/// at the scale at which it is least: 4 for an isometry.
	double energy = 4.0;
	double seams = 0.0; ///< their length, in units of the square root of the area

	/// The objective.
	double total() const { return energy + kSeamPrice * seams; }
};

/// The cost of a map that does not exist.
constexpr double kNoAlternative = std::numeric_limits<double>::infinity();

/// The energy of a map: at the scale s it is s^2 \p forth + \p back / s^2 over \p area.
/// \param forth, back integrals of |J|^2 and |J^-1|^2 over the \p area in space
inline double energyAtBestScale(double forth, double back, double area)
{
	return 2.0 * std::sqrt(forth * back) / area;
}

/// The energy of a conformal map with area factors exp(2 u) where u is small: energyAtBestScale() of the
/// means of 2 exp(2 u) and 2 exp(-2 u), which is 4 and kEnergyPrice times the mean square of u.
/// \param spread standard deviation of 2 u
inline double expectedEnergy(double spread)
{
	return 4.0 + 0.25 * kEnergyPrice * spread * spread;
}

/// What \p cones cost beyond the energy of an isometry.
/// \param meanSquare of u
/// \param seams see MapCost
inline double coneCost(double meanSquare, double seams, int cones)
{
	return kEnergyPrice * meanSquare + kSeamPrice * seams + kConePrice * cones;
}

} // namespace ricci

#endif
