// SPDX-License-Identifier: GPL-3.0-or-later
#include "area.h"

#include "../base/tolerances.h"

#include <vector>

namespace ricci {

namespace {

/// Sum of \p area(sides) over the triangles.
template<class Area>
double sumOverTriangles(const Triangulation& t, const EdgeArray<double>& lengths, Area area)
{
	double sum = 0.0;
	for (const Face f : t.faces())
		sum += area(sidesOf(t, lengths, f));
	return sum;
}

} // namespace

double euclideanArea(const Triangulation& t, const EdgeArray<double>& lengths)
{
	return sumOverTriangles(
		t, lengths, [](const std::array<double, 3>& sides) { return euclideanArea(sides); });
}

double hyperbolicArea(const Triangulation& t, const EdgeArray<double>& lengths)
{
	return sumOverTriangles(
		t, lengths, [](const std::array<double, 3>& sides) { return hyperbolicArea(sides); });
}

EdgeArray<double>
cotangentWeights(const Triangulation& t, const EdgeArray<double>& lengths, double maxCotangent)
{
	EdgeArray<double> weights(t.edgeCount(), 0.0);
	for (const Face f : t.faces()) {
		const std::array<double, 3> l = sidesOf(t, lengths, f);
		const double area = euclideanArea(l);
		for (std::size_t k = 0; k < 3; ++k) {
			const double a = l[k], b = l[(k + 1) % 3], c = l[(k + 2) % 3];
			const double half = ((b - a) * (b + a) + c * c) / std::max(8.0 * area, kNoArea);
			weights[t.halfedges(f)[k].edge()] +=
				std::clamp(half, -0.5 * maxCotangent, 0.5 * maxCotangent);
		}
	}
	return weights;
}

VertexVector areaShares(const Triangulation& t, const EdgeArray<double>& lengths)
{
	VertexVector areas = VertexVector::Zero(t.vertexCount());
	for (const Face f : t.faces()) {
		const double third = euclideanArea(sidesOf(t, lengths, f)) / 3.0;
		for (const Vertex v : t.vertices(f))
			areas[v] += third;
	}
	return areas / areas.sum();
}

Eigen::SparseMatrix<double> laplacian(
	const Triangulation& t,
	const EdgeArray<double>& weights,
	const VertexArray<int>& row,
	Eigen::VectorXd diagonal)
{
	std::vector<Eigen::Triplet<double>> entries;
	entries.reserve(positionOf(weights.size() + row.size()));
	for (const Edge e : t.edges()) {
		const auto ends = t.ends(e);
		const int a = row[ends[0]], b = row[ends[1]];
		if (a == b)
			continue; // a loop
		for (const int i : {a, b})
			if (i >= 0)
				diagonal[i] += weights[e];
		if (a >= 0 && b >= 0)
			entries.emplace_back(std::max(a, b), std::min(a, b), -weights[e]);
	}
	for (int i = 0; i < diagonal.size(); ++i)
		entries.emplace_back(i, i, diagonal[i]);
	Eigen::SparseMatrix<double> lower(diagonal.size(), diagonal.size());
	lower.setFromTriplets(entries.begin(), entries.end());
	return lower;
}

} // namespace ricci
