// SPDX-License-Identifier: GPL-3.0-or-later
// The folder optimize: moves points of a flat mesh, to repair, for least distortion, for least stretch. It knows no
// chart.
#ifndef RICCI_REPAIR_H
#define RICCI_REPAIR_H

#include "../layout/flat_mesh.h"
#include "../mesh/elements.h"
#include "../options.h"
#include "patches.h"
#include "point_groups.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

namespace ricci {

/// What a patch costs as it is in the map; called one after another.
using CostOfPatch = std::function<double(const FlatMesh& flat, const Patch& patch)>;

/// Where a repair may move the boundary. One that is kept is prescribed: it moves only if a triangle is flipped or
/// flat, and where nothing may be cut off instead, circles of it stay circles.
enum class BoundaryRepair { Free, Kept, KeptOnCircles };

/// What a repair is after, and which patches it takes over.
struct RepairRules
{
	RestShapes shapes;
	Validity validity;
	CostOfPatch cost = nullptr; ///< a patch that would cost more stays as it was
	BoundaryRepair boundary = BoundaryRepair::Free;
};

/// What the patches of a map are solved with.
struct PatchProblem
{
	const FlatMesh& flat;
	const PointGroups& groups;
	const RepairRules& rules;
};

/// What untangle() found.
struct Untangled
{
	/// [local point] Places, as they are stored, where all triangles are valid; empty if none were found.
	std::vector<Point2> points;
	int steps = 0; ///< of Newton
};

/// Moves the inner points of a patch until all its triangles are valid, and as near to the shapes of the rules as its
/// border lets them be.
///
/// It minimises the sum over the triangles of w (|J|^2 + lambda (1 + det^2 J)) / chi(det J), where
/// J is the linear map from the rest shape, w its area, and chi(d) = (d + sqrt(eps^2 + d^2)) / 2 is
/// positive for flipped triangles, too. eps falls with them, and in the end only
/// positive determinants remain [Garanzha et al. 2021, Eq. 3]. The steps are Newton's, with each
/// triangle's Hessian made positive semidefinite: in terms of f_z and f_zbar its eigenvalues have
/// closed forms.
/// \param maxSteps of Newton in all; then the search is over
Untangled untangle(const PatchProblem& problem, const Patch& patch, int maxSteps);

/// Lowers the same energy, with eps = 0, on a patch that is valid, which it stays.
Untangled ease(const PatchProblem& problem, const Patch& patch, int maxSteps);

/// What repair() has done.
struct Repair
{
	Array<char> moved;  ///< [point] 1 where the repair moved it; empty where nothing was to be done
	int left = 0;       ///< triangles that are not valid after it
	int endedEarly = 0; ///< of finishInPlane(): parts that the bound on their work has ended

	int movedCount() const;
	/// Takes over what a second repair of the same mesh has done.
	void add(const Repair& next);
};

/// What the repairs of one map may still spend, in triangles set up for a step of Newton: a third of a
/// microsecond to one each. It bounds their time without a clock, so that the result is the same on every run.
class WorkLimit
{
public:
	/// \param triangles of the map
	/// \param steps on all of them that a stage may spend at most; by default the other bound is lower
	explicit WorkLimit(std::int64_t triangles, std::int64_t steps = kOfStage) :
			m_stage(std::min(steps * triangles, kOfStage + kOfStagePerTriangle * triangles)),
			m_left(kStages * m_stage)
	{
	}

	/// What one stage may spend of it.
	std::int64_t ofStage() const { return std::min(m_stage, m_left); }

	/// Steps on all triangles that a stage of a repair may spend where what it leaves can be cut off, or counted: few maps
	/// that are not repaired by then are repaired by more.
	static constexpr std::int64_t kFew = 50;

	/// \param work no more than is left
	void spend(std::int64_t work) { m_left -= work; }
	std::int64_t left() const { return m_left; }

private:
	/// CAD meshes of 20000 triangles with a thousand needles take all of it; the
	/// repair of a refinement of millions takes 1 to 2 for each triangle.
	static constexpr std::int64_t kOfStage = 1000000, kOfStagePerTriangle = 2, kStages = 6;

	std::int64_t m_stage, m_left;
};

/// Triangles of \p flat that are not valid.
std::vector<int> badTriangles(const FlatMesh& flat, const Validity& validity);

/// Mends the triangles that are not valid: moves points near them, and no others.
///
/// Patches of 1, 2, 3, 5, 8, ... rings round clusters of bad triangles are untangled
/// until one holds, or until the limit's share of a stage is spent; triangles that no patch
/// mends stay as they are. Patches of one size move no triangle of each other, so they are solved side by
/// side, and the result does not depend on the number of threads.
Repair
repair(FlatMesh& flat, const PointGroups& groups, const RepairRules& rules, WorkLimit& limit);

/// repair() in stages, each for what the one before has left: the points inside the charts; the copies
/// of seam vertices together, and the boundary where it is free; the boundary everywhere, if the rules let it. Points of
/// circles are moved along these before (slideOnCircles()).
/// Triangles of the surface that are far from their shapes afterwards are evened out with more of their neighbours.
Repair repairInStages(
	FlatMesh& flat, const BoundaryRule& boundaryMoves, const RepairRules& rules, WorkLimit& limit);

/// Mends triangles of charts in the Poincaré disk that are flipped or too low.
///
/// The triangles round one of them are laid out side by side across seams, as in the universal cover, where
/// they are or with that triangle at 0, and are untangled there as straight triangles. Every copy
/// of a point that has moved follows by the isometry that takes the layout to its chart, so that the sides of
/// seams stay congruent. Patches are taken one after another, and only where fewer triangles are wrong in the
/// charts afterwards.
/// \param rules cost is not asked
/// \param boundaryMoves whether points of the surface's boundary may move
Repair
repairInCover(FlatMesh& flat, const RepairRules& rules, bool boundaryMoves, WorkLimit& limit);

/// The finish of a component's map to the plane on its own triangles, which straight lines in place of
/// bent ones may have flipped: repairs it, and makes it the map of least distortion, or of least stretch.
/// \param freeBoundary whether the curvature of the boundary is free
/// \param onHole 1 at vertices of holes, where the boundary may move in any case; may be empty
/// \param mayCut whether triangles that stay flipped may be cut off: a repair that costs more is not made
/// \return what the repair has done
/// \pre finish is not Finish::None
Repair finishInPlane(
	FlatMesh& flat, bool freeBoundary, const VertexArray<char>& onHole, Finish finish, bool mayCut);

/// Puts the border of a disk, which the flow has made round as far as it went, on a circle.
void makeRound(FlatMesh& flat);

/// Moves points of borders that are circles along these, where triangles with all corners on one, or sides of it, are not
/// valid, until they are as high as they should be: three points of a circle in their order have an area. Of all
/// ways to keep the order at such distances it is the one with the least squares of the turns.
/// \param moved [point] set to 1 where they have moved
/// \return [vertex] 1 on a circle, where moving off it is not needed
Array<char> slideOnCircles(const Validity& validity, FlatMesh& flat, Array<char>& moved);

} // namespace ricci

#endif
