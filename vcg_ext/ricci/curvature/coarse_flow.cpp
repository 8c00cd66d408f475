// SPDX-License-Identifier: GPL-3.0-or-later
#include "coarse_flow.h"

#include "../math/aggregation.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ricci {

namespace {

/// \p values taken together by aggregate, each with its \p weight.
VertexVector
sums(const Aggregation& aggregation, const VertexVector& values, const VertexVector& weight)
{
	VertexVector result = VertexVector::Zero(aggregation.root.size());
	for (const Vertex v : values.indices())
		result[Vertex(aggregation.aggregate[v.number()])] += weight[v] * values[v];
	return result;
}

LinearSystem coarser(const LinearSystem& fine, const Aggregation& aggregation)
{
	const VertexVector one = VertexVector::Ones(fine.area.size());
	LinearSystem coarse;
	coarse.fixesBoundary = fine.fixesBoundary;
	coarse.laplacian = restricted(fine.laplacian, aggregation);
	coarse.curvature = sums(aggregation, fine.curvature, one);
	coarse.area = sums(aggregation, fine.area, one);
	if (fine.sink.size() > 0)
		coarse.sink = sums(aggregation, fine.sink, one);
	if (fine.factor.size() > 0)
		coarse.factor = sums(aggregation, fine.factor, fine.area).cwiseQuotient(coarse.area);
	return coarse;
}

/// Root mean square of u for the curvature that \p flow starts with, spread over the surface by area.
double flatteningSize(LinearFlow& flow)
{
	VertexVector rhs = -flow.curvature();
	if (flow.hasFixedSum())
		rhs -= rhs.sum() * flow.area();
	return std::sqrt(flow.meanSquare(flow.solve(rhs)));
}

/// The equation of \p fine on aggregates of vertices, and in \p roots the vertices they grew from.
LinearSystem coarsened(const LinearFlow& fine, int vertices, VertexArray<Vertex>& roots)
{
	LinearSystem system = fine.system(roots);
	while (roots.size() > vertices) {
		const Aggregation aggregation = aggregated(system.laplacian);
		if (aggregation.root.size() == roots.size())
			break;
		system = coarser(system, aggregation);
		VertexArray<Vertex> kept;
		for (const int root : aggregation.root)
			kept.push_back(roots[Vertex(root)]);
		roots = std::move(kept);
	}
	return system;
}

} // namespace

CoarseFlow::CoarseFlow(LinearFlow& fine, int vertices) : flow(coarsened(fine, vertices, roots))
{
	// Functions that are constant on aggregates are stiffer, on the whole evenly.
	const double tooSmall = flatteningSize(flow);
	if (tooSmall > 0.0)
		flow.soften(flatteningSize(fine) / tooSmall);
}

} // namespace ricci
