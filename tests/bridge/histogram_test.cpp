// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/histogram.h"

#include "support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace filter_ricci {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Histogram, EveryValueIsCountedOnceInTheBinThatHoldsIt)
{
	ricci::testing::Random random(210);
	std::vector<double> values;
	for (int i = 0; i < 2000; ++i)
		values.push_back(random.real(-1.0, 4.0));
	values.insert(values.end(), {0.0, 3.0, kInfinity, -kInfinity});
	const Histogram h = countInBins(values, 0.0, 3.0, 12);
	ASSERT_EQ(h.counts.size(), 12u);
	EXPECT_EQ(std::accumulate(h.counts.begin(), h.counts.end(), h.below + h.above), values.size());
	const auto inside = [&](double low, double high) {
		return static_cast<std::size_t>(std::count_if(
			values.begin(), values.end(), [&](double x) { return x >= low && x < high; }));
	};
	for (std::size_t i = 0; i < 12; ++i)
		EXPECT_EQ(h.counts[i], inside(0.25 * double(i), 0.25 * double(i + 1))) << i;
	EXPECT_EQ(h.below, inside(-kInfinity, 0.0));
	EXPECT_EQ(h.above, inside(3.0, kInfinity) + 1);
	for (std::size_t i = 0; i < 12; ++i)
		EXPECT_EQ(h.lowEdge(i), 0.25 * double(i));
}

TEST(Histogram, AValueJustBelowTheUpperEndIsInTheLastBin)
{
	for (std::size_t bins : {1u, 3u, 7u, 50u}) {
		const double high = 1.1;
		const Histogram h = countInBins({std::nextafter(high, 0.0)}, 0.3, high, bins);
		EXPECT_EQ(h.counts.back(), 1u) << bins;
		EXPECT_EQ(h.above, 0u);
	}
}

TEST(Histogram, TheScaleOfDistortionsIsRoundAndHoldsAlmostAll)
{
	ricci::testing::Random random(211);
	for (double size : {1e-9, 3e-4, 0.04, 0.7, 30.0}) {
		std::vector<double> values;
		for (int i = 0; i < 1000; ++i)
			values.push_back(1.0 + size * random.real(0.0, 1.0));
		const Histogram h = distortionHistogram(values);
		EXPECT_EQ(h.low, 1.0);
		EXPECT_EQ(h.below, 0u);
		EXPECT_LE(h.above, 10u);
		std::vector<double> sorted = values;
		std::sort(sorted.begin(), sorted.end());
		const std::size_t below = (99 * sorted.size() + 99) / 100; // 99 of 100, rounded up
		const double top = sorted[below - 1] - 1.0;
		EXPECT_GT(h.high - 1.0, top);
		EXPECT_LE(h.high - 1.0, std::max(2.5 * top, 1e-6) * (1 + 1e-12)); // steps of 1, 2, 5
	}
	EXPECT_EQ(distortionHistogram({1.0, kInfinity, kInfinity}).above, 2u);
	EXPECT_EQ(distortionHistogram({}).above, 0u);
}

TEST(Histogram, TheScaleOfFactorsIsSymmetric)
{
	ricci::testing::Random random(212);
	std::vector<double> logs;
	for (int i = 0; i < 1000; ++i)
		logs.push_back(random.real(-0.3, 0.7));
	const Histogram h = factorHistogram(logs);
	EXPECT_EQ(h.low, -h.high);
	EXPECT_EQ(h.high, 1.0); // the least of 0.1, 0.2, 0.5, 1 ... that holds 99 of 100
	EXPECT_EQ(h.below + h.above, 0u);
	for (double& x : logs)
		x = -x;
	std::vector<std::size_t> mirrored = factorHistogram(logs).counts;
	std::reverse(mirrored.begin(), mirrored.end());
	EXPECT_EQ(mirrored, h.counts);
}

} // namespace
} // namespace filter_ricci
