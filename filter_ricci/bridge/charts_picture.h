// SPDX-License-Identifier: GPL-3.0-or-later
// The charts of a map as they lie in the plane, for the report.
#ifndef FILTER_RICCI_CHARTS_PICTURE_H
#define FILTER_RICCI_CHARTS_PICTURE_H

#include <ricci/layout/flat_mesh.h>

#include <string>

namespace filter_ricci {

/// Cells on a side of the picture.
constexpr int kPictureSize = 400;

/// SVG: the square that holds all charts, v upwards, their outlines, and the colours of kPictureSize^2
/// cells, each that of the triangle at its middle: by the share of the triangle's area in the plane over
/// its share on the surface, from a quarter and less (blue) over 1 (grey) to 4 and more (red). So large
/// meshes need no more room than small ones.
std::string chartsPicture(const ricci::FlatMesh& map);

} // namespace filter_ricci

#endif
