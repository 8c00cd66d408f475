// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of several components: their numbers in one map, their reports in one, and their threads.
#include "support/expect.h"
#include "support/flat_map.h"
#include "support/listener.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <array>
#include <complex>
#include <map>

namespace ricci::testing {
namespace {

Options refined()
{
	Options options;
	options.output = OutputTriangulation::CommonRefinement;
	options.charts = Charts::OfTheFlow;
	return options;
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

TEST(Components, IndicesOfTheRefinedPointsOfSeveralComponents)
{
	Random random(4204);
	const SurfaceMesh mesh = threeComponents(random);
	const FlatResult map = run(mesh, refined());
	expectIndicesOfSeveralComponents(mesh, map);
	const MapCheck check(mesh, map);
	expectSurface(check, 0 - 2 + 1, 1);
	EXPECT_LT(check.areaError, 1e-12);
	EXPECT_LT(check.angleError, 1e-6);
	// The same with faces of both orders, whose pieces have the order of their faces.
	const SurfaceMesh mixed = withReversedFaces(mesh, 3);
	const FlatResult other = run(mixed, refined());
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

TEST(Components, IndicesOfTheRefinedPointsOfSeveralHyperbolicComponents)
{
	Random random(4205);
	for (const bool mixed : {false, true}) {
		SCOPED_TRACE(mixed);
		SurfaceMesh mesh = threeHyperbolicComponents(random);
		if (mixed)
			mesh = withReversedFaces(mesh, 3);
		HyperbolicOptions options;
		options.output = OutputTriangulation::CommonRefinement;
		const FlatResult map = runInDisk(mesh, options);
		expectIndicesOfSeveralComponents(mesh, map);
		for (const Chart& chart : map.charts)
			EXPECT_FALSE(chart.group.sides.empty());
	}
}

/// invariance_test.cpp compares the other numbers of two components with those of each alone.
TEST(Components, ReportsOfComponentsAddUp)
{
	Report first, second, sum;
	first.components = second.components = 1;
	first.annulusModulus = 7.0;
	first.boundaryRatioMin = 0.9;
	first.boundaryRatioMax = 1.1;
	second.boundaryRatioMin = 0.8;
	second.boundaryRatioMax = 1.05;
	second.relationError = 3.0;
	second.expectedSpread = 0.5;
	second.flowStates = {{0, 1, 0.1}};
	sum += first;
	EXPECT_EQ(sum.annulusModulus, 7.0);
	EXPECT_FALSE(sum.relationError);
	sum += second;
	EXPECT_FALSE(sum.annulusModulus) << "of a component alone";
	EXPECT_EQ(sum.relationError, 3.0);
	EXPECT_EQ(sum.expectedSpread, 0.5);
	EXPECT_EQ(sum.boundaryRatioMin, 0.8);
	EXPECT_EQ(sum.boundaryRatioMax, 1.1);
	ASSERT_EQ(sum.flowStates.size(), 1u);
	EXPECT_EQ(sum.flowStates[0].component, 1);
}

/// Sheets of rising size, of which those from \p bad on are rings.
SurfaceMesh sheets(int count, int bad)
{
	SurfaceMesh mesh;
	for (int i = 0; i < count; ++i)
		mesh =
			sideBySide(mesh, i < bad ? rectangle(6, 6 + i, 1, 1) : ring(1, 2, 9 + i, 4), 9.0 * i);
	return mesh;
}

TEST(Components, LogInTheirOrderWhicheverThreadTheyAreIn)
{
	constexpr int kCount = 20; // of 2700 faces: enough for threads
	const SurfaceMesh mesh = sheets(kCount, kCount);
	for (int round = 0; round < 8; ++round) {
		Listener listener;
		withListener(listener, [&] { return parametrizeEuclidean(mesh, {}, {}); });
		int next = 0;
		for (const std::string& line : listener.lines)
			if (line.rfind("Component of ", 0) == 0) {
				expectWords(line, {", " + std::to_string(12 * (6 + next)) + " faces"});
				++next;
			}
		EXPECT_EQ(next, kCount);
	}
}

TEST(Components, OfTheErrorsInThreadsThatOfTheFirstIsThrown)
{
	constexpr int kBad = 5;
	const SurfaceMesh mesh = sheets(20, kBad);
	Options options;
	options.target = TargetCurvature::Disk;
	for (int round = 0; round < 20; ++round) {
		Listener listener;
		const auto error = refusalOf<InvalidOption>([&] {
			withListener(listener, [&] { return parametrizeEuclidean(mesh, {}, options); });
		});
		EXPECT_EQ(error.problem, InvalidOption::NotADisk);
		EXPECT_EQ(error.componentFace, 12 * (6 + 7 + 8 + 9 + 10));
		EXPECT_EQ(error.componentFaces, 8u * (9 + kBad));
		EXPECT_EQ(listener.count("Component of "), kBad + 1);
	}
}

TEST(Components, ShareTheProgressByTheirFaces)
{
	const SurfaceMesh mesh = sheets(3, 3); // of 72, 84 and 96 faces
	struct Progresses : Progress
	{
		bool update(double fraction, const std::string&) override
		{
			now = fraction;
			return true;
		}
		void log(const std::string& line) override
		{
			if (line.rfind("Component of ", 0) == 0)
				begins.push_back(now);
		}
		double now = 0.0;
		std::vector<double> begins;
	} progress;
	withListener(progress, [&] { return parametrizeEuclidean(mesh, {}, {}); });
	ASSERT_EQ(progress.begins.size(), 3u);
	EXPECT_EQ(progress.begins[0], 0.0);
	EXPECT_NEAR(progress.begins[1] / progress.begins[2], 72.0 / (72.0 + 84.0), 1e-12);
	EXPECT_GT(progress.begins[2], 0.5);
}

/// Sides of the map of the first faces and of those behind them, as numbers of the plane.
std::array<std::vector<std::complex<double>>, 2> sidesOfHalves(const FlatResult& map)
{
	std::array<std::vector<std::complex<double>>, 2> sides;
	for (std::size_t f = 0; f < map.uv.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k) {
			const Point2 side = map.uv[f][(k + 1) % 3] - map.uv[f][k];
			sides[f < map.uv.size() / 2 ? 0 : 1].emplace_back(side[0], side[1]);
		}
	return sides;
}

/// turnOf(side) of the first half is one turn in each of its \p charts.
template<class TurnOf>
void expectOneTurnEach(const FlatResult& map, int charts, const TurnOf& turnOf)
{
	std::map<int, std::complex<double>> turns; // of charts
	for (std::size_t i = 0; i < 3 * (map.uv.size() / 2); ++i) {
		const std::complex<double> turn = turnOf(i);
		const int chart = map.mesh.chart[static_cast<int>(i / 3)];
		EXPECT_NEAR(std::abs(turn), 1.0, 1e-4); // of floats in the square
		EXPECT_NEAR(std::abs(turn - turns.emplace(chart, turn).first->second), 0.0, 1e-4);
	}
	EXPECT_EQ(static_cast<int>(turns.size()), charts);
}

/// A copy by a rigid motion, as floats have it, is cut and drawn alike, and solved once.
TEST(Copies, LookAlike)
{
	Random random(77);
	const SurfaceMesh one = inFloats(shaken(perforatedSlab(1, 3), 0.05, random));
	const SurfaceMesh two = sideBySide(one, inFloats(turned(one, {0.3, 1.1, -0.7})), 20);
	Options options;
	options.normalizeUV = false;
	const FlatResult single = run(one, options), both = run(two, options);
	EXPECT_EQ(both.report.iterations, single.report.iterations);
	EXPECT_EQ(both.report.charts, 2 * single.report.charts);
	EXPECT_EQ(both.report.cones, 2 * single.report.cones);
	EXPECT_EQ(both.report.overlappingFaces, 0);
	const auto sides = sidesOfHalves(both);
	expectOneTurnEach(
		both, single.report.charts, [&](std::size_t i) { return sides[1][i] / sides[0][i]; });
}

/// A mirror image, whose triangles list their corners in any order, is drawn mirrored: its charts are turned, and not
/// flipped.
TEST(Copies, MirrorImagesAreMirrored)
{
	Random random(79);
	const SurfaceMesh one = shaken(perforatedSlab(1, 3), 0.05, random);
	for (const std::array<std::size_t, 3>& order :
		 {std::array<std::size_t, 3>{2, 1, 0}, {0, 2, 1}, {1, 0, 2}})
		for (const bool isRefined : {false, true}) {
			SurfaceMesh image = stretched(turned(one, {0.3, 1.1, -0.7}), {-1, 1, 1});
			for (Triangle& t : image.triangles)
				t = {t[order[0]], t[order[1]], t[order[2]]};
			const SurfaceMesh two = sideBySide(one, image, 20);
			Options options;
			options.normalizeUV = false;
			if (isRefined)
				options.output = OutputTriangulation::CommonRefinement;
			const FlatResult single = run(one, options), both = run(two, options);
			EXPECT_EQ(both.report.iterations, single.report.iterations);
			EXPECT_EQ(both.report.charts, 2 * single.report.charts);
			EXPECT_EQ(both.report.flippedFaces + both.report.overlappingFaces, 0);
			EXPECT_EQ(both.report.seamEdges, 2 * single.report.seamEdges);
			EXPECT_NEAR(both.report.qcMean, single.report.qcMean, 1e-9);
			if (isRefined)
				continue; // its pieces have no order
			const auto sides = sidesOfHalves(both);
			expectOneTurnEach(both, single.report.charts, [&](std::size_t i) {
				// By the side between the same corners, which runs the other way.
				const std::size_t j = i - i % 3 + order[(i % 3 + 1) % 3];
				return -sides[1][j] / std::conj(sides[0][i]);
			});
		}
}

/// What is selected on one alone is not copied; neither is a mirror image or another size.
TEST(Copies, AreOnlyWhatIsEqual)
{
	Random random(78);
	const SurfaceMesh one = shaken(perforatedSlab(0, 3), 0.05, random);
	const SurfaceMesh two = sideBySide(one, one, 20);
	const int count = static_cast<int>(one.positions.size());
	Options options;
	options.target = TargetCurvature::SelectedCones;
	VertexInput input;
	input.selected.assign(two.positions.size(), 0);
	const auto select = [&](int first) {
		for (const int v : {0, 5, 9, 14})
			input.selected[at(first + v)] = 1;
	};
	select(0);
	select(count);
	EXPECT_EQ(run(two, options, input).report.cones, 8);
	input.selected[at(count + 14)] = 0;
	input.selected[at(count + 15)] = 1;
	const FlatResult other = run(two, options, input);
	EXPECT_NEAR(other.targetCurvature[at(count + 15)], kPi, 1e-9);
	EXPECT_NEAR(other.targetCurvature[at(count + 14)], 0.0, 1e-9);

	for (const SurfaceMesh& mesh : {stretched(one, {-1, 1, 1}), scaled(one, 1.001)})
		EXPECT_GT(
			run(sideBySide(one, mesh, 20), Options()).report.iterations,
			run(one, Options()).report.iterations);
}

} // namespace
} // namespace ricci::testing
