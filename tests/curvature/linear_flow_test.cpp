// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense_flow.h"
#include "linearised.h"

#include "support/random_surface.h"
#include "support/run_flow.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/curvature/cone_sites.h>
#include <ricci/curvature/linear_flow.h>
#include <ricci/curvature/target_curvature.h>
#include <ricci/math/shortest_paths.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

std::vector<LinearCase> cases()
{
	Random random(760);
	const SurfaceMesh sphere = shaken(perforatedSlab(0, 3), 0.05, random);
	const SurfaceMesh genus1 = shaken(perforatedSlab(1, 2), 0.05, random);
	return {
		{"sphere", sphere, ConeBoundary::Fixed},
		{"genus 1", genus1, ConeBoundary::Prescribed},
		{"disk, fixed boundary", withoutStars(sphere, {0}), ConeBoundary::Fixed},
		{"two holes, fixed boundary", withoutStars(genus1, {0, 40}), ConeBoundary::Fixed},
		{"disk, prescribed boundary", withoutStars(sphere, {0}), ConeBoundary::Prescribed},
		{"two holes, prescribed", withoutStars(genus1, {0, 40}), ConeBoundary::Prescribed}};
}

VertexVector randomVector(int size, Random& random)
{
	VertexVector x(size);
	for (const Vertex v : x.indices())
		x[v] = random.real(-1.0, 1.0);
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

TEST(LinearFlow, TheBoundaryHasSharesWithAndWithoutLength)
{
	Random random(771);
	const SurfaceMesh mesh = withoutStars(shaken(perforatedSlab(1, 2), 0.05, random), {0, 40});
	const Component component = onlyComponent(mesh);
	EmbeddedSurface surface = embeddedSurface(component.positions, component.triangles);
	const auto close = [&](const VertexVector& expected) {
		EXPECT_LT((boundaryShares(surface) - expected).lpNorm<Eigen::Infinity>(), 1e-15);
	};
	close(sharesInLength(surface));
	EdgeArray<double> lengths = surface.lengths;
	for (const Edge e : lengths.indices())
		if (surface.triangulation.isBoundary(e))
			lengths[e] = 1.0;
	surface.lengths = lengths;
	const VertexVector alike = sharesInLength(surface);
	for (double& length : surface.lengths)
		length = 0.0;
	close(alike);
}

TEST(LinearFlow, SolvesTheDenseSystem)
{
	Random random(761);
	for (const LinearCase& c : cases()) {
		SCOPED_TRACE(c.name);
		Linearised linear(c);
		const DenseFlow dense(linear.packed);
		const Topology& topology = linear.surface.topology;
		EXPECT_LT((linear.flow.curvature() - dense.curvature).lpNorm<Eigen::Infinity>(), 1e-12);
		EXPECT_LT((linear.flow.area() - dense.area).lpNorm<Eigen::Infinity>(), 1e-14);
		EXPECT_EQ(linear.flow.hasFixedSum(), topology.type.isClosed());

		VertexVector rhs = randomVector(linear.flow.vertexCount(), random);
		VertexVector expected;
		if (topology.type.isClosed()) {
			rhs.array() -= rhs.mean();
			expected = dense.solve(rhs);
		}
		else if (c.boundary == ConeBoundary::Prescribed)
			expected = dense.solve(rhs - rhs.sum() * sharesInLength(linear.surface));
		else {
			// u = 0 on the boundary.
			Eigen::MatrixXd laplacian = dense.laplacian;
			VertexVector inside = rhs;
			for (const Vertex v : rhs.indices())
				if (topology.boundary[v]) {
					laplacian.row(v.number()).setZero();
					laplacian(v.number(), v.number()) = 1.0;
					inside[v] = 0.0;
				}
			expected = laplacian.partialPivLu().solve(inside);
			expected.array() -= dense.area.dot(expected);
		}
		const VertexVector u = linear.flow.solve(rhs);
		EXPECT_NEAR(linear.flow.area().dot(u), 0.0, 1e-13);
		const double size = expected.lpNorm<Eigen::Infinity>();
		EXPECT_GT(size, 0.1); // or there is nothing to compare
		EXPECT_LT((u - expected).lpNorm<Eigen::Infinity>(), 1e-7 * size);
		EXPECT_NEAR(
			linear.flow.meanSquare(u), dense.area.dot(u.cwiseProduct(u)), 1e-12 * size * size);
	}
}

TEST(LinearFlow, OnAClosedSurfaceOneVertexTakesWhatIsMissingFromTheSum)
{
	Random random(762);
	Linearised linear(cases()[0]);
	const DenseFlow dense(linear.packed);
	const VertexVector rhs = randomVector(linear.flow.vertexCount(), random);
	const VertexVector missed = dense.laplacian * linear.flow.solve(rhs) - rhs;
	int missing = 0;
	for (const Vertex v : missed.indices())
		if (std::abs(missed[v]) > 1e-6) {
			EXPECT_NEAR(missed[v], -rhs.sum(), 1e-6);
			++missing;
		}
	EXPECT_EQ(missing, 1);
}

TEST(LinearFlow, TheGradientSolvesTheAdjointProblem)
{
	Random random(763);
	for (const LinearCase& c : cases()) {
		SCOPED_TRACE(c.name);
		Linearised linear(c);
		const VertexVector& area = linear.flow.area();
		for (int trial = 0; trial < 5; ++trial) {
			VertexVector a = randomVector(linear.flow.vertexCount(), random);
			VertexVector b = randomVector(linear.flow.vertexCount(), random);
			b.array() -= area.dot(b); // like all u
			if (linear.flow.hasFixedSum())
				a.array() -= a.mean();
			const VertexVector u = linear.flow.solve(a), phi = linear.flow.gradient(b);
			const double left = u.dot(area.cwiseProduct(b)), right = a.dot(phi);
			EXPECT_NEAR(left, right, 1e-12 * (1.0 + std::abs(left)));
		}
	}
}

TEST(LinearFlow, TheGradientIsTheDerivativeOfHalfTheMeanSquare)
{
	Random random(764);
	for (const LinearCase& c : cases()) {
		SCOPED_TRACE(c.name);
		Linearised linear(c);
		const VertexArray<char>& boundary = linear.surface.topology.boundary;
		const VertexVector rhs = -linear.flow.curvature();
		const auto half = [&](Vertex v, Vertex w, double k) {
			VertexVector moved = rhs;
			moved[v] += k;
			if (linear.flow.hasFixedSum())
				moved[w] -= k;
			return 0.5 * linear.flow.meanSquare(linear.flow.solve(moved));
		};
		const VertexVector phi = linear.flow.gradient(linear.flow.solve(rhs));
		int tried = 0;
		for (int trial = 0; trial < 40; ++trial) {
			const Vertex v(random.index(linear.flow.vertexCount()));
			const Vertex w(random.index(linear.flow.vertexCount()));
			if (v == w || boundary[v] || boundary[w])
				continue;
			++tried;
			// A quadratic function: the central difference is exact for any step.
			const double slope = 0.5 * (half(v, w, 1.0) - half(v, w, -1.0));
			const double wanted = linear.flow.hasFixedSum() ? phi[v] - phi[w] : phi[v];
			EXPECT_NEAR(slope, wanted, 1e-11 * (1.0 + half(v, w, 1.0)));
		}
		EXPECT_GT(tried, 10);
	}
}

bool sameBits(const VertexVector& a, const VertexVector& b)
{
	return a.size() == b.size() && (a.array() == b.array()).all();
}

/// A flow, and the linear flow where it ends.
struct AtTheEnd
{
	EmbeddedSurface surface;
	ConeBoundary boundary;
	Target target;
	FlowResult flow;

	AtTheEnd(const SurfaceMesh& mesh, ConeBoundary b, int cones) :
			surface(embeddedSurface(VertexArray<Point3>(mesh.positions), mesh.triangles)),
			boundary(b)
	{
		TargetRequest request;
		request.options.target = TargetCurvature::PlacedCones;
		request.options.freeBoundary = boundary == ConeBoundary::Fixed;
		request.options.cones.count = cones;
		InitialPacking start = initialPacking(surface, FlowOptions());
		target = chooseTarget(surface, start, request);
		flow = to(target);
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
		Target other = target;
		std::vector<Vertex> cones;
		for (const Vertex v : surface.triangulation.vertices())
			if (!surface.topology.boundary[v] && target.curvature[v] != 0.0)
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

/// The equations of the start are those of the flow's first step, which has no factorisation of its own then.
TEST(LinearFlow, LeavesItsFactorToTheFlow)
{
	for (const bool isKnown : {false, true}) {
		SCOPED_TRACE(isKnown);
		const SurfaceMesh mesh = torus(2.0, 1.0, 24, 16);
		const EmbeddedSurface surface =
			embeddedSurface(VertexArray<Point3>(mesh.positions), mesh.triangles);
		InitialPacking start = initialPacking(surface, {});
		if (isKnown)
			LinearFlow(surface, start, ConeBoundary::Fixed).factorize();
		EXPECT_EQ(start.hessian != nullptr, isKnown);
		const FlowResult flow =
			runRicciFlow(surface, std::move(start), zeroTarget(surface.topology), {});
		EXPECT_EQ(flow.work.factorizations, isKnown ? 0 : 1);
		EXPECT_EQ(flow.start.hessian, nullptr);
		EXPECT_LT(flow.residual, 1e-12);
	}
}

TEST(LinearFlow, AtAFlowsEndGivesBackItsFactor)
{
	Random random(766);
	int doubled = 0;
	for (const LinearCase& c : cases()) {
		SCOPED_TRACE(c.name);
		const AtTheEnd end(c.mesh, c.boundary, 5);
		VertexVector weights = randomVector(end.surface.triangulation.vertexCount(), random);
		weights = weights.cwiseAbs() / weights.cwiseAbs().sum();
		LinearFlow linear(end.surface, end.flow, c.boundary, weights);
		EXPECT_TRUE(sameBits(linear.area(), weights));
		EXPECT_TRUE(sameBits(linear.curvature(), end.flow.curvature));
		EXPECT_EQ(linear.hasFixedSum(), end.surface.topology.type.isClosed());
		const VertexVector u = linear.factor(end.flow.curvature);
		const VertexVector wanted = AtTheEnd::factor(end.flow, weights);
		EXPECT_GT(wanted.lpNorm<Eigen::Infinity>(), 0.05);
		EXPECT_LT((u - wanted).lpNorm<Eigen::Infinity>(), 1e-9);
		EXPECT_NEAR(weights.dot(u), 0.0, 1e-13);
		doubled += end.flow.doubled;
	}
	EXPECT_GT(doubled, 0); // that way round, too
}

TEST(LinearFlow, AtAFlowsEndKnowsOtherTargetsToSecondOrder)
{
	int tried = 0;
	for (const LinearCase& c : cases()) {
		SCOPED_TRACE(c.name);
		const AtTheEnd end(c.mesh, c.boundary, 5);
		if (end.flow.doubled)
			continue; // linearised at a start
		++tried;
		InitialPacking start = initialPacking(end.surface, FlowOptions());
		LinearFlow atStart(end.surface, start, c.boundary);
		LinearFlow atEnd(end.surface, end.flow, c.boundary, atStart.area());
		const auto errors = [&](double k) {
			const Target target = end.changed(k);
			const VertexVector u = AtTheEnd::factor(end.to(target), atStart.area());
			const auto error = [&](LinearFlow& linear) {
				VertexVector wanted = target.curvature;
				for (const Vertex v : wanted.indices())
					if (target.fixed[v])
						wanted[v] = linear.curvature()[v];
				return (linear.factor(wanted) - u).lpNorm<Eigen::Infinity>();
			};
			return std::make_pair(error(atStart), error(atEnd));
		};
		const auto whole = errors(0.08), half = errors(0.04), quarter = errors(0.02);
		EXPECT_NEAR(std::log2(whole.second / half.second), 2.0, 0.2);
		EXPECT_NEAR(std::log2(half.second / quarter.second), 2.0, 0.1);
		// That at the start is as far off as before.
		EXPECT_NEAR(quarter.first / whole.first, 1.0, 0.2);
		EXPECT_LT(quarter.second, 0.02 * quarter.first);
	}
	EXPECT_GE(tried, 3);
}

std::vector<LinearCase> fineCases()
{
	Random random(810);
	const SurfaceMesh sphere = shaken(perforatedSlab(0, 12), 0.01, random);
	const SurfaceMesh genus1 = shaken(perforatedSlab(1, 9), 0.01, random);
	return {
		{"sphere", sphere, ConeBoundary::Fixed},
		{"genus 1", genus1, ConeBoundary::Fixed},
		{"disk, fixed boundary", withoutStars(sphere, {0}), ConeBoundary::Fixed},
		{"two holes, prescribed", withoutStars(genus1, {0, 40}), ConeBoundary::Prescribed}};
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

TEST(LinearSystem, HasTheSolutionsOfItsFlow)
{
	for (const LinearCase& c : fineCases()) {
		SCOPED_TRACE(c.name);
		Linearised fine(c);
		VertexArray<Vertex> vertices;
		LinearFlow same(fine.flow.system(vertices));
		EXPECT_EQ(same.hasFixedSum(), fine.flow.hasFixedSum());
		EXPECT_NEAR(same.area().sum(), 1.0, 1e-12);
		const Vertex cone(vertices.size() / 2);
		const VertexVector u = factorOfCone(fine.flow, vertices[cone]);
		const VertexVector own = factorOfCone(same, cone);
		// Without the vertex that is left out of a closed surface, or without the boundary's area.
		double sum = 0.0;
		for (const Vertex v : own.indices())
			sum += same.area()[v] * u[vertices[v]];
		for (const Vertex v : own.indices())
			EXPECT_NEAR(own[v], u[vertices[v]] - sum, 0.01) << v.number();
	}
}

TEST(OnAggregates, KeepsAreaAndCurvature)
{
	for (const LinearCase& c : fineCases()) {
		SCOPED_TRACE(c.name);
		Linearised fine(c);
		VertexArray<Vertex> roots;
		const LinearFlow coarse = onAggregates(fine.flow.system(roots), 300, roots);
		EXPECT_LE(roots.size(), 300);
		EXPECT_GE(roots.size(), 40);
		EXPECT_NEAR(coarse.area().sum(), 1.0, 1e-12);
		EXPECT_GT(coarse.area().minCoeff(), 0.0);
		double expected = fine.flow.curvature().sum();
		const auto& boundary = fine.surface.topology.boundary;
		for (const Vertex v : boundary.indices())
			if (c.boundary == ConeBoundary::Fixed && boundary[v])
				expected -= fine.flow.curvature()[v];
		EXPECT_NEAR(coarse.curvature().sum(), expected, 1e-9);
		for (const Vertex root : roots)
			EXPECT_FALSE(c.boundary == ConeBoundary::Fixed && boundary[root]);
	}
}

/// Root mean square of the factor that takes the curvature from a surface.
double flatteningSize(LinearFlow& flow)
{
	VertexVector rhs = -flow.curvature();
	if (flow.hasFixedSum())
		rhs -= rhs.sum() * flow.area();
	return std::sqrt(flow.meanSquare(flow.solve(rhs)));
}

TEST(OnAggregates, FlattensAsMuchAsTheSurface)
{
	for (const LinearCase& c : fineCases()) {
		SCOPED_TRACE(c.name);
		Linearised fine(c);
		const double size = flatteningSize(fine.flow);
		for (const int vertices : {300, 1500}) {
			VertexArray<Vertex> roots;
			LinearFlow coarse = onAggregates(fine.flow.system(roots), vertices, roots);
			EXPECT_NEAR(flatteningSize(coarse), size, 0.03 * size) << vertices;
		}
	}
}

TEST(OnAggregates, HasTheFactorsOfTheSurface)
{
	for (const LinearCase& c : fineCases()) {
		SCOPED_TRACE(c.name);
		Linearised fine(c);
		VertexArray<Vertex> roots;
		LinearFlow coarse = onAggregates(fine.flow.system(roots), 1500, roots);
		const VertexVector& area = coarse.area();
		for (const int k : {roots.size() / 5, roots.size() / 2}) {
			// The adjoint field of a cone, by which cones are placed.
			const VertexVector u = factorOfCone(fine.flow, roots[Vertex(k)]);
			const VertexVector phi = fine.flow.gradient(u);
			VertexVector own = coarse.gradient(factorOfCone(coarse, Vertex(k)));
			VertexVector wanted(own.size());
			for (const Vertex v : own.indices())
				wanted[v] = phi[roots[v]];
			wanted.array() -= area.dot(wanted);
			own.array() -= area.dot(own);
			const double ownSize = std::sqrt(coarse.meanSquare(own));
			const double size = std::sqrt(coarse.meanSquare(wanted));
			const double product = area.dot(own.cwiseProduct(wanted));
			EXPECT_GT(product, 0.995 * ownSize * size);
			EXPECT_NEAR(ownSize, size, 0.2 * size);
		}
	}
}

/// Lengths of the shortest paths from \p v to every site.
VertexArray<double> distancesFrom(const ConeSites& sites, Vertex v)
{
	return shortestPaths<Vertex, Vertex>(
			   sites.toCut().size(),
			   {v},
			   [&](Vertex from, const auto& visit) {
				   for (const ConeSites::Way& way : sites.ways(from))
					   visit(way.to, way.length, from);
			   })
		.distance;
}

/// Length of the minimum spanning tree of \p roots by the distances of \p sites between them.
double treeLength(const ConeSites& sites, const std::vector<Vertex>& roots)
{
	std::vector<double> nearest = {};
	nearest.assign(roots.size(), 1e300);
	std::vector<char> isJoined(roots.size(), 0);
	std::size_t last = 0;
	double length = 0.0;
	for (std::size_t joined = 1; joined < roots.size(); ++joined) {
		isJoined[last] = 1;
		const VertexArray<double> distance = distancesFrom(sites, roots[last]);
		std::size_t next = roots.size();
		for (std::size_t i = 0; i < roots.size(); ++i) {
			if (isJoined[i])
				continue;
			nearest[i] = std::min(nearest[i], distance[roots[i]]);
			if (next == roots.size() || nearest[i] < nearest[next])
				next = i;
		}
		length += nearest[next];
		last = next;
	}
	return length;
}

TEST(ConeSites, ChosenOnesKeepTheirSpanningTree)
{
	Random random(811);
	const Packed p(shaken(perforatedSlab(2, 6), 0.05, random));
	const EmbeddedSurface surface = surfaceOf(p);
	const ConeSites fine(surface, -1);
	VertexArray<Vertex> chosen;
	std::vector<Vertex> inFine, inCoarse;
	for (int v = 3; v < surface.triangulation.vertexCount(); v += 1 + random.index(40)) {
		inCoarse.push_back(Vertex(chosen.size()));
		inFine.push_back(Vertex(v));
		chosen.push_back(Vertex(v));
	}
	const ConeSites coarse(fine, chosen);
	EXPECT_EQ(coarse.count(), chosen.size());
	const double length = treeLength(fine, inFine);
	EXPECT_NEAR(treeLength(coarse, inCoarse), length, 1e-12 * length);
	for (std::size_t i = 0; i < inFine.size(); i += 7) {
		const VertexArray<double> exact = distancesFrom(fine, inFine[i]);
		const VertexArray<double> longer = distancesFrom(coarse, inCoarse[i]);
		for (std::size_t k = 0; k < inFine.size(); ++k)
			EXPECT_GE(longer[inCoarse[k]], exact[inFine[k]] - 1e-12);
	}
}

} // namespace
} // namespace ricci::testing
