// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/wide.h"

#include <ricci/base/tolerances.h>
#include <ricci/error.h>
#include <ricci/flow/newton.h>
#include <ricci/surface/flow_domain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

using Map = GeometricCurvatureMap<Euclidean>;

const auto silent = [](int, double) {};

VertexArray<char> nothingFixed(const Packed& mesh)
{
	return VertexArray<char>(mesh.radii.size(), 0);
}

/// A target with the total curvature of the surface, not far from its own.
VertexVector smoothedCurvature(const Packed& mesh)
{
	Map map = mesh.map();
	map.evaluate(mesh.u());
	const double mean = map.curvature().sum() / static_cast<double>(map.curvature().size());
	return (0.5 * map.curvature().array() + 0.5 * mean).matrix();
}

struct Solved
{
	NewtonResult result;
	VertexVector u, low;
};

Solved solve(
	const Packed& mesh,
	const VertexVector& target,
	VertexVector start,
	VertexArray<char> fixed,
	NewtonOptions options = {})
{
	Map map = mesh.map();
	NewtonSolver solver(map, std::move(fixed));
	Solved solved;
	solved.result = solver.solve(start, target, options, silent);
	solved.u = start;
	solved.low = solver.low();
	return solved;
}

/// Distance of the doubles round 2 pi, at which angle sums are kept.
constexpr double kLastPlace = 4 * std::numeric_limits<double>::epsilon();

/// max |target - K| by a map of its own.
double residualAt(
	const Packed& mesh,
	const Solved& solved,
	const VertexVector& target,
	const VertexArray<char>& fixed)
{
	Map map = mesh.map();
	map.evaluate(solved.u, solved.low);
	double largest = 0.0;
	for (const Vertex v : target.indices())
		if (!fixed[v])
			largest = std::max(largest, std::abs(target[v] - map.curvature()[v]));
	return largest;
}

TEST(Newton, ReachesTheTargetAndReportsTheTrueResidual)
{
	Random random(70);
	for (const SurfaceMesh& surface :
		 {tetrahedron(), bumpyTorus(16, 10, random), perforatedSlab(2, 3)}) {
		const Packed mesh(surface);
		const VertexVector target = smoothedCurvature(mesh);
		const Solved solved = solve(mesh, target, mesh.u(), nothingFixed(mesh));
		EXPECT_TRUE(solved.result.converged);
		EXPECT_LT(solved.result.residual, 1e-8);
		EXPECT_NEAR(
			solved.result.residual,
			residualAt(mesh, solved, target, nothingFixed(mesh)),
			kLastPlace);
	}
}

TEST(Newton, SolvesADoubleOnHalfTheUnknowns)
{
	Random random(77);
	for (const SurfaceMesh& surface :
		 {shaken(rectangle(9, 7, 3.0, 2.0), 0.05, random), ring(1.0, 2.0, 24, 6)}) {
		const IntrinsicMesh half = intrinsicMesh(surface);
		const DoubleSurface d = doubleOf(half.triangulation);
		EdgeArray<double> lengths;
		for (const Edge e : d.edgeOf)
			lengths.push_back(half.lengths[e]);
		const Packed mesh(d.triangulation, lengths);
		const VertexVector smoothed = smoothedCurvature(mesh);
		VertexVector target = smoothed;
		for (const Vertex v : d.mirror.indices())
			target[v] = 0.5 * (smoothed[v] + smoothed[d.mirror[v]]);
		NewtonOptions options;
		options.epsilon = 1e-12;
		const Solved whole = solve(mesh, target, mesh.u(), nothingFixed(mesh), options);
		ASSERT_TRUE(whole.result.converged);

		Map map = mesh.map();
		NewtonSolver solver(map, nothingFixed(mesh), d.mirror);
		VertexVector u = mesh.u();
		const NewtonResult symmetric = solver.solve(u, target, options, silent);
		ASSERT_TRUE(symmetric.converged);
		EXPECT_LT((u - whole.u).lpNorm<Eigen::Infinity>(), 1e-11);
		for (const Vertex v : d.mirror.indices())
			EXPECT_EQ(u[v], u[d.mirror[v]]);
		const double flops = solver.work().flops;
		solver.dropSymmetry();
		EXPECT_EQ(solver.work().flops, flops);
		u = mesh.u();
		EXPECT_TRUE(solver.solve(u, target, options, silent).converged);
		EXPECT_LT((u - whole.u).lpNorm<Eigen::Infinity>(), 1e-11);
		EXPECT_GT(solver.work().flops, flops);
	}
}

