// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/base/tolerances.h>
#include <ricci/cones/area_change.h>

#include <gtest/gtest.h>

namespace ricci::testing {
namespace {

EmbeddedSurface surfaceOf(const SurfaceMesh& mesh)
{
	return embeddedSurface(VertexArray<Point3>(mesh.positions), mesh.triangles);
}

VertexVector randomFactor(const SurfaceMesh& mesh, double bound, Random& random)
{
	VertexVector u(static_cast<Eigen::Index>(mesh.positions.size()));
	for (double& x : u)
		x = random.real(-bound, bound);
	return u;
}

void expectSame(const AreaChange& a, const AreaChange& b, double tolerance)
{
	EXPECT_NEAR(a.mean / b.mean, 1.0, tolerance);
	EXPECT_NEAR(a.spread, b.spread, tolerance * (1.0 + b.spread));
	EXPECT_NEAR(a.energy / b.energy, 1.0, tolerance);
}

using Wide = long double;

Wide areaOf(const SurfaceMesh& mesh, const Triangle& t)
{
	const auto side = [&](std::size_t k, std::size_t i) {
		return static_cast<Wide>(mesh.positions[at(t[k])][i]) - mesh.positions[at(t[0])][i];
	};
	Wide square = 0.0L;
	for (std::size_t i = 0; i < 3; ++i) {
		const std::size_t j = (i + 1) % 3;
		const Wide normal = side(1, i) * side(2, j) - side(1, j) * side(2, i);
		square += normal * normal;
	}
	return 0.5L * std::sqrt(square);
}

/// The change of areas by other formulas, from places in space.
AreaChange byFaces(const SurfaceMesh& mesh, const VertexVector& u)
{
	std::vector<Wide> area, factor;
	Wide total = 0.0L, scaled = 0.0L;
	for (const Triangle& t : mesh.triangles) {
		area.push_back(areaOf(mesh, t));
		factor.push_back(1.0L);
		for (const int v : t)
			factor.back() *= std::exp(2.0L / 3.0L * static_cast<Wide>(u[Vertex(v)]));
		total += area.back();
		scaled += area.back() * factor.back();
	}
	Wide mean = 0.0L, inverse = 0.0L, logMean = 0.0L, variance = 0.0L;
	const auto overFaces = [&](const auto& add) {
		for (std::size_t f = 0; f < area.size(); ++f)
			add(area[f] / total, factor[f] * total / scaled);
	};
	overFaces([&](Wide share, Wide s) {
		mean += share * std::max(s, 1.0L / s);
		inverse += share / s;
		logMean += share * std::log(s);
	});
	overFaces([&](Wide share, Wide s) { variance += share * std::pow(std::log(s) - logMean, 2); });
	// A conformal map has |J|^2 = 2 s, |J^-1|^2 = 2 / s.
	return {
		static_cast<double>(mean),
		static_cast<double>(std::sqrt(variance)),
		static_cast<double>(4.0L * std::sqrt(inverse))};
}

TEST(AreaChange, IsTheMeanOverTheFaces)
{
	Random random(800);
	for (const SurfaceMesh& mesh : surfacesOfEveryKind(random)) {
		const EmbeddedSurface surface = surfaceOf(mesh);
		const VertexVector u = randomFactor(mesh, 3.0, random);
		const AreaChange change = areaChange(surface, u);
		expectSame(change, byFaces(mesh, u), 1e-10);
		EXPECT_NEAR(areaChange(surface, -2.0 * u).spread, 2 * change.spread, 1e-11);
		for (const double c : {5.0, -400.0, 700.0}) { // exp(2 c) is not a double for the last
			expectSame(areaChange(surface, (u.array() + c).matrix()), change, 1e-11);
			expectSame(areaChange(surface, VertexVector::Constant(u.size(), c)), {}, 1e-6);
		}
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
	return sum * h / 3.0 * std::sqrt(2.0 / kPi);
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

/// The weights' mean square has the derivative of the mean of the hyperbolic cosine by area at its best c,
/// up to a factor: 2 w (2 u - c) and 2 a sinh(2 u - c).
TEST(TailWeights, HaveTheDerivativeOfTheHyperbolicCosine)
{
	Random random(806);
	for (const SurfaceMesh& mesh : surfacesOfEveryKind(random)) {
		const EmbeddedSurface surface = surfaceOf(mesh);
		VertexVector area = VertexVector::Zero(static_cast<Eigen::Index>(mesh.positions.size()));
		for (const Triangle& t : mesh.triangles)
			for (const int v : t)
				area[Vertex(v)] += static_cast<double>(areaOf(mesh, t));
		area /= area.sum();
		VertexVector u = randomFactor(mesh, 0.3, random);
		u[Vertex(random.index(static_cast<int>(u.size())))] += 1.5; // a tail
		ASSERT_LT(areaChange(surface, u).spread, kWideSpread);
		const VertexVector weights = tailWeights(surface, u);
		EXPECT_NEAR(weights.sum(), 1.0, 1e-13);
		// The best c, where the mean of sinh(2 u - c) is 0.
		double low = -10.0, high = 10.0;
		for (int i = 0; i < 200; ++i) {
			const double c = 0.5 * (low + high);
			(area.dot((2.0 * u.array() - c).sinh().matrix()) > 0.0 ? low : high) = c;
		}
		const VertexVector x = (2.0 * u.array() - low).matrix();
		const VertexVector a = weights.cwiseProduct(x);
		const VertexVector b = area.cwiseProduct(x.array().sinh().matrix());
		const double common = a.dot(b) / b.dot(b), size = a.lpNorm<Eigen::Infinity>();
		EXPECT_GT(common, 0.1);
		EXPECT_LT((a - common * b).lpNorm<Eigen::Infinity>(), 1e-12 * size);
		const VertexVector shifted = tailWeights(surface, (u.array() + 5.0).matrix());
		EXPECT_LT((shifted - weights).lpNorm<Eigen::Infinity>(), 1e-11);
		// The areas, where the factor is constant or spreads far.
		const VertexVector far = randomFactor(mesh, 6.0, random);
		ASSERT_GT(areaChange(surface, far).spread, kWideSpread);
		for (const VertexVector& plain : {far, VertexVector(VertexVector::Constant(u.size(), 0.4))})
			EXPECT_LT((tailWeights(surface, plain) - area).lpNorm<Eigen::Infinity>(), 1e-12);
	}
}

} // namespace
} // namespace ricci::testing
