// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_COMMON_REFINEMENT_H
#define RICCI_COMMON_REFINEMENT_H

#include "../flow/ricci_flow.h"
#include "../overlay/piece_faces.h"
#include "../surface/flow_domain.h"
#include "flat_mesh.h"
#include "hyperbolic_layout.h"
#include "planar_layout.h"

namespace ricci {

/// The overlay of the triangles of the input, of the start and of the end of a flow with flips, laid
/// out in the plane: every piece lies in one triangle of each, and the map to the plane is the flow's
/// own there.
struct CommonRefinement
{
	FlatMesh mesh;            ///< its vertices are the surface's, then the points where edges cross
	PlanarLayout inputLayout; ///< of the corners of the surface's triangles
	EdgeArray<SidePairing> pairing; ///< [edge of the surface] hyperbolic: across the cut
};

/// The overlay (overlay_pieces.h) for the faces of the domain's surface. Where the flow's surface goes on
/// beyond it (its double, caps on holes), the overlay ends at its boundary.
/// It takes the first half of the task in hand.
/// \pre the flow ran with intrinsic flips
LinkedPieces overlayOf(const FlowDomain& domain, const FlowResult& flow);

/// Lays the overlay \p linked of \p flow out, cut along the surface's edges with \p isCut.
///
/// Positions: affine on the input's faces; in the plane by the projective map of the decorated
/// discrete conformal equivalence, b'_i ~ b_i exp(-(u_i - u0_i)) between a start triangle and an
/// end triangle with the same vertices [Springborn Schroeder Pinkall 2008], [Bobenko Lutz 2023];
/// on the refinement it is continuous across all edges [Gillespie Springborn Crane 2021].
///
CommonRefinement commonRefinement(
	const FlowDomain& domain,
	const FlowResult& flow,
	LinkedPieces linked,
	const EdgeArray<char>& isCut);

} // namespace ricci

#endif
