// SPDX-License-Identifier: GPL-3.0-or-later
// Words in the generators of a group of isometries of the disk, and their canonical form.
#ifndef RICCI_CANONICAL_GENERATORS_H
#define RICCI_CANONICAL_GENERATORS_H

#include "../base/indexed.h"
#include "../numerics/disk_isometry.h"

#include <vector>

namespace ricci {

/// A generator or its inverse.
struct GroupLetter
{
	int generator;
	bool inverse;
};

using GroupWord = std::vector<GroupLetter>;

/// a1, b1, ..., ag, bg.
using Handles = std::vector<ExtendedIsometry>;

/// Product of the letters of \p word.
ExtendedIsometry productOf(const GroupWord& word, const Array<ExtendedIsometry>& generators);

/// Canonical generators a1, b1, ..., ag, bg of the surface whose fundamental polygon has the sides
/// \p word: [a1,b1] ... [ag,bg] is the product of \p word. There are many; these move 0 least.
///
/// The polygon is cut and glued as in the classification of surfaces [Seifert Threlfall 1934],
/// one handle at a time:
///
///     x P y Q x^-1 R y^-1 S = c [a,b] P S R Q c^-1,  c = R Q,  a = c^-1 x,  b = P y Q.
///
/// Products of large isometries lose digits. Of the many ways to read the word, those whose
/// isometries move 0 least are therefore followed: 64 of them at the same time up to genus 25, and
/// fewer beyond, which bounds the work of one handle.
/// \pre \p word has every generator once and its inverse once
/// \return one basis for each way that is followed to its end, the one that moves 0 least first;
/// nothing where all move 0 by more than kMaxSearchedDistance
/// \throw InternalError if \p word is not that of a polygon whose corners are all one point
std::vector<Handles>
canonicalBases(const GroupWord& word, const Array<ExtendedIsometry>& generators);

/// Moves \p generators by as little as possible (in the sum of squares, on the Lie algebra) so that
/// the product of \p word times \p tail is +-1. The metric holds more rounding than this
/// arithmetic, and the canonical generators are long words in which it would grow.
void closeRelation(
	const GroupWord& word, const ExtendedIsometry& tail, Array<ExtendedIsometry>& generators);

} // namespace ricci

#endif
