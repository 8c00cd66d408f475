// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random_surface.h"

#include <ricci/layout/unfold.h>
#include <ricci/metric/circle_packing.h>
#include <ricci/numbers.h>

#include <gtest/gtest.h>

#include <cmath>

namespace ricci::testing {
namespace {

TEST(Unfold, AStripOfThePlaneIsItself)
{
	// From every corner of a plane mesh straight on over two edges, to the left and to the right.
	Random random(630);
	const SurfaceMesh mesh = randomPlanarDisk(5, random);
	const Triangulation t(static_cast<int>(mesh.positions.size()), mesh.triangles);
	const std::vector<double> lengths = edgeLengths(t, mesh.positions);
	int strips = 0;
	for (int h = 0; h < t.halfedgeCount(); ++h)
		for (bool left : {true, false}) {
			if (t.isOuter(h) || t.isOuter(Triangulation::twin(t.next(h))))
				continue;
			NormalCoordinates::Curve curve;
			curve.first = h;
			curve.crossings.resize(2);
			curve.crossings[0].halfedge = t.next(h);
			const int y = Triangulation::twin(t.next(h));
			const int second = left ? t.previous(y) : t.next(y);
			if (t.isOuter(Triangulation::twin(second)))
				continue;
			curve.crossings[1].halfedge = second;
			Strip strip;
			unfold(t, lengths, curve, strip);
			// The plane seen from the curve's beginning, along its first halfedge.
			const Point3& o = mesh.positions[at(t.origin(h))];
			const Point3& e = mesh.positions[at(t.target(h))];
			const double c = (e[0] - o[0]) / distance(o, e), s = (e[1] - o[1]) / distance(o, e);
			const auto expectAt = [&](const Point2& p, int v) {
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
			expectAt(strip.end, t.origin(t.previous(Triangulation::twin(second))));
			++strips;
		}
	EXPECT_GT(strips, 20);
}

} // namespace
} // namespace ricci::testing
