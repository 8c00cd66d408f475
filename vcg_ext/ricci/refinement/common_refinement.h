// SPDX-License-Identifier: GPL-3.0-or-later
// The folder refinement: the common subdivision of the mesh and of the start and the end of the flow. Maps that
// keep the mesh never come here.
#ifndef RICCI_COMMON_REFINEMENT_H
#define RICCI_COMMON_REFINEMENT_H

#include "../layout/corner_layout.h"
#include "overlay_pieces.h"

namespace ricci {

/// The layout of the overlay \p pieces of the triangles of the input, of the start and of the end of \p flow, cut
/// along the surface's edges with \p isCut: every piece lies in one triangle of each, and the map to the plane or
/// the disk is the flow's own there. The vertices of the refinement are the surface's, then the points where
/// edges cross.
///
/// Positions: affine on the input's faces; in the plane by the projective map of the decorated
/// discrete conformal equivalence, b'_i ~ b_i exp(-(u_i - u0_i)) between a start triangle and an
/// end triangle with the same vertices [Springborn Schroeder Pinkall 2008], [Bobenko Lutz 2023];
/// on the refinement it is continuous across all edges [Gillespie Springborn Crane 2021].
/// \pre the flow ran with intrinsic flips
SurfaceLayout layOutRefinement(
	const FlowDomain& domain,
	const FlowResult& flow,
	OverlayPieces pieces,
	const EdgeArray<char>& isCut);

} // namespace ricci

#endif
