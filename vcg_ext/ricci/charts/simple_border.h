// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SIMPLE_BORDER_H
#define RICCI_SIMPLE_BORDER_H

#include "../layout/flat_mesh.h"

#include <vector>

namespace ricci {

/// Whether the border of a chart shows that the chart covers nothing twice: no triangle is flipped
/// or flat; the sides without a joined one form closed polygons that neither touch each other nor
/// themselves; and one of them alone goes round counter-clockwise. False where this cannot be seen so
/// easily.
///
/// The triangles that cover a point are as many as the border goes round it, because the two sides of
/// an edge inside the chart cancel: whatever the topology of the chart. A polygon of the border goes
/// round a point once or not at all, and where it runs clockwise it only takes away. Orientations are
/// exact, so this is.
/// \param chart its triangles, in increasing order
bool hasSimpleBorder(const FlatMesh& mesh, const std::vector<int>& chart);

} // namespace ricci

#endif
