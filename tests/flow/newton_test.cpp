// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/flow/newton.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

using Map = GeometricCurvatureMap<Euclidean>;

const auto silent = [](int, double) {};

std::vector<char> nothingFixed(const Packed& mesh)
{
	return std::vector<char>(mesh.radii.size(), 0);
}

/// A target with the total curvature of the surface, not far from its own.
Eigen::VectorXd smoothedCurvature(const Packed& mesh)
{
	Map map = mesh.map();
	map.evaluate(mesh.u());
	const double mean = map.curvature().sum() / static_cast<double>(map.curvature().size());
	return 0.5 * map.curvature().array() + 0.5 * mean;
}

struct Solved
{
	NewtonResult result;
	Eigen::VectorXd u, rest;
};

Solved solve(
	const Packed& mesh,
	const Eigen::VectorXd& target,
	Eigen::VectorXd start,
	std::vector<char> fixed,
	NewtonOptions options = {})
{
	Map map = mesh.map();
	NewtonSolver solver(map, std::move(fixed));
	Solved solved;
	solved.result = solver.solve(start, target, options, silent);
	solved.u = start;
	solved.rest = solver.rest();
	return solved;
}

/// Distance of the doubles round 2 pi, at which angle sums are kept.
constexpr double kLastPlace = 4 * std::numeric_limits<double>::epsilon();

/// max |target - K| by a map of its own.
double residualAt(
	const Packed& mesh,
	const Solved& solved,
	const Eigen::VectorXd& target,
	const std::vector<char>& fixed)
{
	Map map = mesh.map();
	map.evaluate(solved.u, solved.rest);
	double largest = 0.0;
	for (Eigen::Index v = 0; v < target.size(); ++v)
		if (!fixed[static_cast<std::size_t>(v)])
			largest = std::max(largest, std::abs(target[v] - map.curvature()[v]));
	return largest;
}

TEST(Newton, ReachesTheTargetAndReportsTheTrueResidual)
{
	Random random(70);
	for (const SurfaceMesh& surface :
		 {tetrahedron(), bumpyTorus(16, 10, random), perforatedSlab(2, 3)}) {
		const Packed mesh(surface);
		const Eigen::VectorXd target = smoothedCurvature(mesh);
		const Solved solved = solve(mesh, target, mesh.u(), nothingFixed(mesh));
		EXPECT_TRUE(solved.result.converged);
		EXPECT_LT(solved.result.residual, 1e-8);
		EXPECT_NEAR(
			solved.result.residual,
			residualAt(mesh, solved, target, nothingFixed(mesh)),
			kLastPlace);
	}
}

TEST(Newton, SolutionIsUniqueUpToScale)
{
	Random random(71);
	const Packed mesh(bumpyTorus(16, 10, random));
	const Eigen::VectorXd target = smoothedCurvature(mesh);
	NewtonOptions options;
	options.epsilon = 1e-12;
	const Solved reference = solve(mesh, target, mesh.u(), nothingFixed(mesh), options);
	ASSERT_TRUE(reference.result.converged);
	for (int trial = 0; trial < 10; ++trial) {
		Eigen::VectorXd start = mesh.u();
		for (double& x : start)
			x += random.real(-1.5, 1.5);
		Map map = mesh.map();
		map.evaluate(start);
		EXPECT_GT(map.brokenTriangles(), 0); // far from the start: outside the space of metrics
		const Solved solved = solve(mesh, target, start, nothingFixed(mesh), options);
		ASSERT_TRUE(solved.result.converged) << "trial " << trial;
		Eigen::VectorXd difference = solved.u - reference.u;
		difference.array() -= difference.mean();
		EXPECT_LT(difference.lpNorm<Eigen::Infinity>(), 1e-10);
	}
}

TEST(Newton, KeepsTheMeanWhereNothingIsFixed)
{
	Random random(72);
	const Packed mesh(bumpyTorus(12, 8, random));
	for (double shift : {-20.0, 0.0, 7.0}) {
		const Eigen::VectorXd start = mesh.u().array() + shift;
		const Solved solved =
			solve(mesh, Eigen::VectorXd::Zero(start.size()), start, nothingFixed(mesh));
		ASSERT_TRUE(solved.result.converged);
		EXPECT_GT((solved.u - start).lpNorm<Eigen::Infinity>(), 0.01);
		EXPECT_NEAR(solved.u.mean(), start.mean(), 1e-13 * (1 + std::abs(shift)));
	}
}

