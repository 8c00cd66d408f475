// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_MIRRORED_CONES_H
#define RICCI_MIRRORED_CONES_H

#include "cone_model.h"
#include "cone_placement.h"
#include "cone_sites.h"

#include <vector>

namespace ricci {

/// Puts other cones into \p model, and fits the curvatures of all.
void setCones(std::vector<Vertex> cones, ConeModel& model);

/// Where a surface is its own mirror image, puts the cones of one of its halves and their images in place of those of
/// \p model, if that costs hardly more (kMirrorPrice).
/// \param sites of \p model
/// \param roots [vertex of \p model] the vertex of the surface that it stands for; empty: itself
/// \param positions [vertex of the surface]
/// \return [cone of \p model] the vertex of the surface at which it lies
std::vector<Vertex> mirrorCones(
	const TargetRequest& request,
	const ConeSites& sites,
	const VertexArray<Vertex>& roots,
	const VertexArray<Point3>& positions,
	ConeModel& model);

/// Gives each cone and its image the mean of their curvatures, which rounding has made differ, where all cones have
/// images that are cones.
void mirrorCurvatures(const TargetRequest& request, PlacedCones& placed);

} // namespace ricci

#endif
