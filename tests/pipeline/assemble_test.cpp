// SPDX-License-Identifier: GPL-3.0-or-later
// From the maps of components to the map of the mesh: what is checked is what is written, all
// numbers are those of the input, and errors say where they come from.
#include "../support/expect.h"
#include "../support/flat_map.h"
#include "../support/listener.h"
#include "../support/random_surface.h"
#include "../support/refinement_check.h"
#include "../support/shapes.h"
#include "../support/transform.h"

#include <ricci/error.h>
#include <ricci/measure/distortion.h>
#include <ricci/parametrize.h>
#include <ricci/pipeline/assemble.h>
#include <ricci/verify/result_check.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
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

template<class AnyOptions>
ComponentMap flattened(const Component& component, const AnyOptions& options)
{
	return flattenComponent(component, {}, options);
}

OpenedMesh opened(const SurfaceMesh& mesh)
{
	std::vector<std::string> notes;
	return openMesh(mesh, notes);
}

std::vector<Component> componentsOf(const SurfaceMesh& mesh)
{
	return splitIntoComponents(opened(mesh));
}

SurfaceMesh everyThirdFaceReversed(SurfaceMesh mesh)
{
	for (std::size_t f = 0; f < mesh.triangles.size(); f += 3)
		std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
	return mesh;
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

/// A corner of \p plane at which a seam begins: its neighbour across the seam lies elsewhere.
/// \p triangles as in OutputTriangles
std::pair<std::size_t, std::size_t>
cornerAtASeam(const std::vector<Triangle>& triangles, const std::vector<Triangle2>& plane)
{
	const int count = [&] {
		int largest = 0;
		for (const Triangle& t : triangles)
			largest = std::max({largest, t[0], t[1], t[2]});
		return largest + 1;
	}();
	const Triangulation t(count, triangles);
	for (const Halfedge h : t.interiorHalfedges()) {
		if (t.isBoundary(h.edge()))
			continue;
		const auto placeOf = [&](Halfedge g) {
			const auto sides = t.halfedges(t.face(g));
			const auto k =
				static_cast<std::size_t>(std::find(sides.begin(), sides.end(), g) - sides.begin());
			return std::pair<std::size_t, std::size_t>{at(t.face(g)), k};
		};
		const auto own = placeOf(h), other = placeOf(t.next(h.twin()));
		if (plane[own.first][own.second] != plane[other.first][other.second])
			return own;
	}
	ADD_FAILURE() << "there is no seam";
	return {0, 0};
}

/// The shape is taken apart by a hundredth of its extent.
template<class Triangles>
void tear(Triangles& uv, const std::vector<Triangle>& triangles)
{
	std::vector<Triangle2> plane(uv.begin(), uv.end());
	const auto [f, k] = cornerAtASeam(triangles, plane);
	double extent = 0.0;
	for (const Triangle2& p : plane)
		for (const Point2& q : p)
			extent = std::max(extent, distance(q, plane[0][0]));
	(*(uv.begin() + static_cast<std::ptrdiff_t>(f)))[k][0] += 0.01 * extent;
}

void requireMapOf(const Component& c, const ComponentMap& map, OutputTriangulation output)
{
	requireMap(outputTriangles(c, map, output), map.flow, false);
}

void requireDiskOf(const Component& c, const ComponentMap& map, OutputTriangulation output)
{
	requireDisk(outputTriangles(c, map, output), map.layout, map.flow, false);
}

/// A tear of what is written is found; one of what is not written is not looked at.
template<class AnyOptions, class Require>
void expectTearsFound(const Component& c, const AnyOptions& options, const Require& require)
{
	const ComponentMap map = flattened(c, options);
	ASSERT_GT(map.refinement.crossings, 0u);
	require(c, map, kKept);
	require(c, map, kRefined);

	ComponentMap kept = map;
	tear(kept.uv, c.triangles);
	const auto keptError = errorOf<NotConverged>([&] { require(c, kept, kKept); });
	ASSERT_TRUE(keptError);
	EXPECT_EQ(keptError->problem, NotConverged::CheckFailed);
	expectWords(keptError->finding, {"seams"});
	EXPECT_NO_THROW(require(c, kept, kRefined));

	ComponentMap refined = map;
	tear(refined.refinement.uv, map.refinement.triangles);
	const auto refinedError = errorOf<NotConverged>([&] { require(c, refined, kRefined); });
	ASSERT_TRUE(refinedError);
	EXPECT_EQ(refinedError->problem, NotConverged::CheckFailed);
	expectWords(refinedError->finding, {"seams"});
	EXPECT_NO_THROW(require(c, refined, kKept));
}

TEST(Assemble, ATornSeamOfTheOutputIsFound)
{
	Random random(4200);
	const SurfaceMesh donut = bumpyTorus(10, 7, random);
	const SurfaceMesh closed = shaken(perforatedSlab(2, 2), 0.05, random);
	for (const bool mixed : {false, true}) {
		SCOPED_TRACE(mixed);
		expectTearsFound(
			componentsOf(mixed ? everyThirdFaceReversed(donut) : donut).front(),
			withOutput(kRefined),
			requireMapOf);
		HyperbolicOptions options;
		options.output = kRefined;
		expectTearsFound(
			componentsOf(mixed ? everyThirdFaceReversed(closed) : closed).front(),
			options,
			requireDiskOf);
	}
}

/// A corner away from the seams that leaves its place makes a tear of two sides that were one.
TEST(Assemble, ACornerOfTheOutputThatLeavesItsPlaceIsFound)
{
	Random random(4201);
	const Component c = componentsOf(bumpyTorus(10, 7, random)).front();
	const ComponentMap map = flattened(c, withOutput(kRefined));
	for (const Face f : {Face(0), Face(51), Face(139)})
		for (std::size_t k = 0; k < 3; ++k) {
			ComponentMap moved = map;
			moved.uv[f][k][1] += 0.05;
			EXPECT_THROW(requireMapOf(c, moved, kKept), NotConverged);
			moved = map;
			moved.refinement.uv[2 * at(f)][k][1] += 0.05;
			EXPECT_THROW(requireMapOf(c, moved, kRefined), NotConverged);
		}
	ComponentMap infinite = map;
	infinite.uv[Face(5)][1][0] = std::nan("");
	EXPECT_THROW(requireMapOf(c, infinite, kKept), NotConverged);
}

/// A face of the input whose order of corners was turned must be turned in the output, too.
TEST(Assemble, AFaceOfTheOutputThatIsTurnedRoundIsFound)
{
	Random random(4202);
	const SurfaceMesh mesh = everyThirdFaceReversed(bumpyTorus(10, 7, random));
	const Component c = componentsOf(mesh).front();
	const ComponentMap map = flattened(c, withOutput(kRefined));
	for (const OutputTriangulation output : {kKept, kRefined}) {
		OutputTriangles out = outputTriangles(c, map, output);
		requireMap(out, map.flow, false);
		EXPECT_GT(std::count(out.reversed.begin(), out.reversed.end(), 1), 40);
		out.reversed[0] = !out.reversed[0];
		const auto error = errorOf<NotConverged>([&] { requireMap(out, map.flow, false); });
		ASSERT_TRUE(error);
		expectWords(error->finding, {"1 faces turned round"});
	}
}

/// What outputTriangles() shows to the check is what append() writes.
template<class AnyOptions>
void expectTheOutputIsWritten(const SurfaceMesh& mesh, const AnyOptions& options)
{
	Parametrization result;
	const std::vector<Component> components =
		startResult(mesh, options, options.output, result);
	ASSERT_EQ(components.size(), 3u);
	for (const Component& c : components) {
		const ComponentMap map = flattened(c, options);
		append(c, map, options.output, result);
		const OutputTriangles out = outputTriangles(c, map, options.output);
		const Chart& chart = result.charts.back();
		const bool refined = options.output == kRefined;
		const std::vector<int>& numbers = refined ? chart.refined : chart.faces;
		ASSERT_EQ(out.triangles.size(), numbers.size());
		ASSERT_EQ(out.plane.size(), numbers.size());
		ASSERT_EQ(out.reversed.size(), numbers.size());
		for (std::size_t i = 0; i < numbers.size(); ++i) {
			const std::size_t f = at(numbers[i]);
			const std::size_t input = refined ? at(result.refined.inputFace[f]) : f;
			EXPECT_EQ(out.plane[i], refined ? result.refined.uv[f] : result.uv[f]);
			EXPECT_EQ(out.reversed[i], result.reversed[input]);
			const Triangle& written = refined ? result.refined.triangles[f] : mesh.triangles[f];
			for (std::size_t k = 0; k < 3; ++k) {
				const int v = out.triangles[i][k];
				if (v < c.vertex.size()) {
					EXPECT_EQ(written[k], c.vertex[Vertex(v)]);
				}
				else {
					EXPECT_GE(at(written[k]), mesh.positions.size());
				}
			}
		}
	}
}

TEST(Assemble, TheOutputThatIsCheckedIsWritten)
{
	Random random(4203);
	const SurfaceMesh flat = threeComponents(random), curved = threeHyperbolicComponents(random);
	for (const OutputTriangulation output : {kKept, kRefined}) {
		SCOPED_TRACE(static_cast<int>(output));
		HyperbolicOptions hyperbolic;
		hyperbolic.output = output;
		expectTheOutputIsWritten(everyThirdFaceReversed(flat), withOutput(output));
		expectTheOutputIsWritten(everyThirdFaceReversed(curved), hyperbolic);
	}
}

/// The refinements of several components in one: each point belongs to the face of its triangles and
/// to one chart, and all charts together are the mesh.
void expectNumbersOfSeveralComponents(const SurfaceMesh& mesh, const Parametrization& map)
{
	const RefinedMesh& r = map.refined;
	ASSERT_EQ(map.charts.size(), 3u);
	ASSERT_EQ(r.points.size(), mesh.positions.size() + at(map.report.refinementPoints));
	ASSERT_EQ(r.uv.size(), r.triangles.size());
	ASSERT_EQ(r.inputFace.size(), r.triangles.size());
	for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
		EXPECT_EQ(r.points[v].vertex[0], static_cast<int>(v));
		EXPECT_EQ(r.points[v].weight, (std::array<double, 4>{1, 0, 0, 0}));
	}
	std::vector<int> chartOfPoint(r.points.size(), -1), chartOfTriangle(r.triangles.size(), -1);
	std::vector<int> addedPoints(map.charts.size(), 0);
	for (std::size_t c = 0; c < map.charts.size(); ++c) {
		const Chart& chart = map.charts[c];
		const std::set<int> faces(chart.faces.begin(), chart.faces.end());
		std::set<int> covered, vertices;
		for (const int f : chart.faces)
			vertices.insert(mesh.triangles[at(f)].begin(), mesh.triangles[at(f)].end());
		for (const int i : chart.refined) {
			EXPECT_EQ(chartOfTriangle[at(i)], -1);
			chartOfTriangle[at(i)] = static_cast<int>(c);
			EXPECT_EQ(faces.count(r.inputFace[at(i)]), 1u);
			covered.insert(r.inputFace[at(i)]);
			for (const int p : r.triangles[at(i)]) {
				int& chartOf = chartOfPoint[at(p)];
				EXPECT_TRUE(chartOf == -1 || chartOf == static_cast<int>(c));
				addedPoints[c] += chartOf == -1 && at(p) >= mesh.positions.size();
				chartOf = static_cast<int>(c);
				const SurfacePoint& point = r.points[at(p)];
				double sum = 0.0;
				for (std::size_t x = 0; x < 4; ++x) {
					sum += point.weight[x];
					if (point.weight[x] != 0.0) {
						EXPECT_EQ(vertices.count(point.vertex[x]), 1u);
					}
				}
				EXPECT_NEAR(sum, 1.0, 1e-14);
			}
		}
		EXPECT_EQ(covered, faces);
		EXPECT_GT(addedPoints[c], 0) << "component without added points: nothing is tested";
	}
	EXPECT_EQ(std::count(chartOfTriangle.begin(), chartOfTriangle.end(), -1), 0);
	EXPECT_EQ(std::count(chartOfPoint.begin(), chartOfPoint.end(), -1), 0);
}

