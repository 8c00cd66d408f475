// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_FLIPPED_FLOW_H
#define RICCI_TESTS_FLIPPED_FLOW_H

#include "random.h"

#include <ricci/cones/target_curvature.h>
#include <ricci/cut/cut_graph.h>
#include <ricci/flow/ricci_flow.h>
#include <ricci/mesh/component.h>
#include <ricci/metric/circle_packing.h>
#include <ricci/options.h>
#include <ricci/refinement/overlay_pieces.h>

#include <utility>
#include <vector>

namespace ricci::testing {

/// The flow with its states forgotten.
inline FlowResult runRicciFlow(
	const EmbeddedSurface& surface,
	InitialPacking start,
	const Target& target,
	const FlowOptions& options)
{
	std::vector<FlowState> states;
	return ricci::runRicciFlow(surface, std::move(start), target, options, states);
}

/// What chooseHyperbolicTarget() is asked for.
struct HyperbolicRequest : VertexInput
{
	HyperbolicTargetOptions options;
};

/// The stages of the flow with intrinsic flips on one connected surface, up to the common
/// refinement.
struct FlippedFlow
{
	SurfaceMesh mesh;
	FlowDomain domain;
	FlowResult result;

	/// \throw what chooseTarget() and runRicciFlow() throw
	FlippedFlow(const SurfaceMesh& mesh, const TargetRequest& request, double epsilon = 1e-10);

	/// Hyperbolic.
	/// \throw what chooseHyperbolicTarget() and runRicciFlow() throw
	FlippedFlow(const SurfaceMesh& mesh, const HyperbolicRequest& request, double epsilon = 1e-11);

	const EmbeddedSurface& surface() const { return domain.surface; }
	const Triangulation& base() const { return domain.surface.triangulation; }

	/// 1 where the metric found has a cone inside.
	VertexArray<char> cones() const;

	/// Input's metric flattened cut open along a cut graph through all cones, and laid out.
	CutGraph cut() const;
	/// The same along random ways.
	CutGraph cutAnywhere(Random& random) const;
	SurfaceLayout refinement(const CutGraph& cut) const;

private:
	void run(TargetRequest request, double epsilon);
	void run(HyperbolicRequest request, double epsilon);
};

/// Requests by name.
TargetRequest requestOf(TargetCurvature mode, bool freeBoundary = true);
TargetRequest conesAt(const SurfaceMesh& mesh, const std::vector<int>& vertices);
TargetRequest prescribed(std::vector<double> curvature, bool freeBoundary = false);
HyperbolicRequest hyperbolicMetric(bool freeBoundary = false);
HyperbolicRequest hyperbolicPrescribed(std::vector<double> curvature);

/// Values uniform in [low, high) at a random \p share of the vertices, 0 elsewhere, then moved
/// together so that they add up to 2 pi chi, with \p high as a bound. \p chi as of a closed surface.
std::vector<double>
randomCurvature(int vertexCount, int chi, double low, double high, double share, Random& random);

} // namespace ricci::testing

#endif
