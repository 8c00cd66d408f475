// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FLATTEN_H
#define RICCI_FLATTEN_H

#include "cut/cut_graph.h"
#include "flow/ricci_flow.h"
#include "hyperbolic/group_of_cut.h"
#include "layout/flat_mesh.h"
#include "layout/planar_layout.h"
#include "mesh/component.h"
#include "parametrize.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace ricci {

/// One component mapped to the plane or to the Poincaré disk: what its stages have found.
struct ComponentMap
{
	SurfaceType type;
	FlowResult flow;
	VertexArray<char> cones; ///< 1 at vertices inside that are not flat
	CutGraph cut;
	PlanarLayout layout; ///< on the triangulation of the cut
	FlatMesh mesh;       ///< what is given back
	double scale = 1.0;  ///< lengths in the layout over those of the flow's metric
	FuchsianGroup group; ///< hyperbolic

	bool hasFreeSeams = false;      ///< the finish has let seams go
	std::vector<std::string> notes; ///< what was chosen, in sentences
	Report report;                  ///< but for what the flow and the cut say: asParametrization()
};

/// The stages of the paper on one component, in order, to the plane: flow domain, initial packing (4.1),
/// target (5.2, 5.3), flow (4.2), cut and layout (4.3), invariants, the finish, and the checks of the
/// result by other formulas.
/// \param alternative alternative(cost) tells what another map costs (MapCost), or kNoAlternative, where this
/// one is expected to cost so much. Called with 0, in another thread if there is one, beside the first stages,
/// and again once a target is chosen by what it is expected to cost.
/// \return none if the target is expected to cost more than that
/// \throw what the stages throw
std::optional<ComponentMap> flattenToPlane(
	const Component& component,
	const VertexInput& input,
	const Options& options,
	const std::function<double(double)>& alternative = [](double) { return kNoAlternative; });

/// The same to the Poincaré disk, where neither areas nor rotations across seams are asked for, and the side
/// pairings of the cut generate a Fuchsian group.
ComponentMap flattenToDisk(
	const Component& component, const VertexInput& input, const HyperbolicOptions& options);

/// Whether a component is to be one chart with the boundary that is asked for.
inline bool isOneChart(const Options& options)
{
	return options.target == TargetCurvature::Disk || options.target == TargetCurvature::Rectangle;
}

/// Whether charts may be cut where they cover themselves. A disk or a rectangle is asked for as one piece;
/// that it is none at a few faces, which the finish could not mend, is counted.
inline bool mayCutCharts(const Options& options)
{
	return options.charts != Charts::OfTheFlow && !isOneChart(options);
}

} // namespace ricci

#endif
