// SPDX-License-Identifier: GPL-3.0-or-later
#include "circle_target.h"

#include "../base/numbers.h"
#include "../base/tolerances.h"
#include "../error.h"
#include "../numerics/anderson_mixing.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

namespace ricci {

namespace {

using Complex = std::complex<double>;

/// Bisections of the radius of an inscribed polygon; about 55 halve an interval until it is empty.
constexpr int kMaxBisections = 200;

/// Steps of Newton's method for the conformal barycentre, which needs about ten.
constexpr int kMaxCentringSteps = 100;

/// A step of that method that moves the centre further than this is too far.
constexpr double kMaxCentringStep = 0.5;

/// Fixed-point iterations of the circle; without mixing each one halves the error about.
constexpr int kMaxCircleSteps = 100;

/// Images that Anderson mixing combines.
constexpr std::size_t kMixingDepth = 10;

/// The inner solves are this much more exact than the last change of the target.
constexpr double kInnerAccuracy = 1e-2;

double arcOf(double side, double radius)
{
	return 2.0 * std::asin(std::min(1.0, side / (2.0 * radius)));
}

/// Largest difference of the points on the circle that two sequences of arcs describe.
double largestTurn(const std::vector<double>& a, const std::vector<double>& b)
{
	double turn = 0.0, min = 0.0, max = 0.0;
	for (std::size_t i = 0; i < a.size(); ++i) {
		turn += a[i] - b[i];
		min = std::min(min, turn);
		max = std::max(max, turn);
	}
	return max - min;
}

} // namespace

InscribedPolygon inscribedPolygon(const std::vector<double>& sides)
{
	const auto longestSide = std::max_element(sides.begin(), sides.end());
	const double longest = *longestSide;
	// Sum of the arcs less 2 pi as a function of the radius: decreasing while the centre is inside.
	// If it is negative already where the longest side is a diameter, the centre lies beyond that
	// side, whose arc then is the larger of the two.
	const auto excess = [&](double radius, bool outside) {
		double sum = 0.0;
		for (auto side = sides.begin(); side != sides.end(); ++side)
			sum += outside && side == longestSide ? 2 * kPi - arcOf(*side, radius)
												  : arcOf(*side, radius);
		return sum - 2 * kPi;
	};
	const bool outside = excess(0.5 * longest, false) < 0.0;
	const auto isTooLarge = [&](double radius) {
		return outside ? excess(radius, true) > 0.0 : excess(radius, false) < 0.0;
	};
	double min = 0.5 * longest, max = longest;
	while (!isTooLarge(max) && std::isfinite(max))
		max *= 2.0;
	for (int i = 0; i < kMaxBisections; ++i) {
		const double middle = 0.5 * (min + max);
		double& bound = isTooLarge(middle) ? max : min;
		if (bound == middle) // no double lies between the two
			break;
		bound = middle;
	}
	InscribedPolygon polygon;
	polygon.radius = 0.5 * (min + max);
	double sum = 0.0;
	for (auto side = sides.begin(); side != sides.end(); ++side) {
		const double arc = arcOf(*side, polygon.radius);
		polygon.arcs.push_back(outside && side == longestSide ? 2 * kPi - arc : arc);
		sum += polygon.arcs.back();
	}
	for (double& arc : polygon.arcs)
		arc *= 2 * kPi / sum;
	return polygon;
}

std::vector<double> exteriorAngles(const std::vector<double>& arcs)
{
	std::vector<double> angles(arcs.size());
	for (std::size_t i = 0; i < arcs.size(); ++i)
		angles[i] = 0.5 * (arcs[i] + arcs[(i + arcs.size() - 1) % arcs.size()]);
	return angles;
}

std::vector<double> centredArcs(const std::vector<double>& arcs, const std::vector<double>& weights)
{
	const std::size_t n = arcs.size();
	std::vector<Complex> z(n);
	double angle = 0.0, total = 0.0;
	for (std::size_t i = 0; i < n; ++i) {
		z[i] = std::polar(1.0, angle);
		angle += arcs[i];
		total += weights[i];
	}
	if (*std::max_element(weights.begin(), weights.end()) >= 0.5 * total)
		return arcs;
	// Newton's method on the barycentre b of the present points: moving w to the centre changes b
	// by -w + conj(w) mean(z^2) to first order.
	for (int iteration = 0; iteration < kMaxCentringSteps; ++iteration) {
		Complex b = 0.0, square = 0.0;
		for (std::size_t i = 0; i < n; ++i) {
			b += weights[i] * z[i];
			square += weights[i] * z[i] * z[i];
		}
		b /= total, square /= total;
		if (std::abs(b) < kCentredArcs)
			break;
		Complex w = (b + square * std::conj(b)) / (1.0 - std::norm(square));
		const double size = std::abs(w);
		if (!(size < kMaxCentringStep)) // half the way to the barycentre instead
			w = b / std::abs(b) * 0.5 * std::abs(b);
		for (Complex& p : z) {
			p = (p - w) / (1.0 - std::conj(w) * p);
			p /= std::abs(p);
		}
	}
	std::vector<double> centred(n);
	double sum = 0.0;
	for (std::size_t i = 0; i < n; ++i) {
		double arc = std::arg(z[(i + 1) % n] * std::conj(z[i]));
		if (arc < 0.0)
			arc += 2 * kPi;
		sum += centred[i] = arc;
	}
	for (double& arc : centred)
		arc *= 2 * kPi / sum;
	return centred;
}

NewtonResult solveForCircle(
	const std::vector<double>& sides,
	double epsilon,
	const BoundaryLengths& presentSides,
	const SolveForAngles& solve,
	std::vector<double>& arcs)
{
	std::vector<double> weights(sides.size());
	for (std::size_t i = 0; i < sides.size(); ++i)
		weights[i] = sides[i] + sides[(i + sides.size() - 1) % sides.size()];
	if (arcs.empty())
		arcs = centredArcs(inscribedPolygon(sides).arcs, weights);
	AndersonMixing mixing(kMixingDepth);
	double change = 1.0;
	for (int step = 0; step < kMaxCircleSteps; ++step) {
		const bool last = change < kCircleTolerance;
		const double accuracy =
			last ? epsilon : std::max(epsilon, std::min(kInnerAccuracy, kInnerAccuracy * change));
		const NewtonResult result = solve(exteriorAngles(arcs), accuracy);
		if (last || !result.converged)
			return result;
		const std::vector<double> image =
			centredArcs(inscribedPolygon(presentSides()).arcs, weights);
		change = largestTurn(image, arcs);
		std::vector<double> next = mixing.next(arcs, image);
		if (*std::min_element(next.begin(), next.end()) <= 0.0) {
			mixing.restart();
			next = image;
		}
		arcs = std::move(next);
	}
	throw NotConverged(NotConverged::CircleUnsettled, 0, change);
}

} // namespace ricci
