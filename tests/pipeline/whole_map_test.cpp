// SPDX-License-Identifier: GPL-3.0-or-later
// From the maps of components to the map of the mesh: what is checked is what is written, all
// numbers are those of the input, and errors say where they come from.
#include "../support/expect.h"
#include "../support/flat_map.h"
#include "../support/intrinsic.h"
#include "../support/listener.h"
#include "../support/random_surface.h"
#include "../support/refinement_check.h"
#include "../support/shapes.h"
#include "../support/transform.h"

#include <ricci/error.h>
#include <ricci/measure/distortion.h>
#include <ricci/pipeline/whole_map.h>
#include <ricci/verify/chart_check.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

constexpr auto kKept = OutputTriangulation::KeepMesh;
constexpr auto kRefined = OutputTriangulation::CommonRefinement;

Options withOutput(OutputTriangulation output)
{
	Options options;
	options.output = output;
	options.charts = Charts::OfTheFlow;
	return options;
}

ComponentMap flattened(const Component& component, const Options& options)
{
	return *flattenToPlane(component, {}, options);
}

ComponentMap flattened(const Component& component, const HyperbolicOptions& options)
{
	return flattenToDisk(component, {}, options);
}

/// A torus, a closed surface of genus 2 and a disk, whose vertices and faces are mixed.
SurfaceMesh threeComponents(Random& random)
{
	SurfaceMesh disk = randomPlanarDisk(6, random);
	for (Point3& p : disk.positions)
		p[2] = 0.3 * std::sin(4 * p[0]) * std::cos(3 * p[1]);
	const SurfaceMesh closed = shaken(perforatedSlab(2, 2), 0.02, random);
	return renumbered(
			   sideBySide(sideBySide(bumpyTorus(10, 7, random), closed, 20), disk, 40), random)
		.mesh;
}

/// Three components that have hyperbolic metrics.
SurfaceMesh threeHyperbolicComponents(Random& random)
{
	const SurfaceMesh a = shaken(perforatedSlab(2, 2), 0.05, random);
	const SurfaceMesh b = shaken(perforatedSlab(3, 1), 0.05, random);
	const SurfaceMesh c = withoutStars(shaken(perforatedSlab(0, 5), 0.03, random), {0, 60, 120});
	return renumbered(sideBySide(sideBySide(a, b, 20), c, 40), random).mesh;
}

/// The map with a point at a seam moved by a hundredth of the extent: the shape is taken apart.
FlatMesh torn(FlatMesh mesh)
{
	Box2 box;
	for (const Point2& p : mesh.place)
		box.add(p);
	for (int c = 0; c < 3 * mesh.size(); ++c)
		if (const Corner side(c); mesh.across[side].isValid() && !mesh.joined(side).isValid()) {
			mesh.place[mesh.points[side]][0] += 0.01 * box.extent();
			return mesh;
		}
	ADD_FAILURE() << "there is no seam";
	return mesh;
}

void requireChart(const FlatMesh& mesh, const FlowResult& flow, const Options&)
{
	requireMap(mesh, flow, false);
}

void requireChart(const FlatMesh& mesh, const FlowResult& flow, const HyperbolicOptions&)
{
	requireDisk(mesh, flow, false);
}

template<class AnyOptions>
void expectTearsFound(const SurfaceMesh& mesh, AnyOptions options)
{
	for (const OutputTriangulation output : {kKept, kRefined}) {
		options.output = output;
		const ComponentMap map = flattened(componentsOf(mesh).front(), options);
		requireChart(map.mesh, map.flow, options);
		const auto error =
			refusalOf<NotConverged>([&] { requireChart(torn(map.mesh), map.flow, options); });
		EXPECT_EQ(error.problem, NotConverged::CheckFailed);
		expectWords(error.finding, {"seams"});
	}
}

TEST(WholeMap, ATornSeamIsFound)
{
	Random random(4200);
	const SurfaceMesh donut = bumpyTorus(10, 7, random);
	const SurfaceMesh closed = shaken(perforatedSlab(2, 2), 0.05, random);
	for (const bool mixed : {false, true}) {
		SCOPED_TRACE(mixed);
		Options options = withOutput(kKept);
		options.finish = Finish::None;
		HyperbolicOptions hyperbolic;
		hyperbolic.finish = Finish::None;
		expectTearsFound(mixed ? withReversedFaces(donut, 3) : donut, options);
		expectTearsFound(mixed ? withReversedFaces(closed, 3) : closed, hyperbolic);
	}
}

