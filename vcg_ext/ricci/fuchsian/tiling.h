// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TILING_H
#define RICCI_TILING_H

#include "../math/disk_isometry.h"

#include <vector>

namespace ricci {

/// Copies of a fundamental domain in the disk.
struct Tiling
{
	std::vector<DiskIsometry> deck; ///< the domain to its copies, the identity first
	std::vector<int> ring;          ///< of each copy: how many sides lie between it and the domain
	bool complete = true; ///< false if the largest number, or the resolution of the disk, ended it
};

/// The copies of the fundamental domain in \p rings rings round it: ring 1 has the copies that
/// share a side with it, ring 2 those that share one with ring 1, and so on.
/// \param sides side pairings of the domain (FuchsianGroup::sides)
/// \param maxCount no more copies than this, the domain itself included
Tiling tiling(const std::vector<DiskIsometry>& sides, int rings, int maxCount);

} // namespace ricci

#endif
