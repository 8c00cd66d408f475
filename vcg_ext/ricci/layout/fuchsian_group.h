// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FUCHSIAN_GROUP_H
#define RICCI_FUCHSIAN_GROUP_H

#include "../mesh/elements.h"
#include "../numerics/disk_isometry.h"

#include <cstddef>
#include <vector>

namespace ricci {

/// The deck transformations of the universal cover of a hyperbolic surface, which is the quotient
/// of the disk by them, with the conjugation in which the layout of the surface cut open sees them.
struct FuchsianGroup
{
	/// a1, b1, ..., ag, bg: a canonical basis, if asked for. With [a,b] = a b a^-1 b^-1,
	/// [a1,b1] ... [ag,bg] e1 ... en = +-1.
	std::vector<DiskIsometry> handles;

	/// e1, ..., en: one generator for each boundary loop and each cone, in the order of the
	/// relation. A geodesic boundary of length L has |trace| = 2 cosh(L / 2); a cone of angle t is
	/// a rotation, |trace| = 2 |cos(t / 2)| [Beardon 1983].
	std::vector<DiskIsometry> peripheral;
	std::vector<Vertex> peripheralVertex; ///< for each of them a vertex of the loop, or the cone

	/// The canonical relation letter by letter, a1, b1, a1^-1, b1^-1, ..., e1, ..., en, in extended
	/// precision: the last place of a double is magnified by the condition (see bestConditioned()). Empty
	/// where it was not asked for, or moves points too far (see kMaxGeneratorDistance).
	std::vector<ExtendedIsometry> relation;

	bool isCanonical() const { return !relation.empty(); }

	/// a1, b1, ..., ag, bg, e1, ..., en: the letters of the relation, each once.
	std::vector<ExtendedIsometry> generators() const
	{
		std::vector<ExtendedIsometry> result;
		const std::size_t commutators = 2 * handles.size(); // letters
		for (std::size_t i = 0; i < relation.size(); ++i)
			if (i >= commutators || i % 4 < 2)
				result.push_back(relation[i]);
		return result;
	}

	/// Side pairings of the polygon into which the cut opens the surface, each followed by its
	/// inverse: they take the fundamental domain to its neighbours. One pair for each arc of the
	/// cut.
	std::vector<DiskIsometry> sides;

	/// Holonomy that the layout leaves round the corner of the polygon, as seen from 0: largest
	/// entry of the difference of the relation of the polygon from +-1. From there rounding looks
	/// larger by the exponential of the distances on the way; closingError() does without them.
	double polygonError = 0.0;
	/// The same for the loops round each single regular vertex at which the cut branches or ends.
	double closingError = 0.0;

	/// Largest entry of the difference of the canonical relation from +-1, in extended precision.
	/// Its generators have been moved by about polygonError so that the relation holds. It multiplies
	/// large isometries, so that rounding leaves more of it where the genus is higher or the surface
	/// longer: 2^-101 of the condition (see bestConditioned()), to the order of magnitude.
	double relationError = 0.0;
};

} // namespace ricci

#endif