/// A corner away from the seams that leaves its place makes a tear of two sides that were one.
TEST(WholeMap, ACornerThatLeavesItsPlaceIsFound)
{
	Random random(4201);
	const Component c = componentsOf(bumpyTorus(10, 7, random)).front();
	for (const OutputTriangulation output : {kKept, kRefined}) {
		const ComponentMap map = flattened(c, withOutput(output));
		for (const int f : {0, 51, 139})
			for (const Corner corner : cornersOf(f)) {
				FlatMesh moved = map.mesh;
				const Point2 place = moved.at(corner);
				moved.points[corner] = moved.place.size();
				moved.place.push_back({place[0], place[1] + 0.05});
				EXPECT_THROW(requireMap(moved, map.flow, false), NotConverged);
			}
		FlatMesh infinite = map.mesh;
		infinite.place[infinite.points[5][1]][0] = std::nan("");
		EXPECT_THROW(requireMap(infinite, map.flow, false), NotConverged);
	}
}

TEST(WholeMap, AFlippedFaceIsFound)
{
	Random random(4202);
	const SurfaceMesh mesh = withReversedFaces(bumpyTorus(10, 7, random), 3);
	for (const OutputTriangulation output : {kKept, kRefined}) {
		Options options = withOutput(output);
		options.finish = Finish::None;
		ComponentMap map = flattened(componentsOf(mesh).front(), options);
		requireMap(map.mesh, map.flow, false);
		std::swap(map.mesh.vertices[0][1], map.mesh.vertices[0][2]);
		std::swap(map.mesh.points[0][1], map.mesh.points[0][2]);
		const auto error = refusalOf<NotConverged>([&] { requireMap(map.mesh, map.flow, false); });
		expectWords(error.finding, {"1 faces flipped"});
	}
}

/// The triangles of a component and of the whole map, in the indices of the opened mesh.
template<class AnyOptions>
void expectAppended(const SurfaceMesh& mesh, const AnyOptions& options)
{
	OpenedMesh opened;
	Parametrization whole;
	const std::vector<Component> components = startMap(mesh, options, opened, whole);
	ASSERT_EQ(components.size(), 3u);
	for (std::size_t i = 0; i < components.size(); ++i) {
		const Component& c = components[i];
		const ComponentMap map = flattened(c, options);
		const int first = whole.mesh.size();
		append(c, asParametrization(c, map), whole);
		ASSERT_EQ(whole.mesh.size(), first + map.mesh.size());
		ASSERT_EQ(whole.charts.size(), i + 1);
		for (const int f : map.mesh.points.indices()) {
			EXPECT_EQ(whole.mesh.at(first + f), map.mesh.at(f));
			EXPECT_EQ(whole.mesh.chart[first + f], static_cast<int>(i));
			EXPECT_EQ(whole.mesh.face[first + f], c.face[Face(map.mesh.face[f])]);
			EXPECT_EQ(whole.mesh.lengths[first + f], map.mesh.lengths[f]);
			for (std::size_t k = 0; k < 3; ++k) {
				const int v = map.mesh.vertices[f][k], written = whole.mesh.vertices[first + f][k];
				if (v < c.vertex.size()) {
					EXPECT_EQ(written, c.vertex[Vertex(v)]);
				}
				else {
					EXPECT_GE(at(written), mesh.positions.size());
				}
			}
		}
	}
}

TEST(WholeMap, ComponentsAreAppended)
{
	Random random(4203);
	const SurfaceMesh flat = threeComponents(random), curved = threeHyperbolicComponents(random);
	for (const OutputTriangulation output : {kKept, kRefined}) {
		SCOPED_TRACE(static_cast<int>(output));
		HyperbolicOptions hyperbolic;
		hyperbolic.output = output;
		expectAppended(withReversedFaces(flat, 3), withOutput(output));
		expectAppended(withReversedFaces(curved, 3), hyperbolic);
	}
}

