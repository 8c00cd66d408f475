// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_AREA_CHANGE_H
#define RICCI_AREA_CHANGE_H

#include "../mesh/component.h"

namespace ricci {

/// How a metric changes areas. The area factor s of a triangle is its share of the area in the metric
/// over its share of that in space. See areaDistortion(), which measures a drawn map in the same way.
struct AreaChange
{
	double mean = 1.0;   ///< of max(s, 1/s), weighted by the area in space
	double spread = 0.0; ///< standard deviation of ln s, weighted by the area in space
	double energy = 4.0; ///< of a conformal map that changes areas so, see MapCost
};

/// The change by the metric that scales lengths at each vertex by exp(\p factor). The factor of a
/// triangle is taken from the geometric mean of those at its corners: so flips do not matter, nor how
/// bent edges are drawn.
AreaChange areaChange(const EmbeddedSurface& surface, const VertexVector& factor);

/// How far \p change is from that of a metric that is to have this \p spread: at most 1 where its
/// spread is no larger than that, times \p slack, and its mean no larger than kMaxAreaMean; or, for
/// spreads above kWideSpread, by as much larger as the mean of normally distributed logarithms
/// is. A small part of the surface that becomes very small or very large raises the mean alone.
double areaExcess(const AreaChange& change, double spread, double slack = 1.0);

/// Weights of the vertices, which add up to 1, for mean squares of a factor that are to fall as the
/// mean of cosh(2 u - c) by area does, for the best c: each vertex's area, multiplied by
/// sinh(x) / x at x = 2 u - c, so that both functions have the same derivative at u = \p factor
/// [Holland Welsch 1977]. Where \p factor spreads so far that a linear problem knows nothing of the
/// largest x, they are the areas.
VertexVector tailWeights(const EmbeddedSurface& surface, const VertexVector& factor);

} // namespace ricci

#endif
