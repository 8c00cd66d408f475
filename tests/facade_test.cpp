// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/facade_runs.h"
#include "support/flat_map.h"
#include "support/mesh_contents.h"
#include "support/random_surface.h"

#include <vcg/complex/algorithms/parametrization/ricci_flow_layers.h>

#include <array>
#include <limits>
#include <map>
#include <utility>

namespace ricci::testing {
namespace {

template<class Mesh>
using FlowOf = vcg::tri::RicciFlow<Mesh>;

template<class Mesh>
using LayersOf = vcg::tri::RicciFlowLayers<Mesh>;

template<class Mesh>
class Facade : public ::testing::Test
{
};

using Meshes = ::testing::Types<FloatMesh, DoubleMesh>;
TYPED_TEST_SUITE(Facade, Meshes);

template<class Mesh>
Parametrization compute(const Mesh& m, const Options& par)
{
	return FlowOf<Mesh>::Compute(m, par);
}

TYPED_TEST(Facade, MatchesTheCore)
{
	Random random(302);
	TypeParam m;
	toVcg(bumpyTorus(12, 8, random), m);
	const auto par = fixedTriangulation();
	const auto result = compute(m, par);
	const auto core = parametrizeEuclidean(fromVcg(m), {}, par);
	EXPECT_EQ(result.report.qcMean, core.report.qcMean);
	EXPECT_EQ(result.report.maxCurvatureError, core.report.maxCurvatureError);
	EXPECT_EQ(result.report.torusTauIm, core.report.torusTauIm);
	EXPECT_EQ(result.u, core.u);
	EXPECT_EQ(result.vertexQC, core.vertexQC);
	EXPECT_EQ(result.targetCurvature, core.targetCurvature);
	EXPECT_EQ(result.notes, core.notes);
}

/// MeshLab writes six decimals into OBJ files. A surface whose slivers are lower than that, laid out in
/// the unit square.
TYPED_TEST(Facade, SixDecimalsTurnNoTriangleRound)
{
	const int n = 60;
	const SurfaceMesh slivers = grid(n, n, Ends::Open, Ends::Open, [](int i, int j) {
		// Here and there a vertex lies close to the next one.
		const double x = i % 10 == 5 && j % 10 == 5 ? i + 1 - 2e-5 : i, y = j;
		return Point3{x, y, 2.0 * std::sin(0.3 * x) * std::cos(0.2 * y)};
	});
	TypeParam m;
	toVcg(slivers, m);
	Options par;
	par.normalizeUV = true;
	const auto turnedInText = [&](const auto& map) {
		int turned = 0;
		for (auto t : map.mesh.corners()) {
			for (auto& p : t)
				for (auto& x : p) {
					char text[32];
					std::snprintf(
						text, sizeof text, "%.6f", static_cast<double>(static_cast<float>(x)));
					x = std::atof(text);
				}
			turned += doubledArea(t) <= 0.0; // of six decimals, without rounding that matters
		}
		return turned;
	};
	par.finish = Finish::None;
	EXPECT_GT(turnedInText(compute(m, par)), 0) << "this mesh tests nothing";
	par.finish = Finish::LeastDistortion;
	const auto map = compute(m, par);
	EXPECT_EQ(turnedInText(map), 0);
	EXPECT_EQ(map.report.flippedFaces, 0);
	EXPECT_EQ(map.report.flippedByRounding, 0);
}

TYPED_TEST(Facade, WritesWedgesQualityAndAttributes)
{
	Random random(303);
	TypeParam m;
	build(bumpyTorus(12, 8, random), m);
	const auto result = compute(m, fixedTriangulation());
	FlowOf<TypeParam>::WriteWedgeTexCoord(m, result);
	FlowOf<TypeParam>::WriteVertexQuality(m, result);
	const std::vector<Triangle2> wedges = wedgesOf(result);
	for (std::size_t f = 0; f < m.face.size(); ++f)
		for (int k = 0; k < 3; ++k) {
			EXPECT_EQ(m.face[f].cWT(k).U(), static_cast<float>(wedges[f][at(k)][0]));
			EXPECT_EQ(m.face[f].cWT(k).V(), static_cast<float>(wedges[f][at(k)][1]));
			EXPECT_EQ(m.face[f].cWT(k).N(), 0);
		}
	using Scalar = typename TypeParam::ScalarType;
	auto u = vcg::tri::Allocator<TypeParam>::template FindPerVertexAttribute<Scalar>(m, "ricci_u");
	auto target = vcg::tri::Allocator<TypeParam>::template FindPerVertexAttribute<Scalar>(
		m, "ricci_target_curvature");
	ASSERT_TRUE(vcg::tri::Allocator<TypeParam>::IsValidHandle(m, u));
	ASSERT_TRUE(vcg::tri::Allocator<TypeParam>::IsValidHandle(m, target));
	for (std::size_t v = 0; v < m.vert.size(); ++v) {
		EXPECT_EQ(m.vert[v].cQ(), static_cast<Scalar>(result.vertexQC[v]));
		EXPECT_GE(m.vert[v].cQ(), Scalar(1));
		EXPECT_EQ(u[v], static_cast<Scalar>(result.u[v]));
		EXPECT_EQ(target[v], static_cast<Scalar>(result.targetCurvature[v]));
	}
	// A second run finds its attributes and makes no others.
	const auto count = m.vert_attr.size();
	FlowOf<TypeParam>::WriteVertexQuality(m, result);
	EXPECT_EQ(m.vert_attr.size(), count);
}

TYPED_TEST(Facade, ReadsThePrescribedCurvatureFromTheQuality)
{
	Random random(304);
	TypeParam m;
	toVcg(bumpyTorus(12, 8, random), m);
	std::vector<double> wanted;
	double sum = 0.0;
	for (std::size_t v = 0; v < m.vert.size(); ++v)
		sum += wanted.emplace_back(random.real(-0.3, 0.3));
	using Quality = typename TypeParam::VertexType::QualityType;
	for (std::size_t v = 0; v < m.vert.size(); ++v)
		m.vert[v].Q() = static_cast<Quality>(wanted[v] - sum / static_cast<double>(m.vert.size()));
	const auto result = compute(m, fixedTriangulation(TargetCurvature::Prescribed));
	for (std::size_t v = 0; v < m.vert.size(); ++v)
		EXPECT_NEAR(
			result.targetCurvature[v],
			double(m.vert[v].cQ()),
			100 * double(std::numeric_limits<Quality>::epsilon()));
	// An error beyond rounding is not spread.
	m.vert[0].Q() += Quality(0.01);
	const auto par = fixedTriangulation(TargetCurvature::Prescribed);
	EXPECT_EQ(
		refusalOf<InadmissibleCurvature>([&] { compute(m, par); }).problem,
		InadmissibleCurvature::GaussBonnet);
}

TYPED_TEST(Facade, ReadsTheSelection)
{
	TypeParam m;
	toVcg(rectangle(6, 4, 6, 4), m);
	for (int v : {0, 4, 30, 34})
		m.vert[at(v)].SetS();
	const auto result = compute(m, fixedTriangulation(TargetCurvature::Rectangle));
	for (int v = 0; v < 35; ++v)
		EXPECT_EQ(
			result.targetCurvature[at(v)], v == 0 || v == 4 || v == 30 || v == 34 ? kPi / 2 : 0.0);
	ASSERT_TRUE(result.report.rectangleAspect);
	EXPECT_NEAR(*result.report.rectangleAspect, 1.5, 1e-6);
	m.vert[0].ClearS();
	const auto par = fixedTriangulation(TargetCurvature::Rectangle);
	const auto refusal = refusalOf<InvalidOption>([&] { compute(m, par); });
	EXPECT_EQ(refusal.problem, InvalidOption::CornerCount);
	EXPECT_EQ(refusal.count, 3u);
}

TYPED_TEST(Facade, DeletedElementsTakeNoPart)
{
	Random random(305);
	const SurfaceMesh shape = bumpyTorus(12, 8, random);
	TypeParam clean, dirty;
	toVcg(shape, clean);
	SurfaceMesh more = sideBySide(tetrahedron(), shape, 0);
	for (std::size_t v = 0; v < 4; ++v)
		more.positions[v] = {std::numeric_limits<double>::quiet_NaN(), 0, 0};
	toVcg(more, dirty);
	for (std::size_t f = 0; f < 4; ++f)
		vcg::tri::Allocator<TypeParam>::DeleteFace(dirty, dirty.face[f]);
	for (std::size_t v = 0; v < 4; ++v)
		vcg::tri::Allocator<TypeParam>::DeleteVertex(dirty, dirty.vert[v]);
	const auto a = compute(clean, fixedTriangulation());
	const auto b = compute(dirty, fixedTriangulation());
	EXPECT_EQ(a.report.qcMean, b.report.qcMean);
	EXPECT_EQ(a.mesh.corners(), b.mesh.corners());
	for (const int f : a.mesh.face.indices())
		EXPECT_EQ(a.mesh.face[f] + 4, b.mesh.face[f]);
	for (std::size_t v = 0; v < a.u.size(); ++v)
		EXPECT_EQ(a.u[v], b.u[v + 4]);
	FlowOf<TypeParam>::WriteWedgeTexCoord(dirty, b);
	FlowOf<TypeParam>::WriteVertexQuality(dirty, b);
}

TYPED_TEST(Facade, FacesWithoutTheirVerticesAreRefused)
{
	TypeParam m, other;
	toVcg(rectangle(2, 2, 1, 1), m);
	toVcg(tetrahedron(), other);
	const auto refused = [&](const char* beginning, std::size_t faces) {
		const auto before = contents(m);
		const auto refusal = refusalOf<InvalidMesh>([&] { compute(m, fixedTriangulation()); });
		EXPECT_EQ(refusal.problem, InvalidMesh::DamagedFaces);
		EXPECT_EQ(refusal.count, faces);
		EXPECT_EQ(std::string(refusal.what()).rfind(beginning, 0), 0u) << refusal.what();
		EXPECT_EQ(contents(m), before);
	};
	m.face[0].V(1) = nullptr;
	refused("1 face uses vertices that are deleted or not in the mesh", 1);
	m.face[5].V(2) = &other.vert[3];
	refused("2 faces use vertices that are deleted or not in the mesh", 2);
	vcg::tri::Allocator<TypeParam>::DeleteFace(m, m.face[0]);
	vcg::tri::Allocator<TypeParam>::DeleteFace(m, m.face[5]);
	vcg::tri::Allocator<TypeParam>::DeleteVertex(m, m.vert[4]); // in the middle: of six faces
	refused("4 faces use vertices that are deleted or not in the mesh", 4);
}

TYPED_TEST(Facade, FlatMeshIsTheLayout)
{
	Random random(307);
	TypeParam m, flat;
	toVcg(bumpyTorus(12, 8, random), m);
	auto par = fixedTriangulation();
	par.charts = Charts::WithoutOverlap;
	const auto result = compute(m, par);
	LayersOf<TypeParam>::BuildFlatMesh(result, flat);
	ASSERT_EQ(flat.FN(), m.FN());
	const SurfaceMesh shape = fromVcg(flat);
	std::map<std::pair<int, int>, int> edges; // with the number of their faces
	for (const Triangle& t : shape.triangles)
		for (std::size_t k = 0; k < 3; ++k)
			++edges[std::minmax(t[k], t[(k + 1) % 3])];
	int boundary = 0;
	for (const auto& edge : edges)
		boundary += edge.second == 1;
	EXPECT_EQ(boundary, 2 * result.report.seamEdges);
	// A torus cut open is a disk.
	EXPECT_EQ(flat.VN() - static_cast<int>(edges.size()) + flat.FN(), 1);
	using Scalar = typename TypeParam::ScalarType;
	const std::vector<Triangle2> wedges = wedgesOf(result);
	for (std::size_t f = 0; f < shape.triangles.size(); ++f)
		for (int k = 0; k < 3; ++k) {
			EXPECT_EQ(flat.face[f].cP(k)[0], static_cast<Scalar>(wedges[f][at(k)][0]));
			EXPECT_EQ(flat.face[f].cP(k)[1], static_cast<Scalar>(wedges[f][at(k)][1]));
			EXPECT_EQ(flat.face[f].cP(k)[2], Scalar(0));
		}
}

TYPED_TEST(Facade, RefinementKeepsTheSurface)
{
	using Scalar = typename TypeParam::ScalarType;
	Random random(308);
	// Deleted elements, two components, some faces reversed, a loose vertex, faux sides.
	SurfaceMesh shape = sideBySide(
		tetrahedron(),
		sideBySide(shaken(bumpyTorus(14, 9, random), 0.3, random), rectangle(3, 3, 1, 1), 9),
		20);
	for (std::size_t f = 4; f < shape.triangles.size(); f += 7)
		std::swap(shape.triangles[f][1], shape.triangles[f][2]);
	shape.positions.push_back({1, 2, 3});
	TypeParam m;
	toVcg(shape, m);
	for (std::size_t f = 0; f < 4; ++f)
		vcg::tri::Allocator<TypeParam>::DeleteFace(m, m.face[f]);
	for (std::size_t v = 0; v < 4; ++v)
		vcg::tri::Allocator<TypeParam>::DeleteVertex(m, m.vert[v]);
	for (auto& v : m.vert)
		v.N() = typename TypeParam::CoordType(0, 0, 1);
	for (auto& f : m.face)
		f.SetF(0);
	vcg::tri::Allocator<TypeParam>::template AddPerVertexAttribute<char>(m, "ricci_u");

	const auto sums = [](const TypeParam& mesh) { // area, length of faux sides
		std::array<double, 2> sum{0, 0};
		for (const auto& f : mesh.face) {
			if (f.IsD())
				continue;
			sum[0] += 0.5 * double(((f.cP(1) - f.cP(0)) ^ (f.cP(2) - f.cP(0))).Norm());
			for (int k = 0; k < 3; ++k)
				if (f.IsF(k))
					sum[1] += double((f.cP((k + 1) % 3) - f.cP(k)).Norm());
		}
		return sum;
	};
	const auto before = sums(m);
	std::vector<typename TypeParam::CoordType> places;
	for (const auto& v : m.vert)
		places.push_back(v.cP());

	Options params;
	params.output = OutputTriangulation::CommonRefinement;
	const auto result = compute(m, params);
	ASSERT_GT(result.report.refinementPoints, 0);
	EXPECT_EQ(result.report.flippedFaces, 0);
	const int vertices = m.VN(), faces = m.FN();
	FlowOf<TypeParam>::WriteRefinement(m, result);
	EXPECT_EQ(m.VN(), vertices + result.report.refinementPoints);
	EXPECT_EQ(m.FN(), result.mesh.size());
	EXPECT_GT(m.FN(), faces);

	const double precision = 30 * double(std::numeric_limits<Scalar>::epsilon());
	const auto after = sums(m);
	EXPECT_NEAR(after[0], before[0], precision * before[0]);
	EXPECT_NEAR(after[1], before[1], precision * before[1]);
	for (std::size_t v = 0; v < places.size(); ++v)
		EXPECT_TRUE(m.vert[v].cP() == places[v]);
	for (std::size_t v = places.size(); v < m.vert.size(); ++v)
		EXPECT_NEAR(double(m.vert[v].cN()[2]), 1.0, precision);
	for (const auto& f : m.face)
		for (int k = 0; k < 3 && !f.IsD(); ++k) {
			EXPECT_FALSE(f.cV(k)->IsD());
			EXPECT_GE(f.cWT(k).U(), 0.0f);
			EXPECT_LE(f.cWT(k).U(), 1.0f);
		}
	const auto u =
		vcg::tri::Allocator<TypeParam>::template FindPerVertexAttribute<Scalar>(m, "ricci_u");
	EXPECT_TRUE(vcg::tri::Allocator<TypeParam>::IsValidHandle(m, u));

	TypeParam flat;
	LayersOf<TypeParam>::BuildFlatMesh(result, flat);
	EXPECT_EQ(flat.FN(), m.FN());
}

} // namespace
} // namespace ricci::testing
