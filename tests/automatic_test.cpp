// SPDX-License-Identifier: GPL-3.0-or-later
// What Automatic chooses: cones or none, how many of them, or the surface unfolded between its creases.
#include "support/expect.h"
#include "support/flat_map.h"
#include "support/listener.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <array>
#include <map>
#include <utility>

namespace ricci::testing {
namespace {

const char* const kRound = "more or other cones are needed";

/// Torus, annulus, disk and sphere that no map without many cones keeps the areas of.
std::vector<std::pair<std::string, SurfaceMesh>> hardSurfaces()
{
	Random random(900);
	std::vector<std::array<double, 2>> vase;
	for (int i = 0; i <= 40; ++i)
		vase.push_back({1.0 - 0.9 * std::sin(kPi * i / 40.0), 4.0 * i / 40.0});
	return {
		{"torus", shaken(torus(1.1, 1.0, 24, 24), 0.004, random)},
		{"annulus", shaken(revolved(vase, 24), 0.004, random)},
		{"disk", shaken(sphereWithTube(0.2, 4.0, 0.4, 16, 16), 0.004, random)},
		{"disk, few triangles around its tube", sphereWithTube(0.02, 3.0, 0.4, 12, 3)},
		{"sphere", shaken(sphereWithTube(0.2, 4.0, 0.0, 16, 16), 0.004, random)},
		{"sphere, few triangles around its tube", sphereWithTube(0.02, 3.0, 0.0, 12, 3)}};
}

/// On the refinement, whose pieces show all of the factor.
Options keeping(double distortion)
{
	Options options;
	options.output = OutputTriangulation::CommonRefinement;
	options.cones.distortion = distortion;
	return options;
}

TEST(KeptAreas, OfLongLimbs)
{
	for (const auto& [name, mesh] : hardSurfaces()) {
		SCOPED_TRACE(name);
		const Report report = run(mesh, keeping(0.25)).report;
		EXPECT_GT(report.cones, 0);
		// A tenth more is let pass; and much more is seen where three triangles go round a tube.
		const bool isCoarse = name.find("few triangles") != std::string::npos;
		EXPECT_LE(report.areaDistortionSpread, isCoarse ? 1.0 : 1.05 * 1.1 * 0.25);
		EXPECT_LE(report.areaDistortionMean, 3.0);
	}
}

TEST(KeptAreas, AreLeftWhereAnyDistortionIsAllowed)
{
	for (const auto& [name, mesh] : hardSurfaces()) {
		SCOPED_TRACE(name);
		Options needed = keeping(0.0);
		needed.cones.onlyWhereNeeded = true;
		needed.holes = Holes::Boundaries; // a capped disk is a sphere
		const bool isSphere = name.rfind("sphere", 0) == 0;
		const Report report = run(mesh, keeping(1e9)).report;
		EXPECT_GT(report.areaDistortionSpread, 1.0);
		EXPECT_LE(report.cones, isSphere ? 3 : 0); // which it has to have
		const Report only = run(mesh, needed).report;
		EXPECT_EQ(only.cones > 0, isSphere);
		EXPECT_FALSE(only.expectedSpread.has_value() && !isSphere); // no search was made
	}
}

TEST(KeptAreas, OfGentleSurfacesNeedNoCones)
{
	const SurfaceMesh terrain = grid(30, 30, Ends::Open, Ends::Open, [&](int i, int j) {
		const double x = i / 30.0, y = j / 30.0;
		return Point3{x, y, 0.05 * std::sin(4 * kPi * x) * std::cos(2 * kPi * y)};
	});
	Options options;
	options.cones.distortion = 1.0;
	for (const SurfaceMesh& mesh : {terrain, torus(3.0, 1.0, 30, 30), ring(1.0, 3.0, 40, 20)}) {
		Listener listener;
		const Report report = withListener(listener, [&] { return run(mesh, options).report; });
		EXPECT_EQ(report.cones, 0);
		EXPECT_LT(report.areaDistortionSpread, 1.0);
		EXPECT_EQ(listener.count("No cones: expected energy"), 1);
		EXPECT_EQ(listener.count(kRound), 0);
	}
}

/// Flows follow each other while areas are not kept and more or other cones help: the best of them is taken.
TEST(KeptAreas, AreThoseOfTheBestFlow)
{
	constexpr double kSlack = 1.1, kMaxMean = 2.6;
	int rounds = 0, inVain = 0, ended = 0;
	for (const double wanted : {0.05, 1e-3})
		for (const ConeRounding rounding : {ConeRounding::Free, ConeRounding::QuarterTurns})
			for (const auto& [name, mesh] : hardSurfaces()) {
				SCOPED_TRACE(name + ", " + std::to_string(wanted));
				if (wanted < 0.01 && (name != "disk" || rounding != ConeRounding::Free))
					continue; // one such search is enough
				Options options = keeping(wanted);
				options.cones.rounding = rounding;
				Listener listener;
				const Report report =
					withListener(listener, [&] { return run(mesh, options).report; });
				const int count = listener.count(kRound);
				EXPECT_LE(count, 6);
				EXPECT_EQ(report.endedEarly, count == 6);
				EXPECT_EQ(listener.count("stopped at its limit of solves"), count == 6);
				rounds += count;
				ended += count == 6;
				const std::vector<FlowState>& states = report.flowStates;
				EXPECT_LE(states.back().step, report.iterations);
				EXPECT_TRUE(std::is_sorted(states.begin(), states.end(), [](auto& a, auto& b) {
					return a.step < b.step;
				}));
				if (count == 0)
					continue;
				// What was said, to three digits.
				const std::string& last = *std::find_if(
					listener.lines.begin(), listener.lines.end(), [](const std::string& line) {
						return line.find("area factor is ") != std::string::npos;
					});
				const double spread = numberAfter(last, "area factor is ");
				EXPECT_LE(numberAfter(last, "or its inverse "), 1.01 * kMaxMean);
				EXPECT_GE(report.areaDistortionSpread, 0.98 * spread);
				double before = 0.0;
				for (const std::string& line : listener.lines) {
					if (line.find(kRound) == std::string::npos)
						continue;
					const double passed = numberAfter(line, "comes out as ");
					EXPECT_TRUE(
						passed > 0.99 * kSlack * wanted ||
						numberAfter(line, "or its inverse as ") > 0.99 * kMaxMean)
						<< "no need for the next flow after: " << line;
					EXPECT_LE(spread, 1.01 * passed);
					before = passed;
				}
				if (spread > 1.01 * kSlack * wanted && count < 6) {
					EXPECT_GT(before, spread) << "one flow in vain is not the end";
					++inVain;
				}
			}
	EXPECT_GT(rounds, 20);
	EXPECT_GE(inVain, 3);
	EXPECT_GE(ended, 2);
}

TEST(KeptAreas, AreNoConcernOfCountedCones)
{
	Options options = keeping(0.0);
	options.target = TargetCurvature::PlacedCones;
	options.cones.count = 3;
	Listener listener;
	const Report report =
		withListener(listener, [&] { return run(hardSurfaces()[4].second, options).report; });
	EXPECT_EQ(report.cones, 3);
	EXPECT_GT(report.areaDistortionSpread, 1.0);
	EXPECT_EQ(listener.count(kRound), 0);
}

TEST(KeptAreas, AreForFlipsAlone)
{
	const SurfaceMesh mesh = sphereWithTube(0.5, 1.0, 0.4, 16, 16);
	for (const Method method :
		 {Method::FixedTriangles, Method::EdgeSwaps, Method::IntrinsicFlips}) {
		Options options;
		options.method = method;
		const bool flips = method == Method::IntrinsicFlips;
		const Report report = run(mesh, options).report;
		EXPECT_EQ(report.cones > 0, flips);
		EXPECT_EQ(report.areaDistortionSpread > 1.0, !flips);
	}
}

/// A thin box of 1 x 3 x 1 / 10.
SurfaceMesh plate()
{
	return stretched(perforatedSlab(0, 4), {1, 1, 0.1});
}

TEST(Automatic, IsReported)
{
	const auto reportFor = [](const SurfaceMesh& mesh) { return run(mesh, Options()).report; };
	const Report flat = reportFor(rectangle(4, 4, 1, 1));
	EXPECT_EQ(flat.targetUsed, TargetUsed::FreeBoundary);
	EXPECT_EQ(flat.choice.rfind("no cones", 0), 0u);
	EXPECT_NEAR(flat.expectedSpread.value(), 0.0, 1e-9);
	const FlatResult closed = run(plate(), Options());
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

/// Rulings of cylinders and prisms come out straight and parallel, those of a cone straight.
TEST(Straight, LinesOfSurfacesThatUnroll)
{
	constexpr int kRows = 10;
	for (const int sides : {5, 24})
		for (const double widening : {0.0, 0.1}) {
			SCOPED_TRACE(std::to_string(sides) + " sides, widening " + std::to_string(widening));
			const SurfaceMesh mesh =
				grid(sides, kRows, Ends::Joined, Ends::Open, [=](int i, int j) -> Point3 {
					const double a = 2 * kPi * i / sides, r = 1.0 + widening * j;
					return {r * std::cos(a), r * std::sin(a), 0.3 * j};
				});
			const FlatResult map = run(mesh, Options());
			expectIsometric(mesh, map.uv, map.report);
			ASSERT_EQ(map.report.charts, 1);
			// Directions of the pieces of each ruling, as the faces on either side of it show them.
			std::map<std::pair<int, bool>, std::vector<Point2>> pieces;
			for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
				for (std::size_t k = 0; k < 3; ++k) {
					const Point3& from = mesh.positions[at(mesh.triangles[f][k])];
					const Point3& to = mesh.positions[at(mesh.triangles[f][(k + 1) % 3])];
					const Point3 along = to - from;
					if (std::abs(from[0] * to[1] - from[1] * to[0]) > 1e-9)
						continue;
					const int ruling = static_cast<int>(
						std::lround(std::atan2(from[1], from[0]) * sides / (2 * kPi)));
					const bool isUp = along[2] > 0.0;
					const Point2 d = map.uv[f][(k + 1) % 3] - map.uv[f][k];
					pieces[{ruling, isUp}].push_back((isUp ? 1.0 : -1.0) / length(d) * d);
				}
			EXPECT_EQ(pieces.size(), at(2 * sides));
			const Point2 first = pieces.begin()->second.front();
			for (const auto& [ruling, directions] : pieces) {
				ASSERT_EQ(directions.size(), at(kRows));
				for (const Point2& d : directions)
					EXPECT_NEAR(cross(d, widening > 0.0 ? directions.front() : first), 0.0, 1e-10);
			}
		}
}

/// A box is its net: of the 12 edges 5 are joined, the longest that make a tree of its faces.
TEST(Unfolded, ABoxIsItsNet)
{
	const SurfaceMesh mesh = plate();
	const FlatResult map = run(mesh, Options());
	expectIsometric(mesh, map.uv, map.report);
	EXPECT_EQ(map.report.charts, 1);
	EXPECT_EQ(map.report.overlappingFaces, 0);
	EXPECT_EQ(map.report.cones, 8);
	EXPECT_NEAR(map.report.seamLength, 4 * 0.1 + 2 * 1.0 + 1 * 3.0, 1e-9);
	// Eight corners of a quarter of 4 pi each, nothing elsewhere.
	double sum = 0.0;
	for (const double k : map.targetCurvature) {
		sum += k;
		EXPECT_NEAR(std::abs(k - 0.25 * kPi), 0.25 * kPi, 1e-9); // 0 or pi / 2
	}
	EXPECT_NEAR(sum, 4.0 * kPi, 1e-9);
	EXPECT_EQ(MapCheck(mesh, map).seamEdges, map.report.seamEdges + map.report.overlapCuts);
}

/// Wall, bottom and lid of a cylinder touch in one edge each then.
TEST(Unfolded, ACylinderIsItsWallWithTwoLids)
{
	constexpr int kSides = 16;
	const SurfaceMesh mesh = revolved({{0.0, 0.0}, {1.0, 0.0}, {1.0, 3.0}, {0.0, 3.0}}, kSides);
	Options options;
	options.charts = Charts::WithoutOverlap;
	const FlatResult map = run(mesh, options);
	EXPECT_EQ(map.report.targetUsed, TargetUsed::Unfolded);
	expectIsometric(mesh, map.uv, map.report);
	EXPECT_EQ(map.report.charts, 1);
	EXPECT_EQ(map.report.overlappingFaces, 0);
	const double side = 2.0 * std::sin(kPi / kSides);
	EXPECT_NEAR(map.report.seamLength, 2.0 * (kSides - 1) * side + 3.0, 1e-9);
}

/// A roof of ten sides, between which the surface bends by less than at a first try, lies flat as well.
TEST(Unfolded, AlongBluntCreasesWhereThatCostsLess)
{
	const SurfaceMesh mesh =
		revolved({{0.0, 0.0}, {0.5, 0.0}, {1.0, 0.0}, {1.0, 0.2}, {0.5, 0.675}, {0.0, 1.15}}, 10);
	const FlatResult map = run(mesh, Options());
	EXPECT_EQ(map.report.targetUsed, TargetUsed::Unfolded);
	expectIsometric(mesh, map.uv, map.report);
}

/// Length of the outline along the axes over that of all of it.
double uprightShare(const FlatMesh& map)
{
	std::map<std::pair<int, int>, Point2> sides;
	for (const int f : map.points.indices())
		for (const Corner c : cornersOf(f))
			sides[{map.points[c], map.points[c.next()]}] = map.at(c.next()) - map.at(c);
	double along = 0.0, whole = 0.0;
	for (const auto& [ends, side] : sides)
		if (sides.count({ends.second, ends.first}) == 0) {
			whole += length(side);
			along += std::min(std::abs(side[0]), std::abs(side[1])) < 1e-6 * length(side)
						 ? length(side)
						 : 0.0;
		}
	return along / whole;
}

TEST(Unfolded, BoxesLieAlongTheAxes)
{
	Random random(20);
	for (int i = 0; i < 20; ++i) {
		const Point3 size{random.real(0.3, 3.0), random.real(0.3, 3.0), random.real(0.3, 3.0)};
		const SurfaceMesh box = turned(
			stretched(perforatedSlab(0, 2), size),
			{random.real(-3, 3), random.real(-3, 3), random.real(-3, 3)});
		EXPECT_NEAR(uprightShare(parametrizeEuclidean(box, {}, {}).mesh), 1.0, 1e-9);
		Options asLaidOut;
		asLaidOut.turns = ChartTurns::None;
		const Parametrization map = parametrizeEuclidean(box, {}, asLaidOut);
		EXPECT_EQ(map.report.flippedFaces + map.report.overlappingFaces, 0);
	}
}

/// Two faces with less than a millionth of the area, which no picture shows, do not decide that a box is not unfolded.
TEST(Unfolded, WhateverNeedlesThereAre)
{
	const SurfaceMesh box = perforatedSlab(0, 3);
	const FlatResult whole = run(box, Options());
	ASSERT_EQ(whole.report.targetUsed, TargetUsed::Unfolded);
	Random random(13);
	for (int round = 0; round < 3; ++round) {
		SurfaceMesh mesh = box;
		for (int i = 0; i < 2; ++i) { // a vertex beside an edge, and the needle between them
			const std::size_t f = at(random.index(static_cast<int>(box.triangles.size())));
			const Triangle t = mesh.triangles[f];
			const Point3 &p = mesh.positions[at(t[0])], &q = mesh.positions[at(t[1])];
			const Point3 middle = 0.5 * (p + q);
			const int n = static_cast<int>(mesh.positions.size());
			mesh.positions.push_back(middle + 4e-6 * (mesh.positions[at(t[2])] - middle));
			mesh.triangles[f] = {t[0], n, t[2]};
			mesh.triangles.push_back({n, t[1], t[2]});
			mesh.triangles.push_back({t[0], t[1], n});
		}
		const FlatResult map = run(mesh, Options());
		EXPECT_EQ(map.report.targetUsed, TargetUsed::Unfolded);
		EXPECT_NEAR(*map.report.objective, *whole.report.objective, 0.1);
	}
}

TEST(Unfolded, AreNoRoundSurfaces)
{
	for (const SurfaceMesh& mesh : {torus(2.0, 1.0, 40, 20), ring(1.0, 2.0, 30, 5)}) {
		const Report report = run(mesh, Options()).report;
		EXPECT_NE(report.targetUsed, TargetUsed::Unfolded);
		EXPECT_EQ(report.choice.find("unfolded"), std::string::npos);
	}
}

/// Of both maps the one that costs less is given back; and none is made as a whole where that is expected to
/// cost more.
TEST(Unfolded, WhatCostsLess)
{
	Options placed;
	placed.target = TargetCurvature::PlacedCones;
	placed.charts = Charts::WithoutOverlap;
	Options automatic = placed;
	automatic.target = TargetCurvature::Automatic;
	Options refined = automatic;
	refined.output = OutputTriangulation::CommonRefinement;
	for (const SurfaceMesh& mesh : {plate(), perforatedSlab(2, 4), perforatedSlab(0, 3)}) {
		const double least = *run(mesh, automatic).report.objective + 1e-9;
		EXPECT_LE(least, *run(mesh, placed).report.objective + 1e-8);
		EXPECT_LE(*run(mesh, refined).report.objective, least); // chosen from the same maps
	}
	const Report handles = run(withoutStars(perforatedSlab(12, 1), {0}), automatic).report;
	EXPECT_EQ(handles.targetUsed, TargetUsed::Unfolded);
	EXPECT_NE(handles.choice.find("; cones are expected to cost more"), std::string::npos);
}

/// With memory for one map at a time they are the same; with less there is none, and the log says so, whichever
/// thread it is found in.
TEST(Unfolded, WhereThereIsMemory)
{
	for (const int subdivision : {2, 12}) {
		const SurfaceMesh mesh = stretched(perforatedSlab(0, subdivision), {1, 1, 0.1});
		const auto within = [&](double bytes, Listener& log) {
			Task task(log);
			task.setMemoryLimit(bytes);
			return run(mesh, Options());
		};
		Listener log;
		const double needed = refusalOf<TooLarge>([&] { within(1000.0, log); }).needed;
		const FlatResult map = within(0.0, log);
		EXPECT_EQ(map.report.targetUsed, TargetUsed::Unfolded);
		EXPECT_EQ(within(2.2 * needed, log).uv, map.uv);
		const char* const words = "There is not enough memory to also unfold";
		EXPECT_EQ(log.count(words), 0);
		EXPECT_NE(within(1.1 * needed, log).report.targetUsed, TargetUsed::Unfolded);
		EXPECT_GT(log.count(words), 0);
	}
}

/// A closed bar of octagonal section: rectangles with small chamfers, of random sizes along it.
SurfaceMesh chamferedBar(int rings, Random& random)
{
	SurfaceMesh bar;
	double along = 0.0;
	for (int r = 0; r < rings; ++r) {
		along += std::pow(10.0, random.real(-2.0, -0.5));
		const double shift = random.real(-0.015, 0.015);
		const double w = std::pow(10.0, random.real(-2.8, -1.7));
		const double h = std::pow(10.0, random.real(-3.0, -2.0));
		const double chamfer = std::min(w, h) / random.real(6.0, 20.0);
		const double y[] = {chamfer - w, w - chamfer, w, w},
					 z[] = {-h, -h, chamfer - h, h - chamfer};
		for (const double side : {1.0, -1.0}) // the second half is the first turned by pi
			for (std::size_t k = 0; k < 4; ++k)
				bar.positions.push_back({along, shift + side * y[k], side * z[k]});
	}
	const int last = 8 * (rings - 1);
	for (int r = 0; r < last; r += 8)
		for (int k = 0; k < 8; ++k) {
			const int a = r + k, b = r + (k + 1) % 8;
			bar.triangles.push_back({a, b + 8, b});
			bar.triangles.push_back({a, a + 8, b + 8});
		}
	for (int k = 1; k < 7; ++k) {
		bar.triangles.push_back({0, k, k + 1});
		bar.triangles.push_back({last, last + k + 1, last + k});
	}
	return bar;
}

/// Where the map of the cones that were expected to cost least is poor, other cones are tried: no number that a caller
/// could have asked for gives a map that costs a third, and so little does Automatic.
TEST(PlacedCones, AreNoneThatACallerWouldKnowToBePoor)
{
	Random random(11);
	for (int i = 0; i < 30; ++i) {
		SCOPED_TRACE(i);
		const SurfaceMesh bar = chamferedBar(4, random);
		const auto objective = [&](const Options& options) {
			return *parametrizeEuclidean(bar, {}, options).report.objective;
		};
		const double automatic = objective({});
		for (const ConeRounding rounding : {ConeRounding::Free, ConeRounding::QuarterTurns}) {
			Options options;
			options.target = TargetCurvature::PlacedCones;
			options.cones.rounding = rounding;
			Options refined = options;
			refined.output = OutputTriangulation::CommonRefinement;
			EXPECT_LE(objective(refined), 3.0 * automatic);
			const double own = objective(options);
			EXPECT_LE(own, 3.0 * automatic);
			for (const double distortion : {0.15, 0.25, 0.5}) {
				options.cones.distortion = distortion;
				EXPECT_LE(own, 3.0 * objective(options)) << distortion;
			}
		}
	}
}

/// Holes that are capped for the flow keep nothing from being unfolded: a cube with holes in its sides.
TEST(Automatic, UnfoldsWithHolesCapped)
{
	const SurfaceMesh whole = perforatedSlab(0, 6);
	std::vector<int>
		inside; // vertices inside of two opposite squares, no mirror images of each other
	for (std::size_t v = 0; v < whole.positions.size(); ++v)
		for (const Point3& p : {Point3{1.0 / 3.0, 1.5, 0.0}, Point3{0.5, 1.0, 1.0}})
			if (distance(whole.positions[v], p) < 1e-9)
				inside.push_back(static_cast<int>(v));
	ASSERT_EQ(inside.size(), 2u);
	const SurfaceMesh cube = withoutStars(whole, inside);
	for (const Holes holes : {Holes::Boundaries, Holes::Capped, Holes::ShortCapped}) {
		Options options;
		options.holes = holes;
		const Report report = parametrizeEuclidean(cube, {}, options).report;
		EXPECT_EQ(report.targetUsed, TargetUsed::Unfolded);
		EXPECT_NEAR(*report.stretch, 4.0, 1e-6);
	}
}

} // namespace
} // namespace ricci::testing
