// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/error.h>
#include <ricci/flow/target_curvature.h>
#include <ricci/layout/planar_layout.h>
#include <ricci/layout/seam_cost.h>
#include <ricci/layout/seams.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ricci::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;

constexpr double kFar = std::numeric_limits<double>::infinity();

double costOf(const std::vector<char>& isCut, const std::vector<double>& cost)
{
	double sum = 0.0;
	for (std::size_t e = 0; e < cost.size(); ++e)
		sum += isCut[e] ? cost[e] : 0.0;
	return sum;
}

/// The cut surface is one disk that has every marked vertex on its boundary.
void expectDiskThroughMarks(
	const Triangulation& t, const std::vector<char>& isCut, const std::vector<char>& marked)
{
	expectOpensToADisk(t, isCut);
	std::vector<char> onCut = t.boundaryVertices();
	for (int e = 0; e < t.edgeCount(); ++e)
		if (isCut[at(e)])
			onCut[at(t.origin(2 * e))] = onCut[at(t.target(2 * e))] = 1;
	for (std::size_t v = 0; v < marked.size(); ++v)
		EXPECT_TRUE(!marked[v] || onCut[v]) << "vertex " << v;
}

/// A cut that nobody would want: all edges but those that a breadth-first search of the faces
/// crosses, less the dead ends without a mark.
std::vector<char> clumsyCut(const Triangulation& t, const std::vector<char>& marked)
{
	std::vector<char> isCut(at(t.edgeCount()), 1), seen(at(t.faceCount()), 0);
	std::vector<int> queue{0};
	seen[0] = 1;
	for (std::size_t head = 0; head < queue.size(); ++head)
		for (int h : t.halfedges(queue[head])) {
			const int g = Triangulation::twin(h);
			if (!t.isOuter(g) && !seen[at(t.face(g))]) {
				seen[at(t.face(g))] = 1;
				isCut[at(Triangulation::edge(h))] = 0;
				queue.push_back(t.face(g));
			}
		}
	const auto boundary = t.boundaryVertices();
	for (int e = 0; e < t.edgeCount(); ++e)
		if (t.isBoundaryEdge(e))
			isCut[at(e)] = 0;
	for (bool changed = true; changed;) {
		changed = false;
		std::vector<int> degree(at(t.vertexCount()), 0);
		for (int h = 0; h < t.halfedgeCount(); ++h)
			degree[at(t.origin(h))] += isCut[at(Triangulation::edge(h))];
		for (int h = 0; h < t.halfedgeCount(); ++h) {
			const int v = t.origin(h);
			if (isCut[at(Triangulation::edge(h))] && degree[at(v)] == 1 && !marked[at(v)] &&
				!boundary[at(v)]) {
				isCut[at(Triangulation::edge(h))] = 0;
				changed = true;
				break;
			}
		}
	}
	return isCut;
}

/// Distances along edges between all vertices (Floyd and Warshall).
std::vector<std::vector<double>>
allDistances(const Triangulation& t, const std::vector<double>& lengths)
{
	const std::size_t n = at(t.vertexCount());
	std::vector<std::vector<double>> d(n, std::vector<double>(n, kFar));
	for (std::size_t v = 0; v < n; ++v)
		d[v][v] = 0.0;
	for (int h = 0; h < t.halfedgeCount(); ++h) {
		double& x = d[at(t.origin(h))][at(t.target(h))];
		x = std::min(x, lengths[at(Triangulation::edge(h))]);
	}
	for (std::size_t k = 0; k < n; ++k)
		for (std::size_t i = 0; i < n; ++i)
			for (std::size_t j = 0; j < n; ++j)
				d[i][j] = std::min(d[i][j], d[i][k] + d[k][j]);
	return d;
}

TEST(Seams, StayADiskThroughTheMarksAndGetShorter)
{
	Random random(720);
	for (const SurfaceMesh& mesh : surfacesOfEveryKind(random)) {
		const Packed p(mesh);
		const Triangulation& t = p.triangulation;
		const Topology topology = topologyOf(t);
		SCOPED_TRACE(topology.name());
		for (int count : {0, 3, 7}) {
			std::vector<char> marked(mesh.positions.size(), 0);
			for (int i = 0; i < count; ++i)
				marked[at(random.index(static_cast<int>(marked.size())))] = 1;
			if (topology.isClosed() && topology.genus == 0 && count == 0)
				continue;
			std::vector<char> isCut = clumsyCut(t, marked);
			expectDiskThroughMarks(t, isCut, marked);
			const double before = costOf(isCut, p.lengths);
			shortenCut(t, p.lengths, marked, {}, isCut);
			expectDiskThroughMarks(t, isCut, marked);
			const double after = costOf(isCut, p.lengths);
			EXPECT_LE(after, before * (1 + 1e-12));
			// Nothing is left to gain.
			shortenCut(t, p.lengths, marked, {}, isCut);
			EXPECT_NEAR(costOf(isCut, p.lengths), after, 1e-9 * after);
		}
	}
}

