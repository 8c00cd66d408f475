// SPDX-License-Identifier: GPL-3.0-or-later
#include "newton.h"

#include "../error.h"
#include "../numbers.h"

#include <Eigen/IterativeLinearSolvers>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ricci {

namespace {

/// No entry of u moves further than this in one step: a far trial point drives inversive distances
/// out of range.
constexpr double kStepCap = 4.0;

/// In the hyperbolic plane u is negative; a step covers at most this share of the way to 0.
constexpr double kShareOfRange = 0.9;

/// Where that would shorten the whole step to less than this, only the entries that are too long are
/// shortened: a circle that is nearly a cusp's must not hold up all others.
constexpr double kLeastShare = 0.01;

/// Sufficient decrease of |K - target| asked of a step of length t: by the factor 1 - kDecrease t.
constexpr double kDecrease = 1e-4;

/// Below this step length the search direction has failed.
constexpr double kLeastStep = 1e-10;

/// Added to the diagonal, whose typical entries are of order 1, while triangles are broken: their
/// derivatives are 0.
constexpr double kRegularisation = 1e-6;

/// Steps with the last factor after epsilon is reached; each removes about as many digits as the
/// last full step did, for the price of one evaluation.
constexpr int kPolishingSteps = 2;

/// A minimum with broken triangles is no metric, and the energy is flat beside it: where |K - target|
/// has not fallen by this factor in so many steps, the flow ends there.
constexpr double kStagnation = 0.9;
constexpr int kStagnationSteps = 20;

/// Newton's direction is wanted to this accuracy at first, and to that of the residual afterwards:
/// then every step still squares the residual.
constexpr double kLeastAccuracy = 0.1;

/// Rate of a factorisation's arithmetic, which stays in the cache, over that of a solution, which
/// reads the factor from memory.
constexpr double kFactorizationRate = 5.0;

/// Bounds of the number of conjugate gradient iterations that are worth a factorisation.
constexpr int kLeastIterations = 8, kMostIterations = 50;

int solutionsPerFactorization(const SparseCholesky& cholesky)
{
	const double solution = 4.0 * cholesky.factorEntries();
	const double quotient = cholesky.factorFlops() / (kFactorizationRate * solution);
	return static_cast<int>(
		std::clamp(quotient, double(kLeastIterations), double(kMostIterations)));
}

/// How far the estimate of the rounding floor may be from what is observed.
constexpr double kFloorUncertainty = 20.0;

/// A Cholesky factor of a nearby matrix, in the form in which Eigen wants a preconditioner.
class FactorPreconditioner
{
public:
	void attach(SparseCholesky& cholesky) { m_cholesky = &cholesky; }

	template<class Matrix>
	FactorPreconditioner& analyzePattern(const Matrix&)
	{
		return *this;
	}
	template<class Matrix>
	FactorPreconditioner& factorize(const Matrix&)
	{
		return *this;
	}
	template<class Matrix>
	FactorPreconditioner& compute(const Matrix&)
	{
		return *this;
	}
	const Eigen::VectorXd& solve(const Eigen::VectorXd& residual) const
	{
		m_cholesky->solve(residual, m_solution);
		return m_solution;
	}
	Eigen::ComputationInfo info() { return Eigen::Success; }

private:
	SparseCholesky* m_cholesky = nullptr;
	mutable Eigen::VectorXd m_solution; // kept as work space
};

} // namespace

NewtonSolver::NewtonSolver(CurvatureMap& map, std::vector<char> fixed) :
		m_map(&map), m_fixed(std::move(fixed)), m_unknown(m_fixed.size(), -1)
{
	const bool anyFixed = std::find(m_fixed.begin(), m_fixed.end(), 1) != m_fixed.end();
	m_gaugeFree = !anyFixed && map.scaleInvariant();
	// In a scale invariant background one row is redundant; leaving it out pins that vertex.
	for (std::size_t v = m_gaugeFree ? 1 : 0; v < m_fixed.size(); ++v)
		if (!m_fixed[v])
			m_unknown[v] = m_unknownCount++;
	const auto n = static_cast<Eigen::Index>(m_fixed.size());
	m_gradient.resize(n);
	m_direction.resize(n);
	m_trial.resize(n);
	m_diagonal.resize(n);
	m_trialRest.resize(n);
	m_rest.setZero(n);
	m_rhs.resize(m_unknownCount);
	m_solution.resize(m_unknownCount);
}

void NewtonSolver::continueOn(CurvatureMap& map)
{
	if (m_revision == m_map->revision())
		m_revision = map.revision();
	else
		m_revision = -1;
	m_map = &map;
}

