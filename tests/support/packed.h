// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_PACKED_H
#define RICCI_TESTS_PACKED_H

#include "intrinsic.h"

#include <ricci/flow/curvature_map.h>
#include <ricci/metric/circle_packing.h>
#include <ricci/metric/geometry.h>

#include <cmath>

namespace ricci::testing {

/// A mesh on its way to the flow: glued, measured, with the radii of paper 4.1.
struct Packed
{
	Triangulation triangulation;
	EdgeArray<double> lengths;
	VertexArray<double> radii;
	EdgeArray<double> delta;

	explicit Packed(const SurfaceMesh& mesh) : Packed(intrinsicMesh(mesh)) {}
	Packed(const Triangulation& t, const EdgeArray<double>& l) :
			triangulation(t), lengths(l), radii(initialRadii(t, l)),
			delta(inversiveDistancesLessOne(t, l, radii))
	{
	}

	VertexVector u() const
	{
		VertexVector u(radii.size());
		for (const Vertex v : radii.indices())
			u[v] = std::log(radii[v]);
		return u;
	}
	GeometricCurvatureMap<Euclidean> map() const
	{
		return GeometricCurvatureMap<Euclidean>(triangulation, delta);
	}

private:
	explicit Packed(const IntrinsicMesh& mesh) : Packed(mesh.triangulation, mesh.lengths) {}
};

} // namespace ricci::testing

#endif
