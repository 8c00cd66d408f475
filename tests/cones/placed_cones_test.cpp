// SPDX-License-Identifier: GPL-3.0-or-later
// Cones that are placed so that areas change little.
#include "linearised.h"
#include "support/expect.h"
#include "support/front_door.h"

#include <ricci/error.h>

#include <cmath>
#include <string>

namespace ricci::testing {
namespace {

constexpr double kMaxCone = 1.5 * kPi;

Options cones(int count, double distortion = 0.0, ConeRounding rounding = ConeRounding::Free)
{
	Options options = towards(TargetCurvature::PlacedCones);
	options.cones.count = count;
	options.cones.distortion = distortion;
	options.cones.rounding = rounding;
	return options;
}

/// The map, whose cones are admissible: inside, with at least a right angle each, and with what Gauss-Bonnet asks
/// for where nothing is free.
FlatResult placed(const SurfaceMesh& mesh, const Options& options)
{
	FlatResult map = flattened(mesh, options);
	const std::vector<char> boundary = boundaryOf(mesh);
	EXPECT_LE(map.report.maxCurvatureError, 1e-8);
	EXPECT_EQ(map.report.cones, static_cast<int>(map.placedCones.size()));
	EXPECT_EQ(map.report.targetUsed, TargetUsed::PlacedCones);
	std::vector<double> others = map.targetCurvature;
	for (const int v : map.placedCones) {
		const double K = map.targetCurvature[at(v)];
		EXPECT_LE(K, kMaxCone + 1e-12);
		EXPECT_NE(K, 0.0);
		EXPECT_FALSE(boundary[at(v)]);
		if (options.cones.rounding == ConeRounding::QuarterTurns) {
			EXPECT_NEAR(std::remainder(K, kQuarterTurn), 0.0, 1e-12);
		}
		others[at(v)] = 0.0;
	}
	for (std::size_t v = 0; v < others.size(); ++v)
		EXPECT_TRUE(boundary[v] || others[v] == 0.0);
	if (map.report.boundaryLoops == 0 || !options.freeBoundary) {
		EXPECT_NEAR(sum(map.targetCurvature), 2 * kPi * map.report.eulerCharacteristic, 1e-9);
	}
	return map;
}

int count(const FlatResult& map)
{
	return static_cast<int>(map.placedCones.size());
}

SurfaceMesh slab(int genus, int subdivision, double noise, std::uint64_t seed = 700)
{
	Random random(seed);
	return shaken(perforatedSlab(genus, subdivision), noise, random);
}

TEST(PlacedCones, AreAdmissibleOnClosedSurfacesOfEveryGenus)
{
	for (int genus = 0; genus <= 3; ++genus)
		for (const ConeRounding rounding : {ConeRounding::Free, ConeRounding::QuarterTurns})
			for (const int most : {0, 4, 9}) {
				SCOPED_TRACE("genus " + std::to_string(genus) + ", " + std::to_string(most));
				const FlatResult map = placed(slab(genus, 3, 0.04), cones(most, 0.0, rounding));
				EXPECT_GE(count(map), genus == 0 ? 3 : 1);
				if (most > 0) {
					EXPECT_LE(count(map), most);
				}
			}
}

/// A box is flat except for its eight corners of pi / 2: no area has to change. More cones, or none except for a
/// distortion, would carry nothing.
TEST(PlacedCones, AreTheCornersOfABox)
{
	for (const int subdivision : {2, 3, 4, 6})
		for (const ConeRounding rounding : {ConeRounding::Free, ConeRounding::QuarterTurns})
			for (const int most : {8, 12, 0}) {
				const SurfaceMesh box = perforatedSlab(0, subdivision);
				const FlatResult map = placed(box, cones(most, most > 0 ? 0.0 : 1e-5, rounding));
				EXPECT_EQ(count(map), 8) << most;
				EXPECT_LT(map.report.expectedSpread.value_or(1), 1e-9);
				EXPECT_LT(map.report.areaDistortionSpread, 1e-6);
				for (const int v : map.placedCones) {
					const Point3& p = box.positions[at(v)];
					EXPECT_TRUE((p[0] == 0 || p[0] == 1) && (p[1] == 0 || p[1] == 3));
					EXPECT_NEAR(map.targetCurvature[at(v)], kQuarterTurn, 1e-9);
				}
			}
}

TEST(PlacedCones, HaveTheBestCurvaturesOfTheLinearModel)
{
	for (const int genus : {0, 2}) {
		const SurfaceMesh mesh = slab(genus, 2, 0.05);
		const DenseFlow flow(Linearised({"", mesh}));
		const auto distortion = [&](const std::vector<double>& k) {
			const VertexVector u =
				flow.factor(Eigen::Map<const Eigen::VectorXd>(k.data(), flow.area.size()));
			return 2.0 * std::sqrt(flow.area.dot(u.cwiseProduct(u)));
		};
		const FlatResult map = placed(mesh, cones(6));
		const double own = distortion(map.targetCurvature);
		EXPECT_NEAR(map.report.expectedSpread.value_or(0), own, 1e-5 * own);
		EXPECT_GT(own, 0.01);
		for (const int up : map.placedCones)
			for (const int down : map.placedCones) {
				std::vector<double> other = map.targetCurvature;
				other[at(up)] += 0.05;
				other[at(down)] -= 0.05;
				if (up != down && other[at(up)] <= kMaxCone) {
					EXPECT_GT(distortion(other), own);
				}
			}
		if (genus > 0)
			continue; // rotations across handles are rounded as well
		// Rounded ones are predicted as well, and no better.
		const FlatResult rounded = placed(mesh, cones(6, 0.0, ConeRounding::QuarterTurns));
		const double after = distortion(rounded.targetCurvature);
		EXPECT_NEAR(rounded.report.expectedSpread.value_or(0), after, 1e-5 * after);
		EXPECT_GT(after, own);
	}
}

TEST(PlacedCones, DoNotDependOnWhatTheFlowRunsOn)
{
	const SurfaceMesh mesh = slab(1, 3, 0.02, 709);
	Options fixed = cones(6);
	fixed.method = Method::FixedTriangles;
	const FlatResult a = placed(mesh, cones(6)), b = placed(mesh, fixed);
	EXPECT_EQ(a.placedCones, b.placedCones);
	EXPECT_EQ(a.targetCurvature, b.targetCurvature);
	EXPECT_EQ(a.report.expectedSpread, b.report.expectedSpread);
}

TEST(PlacedCones, LowerTheDistortionAsTheyAreAdded)
{
	const auto expectFalling = [](const SurfaceMesh& mesh, Options options) {
		double before = HUGE_VAL;
		for (const int most : {3, 6, 12, 24}) {
			options.cones.count = most;
			const double spread = placed(mesh, options).report.expectedSpread.value_or(HUGE_VAL);
			EXPECT_LT(spread, before) << most << " cones";
			before = spread;
		}
	};
	for (int genus = 0; genus <= 2; ++genus)
		expectFalling(slab(genus, 4, 0.05, 702), cones(0));
	for (const SurfaceMesh& mesh :
		 {withoutStars(slab(0, 4, 0.05, 705), {0}), withoutStars(slab(1, 4, 0.05, 705), {0, 40})})
		for (const bool isFree : {true, false}) {
			Options options = cones(0);
			options.freeBoundary = isFree;
			expectFalling(mesh, options);
		}
}

/// A boundary that is not free takes what the cones leave of 2 pi chi in proportion to its length.
TEST(PlacedCones, LeaveTheRestToThePrescribedBoundary)
{
	const SurfaceMesh mesh = withoutStars(slab(1, 4, 0.05, 705), {0, 40});
	Options options = cones(3);
	options.freeBoundary = false;
	const FlatResult map = placed(mesh, options);
	std::vector<double> length(mesh.positions.size(), 0.0);
	std::map<std::pair<int, int>, int> sides;
	for (const Triangle& t : mesh.triangles)
		for (std::size_t k = 0; k < 3; ++k)
			++sides[std::minmax(t[k], t[(k + 1) % 3])];
	for (const auto& [ends, faces] : sides)
		for (const int v : {ends.first, ends.second})
			length[at(v)] +=
				faces > 1
					? 0.0
					: distance(mesh.positions[at(ends.first)], mesh.positions[at(ends.second)]);
	double left = 2 * kPi * map.report.eulerCharacteristic;
	for (const int v : map.placedCones)
		left -= map.targetCurvature[at(v)];
	for (std::size_t v = 0; v < length.size(); ++v)
		if (length[v] > 0.0) {
			EXPECT_NEAR(map.targetCurvature[v], left * length[v] / sum(length), 1e-12);
		}
}

/// What is said of the cones before the flow, without it: their number, the distortion, and what their curvatures,
/// over pi, add up to.
struct Said
{
	int count = 0;
	double distortion = 0.0, total = 0.0;

