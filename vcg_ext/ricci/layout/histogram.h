// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_HISTOGRAM_H
#define RICCI_HISTOGRAM_H

#include <cstddef>
#include <vector>

namespace ricci {

/// Counts of values in bins of equal width; bin i holds [low + i w, low + (i + 1) w), w = (high -
/// low) / bins.
struct Histogram
{
	double low = 0.0, high = 1.0;
	std::vector<std::size_t> counts; ///< [bin]
	std::size_t below = 0;           ///< values less than low
	std::size_t above = 0;           ///< values of high and more, infinity included
	double binWidth() const { return (high - low) / static_cast<double>(counts.size()); }
	double lowEdge(std::size_t bin) const { return low + static_cast<double>(bin) * binWidth(); }
};

/// Counts \p values; NaN belongs to no bin. \p low < \p high, \p bins >= 1.
Histogram countInBins(const std::vector<double>& values, double low, double high, std::size_t bins);

/// Counts quasi-conformal distortions from 1 up to the least 1 + (1, 2 or 5) 10^k that is above the
/// 99th percentile, in 50 bins.
Histogram distortionHistogram(const std::vector<double>& values);

/// Counts binary logarithms of factors, in 50 bins between -x and x, x the least (1, 2 or 5) 10^k that
/// is above the 99th percentile of their absolute values.
Histogram factorHistogram(const std::vector<double>& binaryLogarithms);

/// The least value that is not below \p share of \p values (nearest rank), 0 < \p share <= 1; NaN
/// if there is none. NaN among the values is left out.
double percentile(std::vector<double> values, double share);

} // namespace ricci

#endif
