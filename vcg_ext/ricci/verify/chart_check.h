// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CHART_CHECK_H
#define RICCI_CHART_CHECK_H

#include "../layout/flat_mesh.h"

namespace ricci {

/// Number of pairs of border sides of one chart, those without a joined one, that cross deeper than \p
/// depth: every end lies farther than that from the line of the other side. A chart without flipped
/// triangles whose border does not cross itself covers no region partly twice.
int borderCrossings(const FlatMesh& chart, double depth);

} // namespace ricci

#endif