TEST(Newton, WithoutPolishingStopsAtEpsilon)
{
	Random random(78);
	const Packed mesh(bumpyTorus(16, 10, random));
	const VertexVector target = smoothedCurvature(mesh);
	NewtonOptions options;
	options.epsilon = 1e-2;
	const NewtonResult polished = solve(mesh, target, mesh.u(), nothingFixed(mesh), options).result;
	options.polishes = false;
	const NewtonResult rough = solve(mesh, target, mesh.u(), nothingFixed(mesh), options).result;
	EXPECT_TRUE(rough.converged);
	EXPECT_LT(rough.residual, options.epsilon);
	EXPECT_LT(polished.residual, rough.residual);
	EXPECT_GT(polished.iterations, rough.iterations);
}

TEST(Newton, CountsEveryStep)
{
	Random random(78);
	const Packed mesh(bumpyTorus(16, 10, random));
	const VertexVector target = smoothedCurvature(mesh);
	for (const double epsilon : {1e-1, 1e-5}) {
		NewtonOptions options;
		options.epsilon = epsilon;
		VertexVector u = mesh.u();
		Map map = mesh.map();
		NewtonSolver solver(map, nothingFixed(mesh));
		std::vector<int> steps;
		const NewtonResult result =
			solver.solve(u, target, options, [&](int step, double) { steps.push_back(step); });
		std::vector<int> all(at(result.iterations) + 1);
		std::iota(all.begin(), all.end(), 0);
		EXPECT_EQ(steps, all);
		EXPECT_GT(result.iterations, 0);
	}
}

TEST(Newton, SolutionIsUniqueUpToScale)
{
	Random random(71);
	const Packed mesh(bumpyTorus(16, 10, random));
	const VertexVector target = smoothedCurvature(mesh);
	NewtonOptions options;
	options.epsilon = 1e-12;
	const Solved reference = solve(mesh, target, mesh.u(), nothingFixed(mesh), options);
	ASSERT_TRUE(reference.result.converged);
	for (int trial = 0; trial < 10; ++trial) {
		VertexVector start = mesh.u();
		for (double& x : start)
			x += random.real(-1.5, 1.5);
		Map map = mesh.map();
		map.evaluate(start);
		EXPECT_GT(map.brokenTriangles(), 0); // far from the start: outside the space of metrics
		const Solved solved = solve(mesh, target, start, nothingFixed(mesh), options);
		ASSERT_TRUE(solved.result.converged) << "trial " << trial;
		VertexVector difference = solved.u - reference.u;
		difference.array() -= difference.mean();
		EXPECT_LT(difference.lpNorm<Eigen::Infinity>(), 1e-10);
	}
}

TEST(Newton, KeepsTheMeanWhereNothingIsFixed)
{
	Random random(72);
	const Packed mesh(bumpyTorus(12, 8, random));
	for (double shift : {-20.0, 0.0, 7.0}) {
		const VertexVector start = (mesh.u().array() + shift).matrix();
		const Solved solved =
			solve(mesh, VertexVector::Zero(start.size()), start, nothingFixed(mesh));
		ASSERT_TRUE(solved.result.converged);
		EXPECT_GT((solved.u - start).lpNorm<Eigen::Infinity>(), 0.01);
		EXPECT_NEAR(solved.u.mean(), start.mean(), 1e-13 * (1 + std::abs(shift)));
	}
}

TEST(Newton, KeepsTheMeanBeyondTheLastPlaceOfU)
{
	// Small steps from u = 40, whose last place is 7e-15: u and its low part together hold them.
	Random random(80);
	const Packed mesh(bumpyTorus(12, 8, random));
	const VertexVector zero = VertexVector::Zero(mesh.u().size());
	VertexVector start = solve(mesh, zero, mesh.u(), nothingFixed(mesh)).u;
	for (double& x : start)
		x += 40.0 + random.real(-1e-4, 1e-4);
	const Solved solved = solve(mesh, zero, start, nothingFixed(mesh));
	ASSERT_TRUE(solved.result.converged);
	ASSERT_GT(solved.result.iterations, 0);
	long double moved = 0.0L;
	for (const Vertex v : start.indices())
		moved += static_cast<long double>(solved.u[v]) - start[v] + solved.low[v];
	EXPECT_LT(std::abs(static_cast<double>(moved)), 1e-15);
}