TEST(Newton, KeepsTheMeanBeyondTheLastPlaceOfU)
{
	// Small steps from u = 40, whose last place is 7e-15: u and its rest together hold them.
	Random random(80);
	const Packed mesh(bumpyTorus(12, 8, random));
	const Eigen::VectorXd zero = Eigen::VectorXd::Zero(mesh.u().size());
	Eigen::VectorXd start = solve(mesh, zero, mesh.u(), nothingFixed(mesh)).u;
	for (double& x : start)
		x += 40.0 + random.real(-1e-4, 1e-4);
	const Solved solved = solve(mesh, zero, start, nothingFixed(mesh));
	ASSERT_TRUE(solved.result.converged);
	ASSERT_GT(solved.result.iterations, 0);
	long double moved = 0.0L;
	for (Eigen::Index v = 0; v < start.size(); ++v)
		moved += static_cast<long double>(solved.u[v]) - start[v] + solved.rest[v];
	EXPECT_LT(std::abs(static_cast<double>(moved)), 1e-15);
}

/// Is not finite at the first trial points, and keeps all that it is asked for.
class ReluctantMap : public Map
{
public:
	using Map::Map;

	void evaluate(const Eigen::VectorXd& u, const Eigen::VectorXd& rest) override
	{
		asked.emplace_back(u, rest);
		Map::evaluate(u, rest);
		if (asked.size() == 2 || asked.size() == 3)
			m_curvature.setConstant(std::numeric_limits<double>::quiet_NaN());
	}

	std::vector<std::pair<Eigen::VectorXd, Eigen::VectorXd>> asked;
};

TEST(Newton, AStepIsAddedWithoutRounding)
{
	// The trial points of one search are u + d, u + d/2, u + d/4, and doubles are halved exactly. Equal
	// circles have u near 0, so that most steps are larger than u. Multiples of 2^-62 up to 2 fit a
	// long double.
	Random random(81);
	const Packed mesh(bumpyTorus(12, 8, random));
	const double radius = 0.5 * *std::min_element(mesh.lengths.begin(), mesh.lengths.end());
	std::vector<double> lengths = mesh.lengths;
	for (double& l : lengths)
		l /= radius;
	ReluctantMap map(inversiveDistancePacking(
		mesh.triangulation, lengths, std::vector<double>(mesh.radii.size(), 1.0)));
	Eigen::VectorXd start(mesh.u().size());
	for (double& x : start)
		x = 0x1p-60 * std::round(0x1p60 * random.real(-0.01, 0.01));
	std::vector<char> fixed = nothingFixed(mesh);
	fixed[0] = 1;
	NewtonSolver solver(map, fixed);
	NewtonOptions options;
	options.maxIterations = 1;
	Eigen::VectorXd u = start;
	solver.solve(u, Eigen::VectorXd::Zero(u.size()), options, silent);
	ASSERT_GE(map.asked.size(), 4u);
	int larger = 0, inexact = 0;
	for (Eigen::Index v = 0; v < start.size(); ++v) {
		const auto step = [&](std::size_t trial) {
			const auto& [sum, rest] = map.asked[trial];
			return static_cast<long double>(sum[v]) - start[v] + rest[v];
		};
		const long double whole = step(1);
		if (std::abs(whole) < 0x1p-8L || std::abs(whole) > 1.0L)
			continue;
		EXPECT_EQ(step(2), whole / 2);
		EXPECT_EQ(step(3), whole / 4);
		larger += std::abs(whole) > std::abs(start[v]);
		inexact += map.asked[1].second[v] != 0.0;
	}
	EXPECT_GT(larger, 20);
	EXPECT_GT(inexact, 20);
}

TEST(Newton, KeepsFixedVerticesToTheBit)
{
	Random random(73);
	const Packed mesh(sliverDisk(10, 1.0, random));
	std::vector<char> fixed = mesh.triangulation.boundaryVertices();
	const Eigen::VectorXd target = Eigen::VectorXd::Zero(mesh.u().size());
	const Solved solved = solve(mesh, target, mesh.u(), fixed);
	ASSERT_TRUE(solved.result.converged);
	int moved = 0;
	for (Eigen::Index v = 0; v < target.size(); ++v) {
		if (fixed[static_cast<std::size_t>(v)]) {
			EXPECT_EQ(solved.u[v], mesh.u()[v]);
		}
		else
			moved += solved.u[v] != mesh.u()[v];
	}
	EXPECT_GT(moved, 0);
	EXPECT_NEAR(solved.result.residual, residualAt(mesh, solved, target, fixed), kLastPlace);
}

