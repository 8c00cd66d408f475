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
		for (std::size_t c = 0; c < 3; ++c)
			m_plain[c] += weight * rgba[c];
		if (!m_hasAlpha)
			return;
		const double share = weight * rgba[3];
		m_alpha += share;
		for (std::size_t c = 0; c < 3; ++c)
			m_visible[c] += share * rgba[c];
	}

	double weight() const { return m_weight; }

	void write(Sample* rgba) const
	{
		const bool visible = m_alpha > 0.0;
		for (std::size_t c = 0; c < 3; ++c)
			rgba[c] = rounded(visible ? m_visible[c] / m_alpha : m_plain[c] / m_weight);
		rgba[3] = m_hasAlpha ? rounded(m_alpha / m_weight) : std::numeric_limits<Sample>::max();
	}

private:
	static Sample rounded(double x) { return static_cast<Sample>(x + 0.5); }

	bool m_hasAlpha;
	double m_weight = 0.0, m_alpha = 0.0;
	std::array<double, 3> m_plain{}, m_visible{};
};

/// Parallelogram about a point of an old picture, in texels.
struct Footprint
{
	Point2 across{}, down{}; ///< its sides
};

/// Reads one old picture.
template<class Sample>
class PictureSampler
{
public:
	PictureSampler(
		const PictureView<const Sample>& picture, const OldOwners& owners, bool hasAlpha) :
			m_picture(picture),
			m_owners(owners), m_hasAlpha(hasAlpha)
	{
	}

	/// The mean over the footprint at \p p of what belongs to the chart.
	/// \return whether there is any; nothing is written otherwise
	bool mean(const Point2& p, const Footprint& footprint, int chart, Sample* rgba) const
	{
		MeanColour<Sample> sum(m_hasAlpha);
		const int columns = samplesAlong(footprint.across), rows = samplesAlong(footprint.down);
		for (int j = 0; j < rows; ++j)
			for (int i = 0; i < columns; ++i) {
				const double s = (i + 0.5) / columns - 0.5, t = (j + 0.5) / rows - 0.5;
				addBilinear(
					{p[0] + s * footprint.across[0] + t * footprint.down[0],
					 p[1] + s * footprint.across[1] + t * footprint.down[1]},
					chart,
					sum);
			}
		if (!(sum.weight() > 0.0))
			return false;
		sum.write(rgba);
		return true;
	}

	/// What is nearest to \p p: of the chart's texels if one is near, else whatever lies there.
	void nearest(const Point2& p, int chart, Sample* rgba) const
	{
		constexpr int kReach = 4;
		const Point2 q = inside(p);
		const int x = std::min(static_cast<int>(q[0]), m_picture.width - 1);
		const int y = std::min(static_cast<int>(q[1]), m_picture.height - 1);
		double least = HUGE_VAL;
		std::size_t best = m_picture.index(x, y);
		for (int dy = -kReach; dy <= kReach; ++dy)
			for (int dx = -kReach; dx <= kReach; ++dx) {
				const double apart = distance(q, {x + dx + 0.5, y + dy + 0.5});
				if (apart < least && belongs(x + dx, y + dy, chart)) {
					least = apart;
					best = index(x + dx, y + dy);
				}
			}
		std::copy_n(m_picture.rgba + 4 * best, 4, rgba);
		if (!m_hasAlpha)
			rgba[3] = std::numeric_limits<Sample>::max();
	}

private:
	/// Samples at most one texel apart; bilinear ones overlap, so that none is missed.
	static int samplesAlong(const Point2& side)
	{
		constexpr double kSlack = 0.05; // a little larger is not smaller
		constexpr double kMost = 64.0;
		const double length = std::hypot(side[0], side[1]);
		return static_cast<int>(std::clamp(std::ceil(length - kSlack), 1.0, kMost));
	}

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

	bool belongs(int x, int y, int chart) const
	{
		const bool in = x >= 0 && x < m_picture.width && y >= 0 && y < m_picture.height;
		return (in || m_owners.repeats(chart)) && m_owners.belongs(index(x, y), chart);
	}

	void addBilinear(Point2 p, int chart, MeanColour<Sample>& sum) const
	{
		constexpr double kNoWeight = 1e-6; // rounding of the coordinates
		if (m_owners.repeats(chart))
			p = inside(p);
		else if (!(p[0] > -1.0 && p[0] < m_picture.width + 1.0 && p[1] > -1.0 &&
				   p[1] < m_picture.height + 1.0))
			return;
		const double left = std::floor(p[0] - 0.5), top = std::floor(p[1] - 0.5);
		const double tx = p[0] - 0.5 - left, ty = p[1] - 0.5 - top;
		const int x = static_cast<int>(left), y = static_cast<int>(top);
		for (int dy = 0; dy < 2; ++dy)
			for (int dx = 0; dx < 2; ++dx) {
				const double weight = (dx == 0 ? 1.0 - tx : tx) * (dy == 0 ? 1.0 - ty : ty);
				if (weight > kNoWeight && belongs(x + dx, y + dy, chart))
					sum.add(m_picture.rgba + 4 * index(x + dx, y + dy), weight);
			}
	}

	const PictureView<const Sample>& m_picture;
	const OldOwners& m_owners;
	bool m_hasAlpha;
};

} // namespace ricci

#endif
