// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PICTURE_H
#define RICCI_PICTURE_H

#include "../math/points.h"

#include <cstddef>

namespace ricci {

/// A picture in somebody else's memory: rows from the top, texels from the left, of each red, green,
/// blue and alpha, not multiplied with it, without gaps.
template<class Sample>
struct PictureView
{
	int width = 0, height = 0;
	Sample* rgba = nullptr;

	std::size_t texels() const
	{
		return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
	}
	std::size_t index(int x, int y) const
	{
		return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
			   static_cast<std::size_t>(x);
	}
};

/// Texture coordinates in texels from the upper left corner, where the middle of the first texel is
/// (0.5, 0.5).
inline Point2 inTexels(const Point2& uv, int width, int height)
{
	return {uv[0] * width, (1.0 - uv[1]) * height};
}

inline Triangle2 inTexels(const Triangle2& uv, int width, int height)
{
	return {
		inTexels(uv[0], width, height),
		inTexels(uv[1], width, height),
		inTexels(uv[2], width, height)};
}

} // namespace ricci

#endif
