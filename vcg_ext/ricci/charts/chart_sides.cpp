// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart_sides.h"

#include "../math/bucket_sort.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace ricci {

Array<int> sidesAcross(const DrawnChart& chart)
{
	struct Side
	{
		int low, high, number; // lower and higher vertex
		bool runsUp;           // from the lower one
	};
	std::vector<Side> sides;
	sides.reserve(3 * chart.triangles.values().size());
	for (const int i : chart.triangles.indices())
		for (int k = 0; k < 3; ++k) {
			const Triangle& t = chart.triangles[i];
			const int a = t[positionOf(k)], b = t[positionOf((k + 1) % 3)];
			sides.push_back({std::min(a, b), std::max(a, b), 3 * i + k, a < b});
		}
	bucketSort(
		sides,
		[](const Side& s) { return s.low; },
		[](const Side& s, const Side& t) {
			return s.high != t.high ? s.high < t.high : s.number < t.number;
		});
	Array<int> across(sides.size(), -1);
	for (auto first = sides.begin(), last = first; first != sides.end(); first = last) {
		while (last != sides.end() && last->low == first->low && last->high == first->high)
			++last;
		for (auto s = first; s + 1 < last; ++s) {
			const auto a = endsOf(chart, s->number), b = endsOf(chart, s[1].number);
			if (s->runsUp == s[1].runsUp || (last - first > 2 && (a[0] != b[1] || a[1] != b[0])))
				continue;
			across[s->number] = s[1].number;
			across[s[1].number] = s->number;
			++s;
		}
	}
	return across;
}

} // namespace ricci
