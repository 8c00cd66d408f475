// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PICTURE_SAMPLER_H
#define RICCI_PICTURE_SAMPLER_H

#include "../base/task.h"
#include "old_charts.h"
#include "picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace ricci {

/// Mean of samples; colours weigh by their alpha, and where all are transparent, without it.
template<class Sample>
class MeanColour
{
public:
	explicit MeanColour(bool hasAlpha) : m_hasAlpha(hasAlpha) {}

	/// Samples may have other integers for the same range.
	template<class Stored>
	void add(const Stored* rgba, double weight)
	{
		m_weight += weight;
		for (std::size_t c = 0; c < 4; ++c)
			m_plain[c] += weight * kUnit<Stored> * rgba[c];
		if (!m_hasAlpha)
			return;
		const double share = weight * kUnit<Stored> * rgba[3];
		for (std::size_t c = 0; c < 3; ++c)
			m_visible[c] += share * kUnit<Stored> * rgba[c];
	}

	/// Two neighbours of each of two rows, with the product of the weights of their column and their row.
	template<class Stored>
	void
	add(const std::array<const Stored*, 2>& rgba,
		const std::array<double, 2>& column,
		const std::array<double, 2>& row)
	{
		MeanColour sum = *this; // can be held in registers
		for (std::size_t j = 0; j < 2; ++j)
			for (std::size_t i = 0; i < 2; ++i)
				sum.add(rgba[j] + 4 * i, column[i] * row[j]);
		*this = sum;
	}

	double weight() const { return m_weight; }

	template<class Stored>
	void write(Stored* rgba) const
	{
		const auto rounded = [](double x) {
			return static_cast<Stored>(std::lround(x / kUnit<Stored>));
		};
		const double alpha = m_plain[3];
		for (std::size_t c = 0; c < 3; ++c)
			rgba[c] =
				rounded(m_hasAlpha && alpha > 0.0 ? m_visible[c] / alpha : m_plain[c] / m_weight);
		rgba[3] = m_hasAlpha ? rounded(alpha / m_weight) : std::numeric_limits<Stored>::max();
	}

private:
	template<class Stored>
	static constexpr double kUnit = static_cast<double>(std::numeric_limits<Sample>::max()) /
									std::numeric_limits<Stored>::max();

	bool m_hasAlpha;
	double m_weight = 0.0;
	std::array<double, 4> m_plain{};
	std::array<double, 3> m_visible{};
};

/// A parallelogram about a point of an old picture, in texels, and the points in it that are read: at most
/// one block apart, and each read bilinearly between blocks, so that no texel is missed. Blocks are single
/// texels where that takes at most kMaxTexels, else the smallest of which at most kMaxBlocks do.
class Footprint
{
public:
	static constexpr double kMaxTexels = 64.0, kMaxBlocks = 16.0;

	Footprint(const Point2& across, const Point2& down) : m_across(across), m_down(down)
	{
		// There are no pictures of more texels in a row than ints.
		for (double most = kMaxTexels; samples(across) * samples(down) > most && m_level < 30;) {
			++m_level;
			most = kMaxBlocks;
		}
		m_columns = static_cast<int>(std::min(samples(across), kMaxTexels));
		m_rows = static_cast<int>(std::min(samples(down), kMaxTexels));
	}

	/// Of the blocks.
	int level() const { return m_level; }

	/// visit(point) for those about \p p.
	template<class Visit>
	void forEachSample(const Point2& p, const Visit& visit) const
	{
		const double column = 1.0 / m_columns, row = 1.0 / m_rows;
		for (int j = 0; j < m_rows; ++j) {
			const Point2 middle = p + ((j + 0.5) * row - 0.5) * m_down;
			for (int i = 0; i < m_columns; ++i)
				visit(middle + ((i + 0.5) * column - 0.5) * m_across);
		}
	}

private:
	double samples(const Point2& side) const
	{
		const double length = std::ldexp(std::hypot(side[0], side[1]), -m_level);
		return std::max(std::ceil(length - 0.05), 1.0); // a little larger is not smaller
	}

	Point2 m_across, m_down; // its sides
	int m_level = 0;
	int m_columns, m_rows;
};

/// Reads one old picture.
template<class Sample>
class PictureSampler
{
public:
	using Chart = OldOwners::Chart;

