// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.h"

#include <algorithm>

namespace ricci {

Report& Report::operator+=(const Report& next)
{
	for (FlowState state : next.flowStates) {
		state.component += components;
		flowStates.push_back(state);
	}
	for (int Report::*count : std::initializer_list<int Report::*>{
			 &Report::components,
			 &Report::iterations,
			 &Report::brokenTriangles,
			 &Report::flips,
			 &Report::finishMoved,
			 &Report::endedEarly,
			 &Report::edgeSwaps,
			 &Report::boundarySplits,
			 &Report::refinementPoints,
			 &Report::eulerCharacteristic,
			 &Report::genus,
			 &Report::boundaryLoops,
			 &Report::cappedHoles,
			 &Report::cones,
			 &Report::seamEdges,
			 &Report::overlappingCharts,
			 &Report::overlappingFaces,
			 &Report::overlapCuts})
		this->*count += next.*count;
	seamLength += next.seamLength;
	for (double Report::*error : std::initializer_list<double Report::*>{
			 &Report::maxCurvatureError, &Report::residualFloor, &Report::lengthened})
		this->*error = std::max(this->*error, next.*error);
	if (next.hyperbolicArea)
		hyperbolicArea = hyperbolicArea.value_or(0.0) + *next.hyperbolicArea;
	const bool isOnly = components == next.components;
	if (isOnly || targetUsed == next.targetUsed)
		targetUsed = next.targetUsed;
	else
		targetUsed = TargetUsed::Several;
	choice = isOnly || choice == next.choice ? next.choice : "";
	for (std::optional<double> Report::*largest :
		 std::initializer_list<std::optional<double> Report::*>{
			 &Report::holonomyError,
			 &Report::relationError,
			 &Report::expectedSpread,
			 &Report::boundaryRatioMax})
		if (next.*largest)
			this->*largest = std::max((this->*largest).value_or(0.0), *(next.*largest));
	if (next.boundaryRatioMin)
		boundaryRatioMin =
			std::min(boundaryRatioMin.value_or(*next.boundaryRatioMin), *next.boundaryRatioMin);
	for (std::optional<double> Report::*invariant :
		 std::initializer_list<std::optional<double> Report::*>{
			 &Report::torusTauRe,
			 &Report::torusTauIm,
			 &Report::annulusModulus,
			 &Report::rectangleAspect,
			 &Report::periodError})
		this->*invariant = isOnly ? next.*invariant : std::nullopt;
	periodMatrix = isOnly ? next.periodMatrix : std::vector<std::complex<double>>();
	return *this;
}

} // namespace ricci
