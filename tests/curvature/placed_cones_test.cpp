// SPDX-License-Identifier: GPL-3.0-or-later
// Cones that are placed so that areas change little.
#include "support/expect.h"
#include "support/front_door.h"
#include "support/random_surface.h"

#include <ricci/parametrize.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <string>

namespace ricci::testing {
namespace {

constexpr double kQuarter = 0.5 * kPi, kMaxCone = 1.5 * kPi;

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
			EXPECT_NEAR(std::remainder(K, kQuarter), 0.0, 1e-12);
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

/// A box is flat but for its eight corners of pi / 2: no area has to change. More cones, or none but for a
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
					EXPECT_NEAR(map.targetCurvature[at(v)], kQuarter, 1e-9);
				}
			}
}

/// Surface of revolution between two poles of rings that are turned by half a step, so that no edge flips.
SurfaceMesh spindle(int rings, int around, const std::function<double(double)>& radius)
{
	SurfaceMesh mesh{{{0.0, 0.0, -1.0}}, {}};
	const auto vertex = [&](int ring, int i) {
		return ring < 1       ? 0
			   : ring > rings ? 1 + rings * around
							  : 1 + (ring - 1) * around + i % around;
	};
	for (int ring = 1; ring <= rings; ++ring)
		for (int i = 0; i < around; ++i) {
			const double z = -std::cos(kPi * ring / (rings + 1));
			const double a = 2 * kPi * (i + 0.5 * ring) / around, r = radius(z);
			mesh.positions.push_back({r * std::cos(a), r * std::sin(a), z});
		}
	mesh.positions.push_back({0.0, 0.0, 1.0});
	for (int ring = 1; ring <= rings; ++ring)
		for (int i = 0; i < around; ++i) {
			mesh.triangles.push_back(
				{vertex(ring, i), vertex(ring - 1, i + 1), vertex(ring, i + 1)});
			mesh.triangles.push_back({vertex(ring, i), vertex(ring, i + 1), vertex(ring + 1, i)});
		}
	return mesh;
}

/// The flow from the mesh's own metric, linearised: L u = k - K, by dense matrices and the paper's formulas.
struct LinearModel
{
	Eigen::MatrixXd laplacian;
	Eigen::VectorXd curvature, area;

	explicit LinearModel(const SurfaceMesh& mesh)
	{
		Circles circles(mesh);
		std::vector<double> u;
		for (auto& radius : circles.radius) {
			radius /= 2; // with flips, so that no circles touch
			u.push_back(static_cast<double>(std::log(radius)));
		}
		const auto n = static_cast<Eigen::Index>(u.size());
		const auto curvatureAt = [&](std::size_t v, double step) {
			std::vector<double> moved = u;
			moved[v] += step;
			Eigen::VectorXd K(n);
			const auto wide = circles.curvatureWith(moved);
			for (Eigen::Index i = 0; i < n; ++i)
				K[i] = static_cast<double>(wide[static_cast<std::size_t>(i)]);
			return K;
		};
		curvature = curvatureAt(0, 0.0);
		laplacian.resize(n, n);
		for (Eigen::Index v = 0; v < n; ++v)
			laplacian.col(v) = (curvatureAt(static_cast<std::size_t>(v), 1e-5) -
								curvatureAt(static_cast<std::size_t>(v), -1e-5)) /
							   2e-5;
		area.setZero(n);
		for (const Triangle& t : mesh.triangles) {
			const Point3& p = mesh.positions[at(t[0])];
			const double a =
				length(cross(mesh.positions[at(t[1])] - p, mesh.positions[at(t[2])] - p));
			for (const int v : t)
				area[v] += a;
		}
		area /= area.sum();
	}

	/// Standard deviation by area of 2 u.
	double distortion(const std::vector<double>& k) const
	{
		const Eigen::Map<const Eigen::VectorXd> wanted(k.data(), curvature.size());
		Eigen::VectorXd u = laplacian.completeOrthogonalDecomposition().solve(wanted - curvature);
		u.array() -= area.dot(u);
		return 2.0 * std::sqrt(area.dot(u.cwiseProduct(u)));
	}
};

TEST(PlacedCones, HaveTheBestCurvaturesOfTheLinearModel)
{
	for (const double waist : {0.0, 0.6}) {
		const SurfaceMesh mesh = spindle(8, 9, [&](double z) {
			return 0.8 * std::sqrt(1 - z * z) * (1 - waist * std::exp(-8 * z * z));
		});
		const LinearModel flow(mesh);
		const FlatResult map = placed(mesh, cones(6));
		const double own = flow.distortion(map.targetCurvature);
		EXPECT_NEAR(map.report.expectedSpread.value_or(0), own, 1e-5 * own);
		EXPECT_GT(own, 0.01);
		for (const int up : map.placedCones)
			for (const int down : map.placedCones) {
				std::vector<double> other = map.targetCurvature;
				other[at(up)] += 0.05;
				other[at(down)] -= 0.05;
				if (up != down && other[at(up)] <= kMaxCone) {
					EXPECT_GT(flow.distortion(other), own);
				}
			}
		// Rounded ones are predicted as well, and no better.
		const FlatResult rounded = placed(mesh, cones(6, 0.0, ConeRounding::QuarterTurns));
		const double after = flow.distortion(rounded.targetCurvature);
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
		const FlatResult map = placed(mesh, cones(0, 0.4));
		EXPECT_LE(map.report.expectedSpread.value_or(1), 0.4001);
		const FlatResult fewer = placed(mesh, cones(count(map) - 1));
		EXPECT_GT(fewer.report.expectedSpread.value_or(0), 0.4);
		placed(mesh, cones(genus == 0 ? 0 : 10, 0.0, ConeRounding::QuarterTurns));
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

/// The linear problem is that of smooth surfaces; the flow's own distortion agrees with it where the mesh
/// resolves the factor. Where it does not, more cones are placed until areas are kept as was asked for.
TEST(PlacedCones, ChangeAreasAsExpected)
{
	Options options = cones(6);
	options.output = OutputTriangulation::CommonRefinement;
	const Report report = placed(slab(0, 8, 0.01, 704), options).report;
	EXPECT_NEAR(report.areaDistortionSpread, *report.expectedSpread, 0.1 * *report.expectedSpread);
	for (const SurfaceMesh& limb :
		 {sphereWithTube(0.25, 3.0, 0.0, 16, 16), sphereWithTube(0.25, 2.0, 0.5, 16, 16)}) {
		int before = 0;
		for (const double distortion : {1.0, 0.5, 0.25}) {
			options.cones = ConeOptions{0, distortion, ConeRounding::Free};
			const FlatResult map = placed(limb, options);
			EXPECT_LE(map.report.areaDistortionSpread, 1.1 * 1.03 * distortion);
			EXPECT_LE(map.report.areaDistortionMean, std::max(2.6, std::exp(distortion)));
			EXPECT_GE(count(map), before);
			before = count(map);
		}
	}
}

} // namespace
} // namespace ricci::testing
