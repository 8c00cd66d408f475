// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_COMMON_REFINEMENT_H
#define RICCI_COMMON_REFINEMENT_H

#include "../flow/ricci_flow.h"
#include "../overlay/piece_faces.h"
#include "../surface/flow_domain.h"
#include "../surface/surface_mesh.h"
#include "flat_mesh.h"
#include "hyperbolic_layout.h"
#include "planar_layout.h"

#include <cstddef>
#include <vector>

namespace ricci {

/// The overlay of the triangles of the input, of the start and of the end of a flow with flips, laid
/// out in the plane: every piece lies in one triangle of each, and the map to the plane is the flow's
/// own there.
struct CommonRefinement
{
	std::vector<SurfacePoint> points; ///< the surface's vertices first, in order; its vertices
	std::vector<Triangle> triangles;  ///< into points, the surface's orientation
	std::vector<Face> inputFace;      ///< [triangle]
	std::vector<Triangle2> uv;        ///< [triangle][corner] in the plane or Poincaré disk
	EdgeArray<SidePairing> pairing;   ///< [edge of the surface] hyperbolic: across the cut
	PlanarLayout inputLayout;         ///< of the corners of the surface's triangles
	std::size_t crossings = 0;        ///< points that are not vertices of the surface
};

/// Its triangles, joined where they lie on each other.
FlatMesh flatMeshOf(const EmbeddedSurface& surface, const CommonRefinement& refinement);

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
