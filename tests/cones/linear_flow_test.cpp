// SPDX-License-Identifier: GPL-3.0-or-later
#include "linearised.h"
#include "support/flipped_flow.h"

#include <ricci/cones/target_curvature.h>

namespace ricci::testing {
namespace {

VertexVector randomVector(int size, Random& random)
{
	VertexVector x(size);
	for (double& value : x)
		value = random.real(-1.0, 1.0);
	return x;
}

/// Shares of the boundary vertices in its length.
VertexVector sharesInLength(const EmbeddedSurface& surface)
{
	const Triangulation& t = surface.triangulation;
	VertexVector share = VertexVector::Zero(t.vertexCount());
	for (const Edge e : t.edges())
		if (t.isBoundary(e))
			for (const Vertex v : t.ends(e))
				share[v] += surface.lengths[e];
	return share / share.sum();
}

/// A flow to five cones.
struct AtTheEnd : Linearised
{
	ConeBoundary boundary;
	FlowResult reached;

	explicit AtTheEnd(const LinearCase& c) : Linearised(c), boundary(c.boundary)
	{
		TargetRequest request;
		request.target = TargetCurvature::PlacedCones;
		request.freeBoundary = boundary == ConeBoundary::Fixed;
		request.goal = {ConeGoal::Count, 5};
		reached = to(chooseTarget(surface, start, request));
	}

	FlowResult to(const Target& wanted) const
	{
		FlowOptions options;
		options.epsilon = 1e-11;
		return runRicciFlow(surface, initialPacking(surface, options), wanted, options);
	}

	/// The target with \p k more curvature at one cone. On a closed surface another gives it; a
	/// prescribed boundary gives it in proportion to its length.
	Target changed(double k) const
	{
		Target other = reached.target;
		std::vector<Vertex> cones;
		for (const Vertex v : surface.triangulation.vertices())
			if (!surface.topology.boundary[v] && other.curvature[v] != 0.0)
				cones.push_back(v);
		other.curvature[cones[0]] += k;
		if (surface.topology.type.isClosed())
			other.curvature[cones[1]] -= k;
		else if (boundary == ConeBoundary::Prescribed)
			other.curvature -= k * sharesInLength(surface);
		return other;
	}

