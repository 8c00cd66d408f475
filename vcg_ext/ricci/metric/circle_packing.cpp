// SPDX-License-Identifier: GPL-3.0-or-later
#include "circle_packing.h"

#include "euclidean.h"

#include <algorithm>
#include <limits>

namespace ricci {

namespace {

/// I - 1 on each edge, between \p lowest and \p highest.
EdgeArray<double> distancesLessOne(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const VertexArray<double>& radii,
	double lowest,
	double highest)
{
	EdgeArray<double> delta(t.edgeCount());
	for (const Edge e : t.edges()) {
		const auto [i, j] = t.ends(e);
		delta[e] = std::clamp(Euclidean::delta(lengths[e], radii[i], radii[j]), lowest, highest);
	}
	return delta;
}

} // namespace

VertexArray<double> initialRadii(const Triangulation& t, const EdgeArray<double>& lengths)
{
	VertexArray<double> radii(t.vertexCount(), std::numeric_limits<double>::infinity());
	for (const Face f : t.faces())
		for (const Halfedge h : t.halfedges(f)) {
			const double left = lengths[h.edge()];
			const double opposite = lengths[t.next(h).edge()];
			const double right = lengths[t.previous(h).edge()];
			double& radius = radii[t.origin(h)];
			radius = std::min(radius, 0.5 * (left + right - opposite));
		}
	return radii;
}

EdgeArray<double> inversiveDistancesLessOne(
	const Triangulation& t, const EdgeArray<double>& lengths, const VertexArray<double>& radii)
{
	return distancesLessOne(t, lengths, radii, 0.0, std::numeric_limits<double>::infinity());
}

EdgeArray<double> thurstonDistancesLessOne(
	const Triangulation& t, const EdgeArray<double>& lengths, const VertexArray<double>& radii)
{
	return distancesLessOne(t, lengths, radii, -1.0, 0.0);
}

} // namespace ricci
