// SPDX-License-Identifier: GPL-3.0-or-later
#include "parametrize.h"

#include "base/crew.h"
#include "base/numbers.h"
#include "base/task.h"
#include "charts/pack.h"
#include "flatten.h"
#include "hyperbolic/finish_disks.h"
#include "hyperbolic/group_of_cut.h"
#include "measure/distortion.h"
#include "measure/map_check.h"
#include "whole_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace ricci {

namespace {

/// Charts are packed so many times in all.
constexpr int kMaxPackings = 4;

/// Between charts that lie beside a disk: two pixels of a texture of a thousand.
constexpr double kMarginBeside = 0.002;

/// What is done with positions cannot be had from lengths.
/// \throw InvalidOption
void requirePositions(const SurfaceMesh& mesh, const VertexInput& input, const Options& options)
{
	const bool choosesCorners = options.target == TargetCurvature::Rectangle &&
								std::count(input.selected.begin(), input.selected.end(), 0) ==
									static_cast<std::ptrdiff_t>(input.selected.size());
	if (!mesh.lengths.empty() &&
		(choosesCorners || options.method == Method::EdgeSwaps ||
		 options.output == OutputTriangulation::CommonRefinement || options.seamHiding > 0.0 ||
		 options.sharpAngle < kPi || options.cones.rounding == ConeRounding::QuarterTurns))
		throw InvalidOption(InvalidOption::WithoutPositions);
}

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
	requireChoice("join", options.join, JoinSplitVertices::Always);
	if (!(options.epsilon > 0.0 && std::isfinite(options.epsilon)))
		throw InvalidOption(InvalidOption::Epsilon, options.epsilon);
	if (!(options.sharpAngle > 0.0 && options.sharpAngle <= kPi))
		throw InvalidOption(InvalidOption::SharpAngle, options.sharpAngle);
	if (options.output == OutputTriangulation::CommonRefinement &&
		options.method != Method::IntrinsicFlips)
		throw InvalidOption(InvalidOption::WithoutFlips);
}

/// Maps every component.
/// \param flatten flatten(component) to a Parametrization
/// \param isInPlane see appendComponents()
template<class Flatten>
void mapComponents(const Flatten& flatten, bool isInPlane, WholeMap& whole)
{
	appendComponents(whole.opened, whole.values, whole.components, flatten, isInPlane, whole.map);
	whole.map.report.converged = true;
	advance(kComponentsDone, "Measuring the distortion");
}

/// \param flat [triangle] what of the map is measured
void measure(WholeMap& whole, const Array<Triangle2>& flat)
{
	Parametrization& map = whole.map;
	const SurfaceMesh& mesh = whole.opened.mesh;
	static_cast<DistortionReport&>(map.report) =
		mesh.lengths.empty()
			? measureDistortion(
				  map.mesh.vertices, map.mesh.onSurface(mesh.positions), flat, map.vertexQC)
			: measureDistortion(map.mesh, flat, map.vertexQC);
}

void measureInPlane(WholeMap& whole)
{
	Parametrization& map = whole.map;
	measure(whole, map.mesh.corners());
	map.report.stretch = stretchEnergy(map.mesh);
}

/// In the unit disk, before the disks are placed.
void measureInDisk(WholeMap& whole)
{
	measure(whole, chordTriangles(whole.map.mesh));
}

void note(std::string sentence, Parametrization& map)
{
	map.notes.push_back(std::move(sentence));
	logLine(map.notes.back());
}

/// Free; but a rectangle stays upright, and quarter turns across seams stay quarter turns.
ChartTurns chartTurns(const Options& options)
{
	return options.target == TargetCurvature::Rectangle           ? ChartTurns::None
		   : options.cones.rounding == ConeRounding::QuarterTurns ? ChartTurns::Quarter
																  : ChartTurns::Free;
}

