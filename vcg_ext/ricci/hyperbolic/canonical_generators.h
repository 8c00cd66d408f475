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

/// Of several canonical bases of one group the best conditioned, after each has been improved by
/// automorphisms that keep [a1,b1] ... [ag,bg] as an element of the free group:
///
///     a -> a b^+-1;  b -> b a^+-1;  (a, b) -> (a b a^-1, a^-1), (b^-1, b a b^-1);
///     h1 h2 -> (k1 h2 k1^-1) h1, h2 (k2^-1 h1 k2), where k is the commutator of the handle h;
///     a1 -> a1 c^-1, b1 -> c b1 c^-1, a2 -> c a2, c = (b1^-1 a2 b2 a2^-1)^+-1, a Dehn twist;
///
/// and on closed surfaces, where the product is the identity, by conjugation with a letter, which
/// takes another corner of the polygon to 0. The best move is taken while it lowers the condition by a
/// tenth or more, which bounds their number by its logarithm. Moves multiply large isometries, so the
/// relation is closed again after each by closeRelation().
///
/// The condition is by how much [a1,b1] ... [ag,bg] may change, in units of the relative rounding of the
/// letters: the sum of |p| |w| |q| over all letters w, where p is the product of the letters before w,
/// q = p w, and |m| = |a| + |b| = exp(d / 2) for an isometry that moves 0 by d. The p are the corners of
/// the canonical polygon, so this is large where the polygon reaches far out, as seen from 0. Where the
/// product of the letters behind is q^-1, except for isometries of bounded size, this is the first order of
/// the error.
///
/// As many bases are tried, the first ones, as keeps the work independent of the genus: 32 up to genus
/// 7, 16 on genus 10, at least one.
/// \param peripheral the elements behind the handles in the relation
/// \return nothing where each basis is left with a letter that moves 0 by more than
/// kMaxGeneratorDistance, or the relation is beyond what numbers hold
/// \pre all bases have the same number of handles; the relation holds except for rounding
Handles
bestConditioned(const std::vector<Handles>& bases, const std::vector<ExtendedIsometry>& peripheral);

} // namespace ricci

#endif
