// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flat_map.h"
#include "support/flat_meshes.h"
#include "support/listener.h"
#include "support/random_surface.h"
#include "support/vcg_mesh.h"

#include <vcg/complex/algorithms/parametrization/ricci_flow_layers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <set>
#include <vector>

namespace ricci::testing {
namespace {

template<class Mesh>
using Flow = vcg::tri::RicciFlow<Mesh>;

template<class Mesh>
class UniversalCover : public ::testing::Test
{
};

using Meshes = ::testing::Types<FloatMesh, DoubleMesh>;
TYPED_TEST_SUITE(UniversalCover, Meshes);

/// The place of a copy in the texture plane.
Point2 moved(const DiskIsometry& m, const Point2& p, const Box2& disk)
{
	const Point2 middle{(disk.min[0] + disk.max[0]) / 2, (disk.min[1] + disk.max[1]) / 2};
	const double radius = 0.5 * disk.width();
	const std::complex<double> z =
		m(std::complex<double>((p[0] - middle[0]) / radius, (p[1] - middle[1]) / radius));
	return {middle[0] + radius * z.real(), middle[1] + radius * z.imag()};
}

/// The corners of each face of the cover, in the order that it is to have: copy by copy, in each the
/// layout's triangles.
template<class Mesh>
std::vector<Triangle2> expectedCover(const typename Flow<Mesh>::Result& r, int rings, int maxCount)
{
	std::vector<Tiling> tilings;
	std::size_t copies = 0;
	for (const Chart& chart : r.charts) {
		tilings.push_back(tiling(chart.group.sides, rings, maxCount));
		copies = std::max(copies, tilings.back().deck.size());
	}
	std::vector<Triangle2> expected;
	for (std::size_t copy = 0; copy < copies; ++copy)
		for (const int f : r.mesh.points.indices()) {
			const std::size_t component = at(r.mesh.chart[f]);
			if (copy >= tilings[component].deck.size())
				continue;
			Triangle2 corners = r.mesh.at(f);
			for (Point2& p : corners)
				p = moved(tilings[component].deck[copy], p, r.charts[component].box);
			expected.push_back(corners);
		}
	return expected;
}

/// Every corner is a vertex, where the copy puts it, rounded once.
template<class Mesh>
void expectCover(const Mesh& cover, const std::vector<Triangle2>& expected)
{
	using Coordinate = typename Mesh::CoordType::ScalarType;
	ASSERT_EQ(cover.face.size(), expected.size());
	for (std::size_t f = 0; f < expected.size(); ++f)
		for (int k = 0; k < 3; ++k) {
			ASSERT_NE(cover.face[f].cV(k), nullptr);
			const auto& p = cover.face[f].cV(k)->cP();
			const Point2& wanted = expected[f][at(k)];
			EXPECT_EQ(p[0], static_cast<Coordinate>(wanted[0]));
			EXPECT_EQ(p[1], static_cast<Coordinate>(wanted[1]));
			EXPECT_EQ(p[2], 0);
		}
	std::set<const typename Mesh::VertexType*> used;
	for (const auto& f : cover.face)
		for (int k = 0; k < 3; ++k)
			used.insert(f.cV(k));
	EXPECT_EQ(used.size(), cover.vert.size());
}

/// Memory for the layers is taken and they are filled while the run may still be ended.
TYPED_TEST(UniversalCover, LayersAreBuiltUnderTheTaskOfTheRun)
{
	TypeParam m, layer;
	toVcg(perforatedSlab(2, 1), m);
	typename Flow<TypeParam>::HyperbolicParams par;
	par.canonicalGenerators = true;
	const auto r = Flow<TypeParam>::ComputeHyperbolic(m, par);
	using Layers = vcg::tri::RicciFlowLayers<TypeParam>;
	const std::vector<std::function<void()>> builders{
		[&] { Layers::BuildFlatMesh(r, layer); },
		[&] { Layers::BuildUniversalCover(r, 1, 1000000, layer); },
		[&] { Layers::BuildAxes(r, 10, layer); },
		[&] { Layers::BuildCanonicalPolygons(r, 10, layer); }};
	for (const auto& build : builders) {
		layer.Clear();
		Listener impatient(1);
		EXPECT_THROW(
			withListener(
				impatient,
				[&] {
					build();
					return 0;
				}),
			Cancelled);
	}
	TypeParam ball;
	toVcg(perforatedSlab(0, 1), ball);
	const SphereMap sphere =
		Flow<TypeParam>::ComputeSphere(ball, typename Flow<TypeParam>::Params());
	layer.Clear();
	EXPECT_GT(checkpointsOf([&] { Layers::BuildSphereMesh(ball, sphere, layer); }), 0);
}

/// Two components with disks side by side. One reaches the side that the squares share, as it does in
/// floats far out in its disk, and belongs to its own disk all the same.
TYPED_TEST(UniversalCover, APointOnTheSideOfTwoSquaresStaysInItsComponent)
{
	const SurfaceMesh shape{std::vector<Point3>(6), {{0, 1, 2}, {3, 4, 5}}};
	const double side = std::nextafter(0.5, 0.0); // a float of 0.5
	FlatMesh flat = flatMesh(
		shape,
		{Triangle2{Point2{0.25, 0.25}, Point2{side, 0.25}, Point2{0.25, 0.3}},
		 Triangle2{Point2{0.75, 0.25}, Point2{0.5 + 1e-12, 0.25}, Point2{0.75, 0.2}}});
	flat.chart[1] = 1;
	typename Flow<TypeParam>::Result r = mapWith(flat);
	r.vertexQC.assign(6, 1.0);
	r.charts[0].box = {{0.0, 0.0}, {0.5, 0.5}};
	r.charts[1].box = {{0.5, 0.0}, {1.0, 0.5}};
	const DiskIsometry step = DiskIsometry::translation(1.0);
	for (const bool first : {true, false}) {
		r.charts[first ? 0 : 1].group.sides = {step, step.inverse()};
		r.charts[first ? 1 : 0].group.sides.clear();
		TypeParam cover;
		vcg::tri::RicciFlowLayers<TypeParam>::BuildUniversalCover(r, 1, 100, cover);
		EXPECT_EQ(cover.fn, 4);
		expectCover(cover, expectedCover<TypeParam>(r, 1, 100));
	}
}

TYPED_TEST(UniversalCover, SaysWhereCopiesAreLeftOut)
{
	const SurfaceMesh shape{std::vector<Point3>(3), {{0, 1, 2}}};
	typename Flow<TypeParam>::Result r =
		mapWith(flatMesh(shape, {Triangle2{Point2{0.4, 0.5}, Point2{0.6, 0.5}, Point2{0.5, 0.6}}}));
	r.vertexQC.assign(3, 1.0);
	const DiskIsometry step = DiskIsometry::translation(1.0);
	r.charts[0].group.sides = {step, step.inverse()};
	for (const int rings : {1, 1000}) {
		TypeParam cover;
		Listener listener;
		withListener(listener, [&] {
			vcg::tri::RicciFlowLayers<TypeParam>::BuildUniversalCover(r, rings, 10000, cover);
			return 0;
		});
		EXPECT_EQ(cover.fn < 1 + 2 * rings, rings == 1000);
		EXPECT_EQ(listener.count("left out of the universal cover"), rings == 1000);
	}
}

/// Of each face the copies that its component has, moved in doubles and rounded once.
TYPED_TEST(UniversalCover, CopiesAreMovedBeforeTheyAreRounded)
{
	Random random(920);
	const SurfaceMesh shape = sideBySide(
		shaken(perforatedSlab(2, 2), 0.06, random),
		shaken(perforatedSlab(3, 1), 0.05, random),
		20.0);
	TypeParam m;
	toVcg(shape, m);
	for (const OutputTriangulation output : kOutputs) {
		typename Flow<TypeParam>::HyperbolicParams par;
		par.output = output;
		const auto r = Flow<TypeParam>::ComputeHyperbolic(m, par);
		TypeParam cover;
		vcg::tri::RicciFlowLayers<TypeParam>::BuildUniversalCover(r, 1, 1000000, cover);
		expectCover(cover, expectedCover<TypeParam>(r, 1, 1000));
	}
}

} // namespace
} // namespace ricci::testing
