// SPDX-License-Identifier: GPL-3.0-or-later
#include "parametrize.h"

#include "base/numbers.h"
#include "base/task.h"
#include "charts/finish_in_floats.h"
#include "charts/pack.h"
#include "charts/separate_charts.h"
#include "flatten.h"
#include "hyperbolic/finish_disks.h"
#include "hyperbolic/holonomy_check.h"
#include "input_indices.h"
#include "left_out.h"
#include "measure/distortion.h"
#include "measure/overlap_check.h"
#include "whole_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace ricci {

namespace {

/// Share of the progress after which the charts are found.
constexpr double kMapped = 0.95;

/// Between charts that lie beside a disk: two pixels of a texture of a thousand.
constexpr double kMarginBeside = 0.002;

/// \param last of the choices
template<class Choice>
void requireChoice(const char* name, Choice value, Choice last)
{
	const int number = static_cast<int>(value), count = static_cast<int>(last) + 1;
	if (number < 0 || number >= count)
		throw InvalidOption(name, number, count);
}

void checkFlowOptions(const FlowOptions& options)
{
	requireChoice("method", options.method, Method::Thurston);
	requireChoice("output", options.output, OutputTriangulation::CommonRefinement);
	requireChoice("finish", options.finish, Finish::LeastStretch);
	if (!(options.epsilon > 0.0 && std::isfinite(options.epsilon)))
		throw InvalidOption(InvalidOption::Epsilon, options.epsilon);
	if (options.output == OutputTriangulation::CommonRefinement &&
		options.method != Method::IntrinsicFlips)
		throw InvalidOption(InvalidOption::WithoutFlips);
}

/// Gives copies of vertices the values of their vertices, where there are any.
template<class T>
void extendToCopies(const OpenedMesh& opened, std::vector<T>& values)
{
	for (std::size_t v = values.size(); !values.empty() && v < opened.vertex.size(); ++v)
		values.push_back(values[positionOf(opened.vertex[v])]);
}

/// Opens and checks the mesh.
/// \param values of the vertices of the opened mesh
template<class AnyOptions>
std::vector<Component> open(
	const SurfaceMesh& mesh,
	const AnyOptions& options,
	OneSidedCut cut,
	VertexInput& values,
	OpenedMesh& opened,
	Parametrization& map)
{
	checkOptions(options);
	requireLength("selected", values.selected.size(), mesh.positions.size());
	requireLength("targetCurvature", values.targetCurvature.size(), mesh.positions.size());
	advance(0.0, "Checking the mesh");
	std::vector<Component> components = startMap(mesh, options, cut, opened, map);
	extendToCopies(opened, values.selected);
	extendToCopies(opened, values.targetCurvature);
	return components;
}

/// Maps every component, and measures the whole.
/// \param flatten flatten(component) to a Parametrization
template<class Flatten, class Measure>
void mapComponents(
	const OpenedMesh& opened,
	const std::vector<Component>& components,
	const Flatten& flatten,
	const Measure& measure,
	Parametrization& map)
{
	appendComponents(opened, components, flatten, map);
	map.report.converged = true;
	map.report.charts = static_cast<int>(map.charts.size());
	advance(kComponentsDone, "Measuring the distortion");
	measure(opened, map);
	advance(1.0, "Layout done");
}

/// Whether Automatic may unfold a component: nothing but the default has been asked for that a flow of the
/// whole component would have to give.
bool mayUnfold(const Component& component, const Options& options)
{
	return options.target == TargetCurvature::Automatic && options.freeBoundary &&
		   isForObjective(options.cones) && options.cones.rounding == ConeRounding::Free &&
		   isFinished(options) && options.output == OutputTriangulation::KeepMesh &&
		   options.charts != Charts::OfTheFlow && !component.hasSeam;
}

/// Share of the curvature that may be left between creases where a component is unfolded first.
constexpr double kMaxCurvatureBetween = 0.25;

/// A component whose map as a whole costs more, or is expected to, is unfolded, too, whatever its curvature.
constexpr double kPoorCost = 6.0;

/// Where the map of the cones that were expected to cost least is poor all the same, those that bring the expected
/// spread of areas below these are tried: the linear model promises too much where scales differ much.
constexpr double kSpreadsInstead[] = {0.5, 0.25};

/// "energy 4.01, seams 11.9 (objective 4.6)"
std::string costText(const Parametrization& map)
{
	const MapCost cost = costOf(map);
	return "energy " + numberText(cost.energy, 3) + ", seams " + numberText(cost.seams, 3) +
		   " (objective " + numberText(cost.total(), 3) + ")";
}

/// The charts of a component: those of the flow or, where that costs less, of the surface unfolded between
/// its creases.
Parametrization
mapToPlane(const Component& component, const VertexInput& input, const Options& options)
{
	std::optional<Parametrization> unfolded;
	const auto alternative = [&](double cost) {
		const bool isPoor = cost > kPoorCost;
		if (!unfolded && (isPoor || cost == 0.0) && mayUnfold(component, options))
			unfolded = unfold(component, options, isPoor ? 1.0 : kMaxCurvatureBetween);
		return unfolded ? costOf(*unfolded).total() : kNoAlternative;
	};
	const auto chosen = [](const std::string& choice, Parametrization map) {
		map.report.choice = choice;
		map.notes.push_back("Automatic: " + choice + ".");
		logLine(map.notes.back());
		return map;
	};
	std::optional<ComponentMap> flow = flattenToPlane(component, input, options, alternative);
	const auto cut = [&] { return "cut along creases and unfolded: " + costText(*unfolded); };
	if (!flow) {
		const std::string choice = cut() + "; cones are expected to cost more";
		return chosen(choice, std::move(*unfolded));
	}
	advance(1.0, "Looking for overlaps");
	Parametrization map = asParametrization(component, std::move(*flow));
	separateCharts(options, map);
	double cost = costOf(map).total();
	for (const double spread : kSpreadsInstead) {
		if (std::min(cost, alternative(cost)) <= kPoorCost ||
			map.report.targetUsed != TargetUsed::PlacedCones || !isForObjective(options.cones))
			break;
		Options other = options;
		other.cones.distortion = spread;
		auto next = attempt("the map before it stays", [&] {
			Parametrization part =
				asParametrization(component, *flattenToPlane(component, input, other));
			separateCharts(options, part);
			return part;
		});
		if (next && costOf(*next).total() < cost) {
			cost = costOf(*next).total();
			next->report.iterations += map.report.iterations;
			map = std::move(*next);
		}
	}
	const bool isUnfolded = alternative(cost) < cost;
	if (!unfolded)
		return map;
	const std::string whole = "as a whole: " + costText(map);
	const int steps = unfolded->report.iterations + map.report.iterations;
	const std::string choice =
		isUnfolded ? cut() + "; " + whole : map.report.choice + "; " + whole + "; " + cut();
	map = chosen(choice, isUnfolded ? std::move(*unfolded) : std::move(map));
	map.report.iterations = steps;
	return map;
}

void measure(const OpenedMesh& opened, Parametrization& map)
{
	const std::vector<Point3> surface = map.mesh.onSurface(opened.mesh.positions);
	map.vertexQC = measureDistortion(map.mesh.vertices, surface, map.mesh.corners(), map.report);
	map.report.stretch = stretchEnergy(map.mesh);
}

/// In the unit disk, before the disks are placed.
void measureInDisk(const OpenedMesh& opened, Parametrization& map)
{
	const std::vector<Point3> surface = map.mesh.onSurface(opened.mesh.positions);
	map.vertexQC = measureHyperbolicDistortion(map.mesh, surface, map.report);
}

void note(std::string sentence, Parametrization& map)
{
	map.notes.push_back(std::move(sentence));
	logLine(map.notes.back());
}

/// Maps the components that have no hyperbolic metric to the unit square, and says so.
Parametrization mapBeside(
	const OpenedMesh& opened,
	const std::vector<Component>& components,
	const FlowOptions& options,
	Parametrization& map)
{
	Options inPlane;
	inPlane.epsilon = options.epsilon;
	inPlane.finish = options.finish;
	inPlane.chartMargin = kMarginBeside;
	Parametrization leftOut;
	leftOut.u.resize(map.u.size());
	leftOut.targetCurvature.resize(map.u.size());
	appendComponents(
		opened,
		components,
		[&](const Component& component) { return mapToPlane(component, {}, inPlane); },
		leftOut);
	packCharts(leftOut, inPlane, chartTurns(inPlane));
	const auto& largest = *std::max_element(
		components.begin(), components.end(), [](const Component& a, const Component& b) {
			return a.face.size() < b.face.size();
		});
	const std::size_t count = components.size();
	note(
		std::to_string(count) + (count == 1 ? " component has" : " components have") +
			" no hyperbolic metric with this target, and lie in a square beside the disk: the "
			"largest, with face " +
			std::to_string(opened.face[positionOf(largest.face.front())]) + ", has " +
			std::to_string(largest.face.size()) + " faces.",
		map);
	return leftOut;
}

/// The charts of parametrizeHyperbolic() before they are placed, each in the unit disk.
/// \param leftOut receives the map of the components that have no hyperbolic metric
Parametrization chartsInDisk(
	const SurfaceMesh& mesh,
	const VertexInput& input,
	const HyperbolicOptions& options,
	OpenedMesh& opened,
	Parametrization& leftOut)
{
	const Task part(0.0, kMapped);
	Parametrization map;
	VertexInput values = input;
	std::vector<Component> components =
		open(mesh, options, OneSidedCut::ClearOfBoundary, values, opened, map);
	const std::vector<Component> flat = leaveOut(opened, values, options, components);
	const double share = static_cast<double>(faceCount(components)) /
						 static_cast<double>(opened.mesh.triangles.size());
	{
		const Task ofDisks(0.0, share);
		const auto flatten = [&](const Component& component) {
			return asParametrization(component, flattenToDisk(component, values, options));
		};
		mapComponents(opened, components, flatten, measureInDisk, map);
	}
	if (!flat.empty()) {
		const Task beside(share, 1.0, true);
		leftOut = mapBeside(opened, flat, options, map);
	}
	return map;
}

/// Says what the finish could not mend.
void noteFlipped(OutputTriangulation output, Parametrization& map)
{
	const auto noteCount = [&](int count, const std::string& why) {
		if (count > 0)
			note(std::to_string(count) + (count == 1 ? " face stays" : " faces stay") + why, map);
	};
	const std::string tooSmall =
		" flipped in the coordinates stored: smaller than floats can hold.";
	noteCount(
		map.report.flippedFaces,
		output == OutputTriangulation::KeepMesh
			? " flipped: straight lines between the vertices do not fit the map there. The common "
			  "refinement may draw it without flipped faces."
			: tooSmall);
	noteCount(map.report.flippedByRounding, tooSmall);
}

/// A disk or a rectangle, which must not be cut, is none where most of its faces are flipped or cover each other.
/// \throw NotConverged LostInRounding
void requirePicture(const Options& options, const Report& report, int faces)
{
	const int lost = report.flippedFaces + report.flippedByRounding + report.overlappingFaces;
	if (!isOneChart(options) || !isFinished(options) || 2 * lost <= faces)
		return;
	const auto [least, most] =
		std::minmax_element(report.areaFactors.begin(), report.areaFactors.end());
	throw NotConverged(
		NotConverged::LostInRounding,
		positionOf(lost),
		std::round(0.5 * std::log10(2.0) * (*most - *least)));
}

/// From charts to texture coordinates.
void pack(const OpenedMesh& opened, const Options& options, Parametrization& map)
{
	advance(kMapped, "Packing the charts");
	const ChartTurns turns = chartTurns(options);
	if (options.charts == Charts::CutForRoom && options.normalizeUV &&
		options.target == TargetCurvature::Automatic)
		packForRoom(map, options, turns);
	else
		packCharts(map, options, turns);
	advance(kMapped, "Finishing the coordinates");
	FloatFinish finish;
	finish.forText = options.output == OutputTriangulation::KeepMesh;
	finish.measure = [&] { measure(opened, map); };
	finish.packAgain = [&] { packCharts(map, options, turns); };
	finish.mayCut = mayCutCharts(options);
	finish.keepsBoundary = isOneChart(options);
	if (isFinished(options))
		finishInFloats(finish, map);
	countFlipped(map.mesh, map.report);
	countOverlaps(map);
	countUnequalSeams(map);
	requirePicture(options, map.report, map.mesh.size());
	if (map.report.unequalSeams > 0 && options.finish != Finish::LeastStretch)
		note(
			std::to_string(map.report.unequalSeams) + " edges of the seams are longer on one side "
													  "than on the other: flipped faces beside "
													  "them were mended.",
			map);
	if (isFinished(options))
		noteFlipped(options.output, map);
}

/// Adds the numbers of the whole map, then gives the result the input's indices.
void complete(const SurfaceMesh& mesh, const OpenedMesh& opened, Parametrization& map)
{
	map.report.seamLengthRelative =
		map.report.seamLength /
		std::sqrt(surfaceArea(opened.mesh.positions, opened.mesh.triangles));
	if (map.report.stretch)
		map.report.objective =
			costOf(map.mesh, map.report.seamLength + map.report.chosenSeamLength).total();
	toInputIndices(mesh, opened, map);
	advance(1.0, "Done");
}

} // namespace

