// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_END_SHEETS_H
#define RICCI_END_SHEETS_H

#include "../flow/ricci_flow.h"
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

} // namespace ricci

#endif
