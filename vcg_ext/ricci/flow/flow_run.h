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

/// Polygon inscribed in a circle. Side i runs from corner i to corner i + 1 (cyclic).
struct InscribedPolygon
{
	double radius = 0.0;
	std::vector<double> arcs; ///< [side] central angle in radians; they add up to 2 pi
};

/// The one polygon inscribed in a circle with these side lengths, in this order. The centre may lie
/// outside the polygon.
/// \pre each side is less than the sum of the others
InscribedPolygon inscribedPolygon(const std::vector<double>& sides);

/// Exterior angle at each corner of the inscribed polygon with these arcs, radians: half the sum of
/// the two adjacent arcs.
std::vector<double> exteriorAngles(const std::vector<double>& arcs);

/// Arcs after the Moebius transformation of the disk that brings the conformal barycentre of the
/// corners, weighted by \p weights, to the centre [Douady Earle 1986]. It exists and is unique up
/// to rotation while no weight is half of the sum or more; otherwise \p arcs is returned.
std::vector<double>
centredArcs(const std::vector<double>& arcs, const std::vector<double>& weights);

/// Present lengths of the boundary's edges.
using BoundaryLengths = std::function<std::vector<double>()>;

/// Solves for exterior angles at the boundary's vertices, in radians, up to an epsilon.
using SolveForAngles =
	std::function<NewtonResult(const std::vector<double>& angles, double epsilon)>;

/// Solves for a disk that becomes round (paper 5.2): its boundary is inscribed in a circle. The
/// exterior angles follow the boundary's lengths, solve by solve (a fixed point, with Anderson
/// mixing), and the Moebius freedom of the disk is fixed by the conformal barycentre of the
/// original boundary, which is brought to the centre. It ends once the points on the circle stand
/// still, after one more solve, to \p epsilon.
///
/// All arrays follow the vertices of the boundary loop, and its edges from each one to the next.
/// \param sides lengths of the boundary's edges before the flow
/// \param arcs where to start, or empty; afterwards those of the last solve
/// \return the result of the last solve, which is the first one that did not converge if any
/// \throw NotConverged (CircleUnsettled), and what \p solve throws
NewtonResult solveForCircle(
	const std::vector<double>& sides,
	double epsilon,
	const BoundaryLengths& presentSides,
	const SolveForAngles& solve,
	std::vector<double>& arcs);

/// The packing in which a flow with these options starts: with intrinsic flips on the weighted
/// Delaunay triangulation of \p mesh, else on its own.
/// \param mirror see delaunayPacking()
InitialPacking
initialPacking(IntrinsicMesh mesh, const VertexArray<Vertex>& mirror, const FlowOptions& options);

/// The target on the double of a surface, whose curvature is twice as large on the boundary.
/// \param mirror [vertex of the double] its image in the other copy
Target targetOnDouble(Target target, const VertexArray<Vertex>& mirror);

/// Tells the task of each Newton step of a flow. The residual falls by orders of magnitude, so each step
/// closes a part of the distance to epsilon on the logarithmic scale.
class FlowProgress
{
public:
	/// Every state that is passed is appended to \p states, with the steps counted on from those there.
	FlowProgress(double epsilon, std::vector<FlowState>& states) :
			m_epsilon(epsilon), m_states(states)
	{
	}

	/// \param step of the flow; a number that is no larger than the last one begins another solve, which
	/// may go on where that ended
	/// \param residual before it
	void operator()(int step, double residual);

private:
	double m_epsilon, m_first = -1.0;
	std::vector<FlowState>& m_states;
	int m_step = 0;
};

/// One run of the flow on one surface, or on its double.
class FlowRun
{
public:
	/// On \p surface, from its initial packing. \p options and \p progress must live as long as the run.
	FlowRun(
		const EmbeddedSurface& surface,
		InitialPacking start,
		const Target& target,
		const FlowOptions& options,
		FlowProgress& progress);

	/// On the double of \p surface, with its own, symmetric initial packing.
	static FlowRun onDouble(
		const EmbeddedSurface& surface,
		const Target& target,
		const FlowOptions& options,
		FlowProgress& progress);

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

	/// Runs the flow up to \p epsilon, from where solve() goes on.
	/// \return whether that is reached
	/// \pre the target is not circular
	bool solveRoughly(double epsilon);

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
	FlowRun(const FlowOptions& options, FlowProgress& progress);
	void begin(const EmbeddedSurface& surface);
	VertexVector startU() const;
	NewtonResult solveOnCircle();
	NewtonResult solveFor(double epsilon, bool polishes = true);
	double spreadOfScales() const;
	std::vector<double> presentLoopLengths() const;
	NotConverged withState(NotConverged error) const;

	const FlowOptions& m_options;
	FlowProgress& m_progress;
	NewtonSolver::Surgeon m_surgeon;
	FlowResult m_result;          // its target is that on the double, if there is one
	VertexArray<Vertex> m_mirror; // [vertex of a double] its image; empty on the surface
	int m_vertexCount = 0;        // of the surface, whose numbers are the lowest in its double
	int m_maxSteps = NewtonOptions().maxIterations;
	VertexVector m_startU;
	std::shared_ptr<CurvatureMap> m_map;
	std::unique_ptr<NewtonSolver> m_newton;
	NewtonResult m_solved;

	// Of a circular target: the boundary's vertices in order, the edge from each one to the next, the
	// lengths of these edges before the flow, and the arcs of the solution.
	std::vector<Vertex> m_loop;
	std::vector<Edge> m_loopEdges;
	std::vector<double> m_loopLengths, m_arcs;
};

} // namespace ricci

#endif
