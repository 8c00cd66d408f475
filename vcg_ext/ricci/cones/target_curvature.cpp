// SPDX-License-Identifier: GPL-3.0-or-later
#include "target_curvature.h"

#include "../base/numbers.h"
#include "../base/task.h"
#include "../base/tolerances.h"
#include "../error.h"
#include "../numerics/double_double.h"
#include "area_change.h"
#include "prescribed_target.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace ricci {

namespace {

/// By so much less, energy and price of seams are not worth another flow.
constexpr double kWorthAFlow = 0.03;

/// What any target has to fulfil.
void check(const EmbeddedSurface& surface, const Target& target)
{
	checkVertexBounds(surface.topology, target);
	checkFreeBoundary(surface.topology, target);
}

/// Fixes u on the boundary (paper 5.3).
void freeTheBoundary(const EmbeddedSurface& surface, Target& target)
{
	target.fixed = surface.topology.boundary;
	target.notes.push_back("Free boundary: the flow keeps the boundary's metric.");
}

/// Prescribes the boundary: it takes \p total in proportion to its length.
void prescribeByLength(const EmbeddedSurface& surface, double total, Target& target)
{
	target.curvature += total * boundaryShares(surface);
	target.notes.push_back(
		"The boundary is prescribed: its curvature is proportional to its length.");
}

void requireDisk(const EmbeddedSurface& surface, TargetCurvature mode)
{
	if (!surface.topology.type.isDisk())
		throw InvalidOption(InvalidOption::NotADisk, mode, surface.topology.type);
}

void requireFlat(const EmbeddedSurface& surface)
{
	const SurfaceType& type = surface.topology.type;
	if (type.eulerCharacteristic() != 0)
		throw InadmissibleCurvature(
			InadmissibleCurvature::Flat, 0.0, surface.topology.type.totalCurvature(), 0, type);
}

void setDisk(const EmbeddedSurface& surface, Target& target)
{
	requireDisk(surface, TargetCurvature::Disk);
	target.circular = true;
	target.curvature += 2 * kPi * boundaryShares(surface);
}

/// The four selected vertices in the order of the loop.
std::array<Vertex, 4>
selectedCorners(const std::vector<Vertex>& loop, const std::vector<char>& selected)
{
	const std::size_t count = selectedVertices(selected).size();
	if (count != 4)
		throw InvalidOption(InvalidOption::CornerCount, 0.0, 0.0, count);
	std::array<Vertex, 4> corners;
	std::size_t found = 0;
	for (const Vertex v : loop)
		if (selected[positionOf(v)])
			corners[found++] = v;
	if (found != 4)
		throw InvalidOption(InvalidOption::CornersOffBoundary, 0.0, 0.0, found);
	return corners;
}

void setRectangle(const EmbeddedSurface& surface, const TargetRequest& request, Target& target)
{
	requireDisk(surface, TargetCurvature::Rectangle);
	const std::vector<Vertex>& loop = surface.topology.loops.front();
	if (loop.size() < 4)
		throw InvalidOption(InvalidOption::TooFewBoundaryVertices, 0.0, 0.0, loop.size());
	if (selectedVertices(request.selected).empty()) {
		target.corners = rectangleCorners(loop, surface.positions);
		target.notes.push_back(
			"No vertices are selected: the corners are the boundary vertices nearest to the "
			"corners of the smallest rectangle around the boundary.");
	}
	else
		target.corners = selectedCorners(loop, request.selected);
	for (const Vertex v : *target.corners)
		target.curvature[v] = 0.5 * kPi;
}

/// Equal shares of the total curvature at the selected vertices. The boundary is free only if no
/// cone lies on it.
void setCones(const EmbeddedSurface& surface, const TargetRequest& request, Target& target)
{
	const Topology& topology = surface.topology;
	const std::vector<Vertex> cones = selectedCones(request.selected);
	const double share = surface.topology.type.totalCurvature() / static_cast<double>(cones.size());
	bool onBoundary = false;
	for (const Vertex v : cones) {
		target.curvature[v] = share;
		onBoundary |= topology.boundary[v] != 0;
	}
	target.notes.push_back(
		std::to_string(cones.size()) + " cones of curvature " + numberText(share, 9) + " each.");
	if (topology.type.isClosed() || !request.freeBoundary)
		return;
	if (!onBoundary)
		freeTheBoundary(surface, target);
	else
		target.notes.push_back("Cones lie on the boundary, which is therefore prescribed: the "
							   "option of a free boundary has no effect.");
}

/// A free boundary takes whatever the curvature inside leaves of 2 pi chi: what it cannot take shows in the
/// scale factors of the linear flow.
void checkScales(const EmbeddedSurface& surface, InitialPacking& start, const Target& target)
{
	LinearFlow flow(surface, start, ConeBoundary::Fixed);
	const VertexVector u = flow.solve(target.curvature - flow.curvature());
	const double scales = (u.maxCoeff() - u.minCoeff()) / std::log(10.0);
	if (!(scales <= 2.0 * kMaxScales))
		throw InadmissibleCurvature(
			InadmissibleCurvature::ScalesApart, std::round(scales), 2.0 * kMaxScales);
}

/// Copies the prescribed values; a defect of rounding size is spread in proportion to |K|.
void setPrescribedValues(
	const EmbeddedSurface& surface,
	InitialPacking& start,
	const TargetRequest& request,
	Target& target)
{
	setPrescribed(request, target);
	if (!surface.topology.type.isClosed() && request.freeBoundary) {
		freeTheBoundary(surface, target);
		check(surface, target);
		checkScales(surface, start, target);
		return;
	}
	// A sum of many equal values in double drifts by more than their own rounding.
	DoubleDouble exactSum;
	double magnitude = 0.0;
	for (const Vertex v : target.curvature.indices()) {
		exactSum += target.curvature[v];
		magnitude += std::abs(target.curvature[v]);
	}
	const auto sum = static_cast<double>(exactSum);
	const double wanted = surface.topology.type.totalCurvature();
	const double defect = wanted - sum;
	// Each value is at best a full angle less angles, all in double.
	const double angles = 2 * kPi * static_cast<double>(target.curvature.size());
	if (std::abs(defect) > kPrescribedRounding * (request.precision * (magnitude + 2 * kPi) +
												  std::numeric_limits<double>::epsilon() * angles))
		throw InadmissibleCurvature(InadmissibleCurvature::GaussBonnet, sum, wanted);
	if (magnitude > 0.0)
		target.curvature += (defect / magnitude) * target.curvature.cwiseAbs();
}

/// "expected energy 4.09, seams 3.31 (in units of the square root of the area)"
std::string describe(const MapCost& map)
{
	return "expected energy " + numberText(map.energy, 3) + ", seams " + numberText(map.seams, 3) +
		   " (in units of the square root of the area)";
}

/// "12 cones placed: ...", with the vertices and their curvatures.
std::string describe(const PlacedCones& cones, const VertexArray<int>& vertexNumbers)
{
	std::vector<std::pair<int, double>> named;
	for (std::size_t i = 0; i < cones.vertices.size(); ++i) {
		const Vertex v = cones.vertices[i];
		const bool hasNumber = v.number() < vertexNumbers.size();
		named.emplace_back(hasNumber ? vertexNumbers[v] : v.number(), cones.curvatures[i]);
	}
	std::sort(named.begin(), named.end());
	std::string list;
	for (const auto& [vertex, curvature] : named)
		list += (list.empty() ? " " : ", ") + std::to_string(vertex) + " (" +
				numberText(curvature / kPi, 9) + ")";
	return std::to_string(cones.vertices.size()) +
		   " cones placed: " + describe(cones.expectation()) + ", area distortion " +
		   numberText(cones.distortion, 3) + " (spread); vertex (curvature / pi):" + list + ".";
}

/// The target with these cones. A boundary is free or, if it is not to be, takes the rest of the
/// curvature in proportion to its length.
void setPlacedCones(
	const EmbeddedSurface& surface,
	const PlacedCones& cones,
	const TargetRequest& request,
	Target& target)
{
	double total = 0.0;
	for (std::size_t i = 0; i < cones.vertices.size(); ++i) {
		target.curvature[cones.vertices[i]] = cones.curvatures[i];
		total += cones.curvatures[i];
	}
	target.used = TargetUsed::PlacedCones;
	target.expectedSpread = cones.distortion;
	target.isSeamless = request.rounding == ConeRounding::QuarterTurns;
	target.conesAtLimit = cones.atLimit;
	target.notes.push_back(describe(cones, request.vertexNumbers));
	if (request.measuresAreas && request.goal.kind != ConeGoal::Count)
		target.expected = cones.expectation();
	if (surface.topology.type.isClosed())
		return;
	if (request.freeBoundary)
		freeTheBoundary(surface, target);
	else
		prescribeByLength(surface, surface.topology.type.totalCurvature() - total, target);
}

/// Whether Automatic makes it flat, boundary included. A boundary at seams that were chosen is none of the
/// shape's own: where the rest of a disk that a piece is cut out of keeps its metric, it keeps its areas.
bool isFlatAnnulus(const EmbeddedSurface& surface, const TargetRequest& request)
{
	return surface.topology.type.isAnnulus() && !request.hasSeam;
}

/// The target without cones that a surface has by its topology: flat, or a boundary that is free or
/// takes all curvature.
/// \pre not closed, or a torus
void setPlain(const EmbeddedSurface& surface, const TargetRequest& request, Target& target)
{
	const SurfaceType& type = surface.topology.type;
	if (type.isTorus() || isFlatAnnulus(surface, request))
		target.used = TargetUsed::Flat;
	else if (request.freeBoundary) {
		target.used = TargetUsed::FreeBoundary;
		freeTheBoundary(surface, target);
	}
	else if (type.isDisk()) {
		target.used = TargetUsed::Disk;
		setDisk(surface, target);
	}
	else {
		target.used = TargetUsed::PrescribedBoundary;
		prescribeByLength(surface, surface.topology.type.totalCurvature(), target);
	}
}

/// The plain target or cones: what is expected to cost less, or cones where the spread of areas would be
/// larger without them than is asked for.
void choosePlainOrCones(
	const EmbeddedSurface& surface,
	InitialPacking& start,
	const TargetRequest& request,
	Target& target)
{
	// In an annulus, cones come with a free boundary.
	const bool isFlat = isFlatAnnulus(surface, request);
	LinearFlow flow(surface, start, isFlat ? ConeBoundary::Prescribed : ConeBoundary::Fixed);
	// The search first: flow is factorised meanwhile.
	std::optional<PlacedCones> cones =
		isFlat ? placeCones(surface, start, request) : placeCones(surface, flow, request);
	const double spread = 2.0 * std::sqrt(flow.meanSquare(flow.solve(-flow.curvature())));
	const bool goesBySpread = request.goal.kind == ConeGoal::Spread;
	target.seamsWithout = cones->seamsWithout;
	MapCost plain{expectedEnergy(spread), target.seamsWithout};
	const bool isKept = goesBySpread ? spread <= request.goal.spread
									 : plain.energy - expectedEnergy(0.0) < kConePrice;
	if (isKept)
		cones.reset();
	const std::string without =
		describe(plain) + ", area distortion " + numberText(spread, 3) + " (spread)";
	const double costWithout = plain.total(request.energyFactor);
	const double cost = cones ? cones->expectation().total(request.energyFactor) : 0.0;
	if (cones && (goesBySpread || cost < costWithout)) {
		// They may leave more to a short boundary than it can take.
		std::optional<Target> admissible = attempt("no cones are placed", [&] {
			Target withCones = target;
			withCones.choice = goesBySpread
								   ? "cones, because without them areas would spread by " +
										 numberText(spread, 3) + ", more than allowed"
								   : "cones, which are expected to lower the objective from " +
										 numberText(costWithout, 3) + " to " + numberText(cost, 3);
			withCones.notes.push_back("Cones: without them " + without + ".");
			setPlacedCones(surface, *cones, request, withCones);
			check(surface, withCones);
			return withCones;
		});
		if (admissible) {
			target = *std::move(admissible);
			return;
		}
	}
	target.choice = "no cones, because " +
					(!isKept && (goesBySpread || cost < costWithout)
						 ? "they leave more curvature to the boundary than its vertices can take"
					 : cones ? "they are expected to raise the objective from " +
								   numberText(costWithout, 3) + " to " + numberText(cost, 3)
							 : "without them areas are expected to spread by " +
								   numberText(spread, 3) + " alone");
	setPlain(surface, request, target);
	target.expectedSpread = spread;
	target.notes.push_back(
		"No cones: " + without +
		(cones ? "; with " + std::to_string(cones->vertices.size()) + " cones " +
					 describe(cones->expectation())
			   : "") +
		".");
	if (request.goal.kind != ConeGoal::Count)
		target.expected = plain;
}

void setAutomatic(
	const EmbeddedSurface& surface,
	InitialPacking& start,
	const TargetRequest& request,
	Target& target)
{
	const SurfaceType& type = surface.topology.type;
	if (type.isClosed() && !type.isTorus()) {
		target.choice = "cones, because " + type.name() + " has no flat metric without them";
		target.notes.push_back("Cones: " + type.name() + " has no flat metric without them.");
		setPlacedCones(surface, placeCones(surface, start, request), request, target);
	}
	else if (request.measuresAreas && (type.isClosed() || request.freeBoundary))
		choosePlainOrCones(surface, start, request, target);
	else {
		target.choice =
			request.onlyWhereNeeded ? "no cones, because the surface needs none"
			: request.measuresAreas
				? "no cones, because of the topology and the requested boundary"
				: "no cones, because only the method 'Intrinsic flips' places them to keep areas";
		setPlain(surface, request, target);
	}
}

} // namespace

