// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/complex.h"
#include "support/flipped_flow.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/fuchsian/fuchsian_group.h>
#include <ricci/math/disk_isometry.h>
#include <ricci/verify/holonomy_check.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

ExtendedIsometry placeOf(const Point2& p)
{
	return ExtendedIsometry::translationTo(asComplex(p));
}

/// A hyperbolic surface laid out in the disk, with its side pairings.
struct LaidOut
{
	FlippedFlow flow;
	CutGraph cut;
	SurfaceLayout disk;

	LaidOut(const SurfaceMesh& mesh, const HyperbolicRequest& request) :
			flow(mesh, request, 1e-12), cut(flow.cut()), disk(flow.refinement(cut))
	{
		disk.pairing = pairingOfArcs(flow.base(), cut, disk.pairing, flow.cones());
	}

	double error() const { return error(flow.result.target); }
	double error(const Target& target) const
	{
		return holonomyError(flow.base(), cut, disk, flow.cones(), target);
	}

	FuchsianGroup group() const
	{
		return fuchsianGroup(flow.base(), cut, disk.pairing, flow.cones());
	}

	/// Moves all of it in the disk.
	void move(const ExtendedIsometry& m)
	{
		for (Point2& p : disk.corners.points) {
			const auto z = std::complex<double>(m(asComplex(p)));
			p = {z.real(), z.imag()};
		}
		for (const Edge e : flow.base().edges())
			if (cut.isCut[e]) {
				disk.pairing[e].left = m * disk.pairing[e].left;
				disk.pairing[e].right = m * disk.pairing[e].right;
			}
	}

	int degree(Vertex v) const
	{
		int edges = 0;
		for (const Halfedge h : flow.base().halfedges())
			edges += flow.base().origin(h) == v && cut.isCut[h.edge()];
		return edges;
	}
};

/// Of genus 1 with two geodesic boundary loops.
SurfaceMesh pierced(Random& random)
{
	return withoutStars(shaken(perforatedSlab(1, 3), 0.03, random), {0, 70});
}

TEST(HolonomyCheck, LayoutsCloseUp)
{
	Random random(790);
	for (const int genus : {2, 3, 4})
		EXPECT_LT(
			LaidOut(shaken(perforatedSlab(genus, 2), 0.06, random), hyperbolicMetric()).error(),
			1e-11);
	EXPECT_LT(LaidOut(pierced(random), hyperbolicMetric()).error(), 1e-11);
}

/// What remains round a vertex is the same wherever the layout lies, but for the rounding of its
/// places. As seen from 0 it is not: it grows with the way there.
TEST(HolonomyCheck, DoesNotDependOnThePlaceOfTheLayout)
{
	Random random(792);
	LaidOut surface(shaken(perforatedSlab(3, 2), 0.06, random), hyperbolicMetric());
	const double atMiddle = surface.group().polygonError;
	EXPECT_LT(atMiddle, 1e-8);
	const double way = 12.0;
	surface.move(ExtendedIsometry::translation(way));
	EXPECT_LT(surface.error(), 1e-6);
	EXPECT_GT(surface.group().polygonError, 1e-2 * std::exp(way) * atMiddle);
}

/// A side pairing that turns about a vertex by an angle too much, or moves it.
TEST(HolonomyCheck, SeesATurnAndAMoveAtTheirTrueSize)
{
	Random random(793);
	const LaidOut right(shaken(perforatedSlab(2, 2), 0.06, random), hyperbolicMetric());
	const Triangulation& t = right.flow.base();
	int tried = 0;
	for (const Halfedge h : t.interiorHalfedges()) {
		const Vertex v = t.origin(h);
		if (!right.cut.isCut[h.edge()] || right.degree(v) == 2 || tried >= 6)
			continue;
		++tried;
		const ExtendedIsometry place = placeOf(right.disk.corners[h]);
		for (const double size : {1e-3, 1e-5, 1e-7})
			for (const ExtendedIsometry& extra :
				 {ExtendedIsometry::rotation(size), ExtendedIsometry::translation(size)}) {
				LaidOut wrong = right;
				// Only on this edge, so that nothing is wrong but at its ends.
				SidePairing& side = wrong.disk.pairing[h.edge()];
				ExtendedIsometry& frame = h.isFirst() ? side.left : side.right;
				frame = place * extra * place.inverse() * frame;
				const Halfedge end = t.next(h);
				const double length = 2.0 * std::asinh(
												0.5 * chordLength(
														  asComplex(right.disk.corners[h]),
														  asComplex(right.disk.corners[end])));
				EXPECT_GE(wrong.error(), size * (1.0 - 1e-3));
				EXPECT_LE(wrong.error(), size * std::cosh(length) * (1.0 + 1e-3));
			}
	}
	EXPECT_EQ(tried, 6);
}

