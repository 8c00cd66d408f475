// SPDX-License-Identifier: GPL-3.0-or-later
// What the public functions refuse: with which error, which data and which words. A refused mesh is bit for bit
// what it was, and the façade refuses what the functions on arrays do.
#include "support/calls.h"
#include "support/expect.h"
#include "support/flat_map.h"
#include "support/listener.h"
#include "support/mesh_contents.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/transform.h"
#include "support/vcg_mesh.h"

#include <vcg/complex/algorithms/parametrization/ricci_flow_layers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool sameNumber(double a, double b)
{
	return a == b || std::abs(a - b) <= 1e-9 * std::abs(b) || (std::isnan(a) && std::isnan(b));
}

void expectSameData(const InvalidMesh& error, const InvalidMesh& expected)
{
	EXPECT_EQ(error.problem, expected.problem);
	EXPECT_EQ(error.count, expected.count);
}

void expectSameData(const InvalidOption& error, const InvalidOption& expected)
{
	EXPECT_EQ(error.problem, expected.problem);
	EXPECT_TRUE(sameNumber(error.value, expected.value)) << error.value;
	EXPECT_TRUE(sameNumber(error.bound, expected.bound)) << error.bound;
	EXPECT_EQ(error.count, expected.count);
	EXPECT_EQ(error.target, expected.target);
	EXPECT_EQ(error.surface.name(), expected.surface.name());
}

void expectSameData(const InadmissibleCurvature& error, const InadmissibleCurvature& expected)
{
	EXPECT_EQ(error.problem, expected.problem);
	EXPECT_TRUE(sameNumber(error.value, expected.value)) << error.value;
	EXPECT_TRUE(sameNumber(error.bound, expected.bound)) << error.bound;
	EXPECT_EQ(error.count, expected.count);
	EXPECT_EQ(error.surface.name(), expected.surface.name());
}

/// A number that is not known before.
constexpr std::size_t kSome = 1000000;

void expectSameData(const NotConverged& error, const NotConverged& expected)
{
	EXPECT_EQ(error.problem, expected.problem);
	EXPECT_GE(error.count, std::min<std::size_t>(expected.count, 1));
	if (expected.count != kSome) {
		EXPECT_EQ(error.count, expected.count);
	}
	EXPECT_EQ(error.method, expected.method);
}

/// A call that is refused.
struct Refusal : Call
{
	template<class E>
	Refusal(
		const char* called,
		SurfaceMesh surface,
		decltype(options) asked,
		const E& error,
		std::vector<std::string> words,
		VertexInput values = {}) :
			Call{called, std::move(surface), std::move(asked), std::move(values)},
			expect([error, words](const std::function<void()>& call) {
				const E refused = refusalOf<E>(call);
				expectSameData(refused, error);
				expectWords(refused.what(), words);
				return std::pair<int, std::size_t>(refused.componentFace, refused.componentFaces);
			})
	{
	}

	/// The same where the refused surface comes after another one, which is not refused.
	Refusal after(const SurfaceMesh& first) const
	{
		Refusal both = *this;
		both.name += "AfterAnother";
		both.mesh = sideBySide(first, mesh, 50.0);
		both.facesBefore = static_cast<int>(first.triangles.size());
		return both;
	}

	/// Returns the component that is named.
	std::function<std::pair<int, std::size_t>(const std::function<void()>&)> expect;
	int facesBefore = -1;
};

template<class AnyOptions = Options>
AnyOptions with(const std::function<void(AnyOptions&)>& change)
{
	AnyOptions options;
	change(options);
	return options;
}
Options target(TargetCurvature target, bool freeBoundary = true)
{
	Options options;
	options.target = target;
	options.freeBoundary = freeBoundary;
	return options;
}
HyperbolicOptions cones(double angle)
{
	HyperbolicOptions options;
	options.target = HyperbolicTarget::SelectedCones;
	options.coneAngle = angle;
	return options;
}
HyperbolicOptions prescribedInDisk(bool freeBoundary = false)
{
	HyperbolicOptions options;
	options.target = HyperbolicTarget::Prescribed;
	options.freeBoundary = freeBoundary;
	return options;
}

SurfaceType type(int genus, int loops)
{
	SurfaceType type;
	type.genus = genus;
	type.boundaryLoops = loops;
	return type;
}

