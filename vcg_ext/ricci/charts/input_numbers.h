// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_INPUT_NUMBERS_H
#define RICCI_INPUT_NUMBERS_H

#include "parametrization.h"

#include <cstddef>

namespace ricci {

/// Gives a map of an opened mesh the numbers of its input; opened is
/// emptied, the report stays. To be called last, once nothing asks any more which triangles are glued.
///
/// A vertex takes the mean of its copies' distortion, weighted by the area of their faces, the
/// curvature and u of the vertex itself. The refinement's points at copies become the vertex, and so
/// does a degenerate face's corner: it is drawn as a line or a point at corners of a face with which it
/// shares an edge, or else a vertex, so that its three points lie on one line; as the point 0 if there
/// is none. Degenerate faces belong to no chart and become triangles of the refinement, too.
/// \param mesh the input
void toInputNumbers(const SurfaceMesh& mesh, Parametrization& map);

} // namespace ricci

#endif
