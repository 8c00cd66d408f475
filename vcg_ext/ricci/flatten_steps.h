// SPDX-License-Identifier: GPL-3.0-or-later
// Steps that flattenToPlane() and flattenToDisk() share.
#ifndef RICCI_FLATTEN_STEPS_H
#define RICCI_FLATTEN_STEPS_H

#include "base/task.h"
#include "cones/target_curvature.h"
#include "cut/cut_graph.h"
#include "cut/seam_cost.h"
#include "flatten.h"
#include "mesh/flow_domain.h"
#include "refinement/common_refinement.h"

namespace ricci {

/// Share of a component's progress that is spent before the flow, and after it.
constexpr double kBeforeFlow = 0.05, kAfterFlow = 0.1;

/// The values of a surface of \p vertexCount vertices whose first ones are the component's.
TargetInput targetInput(const Component& component, const VertexInput& input, int vertexCount);

/// Logs what the user should know of a flow that reached its target.
void logFlow(const FlowResult& flow, const FlowOptions& options);

/// 1 at the vertices inside that are not flat in the target: the cut must reach them.
/// \p onHole 1 at vertices of holes that the flow closes with caps; may be empty.
VertexArray<char>
conesOf(const EmbeddedSurface& surface, const Target& target, const VertexArray<char>& onHole = {});

/// The cut graph through all cones on edges of the surface (paper 4.3), without seams to holes that the
/// flow closes with caps and, where it can, without seams inside polygons.
/// \param cost [edge] of a seam
CutGraph
cutDomain(const FlowDomain& domain, EdgeArray<double> cost, const VertexArray<char>& cones);

/// Sum of the lengths of the cut's edges.
double lengthOf(const CutGraph& cut, const EdgeArray<double>& lengths);

/// Whether the pieces of the overlay of a flow with flips are given back, not the triangles of the mesh.
inline bool isRefined(const FlowOptions& options)
{
	return options.output == OutputTriangulation::CommonRefinement;
}

/// The overlay of the flow for the faces of the domain's surface; nothing where its pieces are not given back.
OverlayPieces
flowOverlay(const FlowDomain& domain, const FlowOptions& options, const ComponentMap& map);

/// The layout open along the cut, of the overlay if its pieces are given back: that goes to map.mesh.
SurfaceLayout placeCorners(
	const FlowDomain& domain, OverlayPieces overlay, const FlowOptions& options, ComponentMap& map);

/// Takes down what is known of a component before its flow, and logs it.
void describe(const Component& component, const FlowDomain& domain, ComponentMap& map);

/// Takes down the notes of a target, and logs them.
void noteTarget(const Target& target, ComponentMap& map);

/// A flow of a component, first or again: states and steps go on from those of map.report.flowStates. Notes the
/// target.
/// \throw as runRicciFlow()
FlowResult runFlow(
	const EmbeddedSurface& surface,
	InitialPacking start,
	const Target& target,
	const FlowOptions& options,
	ComponentMap& map);

/// [face of the component] The points of its corners.
Array<Triangle2> cornersOf(const FlowDomain& domain, const PlanarLayout& layout);

/// The faces of a component as they are laid out.
FlatMesh flatMesh(const Component& component, const FlowDomain& domain, const PlanarLayout& layout);

/// The period matrix of a closed surface of genus 1 to kMaxPeriodGenus, in the metric of the mesh, on the
/// triangulation at the start of the flow.
void measurePeriods(ComponentMap& map);

/// Whether straight faces of the component may be flipped in the map although it is right: flips, swaps
/// and splits bend their edges, and the repair moves their corners.
bool mayBeFlipped(const ComponentMap& map, OutputTriangulation output);

/// The promise of Target::maxSpread: while the metric of map.flow changes areas more than its target
/// was chosen for, runs the flow again, to targetToKeepAreas(), in a bounded number of rounds. The
/// metric that keeps areas best stays in map.flow.
/// \param surface on which map.flow has run
/// \throw Stopped
void keepAreas(
	const EmbeddedSurface& surface,
	const TargetRequest& request,
	const Options& options,
	ComponentMap& map);

} // namespace ricci

#endif
