// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PICTURE_H
#define RICCI_PICTURE_H

#include "../base/points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

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

/// Rounding of coordinates in texels: middles of texels this far outside of a triangle are in it.
constexpr double kOnSide = 1e-6;

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

/// Calls visit(x, y) for the texels whose middle lies in a triangle, row by row; the middle of texel
/// (x, y) is (x + 0.5, y + 0.5).
/// \param reach positive: at least those this far outside are visited, too; negative: those nearer to
/// the triangle's sides, along the axes, are not
/// \param first, last of the coordinates of texels that are visited
template<class Visit>
void forEachTexelOf(const Triangle2& t, double reach, int first, int last, const Visit& visit)
{
	const auto clamped = [&](double x) { // no number becomes first
		return x > first ? static_cast<int>(std::min(x, last + 1.0)) : first;
	};
	const double low = std::min({t[0][1], t[1][1], t[2][1]}) - reach;
	const double high = std::max({t[0][1], t[1][1], t[2][1]}) + reach;
	const double slab = std::max(reach, 0.0);
	for (int y = clamped(std::ceil(low - 0.5)); y <= last && y + 0.5 <= high; ++y) {
		// What the triangle has of the rows within reach.
		const double bottom = y + 0.5 - slab, top = y + 0.5 + slab;
		double left = HUGE_VAL, right = -HUGE_VAL;
		for (std::size_t k = 0; k < 3; ++k) {
			Point2 a = t[k], b = t[(k + 1) % 3];
			if (a[1] > b[1])
				std::swap(a, b);
			if (b[1] < bottom || a[1] > top)
				continue;
			const double rise = b[1] - a[1];
			const auto at = [&](double height) {
				const double share = rise > 0.0 ? (height - a[1]) / rise : 0.0;
				return a[0] + std::clamp(share, 0.0, 1.0) * (b[0] - a[0]);
			};
			const double from = a[1] >= bottom ? a[0] : at(bottom);
			const double to = b[1] <= top ? b[0] : at(top);
			left = std::min({left, from, to});
			right = std::max({right, from, to});
		}
		if (left > right)
			continue;
		right += reach;
		for (int x = clamped(std::ceil(left - reach - 0.5)); x <= last && x + 0.5 <= right; ++x)
			visit(x, y);
	}
}

/// The point of a triangle that is nearest to p, as barycentric coordinates.
inline Point3 nearestInTriangle(const Triangle2& t, const Point2& p)
{
	const double area = doubledArea(t);
	if (area != 0.0) {
		const Point3 weights{
			doubledArea(p, t[1], t[2]) / area,
			doubledArea(t[0], p, t[2]) / area,
			doubledArea(t[0], t[1], p) / area};
		if (weights[0] >= 0.0 && weights[1] >= 0.0 && weights[2] >= 0.0)
			return weights;
	}
	Point3 nearest{1, 0, 0};
	double nearestSoFar = HUGE_VAL;
	for (std::size_t k = 0; k < 3; ++k) {
		const Point2 &a = t[k], &b = t[(k + 1) % 3];
		const double share = nearestOnSegment(a, b, p);
		const double apart = distance(p, between(a, b, share));
		if (apart < nearestSoFar) {
			nearestSoFar = apart;
			nearest = {0, 0, 0};
			nearest[k] = 1.0 - share;
			nearest[(k + 1) % 3] = share;
		}
	}
	return nearest;
}

/// The point with these barycentric coordinates.
inline Point2 pointOf(const Triangle2& t, const Point3& weights)
{
	return {
		weights[0] * t[0][0] + weights[1] * t[1][0] + weights[2] * t[2][0],
		weights[0] * t[0][1] + weights[1] * t[1][1] + weights[2] * t[2][1]};
}

/// Gives every texel that is not \p covered [texel] the samples of the nearest one that is; nothing
/// where none is. Euclidean distance between middles, found exactly in time proportional to the texels
/// [Felzenszwalb Huttenlocher 2012]. Needs 2 bytes for each texel.
/// \pre the picture is less than 32767 texels high
template<class Sample>
void fillFromNearest(
	const std::vector<char>& covered, const PictureView<Sample>& picture, int threads);

extern template void
fillFromNearest(const std::vector<char>&, const PictureView<unsigned char>&, int);
extern template void
fillFromNearest(const std::vector<char>&, const PictureView<unsigned short>&, int);

} // namespace ricci

#endif