TEST(Assemble, NumbersOfTheRefinedPointsOfSeveralComponents)
{
	Random random(4204);
	const SurfaceMesh mesh = threeComponents(random);
	const Parametrization map = run(mesh, withOutput(kRefined));
	expectNumbersOfSeveralComponents(mesh, map);
	const RefinedMesh& r = map.refined;
	const RefinementCheck check(
		mesh, {r.points, r.triangles, r.inputFace, r.uv}, map.targetCurvature);
	EXPECT_LT(check.areaError, 1e-12);
	EXPECT_GE(check.minWeight, -1e-12);
	EXPECT_LT(check.weightError, 1e-14);
	EXPECT_EQ(check.notPositive, 0);
	EXPECT_LT(check.seamMismatch, 1e-9);
	EXPECT_EQ(check.seamsInside, 0);
	EXPECT_LT(check.angleError, 1e-6);
	EXPECT_EQ(check.eulerCharacteristic, 0 - 2 + 1);
	EXPECT_EQ(check.boundaryLoops, 1);
	// The same with faces of both orders, whose pieces have the order of their faces.
	const SurfaceMesh mixed = everyThirdFaceReversed(mesh);
	const Parametrization other = run(mixed, withOutput(kRefined));
	expectNumbersOfSeveralComponents(mixed, other);
	std::vector<Point3> places;
	for (const SurfacePoint& p : other.refined.points)
		places.push_back(placeOnSurface(p, mixed.positions));
	const auto normal = [](const Point3& a, const Point3& b, const Point3& c) {
		Point3 p, q;
		for (std::size_t k = 0; k < 3; ++k) {
			p[k] = b[k] - a[k];
			q[k] = c[k] - a[k];
		}
		return Point3{
			p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
	};
	int seen = 0, tooSmall = 0;
	for (std::size_t i = 0; i < other.refined.triangles.size(); ++i) {
		const Triangle &piece = other.refined.triangles[i],
					   &face = mixed.triangles[at(other.refined.inputFace[i])];
		const Point3 n = normal(places[at(piece[0])], places[at(piece[1])], places[at(piece[2])]);
		const Point3 m = normal(
			mixed.positions[at(face[0])],
			mixed.positions[at(face[1])],
			mixed.positions[at(face[2])]);
		const double cosine = n[0] * m[0] + n[1] * m[1] + n[2] * m[2];
		if (std::hypot(n[0], n[1], n[2]) < 1e-9 * std::hypot(m[0], m[1], m[2])) {
			++tooSmall;
			continue;
		}
		++seen;
		EXPECT_GT(cosine, 0.0);
	}
	EXPECT_GT(seen, 100 * tooSmall);
}

TEST(Assemble, NumbersOfTheRefinedPointsOfSeveralHyperbolicComponents)
{
	Random random(4205);
	for (const bool mixed : {false, true}) {
		SCOPED_TRACE(mixed);
		SurfaceMesh mesh = threeHyperbolicComponents(random);
		if (mixed)
			mesh = everyThirdFaceReversed(mesh);
		HyperbolicOptions options;
		options.output = kRefined;
		const Parametrization map = parametrizeHyperbolic(mesh, {}, options);
		expectNumbersOfSeveralComponents(mesh, map);
		for (const Chart& chart : map.charts)
			EXPECT_FALSE(chart.group.sides.empty());
	}
}

TEST(Assemble, TheStatesOfTheFlowNameTheirComponent)
{
	Random random(4206);
	const Parametrization map = run(threeComponents(random), withOutput(kKept));
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

TEST(Assemble, StartsWithArraysOfTheMeshsSizes)
{
	SurfaceMesh mesh = everyThirdFaceReversed(torus(2, 1, 9, 6));
	mesh.positions.push_back({9, 9, 9}); // without a face
	for (const OutputTriangulation output : {kKept, kRefined}) {
		Parametrization result;
		result.notes = {"the first one"};
		Listener listener;
		const auto components = heard(listener, [&] { return startResult(mesh, Options(), output, result); });
		EXPECT_EQ(components.size(), 1u);
		EXPECT_EQ(result.report.components, 1);
		EXPECT_EQ(result.uv.size(), mesh.triangles.size());
		EXPECT_EQ(result.reversed, std::vector<char>(mesh.triangles.size(), 0));
		EXPECT_EQ(result.u, std::vector<double>(mesh.positions.size(), 0.0));
		EXPECT_EQ(result.targetCurvature, std::vector<double>(mesh.positions.size(), 0.0));
		EXPECT_EQ(result.refined.points.size(), output == kRefined ? mesh.positions.size() : 0u);
		EXPECT_TRUE(result.charts.empty());
		ASSERT_GT(result.notes.size(), 1u);
		EXPECT_EQ(result.notes.front(), "the first one");
		EXPECT_EQ(listener.lines, result.notes);
	}
}

TEST(Assemble, RefusesWhatTheFlowCannotTakeBeforeItStarts)
{
	SurfaceMesh mesh = rectangle(4, 4, 1, 1);
	mesh.positions[6] = mesh.positions[7];
	const auto start = [&](const FlowOptions& options) {
		Parametrization result;
		startResult(mesh, options, kKept, result);
	};
	FlowOptions options;
	EXPECT_NO_THROW(start(options));
	Progress silent;
	Task task(silent);
	task.setMemoryLimit(1000.0);
	const auto tooLarge = errorOf<TooLarge>([&] { start(options); });
	ASSERT_TRUE(tooLarge);
	EXPECT_EQ(tooLarge->problem, TooLarge::Memory);
	EXPECT_EQ(tooLarge->count, mesh.triangles.size());
	EXPECT_EQ(tooLarge->limit, 1000.0);
	EXPECT_GT(tooLarge->needed, 1000.0);
	for (const Method method : {Method::FixedTriangles, Method::EdgeSwaps}) {
		options.method = method;
		const auto noLength = errorOf<InvalidMesh>([&] { start(options); });
		ASSERT_TRUE(noLength);
		EXPECT_EQ(noLength->problem, InvalidMesh::EdgesWithoutLength);
		EXPECT_EQ(noLength->count, 1u);
	}
}

/// The figures of the report are those of the faces that are given back.
TEST(Assemble, TheReportMeasuresTheOutput)
{
	Random random(4207);
	const SurfaceMesh mesh = threeComponents(random);
	Options asFound = withOutput(kKept); // as the refinement has the mesh's faces
	asFound.finish = Finish::None;
	const Parametrization kept = run(mesh, asFound), refined = run(mesh, withOutput(kRefined));
	const auto meanOf = [](const std::vector<double>& values) {
		double sum = 0.0;
		for (const double x : values)
			sum += x;
		return sum / static_cast<double>(values.size());
	};
	const auto expectNear = [](const std::vector<double>& a, const std::vector<double>& b) {
		ASSERT_EQ(a.size(), b.size());
		for (std::size_t i = 0; i < a.size(); ++i)
			EXPECT_NEAR(a[i], b[i], 1e-10); // laid out in another order
	};
	expectNear(kept.faceQC, refined.faceQC);
	expectNear(kept.vertexQC, refined.vertexQC);
	EXPECT_NEAR(kept.report.qcMean, meanOf(kept.faceQC), 1e-12);
	EXPECT_TRUE(kept.refined.faceQC.empty());
	ASSERT_EQ(refined.refined.faceQC.size(), refined.refined.triangles.size());
	ASSERT_EQ(refined.refined.vertexQC.size(), refined.refined.points.size());
	EXPECT_NEAR(refined.report.qcMean, meanOf(refined.refined.faceQC), 1e-12);
	EXPECT_NE(refined.report.qcMean, kept.report.qcMean);
}

/// Two components, of which the second one's faces begin with number 8.
SurfaceMesh twoComponents()
{
	return sideBySide(rectangle(2, 2, 1, 1), tetrahedron(), 10);
}

/// The error \p thrown where the component with face 8 is run.
template<class E>
std::optional<E> thrownInTheSecond(const SurfaceMesh& mesh, const E& thrown)
{
	return errorOf<E>([&] {
		runComponents(
			opened(mesh), componentsOf(mesh), [&](const Component& c) {
				if (c.face.front() == 8)
					throw thrown;
			});
	});
}

/// \p thrown keeps its type and words and gets the component's data.
template<class E>
void expectNamed(const E& thrown)
{
	const std::optional<E> error = thrownInTheSecond(twoComponents(), thrown);
	ASSERT_TRUE(error);
	EXPECT_EQ(error->componentFace, 8);
	EXPECT_EQ(error->componentFaces, 4u);
	EXPECT_STREQ(error->what(), thrown.what());
}

TEST(Assemble, AnErrorKeepsItsTypeAndGetsItsComponent)
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
	ASSERT_TRUE(error);
	EXPECT_EQ(error->problem, NotConverged::StepsUsedUp);
	EXPECT_EQ(error->iterations, 7);
	EXPECT_EQ(error->residual, 1e-3);
}

TEST(Assemble, AnErrorOfTheOnlyComponentHasNoComponent)
{
	const SurfaceMesh mesh = tetrahedron();
	const auto error = errorOf<InvalidOption>([&] {
		runComponents(
			opened(mesh), componentsOf(mesh), [](const Component&) {
				throw InvalidOption(InvalidOption::NothingSelected);
			});
	});
	ASSERT_TRUE(error);
	EXPECT_EQ(error->componentFace, -1);
	EXPECT_EQ(error->componentFaces, 0u);
}

/// It is not the component's fault that the user or the time limit ends the run.
TEST(Assemble, StoppingNamesNoComponent)
{
	const auto cancelled = thrownInTheSecond(twoComponents(), Cancelled());
	ASSERT_TRUE(cancelled);
	EXPECT_EQ(cancelled->componentFace, -1);
	EXPECT_EQ(cancelled->componentFaces, 0u);
	const auto late = thrownInTheSecond(twoComponents(), TimeOut(12.0, 0.5, 10.0));
	ASSERT_TRUE(late);
	EXPECT_EQ(late->componentFace, -1);
	EXPECT_EQ(late->componentFaces, 0u);
	EXPECT_EQ(late->elapsed, 12.0);
}

TEST(Assemble, OtherExceptionsPassThrough)
{
	const SurfaceMesh mesh = twoComponents();
	EXPECT_THROW(
		runComponents(
			opened(mesh),
			componentsOf(mesh),
			[](const Component&) { throw std::runtime_error("full disk"); }),
		std::runtime_error);
}

TEST(Assemble, ComponentsShareTheProgressByTheirFaces)
{
	const SurfaceMesh mesh = twoComponents(); // 8 and 4 faces
	Listener listener;
	const Task task(listener);
	runComponents(opened(mesh), componentsOf(mesh), [](const Component&) {
		advance(0.0, "begin");
		advance(0.5, "middle");
		advance(0.25, "again");
		advance(1.0, "end");
	});
	const double first = kComponentsDone * 8 / 12, all = kComponentsDone;
	const std::vector<double> expected{
		0.0, 0.5 * first, 0.5 * first, first, first, 0.5 * (first + all), 0.5 * (first + all), all};
	ASSERT_EQ(listener.fractions.size(), expected.size());
	for (std::size_t i = 0; i < expected.size(); ++i)
		EXPECT_NEAR(listener.fractions[i], expected[i], 1e-15);
}

} // namespace
} // namespace ricci::testing
