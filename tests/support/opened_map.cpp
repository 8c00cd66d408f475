// SPDX-License-Identifier: GPL-3.0-or-later
#include "opened_map.h"

#include "shapes.h"

#include <ricci/whole_map.h>

#include <utility>

namespace ricci::testing {

OpenedMap::OpenedMap(const SurfaceMesh& input, const VertexInput& values, const Options& options)
{
	WholeMap whole = chartsInPlane(input, values, options);
	map = std::move(whole.map);
	const OpenedMesh& opened = whole.opened;
	mesh = opened.mesh;
	for (const Face f : opened.reversed.indices())
		if (opened.reversed[f])
			std::swap(mesh.triangles[at(f)][1], mesh.triangles[at(f)][2]);
}

} // namespace ricci::testing
