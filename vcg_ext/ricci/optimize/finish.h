// SPDX-License-Identifier: GPL-3.0-or-later
// The folder optimize: moves points of a flat mesh, to repair, for least distortion, for least stretch. It knows no
// chart.
#ifndef RICCI_FINISH_H
#define RICCI_FINISH_H

#include "../layout/flat_mesh.h"
#include "../mesh/elements.h"
#include "../options.h"

namespace ricci {

/// What the finish has done to the map of one component.
struct FinishCounts
{
	int moved = 0;      ///< points that the repair moved
	int endedEarly = 0; ///< parts of the finish that the bound on their work has ended
};

/// The finish of a component's map to the plane on its own triangles, which straight lines in place of
/// bent ones may have flipped: repairs it (repair.h), and makes it the map of least distortion, or of
/// least stretch.
/// \param cones 1 at cones inside
/// \param freeBoundary whether the curvature of the boundary is free
/// \param onHole 1 at vertices of holes, where the boundary may be repaired in any case; may be empty
/// \param mayCut whether triangles that stay flipped may be cut off: a repair that costs more is not made
/// \pre finish is not Finish::None
FinishCounts finishInPlane(
	FlatMesh& flat,
	const VertexArray<char>& cones,
	bool freeBoundary,
	const VertexArray<char>& onHole,
	Finish finish,
	bool mayCut);

} // namespace ricci

#endif
