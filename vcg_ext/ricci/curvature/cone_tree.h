// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONE_TREE_H
#define RICCI_CONE_TREE_H

#include "cone_model.h"
#include "cone_sites.h"

namespace ricci {

/// Moves cones towards each other where that shortens the minimum spanning tree that joins them by
/// paths along edges: the seams of a sphere. Distortion is flat around its minimum, so that much
/// length can be saved for little. A move has to lower the product of the tree's length and the root
/// of the distortion, and to keep the distortion at or below \p maxDistortion (see
/// ConeModel::distortion()).
void shortenConeTree(ConeModel& model, const ConeSites& sites, double maxDistortion);

} // namespace ricci

#endif
