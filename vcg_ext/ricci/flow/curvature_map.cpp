// SPDX-License-Identifier: GPL-3.0-or-later
#include "curvature_map.h"

#include "../base/graphs.h"
#include "../base/numbers.h"
#include "../base/parallel.h"
#include "../base/tolerances.h"
#include "../error.h"
#include "../metric/geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <utility>

namespace ricci {

namespace {

template<class T>
void release(T& workSpace)
{
	workSpace = T();
}

} // namespace

CurvatureMap::CurvatureMap(Triangulation triangulation, EdgeArray<double> delta) :
		m_triangulation(std::move(triangulation)), m_delta(std::move(delta)),
		m_boundary(m_triangulation.boundaryVertices()), m_threads(defaultThreads())
{
	const Triangulation& t = m_triangulation;
	m_curvature.resize(t.vertexCount());
	m_lengths.resize(t.edgeCount());
	m_weights.resize(t.edgeCount());
	m_angles.assign(t.halfedgeCount(), 0.0);
}

void CurvatureMap::swapEdge(Edge e, double delta)
{
	m_triangulation.flip(e);
	m_delta[e] = delta;
	++m_revision;
}

void CurvatureMap::accept()
{
	for (const auto& [e, delta] : m_journal)
		m_flips.push_back(e);
	m_journal.clear();
}

void CurvatureMap::reject()
{
	if (!m_journal.empty())
		++m_revision;
	rewind(m_journal, m_triangulation, m_delta);
}

template<class Geometry>
GeometricCurvatureMap<Geometry>::GeometricCurvatureMap(
	Triangulation triangulation, EdgeArray<double> delta, bool flips) :
		CurvatureMap(std::move(triangulation), std::move(delta)),
		m_flipsEdges(flips), m_circles(m_triangulation.vertexCount()),
		m_excess(m_triangulation.edgeCount()), m_halfWeights(m_triangulation.halfedgeCount(), 0.0)
{
	if constexpr (!Geometry::scaleInvariant)
		m_cosineLess1.resize(m_triangulation.edgeCount());
}

template<class Geometry>
void GeometricCurvatureMap<Geometry>::evaluate(const VertexVector& u, const VertexVector& low)
{
	evaluateCircles(u, low);
	if (m_flipsEdges)
		flipToDelaunay();
	evaluateEdges();
	evaluateTriangles();
}

template<class Geometry>
void GeometricCurvatureMap<Geometry>::releaseWorkSpace()
{
	release(m_circles);
	release(m_excess);
	release(m_halfWeights);
	release(m_kappa);
	release(m_queue);
}

template<class Geometry>
void GeometricCurvatureMap<Geometry>::evaluateCircles(
	const VertexVector& u, const VertexVector& low)
{
	const bool noLow = low.size() == 0;
	inParallel(m_circles.size(), m_threads, [&](int first, int last) {
		for (const Vertex v : IndexRange<Vertex>(first, last))
			m_circles[v] = Geometry::circle(u[v], noLow ? 0.0 : low[v]);
	});
}

template<class Geometry>
void GeometricCurvatureMap<Geometry>::flipToDelaunay()
{
	m_kappa.resize(m_circles.size());
	for (const Vertex v : m_kappa.indices())
		m_kappa[v] = m_circles[v].kappa;
	const int flips =
		makeWeightedDelaunay(m_triangulation, m_delta, m_kappa, m_journal, m_queue, m_threads);
	if (flips > 0)
		++m_revision;
}

template<class Geometry>
void GeometricCurvatureMap<Geometry>::evaluateEdges()
{
	const Triangulation& t = m_triangulation;
	inParallel(t.edgeCount(), m_threads, [&](int first, int last) {
		for (const Edge e : IndexRange<Edge>(first, last)) {
			const auto& i = m_circles[t.origin(e.halfedge())];
			const auto& j = m_circles[t.target(e.halfedge())];
			const auto edge = Geometry::edge(i, j, m_delta[e]);
			m_lengths[e] = edge.length;
			if constexpr (!Geometry::scaleInvariant)
				m_cosineLess1[e] = edge.cosineLess1;
			m_excess[e] = edge.excess;
			m_weights[e] = i.s * j.s / edge.sine2; // of both circles, until the triangles are known
		}
	});
}

template<class Geometry>
void GeometricCurvatureMap<Geometry>::evaluateTriangles()
{
	const Triangulation& t = m_triangulation;
	m_broken = 0;
	m_needleRatio = 1.0;
	std::mutex summary;
	inParallel(t.faceCount(), m_threads, [&](int first, int last) {
		int broken = 0;
		double needleRatio = 1.0;
		for (const Face f : IndexRange<Face>(first, last))
			if (!evaluateTriangle(f, needleRatio))
				++broken;
		const std::lock_guard<std::mutex> lock(summary);
		m_broken += broken;
		m_needleRatio = std::max(m_needleRatio, needleRatio);
	});
	inParallel(t.edgeCount(), m_threads, [&](int first, int last) {
		for (const Edge e : IndexRange<Edge>(first, last))
			m_weights[e] = m_halfWeights[e.halfedge()] + m_halfWeights[e.halfedge().twin()];
	});

	// Every part goes through all faces and adds up at its own vertices, so that the order of the
	// summands is that of the faces.
	inParallel(t.vertexCount(), m_threads, [&](int first, int last) {
		const IndexRange<Vertex> own(first, last);
		for (const Vertex v : own)
			m_curvature[v] = m_boundary[v] ? kPi : 2.0 * kPi;
		for (const Face f : t.faces())
			for (const Halfedge h : t.halfedges(f))
				if (const Vertex v = t.origin(h); v.number() >= first && v.number() < last)
					m_curvature[v] -= m_angles[h];
		// Without the low part of pi the errors would add up over the vertices and break
		// Gauss-Bonnet by their sum.
		for (const Vertex v : own)
			m_curvature[v] += m_boundary[v] ? kPiLow : 2.0 * kPiLow;
	});
}

/// Angles and weights of face \p f; raises \p needleRatio to that of the face.
/// \return false if the face breaks the triangle inequality
template<class Geometry>
bool GeometricCurvatureMap<Geometry>::evaluateTriangle(Face f, double& needleRatio)
{
	const Triangulation& t = m_triangulation;
	// Vertex k is the origin of halfedge k; side k runs from vertex k to k + 1.
	const std::array<Halfedge, 3> h = t.halfedges(f);
	std::array<Vertex, 3> vertex;
	std::array<Edge, 3> edge;
	for (std::size_t k = 0; k < 3; ++k) {
		vertex[k] = t.origin(h[k]);
		edge[k] = h[k].edge();
	}
	// tau_k = (two adjacent sides - opposite side) / 2, free of cancellation in the radii.
	std::array<double, 3> tau;
	for (std::size_t k = 0; k < 3; ++k)
		tau[k] =
			m_circles[vertex[k]].radius +
			0.5 * (m_excess[edge[k]] + m_excess[edge[(k + 2) % 3]] - m_excess[edge[(k + 1) % 3]]);
	const auto smallest = std::min_element(tau.begin(), tau.end());
	if (!(*smallest > 0.0)) {
		for (std::size_t k = 0; k < 3; ++k) {
			m_angles[h[k]] = 0.0;
			m_halfWeights[h[k]] = 0.0;
		}
		m_angles[h[static_cast<std::size_t>(smallest - tau.begin())]] = kPi;
		return false;
	}
	// With s the sum of the tau, the tangents of the half angles are r / tau_k, r = sqrt(tau_0 tau_1 tau_2 / s), the radius of
	// the inscribed circle.
	const double s = Geometry::heron(tau[0] + tau[1] + tau[2]);
	std::array<double, 3> x;
	for (std::size_t k = 0; k < 3; ++k)
		x[k] = Geometry::heron(tau[k]);
	const double r = std::sqrt(x[0] * (x[1] / s) * x[2]);
	for (std::size_t k = 0; k < 3; ++k)
		m_angles[h[k]] = 2.0 * std::atan(r / x[k]);

	std::array<double, 3> inversive, radius, kappa;
	for (std::size_t k = 0; k < 3; ++k) {
		inversive[k] = 1.0 + m_delta[edge[k]];
		radius[k] = m_circles[vertex[k]].s;
		kappa[k] = m_circles[vertex[k]].kappa;
	}
	// 2 s r is the product of two sides and the sine between them.
	const double factor = radius[0] * radius[1] * radius[2] / (2.0 * s * r);
	double longest = 0.0, shortest = m_lengths[edge[0]];
	for (std::size_t k = 0; k < 3; ++k) {
		// Derivative of the angle at i by u_j, side ij = side k, apex m.
		const std::size_t i = k, j = (k + 1) % 3, m = (k + 2) % 3;
		const double ij = inversive[k], jm = inversive[j], mi = inversive[m];
		const double d = m_delta[edge[k]];
		const double height =
			kappa[i] * (mi + jm * ij) + kappa[j] * (jm + mi * ij) - kappa[m] * d * (d + 2.0);
		m_halfWeights[h[k]] = factor * m_weights[edge[k]] * height;
		longest = std::max(longest, m_lengths[edge[k]]);
		shortest = std::min(shortest, m_lengths[edge[k]]);
	}
	if (longest > needleRatio * shortest)
		needleRatio = longest / shortest;
	return true;
}

template class GeometricCurvatureMap<Euclidean>;
template class GeometricCurvatureMap<Hyperbolic>;

std::shared_ptr<CurvatureMap> curvatureMap(
	Triangulation triangulation, EdgeArray<double> delta, Background background, bool flips)
{
	if (background == Background::EuclideanPlane)
		return std::make_shared<GeometricCurvatureMap<Euclidean>>(
			std::move(triangulation), std::move(delta), flips);
	return std::make_shared<GeometricCurvatureMap<Hyperbolic>>(
		std::move(triangulation), std::move(delta), flips);
}

namespace {

/// From one shift to the next, up to that entry.
constexpr double kShiftGrowth = 100.0;

} // namespace

FactoredHessian::FactoredHessian(
	const VertexArray<char>& fixed, bool scaleInvariant, const VertexArray<Vertex>& mirror) :
		m_row(fixed.size(), -1)
{
	const bool anyFixed = std::find(fixed.begin(), fixed.end(), 1) != fixed.end();
	const Vertex pinned = !anyFixed && scaleInvariant ? Vertex(0) : Vertex();
	for (const Vertex v : fixed.indices()) {
		const Vertex first = mirror.empty() ? v : std::min(v, mirror[v]);
		if (first != v)
			m_row[v] = m_row[first];
		else if (!fixed[v] && v != pinned)
			m_row[v] = m_unknowns++;
	}
}

/// Lays out the sparsity pattern for the connectivity of \p map. Vertices with one row have the same u: their
/// rows of the whole matrix are added up, and their columns.
void FactoredHessian::layOut(const CurvatureMap& map)
{
	const Triangulation& t = map.triangulation();
	m_offDiagonal.assign(t.edgeCount(), -1);

	// Of each column the rows and their edges: no edge on the diagonal.
	using Entry = std::pair<int, Edge>;
	Adjacency<int, Entry> columns(m_unknowns, [&](const auto& add) {
		for (int c = 0; c < m_unknowns; ++c)
			add(c, Entry(c, Edge()));
		for (const Edge e : t.edges()) {
			const auto [a, b] = t.ends(e);
			const auto [low, high] = std::minmax({m_row[a], m_row[b]});
			if (low >= 0 && low != high)
				add(low, Entry(high, e));
		}
	});
	m_matrix.resize(m_unknowns, m_unknowns);
	m_matrix.resizeNonZeros(static_cast<Eigen::Index>(columns.items().size()));
	int* outer = m_matrix.outerIndexPtr();
	int* inner = m_matrix.innerIndexPtr();
	int slot = 0;
	for (int c = 0; c < m_unknowns; ++c) {
		const ItemRange<Entry> column = columns[c];
		std::sort(column.begin(), column.end());
		outer[c] = slot;
		int last = -1;
		for (const auto& [r, e] : column) {
			if (r != last)
				inner[slot++] = last = r;
			if (e.isValid())
				m_offDiagonal[e] = slot - 1;
		}
	}
	outer[m_unknowns] = slot;
	m_matrix.resizeNonZeros(slot);
}

void FactoredHessian::fill(const CurvatureMap& map)
{
	if (m_revision != map.revision()) {
		layOut(map);
		m_revision = map.revision();
	}
	m_hasBroken = map.brokenTriangles() > 0;
	double* value = m_matrix.valuePtr();
	std::fill(value, value + m_matrix.nonZeros(), 0.0);
	const int* diagonal = m_matrix.outerIndexPtr(); // slots: the first of each column
	for (const Edge e : m_offDiagonal.indices()) {
		const double w = map.weights()[e];
		const double C = map.cosineLess1(e);
		const auto ends = map.triangulation().ends(e);
		const int a = m_row[ends[0]], b = m_row[ends[1]];
		if (a >= 0 && a == b) {
			// A loop, or an edge between mirror images, has circles of one size at both ends: 2 w
			// cosh(l) - 2 w.
			value[diagonal[a]] += 2.0 * w * C;
			continue;
		}
		if (a >= 0)
			value[diagonal[a]] += w * (1.0 + C);
		if (b >= 0)
			value[diagonal[b]] += w * (1.0 + C);
		if (m_offDiagonal[e] >= 0)
			value[m_offDiagonal[e]] -= w;
	}
}

void FactoredHessian::factorize()
{
	double shift = 0.0;
	const auto shiftTo = [&](double more) {
		for (int c = 0; c < m_unknowns; ++c)
			m_matrix.valuePtr()[m_matrix.outerIndexPtr()[c]] += more - shift;
		shift = more;
	};
	if (m_hasBroken)
		shiftTo(kRegularisation);
	m_isFactored = false;
	double scale = 1.0;
	for (int c = 0; c < m_unknowns; ++c)
		scale = std::max(scale, m_matrix.valuePtr()[m_matrix.outerIndexPtr()[c]]);
	while (!m_cholesky.factorize(m_matrix)) {
		const double next = std::max(kShiftGrowth * shift, kManyRoundings * scale);
		if (!(next <= scale) || std::isinf(next))
			throw SolverFailed(SolverFailed::Flow);
		shiftTo(next);
	}
	m_isFactored = true;
	m_isShifted = shift > 0.0;
}

Eigen::VectorXd FactoredHessian::gather(const VertexVector& values) const
{
	Eigen::VectorXd rows = Eigen::VectorXd::Zero(m_unknowns);
	for (const Vertex v : m_row.indices())
		if (m_row[v] >= 0)
			rows[m_row[v]] += values[v];
	return rows;
}

VertexVector FactoredHessian::scatter(const Eigen::VectorXd& rows) const
{
	VertexVector values(m_row.size());
	for (const Vertex v : m_row.indices())
		values[v] = m_row[v] >= 0 ? rows[m_row[v]] : 0.0;
	return values;
}

} // namespace ricci
