// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/flipped_flow.h"
#include "support/intrinsic.h"
#include "support/shapes.h"

#include <ricci/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace ricci::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;

Target choose(const SurfaceMesh& mesh, HyperbolicRequest request)
{
	const Triangulation t = glued(mesh);
	request.selected.resize(mesh.positions.size(), 0);
	request.prescribed.resize(mesh.positions.size(), 0.0);
	return chooseHyperbolicTarget(topologyOf(t), t.vertexCount(), request);
}

HyperbolicRequest cones(const std::vector<int>& vertices, double angle, std::size_t count)
{
	HyperbolicRequest request;
	request.mode = HyperbolicTarget::SelectedCones;
	request.coneAngle = angle;
	request.selected.assign(count, 0);
	for (int v : vertices)
		request.selected[at(v)] = 1;
	return request;
}

/// The sentence with which a request is refused by an \p E; empty if it is not.
template<class E>
std::string refusal(const SurfaceMesh& mesh, const HyperbolicRequest& request)
{
	return sentenceOf<E>([&] { choose(mesh, request); });
}

TEST(HyperbolicTarget, AHyperbolicMetricHasNoCurvature)
{
	for (const SurfaceMesh& mesh :
		 {perforatedSlab(2, 1),
		  withoutStars(perforatedSlab(1, 3), {0}),
		  withoutStars(perforatedSlab(0, 4), {0, 30, 60})}) {
		const Target target = choose(mesh, hyperbolicMetric());
		EXPECT_EQ(target.curvature, Eigen::VectorXd::Zero(target.curvature.size()));
		for (char fixed : target.fixed)
			EXPECT_EQ(fixed, 0);
	}
}

TEST(HyperbolicTarget, ConesHaveTheAngleAskedFor)
{
	const SurfaceMesh mesh = withoutStars(perforatedSlab(1, 4), {0});
	const Triangulation t = glued(mesh);
	const std::vector<char> boundary = t.boundaryVertices();
	int inside = -1, outside = -1;
	for (int v = 0; v < t.vertexCount(); ++v)
		(boundary[at(v)] ? outside : inside) = v;
	const Target target = choose(mesh, cones({inside, outside}, 2.5, mesh.positions.size()));
	for (int v = 0; v < t.vertexCount(); ++v)
		EXPECT_EQ(
			target.curvature[v],
			v == inside    ? 2 * kPi - 2.5
			: v == outside ? kPi - 2.5
						   : 0.0);
}

TEST(HyperbolicTarget, AFreeBoundaryKeepsItsCirclesAndDoesNotCount)
{
	const SurfaceMesh mesh = withoutStars(perforatedSlab(1, 4), {0});
	const std::vector<char> boundary = glued(mesh).boundaryVertices();
	HyperbolicRequest request =
		hyperbolicPrescribed(std::vector<double>(mesh.positions.size(), 0.0));
	for (std::size_t v = 0; v < boundary.size(); ++v)
		if (boundary[v])
			request.prescribed[v] = 50.0; // no boundary has that, but nobody asks
	request.freeBoundary = true;
	const Target target = choose(mesh, request);
	EXPECT_EQ(target.fixed, boundary);
	EXPECT_EQ(target.curvature, Eigen::VectorXd::Zero(target.curvature.size()));
	EXPECT_EQ(target.notes.size(), 1u);
}

TEST(HyperbolicTarget, RefusesSurfacesWithoutAHyperbolicMetricAndPointsToTheOtherFilter)
{
	const struct
	{
		SurfaceMesh mesh;
		const char* name;
		int chi;
	} cases[] = {
		{tetrahedron(), "a closed surface of genus 0", 2},
		{torus(2, 1, 8, 6), "a closed surface of genus 1", 0},
		{rectangle(3, 3, 1, 1), "a disk", 1},
		{ring(1, 2, 8, 3), "an annulus", 0}};
	for (const auto& c : cases) {
		const std::string sentence = refusal<InadmissibleCurvature>(c.mesh, hyperbolicMetric());
		expectWords(
			sentence,
			{"Euler characteristic " + std::to_string(c.chi),
			 topologyOf(glued(c.mesh)).name(),
			 "Generalized Ricci Flow (Euclidean)",
			 "Cones at selected vertices"});
	}
}

