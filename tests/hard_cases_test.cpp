// SPDX-License-Identifier: GPL-3.0-or-later
// Input at which a flow on a fixed triangulation breaks down: solved, with a map without flips, or
// refused by a sentence.
#include "support/expect.h"
#include "support/flipped_flow.h"
#include "support/front_door.h"
#include "support/intrinsic.h"
#include "support/random_surface.h"

#include <map>
#include <utility>

namespace ricci::testing {
namespace {

Options refined(TargetCurvature target, bool freeBoundary = true)
{
	Options options;
	options.target = target;
	options.freeBoundary = freeBoundary;
	options.epsilon = 1e-10;
	options.output = OutputTriangulation::CommonRefinement;
	options.finish = Finish::None;      // the refinement is exact, except for floats
	options.charts = Charts::OfTheFlow; // other cuts may cross faces, the flow's own seams may not
	return options;
}

/// Runs the whole algorithm and checks what it hands over.
void expectSolved(const SurfaceMesh& mesh, const Options& options, const VertexInput& input = {})
{
	FlatResult flat;
	try {
		flat = run(mesh, options, input);
	}
	catch (const Error& error) {
		FAIL() << error.what();
	}
	const Report& report = flat.report;
	EXPECT_TRUE(report.converged);
	EXPECT_LE(report.maxCurvatureError, std::max(1e-9, report.residualFloor));
	EXPECT_LE(report.residualFloor, 1e-8);
	EXPECT_EQ(report.brokenTriangles, 0);
	EXPECT_EQ(report.flippedFaces, 0);
	for (double u : flat.u)
		EXPECT_TRUE(std::isfinite(u));
	for (const auto& triangle : flat.uv)
		for (const Point2& p : triangle)
			EXPECT_TRUE(std::isfinite(p[0]) && std::isfinite(p[1]));
	expectSurface(
		MapCheck(mesh, flat),
		report.eulerCharacteristic,
		report.boundaryLoops,
		report.maxCurvatureError);
	std::vector<char> covered(mesh.triangles.size(), 0);
	for (int f : flat.mesh.face)
		covered[at(f)] = 1;
	EXPECT_EQ(std::count(covered.begin(), covered.end(), 0), 0) << "faces are lost";
}

/// Disk whose middle vertices lie \p gap apart: needles there.
SurfaceMesh withNeedles(double gap)
{
	Random random(600);
	SurfaceMesh mesh = randomPlanarDisk(8, random);
	for (Point3& p : mesh.positions)
		p[2] = 0.2 * std::sin(5 * p[0]) * std::cos(4 * p[1]);
	const int columns = 9, a = 4 * columns + 4;
	for (int b : {a + 1, a + columns + 3}) {
		mesh.positions[at(b)] = mesh.positions[at(b - 1)];
		mesh.positions[at(b)][0] += gap;
	}
	return mesh;
}

/// Disk in which one vertex lies \p height off an edge of its neighbours: a cap.
SurfaceMesh withCap(double height)
{
	SurfaceMesh mesh = rectangle(8, 8, 1, 1);
	const int columns = 9, a = 4 * columns + 4;
	// Onto the diagonal of its own cell.
	for (std::size_t k = 0; k < 3; ++k)
		mesh.positions[at(a)][k] =
			0.5 * (mesh.positions[at(a + 1)][k] + mesh.positions[at(a + columns)][k]);
	mesh.positions[at(a)][2] += height;
	Random random(601);
	for (std::size_t v = 0; v < mesh.positions.size(); ++v)
		if (static_cast<int>(v) != a && static_cast<int>(v) != a + 1 &&
			static_cast<int>(v) != a + columns)
			mesh.positions[v][2] += random.real(-0.03, 0.03);
	return mesh;
}

void expectSolvedAsDisk(const SurfaceMesh& mesh)
{
	for (const TargetCurvature target :
		 {TargetCurvature::Automatic, TargetCurvature::Disk, TargetCurvature::Rectangle}) {
		SCOPED_TRACE(static_cast<int>(target));
		expectSolved(mesh, refined(target));
	}
}

TEST(HardCases, Needles)
{
	// The shortest side over the longest, 1/8: from an angle of 0.05 degrees to less than 1e-6.
	for (double gap : {1e-4, 1e-6, 2e-7, 1e-7, 2e-9, 1e-11, 1e-14}) {
		SCOPED_TRACE("gap " + std::to_string(std::log10(gap)));
		expectSolvedAsDisk(withNeedles(gap));
	}
}

TEST(HardCases, Caps)
{
	for (double height : {1e-4, 1e-6, 1e-7, 2e-9, 1e-11, 0.0}) {
		SCOPED_TRACE("height " + std::to_string(height));
		expectSolvedAsDisk(withCap(height));
	}
}

TEST(HardCases, NeedlesOnAClosedSurface)
{
	for (double gap : {1e-6, 1e-9, 1e-13}) {
		SCOPED_TRACE(gap);
		Random random(602);
		SurfaceMesh mesh = bumpyTorus(12, 9, random);
		mesh.positions[40] = mesh.positions[41];
		mesh.positions[40][0] += gap;
		expectSolved(mesh, refined(TargetCurvature::Flat));
	}
}

TEST(HardCases, EdgesWithoutLength)
{
	Random random(603);
	SurfaceMesh donut = bumpyTorus(12, 9, random);
	donut.positions[40] = donut.positions[41];
	donut.positions[70] = donut.positions[71] = donut.positions[72];
	expectSolved(donut, refined(TargetCurvature::Flat));

	SurfaceMesh disk = randomPlanarDisk(8, random);
	disk.positions[0] = disk.positions[1];   // on the boundary
	disk.positions[40] = disk.positions[41]; // inside
	expectSolvedAsDisk(disk);
}

/// Coordinates as a file with few digits has them.
TEST(HardCases, RoundedCoordinates)
{
	Random random(604);
	SurfaceMesh mesh = sliverDisk(14, 3.0, random);
	int collapsed = 0;
	for (Point3& p : mesh.positions)
		for (double& x : p)
			x = std::round(x * 100) / 100;
	for (const Triangle& t : mesh.triangles)
		for (std::size_t k = 0; k < 3; ++k)
			collapsed += mesh.positions[at(t[k])] == mesh.positions[at(t[(k + 1) % 3])];
	EXPECT_GT(collapsed, 0);
	expectSolvedAsDisk(mesh);
}

/// A vertex on the edge of a larger face, joined to it by a face without area.
TEST(HardCases, TVertex)
{
	const SurfaceMesh mesh{
		{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 0}, {0.5, 1.5, 0.4}},
		// 0-2 is the long edge with 4 on it.
		{{0, 1, 2}, {0, 2, 4}, {4, 2, 5}, {0, 4, 5}, {5, 2, 3}, {0, 5, 3}}};
	expectSolvedAsDisk(mesh);
	// A closed surface, one end of which is pressed flat: four edges without length.
	SurfaceMesh flatBox = perforatedSlab(0, 1);
	for (std::size_t v = 4; v < 8; ++v)
		flatBox.positions[v][0] = flatBox.positions[v - 4][0];
	expectSolved(flatBox, refined(TargetCurvature::SelectedCones), selecting(flatBox, {0, 3, 5}));
}

TEST(HardCases, ValenceOfAThousand)
{
	const SurfaceMesh disk = fan(1000, 0.7);
	expectSolvedAsDisk(disk);
	const SurfaceMesh closed = bipyramid(1000, 0.7);
	const int apex = 1000, other = 1001;
	expectSolved(closed, refined(TargetCurvature::SelectedCones), selecting(closed, {0, 300, 700}));
	std::vector<double> curvature(closed.positions.size(), 0.0);
	curvature[apex] = curvature[other] = 2 * kPi - 0.01;
	curvature[500] = 0.02;
	expectSolved(closed, refined(TargetCurvature::Prescribed), prescribing(curvature));
	curvature.assign(closed.positions.size(), 0.0);
	curvature[apex] = curvature[other] = -5.0;
	for (int v : {0, 200, 400, 600})
		curvature[at(v)] = (4 * kPi + 10.0) / 4;
	expectSolved(closed, refined(TargetCurvature::Prescribed), prescribing(curvature));
}

/// Edges that share both ends with another, and loops.
std::pair<int, int> multipleEdgesAndLoops(const Triangulation& t)
{
	std::map<std::pair<Vertex, Vertex>, int> count;
	int multiple = 0, loops = 0;
	for (const Edge e : t.edges()) {
		const auto [v, w] = t.ends(e);
		multiple += ++count[std::minmax(v, w)] == 2;
		loops += v == w;
	}
	return {multiple, loops};
}

TEST(HardCases, SeveralEdgesBetweenTwoVerticesAndLoops)
{
	int multiple = 0, loops = 0;
	Random random(606);
	for (int round = 0; round < 40; ++round) {
		SCOPED_TRACE("round " + std::to_string(round));
		const SurfaceMesh mesh = round % 2 ? shaken(bipyramid(5, 0.6), 0.2, random)
										   : shaken(perforatedSlab(0, 1), 0.2, random);
		const auto curvature =
			randomCurvature(static_cast<int>(mesh.positions.size()), 2, -6.0, 6.2, 1.0, random);
		const FlippedFlow flow(mesh, prescribed(curvature));
		const auto found = multipleEdgesAndLoops(flow.result.metric->triangulation());
		multiple += found.first;
		loops += found.second;
		expectSolved(mesh, refined(TargetCurvature::Prescribed), prescribing(curvature));
	}
	EXPECT_GT(multiple, 10);
	EXPECT_GT(loops, 3);
}

TEST(HardCases, SingleTriangle)
{
	const SurfaceMesh triangles[] = {
		{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}},
		{{{0, 0, 0}, {3, 0, 0}, {1.5, 0.1, 0}}, {{0, 1, 2}}},
		{{{0, 0, 0}, {1, 0, 0}, {0.5, 0, 1e-9}}, {{0, 1, 2}}}};
	for (const SurfaceMesh& mesh : triangles) {
		expectSolved(mesh, refined(TargetCurvature::Automatic));
		expectSolved(mesh, refined(TargetCurvature::Disk));
	}
	expectSolved(
		triangles[1],
		refined(TargetCurvature::Prescribed, false),
		prescribing({kPi - 0.01, kPi - 0.01, 0.02}));
}

