// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_NEWTON_H
#define RICCI_NEWTON_H

#include "../progress.h"
#include "curvature_map.h"
#include "hessian.h"
#include "sparse_cholesky.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace ricci {

/// When Newton's method stops.
struct NewtonOptions
{
	double epsilon = 1e-8; ///< radians: wanted bound of max |target - K|
	int maxIterations = 200;
};

struct NewtonResult
{
	bool converged = false;
	int iterations = 0;
	double residual = 0.0; ///< max |target - K| over the free vertices, radians
	double floor = 0.0;    ///< estimate of what rounding lets the residual reach, radians
};

/// Residuals above this are never called converged because of the rounding floor.
constexpr double kLargestFloor = 1e-8;

/// Globalised Newton's method for K(u) = target (paper 4.2): the minimiser of the convex Ricci
/// energy. The only place that decides when a solve stops. Keeps its work space, pattern and
/// factor between calls, so that a warm start costs no set-up.
///
/// A factorisation costs as much as a dozen or more solutions with it, and the Hessian of one step
/// is close to that of the next, flips included. So the factor of one step is the preconditioner of
/// conjugate gradients in the later ones (an inexact Newton method, Dembo, Eisenstat and Steihaug
/// 1982) until it takes more work than a new one.
class NewtonSolver
{
public:
	/// Called at every accepted iterate; returns true if it changed the map (edge swaps), after
	/// which the map is evaluated anew.
	using Surgeon = std::function<bool(CurvatureMap&)>;

	/// \p fixed: [vertex] 1 where u keeps its value (du = 0); the target is ignored there. If
	/// nothing is fixed and the background is scale invariant, the mean of u is kept.
	NewtonSolver(CurvatureMap& map, std::vector<char> fixed);

	/// Goes on with \p map, which has the triangulation of the present one, from the present u and
	/// with the present factorisation: the same equations in other precision.
	void continueOn(CurvatureMap& map);

	/// What the linear solver has done since the construction.
	const CholeskyWork& work() const { return m_cholesky.work(); }

	/// [vertex] Part of u below the last place of its doubles, as the last solve left it.
	const Eigen::VectorXd& rest() const { return m_rest; }

	/// Solves from \p u, which holds the solution afterwards (to its last place; the map is left at
	/// the solution's full precision, from which a further call with the same \p u goes on). \p
	/// target: K at each vertex, radians. \p report is called with the iteration number and the
	/// residual before each step; it may throw to cancel. Never throws for lack of convergence: see
	/// NewtonResult.
	NewtonResult solve(
		Eigen::VectorXd& u,
		const Eigen::VectorXd& target,
		const NewtonOptions& options,
		const std::function<void(int, double)>& report,
		const Surgeon& surgeon = nullptr);

private:
	double residual(const Eigen::VectorXd& target);
	void updateMatrix(double shift);
	int iterate(double accuracy, int mostIterations);
	void factorize();
	void gatherRightSide();
	void direction(double accuracy, bool reached);
	double longestStep(const Eigen::VectorXd& u, double largest);
	void applyStep(const Eigen::VectorXd& u, double t);
	double roundingFloor();

	CurvatureMap* m_map;
	std::vector<char> m_fixed;
	std::vector<int> m_unknown; // [vertex] row, or -1
	int m_unknownCount = 0;
	bool m_gaugeFree = false; // the mean of u is free
	int m_revision = -1;      // of the map, when the pattern was laid out
	bool m_analyzed = false;  // the symbolic factorisation is that of the pattern
	bool m_factored = false;
	bool m_shifted = false; // the factor is that of a matrix with a shift
	bool m_worn = false;    // the factor has become a bad preconditioner
	Hessian m_hessian;
	SparseCholesky m_cholesky;
	Eigen::VectorXd m_gradient;                       // [vertex] K - target, 0 where fixed
	Eigen::VectorXd m_rhs, m_solution;                // [unknown]
	Eigen::VectorXd m_direction, m_trial, m_diagonal; // [vertex]
	Eigen::VectorXd m_rest, m_trialRest;              // [vertex] of u, below its last place
};

} // namespace ricci

#endif