/// Maps the components that have no hyperbolic metric to the unit square.
Parametrization mapBeside(
	const WholeMap& whole, const std::vector<Component>& components, const FlowOptions& options)
{
	Options inPlane;
	inPlane.epsilon = options.epsilon;
	inPlane.finish = options.finish;
	inPlane.chartMargin = kMarginBeside;
	Parametrization leftOut;
	leftOut.u.resize(whole.map.u.size());
	leftOut.targetCurvature.resize(whole.map.u.size());
	appendComponents(
		whole.opened,
		{},
		components,
		[&](const Component& component) { return mapToPlane(component, {}, inPlane); },
		true,
		leftOut);
	packCharts(leftOut, inPlane, chartTurns(inPlane));
	return leftOut;
}

void noteLeftOut(
	const OpenedMesh& opened, const std::vector<Component>& components, Parametrization& map)
{
	const auto& largest = *std::max_element(
		components.begin(), components.end(), [](const Component& a, const Component& b) {
			return a.face.size() < b.face.size();
		});
	note(
		counted(components.size(), "component has", "components have") +
			" no hyperbolic metric with this target, and lie in a square beside the disk: the "
			"largest, with face " +
			std::to_string(opened.face[positionOf(largest.face.front())]) + ", has " +
			std::to_string(largest.face.size()) + " faces.",
		map);
}

/// The charts of parametrizeHyperbolic() before they are placed, each in the unit disk.
/// \param leftOut receives the map of the components that have no hyperbolic metric
WholeMap chartsInDisk(
	const SurfaceMesh& mesh,
	const VertexInput& input,
	const HyperbolicOptions& options,
	Parametrization& leftOut)
{
	const Task part(0.0, kMapped);
	WholeMap whole = open(mesh, input, options, OneSidedCut::ClearOfBoundary);
	const std::vector<Component> flat =
		leaveOut(whole.opened, whole.values, options, whole.components);
	const double share = static_cast<double>(faceCount(whole.components)) /
						 static_cast<double>(whole.opened.mesh.triangles.size());
	{
		const Task ofDisks(0.0, share);
		const auto flatten = [&](const Component& component) {
			return flattenToDisk(component, whole.values, options);
		};
		mapComponents(flatten, false, whole);
		measureInDisk(whole);
		advance(1.0, "Layout done");
	}
	if (!flat.empty()) {
		{
			const Task beside(share, 1.0, true);
			leftOut = mapBeside(whole, flat, options);
		}
		noteLeftOut(whole.opened, flat, whole.map);
	}
	return whole;
}

/// Says what the finish could not mend.
void noteFlipped(OutputTriangulation output, Parametrization& map)
{
	const auto noteCount = [&](int count, const std::string& why) {
		if (count > 0)
			note(counted(positionOf(count), "face stays", "faces stay") + why, map);
	};
	const std::string tooSmall =
		" flipped in the stored coordinates: smaller than floats can represent.";
	noteCount(
		map.report.flippedFaces,
		output == OutputTriangulation::KeepMesh ? " flipped: straight edges cannot follow the map "
												  "there. The common refinement may avoid this."
												: tooSmall);
	noteCount(map.report.flippedByRounding, tooSmall);
}

/// A disk or a rectangle, which must not be cut, is none where a third of its faces are flipped or cover each other.
/// \throw NotConverged LostInRounding
void requirePicture(const Options& options, const Report& report, int faces)
{
	const int lost = report.flippedFaces + report.flippedByRounding + report.overlappingFaces;
	if (!isOneChart(options) || !isFinished(options) || 3 * lost <= faces)
		return;
	throw NotConverged(NotConverged::LostInRounding, positionOf(lost), scalesApart(report));
}

