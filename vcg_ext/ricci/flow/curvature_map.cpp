// SPDX-License-Identifier: GPL-3.0-or-later
#include "curvature_map.h"

#include "../metric/euclidean.h"
#include "../metric/hyperbolic.h"
#include "../numbers.h"

#include <algorithm>
#include <utility>

namespace ricci {

CurvatureMap::CurvatureMap(CirclePacking packing) :
		m_packing(std::move(packing)), m_boundary(m_packing.triangulation.boundaryVertices())
{
	const Triangulation& t = m_packing.triangulation;
	m_curvature.resize(t.vertexCount());
	m_lengths.resize(at(t.edgeCount()));
	m_weights.resize(at(t.edgeCount()));
	m_cosineLess1.resize(at(t.edgeCount()));
	m_angles.assign(at(t.halfedgeCount()), 0.0);
}

void CurvatureMap::swapEdge(int e, double delta)
{
	m_packing.triangulation.flip(e);
	m_packing.delta[at(e)] = delta;
	++m_revision;
}

template<class Geometry>
GeometricCurvatureMap<Geometry>::GeometricCurvatureMap(CirclePacking packing) :
		CurvatureMap(std::move(packing)), m_circles(at(m_packing.triangulation.vertexCount())),
		m_edges(at(m_packing.triangulation.edgeCount()))
{
}

template<class Geometry>
void GeometricCurvatureMap<Geometry>::evaluate(
	const Eigen::VectorXd& u, const Eigen::VectorXd& rest)
{
	evaluateCircles(u, rest);
	evaluateEdges();
	evaluateTriangles();
}

template<class Geometry>
void GeometricCurvatureMap<Geometry>::evaluateCircles(
	const Eigen::VectorXd& u, const Eigen::VectorXd& rest)
{
	for (std::size_t v = 0; v < m_circles.size(); ++v) {
		const auto i = static_cast<Eigen::Index>(v);
		m_circles[v] = Geometry::circle(u[i], rest.size() > 0 ? rest[i] : 0.0);
	}
}

template<class Geometry>
void GeometricCurvatureMap<Geometry>::evaluateEdges()
{
	const Triangulation& t = m_packing.triangulation;
	for (int e = 0; e < t.edgeCount(); ++e) {
		m_edges[at(e)] = Geometry::edge(
			m_circles[at(t.origin(2 * e))], m_circles[at(t.target(2 * e))], m_packing.delta[at(e)]);
		m_lengths[at(e)] = static_cast<double>(m_edges[at(e)].length);
		m_cosineLess1[at(e)] = static_cast<double>(m_edges[at(e)].cosineLess1);
	}
}

template<class Geometry>
void GeometricCurvatureMap<Geometry>::evaluateTriangles()
{
	using Real = typename Geometry::Real;
	const Triangulation& t = m_packing.triangulation;
	std::fill(m_weights.begin(), m_weights.end(), 0.0);
	for (int v = 0; v < t.vertexCount(); ++v)
		m_curvature[v] = m_boundary[at(v)] ? kPi : 2.0 * kPi;
	m_broken = 0;
	m_needleRatio = 1.0;

	for (int f = 0; f < t.faceCount(); ++f) {
		// Vertex k is the origin of halfedge k; side k runs from vertex k to k + 1.
		const std::array<int, 3> h = t.halfedges(f);
		std::array<int, 3> vertex, edge;
		for (std::size_t k = 0; k < 3; ++k) {
			vertex[k] = t.origin(h[k]);
			edge[k] = Triangulation::edge(h[k]);
		}
		// tau_k = (two adjacent sides - opposite side) / 2, free of cancellation in the radii.
		std::array<Real, 3> tau;
		std::array<double, 3> angle;
		for (std::size_t k = 0; k < 3; ++k)
			tau[k] =
				m_circles[at(vertex[k])].radius +
				Real(0.5) * (m_edges[at(edge[k])].excess + m_edges[at(edge[(k + 2) % 3])].excess -
							 m_edges[at(edge[(k + 1) % 3])].excess);
		const auto shortest = std::min_element(tau.begin(), tau.end());
		if (!(*shortest > 0.0)) {
			++m_broken;
			angle = {0.0, 0.0, 0.0};
			angle[at(static_cast<int>(shortest - tau.begin()))] = kPi;
		}
		else {
			const Real s = Geometry::heron(tau[0] + tau[1] + tau[2]);
			const Real a = Geometry::heron(tau[0]), b = Geometry::heron(tau[1]),
					   c = Geometry::heron(tau[2]);
			angle[0] = static_cast<double>(2 * std::atan2(std::sqrt(b * c), std::sqrt(s * a)));
			angle[1] = static_cast<double>(2 * std::atan2(std::sqrt(c * a), std::sqrt(s * b)));
			angle[2] = static_cast<double>(2 * std::atan2(std::sqrt(a * b), std::sqrt(s * c)));
			const Real area = 2 * std::sqrt(s * a * b * c); // product of two sides and a sine

			std::array<Real, 3> inversive, radius, kappa;
			for (std::size_t k = 0; k < 3; ++k) {
				inversive[k] = 1 + Real(m_packing.delta[at(edge[k])]);
				radius[k] = m_circles[at(vertex[k])].s;
				kappa[k] = m_circles[at(vertex[k])].kappa;
			}
			double longest = 0.0, least = m_lengths[at(edge[0])];
			for (std::size_t k = 0; k < 3; ++k) {
				// Derivative of the angle at i by u_j, side ij = side k, apex m.
				const std::size_t i = k, j = (k + 1) % 3, m = (k + 2) % 3;
				const Real ij = inversive[k], jm = inversive[j], mi = inversive[m];
				const Real d = m_packing.delta[at(edge[k])];
				const Real height =
					kappa[i] * (mi + jm * ij) + kappa[j] * (jm + mi * ij) - kappa[m] * d * (d + 2);
				m_weights[at(edge[k])] += static_cast<double>(
					radius[i] * radius[i] * radius[j] * radius[j] * radius[m] * height /
					(area * m_edges[at(edge[k])].sine2));
				longest = std::max(longest, m_lengths[at(edge[k])]);
				least = std::min(least, m_lengths[at(edge[k])]);
			}
			m_needleRatio = std::max(m_needleRatio, longest / least);
		}
		for (std::size_t k = 0; k < 3; ++k) {
			m_angles[at(h[k])] = angle[k];
			m_curvature[vertex[k]] -= angle[k];
		}
	}
	// Left out, the rest of pi would add up over the vertices and break Gauss-Bonnet by as much.
	for (int v = 0; v < t.vertexCount(); ++v)
		m_curvature[v] += m_boundary[at(v)] ? kPiRest : 2.0 * kPiRest;
}

template<class Geometry>
void FlippingCurvatureMap<Geometry>::evaluate(const Eigen::VectorXd& u, const Eigen::VectorXd& rest)
{
	this->evaluateCircles(u, rest);
	m_kappa.resize(this->m_circles.size());
	for (std::size_t v = 0; v < m_kappa.size(); ++v)
		m_kappa[v] = static_cast<double>(this->m_circles[v].kappa);
	CirclePacking& packing = this->m_packing;
	if (makeWeightedDelaunay(packing.triangulation, packing.delta, m_kappa, m_journal, m_queue) > 0)
		++this->m_revision;
	this->evaluateEdges();
	this->evaluateTriangles();
}

template<class Geometry>
void FlippingCurvatureMap<Geometry>::accept()
{
	m_journal.appendTo(this->m_flips);
	m_journal.clear();
}

template<class Geometry>
void FlippingCurvatureMap<Geometry>::reject()
{
	if (m_journal.size() > 0)
		++this->m_revision;
	m_journal.rewind(this->m_packing.triangulation, this->m_packing.delta);
}

template class GeometricCurvatureMap<Euclidean>;
template class FlippingCurvatureMap<Euclidean>;
template class GeometricCurvatureMap<EuclideanGeometry<long double>>;
template class FlippingCurvatureMap<EuclideanGeometry<long double>>;
template class GeometricCurvatureMap<Hyperbolic>;
template class FlippingCurvatureMap<Hyperbolic>;
template class GeometricCurvatureMap<HyperbolicGeometry<long double>>;
template class FlippingCurvatureMap<HyperbolicGeometry<long double>>;

} // namespace ricci
