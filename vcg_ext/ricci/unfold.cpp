// SPDX-License-Identifier: GPL-3.0-or-later
#include "flatten.h"

#include "base/numbers.h"
#include "base/parallel.h"
#include "base/task.h"
#include "charts/separate_charts.h"
#include "flatten_steps.h"
#include "mesh/opened_mesh.h"
#include "mesh/sides.h"
#include "whole_map.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ricci {

namespace {

/// Angles above which an edge is a crease: less sharp ones are those of coarse round parts, whose pieces are
/// flat enough, and at sharper ones fillets of few triangles are left in one piece with what they round. The
/// least sharp ones, which rough surfaces have everywhere, are those of parts that unfold at others.
constexpr double kCreaseAngles[] = {40.0 * kPi / 180.0, 60.0 * kPi / 180.0, 25.0 * kPi / 180.0};

/// The least sharp ones are those of a rough surface, and its map would cost more, where they make more than so
/// many pieces, and by this factor more than the first ones.
constexpr double kManyPieces = 200.0, kRough = 1.5;

/// Memory that maps of a component take while its flow waits, in units of what the flow alone needs: in all, and
/// for each at work. Fitted from above to measured peaks of 2e5 and 3e5 faces (1.6 for one, 2.6 for two).
constexpr double kBesideMaps = 0.5, kOneMap = 1.1;

/// How many of \p count maps there are threads and memory for at the same time.
int mapsAtOnce(int count, std::size_t faces)
{
	const double flow = estimatedMemory(faces, faces, false);
	int most = std::min(count, threadsFor(static_cast<std::int64_t>(faces)));
	while (most > 0 && !hasRoomFor((kBesideMaps + kOneMap * most) * flow))
		--most;
	return most;
}

/// The pieces of a component between creases, as components of it; none if pieces have no area.
std::vector<Component> pieces(const Component& component, const Creases& creases)
{
	SurfaceMesh surface{component.positions.values(), component.triangles, component.diagonal};
	surface.seam = creases.sides;
	const OpenedMesh opened = openMesh(surface);
	if (!opened.degenerate.empty())
		return {};
	std::vector<Component> pieces = splitIntoComponents(opened);
	for (Component& piece : pieces)
		for (int& v : piece.vertex.values())
			v = opened.vertex[positionOf(v)];
	return pieces;
}

/// The pieces mapped by themselves, in the component's numbers.
Parametrization
mapsOf(const std::vector<Component>& pieces, const Component& component, const Options& options)
{
	const auto vertexCount = component.positions.values().size();
	Parametrization map;
	map.mesh.source = verticesOf(vertexCount);
	map.u.resize(vertexCount, 0.0);
	map.targetCurvature.resize(vertexCount, 0.0);
	std::vector<Parametrization> flat(pieces.size());
	tasksInParallel(
		static_cast<int>(pieces.size()),
		threadsFor(static_cast<std::int64_t>(component.triangles.size())),
		[&](int i) { flat[positionOf(i)] = flattenToPlane(pieces[positionOf(i)], options); });
	for (std::size_t i = 0; i < pieces.size(); ++i)
		append(pieces[i], std::move(flat[i]), map);
	return map;
}

/// The pieces joined to a map of the component. Of their reports that of the flow stays.
Parametrization
joined(const Component& component, const std::vector<Component>& pieces, const Options& options)
{
	Options ofPieces = options;
	ofPieces.finish =
		Finish::Repair; // leaves free boundaries as long as they are, so that they join
	ofPieces.holes = Holes::Boundaries;              // they are pieces elsewhere
	ofPieces.output = OutputTriangulation::KeepMesh; // both sides of a crease have the same points
	Parametrization map = mapsOf(pieces, component, ofPieces);
	connect(map.mesh); // across creases, too
	separateCharts(ofPieces, map);
	joinCharts(map);
	map.notes.clear();
	Report report;
	static_cast<FlowReport&>(report) = std::move(map.report);
	for (FlowState& state : report.flowStates)
		state.component = 0;
	report.targetUsed = TargetUsed::Unfolded;
	report.choice.clear();
	report.expectedSpread.reset();
	report.finishMoved = map.report.finishMoved;
	map.report = std::move(report);
	describeByMap(component, map);
	if (map.report.boundaryLoops == 0) { // the boundaries are the creases' alone
		map.report.boundaryRatioMin.reset();
		map.report.boundaryRatioMax.reset();
	}
	return map;
}

/// What the component is divided into between its creases: the first way, or the others.
std::vector<std::vector<Component>>
divisions(const Component& component, double maxBetween, bool isFirst)
{
	std::vector<std::vector<Component>> ways;
	std::set<int> edges; // numbers of creases
	double first = 0.0;  // pieces
	const Sides sides(component.triangles);
	for (const double angle : kCreaseAngles) {
		const Creases found =
			creases(component.positions.values(), component.triangles, sides, angle);
		const bool isBent = found.edges == 0 || found.curvatureBetween > maxBetween;
		if (first == 0.0 && (isBent || angle < kCreaseAngles[0]))
			break; // as it is between creases that are sharper
		if (isBent || !edges.insert(found.edges).second) // more creases contain fewer
			continue;
		std::vector<Component> all = pieces(component, found);
		const auto count = static_cast<double>(all.size());
		if (all.empty() || (first > 0.0 && count > std::max(kManyPieces, kRough * first)))
			continue;
		if ((first == 0.0) == isFirst)
			ways.push_back(std::move(all));
		if (first == 0.0)
			first = count;
		if (isFirst)
			break;
	}
	return ways;
}

} // namespace

std::optional<Parametrization> unfold(
	const Component& component,
	const Options& options,
	double maxBetween,
	std::optional<Parametrization> first)
{
	const auto ways = divisions(component, maxBetween, !first);
	std::vector<std::optional<Parametrization>> maps(ways.size());
	std::vector<std::vector<std::string>> lines(ways.size()); // of the log
	const auto count = static_cast<int>(ways.size());
	const int atOnce = mapsAtOnce(count, component.triangles.size());
	if (atOnce == 0 && count > 0) {
		logLine("There is not enough memory to also unfold the surface between its creases.");
		return first;
	}
	tasksInParallel(count, atOnce, [&](int i) {
		Task part(double(i) / count, (i + 1.0) / count);
		part.keepLines(lines[positionOf(i)]);
		maps[positionOf(i)] = attempt("it is not unfolded", [&] {
			const Task silent(0.0, 1.0, true);
			return joined(component, ways[positionOf(i)], options);
		});
	});
	for (const std::vector<std::string>& own : lines)
		logLines(own);
	std::optional<Parametrization> best = std::move(first);
	int steps = best ? best->report.iterations : 0; // Newton's
	for (std::optional<Parametrization>& map : maps) {
		steps += map ? map->report.iterations : 0;
		if (map && (!best || costOf(*map).total() < costOf(*best).total()))
			best = std::move(map);
	}
	if (best)
		best->report.iterations = steps;
	return best;
}

} // namespace ricci
