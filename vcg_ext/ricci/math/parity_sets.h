// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PARITY_SETS_H
#define RICCI_PARITY_SETS_H

#include "../base/indexed.h"

#include <algorithm>

namespace ricci {

/// Partition of the elements 0 .. n - 1 in which any two members of one set have a known parity to
/// each other: 0 where they are alike, 1 where they are opposite, such as the orientations of faces
/// (union-find with path compression and the parities on the way).
class ParitySets
{
public:
	explicit ParitySets(int n) : m_parent(n), m_parity(n, 0)
	{
		for (int i = 0; i < n; ++i)
			m_parent[i] = i;
	}

	/// The lowest member of the set of \p i.
	int find(int i)
	{
		// First to the top, then everything on the way directly below it.
		int top = i;
		char parity = 0;
		while (m_parent[top] != top) {
			parity = static_cast<char>(parity ^ m_parity[top]);
			top = m_parent[top];
		}
		while (m_parent[i] != i) {
			const int next = m_parent[i];
			const char rest = static_cast<char>(parity ^ m_parity[i]);
			m_parent[i] = top;
			m_parity[i] = parity;
			parity = rest;
			i = next;
		}
		return top;
	}

	/// Parity of \p i to the lowest member of its set.
	char parity(int i)
	{
		find(i);
		return m_parity[i];
	}

	/// Unites the sets of \p a and \p b, whose parity to each other shall be \p parity.
	/// \return false, and nothing is done, if it is known to be the other
	bool merge(int a, int b, char parity)
	{
		const int x = find(a), y = find(b);
		const auto between = static_cast<char>(m_parity[a] ^ m_parity[b] ^ parity);
		if (x == y)
			return between == 0;
		const int low = std::min(x, y), high = std::max(x, y);
		m_parent[high] = low;
		m_parity[high] = between;
		return true;
	}

private:
	Array<int> m_parent;
	Array<char> m_parity; // to the parent
};

} // namespace ricci

#endif
