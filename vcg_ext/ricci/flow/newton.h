// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_NEWTON_H
#define RICCI_NEWTON_H

#include "curvature_map.h"

#include <functional>
#include <memory>

namespace ricci {

struct NewtonResult
{
	bool converged = false;
	int iterations = 0;    ///< steps, those that polish included
	double residual = 0.0; ///< max |target - K| over the free vertices, radians
	double floor = 0.0;    ///< estimate of what rounding lets the residual reach, radians
};

/// Globalised Newton's method for K(u) = target (paper 4.2), whose solutions are the minimisers of
/// the convex Ricci energy (Eq. 10). The only place that decides when a solve stops. Keeps its work
/// space, pattern and factor between calls, so that a warm start costs no set-up.
///
/// The merit function of the line search is |K - target|, the Euclidean norm of the gradient of the
/// energy, and not the energy itself, for three reasons. The energy is an integral along a path;
/// its closed form (Euclidean) is a sum of Lobachevsky functions, which cost more than K. Near its
/// minimum the energy decreases by the square of the residual, which is lost in rounding while half
/// of the residual's digits are still to be gained. And the norm falls along Newton's direction
/// d = -H^-1 (K - target) wherever the Hessian H is positive definite: the derivative of
/// |K - target|^2 along d is -2 |K - target|^2.
///
/// On a closed surface with flips H is continuous and positive definite for
/// all u (in the Euclidean plane with one vertex pinned), so that the norm is stationary at the
/// solution only. On a triangulation that stays, and at a boundary, H jumps where triangles break, and may be singular beyond: the norm may be stationary
/// where the energy is not minimal. Where it no longer falls and triangles are broken, steps are
/// searched by the energy's slope instead: a step is as long as the energy still falls at its end,
/// (K - target) . d < 0 there. That lowers the convex energy E without its value, because
/// E(u + d) <= E(u) + (K(u + d) - target) . d, and so leads to its minimum wherever that is a metric.
/// At a minimum with broken triangles, which is none, the solver ends without convergence. An edge
/// swap changes the energy, so that nothing is promised across one.
///
/// A factorisation costs as much as a dozen or more solutions with it, and the Hessian of one step
/// is close to that of the next, flips included. So the factor of one step is the preconditioner of
/// conjugate gradients in the later ones, an inexact Newton method [Dembo Eisenstat Steihaug 1982],
/// until it takes more work than a new one.
class NewtonSolver
{
public:
	/// Called at every accepted iterate; returns true if it changed the map (edge swaps), after
	/// which the map is evaluated again.
	using Surgeon = std::function<bool(CurvatureMap&)>;

	/// Fewer than 30 are needed as a rule.
	static constexpr int kMaxSteps = 200;

	/// \param map is evaluated by solve(); must live as long as the solver
	/// \param fixed 1 where u keeps its value (du = 0 in paper 5.3); the target is ignored there.
	/// If nothing is fixed and the background is scale invariant, the mean of u is kept.
	/// \param mirror the images of the vertices where map, target and u are symmetric, or empty. Then u
	/// stays symmetric, and there are half as many equations.
	NewtonSolver(
		CurvatureMap& map, VertexArray<char> fixed, const VertexArray<Vertex>& mirror = {});

	/// Begins with the factor of \p hessian, which nobody else uses any more, if its unknowns are the same.
	/// \pre its pattern is that of the map's triangulation
	void beginWith(std::shared_ptr<FactoredHessian> hessian);

	/// Goes on with an unknown for every vertex.
	void dropSymmetry();

	/// What its last linear solver has done, for others before, too.
	const CholeskyWork& work() const { return m_hessian->cholesky().work(); }

	/// Part of u below the last place of its doubles, as the last solve left it.
	const VertexVector& low() const { return m_low; }

	/// Solves from \p u, which holds the solution afterwards (to its last place; the map is left at
	/// the solution's full precision, from which a further call with the same \p u goes on).
	/// \param target K at each vertex, radians
	/// \param epsilon radians: wanted bound of max |target - K|
	/// \param report is called with the iteration number and the residual before each step; it may
	/// throw to cancel
	/// \return also where the target is not reached: lack of convergence is not an error here
	/// \throw SolverFailed
	NewtonResult solve(
		VertexVector& u,
		const VertexVector& target,
		double epsilon,
		int maxSteps,
		const std::function<void(int, double)>& report,
		const Surgeon& surgeon = nullptr);

private:
	struct Run;

	/// What is to be done at an iterate.
	enum class Verdict {
		Step,   ///< a step of Newton's method
		Polish, ///< a step with the last factor: epsilon is reached
		Stop
	};

	Verdict judge(Run& run);
	bool findDirection(Run& run, Verdict verdict);
	bool searchLine(Run& run, Verdict verdict);
	void accept(Run& run, Verdict verdict);
	void operate(Run& run);
	NewtonResult ended(const Run& run) const;

	double residual(const VertexVector& target);
	double longestStep(const VertexVector& u);
	void applyStep(const VertexVector& u, double t);
	double roundingFloor();

	CurvatureMap* m_map;
	VertexArray<char> m_fixed;
	bool m_gaugeFree = false; // the mean of u is free
	bool m_worn = false;      // the factor has become a bad preconditioner
	std::shared_ptr<FactoredHessian> m_hessian;
	VertexVector m_gradient; // K - target, 0 where fixed
	VertexVector m_direction, m_trial, m_diagonal;
	VertexVector m_low, m_trialLow; // of u, below its last place
};

} // namespace ricci

#endif