void checkOptions(const Options& options)
{
	checkFlowOptions(options);
	requireChoice("target", options.target, TargetCurvature::PlacedCones);
	requireChoice("rounding", options.cones.rounding, ConeRounding::QuarterTurns);
	requireChoice("holes", options.holes, Holes::ShortCapped);
	requireChoice("charts", options.charts, Charts::CutForRoom);
	if (options.holes == Holes::Capped && options.method != Method::IntrinsicFlips)
		throw InvalidOption(InvalidOption::WithoutFlips);
	if (options.cones.count < 0)
		throw InvalidOption(InvalidOption::ConeCount, options.cones.count);
	if (!(options.cones.distortion >= 0.0 && std::isfinite(options.cones.distortion)))
		throw InvalidOption(InvalidOption::ConeDistortion, options.cones.distortion);
	checkChartMargin(options.chartMargin);
	if (!(options.seamHiding >= 0.0 && options.seamHiding <= 1.0))
		throw InvalidOption(InvalidOption::SeamHiding, options.seamHiding);
}

void checkOptions(const HyperbolicOptions& options)
{
	requireChoice("target", options.target, HyperbolicTarget::Prescribed);
	if (options.method == Method::EdgeSwaps || options.method == Method::Thurston)
		throw InvalidOption(InvalidOption::HyperbolicMethod);
	checkFlowOptions(options);
}

