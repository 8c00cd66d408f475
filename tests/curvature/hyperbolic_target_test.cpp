// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/flipped_flow.h"
#include "support/intrinsic.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/curvature/hyperbolic_target.h>
#include <ricci/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace ricci::testing {
namespace {

Target choose(const SurfaceMesh& mesh, HyperbolicRequest request)
{
	const Triangulation t = glued(mesh);
	request.selected.resize(mesh.positions.size(), 0);
	request.prescribed.resize(mesh.positions.size(), 0.0);
	return chooseHyperbolicTarget(topologyOf(t), request.options, request);
}

HyperbolicRequest cones(const std::vector<Vertex>& vertices, double angle, std::size_t count)
{
	HyperbolicRequest request;
	request.options.target = HyperbolicTarget::SelectedCones;
	request.options.coneAngle = angle;
	request.selected.assign(count, 0);
	for (const Vertex v : vertices)
		request.selected[v] = 1;
	return request;
}

/// The error \p E with which a request is refused, for \p problem and with \p words in its
/// sentence.
template<class E>
E refusal(
	const SurfaceMesh& mesh,
	const HyperbolicRequest& request,
	typename E::Problem problem,
	const std::vector<std::string>& words)
{
	return refusalFor<E>(problem, words, [&] { choose(mesh, request); });
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
	const VertexArray<char> boundary = t.boundaryVertices();
	Vertex inside, outside;
	for (const Vertex v : t.vertices())
		(boundary[v] ? outside : inside) = v;
	const Target target = choose(mesh, cones({inside, outside}, 2.5, mesh.positions.size()));
	for (const Vertex v : t.vertices())
		EXPECT_EQ(
			target.curvature[v],
			v == inside    ? 2 * kPi - 2.5
			: v == outside ? kPi - 2.5
						   : 0.0);
}

TEST(HyperbolicTarget, AFreeBoundaryKeepsItsCirclesAndDoesNotCount)
{
	const SurfaceMesh mesh = withoutStars(perforatedSlab(1, 4), {0});
	const VertexArray<char> boundary = glued(mesh).boundaryVertices();
	HyperbolicRequest request =
		hyperbolicPrescribed(std::vector<double>(mesh.positions.size(), 0.0));
	for (const Vertex v : boundary.indices())
		if (boundary[v])
			request.prescribed[v] = 50.0; // no boundary has that, but nobody asks
	request.options.freeBoundary = true;
	const Target target = choose(mesh, request);
	EXPECT_EQ(target.fixed, boundary);
	EXPECT_EQ(target.curvature, Eigen::VectorXd::Zero(target.curvature.size()));
	EXPECT_EQ(target.notes.size(), 1u);
}

TEST(HyperbolicTarget, RefusesSurfacesWithoutAHyperbolicMetric)
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
		const SurfaceType type = topologyOf(glued(c.mesh)).type;
		const InadmissibleCurvature error = refusal<InadmissibleCurvature>(
			c.mesh,
			hyperbolicMetric(),
			InadmissibleCurvature::HyperbolicSurface,
			{"Euler characteristic " + std::to_string(c.chi), c.name, type.name()});
		EXPECT_EQ(error.surface.genus, type.genus);
		EXPECT_EQ(error.surface.boundaryLoops, type.boundaryLoops);
		EXPECT_EQ(error.surface.eulerCharacteristic(), c.chi);
	}
}