TEST(Newton, ConvergesQuadratically)
{
	Random random(74);
	const Packed mesh(bumpyTorus(16, 10, random));
	Map map = mesh.map();
	NewtonSolver solver(map, nothingFixed(mesh));
	Eigen::VectorXd u = mesh.u();
	std::vector<double> residuals;
	NewtonOptions options;
	options.epsilon = 1e-11;
	solver.solve(u, Eigen::VectorXd::Zero(u.size()), options, [&](int, double r) {
		residuals.push_back(r);
	});
	int quadratic = 0;
	for (std::size_t i = 1; i < residuals.size(); ++i)
		if (residuals[i - 1] < 0.1 && residuals[i] > 1e-12) {
			EXPECT_LT(residuals[i], 10 * residuals[i - 1] * residuals[i - 1]);
			++quadratic;
		}
	EXPECT_GE(quadratic, 2);
	for (std::size_t i = 1; i < residuals.size(); ++i)
		EXPECT_LE(residuals[i], residuals[i - 1]); // the last may be reported twice
}

TEST(Newton, StopsAtTheRoundingFloorAndTellsIt)
{
	Random random(75);
	for (const SurfaceMesh& surface : {bumpyTorus(16, 10, random), perforatedSlab(2, 3)}) {
		const Packed mesh(surface);
		NewtonOptions options;
		options.epsilon = 1e-300; // out of reach
		const Solved solved =
			solve(mesh, smoothedCurvature(mesh), mesh.u(), nothingFixed(mesh), options);
		EXPECT_TRUE(solved.result.converged);
		EXPECT_LT(solved.result.iterations, 30);
		EXPECT_GT(solved.result.floor, 0.0);
		EXPECT_LT(solved.result.floor, kLargestFloor);
		EXPECT_LT(solved.result.residual, 20 * solved.result.floor);
		EXPECT_LT(solved.result.residual, 1e-11);
	}
}

TEST(Newton, StopsAfterTheLastIterationWithoutAnError)
{
	Random random(76);
	const Packed mesh(bumpyTorus(16, 10, random));
	for (int most : {1, 2}) {
		NewtonOptions options;
		options.maxIterations = most;
		options.epsilon = 1e-13;
		const Solved solved = solve(
			mesh, Eigen::VectorXd::Zero(mesh.u().size()), mesh.u(), nothingFixed(mesh), options);
		EXPECT_EQ(solved.result.iterations, most);
		EXPECT_FALSE(solved.result.converged);
		EXPECT_GT(solved.result.residual, 1e-13);
	}
}

TEST(Newton, NeedsNoStepAtTheSolution)
{
	Random random(77);
	const Packed mesh(bumpyTorus(12, 8, random));
	Eigen::VectorXd zero = Eigen::VectorXd::Zero(mesh.u().size());
	const Solved once = solve(mesh, zero, mesh.u(), nothingFixed(mesh));
	NewtonOptions options;
	options.epsilon = 2 * std::max(once.result.residual, 1e-12);
	const Solved twice = solve(mesh, zero, once.u, nothingFixed(mesh), options);
	EXPECT_TRUE(twice.result.converged);
	EXPECT_EQ(twice.result.iterations, 0);
}

TEST(Newton, DoesNotCallABrokenMetricConverged)
{
	// Curvature above 2 pi at a vertex: no metric has it. The total is that of the torus.
	Random random(78);
	const Packed mesh(bumpyTorus(12, 8, random));
	Eigen::VectorXd target = Eigen::VectorXd::Zero(mesh.u().size());
	target[5] = 6.5;
	target[40] = -6.5;
	const Solved solved = solve(mesh, target, mesh.u(), nothingFixed(mesh));
	EXPECT_FALSE(solved.result.converged);
	EXPECT_LE(solved.result.iterations, NewtonOptions().maxIterations);
	for (double x : solved.u)
		EXPECT_TRUE(std::isfinite(x));
}

TEST(Newton, EndsWhereNoVertexIsFree)
{
	Random random(79);
	const Packed mesh(bumpyTorus(12, 8, random));
	const std::vector<char> allFixed(mesh.radii.size(), 1);
	Map map = mesh.map();
	map.evaluate(mesh.u());
	const Eigen::VectorXd own = map.curvature();
	EXPECT_TRUE(solve(mesh, own, mesh.u(), allFixed).result.converged);
	Eigen::VectorXd broken = mesh.u();
	for (Eigen::Index v = 0; v < broken.size(); v += 2)
		broken[v] += 8.0;
	map.evaluate(broken);
	ASSERT_GT(map.brokenTriangles(), 0);
	const Solved solved = solve(mesh, own, broken, allFixed);
	EXPECT_FALSE(solved.result.converged);
	EXPECT_EQ(solved.u, broken);
}

TEST(Newton, CancelsWhereTheReportThrows)
{
	Random random(79);
	const Packed mesh(bumpyTorus(12, 8, random));
	for (int last : {0, 1, 2}) {
		Map map = mesh.map();
		NewtonSolver solver(map, nothingFixed(mesh));
		Eigen::VectorXd u = mesh.u();
		int calls = 0;
		EXPECT_THROW(
			solver.solve(
				u,
				Eigen::VectorXd::Zero(u.size()),
				{},
				[&](int step, double) {
					EXPECT_EQ(step, calls);
					++calls;
					if (step == last)
						throw Cancelled();
				}),
			Cancelled);
		EXPECT_EQ(calls, last + 1);
		// The solver can be used again.
		u = mesh.u();
		EXPECT_TRUE(solver.solve(u, Eigen::VectorXd::Zero(u.size()), {}, silent).converged);
	}
}

