// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/base/numbers.h>
#include <ricci/cut/cone_wedges.h>
#include <ricci/cut/cut_graph.h>
#include <ricci/surface/triangulation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ricci::testing {
namespace {

/// Marked vertices, and the angles that cones there will have.
struct Cones
{
	VertexArray<char> marked;
	VertexArray<double> angle;

	Cones(const Triangulation& t, int count, double maxAngle, Random& random) :
			marked(t.vertexCount(), 0), angle(t.vertexCount(), 0.0)
	{
		const VertexArray<char> boundary = t.boundaryVertices();
		for (int i = 0; i < count; ++i) {
			const Vertex v(random.index(t.vertexCount()));
			if (boundary[v])
				continue;
			marked[v] = 1;
			angle[v] = random.real(0.5 * kPi, maxAngle);
		}
	}
};

/// Angles between the cut edges at \p v, one after another; all of it where there is at most one.
std::vector<double> wedgesAt(
	const Triangulation& t,
	const EdgeArray<char>& isCut,
	const HalfedgeArray<double>& corners,
	Vertex v)
{
	std::vector<Halfedge> star;
	for (const Halfedge h : t.halfedges())
		if (t.origin(h) == v && !t.isExterior(h))
			star.push_back(h);
	std::vector<double> wedges;
	double total = 0.0;
	for (const Halfedge first : star) {
		total += corners[first];
		if (!isCut[first.edge()])
			continue;
		double angle = 0.0;
		Halfedge h = first;
		do {
			angle += corners[h];
			h = t.next(t.next(h)).twin(); // counter-clockwise
		} while (!isCut[h.edge()]);
		wedges.push_back(angle);
	}
	return wedges.empty() ? std::vector<double>{total} : wedges;
}

TEST(ConeWedges, CornersAddUpToTheConeAngleInTheRatiosOfTheSurface)
{
	Random random(910);
	const Packed p(shaken(perforatedSlab(2, 4), 0.1, random));
	const Triangulation& t = p.triangulation;
	const Cones cones(t, 12, 5 * kPi, random);
	const HalfedgeArray<double> corners = coneCorners(t, p.lengths, cones.angle);
	const HalfedgeArray<double> onSurface =
		coneCorners(t, p.lengths, VertexArray<double>(t.vertexCount(), 1.0));
	VertexArray<double> sum(t.vertexCount(), 0.0);
	for (const Halfedge h : t.halfedges()) {
		sum[t.origin(h)] += corners[h];
		EXPECT_NEAR(corners[h], onSurface[h] * cones.angle[t.origin(h)], 1e-13);
	}
	for (const Vertex v : t.vertices())
		EXPECT_NEAR(sum[v], cones.angle[v], 1e-12);
}

TEST(ConeWedges, OfARightAngle)
{
	// Two triangles of a unit square: 45 and 45 degrees at one end of the diagonal, 90 at the others.
	const Packed p(rectangle(1, 1, 1.0, 1.0));
	const Triangulation& t = p.triangulation;
	VertexArray<double> angle(t.vertexCount(), 0.0);
	for (const Vertex v : t.vertices())
		angle[v] = kPi / 2;
	const HalfedgeArray<double> corners = coneCorners(t, p.lengths, angle);
	int right = 0, half = 0;
	for (const Halfedge h : t.halfedges())
		if (!t.isExterior(h)) {
			right += std::abs(corners[h] - kPi / 2) < 1e-14;
			half += std::abs(corners[h] - kPi / 4) < 1e-14;
		}
	EXPECT_EQ(right, 2);
	EXPECT_EQ(half, 4);
}

/// A cut through cones of up to 5 pi on surfaces of every kind. Where their curvatures add up to less
/// than Gauss-Bonnet asks of a flat metric, or the boundary has to take the rest, a cut to a disk may
/// not reach every cone often enough.
TEST(ConeWedges, NoneIsWiderThanAFullTurnAndTheCutStaysADisk)
{
	Random random(911);
	int before = 0, after = 0, cones = 0;
	for (const SurfaceMesh& mesh : surfacesOfEveryKind(random)) {
		const Packed p(mesh);
		const Triangulation& t = p.triangulation;
		const Cones chosen(t, 9, 5 * kPi, random);
		if (std::count(chosen.marked.begin(), chosen.marked.end(), 1) < 2)
			continue;
		const HalfedgeArray<double> corners = coneCorners(t, p.lengths, chosen.angle);
		const CutGraph plain = cutToDisk(t, p.lengths, chosen.marked);
		const CutGraph cut = cutToDisk(t, p.lengths, chosen.marked, corners);
		expectOpensToADisk(t, cut.isCut);
		EXPECT_EQ(cut.generators.size(), plain.generators.size());
		EXPECT_GE(cut.length, plain.length * (1 - 1e-9));
		for (const Vertex v : t.vertices()) {
			if (!chosen.marked[v])
				continue;
			++cones;
			const auto tooWide = [&](const EdgeArray<char>& isCut) {
				const auto wedges = wedgesAt(t, isCut, corners, v);
				return std::count_if(
					wedges.begin(), wedges.end(), [](double angle) { return angle > 2 * kPi; });
			};
			before += static_cast<int>(tooWide(plain.isCut));
			const int left = static_cast<int>(tooWide(cut.isCut));
			const SurfaceType type = topologyOf(t).type;
			EXPECT_TRUE(left == 0 || !type.isClosed() || type.genus < 2) << left;
			after += left;
		}
	}
	EXPECT_GT(cones, 50);
	EXPECT_GT(before, 50) << "these cuts test nothing";
	EXPECT_LT(after, before / 3);
}

/// Where no wedge is too wide, the cut is the one without corners.
TEST(ConeWedges, NarrowConesChangeNothing)
{
	Random random(912);
	const Packed p(shaken(perforatedSlab(1, 5), 0.1, random));
	const Triangulation& t = p.triangulation;
	const Cones cones(t, 10, 1.8 * kPi, random);
	const HalfedgeArray<double> corners = coneCorners(t, p.lengths, cones.angle);
	const CutGraph plain = cutToDisk(t, p.lengths, cones.marked);
	const CutGraph cut = cutToDisk(t, p.lengths, cones.marked, corners);
	EXPECT_TRUE(cut.isCut == plain.isCut);
}

} // namespace
} // namespace ricci::testing
