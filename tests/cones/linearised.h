// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_LINEARISED_H
#define RICCI_TESTS_LINEARISED_H

#include "support/intrinsic.h"
#include "support/matrices.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/cones/linear_flow.h>

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace ricci::testing {

/// A mesh with a boundary that is to do this while cones are placed.
struct LinearCase
{
	std::string name;
	SurfaceMesh mesh;
	ConeBoundary boundary = ConeBoundary::Fixed;
};

/// Closed and with holes: a sphere, and a surface of this \p genus, of so many squares along an edge.
inline std::vector<LinearCase>
linearCases(std::uint64_t seed, int ofSphere, int genus, int ofOther, double noise)
{
	Random random(seed);
	const SurfaceMesh sphere = shaken(perforatedSlab(0, ofSphere), noise, random);
	const SurfaceMesh other = shaken(perforatedSlab(genus, ofOther), noise, random);
	return {
		{"sphere", sphere},
		{"genus " + std::to_string(genus), other},
		{"disk, fixed boundary", withoutStars(sphere, {0})},
		{"disk, prescribed boundary", withoutStars(sphere, {0}), ConeBoundary::Prescribed},
		{"two holes, fixed boundary", withoutStars(other, {0, 40})},
		{"two holes, prescribed", withoutStars(other, {0, 40}), ConeBoundary::Prescribed}};
}

/// A linear flow with what it refers to.
struct Linearised
{
	EmbeddedSurface surface;
	InitialPacking start;
	LinearFlow flow;

	explicit Linearised(const LinearCase& c) :
			surface(embeddedSurface(VertexArray<Point3>(c.mesh.positions), c.mesh.triangles)),
			start(initialPacking(surface, FlowOptions())), flow(surface, start, c.boundary)
	{
	}

	double total() const { return surface.topology.type.totalCurvature(); }
};

/// The linear flow on a surface by dense matrices.
struct DenseFlow
{
	Eigen::MatrixXd laplacian; ///< rows and columns by vertex
	VertexVector curvature, area;

	explicit DenseFlow(const Linearised& of)
	{
		const IntrinsicMesh& mesh = of.start.mesh;
		VertexVector u(of.flow.vertexCount());
		for (const Vertex v : u.indices())
			u[v] = std::log(of.start.radii[v]);
		GeometricCurvatureMap<Euclidean> map(mesh.triangulation, of.start.delta);
		const auto curvatureAt = [&](Vertex v, double step) {
			VertexVector moved = u;
			moved[v] += step;
			map.evaluate(moved);
			return map.curvature();
		};
		// By central differences of the curvature, so that neither Hessian nor solver are trusted.
		laplacian.resize(u.size(), u.size());
		for (const Vertex v : u.indices())
			laplacian.col(v.number()) = (curvatureAt(v, 1e-6) - curvatureAt(v, -1e-6)) / 2e-6;
		curvature = curvatureAt(Vertex(0), 0.0);
		area.setZero(u.size());
		for (const Face f : mesh.triangulation.faces()) {
			double l[3];
			for (std::size_t k = 0; k < 3; ++k)
				l[k] = mesh.lengths[mesh.triangulation.halfedges(f)[k].edge()];
			const double s = 0.5 * (l[0] + l[1] + l[2]);
			for (const Vertex v : mesh.triangulation.vertices(f))
				area[v] += std::sqrt(s * (s - l[0]) * (s - l[1]) * (s - l[2]));
		}
		area /= area.sum();
	}

	/// The u of least norm that the Laplacian maps to \p rhs, moved to mean 0 by area.
	VertexVector solve(const VertexVector& rhs) const
	{
		VertexVector u = leastNormSolution(laplacian, rhs);
		u.array() -= area.dot(u);
		return u;
	}

	/// The factor of the metric with curvature \p k.
	VertexVector factor(const VertexVector& k) const { return solve(k - curvature); }
};

} // namespace ricci::testing

#endif
