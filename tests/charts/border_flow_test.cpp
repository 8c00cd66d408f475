// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flat_meshes.h"
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
	FlatMesh chart;
	DualGraph graph;

	RandomChart(Random& random, int size, bool isWhole) :
			chart(chartOf(random, size, isWhole)), graph(chart)
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
			for (const Corner side : cornersOf(triangles[i]))
				if (const Corner other = graph.neighbour(side);
					other.isValid() && static_cast<int>(triangles.size()) < count)
					take(other.face());
		return triangles;
	}

private:
	static FlatMesh chartOf(Random& random, int size, bool isWhole)
	{
		SurfaceMesh mesh = rectangle(size, size, 1.0, 1.0), rest{mesh.positions, {}};
		for (const Triangle& t : mesh.triangles)
			if (isWhole || random.index(20) != 0)
				rest.triangles.push_back(t);
		FlatMesh chart = flatMesh(rest);
		for (const int f : chart.points.indices())
			for (const Corner side : cornersOf(f)) {
				chart.lengths[side] = random.real(0.1, 1.0);
				if (const Corner other = chart.across[side]; other.isValid())
					chart.lengths[other] = chart.lengths[side]; // the same on both sides
			}
		return chart;
	}
};

/// What is sent between the terminals is a flow.
void expectFlow(const RandomChart& c, const Array<Terminal>& terminal, const BorderFlow& flow)
{
	for (const int i : terminal.indices()) {
		std::int64_t sum = 0;
		for (const Corner side : cornersOf(i)) {
			sum += flow.across(side);
			const Corner other = c.graph.neighbour(side);
			if (other.isValid()) {
				EXPECT_EQ(flow.across(other), -flow.across(side));
				if (terminal[i] == kNoTerminal || terminal[i] != terminal[other.face()]) {
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
		for (const Corner side : cornersOf(i))
			if (const Corner other = c.graph.neighbour(side);
				terminal[i] == kind && other.isValid() && terminal[other.face()] != kind)
				sum += flow.across(side);
	return sum;
}

/// The edges of part 0, with all sources joined to one node more, and all sinks to another.
std::vector<Link> linksOf(const RandomChart& c, const Array<Terminal>& terminal)
{
	std::vector<Link> links;
	const int n = terminal.size();
	for (const int i : terminal.indices()) {
		for (const Corner side : cornersOf(i))
			if (const Corner other = c.graph.neighbour(side); other > side)
				links.push_back({i, other.face(), c.graph.weight(side), c.graph.weight(side)});
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
		const int n = c.chart.size();
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
				for (const Corner s : cornersOf(i))
					if (const Corner other = c.graph.neighbour(s);
						other.isValid() &&
						(terminal[i] == kNoTerminal || terminal[i] != terminal[other.face()]))
						add(other.face(),
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
		for (const int i : isOnSide.indices())
			for (const Corner s : cornersOf(i))
				if (const Corner other = c.graph.neighbour(s);
					other.isValid() && isOnSide[i] && !isOnSide[other.face()])
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
		const int n = c.chart.size();
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

/// The least cut is far from both ends, which are few: the border leads a path there past hundreds of vertices.
TEST(BorderFlow, FindsAFarCutToo)
{
	Random random(1222);
	const int size = 40;
	RandomChart c(random, size, true);
	const auto isInMiddle = [](const Point2& p) { return std::abs(p[0] - 0.5) < 1e-9; };
	for (const int f : c.chart.points.indices())
		for (const Corner side : cornersOf(f)) {
			const auto ends = c.chart.ends(side);
			c.chart.lengths[side] = isInMiddle(ends[0]) && isInMiddle(ends[1]) ? 1e-4 : 1.0;
		}
	const int n = c.chart.size();
	Array<Terminal> terminal(n, kNoTerminal);
	const auto sources = c.blob(0, 1, kSource, terminal);
	const auto sinks = c.blob(n - 1, 1, kSink, terminal);
	BorderFlow flow(c.graph);
	flow.find(sources, sinks, terminal);
	expectFlow(c, terminal, flow);
	const std::int64_t all = flowBetween(n + 2, linksOf(c, terminal), n, n + 1);
	EXPECT_NEAR(static_cast<double>(all), size * 1e5, size * 1e2); // about 1e9 for the longest edge
	EXPECT_EQ(sent(c, kSource, terminal, flow), all);
}

} // namespace
} // namespace ricci::testing
