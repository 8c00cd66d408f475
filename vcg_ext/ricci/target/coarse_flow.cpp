// SPDX-License-Identifier: GPL-3.0-or-later
#include "coarse_flow.h"

#include "../math/smoothed_aggregation.h"

#include <cmath>
#include <utility>
#include <vector>

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

/// The rows of the \p chosen vertices in the matrix 1.
Eigen::SparseMatrix<double, Eigen::RowMajor> selection(const Array<int>& chosen, int vertexCount)
{
	Eigen::SparseMatrix<double, Eigen::RowMajor> rows(chosen.size(), vertexCount);
	rows.reserve(chosen.size());
	for (const int i : chosen.indices()) {
		rows.startVec(i);
		rows.insertBack(i, chosen[i]) = 1.0;
	}
	rows.finalize();
	return rows;
}

LinearSystem coarser(const LinearSystem& fine, const Aggregation& aggregation)
{
	const Eigen::SparseMatrix<double>& prolongation = aggregation.prolongation;
	const VertexVector one = VertexVector::Ones(fine.area.size());
	LinearSystem coarse;
	coarse.fixesBoundary = fine.fixesBoundary;
	const Eigen::SparseMatrix<double> image = fine.laplacian * prolongation;
	coarse.laplacian = prolongation.transpose() * image;
	coarse.values = selection(aggregation.root, one.size());
	if (fine.values.size() > 0)
		coarse.values = coarse.values * fine.values;
	coarse.values = coarse.values * prolongation;
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

} // namespace

std::list<CoarseFlow> coarseFlows(LinearFlow& fine, int maxVertices, int enough)
{
	std::list<CoarseFlow> levels;
	VertexArray<Vertex> vertices;
	LinearSystem system = fine.system(vertices);
	const double size = flatteningSize(fine);
	while (vertices.size() > enough) {
		const Aggregation aggregation = aggregated(system.laplacian);
		if (aggregation.root.size() == vertices.size())
			break;
		system = coarser(system, aggregation);
		VertexArray<Vertex> roots;
		for (const int root : aggregation.root)
			roots.push_back(vertices[Vertex(root)]);
		vertices = std::move(roots);
		if (vertices.size() > maxVertices)
			continue;
		LinearFlow& flow = levels.emplace_front(vertices, system).flow;
		// A space of fewer functions is stiffer, on the whole evenly.
		const double tooSmall = flatteningSize(flow);
		if (tooSmall > 0.0)
			flow.soften(size / tooSmall);
	}
	return levels;
}

} // namespace ricci
