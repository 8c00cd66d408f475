// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flat_map.h"
#include "support/flipped_flow.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/base/tolerances.h>
#include <ricci/curvature/area_change.h>
#include <ricci/measure/distortion.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace ricci::testing {
namespace {

EmbeddedSurface surfaceOf(const SurfaceMesh& mesh)
{
	return embeddedSurface(VertexArray<Point3>(mesh.positions), mesh.triangles);
}

VertexVector randomFactor(int size, double bound, Random& random)
{
	VertexVector u(size);
	for (const Vertex v : u.indices())
		u[v] = random.real(-bound, bound);
	return u;
}

void expectSame(const AreaChange& a, const AreaChange& b, double tolerance)
{
	EXPECT_NEAR(a.mean / b.mean, 1.0, tolerance);
	EXPECT_NEAR(a.spread, b.spread, tolerance * (1.0 + b.spread));
}

/// The change of areas by other formulas, from places in space.
AreaChange byFaces(const SurfaceMesh& mesh, const VertexVector& u)
{
	std::vector<long double> area, factor;
	long double total = 0.0L, scaled = 0.0L;
	for (const Triangle& t : mesh.triangles) {
		const auto place = [&](std::size_t k, std::size_t i) {
			return static_cast<long double>(mesh.positions[at(t[k])][i]) -
				   static_cast<long double>(mesh.positions[at(t[0])][i]);
		};
		long double square = 0.0L;
		for (std::size_t i = 0; i < 3; ++i) {
			const std::size_t j = (i + 1) % 3;
			const long double normal = place(1, i) * place(2, j) - place(1, j) * place(2, i);
			square += normal * normal;
		}
		area.push_back(0.5L * std::sqrt(square));
		factor.push_back(1.0L);
		for (const int v : t)
			factor.back() *= std::exp(2.0L / 3.0L * static_cast<long double>(u[Vertex(v)]));
		total += area.back();
		scaled += area.back() * factor.back();
	}
	long double mean = 0.0L, logMean = 0.0L, variance = 0.0L;
	for (std::size_t f = 0; f < area.size(); ++f) {
		const long double s = factor[f] * total / scaled;
		mean += area[f] / total * std::max(s, 1.0L / s);
		logMean += area[f] / total * std::log(s);
	}
	for (std::size_t f = 0; f < area.size(); ++f) {
		const long double x = std::log(factor[f] * total / scaled) - logMean;
		variance += area[f] / total * x * x;
	}
	return {static_cast<double>(mean), static_cast<double>(std::sqrt(variance))};
}

/// A strip of width 1 with a left part of this share, joined to the right by a column of cells with
/// no area to speak of; and the factor that is \p left there and \p right beyond.
struct TwoParts
{
	SurfaceMesh mesh;
	VertexVector factor;