/// Is not finite at the first trial points, and keeps all that it is asked for.
class ReluctantMap : public Map
{
public:
	using Map::Map;

	void evaluate(const VertexVector& u, const VertexVector& low) override
	{
		asked.emplace_back(u, low);
		Map::evaluate(u, low);
		if (asked.size() == 2 || asked.size() == 3)
			m_curvature.setConstant(std::numeric_limits<double>::quiet_NaN());
	}

	std::vector<std::pair<VertexVector, VertexVector>> asked;
};

TEST(Newton, AStepIsAddedWithoutRounding)
{
	RICCI_NEEDS_WIDE_LONG_DOUBLE();
	// The trial points of one search are u + d, u + d/2, u + d/4, and doubles are halved exactly. Equal
	// circles have u near 0, so that most steps are larger than u. Multiples of 2^-62 up to 2 fit a
	// long double.
	Random random(81);
	const Packed mesh(bumpyTorus(12, 8, random));
	const double radius = 0.5 * *std::min_element(mesh.lengths.begin(), mesh.lengths.end());
	EdgeArray<double> lengths = mesh.lengths;
	for (double& l : lengths)
		l /= radius;
	const VertexArray<double> ones(mesh.radii.size(), 1.0);
	ReluctantMap map(CirclePacking{
		mesh.triangulation, inversiveDistancesLessOne(mesh.triangulation, lengths, ones)});
	VertexVector start(mesh.u().size());
	for (double& x : start)
		x = 0x1p-60 * std::round(0x1p60 * random.real(-0.01, 0.01));
	VertexArray<char> fixed = nothingFixed(mesh);
	fixed[Vertex(0)] = 1;
	NewtonSolver solver(map, fixed);
	NewtonOptions options;
	options.maxIterations = 1;
	VertexVector u = start;
	solver.solve(u, VertexVector::Zero(u.size()), options, silent);
	ASSERT_GE(map.asked.size(), 4u);
	int larger = 0, inexact = 0;
	for (const Vertex v : start.indices()) {
		const auto step = [&](std::size_t trial) {
			const auto& [sum, low] = map.asked[trial];
			return static_cast<long double>(sum[v]) - start[v] + low[v];
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
	const VertexArray<char> fixed = mesh.triangulation.boundaryVertices();
	const VertexVector target = VertexVector::Zero(mesh.u().size());
	const Solved solved = solve(mesh, target, mesh.u(), fixed);
	ASSERT_TRUE(solved.result.converged);
	int moved = 0;
	for (const Vertex v : target.indices()) {
		if (fixed[v]) {
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
	VertexVector u = mesh.u();
	std::vector<double> residuals;
	NewtonOptions options;
	options.epsilon = 1e-11;
	solver.solve(
		u, VertexVector::Zero(u.size()), options, [&](int, double r) { residuals.push_back(r); });
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
		EXPECT_LT(solved.result.floor, kMaxFloor);
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
		const Solved solved =
			solve(mesh, VertexVector::Zero(mesh.u().size()), mesh.u(), nothingFixed(mesh), options);
		EXPECT_EQ(solved.result.iterations, most);
		EXPECT_FALSE(solved.result.converged);
		EXPECT_GT(solved.result.residual, 1e-13);
	}
}

TEST(Newton, NeedsNoStepAtTheSolution)
{
	Random random(77);
	const Packed mesh(bumpyTorus(12, 8, random));
	VertexVector zero = VertexVector::Zero(mesh.u().size());
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
	VertexVector target = VertexVector::Zero(mesh.u().size());
	target[Vertex(5)] = 6.5;
	target[Vertex(40)] = -6.5;
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
	const VertexArray<char> allFixed(mesh.radii.size(), 1);
	Map map = mesh.map();
	map.evaluate(mesh.u());
	const VertexVector own = map.curvature();
	EXPECT_TRUE(solve(mesh, own, mesh.u(), allFixed).result.converged);
	VertexVector broken = mesh.u();
	for (const Vertex v : broken.indices())
		if (v.number() % 2 == 0)
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
		VertexVector u = mesh.u();
		int calls = 0;
		EXPECT_THROW(
			solver.solve(
				u,
				VertexVector::Zero(u.size()),
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
		EXPECT_TRUE(solver.solve(u, VertexVector::Zero(u.size()), {}, silent).converged);
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
			VertexVector u = mesh.u();
			NewtonOptions options;
			options.maxIterations = mostIterations;
			const NewtonResult result =
				solver.solve(u, VertexVector::Zero(u.size()), options, silent);
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
	const VertexVector zero = VertexVector::Zero(mesh.u().size());
	const Solved direct = solve(mesh, zero, mesh.u(), nothingFixed(mesh), options);
	Map map = mesh.map();
	NewtonSolver solver(map, nothingFixed(mesh));
	VertexVector u = mesh.u();
	ASSERT_TRUE(solver.solve(u, smoothedCurvature(mesh), options, silent).converged);
	ASSERT_TRUE(solver.solve(u, zero, options, silent).converged);
	EXPECT_LT(solver.work().factorizations, solver.work().solutions);
	VertexVector difference = u - direct.u;
	difference.array() -= difference.mean();
	EXPECT_LT(difference.lpNorm<Eigen::Infinity>(), 1e-10);
}

/// The first step is solved with the factor that someone else has made, if its unknowns are the same ones.
TEST(Newton, BeginsWithAFactorOfTheSameUnknowns)
{
	Random random(81);
	const Packed mesh(bumpyTorus(30, 20, random));
	const VertexVector zero = VertexVector::Zero(mesh.u().size());
	const Solved direct = solve(mesh, zero, mesh.u(), nothingFixed(mesh));
	for (const bool isSame : {true, false}) {
		Map map = mesh.map();
		map.evaluate(mesh.u());
		VertexArray<char> fixed = nothingFixed(mesh);
		fixed[Vertex(5)] = isSame ? 0 : 1;
		const auto known = std::make_shared<FactoredHessian>(fixed, map.scaleInvariant());
		ASSERT_TRUE(known->factorize(map));
		NewtonSolver solver(map, nothingFixed(mesh));
		solver.beginWith(known);
		EXPECT_EQ(solver.work().factorizations, 0);
		NewtonOptions oneStep;
		oneStep.maxIterations = 1;
		VertexVector u = mesh.u();
		solver.solve(u, zero, oneStep, silent);
		EXPECT_EQ(solver.work().factorizations, isSame ? 0 : 1);
		EXPECT_GE(solver.work().solutions, 1);
		ASSERT_TRUE(solver.solve(u, zero, {}, silent).converged);
		VertexVector difference = u - direct.u;
		difference.array() -= difference.mean();
		EXPECT_LT(difference.lpNorm<Eigen::Infinity>(), 1e-10);
	}
}

TEST(Newton, FollowsASurgeonThatChangesTheConnectivity)
{
	// Swapping the diagonal of a square keeps the flat metric if the new edge gets its length.
	const Packed mesh(rectangle(6, 6, 1.0, 1.0));
	Map map = mesh.map();
	const VertexArray<char> fixed = mesh.triangulation.boundaryVertices();
	NewtonSolver solver(map, fixed);
	VertexVector u = mesh.u();
	for (const Vertex v : u.indices())
		if (!fixed[v])
			u[v] -= 0.05;
	int swaps = 0;
	const auto surgeon = [&](CurvatureMap& m) {
		if (swaps == 3)
			return false;
		for (Edge e(10 * swaps);; e = Edge(e.number() + 1)) {
			const Triangulation& t = m.triangulation();
			if (!t.isFlippable(e) || std::abs(mesh.lengths[e] - std::sqrt(2.0) / 6) > 1e-9)
				continue;
			const Vertex k = t.apex(e.halfedge()), l = t.apex(e.halfedge().twin());
			const double d = std::sqrt(2.0) / 6;
			if (k == l)
				continue;
			m.swapEdge(e, Euclidean::delta(d, mesh.radii[k], mesh.radii[l]));
			break;
		}
		++swaps;
		return true;
	};
	const NewtonResult result = solver.solve(u, VertexVector::Zero(u.size()), {}, silent, surgeon);
	EXPECT_TRUE(result.converged);
	EXPECT_GE(swaps, 2);
	// The flat metric is the original one.
	for (const Vertex v : u.indices())
		EXPECT_NEAR(u[v], mesh.u()[v], 1e-7);
}

} // namespace
} // namespace ricci::testing
