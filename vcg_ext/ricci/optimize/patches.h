// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PATCHES_H
#define RICCI_PATCHES_H

#include "../base/adjacency.h"
#include "../layout/flat_mesh.h"
#include "point_groups.h"

#include <vector>

namespace ricci {

/// A part of a flat mesh whose inner points may move while everything round it stays.
struct Patch
{
	std::vector<int> triangles; ///< of the mesh, in increasing order
	std::vector<int> points;    ///< of the mesh: [local point]
	Array<Triangle> corners;    ///< [triangle of the patch] local points
	Array<int> variable;        ///< [local point] the group that moves it, or -1
	int variables = 0;          ///< groups all of whose triangles are in the patch

	/// Whether nothing holds it: all points move, each by itself.
	bool isFree() const { return variables == static_cast<int>(points.size()); }
};

/// All triangles; every point moves.
Patch wholePatch(const FlatMesh& flat);

/// Finds patches in one flat mesh.
class PatchFinder
{
public:
	PatchFinder(const FlatMesh& flat, const PointGroups& groups);

	/// The patches that \p rings rings round \p seeds make, k rings being the triangles that the
	/// points of k - 1 rings belong to. Patches that meet in a point are one. So no variable of one
	/// patch moves a triangle of another. A seed with no point that moves makes no patch.
	/// \return the patches in the order of their lowest triangles, those without variables left out
	std::vector<Patch> patches(const std::vector<int>& seeds, int rings);

private:
	Patch makePatch(std::vector<int> triangles);

	const FlatMesh& m_flat;
	const PointGroups& m_groups;
	Adjacency<int, int> m_trianglesOf; // [group] a triangle once for each of its corners
	Array<char> m_taken;               // [triangle] scratch, 0 between calls
	Array<int> m_local;                // [point] scratch, -1 between calls
	Array<int> m_number, m_count;      // [group] scratch, -1 and 0 between calls
};

} // namespace ricci

#endif