	TwoParts(double share, double left, double right)
	{
		const double x[] = {0.0, 0.5 * share, share, share + 1e-11, 0.5 * (1.0 + share), 1.0};
		mesh = grid(5, 3, Ends::Open, Ends::Open, [&](int i, int j) {
			return Point3{x[i], j / 3.0, 0.0};
		});
		factor.resize(static_cast<Eigen::Index>(mesh.positions.size()));
		for (const Vertex v : factor.indices())
			factor[v] = mesh.positions[at(v)][0] <= share ? left : right;
	}
};

TEST(AreaChange, OfTwoPartsIsKnown)
{
	for (const double share : {0.5, 0.25, 0.9})
		for (const double step : {0.3, 2.0, -3.0}) {
			const TwoParts parts(share, 0.7 + step, 0.7);
			const double rest = 1.0 - share;
			const double scale = share * std::exp(2 * step) + rest;
			const double s = std::exp(2 * step) / scale, t = 1.0 / scale;
			const double mean = share * std::max(s, 1 / s) + rest * std::max(t, 1 / t);
			const AreaChange change = areaChange(surfaceOf(parts.mesh), parts.factor);
			EXPECT_NEAR(change.mean, mean, 1e-8 * mean);
			EXPECT_NEAR(change.spread, std::abs(2 * step) * std::sqrt(share * rest), 1e-8);
		}
}

TEST(AreaChange, IsTheMeanOverTheFaces)
{
	Random random(800);
	for (const SurfaceMesh& mesh : surfacesOfEveryKind(random)) {
		const VertexVector u = randomFactor(static_cast<int>(mesh.positions.size()), 3.0, random);
		expectSame(areaChange(surfaceOf(mesh), u), byFaces(mesh, u), 1e-10);
	}
}

TEST(AreaChange, OfAConstantFactorIsNone)
{
	Random random(801);
	const EmbeddedSurface surface = surfaceOf(bumpyTorus(12, 9, random));
	for (const double c : {0.0, -3.0, 700.0}) { // exp(2 c) is no double for the last
		const VertexVector u = VertexVector::Constant(surface.triangulation.vertexCount(), c);
		expectSame(areaChange(surface, u), {1.0, 0.0}, 1e-6);
	}
}

TEST(AreaChange, DependsOnNoConstantNoScaleAndNoNumbers)
{
	Random random(802);
	for (const SurfaceMesh& mesh : surfacesOfEveryKind(random)) {
		const int size = static_cast<int>(mesh.positions.size());
		const VertexVector u = randomFactor(size, 2.0, random);
		const AreaChange change = areaChange(surfaceOf(mesh), u);
		const VertexVector weights = tailWeights(surfaceOf(mesh), u);
		EXPECT_GT(change.spread, 0.3); // or there is nothing to compare
		for (const double c : {5.0, -400.0}) {
			const VertexVector moved = (u.array() + c).matrix();
			expectSame(areaChange(surfaceOf(mesh), moved), change, 1e-11);
			EXPECT_LT(
				(tailWeights(surfaceOf(mesh), moved) - weights).lpNorm<Eigen::Infinity>(), 1e-11);
		}
		expectSame(areaChange(surfaceOf(scaled(mesh, 3e-7)), u), change, 1e-11);
		const Renumbered other = renumbered(mesh, random);
		VertexVector renamed(size);
		for (const Vertex v : renamed.indices())
			renamed[v] = u[Vertex(other.vertex[at(v)])];
		expectSame(areaChange(surfaceOf(other.mesh), renamed), change, 1e-12);
		const VertexVector otherWeights = tailWeights(surfaceOf(other.mesh), renamed);
		for (const Vertex v : renamed.indices())
			EXPECT_NEAR(otherWeights[v], weights[Vertex(other.vertex[at(v)])], 1e-12);
	}
}

TEST(AreaChange, OfTheInverseFactorHasTheSameSpread)
{
	Random random(803);
	const SurfaceMesh mesh = bumpyTorus(14, 9, random);
	const VertexVector u = randomFactor(static_cast<int>(mesh.positions.size()), 1.0, random);
	const VertexVector inverse = -u, twice = 2.0 * u;
	const AreaChange change = areaChange(surfaceOf(mesh), u);
	EXPECT_NEAR(areaChange(surfaceOf(mesh), inverse).spread, change.spread, 1e-12);
	EXPECT_NEAR(areaChange(surfaceOf(mesh), twice).spread, 2 * change.spread, 1e-12);
	EXPECT_GT(areaChange(surfaceOf(mesh), twice).mean, change.mean);
}

TEST(AreaChange, IsThatOfTheDrawnMap)
{
	// A sphere with a hole, which becomes flat with its boundary kept; spheres with four cones.
	Random random(804);
	const struct
	{
		SurfaceMesh mesh;
		std::vector<int> cones;
	} cases[] = {
		{sphereWithTube(0.5, 0.1, 1.0, 40, 80), {}},
		{shaken(perforatedSlab(0, 10), 0.01, random), {0, 40, 300, 500}},
		{sphereWithTube(0.5, 1.0, 0.0, 40, 80), {0, 700, 1400, 2000}}};
	for (const auto& c : cases) {
		SCOPED_TRACE(c.cones.size());
		Options options;
		options.output = OutputTriangulation::CommonRefinement;
		options.target =
			c.cones.empty() ? TargetCurvature::Prescribed : TargetCurvature::SelectedCones;
		VertexInput input = selecting(c.mesh, c.cones);
		input.targetCurvature.assign(c.mesh.positions.size(), 0.0);
		const Report report = run(c.mesh, options, input).report;
		const FlippedFlow flow(
			c.mesh,
			c.cones.empty() ? prescribed(input.targetCurvature, true) : conesAt(c.mesh, c.cones));
		const AreaChange change = areaChange(flow.surface(), flowFactor(flow.result));
		EXPECT_GT(change.spread, 0.3);
		EXPECT_NEAR(change.spread / report.areaDistortionSpread, 1.0, 0.03);
		EXPECT_NEAR(change.mean / report.areaDistortionMean, 1.0, 0.03);
	}
}

/// Mean of exp |x| for a normally distributed x with mean 0, by Simpson's rule.
double meanOfNormal(double spread)
{
	const int n = 4000;
	const double end = 12.0 + spread, h = end / n;
	double sum = 0.0;
	for (int i = 0; i <= n; ++i) {
		const double x = i * h;
		const double weight = i == 0 || i == n ? 1.0 : i % 2 == 0 ? 2.0 : 4.0;
		sum += weight * std::exp(spread * x - 0.5 * x * x);
	}
	return sum * h / 3.0 * std::sqrt(2.0 / std::acos(-1.0));
}

TEST(AreaExcess, IsOneAtItsBounds)
{
	for (const double spread : {0.1, 0.5, 1.0, 2.0, 4.0}) {
		EXPECT_NEAR(areaExcess({1.0, spread}, spread), 1.0, 1e-15);
		EXPECT_NEAR(areaExcess({1.0, kSpreadSlack * spread}, spread, kSpreadSlack), 1.0, 1e-15);
		EXPECT_NEAR(areaExcess({1.0, 3.0 * spread}, spread), 3.0, 1e-14);
		double mean = kMaxAreaMean;
		if (spread > kWideSpread)
			mean *= meanOfNormal(spread) / meanOfNormal(kWideSpread);
		EXPECT_NEAR(areaExcess({mean, 0.0}, spread), 1.0, 1e-9) << spread;
		EXPECT_NEAR(areaExcess({mean, 0.0}, spread, 1.7), 1.0, 1e-9); // the slack is the spread's
	}
}

TEST(AreaExcess, GrowsWithTheChangeAndFallsWithWhatIsAllowed)
{
	Random random(805);
	for (int i = 0; i < 500; ++i) {
		const AreaChange change{std::exp(random.real(0.0, 8.0)), random.real(0.0, 5.0)};
		const double spread = random.real(0.05, 4.0), more = random.real(1.01, 2.0);
		const double excess = areaExcess(change, spread);
		EXPECT_LE(excess, areaExcess({change.mean * more, change.spread}, spread));
		EXPECT_LE(excess, areaExcess({change.mean, change.spread * more}, spread));
		EXPECT_LT(excess, areaExcess({change.mean * more, change.spread * more}, spread));
		EXPECT_GE(excess, areaExcess(change, spread * more));
		EXPECT_GE(excess, areaExcess(change, spread, more));
	}
}

/// The vertices' shares in the area.
VertexVector vertexAreas(const SurfaceMesh& mesh)
{
	VertexVector area = VertexVector::Zero(static_cast<Eigen::Index>(mesh.positions.size()));
	const EmbeddedSurface surface = surfaceOf(mesh);
	for (const Triangle& t : mesh.triangles) {
		const double a = triangleArea(
			{mesh.positions[at(t[0])], mesh.positions[at(t[1])], mesh.positions[at(t[2])]});
		for (const int v : t)
			area[Vertex(v)] += a / 3.0;
	}
	return area / area.sum();
}

TEST(TailWeights, HaveTheDerivativeOfTheHyperbolicCosine)
{
	Random random(806);
	for (const SurfaceMesh& mesh : surfacesOfEveryKind(random)) {
		const int size = static_cast<int>(mesh.positions.size());
		const EmbeddedSurface surface = surfaceOf(mesh);
		VertexVector u = randomFactor(size, 0.3, random);
		u[Vertex(random.index(size))] += 1.5; // a tail
		ASSERT_LT(areaChange(surface, u).spread, kWideSpread);
		const VertexVector area = vertexAreas(mesh), weights = tailWeights(surface, u);
		EXPECT_NEAR(weights.sum(), 1.0, 1e-13);
		const auto cosine = [&](const VertexVector& x, double c) {
			return area.dot(((2.0 * x.array() - c).cosh()).matrix());
		};
		// The best c, by ternary search of a convex function.
		double low = -10.0, high = 10.0;
		for (int i = 0; i < 200; ++i) {
			const double a = low + (high - low) / 3, b = high - (high - low) / 3;
			if (cosine(u, a) < cosine(u, b))
				high = b;
			else
				low = a;
		}
		const double c = 0.5 * (low + high);
		const auto square = [&](const VertexVector& x) {
			return 0.5 * weights.dot((2.0 * x.array() - c).square().matrix());
		};
		VertexVector a(size), b(size);
		const double step = 1e-4;
		for (const Vertex v : u.indices()) {
			VertexVector up = u, down = u;
			up[v] += step;
			down[v] -= step;
			a[v] = (square(up) - square(down)) / (2 * step);
			b[v] = (cosine(up, c) - cosine(down, c)) / (2 * step);
		}
		// Weights add up to 1, so that one factor is common to all vertices.
		const double common = a.dot(b) / b.dot(b);
		EXPECT_GT(common, 0.1);
		EXPECT_LT((a - common * b).lpNorm<Eigen::Infinity>(), 1e-6 * a.lpNorm<Eigen::Infinity>());
		// The areas alone do not have it.
		const VertexVector plain = (area.array() * (2.0 * u.array() - c)).matrix();
		const VertexVector missed = plain - plain.dot(b) / b.dot(b) * b;
		EXPECT_GT(missed.lpNorm<Eigen::Infinity>(), 0.01 * plain.lpNorm<Eigen::Infinity>());
	}
}

TEST(TailWeights, AreTheAreasWhereTheFactorIsConstantOrSpreadsFar)
{
	Random random(807);
	for (const SurfaceMesh& mesh : surfacesOfEveryKind(random)) {
		const int size = static_cast<int>(mesh.positions.size());
		const EmbeddedSurface surface = surfaceOf(mesh);
		const VertexVector area = vertexAreas(mesh), far = randomFactor(size, 6.0, random);
		ASSERT_GT(areaChange(surface, far).spread, kWideSpread);
		for (const VertexVector& u : {far, VertexVector(VertexVector::Constant(size, 0.4))})
			EXPECT_LT((tailWeights(surface, u) - area).lpNorm<Eigen::Infinity>(), 1e-12);
	}
}

} // namespace
} // namespace ricci::testing
