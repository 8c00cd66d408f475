// SPDX-License-Identifier: GPL-3.0-or-later
// Components of a mesh that have no hyperbolic metric, such as loose bolts beside a body with handles.
#ifndef RICCI_LEFT_OUT_H
#define RICCI_LEFT_OUT_H

#include "layout/parametrization.h"
#include "mesh/component.h"
#include "parametrize.h"

#include <vector>

namespace ricci {

/// Takes out of \p components, where there are several, those on which no metric of curvature -1 has the target
/// (Gauss-Bonnet), and those without a selected vertex where cones are asked for at selected vertices.
/// \param input of the vertices of \p opened
/// \return what was taken out
/// \throw if that is all: InadmissibleCurvature or InvalidOption, of the largest component
std::vector<Component> leaveOut(
	const OpenedMesh& opened,
	const VertexInput& input,
	const HyperbolicTargetOptions& options,
	std::vector<Component>& components);

/// Adds a packed map of components that were taken out to that of the others, as one chart more: in the square
/// inscribed in a disk of its own, and open along its seams, which are no isometries of the disk.
/// \param leftOut in the unit square
/// \param map before placeDisks()
void addBeside(Parametrization leftOut, Parametrization& map);

} // namespace ricci

#endif
