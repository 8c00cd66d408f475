// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CORNER_LAYOUT_H
#define RICCI_CORNER_LAYOUT_H

#include "../flow/ricci_flow.h"
#include "../surface/flow_domain.h"
#include "hyperbolic_layout.h"
#include "planar_layout.h"

namespace ricci {

/// The layout of the corners of the domain's surface in the plane: that of commonRefinement(), without
/// an overlay.
///
/// The vertices of the surface are those of the end triangulation. That is laid out, open along the
/// cut, whose edges, pulled tight, run through end triangles. Their normal coordinates tell into which
/// parts they divide these, and beside which edges of the cut the corners of the parts lie; a part is
/// a sheet as in end_sheets.h. A flow without flips ends on the surface's own triangles.
/// \param isCut 1 on edges of the domain's surface, which they open to a disk
/// \throw TooLarge if end edges and the cut cross too often, see requireOverlayMemory()
/// \pre the flow ran in the plane
PlanarLayout
layOutCorners(const FlowDomain& domain, const FlowResult& flow, const EdgeArray<char>& isCut);

/// The corners of a surface in the Poincaré disk, and what continues their layout across the cut.
struct DiskLayout
{
	PlanarLayout corners;
	EdgeArray<SidePairing> pairing; ///< [edge of the surface] known on the cut
};

/// The same for a flow in the hyperbolic plane, laid out by layOutInDisk().
DiskLayout
layOutCornersInDisk(const FlowDomain& domain, const FlowResult& flow, const EdgeArray<char>& isCut);

} // namespace ricci

#endif
