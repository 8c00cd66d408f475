// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/metric/unfold.h>

#include <gtest/gtest.h>

#include <cmath>

namespace ricci::testing {
namespace {

TEST(Unfold, AStripOfThePlaneIsItself)
{
	// From every corner of a plane mesh straight on over two edges, to the left and to the right.
	Random random(630);
	const SurfaceMesh mesh = randomPlanarDisk(5, random);
	const Triangulation t = glued(mesh);
	const EdgeArray<double> lengths = edgeLengths(t, mesh);
	int strips = 0;
	for (const Halfedge h : t.halfedges())
		for (bool left : {true, false}) {
			if (t.isExterior(h) || t.isExterior(t.next(h).twin()))
				continue;
			NormalCoordinates::Curve curve;
			curve.first = h;
			curve.crossings.resize(2);
			curve.crossings[0].halfedge = t.next(h);
			const Halfedge y = t.next(h).twin();
			const Halfedge second = left ? t.previous(y) : t.next(y);
			if (t.isExterior(second.twin()))
				continue;
			curve.crossings[1].halfedge = second;
			Strip strip;
			unfold(t, lengths, curve, strip);
			// The plane seen from the curve's beginning, along its first halfedge.
			const Point3& o = mesh.positions[at(t.origin(h))];
			const Point3& e = mesh.positions[at(t.target(h))];
			const double c = (e[0] - o[0]) / distance(o, e), s = (e[1] - o[1]) / distance(o, e);
			const auto expectAt = [&](const Point2& p, Vertex v) {
				const Point3& q = mesh.positions[at(v)];
				const double x = q[0] - o[0], z = q[1] - o[1];
				EXPECT_NEAR(p[0], c * x + s * z, 1e-12);
				EXPECT_NEAR(p[1], c * z - s * x, 1e-12);
			};
			ASSERT_EQ(strip.sides.size(), 2u);
			for (std::size_t i = 0; i < 2; ++i) {
				expectAt(strip.sides[i].from, t.origin(curve.crossings[i].halfedge));
				expectAt(strip.sides[i].to, t.target(curve.crossings[i].halfedge));
			}
			expectAt(strip.end, t.apex(second.twin()));
			++strips;
		}
	EXPECT_GT(strips, 20);
}

} // namespace
} // namespace ricci::testing
