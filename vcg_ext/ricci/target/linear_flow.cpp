// SPDX-License-Identifier: GPL-3.0-or-later
#include "linear_flow.h"

#include "../flow/curvature_map.h"
#include "../metric/circle_packing.h"
#include "../metric/euclidean.h"

#include <cmath>
#include <utility>

namespace ricci {

namespace {

/// The curvature map of \p packing at its radii.
std::unique_ptr<CurvatureMap> mapOf(const InitialPacking& packing)
{
	CirclePacking circles =
		inversiveDistancePacking(packing.mesh.triangulation, packing.mesh.lengths, packing.radii);
	const VertexVector u = Eigen::Map<const Eigen::VectorXd>(circles.u.data(), circles.u.size());
	auto map = std::make_unique<GeometricCurvatureMap<Euclidean>>(std::move(circles));
	map->evaluate(u);
	return map;
}

} // namespace

LinearFlow::LinearFlow(const EmbeddedSurface& surface, FlowStart& start, ConeBoundary boundary) :
		m_fixesBoundary(boundary == ConeBoundary::Fixed && !surface.topology.type.isClosed())
{
	const bool isShared = start.packing.isDelaunay;
	const auto map = mapOf(
		isShared ? start.packing : delaunayPacking({surface.triangulation, surface.lengths}, {}));
	m_curvature = map->curvature();
	computeAreas(*map);
	factorize(surface, *map, boundary, isShared ? start.hessian : m_ownHessian);
}

LinearFlow::LinearFlow(
	const EmbeddedSurface& surface,
	const FlowResult& flow,
	ConeBoundary boundary,
	VertexVector weights) :
		m_fixesBoundary(boundary == ConeBoundary::Fixed && !surface.topology.type.isClosed()),
		m_curvature(flow.curvature), m_area(std::move(weights)), m_factor(flowFactor(flow))
{
	if (flow.doubled)
		factorize(
			surface,
			*mapOf(delaunayPacking({surface.triangulation, surface.lengths}, {})),
			boundary,
			m_ownHessian);
	else
		factorize(surface, *flow.metric, boundary, m_ownHessian);
}

void LinearFlow::factorize(
	const EmbeddedSurface& surface,
	const CurvatureMap& map,
	ConeBoundary boundary,
	std::unique_ptr<FactoredHessian>& hessian)
{
	hessian = std::make_unique<FactoredHessian>(
		m_fixesBoundary ? surface.topology.boundary : VertexArray<char>(vertexCount(), 0),
		map.scaleInvariant());
	m_hessian = hessian.get();
	if (m_hessian->unknowns() > 0)
		m_hessian->factorize(map);
	if (boundary == ConeBoundary::Prescribed && !surface.topology.type.isClosed())
		spreadSink(surface);
}

VertexVector LinearFlow::factor(VertexVector k)
{
	k -= m_curvature;
	if (m_factor.size() == 0)
		return solve(std::move(k));
	VertexVector u = m_factor + solve(std::move(k));
	u.array() -= m_area.dot(u);
	return u;
}

VertexVector LinearFlow::solve(VertexVector rhs)
{
	if (m_sink.size() > 0)
		rhs -= rhs.sum() * m_sink;
	VertexVector u = solveRows(rhs);
	u.array() -= m_area.dot(u);
	return u;
}

VertexVector LinearFlow::gradient(const VertexVector& u)
{
	VertexVector phi = solveRows(m_area.cwiseProduct(u));
	if (m_sink.size() > 0)
		phi.array() -= m_sink.dot(phi);
	return phi;
}

/// L^-1 rhs on the unknown vertices, 0 on the others.
VertexVector LinearFlow::solveRows(const VertexVector& rhs)
{
	m_hessian->gather(rhs, m_rhs);
	if (m_hessian->unknowns() > 0)
		m_hessian->cholesky().solve(m_rhs, m_solution);
	VertexVector x(vertexCount());
	m_hessian->scatter(m_solution, x);
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

/// Shares of the boundary vertices in the curvature of a prescribed boundary, by the length of their
/// two boundary edges.
void LinearFlow::spreadSink(const EmbeddedSurface& surface)
{
	const Triangulation& t = surface.triangulation;
	m_sink.setZero(t.vertexCount());
	for (const Halfedge h : t.exteriorHalfedges())
		for (const Vertex v : {t.origin(h), t.target(h)})
			m_sink[v] += surface.lengths[h.edge()];
	m_sink /= m_sink.sum();
}

} // namespace ricci
