// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/numbers.h"
#include "base/parallel.h"
#include "base/task.h"
#include "base/tolerances.h"
#include "charts/separate_charts.h"
#include "flatten.h"
#include "flatten_steps.h"
#include "measure/distortion.h"
#include "measure/map_check.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace ricci {

namespace {

/// Share of the curvature that may be left between creases where a component is unfolded first.
constexpr double kMaxCurvatureBetween = 0.25;

/// A component whose map as a whole costs more, or is expected to, is unfolded, too, whatever its curvature.
constexpr double kPoorCost = 6.0;

/// The surface is unfolded at all angles where what the first costs above an isometry is at most so many times what
/// another map does. Of 82 components the best angle costs less than the first by 1.6 at most, and by 1.1 mostly.
constexpr double kNear = 1.5;

/// Where a map of cones breaks its promise, others are tried: if that is by its energy, those for what energy has turned
/// out to cost, at most so many times what is expected, else those that bring the expected spread of areas below the first
/// of the spreads. Where the map is poor all the same, all spreads are tried: the linear model promises too much where
/// scales differ much. Of 600 thin bars with quarter turns, three cost up to four times as much with the first spread
/// alone. After cones for the energy a spread gains on one of 17 components.
constexpr double kMaxEnergyFactor = 8.0;
constexpr double kSpreadsInstead[] = {0.25, 0.125, 0.0625, 0.03125};

/// Capped holes are tried where the seams to them make at least this share of what the map is expected to cost above an
/// isometry, or the map is poor. Of 92 components of shared meshes the 15 that gain have 0.37 and more, or are poor;
/// the plan of a second target takes a third of the time of a large mesh.
constexpr double kMinShareOfHoles = 0.25;

/// Whether Automatic may do without a flow of a whole component: nothing but the default has been asked for that it
/// would have to give.
bool needsNoFlow(const Options& options)
{
	return options.target == TargetCurvature::Automatic && options.freeBoundary &&
		   coneGoal(options.cones).kind == ConeGoal::LeastCost &&
		   options.cones.rounding == ConeRounding::Free && isFinished(options) &&
		   options.charts != Charts::OfTheFlow;
}

bool mayUnfold(const Component& component, const Options& options)
{
	return needsNoFlow(options) && !options.cones.onlyWhereNeeded && component.lengths.empty() &&
		   !component.hasSeam;
}

double totalOf(const std::optional<Parametrization>& map)
{
	return map ? costOf(*map).total() : kInfinity;
}

/// "energy 4.01, seams 11.9 (objective 4.6)"
std::string costText(const Parametrization& map)
{
	const MapCost cost = costOf(map);
	return "energy " + numberText(cost.energy, 3) + ", seams " + numberText(cost.seams, 3) +
		   " (objective " + numberText(cost.total(), 3) + ")";
}

std::string unfoldedText(const Parametrization& unfolded)
{
	return "cut along creases and unfolded: " + costText(unfolded);
}

/// The map that Automatic takes, and why.
Parametrization chosen(const std::string& choice, Parametrization map)
{
	map.report.choice = choice;
	map.notes.push_back("Automatic: " + choice + ".");
	logLine(map.notes.back());
	return map;
}

/// The map of a flow with other cones, without overlap.
/// \param ask changes the TargetRequest
/// \param isWorth whether to lay out the Target that was chosen
/// \return none where it is not worth that, or fails, which is told with \p otherwise
template<class Ask>
std::optional<Parametrization> otherMap(
	const Component& component,
	const VertexInput& input,
	const Options& options,
	const std::string& otherwise,
	const Ask& ask,
	const std::function<bool(const Target&)>& isWorth = nullptr)
{
	auto found = attempt(otherwise, [&]() -> std::optional<Parametrization> {
		FlowPlan plan = startOfPlan(component, input, options);
		ask(plan.request);
		completePlan(options, plan);
		if (isWorth && !isWorth(plan.target))
			return std::nullopt;
		Parametrization map = flattenToPlane(component, std::move(plan), options);
		separateCharts(options, map);
		return map;
	});
	return found ? *std::move(found) : std::nullopt;
}

/// Maps with other cones where that of the cheapest ones is poor, or costs more than was expected.
/// \param expected what it was expected to cost
/// \param alternative what another map costs
Parametrization withOtherCones(
	const Component& component,
	const VertexInput& input,
	const Options& options,
	const MapCost& expected,
	double alternative,
	Parametrization map)
{
	const MapCost first = costOf(map);
	double own = first.total();
	const auto cost = [&] { return std::min(own, alternative); };
	const double isometry = expectedEnergy(0.0);
	const double factor = std::clamp(
		(first.energy - isometry) / std::max(kTiny, expected.energy - isometry),
		1.0,
		kMaxEnergyFactor);
	const double mostPromised = expected.total() + kBrokenPromise;
	const bool isBroken = cost() > mostPromised;
	const bool isBrokenByEnergy = isBroken && expected.total(factor) > mostPromised;
	const auto tryOther = [&](const auto& ask, const auto& isWorth) {
		auto next = otherMap(component, input, options, "the map before it stays", ask, isWorth);
		if (!next)
			return;
		const int steps = map.report.iterations + next->report.iterations;
		if (const double ofNext = costOf(*next).total(); ofNext < own) {
			own = ofNext;
			map = *std::move(next);
		}
		map.report.iterations = steps;
	};
	if (isBrokenByEnergy)
		tryOther(
			[&](TargetRequest& request) {
				request.energyFactor = factor;
				request.alternative = cost();
			},
			[&](const Target& target) {
				return target.expected && target.expected->total(factor) < cost();
			});
	VertexVector tried;   // the curvature of the cones
	bool atLimit = false; // then a smaller spread finds the same again
	for (const double spread : kSpreadsInstead)
		if (!atLimit &&
			(cost() > kPoorCost || (isBroken && !isBrokenByEnergy && spread == kSpreadsInstead[0])))
			tryOther(
				[&](TargetRequest& request) {
					request.goal = {ConeGoal::Spread, 0, spread};
				},
				[&](const Target& target) {
					atLimit = target.conesAtLimit;
					const bool isOther =
						tried.size() != target.curvature.size() || tried != target.curvature;
					tried = target.curvature;
					// Cones at the limit may miss the spread by far: they are laid out only if they promise less.
					return isOther &&
						   (!atLimit || (target.expected && target.expected->total() < cost()));
				});
	return map;
}

/// The plan with the holes capped where that is expected to cost less: a loop round which the surface is nearly flat needs
/// no seams to it then.
/// \param plan complete; its holes are those that are capped by their length
FlowPlan withCheaperHoles(
	const Component& component, const VertexInput& input, const Options& options, FlowPlan plan)
{
	const int open = plan.domain.surface.topology.type.boundaryLoops - plan.domain.holes;
	if (!mayUnfold(component, options) || options.holes != Holes::ShortCapped || open < 2 ||
		!plan.target.expected)
		return plan;
	const double cost = plan.target.expected->total();
	const double ofHoles = kSeamPrice * plan.target.seamsWithout;
	if (cost <= kPoorCost && ofHoles < kMinShareOfHoles * (cost - expectedEnergy(0.0)))
		return plan;
	auto capped = attempt("the holes stay boundaries", [&] {
		Options other = options;
		other.holes = Holes::Capped;
		FlowPlan next = startOfPlan(component, input, other);
		next.request.alternative = std::min(cost, plan.request.alternative);
		completePlan(other, next);
		return next;
	});
	return capped && capped->target.expected && capped->target.expected->total() < cost
			   ? *std::move(capped)
			   : std::move(plan);
}

/// The coordinates of the component as a flat mesh. Sides of edges at which they do not jump, which may differ by
/// kSameCoordinate, get the same ends.
FlatMesh meshOf(const Component& component)
{
	const Array<Triangle2> plane(component.map);
	FlatMesh mesh =
		flatMeshOf(Array<Triangle>(component.triangles), plane, component.positions.values());
	for (const Face f : component.face.indices())
		mesh.lengths[f.number()] = component.sides(f);
	mesh.isDiagonal = sidesOf(component.diagonal);
	numberPoints([&](Corner c) { return plane[c]; }, [](Corner, Corner) { return true; }, mesh);
	return mesh;
}

/// The map that a component has, in the \p mesh that meshOf() makes of it, as one chart: no flow, no cones.
/// \param turns whether it is turned, with its smallest bounding rectangle along the axes
/// \pre its coordinates are finite
Parametrization chartOf(const Component& component, bool turns, FlatMesh mesh)
{
	Parametrization map;
	map.mesh = std::move(mesh);
	if (turns)
		moveUpright(minAreaRectangle(map.mesh.place.values()), 1.0, map.mesh.place);
	map.charts.resize(1);
	map.u.assign(component.positions.values().size(), 0.0);
	map.report.targetUsed = TargetUsed::GivenMap;
	describeByMap(component, map);
	return map;
}

/// To the scale of least symmetric Dirichlet energy, if that is finite.
void scaleForLeastEnergy(FlatMesh& mesh)
{
	const auto [forth, back, area] = stretchIntegrals(mesh);
	if (forth > 0.0 && back < kInfinity)
		for (Point2& p : mesh.place)
			p *= std::pow(back / forth, 0.25);
}

/// That map where Automatic may take it: at the scale of least energy, turned over if it is mirrored.
/// \return none if the component has none, or one with flipped or overlapping faces
std::optional<Parametrization> rightGivenMap(const Component& component)
{
	const auto isFinite = [](const Triangle2& t) { return std::isfinite(doubledArea(t)); };
	if (component.map.empty() || !std::all_of(component.map.begin(), component.map.end(), isFinite))
		return std::nullopt;
	FlatMesh mesh = meshOf(component);
	double doubled = 0.0;
	for (const Triangle2& t : mesh.corners())
		doubled += doubledArea(t);
	if (doubled < 0.0)
		for (Point2& p : mesh.place)
			p[0] = -p[0];
	if (countFlipped(mesh) + countFlippedByRounding(mesh) > 0 || overlapsInFloats(mesh)[0] > 0)
		return std::nullopt;
	Parametrization map = chartOf(component, true, std::move(mesh));
	scaleForLeastEnergy(map.mesh);
	return map;
}

/// The map that a component has, or that of the flow if it costs less and needs no seam.
Parametrization givenOrFlow(
	const Component& component,
	const VertexInput& input,
	const Options& options,
	Parametrization given)
{
	Options plain = options;
	plain.cones.onlyWhereNeeded = true;
	auto map =
		otherMap(component, input, plain, "the existing map stays", [](const TargetRequest&) {});
	const std::string own = "the existing map: " + costText(given);
	if (!map)
		return chosen(own, std::move(given));
	given.report.iterations = map->report.iterations;
	const bool hasSeams = map->report.seamLength > 0.0 || map->charts.size() > 1;
	const bool isTaken = !hasSeams && costOf(*map).total() < (1.0 - kTiny) * costOf(given).total();
	const std::string flow = "as a whole: " + costText(*map);
	if (!isTaken)
		return chosen(own + "; " + flow, std::move(given));
	scaleForLeastEnergy(map->mesh); // as other charts that are kept have it
	return chosen(flow + "; " + own, *std::move(map));
}

} // namespace