TEST(HyperbolicTarget, RefusesATotalCurvatureThatLeavesNoAreaWithBothNumbers)
{
	const SurfaceMesh sphere = perforatedSlab(0, 2), donut = torus(2, 1, 8, 6);
	const auto expectSum = [](const SurfaceMesh& mesh,
							  const HyperbolicRequest& request,
							  double sum,
							  double bound,
							  const std::vector<std::string>& words) {
		const InadmissibleCurvature error = refusal<InadmissibleCurvature>(
			mesh, request, InadmissibleCurvature::HyperbolicSum, words);
		EXPECT_NEAR(error.value, sum, 1e-13);
		EXPECT_EQ(error.bound, bound);
	};
	// Four cones of angle pi make a flat sphere.
	const std::vector<Vertex> four{Vertex(0), Vertex(5), Vertex(9), Vertex(14)};
	expectSum(
		sphere,
		cones(four, kPi, sphere.positions.size()),
		4 * kPi,
		4 * kPi,
		{"12.5663706", "2 pi chi = 12.5663706", "Gauss-Bonnet"});
	EXPECT_NO_THROW(choose(sphere, cones(four, kPi - 1e-6, sphere.positions.size())));
	expectSum(
		sphere,
		cones({Vertex(0), Vertex(5)}, 0.5, sphere.positions.size()),
		4 * kPi - 1.0,
		4 * kPi,
		{"11.5663706", "12.5663706"});
	// A wide cone on a torus has negative curvature.
	expectSum(
		donut,
		cones({Vertex(3)}, 7.0, donut.positions.size()),
		2 * kPi - 7.0,
		0.0,
		{"-0.716814693", "2 pi chi = 0"});
	std::vector<double> curvature(donut.positions.size(), 0.0);
	curvature[2] = 0.25;
	curvature[7] = -0.75;
	expectSum(donut, hyperbolicPrescribed(curvature), -0.5, 0.0, {"-0.5", "2 pi chi = 0"});
	curvature[7] = -0.25 + 1e-6;
	EXPECT_NO_THROW(choose(donut, hyperbolicPrescribed(curvature)));
}

/// A free boundary can take whatever Gauss-Bonnet leaves, as long as that is less than pi for each
/// of its vertices: the smooth Dirichlet problem has a solution on every surface with boundary.
TEST(HyperbolicTarget, AFreeBoundaryTakesWhatGaussBonnetLeaves)
{
	for (const SurfaceMesh& mesh : {rectangle(3, 3, 1, 1), ring(1, 2, 8, 3)}) {
		const Topology topology = topologyOf(glued(mesh));
		SCOPED_TRACE(topology.type.name());
		EXPECT_EQ(choose(mesh, hyperbolicMetric(true)).fixed, topology.boundary);
		const auto n =
			static_cast<double>(std::count(topology.boundary.begin(), topology.boundary.end(), 1));
		const double bound = 2 * kPi * topology.type.eulerCharacteristic() - kPi * n;
		HyperbolicRequest request =
			hyperbolicPrescribed(std::vector<double>(mesh.positions.size(), 0.0));
		request.options.freeBoundary = true;
		Vertex inside;
		for (const Vertex v : topology.boundary.indices())
			if (!topology.boundary[v])
				inside = v;
		ASSERT_TRUE(inside.isValid());
		request.prescribed[inside] = bound + 1e-6;
		EXPECT_NO_THROW(choose(mesh, request));
		request.prescribed[inside] = bound - 1e-6;
		const InadmissibleCurvature error = refusal<InadmissibleCurvature>(
			mesh, request, InadmissibleCurvature::FreeBoundary, {"free boundary"});
		EXPECT_EQ(error.value, bound - 1e-6);
		EXPECT_NEAR(error.bound, bound, 1e-13 * n);
		EXPECT_EQ(static_cast<double>(error.count), n);
	}
}