/// 0 but for some vertices.
VertexInput curvature(
	const SurfaceMesh& mesh, const std::vector<std::pair<int, double>>& values, double rest = 0.0)
{
	VertexInput input;
	input.targetCurvature.assign(mesh.positions.size(), rest);
	for (const auto& [v, k] : values)
		input.targetCurvature[at(v)] = k;
	return input;
}

SurfaceMesh moved(SurfaceMesh mesh, int vertex, const Point3& place)
{
	mesh.positions[at(vertex)] = place;
	return mesh;
}

std::vector<Refusal> options()
{
	const SurfaceMesh sheet = rectangle(2, 2, 1, 1);
	std::vector<Refusal> all;
	int n = 0;
	const auto add =
		[&](const char* name, const auto& with, const InvalidOption& error, auto words) {
			all.emplace_back(name, sheet, with, error, std::vector<std::string>{words});
			all.back().name += std::to_string(n++);
		};
	for (const double x : {0.0, -1e-9, kNaN, kInfinity}) {
		const InvalidOption error(InvalidOption::Epsilon, x);
		const char* words = "must be greater than 0 radians";
		add("Epsilon", with<Options>([=](Options& o) { o.epsilon = x; }), error, words);
		add("HyperbolicEpsilon",
			with<HyperbolicOptions>([=](HyperbolicOptions& o) { o.epsilon = x; }),
			error,
			words);
	}
	for (const double x : {-1.0, kNaN, kInfinity})
		add("ConeDistortion",
			with<Options>([=](Options& o) { o.cones.distortion = x; }),
			InvalidOption(InvalidOption::ConeDistortion, x),
			"must be 0 or more and finite");
	for (const int x : {-1, std::numeric_limits<int>::min()})
		add("ConeCount",
			with<Options>([=](Options& o) { o.cones.count = x; }),
			InvalidOption(InvalidOption::ConeCount, x),
			"must be 0 or more");
	for (const double x : {-0.1, 1.1, kNaN})
		add("SeamHiding",
			with<Options>([=](Options& o) { o.seamHiding = x; }),
			InvalidOption(InvalidOption::SeamHiding, x),
			"between 0 and 1");
	for (const double x : {-0.1, 0.26, kNaN})
		add("ChartMargin",
			with<Options>([=](Options& o) { o.chartMargin = x; }),
			InvalidOption(InvalidOption::ChartMargin, x, kMaxChartMargin),
			"between 0 and 0.25");
	for (const Method method : {Method::FixedTriangles, Method::EdgeSwaps, Method::Thurston}) {
		const InvalidOption error(InvalidOption::WithoutFlips);
		const char* words = "The common refinement and capped holes belong to intrinsic flips";
		const auto change = [=](FlowOptions& o) {
			o.method = method;
			o.output = OutputTriangulation::CommonRefinement;
		};
		add("Refined", with<Options>(change), error, words);
		add("Capped",
			with<Options>([=](Options& o) {
				o.method = method;
				o.holes = Holes::Capped;
			}),
			error,
			words);
		add("HyperbolicMethod",
			with<HyperbolicOptions>(change),
			method == Method::FixedTriangles ? error
											 : InvalidOption(InvalidOption::HyperbolicMethod),
			method == Method::FixedTriangles ? words : "no edge swaps and no Thurston packing");
	}
	SurfaceMesh many;
	for (int i = 0; i < 30; ++i)
		many = sideBySide(many, sheet, 3.0 * i);
	all.emplace_back(
		"ChartMarginTooWide", // 30 charts need more than 5 such margins side by side
		many,
		with<Options>([](Options& o) { o.chartMargin = kMaxChartMargin; }),
		InvalidOption(InvalidOption::ChartMarginTooWide, kMaxChartMargin, 0.0, 30),
		std::vector<std::string>{"leaves no room for 30 charts"});
	return all;
}

