// SPDX-License-Identifier: GPL-3.0-or-later
#include "histogram.h"

#include <ricci/measure/distortion.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace filter_ricci {

namespace {

constexpr std::size_t kBins = 50;

/// Scales finer than this show only rounding.
constexpr double kFinestScale = 1e-6;

/// The smallest 1, 2 or 5 times a power of 10 above \p x, and not below kFinestScale; 1 for an infinite distortion, which
/// has no scale of its own.
double roundNumberAbove(double x)
{
	if (!std::isfinite(x))
		return 1.0;
	for (double power = kFinestScale;; power *= 10.0)
		for (double digit : {1.0, 2.0, 5.0})
			if (digit * power > x)
				return digit * power;
}

} // namespace

Histogram countInBins(const std::vector<double>& values, double low, double high, std::size_t bins)
{
	Histogram histogram;
	histogram.low = low;
	histogram.high = high;
	histogram.counts.assign(bins, 0);
	for (double x : values) {
		if (x < low)
			++histogram.below;
		else if (x >= high)
			++histogram.above;
		else {
			const double bin = std::floor((x - low) / (high - low) * static_cast<double>(bins));
			++histogram.counts[std::min(static_cast<std::size_t>(bin), bins - 1)];
		}
	}
	return histogram;
}

Histogram distortionHistogram(const std::vector<double>& values)
{
	const double size = roundNumberAbove(ricci::percentile(values, 0.99) - 1.0);
	return countInBins(values, 1.0, 1.0 + size, kBins);
}

Histogram factorHistogram(const std::vector<double>& binaryLogarithms)
{
	std::vector<double> sizes;
	sizes.reserve(binaryLogarithms.size());
	for (double x : binaryLogarithms)
		sizes.push_back(std::abs(x));
	const double end = roundNumberAbove(ricci::percentile(std::move(sizes), 0.99));
	return countInBins(binaryLogarithms, -end, end, kBins);
}

} // namespace filter_ricci
