// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_REPAIR_H
#define RICCI_REPAIR_H

#include "../layout/flat_mesh.h"
#include "patches.h"
#include "point_groups.h"
#include "rest_shape.h"
#include "soundness.h"
#include "work_limit.h"

#include <functional>
#include <vector>

namespace ricci {

/// What repair() has done.
struct Repair
{
	Array<char> moved; ///< [point] 1 where the repair moved it; empty where nothing was to be done
	int bad = 0;       ///< triangles that were not sound before
	int left = 0;      ///< and after

	int movedCount() const;
	/// Takes over what a second repair of the same mesh has done.
	void add(const Repair& next);
};

/// Triangles of \p flat that are not sound.
std::vector<int> badTriangles(const FlatMesh& flat, const Soundness& soundness);

/// Whether a patch may be as it is in the map; called one after another.
using PatchTest = std::function<bool(const FlatMesh& flat, const Patch& patch)>;

/// Which patches are tried, and which are taken over.
struct PatchRules
{
	int maxRings;                ///< of the largest patches
	PatchTest accepts = nullptr; ///< a patch that it refuses stays as it was
	bool partly = false;         ///< patches, too, of which a part was mended
};

/// Mends the triangles that are not sound: moves points near them, and no others.
///
/// Patches of 1, 2, 3, 5, 8, ... rings round clusters of bad triangles are untangled
/// (untangle.h) until one holds, or until the limit's share of a stage is spent; triangles that no patch
/// mends stay as they are. Patches of one size move no triangle of each other, so they are solved side by
/// side, and the result does not depend on the number of threads.
Repair repair(
	FlatMesh& flat,
	const PointGroups& groups,
	RestShapes shapes,
	const Soundness& soundness,
	const PatchRules& rules,
	WorkLimit& limit);

/// What may move beyond the points inside the charts.
struct BorderMoves
{
	SeamGeometry seams = SeamGeometry::Plane;
	std::function<bool(int vertex)> boundary; ///< whether the boundary moves freely there
	PatchTest accepts; ///< a patch that is not sound, only better, may reach beyond its chart
};

/// repair() in stages, each for what the one before has left: the points inside the charts; the copies
/// of seam vertices together, and the boundary where it is free; the boundary everywhere; this again,
/// with patches of which only a part is mended, for a map of the surface to the plane only if nothing is
/// left then; and, for coordinates stored as floats and not as text,
/// once more with patches whose triangles share their area as they do on the surface.
Repair repairInStages(
	FlatMesh& flat,
	const BorderMoves& moves,
	RestShapes shapes,
	const Soundness& soundness,
	WorkLimit& limit);

/// The same where seams need not stay isometric: the points inside the charts; then all points, each
/// by itself; this again, with patches of which only a part is mended.
Repair repairFreely(
	FlatMesh& flat,
	const PatchTest& accepts,
	RestShapes shapes,
	const Soundness& soundness,
	WorkLimit& limit);

} // namespace ricci

#endif