TEST(Newton, WorkGrowsWithTheMeshAndStaysThatOfFewFactorisations)
{
	// Refinements of one smooth surface: the number of steps belongs to the surface, not to the mesh,
	// and the first factor serves all of them, so that the arithmetic is below that of three steps
	// with a factorisation each.
	std::vector<int> iterations;
	for (int n : {24, 48, 96}) {
		const Packed mesh(torus(2.0, 1.0, 2 * n, n));
		const auto workOf = [&](int mostIterations) {
			Map map = mesh.map();
			NewtonSolver solver(map, nothingFixed(mesh));
			Eigen::VectorXd u = mesh.u();
			NewtonOptions options;
			options.maxIterations = mostIterations;
			const NewtonResult result =
				solver.solve(u, Eigen::VectorXd::Zero(u.size()), options, silent);
			EXPECT_EQ(result.converged, mostIterations > 1);
			iterations.push_back(result.iterations);
			return solver.work();
		};
		const CholeskyWork oneStep = workOf(1), all = workOf(200);
		EXPECT_EQ(oneStep.factorizations, 1);
		EXPECT_EQ(oneStep.solutions, 1);
		EXPECT_EQ(all.orderings, 1);
		EXPECT_LE(all.factorizations, 2);
		EXPECT_LT(all.flops, 3 * oneStep.flops);
		EXPECT_LE(iterations.back(), 10);
	}
	EXPECT_LE(std::abs(iterations[5] - iterations[1]), 1);
}

TEST(Newton, StepsWithAnOldFactorReachTheSameMetric)
{
	// The same equations from a start whose factor is none of theirs: another start, another target.
	Random random(80);
	const Packed mesh(bumpyTorus(30, 20, random));
	NewtonOptions options;
	options.epsilon = 1e-12;
	const Eigen::VectorXd zero = Eigen::VectorXd::Zero(mesh.u().size());
	const Solved direct = solve(mesh, zero, mesh.u(), nothingFixed(mesh), options);
	Map map = mesh.map();
	NewtonSolver solver(map, nothingFixed(mesh));
	Eigen::VectorXd u = mesh.u();
	ASSERT_TRUE(solver.solve(u, smoothedCurvature(mesh), options, silent).converged);
	ASSERT_TRUE(solver.solve(u, zero, options, silent).converged);
	EXPECT_LT(solver.work().factorizations, solver.work().solutions);
	Eigen::VectorXd difference = u - direct.u;
	difference.array() -= difference.mean();
	EXPECT_LT(difference.lpNorm<Eigen::Infinity>(), 1e-10);
}

TEST(Newton, FollowsASurgeonThatChangesTheConnectivity)
{
	// Swapping the diagonal of a square keeps the flat metric if the new edge gets its length.
	const Packed mesh(rectangle(6, 6, 1.0, 1.0));
	Map map = mesh.map();
	std::vector<char> fixed = mesh.triangulation.boundaryVertices();
	NewtonSolver solver(map, fixed);
	Eigen::VectorXd u = mesh.u();
	for (Eigen::Index v = 0; v < u.size(); ++v)
		if (!fixed[static_cast<std::size_t>(v)])
			u[v] -= 0.05;
	int swaps = 0;
	const auto surgeon = [&](CurvatureMap& m) {
		if (swaps == 3)
			return false;
		for (int e = 10 * swaps;; ++e) {
			const Triangulation& t = m.triangulation();
			if (!t.isFlippable(e) || std::abs(mesh.lengths[at(e)] - std::sqrt(2.0) / 6) > 1e-9)
				continue;
			const int k = t.origin(t.previous(2 * e)), l = t.origin(t.previous(2 * e + 1));
			const double d = std::sqrt(2.0) / 6;
			if (k == l)
				continue;
			m.swapEdge(e, Euclidean::delta(d, mesh.radii[at(k)], mesh.radii[at(l)]));
			break;
		}
		++swaps;
		return true;
	};
	const NewtonResult result =
		solver.solve(u, Eigen::VectorXd::Zero(u.size()), {}, silent, surgeon);
	EXPECT_TRUE(result.converged);
	EXPECT_GE(swaps, 2);
	// The flat metric is the original one.
	for (Eigen::Index v = 0; v < u.size(); ++v)
		EXPECT_NEAR(u[v], mesh.u()[v], 1e-7);
}

} // namespace
} // namespace ricci::testing
