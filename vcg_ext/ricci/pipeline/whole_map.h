// SPDX-License-Identifier: GPL-3.0-or-later
// From the maps of components to the map of the whole mesh.
#ifndef RICCI_WHOLE_MAP_H
#define RICCI_WHOLE_MAP_H

#include "../base/task.h"
#include "../charts/outline_packing.h"
#include "../charts/parametrization.h"
#include "../flow/map_cost.h"
#include "../options.h"
#include "../parametrize.h"
#include "../surface/component.h"
#include "flatten.h"

#include <string>
#include <vector>

namespace ricci {

/// The charts of parametrizeEuclidean() before they are packed, in the plane each from the origin, in the
/// indices of the opened mesh.
/// \param opened receives it
Parametrization chartsInPlane(
	const SurfaceMesh& mesh, const VertexInput& input, const Options& options, OpenedMesh& opened);

/// The charts of parametrizeHyperbolic() before they are placed, each in the unit disk.
Parametrization chartsInDisk(
	const SurfaceMesh& mesh,
	const VertexInput& input,
	const HyperbolicOptions& options,
	OpenedMesh& opened);

/// Free; but a rectangle stays upright, and quarter turns across seams stay quarter turns.
ChartTurns chartTurns(const Options& options);

/// Opens and checks \p mesh, sees whether memory will do, logs what there is to note, and makes \p map
/// ready for its components: its arrays have their sizes, and its mesh the vertices of the opened one.
/// \throw InvalidMesh, TooLarge
std::vector<Component> startMap(
	const SurfaceMesh& mesh, const FlowOptions& options, OpenedMesh& opened, Parametrization& map);

/// A component's map as one chart, in the component's indices.
Parametrization asParametrization(const Component& component, ComponentMap map);

/// What it costs.
MapCost costOf(const Parametrization& map);

/// Whether charts may be cut where they cover themselves. A disk or a rectangle is asked for as one piece;
/// that it is none at a few faces, which the finish could not mend, is counted.
inline bool mayCutCharts(const Options& options)
{
	return options.charts != Charts::OfTheFlow && options.target != TargetCurvature::Disk &&
		   options.target != TargetCurvature::Rectangle;
}

/// Finds charts that overlap, as \p options say; divides them, and reflects flipped triangles, unless the charts
/// are to be those of the flow.
void separateCharts(const Options& options, Parametrization& map);

/// Appends the map of a component, in its indices, to that of the surface that it is a component of.
void append(const Component& component, const Parametrization& part, Parametrization& whole);

/// Shares of the progress after which all components are mapped, and their distortion is measured.
constexpr double kComponentsDone = 0.9, kMeasured = 0.95;

/// Of more components than this, the log describes so many only, the largest.
constexpr std::size_t kDescribedComponents = 20;

/// [component] 1 where the log says nothing of it.
std::vector<char> silentComponents(const std::vector<Component>& components);

/// Runs \p run(component) on every component as its part of the task. Where there are several, an error
/// other than Stopped keeps its type and gets the component's data.
template<class Run>
void runComponents(
	const OpenedMesh& opened, const std::vector<Component>& components, const Run& run)
{
	const std::vector<char> isSilent = silentComponents(components);
	std::size_t facesDone = 0;
	const auto done = [&] {
		return kComponentsDone *
			   (static_cast<double>(facesDone) / static_cast<double>(opened.mesh.triangles.size()));
	};
	for (std::size_t i = 0; i < components.size(); ++i) {
		const Component& component = components[i];
		const double from = done();
		facesDone += component.triangles.size();
		try {
			const Task part(from, done(), isSilent[i]);
			run(component);
		}
		catch (const Stopped&) {
			throw; // not the component's fault
		}
		catch (Error& error) {
			if (components.size() > 1) {
				error.componentFace = opened.face[positionOf(component.face.front())];
				error.componentFaces = component.triangles.size();
			}
			throw;
		}
	}
	if (components.size() > kDescribedComponents)
		logLine(
			"The log leaves out the smaller ones of " + std::to_string(components.size()) +
			" components.");
}

} // namespace ricci

#endif