std::vector<Refusal> meshes()
{
	const SurfaceMesh sheet = rectangle(3, 3, 1, 1), solid = tetrahedron();
	const SurfaceMesh points{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}};
	SurfaceMesh line{{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, {{0, 1, 2}, {0, 1, 1}, {2, 2, 2}}};
	SurfaceMesh unused = sheet;
	unused.positions.push_back({kNaN, 0, 0});
	SurfaceMesh pressed = perforatedSlab(0, 1);
	for (Point3& p : pressed.positions)
		p[2] = 0.0;
	const SurfaceMesh collapsed = moved(sheet, 5, sheet.positions[6]);
	const SurfaceMesh cap = moved(
		sheet, 5, 0.5 * (sheet.positions[9] + sheet.positions[10])); // on the side opposite to it
	std::vector<Refusal> all;
	int n = 0;
	const auto add =
		[&](const char* name, const SurfaceMesh& mesh, const InvalidMesh& error, auto words) {
			for (const auto& with :
				 {decltype(Call::options)(Options()),
				  decltype(Call::options)(HyperbolicOptions()),
				  decltype(Call::options)(SphereOptions())}) {
				all.emplace_back(name, mesh, with, error, std::vector<std::string>{words});
				all.back().name += std::to_string(n++);
			}
		};
	add("Empty", {}, InvalidMesh(InvalidMesh::Empty, 0), "The mesh is empty");
	add("NoFaces", points, InvalidMesh(InvalidMesh::NoFaces, 3), "3 vertices but no faces");
	for (const double x : {kNaN, kInfinity, -kInfinity})
		add("NotFinite",
			moved(moved(sheet, 4, {0, x, 0}), 9, {0, 0, x}),
			InvalidMesh(InvalidMesh::NotFinite, 2),
			"2 vertices have coordinates that are not finite");
	add("UnusedNotFinite", unused, InvalidMesh(InvalidMesh::NotFinite, 1), "1 vertex has");
	add("OutOfRange",
		scaled(solid, 1.8e50), // whose coordinates are 1 / sqrt(3)
		InvalidMesh(InvalidMesh::OutOfRange, 4),
		"4 vertices have coordinates beyond 1e50");
	add("TooSmall",
		sideBySide(scaled(solid, 1e-51), scaled(sheet, 1e-51), 0.0),
		InvalidMesh(InvalidMesh::TooSmall, 2),
		"2 components are smaller than 1e-50");
	add("NoArea", line, InvalidMesh(InvalidMesh::NoArea, 3), "3 faces but no area");
	for (const Method method : {Method::FixedTriangles, Method::EdgeSwaps, Method::Thurston}) {
		const auto options = with<Options>([=](Options& o) { o.method = method; });
		const std::string number = std::to_string(static_cast<int>(method));
		all.emplace_back(
			"EdgeWithoutLength",
			collapsed,
			options,
			InvalidMesh(InvalidMesh::EdgesWithoutLength, 1),
			std::vector<std::string>{"1 edge has no length"});
		all.back().name += number;
		all.emplace_back(
			"FaceWithoutArea",
			cap,
			options,
			InvalidMesh(InvalidMesh::FacesWithoutArea, 1),
			std::vector<std::string>{"1 face has no area"});
		all.back().name += number;
	}
	for (const double factor : {1e45, 1e-45}) {
		all.emplace_back(
			"BeyondFloats",
			scaled(sheet, factor),
			with<Options>([](Options& o) { o.normalizeUV = false; }),
			InvalidMesh(InvalidMesh::BeyondFloats),
			std::vector<std::string>{"too large or too small for texture coordinates"});
		all.back().name += factor > 1 ? "Large" : "Small";
	}
	all.emplace_back(
		"NotPuncturable",
		pressed,
		SphereOptions(),
		InvalidMesh(InvalidMesh::NotPuncturable),
		std::vector<std::string>{"touches itself"});
	return all;
}

