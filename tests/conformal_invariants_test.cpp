// SPDX-License-Identifier: GPL-3.0-or-later
// Conformal invariants of surfaces for which they are known, by the whole way from mesh to plane.
#include "support/flat_map.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/base/numbers.h>
#include <ricci/parametrize.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace ricci::testing {
namespace {

double imTau(const SurfaceMesh& mesh)
{
	Options options;
	options.target = TargetCurvature::Flat; // with cones there would be no modulus
	const FlatResult flat = run(mesh, options);
	EXPECT_TRUE(flat.report.torusTauIm);
	EXPECT_NEAR(flat.report.torusTauRe.value_or(1), 0.0, 1e-9);
	return flat.report.torusTauIm.value_or(0);
}

TEST(Invariants, OfToriOfRevolutionAtAHundredThousandFaces)
{
	// tau = i sqrt(R^2 - r^2) / r or its inverse.
	for (const double R : {2.0, std::sqrt(2.0), 1.7}) {
		const double ratio = std::sqrt(R * R - 1);
		const double exact = std::max(ratio, 1 / ratio);
		std::vector<double> values;
		for (const int n : {56, 112, 224})
			values.push_back(imTau(torus(R, 1.0, n, n)));
		EXPECT_LT(std::abs(values[2] - exact), 5e-5) << "R = " << R;
		for (std::size_t i = 1; i < values.size(); ++i)
			EXPECT_NEAR(
				std::log2(std::abs((values[i - 1] - exact) / (values[i] - exact))), 2.0, 0.05);
		// Richardson: the error of second order cancels, the next is of fourth.
		const double extrapolated = (4 * values[2] - values[1]) / 3;
		EXPECT_LT(std::abs(extrapolated - exact), 1e-6) << "R = " << R;
	}
}

/// Arithmetic-geometric mean: K(k) = pi / 2 agm(1, sqrt(1 - k^2)).
double agm(double a, double b)
{
	while (std::abs(a - b) > 1e-15 * a) {
		const double mean = 0.5 * (a + b);
		b = std::sqrt(a * b);
		a = mean;
	}
	return a;
}

/// Extremal distance of the two intervals (0, 1) and (a, infinity) in the upper half plane, a > 1:
/// K'(k) / K(k) for k^2 = 1 / a.
double halfPlaneModulus(double a)
{
	const double k = std::sqrt(1 / a), complement = std::sqrt(1 - 1 / a);
	return agm(1.0, complement) / agm(1.0, k);
}

template<class Function>
double integral(double from, double to, Function f) // Simpson's rule
{
	const int n = 2000;
	double sum = f(from) + f(to);
	for (int i = 1; i < n; ++i)
		sum += (i % 2 ? 4 : 2) * f(from + (to - from) * i / n);
	return sum * (to - from) / (3 * n);
}

/// Distance of the two ends of the L of three unit squares over their width. Its diagonal is a line
/// of symmetry, so it is twice that of the trapezoid (0,0), (2,0), (2,1), (1,1) between the side at
/// x = 2 and the diagonal. The Schwarz-Christoffel integral with the corners at infinity, 0, 1 and a
/// has the derivative w^(-1/2) (w - 1)^(-1/2) (w - a)^(-1/4); a makes the sides of length 1 equal.
double modulusOfL()
{
	const auto excess = [](double a) {
		const double end = integral(0.0, kPi / 2, [&](double t) { // w = sin^2 t
			return 2 * std::pow(a - std::pow(std::sin(t), 2), -0.25);
		});
		const double top = integral(0.0, 1.0, [&](double r) { // w = 1 + (a - 1) p^2, p = 1 - r^4
			const double p = 1 - std::pow(r, 4), w = 1 + (a - 1) * p * p;
			return 8 * r * r * std::pow(a - 1, 0.25) * std::pow(2 - std::pow(r, 4), -0.25) /
				   std::sqrt(w);
		});
		return top - end;
	};
	double low = 1.0 + 1e-9, high = 100.0;
	while (high - low > 1e-14 * high) {
		const double middle = 0.5 * (low + high);
		(excess(middle) < 0 ? low : high) = middle;
	}
	return 2 * halfPlaneModulus(low);
}

/// The L of three squares of n x n cells without [1,2]^2; \p select corners by their place.
SurfaceMesh shapeL(int n)
{
	SurfaceMesh square = rectangle(2 * n, 2 * n, 2.0, 2.0), mesh;
	std::vector<int> number(square.positions.size(), -1);
	for (const Triangle& t : square.triangles) {
		double x = 0.0, y = 0.0;
		for (int v : t) {
			x += square.positions[at(v)][0] / 3;
			y += square.positions[at(v)][1] / 3;
		}
		if (x > 1 && y > 1)
			continue;
		Triangle own = t;
		for (int& v : own) {
			int& i = number[at(v)];
			if (i < 0) {
				i = static_cast<int>(mesh.positions.size());
				mesh.positions.push_back(square.positions[at(v)]);
			}
			v = i;
		}
		mesh.triangles.push_back(own);
	}
	return mesh;
}

double aspect(const SurfaceMesh& mesh, const std::vector<Point2>& corners)
{
	VertexInput input;
	for (const Point3& p : mesh.positions) {
		char selected = 0;
		for (const Point2& c : corners)
			selected |= std::hypot(p[0] - c[0], p[1] - c[1]) < 1e-9;
		input.selected.push_back(selected);
	}
	Options options;
	options.target = TargetCurvature::Rectangle;
	const FlatResult flat = run(mesh, options, input);
	EXPECT_TRUE(flat.report.rectangleAspect);
	return flat.report.rectangleAspect.value_or(0);
}

TEST(Invariants, OfTheLShapeBetweenItsEnds)
{
	const double exact = modulusOfL();
	// Known from the resistance of a corner: two squares and 0.559 of one.
	EXPECT_NEAR(exact, 2.559, 1e-3);
	std::vector<double> errors;
	for (int n : {8, 16, 32, 64})
		errors.push_back(std::abs(aspect(shapeL(n), {{2, 0}, {2, 1}, {1, 2}, {0, 2}}) - exact));
	// A finite element's energy would lose order at the corner of 3 pi / 2, where the map behaves
	// like z^(2/3); a conformal scale at the corner follows it.
	for (std::size_t i = 1; i < errors.size(); ++i)
		EXPECT_NEAR(std::log2(errors[i - 1] / errors[i]), 2.0, 0.2);
	EXPECT_LT(errors.back(), 1e-3);
}

TEST(Invariants, OfTheLShapeThatEqualsItsConjugate)
{
	// The reflection in the diagonal exchanges the two pairs of opposite sides: modulus 1. On a mesh
	// without that symmetry too, in the limit.
	std::vector<double> errors;
	for (int n : {6, 12, 24}) {
		SurfaceMesh mesh = shapeL(n);
		for (Point3& p : mesh.positions) { // moves vertices inside only
			const double bump = std::sin(kPi * p[0]) * std::sin(kPi * p[1]);
			p[0] += 0.15 * bump;
			p[1] -= 0.05 * bump;
		}
		errors.push_back(aspect(mesh, {{0, 0}, {2, 0}, {1, 1}, {0, 2}}) - 1.0);
	}
	for (std::size_t i = 1; i < errors.size(); ++i)
		EXPECT_LT(errors[i], 0.6 * errors[i - 1]);
	EXPECT_LT(errors.back(), 0.01);
}

TEST(Invariants, OfARectangleWithOtherCorners)
{
	// The map of the rectangle (-K, K) x (0, K') to the half plane by sn takes the ends of its lower
	// side's middle half to known places: the quadrilateral of these two and the two upper corners
	// has the cross-ratio of sn(-K/2), sn(K/2), 1/k, -1/k with sn(K/2) = 1 / sqrt(1 + k').
	const double k = 0.5, k1 = std::sqrt(1 - k * k);
	const double K = kPi / (2 * agm(1, k1)), height = kPi / (2 * agm(1, k));
	const double s = 1 / std::sqrt(1 + k1);
	// Moebius: (-s, s) -> (0, 1), (1/k, -1/k) -> (a, infinity).
	const double a = (1 / k + s) / (1 / k - (-1 / k)) * (s + 1 / k) / (2 * s);
	const double modulus = halfPlaneModulus(a), exact = std::max(modulus, 1 / modulus);
	std::vector<double> errors;
	for (int n : {8, 16, 32}) {
		SurfaceMesh mesh = rectangle(4 * n, 4 * n, 2 * K, height);
		errors.push_back(std::abs(
			aspect(mesh, {{K / 2, 0.0}, {3 * K / 2, 0.0}, {2 * K, height}, {0.0, height}}) -
			exact));
	}
	for (std::size_t i = 1; i < errors.size(); ++i)
		EXPECT_LT(errors[i], 0.6 * errors[i - 1]) << errors[i];
	EXPECT_LT(errors.back(), 0.02 * exact);
}

} // namespace
} // namespace ricci::testing
