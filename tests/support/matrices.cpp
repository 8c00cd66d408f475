// SPDX-License-Identifier: GPL-3.0-or-later
#include "matrices.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <vector>

namespace ricci::testing {
namespace {

/// All vectors x of integers but 0 with x^T \p gram x <= \p bound.
std::vector<Eigen::VectorXd> shortVectors(const Eigen::MatrixXd& gram, double bound)
{
	const Eigen::MatrixXd upper = gram.llt().matrixU();
	const Eigen::Index n = gram.rows();
	std::vector<Eigen::VectorXd> found;
	Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
	const std::function<void(Eigen::Index, double)> choose = [&](Eigen::Index i, double left) {
		if (i < 0) {
			if (!x.isZero(0.0))
				found.push_back(x);
			return;
		}
		const double others = upper.row(i).tail(n - i - 1).dot(x.tail(n - i - 1));
		const double centre = -others / upper(i, i), reach = std::sqrt(left) / upper(i, i);
		for (double k = std::ceil(centre - reach); k <= centre + reach; ++k) {
			x[i] = k;
			choose(i - 1, std::max(0.0, left - std::pow(upper(i, i) * (k - centre), 2)));
		}
		x[i] = 0.0;
	};
	choose(n - 1, bound);
	return found;
}

/// Energies of the real harmonic forms of a surface with this period matrix, in the basis of their
/// periods along a1, ..., ag, b1, ..., bg: symmetric, positive definite and symplectic.
Eigen::MatrixXd energyOf(const Eigen::MatrixXcd& omega)
{
	// A form with the periods a and b is Re (c w) with w's periods 1 and X + iY, so that
	// Im c = Y^-1 (X a - b), and its energy is Re c^T Y Re c + Im c^T Y Im c.
	const Eigen::Index g = omega.rows();
	const Eigen::MatrixXd x = omega.real(), y = omega.imag(), inverse = y.inverse();
	Eigen::MatrixXd energy(2 * g, 2 * g);
	energy << y + x * inverse * x, -x * inverse, -inverse * x, inverse;
	return energy;
}

} // namespace

double classDistance(const Eigen::MatrixXcd& one, const Eigen::MatrixXcd& two, double radius)
{
	const Eigen::MatrixXd a = energyOf(one), b = energyOf(two);
	const Eigen::Index n = a.rows(), g = n / 2;
	Eigen::MatrixXd product = Eigen::MatrixXd::Zero(n, n);
	product.topRightCorner(g, g).setIdentity();
	product.bottomLeftCorner(g, g) = -product.topRightCorner(g, g);
	const double stretch = std::exp(radius);
	struct Candidate
	{
		Eigen::VectorXd vector, dual, product;
	};
	std::vector<Candidate> candidates;
	for (const Eigen::VectorXd& v : shortVectors(a, stretch * b.diagonal().maxCoeff()))
		candidates.push_back({v, a * v, product * v});
	double best = std::numeric_limits<double>::infinity();
	Eigen::MatrixXd basis(n, n);
	const std::function<void(Eigen::Index)> choose = [&](Eigen::Index i) {
		if (i == n) {
			const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
				basis.transpose() * a * basis, b, Eigen::EigenvaluesOnly);
			const double d = solver.eigenvalues().array().log().abs().maxCoeff();
			best = d <= radius ? std::min(best, d) : best;
			return;
		}
		const Eigen::VectorXd wanted = product.col(i);
		for (const Candidate& c : candidates) {
			bool fits = true;
			for (Eigen::Index j = i; fits && j >= 0; --j) {
				const double slack = (stretch - 1.0) * std::sqrt(b(i, i) * b(j, j)) + 1e-12;
				const Eigen::Ref<const Eigen::VectorXd> other =
					j == i ? Eigen::Ref<const Eigen::VectorXd>(c.vector) : basis.col(j);
				fits = std::abs(other.dot(c.dual) - b(j, i)) <= slack &&
					   other.dot(c.product) == wanted[j];
			}
			if (fits) {
				basis.col(i) = c.vector;
				choose(i + 1);
			}
		}
	};
	choose(0);
	return best;
}

Eigen::MatrixXcd omegaOfPolygon(int sides)
{
	const int m = sides / 2, genus = sides / 4;
	Eigen::MatrixXcd a(genus, genus), b(genus, genus);
	for (int k = 0; k < genus; ++k) {
		std::complex<double> sum = 0.0;
		for (int i = 0; i < genus; ++i) {
			const auto period = [&](int j) {
				return std::polar(1.0, 3.14159265358979323846 * (2 * k + 1) * j / m);
			};
			a(i, k) = period(2 * i) + sum;
			b(i, k) = period(2 * i + 1) + sum;
			sum += period(2 * i) - period(2 * i + 1);
		}
	}
	return b * a.inverse();
}

Eigen::MatrixXd leastNormSolution(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right)
{
	return matrix.completeOrthogonalDecomposition().solve(right);
}

Eigen::VectorXd symmetricEigenvalues(const Eigen::MatrixXd& matrix)
{
	return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly)
		.eigenvalues();
}

} // namespace ricci::testing
