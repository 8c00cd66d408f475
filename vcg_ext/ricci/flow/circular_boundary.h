// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CIRCULAR_BOUNDARY_H
#define RICCI_CIRCULAR_BOUNDARY_H

#include <vector>

namespace ricci {

/// Polygon inscribed in a circle. Side i runs from corner i to corner i + 1 (cyclic).
struct InscribedPolygon
{
	double radius = 0.0;
	std::vector<double> arcs; ///< [side] central angle in radians; they add up to 2 pi
};

/// The one polygon inscribed in a circle with these side lengths, in this order. Each must be
/// less than the sum of the others; the centre may lie outside the polygon.
InscribedPolygon inscribedPolygon(const std::vector<double>& sides);

/// Exterior angle at each corner of the inscribed polygon with these arcs, radians: half the sum of
/// the two adjacent arcs.
std::vector<double> exteriorAngles(const std::vector<double>& arcs);

/// Arcs after the Moebius transformation of the disk that brings the conformal barycentre of the
/// corners, weighted by \p weights, to the centre (Douady and Earle 1986). It exists and is unique
/// up to rotation while no weight is half of the sum or more; otherwise \p arcs is returned.
std::vector<double>
centredArcs(const std::vector<double>& arcs, const std::vector<double>& weights);

/// Anderson acceleration of a fixed-point iteration x <- g(x).
class AndersonMixing
{
public:
	explicit AndersonMixing(std::size_t depth) : m_depth(depth) {}

	/// The next x from the present one and its image.
	std::vector<double> next(const std::vector<double>& x, const std::vector<double>& image);

	void restart() { m_points.clear(), m_residuals.clear(); }

private:
	std::size_t m_depth;
	std::vector<std::vector<double>> m_points, m_residuals; ///< images and image - x, oldest first
};

} // namespace ricci

#endif
