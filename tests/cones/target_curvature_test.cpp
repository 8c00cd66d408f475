// SPDX-License-Identifier: GPL-3.0-or-later
// What each target asks of the flow.
#include "support/expect.h"
#include "support/front_door.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/parametrize.h>

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>

namespace ricci::testing {
namespace {

/// The vertices at these places.
std::vector<int> verticesAt(const SurfaceMesh& mesh, const std::vector<Point2>& places)
{
	std::vector<int> vertices;
	for (const Point2& p : places)
		for (std::size_t v = 0; v < mesh.positions.size(); ++v)
			if (mesh.positions[v][0] == p[0] && mesh.positions[v][1] == p[1])
				vertices.push_back(static_cast<int>(v));
	EXPECT_EQ(vertices.size(), places.size());
	return vertices;
}

/// On the mesh's own triangles, where Automatic goes by topology alone.
FlatResult onMesh(const SurfaceMesh& mesh, Options options, const std::vector<int>& selected = {})
{
	options.method = Method::FixedTriangles;
	FlatResult map = flattened(mesh, options, selecting(mesh, selected));
	EXPECT_LE(map.report.maxCurvatureError, 1e-8);
	return map;
}

SurfaceMesh flatDisk()
{
	return rectangle(5, 4, 5, 4);
}

TEST(Target, AutomaticGoesByTopologyWhereNoAreasAreMeasured)
{
	const SurfaceMesh pierced = withoutStars(torus(3, 1, 9, 9), {0, 40});
	const struct
	{
		SurfaceMesh mesh;
		TargetUsed free, prescribed;
	} cases[] = {
		{flatDisk(), TargetUsed::FreeBoundary, TargetUsed::Disk},
		{ring(1, 2, 9, 3), TargetUsed::Flat, TargetUsed::Flat},
		{torus(3, 1, 9, 7), TargetUsed::Flat, TargetUsed::Flat},
		{pierced, TargetUsed::FreeBoundary, TargetUsed::PrescribedBoundary},
		{perforatedSlab(0, 2), TargetUsed::PlacedCones, TargetUsed::PlacedCones},
		{perforatedSlab(2, 1), TargetUsed::PlacedCones, TargetUsed::PlacedCones}};
	for (const auto& c : cases)
		for (const bool isFree : {true, false}) {
			Options options = towards(TargetCurvature::Automatic);
			options.freeBoundary = isFree;
			const FlatResult map = onMesh(c.mesh, options);
			SCOPED_TRACE(map.report.choice);
			const TargetUsed used = isFree ? c.free : c.prescribed;
			EXPECT_EQ(map.report.targetUsed, used);
			if (used != TargetUsed::FreeBoundary) {
				EXPECT_NEAR(
					sum(map.targetCurvature), 2 * kPi * map.report.eulerCharacteristic, 1e-9);
				EXPECT_TRUE(isFree || !map.report.boundaryRatioMin);
			}
			const std::vector<char> boundary = boundaryOf(c.mesh);
			for (std::size_t v = 0; v < boundary.size(); ++v)
				if (used != TargetUsed::PlacedCones && (!boundary[v] || used == TargetUsed::Flat)) {
					EXPECT_EQ(map.targetCurvature[v], 0.0);
				}
		}
}

/// Standard deviation of 2 ln \p x, which has the density \p weight over (0, 1).
double spreadOf(const std::function<double(double)>& x, const std::function<double(double)>& weight)
{
	const int n = 200000;
	double total = 0.0, first = 0.0, squares = 0.0;
	for (int i = 0; i < n; ++i) {
		const double t = (i + 0.5) / n, w = weight(t), y = 2 * std::log(x(t));
		total += w;
		first += w * y;
		squares += w * y * y;
	}
	return std::sqrt(squares / total - first * first / (total * total));
}

/// Expected spread of the area factor without cones, by the formula of the smooth surface: the flat
/// metric of a surface of revolution without poles divides lengths by the radius, that of a sphere
/// with a hole is the stereographic projection from the middle of the hole.
struct Plain
{
	SurfaceMesh mesh;
	double spread;
	TargetUsed used; ///< without cones
	bool needsCones; ///< to keep areas: a plane ring keeps them as soon as its boundary is free
};

std::vector<Plain> plainSurfaces()
{
	std::vector<Plain> surfaces;
	for (const double R : {8.0, 1.1}) {
		const auto radius = [R](double t) { return R + std::cos(2 * kPi * t); };
		surfaces.push_back(
			{torus(R, 1.0, 60, 60), spreadOf(radius, radius), TargetUsed::Flat, true});
	}
	for (const double end : {0.7, 0.1}) { // an hourglass, or nearly a cylinder
		const auto radius = [end](double t) { return 1.0 + (end - 1.0) * std::sin(kPi * t); };
		const auto area = [end, &radius](double t) {
			return radius(t) * std::hypot((end - 1.0) * kPi * std::cos(kPi * t), 4.0);
		};
		std::vector<std::array<double, 2>> profile;
		for (int i = 0; i <= 80; ++i)
			profile.push_back({radius(i / 80.0), i / 20.0});
		surfaces.push_back({revolved(profile, 60), spreadOf(radius, area), TargetUsed::Flat, true});
	}
	const auto radius = [](double t) { return 1.0 + 3.0 * t; };
	surfaces.push_back({ring(1.0, 4.0, 60, 40), spreadOf(radius, radius), TargetUsed::Flat, false});
	for (const double hole : {2.3, 0.3}) {
		const double cap = 0.5 * (1.0 - std::cos(hole)); // its share of the sphere
		std::vector<std::array<double, 2>> profile;
		for (int i = 0; i <= 60; ++i) {
			const double a = hole + (kPi - hole) * i / 60;
			profile.push_back({i < 60 ? std::sin(a) : 0.0, -std::cos(a)});
		}
		const auto area = [cap](double t) { return cap + (1.0 - cap) * t; };
		surfaces.push_back(
			{revolved(profile, 60),
			 spreadOf(area, [](double) { return 1.0; }),
			 TargetUsed::FreeBoundary,
			 true});
	}
	return surfaces;
}

/// Expected energy, and what it costs with its seams.
double cost(double spread, double seams)
{
	return 4.0 + 2.0 * spread * spread + 0.05 * seams;
}

TEST(Target, AutomaticTakesWhatIsExpectedToCostLess)
{
	int withCones = 0;
	Options options = towards(TargetCurvature::Automatic);
	for (const Plain& p : plainSurfaces()) {
		const FlatResult map = flattened(p.mesh, options);
		SCOPED_TRACE(map.report.choice);
		std::string note; // on the choice
		for (const std::string& n : map.notes)
			if (n.find("ones: ") != std::string::npos)
				note = note.empty() ? n : note;
		const double spread = numberAfter(note, "area distortion "); // without cones
		EXPECT_NEAR(spread / p.spread, 1.0, 0.03) << note;
		const double plain = cost(spread, numberAfter(note, ", seams "));
		const bool hasCones = map.report.targetUsed == TargetUsed::PlacedCones;
		EXPECT_EQ(hasCones, map.report.choice.rfind("cones", 0) == 0);
		withCones += hasCones;
		if (!hasCones) {
			EXPECT_EQ(map.report.targetUsed, p.used);
			EXPECT_EQ(map.report.cones, 0);
			EXPECT_NEAR(map.report.expectedSpread.value_or(0) / p.spread, 1.0, 0.03);
			continue;
		}
		// What the cones save is more than the seams that they need.
		EXPECT_EQ(map.report.cones > 0, p.needsCones);
		const std::string said = map.report.choice.substr(map.report.choice.find("the objective"));
		EXPECT_NEAR(numberAfter(said, " from "), plain, 0.01 * plain);
		EXPECT_LT(numberAfter(said, " to "), numberAfter(said, " from "));
		EXPECT_LT(map.report.expectedSpread.value_or(HUGE_VAL), spread);
	}
	EXPECT_GE(withCones, 3);
}

/// More distortion than there is without cones needs none, as far as the choice can foresee; less needs them, and a
/// free boundary.
TEST(Target, AutomaticPlacesConesWhereLessDistortionIsAskedFor)
{
	Options options = towards(TargetCurvature::Automatic);
	for (const Plain& p : plainSurfaces())
		for (const double share : {1e9, 1.1, 0.9}) {
			SCOPED_TRACE(p.spread);
			options.cones.distortion = share * p.spread;
			const Report report = flattened(p.mesh, options).report;
			EXPECT_EQ(report.choice.rfind("no cones, ", 0) == 0, share > 1.0) << report.choice;
			if (share > 2.0) {
				EXPECT_EQ(report.targetUsed, p.used);
				EXPECT_EQ(report.cones, 0);
			}
			if (share < 1.0) {
				EXPECT_EQ(report.targetUsed, TargetUsed::PlacedCones);
				EXPECT_EQ(report.cones > 0, p.needsCones);
				EXPECT_EQ(report.boundaryRatioMin.has_value(), report.boundaryLoops > 0);
				EXPECT_LE(report.expectedSpread.value_or(1e9), 1.1 * options.cones.distortion);
			}
		}
	// A cylinder is flat, and so is a disk in the plane.
	options.cones.distortion = 0.0;
	for (const SurfaceMesh& mesh :
		 {revolved({{1.0, 0.0}, {1.0, 1.0}, {1.0, 2.0}, {1.0, 3.0}}, 24), flatDisk()}) {
		const Report report = flattened(mesh, options).report;
		EXPECT_EQ(report.cones, 0);
		EXPECT_LT(report.expectedSpread.value_or(1), 1e-4);
		EXPECT_EQ(report.iterations, 0);
	}
	options.cones.count = 5; // the number is the user's
	EXPECT_EQ(flattened(torus(1.1, 1.0, 40, 40), options).report.cones, 5);
}

/// Four corners of pi / 2, the boundary straight between them: \p corners, or any four where none are given.
void expectRectangle(
	const SurfaceMesh& mesh, const std::vector<int>& selected, const std::set<int>& corners = {})
{
	const FlatResult map =
		flattened(mesh, towards(TargetCurvature::Rectangle), selecting(mesh, selected));
	std::set<int> found;
	for (std::size_t v = 0; v < map.targetCurvature.size(); ++v)
		if (map.targetCurvature[v] != 0.0) {
			EXPECT_EQ(map.targetCurvature[v], kPi / 2);
			found.insert(static_cast<int>(v));
		}
	EXPECT_EQ(found.size(), 4u);
	if (!corners.empty()) {
		EXPECT_EQ(found, corners);
	}
	expectDrawn(mesh, map, map.targetCurvature);
	EXPECT_TRUE(map.report.rectangleAspect);
}

TEST(Target, RectangleHasTheCornersOfItsShapeOrOfTheSelection)
{
	// A rectangular patch, turned in space, bent a little, shuffled: its own four corners.
	Random random(90);
	for (int trial = 0; trial < 20; ++trial) {
		const int nx = 4 + random.index(8), ny = 4 + random.index(8);
		SurfaceMesh patch = rectangle(nx, ny, random.real(1, 4), random.real(1, 4));
		const std::set<int> expected{0, ny, nx * (ny + 1), nx * (ny + 1) + ny};
		for (Point3& p : patch.positions)
			p[2] = 0.1 * std::sin(p[0] + 2 * p[1]);
		patch = turned(patch, {random.real(-3, 3), random.real(-3, 3), random.real(-3, 3)});
		const Renumbered other = renumbered(patch, random);
		std::set<int> corners;
		for (std::size_t v = 0; v < other.vertex.size(); ++v)
			if (expected.count(other.vertex[v]) > 0)
				corners.insert(static_cast<int>(v));
		expectRectangle(other.mesh, {}, corners);
	}
	for (const int n : {4, 5, 7, 30}) { // round: every boundary vertex is like the others
		SurfaceMesh fan{{{0, 0, 0}}, {}};
		for (int i = 0; i < n; ++i) {
			fan.positions.push_back({std::cos(2 * kPi * i / n), std::sin(2 * kPi * i / n), 0});
			fan.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
		}
		expectRectangle(fan, {});
	}
	const std::vector<int> chosen = verticesAt(flatDisk(), {{0, 0}, {3, 0}, {5, 4}, {0, 2}});
	expectRectangle(flatDisk(), chosen, {chosen.begin(), chosen.end()});
}

/// A flat triangle: the nearest vertex to the upper corners of its rectangle is the lower one. The corners then
/// divide the boundary into quarters, up to an edge.
TEST(Target, RectangleHasQuartersWhereTwoCornersAreNearestToOneVertex)
{
	SurfaceMesh mesh;
	std::vector<Point3> outline;
	const auto side = [&](const Point3& a, const Point3& b, int parts) {
		for (int i = 0; i < parts; ++i)
			outline.push_back(a + (static_cast<double>(i) / parts) * (b - a));
	};
	const Point3 left{0.0, 0.0, 0.0}, right{4.0, 0.0, 0.0}, apex{2.0, 0.5, 0.0};
	side(left, right, 8);
	side(right, apex, 4);
	side(apex, left, 4);
	mesh.positions = outline;
	mesh.positions.push_back({2.0, 0.25, 0.0});
	const int n = static_cast<int>(outline.size());
	for (int i = 0; i < n; ++i)
		mesh.triangles.push_back({i, (i + 1) % n, n});
	Options options = towards(TargetCurvature::Rectangle);
	const FlatResult map = flattened(mesh, options);
	std::vector<double> places; // of the corners along the boundary
	double along = 0.0;
	for (int i = 0; i < n; ++i) {
		if (map.targetCurvature[at(i)] != 0.0)
			places.push_back(along);
		along += distance(outline[at(i)], outline[at((i + 1) % n)]);
	}
	ASSERT_EQ(places.size(), 4u);
	for (std::size_t k = 0; k < 4; ++k) {
		const double next = k < 3 ? places[k + 1] : places[0] + along;
		EXPECT_NEAR(next - places[k], along / 4, std::hypot(2.0, 0.5) / 4 + 1e-12);
	}
}

TEST(Target, SelectedConesShareTheTotalCurvature)
{
	Options options = towards(TargetCurvature::SelectedCones);
	for (const SurfaceMesh& mesh : {perforatedSlab(0, 2), perforatedSlab(2, 2)})
		for (const int n : {3, 5, 8}) {
			std::vector<int> cones;
			for (int i = 0; i < n; ++i)
				cones.push_back(2 * i);
			const FlatResult map = flattened(mesh, options, selecting(mesh, cones));
			const double share = 2 * kPi * map.report.eulerCharacteristic / n;
			for (std::size_t v = 0; v < map.targetCurvature.size(); ++v) {
				const bool isCone = std::count(cones.begin(), cones.end(), static_cast<int>(v)) > 0;
				EXPECT_NEAR(map.targetCurvature[v], isCone ? share : 0.0, 1e-15);
			}
			EXPECT_EQ(map.report.cones, n);
		}
	// Inside a boundary that is free; on one that is prescribed therefore.
	const SurfaceMesh disk = flatDisk();
	const std::vector<int> inside = verticesAt(disk, {{2, 2}, {3, 2}});
	const FlatResult free = onMesh(disk, options, inside);
	EXPECT_NEAR(free.report.boundaryRatioMin.value_or(0), 1.0, 1e-9);
	const std::vector<int> corners = verticesAt(disk, {{0, 0}, {2, 4}, {5, 0}});
	const FlatResult triangle = flattened(disk, options, selecting(disk, corners));
	EXPECT_FALSE(triangle.report.boundaryRatioMin);
	for (const int v : corners)
		EXPECT_NEAR(triangle.targetCurvature[at(v)], 2 * kPi / 3, 1e-15);
	EXPECT_NEAR(sum(triangle.targetCurvature), 2 * kPi, 1e-12);
}

/// What rounding makes of values, of floats here, is spread in proportion to |K|; and is not a cone.
TEST(Target, PrescribedValuesMayBeRounded)
{
	Random random(91);
	const SurfaceMesh mesh = perforatedSlab(2, 2);
	VertexInput input = prescribing(std::vector<double>(mesh.positions.size(), 0.0));
	for (double& K : input.targetCurvature)
		K = random.real(-1, 1);
	const double move =
		(-4 * kPi - sum(input.targetCurvature)) / static_cast<double>(mesh.positions.size());
	for (double& K : input.targetCurvature)
		K = static_cast<double>(static_cast<float>(K + move));
	input.precision = std::numeric_limits<float>::epsilon();
	ASSERT_GT(std::abs(sum(input.targetCurvature) + 4 * kPi), 1e-9); // there is a defect to spread
	const FlatResult map = flattened(mesh, towards(TargetCurvature::Prescribed), input);
	EXPECT_NEAR(sum(map.targetCurvature), -4 * kPi, 1e-12);
	double ratio = 0.0;
	for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
		const double K = input.targetCurvature[v], moved = map.targetCurvature[v] - K;
		ratio = v == 0 ? moved / std::abs(K) : ratio;
		EXPECT_NEAR(moved, ratio * std::abs(K), 1e-14);
	}
	HyperbolicOptions hyperbolic;
	hyperbolic.target = HyperbolicTarget::Prescribed;
	input.targetCurvature.assign(mesh.positions.size(), 1e-7);
	input.targetCurvature[3] = 4.0 * input.precision; // just so
	input.targetCurvature[4] = 1e-5;
	const FlatResult cone = inUnitDisk(mesh, hyperbolic, input);
	for (std::size_t v = 0; v < mesh.positions.size(); ++v)
		EXPECT_EQ(cone.targetCurvature[v], v == 4 ? 1e-5 : 0.0);
}

TEST(HyperbolicTarget, ConesHaveTheAngleAskedFor)
{
	const SurfaceMesh mesh = withoutStars(perforatedSlab(1, 4), {0});
	const std::vector<char> boundary = boundaryOf(mesh);
	const auto outside =
		static_cast<int>(std::find(boundary.begin(), boundary.end(), 1) - boundary.begin());
	const auto inside = static_cast<int>(
		std::find(boundary.rbegin(), boundary.rend(), 0).base() - boundary.begin() - 1);
	HyperbolicOptions options;
	options.target = HyperbolicTarget::SelectedCones;
	options.coneAngle = 2.5;
	const FlatResult map = inUnitDisk(mesh, options, selecting(mesh, {inside, outside}));
	for (int v = 0; v < static_cast<int>(boundary.size()); ++v)
		EXPECT_EQ(
			map.targetCurvature[at(v)],
			v == inside    ? 2 * kPi - 2.5
			: v == outside ? kPi - 2.5
						   : 0.0);
	EXPECT_NEAR(*map.report.hyperbolicArea, 3 * kPi - 5.0 + 2 * kPi, 1e-7);
}

} // namespace
} // namespace ricci::testing