/// The refinements of several components in one: each point belongs to the face of its triangles and
/// to one chart, and all charts together are the mesh.
void expectIndicesOfSeveralComponents(const SurfaceMesh& mesh, const Parametrization& map)
{
	const FlatMesh& r = map.mesh;
	ASSERT_EQ(map.charts.size(), 3u);
	ASSERT_EQ(at(r.source.size()), mesh.positions.size() + at(map.report.refinementPoints));
	for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
		EXPECT_EQ(r.source[static_cast<int>(v)].vertex[0], static_cast<int>(v));
		EXPECT_EQ(r.source[static_cast<int>(v)].weight, (std::array<double, 4>{1, 0, 0, 0}));
	}
	std::vector<int> chartOfPoint(at(r.source.size()), -1), chartOfFace(mesh.triangles.size(), -1);
	std::vector<int> addedPoints(map.charts.size(), 0);
	for (const int i : r.points.indices()) {
		const Triangle& face = mesh.triangles[at(r.face[i])];
		int& ofFace = chartOfFace[at(r.face[i])];
		EXPECT_TRUE(ofFace == -1 || ofFace == r.chart[i]);
		ofFace = r.chart[i];
		for (const int p : r.vertices[i]) {
			int& ofPoint = chartOfPoint[at(p)];
			EXPECT_TRUE(ofPoint == -1 || ofPoint == r.chart[i]);
			addedPoints[at(r.chart[i])] += ofPoint == -1 && at(p) >= mesh.positions.size();
			ofPoint = r.chart[i];
			double sum = 0.0, ofFaces = 0.0;
			for (std::size_t x = 0; x < 4; ++x) {
				sum += r.source[p].weight[x];
				if (std::find(face.begin(), face.end(), r.source[p].vertex[x]) != face.end())
					ofFaces += r.source[p].weight[x];
			}
			EXPECT_NEAR(sum, 1.0, 1e-14);
			EXPECT_NEAR(ofFaces, 1.0, 1e-14);
		}
	}
	for (const int count : addedPoints)
		EXPECT_GT(count, 0) << "component without added points: nothing is tested";
	EXPECT_EQ(std::count(chartOfFace.begin(), chartOfFace.end(), -1), 0);
	EXPECT_EQ(std::count(chartOfPoint.begin(), chartOfPoint.end(), -1), 0);
}

TEST(WholeMap, IndicesOfTheRefinedPointsOfSeveralComponents)
{
	Random random(4204);
	const SurfaceMesh mesh = threeComponents(random);
	const FlatResult map = run(mesh, withOutput(kRefined));
	expectIndicesOfSeveralComponents(mesh, map);
	const RefinementCheck check(mesh, map.mesh, map.targetCurvature);
	check.expectValid(0 - 2 + 1, 1);
	EXPECT_LT(check.areaError, 1e-12);
	EXPECT_LT(check.angleError, 1e-6);
	// The same with faces of both orders, whose pieces have the order of their faces.
	const SurfaceMesh mixed = withReversedFaces(mesh, 3);
	const FlatResult other = run(mixed, withOutput(kRefined));
	expectIndicesOfSeveralComponents(mixed, other);
	const std::vector<Point3> places = other.mesh.onSurface(mixed.positions);
	const auto normal = [](const std::vector<Point3>& p, const Triangle& t) {
		return cross(p[at(t[1])] - p[at(t[0])], p[at(t[2])] - p[at(t[0])]);
	};
	int seen = 0, tooSmall = 0;
	for (const int i : other.mesh.points.indices()) {
		const Point3 n = normal(places, other.mesh.vertices[i]);
		const Point3 m = normal(mixed.positions, mixed.triangles[at(other.mesh.face[i])]);
		if (length(n) < 1e-9 * length(m)) {
			++tooSmall;
			continue;
		}
		++seen;
		EXPECT_GT(dot(n, m), 0.0);
	}
	EXPECT_GT(seen, 100 * tooSmall);
}

TEST(WholeMap, IndicesOfTheRefinedPointsOfSeveralHyperbolicComponents)
{
	Random random(4205);
	for (const bool mixed : {false, true}) {
		SCOPED_TRACE(mixed);
		SurfaceMesh mesh = threeHyperbolicComponents(random);
		if (mixed)
			mesh = withReversedFaces(mesh, 3);
		HyperbolicOptions options;
		options.output = kRefined;
		const FlatResult map = runInDisk(mesh, options);
		expectIndicesOfSeveralComponents(mesh, map);
		for (const Chart& chart : map.charts)
			EXPECT_FALSE(chart.group.sides.empty());
	}
}

TEST(WholeMap, TheStatesOfTheFlowNameTheirComponent)
{
	Random random(4206);
	const FlatResult map = run(threeComponents(random), withOutput(kKept));
	std::vector<int> count(3, 0);
	int last = 0;
	for (const FlowState& state : map.report.flowStates) {
		ASSERT_GE(state.component, last);
		ASSERT_LT(state.component, 3);
		++count[at(state.component)];
		last = state.component;
	}
	for (const int n : count)
		EXPECT_GT(n, 0);
}