/// What is asked for does not fit the topology or the selection.
std::vector<Refusal> targets()
{
	const SurfaceMesh sheet = rectangle(6, 4, 6, 4), donut = torus(2, 1, 8, 8);
	const SurfaceMesh solid = tetrahedron(), tube = ring(1, 2, 8, 2), slab = perforatedSlab(2, 1);
	std::vector<Refusal> all;
	const auto add = [&](std::string name,
						 const SurfaceMesh& mesh,
						 const decltype(Call::options)& with,
						 const auto& error,
						 const std::vector<std::string>& words,
						 const VertexInput& input = {}) {
		all.emplace_back("", mesh, with, error, words, input);
		all.back().name = std::move(name);
		return all.back();
	};
	const struct
	{
		const char* name;
		const SurfaceMesh& mesh;
		SurfaceType type;
	} others[] = {
		{"Sphere", solid, type(0, 0)},
		{"Torus", donut, type(1, 0)},
		{"Annulus", tube, type(0, 2)},
		{"Genus2", slab, type(2, 0)},
		{"Disk", sheet, type(0, 1)}};
	for (const auto& [name, mesh, kind] : others) {
		const std::string words = kind.name();
		for (const TargetCurvature t : {TargetCurvature::Disk, TargetCurvature::Rectangle})
			if (!kind.isDisk())
				all.push_back(
					add((t == TargetCurvature::Disk ? "NotADisk" : "NotARectangle") +
							std::string(name),
						mesh,
						target(t),
						InvalidOption(InvalidOption::NotADisk, t, kind),
						{words, t == TargetCurvature::Disk ? "A disk is" : "A rectangle is"})
						.after(sheet));
		if (kind.eulerCharacteristic() != 0)
			add(std::string("Flat") + name,
				mesh,
				target(TargetCurvature::Flat),
				InadmissibleCurvature(
					InadmissibleCurvature::Flat, 0.0, kind.totalCurvature(), 0, kind),
				{words, "2 pi chi = "});
		if (kind.eulerCharacteristic() >= 0)
			all.push_back(
				add(std::string("Hyperbolic") + name,
					mesh,
					HyperbolicOptions(),
					InadmissibleCurvature(
						InadmissibleCurvature::HyperbolicSurface,
						0.0,
						kind.totalCurvature(),
						0,
						kind),
					{words, "Euler characteristic " + std::to_string(kind.eulerCharacteristic())})
					.after(slab));
		if (!kind.isSphere())
			add(std::string("NotASphere") + name,
				mesh,
				SphereOptions(),
				InvalidOption(InvalidOption::NotASphere, TargetCurvature::Automatic, kind),
				{words});
	}
	add("SphereOfComponents",
		sideBySide(solid, solid, 5),
		SphereOptions(),
		InvalidOption(InvalidOption::SphereOfComponents, 0.0, 0.0, 2),
		{"2 components"});
	const auto corners = [&](const std::vector<int>& selected) {
		return selecting(sheet, selected);
	};
	const Options rectangle = target(TargetCurvature::Rectangle);
	for (const std::vector<int>& chosen : {std::vector<int>{0, 4, 30}, {0, 1, 2, 3, 4}})
		add("CornerCount" + std::to_string(chosen.size()),
			sheet,
			rectangle,
			InvalidOption(InvalidOption::CornerCount, 0.0, 0.0, chosen.size()),
			{std::to_string(chosen.size()) + " are selected"},
			corners(chosen));
	add("CornersOffBoundary",
		sheet,
		rectangle,
		InvalidOption(InvalidOption::CornersOffBoundary, 0.0, 0.0, 3),
		{"only 3 of the selected"},
		corners({0, 4, 30, 17}));
	add("TooFewBoundaryVertices",
		{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}},
		rectangle,
		InvalidOption(InvalidOption::TooFewBoundaryVertices, 0.0, 0.0, 3),
		{"four boundary vertices", "has 3"});
	add("NothingSelected",
		solid,
		target(TargetCurvature::SelectedCones),
		InvalidOption(InvalidOption::NothingSelected),
		{"none is selected"},
		selecting(solid, {}));
	add("NothingSelectedInDisk",
		slab,
		cones(1.0),
		InvalidOption(InvalidOption::NothingSelected),
		{"none is selected"},
		selecting(slab, {}));
	for (const double angle : {0.0, -1.0, kNaN, kInfinity})
		add("ConeAngle" + std::to_string(all.size()),
			slab,
			cones(angle),
			InvalidOption(InvalidOption::ConeAngle, angle),
			{"finite and greater than 0"},
			selecting(slab, {0}));
	const auto placed = [](int count) {
		return with<Options>([=](Options& o) {
			o.target = TargetCurvature::PlacedCones;
			o.cones.count = count;
		});
	};
	// Two cones below 2 pi cannot carry the 4 pi of a sphere.
	add("TooFewCones",
		solid,
		placed(2),
		InvalidOption(InvalidOption::TooFewCones, 2, 3),
		{"at least 3 placed cones", "2 are asked for"});
	add("TooFewVertices",
		solid,
		placed(5),
		InvalidOption(InvalidOption::TooFewVertices, 5, 5, 4),
		{"4 interior vertices"});
	return all;
}

