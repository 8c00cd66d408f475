// SPDX-License-Identifier: GPL-3.0-or-later
#include "newton.h"

#include "../base/numbers.h"
#include "../base/tolerances.h"
#include "../numerics/iteration.h"

#include <algorithm>
#include <cmath>
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

/// Steps with the last factor after epsilon is reached; each gains about as many digits as the last
/// full step did, at the cost of one evaluation.
constexpr int kPolishingSteps = 2;

/// A minimum with broken triangles is not a metric, and the energy is flat around it: where
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

} // namespace

NewtonSolver::NewtonSolver(
	CurvatureMap& map, VertexArray<char> fixed, const VertexArray<Vertex>& mirror) :
		m_map(&map),
		m_fixed(std::move(fixed))
{
	const bool anyFixed = std::find(m_fixed.begin(), m_fixed.end(), 1) != m_fixed.end();
	m_gaugeFree = !anyFixed && map.scaleInvariant();
	m_hessian = std::make_shared<FactoredHessian>(m_fixed, map.scaleInvariant(), mirror);
	const int n = m_fixed.size();
	m_gradient.resize(n);
	m_direction.resize(n);
	m_trial.resize(n);
	m_diagonal.resize(n);
	m_trialLow.resize(n);
	m_low.setZero(n);
}

void NewtonSolver::beginWith(std::shared_ptr<FactoredHessian> hessian)
{
	if (hessian->row() == m_hessian->row())
		m_hessian = std::move(hessian);
}

void NewtonSolver::dropSymmetry()
{
	m_hessian = std::make_shared<FactoredHessian>(m_fixed, m_map->scaleInvariant());
}

/// Computes the gradient; returns max |target - K|, infinity if it is not finite.
double NewtonSolver::residual(const VertexVector& target)
{
	double largest = 0.0;
	for (const Vertex v : m_gradient.indices()) {
		m_gradient[v] = m_fixed[v] ? 0.0 : m_map->curvature()[v] - target[v];
		if (!std::isfinite(m_gradient[v]))
			return kInfinity;
		largest = std::max(largest, std::abs(m_gradient[v]));
	}
	if (m_gaugeFree) {
		// By Gauss-Bonnet the gradient adds up to 0 except for the rounding of the target's sum, which
		// the pinned vertex would have to bear alone.
		m_gradient.array() -= m_gradient.mean();
	}
	return largest;
}

/// Share of m_direction that keeps u in range. May shorten entries of m_direction.
double NewtonSolver::longestStep(const VertexVector& u)
{
	const double largest = m_direction.lpNorm<Eigen::Infinity>();
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
		const double w = std::abs(m_map->weights()[e]) * (1.0 + m_map->cosineLess1(e));
		m_diagonal[t.origin(e.halfedge())] += w;
		m_diagonal[t.target(e.halfedge())] += w;
	}
	double amplification = m_map->needleRatio();
	amplification = std::max(amplification, m_diagonal.maxCoeff());
	// Angles and their sums are kept as doubles in any case: a dozen angles, the sums of which are up to 2 pi and round
	// by up to two units each.
	return 4.0 * kUnitRoundoff * amplification + 24.0 * kUnitRoundoff;
}

/// One call of solve().
struct NewtonSolver::Run
{
	VertexVector& u;
	const VertexVector& target;
	double epsilon;
	int maxSteps;
	const Surgeon& surgeon;
	NewtonResult result = {};   // so far
	double firstNorm = 0.0;     // of the gradient, kStagnationSteps ago
	int polishing = 0;          // steps with the last factor
	int slopeSteps = 0;         // steps searched by the energy's slope
	bool searchesSlope = false; // the next step is
	bool isStuck = false;       // no further step can be found
};

NewtonResult NewtonSolver::solve(
	VertexVector& u,
	const VertexVector& target,
	double epsilon,
	int maxSteps,
	const std::function<void(int, double)>& report,
	const Surgeon& surgeon)
{
	Run run{u, target, epsilon, maxSteps, surgeon};
	m_map->evaluate(u, m_low);
	m_map->accept();
	run.result.residual = residual(target);
	operate(run);
	run.firstNorm = m_gradient.norm();
	while (true) {
		report(run.result.iterations, run.result.residual);
		const Verdict verdict = judge(run);
		if (verdict == Verdict::Stop || !findDirection(run, verdict))
			return ended(run);
		if (searchLine(run, verdict))
			accept(run, verdict);
	}
}

/// What to do at the present iterate: the only place that says when a solve stops.
NewtonSolver::Verdict NewtonSolver::judge(Run& run)
{
	NewtonResult& result = run.result;
	result.floor = roundingFloor();
	const bool isMetric = m_map->brokenTriangles() == 0;
	const double bound = isMetric ? result.floor : std::min(run.epsilon, result.floor); // a minimum
	if (result.residual <= bound || run.isStuck || m_hessian->unknowns() == 0)
		return Verdict::Stop;
	if (!isMetric || !(result.residual < run.epsilon))
		return result.iterations < run.maxSteps ? Verdict::Step : Verdict::Stop;
	return run.polishing < kPolishingSteps ? Verdict::Polish : Verdict::Stop;
}

