// SPDX-License-Identifier: GPL-3.0-or-later
#include "flatten.h"

#include "flatten_steps.h"
#include "measure/distortion.h"
#include "measure/map_check.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ricci {

namespace {

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

} // namespace

void scaleForLeastEnergy(FlatMesh& mesh)
{
	const auto [forth, back, area] = stretchIntegrals(mesh);
	if (forth > 0.0 && back < kInfinity)
		for (Point2& p : mesh.place)
			p *= std::pow(back / forth, 0.25);
}

Parametrization givenMap(const Component& component, bool turns)
{
	return chartOf(component, turns, meshOf(component));
}

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

} // namespace ricci
