// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_OLD_CHARTS_H
#define RICCI_OLD_CHARTS_H

#include "../base/indexed.h"
#include "carry_texture.h"

#include <cstddef>
#include <vector>

namespace ricci {

/// [face] a number that the faces of one chart of the old map share: those that are joined by edges with
/// the same picture and coordinates on both sides.
std::vector<int> oldCharts(const std::vector<TexturedFace>& faces, const Tick& tick);

/// Old coordinates in texels, moved by whole pictures so that they start in the first one; 0 where they
/// are no numbers.
Triangle2 oldTexels(const TexturedFace& face, int width, int height);

/// Which chart each texel of one old picture belongs to: that in which its middle lies.
class OldOwners
{
public:
	OldOwners(
		const std::vector<TexturedFace>& faces,
		const std::vector<int>& charts,
		int picture,
		int width,
		int height,
		const Tick& tick);

	/// Whether a texel has colours of the chart. Those between charts, and those on the border of two,
	/// belong to none; those where charts overlap belong to all. A chart with a triangle larger than
	/// the picture has all of it.
	bool belongs(std::size_t texel, int chart) const
	{
		const int owner = m_owners[texel];
		return (owner | 1) == keyOf(chart) || owner == kOverlap ||
			   m_extents[positionOf(chart)] == All;
	}

	/// Whether the chart goes on across the border of the picture, at the opposite side of it.
	bool repeats(int chart) const { return m_extents[positionOf(chart)] != Inside; }

private:
	/// Of texels inside of a chart the even number before, of those on its border the key itself.
	static int keyOf(int chart) { return 2 * chart + 5; }

	static constexpr int kNone = 0, kBorderOfTwo = 1, kOverlap = 2;

	enum Extent : char { Inside, AcrossBorder, All };

	std::vector<int> m_owners;     // [texel]
	std::vector<Extent> m_extents; // [chart]
};

} // namespace ricci

#endif
