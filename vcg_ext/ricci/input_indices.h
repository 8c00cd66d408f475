// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_INPUT_INDICES_H
#define RICCI_INPUT_INDICES_H

#include "layout/parametrization.h"
#include "mesh/opened_mesh.h"

namespace ricci {

/// Gives a map of an opened mesh the indices of its input, and its triangles the input's order and orders
/// of corners. To be called last, once nothing asks any more which triangles are glued.
///
/// Vertices that were joined (OpenedMesh::joined) have the values of the one, and each face its own of them again.
///
/// A vertex takes the mean of its copies' distortion, weighted by the area of their faces, and the
/// curvature and u of the vertex itself. The refinement's points at copies become the vertex. Degenerate
/// faces become triangles of no chart: such a face lies at corners of a face with which it shares an edge,
/// or else a vertex, so that its three points are on one line; at the point 0 if there is none.
void toInputIndices(const SurfaceMesh& input, const OpenedMesh& opened, Parametrization& map);

} // namespace ricci

#endif