	/// The factor of \p result with mean 0.
	static VertexVector factor(const FlowResult& result, const VertexVector& weights)
	{
		VertexVector u = flowFactor(result);
		u.array() -= weights.dot(u);
		return u;
	}
};

TEST(LinearFlow, AtAFlowsEndGivesBackItsFactorAndOtherTargetsToSecondOrder)
{
	Random random(766);
	int doubled = 0, tried = 0;
	for (const LinearCase& c : linearCases(760, 3, 1, 2, 0.05)) {
		SCOPED_TRACE(c.name);
		AtTheEnd end(c);
		VertexVector weights = randomVector(end.surface.triangulation.vertexCount(), random);
		weights = weights.cwiseAbs() / weights.cwiseAbs().sum();
		LinearFlow linear(end.surface, end.reached, c.boundary, weights);
		EXPECT_EQ(linear.area(), weights);
		EXPECT_EQ(linear.curvature(), end.reached.curvature);
		EXPECT_EQ(linear.hasFixedSum(), end.surface.topology.type.isClosed());
		const VertexVector u = linear.factor(end.reached.curvature);
		const VertexVector wanted = AtTheEnd::factor(end.reached, weights);
		EXPECT_GT(wanted.lpNorm<Eigen::Infinity>(), 0.05);
		EXPECT_LT((u - wanted).lpNorm<Eigen::Infinity>(), 1e-9);
		EXPECT_NEAR(weights.dot(u), 0.0, 1e-13);
		doubled += end.reached.doubled;
		if (end.reached.doubled)
			continue; // linearised at a start
		++tried;
		LinearFlow& atStart = end.flow;
		LinearFlow atEnd(end.surface, end.reached, c.boundary, atStart.area());
		const auto errors = [&](double k) {
			const Target target = end.changed(k);
			const VertexVector exact = AtTheEnd::factor(end.to(target), atStart.area());
			const auto error = [&](LinearFlow& flow) {
				VertexVector curvature = target.curvature;
				for (const Vertex v : curvature.indices())
					if (target.fixed[v])
						curvature[v] = flow.curvature()[v];
				return (flow.factor(curvature) - exact).lpNorm<Eigen::Infinity>();
			};
			return std::make_pair(error(atStart), error(atEnd));
		};
		const auto full = errors(0.08), half = errors(0.04), quarter = errors(0.02);
		EXPECT_NEAR(std::log2(full.second / half.second), 2.0, 0.2);
		EXPECT_NEAR(std::log2(half.second / quarter.second), 2.0, 0.1);
		// That at the start is as far off as before.
		EXPECT_NEAR(quarter.first / full.first, 1.0, 0.2);
		EXPECT_LT(quarter.second, 0.02 * quarter.first);
	}
	EXPECT_GE(tried, 3);
	EXPECT_GT(doubled, 0);
}

/// u for a unit of curvature at \p v; where the sum is fixed, less one by area.
VertexVector factorOfCone(LinearFlow& flow, Vertex v)
{
	VertexVector rhs = VertexVector::Zero(flow.vertexCount());
	if (flow.hasFixedSum())
		rhs -= flow.area();
	rhs[v] += 1.0;
	return flow.solve(rhs);
}

/// Root mean square of the factor that takes the curvature from a surface.
double flatteningSize(LinearFlow& flow)
{
	VertexVector rhs = -flow.curvature();
	if (flow.hasFixedSum())
		rhs -= rhs.sum() * flow.area();
	return std::sqrt(flow.meanSquare(flow.solve(rhs)));
}

TEST(OnAggregates, HasTheAreaTheCurvatureAndTheFactorsOfTheSurface)
{
	const std::vector<LinearCase> all = linearCases(810, 12, 1, 9, 0.01);
	for (const LinearCase& c : {all[0], all[1], all[2], all[5]}) {
		SCOPED_TRACE(c.name);
		Linearised fine(c);
		const VertexArray<char>& boundary = fine.surface.topology.boundary;
		const bool isFixed = c.boundary == ConeBoundary::Fixed;
		VertexArray<Vertex> vertices;
		LinearFlow same(fine.flow.system(vertices));
		EXPECT_EQ(same.hasFixedSum(), fine.flow.hasFixedSum());
		EXPECT_NEAR(same.area().sum(), 1.0, 1e-12);
		const Vertex cone(vertices.size() / 2);
		VertexVector own = factorOfCone(same, cone);
		const VertexVector whole = factorOfCone(fine.flow, vertices[cone]);
		// Without the vertex that is left out of a closed surface, or without the boundary's area.
		for (const Vertex v : own.indices())
			own[v] -= whole[vertices[v]];
		own.array() -= same.area().dot(own);
		EXPECT_LT(own.lpNorm<Eigen::Infinity>(), 0.01);

		double curvature = 0.0;
		for (const Vertex v : boundary.indices())
			curvature += isFixed && boundary[v] ? 0.0 : fine.flow.curvature()[v];
		const double size = flatteningSize(fine.flow);
		for (const int count : {300, 1500}) {
			VertexArray<Vertex> roots;
			LinearFlow coarse = onAggregates(fine.flow.system(roots), count, roots);
			EXPECT_LE(roots.size(), count);
			EXPECT_GE(roots.size(), 40);
			EXPECT_NEAR(coarse.area().sum(), 1.0, 1e-12);
			EXPECT_GT(coarse.area().minCoeff(), 0.0);
			EXPECT_NEAR(coarse.curvature().sum(), curvature, 1e-9);
			for (const Vertex root : roots)
				EXPECT_FALSE(isFixed && boundary[root]);
			// Two steps, each 2.7 to 3.3 times as stiff in place of 2.9.
			EXPECT_NEAR(flatteningSize(coarse), size, 0.3 * size);
			for (const int k : {roots.size() / 5, roots.size() / 2}) {
				if (count == 300)
					continue;
				// The adjoint field of a cone, by which cones are placed.
				const VertexVector phi =
					fine.flow.gradient(factorOfCone(fine.flow, roots[Vertex(k)]));
				VertexVector field = coarse.gradient(factorOfCone(coarse, Vertex(k)));
				VertexVector wanted(field.size());
				for (const Vertex v : field.indices())
					wanted[v] = phi[roots[v]];
				wanted.array() -= coarse.area().dot(wanted);
				field.array() -= coarse.area().dot(field);
				const double a = std::sqrt(coarse.meanSquare(field));
				const double b = std::sqrt(coarse.meanSquare(wanted));
				EXPECT_GT(coarse.area().dot(field.cwiseProduct(wanted)), 0.995 * a * b);
				EXPECT_NEAR(a, b, 0.2 * b);
			}
		}
	}
}

} // namespace
} // namespace ricci::testing
