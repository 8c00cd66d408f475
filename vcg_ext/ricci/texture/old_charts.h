// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_OLD_CHARTS_H
#define RICCI_OLD_CHARTS_H

#include "../base/indexed.h"
#include "carry_texture.h"

#include <array>
#include <cstddef>
#include <vector>

namespace ricci {

/// [face] a number that the faces of one chart of the old map share: those that are joined by edges with
/// the same picture and coordinates on both sides.
std::vector<int> oldCharts(const std::vector<TexturedFace>& faces);

/// Old coordinates in texels, moved by whole pictures so that they start in the first one; 0 where they
/// are not numbers.
Triangle2 oldTexels(const TexturedFace& face, int width, int height);

/// Which chart each texel of one old picture belongs to: that in which its middle lies.
class OldOwners
{
public:
	/// \param shown the faces with this picture
	OldOwners(
		const std::vector<TexturedFace>& faces,
		const std::vector<int>& charts,
		const std::vector<int>& shown,
		int width,
		int height);

	/// Charts over one texel, in the mean, that are told apart; more would take the time of the faces
	/// times that of the picture.
	static constexpr std::size_t kMaxLayers = 16;

	/// Looks at the blocks of levels up to \p last, too.
	void addLevels(int last);

	/// How much of a block has colours of a chart.
	enum class Share { None, Part, All };

	/// The texels that have colours of one chart.
	class Chart
	{
	public:
		/// Those between charts, and those with their middle on the outline of one, belong to none
		/// (but where two triangles of a chart meet in a corner of it they can be its own); those where
		/// charts overlap belong to all. A chart with a triangle larger than the picture has all of it,
		/// as those have that come after charts with kMaxLayers times its texels.
		bool has(std::size_t texel) const { return isOwn(m_texels[texel]); }

		/// \param index of a block of a level that has been added, or of a texel
		Share of(int level, std::size_t index) const
		{
			const int owner = (*m_owners)[positionOf(level)][index];
			return isOwn(owner) ? Share::All : owner == kMixed ? Share::Part : Share::None;
		}

		/// Whether all of these blocks of a level have its colours only.
		bool hasAll(int level, const std::array<std::size_t, 4>& indices) const
		{
			const int* owners = (*m_owners)[positionOf(level)].data();
			return m_isWhole || (isOwn(owners[indices[0]]) && isOwn(owners[indices[1]]) &&
								 isOwn(owners[indices[2]]) && isOwn(owners[indices[3]]));
		}

		/// Whether the chart goes on across the border of the picture, at the opposite side of it.
		bool repeats() const { return m_repeats; }

	private:
		friend class OldOwners;

		bool isOwn(int owner) const { return owner == m_key || owner == kOverlap || m_isWhole; }

		const std::vector<std::vector<int>>* m_owners = nullptr;
		const int* m_texels = nullptr;
		int m_key = 0;
		bool m_repeats = false, m_isWhole = false;
	};

	Chart of(int chart) const
	{
		Chart texels;
		texels.m_owners = &m_owners;
		texels.m_texels = m_owners.front().data();
		texels.m_key = keyOf(chart);
		texels.m_repeats = m_repeats[positionOf(chart)] != 0;
		texels.m_isWhole = m_isWhole[positionOf(chart)] != 0;
		return texels;
	}

private:
	/// Of texels inside of a chart; the odd number after it is that of texels on the side of one
	/// triangle, which become inside when they are on the side of another one of the chart.
	static int keyOf(int chart) { return 2 * chart + 4; }

	static constexpr int kMixed = -1, kNone = 0, kOutlineOfTwo = 1, kOverlap = 2;

	Blocks m_blocks;
	std::vector<std::vector<int>> m_owners; // [level][block]
	std::vector<char> m_repeats, m_isWhole; // [chart]
};

} // namespace ricci

#endif