MapCost costOf(const Parametrization& map)
{
	return costOf(map.mesh, map.report.seamLength);
}

void separateCharts(const Options& options, Parametrization& map)
{
	if (mayCutCharts(options))
		separateCharts(
			options.cones.rounding != ConeRounding::QuarterTurns, isFinished(options), map);
}

Parametrization
mapToPlane(const Component& component, const VertexInput& input, const Options& options)
{
	if (options.charts == Charts::AsGiven)
		return chartOf(component, options.turns == ChartTurns::Free, meshOf(component));
	// A refinement costs less than is expected, which is fitted to straight edges: there the maps decide.
	const bool keepsMesh = options.output == OutputTriangulation::KeepMesh;
	if (needsNoFlow(options) && keepsMesh)
		if (auto given = rightGivenMap(component))
			return givenOrFlow(component, input, options, *std::move(given));
	const bool mayBeUnfolded = mayUnfold(component, options);
	FlowPlan plan;
	std::optional<Parametrization> unfolded;
	std::vector<std::string> lines; // of its log
	besides(
		threadsFor(static_cast<std::int64_t>(component.triangles.size())),
		[&] { plan = startOfPlan(component, input, options); },
		[&] {
			Task still(0.0, 0.0);
			still.keepLines(lines);
			if (mayBeUnfolded)
				unfolded = unfold(component, options, kMaxCurvatureBetween);
		});
	logLines(lines);
	double maxBetween = kMaxCurvatureBetween;
	bool isTried = false; // at all angles
	// As far as that may be worth it beside a map of this cost.
	const auto unfoldBeside = [&](double cost) {
		if (mayBeUnfolded && !unfolded && cost > kPoorCost && maxBetween < 1.0)
			unfolded = unfold(component, options, maxBetween = 1.0);
		const double isometry = expectedEnergy(0.0);
		if (unfolded && totalOf(unfolded) - isometry < kNear * (cost - isometry) &&
			!std::exchange(isTried, true))
			unfolded = unfold(component, options, maxBetween, std::move(unfolded));
	};

	if (keepsMesh)
		plan.request.alternative = totalOf(unfolded);
	completePlan(options, plan);
	plan = withCheaperHoles(component, input, options, std::move(plan));
	if (plan.target.expected && keepsMesh) {
		const Task inPlaceOfFlow(kBeforeFlow, 1.0 - kAfterFlow);
		const double cost = plan.target.expected->total();
		unfoldBeside(cost);
		if (cost > totalOf(unfolded)) {
			const std::string choice =
				unfoldedText(*unfolded) + "; cones are expected to cost more";
			return chosen(choice, *std::move(unfolded));
		}
	}
	const std::optional<MapCost> expected = plan.target.expected;
	const bool isForCost = plan.request.goal.kind == ConeGoal::LeastCost;
	Parametrization map = flattenToPlane(component, std::move(plan), options);
	advance(1.0, "Looking for overlaps");
	separateCharts(options, map);
	unfoldBeside(costOf(map).total());
	if (expected && isForCost && map.report.targetUsed == TargetUsed::PlacedCones)
		map =
			withOtherCones(component, input, options, *expected, totalOf(unfolded), std::move(map));
	if (!unfolded)
		return map;
	const std::string whole = "as a whole: " + costText(map);
	const int steps = unfolded->report.iterations + map.report.iterations;
	const bool isUnfolded = totalOf(unfolded) < costOf(map).total();
	const std::string choice =
		isUnfolded ? unfoldedText(*unfolded) + "; " + whole
				   : map.report.choice + "; " + whole + "; " + unfoldedText(*unfolded);
	map = chosen(choice, isUnfolded ? *std::move(unfolded) : std::move(map));
	map.report.iterations = steps;
	return map;
}

} // namespace ricci
