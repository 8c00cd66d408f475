// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_FLIPPED_FLOW_H
#define RICCI_TESTS_FLIPPED_FLOW_H

#include "random.h"

#include <ricci/flow/ricci_flow.h>
#include <ricci/flow/target_curvature.h>
#include <ricci/layout/common_refinement.h>
#include <ricci/layout/cut_graph.h>
#include <ricci/metric/delaunay_start.h>
#include <ricci/options.h>

#include <vector>

namespace ricci::testing {

/// The flow with intrinsic flips on one connected surface, and what it was asked for.
struct FlippedFlow
{
	SurfaceMesh mesh;
	Triangulation base;
	std::vector<double> lengths;
	Topology topology;
	FlowResult result;

	/// \throw what chooseTarget() and runRicciFlow() throw
	FlippedFlow(const SurfaceMesh& mesh, const TargetRequest& request, double epsilon = 1e-10);

	/// From any triangulation; targets that need places in space are not for it.
	FlippedFlow(const IntrinsicMesh& metric, const TargetRequest& request, double epsilon = 1e-10);

	/// Input's metric flattened cut open along a cut graph through all cones, and laid out.
	CutGraph cut() const;
	CommonRefinement refinement(const CutGraph& cut) const;

private:
	void run(TargetRequest request, double epsilon);
};

/// Requests by name.
TargetRequest requestOf(TargetCurvature mode, bool freeBoundary = true);
TargetRequest conesAt(const SurfaceMesh& mesh, const std::vector<int>& vertices);
TargetRequest prescribed(std::vector<double> curvature, bool freeBoundary = false);

/// Values uniform in [low, high) at a random \p share of the vertices, 0 elsewhere, then moved
/// together so that they add up to 2 pi chi, with \p high as a bound. \p chi as of a closed surface.
std::vector<double>
randomCurvature(int vertexCount, int chi, double low, double high, double share, Random& random);

/// Curvature error of a result by its lengths alone, in extended precision, and the part of it that
/// the last place of the lengths accounts for.
struct IndependentError
{
	double error = 0.0;    ///< max |K - target|, where K is prescribed
	double rounding = 0.0; ///< what one unit in the last place of all lengths makes of K

	explicit IndependentError(const FlippedFlow& flow);
};

} // namespace ricci::testing

#endif
