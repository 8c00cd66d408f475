// SPDX-License-Identifier: GPL-3.0-or-later
// From the maps of components to the map of the whole mesh.
#ifndef RICCI_WHOLE_MAP_H
#define RICCI_WHOLE_MAP_H

#include "charts/outline_packing.h"
#include "error.h"
#include "flatten.h"
#include "flow/target.h"
#include "layout/parametrization.h"
#include "mesh/component.h"
#include "options.h"
#include "parametrize.h"

#include <functional>
#include <optional>
#include <vector>

namespace ricci {

/// The charts of parametrizeEuclidean() before they are packed, in the plane each from the origin, in the
/// indices of the opened mesh.
/// \param opened receives it
Parametrization chartsInPlane(
	const SurfaceMesh& mesh, const VertexInput& input, const Options& options, OpenedMesh& opened);

/// Free; but a rectangle stays upright, and quarter turns across seams stay quarter turns.
ChartTurns chartTurns(const Options& options);

/// Opens and checks \p mesh, sees whether memory will do, logs what there is to note, and makes \p map
/// ready for its components: its arrays have their sizes, and its mesh the vertices of the opened one.
/// \throw InvalidMesh, TooLarge
std::vector<Component> startMap(
	const SurfaceMesh& mesh,
	const FlowOptions& options,
	OneSidedCut cut,
	OpenedMesh& opened,
	Parametrization& map);

/// A component's map as one chart, in the component's indices.
Parametrization asParametrization(const Component& component, ComponentMap map);

/// What it costs.
MapCost costOf(const Parametrization& map);

/// Divides charts that overlap, unless the charts are to be those of the flow.
void separateCharts(const Options& options, Parametrization& map);

/// Appends the map of a component, in its indices, to that of the surface that it is a component of.
void append(const Component& component, Parametrization part, Parametrization& whole);

/// Share of the progress after which all components are mapped.
constexpr double kComponentsDone = 0.9;

/// Of all of them together.
std::size_t faceCount(const std::vector<Component>& components);

/// Gives an error the data of the component that it is of, where there are several.
void nameComponent(const OpenedMesh& opened, const Component& component, Error& error);

/// Appends what \p flatten makes of each component, several of them at the same time in threads. The log has
/// their lines in the order of the components. Of several errors that of the first component is thrown; where
/// there are several components, it gets the component's data.
void appendComponents(
	const OpenedMesh& opened,
	const std::vector<Component>& components,
	const std::function<Parametrization(const Component&)>& flatten,
	Parametrization& whole);

/// A map of a component in several charts without overlap, in the component's indices.
///
/// Where nearly all curvature of a surface lies at its creases, what is between them is its own flat metric,
/// and a flow that has to spread that curvature over the surface distorts what could lie flat. The component
/// is cut along its creases, each piece is mapped by itself with a free boundary, and the pieces are joined
/// across creases again where they have room: a crease carries no curvature, only its corners do, so that
/// joining distorts nothing. Creases are all edges above one of several angles, each of which is tried; the map
/// that costs least is taken (MapCost).
/// \param maxBetween share of the curvature that may be left between creases
/// \return none where more is left, there are no creases, or there is no memory for it (Task::memoryLimit())
/// \throw what the stages throw
std::optional<Parametrization>
unfold(const Component& component, const Options& options, double maxBetween);

} // namespace ricci

#endif
