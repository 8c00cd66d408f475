// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONE_PLACEMENT_H
#define RICCI_CONE_PLACEMENT_H

#include "../base/numbers.h"
#include "../flow/target.h"
#include "../mesh/component.h"
#include "cone_curvatures.h"
#include "linear_flow.h"
#include "prescribed_target.h"

#include <memory>
#include <vector>

namespace ricci {

/// What cones are placed for, and what goes with it.
struct ConeGoal
{
	enum Kind { LeastCost, Count, Spread };
	Kind kind = LeastCost;
	int count = 0;       ///< of Count
	double spread = 0.0; ///< of Spread: of areas, at most

	/// Of LeastCost: cones are mirrored by it where that costs hardly more; null: no such wish. Its vertices are the first
	/// ones of the surface.
	std::shared_ptr<const MirrorSymmetry> mirror = nullptr;
};

inline ConeGoal coneGoal(const ConeOptions& options)
{
	if (options.count > 0)
		return {ConeGoal::Count, options.count};
	if (options.distortion > 0.0)
		return {ConeGoal::Spread, 0, options.distortion};
	return {};
}

/// What chooseTarget() is asked for, and which cones placeCones() looks for, and where.
struct TargetRequest : VertexInput
{
	TargetCurvature target = TargetCurvature::Automatic;
	ConeGoal goal;
	ConeRounding rounding = ConeRounding::Free;
	bool freeBoundary = true;     ///< u is fixed on the boundary
	bool onlyWhereNeeded = false; ///< see ConeOptions
	bool measuresAreas = true;    ///< false: Automatic decides by topology alone
	bool hasSeam = false;         ///< see Component: Automatic makes no flat annulus of it
	/// What another map costs, see MapCost: the search for the objective ends where that is out of its reach.
	double alternative = kInfinity;
	/// By what energy beyond that of an isometry costs more than is expected, see MapCost::total().
	double energyFactor = 1.0;

	/// Under which notes name vertices; placed cones lie at these alone. Empty: their own numbers,
	/// and cones at any.
	VertexArray<int> vertexNumbers = {};

	ConeBoundary boundary() const
	{
		return freeBoundary ? ConeBoundary::Fixed : ConeBoundary::Prescribed;
	}
	/// Cones lie at vertices with a number below this; -1: at any.
	int coneVertices() const { return vertexNumbers.empty() ? -1 : vertexNumbers.size(); }
};

/// Cones that placeCones() has found.
struct PlacedCones
{
	std::vector<Vertex> vertices;   ///< increasing
	std::vector<double> curvatures; ///< radians, at most ConeModel::maxCurvature(), never 0
	/// Standard deviation by area of 2 u, the logarithm of the change of areas
	/// (Report::areaDistortionSpread), as the linear problem predicts it.
	double distortion = 0.0;
	/// Length of the seams that are to be expected, and of those without cones, in units of the square
	/// root of the area.
	double seams = 0.0, seamsWithout = 0.0;
	bool atLimit = false; ///< a search on the surface itself could place no more

	/// What a map with them is expected to cost.
	MapCost expectation() const { return {expectedEnergy(distortion), seams}; }
};

/// Chooses cones so that the flow to them changes areas little.
///
/// The conformal factor u of a flat metric with cones of curvature k solves L u = k - K, where the
/// Laplacian L is the Hessian of the flow at its start (LinearFlow). The mean square of u is a
/// quadratic function of k, the L2 distortion of [Soliman Slepcev Crane 2018] (ConeModel). Its
/// gradient at every vertex, the field phi with L phi = A u for the areas A, says what a cone gains
/// there. Their method finds the minimum among all cones up to a total angle, by convex
/// optimisation, and the number of cones follows; here the number is given, or what the distortion
/// takes, or what costs least.
///
/// 1. Cones are added one by one where phi is farthest from its value at the cones that are there,
///    and all curvatures fitted again each time: orthogonal matching pursuit
///    [Pati Rezaiifar Krishnaprasad 1993].
/// 2. Every cone in turn is taken out and put where it gains most, while that helps.
/// 3. With ConeRounding::QuarterTurns the curvatures are multiples of pi / 2 from a search by single
///    steps and exchanges (roundToQuarterTurns()).
/// 4. Cones move to where energy and price of their seams together are lower (shortenConeTree()). Where
///    neither number nor distortion is given, cones are added beyond the least sum of the two, and those
///    that are not worth their seams taken out (dropCostlyCones()).
///
/// On a large surface, all of this happens on aggregates of its vertices (onAggregates()); on the surface
/// itself the curvatures are fitted, and cones moved or added where its own distortion asks for it.
///
/// All of it is greedy: the cones are good ones, not provably the best. On a closed surface the
/// curvatures add up to 2 pi chi. No cone lies on the boundary. The result depends on nothing but
/// the arguments.
/// \param start of the flow on \p surface, to which L belongs if it is a Delaunay start
/// \throw InvalidOption (TooFewCones, TooFewVertices) if the count is too small for the surface, or
/// larger than its number of interior vertices
/// \throw SolverFailed
PlacedCones
placeCones(const EmbeddedSurface& surface, InitialPacking& start, const TargetRequest& request);

/// The same with the linear problem at hand.
/// \param flow at the start on \p surface, with the boundary of \p request
PlacedCones
placeCones(const EmbeddedSurface& surface, LinearFlow& flow, const TargetRequest& request);

/// Places cones again with the linear problem of the metric of \p flow, which knows how far the first one was from
/// the truth. For the least cost all are placed anew; for a spread the curvatures of the cones that \p flow has reached
/// are fitted again and cones added, until areas are expected to change as \p request allows (areaExcess() at its
/// spread), or kMaxPlacedCones were added. Mean squares weigh the parts of the surface that have become very small or
/// very large, see tailWeights().
/// \param flow on \p surface, with intrinsic flips and the boundary of \p request
/// \param request without a count
/// \return cones with the spread of all areas that is to be expected
/// \throw SolverFailed
PlacedCones
moreCones(const EmbeddedSurface& surface, const FlowResult& flow, const TargetRequest& request);

} // namespace ricci

#endif
