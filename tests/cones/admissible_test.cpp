// SPDX-License-Identifier: GPL-3.0-or-later
// Curvatures that no metric has, at the bound, and just below it some that one has. refusals_test.cpp has what else
// is refused.
#include "support/expect.h"
#include "support/front_door.h"

#include <ricci/error.h>

#include <gtest/gtest.h>

namespace ricci::testing {
namespace {

using Problem = InadmissibleCurvature::Problem;

/// One mesh, and the curvatures that are prescribed.
struct Asked
{
	SurfaceMesh mesh;
	bool isHyperbolic = false, isFree = false;
	std::vector<double> curvature = std::vector<double>(mesh.positions.size(), 0.0);

	std::vector<char> boundary() const { return boundaryOf(mesh); }
	/// A vertex on the boundary, or inside.
	std::size_t vertex(bool isOnBoundary, std::size_t number = 0) const
	{
		std::vector<std::size_t> found;
		for (std::size_t v = 0; v < boundary().size(); ++v)
			if ((boundary()[v] != 0) == isOnBoundary)
				found.push_back(v);
		return found[number % found.size()];
	}

	FlatResult map() const
	{
		if (isHyperbolic) {
			HyperbolicOptions options;
			options.target = HyperbolicTarget::Prescribed;
			options.freeBoundary = isFree;
			return inUnitDisk(mesh, options, prescribing(curvature));
		}
		Options options = towards(TargetCurvature::Prescribed);
		options.freeBoundary = isFree;
		return flattened(mesh, options, prescribing(curvature));
	}
};

void expectRefused(
	const Asked& asked, Problem problem, double value, double bound, std::size_t count = 0)
{
	const auto error = refusalOf<InadmissibleCurvature>([&] { asked.map(); });
	EXPECT_EQ(error.problem, problem) << error.what();
	EXPECT_NEAR(error.value, value, 1e-11);
	EXPECT_NEAR(error.bound, bound, 1e-11);
	EXPECT_EQ(error.count, count);
	EXPECT_NE(std::string(error.what()), "");
}

void expectAccepted(const Asked& asked)
{
	EXPECT_TRUE(reachesTheFlow([&] { return asked.map(); }));
}

/// Below 2 pi inside and pi on the boundary; the worst one is named, with how many there are.
TEST(Admissible, CurvatureOfOneVertexIsBounded)
{
	for (const bool isHyperbolic : {false, true}) {
		Asked asked{withoutStars(perforatedSlab(2, 2), {0}), isHyperbolic};
		const double rest = isHyperbolic ? 0.0 : -6 * kPi; // a sum is prescribed in the plane
		const std::size_t inside = asked.vertex(false), outside = asked.vertex(true);
		const std::size_t other = asked.vertex(false, 40);
		const auto set = [&](double in, double out) {
			asked.curvature[inside] = in;
			asked.curvature[outside] = out;
			asked.curvature[other] = rest == 0.0 ? 0.0 : rest - in - out;
		};
		set(2 * kPi, 0.0);
		expectRefused(asked, InadmissibleCurvature::TooLargeInside, 2 * kPi, 2 * kPi, 1);
		set(0.0, kPi);
		expectRefused(asked, InadmissibleCurvature::TooLargeOnBoundary, kPi, kPi, 1);
		set(6.2, 3.25);
		expectRefused(asked, InadmissibleCurvature::TooLargeOnBoundary, 3.25, kPi, 1);
		set(7.5, 3.5);
		expectRefused(asked, InadmissibleCurvature::TooLargeInside, 7.5, 2 * kPi, 2);
		set(2 * kPi - 0.01, kPi - 0.01);
		expectAccepted(asked);
	}
}

/// In the hyperbolic plane the sum is more than 2 pi chi: area is left.
TEST(Admissible, HyperbolicMetricsObeyGaussBonnet)
{
	// Four cones of angle pi make a flat sphere.
	Asked sphere{perforatedSlab(0, 2), true};
	for (const std::size_t v : {0u, 5u, 9u, 14u})
		sphere.curvature[v] = kPi;
	expectRefused(sphere, InadmissibleCurvature::HyperbolicSum, 4 * kPi, 4 * kPi);
	sphere.curvature[5] += 1e-3;
	expectAccepted(sphere);
	// A wide cone on a torus has negative curvature.
	Asked donut{torus(2, 1, 8, 6), true};
	donut.curvature[2] = 0.25;
	donut.curvature[7] = -0.25 + 1e-3;
	expectAccepted(donut);
}

/// A free boundary can take whatever Gauss-Bonnet leaves, as long as that is less than pi for each
/// of its vertices: the smooth Dirichlet problem has a solution on every surface with boundary. Values on it
/// are not read.
TEST(Admissible, AFreeBoundaryTakesWhatGaussBonnetLeaves)
{
	for (const bool isHyperbolic : {false, true})
		for (const SurfaceMesh& mesh : {rectangle(5, 4, 5, 4), ring(1, 2, 8, 3)}) {
			Asked asked{mesh, isHyperbolic, true};
			const std::vector<char> boundary = asked.boundary();
			const auto n = static_cast<double>(std::count(boundary.begin(), boundary.end(), 1));
			const double bound =
				(boundary == boundaryOf(rectangle(5, 4, 5, 4)) ? 2 * kPi : 0.0) - kPi * n;
			const std::size_t inside = asked.vertex(false, 5);
			for (std::size_t v = 0; v < boundary.size(); ++v)
				asked.curvature[v] = boundary[v] ? 50.0 : 0.0;
			expectAccepted(asked);
			for (const double less : {0.0, 1e-6}) {
				asked.curvature[inside] = bound - less;
				expectRefused(
					asked,
					InadmissibleCurvature::FreeBoundary,
					bound - less,
					bound,
					static_cast<std::size_t>(n));
			}
			asked.curvature[inside] = bound + 1e-6;
			if (isHyperbolic) { // in the plane, scales are too far apart
				expectAccepted(asked);
			}
		}
}

/// But no coordinates hold what much curvature inside makes of lengths.
TEST(Admissible, ScalesAreNotTooFarApart)
{
	Asked asked{rectangle(40, 40, 1, 1), false, true};
	asked.curvature.assign(asked.curvature.size(), 1e-3);
	expectAccepted(asked);
	asked.curvature.assign(asked.curvature.size(), 1.0);
	const auto error = refusalOf<InadmissibleCurvature>([&] { asked.map(); });
	EXPECT_EQ(error.problem, InadmissibleCurvature::ScalesApart);
	// u = (1 - r^2) / 4 per unit of curvature in a round disk; the density is 1600.
	EXPECT_GT(error.value, 0.25 * 1600 * 0.25 / std::log(10.0));
	EXPECT_LT(error.value, 0.25 * 1600 * 0.5 / std::log(10.0));
	EXPECT_GT(error.value, error.bound);
}

} // namespace
} // namespace ricci::testing
