// SPDX-License-Identifier: GPL-3.0-or-later
// The whole way from a mesh to the plane, on surfaces whose conformal map is known or whose flat
// metric can be checked in the plane.
#include "../support/expect.h"
#include "../support/flat_map.h"
#include "../support/intrinsic.h"
#include "../support/listener.h"
#include "../support/packed.h"
#include "../support/random_surface.h"
#include "../support/shapes.h"
#include "../support/transform.h"

#include <ricci/base/numbers.h>
#include <ricci/error.h>
#include <ricci/math/convex_hull.h>
#include <ricci/measure/distortion.h>
#include <ricci/parametrize.h>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

namespace ricci::testing {
namespace {

using Complex = std::complex<double>;

Complex tau(const Report& report)
{
	EXPECT_TRUE(report.torusTauRe && report.torusTauIm);
	return {report.torusTauRe.value_or(0), report.torusTauIm.value_or(0)};
}

double surfaceArea(const SurfaceMesh& mesh)
{
	double area = 0.0;
	for (const Triangle& t : mesh.triangles)
		area += triangleArea(
			{mesh.positions[at(t[0])], mesh.positions[at(t[1])], mesh.positions[at(t[2])]});
	return area;
}

/// A bumpy patch with a round outline that is not centred on anything.
SurfaceMesh bumpyPatch(int n)
{
	return grid(n, n, Ends::Open, Ends::Open, [&](int i, int j) {
		const double x = 2.0 * i / n - 1, y = 2.0 * j / n - 1;
		return Point3{
			x * std::sqrt(1 - 0.5 * y * y) + 0.1 * y,
			y * std::sqrt(1 - 0.5 * x * x),
			0.4 * std::exp(-2 * (x - 0.3) * (x - 0.3) - 3 * y * y)};
	});
}

Box2 boxOf(const UV& uv)
{
	Box2 box;
	for (const Triangle2& t : uv)
		for (const Point2& p : t)
			box.add(p);
	return box;
}
/// Order of convergence seen in the errors on meshes of halved edges: log2 of their quotients.
std::vector<double> observedOrders(const std::vector<double>& errors)
{
	std::vector<double> orders;
	for (std::size_t i = 1; i < errors.size(); ++i)
		orders.push_back(std::log2(errors[i - 1] / errors[i]));
	return orders;
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

TEST(Parametrize, AChartStandsUprightInItsLeastRectangle)
{
	const SurfaceMesh mesh = turned(rectangle(9, 4, 9, 4), {0.3, 0.7, -1.1});
	const Box2 box = boxOf(run(mesh, fixedTriangulation()).uv);
	EXPECT_NEAR(box.min[0], 0.0, 1e-12);
	EXPECT_NEAR(box.min[1], 0.0, 1e-12);
	EXPECT_NEAR(box.max[0], 9.0, 1e-11);
	EXPECT_NEAR(box.max[1], 4.0, 1e-11);
}

/// Least distortion moves the border of the chart.
TEST(Parametrize, AFinishedChartStandsUprightInItsLeastRectangle)
{
	Random random(215);
	const SurfaceMesh mesh = withoutStars(bumpyTorus(14, 9, random), {30, 70});
	Options asFound;
	asFound.finish = Finish::None;
	const FlatResult flat = run(mesh, {});
	EXPECT_NE(flat.uv, run(mesh, asFound).uv);
	const Box2 box = boxOf(flat.uv);
	const OrientedRectangle least = minAreaRectangle(flat.mesh.place.values());
	EXPECT_NEAR(box.min[0], 0.0, 1e-12);
	EXPECT_NEAR(box.min[1], 0.0, 1e-12);
	EXPECT_NEAR(box.max[0], least.width(), 1e-10);
	EXPECT_NEAR(box.max[1], least.height(), 1e-10);
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
	EXPECT_EQ(overlapsIn(even.mesh), 0u);
	EXPECT_LT(
		even.report.areaDistortionMean - 1.0, 0.9 * (conformal.report.areaDistortionMean - 1.0));
	EXPECT_LT(FlatMap(mesh, conformal.uv).seamMismatch, 1e-8);
	EXPECT_GT(FlatMap(mesh, even.uv).seamMismatch, 1e-3);
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

TEST(Parametrize, ModulusOfToriOfRevolutionConvergesWithSecondOrder)
{
	// Conformal coordinates (u, integral of r dv / (R + r cos v)) make the torus a rectangle of
	// sides 2 pi and 2 pi r / sqrt(R^2 - r^2).
	for (const auto& [R, r] : {std::pair{2.0, 1.0}, {5.0, 1.0}, {1.5, 1.0}}) {
		const double ratio = std::sqrt(R * R - r * r) / r;
		const Complex exact(0.0, std::max(ratio, 1 / ratio));
		std::vector<double> errors;
		for (int n : {10, 20, 40}) {
			const int around = static_cast<int>(std::lround(2 * n * std::max(1.0, R / r / 2)));
			const FlatResult flat = run(torus(R, r, around, n), fixedTriangulation());
			errors.push_back(std::abs(tau(flat.report) - exact));
			EXPECT_EQ(flat.report.flippedFaces, 0);
		}
		for (double order : observedOrders(errors))
			EXPECT_NEAR(order, 2.0, 0.2) << "R = " << R;
		EXPECT_LT(errors.back(), 0.02 * exact.imag());
	}
}

TEST(Parametrize, ModulusOfAnnuliConvergesWithSecondOrder)
{
	// A planar ring, and a cone of revolution, whose slant radii take the place of the radii and
	// whose angle round the apex is 2 pi sin(half opening).
	for (double sine : {1.0, 0.5})
		for (double outer : {1.5, 4.0}) {
			std::vector<double> errors;
			for (int n : {8, 16, 32}) {
				SurfaceMesh mesh = grid(n, 4 * n, Ends::Open, Ends::Joined, [&](int i, int j) {
					const double slant = 1.0 + (outer - 1.0) * i / n, a = 2 * kPi * j / (4 * n);
					return Point3{
						slant * sine * std::cos(a),
						slant * sine * std::sin(a),
						-slant * std::sqrt(1 - sine * sine)};
				});
				const FlatResult flat = run(mesh, fixedTriangulation());
				ASSERT_TRUE(flat.report.annulusModulus);
				errors.push_back(
					std::abs(*flat.report.annulusModulus - std::log(outer) / (2 * kPi * sine)));
				EXPECT_EQ(flat.report.flippedFaces, 0);
			}
			for (double order : observedOrders(errors))
				EXPECT_NEAR(order, 2.0, 0.2) << "sine " << sine << ", outer radius " << outer;
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
	const int n = 60, faces = 2 * n * n, corner = (n + 1) * (n + 1) - 1;
	const SurfaceMesh tail = withFlatTail(rectangle(n, n, 0.05, 1), corner - 1, corner, 1000.0);
	Options options;
	options.finish = Finish::None;
	const FlatResult flat = run(tail, options);
	EXPECT_GT(flat.report.lengthened, 0.0);
	EXPECT_LT(flat.report.lengthened, 2e-5);
	for (int f = 0; f < faces; ++f)
		EXPECT_NEAR(qcOf(tail, flat, at(f)), 1.0, 1e-6) << f;

	// The tail opens a sixtieth of a side of the rectangle, and the face without area nothing.
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

TEST(Parametrize, ARectangleHasFourStraightSides)
{
	const SurfaceMesh mesh = grid(24, 16, Ends::Open, Ends::Open, [](int i, int j) {
		const double x = i / 16.0 + 0.02 * std::sin(j), y = j / 16.0;
		return Point3{x, y, 0.3 * std::exp(-6 * (x - 0.6) * (x - 0.6) - 9 * (y - 0.4) * (y - 0.4))};
	});
	const FlatResult flat = run(mesh, fixedTriangulation(TargetCurvature::Rectangle));
	ASSERT_TRUE(flat.report.rectangleAspect);
	const Triangulation t = glued(mesh);
	const double width = std::sqrt(surfaceArea(mesh) * *flat.report.rectangleAspect);
	const double height = width / *flat.report.rectangleAspect;
	int onSides = 0;
	const VertexArray<char> boundary = t.boundaryVertices();
	for (const Face f : t.faces())
		for (std::size_t k = 0; k < 3; ++k) {
			const Point2& p = flat.uv[at(f)][k];
			if (!boundary[t.vertices(f)[k]])
				continue;
			++onSides;
			const double off = std::min(
				{std::abs(p[0]), std::abs(p[0] - width), std::abs(p[1]), std::abs(p[1] - height)});
			EXPECT_LT(off, 1e-8);
		}
	EXPECT_GT(onSides, 76);
	EXPECT_EQ(flat.report.flippedFaces, 0);
}

/// Largest relative deviation of the boundary's points from a circle round their centre.
double roundness(const SurfaceMesh& mesh, const UV& uv)
{
	const VertexArray<char> boundary = glued(mesh).boundaryVertices();
	std::vector<Point2> points;
	for (std::size_t f = 0; f < uv.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k)
			if (boundary[Vertex(mesh.triangles[f][k])])
				points.push_back(uv[f][k]);
	// Circle x^2 + y^2 + a x + b y + c = 0 by least squares.
	Eigen::MatrixXd A(points.size(), 3);
	Eigen::VectorXd b(points.size());
	for (std::size_t i = 0; i < points.size(); ++i) {
		const auto row = static_cast<Eigen::Index>(i);
		A.row(row) << points[i][0], points[i][1], 1.0;
		b[row] = -points[i][0] * points[i][0] - points[i][1] * points[i][1];
	}
	const Eigen::Vector3d c = A.colPivHouseholderQr().solve(b);
	const double radius = std::sqrt(0.25 * (c[0] * c[0] + c[1] * c[1]) - c[2]);
	double worst = 0.0;
	for (const Point2& p : points)
		worst = std::max(
			worst, std::abs(std::hypot(p[0] + 0.5 * c[0], p[1] + 0.5 * c[1]) / radius - 1.0));
	return worst;
}

TEST(Parametrize, ADiskIsRound)
{
	Random random(203);
	for (const SurfaceMesh& mesh :
		 {bumpyPatch(8),
		  bumpyPatch(24),
		  rectangle(30, 6, 5, 1),
		  withoutStars(perforatedSlab(0, 6), {0})}) {
		const FlatResult flat = run(mesh, fixedTriangulation(TargetCurvature::Disk));
		EXPECT_LT(roundness(mesh, flat.uv), 1e-9);
		EXPECT_EQ(flat.report.flippedFaces, 0);
		EXPECT_LT(flat.report.maxCurvatureError, 1e-8);
		const FlatMap map(mesh, flat.uv);
		EXPECT_LT(map.error(flat.targetCurvature), 1e-8);
	}
}

TEST(Parametrize, ARegularPolygonIsADiskAlready)
{
	for (int n : {5, 12}) {
		const SurfaceMesh polygon = fan(n, 0.0);
		const FlatResult flat = run(polygon, fixedTriangulation(TargetCurvature::Disk));
		EXPECT_NEAR(flat.report.qcMax, 1.0, 1e-9);
		EXPECT_LT(roundness(polygon, flat.uv), 1e-12);
	}
}

TEST(Parametrize, TheLogNamesConesByTheirNumbersInTheMesh)
{
	Random random(205);
	const SurfaceMesh one = shaken(perforatedSlab(0, 3), 0.05, random);
	SurfaceMesh mesh = sideBySide(one, shaken(perforatedSlab(2, 3), 0.05, random), 9.0);
	std::reverse(mesh.triangles.begin(), mesh.triangles.end()); // components number by first use
	Listener listener;
	const Parametrization flat =
		heard(listener, [&] { return parametrizeEuclidean(mesh, {}, Options()); });
	int cones = 0;
	for (const std::string& line : listener.lines) {
		const std::size_t list = line.find("vertex (curvature / pi):");
		if (list == std::string::npos)
			continue;
		std::istringstream in(line.substr(list + 24));
		int vertex;
		double curvature;
		char open, close, comma;
		for (; in >> vertex >> open >> curvature >> close >> comma; ++cones)
			EXPECT_NEAR(flat.targetCurvature[at(vertex)], curvature * kPi, 1e-6) << vertex;
	}
	EXPECT_EQ(cones, flat.report.cones);
}

TEST(Parametrize, ClosedSurfacesWithCones)
{
	Random random(204);
	for (int genus : {0, 2, 3}) {
		const SurfaceMesh mesh = shaken(perforatedSlab(genus, 4), 0.02, random);
		std::vector<int> cones;
		for (std::size_t v = 3; v < mesh.positions.size() && cones.size() < 20; v += 17)
			cones.push_back(static_cast<int>(v));
		const FlatResult flat =
			run(mesh, fixedTriangulation(TargetCurvature::SelectedCones), selecting(mesh, cones));
		const FlatMap map(mesh, flat.uv);
		EXPECT_EQ(flat.report.genus, genus);
		EXPECT_LT(map.error(flat.targetCurvature), 1e-9);
		EXPECT_LT(map.seamMismatch, 1e-9);
		EXPECT_EQ(map.seamEdges, flat.report.seamEdges + flat.report.overlapCuts);
		EXPECT_EQ(flat.report.flippedFaces, 0);
		double sum = 0.0;
		for (double K : flat.targetCurvature)
			sum += K;
		EXPECT_NEAR(sum, 2 * kPi * (2 - 2 * genus), 1e-11);
		EXPECT_NEAR(map.area / surfaceArea(mesh), 1.0, 1e-10);
	}
}

TEST(Parametrize, PrescribedCurvatureIsReached)
{
	Random random(205);
	const SurfaceMesh mesh = bumpyTorus(14, 9, random);
	VertexInput input;
	double sum = 0.0;
	for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
		input.targetCurvature.push_back(random.real(-0.3, 0.3));
		sum += input.targetCurvature.back();
	}
	for (double& K : input.targetCurvature)
		K -= sum / static_cast<double>(mesh.positions.size());
	const FlatResult flat = run(mesh, fixedTriangulation(TargetCurvature::Prescribed), input);
	const FlatMap map(mesh, flat.uv);
	for (std::size_t v = 0; v < mesh.positions.size(); ++v)
		EXPECT_NEAR(map.curvature[v], input.targetCurvature[v], 1e-9);
	EXPECT_FALSE(flat.report.torusTauRe); // not flat: no period lattice
}

TEST(Parametrize, SurfacesWithManyBoundaries)
{
	const SurfaceMesh mesh = withoutStars(torus(3, 1, 16, 12), {0, 50, 100});
	const FlatResult free = run(mesh, fixedTriangulation());
	EXPECT_EQ(free.report.boundaryLoops, 3);
	EXPECT_EQ(free.report.genus, 1);
	EXPECT_EQ(free.report.eulerCharacteristic, -3);
	const FlatMap freeMap(mesh, free.uv);
	EXPECT_LT(freeMap.insideError(std::vector<double>(mesh.positions.size(), 0.0)), 1e-9);
	EXPECT_LT(freeMap.seamMismatch, 1e-9);
	// The free boundary keeps its lengths.
	const Triangulation t = glued(mesh);
	int boundaryEdges = 0;
	for (const Face f : t.faces())
		for (std::size_t k = 0; k < 3; ++k)
			if (t.isBoundary(t.halfedges(f)[k].edge())) {
				++boundaryEdges;
				EXPECT_NEAR(sideLength(free.uv[at(f)], k) / sideLength(mesh, at(f), k), 1.0, 1e-10);
			}
	EXPECT_EQ(boundaryEdges, 3 * 6);
	Options options = fixedTriangulation();
	options.freeBoundary = false;
	const FlatResult prescribed = run(mesh, options);
	const FlatMap map(mesh, prescribed.uv);
	EXPECT_LT(map.error(prescribed.targetCurvature), 1e-9);
}

TEST(Parametrize, ResultDoesNotDependOnScaleOrPlace)
{
	Random random(206);
	const SurfaceMesh mesh = bumpyTorus(16, 10, random);
	const FlatResult reference = run(mesh, fixedTriangulation());
	const SurfaceMesh others[] = {
		scaled(mesh, 1e8), scaled(mesh, 1e-8), turned(mesh, {0.4, 2.0, -0.7})};
	for (const SurfaceMesh& other : others) {
		const FlatResult flat = run(other, fixedTriangulation());
		EXPECT_EQ(flat.report.iterations, reference.report.iterations);
		EXPECT_LT(flat.report.maxCurvatureError, 1e-10);
		EXPECT_NEAR(flat.report.qcMean, reference.report.qcMean, 1e-10);
		EXPECT_NEAR(flat.report.qcVertexMean, reference.report.qcVertexMean, 1e-10);
		EXPECT_NEAR(flat.report.qcAreaMean, reference.report.qcAreaMean, 1e-10);
		EXPECT_NEAR(flat.report.qcMax, reference.report.qcMax, 1e-9);
		EXPECT_LT(std::abs(tau(flat.report) - tau(reference.report)), 1e-10);
		for (std::size_t v = 0; v < mesh.positions.size(); ++v)
			EXPECT_NEAR(flat.vertexQC[v], reference.vertexQC[v], 1e-9);
	}
}

TEST(Parametrize, ResultDoesNotDependOnTheNumbersOfVerticesAndFaces)
{
	Random random(207);
	for (const SurfaceMesh& mesh : {bumpyTorus(16, 10, random), bumpyPatch(12)}) {
		const FlatResult reference = run(mesh, fixedTriangulation());
		for (int trial = 0; trial < 3; ++trial) {
			const Renumbered other = renumbered(mesh, random);
			const FlatResult flat = run(other.mesh, fixedTriangulation());
			EXPECT_LT(flat.report.maxCurvatureError, 1e-8);
			EXPECT_NEAR(flat.report.qcMean, reference.report.qcMean, 1e-9);
			EXPECT_NEAR(flat.report.qcVertexMean, reference.report.qcVertexMean, 1e-9);
			EXPECT_NEAR(flat.report.qcAreaMean, reference.report.qcAreaMean, 1e-9);
			if (reference.report.torusTauRe) {
				EXPECT_LT(std::abs(tau(flat.report) - tau(reference.report)), 1e-9);
			}
			double shift = 0.0; // the scale of a torus is open, but fixed by its area
			for (std::size_t v = 0; v < other.vertex.size(); ++v)
				shift = std::max(shift, std::abs(flat.u[v] - reference.u[at(other.vertex[v])]));
			EXPECT_LT(shift, 1e-9);
			for (std::size_t f = 0; f < other.face.size(); ++f)
				EXPECT_NEAR(
					qcOf(other.mesh, flat, f), qcOf(mesh, reference, at(other.face[f])), 1e-8);
		}
	}
}

TEST(Parametrize, SeveralComponentsAreSolvedOneByOne)
{
	Random random(208);
	const SurfaceMesh a = bumpyTorus(12, 8, random), b = bumpyPatch(8);
	const SurfaceMesh both = sideBySide(a, b, 10);
	const FlatResult pair = run(both, fixedTriangulation());
	// The second one at the place where it lies in the pair: moving it rounds its lengths.
	const FlatResult first = run(a, fixedTriangulation()),
					 second = run(sideBySide({}, b, 10), fixedTriangulation());
	EXPECT_EQ(pair.report.components, 2);
	ASSERT_EQ(pair.charts.size(), 2u);
	EXPECT_EQ(pair.mesh.trianglesByChart(2)[0].size(), a.triangles.size());
	EXPECT_EQ(pair.report.iterations, first.report.iterations + second.report.iterations);
	EXPECT_EQ(pair.report.genus, 1);
	EXPECT_EQ(pair.report.eulerCharacteristic, 1);
	EXPECT_EQ(pair.report.boundaryLoops, 1);
	EXPECT_EQ(pair.report.seamEdges, first.report.seamEdges + second.report.seamEdges);
	EXPECT_EQ(
		pair.report.maxCurvatureError,
		std::max(first.report.maxCurvatureError, second.report.maxCurvatureError));
	const double na = static_cast<double>(a.triangles.size());
	const double nb = static_cast<double>(b.triangles.size());
	EXPECT_NEAR(
		pair.report.qcMean,
		(na * first.report.qcMean + nb * second.report.qcMean) / (na + nb),
		1e-12);
	EXPECT_FALSE(pair.report.torusTauRe);
	EXPECT_TRUE(first.report.torusTauRe);
	for (std::size_t f = 0; f < a.triangles.size(); ++f)
		EXPECT_EQ(pair.uv[f], first.uv[f]);
}

TEST(Parametrize, TheRefusalOfOneComponentNamesIt)
{
	const SurfaceMesh both = sideBySide(rectangle(2, 2, 1, 1), tetrahedron(), 10);
	const auto error =
		refusalOf<InvalidOption>([&] { run(both, fixedTriangulation(TargetCurvature::Disk)); });
	EXPECT_EQ(error.componentFace, 8);
	EXPECT_EQ(error.componentFaces, 4u);
	EXPECT_EQ(error.problem, InvalidOption::NotADisk);
	EXPECT_EQ(error.target, TargetCurvature::Disk);
	EXPECT_TRUE(error.surface.isSphere());
	expectWords(error.what(), {"genus 0"});
}

TEST(Parametrize, FacesOfTheOtherOrientationAreMappedLikeTheRest)
{
	const SurfaceMesh mesh = bumpyPatch(10);
	const SurfaceMesh mixed = withReversedFaces(mesh, 5);
	const FlatResult straight = run(mesh, fixedTriangulation());
	const FlatResult flat = run(mixed, fixedTriangulation());
	EXPECT_EQ(flat.report.flippedFaces, 0);
	EXPECT_NEAR(flat.report.qcMean, straight.report.qcMean, 1e-12);
	for (std::size_t f = 0; f < mixed.triangles.size(); ++f) {
		EXPECT_EQ(doubledArea(flat.uv[f][0], flat.uv[f][1], flat.uv[f][2]) < 0.0, f % 5 == 0);
		for (std::size_t k = 0; k < 3; ++k) {
			const std::size_t j = f % 5 == 0 ? (3 - k) % 3 : k;
			for (std::size_t x = 0; x < 2; ++x)
				EXPECT_NEAR(flat.uv[f][j][x], straight.uv[f][k][x], 1e-9);
		}
	}
	ASSERT_FALSE(flat.notes.empty());
	EXPECT_NE(flat.notes[0].find("oriented against"), std::string::npos);
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

TEST(Parametrize, RefusesOptionsOutOfRange)
{
	const SurfaceMesh mesh = rectangle(2, 2, 1, 1);
	for (double epsilon : {0.0, -1e-9, std::numeric_limits<double>::quiet_NaN()}) {
		Options options = fixedTriangulation();
		options.epsilon = epsilon;
		const auto error = refusalOf<InvalidOption>([&] { run(mesh, options); });
		EXPECT_EQ(error.problem, InvalidOption::Epsilon);
		EXPECT_TRUE(error.value == epsilon || (std::isnan(error.value) && std::isnan(epsilon)));
		expectWords(error.what(), {"must be greater than 0 radians"});
	}
}

TEST(Parametrize, TheLogSaysWhenAnotherSolveBegins)
{
	Options options;
	options.target = TargetCurvature::Disk; // solve by solve, and on the double
	Listener listener;
	const Parametrization flat =
		heard(listener, [&] { return parametrizeEuclidean(bumpyPatch(12), {}, options); });
	int solves = 0;
	for (std::size_t i = 1; i < listener.lines.size(); ++i) {
		const auto residual = [&](std::size_t line) {
			const std::size_t equals = listener.lines[line].rfind("= ");
			return listener.lines[line].rfind("Newton step", 0) == 0
					   ? std::stod(listener.lines[line].substr(equals + 2))
					   : 0.0;
		};
		if (residual(i - 1) > 0.0) {
			EXPECT_LT(residual(i), residual(i - 1)) << listener.lines[i];
		}
		const std::string& line = listener.lines[i];
		solves += line.rfind("Solve ", 0) == 0 || line.rfind("Another solve", 0) == 0;
	}
	EXPECT_GT(solves, 0);
	const std::vector<FlowState>& states = flat.report.flowStates;
	int repeated = 0; // numbers, with which solves begin
	for (std::size_t i = 1; i < states.size(); ++i)
		repeated += states[i].step == states[i - 1].step;
	EXPECT_GE(repeated, solves);
	EXPECT_EQ(static_cast<int>(states.size()) - 1 - repeated, flat.report.iterations);
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

TEST(Parametrize, ChosenTargetsAreReported)
{
	const auto reportFor = [](const SurfaceMesh& mesh) { return run(mesh, Options()).report; };
	const Report flat = reportFor(rectangle(4, 4, 1, 1));
	EXPECT_EQ(flat.targetUsed, TargetUsed::FreeBoundary);
	EXPECT_EQ(flat.choice.rfind("no cones", 0), 0u);
	EXPECT_NEAR(flat.expectedSpread.value(), 0.0, 1e-9);
	SurfaceMesh plate = perforatedSlab(0, 4);
	for (Point3& p : plate.positions)
		p[2] *= 0.1;
	const FlatResult closed = run(plate, Options());
	EXPECT_EQ(closed.report.targetUsed, TargetUsed::Unfolded);
	EXPECT_TRUE(closed.placedCones.empty());
	EXPECT_FALSE(closed.report.boundaryRatioMax);
	Options options;
	options.target = TargetCurvature::PlacedCones;
	const FlatResult cones = run(perforatedSlab(0, 4), options);
	EXPECT_EQ(cones.report.targetUsed, TargetUsed::PlacedCones);
	EXPECT_TRUE(cones.report.choice.empty());
	EXPECT_EQ(static_cast<int>(cones.placedCones.size()), cones.report.cones);
	double sum = 0.0;
	for (const int v : cones.placedCones)
		sum += cones.targetCurvature[at(v)];
	EXPECT_NEAR(sum, 4 * kPi, 1e-9);
	const Report both = reportFor(sideBySide(rectangle(4, 4, 1, 1), perforatedSlab(0, 4), 10));
	EXPECT_EQ(both.targetUsed, TargetUsed::Several);
	EXPECT_TRUE(both.choice.empty());
}

TEST(Parametrize, ErrorsOfTheListenerPassThrough)
{
	struct Broken : Progress
	{
		bool update(double, const std::string&) override { throw std::runtime_error("full disk"); }
	} broken;
	EXPECT_THROW(
		heard(
			broken,
			[&] { return parametrizeEuclidean(rectangle(2, 2, 1, 1), {}, fixedTriangulation()); }),
		std::runtime_error);
}

TEST(Parametrize, SplitsABoundaryEdgeThatWouldBreakItsTriangle)
{
	// The more negative the curvature asked of the middle, the nearer its vertex comes to the long
	// side, whose triangle breaks. A boundary edge cannot be swapped: it is split.
	const SurfaceMesh fan = fanWithGap(100);
	VertexInput input;
	input.targetCurvature.assign(8, 0.0);
	Options options = fixedTriangulation(TargetCurvature::Prescribed);
	options.method = Method::EdgeSwaps;
	for (double K : {-1.0, -2.0, -3.0}) {
		input.targetCurvature[0] = K;
		const FlatResult flat = run(fan, options, input);
		EXPECT_EQ(flat.report.boundarySplits, K < -2.5 ? 1 : 0);
		EXPECT_EQ(flat.report.edgeSwaps, 0);
		EXPECT_EQ(flat.report.brokenTriangles, 0);
		EXPECT_EQ(flat.report.flippedFaces, 0);
		EXPECT_LT(flat.report.maxCurvatureError, 1e-8);
		const FlatMap map(fan, flat.uv);
		EXPECT_NEAR(map.curvature[0], K, 1e-9);
		ASSERT_EQ(flat.u.size(), fan.positions.size()); // the new vertex stays inside
	}
	options.method = Method::FixedTriangles;
	const auto error = refusalOf<NotConverged>([&] { run(fan, options, input); });
	EXPECT_EQ(error.problem, NotConverged::BrokenTriangles);
	EXPECT_EQ(error.count, 1u);
	EXPECT_EQ(error.method, Method::FixedTriangles);
	expectWords(error.what(), {"the triangle inequality at the end"});
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
	const std::vector<char> boundary = glued(mesh).boundaryVertices().values();
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

TEST(Parametrize, ReportedRadiiBelongToTheLayout)
{
	// Scaling the layout to the area of the surface shifts u; edges of the layout must follow it.
	Random random(213);
	const SurfaceMesh mesh = bumpyTorus(12, 8, random);
	const FlatResult flat = run(mesh, fixedTriangulation());
	const Packed packed(mesh);
	const Triangulation& t = packed.triangulation;
	for (const Face f : t.faces())
		for (std::size_t k = 0; k < 3; ++k) {
			const Halfedge h = t.halfedges(f)[k];
			const double gi = std::exp(flat.u[at(t.origin(h))]);
			const double gj = std::exp(flat.u[at(t.target(h))]);
			const double I = 1 + packed.packing.delta[h.edge()];
			EXPECT_NEAR(
				sideLength(flat.uv[at(f)], k) / std::sqrt(gi * gi + gj * gj + 2 * I * gi * gj),
				1.0,
				1e-9);
		}
}

} // namespace
} // namespace ricci::testing
