// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_COVER_REPAIR_H
#define RICCI_COVER_REPAIR_H

#include "repair.h"

namespace ricci {

/// Mends triangles of charts in the Poincaré disk that are flipped or too low.
///
/// The triangles round one of them are laid out side by side across seams, as in the universal cover, where
/// they are or with that triangle at 0, and are untangled there as straight triangles (untangle.h). Every copy
/// of a point that has moved follows by the isometry that takes the layout to its chart, so that the sides of
/// seams stay congruent. Patches are taken one after another, and only where fewer triangles are wrong in the
/// charts afterwards.
/// \param rules cost is not asked
/// \param boundaryMoves whether points of the surface's boundary may move
Repair
repairInCover(FlatMesh& flat, const RepairRules& rules, bool boundaryMoves, WorkLimit& limit);

} // namespace ricci

#endif
