// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FLATTEN_H
#define RICCI_FLATTEN_H

#include "../cut/cut_graph.h"
#include "../flow/ricci_flow.h"
#include "../fuchsian/fuchsian_group.h"
#include "../layout/flat_mesh.h"
#include "../layout/planar_layout.h"
#include "../measure/period_matrix.h"
#include "../parametrize.h"
#include "../surface/component.h"

#include <limits>
#include <optional>
#include <vector>

namespace ricci {

/// One component mapped to the plane or to the Poincaré disk: what its stages have found.
struct ComponentMap
{
	SurfaceType type;
	FlowResult flow;
	std::vector<FlowState> flowStates;
	VertexArray<char> cones; ///< 1 at vertices inside that are not flat
	CutGraph cut;
	double seamLength = 0.0; ///< of the cut on the mesh

	PlanarLayout layout; ///< on the triangulation of the cut
	FlatMesh mesh;       ///< what is given back
	double scale = 1.0;  ///< lengths in the layout over those of the flow's metric

	FuchsianGroup group;  ///< hyperbolic
	PeriodMatrix periods; ///< of a closed surface, see measurePeriods()
	std::optional<std::complex<double>> torusModulus;
	std::optional<double> annulusModulus, rectangleAspect, hyperbolicArea, relationError;
	std::optional<double> holonomyError;

	std::vector<std::string> notes; ///< what was chosen, in sentences
	int seamlessSteps = 0;          ///< of Newton's method, for turns across seams
	std::optional<double> boundaryRatioMin, boundaryRatioMax; ///< see Report

	int finishMoved = 0;       ///< points that the repair moved
	int endedEarly = 0;        ///< see Report::endedEarly
	bool hasFreeSeams = false; ///< the finish has let seams go
	int cappedHoles = 0;
	int edgeSwaps = 0, boundarySplits = 0; ///< Method::EdgeSwaps
};

constexpr double kNoAlternative = std::numeric_limits<double>::infinity();

/// The stages of the paper on one component, in order, to the plane: flow domain, initial packing (4.1),
/// target (5.2, 5.3), flow (4.2), cut and layout (4.3), invariants, the finish, and the checks of the
/// result by other formulas.
/// \param alternative what another map that is at hand costs (MapCost)
/// \return none if the target is expected to cost more than that
/// \throw what the stages throw
std::optional<ComponentMap> flattenToPlane(
	const Component& component,
	const VertexInput& input,
	const Options& options,
	double alternative = kNoAlternative);

/// The same to the Poincaré disk, where neither areas nor rotations across seams are asked for, and the side
/// pairings of the cut generate a Fuchsian group.
ComponentMap flattenToDisk(
	const Component& component, const VertexInput& input, const HyperbolicOptions& options);

} // namespace ricci

#endif