ChartTurns chartTurns(const Options& options)
{
	return options.target == TargetCurvature::Rectangle           ? ChartTurns::None
		   : options.cones.rounding == ConeRounding::QuarterTurns ? ChartTurns::Quarter
																  : ChartTurns::Free;
}

Parametrization chartsInPlane(
	const SurfaceMesh& mesh, const VertexInput& input, const Options& options, OpenedMesh& opened)
{
	const Task part(0.0, kMapped);
	Parametrization map;
	VertexInput values = input;
	const std::vector<Component> components =
		open(mesh, options, OneSidedCut::Shortest, values, opened, map);
	const auto flatten = [&](const Component& component) {
		return mapToPlane(component, values, options);
	};
	mapComponents(opened, components, flatten, measure, map);
	return map;
}

Parametrization
parametrizeEuclidean(const SurfaceMesh& mesh, const VertexInput& input, const Options& options)
{
	OpenedMesh opened;
	Parametrization map = chartsInPlane(mesh, input, options, opened);
	pack(opened, options, map);
	complete(mesh, opened, map);
	return map;
}

Parametrization parametrizeHyperbolic(
	const SurfaceMesh& mesh, const VertexInput& input, const HyperbolicOptions& options)
{
	OpenedMesh opened;
	Parametrization leftOut;
	Parametrization map = chartsInDisk(mesh, input, options, opened, leftOut);
	advance(kMapped, "Finishing the coordinates");
	const bool isRefined = options.output == OutputTriangulation::CommonRefinement;
	if (isFinished(options) && finishDisks({options.freeBoundary, isRefined}, map))
		measureInDisk(opened, map);
	map.report.relationError =
		std::max(*map.report.relationError, closingError(map.mesh, map.targetCurvature));
	if (!leftOut.charts.empty())
		addBeside(std::move(leftOut), map);
	placeDisks(map);
	const int flipped = map.report.flippedFaces; // of geodesic triangles
	countFlipped(map.mesh, map.report);
	if (!isFinished(options)) // straight triangles may be flipped where geodesic ones are not
		map.report.flippedFaces = flipped;
	countOverlaps(map);
	countUnequalSeamsInDisk(map);
	if (isFinished(options))
		noteFlipped(options.output, map);
	complete(mesh, opened, map);
	return map;
}

} // namespace ricci