TEST(HyperbolicTarget, RefusesCurvatureBeyondTheBoundWithBothNumbers)
{
	const SurfaceMesh mesh = withoutStars(perforatedSlab(2, 3), {0});
	const VertexArray<char> boundary = glued(mesh).boundaryVertices();
	std::vector<double> curvature(mesh.positions.size(), 0.0);
	std::size_t inside = 0, outside = 0;
	for (const Vertex v : boundary.indices())
		(boundary[v] ? outside : inside) = at(v);
	const auto expectBound = [&](InadmissibleCurvature::Problem problem,
								 double value,
								 std::size_t count,
								 const std::vector<std::string>& words) {
		const InadmissibleCurvature error =
			refusal<InadmissibleCurvature>(mesh, hyperbolicPrescribed(curvature), problem, words);
		EXPECT_EQ(error.value, value);
		EXPECT_EQ(
			error.bound, problem == InadmissibleCurvature::TooLargeOnBoundary ? kPi : 2 * kPi);
		EXPECT_EQ(error.count, count);
	};
	curvature[inside] = 6.5;
	expectBound(
		InadmissibleCurvature::TooLargeInside,
		6.5,
		1,
		{"6.5", "interior vertex (1 such)", "2 pi = 6.28318531"});
	curvature[inside] = 2 * kPi; // a cusp is no cone
	expectBound(InadmissibleCurvature::TooLargeInside, 2 * kPi, 1, {});
	curvature[inside] = 2 * kPi * (1 - 1e-15);
	curvature[outside] = kPi * (1 - 1e-15);
	EXPECT_NO_THROW(choose(mesh, hyperbolicPrescribed(curvature)));
	curvature[outside] = kPi;
	expectBound(InadmissibleCurvature::TooLargeOnBoundary, kPi, 1, {});
	curvature[inside] = 6.2;
	curvature[outside] = 3.25;
	expectBound(
		InadmissibleCurvature::TooLargeOnBoundary,
		3.25,
		1,
		{"3.25", "boundary vertex (1 such)", "pi = 3.14159265"});
	curvature[outside] = 3.0;
	EXPECT_NO_THROW(choose(mesh, hyperbolicPrescribed(curvature)));
	// The worst one is named, with how many there are.
	curvature[outside] = 3.5;
	curvature[inside] = 7.5;
	expectBound(InadmissibleCurvature::TooLargeInside, 7.5, 2, {"7.5", "2 such"});
}

TEST(HyperbolicTarget, RefusesConesWithoutSelectionOrAngle)
{
	const SurfaceMesh mesh = perforatedSlab(2, 1);
	const std::size_t n = mesh.positions.size();
	refusal<InvalidOption>(
		mesh,
		cones({}, kPi, n),
		InvalidOption::NothingSelected,
		{"selected vertices", "none is selected"});
	for (double angle :
		 {0.0,
		  -1.0,
		  -kPi / 2,
		  std::numeric_limits<double>::quiet_NaN(),
		  std::numeric_limits<double>::infinity()}) {
		const InvalidOption error = refusal<InvalidOption>(
			mesh,
			cones({Vertex(1)}, angle, n),
			InvalidOption::ConeAngle,
			{"angle", "greater than 0"});
		EXPECT_TRUE(error.value == angle || (std::isnan(error.value) && std::isnan(angle)));
	}
}

TEST(HyperbolicTarget, RefusesValuesThatAreNoNumbers)
{
	const SurfaceMesh mesh = perforatedSlab(2, 1);
	std::vector<double> curvature(mesh.positions.size(), 0.0);
	curvature[3] = std::numeric_limits<double>::quiet_NaN();
	curvature[5] = -std::numeric_limits<double>::infinity();
	const InadmissibleCurvature error = refusal<InadmissibleCurvature>(
		mesh,
		hyperbolicPrescribed(curvature),
		InadmissibleCurvature::NotFinite,
		{"2 vertices", "not a finite number"});
	EXPECT_EQ(error.count, 2u);
}

TEST(HyperbolicTarget, RoundingOfValuesMakesNoCones)
{
	const SurfaceMesh mesh = perforatedSlab(2, 1);
	HyperbolicRequest request =
		hyperbolicPrescribed(std::vector<double>(mesh.positions.size(), 1e-7));
	request.prescribedPrecision = 6e-8; // of floats
	const Target target = choose(mesh, request);
	EXPECT_EQ(target.curvature, Eigen::VectorXd::Zero(target.curvature.size()));
	request.prescribed[Vertex(3)] = kPrescribedRounding * request.prescribedPrecision; // just so
	request.prescribed[Vertex(4)] = 1e-5;
	const Target cone = choose(mesh, request);
	EXPECT_EQ(cone.curvature[Vertex(3)], 0.0);
	EXPECT_EQ(cone.curvature[Vertex(4)], 1e-5);
}

} // namespace
} // namespace ricci::testing
