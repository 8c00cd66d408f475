// SPDX-License-Identifier: GPL-3.0-or-later
// Target curvatures, and what cones, cuts along creases and Automatic are chosen by.
#ifndef RICCI_TARGET_H
#define RICCI_TARGET_H

#include "../base/numbers.h"
#include "../mesh/elements.h"
#include "../options.h"
#include "../report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace ricci {

/// What a seam as long as the square root of the area costs. A map that costs so much more than it was expected to
/// breaks its promise.
constexpr double kSeamPrice = 0.05, kBrokenPromise = kSeamPrice;

/// What one more cone must save beyond the price of its seam: charts with more cones overlap themselves
/// more often, and are divided there by seams that no tree of cones foretells.
constexpr double kConePrice = 0.001;

/// Share of the objective of an isometry that mirrored cones may cost, and mirrored seams once more.
constexpr double kMirrorPrice = 0.015;

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

	/// The objective that is to be expected of a map on whose mesh energy beyond that of an isometry is \p energyFactor
	/// times what the metric has: straight triangles bend where thin ones were flipped.
	double total(double energyFactor) const
	{
		return total() + (energyFactor - 1.0) * (energy - 4.0);
	}
};

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
/// \param energy beyond it
/// \param seams see MapCost
inline double coneCost(double energy, double seams, int cones)
{
	return energy + kSeamPrice * seams + kConePrice * cones;
}

/// A target curvature that Gauss-Bonnet allows.
struct Target
{
	Background background = Background::EuclideanPlane;
	VertexVector curvature;  ///< radians; meaningless where fixed
	VertexArray<char> fixed; ///< 1 where u keeps its value (free boundary, du = 0 in paper 5.3)
	bool circular = false;   ///< boundary curvature to be adapted to a round disk
	std::optional<std::array<Vertex, 4>> corners; ///< of a rectangle, in boundary order
	std::optional<MapCost> expected; ///< where it was chosen to cost least, or to keep areas
	double seamsWithout = 0.0;       ///< see PlacedCones; 0 where cones were not considered
	bool isSeamless = false;         ///< cones were placed with multiples of pi / 2
	bool conesAtLimit = false;       ///< see PlacedCones
	TargetUsed used = TargetUsed::Prescribed;
	std::optional<double> expectedSpread; ///< see Report
	std::string choice;                   ///< see Report
	std::vector<std::string> notes;       ///< what was chosen, in sentences

	bool hasFixed() const { return std::find(fixed.begin(), fixed.end(), 1) != fixed.end(); }
};

/// The area to which a surface of Euler characteristic \p chi is scaled before the circles of a free
/// boundary are taken over into the hyperbolic plane, whose metrics have no scale of their own:
/// 2 pi max(1, |chi|). Where chi < 0 that is the area of the surface with geodesic boundary.
inline double freeBoundaryArea(int chi)
{
	return 2 * kPi * std::max(1, std::abs(chi));
}

} // namespace ricci

#endif