Target
chooseTarget(const EmbeddedSurface& surface, InitialPacking& start, const TargetRequest& request)
{
	Target target = zeroTarget(surface.topology);
	target.used = static_cast<TargetUsed>(request.target); // Automatic ends with another one
	switch (request.target) {
	case TargetCurvature::Automatic:
		setAutomatic(surface, start, request, target);
		break;
	case TargetCurvature::Flat:
		requireFlat(surface);
		break;
	case TargetCurvature::Disk:
		setDisk(surface, target);
		break;
	case TargetCurvature::Rectangle:
		setRectangle(surface, request, target);
		break;
	case TargetCurvature::SelectedCones:
		setCones(surface, request, target);
		break;
	case TargetCurvature::Prescribed:
		setPrescribedValues(surface, start, request, target);
		break;
	case TargetCurvature::PlacedCones:
		setPlacedCones(surface, placeCones(surface, start, request), request, target);
		break;
	}
	const bool isImplied = target.used == TargetUsed::Flat || target.used == TargetUsed::Disk ||
						   target.used == TargetUsed::Rectangle;
	if (isImplied && request.freeBoundary && !surface.topology.type.isClosed())
		target.notes.push_back(
			"The target prescribes the boundary: the option of a free boundary has no effect.");
	check(surface, target);
	return target;
}