TEST(HardCases, TwoTriangles)
{
	const SurfaceMesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
	expectSolvedAsDisk(square);
	SurfaceMesh bent = square;
	bent.positions[3] = {0.9, 0.1, 0.05}; // both on one side of the diagonal
	expectSolvedAsDisk(bent);
}

TEST(HardCases, TetrahedronWithThreeCones)
{
	Random random(607);
	for (int round = 0; round < 5; ++round) {
		const SurfaceMesh mesh = round == 0 ? tetrahedron() : shaken(tetrahedron(), 0.4, random);
		VertexInput cones;
		cones.selected = {1, 1, 1, 0};
		expectSolved(mesh, refined(TargetCurvature::SelectedCones), cones);
		expectSolved(
			mesh,
			refined(TargetCurvature::Prescribed),
			prescribing({2 * kPi - 0.01, 2 * kPi - 0.01, 2 * kPi - 0.01, 0.03 - 2 * kPi}));
	}
}

TEST(HardCases, NegativeCurvatureAtAVertexOfThreeFaces)
{
	Random random(608);
	SurfaceMesh mesh = shaken(bipyramid(8, 0.8), 0.05, random);
	const Triangle t = mesh.triangles.front();
	Point3 middle{0, 0, 0};
	for (int v : t)
		middle += mesh.positions[at(v)] / 3;
	const int added = static_cast<int>(mesh.positions.size());
	mesh.positions.push_back(middle);
	mesh.triangles.front() = {t[0], t[1], added};
	mesh.triangles.push_back({t[1], t[2], added});
	mesh.triangles.push_back({t[2], t[0], added});
	for (double strength : {-1.0, -6.0, -10.0, -20.0}) {
		SCOPED_TRACE(strength);
		std::vector<double> curvature(mesh.positions.size(), (4 * kPi - strength) / added);
		curvature[at(added)] = strength;
		expectSolved(mesh, refined(TargetCurvature::Prescribed), prescribing(curvature));
	}
}

