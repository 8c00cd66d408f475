// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_CLOSED_FLOWS_H
#define RICCI_TESTS_CLOSED_FLOWS_H

#include "flipped_flow.h"
#include "random_surface.h"
#include "shapes.h"

#include <vector>

namespace ricci::testing {

/// Flows on closed surfaces of genus 0, 1 and 2 that flip many edges, before the first step and after
/// it. Every vertex has a curvature of its own.
inline std::vector<FlippedFlow> closedFlows(Random& random)
{
	const std::vector<SurfaceMesh> meshes{
		shaken(perforatedSlab(0, 3), 0.15, random),
		bumpyTorus(12, 9, random),
		foldedTorus(3, 3, 0.1, random),
		shaken(perforatedSlab(2, 2), 0.15, random)};
	const int chi[] = {2, 0, 0, -2};
	std::vector<FlippedFlow> flows;
	for (std::size_t i = 0; i < meshes.size(); ++i) {
		const int vertices = static_cast<int>(meshes[i].positions.size());
		flows.emplace_back(
			meshes[i], prescribed(randomCurvature(vertices, chi[i], -4.0, 3.0, 1.0, random)));
	}
	return flows;
}

} // namespace ricci::testing

#endif