TEST(HolonomyCheck, ConesAreRotationsByTheirAngle)
{
	Random random(794);
	const SurfaceMesh sphere = shaken(perforatedSlab(0, 3), 0.05, random);
	std::vector<double> curvature(sphere.positions.size(), 0.0);
	for (const std::size_t v : {3u, 20u, 40u})
		curvature[v] = 1.5 * kPi;
	const LaidOut surface(sphere, hyperbolicPrescribed(curvature));
	EXPECT_LT(surface.error(), 1e-11);
	for (const int v : {3, 20, 40}) {
		Target other = surface.flow.result.target;
		other.curvature[Vertex(v)] += 0.01;
		EXPECT_NEAR(
			surface.error(other),
			2 * std::abs(std::cos(0.75 * kPi) - std::cos(0.75 * kPi + 0.005)),
			1e-10);
	}
}

TEST(HolonomyCheck, AGeodesicBoundaryIsAsLongAsItsIsometryMovesItsAxis)
{
	Random random(790);
	const LaidOut right(pierced(random), hyperbolicMetric());
	EXPECT_LT(right.error(), 1e-11);
	const Triangulation& t = right.flow.base();
	int moved = 0;
	for (const Halfedge first : t.boundaryLoops())
		for (const Halfedge outside : t.loop(first)) {
			// The axis is the boundary. Where the cut is crossed first on the way round its vertex, the
			// axis is moved along itself by a known amount more or less.
			const Halfedge h = outside.twin();
			Halfedge in = t.previous(h);
			while (!t.isExterior(in.twin()) && !right.cut.isCut[in.edge()])
				in = t.previous(in.twin());
			if (t.isExterior(in.twin()))
				continue;
			const ExtendedIsometry place = placeOf(right.disk.corners[h]);
			const auto next = place.inverse()(asComplex(right.disk.corners[t.next(h)]));
			const ExtendedIsometry along = place * ExtendedIsometry::rotation(arg(next));
			LaidOut wrong = right;
			SidePairing& side = wrong.disk.pairing[in.edge()];
			ExtendedIsometry& frame = in.isFirst() ? side.left : side.right;
			frame = along * ExtendedIsometry::translation(0.01) * along.inverse() * frame;
			EXPECT_GE(wrong.error(), 0.01 - 1e-9);
			++moved;
		}
	EXPECT_GE(moved, 2);
}

TEST(HolonomyCheck, BoundariesThatAreNotGeodesicAreLeftOut)
{
	Random random(791);
	// Free, or with curvature at one vertex of each loop.
	const SurfaceMesh mesh = pierced(random);
	const Topology topology =
		topologyOf(Triangulation(static_cast<int>(mesh.positions.size()), mesh.triangles));
	std::vector<double> curvature(mesh.positions.size(), 0.0);
	for (const std::vector<Vertex>& loop : topology.loops)
		curvature[at(loop.front())] = 0.3;
	for (const LaidOut& surface :
		 {LaidOut(mesh, hyperbolicMetric(true)), LaidOut(mesh, hyperbolicPrescribed(curvature))}) {
		EXPECT_EQ(surface.group().peripheral.size(), 2u);
		EXPECT_LT(surface.error(), 1e-11);
		Target geodesic = surface.flow.result.target;
		geodesic.curvature.setZero();
		geodesic.fixed.assign(geodesic.fixed.size(), 0);
		EXPECT_GT(surface.error(geodesic), 1e-3);
	}
}

} // namespace
} // namespace ricci::testing
