// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of one component against the whole way of the mesh that consists of it: what lies
// between them only renumbers, so that all results agree to the bit.
#include "../support/expect.h"
#include "../support/flat_map.h"
#include "../support/flipped_flow.h"
#include "../support/intrinsic.h"
#include "../support/listener.h"
#include "../support/random_surface.h"
#include "../support/shapes.h"
#include "../support/transform.h"

#include <ricci/base/numbers.h>
#include <ricci/error.h>
#include <ricci/parametrize.h>
#include <ricci/pipeline/whole_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace ricci::testing {
namespace {

template<class AnyOptions>
struct Case
{
	std::string name;
	SurfaceMesh mesh;
	AnyOptions options;
	VertexInput input;
};

ComponentMap
flattened(const Component& component, const Options& options, const VertexInput& input = {})
{
	return *flattenToPlane(component, input, options);
}

ComponentMap flattened(
	const Component& component, const HyperbolicOptions& options, const VertexInput& input = {})
{
	return flattenToDisk(component, input, options);
}

FlatResult wholeWay(const SurfaceMesh& mesh, const VertexInput& input, const Options& options)
{
	return run(mesh, options, input);
}

FlatResult
wholeWay(const SurfaceMesh& mesh, const VertexInput& input, const HyperbolicOptions& options)
{
	return runInDisk(mesh, options, input);
}

/// The component as a mesh of its own.
SurfaceMesh meshOf(const Component& component)
{
	SurfaceMesh mesh;
	mesh.positions = component.positions.values();
	mesh.triangles = component.triangles;
	return mesh;
}

void expectSameMap(
	const Component& c, const ComponentMap& map, const Parametrization& flat, std::size_t chart = 0)
{
	const std::vector<int> triangles = flat.mesh.trianglesByChart(flat.charts.size())[chart];
	ASSERT_EQ(static_cast<int>(triangles.size()), map.mesh.size());
	const auto faceOf = [&](int f) { return c.face[Face(map.mesh.face[f])]; };
	std::vector<int> byFace(triangles.size());
	std::iota(byFace.begin(), byFace.end(), 0);
	std::stable_sort(
		byFace.begin(), byFace.end(), [&](int f, int g) { return faceOf(f) < faceOf(g); });
	for (std::size_t i = 0; i < triangles.size(); ++i) {
		const int own = triangles[i], f = byFace[i];
		EXPECT_EQ(flat.mesh.face[own], faceOf(f));
		const bool reversed = c.reversed[Face(map.mesh.face[f])];
		for (std::size_t k = 0; k < 3; ++k)
			EXPECT_EQ(flat.mesh.at(own)[reversed ? (3 - k) % 3 : k], map.mesh.at(f)[k]);
	}
	const double shift = std::log(map.scale);
	for (const Vertex v : c.vertex.indices()) {
		const std::size_t vertex = at(c.vertex[v]);
		EXPECT_EQ(flat.u[vertex], map.flow.u[v] + shift);
		EXPECT_EQ(
			flat.targetCurvature[vertex],
			map.flow.target.fixed[v] ? map.flow.curvature[v] : map.flow.target.curvature[v]);
	}
}

void expectSameReport(const Report& own, const Report& report)
{
	for (const auto count :
		 {&Report::components,
		  &Report::iterations,
		  &Report::flips,
		  &Report::edgeSwaps,
		  &Report::boundarySplits,
		  &Report::cappedHoles,
		  &Report::genus,
		  &Report::boundaryLoops,
		  &Report::cones,
		  &Report::seamEdges})
		EXPECT_EQ(report.*count, own.*count);
	for (const auto figure :
		 {&Report::maxCurvatureError, &Report::residualFloor, &Report::seamLength})
		EXPECT_EQ(report.*figure, own.*figure);
	for (const auto figure :
		 {&Report::torusTauRe,
		  &Report::torusTauIm,
		  &Report::annulusModulus,
		  &Report::rectangleAspect,
		  &Report::periodError,
		  &Report::hyperbolicArea,
		  &Report::relationError})
		EXPECT_EQ(report.*figure, own.*figure);
	EXPECT_EQ(report.periodMatrix, own.periodMatrix);
	ASSERT_EQ(report.flowStates.size(), own.flowStates.size());
	for (std::size_t i = 0; i < own.flowStates.size(); ++i) {
		EXPECT_EQ(report.flowStates[i].step, own.flowStates[i].step);
		EXPECT_EQ(report.flowStates[i].residual, own.flowStates[i].residual);
	}
}

void expectSameGroup(const FuchsianGroup& a, const FuchsianGroup& b)
{
	const auto expectSame = [](const std::vector<DiskIsometry>& p,
							   const std::vector<DiskIsometry>& q) {
		ASSERT_EQ(p.size(), q.size());
		for (std::size_t i = 0; i < p.size(); ++i) {
			EXPECT_EQ(p[i].a, q[i].a);
			EXPECT_EQ(p[i].b, q[i].b);
		}
	};
	expectSame(a.handles, b.handles);
	expectSame(a.peripheral, b.peripheral);
	expectSame(a.sides, b.sides);
}

template<class AnyOptions>
void expectSame(const Case<AnyOptions>& c)
{
	SCOPED_TRACE(c.name);
	const std::vector<Component> components = componentsOf(c.mesh);
	ASSERT_EQ(components.size(), 1u);
	const Component& component = components.front();
	const ComponentMap map = flattened(component, c.options, c.input);
	const FlatResult flat = wholeWay(c.mesh, c.input, c.options);
	expectSameMap(component, map, flat);
	expectSameReport(asParametrization(component, map).report, flat.report);
	ASSERT_EQ(flat.charts.size(), 1u);
	expectSameGroup(flat.charts[0].group, map.group);
}

/// Other numbers than the component will have, with a vertex that no face uses in front of them.
Renumbered shuffled(const SurfaceMesh& mesh, Random& random)
{
	Renumbered result = renumbered(mesh, random);
	result.mesh.positions.insert(result.mesh.positions.begin(), Point3{7, 7, 7});
	for (Triangle& t : result.mesh.triangles)
		for (int& v : t)
			++v;
	return result;
}

/// The vertices \p old of a mesh by their numbers after shuffled().
VertexInput selectingOld(const Renumbered& r, const std::vector<int>& old)
{
	VertexInput input;
	input.selected.push_back(0);
	for (const int v : r.vertex)
		input.selected.push_back(std::find(old.begin(), old.end(), v) != old.end());
	return input;
}

SurfaceMesh bumpyDisk(int n, Random& random)
{
	SurfaceMesh mesh = randomPlanarDisk(n, random);
	for (Point3& p : mesh.positions)
		p[2] = 0.3 * std::sin(4 * p[0]) * std::cos(3 * p[1]);
	return mesh;
}

Options euclidean(TargetCurvature target, Method method = Method::IntrinsicFlips)
{
	Options options;
	options.target = target;
	options.method = method;
	options.charts = Charts::OfTheFlow; // which is not a matter of one component
	return options;
}

template<class AnyOptions>
AnyOptions refining(AnyOptions options)
{
	options.output = OutputTriangulation::CommonRefinement;
	return options;
}

std::vector<Case<Options>> euclideanCases(Method method)
{
	Random random(4100);
	std::vector<Case<Options>> cases;
	const auto add = [&](const char* name,
						 const SurfaceMesh& mesh,
						 TargetCurvature target,
						 const VertexInput& input = {}) {
		cases.push_back({name, mesh, euclidean(target, method), input});
	};
	const SurfaceMesh disk = shuffled(bumpyDisk(7, random), random).mesh;
	for (const TargetCurvature target :
		 {TargetCurvature::Automatic, TargetCurvature::Disk, TargetCurvature::Rectangle})
		add("disk", disk, target);
	add("disk of mixed order", withReversedFaces(disk, 3), TargetCurvature::Automatic);
	add("torus", shuffled(bumpyTorus(10, 7, random), random).mesh, TargetCurvature::Flat);
	const SurfaceMesh annulus = shaken(ring(1.0, 2.5, 16, 4), 0.04, random);
	add("annulus", shuffled(annulus, random).mesh, TargetCurvature::Flat);
	const Renumbered closed = shuffled(shaken(perforatedSlab(2, 2), 0.02, random), random);
	add("placed cones", closed.mesh, TargetCurvature::PlacedCones);
	add("selected cones",
		closed.mesh,
		TargetCurvature::SelectedCones,
		selectingOld(closed, {0, 5, 11, 17, 23, 29, 35, 41}));
	const SurfaceMesh pierced = withoutStars(torus(3, 1, 16, 12), {0, 50, 100});
	add("three holes", shuffled(pierced, random).mesh, TargetCurvature::Automatic);
	return cases;
}

TEST(Flatten, IsTheEuclideanMapOfTheMeshItIs)
{
	for (const Method method : {Method::FixedTriangles, Method::EdgeSwaps, Method::IntrinsicFlips})
		for (const Case<Options>& c : euclideanCases(method)) {
			SCOPED_TRACE(static_cast<int>(method));
			expectSame(c);
		}
}

TEST(Flatten, IsTheEuclideanMapOnTheCommonRefinement)
{
	int crossings = 0;
	for (Case<Options>& c : euclideanCases(Method::IntrinsicFlips)) {
		c.options = refining(c.options);
		expectSame(c);
		crossings += run(c.mesh, c.options, c.input).report.refinementPoints;
	}
	EXPECT_GT(crossings, 100);
}

TEST(Flatten, IsTheEuclideanMapWithCappedHoles)
{
	Random random(4101);
	const SurfaceMesh mesh =
		shuffled(withoutStars(shaken(perforatedSlab(0, 5), 0.02, random), {0, 60, 120}), random)
			.mesh;
	Options options = euclidean(TargetCurvature::Automatic);
	options.holes = Holes::Capped;
	expectSame(Case<Options>{"capped", mesh, options, {}});
	expectSame(Case<Options>{"capped, refined", mesh, refining(options), {}});
	EXPECT_EQ(flattened(componentsOf(mesh).front(), options).report.cappedHoles, 2);
}

TEST(Flatten, IsTheEuclideanMapOfThurstonsPacking)
{
	Random random(4102);
	const Options options = euclidean(TargetCurvature::Flat, Method::Thurston);
	expectSame(
		Case<Options>{"torus", shuffled(bumpyTorus(10, 7, random), random).mesh, options, {}});
}

TEST(Flatten, IsTheEuclideanMapAfterEdgeSwaps)
{
	Random random(4107);
	for (int round = 0; round < 3; ++round) {
		const SurfaceMesh mesh = bumpyTorus(10, 7, random);
		VertexInput input;
		input.targetCurvature =
			randomCurvature(static_cast<int>(mesh.positions.size()), 0, -2.5, 2.5, 0.5, random);
		const Options options = euclidean(TargetCurvature::Prescribed, Method::EdgeSwaps);
		EXPECT_GT(flattened(componentsOf(mesh).front(), options, input).report.edgeSwaps, 0);
		expectSame(Case<Options>{"round " + std::to_string(round), mesh, options, input});
	}
}

/// Seven triangles round a vertex, whose strong curvature splits the boundary edge of the widest.
TEST(Flatten, IsTheEuclideanMapAfterABoundarySplit)
{
	const SurfaceMesh fan = fanWithGap(100);
	VertexInput input;
	input.targetCurvature.assign(8, 0.0);
	input.targetCurvature[0] = -3.0;
	const Options options = euclidean(TargetCurvature::Prescribed, Method::EdgeSwaps);
	EXPECT_EQ(flattened(componentsOf(fan).front(), options, input).report.boundarySplits, 1);
	expectSame(Case<Options>{"fan", fan, options, input});
}

std::vector<Case<HyperbolicOptions>> hyperbolicCases()
{
	Random random(4103);
	std::vector<Case<HyperbolicOptions>> cases;
	const SurfaceMesh closed = shuffled(shaken(perforatedSlab(2, 2), 0.05, random), random).mesh;
	cases.push_back({"genus 2", closed, {}, {}});
	cases.push_back({"genus 2 of mixed order", withReversedFaces(closed, 3), {}, {}});
	cases.push_back(
		{"three boundary loops",
		 shuffled(withoutStars(shaken(perforatedSlab(0, 5), 0.03, random), {0, 60, 120}), random)
			 .mesh,
		 {},
		 {}});
	const Renumbered sphere = shuffled(shaken(perforatedSlab(0, 2), 0.05, random), random);
	HyperbolicOptions cones;
	cones.target = HyperbolicTarget::SelectedCones;
	cones.coneAngle = kPi / 2;
	cases.push_back({"cones", sphere.mesh, cones, selectingOld(sphere, {3, 9, 20})});
	return cases;
}

TEST(Flatten, IsTheHyperbolicMapOfTheMeshItIs)
{
	for (const Case<HyperbolicOptions>& c : hyperbolicCases())
		expectSame(c);
}

TEST(Flatten, IsTheHyperbolicMapOnTheCommonRefinement)
{
	for (Case<HyperbolicOptions>& c : hyperbolicCases()) {
		c.options = refining(c.options);
		expectSame(c);
	}
}

TEST(Flatten, IsTheHyperbolicMapOnTheGivenTriangulation)
{
	Random random(4104);
	HyperbolicOptions options;
	options.method = Method::FixedTriangles;
	expectSame(Case<HyperbolicOptions>{
		"genus 2", shuffled(perforatedSlab(2, 3), random).mesh, options, {}});
}

/// What else the mesh has does not matter: each component is mapped as a mesh of its own.
template<class AnyOptions>
void expectComponentsOnTheirOwn(const SurfaceMesh& mesh, const AnyOptions& options, int count)
{
	const std::vector<Component> components = componentsOf(mesh);
	ASSERT_EQ(static_cast<int>(components.size()), count);
	const FlatResult whole = wholeWay(mesh, {}, options);
	for (std::size_t i = 0; i < components.size(); ++i) {
		const Component& component = components[i];
		const ComponentMap map = flattened(component, options);
		expectSameMap(component, map, whole, i);
		const FlatResult flat = wholeWay(meshOf(component), {}, options);
		Array<Triangle2> alone = flat.mesh.corners(), ofComponent = map.mesh.corners();
		std::sort(alone.begin(), alone.end()); // the result has them by face
		std::sort(ofComponent.begin(), ofComponent.end());
		EXPECT_TRUE(alone == ofComponent);
		EXPECT_EQ(
			flat.report.refinementPoints, map.mesh.source.size() - component.positions.size());
	}
}

TEST(Flatten, DoesNotDependOnTheRestOfTheMesh)
{
	Random random(4105);
	const SurfaceMesh flat = sideBySide(bumpyTorus(10, 7, random), bumpyDisk(6, random), 10.0);
	const SurfaceMesh curved = sideBySide(
		shaken(perforatedSlab(2, 2), 0.05, random), shaken(perforatedSlab(3, 1), 0.05, random), 20);
	for (const bool refined : {false, true}) {
		SCOPED_TRACE(refined);
		const Options options = euclidean(TargetCurvature::Automatic);
		const HyperbolicOptions hyperbolic;
		expectComponentsOnTheirOwn(
			shuffled(flat, random).mesh, refined ? refining(options) : options, 2);
		expectComponentsOnTheirOwn(
			shuffled(curved, random).mesh, refined ? refining(hyperbolic) : hyperbolic, 2);
	}
}

/// Ribbons all of whose vertices lie on the boundary: no cone has a place, however many vertices they are.
TEST(Flatten, ARibbonWithoutInnerVerticesGetsNoCones)
{
	std::vector<Options> all(3, euclidean(TargetCurvature::Automatic));
	for (Options& options : all)
		options.freeBoundary = true;
	all[1].target = all[2].target = TargetCurvature::PlacedCones;
	all[2].cones.distortion = 0.2;
	for (const int length : {100, 11000})
		for (const Ends ends : {Ends::Open, Ends::Joined})
			for (const Options& options : all) {
				SCOPED_TRACE(length);
				const SurfaceMesh ribbon = grid(1, length, Ends::Open, ends, [&](int i, int j) {
					const double turn = ends == Ends::Open ? 0.05 * j : 2.0 * kPi * j / length;
					const double height = ends == Ends::Open ? 0.1 * j : 0.3 * std::sin(3.0 * turn);
					return Point3{(1.0 + i) * std::cos(turn), (1.0 + i) * std::sin(turn), height};
				});
				const Component component = componentsOf(ribbon).front();
				const ComponentMap map = flattened(component, options);
				EXPECT_EQ(std::count(map.cones.begin(), map.cones.end(), 1), 0);
				for (const int f : map.mesh.points.indices()) {
					const Triangle2 p = map.mesh.at(f);
					EXPECT_GT(doubledArea(p[0], p[1], p[2]), 0.0);
					for (const Corner side : cornersOf(f)) {
						const std::array<Point2, 2> at = map.mesh.ends(side);
						EXPECT_NEAR(distance(at[0], at[1]), map.mesh.lengths[side], 1e-9);
					}
				}
			}
}

TEST(Flatten, KeepsToItsShareOfTheProgress)
{
	Random random(4106);
	const SurfaceMesh mesh = bumpyTorus(10, 7, random);
	Listener patient;
	const Task task(patient);
	const Task part(0.25, 0.75);
	flattenToPlane(componentsOf(mesh).front(), {}, euclidean(TargetCurvature::Automatic));
	ASSERT_GT(patient.fractions.size(), 5u);
	EXPECT_EQ(patient.fractions.front(), 0.25);
	EXPECT_EQ(patient.fractions.back(), 0.75);
	EXPECT_TRUE(std::is_sorted(patient.fractions.begin(), patient.fractions.end()));
	ASSERT_FALSE(patient.lines.empty());
	expectWords(patient.lines.front(), {"70 vertices", "140 faces", "a torus"});
}

TEST(Flatten, LeavesItToItsCallerToNameTheComponent)
{
	const SurfaceMesh pair = sideBySide(rectangle(2, 2, 1, 1), tetrahedron(), 10);
	const auto error = refusalOf<InvalidOption>(
		[&] { flattened(componentsOf(pair)[1], euclidean(TargetCurvature::Disk)); });
	EXPECT_EQ(error.problem, InvalidOption::NotADisk);
	EXPECT_EQ(error.componentFace, -1);
	EXPECT_EQ(error.componentFaces, 0u);
}

} // namespace
} // namespace ricci::testing
