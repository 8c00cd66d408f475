// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SHARED_EDGES_H
#define RICCI_SHARED_EDGES_H

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ricci {

/// Calls \p visit(a, b) for the two sides of every edge that exactly two triangles share. A side has
/// the numbers \c low < \c high of its ends, and is one of \p sides for each triangle that it belongs
/// to; \p sides is sorted.
template<class Side, class Visit>
void forSharedEdges(std::vector<Side>& sides, Visit visit)
{
	std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
		return a.low != b.low ? a.low < b.low : a.high < b.high;
	});
	for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
		end = i;
		while (end < sides.size() && sides[end].low == sides[i].low &&
			   sides[end].high == sides[i].high)
			++end;
		if (end - i == 2)
			visit(sides[i], sides[i + 1]);
	}
}

} // namespace ricci

#endif