TEST(WholeMap, NotesAreOfTheLargestComponents)
{
	const SurfaceMesh large = torus(2, 1, 9, 6);
	SurfaceMesh mesh = rectangle(1, 1, 1, 1);
	const std::size_t small = parametrizeEuclidean(mesh, {}, Options()).notes.size();
	ASSERT_GT(small, 0u);
	for (int i = 1; i < 24; ++i)
		mesh = sideBySide(mesh, rectangle(1, 1, 1, 1), 3.0 * i);
	const std::vector<std::string> whole =
		parametrizeEuclidean(sideBySide(mesh, large, 100), {}, Options()).notes;
	const std::vector<std::string> alone = parametrizeEuclidean(large, {}, Options()).notes;
	ASSERT_EQ(whole.size(), 19 * small + alone.size());
	EXPECT_EQ(whole[19 * small], alone.front());
}

TEST(WholeMap, StartsWithArraysOfTheMeshsSizes)
{
	SurfaceMesh mesh = withReversedFaces(torus(2, 1, 9, 6), 3);
	mesh.positions.push_back({9, 9, 9}); // without a face
	for (const OutputTriangulation output : {kKept, kRefined}) {
		Parametrization result;
		result.notes = {"the first one"};
		Listener listener;
		OpenedMesh opened;
		const auto components =
			heard(listener, [&] { return startMap(mesh, withOutput(output), opened, result); });
		EXPECT_EQ(components.size(), 1u);
		EXPECT_EQ(opened.mesh.triangles, mesh.triangles);
		EXPECT_EQ(result.mesh.size(), 0);
		EXPECT_EQ(result.u, std::vector<double>(mesh.positions.size(), 0.0));
		EXPECT_EQ(result.targetCurvature, std::vector<double>(mesh.positions.size(), 0.0));
		EXPECT_EQ(at(result.mesh.source.size()), mesh.positions.size());
		EXPECT_TRUE(result.charts.empty());
		ASSERT_GT(result.notes.size(), 1u);
		EXPECT_EQ(result.notes.front(), "the first one");
		EXPECT_EQ(listener.lines, result.notes);
	}
}

TEST(WholeMap, RefusesWhatTheFlowCannotTakeBeforeItStarts)
{
	SurfaceMesh mesh = rectangle(4, 4, 1, 1);
	mesh.positions[6] = mesh.positions[7];
	const auto start = [&](const FlowOptions& options) {
		OpenedMesh opened;
		Parametrization result;
		startMap(mesh, options, opened, result);
	};
	FlowOptions options;
	EXPECT_NO_THROW(start(options));
	Progress silent;
	Task task(silent);
	task.setMemoryLimit(1000.0);
	const auto tooLarge = refusalOf<TooLarge>([&] { start(options); });
	EXPECT_EQ(tooLarge.problem, TooLarge::Memory);
	EXPECT_EQ(tooLarge.count, mesh.triangles.size());
	EXPECT_EQ(tooLarge.limit, 1000.0);
	EXPECT_GT(tooLarge.needed, 1000.0);
	for (const Method method : {Method::FixedTriangles, Method::EdgeSwaps}) {
		options.method = method;
		const auto noLength = refusalOf<InvalidMesh>([&] { start(options); });
		EXPECT_EQ(noLength.problem, InvalidMesh::EdgesWithoutLength);
		EXPECT_EQ(noLength.count, 1u);
	}
}

/// The figures of the report are those of the triangles that are given back.
TEST(WholeMap, TheReportMeasuresTheOutput)
{
	Random random(4207);
	const SurfaceMesh mesh = threeComponents(random);
	for (const OutputTriangulation output : {kKept, kRefined}) {
		const FlatResult map = run(mesh, withOutput(output));
		Report report;
		const std::vector<double> expected = measureDistortion(
			map.mesh.vertices, map.mesh.onSurface(mesh.positions), map.mesh.corners(), report);
		EXPECT_NEAR(map.report.qcMean, report.qcMean, 1e-9);
		EXPECT_NEAR(map.report.areaDistortionSpread, report.areaDistortionSpread, 1e-9);
		ASSERT_EQ(map.vertexQC.size(), expected.size());
		for (std::size_t v = 0; v < expected.size(); ++v)
			EXPECT_NEAR(map.vertexQC[v], expected[v], 1e-9);
	}
}

