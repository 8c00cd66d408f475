// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SEPARATE_CHARTS_H
#define RICCI_SEPARATE_CHARTS_H

#include "parametrize.h"

#include <functional>

namespace ricci {

/// Counts the charts of \p map, those of them that cover a part of the plane more than once, and
/// their faces (see overlappingPairs()), on the triangles of the output: the refinement's where
/// there is one. With \p resolve such charts are replaced by the parts of divideChart(), each with
/// its least bounding rectangle along the axes, from the origin; the report then counts no overlap,
/// and the edges that were cut, whose length is added to that of the seams. Faces of the input go
/// with their first piece. \p tick: see overlappingPairs().
void separateCharts(
	const SurfaceMesh& mesh, bool resolve, const std::function<void()>& tick, Parametrization& map);

} // namespace ricci

#endif
