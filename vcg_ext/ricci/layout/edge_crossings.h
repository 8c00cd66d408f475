// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_EDGE_CROSSINGS_H
#define RICCI_EDGE_CROSSINGS_H

#include "../surface/normal_coordinates.h"
#include "common_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace ricci {

/// Crossings stay this far from the ends of their edge, relative to its length: rounding must not
/// put them on a vertex.
constexpr double kEndGap = 1e-14;

inline double keepInside(double t)
{
	return std::min(std::max(std::isfinite(t) ? t : 0.5, kEndGap), 1.0 - kEndGap);
}

inline double mix(double a, double b, double t)
{
	return (1.0 - t) * a + t * b;
}

/// Crossing of an end edge with a start edge, as one vector of R^{2,1} in two bases.
struct HomogeneousPoint
{
	int curve = -1;                      ///< end edge
	std::array<double, 2> onStart{0, 0}; ///< weights of the ends of the start edge's even halfedge
	std::array<double, 2> onEnd{0, 0};   ///< weights of the ends of the end edge's even halfedge
};

/// Crossing of an input edge with a start edge.
struct InputPoint
{
	int curve = -1;       ///< input edge
	double along = 0.0;   ///< on the input edge
	double onStart = 0.0; ///< on the start edge
};

/// Where the edges of the input and of the end cross those of the start. Which and in what order:
/// by integers. Where: straight lines in the input's metric, and planes through the origin of
/// R^{2,1} for the conformal flips.
class EdgeCrossings
{
public:
	using Curve = NormalCoordinates::Curve;

	/// \param listener is told the number of crossings before there is an array of them
	EdgeCrossings(const FlippedSurface& surface, const OverlayListener& listener);

	/// Index of a crossing in inputPoints, endPoints.
	int inputSlot(const NormalCoordinates::Crossing& x) const;
	int endSlot(const NormalCoordinates::Crossing& x) const;

	NormalCoordinates inputOnStart, endOnStart;
	std::vector<Curve> inputCurves, endCurves; ///< [edge] their ways on the start triangulation
	std::vector<Curve> startCurves;            ///< [start edge] its way on the end triangulation

	/// [start edge] first slot of its points, in order from the origin of its even halfedge
	std::vector<int> firstInput, firstEnd;
	std::vector<InputPoint> inputPoints;
	std::vector<HomogeneousPoint> endPoints;

private:
	struct StartTriangle
	{
		double ij, jk, ki, rootD;
	};

	void placeInputCrossings();
	void placeEndCrossings();
	StartTriangle startTriangle(int h) const;
	double across(int h, double fi, double fj, double fk) const;

	const FlippedSurface& m_surface;
	const Triangulation& m_start;
};

} // namespace ricci

#endif