	/// \param lastLevel of the blocks that footprints are to be read in; larger ones are read in these
	PictureSampler(const PictureView<const Sample>& picture, bool hasAlpha, int lastLevel) :
			m_picture(picture), m_overWidth(1.0 / picture.width),
			m_overHeight(1.0 / picture.height), m_blocks{picture.width, picture.height},
			m_hasAlpha(hasAlpha)
	{
		for (int level = 1; level <= lastLevel; ++level)
			addLevel(level);
	}

	const PictureView<const Sample>& picture() const { return m_picture; }

	/// The mean over the footprint at \p p of what belongs to the chart.
	/// \return whether there is any; nothing is written otherwise
	bool mean(const Point2& p, const Footprint& footprint, const Chart& chart, Sample* rgba) const
	{
		MeanColour<Sample> sum(m_hasAlpha);
		const int level = std::min(footprint.level(), static_cast<int>(m_means.size()));
		if (level == 0)
			footprint.forEachSample(p, [&](const Point2& q) { addBilinear(q, chart, sum); });
		else
			footprint.forEachSample(p, [&](const Point2& q) { addBlocks(q, level, chart, sum); });
		if (!(sum.weight() > 0.0))
			return false;
		sum.write(rgba);
		return true;
	}

	/// What is nearest to \p p: of the chart's texels if one is near, else whatever lies there. On the
	/// middle of a texel that is this one, whosever it is: so nothing changes where the map does not.
	void nearest(const Point2& p, const Chart& chart, Sample* rgba) const
	{
		constexpr int kReach = 4;
		const Point2 q = inside(p);
		const int x = std::min(static_cast<int>(q[0]), m_picture.width - 1);
		const int y = std::min(static_cast<int>(q[1]), m_picture.height - 1);
		std::size_t best = m_picture.index(x, y);
		const bool onMiddle = distance(q, {x + 0.5, y + 0.5}) < 1e-4;
		double nearestSoFar = onMiddle ? 0.0 : HUGE_VAL;
		for (int dy = -kReach; dy <= kReach; ++dy)
			for (int dx = -kReach; dx <= kReach; ++dx) {
				const double apart = distance(q, {x + dx + 0.5, y + dy + 0.5});
				if (apart < nearestSoFar && belongs(x + dx, y + dy, chart)) {
					nearestSoFar = apart;
					best = index(x + dx, y + dy);
				}
			}
		std::copy_n(m_picture.rgba + 4 * best, 4, rgba);
		if (!m_hasAlpha)
			rgba[3] = std::numeric_limits<Sample>::max();
	}

private:
	/// The same point of the picture that is repeated.
	Point2 inside(const Point2& p) const
	{
		const double w = m_picture.width, h = m_picture.height;
		return {
			std::clamp(p[0] - w * std::floor(p[0] * m_overWidth), 0.0, w),
			std::clamp(p[1] - h * std::floor(p[1] * m_overHeight), 0.0, h)};
	}

	/// Of a texel at most a few beside the picture.
	std::size_t index(int x, int y) const
	{
		const int w = m_picture.width, h = m_picture.height;
		x = x >= 0 && x < w ? x : ((x % w) + w) % w;
		y = y >= 0 && y < h ? y : ((y % h) + h) % h;
		return m_picture.index(x, y);
	}

	bool belongs(int x, int y, const Chart& chart) const
	{
		const bool in = x >= 0 && x < m_picture.width && y >= 0 && y < m_picture.height;
		return (in || chart.repeats()) && chart.has(index(x, y));
	}

	void addLevel(int level)
	{
		std::vector<Word> means;
		m_blocks.forLevel(level, [&](const Block& block) {
			checkpointNowAndThen(means.size());
			MeanColour<Sample> sum(m_hasAlpha);
			m_blocks.forParts(
				block, [&](const Block& part) { addMean(part, m_blocks.texels(part), sum); });
			std::array<Word, 4> rgba;
			sum.write(rgba.data());
			means.insert(means.end(), rgba.begin(), rgba.end());
		});
		m_means.push_back(std::move(means));
	}

	void addMean(const Block& block, double weight, MeanColour<Sample>& sum) const
	{
		const std::size_t first = 4 * m_blocks.index(block);
		if (block.level == 0)
			sum.add(m_picture.rgba + first, weight);
		else
			sum.add(m_means[positionOf(block.level - 1)].data() + first, weight);
	}