/// Solves H d = -(K - target), with the last factor as long as that takes less work than a new one, or
/// if there is one and the step only polishes.
/// \return whether there is one and it is finite
bool NewtonSolver::findDirection(Run& run, Verdict verdict)
{
	// Nothing is gained by solving for less than rounding leaves.
	const double left = std::max(run.result.residual, 0.5 * run.result.floor / run.result.residual);
	const double accuracy = std::min(left, kMaxInaccuracy);
	const bool keepsFactor = verdict == Verdict::Polish && m_hessian->isFactored();
	m_hessian->fill(*m_map);
	SparseCholesky& cholesky = m_hessian->cholesky();
	const Eigen::VectorXd rhs = -m_hessian->gather(m_gradient);
	Eigen::VectorXd solution;
	const bool usable =
		m_hessian->isFactored() && !m_hessian->isShifted() && m_map->brokenTriangles() == 0;
	if (keepsFactor && !usable) {
		run.isStuck = true; // a shifted factor polishes nothing
		return false;
	}
	bool solved = false;
	if (usable && (!m_worn || keepsFactor)) {
		const int limit = solutionsPerFactorization(cholesky);
		const int iterations =
			cholesky.iterate(m_hessian->matrix(), rhs, accuracy, limit, solution);
		solved = iterations <= limit;
		m_worn = 2 * iterations > limit;
	}
	if (!solved && !keepsFactor) {
		m_hessian->factorize();
		m_worn = false;
		solution = cholesky.solve(rhs);
	}
	m_direction = m_hessian->scatter(solution);
	if (m_gaugeFree)
		m_direction.array() -= m_direction.mean();
	return std::isfinite(m_direction.lpNorm<Eigen::Infinity>());
}

/// Shortens the step until |K - target| falls enough, or the energy still falls at its end. Where no
/// step does, returns to the iterate; if triangles are broken there, the next step is searched by the
/// energy's slope.
/// \return whether m_trial is better than u
bool NewtonSolver::searchLine(Run& run, Verdict verdict)
{
	const bool isMetric = m_map->brokenTriangles() == 0;
	double t = longestStep(run.u);
	const double norm = m_gradient.norm(), slope = m_gradient.dot(m_direction);
	do {
		applyStep(run.u, t);
		m_map->evaluate(m_trial, m_trialLow);
		const double trialResidual = residual(run.target);
		// The energy still has to fall with a share of its first slope, or |K - target| falls by a share of t.
		const double share = LineSearch::kDecrease;
		const bool falls = run.searchesSlope ? m_gradient.dot(m_direction) <= share * slope
											 : m_gradient.norm() <= (1.0 - share * t) * norm;
		if (std::isfinite(trialResidual) && falls) {
			run.result.residual = trialResidual;
			return true;
		}
		m_map->reject();
		t *= 0.5;
		// A full step that only rounding keeps from descending is the end, not a failure.
	} while (t >= kMinNewtonStep && verdict == Verdict::Step);
	m_map->evaluate(run.u, m_low);
	run.result.residual = residual(run.target);
	run.isStuck = isMetric || run.searchesSlope;
	run.searchesSlope = !isMetric;
	return false;
}

/// Makes m_trial the iterate, and looks whether the steps still get somewhere.
void NewtonSolver::accept(Run& run, Verdict verdict)
{
	run.u.swap(m_trial);
	m_low.swap(m_trialLow);
	m_map->accept();
	run.slopeSteps += run.searchesSlope;
	run.polishing += verdict == Verdict::Polish;
	if (++run.result.iterations % kStagnationSteps == 0 && verdict == Verdict::Step) {
		const double norm = m_gradient.norm();
		const bool stagnates = m_map->brokenTriangles() > 0 && norm > kStagnation * run.firstNorm;
		run.isStuck = stagnates && run.slopeSteps >= kSlopeSteps;
		run.searchesSlope = run.searchesSlope || stagnates;
		run.firstNorm = norm;
	}
	operate(run);
}

/// Lets the surgeon change the map at the present iterate.
void NewtonSolver::operate(Run& run)
{
	if (!run.surgeon || !run.surgeon(*m_map))
		return;
	m_map->evaluate(run.u, m_low);
	run.result.residual = residual(run.target);
}

NewtonResult NewtonSolver::ended(const Run& run) const
{
	NewtonResult result = run.result;
	const double observedFloor = run.isStuck ? kFloorUncertainty * result.floor : result.floor;
	const bool atFloor = result.residual < kMaxFloor && result.residual <= observedFloor;
	// Where the weights overflow there is no metric, however large epsilon is.
	const bool isMetric = m_map->brokenTriangles() == 0 && std::isfinite(result.floor);
	result.converged = isMetric && (result.residual < run.epsilon || atFloor);
	return result;
}

} // namespace ricci
