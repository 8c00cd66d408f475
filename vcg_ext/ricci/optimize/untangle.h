// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_UNTANGLE_H
#define RICCI_UNTANGLE_H

#include "../layout/flat_mesh.h"
#include "patches.h"
#include "rest_shape.h"
#include "validity.h"

#include <vector>

namespace ricci {

/// A patch whose triangles are to be valid, and as near to their rest shapes as its border lets them be.
struct PatchProblem
{
	const FlatMesh& flat;
	const PointGroups& groups;
	const Patch& patch;
	std::vector<RestShape> shapes; ///< [triangle of the patch]
	const Validity& validity;
	int maxSteps; ///< of Newton in all; then the search is over
};

/// What untangle() found.
struct Untangled
{
	/// [local point] Places, as they are stored, where all triangles are valid; empty if none were found.
	std::vector<Point2> points;
	int steps = 0; ///< of Newton
};

/// Moves the inner points of a patch until all its triangles are valid.
///
/// It minimises the sum over the triangles of w (|J|^2 + lambda (1 + det^2 J)) / chi(det J), where
/// J is the linear map from the rest shape, w its area, and chi(d) = (d + sqrt(eps^2 + d^2)) / 2 is
/// positive for flipped triangles, too. eps falls with them, and in the end only
/// positive determinants remain [Garanzha et al. 2021, Eq. 3]. The steps are Newton's, with each
/// triangle's Hessian made positive semidefinite: in terms of f_z and f_zbar its eigenvalues have
/// closed forms.
Untangled untangle(const PatchProblem& problem);

/// Lowers the same energy, with eps = 0, on a patch that is valid, which it stays.
Untangled ease(const PatchProblem& problem);

} // namespace ricci

#endif
