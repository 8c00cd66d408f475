// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PICTURE_SAMPLER_H
#define RICCI_PICTURE_SAMPLER_H

#include "old_charts.h"
#include "picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ricci {

/// Mean of samples; colours weigh by their alpha, and where all are transparent, without it.
template<class Sample>
class MeanColour
{
public:
	explicit MeanColour(bool hasAlpha) : m_hasAlpha(hasAlpha) {}

	void add(const Sample* rgba, double weight)
	{
		m_weight += weight;
		for (std::size_t c = 0; c < 4; ++c)
			m_plain[c] += weight * rgba[c];
		if (!m_hasAlpha)
			return;
		const double share = weight * rgba[3];
		for (std::size_t c = 0; c < 3; ++c)
			m_visible[c] += share * rgba[c];
	}

	double weight() const { return m_weight; }

	void write(Sample* rgba) const
	{
		const double alpha = m_plain[3];
		for (std::size_t c = 0; c < 3; ++c)
			rgba[c] =
				rounded(m_hasAlpha && alpha > 0.0 ? m_visible[c] / alpha : m_plain[c] / m_weight);
		rgba[3] = m_hasAlpha ? rounded(alpha / m_weight) : std::numeric_limits<Sample>::max();
	}

private:
	static Sample rounded(double x) { return static_cast<Sample>(std::lround(x)); }

	bool m_hasAlpha;
	double m_weight = 0.0;
	std::array<double, 4> m_plain{};
	std::array<double, 3> m_visible{};
};

/// A parallelogram about a point of an old picture, in texels, and the points in it that are read: at most
/// one texel apart, and each read bilinearly, so that none is missed; but no more than 64 in a row.
class Footprint
{
public:
	Footprint(const Point2& across, const Point2& down) :
			m_across(across), m_down(down), m_columns(samplesAlong(across)),
			m_rows(samplesAlong(down))
	{
	}

	/// visit(point) for those about \p p.
	template<class Visit>
	void forEachSample(const Point2& p, const Visit& visit) const
	{
		for (int j = 0; j < m_rows; ++j)
			for (int i = 0; i < m_columns; ++i) {
				const double s = (i + 0.5) / m_columns - 0.5, t = (j + 0.5) / m_rows - 0.5;
				visit(Point2{
					p[0] + s * m_across[0] + t * m_down[0],
					p[1] + s * m_across[1] + t * m_down[1]});
			}
	}

private:
	static int samplesAlong(const Point2& side)
	{
		constexpr double kSlack = 0.05; // a little larger is not smaller
		constexpr double kMaxSamples = 64.0;
		const double length = std::hypot(side[0], side[1]);
		return static_cast<int>(std::clamp(std::ceil(length - kSlack), 1.0, kMaxSamples));
	}

	Point2 m_across, m_down; // its sides
	int m_columns, m_rows;
};

/// Reads one old picture.
template<class Sample>
class PictureSampler
{
public:
	using Chart = OldOwners::Chart;

	PictureSampler(const PictureView<const Sample>& picture, bool hasAlpha) :
			m_picture(picture), m_hasAlpha(hasAlpha)
	{
	}

	/// The mean over the footprint at \p p of what belongs to the chart.
	/// \return whether there is any; nothing is written otherwise
	bool mean(const Point2& p, const Footprint& footprint, const Chart& chart, Sample* rgba) const
	{
		MeanColour<Sample> sum(m_hasAlpha);
		footprint.forEachSample(p, [&](const Point2& q) { addBilinear(q, chart, sum); });
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
		constexpr double kOnMiddle = 1e-4;
		const Point2 q = inside(p);
		const int x = std::min(static_cast<int>(q[0]), m_picture.width - 1);
		const int y = std::min(static_cast<int>(q[1]), m_picture.height - 1);
		std::size_t best = m_picture.index(x, y);
		const bool onMiddle = distance(q, {x + 0.5, y + 0.5}) < kOnMiddle;
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
			std::clamp(p[0] - w * std::floor(p[0] / w), 0.0, w),
			std::clamp(p[1] - h * std::floor(p[1] / h), 0.0, h)};
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

	void addBilinear(Point2 p, const Chart& chart, MeanColour<Sample>& sum) const
	{
		constexpr double kNoWeight = 1e-6; // rounding of the coordinates
		if (chart.repeats())
			p = inside(p);
		else if (!(p[0] > -1.0 && p[0] < m_picture.width + 1.0 && p[1] > -1.0 &&
				   p[1] < m_picture.height + 1.0))
			return;
		const int x = static_cast<int>(p[0] + 1.5) - 2, y = static_cast<int>(p[1] + 1.5) - 2;
		const double tx = p[0] - 0.5 - x, ty = p[1] - 0.5 - y;
		const double sx = 1.0 - tx, sy = 1.0 - ty;
		if (x >= 0 && x + 1 < m_picture.width && y >= 0 && y + 1 < m_picture.height &&
			std::min({tx, ty, sx, sy}) > kNoWeight) {
			const std::size_t upper = m_picture.index(x, y), lower = m_picture.index(x, y + 1);
			if (chart.has(upper) && chart.has(upper + 1) && chart.has(lower) &&
				chart.has(lower + 1)) {
				sum.add(m_picture.rgba + 4 * upper, sx * sy);
				sum.add(m_picture.rgba + 4 * upper + 4, tx * sy);
				sum.add(m_picture.rgba + 4 * lower, sx * ty);
				sum.add(m_picture.rgba + 4 * lower + 4, tx * ty);
				return;
			}
		}
		for (int dy = 0; dy < 2; ++dy)
			for (int dx = 0; dx < 2; ++dx) {
				const double weight = (dx == 0 ? sx : tx) * (dy == 0 ? sy : ty);
				if (weight > kNoWeight && belongs(x + dx, y + dy, chart))
					sum.add(m_picture.rgba + 4 * index(x + dx, y + dy), weight);
			}
	}

	const PictureView<const Sample>& m_picture;
	bool m_hasAlpha;
};

} // namespace ricci

#endif
