// SPDX-License-Identifier: GPL-3.0-or-later
#include "canonical_polygon.h"

#include "../numbers.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace ricci {

namespace {

using Complex = std::complex<double>;

/// Images of the basis of R^{2,1} (time first) under the motion, as columns. In the Hermitian
/// matrices [x0 x; conj(x) x0], x = x1 + i x2, it acts by H -> g H g*.
Eigen::Matrix3d lorentzMatrix(const DiskIsometry& g)
{
	const auto image = [&](double x0, Complex x) -> Eigen::Vector3d {
		const Complex h00 = g.a * x0 + g.b * std::conj(x), h01 = g.a * x + g.b * x0;
		const Complex off = h00 * g.b + h01 * g.a;
		return {(h00 * std::conj(g.a) + h01 * std::conj(g.b)).real(), off.real(), off.imag()};
	};
	Eigen::Matrix3d m;
	m << image(1.0, 0.0), image(0.0, 1.0), image(0.0, Complex(0.0, 1.0));
	return m;
}

/// The point p with the least sum of cosh d(p, g p) = -<p, g p>.
Complex basePoint(const std::vector<DiskIsometry>& generators)
{
	const Eigen::Matrix3d form = Eigen::Vector3d(-1.0, 1.0, 1.0).asDiagonal();
	Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
	for (const DiskIsometry& g : generators) {
		const Eigen::Matrix3d m = form * lorentzMatrix(g);
		sum -= 0.5 * (m + m.transpose());
	}
	const Eigen::EigenSolver<Eigen::Matrix3d> solver(form * sum);
	Complex best = 0.0;
	double least = 0.0;
	for (int k = 0; k < 3; ++k) {
		const Eigen::Vector3d v = solver.eigenvectors().col(k).real();
		const double norm = v.dot(form * v) / v.squaredNorm();
		if (norm < least) {
			least = norm;
			const Eigen::Vector3d x = v / std::copysign(std::sqrt(-v.dot(form * v)), v[0]);
			best = Complex(x[1], x[2]) / (1.0 + x[0]);
		}
	}
	return best;
}

/// Twice the area of the triangle in the Klein model, where geodesics are straight.
double turn(Complex o, Complex x, Complex y)
{
	return std::imag(std::conj(x - o) * (y - o));
}

bool cross(Complex a, Complex b, Complex c, Complex d)
{
	return turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0;
}

bool isSimple(const std::vector<Complex>& corners)
{
	std::vector<Complex> klein;
	klein.reserve(corners.size());
	for (const Complex& z : corners)
		klein.push_back(2.0 * z / (1.0 + std::norm(z)));
	const std::size_t n = klein.size();
	for (std::size_t i = 0; i < n; ++i)
		for (std::size_t j = i + 2; j < n; ++j)
			if (cross(klein[i], klein[i + 1], klein[j], klein[(j + 1) % n]))
				return false;
	return true;
}

/// Sum of the angles inside a polygon that runs counter-clockwise.
double sumOfAngles(const std::vector<Complex>& corners)
{
	double sum = 0.0;
	const std::size_t n = corners.size();
	for (std::size_t i = 0; i < n; ++i) {
		const DiskIsometry toCorner = DiskIsometry::translationTo(corners[i]).inverse();
		const Complex next = toCorner(corners[(i + 1) % n]);
		const Complex before = toCorner(corners[(i + n - 1) % n]);
		const double angle = std::arg(before / next);
		sum += angle < 0.0 ? angle + 2.0 * kPi : angle;
	}
	return sum;
}

} // namespace

CanonicalPolygon canonicalPolygon(const FuchsianGroup& group)
{
	std::vector<DiskIsometry> generators = group.handles;
	generators.insert(generators.end(), group.ends.begin(), group.ends.end());
	const DiskIsometry toBase = DiskIsometry::translationTo(basePoint(generators));

	// The letters as seen from the base point.
	std::vector<DiskIsometry> letters;
	const auto letter = [&](const DiskIsometry& g) {
		letters.push_back((toBase.inverse() * g * toBase).normalised());
	};
	for (std::size_t i = 0; i + 1 < group.handles.size(); i += 2) {
		const DiskIsometry &a = group.handles[i], &b = group.handles[i + 1];
		for (const DiskIsometry& g : {a, b, a.inverse(), b.inverse()})
			letter(g);
	}
	for (const DiskIsometry& g : group.ends)
		letter(g);

	CanonicalPolygon polygon;
	const std::size_t count = letters.size(), middle = count / 2;
	std::vector<Complex> corners(count);
	DiskIsometry word;
	for (std::size_t k = middle; k-- > 0;) { // corner k = (w_k ... w_{middle - 1})^-1
		word = (word * letters[k].inverse()).normalised();
		corners[k] = word.origin();
	}
	word = DiskIsometry();
	for (std::size_t k = middle; k < count; ++k) { // corner k = w_middle ... w_{k - 1}
		corners[k] = word.origin();
		word = (word * letters[k]).normalised();
	}
	if (count == 0)
		return polygon;
	polygon.gap = 2.0 * std::asinh(0.5 * chordLength(word.origin(), corners[0]));
	polygon.isSimple = isSimple(corners);
	polygon.angleSum = sumOfAngles(corners);
	for (const Complex& z : corners)
		polygon.corners.push_back(toBase(z));
	return polygon;
}

} // namespace ricci
