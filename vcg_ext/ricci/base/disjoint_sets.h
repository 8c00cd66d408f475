// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_DISJOINT_SETS_H
#define RICCI_DISJOINT_SETS_H

#include "indexed.h"

#include <algorithm>

namespace ricci {

/// Partition of the elements 0 .. n - 1, which starts with a set for each of them. \p I is the type
/// of their indices. The lowest member stands for its set, so that the representatives depend on
/// the partition alone, not on the order of the merges (union-find with path halving,
/// [Tarjan van Leeuwen 1984]).
template<class I>
class DisjointSetsOf
{
public:
	explicit DisjointSetsOf(int n) : m_parent(n)
	{
		for (const I i : m_parent.indices())
			m_parent[i] = i;
	}

	int size() const { return m_parent.size(); }

	/// The lowest member of the set of \p i.
	I find(I i)
	{
		while (m_parent[i] != i)
			i = m_parent[i] = m_parent[m_parent[i]];
		return i;
	}

	/// Unites the sets of \p a and \p b.
	/// \return whether they were two
	bool merge(I a, I b)
	{
		a = find(a), b = find(b);
		m_parent[std::max(a, b)] = std::min(a, b);
		return a != b;
	}

private:
	IndexedArray<I, I> m_parent; // never above its element
};

/// The same on plain numbers.
using DisjointSets = DisjointSetsOf<int>;

/// Partition of the elements 0 .. n - 1 in which any two members of one set have a known parity to
/// each other: 0 where they are alike, 1 where they are opposite, such as the orientations of faces.
class ParitySets
{
public:
	explicit ParitySets(int n) : m_sets(2 * n) {}

	/// The lowest member of the set of \p i.
	int find(int i) { return m_sets.find(2 * i) / 2; }

	/// Parity of \p i to the lowest member of its set.
	char parity(int i) { return static_cast<char>(m_sets.find(2 * i) % 2); }

	/// Unites the sets of \p a and \p b, whose parity to each other shall be \p parity.
	/// \return false, and nothing is done, if it is known to be the other
	bool merge(int a, int b, char parity)
	{
		if (m_sets.find(2 * a) == m_sets.find(2 * b + 1 - parity))
			return false;
		m_sets.merge(2 * a, 2 * b + parity);
		m_sets.merge(2 * a + 1, 2 * b + 1 - parity);
		return true;
	}

private:
	DisjointSets m_sets; // of 2 i: i as it is, and 2 i + 1: its opposite
};

} // namespace ricci

#endif