	Said(const SurfaceMesh& mesh, const Options& options)
	{
		Listener listener(1, "Solving for the metric");
		EXPECT_THROW(withListener(listener, [&] { flattened(mesh, options); }), Cancelled);
		for (const std::string& line : listener.lines) {
			if (line.find(" cones placed: ") == std::string::npos)
				continue;
			count = std::stoi(line);
			distortion = numberAfter(line, "area distortion ");
			for (std::size_t k = line.find("pi):"); (k = line.find('(', k + 1)) != line.npos;) {
				const double K = std::stod(line.substr(k + 1));
				EXPECT_LE(K, 1.5);
				if (options.cones.rounding == ConeRounding::QuarterTurns) {
					EXPECT_EQ(std::remainder(K, 0.5), 0.0);
				}
				total += K;
			}
		}
		EXPECT_GT(count, 0);
	}
};

/// So few that one less would not do; also on surfaces where they are searched for on aggregates of vertices.
TEST(PlacedCones, AreAsManyAsTheDistortionAsksFor)
{
	int before = 0;
	for (const double distortion : {0.8, 0.4, 0.2}) {
		const FlatResult map = placed(slab(1, 4, 0.05, 703), cones(0, distortion));
		EXPECT_LE(map.report.expectedSpread.value_or(1), 1.0001 * distortion);
		EXPECT_GE(count(map), before);
		before = count(map);
	}
	for (const int genus : {0, 1}) {
		const SurfaceMesh mesh = slab(genus, genus == 0 ? 38 : 20, 0.002, 705);
		ASSERT_GT(mesh.positions.size(), genus == 0 ? 20000u : 10000u);
		const Said enough(mesh, cones(0, 0.4));
		EXPECT_LE(enough.distortion, 0.4);
		EXPECT_GE(Said(mesh, cones(enough.count - 1)).distortion, 0.4);
		const ConeRounding quarters = ConeRounding::QuarterTurns;
		for (const Options& options : {cones(0), cones(genus == 0 ? 0 : 10, 0.0, quarters)})
			EXPECT_NEAR(Said(mesh, options).total, 4 * (1 - genus), 1e-7);
	}
}

/// Energy and price of seams that are expected.
double cost(const FlatResult& map)
{
	for (const std::string& note : map.notes)
		if (note.find(" cones placed: ") != std::string::npos)
			return numberAfter(note, "expected energy ") + 0.05 * numberAfter(note, ", seams ");
	ADD_FAILURE() << "nothing is said about cones";
	return 0.0;
}

TEST(PlacedCones, AreAsManyAsLowerEnergyAndPriceOfSeams)
{
	for (int genus = 0; genus <= 2; ++genus) {
		const SurfaceMesh mesh = slab(genus, 4, 0.05, 711);
		const FlatResult best = placed(mesh, cones(0));
		// Half as many have too much energy, twice as many too long seams.
		for (const int other : {std::max(3, count(best) / 2), 2 * count(best)})
			EXPECT_LT(cost(best), cost(placed(mesh, cones(other)))) << genus << ", " << other;
	}
}

/// Those found on aggregates and tidied on the surface cost no more than those of a coarser mesh that is searched whole.
TEST(PlacedCones, CostTheSameOnFinerMeshes)
{
	const auto costOfSlab = [](int n) { return cost(placed(slab(1, n, 0.2 / n, 711), cones(0))); };
	const double whole = costOfSlab(12);
	for (const int n : {14, 16, 20})
		EXPECT_LT(costOfSlab(n), whole + 0.01) << n;
}

/// The linear problem is that of smooth surfaces; the flow's own distortion agrees with it where the mesh
/// resolves the factor.
/// The tip of a spire has more curvature than a cone gets elsewhere. With all of it the sides are a sector.
TEST(PlacedCones, KeepTheTipOfASpire)
{
	const int sides = 24;
	for (const double height : {4.0, 10.0, 50.0}) {
		SurfaceMesh spire;
		spire.positions.push_back({0, 0, height});
		for (int i = 0; i < sides; ++i) {
			const double angle = 2 * kPi * i / sides;
			spire.positions.push_back({std::cos(angle), std::sin(angle), 0});
			spire.triangles.push_back({0, 1 + i, 1 + (i + 1) % sides});
		}
		const Report report = parametrizeEuclidean(spire, {}, {}).report;
		EXPECT_EQ(report.cones, 1);
		EXPECT_NEAR(report.stretch.value_or(0.0), 4.0, 1e-9);
	}
}

TEST(PlacedCones, ChangeAreasAsExpected)
{
	Options options = cones(6);
	options.output = OutputTriangulation::CommonRefinement;
	const Report report = placed(slab(0, 8, 0.01, 704), options).report;
	EXPECT_NEAR(report.areaDistortionSpread, *report.expectedSpread, 0.1 * *report.expectedSpread);
}

} // namespace
} // namespace ricci::testing
