// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/bolza.h"
#include "support/complex.h"
#include "support/flipped_flow.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/wide.h"

#include <ricci/layout/corner_layout.h>
#include <ricci/layout/hyperbolic_layout.h>
#include <ricci/metric/geometry.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

/// Triangles in the Poincaré disk as a surface of curvature -1.
struct HyperbolicCheck
{
	std::vector<long double> defect; ///< [vertex] 2 pi, pi on the boundary, less the angles
	long double area = 0.0L;
	int flipped = 0; ///< geodesic triangles that are not counter-clockwise
	/// Both sides of the edges that are not joined, which have to be as long as each other.
	std::vector<std::array<std::array<Complex, 2>, 2>> seams;

	/// \param mesh places are points of the disk, triangles coherent
	explicit HyperbolicCheck(const FlatMesh& mesh) :
			defect(at(mesh.vertexCount()), 2 * std::acos(-1.0L))
	{
		const long double pi = std::acos(-1.0L);
		std::map<std::pair<int, int>, std::array<Complex, 2>> sides;
		for (const int f : mesh.points.indices()) {
			std::array<Complex, 3> p;
			for (std::size_t k = 0; k < 3; ++k)
				p[k] = asComplex(mesh.at(f)[k]);
			flipped += hyperbolicOrientation(p[0], p[1], p[2]) != 1;
			area += pi;
			for (std::size_t k = 0; k < 3; ++k) {
				const long double angle = angleInDisk(p[k], p[(k + 1) % 3], p[(k + 2) % 3]);
				area -= angle;
				defect[at(mesh.vertices[f][k])] -= angle;
				const int v = mesh.vertices[f][k], w = mesh.vertices[f][(k + 1) % 3];
				EXPECT_TRUE(sides.insert({{v, w}, {p[k], p[(k + 1) % 3]}}).second);
			}
		}
		for (const auto& [ends, here] : sides) {
			const auto across = sides.find({ends.second, ends.first});
			if (across == sides.end()) {
				// A vertex of the boundary begins one edge of it. Its other points lie on a straight line.
				defect[at(ends.first)] -= pi;
				continue;
			}
			const std::array<Complex, 2> there{across->second[1], across->second[0]};
			if (ends.first > ends.second || here == there)
				continue;
			seams.push_back({here, there});
			const double left = chordLength(here[0], here[1]),
						 right = chordLength(there[0], there[1]);
			double rounding = 0.0;
			for (const Complex z : {here[0], here[1], there[0], there[1]})
				rounding += 4e-16 / (1.0 - std::norm(z));
			EXPECT_NEAR(left, right, 1e-9 * left + rounding);
		}
	}

	/// Of a surface with this curvature at its first vertices, and 0 at all others.
	void expectCurvature(const std::vector<double>& curvature) const
	{
		EXPECT_EQ(flipped, 0);
		for (std::size_t v = 0; v < defect.size(); ++v)
			EXPECT_NEAR(
				static_cast<double>(defect[v]), v < curvature.size() ? curvature[v] : 0.0, 1e-8)
				<< "point " << v;
	}
};

/// Closed, with boundary and with cones, and tori whose cuts cross end edges more often than they must.
std::vector<FlippedFlow> flows()
{
	Random random(600);
	std::vector<FlippedFlow> all;
	for (const SurfaceMesh& mesh :
		 {shaken(perforatedSlab(2, 3), 0.06, random),
		  shaken(perforatedSlab(3, 2), 0.06, random),
		  withoutStars(shaken(perforatedSlab(0, 5), 0.04, random), {0, 60, 120})})
		all.emplace_back(mesh, hyperbolicMetric(), 1e-12);
	for (int i = 0; i < 60; ++i) {
		std::vector<double> cones(9, 0.0);
		for (int k = 0; k < 3; ++k)
			cones[at(random.index(9))] = 4.0;
		all.emplace_back(foldedTorus(3, 3, 0.1, random), hyperbolicPrescribed(cones), 1e-12);
	}
	const SurfaceMesh sphere = shaken(perforatedSlab(0, 3), 0.05, random);
	std::vector<double> curvature(sphere.positions.size(), 0.0);
	curvature[3] = curvature[20] = 5.0;
	curvature[40] = 4.0;
	curvature[11] = -1.0;
	all.emplace_back(sphere, hyperbolicPrescribed(curvature), 1e-12);
	return all;
}

