// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_MAP_JUMPS_H
#define RICCI_MAP_JUMPS_H

#include "surface_mesh.h"

#include <vector>

namespace ricci {

/// Where a map that a mesh has jumps: it puts two faces at a vertex into different pictures, or there more than
/// kSameCoordinate of the widest extent of all coordinates apart. Two NaN are equal.
class MapJumps
{
public:
	/// \param map must outlive this
	explicit MapJumps(const std::vector<MappedFace>& map);

	/// Between corners of two faces at one vertex.
	bool operator()(Corner a, Corner b) const;

private:
	const std::vector<MappedFace>& m_map;
	double m_bound;
};

} // namespace ricci

#endif
