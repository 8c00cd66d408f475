// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FINISH_H
#define RICCI_FINISH_H

#include "../layout/common_refinement.h"
#include "../layout/planar_layout.h"
#include "../options.h"
#include "../surface/flow_domain.h"

namespace ricci {

/// What the finish has done to the map of one component.
struct FinishCounts
{
	int moved = 0; ///< points that the repair moved
	int left = 0;  ///< triangles that it could not mend
};

/// The finish of a map to the plane on the triangles of the domain's surface, which straight lines in
/// place of bent ones may have turned round: repairs it (repair.h), and makes it the map of least
/// distortion.
/// \param isCut of the layout
/// \param cones 1 at cones inside
/// \param freeBoundary whether the curvature of the boundary is free
/// \pre finish is not Finish::None
FinishCounts finishMap(
	const FlowDomain& domain,
	const EdgeArray<char>& isCut,
	const VertexArray<char>& cones,
	bool freeBoundary,
	Finish finish,
	PlanarLayout& layout);

/// The repair of a map to the Poincaré disk, for the straight triangles between its points. Seams stay
/// isometric in the hyperbolic metric, and all points in the disk.
FinishCounts
finishDisk(const FlowDomain& domain, bool freeBoundary, PlanarLayout& layout);

/// The same for a refinement, which keeps the shapes of its triangles.
FinishCounts finishDisk(
	const FlowDomain& domain, bool freeBoundary, CommonRefinement& refinement);

} // namespace ricci

#endif
