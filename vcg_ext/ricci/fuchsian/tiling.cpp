// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiling.h"

#include "../base/tolerances.h"

#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

namespace ricci {

namespace {

/// Isometries by their images of 0 on the hyperboloid, in square cells as wide as the tolerance.
class TileIndex
{
public:
	/// \p tiles may grow later; numbers refer to it.
	explicit TileIndex(const std::vector<DiskIsometry>& tiles) : m_tiles(tiles) {}

	void insert(std::size_t tile) { m_cells.emplace(cellOf(m_tiles[tile]), tile); }

	bool contains(const DiskIsometry& m) const
	{
		const Cell centre = cellOf(m);
		for (std::int64_t i = -1; i <= 1; ++i)
			for (std::int64_t j = -1; j <= 1; ++j) {
				const auto range = m_cells.equal_range({centre.first + i, centre.second + j});
				for (auto known = range.first; known != range.second; ++known) {
					const DiskIsometry difference = m_tiles[known->second].inverse() * m;
					if (difference.distanceFromIdentity() < kSameTile)
						return true;
				}
			}
		return false;
	}

private:
	using Cell = std::pair<std::int64_t, std::int64_t>;

	static Cell cellOf(const DiskIsometry& m)
	{
		const std::complex<double> x = 2.0 * m.a * m.b;
		return {
			static_cast<std::int64_t>(std::floor(x.real() / kSameTile)),
			static_cast<std::int64_t>(std::floor(x.imag() / kSameTile))};
	}

	const std::vector<DiskIsometry>& m_tiles;
	std::multimap<Cell, std::size_t> m_cells;
};

} // namespace

Tiling tiling(const std::vector<DiskIsometry>& sides, int rings, int maxCount)
{
	Tiling result;
	result.deck.push_back(DiskIsometry());
	result.ring.push_back(0);
	TileIndex known(result.deck);
	known.insert(0);
	for (std::size_t next = 0; next < result.deck.size(); ++next) {
		if (result.ring[next] == rings)
			break;
		for (const DiskIsometry& side : sides) {
			const DiskIsometry m = (result.deck[next] * side).normalised();
			const double distance = m.displacement();
			// Farther out than any known tile a cell may have no number.
			const bool mayBeKnown = distance <= kMaxTileDistance + kSameTile;
			if (mayBeKnown && known.contains(m))
				continue;
			if (!(distance <= kMaxTileDistance) ||
				result.deck.size() >= static_cast<std::size_t>(maxCount)) {
				result.complete = false;
				continue;
			}
			result.deck.push_back(m);
			result.ring.push_back(result.ring[next] + 1);
			known.insert(result.deck.size() - 1);
		}
	}
	return result;
}

} // namespace ricci