bool keepsAreas(
	const EmbeddedSurface& surface, const FlowResult& flow, const TargetRequest& request)
{
	const std::optional<MapCost>& expected = flow.target.expected;
	const bool goesBySpread = request.goal.kind == ConeGoal::Spread;
	return !expected || areaCost(surface, flow, request) <=
							(goesBySpread ? 1.0 : expected->total() + kWorthAFlow);
}

double
areaCost(const EmbeddedSurface& surface, const FlowResult& flow, const TargetRequest& request)
{
	const AreaChange change = areaChange(surface, flowFactor(flow));
	return request.goal.kind == ConeGoal::Spread
			   ? areaExcess(change, request.goal.spread, kSpreadSlack)
			   : MapCost{change.energy, flow.target.expected->seams}.total();
}

std::optional<Target> targetToKeepAreas(
	const EmbeddedSurface& surface,
	InitialPacking& start,
	const FlowResult& flow,
	const TargetRequest& request)
{
	const bool wasFlat = isFlatAnnulus(surface, request) && !flow.target.hasFixed();
	const PlacedCones cones = wasFlat && request.freeBoundary ? placeCones(surface, start, request)
															  : moreCones(surface, flow, request);
	if (request.goal.kind == ConeGoal::LeastCost &&
		cones.expectation().total() > areaCost(surface, flow, request) - kWorthAFlow)
		return std::nullopt;
	const AreaChange change = areaChange(surface, flowFactor(flow));
	Target target = targetWithCones(surface, cones, request);
	target.choice = flow.target.choice;
	target.notes.insert(
		target.notes.begin(),
		"The spread of the logarithm of the area factor comes out as " +
			numberText(change.spread, 3) + ", the mean of the factor or its inverse as " +
			numberText(change.mean, 3) + ", the energy as " + numberText(change.energy, 3) +
			": more or other cones are needed.");
	return target;
}

Target targetWithCones(
	const EmbeddedSurface& surface, const PlacedCones& cones, const TargetRequest& request)
{
	Target target = zeroTarget(surface.topology);
	setPlacedCones(surface, cones, request, target);
	check(surface, target);
	return target;
}

} // namespace ricci
