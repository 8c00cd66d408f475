// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_DRAWN_MESH_H
#define RICCI_TESTS_DRAWN_MESH_H

#include "support/shapes.h"

#include <ricci/charts/chart_overlap.h>

namespace ricci::testing {

/// A mesh over the plane: its own x and y are its place there.
inline DrawnChart drawn(const SurfaceMesh& mesh)
{
	DrawnChart chart;
	chart.triangles = Array<Triangle>(mesh.triangles);
	for (const Triangle& t : mesh.triangles) {
		Triangle2 p;
		for (std::size_t k = 0; k < 3; ++k)
			p[k] = {mesh.positions[at(t[k])][0], mesh.positions[at(t[k])][1]};
		chart.plane.push_back(p);
	}
	return chart;
}

} // namespace ricci::testing

#endif
