// SPDX-License-Identifier: GPL-3.0-or-later
// A disk that becomes round (paper 5.2).
#include "support/front_door.h"
#include "support/random_surface.h"

#include <gtest/gtest.h>

namespace ricci::testing {
namespace {

using Complex = std::complex<double>;

/// The boundary of a disk, in order.
std::vector<int> loopOf(const SurfaceMesh& mesh)
{
	std::map<std::pair<int, int>, int> sides;
	for (const Triangle& t : mesh.triangles)
		for (std::size_t k = 0; k < 3; ++k)
			sides[{t[k], t[(k + 1) % 3]}] = 1;
	std::map<int, int> next;
	for (const auto& [ends, once] : sides)
		if (sides.count({ends.second, ends.first}) == 0)
			next[ends.first] = ends.second;
	std::vector<int> loop{next.begin()->first};
	while (next[loop.back()] != loop.front())
		loop.push_back(next[loop.back()]);
	return loop;
}

std::vector<SurfaceMesh> disks()
{
	Random random(203);
	std::vector<SurfaceMesh> meshes{
		rectangle(30, 6, 5, 1),
		withoutStars(perforatedSlab(0, 6), {0}),
		shaken(rectangle(6, 6, 1, 1), 0.08, random),
		sphereWithTube(0.3, 1.0, 1.2, 12, 16)};
	for (const int n : {8, 24})
		meshes.push_back(bumpyPatch(n));
	return meshes;
}

/// The boundary lies on a circle; the curvature at a vertex is the exterior angle there, half of the arcs beside it;
/// and of all round disks, which Moebius transformations take to one another, it is the one whose boundary, weighted
/// by its lengths on the mesh, has its barycentre at the centre [Douady Earle 1986].
TEST(RoundDisk, HasABoundaryOnACircleWithItsBarycentreAtTheCentre)
{
	for (const SurfaceMesh& mesh : disks())
		for (const Method method : {Method::FixedTriangles, Method::IntrinsicFlips}) {
			SCOPED_TRACE(mesh.positions.size());
			const FlatResult map = flattened(mesh, towards(TargetCurvature::Disk, method));
			EXPECT_LE(map.report.maxCurvatureError, 1e-8);
			EXPECT_EQ(map.report.targetUsed, TargetUsed::Disk);
			expectDrawn(mesh, map, map.targetCurvature);
			const std::vector<int> loop = loopOf(mesh);
			std::map<int, Complex> place;
			for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
				for (std::size_t k = 0; k < 3; ++k)
					place[mesh.triangles[f][k]] = asComplex(map.uv[f][k]);
			// The centre is where the bisectors of two chords meet.
			const Complex a = place[loop[0]], b = place[loop[loop.size() / 3]];
			const Complex c = place[loop[2 * loop.size() / 3]], u = b - a, v = c - a;
			const Complex centre = a + Complex(0, 1) * (std::norm(v) * u - std::norm(u) * v) /
										   (2.0 * (std::conj(u) * v).imag());
			Complex barycentre = 0.0;
			double weights = 0.0;
			for (std::size_t i = 0; i < loop.size(); ++i) {
				const int last = loop[(i + loop.size() - 1) % loop.size()];
				const int own = loop[i], next = loop[(i + 1) % loop.size()];
				const auto at0 = [&](int vertex) {
					return (place[vertex] - centre) / std::abs(a - centre);
				};
				EXPECT_NEAR(std::abs(at0(own)), 1.0, 1e-8);
				const double arcs = std::arg(at0(own) / at0(last)) + std::arg(at0(next) / at0(own));
				EXPECT_NEAR(map.targetCurvature[at(own)], 0.5 * arcs, 1e-7);
				const Point3& p = mesh.positions[at(own)];
				const double weight =
					distance(p, mesh.positions[at(last)]) + distance(p, mesh.positions[at(next)]);
				barycentre += weight * at0(own);
				weights += weight;
			}
			EXPECT_LT(std::abs(barycentre) / weights, 1e-8);
		}
}

} // namespace
} // namespace ricci::testing
