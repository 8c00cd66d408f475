// SPDX-License-Identifier: GPL-3.0-or-later
// Maps and conformal invariants that are known in closed form, by complete runs from mesh to plane.
#include "support/flat_map.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <utility>

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

/// Order of convergence seen in the errors on meshes of halved edges: log2 of their quotients.
void expectOrder(const std::vector<double>& errors, double order, double tolerance)
{
	for (std::size_t i = 1; i < errors.size(); ++i)
		EXPECT_NEAR(std::log2(errors[i - 1] / errors[i]), order, tolerance) << errors[i];
}

/// Conformal coordinates (u, integral of r dv / (R + r cos v)) make the torus a rectangle of sides 2 pi and
/// 2 pi r / sqrt(R^2 - r^2).
TEST(Invariants, OfToriOfRevolutionOnTheMeshItself)
{
	for (const auto& [R, r] : {std::pair{2.0, 1.0}, {5.0, 1.0}, {1.5, 1.0}}) {
		SCOPED_TRACE(R);
		const double ratio = std::sqrt(R * R - r * r) / r, exact = std::max(ratio, 1 / ratio);
		std::vector<double> errors;
		for (int n : {10, 20, 40}) {
			const int around = static_cast<int>(std::lround(2 * n * std::max(1.0, R / r / 2)));
			const Report report = run(torus(R, r, around, n), fixedTriangulation()).report;
			ASSERT_TRUE(report.torusTauIm);
			errors.push_back(std::hypot(*report.torusTauIm - exact, *report.torusTauRe));
			EXPECT_EQ(report.flippedFaces, 0);
		}
		expectOrder(errors, 2.0, 0.2);
		EXPECT_LT(errors.back(), 0.02 * exact);
	}
}

/// \p point(t, angle): from the inner boundary, t = 0, to the outer one
double annulusModulus(int n, const std::function<Point3(double, double)>& point)
{
	const SurfaceMesh mesh = grid(n, 4 * n, Ends::Open, Ends::Joined, [&](int i, int j) {
		return point(static_cast<double>(i) / n, kPi * j / (2 * n));
	});
	Options options;
	options.target = TargetCurvature::Flat;
	const Report report = run(mesh, options).report;
	EXPECT_EQ(report.flippedFaces, 0);
	EXPECT_TRUE(report.annulusModulus);
	return report.annulusModulus.value_or(0.0);
}

/// A planar ring, and a cone of revolution, whose slant radii take the place of the radii and whose angle round
/// the apex is 2 pi sin(half opening).
TEST(Invariants, OfRingsAndConesOfRevolution)
{
	for (const double sine : {1.0, 0.5})
		for (const double outer : {1.5, 4.0}) {
			SCOPED_TRACE(outer);
			std::vector<double> errors;
			for (const int n : {8, 16, 32}) {
				const double modulus = annulusModulus(n, [&](double t, double angle) {
					const double slant = 1.0 + (outer - 1.0) * t;
					return Point3{
						slant * sine * std::cos(angle),
						slant * sine * std::sin(angle),
						-slant * std::sqrt(1 - sine * sine)};
				});
				errors.push_back(std::abs(modulus - std::log(outer) / (2 * kPi * sine)));
			}
			expectOrder(errors, 2.0, 0.2);
		}
}

/// Between the unit circle and one of radius r whose centre lies at d: a Moebius transformation makes the circles
/// concentric, of ratio exp(acosh((1 + r^2 - d^2) / 2r)).
TEST(Invariants, OfEccentricRings)
{
	for (const auto& [r, d] : {std::pair{0.3, 0.5}, {0.5, 0.3}}) {
		SCOPED_TRACE(d);
		const double exact = std::acosh((1 + r * r - d * d) / (2 * r)) / (2 * kPi);
		std::vector<double> errors;
		for (const int n : {10, 20, 40})
			errors.push_back(std::abs(
				annulusModulus(
					n,
					[&, r = r, d = d](double t, double angle) {
						const double radius = r + t * (1 - r), x = (1 - t) * d;
						return Point3{x + radius * std::cos(angle), radius * std::sin(angle), 0.0};
					}) -
				exact));
		expectOrder(errors, 2.0, 0.25);
		EXPECT_LT(errors.back(), 1e-3);
	}
}