/// Computes the gradient; returns max |target - K|, infinity if it is not finite.
double NewtonSolver::residual(const Eigen::VectorXd& target)
{
	double largest = 0.0;
	for (Eigen::Index v = 0; v < m_gradient.size(); ++v) {
		m_gradient[v] = m_fixed[at(v)] ? 0.0 : m_map->curvature()[v] - target[v];
		if (!std::isfinite(m_gradient[v]))
			return std::numeric_limits<double>::infinity();
		largest = std::max(largest, std::abs(m_gradient[v]));
	}
	if (m_gaugeFree) {
		// By Gauss-Bonnet the gradient adds up to 0 but for the rounding of the target's sum, which
		// the pinned vertex would have to bear alone.
		m_gradient.array() -= m_gradient.mean();
	}
	return largest;
}

/// The Hessian at the map's state, with \p shift added to its diagonal.
void NewtonSolver::updateMatrix(double shift)
{
	if (m_revision != m_map->revision()) {
		m_hessian.layOut(*m_map, m_unknown, m_unknownCount);
		m_analyzed = false;
		m_revision = m_map->revision();
	}
	m_hessian.fill(*m_map, shift);
}

void NewtonSolver::factorize()
{
	if (!m_analyzed) {
		const auto layOut = [this] { m_hessian.layOut(*m_map, m_unknown, m_unknownCount); };
		m_factored = false;
		if (m_cholesky.analyze(m_hessian.matrix(), m_unknown, layOut))
			m_hessian.fill(*m_map, 0.0);
		m_analyzed = true;
	}
	double shift = m_map->brokenTriangles() > 0 ? kRegularisation : 0.0;
	if (shift > 0.0)
		updateMatrix(shift);
	const double scale = std::max(m_hessian.largestDiagonal(), 1.0);
	while (!m_cholesky.factorize(m_hessian.matrix())) {
		shift = std::max(100.0 * shift, 1e-14 * scale);
		if (!(shift <= scale) || std::isinf(shift))
			throw Error(
				"The linear solver failed: its matrix is not positive definite. Remesh the worst "
				"triangles.");
		updateMatrix(shift);
	}
	m_factored = true;
	m_worn = false;
	m_shifted = shift > 0.0;
}

/// Conjugate gradients with the last factor for preconditioner, for the matrix as it is, until
/// |H d + gradient| <= \p accuracy |gradient|. \return number of iterations, more than \p
/// mostIterations if they do not suffice
int NewtonSolver::iterate(double accuracy, int mostIterations)
{
	Eigen::ConjugateGradient<Hessian::Matrix, Eigen::Lower, FactorPreconditioner> gradients;
	gradients.preconditioner().attach(m_cholesky);
	gradients.setTolerance(accuracy);
	gradients.setMaxIterations(mostIterations);
	gradients.compute(m_hessian.matrix());
	m_solution = gradients.solve(m_rhs);
	const bool solved = gradients.info() == Eigen::Success && m_solution.allFinite();
	return solved ? static_cast<int>(gradients.iterations()) : mostIterations + 1;
}

/// Right side of Newton's equations in the order of the unknowns.
void NewtonSolver::gatherRightSide()
{
	for (std::size_t v = 0; v < m_unknown.size(); ++v)
		if (m_unknown[v] >= 0)
			m_rhs[m_unknown[v]] = -m_gradient[static_cast<Eigen::Index>(v)];
}

/// Solves H d = -(K - target) so that what is left is at most \p accuracy of the right side, with
/// the last factor as long as that takes less work than a new one. Once epsilon is reached, the last
/// factor has to do.
void NewtonSolver::direction(double accuracy, bool reached)
{
	updateMatrix(0.0);
	gatherRightSide();
	const bool usable = m_factored && !m_shifted && m_map->brokenTriangles() == 0;
	bool solved = false;
	if (usable && (!m_worn || reached)) {
		const int limit = solutionsPerFactorization(m_cholesky);
		const int iterations = iterate(accuracy, limit);
		solved = iterations <= limit;
		m_worn = 2 * iterations > limit;
	}
	if (!solved && !reached) {
		factorize();
		gatherRightSide(); // the unknowns may have been renumbered
		m_cholesky.solve(m_rhs, m_solution);
	}
	for (std::size_t v = 0; v < m_unknown.size(); ++v)
		m_direction[static_cast<Eigen::Index>(v)] =
			m_unknown[v] >= 0 ? m_solution[m_unknown[v]] : 0.0;
	if (m_gaugeFree)
		m_direction.array() -= m_direction.mean();
}

