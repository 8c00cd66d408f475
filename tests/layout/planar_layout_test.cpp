// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/complex.h"
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/cut/cut_graph.h>
#include <ricci/flow/newton.h>
#include <ricci/layout/planar_layout.h>
#include <ricci/math/orientation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ricci::testing {
namespace {

struct LaidOut
{
	GeometricCurvatureMap<Euclidean> map;
	CutGraph cut;
	PlanarLayout layout;

	/// \p u must make the surface flat off the marked vertices.
	LaidOut(const Packed& mesh, const VertexVector& u, const VertexArray<char>& marked) :
			map(mesh.map())
	{
		map.evaluate(u);
		cut = cutToDisk(map.triangulation(), mesh.lengths, marked);
		layout = layOutInPlane(map.triangulation(), map.lengths(), map.angles(), cut.isCut);
	}
};

VertexVector flatMetric(const Packed& mesh, const VertexVector& target)
{
	auto map = mesh.map();
	NewtonSolver solver(map, VertexArray<char>(mesh.radii.size(), 0));
	VertexVector u = mesh.u();
	NewtonOptions options;
	options.epsilon = 1e-13;
	EXPECT_TRUE(solver.solve(u, target, options, [](int, double) {}).converged);
	return u;
}

/// Lengths and angles of the drawn triangles are those of the metric.
void expectFaithful(const LaidOut& flat, double tolerance)
{
	const Triangulation& t = flat.map.triangulation();
	for (const Halfedge h : t.interiorHalfedges()) {
		const Complex p = asComplex(flat.layout[h]), q = asComplex(flat.layout[t.next(h)]),
					  r = asComplex(flat.layout[t.previous(h)]);
		EXPECT_NEAR(std::abs(q - p) / flat.map.lengths()[h.edge()], 1.0, tolerance);
		EXPECT_NEAR(std::arg((r - p) / (q - p)), flat.map.angles()[h], tolerance);
	}
	for (const Face f : t.faces()) {
		const auto h = t.halfedges(f);
		EXPECT_EQ(orientation(flat.layout[h[0]], flat.layout[h[1]], flat.layout[h[2]]), 1);
	}
}

TEST(PlanarLayout, APlaneComesBackUpToAnIsometry)
{
	Random random(140);
	for (int n : {4, 12, 30}) {
		const SurfaceMesh mesh = randomPlanarDisk(n, random);
		const Packed packed(mesh);
		const LaidOut flat(packed, packed.u(), VertexArray<char>(packed.radii.size(), 0));
		ASSERT_EQ(flat.cut.edgeCount, 0);
		// The isometry by two far corners, then every corner of every face.
		const Triangulation& t = packed.triangulation;
		const auto input = [&](Halfedge h) {
			const Point3& p = mesh.positions[at(t.origin(h))];
			return Complex(p[0], p[1]);
		};
		const Halfedge a = t.halfedge(Face(0)), b = t.halfedge(Face(t.faceCount() - 1));
		const Complex turn =
			(asComplex(flat.layout[b]) - asComplex(flat.layout[a])) / (input(b) - input(a));
		EXPECT_NEAR(std::abs(turn), 1.0, 1e-10);
		for (const Halfedge h : t.interiorHalfedges()) {
			const Complex wanted = asComplex(flat.layout[a]) + turn * (input(h) - input(a));
			EXPECT_LT(std::abs(asComplex(flat.layout[h]) - wanted), 1e-10);
		}
	}
}

TEST(PlanarLayout, BothSidesOfEverySeamHaveTheSameLength)
{
	Random random(142);
	// A torus, whose seams are translations, and a sphere with cones, whose seams turn.
	const Packed flatTorus(bumpyTorus(20, 12, random));
	const SurfaceMesh slab = perforatedSlab(0, 4);
	const Packed sphere(slab);
	VertexArray<char> cones(sphere.radii.size(), 0);
	VertexVector target = Eigen::VectorXd::Zero(sphere.u().size());
	for (int n = 0; n < 4; ++n) {
		const Vertex v(13 * n);
		cones[v] = 1;
		target[v] = kPi;
	}
	const LaidOut drawings[] = {
		LaidOut(
			flatTorus,
			flatMetric(flatTorus, VertexVector(Eigen::VectorXd::Zero(flatTorus.u().size()))),
			VertexArray<char>(flatTorus.radii.size(), 0)),
		LaidOut(sphere, flatMetric(sphere, target), cones)};
	for (const LaidOut& flat : drawings) {
		const Triangulation& t = flat.map.triangulation();
		int seams = 0;
		for (const Edge e : t.edges()) {
			if (!flat.cut.isCut[e])
				continue;
			++seams;
			const auto side = [&](Halfedge h) {
				return distance(flat.layout[h], flat.layout[t.next(h)]);
			};
			EXPECT_NEAR(side(e.halfedge()) / side(e.halfedge().twin()), 1.0, 1e-9);
		}
		EXPECT_GT(seams, 5);
		expectFaithful(flat, 1e-9);
	}
}

TEST(PlanarLayout, ANeedleDoesNotSpoilItsNeighbours)
{
	// The plane again, on a grid whose cells are up to 10^5 times longer than wide.
	Random random(143);
	SurfaceMesh mesh = sliverDisk(10, 5.0, random);
	for (Point3& p : mesh.positions)
		p[2] = 0.0;
	const Packed packed(mesh);
	const LaidOut flat(packed, packed.u(), VertexArray<char>(packed.radii.size(), 0));
	const Triangulation& t = packed.triangulation;
	double largest = 0.0;
	for (double l : packed.lengths)
		largest = std::max(largest, l);
	for (const Halfedge h : t.interiorHalfedges())
		EXPECT_NEAR(
			distance(flat.layout[h], flat.layout[t.next(h)]),
			packed.lengths[h.edge()],
			1e-9 * largest);
}

} // namespace
} // namespace ricci::testing