/// Between two moves the cut is a disk's, so that a search may end there.
TEST(Seams, ASearchThatIsEndedLeavesADisk)
{
	Random random(723);
	const Packed p(shaken(perforatedSlab(6, 3), 0.05, random));
	const Triangulation& t = p.triangulation;
	std::vector<char> marked(at(t.vertexCount()), 0);
	for (int i = 0; i < 120; ++i)
		marked[at(random.index(t.vertexCount()))] = 1;
	const std::vector<char> clumsy = clumsyCut(t, marked);
	int ticks = 0;
	std::vector<char> whole = clumsy;
	shortenCut(t, p.lengths, marked, {}, whole, [&] { ++ticks; });
	EXPECT_GE(ticks, 3);
	double before = costOf(clumsy, p.lengths);
	for (int n = 1; n <= ticks; ++n) {
		std::vector<char> isCut = clumsy;
		int left = n;
		EXPECT_THROW(
			shortenCut(
				t,
				p.lengths,
				marked,
				{},
				isCut,
				[&] {
					if (--left == 0)
						throw Cancelled();
				}),
			Cancelled);
		expectDiskThroughMarks(t, isCut, marked);
		const double now = costOf(isCut, p.lengths);
		EXPECT_LE(now, before * (1 + 1e-12));
		before = now;
	}
	EXPECT_LE(costOf(whole, p.lengths), before * (1 + 1e-12));
}

TEST(Seams, JoinTwoMarksByAShortestPath)
{
	Random random(721);
	const Packed p(shaken(perforatedSlab(0, 2), 0.05, random));
	const Triangulation& t = p.triangulation;
	const auto distance = allDistances(t, p.lengths);
	for (int i = 0; i < 20; ++i) {
		const int a = random.index(t.vertexCount()), b = random.index(t.vertexCount());
		if (a == b)
			continue;
		std::vector<char> marked(at(t.vertexCount()), 0);
		marked[at(a)] = marked[at(b)] = 1;
		std::vector<char> isCut = clumsyCut(t, marked);
		shortenCut(t, p.lengths, marked, {}, isCut);
		EXPECT_NEAR(costOf(isCut, p.lengths), distance[at(a)][at(b)], 1e-12);
	}
}

TEST(Seams, JoinThreeMarksNearlyAsShortAsCanBe)
{
	Random random(722);
	const Packed p(shaken(perforatedSlab(0, 2), 0.05, random));
	const Triangulation& t = p.triangulation;
	const auto distance = allDistances(t, p.lengths);
	int shortest = 0, all = 0;
	for (int i = 0; i < 30; ++i) {
		std::size_t mark[3];
		for (std::size_t& m : mark)
			m = at(random.index(t.vertexCount()));
		if (mark[0] == mark[1] || mark[1] == mark[2] || mark[2] == mark[0])
			continue;
		std::vector<char> marked(at(t.vertexCount()), 0);
		for (std::size_t m : mark)
			marked[m] = 1;
		std::vector<char> isCut = clumsyCut(t, marked);
		shortenCut(t, p.lengths, marked, {}, isCut);
		const double found = costOf(isCut, p.lengths);
		double least = kFar;
		for (std::size_t v = 0; v < marked.size(); ++v)
			least =
				std::min(least, distance[v][mark[0]] + distance[v][mark[1]] + distance[v][mark[2]]);
		const double ab = distance[mark[0]][mark[1]], bc = distance[mark[1]][mark[2]],
					 ca = distance[mark[2]][mark[0]];
		EXPECT_GE(found, least - 1e-12);
		// No longer than the paths between the marks, without a branch elsewhere.
		EXPECT_LE(found, ab + bc + ca - std::max({ab, bc, ca}) + 1e-12);
		shortest += found < least + 1e-12;
		++all;
	}
	EXPECT_GT(shortest, all / 2);
}

TEST(Seams, KeepOffForbiddenEdges)
{
	Random random(723);
	const Packed p(bumpyTorus(14, 9, random));
	const std::vector<char> unmarked(p.radii.size(), 0);
	std::vector<char> isCut = clumsyCut(p.triangulation, unmarked);
	std::vector<char> forbidden(p.lengths.size(), 0);
	for (std::size_t e = 0; e < forbidden.size(); e += 3)
		forbidden[e] = !isCut[e];
	shortenCut(p.triangulation, p.lengths, unmarked, forbidden, isCut);
	expectDiskThroughMarks(p.triangulation, isCut, unmarked);
	for (std::size_t e = 0; e < forbidden.size(); ++e)
		EXPECT_FALSE(forbidden[e] && isCut[e]);
}

/// A square patch with a groove along x = 0 and a ridge along x = 1.
SurfaceMesh grooveAndRidge(int n)
{
	return grid(n, n, Ends::Open, Ends::Open, [n](int i, int j) {
		const double x = 3.0 * i / n - 1.0, y = 3.0 * j / n;
		const double z = 0.2 * std::exp(-30 * (x - 1) * (x - 1)) - 0.2 * std::exp(-30 * x * x);
		return Point3{x, y, z};
	});
}