/// tau = i sqrt(R^2 - r^2) / r or its inverse.
TEST(Invariants, OfATorusOfRevolutionAtAHundredThousandFaces)
{
	const double exact = std::sqrt(3.0);
	std::vector<double> values, errors;
	for (const int n : {56, 112, 224}) {
		values.push_back(imTau(torus(2.0, 1.0, n, n)));
		errors.push_back(std::abs(values.back() - exact));
	}
	EXPECT_LT(errors[2], 5e-5);
	expectOrder(errors, 2.0, 0.05);
	// Richardson: the error of second order cancels, the next is of fourth.
	EXPECT_LT(std::abs((4 * values[2] - values[1]) / 3 - exact), 1e-6);
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
	return partOf(rectangle(2 * n, 2 * n, 2.0, 2.0), [&](std::size_t f) {
		const int cell = static_cast<int>(f / 2);
		return cell / (2 * n) < n || cell % (2 * n) < n;
	});
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
	expectOrder(errors, 2.0, 0.2);
	EXPECT_LT(errors.back(), 1e-3);
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

/// The integral of (1 + t^4)^(-1/2), the inverse of a lemniscate sine, maps the unit disk to a square whose sides
/// touch the images of 1, i, -1 and -i. Cross-ratios see the map except for a Moebius transformation of the disk.
TEST(Invariants, OfASquareMappedToADisk)
{
	const auto toSquare = [](double radius) {
		return integral(0.0, radius, [](double t) { return 1 / std::sqrt(1 + std::pow(t, 4)); });
	};
	using Complex = std::complex<double>;
	std::vector<double> errors;
	for (const int n : {16, 32, 64}) {
		const SurfaceMesh mesh = rectangle(2 * n, 2 * n, 2.0, 2.0);
		Options options;
		options.target = TargetCurvature::Disk;
		const FlatResult flat = run(mesh, options);
		EXPECT_EQ(flat.report.flippedFaces, 0);
		std::vector<Complex> place(mesh.positions.size());
		for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
			for (std::size_t k = 0; k < 3; ++k)
				place[at(mesh.triangles[f][k])] = asComplex(flat.uv[f][k]);
		double worst = 0.0;
		for (const int axis : {1, 2 * n + 1}) { // step between vertices along x or y
			const auto onAxis = [&](int i) { return place[at(n * (2 * n + 2) + i * axis)]; };
			for (int i = 1; i < n; ++i) {
				double low = 0.0,
					   high = 1.0; // the radius that the square has i / n of its half side for
				while (high - low > 1e-14) {
					const double middle = 0.5 * (low + high);
					(toSquare(middle) < i * toSquare(1.0) / n ? low : high) = middle;
				}
				const Complex p = onAxis(-i), q = onAxis(i), a = onAxis(-n), b = onAxis(n);
				const Complex ratio = (p - a) * (q - b) / ((p - b) * (q - a));
				worst = std::max(worst, std::abs(ratio - std::pow((1 - low) / (1 + low), 2)));
			}
		}
		errors.push_back(worst);
	}
	expectOrder(errors, 2.0, 0.2);
	EXPECT_LT(errors.back(), 1e-5);
}

/// Least distances of the places of three vertices, by \p distance.
template<class Distance>
std::array<double, 3> apart(
	const SurfaceMesh& mesh,
	const UV& uv,
	const std::array<int, 3>& cones,
	const Distance& distance)
{
	std::array<std::vector<Point2>, 3> places;
	for (std::size_t f = 0; f < uv.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k)
			for (std::size_t c = 0; c < 3; ++c)
				if (mesh.triangles[f][k] == cones[c])
					places[c].push_back(uv[f][k]);
	std::array<double, 3> least;
	least.fill(std::numeric_limits<double>::infinity());
	for (std::size_t c = 0; c < 3; ++c)
		for (const Point2& p : places[c])
			for (const Point2& q : places[(c + 1) % 3])
				least[c] = std::min(least[c], distance(p, q));
	return least;
}

/// A sphere with three equal cones is the double of a triangle with equal angles, whatever its shape: the sphere
/// has one conformal structure, and any three points of it can be moved to any others.
TEST(Invariants, OfASphereWithThreeCones)
{
	Random random(95);
	const SurfaceMesh mesh = shaken(perforatedSlab(0, 4), 0.02, random);
	const std::array<int, 3> cones{4, 100, 190};
	const VertexInput input = selecting(mesh, {cones[0], cones[1], cones[2]});
	Options options;
	options.target = TargetCurvature::SelectedCones;
	options.output = OutputTriangulation::CommonRefinement;
	const auto sides = apart(
		mesh, run(mesh, options, input).uv, cones, [](auto& p, auto& q) { return distance(p, q); });
	EXPECT_NEAR(sides[1] / sides[0], 1.0, 1e-6);
	EXPECT_NEAR(sides[2] / sides[0], 1.0, 1e-6);
	for (const double angle : {0.3, 1.0}) { // of the triangle
		HyperbolicOptions inDisk;
		inDisk.target = HyperbolicTarget::SelectedCones;
		inDisk.coneAngle = 2 * angle;
		inDisk.output = OutputTriangulation::CommonRefinement;
		const double c = std::cos(angle), s = std::sin(angle),
					 exact = std::acosh(c * (1 + c) / (s * s));
		for (const double side :
			 apart(mesh, runInDisk(mesh, inDisk, input).uv, cones, [](auto&p, auto&q) {
				 const auto a = asComplex(p), b = asComplex(q);
				 return 2 * std::atanh(std::abs((a - b) / (1.0 - std::conj(a) * b)));
			 }))
			EXPECT_NEAR(side, exact, 1e-6 * exact);
	}
}

/// A sphere with four cones of pi on a circle is the double of a rectangle, whose sides are as K(l) to K(1 - l) for the
/// cross-ratio l of the cones. The flat metric is like a square root near a cone: triangles of the size h have the
/// size of the root of h there, which takes from the order of convergence, unless they get smaller towards the cone.
TEST(Invariants, OfASphereWithFourConesOfPi)
{
	const double angles[] = {0.0, kPi / 4, kPi / 2, kPi};
	const auto place = [](double angle) { return Point3{std::cos(angle), std::sin(angle), 0.0}; };
	const auto chord = [&](int i, int j) { return std::sin(0.5 * (angles[j] - angles[i])); };
	const double ratio = chord(0, 1) * chord(2, 3) / (chord(0, 2) * chord(1, 3));
	const double exact =
		agm(1.0, std::sqrt(ratio)) / agm(1.0, std::sqrt(1.0 - ratio)); // K(l) / K(1 - l)
	constexpr double kNear = 0.35; // half the way to the next cone
	for (const bool isGraded : {false, true}) {
		std::vector<double> errors;
		for (const int subdivision : {8, 16, 32}) {
			SurfaceMesh sphere = perforatedSlab(0, subdivision); // a box of 1 x 3 x 1
			const auto onSphere = [](const Point3& p) { return (1.0 / length(p)) * p; };
			std::vector<int> cones(4);
			for (std::size_t v = 0; v < sphere.positions.size(); ++v) {
				Point3& p = sphere.positions[v];
				p = onSphere(p - Point3{0.5, 1.5, 0.5});
				for (std::size_t k = 0; k < 4; ++k)
					if (const double r = distance(p, place(angles[k])); r < 1e-9)
						cones[k] = static_cast<int>(v);
					else if (isGraded && r < kNear)
						p = onSphere(place(angles[k]) + (r / kNear) * (p - place(angles[k])));
			}
			Options options;
			options.target = TargetCurvature::SelectedCones;
			options.output = OutputTriangulation::CommonRefinement;
			const UV uv = run(sphere, options, selecting(sphere, cones)).uv;
			const auto sides =
				apart(sphere, uv, {cones[0], cones[1], cones[2]}, [](auto& p, auto& q) {
					return distance(p, q);
				});
			errors.push_back(std::abs(sides[0] / sides[1] / exact - 1.0));
		}
		EXPECT_LT(errors.back(), 6e-4);
		expectOrder(errors, isGraded ? 1.85 : 1.55, 0.15);
	}
}

} // namespace
} // namespace ricci::testing
