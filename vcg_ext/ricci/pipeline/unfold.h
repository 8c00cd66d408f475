// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_UNFOLD_H
#define RICCI_UNFOLD_H

#include "../charts/parametrization.h"
#include "../options.h"
#include "../surface/component.h"

#include <optional>

namespace ricci {

/// A map of a component in several charts without overlap, in the component's indices.
///
/// Where nearly all curvature of a surface lies at its creases, what is between them is its own flat metric,
/// and a flow that has to spread that curvature over the surface distorts what could lie flat. The component
/// is cut along its creases, each piece is mapped by itself with a free boundary, and the pieces are joined
/// across creases again where they have room: a crease carries no curvature, only its corners do, so that
/// joining distorts nothing. Creases are all edges above one of several angles, each of which is tried; the map
/// that costs least is taken (MapCost).
/// \param maxBetween share of the curvature that may be left between creases
/// \return none where more is left, there are no creases, or there is no memory for it (Task::memoryLimit())
/// \throw what the stages throw
std::optional<Parametrization>
unfold(const Component& component, const Options& options, double maxBetween);

} // namespace ricci

#endif
