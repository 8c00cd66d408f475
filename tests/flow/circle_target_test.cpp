// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <ricci/base/numbers.h>
#include <ricci/flow/flow_run.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ricci::testing {
namespace {

double sum(const std::vector<double>& x)
{
	return std::accumulate(x.begin(), x.end(), 0.0);
}

/// Random arcs that add up to 2 pi; \p largest is the share of the first, the others random.
std::vector<double> randomArcs(std::size_t n, double largest, Random& random)
{
	std::vector<double> arcs(n);
	for (double& arc : arcs)
		arc = random.real(0.1, 1.0);
	const double others = sum(arcs) - arcs[0];
	for (double& arc : arcs)
		arc *= 2 * kPi * (1 - largest) / others;
	arcs[0] = 2 * kPi * largest;
	return arcs;
}

TEST(InscribedArcs, HaveTheSidesForChords)
{
	Random random(80);
	int checked = 0;
	for (int trial = 0; trial < 300; ++trial) {
		const std::size_t n = 3 + static_cast<std::size_t>(random.index(60));
		// The first arc beyond a half circle: the centre lies outside the polygon.
		const bool outside = trial % 3 == 0;
		const double share = outside ? random.real(0.53, 0.9) : random.real(0.02, 0.45);
		std::vector<double> arcs = randomArcs(n, share, random);
		if (!outside && *std::max_element(arcs.begin(), arcs.end()) > 0.95 * kPi)
			continue;
		++checked;
		std::rotate(arcs.begin(), arcs.begin() + random.index(static_cast<int>(n)), arcs.end());
		const double radius = std::pow(10.0, random.real(-6, 6));
		std::vector<double> chords;
		for (const double arc : arcs)
			chords.push_back(2 * radius * std::sin(0.5 * arc));
		const std::vector<double> found = inscribedArcs(chords);
		ASSERT_EQ(found.size(), n);
		for (std::size_t i = 0; i < n; ++i)
			EXPECT_NEAR(found[i], arcs[i], 1e-10);
		EXPECT_NEAR(sum(found), 2 * kPi, 1e-13);
	}
	EXPECT_GT(checked, 250);
	for (const int n : {3, 4, 5, 17, 1000}) // regular ones
		for (const double arc :
			 inscribedArcs(std::vector<double>(static_cast<std::size_t>(n), 0.7)))
			EXPECT_NEAR(arc, 2 * kPi / n, 1e-13);
}

} // namespace
} // namespace ricci::testing
