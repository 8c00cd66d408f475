// SPDX-License-Identifier: GPL-3.0-or-later
#include "least_distortion.h"

#include "../base/graphs.h"
#include "../base/numbers.h"
#include "../base/task.h"
#include "../numerics/iteration.h"

#include <algorithm>
#include <cmath>

namespace ricci {

namespace {

using Complex = std::complex<double>;

/// So many iterations for a direction at most: a few are usual, fans of needles would take thousands, and it leads
/// down after any number of them. Steps at most: a few are enough for most maps, CAD with long triangles takes a hundred.
constexpr int kMaxIterations = 100, kMaxSteps = 100;

/// Re(conj(a) b).
double realProduct(Complex a, Complex b)
{
	return a.real() * b.real() + a.imag() * b.imag();
}

} // namespace

DistortionLaplacian::DistortionLaplacian(const MeanDistortion& energy) :
		m_energy(energy), m_points(energy.points()), m_slot(energy.size(), {-1, -1, -1}),
		m_below(m_points.unknowns, m_points.unknowns), m_scale(m_points.unknowns),
		m_residual(m_points.unknowns), m_direction(m_points.unknowns), m_solved(m_points.unknowns),
		m_product(m_points.unknowns)
{
	const auto eachSide = [&](const auto& use) {
		for (const int f : m_slot.indices())
			for (std::size_t k = 0; k < 3; ++k) {
				const auto [column, row] = std::minmax(
					{m_points.unknown[energy.corners(f)[k]],
					 m_points.unknown[energy.corners(f)[(k + 1) % 3]]});
				if (column >= 0 && column != row)
					use(row, column, m_slot[f][k]);
			}
	};
	// The rows of each column, in increasing order; the sides of two triangles have one entry.
	Adjacency<int, int> rows(m_points.unknowns, [&](const auto& add) {
		eachSide([&](int row, int column, int) { add(column, row); });
	});
	m_below.resizeNonZeros(static_cast<Eigen::Index>(rows.items().size()));
	int* const first = m_below.outerIndexPtr();
	int* const inner = m_below.innerIndexPtr();
	for (int column = 0, slot = 0; column < m_points.unknowns; ++column) {
		const ItemRange<int> own = rows[column];
		std::sort(own.begin(), own.end());
		slot = static_cast<int>(std::unique_copy(own.begin(), own.end(), inner + slot) - inner);
		first[column + 1] = slot;
	}
	m_below.resizeNonZeros(first[m_points.unknowns]);
	eachSide([&](int row, int column, int& slot) {
		slot = static_cast<int>(
			std::lower_bound(inner + first[column], inner + first[column + 1], row) - inner);
	});
}

bool DistortionLaplacian::factorize()
{
	Eigen::VectorXd& diagonal = m_scale;
	diagonal.setZero();
	m_below.coeffs().setZero();
	for (const int f : m_slot.indices()) {
		const double s = m_energy.stiffness(f);
		std::array<Complex, 3> slopes = m_energy.slopes(f);
		Triangle unknown{};
		for (std::size_t k = 0; k < 3; ++k) {
			const int point = m_energy.corners(f)[k];
			unknown[k] = m_points.unknown[point];
			if (unknown[k] >= 0 && unknown[k] != point) // an image
				slopes[k] *= m_points.turn[point];
		}
		for (std::size_t k = 0; k < 3; ++k) {
			if (unknown[k] < 0)
				continue;
			diagonal[unknown[k]] += s * std::norm(slopes[k]);
			const std::size_t next = (k + 1) % 3;
			if (m_slot[f][k] >= 0)
				m_below.coeffs()[m_slot[f][k]] += s * realProduct(slopes[k], slopes[next]);
			else if (unknown[k] == unknown[next]) // the two copies of a seam vertex
				diagonal[unknown[k]] += 2.0 * s * realProduct(slopes[k], slopes[next]);
		}
	}
	for (double& d : diagonal) {
		if (!(d > 0.0 && std::isfinite(d)))
			return false;
		d = 1.0 / std::sqrt(d);
	}
	for (int column = 0; column < m_points.unknowns; ++column)
		for (Eigen::SparseMatrix<double>::InnerIterator entry(m_below, column); entry; ++entry)
			entry.valueRef() *= m_scale[column] * m_scale[entry.row()];
	m_belowByRows = m_below;
	return true;
}

/// x = (1 + L)^-1 x for the entries L below the diagonal.
void DistortionLaplacian::solveForward(Eigen::VectorXcd& x) const
{
	m_belowByRows.triangularView<Eigen::UnitLower>().solveInPlace(x);
}

/// x = (1 + L)^-T x.
void DistortionLaplacian::solveBackward(Eigen::VectorXcd& x) const
{
	m_below.transpose().triangularView<Eigen::UnitUpper>().solveInPlace(x);
}

/// With A = 1 + L + L^T, conjugate gradients run on (1 + L)^-1 A (1 + L)^-T y = (1 + L)^-1 rhs, where
/// the product with p is t + (1 + L)^-1 (p - t) for t = (1 + L)^-T p; x is the sum of the same t.
void DistortionLaplacian::solve(const Eigen::VectorXcd& rhs, Eigen::VectorXcd& x, double residual)
{
	const auto dot = LimitedMemoryBfgs::dot;
	m_residual = m_scale.cwiseProduct(rhs);
	solveForward(m_residual);
	m_direction = m_residual;
	x.setZero(m_points.unknowns);
	double square = dot(m_residual, m_residual);
	const double wanted = residual * residual * square;
	for (int i = 0; i < kMaxIterations && square > wanted; ++i) {
		m_solved = m_direction;
		solveBackward(m_solved);
		m_product = m_direction - m_solved;
		solveForward(m_product);
		m_product += m_solved;
		const double length = square / dot(m_direction, m_product);
		if (!(length > 0.0 && std::isfinite(length)))
			break;
		x += length * m_solved;
		m_residual -= length * m_product;
		const double last = square;
		square = dot(m_residual, m_residual);
		m_direction = m_residual + (square / last) * m_direction;
	}
	x = m_scale.cwiseProduct(x);
}

namespace {

/// The steps end when two in a row gain less than this change of K in all triangles is worth: it is not seen in the
/// third decimal of a mean.
constexpr double kSeen = 1e-4;

/// Steps that the direction remembers; steps with the same stiffness; and the residual of a direction.
constexpr int kDepth = 5, kSameStiffness = 8;
constexpr double kResidual = 0.3;

constexpr double kMinStep = 1e-6;

/// [number of a point]
Eigen::VectorXcd positionsOf(const NumberedPoints& points, const FlatMesh& flat)
{
	Eigen::VectorXcd positions(points.number.size());
	for (const int p : flat.place.indices())
		positions[points.number[p]] = asComplex(flat.place[p]);
	return positions;
}

} // namespace

bool leastDistortion(FlatMesh& flat, const PointGroups& groups, bool countsFlipped)
{
	MeanDistortion energy(flat, groups, countsFlipped);
	const NumberedPoints& points = energy.points();
	const int unknowns = points.unknowns;
	LimitedMemoryBfgs bfgs(unknowns, kDepth);
	const Eigen::VectorXcd start = positionsOf(points, flat);
	Eigen::VectorXcd position = start, trial = start; // [number of a point]
	double value = energy.evaluate(position);
	if (!std::isfinite(value) || unknowns == 0)
		return false;
	// Nothing is allocated between steps.
	Eigen::VectorXcd direction(unknowns), gradient, nextGradient;
	const auto valueAt = [&](double length) {
		trial.head(unknowns) = position.head(unknowns) + length * direction;
		// From the start on, so that the sides of a seam differ as they did there.
		for (int p = unknowns; p < points.moving; ++p) {
			const int source = points.unknown[p];
			trial[p] = start[p] + points.turn[p] * (trial[source] - start[source]);
		}
		return energy.evaluate(trial);
	};
	// Goes along the direction as far as E falls. \return by how much it falls; 0 where it leads down no longer
	const auto gainOfStep = [&] {
		const double slope = 2.0 * LimitedMemoryBfgs::dot(gradient, direction), before = value;
		if (!(slope < 0.0 && std::isfinite(slope)))
			return 0.0;
		double next = before;
		const double length = LineSearch{kMinStep}.run(
			slope, before, [&](double trialLength) { return next = valueAt(trialLength); });
		if (length == 0.0)
			return 0.0;
		value = next;
		position.swap(trial);
		energy.gradient(nextGradient);
		gradient = nextGradient - gradient;
		direction *= length;
		bfgs.remember(direction, gradient);
		gradient.swap(nextGradient);
		return before - value;
	};
	DistortionLaplacian laplacian(energy);
	energy.gradient(gradient);
	int steps = 0; // that have lowered it
	double lastGain = kInfinity;
	bool isSeen = true;
	while (steps < kMaxSteps && isSeen) {
		checkpoint();
		if (steps % kSameStiffness == 0 && !laplacian.factorize())
			break;
		bfgs.direction(
			gradient,
			[&](const Eigen::VectorXcd& rhs, Eigen::VectorXcd& x) {
				laplacian.solve(rhs, x, kResidual);
			},
			direction);
		const double gain = gainOfStep();
		if (!(gain > 0.0))
			break;
		++steps;
		// How much E = mean of (K - 1)^(5/4) changes where K changes by kSeen everywhere.
		isSeen = gain + lastGain >= 1.25 * std::pow(value, 0.2) * kSeen;
		lastGain = gain;
	}
	if (steps > 0)
		for (const int p : flat.place.indices())
			flat.place[p] = asPoint(position[points.number[p]]);
	return steps == kMaxSteps && isSeen;
}

} // namespace ricci
