// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_BLOCKS_H
#define RICCI_BLOCKS_H

#include <algorithm>
#include <cstddef>

namespace ricci {

/// 2^level texels in each direction, the x-th from the left and the y-th from the top.
struct Block
{
	int level, x, y;
};

/// The blocks of a picture. Those at its right and lower border may be cut off there.
struct Blocks
{
	int width, height; ///< of the picture

	int across(int level) const { return ((width - 1) >> level) + 1; }
	int down(int level) const { return ((height - 1) >> level) + 1; }

	/// The level of the block that is the whole picture.
	int lastLevel() const
	{
		int level = 0;
		while (across(level) > 1 || down(level) > 1)
			++level;
		return level;
	}

	std::size_t index(const Block& b) const
	{
		return static_cast<std::size_t>(b.y) * static_cast<std::size_t>(across(b.level)) +
			   static_cast<std::size_t>(b.x);
	}

	/// Number of texels.
	double texels(const Block& b) const
	{
		const int side = 1 << b.level;
		return static_cast<double>(std::min(side, width - b.x * side)) *
			   std::min(side, height - b.y * side);
	}

	/// The texel next to the middle.
	Block middle(const Block& b) const
	{
		const int side = 1 << b.level;
		return {
			0,
			std::min(b.x * side + side / 2, width - 1),
			std::min(b.y * side + side / 2, height - 1)};
	}

	/// visit(part) for the up to four blocks of the level below that a block consists of.
	template<class Visit>
	void forParts(const Block& b, const Visit& visit) const
	{
		const int level = b.level - 1;
		for (int y = 2 * b.y; y < std::min(2 * b.y + 2, down(level)); ++y)
			for (int x = 2 * b.x; x < std::min(2 * b.x + 2, across(level)); ++x)
				visit(Block{level, x, y});
	}

	/// visit(block) in the order of index().
	template<class Visit>
	void forLevel(int level, const Visit& visit) const
	{
		for (int y = 0; y < down(level); ++y)
			for (int x = 0; x < across(level); ++x)
				visit(Block{level, x, y});
	}
};

} // namespace ricci

#endif
