// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PARAMETRIZATION_H
#define RICCI_PARAMETRIZATION_H

#include "../base/points.h"
#include "../report.h"
#include "flat_mesh.h"
#include "fuchsian_group.h"

#include <string>
#include <vector>

namespace ricci {

/// One component laid out by its own metric, or a part of one.
struct Chart
{
	FuchsianGroup group; ///< hyperbolic flow
	Box2 box;            ///< what packing has given it; hyperbolic flow: the square round its disk

	/// Hyperbolic flow, a part of a disk that is divided (divideDisks()): the chart in the middle, which has
	/// the group, and what takes its disk to that of the part. -1: itself.
	int middle = -1;
	ExtendedIsometry place;
};

/// A map of the whole mesh to the plane. Vertices and faces have the numbers of the opened mesh (see
/// OpenedMesh), and triangles the order in which they are counter-clockwise, until toInputIndices() gives
/// them those of the input.
struct Parametrization
{
	/// In the plane each chart from the origin, with its smallest bounding rectangle along the axes
	/// unless turns by right angles only are kept; in the disk as the group acts; until they are packed.
	FlatMesh mesh;
	std::vector<Chart> charts; ///< [FlatMesh::chart]
	Report report;
	std::vector<std::string> notes; ///< what was done or chosen without being asked
	/// [vertex of mesh] sigma1 / sigma2: area-weighted mean over the triangles at the vertex
	std::vector<double> vertexQC;
	std::vector<double> u;               ///< [vertex of the input] Eq. 6; 0 at unused vertices
	std::vector<double> targetCurvature; ///< [vertex of the input] radians, as reached
	std::vector<int> placedCones;        ///< vertices of the input at which cones were placed
};

} // namespace ricci

#endif
