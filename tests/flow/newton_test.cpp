// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/intrinsic.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/wide.h"

#include <ricci/base/tolerances.h>
#include <ricci/flow/newton.h>

#include <gtest/gtest.h>

namespace ricci::testing {
namespace {

using Map = GeometricCurvatureMap<Euclidean>;

/// Distance of the doubles round 2 pi, at which angle sums are kept.
constexpr double kLastPlace = 4 * std::numeric_limits<double>::epsilon();

Packed bumpy(std::uint64_t seed, int nu = 12, int nv = 8)
{
	Random random(seed);
	return Packed(bumpyTorus(nu, nv, random));
}

VertexVector zero(const Packed& mesh)
{
	return VertexVector::Zero(mesh.radii.size());
}

VertexVector ownCurvature(const Packed& mesh)
{
	Map map = mesh.map();
	map.evaluate(mesh.u());
	return map.curvature();
}

/// A target with the total curvature of the surface, not far from its own.
VertexVector smoothedCurvature(const Packed& mesh)
{
	const VertexVector own = ownCurvature(mesh);
	return (0.5 * own.array() + 0.5 * own.mean()).matrix();
}

VertexVector moved(VertexVector u, double spread, Random& random)
{
	for (double& x : u)
		x += random.real(-spread, spread);
	return u;
}

/// A solver on one surface, and what it was last asked for.
struct Solve
{
	const Packed& mesh;
	VertexArray<char> fixed = VertexArray<char>(mesh.radii.size(), 0);
	Map map = mesh.map();
	NewtonSolver solver{map, fixed};
	VertexVector u = mesh.u();
	NewtonResult result = {};

	Solve& to(const VertexVector& target, double epsilon = 1e-8)
	{
		result = solver.solve(u, target, epsilon, NewtonSolver::kMaxSteps, [](int, double) {});
		// By a map of its own.
		Map other = mesh.map();
		other.evaluate(u, solver.low());
		double largest = 0.0;
		for (const Vertex v : target.indices())
			if (!fixed[v])
				largest = std::max(largest, std::abs(target[v] - other.curvature()[v]));
		EXPECT_NEAR(result.residual, largest, kLastPlace);
		return *this;
	}
	/// From \p start.
	Solve& from(const VertexVector& start)
	{
		u = start;
		return *this;
	}
};

/// u as a metric: up to scale.
double difference(const VertexVector& a, const VertexVector& b)
{
	VertexVector d = a - b;
	d.array() -= d.mean();
	return d.lpNorm<Eigen::Infinity>();
}

TEST(Newton, ReachesTheRoundingFloor)
{
	for (const Packed& mesh :
		 {Packed(tetrahedron()), bumpy(70, 16, 10), Packed(perforatedSlab(2, 3))}) {
		Solve solve{mesh};
		EXPECT_TRUE(solve.to(smoothedCurvature(mesh), 1e-300).result.converged);
		EXPECT_LT(solve.result.iterations, 30);
		EXPECT_GT(solve.result.floor, 0.0);
		EXPECT_LT(solve.result.floor, kMaxFloor);
		EXPECT_LT(solve.result.residual, std::min(20 * solve.result.floor, 1e-11));
		// At the solution no step is needed.
		EXPECT_EQ(solve.to(smoothedCurvature(mesh), 1e-11).result.iterations, 0);
		EXPECT_TRUE(solve.result.converged);
	}
}

TEST(Newton, KeepsTheMeanWhereNothingIsFixed)
{
	Random random(72);
	const Packed mesh = bumpy(72);
	for (const double shift : {-20.0, 0.0, 7.0}) {
		const VertexVector start = (mesh.u().array() + shift).matrix();
		Solve solve{mesh};
		ASSERT_TRUE(solve.from(start).to(zero(mesh)).result.converged);
		EXPECT_GT((solve.u - start).lpNorm<Eigen::Infinity>(), 0.01);
		EXPECT_NEAR(solve.u.mean(), start.mean(), 1e-13 * (1 + std::abs(shift)));
	}
	// Small steps from u = 40, whose last place is 7e-15: u and its low part together hold them.
	Solve solve{mesh};
	const VertexVector flat = solve.to(zero(mesh)).u;
	const VertexVector start = moved((flat.array() + 40.0).matrix(), 1e-4, random);
	ASSERT_TRUE(solve.from(start).to(zero(mesh)).result.converged);
	ASSERT_GT(solve.result.iterations, 0);
	long double sum = 0.0L;
	for (const Vertex v : start.indices())
		sum += static_cast<long double>(solve.u[v]) - start[v] + solve.solver.low()[v];
	// A hundredth of that for each vertex.
	EXPECT_LT(std::abs(static_cast<double>(sum)), 7e-17 * static_cast<double>(start.size()));
}

/// Is not finite at the first trial points, and keeps all that it is asked for.
class RecordingMap : public Map
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
	RecordingMap map(
		mesh.triangulation, inversiveDistancesLessOne(mesh.triangulation, lengths, ones));
	VertexVector start(mesh.u().size());
	for (double& x : start)
		x = 0x1p-60 * std::round(0x1p60 * random.real(-0.01, 0.01));
	VertexArray<char> fixed(mesh.radii.size(), 0);
	fixed[Vertex(0)] = 1;
	NewtonSolver solver(map, fixed);
	VertexVector u = start;
	solver.solve(u, zero(mesh), 1e-8, 1, [](int, double) {});
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

/// Curvature of a metric with the triangles of \p mesh, in \p metric; not far from the mesh's own.
VertexVector reachableTarget(const Packed& mesh, Random& random, VertexVector& metric)
{
	auto map = mesh.map();
	for (double spread = 0.3;; spread *= 0.7) {
		map.evaluate(metric = moved(mesh.u(), spread, random));
		if (map.brokenTriangles() == 0)
			return map.curvature();
	}
}

/// No flips: nearly all triangles are broken at the start, where the norm of the gradient has stationary
/// points. The energy's minimum is the metric that the target was taken from.
TEST(NewtonDescent, FindsTheMetricThatExistsFromFarOutsideOfAll)
{
	Random random(90);
	for (const bool slivers : {false, true})
		for (const double spread : {1.0, 4.0, 8.0, 16.0})
			for (int trial = 0; trial < 12; ++trial) {
				SCOPED_TRACE(spread);
				const Packed mesh(slivers ? sliverDisk(8, 2.0, random) : bumpyTorus(12, 8, random));
				VertexVector metric;
				const VertexVector target = reachableTarget(mesh, random, metric);
				Solve solve{mesh};
				EXPECT_TRUE(solve.from(moved(metric, spread, random)).to(target).result.converged);
				EXPECT_LT(difference(solve.u, metric), 1e-5);
			}
}

} // namespace
} // namespace ricci::testing
