// SPDX-License-Identifier: GPL-3.0-or-later
#include "newton.h"

#include "../base/tolerances.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ricci {

namespace {

/// No entry of u moves further than this in one step: a far trial point drives inversive distances
/// out of range.
constexpr double kStepCap = 4.0;

/// In the hyperbolic plane u is negative; a step covers at most this share of the way to 0.
constexpr double kShareOfRange = 0.9;

/// Where that would shorten the whole step to less than this, only the entries that are too long
/// are shortened: one circle near u = 0, whose radius is nearly infinite, must not slow down all
/// others.
constexpr double kMinShare = 0.01;

/// Sufficient decrease of |K - target| asked of a step of length t: by the factor 1 - kDecrease t. And
/// the share of its first slope with which the energy has to fall still at the end of a step.
constexpr double kDecrease = 1e-4;

/// Steps with the last factor after epsilon is reached; each gains about as many digits as the last
/// full step did, at the cost of one evaluation.
constexpr int kPolishingSteps = 2;

/// A minimum with broken triangles is no metric, and the energy is flat around it: where
/// |K - target| has not fallen by this factor in so many steps, steps are searched by slope, and where
/// it has not after so many of those, the solve ends.
constexpr double kStagnation = 0.9;
constexpr int kStagnationSteps = 20, kSlopeSteps = 80;

/// What a direction may leave of the right side, relative to it: this at first, and the residual
/// itself afterwards, so that every step still squares the residual.
constexpr double kMaxInaccuracy = 0.1;

/// Rate of a factorisation's arithmetic, which stays in the cache, over that of a solution, which
/// reads the factor from memory.
constexpr double kFactorizationRate = 5.0;

/// Bounds of the number of conjugate gradient iterations that cost as much as a factorisation.
constexpr int kMinIterations = 8, kMaxIterations = 50;

int solutionsPerFactorization(const SparseCholesky& cholesky)
{
	const double solution = 4.0 * cholesky.factorEntries();
	const double quotient = cholesky.factorFlops() / (kFactorizationRate * solution);
	return static_cast<int>(std::clamp(quotient, double(kMinIterations), double(kMaxIterations)));
}

/// Angles and their sums are kept as doubles in any case: a dozen angles, the sums of which are up to 2
/// pi and round by up to two epsilons each.
constexpr double kSumRounding = 24.0 * std::numeric_limits<double>::epsilon();

} // namespace

NewtonSolver::NewtonSolver(
	CurvatureMap& map,
	VertexArray<char> fixed,
	std::unique_ptr<FactoredHessian> start,
	const VertexArray<Vertex>& mirror) :
		m_map(&map),
		m_fixed(std::move(fixed))
{
	const bool anyFixed = std::find(m_fixed.begin(), m_fixed.end(), 1) != m_fixed.end();
	m_gaugeFree = !anyFixed && map.scaleInvariant();
	m_hessian = std::make_unique<FactoredHessian>(m_fixed, map.scaleInvariant(), mirror);
	if (start && start->isFactored() && start->hasUnknownsOf(*m_hessian))
		m_start = std::move(start);
	const int n = m_fixed.size();
	m_gradient.resize(n);
	m_direction.resize(n);
	m_trial.resize(n);
	m_diagonal.resize(n);
	m_trialLow.resize(n);
	m_low.setZero(n);
}

void NewtonSolver::continueOn(CurvatureMap& map)
{
	m_hessian->continueOn(*m_map, map);
	m_map = &map;
}

void NewtonSolver::dropSymmetry()
{
	m_symmetricWork = work();
	m_hessian = std::make_unique<FactoredHessian>(m_fixed, m_map->scaleInvariant());
}

CholeskyWork NewtonSolver::work() const
{
	return m_symmetricWork + m_hessian->cholesky().work();
}