/// Curvature that no metric has.
std::vector<Refusal> curvatures()
{
	const SurfaceMesh sheet = rectangle(5, 4, 5, 4), donut = torus(2, 1, 8, 8);
	const SurfaceMesh solid = perforatedSlab(0, 1), slab = perforatedSlab(2, 1);
	const int inside = 2 * 5 + 2, corner = 0, opposite = 5 * 5 + 4; // of the sheet
	const Options prescribed = target(TargetCurvature::Prescribed);
	const Options withBoundary = target(TargetCurvature::Prescribed, false);
	std::vector<Refusal> all;
	const auto add = [&](const char* name,
						 const SurfaceMesh& mesh,
						 const decltype(Call::options)& with,
						 const InadmissibleCurvature& error,
						 const std::vector<std::string>& words,
						 const VertexInput& input) {
		all.emplace_back(name, mesh, with, error, words, input);
	};
	using E = InadmissibleCurvature;
	add("NaN",
		donut,
		prescribed,
		E(E::NotFinite, 0, 0, 1),
		{"1 vertex"},
		curvature(donut, {{3, kNaN}}));
	add("Infinite",
		slab,
		prescribedInDisk(),
		E(E::NotFinite, 0, 0, 2),
		{"2 vertices"},
		curvature(slab, {{3, kInfinity}, {5, -kInfinity}}));
	add("GaussBonnet",
		donut,
		prescribed,
		E(E::GaussBonnet, 0.5, 0.0),
		{"adds up to 0.5", "2 pi chi = 0"},
		curvature(donut, {{3, 0.75}, {9, -0.25}}));
	add("GaussBonnetWithBoundary",
		sheet,
		withBoundary,
		E(E::GaussBonnet, 1.0, 2 * kPi),
		{"2 pi chi = 6.28318531"},
		curvature(sheet, {{corner, 1.0}}));
	add("TooLargeInside",
		solid,
		target(TargetCurvature::SelectedCones),
		E(E::TooLargeInside, 2 * kPi, 2 * kPi, 2),
		{"interior vertex (2 such)", "less than 2 pi = 6.28318531"},
		selecting(solid, {0, 5}));
	add("TooLargeInsideAFreeBoundary",
		sheet,
		prescribed,
		E(E::TooLargeInside, 7.0, 2 * kPi, 1),
		{"curvature 7 at"},
		curvature(sheet, {{inside, 7.0}, {inside + 1, 6.0}}));
	add("TooLargeInTheDisk",
		slab,
		prescribedInDisk(),
		E(E::TooLargeInside, 9.0, 2 * kPi, 2),
		{"curvature 9 at", "2 such"},
		curvature(slab, {{0, 7.0}, {5, 9.0}}));
	add("TooLargeOnBoundary",
		sheet,
		withBoundary,
		E(E::TooLargeOnBoundary, 3.5, kPi, 1),
		{"boundary vertex (1 such)", "less than pi = 3.14159265"},
		curvature(sheet, {{corner, 3.5}, {opposite, 2 * kPi - 3.5}}));
	// 18 boundary vertices: sum K inside > 2 pi - 18 pi.
	add("FreeBoundary",
		sheet,
		prescribed,
		E(E::FreeBoundary, -16.5 * kPi, -16 * kPi, 18),
		{"free boundary of 18 vertices"},
		curvature(sheet, {{inside, -16.5 * kPi}}));
	add("FreeBoundaryInTheDisk",
		sheet,
		prescribedInDisk(true),
		E(E::FreeBoundary, -16.5 * kPi, -16 * kPi, 18),
		{"free boundary of 18 vertices"},
		curvature(sheet, {{inside, -16.5 * kPi}}));
	add("HyperbolicSum",
		donut,
		prescribedInDisk(),
		E(E::HyperbolicSum, -0.5, 0.0, 0, type(1, 0)),
		{"adds up to -0.5", "more than 2 pi chi = 0"},
		curvature(donut, {{3, -0.5}}));
	add("HyperbolicCones", // 3 pi of curvature on a sphere
		solid,
		cones(kPi),
		E(E::HyperbolicSum, 3 * kPi, 4 * kPi, 0, type(0, 0)),
		{"2 pi chi = 12.5663706"},
		selecting(solid, {0, 5, 9}));
	return all;
}

