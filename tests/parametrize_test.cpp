// SPDX-License-Identifier: GPL-3.0-or-later
// Complete runs from a mesh to the plane, on surfaces whose conformal map is known or whose flat
// metric can be checked in the plane.
#include "support/expect.h"
#include "support/front_door.h"
#include "support/intrinsic.h"
#include "support/random_surface.h"

#include <ricci/flow/target.h>
#include <ricci/ricci.h>

#include <map>
#include <utility>

namespace ricci::testing {
namespace {

Box2 boxOf(const UV& uv)
{
	Box2 box;
	for (const Triangle2& t : uv)
		for (const Point2& p : t)
			box.add(p);
	return box;
}

/// The faces as parametrizeEuclidean() draws them, each with the corners of the input.
TEST(Flatten, GivesTheCornersOfEachFace)
{
	Random random(56);
	for (const SurfaceMesh& mesh : {bumpyPatch(8), bumpyTorus(12, 8, random), tetrahedron()}) {
		const TextureCoordinates map = flatten(mesh.positions, mesh.triangles);
		const Parametrization whole = parametrizeEuclidean(mesh, VertexInput(), Options());
		ASSERT_EQ(map.triangles.size(), mesh.triangles.size());
		for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
			EXPECT_EQ(map.face[f], static_cast<int>(f));
			for (std::size_t k = 0; k < 3; ++k)
				EXPECT_EQ(map.uv[at(map.triangles[f][k])], whole.mesh.at(static_cast<int>(f))[k]);
		}
		EXPECT_EQ(map.objective, whole.report.objective);
		EXPECT_EQ(map.flippedFaces + map.overlappingFaces, 0);
	}
	struct Never : Progress
	{
		bool update(double, const std::string&) override { return false; }
	} never;
	EXPECT_THROW(flatten(tetrahedron().positions, tetrahedron().triangles, {}, &never), Cancelled);
	EXPECT_THROW(flatten({{0, 0, 0}}, {{0, 1, 2}}), InvalidMesh);
}

TEST(Parametrize, APlaneIsMappedToItself)
{
	Random random(200);
	for (int n : {5, 15, 30}) {
		const SurfaceMesh mesh = turned(randomPlanarDisk(n, random), {0.3, 0.7, -1.1});
		const FlatResult flat = run(mesh, fixedTriangulation());
		EXPECT_EQ(flat.report.iterations, 0);
		EXPECT_TRUE(flat.report.converged);
		EXPECT_NEAR(flat.report.qcMax, 1.0, 1e-10);
		EXPECT_EQ(flat.report.flippedFaces, 0);
		// A free boundary keeps its metric: a motion, not only a similarity.
		for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
			for (std::size_t k = 0; k < 3; ++k)
				EXPECT_NEAR(sideLength(flat.uv[f], k) / sideLength(mesh, f, k), 1.0, 1e-10);
	}
}

/// In its own scale no rectangle round the chart is smaller than the upright one, in the unit square no square.
TEST(Parametrize, AChartStandsUprightInItsLeastRectangleOrSquare)
{
	Random random(215);
	Options options;
	options.target = TargetCurvature::Rectangle;
	const Box2 flat = boxOf(run(turned(rectangle(9, 4, 9, 4), {0.3, 0.7, -1.1}), options).uv);
	EXPECT_NEAR(flat.width(), 9.0, 1e-11);
	EXPECT_NEAR(flat.height(), 4.0, 1e-11);
	options.target = TargetCurvature::Automatic;
	options.charts = Charts::OfTheFlow;
	for (const Finish finish : {Finish::None, Finish::LeastDistortion})
		for (const bool normalize : {false, true}) {
			options.finish = finish;
			options.normalizeUV = normalize;
			const FlatMesh mesh = parametrizeEuclidean(bumpyPatch(9), {}, options).mesh;
			const auto sizeAt = [&](double angle) {
				Box2 box;
				for (const Point2& p : mesh.place)
					box.add(asPoint(asComplex(p) * std::polar(1.0, angle)));
				return normalize ? box.extent() : box.width() * box.height();
			};
			const double own = sizeAt(0.0);
			for (int i = 1; i < 180; ++i)
				EXPECT_GE(sizeAt(kPi * i / 180), own * (1.0 - 1e-9)) << i;
			EXPECT_NEAR(mesh.box().min[0], 0.0, 1e-12);
			EXPECT_NEAR(mesh.box().min[1], 0.0, 1e-12);
		}
}

/// On a surface of every kind no triangle turns, and the distortion is less than that of straight triangles alone.
TEST(Parametrize, TheLeastDistortionIsLessWithoutTurningATriangle)
{
	Random random(621);
	int better = 0;
	const std::vector<SurfaceMesh> meshes = surfacesOfEveryKind(random);
	for (const SurfaceMesh& mesh : meshes) {
		Options options;
		options.charts = Charts::OfTheFlow;
		options.target = TargetCurvature::PlacedCones;
		options.cones.distortion = 1.0;
		options.finish = Finish::Repair;
		const Report straight = run(mesh, options).report;
		options.finish = Finish::LeastDistortion;
		const Report least = run(mesh, options).report;
		EXPECT_EQ(least.flippedFaces, 0);
		better += least.qcVertexMean < straight.qcVertexMean;
	}
	EXPECT_EQ(better, static_cast<int>(meshes.size()));
}

TEST(Parametrize, LeastStretchLetsSeamsGoAndKeepsAreasBetter)
{
	Random random(216);
	const SurfaceMesh mesh = bumpyTorus(20, 12, random);
	Options options;
	const FlatResult conformal = run(mesh, options);
	options.finish = Finish::LeastStretch;
	const FlatResult even = run(mesh, options);
	EXPECT_EQ(even.report.flippedFaces, 0);
	EXPECT_EQ(even.report.overlappingFaces, 0);
	EXPECT_LT(
		even.report.areaDistortionMean - 1.0, 0.9 * (conformal.report.areaDistortionMean - 1.0));
	EXPECT_LT(MapCheck(mesh, conformal).seamMismatch, 1e-8);
	EXPECT_GT(MapCheck(mesh, even).seamMismatch, 1e-3);
}

/// The long triangles of a spool cannot follow the metric that its cones were chosen for. By default the energy of the
/// straight ones is lowered, and the two sides of a seam stay equal; where the cones are a wish, angles count alone.
TEST(Parametrize, TheEnergyOfLongTrianglesIsLoweredWithEqualSeams)
{
	const std::vector<std::array<double, 2>> profile{
		{0.0, 0.0},
		{2.0, 0.0},
		{2.0, 0.3},
		{0.5, 0.4},
		{0.5, 2.0},
		{2.0, 2.1},
		{2.0, 2.4},
		{0.0, 2.4}};
	bool isLower = false; // once at least
	const auto countLowered = [&](const SurfaceMesh& mesh, const Options& options) {
		Listener listener;
		const FlatResult map = withListener(listener, [&] { return run(mesh, options); });
		EXPECT_EQ(map.report.flippedFaces, 0);
		EXPECT_EQ(map.report.unequalSeams, 0);
		EXPECT_LT(MapCheck(mesh, map).seamMismatch, 1e-8);
		for (const std::string& line : listener.lines) {
			std::vector<double>
				energies; // of straight triangles, of the metric, and in the end: of three digits
			const std::string words[] = {"have the energy ", "not ", "angles, to "};
			if (line.find(words[0]) == std::string::npos)
				continue;
			for (const std::string& word : words)
				energies.push_back(std::stod(line.substr(line.find(word) + word.size())));
			EXPECT_LE(energies[2], energies[0]);
			isLower |= energies[2] < energies[0];
			EXPECT_LT(energies[1], energies[0] - kBrokenPromise + 0.01);
		}
		return listener.count("have the energy");
	};
	Options wished;
	wished.cones.distortion = 0.5;
	int lowered = 0;
	for (const int around : {60, 100, 160, 240}) {
		const SurfaceMesh spool = revolved(profile, around);
		lowered += countLowered(spool, {});
		EXPECT_EQ(countLowered(spool, wished), 0);
	}
	EXPECT_GE(lowered, 2);
	EXPECT_TRUE(isLower);
}

/// What a map has to keep, it keeps.
TEST(Parametrize, APrescribedBoundaryOrQuarterTurnsGetTheLeastDistortionForTheLeastStretch)
{
	Random random(217);
	Options disk, quarters;
	disk.target = TargetCurvature::Disk;
	quarters.cones.rounding = ConeRounding::QuarterTurns;
	for (const auto& [mesh, asked] :
		 {std::pair(bumpyPatch(10), disk), std::pair(bumpyTorus(14, 9, random), quarters)}) {
		Options options = asked;
		const UV distortion = run(mesh, options).uv;
		options.finish = Finish::LeastStretch;
		EXPECT_EQ(run(mesh, options).uv, distortion);
	}
}

TEST(Parametrize, TheStatesOfTheFlowRunFromTheMeshToTheResult)
{
	const SurfaceMesh mesh = torus(2.0, 1.0, 24, 14);
	const FlatResult flat = run(mesh, fixedTriangulation());
	const std::vector<FlowState>& states = flat.report.flowStates;
	ASSERT_GE(states.size(), 2u);
	// The flow starts at the mesh's own metric, whose curvatures are the angle defects.
	double largest = 0.0;
	for (double defect : curvatureInSpace(mesh))
		largest = std::max(largest, std::abs(defect));
	EXPECT_EQ(states.front().step, 0);
	EXPECT_NEAR(states.front().residual, largest, 1e-12);
	EXPECT_EQ(states.back().step, flat.report.iterations);
	EXPECT_NEAR(states.back().residual, flat.report.maxCurvatureError, 1e-14);
	for (std::size_t i = 1; i < states.size(); ++i) {
		EXPECT_EQ(states[i].component, 0);
		EXPECT_GE(states[i].step, states[i - 1].step);
		EXPECT_LE(states[i].step, states[i - 1].step + 1);
	}
}

TEST(Parametrize, AFlatRectangleKeepsItsAspect)
{
	Random random(202);
	for (double width : {1.0, 2.5, 7.0}) {
		const int nx = 14, ny = 8;
		SurfaceMesh mesh = rectangle(nx, ny, width, 1.0);
		for (int i = 1; i < nx; ++i)
			for (int j = 1; j < ny; ++j)
				for (std::size_t k = 0; k < 2; ++k)
					mesh.positions[at(i * (ny + 1) + j)][k] +=
						random.real(-0.2, 0.2) * (k == 0 ? width / nx : 1.0 / ny);
		swapDiagonalsAtRandom(mesh, random);
		const FlatResult flat = run(mesh, fixedTriangulation(TargetCurvature::Rectangle));
		ASSERT_TRUE(flat.report.rectangleAspect);
		EXPECT_NEAR(*flat.report.rectangleAspect, width, 1e-9 * width);
		EXPECT_NEAR(flat.report.qcMax, 1.0, 1e-9);
	}
}

TEST(Parametrize, AFaceWithoutAreaChangesNoOther)
{
	// Its edge is 1000 times as long as the rectangle, whose faces keep their angles all the same: the plane
	// is mapped to itself.
	const int n = 40, faces = 2 * n * n, corner = (n + 1) * (n + 1) - 1;
	const SurfaceMesh tail = withFlatTail(rectangle(n, n, 0.05, 1), corner - 1, corner, 1000.0);
	Options options;
	options.finish = Finish::None;
	const FlatResult flat = run(tail, options);
	EXPECT_GT(flat.report.lengthened, 0.0);
	EXPECT_LT(flat.report.lengthened, 2e-5);
	const std::vector<double> qc = Distortion(tail, flat).qc;
	for (int f = 0; f < faces; ++f)
		EXPECT_NEAR(qc[at(f)], 1.0, 1e-6) << f;

	// The tail opens a fortieth of a side of the rectangle, and the face without area nothing.
	options.target = TargetCurvature::Rectangle;
	const std::vector<int> corners{0, n, n * (n + 1), corner};
	SurfaceMesh without = tail;
	without.triangles.pop_back();
	without.positions.pop_back();
	const FlatResult one = run(tail, options, selecting(tail, corners));
	const FlatResult other = run(without, options, selecting(without, corners));
	EXPECT_GT(one.report.lengthened, 0.0);
	EXPECT_EQ(other.report.lengthened, 0.0);
	EXPECT_NEAR(*one.report.rectangleAspect, *other.report.rectangleAspect, 1e-3);
	EXPECT_NEAR(*one.report.rectangleAspect, 20.0, 20.0 / n);
}

/// Packing turns charts by right angles alone then.
TEST(Parametrize, QuarterTurnsAcrossSeamsStaySoInTheSquare)
{
	Random random(218);
	const SurfaceMesh mesh = sideBySide(
		shaken(perforatedSlab(2, 2), 0.05, random), shaken(perforatedSlab(0, 3), 0.05, random), 20);
	Options options;
	options.target = TargetCurvature::PlacedCones;
	options.cones.rounding = ConeRounding::QuarterTurns;
	const Parametrization map = parametrizeEuclidean(mesh, {}, options);
	std::map<std::pair<int, int>, Point2> sides; // from one vertex to the other
	for (const int f : map.mesh.points.indices())
		for (const Corner c : cornersOf(f))
			sides[{map.mesh.vertices[c], map.mesh.vertices[c.next()]}] =
				map.mesh.at(c.next()) - map.mesh.at(c);
	int turned = 0;
	for (const auto& [ends, side] : sides) {
		const Point2 other = -1.0 * sides.at({ends.second, ends.first});
		const double turns = std::arg(asComplex(side) / asComplex(other)) / (kPi / 2);
		EXPECT_NEAR(turns, std::round(turns), 1e-5);
		turned += std::abs(turns) > 0.5;
	}
	EXPECT_GT(turned, 10);
	EXPECT_LT(map.report.holonomyError.value_or(1.0), 1e-6);
}

/// One line of edges across a planar ring, which the flow leaves as it is.
TEST(Parametrize, TheSeamOfARingIsShortest)
{
	Options options;
	options.target = TargetCurvature::Flat;
	const Report report = run(ring(1, 4, 12, 5), options).report;
	EXPECT_EQ(report.seamEdges, 5);
	EXPECT_NEAR(report.seamLength, 3.0, 1e-12);
}

TEST(Parametrize, ConventionalFlowIsLessConformal)
{
	Random random(209);
	const SurfaceMesh mesh = bumpyTorus(20, 12, random);
	Options options = fixedTriangulation();
	const double inversive = run(mesh, options).report.qcVertexMean;
	options.method = Method::Thurston;
	const FlatResult conventional = run(mesh, options);
	EXPECT_LT(conventional.report.maxCurvatureError, 1e-8);
	EXPECT_GT(conventional.report.qcVertexMean, inversive + 0.1);
}

TEST(Parametrize, AFreeBoundaryTellsWhatTheFinishDoesToItsLengths)
{
	Options options;
	options.finish = Finish::None;
	const FlatResult kept = run(bumpyPatch(8), options);
	EXPECT_NEAR(kept.report.boundaryRatioMin.value(), 1.0, 1e-9);
	EXPECT_NEAR(kept.report.boundaryRatioMax.value(), 1.0, 1e-9);
	options.finish = Finish::LeastDistortion;
	const FlatResult moved = run(bumpyPatch(8), options);
	EXPECT_LT(moved.report.boundaryRatioMin.value(), 1.0 - 1e-4);
	EXPECT_GT(moved.report.boundaryRatioMax.value(), 1.0 + 1e-4);
	options.target = TargetCurvature::Disk;
	EXPECT_FALSE(run(bumpyPatch(8), options).report.boundaryRatioMax);
}

/// A corner of one triangle is to become straight: no triangle has an angle of pi, but flat ones come
/// as near as one likes.
TEST(Parametrize, ACurvatureAtTheLimitOfATriangleIsRefused)
{
	const SurfaceMesh mesh = rectangle(3, 3, 3, 3);
	std::vector<int> faces(mesh.positions.size(), 0);
	for (const Triangle& face : mesh.triangles)
		for (int v : face)
			++faces[at(v)];
	const std::vector<char> boundary = boundaryOf(mesh);
	const auto others =
		std::count(boundary.begin(), boundary.end(), 1) - std::count(faces.begin(), faces.end(), 1);
	VertexInput input;
	for (std::size_t v = 0; v < faces.size(); ++v)
		input.targetCurvature.push_back(
			boundary[v] && faces[v] > 1 ? 2 * kPi / static_cast<double>(others) : 0.0);
	Options options = fixedTriangulation(TargetCurvature::Prescribed);
	options.freeBoundary = false;
	const auto error = refusalOf<NotConverged>([&] { run(mesh, options, input); });
	EXPECT_EQ(error.problem, NotConverged::BrokenTriangles);
	EXPECT_EQ(error.count, 2u);
	EXPECT_EQ(error.method, Method::FixedTriangles); // for which the flips are the remedy
	options.method = Method::IntrinsicFlips;
	EXPECT_LT(run(mesh, options, input).report.maxCurvatureError, 1e-8);
}

/// Ribbons all of whose vertices lie on the boundary: no cone has a place, however many vertices they are.
TEST(Parametrize, ARibbonWithoutInnerVerticesGetsNoCones)
{
	std::vector<Options> all(3);
	all[1].target = all[2].target = TargetCurvature::PlacedCones;
	all[2].cones.distortion = 0.2;
	for (const int length : {100, 11000})
		for (const Ends ends : {Ends::Open, Ends::Joined})
			for (Options options : all) {
				if (length > 100 && ends == Ends::Joined)
					continue;
				SCOPED_TRACE(length);
				const SurfaceMesh ribbon = grid(1, length, Ends::Open, ends, [&](int i, int j) {
					const double turn = ends == Ends::Open ? 0.05 * j : 2.0 * kPi * j / length;
					const double height = ends == Ends::Open ? 0.1 * j : 0.3 * std::sin(3.0 * turn);
					return Point3{(1.0 + i) * std::cos(turn), (1.0 + i) * std::sin(turn), height};
				});
				options.charts = Charts::OfTheFlow;
				const FlatResult map = run(ribbon, options);
				EXPECT_EQ(map.report.cones, 0);
				expectIsometric(ribbon, map.uv, map.report);
			}
}

} // namespace
} // namespace ricci::testing
