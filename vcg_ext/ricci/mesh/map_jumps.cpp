// SPDX-License-Identifier: GPL-3.0-or-later
#include "map_jumps.h"

#include "../base/tolerances.h"

#include <algorithm>
#include <cmath>

namespace ricci {

MapJumps::MapJumps(const std::vector<MappedFace>& map) : m_map(map)
{
	Box2 box;
	for (const MappedFace& face : map)
		for (const Point2& p : face.uv)
			if (std::isfinite(p[0]) && std::isfinite(p[1]))
				box.add(p);
	m_bound = kSameCoordinate * std::max(0.0, box.extent());
}

bool MapJumps::operator()(Corner a, Corner b) const
{
	const MappedFace &f = m_map[positionOf(a.face())], &g = m_map[positionOf(b.face())];
	const auto differ = [&](std::size_t k) {
		const double x = f.uv[a.index()][k], y = g.uv[b.index()][k];
		return !(std::abs(x - y) <= m_bound) && x != y && !(std::isnan(x) && std::isnan(y));
	};
	return f.picture != g.picture || differ(0) || differ(1);
}

} // namespace ricci
