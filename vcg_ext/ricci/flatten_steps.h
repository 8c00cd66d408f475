// SPDX-License-Identifier: GPL-3.0-or-later
// Steps that the ways to the plane and to the disk share.
#ifndef RICCI_FLATTEN_STEPS_H
#define RICCI_FLATTEN_STEPS_H

#include "base/convex_hull.h"
#include "base/task.h"
#include "cones/prescribed_target.h"
#include "cut/cut_graph.h"
#include "flatten.h"
#include "mesh/component.h"
#include "refinement/overlay_pieces.h"

#include <string>
#include <vector>

namespace ricci {

/// The flows of a component, those included whose metric was not taken.
struct FlowLog
{
	std::vector<FlowState> states;
	std::vector<std::string> notes; ///< of their targets
	int roundingSteps = 0;          ///< of Newton's method, see makeSeamless()
	int endedEarly = 0;             ///< see Report

	/// Takes down the notes of a target, and logs them.
	void add(const Target& target);
};

/// The values of a surface of \p vertexCount vertices whose first ones are the component's.
VertexInput inputOf(const Component& component, const VertexInput& input, int vertexCount);

/// A flow of a component, first or again.
/// \throw as runRicciFlow()
FlowResult runFlow(
	const EmbeddedSurface& surface,
	InitialPacking start,
	const Target& target,
	const FlowOptions& options,
	FlowLog& log);

/// Logs what the user should know of a flow that reached its target.
void logFlow(const FlowResult& flow, const FlowOptions& options);

/// 1 at the vertices inside that are not flat in the target: the cut must reach them.
/// \p onHole 1 at vertices of holes that the flow closes with caps; may be empty.
VertexArray<char>
conesOf(const EmbeddedSurface& surface, const Target& target, const VertexArray<char>& onHole = {});

/// The cut graph through all cones on edges of the surface (paper 4.3), without seams to holes that the
/// flow closes with caps and, where it can, without seams inside polygons.
/// \param cost [edge] of a seam
/// \param mirror of the domain's surface, or null: the cut is mirrored where that is hardly longer
CutGraph cutDomain(
	const FlowDomain& domain,
	EdgeArray<double> cost,
	VertexArray<char> cones,
	const MirrorSymmetry* mirror = nullptr);

/// Whether the pieces of the overlay of a flow with flips are given back, not the triangles of the mesh.
inline bool isRefined(const FlowOptions& options)
{
	return options.output == OutputTriangulation::CommonRefinement;
}

/// The layout open along the cut, with the refinement if pieces of the overlay are given back.
SurfaceLayout layOutSurface(
	const FlowDomain& domain,
	const FlowOptions& options,
	const FlowResult& flow,
	const EdgeArray<char>& isCut);

/// Invariants with the period matrix of a closed surface of genus 1 to kMaxPeriodGenus, in the metric of the mesh,
/// on the triangulation at the start of the flow.
InvariantReport measurePeriods(const SurfaceType& type, const FlowResult& flow);

/// Whether straight faces of the component may be flipped in the map although it is right: flips, swaps
/// and splits bend their edges.
bool isBent(const FlowResult& flow, OutputTriangulation output);

/// Says what the component is.
void logComponent(const Component& component, const SurfaceType& type);

/// Fills in what a map of a component without a flow of its own tells: the surface, its seams and, as
/// Parametrization::targetCurvature, what its triangles leave of the turns round the vertices.
void describeByMap(const Component& component, Parametrization& map);

/// Scales points and moves them from the frame of a rectangle to one along the axes, from the origin.
void moveUpright(const OrientedRectangle& r, double scale, Array<Point2>& points);

/// A component by itself, without its map: the values of its vertices, and what is known of its surface, its flow and
/// its cut.
/// \param scale lengths in the map over those of the flow's metric
Parametrization withoutMap(
	const Component& component,
	const FlowDomain& domain,
	const FlowResult& flow,
	FlowLog log,
	const CutGraph& cut,
	double scale);

} // namespace ricci

#endif
