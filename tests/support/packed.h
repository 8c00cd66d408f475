// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_PACKED_H
#define RICCI_TESTS_PACKED_H

#include <ricci/flow/curvature_map.h>
#include <ricci/metric/circle_packing.h>
#include <ricci/metric/euclidean.h>

#include <Eigen/Core>

#include <vector>

namespace ricci::testing {

/// A mesh on its way to the flow: glued, measured, with the radii of paper 4.1.
struct Packed
{
	Triangulation triangulation;
	std::vector<double> lengths, radii;
	CirclePacking packing;

	explicit Packed(const SurfaceMesh& mesh) :
			Packed(
				Triangulation(static_cast<int>(mesh.positions.size()), mesh.triangles),
				mesh.positions)
	{
	}
	Packed(const Triangulation& t, const std::vector<double>& l) :
			triangulation(t), lengths(l), radii(initialRadii(t, l)),
			packing(inversiveDistancePacking(t, l, radii))
	{
	}

	Eigen::VectorXd u() const
	{
		return Eigen::Map<const Eigen::VectorXd>(
			packing.u.data(), static_cast<Eigen::Index>(packing.u.size()));
	}
	GeometricCurvatureMap<Euclidean> map() const
	{
		return GeometricCurvatureMap<Euclidean>(packing);
	}

private:
	Packed(const Triangulation& t, const std::vector<Point3>& positions) :
			Packed(t, edgeLengths(t, positions))
	{
	}
};

} // namespace ricci::testing

#endif