/// Circles that touch: the regular tetrahedron has no others.
TEST(HardCases, TangentCircles)
{
	const Options options = fixedTriangulation(TargetCurvature::SelectedCones);
	const VertexInput cones = selecting(tetrahedron(), {0, 1, 2, 3});
	EXPECT_LT(run(tetrahedron(), options, cones).report.maxCurvatureError, 1e-12);
}

/// All the negative curvature of many handles moved to one small hole: scale factors grow from handle
/// to handle, beyond every floating-point number's digits. Cones keep them apart.
TEST(HardCases, FlatHandlesRoundASmallHole)
{
	const SurfaceMesh mesh = withoutStars(perforatedSlab(40, 3), {0});
	const VertexInput flat = prescribing(std::vector<double>(mesh.positions.size(), 0.0));
	Options options;
	options.target = TargetCurvature::Prescribed; // inside; the boundary is free
	const auto error = refusalOf<InadmissibleCurvature>([&] { run(mesh, options, flat); });
	EXPECT_EQ(error.problem, InadmissibleCurvature::ScalesApart);
	EXPECT_GT(error.value, 15.0); // orders of magnitude
	expectWords(error.what(), {"times as large as others"});
	options.target = TargetCurvature::PlacedCones;
	options.cones.count = 80;
	EXPECT_LT(run(mesh, options).report.maxCurvatureError, 1e-8);
}

/// Long chains of near-degenerate faces whose circles differ by many orders of magnitude.
TEST(HardCases, SlenderSurfaces)
{
	Random random(610);
	SurfaceMesh needle = torus(1.0, 1e-4, 30, 6);
	expectSolved(needle, refined(TargetCurvature::Flat));
	SurfaceMesh strip = rectangle(60, 1, 1e5, 1.0);
	expectSolved(strip, refined(TargetCurvature::Automatic));
	expectSolved(strip, refined(TargetCurvature::Rectangle));
	for (double decades : {4.0, 6.0}) {
		SCOPED_TRACE(decades);
		expectSolved(sliverDisk(12, decades, random), refined(TargetCurvature::Automatic));
	}
}

} // namespace
} // namespace ricci::testing
