// SPDX-License-Identifier: GPL-3.0-or-later
// What the public functions refuse: with which error, which data and which words. A refused mesh is bit for bit
// what it was, and the façade refuses what the functions on arrays do.
#include "support/calls.h"
#include "support/expect.h"
#include "support/flat_map.h"
#include "support/mesh_contents.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/vcg_mesh.h"

#include <vcg/complex/algorithms/parametrization/ricci_flow.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>

namespace ricci::testing {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Numbers that are not known before.
constexpr std::size_t kSome = 1000000;
constexpr double kBeyond = 1e9; ///< but beyond the bound

void expectNumber(double found, double expected)
{
	if (std::isfinite(expected))
		EXPECT_NEAR(found, expected, 1e-9 * std::abs(expected));
	else
		EXPECT_TRUE(found == expected || (std::isnan(found) && std::isnan(expected))) << found;
}

void expectSameData(const InvalidMesh& error, const InvalidMesh& expected)
{
	EXPECT_EQ(error.problem, expected.problem);
	EXPECT_EQ(error.count, expected.count);
}

template<class E> // InvalidOption, InadmissibleCurvature
void expectSameData(const E& error, const E& expected)
{
	EXPECT_EQ(error.problem, expected.problem);
	if (expected.value == kBeyond) {
		EXPECT_GT(error.value, error.bound);
	}
	else {
		expectNumber(error.value, expected.value);
		expectNumber(error.bound, expected.bound);
	}
	EXPECT_EQ(error.count, expected.count);
	EXPECT_EQ(error.surface.name(), expected.surface.name());
	if constexpr (std::is_same_v<E, InvalidOption>) {
		EXPECT_EQ(error.target, expected.target);
	}
}

void expectSameData(const NotConverged& error, const NotConverged& expected)
{
	EXPECT_EQ(error.problem, expected.problem);
	EXPECT_EQ(error.count > 0, expected.count > 0);
	if (expected.count != kSome) {
		EXPECT_EQ(error.count, expected.count);
	}
	EXPECT_EQ(error.method, expected.method);
}

/// A call that is refused.
struct Refusal : Call
{
	/// \param words in the error's own sentence
	template<class E>
	Refusal(const Call& call, const E& error, const std::string& words) :
			Call(call), expect([error, words](const std::function<void()>& run) {
				const E refused = refusalOf<E>(run);
				expectSameData(refused, error);
				expectWords(refused.what(), {words});
				return std::pair<int, std::size_t>(refused.componentFace, refused.componentFaces);
			})
	{
	}

	/// Returns the component that is named.
	std::function<std::pair<int, std::size_t>(const std::function<void()>&)> expect;
	int facesBefore = -1; ///< of another component, which is not refused
};

/// Rows of the table; names get a number where they come again.
class Table
{
public:
	template<class E>
	void add(const std::string& name, Call call, const E& error, const std::string& words)
	{
		call.name = name;
		for (int n = 2; std::any_of(
				 m_rows.begin(),
				 m_rows.end(),
				 [&](const Refusal& row) { return row.name == call.name; });
			 ++n)
			call.name = name + std::to_string(n);
		m_rows.emplace_back(call, error, words);
	}

	/// The last row again, behind another component.
	void again(const SurfaceMesh& first)
	{
		Refusal row = m_rows.back();
		row.name += "AfterAnother";
		row.mesh = sideBySide(first, row.mesh, 50.0);
		row.facesBefore = static_cast<int>(first.triangles.size());
		m_rows.push_back(row);
	}

