// SPDX-License-Identifier: GPL-3.0-or-later
// What the Euclidean and the hyperbolic parametrization share: from components to one result.
#ifndef RICCI_RESULT_ASSEMBLY_H
#define RICCI_RESULT_ASSEMBLY_H

#include "error.h"
#include "flow/ricci_flow.h"
#include "layout/cut_graph.h"
#include "layout/distortion.h"
#include "parametrize.h"
#include "run_progress.h"
#include "surface/component.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace ricci {

/// \throw InvalidOption for a number out of range
void checkFlowOptions(const FlowOptions& options);

/// Checks \p mesh and whether memory will do, logs what there is to note, and makes \p result ready
/// for its components: its arrays have their sizes, and its refinement, if one is asked for, begins
/// with the input's vertices.
/// \throw InvalidMesh, InvalidOption and what requireMemory() throws
std::vector<Component> startResult(
	const SurfaceMesh& mesh,
	const FlowOptions& options,
	OutputTriangulation output,
	Progress& progress,
	Parametrization& result);

/// The note that the flow sees longer edges than the input's, if it does.
void logLengthened(const FlowResult& flow, Interval& interval);

/// Puts the flow on one component into \p result: u, moved by \p shift, the target, and its part of
/// the report.
void storeFlow(
	const FlowResult& flow,
	const Component& component,
	const Topology& topology,
	double shift,
	Parametrization& result);

/// Adds the cut of one component to the report. \p lengths [edge] of the input.
void storeCut(const CutGraph& cut, const std::vector<double>& lengths, Report& report);

/// Distortion of the map and of its refinement if it has one, whose figures then are those of the
/// report. \p measure takes what measureDistortion() does.
using Measure = std::function<DistortionField(
	const SurfaceMesh&,
	const std::vector<std::array<Point2, 3>>&,
	const std::vector<char>&,
	Report&)>;
void measureResult(
	const SurfaceMesh& mesh,
	OutputTriangulation output,
	const Measure& measure,
	Parametrization& result);

/// In space.
double areaOf(const SurfaceMesh& mesh);

/// The overlay of the triangles that the flow with flips went through, for the faces of \p base, the
/// triangulation of the component. \p isCut [edge of base]: where the layout is cut.
/// \param endsAtBoundary whether the flow's surface goes on beyond that of base (its double, caps on
/// holes), which then ends there
/// \param cornersOnly see FlippedSurface
/// \param listener see commonRefinement()
CommonRefinement overlayOfFlow(
	const FlowResult& flow,
	Background background,
	const Triangulation& base,
	const std::vector<Point3>& positions,
	std::vector<char> isCut,
	bool endsAtBoundary,
	bool cornersOnly,
	const OverlayListener& listener);

/// Appends the refinement of one component, in the indices and the orientation of the whole input.
void appendRefinement(
	const CommonRefinement& refinement,
	const Component& component,
	RefinedMesh& refined,
	Chart& chart);

/// The triangles of one component's chart as they are given back, in the input's order of corners.
struct OutputTriangles
{
	std::vector<Triangle> triangles; ///< corners by vertex or point
	std::vector<std::array<Point2, 3>> plane;
	std::vector<char> reversed; ///< 1 where clockwise is wanted
};

OutputTriangles
outputOf(const Component& component, const Chart& chart, const Parametrization& result);

/// Shares of the progress after which all components are mapped, and their distortion is measured.
constexpr double kComponentsDone = 0.9, kMeasured = 0.95;

/// Runs \p run(component, interval) on every component with its share of the progress. An error
/// names its component where there are several.
template<class Run>
void runComponents(
	const SurfaceMesh& mesh, const std::vector<Component>& components, Progress& progress, Run run)
{
	std::size_t facesDone = 0;
	for (const Component& component : components) {
		const auto done = [&] {
			return kComponentsDone *
				   (static_cast<double>(facesDone) / static_cast<double>(mesh.triangles.size()));
		};
		const double from = done();
		facesDone += component.triangles.size();
		try {
			run(component, Interval(progress, from, done()));
		}
		catch (const Stopped&) {
			throw;
		}
		catch (const Error& error) {
			if (components.size() == 1)
				throw;
			throw Error(
				"Component with face " + std::to_string(component.face.front()) + " (" +
				std::to_string(component.face.size()) + " faces): " + error.what());
		}
	}
}

} // namespace ricci

#endif
