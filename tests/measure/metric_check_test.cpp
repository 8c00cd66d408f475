// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/flipped_flow.h"
#include "support/intrinsic.h"
#include "support/random_surface.h"

#include <ricci/base/numbers.h>
#include <ricci/hyperbolic/group_of_cut.h>
#include <ricci/measure/map_check.h>
#include <ricci/metric/geometry.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ricci::testing {
namespace {

/// A metric near that of a mesh, with the target that it has, and with known errors.
template<class Geometry>
void agreesAndDetects(Background background, double scale)
{
	SCOPED_TRACE(scale);
	Random random(600);
	for (const SurfaceMesh& mesh :
		 {bumpyTorus(9, 7, random), randomPlanarDisk(6, random), perforatedSlab(2, 1)}) {
		const Packed packed(mesh);
		GeometricCurvatureMap<Geometry> map(packed.triangulation, packed.delta);
		VertexVector u = packed.u();
		for (double& x : u)
			x += std::log(scale) + random.real(-1e-3, 1e-3);
		map.evaluate(u);
		ASSERT_EQ(map.brokenTriangles(), 0);
		const auto check = [&](const EdgeArray<double>& lengths, const VertexVector& target) {
			return checkMetric(background, map, u, lengths, target);
		};
		const VertexVector& K = map.curvature();
		const MetricCheck good = check(map.lengths(), K);
		EXPECT_EQ(good.lengthError, 0.0);
		EXPECT_LT(good.curvatureError, 1e-14); // the flow's own sums
		EXPECT_EQ(good.broken, 0);

		// A target that is missed by a known amount.
		VertexVector target = K;
		target[Vertex(3)] += 1e-6;
		MetricCheck bad = check(map.lengths(), target);
		EXPECT_NEAR(bad.curvatureError, 1e-6, 1e-11);
		target[Vertex(3)] = std::numeric_limits<double>::quiet_NaN(); // nothing prescribed
		EXPECT_LT(check(map.lengths(), target).curvatureError, 1e-14);

		// A length that is not that of its circles.
		EdgeArray<double> lengths = map.lengths();
		lengths[Edge(5)] *= 1.0 + 1e-6;
		bad = check(lengths, K);
		EXPECT_NEAR(bad.lengthError, 1e-6, 1e-11);
		EXPECT_GT(bad.curvatureError, 1e-8);
		lengths[Edge(5)] = lengths[Edge(6)] = 0.0;
		EXPECT_GT(check(lengths, K).broken, 0);
		lengths[Edge(5)] = std::numeric_limits<double>::quiet_NaN();
		EXPECT_TRUE(std::isinf(check(lengths, K).lengthError));
	}
}

TEST(MetricCheck, AgreesWithTheFlowsAndSeesWhatIsWrong)
{
	for (double scale : {1.0, 1e-6, 1e20})
		agreesAndDetects<Euclidean>(Background::EuclideanPlane, scale);
	for (double scale : {0.1, 1e-3})
		agreesAndDetects<Hyperbolic>(Background::HyperbolicPlane, scale);
}

TEST(MetricCheck, OpenCurvatureIsTheSumOfWhatTheFreeVerticesMiss)
{
	FlowResult flow;
	flow.curvature = VertexVector::LinSpaced(4, 1.0, 4.0);
	flow.target.curvature = VertexVector::Zero(4);
	flow.target.curvature << 1.5, 1.75, 3.0, -100.0;
	flow.target.fixed = {0, 0, 0, 1};
	EXPECT_EQ(openCurvature(flow), 0.5 + 0.25);
}

TEST(MetricCheck, RequiresTheTargetThatTheFlowSaysItHasReached)
{
	Random random(630);
	const SurfaceMesh mesh = bumpyTorus(10, 8, random);
	std::vector<double> cones(mesh.positions.size(), 0.0);
	cones[3] = 1.0;
	cones[40] = -1.0;
	FlippedFlow flow(mesh, prescribed(cones));
	const VertexArray<char> closed(mesh.positions.size(), 0);
	EXPECT_NO_THROW(requireMetric(flow.result, closed));
	flow.result.target.curvature[Vertex(3)] += 1e-6;
	const auto error = refusalFor<NotConverged>(
		NotConverged::CheckFailed, {}, [&] { requireMetric(flow.result, closed); });
	expectWords(error.finding, {"curvature 1e-06 off at one vertex"});
	expectWords(error.what(), {error.finding});
	flow.result.target.fixed[Vertex(3)] = 1; // nothing is prescribed there
	EXPECT_NO_THROW(requireMetric(flow.result, closed));
}

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
		disk.pairing = pairingOfArcs(flow.base(), cut, disk.pairing);
	}

	double error() const { return error(flow.result.target); }
	double error(const Target& target) const
	{
		return closingError(flow.base(), cut, disk, target);
	}
	FuchsianGroup group() const { return fuchsianGroup(flow.base(), cut, disk.pairing); }

	/// The same with \p extra at the place of h in the side pairing of the edge of \p side, on its side there.
	LaidOut with(const ExtendedIsometry& extra, Halfedge side) const
	{
		LaidOut wrong = *this;
		SidePairing& pairing = wrong.disk.pairing[side.edge()];
		ExtendedIsometry& frame = side.isFirst() ? pairing.left : pairing.right;
		frame = extra * frame;
		return wrong;
	}
};