/// From charts to texture coordinates.
void pack(const Options& options, WholeMap& whole)
{
	Parametrization& map = whole.map;
	advance(kMapped, "Packing the charts");
	const ChartTurns turns = chartTurns(options);
	const bool cutsForTiles = options.tileSide > 0.0 && mayCutCharts(options);
	const bool mayCut =
		cutsForTiles ||
		(options.charts == Charts::CutForPacking && whole.opened.mesh.map.empty() &&
		 whole.opened.seamEdges == 0 && options.target == TargetCurvature::Automatic);
	packCharts(map, options, turns, mayCut);
	advance(kMapped, "Finishing the coordinates");
	if (!isFinished(options))
		return;
	FloatRules rules;
	rules.keepsMesh = options.output == OutputTriangulation::KeepMesh;
	rules.mayCut = mayCutCharts(options);
	if (!rules.mayCut && (isOneChart(options) || !options.freeBoundary))
		rules.boundary = BoundaryRepair::KeptOnCircles;
	bool isChanged = false, isPacked = false;
	for (int packings = 1; !isPacked; ++packings) {
		rules.mayGrow = packings < kMaxPackings;
		const auto [moved, needsPacking] = repairInFloats(rules, map);
		map.report.finishMoved += moved;
		isChanged = isChanged || moved > 0 || needsPacking;
		isPacked = !needsPacking;
		if (needsPacking)
			packCharts(map, options, turns, cutsForTiles);
	}
	if (isChanged)
		measureInPlane(whole);
}

/// Counts what is wrong with the coordinates as they are stored.
void countFaults(Parametrization& map)
{
	map.report.flippedFaces = countFlipped(map.mesh);
	map.report.flippedByRounding = countFlippedByRounding(map.mesh);
	const auto [faces, charts] = overlapsInFloats(map.mesh);
	map.report.overlappingFaces = faces;
	map.report.overlappingCharts = charts;
}

/// Adds the numbers of the whole map, then gives the result the input's indices.
Parametrization complete(const SurfaceMesh& mesh, WholeMap whole)
{
	Parametrization& map = whole.map;
	Report& report = map.report;
	report.charts = static_cast<int>(map.charts.size());
	const SurfaceMesh& opened = whole.opened.mesh;
	const std::vector<double> areas =
		triangleAreas(opened.positions, opened.triangles, opened.lengths);
	report.seamLengthRelative =
		report.seamLength / std::sqrt(std::accumulate(areas.begin(), areas.end(), 0.0));
	const std::size_t unseen = unseenTriangles(map.mesh).size();
	if (report.stretch && unseen > 0)
		note(
			counted(unseen, "face is", "faces are") +
				" lower than a texel of the largest texture and excluded from the objective.",
			map);
	if (report.stretch)
		report.objective = costOf(map.mesh, report.seamLength + report.chosenSeamLength).total();
	toInputIndices(mesh, whole.opened, map);
	advance(1.0, "Done");
	return std::move(map);
}

} // namespace

