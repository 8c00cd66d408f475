// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_OUTLINE_H
#define RICCI_OUTLINE_H

#include "../base/points.h"
#include "../layout/flat_mesh.h"

#include <array>
#include <complex>
#include <vector>

namespace ricci {

/// The border of a chart: straight sides from one point to the next, the chart on the left of each.
using Outline = std::vector<std::array<Point2, 2>>;

/// The sides of a chart's triangles, each taken counter-clockwise, except for two that are joined and run
/// opposite ways. A point off them is covered by as many triangles as they go round it.
Outline outlineOf(const FlatMesh& mesh, const std::vector<int>& triangles);

/// The turn that lays a chart along the axes whose outline runs in two perpendicular directions mostly: more than half
/// its length, to a degree. Else 0.
std::complex<double> uprightTurn(const Outline& outline);

/// Whether no point of a chart is nearer than \p padding > 0 to another chart, or in it, as far as doubles
/// tell.
bool keepApart(const std::vector<Outline>& outlines, double padding);

} // namespace ricci

#endif
