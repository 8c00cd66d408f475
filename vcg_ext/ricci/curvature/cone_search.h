// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONE_SEARCH_H
#define RICCI_CONE_SEARCH_H

#include "cone_model.h"
#include "cone_sites.h"

namespace ricci {

/// Places the ConeModel::minSize() cones that the total curvature needs: one after another where
/// equal shares of it gain most, the rest of the total on the whole surface by area.
void startCones(ConeModel& model, const ConeSites& sites);

/// Places one more cone where it gains most, and fits all curvatures anew (a step of orthogonal
/// matching pursuit [Pati Rezaiifar Krishnaprasad 1993]).
/// \return false if no vertex is left
bool addCone(ConeModel& model, const ConeSites& sites);

/// Takes every cone in turn out and puts it where it gains most, or moves it down the gradient, in
/// several rounds, while that lowers the energy.
void relocateCones(ConeModel& model, const ConeSites& sites);

/// Takes the cones that are needed least out, one after another, while the others can move so that
/// the distortion stays below \p distortion.
void dropCones(ConeModel& model, const ConeSites& sites, double distortion);

/// Takes out cones that are too weak to be worth a seam, down to ConeModel::minSize().
void removeWeakCones(ConeModel& model);

} // namespace ricci

#endif