/// Where the flow comes to an end without the metric.
std::vector<Refusal> flows()
{
	const SurfaceMesh fan = fanWithGap(100), slab = perforatedSlab(4, 1);
	const SurfaceMesh handles = withoutStars(perforatedSlab(40, 3), {0});
	NotConverged broken(NotConverged::BrokenTriangles, 1),
		outside(NotConverged::OutsideDisk, kSome);
	broken.method = Method::FixedTriangles;
	NotConverged brokenInDisk(NotConverged::BrokenTriangles, kSome);
	brokenInDisk.method = Method::FixedTriangles;
	Random random(9);
	const SurfaceMesh bumpy = bumpyTorus(12, 9, random);
	std::vector<int> many;
	for (int v = 5; v < static_cast<int>(bumpy.positions.size()); v += 3)
		many.push_back(v);
	HyperbolicOptions fixed = prescribedInDisk();
	fixed.method = Method::FixedTriangles;
	const std::vector<std::string> words{"the triangle inequality at the end"};
	return {
		{"BrokenTriangle",
		 fan,
		 fixedTriangulation(TargetCurvature::Prescribed),
		 broken,
		 words,
		 curvature(fan, {{0, -3.0}})},
		// More than a straight angle for each triangle at one vertex.
		{"BrokenTrianglesInDisk",
		 slab,
		 fixed,
		 brokenInDisk,
		 words,
		 curvature(slab, {{0, -11.9 * kPi}})},
		// The disk's ends are e^-47 of its middle (crowding).
		{"LostInRounding",
		 rectangle(60, 1, 60, 2),
		 target(TargetCurvature::Disk),
		 NotConverged(NotConverged::LostInRounding, kSome),
		 {"lost in rounding"}},
		// All the negative curvature of many handles is moved to one small hole.
		{"LostRoundAHole",
		 handles,
		 with<Options>([](Options& o) { o.cones.distortion = 1e9; }),
		 NotConverged(NotConverged::LostInRounding),
		 {"times as large as others"}},
		// The doubles of the disk reach to 37.
		{"OutsideDisk", bumpy, cones(1e-12), outside, {"Poincaré disk"}, selecting(bumpy, many)}};
}

class Refusals : public ::testing::TestWithParam<Refusal>
{
};

TEST_P(Refusals, NameWhatIsWrong)
{
	const Refusal& refusal = GetParam();
	const auto [face, faces] = refusal.expect([&] { outcomeOf(refusal); });
	EXPECT_EQ(face, refusal.facesBefore);
	EXPECT_EQ(
		faces,
		refusal.facesBefore < 0 ? 0u : refusal.mesh.triangles.size() - at(refusal.facesBefore));
}

TEST_P(Refusals, AreTheSameAtTheFacadeAndLeaveTheMesh)
{
	using Flow = vcg::tri::RicciFlow<DoubleMesh>;
	const Refusal& refusal = GetParam();
	DoubleMesh m;
	toVcg(refusal.mesh, m);
	for (std::size_t v = 0; v < m.vert.size(); ++v) {
		if (!refusal.input.selected.empty() && refusal.input.selected[v])
			m.vert[v].SetS();
		m.vert[v].Q() = refusal.input.targetCurvature.empty() ? 0.25 * double(v)
															  : refusal.input.targetCurvature[v];
	}
	const std::string before = contents(m);
	refusal.expect([&] {
		if (const auto* options = std::get_if<SphereOptions>(&refusal.options))
			Flow::ComputeSphere(m, *options);
		else if (const auto* hyperbolic = std::get_if<HyperbolicOptions>(&refusal.options))
			Flow::ComputeHyperbolic(m, *hyperbolic);
		else
			Flow::Compute(m, std::get<Options>(refusal.options));
	});
	EXPECT_EQ(contents(m) == before, true);
}

INSTANTIATE_TEST_SUITE_P(Options, Refusals, ::testing::ValuesIn(options()), CallName());
INSTANTIATE_TEST_SUITE_P(Meshes, Refusals, ::testing::ValuesIn(meshes()), CallName());
INSTANTIATE_TEST_SUITE_P(Targets, Refusals, ::testing::ValuesIn(targets()), CallName());
INSTANTIATE_TEST_SUITE_P(Curvatures, Refusals, ::testing::ValuesIn(curvatures()), CallName());
INSTANTIATE_TEST_SUITE_P(Flows, Refusals, ::testing::ValuesIn(flows()), CallName());

} // namespace
} // namespace ricci::testing
