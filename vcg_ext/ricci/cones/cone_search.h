// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONE_SEARCH_H
#define RICCI_CONE_SEARCH_H

#include "cone_model.h"
#include "cone_sites.h"

namespace ricci {

/// Places the ConeModel::minSize() cones that the total curvature needs: one after another where
/// equal shares of it gain most, the rest of the total on the whole surface by area.
void startCones(ConeModel& model, const ConeSites& sites);

/// Places one more cone where it gains most, and others where they gain most of all places around, \p
/// count at most; then fits all curvatures again (a step of orthogonal matching pursuit
/// [Pati Rezaiifar Krishnaprasad 1993]).
/// \return false if no vertex is left
bool addCones(ConeModel& model, const ConeSites& sites, int count = 1);

/// Takes every cone in turn out and puts it where it gains most, or moves it down the gradient, in
/// \p rounds at most, while that lowers the energy.
void relocateCones(ConeModel& model, const ConeSites& sites, int rounds = 5);

/// Takes the cones that are needed least out, one after another, while the others can move so that
/// the distortion stays below \p distortion.
void dropCones(ConeModel& model, const ConeSites& sites, double distortion);

/// Takes cones out that save less energy than they and their seams cost, see MapCost.
/// \param tree of the cones
/// \return whether there were any
bool dropCostlyCones(ConeModel& model, SeamTree& tree);

/// Takes out cones that are too weak to be worth a seam, down to ConeModel::minSize().
void removeWeakCones(ConeModel& model);

/// Moves cones towards the tree of their seams where that lowers the energy of the map and the price of
/// its seams together (see MapCost), in several rounds, and keeps the distortion (see
/// ConeModel::distortion()) at or below \p maxDistortion.
/// \param tree of the cones of \p model
void shortenConeTree(
	ConeModel& model, SeamTree& tree, const ConeSites& sites, double maxDistortion);

} // namespace ricci

#endif