	/// Adds what belongs to the chart of the blocks round \p p.
	void addBlocks(Point2 p, int level, const Chart& chart, MeanColour<Sample>& sum) const
	{
		if (chart.repeats())
			p = inside(p);
		const double perTexel = 1.0 / (1 << level); // blocks
		const double x = p[0] * perTexel - 0.5, y = p[1] * perTexel - 0.5;
		const int across = m_blocks.across(level), down = m_blocks.down(level);
		if (!(x > -1.0 && x < across && y > -1.0 && y < down))
			return;
		const Block first{level, static_cast<int>(x + 1.0) - 1, static_cast<int>(y + 1.0) - 1};
		const double tx = x - first.x, ty = y - first.y;
		const std::array<double, 2> right{1.0 - tx, tx}, below{1.0 - ty, ty};
		if (first.x >= 0 && first.y >= 0 && first.x + 2 < across && first.y + 2 < down) {
			const std::size_t upper = m_blocks.index(first), lower = upper + positionOf(across);
			if (chart.hasAll(level, {upper, upper + 1, lower, lower + 1})) { // and none is cut off
				const Word* means = m_means[positionOf(level - 1)].data();
				sum.add(std::array{means + 4 * upper, means + 4 * lower}, right, below);
				return;
			}
		}
		for (int j = 0; j < 2; ++j)
			for (int i = 0; i < 2; ++i) {
				Block block{level, first.x + i, first.y + j};
				if (chart.repeats()) {
					block.x += block.x < 0 ? across : block.x < across ? 0 : -across;
					block.y += block.y < 0 ? down : block.y < down ? 0 : -down;
				}
				if (block.x >= 0 && block.x < across && block.y >= 0 && block.y < down)
					addBlock(
						block,
						level - kDepth,
						right[positionOf(i)] * below[positionOf(j)] * perTexel * perTexel,
						chart,
						sum);
			}
	}

	/// \param weight of a texel
	/// \param leastLevel of blocks that are divided if the chart has a part of them; of smaller ones the
	/// texel in the middle decides
	void addBlock(
		const Block& block,
		int leastLevel,
		double weight,
		const Chart& chart,
		MeanColour<Sample>& sum) const
	{
		switch (chart.of(block.level, m_blocks.index(block))) {
		case OldOwners::Share::None:
			return;
		case OldOwners::Share::All:
			addMean(block, weight * m_blocks.texels(block), sum);
			return;
		case OldOwners::Share::Part:
			break;
		}
		if (block.level > leastLevel)
			m_blocks.forParts(
				block, [&](const Block& part) { addBlock(part, leastLevel, weight, chart, sum); });
		else if (const Block middle = m_blocks.middle(block); chart.has(m_blocks.index(middle)))
			addMean(middle, weight * m_blocks.texels(block), sum);
	}

	void addBilinear(Point2 p, const Chart& chart, MeanColour<Sample>& sum) const
	{
		if (chart.repeats())
			p = inside(p);
		else if (!(p[0] > -1.0 && p[0] < m_picture.width + 1.0 && p[1] > -1.0 &&
				   p[1] < m_picture.height + 1.0))
			return;
		const int x = static_cast<int>(p[0] + 1.5) - 2, y = static_cast<int>(p[1] + 1.5) - 2;
		const double tx = p[0] - 0.5 - x, ty = p[1] - 0.5 - y;
		const double sx = 1.0 - tx, sy = 1.0 - ty;
		if (x >= 0 && x + 1 < m_picture.width && y >= 0 && y + 1 < m_picture.height &&
			std::min({tx, ty, sx, sy}) > kOnSide) {
			const std::size_t upper = m_picture.index(x, y), lower = m_picture.index(x, y + 1);
			if (chart.has(upper) && chart.has(upper + 1) && chart.has(lower) &&
				chart.has(lower + 1)) {
				const Sample* texels = m_picture.rgba;
				sum.add(std::array{texels + 4 * upper, texels + 4 * lower}, {sx, tx}, {sy, ty});
				return;
			}
		}
		for (int dy = 0; dy < 2; ++dy)
			for (int dx = 0; dx < 2; ++dx) {
				const double weight = (dx == 0 ? sx : tx) * (dy == 0 ? sy : ty);
				if (weight > kOnSide && belongs(x + dx, y + dy, chart))
					sum.add(m_picture.rgba + 4 * index(x + dx, y + dy), weight);
			}
	}

	using Word = unsigned short; // of means: the mean of many bytes needs more than a byte

	/// Levels that a block is divided by where only a part of it belongs to the chart.
	static constexpr int kDepth = 3;

	const PictureView<const Sample>& m_picture;
	double m_overWidth, m_overHeight; // 1 over
	Blocks m_blocks;
	bool m_hasAlpha;
	std::vector<std::vector<Word>> m_means; // [level - 1] of the blocks; colours by their alpha
};

} // namespace ricci

#endif
