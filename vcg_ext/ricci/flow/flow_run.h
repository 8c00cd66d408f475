// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FLOW_RUN_H
#define RICCI_FLOW_RUN_H

#include "../error.h"
#include "../report.h"
#include "curvature_map.h"
#include "newton.h"
#include "ricci_flow.h"
#include "target.h"

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace ricci {

/// [side] Central angle in radians, all of which add up to 2 pi, of each side of the one polygon inscribed in a
/// circle with these side lengths, in this order. The centre may lie outside the polygon.
/// \pre each side is less than the sum of the others
std::vector<double> inscribedArcs(const std::vector<double>& sides);

/// The packing in which a flow with these options starts: with intrinsic flips on the weighted
/// Delaunay triangulation of \p mesh, else on its own.
/// \param mirror see delaunayPacking()
InitialPacking
initialPacking(IntrinsicMesh mesh, const VertexArray<Vertex>& mirror, const FlowOptions& options);

/// Hears of each Newton step of a flow: its number, where one that is no larger than the last begins another solve,
/// which may go on where that ended; and the residual before it.
using FlowProgress = std::function<void(int step, double residual)>;

/// Tells the task. The residual falls by orders of magnitude, so each step closes a part of the distance to epsilon on
/// the logarithmic scale.
/// \param states get every state, with the steps counted on from those there
FlowProgress flowProgress(double epsilon, std::vector<FlowState>& states);

/// One run of the flow on one surface, or on its double.
class FlowRun
{
public:
	/// On \p surface, from its initial packing. \p surface, \p options and \p progress must live as long as
	/// the run.
	FlowRun(
		const EmbeddedSurface& surface,
		InitialPacking start,
		const Target& target,
		const FlowOptions& options,
		const FlowProgress& progress);

	/// On the double of \p surface, with its own, symmetric initial packing.
	static FlowRun onDouble(
		const EmbeddedSurface& surface,
		const Target& target,
		const FlowOptions& options,
		const FlowProgress& progress);

	/// Bounds the Newton steps of one solve.
	void limitSteps(int most) { m_maxSteps = most; }

	/// Lets \p surgeon change the map, see NewtonSolver.
	void operate(NewtonSolver::Surgeon surgeon) { m_surgeon = std::move(surgeon); }

	/// Goes on from the run on the half of this double, which has ended: counts its steps, and starts
	/// from its metric if that is \p solved.
	void goOnFrom(const FlowRun& half, bool solved);

	/// Runs the flow.
	/// \return whether the target is reached
	/// \throw NotConverged if a circular boundary does not settle; SolverFailed
	bool solve();

	/// Whether a boundary edge would have to flip in the double: the circle of its triangle extends
	/// beyond it.
	bool bendsAtBoundary() const;

	/// Frees what only solving needs.
	void end();

	/// What the flow found, moved out: no other function may be called afterwards.
	FlowResult result();

	/// Why solve() has returned false.
	NotConverged failure() const;

private:
	FlowRun(
		const EmbeddedSurface& surface, const FlowOptions& options, const FlowProgress& progress);
	void begin();
	VertexVector startU() const;
	NewtonResult solveOnCircle();
	NewtonResult solveFor(double epsilon);
	double spreadOfScales() const;
	std::vector<Edge> loopEdges() const;
	std::vector<double> presentLoopLengths() const;
	NotConverged withState(NotConverged error) const;

	const EmbeddedSurface& m_surface; // has the lowest numbers of its double
	const FlowOptions& m_options;
	const FlowProgress& m_progress;
	NewtonSolver::Surgeon m_surgeon;
	FlowResult m_result;          // its target is that on the double, if there is one
	VertexArray<Vertex> m_mirror; // [vertex of a double] its image; empty on the surface
	int m_maxSteps = NewtonSolver::kMaxSteps;
	VertexVector m_startU;
	std::shared_ptr<CurvatureMap> m_map;
	std::unique_ptr<NewtonSolver> m_newton;
	NewtonResult m_solved;
	std::vector<double> m_arcs; // of a circular target: those of the sides of the boundary loop
};

} // namespace ricci

#endif