void checkOptions(const Options& options)
{
	checkFlowOptions(options);
	requireChoice("target", options.target, TargetCurvature::PlacedCones);
	requireChoice("rounding", options.cones.rounding, ConeRounding::QuarterTurns);
	requireChoice("holes", options.holes, Holes::ShortCapped);
	requireChoice("charts", options.charts, Charts::AsGiven);
	requireChoice("turns", options.turns, ChartTurns::Free);
	if (options.holes == Holes::Capped && options.method != Method::IntrinsicFlips)
		throw InvalidOption(InvalidOption::WithoutFlips);
	if (options.cones.count < 0)
		throw InvalidOption(InvalidOption::ConeCount, options.cones.count);
	if (!(options.cones.distortion >= 0.0 && std::isfinite(options.cones.distortion)))
		throw InvalidOption(InvalidOption::ConeDistortion, options.cones.distortion);
	if (!(options.chartMargin >= 0.0 && options.chartMargin <= kMaxChartMargin))
		throw InvalidOption(InvalidOption::ChartMargin, options.chartMargin, kMaxChartMargin);
	if (!(options.tileSide >= 0.0 && std::isfinite(options.tileSide)))
		throw InvalidOption(InvalidOption::TileSide, options.tileSide);
	if (options.tileSide > 0.0 && !options.normalizeUV)
		throw InvalidOption(InvalidOption::TilesInOwnScale);
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

WholeMap chartsInPlane(const SurfaceMesh& mesh, const VertexInput& input, const Options& options)
{
	requirePositions(mesh, input, options);
	const Task part(0.0, kMapped);
	WholeMap whole = open(mesh, input, options, OneSidedCut::Shortest);
	const auto flatten = [&](const Component& component) {
		return mapToPlane(component, whole.values, options);
	};
	mapComponents(flatten, true, whole);
	measureInPlane(whole);
	advance(1.0, "Layout done");
	return whole;
}

namespace {

/// What the map that a mesh has is kept with.
/// \throw InvalidOption NoMap, MapWithoutArea
Options optionsToKeep(const SurfaceMesh& mesh, const Options& asked)
{
	const auto isMissing = [](const MappedFace& face) {
		return !std::isfinite(doubledArea(face.uv));
	};
	const auto missing = std::count_if(mesh.map.begin(), mesh.map.end(), isMissing);
	if (missing > 0 || mesh.map.empty())
		throw InvalidOption(
			InvalidOption::NoMap,
			0.0,
			0.0,
			mesh.map.empty() ? mesh.triangles.size() : static_cast<std::size_t>(missing));
	if (std::all_of(mesh.map.begin(), mesh.map.end(), [](const MappedFace& face) {
			return doubledArea(face.uv) == 0.0;
		}))
		throw InvalidOption(InvalidOption::MapWithoutArea);
	Options options;
	static_cast<PackOptions&>(options) = asked;
	options.charts = Charts::AsGiven;
	options.finish = Finish::None;
	options.join = JoinSplitVertices::Always; // a chart goes on where the map does not jump
	return options;
}

} // namespace

Parametrization
parametrizeEuclidean(const SurfaceMesh& mesh, const VertexInput& input, const Options& asked)
{
	const Crew crew;
	checkOptions(asked);
	const bool keepsMap = asked.charts == Charts::AsGiven;
	const Options options = keepsMap ? optionsToKeep(mesh, asked) : asked;
	WholeMap whole = chartsInPlane(mesh, input, options);
	Parametrization& map = whole.map;
	if (keepsMap)
		scaleToSurface(map.mesh);
	pack(options, whole);
	countFaults(map);
	map.report.unequalSeams = unequalSeams(map.mesh);
	requirePicture(options, map.report, map.mesh.size());
	if (map.report.unequalSeams > 0 && options.finish != Finish::LeastStretch && mesh.map.empty())
		note(
			std::to_string(map.report.unequalSeams) +
				" seam edges are longer on one side than on the other: flipped faces next to them "
				"were repaired.",
			map);
	if (isFinished(options))
		noteFlipped(options.output, map);
	return complete(mesh, std::move(whole));
}

Parametrization parametrizeHyperbolic(
	const SurfaceMesh& mesh, const VertexInput& input, const HyperbolicOptions& options)
{
	const Crew crew;
	checkOptions(options);
	if (!mesh.lengths.empty() &&
		(options.output == OutputTriangulation::CommonRefinement || options.sharpAngle < kPi))
		throw InvalidOption(InvalidOption::WithoutPositions);
	Parametrization leftOut;
	WholeMap whole = chartsInDisk(mesh, input, options, leftOut);
	Parametrization& map = whole.map;
	advance(kMapped, "Finishing the coordinates");
	const RestShapes shapes = options.output == OutputTriangulation::CommonRefinement
								  ? RestShapes::OfDrawing
								  : RestShapes::OfSurface;
	if (isFinished(options) && finishDisks(shapes, options.freeBoundary, map))
		measureInDisk(whole);
	map.report.relationError =
		std::max(*map.report.relationError, closingError(map.mesh, map.targetCurvature));
	// Straight triangles of a disk may be flipped where geodesic ones are not.
	const int flipped =
		isFinished(options) ? 0 : flippedInDisk(map.mesh) + countFlipped(leftOut.mesh);
	if (!leftOut.charts.empty())
		addBeside(std::move(leftOut), map);
	placeDisks(map);
	countFaults(map);
	map.report.unequalSeams = unequalSeamsInDisk(map);
	if (isFinished(options))
		noteFlipped(options.output, map);
	else
		map.report.flippedFaces = flipped;
	return complete(mesh, std::move(whole));
}

} // namespace ricci