/// Share of m_direction, whose largest entry is \p largest, that keeps u in range. May shorten entries
/// of m_direction.
double NewtonSolver::longestStep(const Eigen::VectorXd& u, double largest)
{
	const double cap = largest > kStepCap ? kStepCap / largest : 1.0;
	if (m_map->scaleInvariant())
		return cap;
	double share = 1.0;
	for (Eigen::Index v = 0; v < u.size(); ++v)
		if (m_direction[v] > 0.0)
			share = std::min(share, kShareOfRange * -u[v] / m_direction[v]);
	if (share >= kLeastShare)
		return std::min(cap, share);
	for (Eigen::Index v = 0; v < u.size(); ++v)
		m_direction[v] = std::min(m_direction[v], kShareOfRange * -u[v] / cap);
	return cap;
}

/// m_trial + m_trialRest = u + m_rest + t m_direction, with the rounding error of the sum kept.
void NewtonSolver::applyStep(const Eigen::VectorXd& u, double t)
{
	for (Eigen::Index v = 0; v < u.size(); ++v) {
		const double step = m_rest[v] + t * m_direction[v];
		const double sum = u[v] + step, virtualStep = sum - u[v];
		m_trial[v] = sum;
		m_trialRest[v] = (u[v] - (sum - virtualStep)) + (step - virtualStep);
	}
}

/// Rounding of the radii moves K by up to eps H_ii, and rounding of the sides of a needle by up to
/// eps times their quotient.
double NewtonSolver::roundingFloor()
{
	m_diagonal.setZero();
	const Triangulation& t = m_map->triangulation();
	for (int e = 0; e < t.edgeCount(); ++e) {
		const double w = std::abs(m_map->weights()[at(e)]) * (1.0 + m_map->cosineLess1()[at(e)]);
		m_diagonal[t.origin(2 * e)] += w;
		m_diagonal[t.target(2 * e)] += w;
	}
	double amplification = m_map->needleRatio();
	amplification = std::max(amplification, m_diagonal.maxCoeff());
	// Angles and their sums are kept as doubles in any case.
	return 4.0 * (m_map->precision() * amplification + std::numeric_limits<double>::epsilon());
}

NewtonResult NewtonSolver::solve(
	Eigen::VectorXd& u,
	const Eigen::VectorXd& target,
	const NewtonOptions& options,
	const std::function<void(int, double)>& report,
	const Surgeon& surgeon)
{
	NewtonResult result;
	m_map->evaluate(u, m_rest);
	m_map->accept();
	if (surgeon && surgeon(*m_map))
		m_map->evaluate(u, m_rest);
	result.residual = residual(target);
	int polishing = 0;
	double normThen = m_gradient.norm(); // kStagnationSteps ago
	bool searchFails = false;

	while (true) {
		report(result.iterations, result.residual);
		result.floor = roundingFloor();
		const bool valid = m_map->brokenTriangles() == 0;
		const bool reached = valid && result.residual < options.epsilon;
		const bool atFloor = valid && result.residual <= result.floor;
		if (atFloor || searchFails || m_unknownCount == 0 ||
			(reached && polishing >= kPolishingSteps) ||
			(!reached && result.iterations >= options.maxIterations))
			break;

		// Nothing is gained by solving for less than rounding leaves.
		const double accuracy = std::max(result.residual, 0.5 * result.floor / result.residual);
		direction(std::min(accuracy, kLeastAccuracy), reached && m_factored);
		const double largest = m_direction.lpNorm<Eigen::Infinity>();
		if (!std::isfinite(largest))
			break;
		double t = longestStep(u, largest);
		const double before = m_gradient.norm();
		double after = 0.0;
		double trialResidual;
		while (true) {
			applyStep(u, t);
			m_map->evaluate(m_trial, m_trialRest);
			trialResidual = residual(target);
			after = m_gradient.norm();
			if (std::isfinite(trialResidual) && after <= (1.0 - kDecrease * t) * before)
				break;
			m_map->reject();
			t *= 0.5;
			// A full step that only rounding keeps from descending is the end, not a failure.
			if (t < kLeastStep || reached) {
				searchFails = true;
				break;
			}
		}
		if (searchFails) {
			m_map->evaluate(u, m_rest);
			result.residual = residual(target);
			continue;
		}
		u.swap(m_trial);
		m_rest.swap(m_trialRest);
		m_map->accept();
		result.residual = trialResidual;
		if (reached)
			++polishing;
		else if (++result.iterations % kStagnationSteps == 0) {
			searchFails = m_map->brokenTriangles() > 0 && after > kStagnation * normThen;
			normThen = after;
		}
		if (surgeon && surgeon(*m_map)) {
			m_map->evaluate(u, m_rest);
			result.residual = residual(target);
		}
	}
	const double observedFloor = searchFails ? kFloorUncertainty * result.floor : result.floor;
	const bool atFloor = result.residual < kLargestFloor && result.residual <= observedFloor;
	result.converged =
		m_map->brokenTriangles() == 0 && (result.residual < options.epsilon || atFloor);
	return result;
}

} // namespace ricci
