// SPDX-License-Identifier: GPL-3.0-or-later
#include "area_change.h"

#include "../base/tolerances.h"
#include "../flow/target.h"
#include "../metric/area.h"

#include <algorithm>
#include <cmath>

namespace ricci {

namespace {

/// Largest multiple of its area that a vertex weighs.
constexpr double kMaxTailWeight = 1e6;

/// Below this x, sinh(x) / x is 1 to the last place but two.
constexpr double kSmallTail = 1e-6;

/// Share of each triangle in the area of the surface in space.
FaceArray<double> areaShares(const EmbeddedSurface& surface)
{
	const Triangulation& t = surface.triangulation;
	FaceArray<double> share(t.faceCount());
	double total = 0.0;
	for (const Face f : t.faces()) {
		share[f] = euclideanArea(sidesOf(t, surface.lengths, f));
		total += share[f];
	}
	for (double& s : share)
		s /= total;
	return share;
}

/// ln of the mean of exp(\p x), which may be too large for a double, with weights that add up to 1.
template<class Index>
double logMean(const IndexedArray<Index, double>& weight, const IndexedArray<Index, double>& x)
{
	const double largest = *std::max_element(x.begin(), x.end());
	double sum = 0.0;
	for (const Index i : x.indices())
		sum += weight[i] * std::exp(x[i] - largest);
	return largest + std::log(sum);
}

/// ln of the mean of exp |x| for a normally distributed x with mean 0.
double logMeanOfNormal(double spread)
{
	return 0.5 * spread * spread + std::log(std::erfc(-spread / std::sqrt(2.0)));
}

} // namespace

AreaChange areaChange(const EmbeddedSurface& surface, const VertexVector& factor)
{
	const Triangulation& t = surface.triangulation;
	const FaceArray<double> share = areaShares(surface);
	FaceArray<double> logFactor(t.faceCount());
	for (const Face f : t.faces())
		for (const Vertex v : t.vertices(f))
			logFactor[f] += 2.0 / 3.0 * factor[v];
	const double level = logMean(share, logFactor);
	double mean = 0.0, meanInverse = 0.0, logSum = 0.0, logSquare = 0.0;
	for (const Face f : t.faces()) {
		const double x = logFactor[f] - level;
		mean += share[f] * std::exp(std::abs(x));
		meanInverse += share[f] * std::exp(-x);
		logSum += share[f] * x;
		logSquare += share[f] * x * x;
	}
	return {
		mean,
		std::sqrt(std::max(0.0, logSquare - logSum * logSum)),
		energyAtBestScale(2.0, 2.0 * meanInverse, 1.0)};
}

double areaExcess(const AreaChange& change, double spread, double slack)
{
	const double maxLogMean = std::log(kMaxAreaMean) +
							  std::max(0.0, logMeanOfNormal(spread) - logMeanOfNormal(kWideSpread));
	return std::max(change.spread / (slack * spread), std::log(change.mean) / maxLogMean);
}

VertexVector tailWeights(const EmbeddedSurface& surface, const VertexVector& factor)
{
	const Triangulation& t = surface.triangulation;
	const FaceArray<double> share = areaShares(surface);
	VertexArray<double> area(t.vertexCount(), 0.0), plus(t.vertexCount()), minus(t.vertexCount());
	for (const Face f : t.faces())
		for (const Vertex v : t.vertices(f))
			area[v] += share[f] / 3.0;
	for (const Vertex v : t.vertices()) {
		plus[v] = 2.0 * factor[v];
		minus[v] = -plus[v];
	}
	const bool isLinear = areaChange(surface, factor).spread <= kWideSpread;
	const double centre = 0.5 * (logMean(area, plus) - logMean(area, minus));
	VertexVector weights(t.vertexCount());
	for (const Vertex v : t.vertices()) {
		const double x = std::abs(plus[v] - centre);
		const double tail =
			isLinear && x > kSmallTail ? std::min(std::sinh(x) / x, kMaxTailWeight) : 1.0;
		weights[v] = area[v] * tail;
	}
	return weights / weights.sum();
}

} // namespace ricci
