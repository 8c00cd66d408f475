// SPDX-License-Identifier: GPL-3.0-or-later
// Curvatures that no metric has, up to the bound, and just below it some that one has.
#include "support/expect.h"
#include "support/front_door.h"

#include <ricci/error.h>
#include <ricci/parametrize.h>

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace ricci::testing {
namespace {

using Problem = InadmissibleCurvature::Problem;

/// One mesh, one target of each flow, and curvatures.
struct Asked
{
	SurfaceMesh mesh;
	bool isHyperbolic = false, isFree = false;
	TargetCurvature target = TargetCurvature::Prescribed;
	HyperbolicTarget inDisk = HyperbolicTarget::Prescribed;
	std::vector<double> curvature = std::vector<double>(mesh.positions.size(), 0.0);
	std::vector<int> selected = {};
	double coneAngle = kPi;

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
		VertexInput input = selecting(mesh, selected);
		input.targetCurvature = curvature;
		if (isHyperbolic) {
			HyperbolicOptions options;
			options.target = inDisk;
			options.coneAngle = coneAngle;
			options.freeBoundary = isFree;
			return inUnitDisk(mesh, options, input);
		}
		Options options = towards(target);
		options.freeBoundary = isFree;
		return flattened(mesh, options, input);
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

SurfaceMesh flatDisk()
{
	return rectangle(5, 4, 5, 4);
}

/// Below 2 pi inside and pi on the boundary; the worst one is named, with how many there are. A cusp is no cone.
TEST(Admissible, CurvatureOfOneVertexIsBounded)
{
	for (const bool isHyperbolic : {false, true}) {
		Asked asked{withoutStars(perforatedSlab(2, 3), {0}), isHyperbolic};
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
		for (const double none : {std::nan(""), -HUGE_VAL}) {
			asked.curvature[inside] = asked.curvature[outside] = none;
			expectRefused(asked, InadmissibleCurvature::NotFinite, 0.0, 0.0, 2);
		}
	}
}

/// Equal shares at selected vertices are bounded alike.
TEST(Admissible, SelectedConesAreNotTooFew)
{
	Asked asked{perforatedSlab(0, 2)};
	asked.target = TargetCurvature::SelectedCones;
	asked.selected = {0};
	expectRefused(asked, InadmissibleCurvature::TooLargeInside, 4 * kPi, 2 * kPi, 1);
	asked.selected = {0, 3};
	expectRefused(asked, InadmissibleCurvature::TooLargeInside, 2 * kPi, 2 * kPi, 2);
	asked.selected = {0, 3, 7};
	expectAccepted(asked);
	Asked disk{flatDisk()};
	disk.target = TargetCurvature::SelectedCones;
	disk.selected = {0, 29};
	expectRefused(disk, InadmissibleCurvature::TooLargeOnBoundary, kPi, kPi, 2);
}

/// In the plane the sum is 2 pi chi.
TEST(Admissible, FlatMetricsObeyGaussBonnet)
{
	const struct
	{
		SurfaceMesh mesh;
		double total;
	} cases[] = {
		{perforatedSlab(0, 2), 4 * kPi}, {perforatedSlab(2, 1), -4 * kPi}, {flatDisk(), 2 * kPi}};
	for (const auto& c : cases) {
		Asked asked{c.mesh};
		expectRefused(asked, InadmissibleCurvature::GaussBonnet, 0.0, c.total);
		asked.curvature.assign(asked.curvature.size(), c.total / double(asked.curvature.size()));
		expectAccepted(asked);
		asked.curvature[0] += 0.01;
		expectRefused(asked, InadmissibleCurvature::GaussBonnet, c.total + 0.01, c.total);
		asked.target = TargetCurvature::Flat;
		expectRefused(asked, InadmissibleCurvature::Flat, 0.0, c.total);
	}
}

/// In the hyperbolic plane it is larger: area is left.
TEST(Admissible, HyperbolicMetricsObeyGaussBonnet)
{
	const struct
	{
		SurfaceMesh mesh;
		int chi;
	} cases[] = {
		{tetrahedron(), 2},
		{torus(2, 1, 8, 6), 0},
		{rectangle(3, 3, 1, 1), 1},
		{ring(1, 2, 8, 3), 0}};
	for (const auto& c : cases) {
		Asked asked{c.mesh, true};
		asked.inDisk = HyperbolicTarget::HyperbolicMetric;
		expectRefused(asked, InadmissibleCurvature::HyperbolicSurface, 0.0, 2 * kPi * c.chi);
		const auto error = refusalOf<InadmissibleCurvature>([&] { asked.map(); });
		EXPECT_EQ(error.surface.eulerCharacteristic(), c.chi);
	}
	// Four cones of angle pi make a flat sphere.
	Asked sphere{perforatedSlab(0, 2), true};
	sphere.inDisk = HyperbolicTarget::SelectedCones;
	sphere.selected = {0, 5, 9, 14};
	expectRefused(sphere, InadmissibleCurvature::HyperbolicSum, 4 * kPi, 4 * kPi);
	sphere.coneAngle = kPi - 1e-3;
	expectAccepted(sphere);
	sphere.selected = {0, 5};
	sphere.coneAngle = 0.5;
	expectRefused(sphere, InadmissibleCurvature::HyperbolicSum, 4 * kPi - 1.0, 4 * kPi);
	// A wide cone on a torus has negative curvature.
	Asked donut{torus(2, 1, 8, 6), true};
	donut.curvature[2] = 0.25;
	donut.curvature[7] = -0.75;
	expectRefused(donut, InadmissibleCurvature::HyperbolicSum, -0.5, 0.0);
	donut.curvature[7] = -0.25 + 1e-3;
	expectAccepted(donut);
	donut.inDisk = HyperbolicTarget::SelectedCones;
	donut.selected = {3};
	donut.coneAngle = 7.0;
	expectRefused(donut, InadmissibleCurvature::HyperbolicSum, 2 * kPi - 7.0, 0.0);
}

/// A free boundary can take whatever Gauss-Bonnet leaves, as long as that is less than pi for each
/// of its vertices: the smooth Dirichlet problem has a solution on every surface with boundary. Values on it
/// are not read.
TEST(Admissible, AFreeBoundaryTakesWhatGaussBonnetLeaves)
{
	for (const bool isHyperbolic : {false, true})
		for (const SurfaceMesh& mesh : {flatDisk(), ring(1, 2, 8, 3)}) {
			Asked asked{mesh, isHyperbolic, true};
			const std::vector<char> boundary = asked.boundary();
			const auto n = static_cast<double>(std::count(boundary.begin(), boundary.end(), 1));
			const double bound = (boundary == boundaryOf(flatDisk()) ? 2 * kPi : 0.0) - kPi * n;
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

/// Options that contradict the surface, with how many there are and would have to be.
TEST(Admissible, TargetsFitTheSurface)
{
	const auto expectInvalid = [](const Asked& asked,
								  InvalidOption::Problem problem,
								  std::size_t count) {
		const auto error = refusalOf<InvalidOption>([&] { asked.map(); });
		EXPECT_EQ(error.problem, problem) << error.what();
		EXPECT_EQ(error.count, count);
		EXPECT_EQ(error.target, problem == InvalidOption::NotADisk ? asked.target : error.target);
	};
	for (const TargetCurvature target : {TargetCurvature::Disk, TargetCurvature::Rectangle})
		for (const SurfaceMesh& mesh :
			 {ring(1, 2, 9, 3), torus(3, 1, 9, 7), perforatedSlab(0, 2)}) {
			Asked asked{mesh, false, true, target};
			expectInvalid(asked, InvalidOption::NotADisk, 0);
		}
	Asked asked{flatDisk(), false, true, TargetCurvature::Rectangle};
	asked.selected = {0, 4, 29};
	expectInvalid(asked, InvalidOption::CornerCount, 3);
	asked.selected = {0, 4, 29, 25, 12};
	expectInvalid(asked, InvalidOption::CornerCount, 5);
	asked.selected = {0, 4, 29, 12};
	expectInvalid(asked, InvalidOption::CornersOffBoundary, 3);
	asked.target = TargetCurvature::SelectedCones;
	asked.selected = {};
	expectInvalid(asked, InvalidOption::NothingSelected, 0);
	Asked triangle{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}};
	triangle.target = TargetCurvature::Rectangle;
	expectInvalid(triangle, InvalidOption::TooFewBoundaryVertices, 3);
	// Two cones below 2 pi cannot carry the 4 pi of a sphere.
	Options cones = towards(TargetCurvature::PlacedCones);
	const auto expectCones = [&](const SurfaceMesh& mesh, int count) {
		cones.cones.count = count;
		return refusalOf<InvalidOption>([&] { flattened(mesh, cones); });
	};
	const InvalidOption few = expectCones(perforatedSlab(0, 2), 2);
	EXPECT_EQ(few.problem, InvalidOption::TooFewCones);
	EXPECT_EQ(few.value, 2.0);
	EXPECT_EQ(few.bound, 3.0);
	const InvalidOption many = expectCones(tetrahedron(), 5);
	EXPECT_EQ(many.problem, InvalidOption::TooFewVertices);
	EXPECT_EQ(many.value, 5.0);
	EXPECT_EQ(many.count, 4u);
}

} // namespace
} // namespace ricci::testing