TEST(HyperbolicLayout, TrianglesHaveTheLengthsAndAnglesOfTheMetric)
{
	RICCI_NEEDS_WIDE_LONG_DOUBLE();
	for (const FlippedFlow& flow : flows()) {
		const CurvatureMap& metric = *flow.result.metric;
		const Triangulation& t = metric.triangulation();
		VertexArray<char> cones = flow.cones();
		cones.resize(t.vertexCount(), 0);
		const CutGraph cut = cutToDisk(t, metric.lengths(), cones);
		const HyperbolicLayout layout =
			layOutInDisk(t, metric.lengths(), metric.angles(), cut.isCut);
		const auto at = [&](Halfedge h) { return Complex(layout[h].origin()); };
		std::complex<long double> moment = 0.0L;
		for (const Halfedge h : t.interiorHalfedges()) {
			const auto z = wide(layout[h].origin());
			const auto w = wide(layout[t.next(h)].origin());
			const auto x = wide(layout[t.previous(h)].origin());
			ASSERT_LT(std::abs(z), 1.0L);
			const double length = metric.lengths()[h.edge()];
			EXPECT_NEAR(static_cast<double>(distanceInDisk(z, w)) / length, 1.0, 1e-11);
			EXPECT_NEAR(chordLength(at(h), at(t.next(h))) / (2 * std::sinh(length / 2)), 1.0, 1e-8);
			EXPECT_NEAR(static_cast<double>(angleInDisk(z, w, x)), metric.angles()[h], 1e-10);
			EXPECT_EQ(hyperbolicOrientation(at(h), at(t.next(h)), at(t.previous(h))), 1);
			// The frame looks along the halfedge.
			const auto ahead = wide(layout[h].inverse()(layout[t.next(h)].origin()));
			EXPECT_LT(static_cast<double>(std::abs(ahead.imag())), 1e-12);
			EXPECT_GT(ahead.real(), 0.0L);
			// Its vector on the hyperboloid, by the area round it.
			double area = kPi;
			for (const Halfedge side : t.loop(h))
				area -= metric.angles()[side];
			moment += static_cast<long double>(2 * area) * z / (1.0L - std::norm(z));
		}
		// The middle is at 0.
		EXPECT_LT(static_cast<double>(std::abs(moment)) / flow.result.area, 1e-9);
		// Across the cut the two sides differ by the side pairing, across the rest by nothing.
		for (const Edge e : t.edges()) {
			if (t.isBoundary(e))
				continue;
			const Halfedge h = e.halfedge(), g = h.twin();
			SidePairing pairing;
			offerPairing(layout, metric.lengths()[e], h, g, pairing);
			for (const auto& [from, to] : {std::pair(t.next(g), h), std::pair(g, t.next(h))})
				EXPECT_LT(
					std::abs(Complex(pairing.isometry()(layout[from].origin())) - at(to)), 1e-10);
			if (!cut.isCut[e]) {
				EXPECT_LT(static_cast<double>(pairing.isometry().distanceFromIdentity()), 1e-9);
			}
		}
	}
}

/// Along any cut the refinement has the metric of the flow, its corners are those of the corners' own layout, and
/// both sides of the cut differ by the isometry that is given.
TEST(HyperbolicLayout, OfTheRefinementAlongAnyCut)
{
	RICCI_NEEDS_WIDE_LONG_DOUBLE();
	Random random(615);
	for (const FlippedFlow& flow : flows()) {
		const CutGraph cut = flow.cutAnywhere(random);
		const SurfaceLayout r = flow.refinement(cut);
		const VertexVector& k = flow.result.target.curvature;
		const HyperbolicCheck check(r.refinement);
		check.expectCurvature({k.data(), k.data() + k.size()});
		EXPECT_GE(static_cast<int>(check.seams.size()), cut.edgeCount);
		const SurfaceLayout disk = layOutCorners(flow.domain, flow.result, cut.isCut);
		const Triangulation& input = flow.base();
		for (const SurfaceLayout* layout : {&r, &disk})
			for (const Edge e : input.edges()) {
				if (!cut.isCut[e])
					continue;
				const auto place = [&](Halfedge h) { return asComplex(layout->corners[h]); };
				const Halfedge h = e.halfedge(), g = h.twin();
				const DiskIsometry isometry = rounded(layout->pairing[e].isometry());
				EXPECT_LT(std::abs(isometry(place(input.next(g))) - place(h)), 1e-9);
				EXPECT_LT(std::abs(isometry(place(g)) - place(input.next(h))), 1e-9);
			}
		for (const Halfedge h : input.interiorHalfedges()) {
			double rounding = 0.0, fromFirst[2];
			for (const SurfaceLayout* layout : {&r, &disk}) {
				const Complex z = asComplex(layout->corners[h]);
				const Complex first = asComplex(layout->corners.points[0]);
				fromFirst[layout == &r] = static_cast<double>(distanceInDisk(z, first));
				rounding += 1e-14 / (1.0 - std::norm(z)) + 1e-14 / (1.0 - std::norm(first));
			}
			EXPECT_NEAR(fromFirst[0], fromFirst[1], 1e-9 + rounding);
		}
	}
}

TEST(HyperbolicLayout, OrientationIsThatOfTheGeodesicTriangle)
{
	Random random(610);
	int clear = 0;
	for (int i = 0; i < 1000; ++i) {
		const auto point = [&] {
			return std::polar(std::sqrt(random.real(0.0, 0.95)), random.real(0.0, 6.28));
		};
		const Complex p = point(), q = point(), r = point();
		const int sign = hyperbolicOrientation(p, q, r);
		EXPECT_EQ(hyperbolicOrientation(q, r, p), sign);
		EXPECT_EQ(hyperbolicOrientation(q, p, r), -sign);
		// In the Klein model geodesics are straight.
		const auto klein = [](Complex z) { return 2.0 * z / (1.0 + std::norm(z)); };
		const double area = (std::conj(klein(q) - klein(p)) * (klein(r) - klein(p))).imag();
		if (std::abs(area) > 1e-12) {
			EXPECT_EQ(sign, area > 0 ? 1 : -1);
			++clear;
		}
	}
	EXPECT_GT(clear, 900);
	EXPECT_EQ(hyperbolicOrientation(0.0, 0.25, 0.5), 0);
}

} // namespace
} // namespace ricci::testing