TEST(HyperbolicTarget, RefusesATotalCurvatureThatLeavesNoAreaWithBothNumbers)
{
	const SurfaceMesh sphere = perforatedSlab(0, 2), donut = torus(2, 1, 8, 6);
	// Four cones of angle pi make a flat sphere.
	expectWords(
		refusal<InadmissibleCurvature>(sphere, cones({0, 5, 9, 14}, kPi, sphere.positions.size())),
		{"12.5663706", "2 pi chi = 12.5663706", "Gauss-Bonnet"});
	EXPECT_NO_THROW(choose(sphere, cones({0, 5, 9, 14}, kPi - 1e-6, sphere.positions.size())));
	expectWords(
		refusal<InadmissibleCurvature>(sphere, cones({0, 5}, 0.5, sphere.positions.size())),
		{"11.5663706", "12.5663706"});
	// A wide cone on a torus has negative curvature.
	expectWords(
		refusal<InadmissibleCurvature>(donut, cones({3}, 7.0, donut.positions.size())),
		{"-0.716814693", "2 pi chi = 0", "Euclidean"});
	std::vector<double> curvature(donut.positions.size(), 0.0);
	curvature[2] = 0.25;
	curvature[7] = -0.75;
	expectWords(
		refusal<InadmissibleCurvature>(donut, hyperbolicPrescribed(curvature)),
		{"-0.5", "2 pi chi = 0"});
	curvature[7] = -0.25 + 1e-6;
	EXPECT_NO_THROW(choose(donut, hyperbolicPrescribed(curvature)));
}

TEST(HyperbolicTarget, RefusesCurvatureBeyondTheBoundWithBothNumbers)
{
	const SurfaceMesh mesh = withoutStars(perforatedSlab(2, 3), {0});
	const std::vector<char> boundary = glued(mesh).boundaryVertices();
	std::vector<double> curvature(mesh.positions.size(), 0.0);
	std::size_t inside = 0, outside = 0;
	for (std::size_t v = 0; v < boundary.size(); ++v)
		(boundary[v] ? outside : inside) = v;
	curvature[inside] = 6.5;
	expectWords(
		refusal<InadmissibleCurvature>(mesh, hyperbolicPrescribed(curvature)),
		{"6.5", "interior vertex (1 such)", "2 pi = 6.28318531"});
	curvature[inside] = 2 * kPi; // a cusp is no cone
	EXPECT_NE(refusal<InadmissibleCurvature>(mesh, hyperbolicPrescribed(curvature)), "");
	curvature[inside] = 6.2;
	curvature[outside] = 3.25;
	expectWords(
		refusal<InadmissibleCurvature>(mesh, hyperbolicPrescribed(curvature)),
		{"3.25", "boundary vertex (1 such)", "pi = 3.14159265"});
	curvature[outside] = 3.0;
	EXPECT_NO_THROW(choose(mesh, hyperbolicPrescribed(curvature)));
	// The worst one is named, with how many there are.
	curvature[outside] = 3.5;
	curvature[inside] = 7.5;
	expectWords(
		refusal<InadmissibleCurvature>(mesh, hyperbolicPrescribed(curvature)), {"7.5", "2 such"});
}

TEST(HyperbolicTarget, RefusesConesWithoutSelectionOrAngle)
{
	const SurfaceMesh mesh = perforatedSlab(2, 1);
	const std::size_t n = mesh.positions.size();
	expectWords(
		refusal<InvalidOption>(mesh, cones({}, kPi, n)), {"selected vertices", "none is selected"});
	for (double angle :
		 {0.0,
		  -1.0,
		  std::numeric_limits<double>::quiet_NaN(),
		  std::numeric_limits<double>::infinity()})
		expectWords(
			refusal<InvalidOption>(mesh, cones({1}, angle, n)), {"cone_angle", "0 degrees"});
	expectWords(refusal<InvalidOption>(mesh, cones({1}, -kPi / 2, n)), {"-90"});
}

TEST(HyperbolicTarget, RefusesQualitiesThatAreNoNumbers)
{
	const SurfaceMesh mesh = perforatedSlab(2, 1);
	std::vector<double> curvature(mesh.positions.size(), 0.0);
	curvature[3] = std::numeric_limits<double>::quiet_NaN();
	curvature[5] = -std::numeric_limits<double>::infinity();
	expectWords(
		refusal<InadmissibleCurvature>(mesh, hyperbolicPrescribed(curvature)),
		{"2 vertices", "not a finite number"});
}

TEST(HyperbolicTarget, RoundingOfQualitiesMakesNoCones)
{
	const SurfaceMesh mesh = perforatedSlab(2, 1);
	HyperbolicRequest request =
		hyperbolicPrescribed(std::vector<double>(mesh.positions.size(), 1e-7));
	request.prescribedPrecision = 6e-8; // of floats
	const Target target = choose(mesh, request);
	EXPECT_EQ(target.curvature, Eigen::VectorXd::Zero(target.curvature.size()));
	request.prescribed[4] = 1e-5;
	EXPECT_EQ(choose(mesh, request).curvature[4], 1e-5);
}

} // namespace
} // namespace ricci::testing
