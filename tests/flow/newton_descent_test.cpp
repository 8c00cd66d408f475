// SPDX-License-Identifier: GPL-3.0-or-later
// Where the line search of Newton's method leads, seen by the convex energy whose gradient is
// K - target: as an integral along the steps, not by a formula of its own.
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/flow/newton.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace ricci::testing {
namespace {

const auto silent = [](int, double) {};

/// Keeps the points that were accepted.
template<class Map>
class Recorded : public Map
{
public:
	using Map::Map;

	void evaluate(const VertexVector& u, const VertexVector& low) override
	{
		m_last = u;
		Map::evaluate(u, low);
	}
	void accept() override
	{
		accepted.push_back(m_last);
		Map::accept();
	}

	std::vector<VertexVector> accepted;

private:
	VertexVector m_last;
};

/// E(\p to) - E(\p from): the gradient integrated by Gauss's two points on so many \p parts.
double energyDifference(
	CurvatureMap& map,
	const VertexVector& from,
	const VertexVector& to,
	const VertexVector& target,
	int parts)
{
	const VertexVector step = to - from;
	double sum = 0.0;
	for (int part = 0; part < parts; ++part)
		for (const double point : {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)}) {
			map.evaluate(from + (part + point) / parts * step);
			sum += (map.curvature() - target).dot(step);
		}
	return 0.5 * sum / parts;
}

/// Curvature of a metric with the triangles of \p mesh, in \p metric; not far from the mesh's own.
VertexVector reachableTarget(const Packed& mesh, Random& random, VertexVector& metric)
{
	auto map = mesh.map();
	for (double spread = 0.3;; spread *= 0.7) {
		metric = mesh.u();
		for (double& x : metric)
			x += random.real(-spread, spread);
		map.evaluate(metric);
		if (map.brokenTriangles() == 0)
			return map.curvature();
	}
}

TEST(NewtonDescent, FindsTheMetricThatExistsFromFarOutsideOfAll)
{
	// No flips: nearly all triangles are broken at the start, where the norm of the gradient has
	// stationary points. The energy's minimum is the metric that the target was taken from.
	Random random(90);
	for (const bool slivers : {false, true})
		for (const double spread : {1.0, 4.0, 8.0, 16.0})
			for (int trial = 0; trial < 12; ++trial) {
				const Packed mesh(slivers ? sliverDisk(8, 2.0, random) : bumpyTorus(12, 8, random));
				VertexVector metric;
				const VertexVector target = reachableTarget(mesh, random, metric);
				VertexVector u = metric;
				for (double& x : u)
					x += random.real(-spread, spread);
				auto map = mesh.map();
				NewtonSolver solver(map, VertexArray<char>(mesh.radii.size(), 0));
				const NewtonResult result = solver.solve(u, target, {}, silent);
				EXPECT_TRUE(result.converged)
					<< "spread " << spread << ": " << result.residual << " after "
					<< result.iterations << " steps, " << map.brokenTriangles() << " broken";
				u -= metric;
				u.array() -= u.mean();
				EXPECT_LT(u.lpNorm<Eigen::Infinity>(), 1e-5);
			}
}

TEST(NewtonDescent, LowersTheEnergyWithEveryStepWhereEdgesFlip)
{
	// The steps are accepted by the norm of the gradient. With flips that is no worse than a search by
	// the energy: it falls with each.
	Random random(91);
	int steps = 0;
	for (int trial = 0; trial < 12; ++trial) {
		const Packed mesh(trial % 2 ? bumpyTorus(12, 8, random) : perforatedSlab(2, 3));
		const int n = static_cast<int>(mesh.radii.size());
		auto own = mesh.map();
		own.evaluate(mesh.u());
		VertexVector target(n);
		for (double& k : target)
			k = random.real(-4.0, 3.0);
		target.array() += (own.curvature().sum() - target.sum()) / n;
		ASSERT_LT(target.maxCoeff(), 6.28);
		Recorded<FlippingCurvatureMap<Euclidean>> map(mesh.packing);
		NewtonSolver solver(map, VertexArray<char>(mesh.radii.size(), 0));
		VertexVector u = mesh.u();
		const NewtonResult result = solver.solve(u, target, {}, silent);
		EXPECT_TRUE(result.converged) << result.residual;
		FlippingCurvatureMap<Euclidean> reference(mesh.packing);
		for (std::size_t i = 1; i < map.accepted.size(); ++i) {
			const VertexVector &from = map.accepted[i - 1], &to = map.accepted[i];
			const double difference = energyDifference(reference, from, to, target, 32);
			// At the end the energy is flat within rounding.
			EXPECT_LT(difference, 1e-12) << "step " << i << " of trial " << trial;
			++steps;
		}
	}
	EXPECT_GT(steps, 5 * 12);
}

TEST(NewtonDescent, EndsAtAMinimumThatIsNoMetric)
{
	// Curvature above 2 pi: the energy, continued beyond the metrics, has no minimum among them.
	Random random(92);
	for (int trial = 0; trial < 4; ++trial) {
		const Packed mesh(bumpyTorus(12, 8, random));
		VertexVector metric;
		VertexVector target = reachableTarget(mesh, random, metric);
		target[Vertex(5)] += 7.0;
		target[Vertex(40)] -= 7.0;
		auto map = mesh.map();
		NewtonSolver solver(map, VertexArray<char>(mesh.radii.size(), 0));
		VertexVector u = mesh.u();
		const NewtonResult result = solver.solve(u, target, {}, silent);
		EXPECT_FALSE(result.converged);
		for (const double x : u)
			EXPECT_TRUE(std::isfinite(x));
	}
}

} // namespace
} // namespace ricci::testing
