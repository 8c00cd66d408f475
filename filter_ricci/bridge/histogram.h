// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_RICCI_HISTOGRAM_H
#define FILTER_RICCI_HISTOGRAM_H

#include <cstddef>
#include <vector>

namespace filter_ricci {

/// Counts of values in bins of equal width; bin i holds [low + i w, low + (i + 1) w) with
/// w = (high - low) / bins.
struct Histogram
{
	double low = 0.0, high = 1.0;
	std::vector<std::size_t> counts; ///< [bin]
	std::size_t below = 0;           ///< values less than low
	std::size_t above = 0;           ///< values of high and more, infinity included

	double binWidth() const { return (high - low) / static_cast<double>(counts.size()); }
	double lowEdge(std::size_t bin) const { return low + static_cast<double>(bin) * binWidth(); }
};

/// Counts \p values in \p bins >= 1 bins between \p low and \p high. None of them is NaN.
/// \pre low < high
Histogram countInBins(const std::vector<double>& values, double low, double high, std::size_t bins);

/// Counts quasi-conformal distortions, in 50 bins from 1 to 1 + x. x is the smallest (1, 2 or 5) 10^k
/// such that 1 + x is above the 99th percentile, and 1e-6 at least.
Histogram distortionHistogram(const std::vector<double>& values);

/// Counts binary logarithms of factors, in 50 bins between -x and x. x is the smallest
/// (1, 2 or 5) 10^k above the 99th percentile of their absolute values, and 1e-6 at least.
Histogram factorHistogram(const std::vector<double>& binaryLogarithms);

} // namespace filter_ricci

#endif