TEST(WholeMap, RectanglesStayUprightAndQuarterTurnsStaySo)
{
	Options options;
	EXPECT_EQ(chartTurns(options), ChartTurns::Free);
	options.cones.rounding = ConeRounding::QuarterTurns;
	EXPECT_EQ(chartTurns(options), ChartTurns::Quarter);
	options.target = TargetCurvature::Rectangle;
	EXPECT_EQ(chartTurns(options), ChartTurns::None);
}

TEST(WholeMap, ReportsOfComponentsAddUp)
{
	Report first, second, sum;
	first.components = second.components = 1;
	first.iterations = 3;
	second.iterations = 4;
	first.residualFloor = 2.0;
	second.residualFloor = 1.0;
	first.seamLength = 0.5;
	second.seamLength = 0.25;
	second.relationError = 3.0;
	first.hyperbolicArea = 4.0;
	second.hyperbolicArea = 5.0;
	first.annulusModulus = 7.0;
	first.targetUsed = TargetUsed::Flat;
	second.targetUsed = TargetUsed::PlacedCones;
	first.choice = "no cones";
	second.choice = "cones";
	second.expectedSpread = 0.5;
	first.boundaryRatioMin = 0.9;
	first.boundaryRatioMax = 1.1;
	second.boundaryRatioMin = 0.8;
	second.boundaryRatioMax = 1.05;
	second.flowStates = {{0, 1, 0.1}};
	sum += first;
	EXPECT_EQ(sum.annulusModulus, 7.0);
	EXPECT_FALSE(sum.relationError);
	EXPECT_EQ(sum.targetUsed, TargetUsed::Flat);
	EXPECT_EQ(sum.choice, "no cones");
	sum += second;
	EXPECT_EQ(sum.targetUsed, TargetUsed::Several);
	EXPECT_EQ(sum.choice, "");
	EXPECT_EQ(sum.expectedSpread, 0.5);
	EXPECT_EQ(sum.boundaryRatioMin, 0.8);
	EXPECT_EQ(sum.boundaryRatioMax, 1.1);
	EXPECT_EQ(sum.components, 2);
	EXPECT_EQ(sum.iterations, 7);
	EXPECT_EQ(sum.residualFloor, 2.0);
	EXPECT_EQ(sum.seamLength, 0.75);
	EXPECT_EQ(sum.relationError, 3.0);
	EXPECT_EQ(sum.hyperbolicArea, 9.0);
	EXPECT_FALSE(sum.annulusModulus) << "of a component alone";
	ASSERT_EQ(sum.flowStates.size(), 1u);
	EXPECT_EQ(sum.flowStates[0].component, 1);
}

/// Two components, of which the second one's faces begin with number 8.
SurfaceMesh twoComponents()
{
	return sideBySide(rectangle(2, 2, 1, 1), tetrahedron(), 10);
}

/// Calls \p run for each component of \p mesh, whose map is empty.
void runComponents(const SurfaceMesh& mesh, const std::function<void(const Component&)>& run)
{
	Parametrization whole;
	whole.u.resize(mesh.positions.size());
	whole.targetCurvature.resize(mesh.positions.size());
	appendComponents(
		opened(mesh),
		componentsOf(mesh),
		[&](const Component& c) {
			run(c);
			Parametrization part;
			part.u.resize(c.vertex.values().size());
			part.targetCurvature.resize(c.vertex.values().size());
			return part;
		},
		whole);
}

/// The error \p thrown where the component with face 8 is run.
template<class E>
E thrownInTheSecond(const SurfaceMesh& mesh, const E& thrown)
{
	return refusalOf<E>([&] {
		runComponents(mesh, [&](const Component& c) {
			if (c.face.front() == 8)
				throw thrown;
		});
	});
}

/// \p thrown keeps its type and words and gets the component's data.
template<class E>
void expectNamed(const E& thrown)
{
	const auto error = thrownInTheSecond(twoComponents(), thrown);
	EXPECT_EQ(error.componentFace, 8);
	EXPECT_EQ(error.componentFaces, 4u);
	EXPECT_STREQ(error.what(), thrown.what());
}

