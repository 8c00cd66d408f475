// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes that are not oriented manifolds, at the façade. Where a mesh is developable between its cuts,
// its map is known: an isometry.
#include "support/expect.h"
#include "support/random.h"
#include "support/written.h"

#include <vcg/complex/algorithms/parametrization/ricci_flow_layers.h>

#include <array>

namespace ricci::testing {
namespace {

using Flow = vcg::tri::RicciFlow<DoubleMesh>;
using Layers = vcg::tri::RicciFlowLayers<DoubleMesh>;

void expectFinite(const Flow::Result& r)
{
	for (const auto* values : {&r.u, &r.vertexQC, &r.targetCurvature})
		for (const double x : *values)
			EXPECT_TRUE(std::isfinite(x));
	for (const double x : r.vertexQC)
		EXPECT_GE(x, 1.0);
}

/// The bounding boxes of \p charts, lists of faces, have no inner point in common.
void expectApart(const Flow::Result& r, const std::vector<std::vector<std::size_t>>& charts)
{
	const std::vector<Triangle2> wedges = wedgesOf(r);
	std::vector<Box2> boxes(charts.size());
	for (std::size_t c = 0; c < charts.size(); ++c)
		for (const std::size_t f : charts[c])
			for (const Point2& p : wedges[f])
				boxes[c].add(p);
	for (std::size_t a = 0; a < boxes.size(); ++a)
		for (std::size_t b = a + 1; b < boxes.size(); ++b) {
			bool apart = false;
			for (std::size_t k = 0; k < 2; ++k)
				apart = apart || boxes[a].max[k] <= boxes[b].min[k] ||
						boxes[b].max[k] <= boxes[a].min[k];
			EXPECT_TRUE(apart) << a << ", " << b;
		}
}

/// Of a mesh that is developable between its cuts.
void expectLaidFlat(const SurfaceMesh& mesh, OutputTriangulation output, const Flow::Result& r)
{
	expectFinite(r);
	expectWritten(mesh, output, r);
	if (output == OutputTriangulation::KeepMesh)
		expectIsometric(mesh, wedgesOf(r), r.report);
}

TEST(AnyTriangles, UnconnectedTrianglesAreDrawnAsTheyAre)
{
	Random random(1);
	for (const bool atOnePoint : {false, true}) {
		SurfaceMesh mesh;
		const auto point = [&] {
			return Point3{random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)};
		};
		mesh.positions.push_back(point());
		std::vector<std::vector<std::size_t>> charts;
		for (int f = 0; f < 60; ++f) {
			Triangle t{0, 0, 0};
			for (std::size_t k = atOnePoint ? 1 : 0; k < 3; ++k) {
				t[k] = static_cast<int>(mesh.positions.size());
				mesh.positions.push_back(point());
			}
			charts.push_back({mesh.triangles.size()});
			mesh.triangles.push_back(t);
		}
		for (const OutputTriangulation output : kOutputs) {
			const auto r = compute(mesh, unscaled(output));
			EXPECT_EQ(r.report.charts, 60);
			EXPECT_EQ(r.report.components, 60);
			EXPECT_EQ(r.report.splitVertices, atOnePoint ? 1 : 0);
			expectLaidFlat(mesh, output, r);
			if (output == OutputTriangulation::KeepMesh)
				expectApart(r, charts);
		}
	}
}

/// Two sheets that are glued, however bent along the spine, can be laid flat.
TEST(AnyTriangles, TheSheetsOfABookAreLaidFlat)
{
	for (int sheets = 3; sheets <= 6; ++sheets) {
		SCOPED_TRACE(sheets);
		const int n = 3;
		const SurfaceMesh mesh = book(sheets, n);
		for (const OutputTriangulation output : kOutputs) {
			const auto r = compute(mesh, unscaled(output));
			EXPECT_EQ(r.report.charts, (sheets + 1) / 2);
			EXPECT_EQ(r.report.cutNonmanifoldEdges, n);
			EXPECT_EQ(r.report.splitVertices, n + 1);
			expectLaidFlat(mesh, output, r);
		}
	}
}

/// A strip of congruent triangles, each next one across a leg, closed with a half turn. Its shortest
/// one-sided loop runs along the border except for a leg, which is cut: the strip is laid flat.
TEST(AnyTriangles, AFlatMoebiusBandIsAStrip)
{
	const int n = 15;
	SurfaceMesh mesh;
	for (int i = 0; i < n; ++i)
		mesh.positions.push_back({std::cos(2 * kPi * i / n), std::sin(2 * kPi * i / n), 0.0});
	for (int i = 0; i < n; ++i)
		mesh.triangles.push_back({i, (i + 1) % n, (i + 2) % n});
	for (const OutputTriangulation output : kOutputs) {
		const auto r = compute(mesh, unscaled(output));
		EXPECT_EQ(r.report.oneSidedComponents, 1);
		EXPECT_EQ(r.report.charts, 1);
		EXPECT_EQ(r.report.splitVertices, 2);
		EXPECT_EQ(r.report.eulerCharacteristic, 1);
		EXPECT_EQ(r.report.cones, 0);
		expectLaidFlat(mesh, output, r);
	}
}

/// A flat Klein bottle of length L and girth H, its tube pressed flat. Its faces change their order
/// across one girth, which is shorter than the one-sided loops along the folds and is cut: an annulus of
/// girth H and height L.
TEST(AnyTriangles, AFlatKleinBottleIsAnAnnulusOfKnownModulus)
{
	const int nu = 20, nv = 8;
	const SurfaceMesh mesh = kleinBottle(nu, nv, [&](int i, int j) {
		const double u = 2 * kPi * i / nu;
		return Point3{std::cos(u), std::sin(u), 0.4 * std::min(j, nv - j)};
	});
	const double length = nu * 2 * std::sin(kPi / nu), girth = 0.4 * nv;
	for (const OutputTriangulation output : kOutputs) {
		const auto r = compute(mesh, unscaled(output));
		EXPECT_EQ(r.report.oneSidedComponents, 1);
		EXPECT_EQ(r.report.components, 1);
		EXPECT_EQ(r.report.eulerCharacteristic, 0);
		EXPECT_EQ(r.report.boundaryLoops, 2);
		EXPECT_EQ(r.report.splitVertices, nv);
		ASSERT_TRUE(r.report.annulusModulus);
		EXPECT_NEAR(*r.report.annulusModulus, length / girth, 1e-6);
		EXPECT_NEAR(r.report.qcMax, 1.0, 1e-4);
		expectFinite(r);
		expectWritten(mesh, output, r);
	}
}

/// In the disk, a one-sided surface is cut clear of its boundary, which keeps the Euler characteristic and so the area.
TEST(AnyTriangles, PuncturedKleinBottlesKeepTheirHyperbolicArea)
{
	const int nu = 20, nv = 12;
	const SurfaceMesh bottle = kleinBottle(nu, nv, [&](int i, int j) {
		const double u = 2 * kPi * i / nu, v = 2 * kPi * j / nv;
		return Point3{
			(2.0 + std::cos(v)) * std::cos(u),
			(2.0 + std::cos(v)) * std::sin(u),
			std::sin(v) * std::cos(0.5 * u)};
	});
	std::vector<int> stars;
	for (const int star : {4 * nv + 6, 9 * nv, 14 * nv + 3, 17 * nv + 9}) {
		stars.push_back(star);
		const auto punctures = static_cast<int>(stars.size());
		const Parametrization map =
			parametrizeHyperbolic(withoutStars(bottle, stars), {}, HyperbolicOptions());
		EXPECT_EQ(map.report.oneSidedComponents, 1);
		EXPECT_EQ(map.report.eulerCharacteristic, -punctures);
		EXPECT_NEAR(*map.report.hyperbolicArea, 2.0 * kPi * punctures, 1e-9);
		EXPECT_EQ(map.report.flippedFaces + map.report.flippedByRounding, 0);
		EXPECT_EQ(map.report.overlappingFaces + map.report.unequalSeams, 0);
	}
}

/// A horn: its two poles lie in one place. The last vertex is one of them.
SurfaceMesh horn(int rings, int around)
{
	std::vector<std::array<double, 2>> profile;
	for (int i = 0; i <= rings; ++i) {
		const double t = kPi * i / rings;
		const bool isPole = i == 0 || i == rings;
		profile.push_back({isPole ? 0.0 : std::sin(t), isPole ? 0.0 : std::sin(t) * std::cos(t)});
	}
	return revolved(profile, around);
}

SurfaceMesh pinched(SurfaceMesh mesh)
{
	const int last = static_cast<int>(mesh.positions.size()) - 1;
	for (Triangle& t : mesh.triangles)
		for (int& v : t)
			v = v == last ? 0 : v;
	mesh.positions.pop_back();
	return mesh;
}

/// Cut open at the pinch, the horn is the sphere with its vertices in the same order.
TEST(AnyTriangles, APinchedSphereIsMappedAsTheSphere)
{
	const SurfaceMesh sphere = horn(10, 12), mesh = pinched(sphere);
	for (const OutputTriangulation output : kOutputs) {
		const auto whole = compute(sphere, unscaled(output)), r = compute(mesh, unscaled(output));
		EXPECT_EQ(r.report.splitVertices, 1);
		EXPECT_EQ(r.report.cutNonmanifoldEdges, 0);
		EXPECT_EQ(r.report.components, 1);
		EXPECT_EQ(r.report.genus, 0);
		EXPECT_EQ(r.report.eulerCharacteristic, 2);
		EXPECT_EQ(r.report.cones, whole.report.cones);
		EXPECT_EQ(wedgesOf(r), wedgesOf(whole));
		EXPECT_EQ(r.mesh.corners(), whole.mesh.corners());
		const std::size_t n = mesh.positions.size();
		for (std::size_t v = 1; v < n; ++v) {
			EXPECT_EQ(r.u[v], whole.u[v]);
			EXPECT_NEAR(r.vertexQC[v], whole.vertexQC[v], 1e-12);
		}
		// The two poles have stars of the same area.
		EXPECT_NEAR(r.vertexQC[0], 0.5 * (whole.vertexQC[0] + whole.vertexQC[n]), 1e-9);
		expectFinite(r);
		expectWritten(mesh, output, r);
	}
}

TEST(AnyTriangles, TheSphereLayerHasBothPlacesOfAPinch)
{
	const SurfaceMesh sphere = horn(10, 12);
	SurfaceMesh mesh = pinched(sphere);
	mesh.triangles.push_back({3, 4, 4}); // without area
	DoubleMesh whole, m, layer;
	toVcg(sphere, whole);
	toVcg(mesh, m);
	const SphereMap expected = Flow::ComputeSphere(whole, {});
	const SphereMap map = Flow::ComputeSphere(m, {});
	EXPECT_EQ(map.positions, expected.positions);
	EXPECT_EQ(map.vertex.back(), 0);
	Layers::BuildSphereMesh(m, map, layer);
	EXPECT_EQ(at(layer.VN()), sphere.positions.size());
	SurfaceMesh built = fromVcg(layer);
	EXPECT_EQ(built.triangles.back(), mesh.triangles.back());
	built.triangles.pop_back();
	EXPECT_EQ(built.triangles, sphere.triangles);
}

/// A selected vertex is selected at every place.
TEST(AnyTriangles, ASelectedPinchIsAConeTwice)
{
	const SurfaceMesh sphere = horn(10, 12), mesh = pinched(sphere);
	Options params = unscaled();
	params.target = TargetCurvature::SelectedCones;
	const auto with = [&](const SurfaceMesh& surface, const std::vector<std::size_t>& selected) {
		DoubleMesh m;
		toVcg(surface, m);
		for (const std::size_t v : selected)
			m.vert[v].SetS();
		return Flow::Compute(m, params);
	};
	const auto r = with(mesh, {0, 50});
	const auto whole = with(sphere, {0, 50, sphere.positions.size() - 1});
	EXPECT_EQ(r.report.cones, 3);
	EXPECT_EQ(wedgesOf(r), wedgesOf(whole));
	expectFinite(r);
}

/// Prescribed curvature is taken at the vertices of the surface; faces without area are drawn along.
TEST(AnyTriangles, PrescribedCurvatureBesideFacesWithoutArea)
{
	SurfaceMesh mesh = torus(2, 1, 14, 9);
	const std::size_t faces = mesh.triangles.size(), vertices = mesh.positions.size();
	const Triangle edge = mesh.triangles[10];
	mesh.triangles.insert(mesh.triangles.begin(), {edge[0], edge[1], edge[1]});
	mesh.triangles.push_back({5, 5, 5});
	for (int i = 0; i < 3; ++i)
		mesh.positions.push_back({9.0 + i, 0, 0});
	const int line = static_cast<int>(vertices);
	mesh.triangles.push_back({line, line + 1, line + 2});
	std::vector<double> wanted(vertices, 0.0);
	wanted[20] = 0.5;
	wanted[70] = -0.5;
	for (const OutputTriangulation output : kOutputs) {
		DoubleMesh m;
		toVcg(mesh, m);
		for (std::size_t v = 0; v < vertices; ++v)
			m.vert[v].Q() = wanted[v];
		Options params = unscaled(output);
		params.target = TargetCurvature::Prescribed;
		const auto r = Flow::Compute(m, params);
		EXPECT_EQ(r.report.degenerateFaces, 3);
		EXPECT_EQ(r.report.components, 1);
		EXPECT_EQ(r.report.flippedFaces + r.report.flippedByRounding, 0);
		for (std::size_t v = 0; v < vertices; ++v)
			EXPECT_NEAR(r.targetCurvature[v], wanted[v], 1e-4);
		for (const std::size_t f : {std::size_t(0), faces + 1, faces + 2}) {
			const Triangle2 t = wedgesOf(r)[f];
			EXPECT_EQ(doubledArea(t), 0.0);
		}
		// The first is drawn at a side of a face next to it.
		const Triangle2 drawn = wedgesOf(r)[0];
		EXPECT_EQ(drawn[1], drawn[2]);
		EXPECT_NE(drawn[0], drawn[1]);
		expectFinite(r);
		expectWritten(mesh, output, r);
	}
}

/// The body with handles fills the disk as it would alone; a fin on it, a loose sphere and a torus lie beside it.
TEST(AnyTriangles, PiecesWithoutAHyperbolicMetricLieBesideTheDisk)
{
	SurfaceMesh body = perforatedSlab(2, 1);
	const auto faces = static_cast<int>(body.triangles.size());
	const HyperbolicOptions options;
	const Parametrization alone = parametrizeHyperbolic(body, {}, options);
	const Triangle first = body.triangles[0];
	body.positions.push_back({9, 9, 9});
	body.triangles.push_back({first[0], first[1], static_cast<int>(body.positions.size()) - 1});
	const SurfaceMesh mesh =
		sideBySide(sideBySide(body, tetrahedron(), 20.0), torus(2.0, 1.0, 8, 6), 40.0);
	for (const OutputTriangulation output : kOutputs) {
		HyperbolicOptions asked = options;
		asked.output = output;
		const Parametrization map = parametrizeHyperbolic(mesh, {}, asked);
		const Report& report = map.report;
		EXPECT_EQ(report.components, 4);
		EXPECT_EQ(report.leftOutComponents, 3);
		EXPECT_EQ(report.eulerCharacteristic, -2 + 1 + 2 + 0);
		EXPECT_NEAR(*report.hyperbolicArea, 4.0 * kPi, 1e-9);
		EXPECT_LE(*report.relationError, 1e-9);
		EXPECT_EQ(report.flippedFaces + report.flippedByRounding, 0);
		EXPECT_EQ(report.overlappingFaces + report.unequalSeams, 0);
		EXPECT_EQ(report.charts, 2);
		ASSERT_EQ(map.charts.size(), 2u);
		for (const int f : map.mesh.face.indices())
			EXPECT_EQ(map.mesh.chart[f], map.mesh.face[f] < faces ? 0 : 1);
		EXPECT_EQ(
			std::count_if(
				map.notes.begin(),
				map.notes.end(),
				[&](const std::string& note) {
					return note.find("3 components have no hyperbolic metric") == 0 &&
						   note.find("with face " + std::to_string(faces + 5) + ", has 96 faces") !=
							   std::string::npos;
				}),
			1);
		for (int f = 0; f < faces && output == OutputTriangulation::KeepMesh; ++f)
			for (int k = 0; k < 3; ++k) // its disk has a quarter of the square
				EXPECT_LT(distance(map.mesh.at(f)[at(k)], 0.5 * alone.mesh.at(f)[at(k)]), 1e-12);
	}
}

TEST(AnyTriangles, RefusalsNameTheComponentInTheInputsNumbers)
{
	SurfaceMesh mesh = perforatedSlab(2, 1);
	const std::size_t faces = mesh.triangles.size();
	const Triangle first = mesh.triangles[0];
	mesh.positions.push_back({9, 9, 9});
	mesh.triangles.insert(mesh.triangles.begin(), {first[0], first[0], first[1]});
	mesh.triangles.push_back({first[0], first[1], static_cast<int>(mesh.positions.size()) - 1});
	DoubleMesh m;
	toVcg(mesh, m);
	// No component has a hyperbolic metric: the largest is named.
	const SurfaceMesh spheres = sideBySide(tetrahedron(), torus(2.0, 1.0, 8, 6), 9.0);
	const auto flat = refusalOf<InadmissibleCurvature>(
		[&] { parametrizeHyperbolic(spheres, {}, HyperbolicOptions()); });
	EXPECT_EQ(flat.problem, InadmissibleCurvature::HyperbolicSurface);
	EXPECT_EQ(flat.componentFace, 4);
	EXPECT_EQ(flat.componentFaces, 96u);
	Options disk;
	disk.target = TargetCurvature::Disk;
	const auto slab = refusalOf<InvalidOption>([&] { Flow::Compute(m, disk); });
	EXPECT_EQ(slab.problem, InvalidOption::NotADisk);
	EXPECT_EQ(slab.componentFace, 1);
	EXPECT_EQ(slab.componentFaces, faces);
	// Of sheets that are disks each becomes a round one.
	SurfaceMesh twice = hill(5, 0.4);
	for (std::size_t f = 0; f < 50; ++f)
		twice.triangles.push_back(Triangle(twice.triangles[f]));
	const auto r = compute(twice, disk);
	EXPECT_EQ(r.report.charts, 2);
	EXPECT_EQ(r.report.flippedFaces + r.report.flippedByRounding, 0);
	expectFinite(r);
}

} // namespace
} // namespace ricci::testing
