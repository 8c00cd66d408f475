// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/max_flow.h"
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/charts/border_flow.h>
#include <ricci/math/min_cut.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

namespace ricci::testing {
namespace {

/// A grid in the plane with random lengths in space, some of its triangles left out or in another part.
struct RandomChart
{
	DrawnChart chart;
	ChartSides sides;
	PartGraph graph;

	RandomChart(Random& random, int size, bool isWhole) :
			chart(chartOf(random, size, isWhole)),
			sides{sidesAcross(chart), lengthsOf(random, chart)}, graph(chart, sides)
	{
		for (int& part : graph.part)
			part = !isWhole && random.index(20) == 0;
	}

	/// Up to \p count connected triangles of part 0 from \p first on, which become terminals.
	std::vector<int> blob(int first, int count, Terminal kind, Array<Terminal>& terminal) const
	{
		std::vector<int> triangles;
		const auto take = [&](int i) {
			if (graph.part[i] != 0 || terminal[i] != kNoTerminal)
				return;
			terminal[i] = kind;
			triangles.push_back(i);
		};
		take(first);
		for (std::size_t i = 0; i < triangles.size(); ++i)
			for (int k = 0; k < 3; ++k)
				if (const int other = graph.neighbour(3 * triangles[i] + k);
					other >= 0 && static_cast<int>(triangles.size()) < count)
					take(other / 3);
		return triangles;
	}

private:
	static DrawnChart chartOf(Random& random, int size, bool isWhole)
	{
		const SurfaceMesh mesh = rectangle(size, size, 1.0, 1.0);
		DrawnChart chart;
		for (const Triangle& t : mesh.triangles) {
			if (!isWhole && random.index(20) == 0)
				continue;
			Triangle2 p;
			for (std::size_t k = 0; k < 3; ++k)
				p[k] = {mesh.positions[at(t[k])][0], mesh.positions[at(t[k])][1]};
			chart.triangles.push_back(t);
			chart.plane.push_back(p);
		}
		return chart;
	}