TEST(WholeMap, AnErrorKeepsItsTypeAndGetsItsComponent)
{
	expectNamed(InvalidMesh(InvalidMesh::NotPuncturable));
	expectNamed(InvalidOption(InvalidOption::NothingSelected));
	expectNamed(InadmissibleCurvature(InadmissibleCurvature::GaussBonnet, 1.0, 2.0));
	expectNamed(NotConverged(7, 1e-3, 1e-8, 1e-13));
	expectNamed(SolverFailed(SolverFailed::Flow));
	expectNamed(TooLarge(TooLarge::Crossings, 10, 0.0, 5.0));
	expectNamed(InternalError("a reason"));
	// The data of the problem stay as they are.
	const auto error = thrownInTheSecond(twoComponents(), NotConverged(7, 1e-3, 1e-8, 1e-13));
	EXPECT_EQ(error.problem, NotConverged::StepsUsedUp);
	EXPECT_EQ(error.iterations, 7);
	EXPECT_EQ(error.residual, 1e-3);
}

TEST(WholeMap, AnErrorOfTheOnlyComponentHasNoComponent)
{
	const SurfaceMesh mesh = tetrahedron();
	const auto error = refusalOf<InvalidOption>([&] {
		runComponents(
			mesh, [](const Component&) { throw InvalidOption(InvalidOption::NothingSelected); });
	});
	EXPECT_EQ(error.componentFace, -1);
	EXPECT_EQ(error.componentFaces, 0u);
}

/// It is not the component's fault that the user or the time limit ends the run.
TEST(WholeMap, StoppingNamesNoComponent)
{
	const auto cancelled = thrownInTheSecond(twoComponents(), Cancelled());
	EXPECT_EQ(cancelled.componentFace, -1);
	EXPECT_EQ(cancelled.componentFaces, 0u);
	const auto late = thrownInTheSecond(twoComponents(), TimeOut(12.0, 0.5, 10.0));
	EXPECT_EQ(late.componentFace, -1);
	EXPECT_EQ(late.componentFaces, 0u);
	EXPECT_EQ(late.elapsed, 12.0);
}

TEST(WholeMap, OtherExceptionsPassThrough)
{
	const SurfaceMesh mesh = twoComponents();
	EXPECT_THROW(
		runComponents(mesh, [](const Component&) { throw std::runtime_error("full disk"); }),
		std::runtime_error);
}

/// So many components that threads share them: each logs its first face, those from \p failing on fail.
void logComponents(int failing)
{
	constexpr int kComponents = 40;
	SurfaceMesh mesh = rectangle(6, 6, 1, 1);
	for (int i = 1; i < kComponents; ++i)
		mesh = sideBySide(mesh, rectangle(6, 6, 1, 1), i);
	runComponents(mesh, [&](const Component& c) {
		logLine(std::to_string(c.face.front()));
		if (c.face.front() >= failing)
			throw InternalError("no map");
	});
}

TEST(WholeMap, ComponentsInThreadsLogInTheirOrder)
{
	for (int round = 0; round < 50; ++round) {
		Listener listener;
		const Task task(listener);
		logComponents(std::numeric_limits<int>::max());
		ASSERT_EQ(listener.lines.size(), 21u); // and that the smaller ones are left out
		for (std::size_t i = 0; i < 20; ++i)
			EXPECT_EQ(listener.lines[i], std::to_string(72 * i));
	}
}

TEST(WholeMap, OfErrorsInThreadsTheFirstComponentsIsThrown)
{
	for (int round = 0; round < 50; ++round) {
		Listener listener;
		const Task task(listener);
		const auto error = refusalOf<InternalError>([&] { logComponents(72 * 5); });
		EXPECT_EQ(error.componentFace, 72 * 5);
		EXPECT_EQ(listener.lines.size(), 6u);
	}
}

TEST(WholeMap, ComponentsShareTheProgressByTheirFaces)
{
	const SurfaceMesh mesh = twoComponents(); // 8 and 4 faces
	Listener listener;
	const Task task(listener);
	runComponents(mesh, [](const Component&) {
		advance(0.0, "begin");
		advance(0.5, "middle");
		advance(0.25, "again");
		advance(1.0, "end");
	});
	const double first = kComponentsDone * 8 / 12, all = kComponentsDone;
	const double middle = 0.5 * (first + all);
	// With a checkpoint before all of them and one before each.
	const std::vector<double> expected{
		0.0, 0.0, 0.0, 0.5 * first, 0.5 * first, first, first, first, middle, middle, all};
	ASSERT_EQ(listener.fractions.size(), expected.size());
	for (std::size_t i = 0; i < expected.size(); ++i)
		EXPECT_NEAR(listener.fractions[i], expected[i], 1e-15);
}

} // namespace
} // namespace ricci::testing
