// SPDX-License-Identifier: GPL-3.0-or-later
#include "holonomy_check.h"

#include "../math/disk_isometry.h"
#include "../math/points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace ricci {

namespace {

bool contains(const std::vector<Vertex>& loop, Vertex v)
{
	return std::find(loop.begin(), loop.end(), v) != loop.end();
}

bool isGeodesic(const std::vector<Vertex>& loop, const Target& target)
{
	return std::all_of(loop.begin(), loop.end(), [&](Vertex v) {
		return !target.fixed[v] && target.curvature[v] == 0.0;
	});
}

/// Hyperbolic length of a boundary loop.
double lengthOf(const std::vector<Vertex>& loop, const Triangulation& t, const PlanarLayout& layout)
{
	double length = 0.0;
	for (const Halfedge h : t.interiorHalfedges()) {
		if (!t.isBoundary(h.edge()) || !contains(loop, t.origin(h)))
			continue;
		const double chord = chordLength(asComplex(layout[h]), asComplex(layout[t.next(h)]));
		length += 2.0 * std::asinh(0.5 * chord);
	}
	return length;
}

} // namespace

double boundaryHolonomyError(
	const FuchsianGroup& group,
	const Triangulation& t,
	const Topology& topology,
	const PlanarLayout& layout,
	const Target& target)
{
	double error = 0.0;
	for (std::size_t i = 0; i < group.peripheral.size(); ++i)
		for (const std::vector<Vertex>& loop : topology.loops)
			if (contains(loop, group.peripheralVertex[i]) && isGeodesic(loop, target)) {
				const double half = 0.5 * std::abs(group.peripheral[i].trace());
				const double translation = 2.0 * std::acosh(std::max(half, 1.0));
				error = std::max(error, std::abs(translation - lengthOf(loop, t, layout)));
			}
	return error;
}

} // namespace ricci