	/// The same on both sides.
	static Array<std::array<double, 3>> lengthsOf(Random& random, const DrawnChart& chart)
	{
		Array<std::array<double, 3>> lengths(chart.triangles.size());
		const Array<int> across = sidesAcross(chart);
		for (const int s : across.indices()) {
			const double length = random.real(0.1, 1.0);
			lengths[s / 3][at(s % 3)] = length;
			if (const int other = across[s]; other >= 0)
				lengths[other / 3][at(other % 3)] = length;
		}
		return lengths;
	}
};

/// What is sent between the terminals is a flow.
void expectFlow(const RandomChart& c, const Array<Terminal>& terminal, const BorderFlow& flow)
{
	for (const int i : terminal.indices()) {
		std::int64_t sum = 0;
		for (int side = 3 * i; side < 3 * i + 3; ++side) {
			sum += flow.across(side);
			const int other = c.graph.neighbour(side);
			if (other >= 0) {
				EXPECT_EQ(flow.across(other), -flow.across(side));
				if (terminal[i] == kNoTerminal || terminal[i] != terminal[other / 3]) {
					EXPECT_LE(std::abs(flow.across(side)), c.graph.weight(side));
				}
			}
			else if (terminal[i] == kNoTerminal) {
				EXPECT_EQ(flow.across(side), 0);
			}
		}
		EXPECT_EQ(sum, 0);
	}
}

/// What leaves the triangles of a kind.
std::int64_t
sent(const RandomChart& c, Terminal kind, const Array<Terminal>& terminal, const BorderFlow& flow)
{
	std::int64_t sum = 0;
	for (const int i : terminal.indices())
		for (int side = 3 * i; side < 3 * i + 3 && terminal[i] == kind; ++side)
			if (const int other = c.graph.neighbour(side);
				other >= 0 && terminal[other / 3] != kind)
				sum += flow.across(side);
	return sum;
}

/// The edges of part 0, with all sources joined to one node more, and all sinks to another.
std::vector<Link> linksOf(const RandomChart& c, const Array<Terminal>& terminal)
{
	std::vector<Link> links;
	const int n = terminal.size();
	for (const int i : terminal.indices()) {
		for (int side = 3 * i; side < 3 * i + 3; ++side)
			if (const int other = c.graph.neighbour(side); other > side)
				links.push_back({i, other / 3, c.graph.weight(side), c.graph.weight(side)});
		const std::int64_t unlimited = std::int64_t(1) << 60;
		if (terminal[i] != kNoTerminal)
			links.push_back({i, terminal[i] == kSource ? n : n + 1, unlimited, unlimited});
	}
	return links;
}

/// The local search with the flow as its start against a plain one in the whole chart.
TEST(BorderFlow, LeavesTheMinimumCutAsItIs)
{
	Random random(1220);
	int cuts = 0, begun = 0;
	for (int trial = 0; trial < 300; ++trial) {
		const RandomChart c(random, 9, trial % 3 == 0);
		const int n = c.chart.triangles.size();
		Array<Terminal> terminal(n, kNoTerminal);
		const std::vector<int> sources =
			c.blob(random.index(n), 1 + random.index(20), kSource, terminal);
		std::vector<int> sinks;
		for (int i = 1 + random.index(3); i > 0; --i)
			for (const int t : c.blob(random.index(n), 1 + random.index(20), kSink, terminal))
				sinks.push_back(t);
		if (sources.empty() || sinks.empty())
			continue;
		BorderFlow flow(c.graph);
		flow.find(sources, sinks, terminal);
		expectFlow(c, terminal, flow);
		const std::int64_t begin = sent(c, kSource, terminal, flow);
		EXPECT_GE(begin, 0);

		const MinCut::Side side =
			MinCut(n).run(sources, sinks, [&](int i, const MinCut::AddEdge& add) {
				for (int s = 3 * i; s < 3 * i + 3; ++s)
					if (const int other = c.graph.neighbour(s);
						other >= 0 &&
						(terminal[i] == kNoTerminal || terminal[i] != terminal[other / 3]))
						add(other / 3,
							c.graph.weight(s) - flow.across(s),
							c.graph.weight(s) + flow.across(s));
			});
		Array<char> isOnSide(n, 0);
		for (const int i : side.nodes)
			isOnSide[i] = 1;
		for (const int i : sources)
			EXPECT_EQ(isOnSide[i] != 0, side.isOfSources);
		for (const int i : sinks)
			EXPECT_EQ(isOnSide[i] != 0, !side.isOfSources);
		std::int64_t cut = 0;
		for (int s = 0; s < 3 * n; ++s)
			if (const int other = c.graph.neighbour(s);
				other >= 0 && isOnSide[s / 3] && !isOnSide[other / 3])
				cut += c.graph.weight(s);
		EXPECT_EQ(cut, flowBetween(n + 2, linksOf(c, terminal), n, n + 1));
		EXPECT_LE(begin, cut);
		cuts += cut > 0;
		begun += begin > 0;
	}
	EXPECT_GT(cuts, 150);
	EXPECT_GT(begun, 60);
}

/// Both at the border of a disk: then nothing is left to be found.
TEST(BorderFlow, BetweenBlobsAtTheBorderIsTheMaximum)
{
	Random random(1221);
	int count = 0;
	for (int trial = 0; trial < 100; ++trial) {
		const int size = 8;
		const RandomChart c(random, size, true);
		const int n = c.chart.triangles.size();
		Array<Terminal> terminal(n, kNoTerminal);
		// The first and the last row of the grid.
		const auto sources =
			c.blob(random.index(2 * size), 1 + random.index(30), kSource, terminal);
		const auto sinks =
			c.blob(n - 1 - random.index(2 * size), 1 + random.index(30), kSink, terminal);
		BorderFlow flow(c.graph);
		flow.find(sources, sinks, terminal);
		expectFlow(c, terminal, flow);
		// A blob may reach the border at several places, or with a corner of a triangle only.
		const std::int64_t all = flowBetween(n + 2, linksOf(c, terminal), n, n + 1);
		count += sent(c, kSource, terminal, flow) == all;
	}
	EXPECT_GE(count, 80);
}

} // namespace
} // namespace ricci::testing