	std::vector<Refusal> rows() const { return m_rows; }

private:
	std::vector<Refusal> m_rows;
};

Options target(TargetCurvature target, bool freeBoundary = true)
{
	Options options;
	options.target = target;
	options.freeBoundary = freeBoundary;
	return options;
}
HyperbolicOptions target(HyperbolicTarget target, double coneAngle = 1.0)
{
	HyperbolicOptions options;
	options.target = target;
	options.coneAngle = coneAngle;
	return options;
}

std::vector<Refusal> options()
{
	Table table;
	const SurfaceMesh sheet = rectangle(2, 2, 1, 1);
	const auto add = [&](const char* name, const auto& options, auto error, const char* words) {
		table.add(name, {"", sheet, options}, error, words);
	};
	using E = InvalidOption;
	for (const double x : {0.0, -1e-9, kNaN, kInfinity}) {
		const auto change = [=](FlowOptions& o) { o.epsilon = x; };
		add("Epsilon", with(change), E(E::Epsilon, x), "must be greater than 0 radians");
		add("DiskEpsilon", inDisk(change), E(E::Epsilon, x), "must be greater than 0 radians");
	}
	for (const double x : {0.0, -1.0, 3.2, kNaN}) {
		const auto change = [=](FlowOptions& o) { o.sharpAngle = x; };
		add("SharpAngle", with(change), E(E::SharpAngle, x), "greater than 0 and at most pi");
		add("DiskSharpAngle", inDisk(change), E(E::SharpAngle, x), "greater than 0 and at most pi");
	}
	for (const double x : {-1.0, kNaN, kInfinity})
		add("ConeDistortion",
			with([=](Options& o) { o.cones.distortion = x; }),
			E(E::ConeDistortion, x),
			"must be 0 or more and finite");
	for (const int x : {-1, std::numeric_limits<int>::min()})
		add("ConeCount",
			with([=](Options& o) { o.cones.count = x; }),
			E(E::ConeCount, x),
			"must be 0 or more");
	for (const double x : {-0.1, 1.1, kNaN})
		add("SeamHiding",
			with([=](Options& o) { o.seamHiding = x; }),
			E(E::SeamHiding, x),
			"between 0 and 1");
	for (const double x : {-0.1, 0.26, kNaN})
		add("ChartMargin",
			with([=](Options& o) { o.chartMargin = x; }),
			E(E::ChartMargin, x, kMaxChartMargin),
			"between 0 and 0.25");
	for (const double x : {-1.0, kNaN, kInfinity})
		add("TileSide",
			with([=](Options& o) { o.tileSide = x; }),
			E(E::TileSide, x),
			"must be 0, or finite");
	add("TilesInOwnScale",
		with([](Options& o) {
			o.tileSide = 1.0;
			o.normalizeUV = false;
		}),
		E(E::TilesInOwnScale),
		"cannot keep the scale");
	for (const Method method : {Method::FixedTriangles, Method::EdgeSwaps, Method::Thurston}) {
		const bool isKept = method == Method::FixedTriangles;
		const char* words = "The common refinement and capped holes need intrinsic flips";
		const auto refine = [=](FlowOptions& o) {
			o.method = method;
			o.output = OutputTriangulation::CommonRefinement;
		};
		const auto cap = [=](Options& o) {
			o.method = method;
			o.holes = Holes::Capped;
		};
		add("Refined", with(refine), E(E::WithoutFlips), words);
		add("Capped", with(cap), E(E::WithoutFlips), words);
		add("DiskMethod",
			inDisk(refine),
			E(isKept ? E::WithoutFlips : E::HyperbolicMethod),
			isKept ? words : "no edge swaps and no Thurston packing");
	}
	return table.rows();
}

std::vector<Refusal> meshes()
{
	Table table;
	const SurfaceMesh sheet = rectangle(3, 3, 1, 1), solid = tetrahedron();
	const auto moved = [&](int vertex, const Point3& place) {
		SurfaceMesh mesh = sheet;
		mesh.positions[at(vertex)] = place;
		return mesh;
	};
	using E = InvalidMesh;
	const auto add = [&](const char* name, const SurfaceMesh& mesh, auto error, auto words) {
		table.add(name, {"", mesh, Options()}, error, words);
		table.add(name, {"", mesh, HyperbolicOptions()}, error, words);
		table.add(name, {"", mesh, SphereOptions()}, error, words);
	};
	add("Empty", {}, E(E::Empty, 0), "The mesh is empty");
	add("NoFaces", {solid.positions, {}}, E(E::NoFaces, 4), "4 vertices but no faces");
	for (const double x : {kNaN, kInfinity, -kInfinity}) {
		SurfaceMesh mesh = moved(4, {0, x, 0});
		mesh.positions.push_back({0, 0, x}); // of no face
		add("NotFinite", mesh, E(E::NotFinite, 2), "2 vertices have coordinates that are not fin");
	}
	const SurfaceMesh huge = scaled(solid, 1.8e50); // its coordinates are 1 / sqrt(3)
	add("OutOfRange", huge, E(E::OutOfRange, 4), "4 vertices have coordinates beyond 1e50");
	const SurfaceMesh tiny = sideBySide(scaled(solid, 1e-51), scaled(sheet, 1e-51), 0.0);
	add("TooSmall", tiny, E(E::TooSmall, 2), "2 components are smaller than 1e-50");
	const SurfaceMesh line{{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, {{0, 1, 2}, {0, 1, 1}, {2, 2, 2}}};
	add("NoArea", line, E(E::NoArea, 3), "3 faces but no area");
	const Point3 collapsed = sheet.positions[6]; // and a cap: on the side opposite to it
	const Point3 middle = 0.5 * (sheet.positions[9] + sheet.positions[10]);
	for (const Method method : {Method::FixedTriangles, Method::EdgeSwaps, Method::Thurston}) {
		const auto options = with([=](Options& o) { o.method = method; });
		table.add(
			"NoLength",
			{"", moved(5, collapsed), options},
			E(E::EdgesWithoutLength, 1),
			"1 edge has no length");
		table.add(
			"Cap",
			{"", moved(5, middle), options},
			E(E::FacesWithoutArea, 1),
			"1 face has no area");
	}
	const auto unscaled = with([](Options& o) { o.normalizeUV = false; });
	for (const double factor : {1e45, 1e-45})
		table.add(
			"BeyondFloats",
			{"", scaled(sheet, factor), unscaled},
			E(E::BeyondFloats),
			"too large or too small for texture coordinates");
	const SurfaceMesh pressed = stretched(perforatedSlab(0, 1), {1, 1, 0});
	table.add(
		"NotPuncturable", {"", pressed, SphereOptions()}, E(E::NotPuncturable), "touches itself");
	return table.rows();
}

/// What is asked for does not fit the topology or the selection.
std::vector<Refusal> targets()
{
	Table table;
	const SurfaceMesh sheet = rectangle(6, 4, 6, 4), donut = torus(2, 1, 8, 8);
	const SurfaceMesh solid = tetrahedron(), tube = ring(1, 2, 8, 2), slab = perforatedSlab(2, 1);
	using E = InvalidOption;
	using C = InadmissibleCurvature;
	const std::tuple<std::string, SurfaceMesh, SurfaceType> surfaces[] = {
		{"Sphere", solid, SurfaceType{0, 0}},
		{"Torus", donut, SurfaceType{1, 0}},
		{"Annulus", tube, SurfaceType{0, 2}},
		{"Genus2", slab, SurfaceType{2, 0}},
		{"Disk", sheet, SurfaceType{0, 1}}};
	for (const auto& [name, mesh, kind] : surfaces) {
		const std::string words = kind.name();
		for (const TargetCurvature t : {TargetCurvature::Disk, TargetCurvature::Rectangle})
			if (!kind.isDisk()) {
				const std::string what = t == TargetCurvature::Disk ? "disk" : "rectangle";
				table.add(
					"No" + what + name, {"", mesh, target(t)}, E(E::NotADisk, t, kind), words);
				table.again(sheet);
			}
		const double total = kind.totalCurvature();
		if (kind.eulerCharacteristic() != 0)
			table.add(
				"Flat" + name,
				{"", mesh, target(TargetCurvature::Flat)},
				C(C::Flat, 0.0, total, 0, kind),
				words);
		if (kind.eulerCharacteristic() >= 0) {
			table.add(
				"Hyperbolic" + name,
				{"", mesh, HyperbolicOptions()},
				C(C::HyperbolicSurface, 0.0, total, 0, kind),
				words + " with Euler characteristic " + std::to_string(kind.eulerCharacteristic()));
			table.again(rectangle(1, 1, 1, 1)); // neither has a metric: the larger one is named
		}
		if (!kind.isSphere())
			table.add(
				"NoSphere" + name,
				{"", mesh, SphereOptions()},
				E(E::NotASphere, TargetCurvature::Automatic, kind),
				words);
	}
	const auto add = [&](const char* name, const Call& call, const E& error, const char* words) {
		table.add(name, call, error, words);
	};
	const SurfaceMesh two = sideBySide(solid, solid, 5);
	add("Two", {"", two, SphereOptions()}, E(E::SphereOfComponents, 0, 0, 2), "2 components");
	const Options rectangle = target(TargetCurvature::Rectangle);
	const auto corners = [&](const std::vector<int>& selected) {
		return Call{"", sheet, rectangle, selecting(sheet, selected)};
	};
	add("ThreeCorners", corners({0, 4, 30}), E(E::CornerCount, 0, 0, 3), "3 are selected");
	add("FiveCorners", corners({0, 1, 2, 3, 4}), E(E::CornerCount, 0, 0, 5), "5 are selected");
	add("CornersOffBoundary",
		corners({0, 4, 30, 17}),
		E(E::CornersOffBoundary, 0, 0, 3),
		"only 3 of the selected");
	const SurfaceMesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
	add("TooFewBoundaryVertices",
		{"", triangle, rectangle},
		E(E::TooFewBoundaryVertices, 0, 0, 3),
		"four boundary vertices, but the boundary has 3");
	add("NothingSelected",
		{"", solid, target(TargetCurvature::SelectedCones), selecting(solid, {})},
		E(E::NothingSelected),
		"none is selected");
	const auto cones = HyperbolicTarget::SelectedCones;
	add("NothingSelectedInDisk",
		{"", slab, target(cones), selecting(slab, {})},
		E(E::NothingSelected),
		"none is selected");
	for (const double angle : {0.0, -1.0, kNaN, kInfinity})
		add("ConeAngle",
			{"", slab, target(cones, angle), selecting(slab, {0})},
			E(E::ConeAngle, angle),
			"finite and greater than 0");
	const auto placed = [&](int count) {
		Options options = target(TargetCurvature::PlacedCones);
		options.cones.count = count;
		return Call{"", solid, options};
	};
	// Two cones below 2 pi cannot carry the 4 pi of a sphere.
	add("TooFewCones", placed(2), E(E::TooFewCones, 2, 3), "at least 3 placed cones, but 2");
	add("TooFewVertices", placed(5), E(E::TooFewVertices, 5, 5, 4), "4 interior vertices");
	return table.rows();
}

/// Curvature that no metric has.
std::vector<Refusal> curvatures()
{
	Table table;
	const SurfaceMesh sheet = rectangle(5, 4, 5, 4), donut = torus(2, 1, 8, 8);
	const SurfaceMesh solid = perforatedSlab(0, 1), slab = perforatedSlab(2, 1);
	const int inside = 2 * 5 + 2, corner = 0, opposite = 5 * 5 + 4; // of the sheet
	const Options plane = target(TargetCurvature::Prescribed);
	const Options wholePlane = target(TargetCurvature::Prescribed, false);
	const HyperbolicOptions disk = target(HyperbolicTarget::Prescribed);
	const auto free = inDisk([](HyperbolicOptions& o) {
		o.target = HyperbolicTarget::Prescribed;
		o.freeBoundary = true;
	});
	using E = InadmissibleCurvature;
	/// Prescribes 0 except for some vertices.
	const auto add = [&](const char* name,
						 const SurfaceMesh& mesh,
						 const auto& options,
						 const std::vector<std::pair<int, double>>& values,
						 const E& error,
						 const char* words) {
		Call call{"", mesh, options};
		call.input.targetCurvature.assign(mesh.positions.size(), 0.0);
		for (const auto& [v, k] : values)
			call.input.targetCurvature[at(v)] = k;
		table.add(name, call, error, words);
	};
	const double kDeep = -16.5 * kPi; // 18 boundary vertices: sum K inside > 2 pi - 18 pi
	const E deep(E::FreeBoundary, kDeep, -16 * kPi, 18);
	const E sum(E::HyperbolicSum, -0.5, 0.0, 0, SurfaceType{1, 0});
	add("NaN", donut, plane, {{3, kNaN}}, E(E::NotFinite, 0, 0, 1), "1 vertex");
	add("Infinite", slab, disk, {{3, kInfinity}, {5, kNaN}}, E(E::NotFinite, 0, 0, 2), "2 vert");
	add("Torus", donut, plane, {{3, 0.75}, {9, -0.25}}, E(E::GaussBonnet, 0.5), "adds up to 0.5");
	add("Sheet", sheet, wholePlane, {{corner, 1}}, E(E::GaussBonnet, 1, 2 * kPi), "= 6.28318531");
	add("Inside",
		sheet,
		plane,
		{{inside, 7.0}, {inside + 1, 6.0}},
		E(E::TooLargeInside, 7.0, 2 * kPi, 1),
		"curvature 7 at an interior vertex (1 such)");
	add("InTheDisk",
		slab,
		disk,
		{{0, 7.0}, {5, 9.0}},
		E(E::TooLargeInside, 9.0, 2 * kPi, 2),
		"curvature 9 at an interior vertex (2 such): it must be less than 2 pi = 6.28318531");
	add("OnBoundary",
		sheet,
		wholePlane,
		{{corner, 3.5}, {opposite, 2 * kPi - 3.5}},
		E(E::TooLargeOnBoundary, 3.5, kPi, 1),
		"boundary vertex (1 such): it must be less than pi = 3.14159265");
	add("FreeBoundary", sheet, plane, {{inside, kDeep}}, deep, "free boundary of 18 vertices");
	add("FreeInTheDisk", sheet, free, {{inside, kDeep}}, deep, "free boundary of 18 vertices");
	add("Sum", donut, disk, {{3, -0.5}}, sum, "adds up to -0.5");
	table.add(
		"TwoCones",
		{"", solid, target(TargetCurvature::SelectedCones), selecting(solid, {0, 5})},
		E(E::TooLargeInside, 2 * kPi, 2 * kPi, 2),
		"interior vertex (2 such)");
	table.add( // 3 pi of curvature on a sphere
		"ThreeCones",
		{"", solid, target(HyperbolicTarget::SelectedCones, kPi), selecting(solid, {0, 5, 9})},
		E(E::HyperbolicSum, 3 * kPi, 4 * kPi, 0, SurfaceType{0, 0}),
		"2 pi chi = 12.5663706");
	// All the negative curvature of many handles is moved to one small hole.
	const SurfaceMesh handles = withoutStars(perforatedSlab(10, 2), {0});
	add("ScalesApart", handles, plane, {}, E(E::ScalesApart, kBeyond), "times as large as others");
	return table.rows();
}

/// Where the flow comes to an end without the metric.
std::vector<Refusal> flows()
{
	Table table;
	using E = NotConverged;
	const auto add = [&](const char* name, const Call& call, E error, Method method, auto words) {
		error.method = method;
		table.add(name, call, error, words);
	};
	const auto prescribing = [](const SurfaceMesh& mesh, double value, const auto& options) {
		Call call{"", mesh, options};
		call.input.targetCurvature.assign(mesh.positions.size(), 0.0);
		call.input.targetCurvature[0] = value;
		return call;
	};
	const char* broken = "the triangle inequality at the end";
	HyperbolicOptions fixed = target(HyperbolicTarget::Prescribed);
	fixed.method = Method::FixedTriangles;
	add("BrokenTriangle",
		prescribing(fanWithGap(100), -3.0, fixedTriangulation(TargetCurvature::Prescribed)),
		E(E::BrokenTriangles, 1),
		Method::FixedTriangles,
		broken);
	add("BrokenInTheDisk", // more than a straight angle for each triangle at one vertex
		prescribing(perforatedSlab(4, 1), -11.9 * kPi, fixed),
		E(E::BrokenTriangles, kSome),
		Method::FixedTriangles,
		broken);
	add("Crowding", // the disk's ends are e^-47 of its middle
		{"", rectangle(60, 1, 60, 2), target(TargetCurvature::Disk)},
		E(E::LostInRounding, kSome),
		Method::IntrinsicFlips,
		"lost in rounding");
	const SurfaceMesh handles = withoutStars(perforatedSlab(10, 2), {0});
	add("RoundAHole",
		{"", handles, with([](Options& o) { o.cones.distortion = 1e9; })},
		E(E::LostInRounding),
		Method::IntrinsicFlips,
		"times as large as others");
	Random random(9);
	const SurfaceMesh bumpy = bumpyTorus(12, 9, random);
	std::vector<int> many;
	for (int v = 5; v < static_cast<int>(bumpy.positions.size()); v += 3)
		many.push_back(v);
	add("OutsideDisk", // whose doubles reach to 37
		{"", bumpy, target(HyperbolicTarget::SelectedCones, 1e-12), selecting(bumpy, many)},
		E(E::OutsideDisk, kSome),
		Method::IntrinsicFlips,
		"so far from the middle of the layout");
	return table.rows();
}

class Refusals : public ::testing::TestWithParam<Refusal>
{
};

TEST_P(Refusals, NameWhatIsWrongAtTheFacadeTooAndLeaveTheMesh)
{
	const Refusal& refusal = GetParam();
	const auto [face, faces] = refusal.expect([&] { outcomeOf(refusal); });
	EXPECT_EQ(face, refusal.facesBefore);
	EXPECT_EQ(
		faces,
		refusal.facesBefore < 0 ? 0u : refusal.mesh.triangles.size() - at(refusal.facesBefore));
	using Facade = vcg::tri::RicciFlow<DoubleMesh>;
	const VertexInput& input = refusal.input;
	DoubleMesh m;
	toVcg(refusal.mesh, m);
	for (std::size_t v = 0; v < m.vert.size(); ++v) {
		if (!input.selected.empty() && input.selected[v])
			m.vert[v].SetS();
		m.vert[v].Q() = input.targetCurvature.empty() ? 0.25 * double(v) : input.targetCurvature[v];
	}
	const std::string before = contents(m);
	refusal.expect([&] {
		if (const auto* options = std::get_if<SphereOptions>(&refusal.options))
			Facade::ComputeSphere(m, *options);
		else if (const auto* hyperbolic = std::get_if<HyperbolicOptions>(&refusal.options))
			Facade::ComputeHyperbolic(m, *hyperbolic);
		else
			Facade::Compute(m, std::get<Options>(refusal.options));
	});
	EXPECT_EQ(contents(m) == before, true);
}

/// The façade cannot hand such faces over.
TEST(FacesInArrays, HaveTheirVerticesThere)
{
	const SurfaceMesh sound = tetrahedron();
	for (const int vertex : {-1, 4, 1000})
		for (const std::size_t faces : {1u, 3u}) {
			SurfaceMesh mesh = sound;
			for (std::size_t f = 0; f < faces; ++f)
				mesh.triangles[f][f] = vertex;
			const std::function<void()> calls[] = {
				[&] { parametrizeEuclidean(mesh, {}, {}); },
				[&] { parametrizeHyperbolic(mesh, {}, {}); },
				[&] { mapToSphere(mesh, {}); }};
			for (const auto& call : calls) {
				SCOPED_TRACE(std::to_string(faces) + " with " + std::to_string(vertex));
				expectSameData(
					refusalOf<InvalidMesh>(call), InvalidMesh(InvalidMesh::DamagedFaces, faces));
			}
		}
}

TEST(Arrays, HaveALengthThatFitsTheMesh)
{
	const SurfaceMesh sound = perforatedSlab(2, 1);
	const std::size_t vertices = sound.positions.size(), faces = sound.triangles.size();
	const struct
	{
		const char* name;
		std::size_t wanted;
		std::function<void(SurfaceMesh&, VertexInput&, std::size_t)> resize;
	} arrays[] = {
		{"seam",
		 faces,
		 [](SurfaceMesh& mesh, VertexInput&, std::size_t n) { mesh.seam.resize(n); }},
		{"diagonal",
		 faces,
		 [](SurfaceMesh& mesh, VertexInput&, std::size_t n) { mesh.diagonal.resize(n); }},
		{"part",
		 vertices,
		 [](SurfaceMesh& mesh, VertexInput&, std::size_t n) { mesh.part.resize(n); }},
		{"selected",
		 vertices,
		 [](SurfaceMesh&, VertexInput& input, std::size_t n) { input.selected.resize(n); }},
		{"targetCurvature", vertices, [](SurfaceMesh&, VertexInput& input, std::size_t n) {
			 input.targetCurvature.resize(n);
		 }}};
	for (const auto& array : arrays)
		for (const std::size_t n :
			 {std::size_t(1), array.wanted - 1, array.wanted, array.wanted + 1}) {
			SCOPED_TRACE(array.name + std::to_string(n));
			SurfaceMesh mesh = sound;
			VertexInput input;
			array.resize(mesh, input, n);
			const std::function<void()> calls[] = {
				[&] { parametrizeEuclidean(mesh, input, {}); },
				[&] { parametrizeHyperbolic(mesh, input, {}); }};
			for (const auto& call : calls) {
				if (n == array.wanted) {
					EXPECT_NO_THROW(call());
					continue;
				}
				const auto refusal = refusalOf<InvalidMesh>(call);
				EXPECT_EQ(refusal.problem, InvalidMesh::ArrayLength);
				EXPECT_EQ(refusal.array, std::string(array.name));
				EXPECT_EQ(refusal.count, n);
				EXPECT_EQ(refusal.wanted, array.wanted);
				expectWords(
					refusal.what(), {array.name, std::to_string(n), std::to_string(array.wanted)});
			}
		}
}

TEST(Choices, AreThoseThatThereAre)
{
	const SurfaceMesh mesh = tetrahedron();
	const auto expectRefused =
		[](const char* name, int choices, auto options, const auto& member, const auto& call) {
			for (const int value : {-1, choices, 99}) {
				auto changed = options;
				auto& choice = std::invoke(member, changed);
				choice = static_cast<std::remove_reference_t<decltype(choice)>>(value);
				const auto refusal = refusalOf<InvalidOption>([&] { call(changed); });
				EXPECT_EQ(refusal.problem, InvalidOption::NoSuchChoice);
				EXPECT_EQ(refusal.name, std::string(name));
				EXPECT_EQ(refusal.value, value);
				EXPECT_EQ(refusal.bound, choices);
				expectWords(refusal.what(), {name, std::to_string(value)});
			}
		};
	const auto inPlane = [&](const char* name, int choices, const auto& member) {
		expectRefused(name, choices, Options(), member, [&](const Options& options) {
			parametrizeEuclidean(mesh, {}, options);
		});
	};
	const auto inDisk = [&](const char* name, int choices, const auto& member) {
		expectRefused(
			name, choices, HyperbolicOptions(), member, [&](const HyperbolicOptions& options) {
				parametrizeHyperbolic(mesh, {}, options);
			});
	};
	inPlane("target", 7, &Options::target);
	inPlane(
		"rounding", 2, [](Options & o) -> auto& { return o.cones.rounding; });
	inPlane("holes", 3, &Options::holes);
	inPlane("charts", 4, &Options::charts);
	inPlane("join", 3, &Options::join);
	inPlane("turns", 3, &Options::turns);
	inDisk("target", 3, &HyperbolicOptions::target);
	inPlane("method", 4, &Options::method);
	inPlane("output", 2, &Options::output);
	inDisk("finish", 4, &HyperbolicOptions::finish);
}

/// Beside a vertex so far away no face has an area that doubles can tell from 0.
TEST(Coordinates, ThatDifferByMoreThanDoublesHoldAreNamed)
{
	SurfaceMesh mesh = rectangle(6, 6, 1.0, 1.0);
	mesh.positions[17][0] = 1e49;
	const auto refusal = refusalOf<InvalidMesh>([&] { parametrizeEuclidean(mesh, {}, {}); });
	EXPECT_EQ(refusal.problem, InvalidMesh::ScalesApart);
	EXPECT_EQ(refusal.vertices[0], 17);
	expectWords(refusal.what(), {"17"});
}

INSTANTIATE_TEST_SUITE_P(Options, Refusals, ::testing::ValuesIn(options()), CallName());
INSTANTIATE_TEST_SUITE_P(Meshes, Refusals, ::testing::ValuesIn(meshes()), CallName());
INSTANTIATE_TEST_SUITE_P(Targets, Refusals, ::testing::ValuesIn(targets()), CallName());
INSTANTIATE_TEST_SUITE_P(Curvatures, Refusals, ::testing::ValuesIn(curvatures()), CallName());
INSTANTIATE_TEST_SUITE_P(Flows, Refusals, ::testing::ValuesIn(flows()), CallName());

} // namespace
} // namespace ricci::testing
