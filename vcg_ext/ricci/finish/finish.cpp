// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish.h"

#include "../base/task.h"
#include "../base/tolerances.h"
#include "least_distortion.h"
#include "repair.h"

#include <cmath>
#include <utility>

namespace ricci {

namespace {

/// Extent of the disk.
constexpr double kDiskExtent = 2.0;

/// The triangles of a layout.
FlatMesh flatMeshOf(const EmbeddedSurface& surface, const PlanarLayout& layout)
{
	const Triangulation& t = surface.triangulation;
	FlatMesh flat;
	flat.place = layout.points;
	for (const Face f : t.faces()) {
		Triangle vertices{}, corners{};
		std::array<double, 3> sides{};
		const auto h = t.halfedges(f);
		for (std::size_t k = 0; k < 3; ++k) {
			vertices[k] = t.origin(h[k]).number();
			corners[k] = layout.wedges.of[h[k]];
			sides[k] = surface.lengths[h[k].edge()];
		}
		flat.vertices.push_back(vertices);
		flat.points.push_back(corners);
		flat.lengths.push_back(sides);
	}
	return flat;
}

/// Whether the triangles of a layout are sound, without a drawing of them.
bool isSound(const Triangulation& t, const PlanarLayout& layout, const Soundness& soundness)
{
	for (const Face f : t.faces()) {
		const auto h = t.halfedges(f);
		if (!soundness.isSound({layout[h[0]], layout[h[1]], layout[h[2]]}))
			return false;
	}
	return true;
}

/// Whether the boundary may move at a vertex without a prescribed curvature being lost.
std::function<bool(int)> freeVertices(const FlowDomain& domain, bool freeBoundary)
{
	return [&domain, freeBoundary](int v) {
		return freeBoundary || (!domain.onHole.empty() && domain.onHole[Vertex(v)]);
	};
}

bool isInDisk(const FlatMesh& flat, const Patch& patch)
{
	for (const int p : patch.points)
		if (!(std::norm(asComplex(flat.place[p])) < 1.0))
			return false;
	return true;
}

BorderMoves movesInDisk(const FlowDomain& domain, bool freeBoundary)
{
	return {SeamGeometry::Disk, freeVertices(domain, freeBoundary), isInDisk};
}

FinishCounts countsOf(const Repair& repair)
{
	return {repair.movedCount(), repair.left};
}

FinishCounts repairLayout(
	const EmbeddedSurface& surface,
	const BorderMoves& moves,
	double extent,
	PlanarLayout& layout)
{
	const Soundness soundness{kMinHeight * extent, kWantedHeights * kMinHeight * extent, false};
	if (isSound(surface.triangulation, layout, soundness))
		return {};
	FlatMesh flat = flatMeshOf(surface, layout);
	WorkLimit limit(flat.points.size());
	const Repair repair =
		repairInStages(flat, moves, RestShapes::OfSurface, soundness, limit);
	layout.points = std::move(flat.place);
	return countsOf(repair);
}

} // namespace

FinishCounts finishMap(
	const FlowDomain& domain,
	const EdgeArray<char>& isCut,
	const VertexArray<char>& cones,
	bool freeBoundary,
	Finish finish,
	PlanarLayout& layout)
{
	checkpoint();
	Box2 box;
	for (const Point2& p : layout.points)
		box.add(p);
	const EmbeddedSurface& surface = domain.surface;
	const FinishCounts counts = repairLayout(
		surface,
		{SeamGeometry::Plane, freeVertices(domain, freeBoundary), nullptr},
		box.extent(),
		layout);
	if (finish == Finish::LeastDistortion)
		leastDistortion(
			surface.triangulation, surface.lengths, isCut, cones, freeBoundary, layout);
	return counts;
}

FinishCounts
finishDisk(const FlowDomain& domain, bool freeBoundary, PlanarLayout& layout)
{
	return repairLayout(
		domain.surface, movesInDisk(domain, freeBoundary), kDiskExtent, layout);
}

FinishCounts finishDisk(
	const FlowDomain& domain, bool freeBoundary, CommonRefinement& refinement)
{
	const Soundness soundness{kMinRefinedHeight * kDiskExtent, kMinHeight * kDiskExtent, false};
	const int count = static_cast<int>(refinement.triangles.size());
	int bad = 0;
	for (const Triangle2& p : refinement.uv)
		bad += !soundness.isSound(p);
	if (bad == 0)
		return {};
	std::vector<Point3> places;
	for (const SurfacePoint& p : refinement.points)
		places.push_back(placeOnSurface(p, domain.surface.positions.values()));
	Array<std::array<double, 3>> sides;
	for (const Triangle& t : refinement.triangles) {
		const auto length = [&](std::size_t i, std::size_t j) {
			return distance(places[positionOf(t[i])], places[positionOf(t[j])]);
		};
		sides.push_back({length(0, 1), length(1, 2), length(2, 0)});
	}
	FlatMesh flat = flatMeshOf(
		Array<Triangle>(refinement.triangles),
		Array<Triangle2>(refinement.uv),
		Array<int>(count, 0),
		std::move(sides));
	// Points of the refinement are boundary points only between two boundary vertices; none is on a
	// hole alone.
	BorderMoves moves = movesInDisk(domain, freeBoundary);
	moves.boundary = [freeBoundary](int) { return freeBoundary; };
	WorkLimit limit(count);
	const Repair repair =
		repairInStages(flat, moves, RestShapes::OfDrawing, soundness, limit);
	for (int f = 0; f < count; ++f)
		refinement.uv[positionOf(f)] = flat.at(f);
	return countsOf(repair);
}

} // namespace ricci