TEST(SeamCost, IsLowInHollowsAndHighOnRidges)
{
	const SurfaceMesh mesh = grooveAndRidge(48);
	const Packed p(mesh);
	const std::vector<double> exposed = exposure(p.triangulation, p.lengths, mesh.positions);
	const auto column = [&](double x, double& low, double& high) {
		low = 1.0;
		high = 0.0;
		for (std::size_t v = 0; v < exposed.size(); ++v) {
			const Point3& q = mesh.positions[v];
			if (std::abs(q[0] - x) < 0.02 && q[1] > 0.5 && q[1] < 2.5) {
				low = std::min(low, exposed[v]);
				high = std::max(high, exposed[v]);
			}
		}
	};
	double grooveLow, grooveHigh, ridgeLow, ridgeHigh;
	column(0.0, grooveLow, grooveHigh);
	column(1.0, ridgeLow, ridgeHigh);
	EXPECT_LT(grooveHigh, 0.25);
	EXPECT_GT(ridgeLow, 0.75);
	for (double x : exposed) {
		EXPECT_GE(x, 0.0);
		EXPECT_LE(x, 1.0);
	}
	// Turned over, hollows become ridges.
	SurfaceMesh other = mesh;
	for (Triangle& t : other.triangles)
		std::swap(t[1], t[2]);
	const Packed q(other);
	const std::vector<double> opposite = exposure(q.triangulation, q.lengths, other.positions);
	for (std::size_t v = 0; v < exposed.size(); ++v)
		EXPECT_NEAR(exposed[v] + opposite[v], 1.0, 1e-9);
}

/// A prism over a star whose corners are at the distances R + d and R - d from its axis in turn: the
/// sum of two eigenvectors of its Laplacian, which smoothing shrinks to 1 / (1 + t e) for the
/// eigenvalue e. Its faces are vertical, so that the heights depend on nothing else.
TEST(SeamCost, ExposureOfAStarIsThatOfItsTwoModes)
{
	constexpr int n = 16, rows = 8;
	constexpr double R = 2.0, d = 0.3, sector = 2 * kPi / n;
	const double outer = R + d, inner = R - d;
	const double side =
		std::sqrt(outer * outer + inner * inner - 2 * outer * inner * std::cos(sector));
	const double storey = 0.9 * side;
	const SurfaceMesh mesh = grid(n, rows, Ends::Joined, Ends::Open, [&](int i, int j) {
		const double r = i % 2 == 0 ? outer : inner;
		return Point3{r * std::cos(i * sector), r * std::sin(i * sector), j * storey};
	});
	const Packed p(mesh);
	const double time = n * rows * side * storey / 400.0; // of the area
	const auto lost = [&](double cosine) {
		const double e = 2 * (1 - cosine) / (side * side);
		return time * e / (1 + time * e);
	};
	const double ofCircle = lost(std::cos(sector)) * R, ofTeeth = lost(-std::cos(sector)) * d;
	// Two of three triangles at a vertex of the first and last row are on one side of it.
	const auto tilt = [&](double r, double neighbour) {
		const double along = (r - neighbour * std::cos(sector)) / side; // sine of half the exterior
		const double cosine = neighbour * std::sin(sector) / side;      // angle, and cosine
		return 3 * cosine / std::hypot(3 * cosine, along);
	};
	const double heights[] = {ofCircle + ofTeeth, ofCircle - ofTeeth};
	const double tilted[] = {heights[0] * tilt(outer, inner), heights[1] * tilt(inner, outer)};
	double square = 0.0;
	for (int k : {0, 1})
		square += ((rows - 1) * heights[k] * heights[k] + tilted[k] * tilted[k]) / (2.0 * rows);
	const std::vector<double> exposed = exposure(p.triangulation, p.lengths, mesh.positions);
	for (std::size_t v = 0; v < exposed.size(); ++v) {
		const Point3& q = mesh.positions[v];
		const int k = std::hypot(q[0], q[1]) > R ? 0 : 1;
		const bool atEnd = q[2] < 0.5 * storey || q[2] > (rows - 0.5) * storey;
		const double height = atEnd ? tilted[k] : heights[k];
		// The diagonals of the cells, which are rectangles, have a weight of 1e-6.
		EXPECT_NEAR(exposed[v], 0.5 * (1 + std::tanh(height / std::sqrt(square))), 1e-5);
	}
	EXPECT_LT(heights[1], 0.0); // or one mode alone decides
}

TEST(SeamCost, IsTheLengthWhereNothingIsToBeHidden)
{
	Random random(724);
	const SurfaceMesh mesh = bumpyTorus(14, 9, random);
	const Packed p(mesh);
	EXPECT_EQ(seamCost(p.triangulation, p.lengths, mesh.positions, 0.0), p.lengths);
	const auto hidden = seamCost(p.triangulation, p.lengths, mesh.positions, 1.0);
	for (std::size_t e = 0; e < hidden.size(); ++e) {
		EXPECT_GE(hidden[e], p.lengths[e]);
		EXPECT_LE(hidden[e], 10.0 * p.lengths[e]);
	}
}

} // namespace
} // namespace ricci::testing