/// Of genus 1 with two geodesic boundary loops.
SurfaceMesh pierced(Random& random)
{
	return withoutStars(shaken(perforatedSlab(1, 3), 0.03, random), {0, 70});
}

/// A side pairing that turns about a vertex by an angle too much, or moves it. Only on one edge, so that nothing is
/// wrong but at its ends.
TEST(HolonomyCheck, SeesATurnAndAMoveAtTheirTrueSize)
{
	Random random(793);
	const LaidOut right(shaken(perforatedSlab(2, 2), 0.06, random), hyperbolicMetric());
	const Triangulation& t = right.flow.base();
	int tried = 0;
	for (const Halfedge h : t.interiorHalfedges()) {
		int degree = 0;
		for (const Halfedge g : t.around(t.origin(h)))
			degree += right.cut.isCut[g.edge()];
		if (!right.cut.isCut[h.edge()] || degree == 2 || tried >= 6)
			continue;
		++tried;
		const Point2 here = right.disk.corners[h], end = right.disk.corners[t.next(h)];
		const double length = 2.0 * std::asinh(0.5 * chordLength(asComplex(here), asComplex(end)));
		for (const double size : {1e-3, 1e-5, 1e-7})
			for (const ExtendedIsometry& extra :
				 {ExtendedIsometry::rotation(size), ExtendedIsometry::translation(size)}) {
				const double error =
					right.with(placeOf(here) * extra * placeOf(here).inverse(), h).error();
				EXPECT_GE(error, size * (1.0 - 1e-3));
				EXPECT_LE(error, size * std::cosh(length) * (1.0 + 1e-3));
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

/// The axis is the boundary. Where the cut is crossed first on the way round its vertex, the axis is moved along
/// itself by a known amount more or less.
TEST(HolonomyCheck, AGeodesicBoundaryIsAsLongAsItsIsometryMovesItsAxis)
{
	Random random(790);
	const LaidOut right(pierced(random), hyperbolicMetric());
	EXPECT_LT(right.error(), 1e-11);
	const Triangulation& t = right.flow.base();
	int moved = 0;
	for (const Halfedge first : t.boundaryLoops())
		for (const Halfedge outside : t.loop(first)) {
			const Halfedge h = outside.twin();
			Halfedge in = t.previous(h);
			while (!t.isExterior(in.twin()) && !right.cut.isCut[in.edge()])
				in = t.previous(in.twin());
			if (t.isExterior(in.twin()))
				continue;
			const ExtendedIsometry place = placeOf(right.disk.corners[h]);
			const auto next = place.inverse()(asComplex(right.disk.corners[t.next(h)]));
			const ExtendedIsometry along = place * ExtendedIsometry::rotation(arg(next));
			const LaidOut wrong =
				right.with(along * ExtendedIsometry::translation(0.01) * along.inverse(), in);
			EXPECT_GE(wrong.error(), 0.01 - 1e-9);
			++moved;
		}
	EXPECT_GE(moved, 2);
}

/// Free, or with curvature at one vertex of each loop.
TEST(HolonomyCheck, BoundariesThatAreNotGeodesicAreLeftOut)
{
	Random random(791);
	const SurfaceMesh mesh = pierced(random);
	std::vector<double> curvature(mesh.positions.size(), 0.0);
	for (const std::vector<Vertex>& loop : topologyOf(glued(mesh)).loops)
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
