// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_DENSE_FLOW_H
#define RICCI_TESTS_DENSE_FLOW_H

#include "support/packed.h"

#include <ricci/metric/circle_packing.h>
#include <ricci/surface/flow_domain.h>

#include <Eigen/Dense>

#include <cmath>
#include <vector>

namespace ricci::testing {

/// The surface of a packed mesh, without places in space.
inline EmbeddedSurface surfaceOf(const Packed& p)
{
	return {p.triangulation, {}, p.lengths, topologyOf(p.triangulation)};
}

/// The linear flow on a surface by dense matrices.
struct DenseFlow
{
	Eigen::MatrixXd laplacian; ///< rows and columns by vertex
	VertexVector curvature, area;

	explicit DenseFlow(const Packed& p)
	{
		const InitialPacking start = delaunayPacking({p.triangulation, p.lengths}, {});
		const Triangulation& t = start.mesh.triangulation;
		VertexVector u(t.vertexCount());
		for (const Vertex v : t.vertices())
			u[v] = std::log(start.radii[v]);
		GeometricCurvatureMap<Euclidean> map(CirclePacking{t, start.delta});
		// By central differences of the curvature, so that neither Hessian nor solver are trusted.
		laplacian.resize(t.vertexCount(), t.vertexCount());
		const double step = 1e-6;
		for (const Vertex v : t.vertices()) {
			VertexVector moved = u;
			moved[v] += step;
			map.evaluate(moved);
			VertexVector slope = map.curvature();
			moved[v] -= 2 * step;
			map.evaluate(moved);
			slope -= map.curvature();
			laplacian.col(v.number()) = slope / (2 * step);
		}
		map.evaluate(u);
		curvature = map.curvature();
		area.setZero(t.vertexCount());
		for (const Face f : t.faces()) {
			double l[3];
			for (std::size_t k = 0; k < 3; ++k)
				l[k] = start.mesh.lengths[t.halfedges(f)[k].edge()];
			const double s = 0.5 * (l[0] + l[1] + l[2]);
			const double heron = std::sqrt(s * (s - l[0]) * (s - l[1]) * (s - l[2]));
			for (const Vertex v : t.vertices(f))
				area[v] += heron / 3.0;
		}
		area /= area.sum();
	}

	/// The u of least norm that the Laplacian maps to \p rhs, moved to mean 0 by area.
	VertexVector solve(const VertexVector& rhs) const
	{
		VertexVector u = laplacian.completeOrthogonalDecomposition().solve(rhs);
		u.array() -= area.dot(u);
		return u;
	}

	/// Standard deviation by area of 2 u, on a closed surface.
	double
	distortion(const std::vector<Vertex>& vertices, const std::vector<double>& curvatures) const
	{
		VertexVector rhs = -curvature;
		for (std::size_t i = 0; i < vertices.size(); ++i)
			rhs[vertices[i]] += curvatures[i];
		const VertexVector u = solve(rhs);
		return 2.0 * std::sqrt(area.dot(u.cwiseProduct(u)));
	}
};

} // namespace ricci::testing

#endif
