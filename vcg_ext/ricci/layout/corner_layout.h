// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CORNER_LAYOUT_H
#define RICCI_CORNER_LAYOUT_H

#include "../flow/ricci_flow.h"
#include "../mesh/component.h"
#include "hyperbolic_layout.h"
#include "planar_layout.h"

namespace ricci {

/// The end triangles as they are laid out. The cut runs on input edges, through end triangles: a
/// triangle that it divides is drawn once for each of its parts. A sheet is one such drawing, a whole
/// triangle of which only the pieces of one part are used.
struct EndSheets
{
	Triangulation triangulation; ///< its faces are the sheets, its vertices those of the end
	FaceArray<Face> endFace;   ///< [sheet] its end triangle, whose halfedges() have the same order
	Array<Face> of;            ///< [piece] its sheet, where there is an overlay
	EdgeArray<double> lengths; ///< of the sheets in the metric of the end
	HalfedgeArray<double> angles; ///< at the halfedge's origin
};

/// Gives the sheets the lengths and angles of their end triangles.
void takeMetric(const FlowResult& flow, EndSheets& sheets);

/// Lays the sheets out, see layOutInPlane() and layOutInDisk().
PlanarLayout layOutInPlane(const EndSheets& sheets, Face root = Face(0));
HyperbolicLayout layOutInDisk(const EndSheets& sheets);

/// A surface laid out in the plane or in the Poincaré disk, open along a cut.
struct SurfaceLayout
{
	PlanarLayout corners;           ///< of the surface's triangles
	EdgeArray<SidePairing> pairing; ///< [edge of the surface] in the disk: across the cut
	FlatMesh refinement;            ///< by layOutRefinement(); else empty
};

/// The layout of the corners of the domain's surface: that of layOutRefinement(), without an overlay.
///
/// The vertices of the surface are those of the end triangulation. That is laid out, open along the
/// cut, whose edges, pulled tight, run through end triangles. Their normal coordinates tell into which
/// parts they divide these, and beside which edges of the cut the corners of the parts lie; a part is
/// a sheet, see EndSheets. In the plane, a flow without flips ends on the surface's
/// own triangles.
/// \param isCut 1 on edges of the domain's surface, which they open to a disk
/// \throw TooLarge if end edges and the cut cross too often, see requireOverlayMemory()
SurfaceLayout
layOutCorners(const FlowDomain& domain, const FlowResult& flow, const EdgeArray<char>& isCut);

} // namespace ricci

#endif
