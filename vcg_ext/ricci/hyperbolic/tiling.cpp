// SPDX-License-Identifier: GPL-3.0-or-later
#include "group_of_cut.h"

#include "../base/tolerances.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

namespace ricci {

Tiling tiling(const std::vector<DiskIsometry>& sides, int rings, int maxCount)
{
	Tiling result;
	// Copies by the image of 0 on the hyperboloid, in square cells as wide as the tolerance.
	using Cell = std::pair<std::int64_t, std::int64_t>;
	std::multimap<Cell, std::size_t> cells;
	const auto cellOf = [](const DiskIsometry& m) -> Cell {
		const std::complex<double> x = 2.0 * m.a * m.b;
		return {
			static_cast<std::int64_t>(std::floor(x.real() / kSameTile)),
			static_cast<std::int64_t>(std::floor(x.imag() / kSameTile))};
	};
	const auto add = [&](const DiskIsometry& m, int ring) {
		cells.emplace(cellOf(m), result.deck.size());
		result.deck.push_back(m);
		result.ring.push_back(ring);
	};
	const auto isKnown = [&](const DiskIsometry& m) {
		const auto [x, y] = cellOf(m);
		for (std::int64_t i = -1; i <= 1; ++i)
			for (std::int64_t j = -1; j <= 1; ++j) {
				const auto [first, end] = cells.equal_range({x + i, y + j});
				if (std::any_of(first, end, [&](const auto& known) {
						const DiskIsometry difference = result.deck[known.second].inverse() * m;
						return difference.distanceFromIdentity() < kSameTile;
					}))
					return true;
			}
		return false;
	};
	add(DiskIsometry(), 0);
	for (std::size_t next = 0; next < result.deck.size() && result.ring[next] != rings; ++next)
		for (const DiskIsometry& side : sides) {
			const DiskIsometry m = (result.deck[next] * side).normalised();
			const double distance = m.displacement();
			// Farther out than any known tile a cell may have no number.
			if (distance <= kMaxTileDistance + kSameTile && isKnown(m))
				continue;
			if (distance <= kMaxTileDistance &&
				result.deck.size() < static_cast<std::size_t>(maxCount))
				add(m, result.ring[next] + 1);
			else
				result.complete = false;
		}
	return result;
}

namespace {

using Complex = ExtendedIsometry::Complex;

/// The isometry as a linear map of R^{2,1}, time first: its columns are the images of the basis. On
/// the Hermitian matrices [x0 x; conj(x) x0] with x = x1 + i x2 it acts by H -> g H g*.
Eigen::Matrix3d lorentzMatrix(const DiskIsometry& g)
{
	const auto image = [&](double x0, std::complex<double> x) -> Eigen::Vector3d {
		const std::complex<double> h00 = g.a * x0 + g.b * std::conj(x), h01 = g.a * x + g.b * x0;
		const std::complex<double> off = h00 * g.b + h01 * g.a;
		return {(h00 * std::conj(g.a) + h01 * std::conj(g.b)).real(), off.real(), off.imag()};
	};
	Eigen::Matrix3d m;
	m << image(1.0, 0.0), image(0.0, 1.0), image(0.0, {0.0, 1.0});
	return m;
}

/// The point p with the smallest sum of cosh d(p, g p) = -<p, g p>.
std::complex<double> basePoint(const std::vector<DiskIsometry>& generators)
{
	const Eigen::Matrix3d form = Eigen::Vector3d(-1.0, 1.0, 1.0).asDiagonal();
	Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
	for (const DiskIsometry& g : generators) {
		const Eigen::Matrix3d m = form * lorentzMatrix(g);
		sum -= 0.5 * (m + m.transpose());
	}
	const Eigen::EigenSolver<Eigen::Matrix3d> solver(form * sum);
	std::complex<double> best = 0.0;
	double minNorm = 0.0;
	for (int k = 0; k < 3; ++k) {
		const Eigen::Vector3d v = solver.eigenvectors().col(k).real();
		const double norm = v.dot(form * v) / v.squaredNorm();
		if (norm < minNorm) {
			minNorm = norm;
			const Eigen::Vector3d x = v / std::copysign(std::sqrt(-v.dot(form * v)), v[0]);
			best = std::complex<double>(x[1], x[2]) / (1.0 + x[0]);
		}
	}
	return best;
}

/// Twice the area of a triangle in the plane, positive if counter-clockwise.
DoubleDouble doubledArea(Complex o, Complex x, Complex y)
{
	return (conj(x - o) * (y - o)).imag();
}

/// Whether the straight segments ab and cd cross.
bool cross(Complex a, Complex b, Complex c, Complex d)
{
	return doubledArea(a, b, c) * doubledArea(a, b, d) < 0.0 &&
		   doubledArea(c, d, a) * doubledArea(c, d, b) < 0.0;
}

/// Whether no side of the geodesic polygon crosses another.
bool isSimple(const std::vector<Complex>& corners)
{
	std::vector<Complex> klein; // in the Klein model geodesics are straight
	klein.reserve(corners.size());
	for (const Complex& z : corners)
		klein.push_back(2.0 * z / (1.0 + norm(z)));
	const std::size_t n = klein.size();
	for (std::size_t i = 0; i < n; ++i)
		for (std::size_t j = i + 2; j < n; ++j)
			if (cross(klein[i], klein[i + 1], klein[j], klein[(j + 1) % n]))
				return false;
	return true;
}

} // namespace

CanonicalPolygon canonicalPolygon(const FuchsianGroup& group)
{
	CanonicalPolygon polygon;
	if (!group.isCanonical())
		return polygon;
	std::vector<DiskIsometry> generators = group.handles;
	generators.insert(generators.end(), group.peripheral.begin(), group.peripheral.end());
	const auto toBase = ExtendedIsometry::translationTo(Complex(basePoint(generators)));

	// The letters as seen from the base point.
	std::vector<ExtendedIsometry> letters;
	for (const ExtendedIsometry& g : group.relation)
		letters.push_back((toBase.inverse() * g * toBase).normalised());

	const std::size_t count = letters.size(), middle = count / 2;
	std::vector<Complex> corners(count);
	ExtendedIsometry word;
	for (std::size_t k = middle; k-- > 0;) { // corner k = (w_k ... w_{middle - 1})^-1
		word = (word * letters[k].inverse()).normalised();
		corners[k] = word.origin();
	}
	const ExtendedIsometry toFirst = word;
	word = ExtendedIsometry();
	for (std::size_t k = middle; k < count; ++k) { // corner k = w_middle ... w_{k - 1}
		corners[k] = word.origin();
		word = (word * letters[k]).normalised();
	}
	// From the isometries: points near the border of the disk have lost their distances.
	polygon.gap = static_cast<double>((toFirst.inverse() * word).displacement());
	bool inDisk = true;
	for (const Complex& z : corners) {
		polygon.corners.emplace_back(toBase(z));
		inDisk = inDisk && std::abs(polygon.corners.back()) < 1.0;
	}
	if (!(polygon.gap <= kMaxPolygonGap) || !inDisk) {
		polygon.corners.clear();
		return polygon;
	}
	polygon.isSimple = isSimple(corners);
	return polygon;
}

} // namespace ricci
