// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/complex.h"
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/flow/newton.h>
#include <ricci/layout/cut_graph.h>
#include <ricci/layout/orientation.h>
#include <ricci/layout/planar_layout.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ricci::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;

struct LaidOut
{
	GeometricCurvatureMap<Euclidean> map;
	CutGraph cut;
	PlanarLayout layout;

	/// \p u must make the surface flat off the marked vertices.
	LaidOut(const Packed& mesh, const Eigen::VectorXd& u, const std::vector<char>& marked) :
			map(mesh.map())
	{
		map.evaluate(u);
		cut = cutToDisk(map.triangulation(), mesh.lengths, marked, {});
		layout = layOutInPlane(map.triangulation(), map.lengths(), map.angles(), cut.isCut);
	}
};

Eigen::VectorXd flatMetric(const Packed& mesh, const Eigen::VectorXd& target)
{
	auto map = mesh.map();
	NewtonSolver solver(map, std::vector<char>(mesh.radii.size(), 0));
	Eigen::VectorXd u = mesh.u();
	NewtonOptions options;
	options.epsilon = 1e-13;
	EXPECT_TRUE(solver.solve(u, target, options, [](int, double) {}).converged);
	return u;
}

/// Lengths and angles of the drawn triangles are those of the metric.
void expectFaithful(const LaidOut& flat, double tolerance)
{
	const Triangulation& t = flat.map.triangulation();
	for (int h = 0; h < t.halfedgeCount(); ++h) {
		if (t.isOuter(h))
			continue;
		const Complex p = asComplex(flat.layout.at(h)), q = asComplex(flat.layout.at(t.next(h))),
					  r = asComplex(flat.layout.at(t.previous(h)));
		EXPECT_NEAR(
			std::abs(q - p) / flat.map.lengths()[at(Triangulation::edge(h))], 1.0, tolerance);
		EXPECT_NEAR(std::arg((r - p) / (q - p)), flat.map.angles()[at(h)], tolerance);
	}
	for (int f = 0; f < t.faceCount(); ++f) {
		const auto h = t.halfedges(f);
		EXPECT_EQ(orientation(flat.layout.at(h[0]), flat.layout.at(h[1]), flat.layout.at(h[2])), 1);
	}
}

TEST(PlanarLayout, APlaneComesBackUpToAMotion)
{
	Random random(140);
	for (int n : {4, 12, 30}) {
		const SurfaceMesh mesh = randomPlanarDisk(n, random);
		const Packed packed(mesh);
		const LaidOut flat(packed, packed.u(), std::vector<char>(packed.radii.size(), 0));
		ASSERT_EQ(flat.cut.edgeCount, 0);
		// The motion by two far corners, then every corner of every face.
		const Triangulation& t = packed.triangulation;
		const auto input = [&](int h) {
			const Point3& p = mesh.positions[at(t.origin(h))];
			return Complex(p[0], p[1]);
		};
		const int a = t.halfedge(0), b = t.halfedge(t.faceCount() - 1);
		const Complex turn =
			(asComplex(flat.layout.at(b)) - asComplex(flat.layout.at(a))) / (input(b) - input(a));
		EXPECT_NEAR(std::abs(turn), 1.0, 1e-10);
		for (int h = 0; h < t.halfedgeCount(); ++h)
			if (!t.isOuter(h)) {
				const Complex wanted = asComplex(flat.layout.at(a)) + turn * (input(h) - input(a));
				EXPECT_LT(std::abs(asComplex(flat.layout.at(h)) - wanted), 1e-10);
			}
	}
}

TEST(PlanarLayout, ClosesRoundEveryVertexOffTheCut)
{
	Random random(141);
	const Packed packed(bumpyTorus(20, 12, random));
	const auto u = flatMetric(packed, Eigen::VectorXd::Zero(packed.u().size()));
	const LaidOut flat(packed, u, std::vector<char>(packed.radii.size(), 0));
	// All corners at a vertex off the cut share a sector, hence one point, and every triangle has
	// the shape that the metric gives it: the drawing closes.
	const Triangulation& t = packed.triangulation;
	std::vector<char> onCut(packed.radii.size(), 0);
	for (int e = 0; e < t.edgeCount(); ++e)
		if (flat.cut.isCut[at(e)])
			onCut[at(t.origin(2 * e))] = onCut[at(t.target(2 * e))] = 1;
	std::vector<int> sector(packed.radii.size(), -1);
	int inside = 0;
	for (int h = 0; h < t.halfedgeCount(); ++h) {
		const std::size_t v = at(t.origin(h));
		if (onCut[v])
			continue;
		if (sector[v] < 0)
			sector[v] = flat.layout.sector[at(h)];
		EXPECT_EQ(flat.layout.sector[at(h)], sector[v]);
		++inside;
	}
	EXPECT_GT(inside, 1000);
	expectFaithful(flat, 1e-9);
}

TEST(PlanarLayout, BothSidesOfEverySeamHaveTheSameLength)
{
	Random random(142);
	// A torus, whose seams are translations, and a sphere with cones, whose seams turn.
	const Packed flatTorus(bumpyTorus(20, 12, random));
	const SurfaceMesh slab = perforatedSlab(0, 4);
	const Packed sphere(slab);
	std::vector<char> cones(sphere.radii.size(), 0);
	Eigen::VectorXd target = Eigen::VectorXd::Zero(sphere.u().size());
	for (std::size_t v = 0, n = 0; n < 4; v += 13, ++n) {
		cones[v] = 1;
		target[static_cast<Eigen::Index>(v)] = kPi;
	}
	const LaidOut drawings[] = {
		LaidOut(
			flatTorus,
			flatMetric(flatTorus, Eigen::VectorXd::Zero(flatTorus.u().size())),
			std::vector<char>(flatTorus.radii.size(), 0)),
		LaidOut(sphere, flatMetric(sphere, target), cones)};
	for (const LaidOut& flat : drawings) {
		const Triangulation& t = flat.map.triangulation();
		int seams = 0;
		for (int e = 0; e < t.edgeCount(); ++e) {
			if (!flat.cut.isCut[at(e)])
				continue;
			++seams;
			double side[2];
			for (int k = 0; k < 2; ++k)
				side[k] = std::abs(
					asComplex(flat.layout.at(t.next(2 * e + k))) -
					asComplex(flat.layout.at(2 * e + k)));
			EXPECT_NEAR(side[0] / side[1], 1.0, 1e-9);
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
	const LaidOut flat(packed, packed.u(), std::vector<char>(packed.radii.size(), 0));
	const Triangulation& t = packed.triangulation;
	double largest = 0.0;
	for (double l : packed.lengths)
		largest = std::max(largest, l);
	for (int e = 0; e < t.edgeCount(); ++e)
		for (int h : {2 * e, 2 * e + 1})
			if (!t.isOuter(h)) {
				const double drawn =
					std::abs(asComplex(flat.layout.at(t.next(h))) - asComplex(flat.layout.at(h)));
				EXPECT_NEAR(drawn, packed.lengths[at(e)], 1e-9 * largest);
			}
}

} // namespace
} // namespace ricci::testing
