// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_EDGE_ORDER_H
#define RICCI_EDGE_ORDER_H

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ricci {

/// Puts sides of triangles in order of their edges: by the number \c low of the one end, then by
/// \c high > \c low of the other. Sides of one edge stay in the order that they have. By counting, in
/// time proportional to the sides and the highest number.
template<class Side>
void sortByEdge(std::vector<Side>& sides)
{
	int highest = -1;
	for (const Side& s : sides)
		highest = std::max(highest, s.high);
	std::vector<std::size_t> first;
	std::vector<Side> sorted(sides.size());
	for (const auto end : {&Side::high, &Side::low}) {
		const auto number = [&](const Side& s) { return static_cast<std::size_t>(s.*end); };
		first.assign(static_cast<std::size_t>(highest + 2), 0);
		for (const Side& s : sides)
			++first[number(s) + 1];
		for (std::size_t v = 1; v < first.size(); ++v)
			first[v] += first[v - 1];
		for (const Side& s : sides)
			sorted[first[number(s)]++] = s;
		sides.swap(sorted);
	}
}

} // namespace ricci

#endif
