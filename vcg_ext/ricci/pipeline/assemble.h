// SPDX-License-Identifier: GPL-3.0-or-later
// From the maps of components to the map of the whole mesh.
#ifndef RICCI_ASSEMBLE_H
#define RICCI_ASSEMBLE_H

#include "../charts/output_triangles.h"
#include "../charts/parametrization.h"
#include "../options.h"
#include "../base/task.h"
#include "../surface/component.h"
#include "flatten_component.h"

#include <string>
#include <vector>

namespace ricci {

/// Opens and checks \p mesh, sees whether memory will do, logs what there is to note, and makes \p result ready
/// for its components: its arrays have their sizes, and its refinement, if one is asked for, begins
/// with the input's vertices.
/// \throw InvalidMesh, TooLarge
std::vector<Component> startResult(
	const SurfaceMesh& mesh,
	const FlowOptions& options,
	OutputTriangulation output,
	Parametrization& result);

/// The triangles of a component's map as they are given back, in the component's numbers and the
/// input's order of corners.
OutputTriangles
outputTriangles(const Component& component, const ComponentMap& map, OutputTriangulation output);

/// Appends a component's map as one more chart, in the numbers of the opened mesh and the orientation of the input.
void append(
	const Component& component,
	const ComponentMap& map,
	OutputTriangulation output,
	Parametrization& result);

/// Shares of the progress after which all components are mapped, and their distortion is measured.
constexpr double kComponentsDone = 0.9, kMeasured = 0.95;

/// Of more components than this, the log describes so many only, the largest.
constexpr std::size_t kDescribedComponents = 20;

/// [component] 1 where the log says nothing of it.
std::vector<char> silentComponents(const std::vector<Component>& components);

/// Runs \p run(component) on every component as its part of the task. Where there are
/// several, an error other than Stopped keeps its type and gets the component's data.
template<class Run>
void runComponents(
	const OpenedMesh& opened, const std::vector<Component>& components, Run run)
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
