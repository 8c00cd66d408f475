// SPDX-License-Identifier: GPL-3.0-or-later
// What is drawn of a Fuchsian group.
#ifndef RICCI_TILING_H
#define RICCI_TILING_H

#include "../layout/parametrization.h"
#include "../numerics/disk_isometry.h"

#include <complex>
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

/// A fundamental polygon with geodesic sides whose corners are all one point of the surface. Side k
/// runs from corner k to corner k + 1 and is a copy of the closed curve of letter k of the
/// canonical relation a1 b1 a1^-1 b1^-1 ... e1 ... en. A closed surface of genus g has 4 g sides,
/// which are paired like the letters; the sides of the peripheral generators e_i have no partner.
struct CanonicalPolygon
{
	std::vector<std::complex<double>>
		corners;           ///< in the Poincaré disk, in the order of the relation
	bool isSimple = false; ///< no side crosses another
	double gap = 0.0;      ///< hyperbolic distance by which the last side misses the first corner
};

/// Computes the polygon for the base point p that minimizes the sum of cosh d(p, g p) over the
/// canonical generators g. On the hyperboloid this sum is the quadratic form -<p, g p>, and p is
/// its timelike eigenvector. The middle corner of the polygon is p itself, so that no corner is a
/// product of more than half of the letters.
///
/// Where the group has no canonical basis, or generators move points so far that rounding leaves a gap
/// above kMaxPolygonGap or takes corners out of the disk, the polygon has no corners.
CanonicalPolygon canonicalPolygon(const FuchsianGroup& group);

} // namespace ricci

#endif
