// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish_disks.h"

#include "../base/graphs.h"
#include "../base/numbers.h"
#include "../base/task.h"
#include "../base/tolerances.h"
#include "../charts/chart_overlap.h"
#include "../charts/separate_charts.h"
#include "../layout/hyperbolic_layout.h"
#include "../optimize/repair.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <utility>

namespace ricci {

namespace {

/// A part of a disk that is moved to the middle of its own may still overlap itself there, which is rare.
constexpr int kMaxSeparations = 3;

/// Some triangles of a chart, and their Voronoi cells.
struct Cells
{
	std::vector<int> centre;
	std::vector<ExtendedIsometry> place; ///< [cell] moves its middle to 0, but that of the first
	Array<int> of;                       ///< [triangle] number
	Array<double> distance; ///< [triangle] from the centre, on the way through the chart
};

Cells cellsOf(const FlatMesh& chart, std::vector<int> centre)
{
	Array<std::complex<double>> middle; // [triangle]
	for (const int f : chart.points.indices()) {
		checkpointNowAndThen(positionOf(f));
		middle.push_back(
			static_cast<std::complex<double>>(toMiddle(chart, {f}).inverse().origin()));
	}
	if (centre.empty()) {
		centre.push_back(0);
		for (const int f : chart.points.indices())
			if (std::abs(middle[f]) < std::abs(middle[centre[0]]))
				centre[0] = f;
	}
	Cells cells{
		std::move(centre), {{}}, Array<int>(chart.size(), 0), Array<double>(chart.size(), 0.0)};
	SearchFront<int, int> front(chart.size());
	for (std::size_t i = 0; i < cells.centre.size(); ++i) {
		cells.of[cells.centre[i]] = static_cast<int>(i);
		front.offer(cells.centre[i], 0.0);
	}
	std::vector<std::vector<int>> triangles(cells.centre.size());
	for (int f = front.next(); f >= 0; f = front.next()) {
		if (const int from = front.parent(f); from >= 0)
			cells.of[f] = cells.of[from];
		cells.distance[f] = front[f];
		triangles[positionOf(cells.of[f])].push_back(f);
		for (const Corner side : cornersOf(f))
			if (const Corner other = chart.joined(side); other.isValid()) {
				const double way = distanceInDisk(middle[f], middle[other.face()]);
				front.offer(other.face(), front[f] + way, f);
			}
	}
	for (std::size_t i = 1; i < triangles.size(); ++i)
		cells.place.push_back(toMiddle(chart, triangles[i]));
	return cells;
}

/// Of each cell the triangle farthest from its centre of those that floats cannot hold, but could near 0.
std::vector<int>
farthestInvalid(const FlatMesh& chart, const Cells& cells, const Validity& validity)
{
	const auto isValid = [&](int f, const ExtendedIsometry& place) {
		Triangle2 p = chart.at(f);
		for (Point2& corner : p)
			corner = moved(place, corner);
		return validity.isValid(p);
	};
	std::vector<int> farthest(cells.centre.size(), -1);
	for (const int f : chart.points.indices()) {
		checkpointNowAndThen(positionOf(f));
		const std::size_t cell = positionOf(cells.of[f]);
		int& far = farthest[cell];
		if ((far < 0 || cells.distance[f] > cells.distance[far]) && f != cells.centre[cell] &&
			!isValid(f, cells.place[cell]) && isValid(f, toMiddle(chart, {f})))
			far = f;
	}
	farthest.erase(std::remove(farthest.begin(), farthest.end(), -1), farthest.end());
	return farthest;
}

/// What a triangle must be in the unit disk, so that floats hold it where so many disks are placed in the square.
Validity diskValidity(std::size_t disks)
{
	const double perRow = std::ceil(std::sqrt(static_cast<double>(disks)));
	const double height = kMinFloatSteps * (2.0 * perRow * floatStep(1.0));
	return {height, kWantedHeights * height};
}

} // namespace

bool divideDisks(Parametrization& map)
{
	FlatMesh& mesh = map.mesh;
	std::size_t disks = map.charts.size();
	const std::vector<std::vector<int>> triangles = mesh.trianglesByChart(disks);
	std::vector<Cells> cells(disks); // [chart] without centres where it is not looked at
	bool endsEarly = false;
	for (bool grows = true; grows && !endsEarly;) {
		grows = false;
		const bool isFull = disks >= kMaxDisks;
		const Validity validity = diskValidity(disks);
		for (std::size_t c = 0; c < triangles.size(); ++c) {
			const bool isValid = std::all_of(triangles[c].begin(), triangles[c].end(), [&](int f) {
				return validity.isValid(mesh.at(f));
			});
			if (isValid)
				continue;
			const FlatMesh chart = mesh.part(triangles[c]);
			if (cells[c].centre.empty())
				cells[c] = cellsOf(chart, {});
			std::vector<int> more = farthestInvalid(chart, cells[c], validity);
			if (more.empty())
				continue;
			if (isFull) {
				endsEarly = true;
				break;
			}
			grows = true;
			disks += more.size();
			more.insert(more.begin(), cells[c].centre.begin(), cells[c].centre.end());
			cells[c] = cellsOf(chart, std::move(more));
		}
	}
	if (endsEarly) {
		++map.report.endedEarly;
		logLine(
			"The division of disks stopped at " + std::to_string(disks) +
			": some triangles are still too small for floats.");
	}
	if (disks == map.charts.size())
		return false;
	const EdgeSet before = seams(mesh);
	for (std::size_t c = 0; c < triangles.size(); ++c) {
		const int more = static_cast<int>(map.charts.size()) - 1;
		for (std::size_t i = 0; i < triangles[c].size() && cells[c].centre.size() > 1; ++i)
			if (const int cell = cells[c].of[static_cast<int>(i)]; cell > 0)
				mesh.chart[triangles[c][i]] = more + cell;
		for (std::size_t i = 1; i < cells[c].centre.size(); ++i)
			map.charts.push_back({{}, {}, static_cast<int>(c), cells[c].place[i]});
	}
	splitPoints(mesh);
	const Array<int> chart = mesh.chartOfPoints();
	for (const int p : chart.indices())
		mesh.place[p] = moved(map.charts[positionOf(chart[p])].place, mesh.place[p]);
	countCuts(before, map);
	return true;
}

namespace {

/// Divides the charts in the Poincaré disk that overlap themselves as straight triangles, as separateCharts() does
/// in the plane. The largest part keeps its place, each other one has a disk of its own with its middle at 0.
/// \return whether charts were divided
bool separateDisks(Parametrization& map)
{
	FlatMesh& mesh = map.mesh;
	const double touching = diskValidity(map.charts.size()).height / kMinFloatSteps;
	const std::vector<std::vector<int>> triangles = mesh.trianglesByChart(map.charts.size());
	const std::size_t disks = triangles.size();
	std::vector<ExtendedIsometry> places(disks); // [chart] moves the points there
	EdgeSet before;
	for (std::size_t c = 0; c < disks; ++c) {
		checkpoint();
		const FlatMesh chart = mesh.part(triangles[c]);
		const OverlapSearch overlaps(chart, touching);
		if (overlaps.pairs().empty())
			continue;
		if (map.charts.size() == disks)
			before = seams(mesh);
		std::vector<std::vector<int>> parts = divideChart(chart, overlaps);
		std::iter_swap(
			parts.begin(),
			std::max_element(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
				return a.size() < b.size();
			}));
		const int middle = map.charts[c].middle < 0 ? static_cast<int>(c) : map.charts[c].middle;
		for (std::size_t i = 1; i < parts.size() && map.charts.size() < kMaxDisks; ++i) {
			for (const int f : parts[i])
				mesh.chart[triangles[c][positionOf(f)]] = static_cast<int>(map.charts.size());
			places.push_back(toMiddle(chart, parts[i]));
			map.charts.push_back({{}, {}, middle, places.back() * map.charts[c].place});
		}
	}
	if (map.charts.size() == disks)
		return false;
	splitPoints(mesh);
	const Array<int> chart = mesh.chartOfPoints();
	for (const int p : chart.indices())
		if (positionOf(chart[p]) >= disks)
			mesh.place[p] = moved(places[positionOf(chart[p])], mesh.place[p]);
	countCuts(before, map);
	return true;
}

/// Mends triangles of charts in the unit disk, and divides those that overlap then.
/// \return points that were moved
int repairDisks(RestShapes shapes, bool freeBoundary, Parametrization& map)
{
	const Validity validity = diskValidity(map.charts.size());
	Repair result;
	const auto inside = [&](RestShapes rest) {
		WorkLimit limit(map.mesh.size(), WorkLimit::kFew);
		result.add(repair(map.mesh, insidePoints(map.mesh), {rest, validity}, limit));
	};
	const auto inCover = [&](bool boundaryMoves) {
		if (result.left == 0)
			return;
		WorkLimit limit(map.mesh.size(), WorkLimit::kFew);
		result.add(repairInCover(map.mesh, {shapes, validity}, boundaryMoves, limit));
	};
	inside(shapes);
	inCover(freeBoundary);
	inCover(true);
	inside(RestShapes::OfSurfaceEvenly);
	for (int i = 0; i < kMaxSeparations && separateDisks(map); ++i)
		;
	return result.movedCount();
}

/// Triangles of disks that are not valid, and those that overlap.
int countFaults(const Parametrization& map)
{
	const Validity validity = diskValidity(map.charts.size());
	auto count = static_cast<int>(badTriangles(map.mesh, validity).size());
	for (const std::vector<int>& triangles : map.mesh.trianglesByChart(map.charts.size())) {
		const Array<char> overlaps =
			OverlapSearch(map.mesh.part(triangles), validity.height / kMinFloatSteps).overlapping();
		count += static_cast<int>(std::count(overlaps.begin(), overlaps.end(), 1));
	}
	return count;
}

} // namespace

bool finishDisks(RestShapes shapes, bool freeBoundary, Parametrization& map)
{
	int faults = countFaults(map);
	if (faults == 0)
		return false;
	bool isChanged = false;
	const Parametrization asFound = map;
	for (const bool divides : {false, true}) {
		Parametrization next = asFound;
		if (faults == 0 || (divides && !divideDisks(next)))
			break;
		const int moved = repairDisks(shapes, freeBoundary, next);
		const int left = countFaults(next);
		if (left >= faults)
			continue;
		faults = left;
		isChanged = true;
		map = std::move(next);
		map.report.finishMoved += moved;
	}
	if (map.charts.size() > asFound.charts.size())
		logLine(
			"The disks are too wide for floats: they were divided into " +
			std::to_string(map.charts.size()) + ", each with its own centre.");
	return isChanged;
}

} // namespace ricci
