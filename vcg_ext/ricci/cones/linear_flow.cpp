// SPDX-License-Identifier: GPL-3.0-or-later
#include "linear_flow.h"

#include "../base/tolerances.h"
#include "../flow/curvature_map.h"
#include "../metric/circle_packing.h"
#include "../metric/geometry.h"
#include "../numerics/aggregation.h"

#include <cmath>
#include <utility>

namespace ricci {

namespace {

/// The curvature map of \p packing at its radii.
std::shared_ptr<const CurvatureMap> mapOf(const InitialPacking& packing)
{
	VertexVector u(packing.radii.size());
	for (const Vertex v : packing.radii.indices())
		u[v] = std::log(packing.radii[v]);
	auto map = std::make_shared<GeometricCurvatureMap<Euclidean>>(
		packing.mesh.triangulation, packing.delta);
	map->evaluate(u);
	return map;
}

} // namespace

LinearFlow::LinearFlow(
	const EmbeddedSurface& surface, InitialPacking& start, ConeBoundary boundary) :
		m_fixesBoundary(boundary == ConeBoundary::Fixed && !surface.topology.type.isClosed())
{
	const auto map = mapOf(
		start.isDelaunay ? start : delaunayPacking({surface.triangulation, surface.lengths}, {}));
	m_curvature = map->curvature();
	computeAreas(*map);
	layOut(surface, *map, boundary);
	if (start.isDelaunay)
		start.hessian = m_hessian;
}

LinearFlow::LinearFlow(
	const EmbeddedSurface& surface,
	const FlowResult& flow,
	ConeBoundary boundary,
	VertexVector weights) :
		m_fixesBoundary(boundary == ConeBoundary::Fixed && !surface.topology.type.isClosed()),
		m_curvature(flow.curvature), m_area(std::move(weights)), m_factor(flowFactor(flow))
{
	const auto map = flow.doubled
						 ? mapOf(delaunayPacking({surface.triangulation, surface.lengths}, {}))
						 : flow.metric;
	layOut(surface, *map, boundary);
}

LinearFlow::LinearFlow(LinearSystem system) :
		m_hessian(std::make_shared<FactoredHessian>(
			VertexArray<char>(static_cast<int>(system.area.size()), 0), !system.fixesBoundary)),
		m_fixesBoundary(system.fixesBoundary), m_curvature(std::move(system.curvature)),
		m_area(std::move(system.area)), m_factor(std::move(system.factor)),
		m_sink(std::move(system.sink))
{
	const int n = m_hessian->unknowns();
	m_hessian->fill(system.laplacian.bottomRightCorner(n, n).triangularView<Eigen::Lower>());
	factorize();
}

LinearSystem LinearFlow::system(VertexArray<Vertex>& vertices) const
{
	vertices.clear();
	Vertex pinned;
	for (const Vertex v : m_hessian->row().indices()) {
		if (m_hessian->row()[v] >= 0)
			vertices.push_back(v);
		else if (!m_fixesBoundary)
			pinned = v;
	}
	const auto ofVertices = [&](const VertexVector& values) {
		VertexVector result(values.size() == 0 ? 0 : vertices.size());
		if (values.size() > 0)
			for (const Vertex v : vertices.indices())
				result[v] = values[vertices[v]];
		return result;
	};

	LinearSystem result;
	result.fixesBoundary = m_fixesBoundary;
	result.laplacian = m_hessian->matrix().selfadjointView<Eigen::Lower>();
	result.curvature = ofVertices(m_curvature);
	result.area = ofVertices(m_area);
	result.factor = ofVertices(m_factor);
	result.sink = ofVertices(m_sink);
	if (!pinned.isValid()) {
		result.area /= result.area.sum();
		return result;
	}
	// What a row lacks to 0 is the weight of the edge to the vertex that is left out.
	VertexVector share = result.laplacian * Eigen::VectorXd::Ones(vertices.size());
	for (const Vertex v : share.indices()) {
		double& diagonal = result.laplacian.coeffRef(v.number(), v.number());
		if (share[v] < kTiny * diagonal)
			share[v] = 0.0;
		diagonal -= share[v];
	}
	if (share.sum() > 0.0)
		share /= share.sum();
	result.curvature += m_curvature[pinned] * share;
	result.area += m_area[pinned] * share;
	if (m_sink.size() > 0)
		result.sink += m_sink[pinned] * share;
	return result;
}

void LinearFlow::factorize()
{
	if (!m_hessian->isFactored() && m_hessian->unknowns() > 0)
		m_hessian->factorize();
}

void LinearFlow::layOut(
	const EmbeddedSurface& surface, const CurvatureMap& map, ConeBoundary boundary)
{
	m_hessian = std::make_shared<FactoredHessian>(
		m_fixesBoundary ? surface.topology.boundary : VertexArray<char>(vertexCount(), 0),
		map.scaleInvariant());
	m_hessian->fill(map);
	if (boundary == ConeBoundary::Prescribed && !surface.topology.type.isClosed())
		m_sink = boundaryShares(surface);
}

VertexVector LinearFlow::factor(VertexVector k)
{
	k -= m_curvature;
	if (m_factor.size() == 0)
		return solve(k);
	VertexVector u = m_factor + solve(k);
	u.array() -= m_area.dot(u);
	return u;
}

Eigen::MatrixXd LinearFlow::solve(Eigen::MatrixXd rhs)
{
	if (m_sink.size() > 0) // takes what the sum lacks
		for (Eigen::Index k = 0; k < rhs.cols(); ++k)
			rhs.col(k) -= rhs.col(k).sum() * m_sink;
	Eigen::MatrixXd u = solveRows(rhs);
	for (Eigen::Index k = 0; k < u.cols(); ++k)
		u.col(k).array() -= m_area.dot(u.col(k));
	return u;
}

Eigen::MatrixXd LinearFlow::gradient(const Eigen::MatrixXd& u)
{
	Eigen::MatrixXd phi = solveRows(m_area.asDiagonal() * u);
	if (m_sink.size() > 0)
		for (Eigen::Index k = 0; k < phi.cols(); ++k)
			phi.col(k).array() -= m_sink.dot(phi.col(k));
	return phi;
}

/// L^-1 rhs on the unknown vertices, 0 on the others.
Eigen::MatrixXd LinearFlow::solveRows(const Eigen::MatrixXd& rhs)
{
	factorize();
	// Entry by entry: expressions of rows cost more where there are few columns.
	const auto& row = m_hessian->row();
	Eigen::MatrixXd rows(m_hessian->unknowns(), rhs.cols()), x(rhs.rows(), rhs.cols());
	for (Eigen::Index k = 0; k < rhs.cols(); ++k)
		for (const Vertex v : row.indices())
			if (row[v] >= 0)
				rows(row[v], k) = rhs(v.number(), k);
	if (rows.rows() > 0)
		rows = m_hessian->cholesky().solve(rows);
	for (Eigen::Index k = 0; k < rhs.cols(); ++k)
		for (const Vertex v : row.indices())
			x(v.number(), k) = row[v] >= 0 ? rows(row[v], k) : 0.0;
	return x;
}

void LinearFlow::computeAreas(const CurvatureMap& map)
{
	const Triangulation& t = map.triangulation();
	m_area.setZero(t.vertexCount());
	for (const Face f : t.faces()) {
		const auto h = t.halfedges(f);
		const double area = 0.5 * map.lengths()[h[0].edge()] * map.lengths()[h[2].edge()] *
							std::sin(map.angles()[h[0]]);
		for (const Halfedge side : h)
			m_area[t.origin(side)] += area / 3.0;
	}
	m_area /= m_area.sum();
}

VertexVector boundaryShares(const EmbeddedSurface& surface)
{
	const Triangulation& t = surface.triangulation;
	double perimeter = 0.0;
	int edges = 0;
	for (const Halfedge h : t.exteriorHalfedges()) {
		perimeter += surface.lengths[h.edge()];
		++edges;
	}
	VertexVector shares = VertexVector::Zero(t.vertexCount());
	for (const Halfedge h : t.exteriorHalfedges())
		for (const Vertex v : {t.origin(h), t.target(h)})
			shares[v] +=
				0.5 * (perimeter > 0.0 ? surface.lengths[h.edge()] / perimeter : 1.0 / edges);
	return shares;
}

namespace {

/// Functions that are constant on aggregates are about so much stiffer: 2.7 to 3.3 times, whatever the surface.
constexpr double kStiffer = 2.9;

LinearSystem coarser(const LinearSystem& fine, const Aggregation& aggregation)
{
	const Eigen::SparseMatrix<double> sums = aggregation.sums();
	LinearSystem coarse;
	coarse.fixesBoundary = fine.fixesBoundary;
	coarse.laplacian = sums * fine.laplacian * sums.transpose() / kStiffer;
	coarse.curvature = sums * fine.curvature;
	coarse.area = sums * fine.area;
	if (fine.sink.size() > 0)
		coarse.sink = sums * fine.sink;
	if (fine.factor.size() > 0)
		coarse.factor = (sums * fine.area.cwiseProduct(fine.factor)).cwiseQuotient(coarse.area);
	return coarse;
}

} // namespace

LinearFlow onAggregates(LinearSystem system, int vertices, VertexArray<Vertex>& roots)
{
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
	return LinearFlow(std::move(system));
}

} // namespace ricci