/// Computes the gradient; returns max |target - K|, infinity if it is not finite.
double NewtonSolver::residual(const VertexVector& target)
{
	double largest = 0.0;
	for (const Vertex v : m_gradient.indices()) {
		m_gradient[v] = m_fixed[v] ? 0.0 : m_map->curvature()[v] - target[v];
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

/// Makes the factor that the solver was given its own.
/// \return whether there is one
bool NewtonSolver::takeOverStart()
{
	if (!m_start)
		return false;
	m_hessian = std::move(m_start);
	return true;
}

/// Solves H d = -(K - target) so that what is left is at most \p accuracy of the right side, with
/// the last factor as long as that takes less work than a new one. Once epsilon is reached, the
/// last factor has to do.
void NewtonSolver::direction(double accuracy, bool reached)
{
	const bool isFirst = takeOverStart();
	m_hessian->fill(*m_map, 0.0);
	SparseCholesky& cholesky = m_hessian->cholesky();
	const Eigen::VectorXd rhs = -m_hessian->gather(m_gradient);
	Eigen::VectorXd solution;
	const bool usable =
		m_hessian->isFactored() && !m_hessian->isShifted() && m_map->brokenTriangles() == 0;
	bool solved = isFirst || (reached && !usable);
	if (solved)
		solution = cholesky.solve(rhs);
	else if (usable && (!m_worn || reached)) {
		const int limit = solutionsPerFactorization(cholesky);
		const int iterations =
			cholesky.iterate(m_hessian->hessian().matrix(), rhs, accuracy, limit, solution);
		solved = iterations <= limit;
		m_worn = 2 * iterations > limit;
	}
	if (!solved && !reached) {
		m_hessian->factorize(*m_map, m_map->tick());
		m_worn = false;
		solution = cholesky.solve(rhs);
	}
	m_direction = m_hessian->scatter(solution);
	if (m_gaugeFree)
		m_direction.array() -= m_direction.mean();
}

/// Share of m_direction, whose largest entry is \p largest, that keeps u in range. May shorten
/// entries of m_direction.
double NewtonSolver::longestStep(const VertexVector& u, double largest)
{
	const double cap = largest > kStepCap ? kStepCap / largest : 1.0;
	if (m_map->scaleInvariant())
		return cap;
	double share = 1.0;
	for (const Vertex v : u.indices())
		if (m_direction[v] > 0.0)
			share = std::min(share, kShareOfRange * -u[v] / m_direction[v]);
	if (share >= kMinShare)
		return std::min(cap, share);
	for (const Vertex v : u.indices())
		m_direction[v] = std::min(m_direction[v], kShareOfRange * -u[v] / cap);
	return cap;
}

/// m_trial + m_trialLow = u + m_low + t m_direction, with the rounding error of the sum kept.
void NewtonSolver::applyStep(const VertexVector& u, double t)
{
	for (const Vertex v : u.indices()) {
		const double step = m_low[v] + t * m_direction[v];
		const double sum = u[v] + step, virtualStep = sum - u[v];
		m_trial[v] = sum;
		m_trialLow[v] = (u[v] - (sum - virtualStep)) + (step - virtualStep);
	}
}

/// Rounding of the radii moves K by up to eps H_ii, and rounding of the sides of a needle by up to
/// eps times their quotient.
double NewtonSolver::roundingFloor()
{
	m_diagonal.setZero();
	const Triangulation& t = m_map->triangulation();
	for (const Edge e : t.edges()) {
		const double w = std::abs(m_map->weights()[e]) * (1.0 + m_map->cosineLess1()[e]);
		m_diagonal[t.origin(e.halfedge())] += w;
		m_diagonal[t.target(e.halfedge())] += w;
	}
	double amplification = m_map->needleRatio();
	amplification = std::max(amplification, m_diagonal.maxCoeff());
	return 4.0 * m_map->precision() * amplification + kSumRounding;
}

NewtonResult NewtonSolver::solve(
	VertexVector& u,
	const VertexVector& target,
	const NewtonOptions& options,
	const std::function<void(int, double)>& report,
	const Surgeon& surgeon)
{
	NewtonResult result;
	m_map->evaluate(u, m_low);
	m_map->accept();
	if (surgeon && surgeon(*m_map))
		m_map->evaluate(u, m_low);
	if (m_map->revision() != 0)
		m_start.reset();
	result.residual = residual(target);
	int polishing = 0;
	double normThen = m_gradient.norm(); // kStagnationSteps ago
	bool searchFails = false, bySlope = false;
	int slopeSteps = 0;

	while (true) {
		report(result.iterations, result.residual);
		result.floor = roundingFloor();
		const bool valid = m_map->brokenTriangles() == 0;
		const bool reached = valid && result.residual < options.epsilon;
		const bool atFloor = valid && result.residual <= result.floor;
		const bool brokenMinimum =
			!valid && result.residual <= std::min(options.epsilon, result.floor);
		const bool polishes = options.polishes && result.floor <= options.maxPolishedFloor;
		if (atFloor || searchFails || brokenMinimum || m_hessian->unknowns() == 0 ||
			(reached && polishing >= (polishes ? kPolishingSteps : 0)) ||
			(!reached && result.iterations >= options.maxIterations))
			break;

		// Nothing is gained by solving for less than rounding leaves.
		const double accuracy = std::max(result.residual, 0.5 * result.floor / result.residual);
		direction(std::min(accuracy, kMaxInaccuracy), reached && m_hessian->isFactored());
		const double largest = m_direction.lpNorm<Eigen::Infinity>();
		if (!std::isfinite(largest))
			break;
		double t = longestStep(u, largest);
		const double before = m_gradient.norm(), slope = m_gradient.dot(m_direction);
		double after = 0.0;
		double trialResidual;
		while (true) {
			applyStep(u, t);
			m_map->evaluate(m_trial, m_trialLow);
			trialResidual = residual(target);
			after = m_gradient.norm();
			const bool falls = bySlope ? m_gradient.dot(m_direction) <= kDecrease * slope
									   : after <= (1.0 - kDecrease * t) * before;
			if (std::isfinite(trialResidual) && falls)
				break;
			m_map->reject();
			t *= 0.5;
			// A full step that only rounding keeps from descending is the end, not a failure.
			if (t < kMinNewtonStep || reached) {
				searchFails = true;
				break;
			}
		}
		if (searchFails) {
			m_map->evaluate(u, m_low);
			result.residual = residual(target);
			searchFails = valid || bySlope;
			bySlope = !valid;
			continue;
		}
		u.swap(m_trial);
		m_low.swap(m_trialLow);
		m_map->accept();
		result.residual = trialResidual;
		slopeSteps += bySlope;
		if (reached)
			++polishing;
		else if (++result.iterations % kStagnationSteps == 0) {
			const bool stagnates = m_map->brokenTriangles() > 0 && after > kStagnation * normThen;
			searchFails = stagnates && slopeSteps >= kSlopeSteps;
			bySlope = bySlope || stagnates;
			normThen = after;
		}
		if (surgeon && surgeon(*m_map)) {
			m_map->evaluate(u, m_low);
			result.residual = residual(target);
		}
	}
	m_start.reset();
	const double observedFloor = searchFails ? kFloorUncertainty * result.floor : result.floor;
	const bool atFloor = result.residual < kMaxFloor && result.residual <= observedFloor;
	// Where the weights overflow there is no metric, however large epsilon is.
	const bool isMetric = m_map->brokenTriangles() == 0 && std::isfinite(result.floor);
	result.converged = isMetric && (result.residual < options.epsilon || atFloor);
	return result;
}

} // namespace ricci
