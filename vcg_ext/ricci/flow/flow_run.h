// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FLOW_RUN_H
#define RICCI_FLOW_RUN_H

#include "../error.h"
#include "curvature_map.h"
#include "newton.h"
#include "ricci_flow.h"
#include "target.h"

#include <limits>
#include <memory>
#include <vector>

namespace ricci {

/// What one run of the flow starts from and is to reach: on the surface, or on its double.
struct FlowProblem
{
	Triangulation input; ///< the surface, or its double
	InitialPacking start; ///< on the input's metric
	Target target;       ///< on the input

	/// Vertices of the surface, which have the lowest numbers in its double.
	int vertexCount = 0;

	int maxSteps = NewtonOptions().maxIterations; ///< of one solve

	/// [vertex of a double] the image in the other copy; empty where the input is the surface.
	VertexArray<Vertex> mirror;

	/// The boundary of a circular target, else empty: its vertices in order, the edge from each one
	/// to the next, and the lengths of these edges before the flow.
	std::vector<Vertex> loop;
	std::vector<Edge> loopEdges;
	std::vector<double> loopLengths;

	bool isDoubled() const { return !mirror.empty(); }
};

/// The packing in which a flow with these options starts: with intrinsic flips on the weighted
/// Delaunay triangulation of \p mesh, else on its own.
/// \param mirror see delaunayPacking()
InitialPacking initialPacking(
	IntrinsicMesh mesh,
	const VertexArray<Vertex>& mirror,
	const FlowOptions& options);

/// \param start the initial packing of \p surface
FlowProblem
flowProblem(const EmbeddedSurface& surface, InitialPacking start, const Target& target);

/// On the double of the surface, with its own, symmetric initial packing. Curvature is twice as
/// large on the boundary.
FlowProblem flowProblemOnDouble(
	const EmbeddedSurface& surface,
	const Target& target,
	const FlowOptions& options);

/// One run of the flow on one surface.
class FlowRun
{
public:
	/// \p options and \p listener must live as long as the run. \p stepsBefore is added to the
	/// number of steps that the listener gets and the result has.
	FlowRun(
		Background background,
		FlowProblem problem,
		const FlowOptions& options,
		int stepsBefore,
		const FlowListener& listener,
		NewtonSolver::Surgeon surgeon = nullptr);

	/// Starts from what another run found on the half of this double: its factor() and its arcs().
	void startFrom(const VertexVector& factor, std::vector<double> arcs);

	/// Runs the flow, at the end in extended precision where rounding calls for it.
	/// \return whether the target is reached
	/// \throw NotConverged if a circular boundary does not settle; SolverFailed
	bool solve();

	/// Runs the flow up to \p epsilon, from where solve() goes on.
	/// \return whether that is reached
	/// \pre the target is not circular
	bool solveRoughly(double epsilon);

	/// Newton steps so far, those before this run included.
	int iterations() const { return m_result.iterations; }

	/// Arcs of a circular boundary.
	const std::vector<double>& arcs() const { return m_arcs; }

	/// Logarithmic conformal factor at the surface's vertices, end less start.
	VertexVector factor() const { return (m_result.u - m_startU).head(m_problem.vertexCount); }

	/// Whether a boundary edge would have to flip in the double: the circle of its triangle extends
	/// beyond it.
	bool bendsAtBoundary() const;

	/// What the flow found, moved out: no other function may be called afterwards.
	FlowResult result();

	/// Why solve() has returned false.
	NotConverged failure() const;

private:
	CirclePacking takeStart();
	template<class Geometry>
	std::shared_ptr<CurvatureMap> makeMap(CirclePacking packing) const;
	VertexVector startU(const IntrinsicMesh& mesh, const VertexArray<double>& radii) const;
	NewtonResult solveOnCircle();
	NewtonResult solveFor(
		double epsilon,
		bool polishes = true,
		double maxPolishedFloor = std::numeric_limits<double>::infinity());
	NewtonResult solveExtended();
	bool isFlatDisk() const;
	double spreadOfScales() const;
	std::vector<Edge> flowFlips() const;
	std::vector<double> presentLoopLengths() const;
	NotConverged withState(NotConverged error) const;

	Background m_background;
	FlowProblem m_problem; // the history takes over its input and start where edges flip
	const FlowOptions& m_options;
	const FlowListener& m_listener;
	NewtonSolver::Surgeon m_surgeon;
	FlowResult m_result;
	VertexVector m_startU;
	std::shared_ptr<CurvatureMap> m_map;
	std::vector<Edge> m_flipsBefore; // those of the map in double, once the map is an extended one
	std::unique_ptr<NewtonSolver> m_newton;
	NewtonResult m_solved;
	std::vector<double> m_arcs; // of a circular boundary
};

} // namespace ricci

#endif
