// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONE_PLACEMENT_H
#define RICCI_CONE_PLACEMENT_H

#include "../options.h"
#include "../surface/triangulation.h"

#include <vector>

namespace ricci {

/// The largest curvature of a placed cone, radians: its angle is at least a right one.
constexpr double kMostConeCurvature = 4.71238898038468985769;

/// How much larger the distortion of a given number of cones may become for shorter seams.
constexpr double kSeamAllowance = 1.05;

/// The most cones that are placed where the distortion decides.
constexpr int kMostPlacedCones = 64;

/// How the curvature of the boundary belongs to that of the cones.
enum class ConeBoundary {
	Fixed,     ///< u = 0 on the boundary; a closed surface has none
	Prescribed ///< the boundary takes what Gauss-Bonnet leaves, in proportion to its length
};

struct ConeRequest
{
	int count = 0;           ///< of cones; 0: the fewest found that reach the distortion
	double distortion = 0.5; ///< wanted if count is 0; see PlacedCones::distortion
	ConeRounding rounding = ConeRounding::Free;
	ConeBoundary boundary = ConeBoundary::Fixed;
	int vertices = -1; ///< cones lie at the first so many vertices; -1: at any
	/// On a sphere, move cones towards each other where that shortens the tree that joins them more
	/// than it raises the distortion: up to the wanted one, or by kSeamAllowance for a given count.
	bool shortSeams = true;
};

struct PlacedCones
{
	std::vector<int> vertices;      ///< increasing
	std::vector<double> curvatures; ///< radians, at most kMostConeCurvature, never 0
	/// Standard deviation, by area, of 2 u, the logarithm of the change of areas
	/// (AreaDistortion::spread), as the linear problem predicts it.
	double distortion = 0.0;
};

/// Chooses cones so that the flow to them changes areas little.
///
/// The conformal factor of a flat metric with cones of curvature k solves L u = k - K, where L, the
/// flow's Hessian at the metric \p lengths, is a Laplacian. Its mean square is a quadratic function
/// of k (the L2 distortion of Soliman, Slepcev and Crane, Optimal Cone Singularities for Conformal
/// Flattening, 2018), and its gradient, the field phi with L phi = u, says what a cone gains at
/// every vertex. Cones are added one by one where phi is furthest from its value at the cones that
/// are there, and the curvatures fitted anew each time (orthogonal matching pursuit); then every
/// cone in turn is taken out and put where it gains most, while that helps. With
/// ConeRounding::QuarterTurns the curvatures are the best multiples of pi/2 that a search by single
/// steps and exchanges finds.
///
/// The seams of a sphere are a tree through its cones. Distortion is flat about its least value: the
/// last moves lower the product of the tree's length and the root of the distortion.
///
/// On a closed surface the curvatures add up to 2 pi chi. No cone lies on the boundary.
/// Deterministic.
/// \param lengths [edge] of the surface, positive
/// \throw InvalidOption if the count is too small for the surface, or larger than its number of
/// interior vertices
PlacedCones
placeCones(const Triangulation& t, const std::vector<double>& lengths, const ConeRequest& request);

} // namespace ricci

#endif
