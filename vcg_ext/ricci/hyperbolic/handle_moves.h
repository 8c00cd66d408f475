// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_HANDLE_MOVES_H
#define RICCI_HANDLE_MOVES_H

#include "canonical_generators.h"

#include <vector>

namespace ricci {

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
/// relation is closed anew after each by closeRelation().
///
/// The condition is by how much [a1,b1] ... [ag,bg] may change, in units of the relative rounding of the
/// letters: the sum of |p| |w| |q| over all letters w, where p is the product of the letters before w,
/// q = p w, and |m| = |a| + |b| = exp(d / 2) for an isometry that moves 0 by d. The p are the corners of
/// the canonical polygon, so this is large where the polygon reaches far out, as seen from 0. Where the
/// product of the letters behind is q^-1, but for isometries of bounded size, this is the first order of
/// the error.
///
/// As many bases are tried, the first ones, as keeps the work independent of the genus: 32 up to genus
/// 7, 16 on genus 10, at least one.
/// \param peripheral the elements behind the handles in the relation
/// \return nothing where each basis is left with a letter that moves 0 by more than
/// kMaxGeneratorDistance, or the relation is beyond what numbers hold
/// \pre all bases have the same number of handles; the relation holds but for rounding
Handles
bestConditioned(const std::vector<Handles>& bases, const std::vector<ExtendedIsometry>& peripheral);

} // namespace ricci

#endif
