// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_MEAN_DISTORTION_H
#define RICCI_MEAN_DISTORTION_H

#include "../base/graphs.h"
#include "point_groups.h"

#include <Eigen/Core>

#include <array>
#include <complex>

namespace ricci {

/// The points of a flat mesh in the order in which an optimisation takes them: the unknowns, which are
/// the first points of the groups that move, then their images, then the points that stay.
///
/// The unknowns follow a walk over the surface, breadth first from its point farthest from the middle
/// of the mesh, and at every vertex to the farthest neighbours first: what takes them one after another
/// does not depend on the numbers of the mesh, and finds neighbours near in memory.
struct NumberedPoints
{
	Array<int> number; ///< [point of the mesh]
	int unknowns = 0;
	int moving = 0; ///< unknowns and images

	// By number.
	Array<int> unknown;               ///< that moves the point, or -1
	Array<std::complex<double>> turn; ///< the derivative of the point by its unknown

	/// If no group is fixed, two points far from each other stay, which takes away the similarities of
	/// the plane.
	NumberedPoints(const FlatMesh& flat, const PointGroups& groups);
};

/// The mean conformal distortion of a map f of triangles to the plane, as a function of the points
/// that may move: E = sum over the faces of weight (K - 1)^(5/4), weights with the sum 1.
///
/// K = sigma1 / sigma2 = (1 + m) / (1 - m) is the dilatation (paper 5.1), m = |f_zbar| / |f_z| by
/// the Wirtinger derivatives of the linear map of the triangle [Weber Myles Zorin 2012], smoothed
/// at 0. In a triangle 0 z1 z2 of area A, with e1 and e2 the sides of its image at the image of 0,
///     4 A f_zbar = i (z1 e2 - z2 e1),   4 A f_z = i (conj(z2) e1 - conj(z1) e2),
/// and |f_z|^2 - |f_zbar|^2 is the quotient of the areas: m < 1 where the image is
/// counter-clockwise.
///
/// The exponent is between that of the mean of K (1), which lowers the mean at the cost of the
/// worst triangles, and those (2 and more) that leave the mean where a conformal map has it. The
/// weights are those of the paper's mean over vertices (5.1) for the most part, and of the means by
/// area and over faces for the rest.
class MeanDistortion
{
public:
	using Complex = std::complex<double>;

	/// A triangle that has no area by its lengths has no shape to keep: the shape that it has in the plane
	/// takes the place. Flipped triangles count as reflected ones, those without area in the plane do not.
	/// \param countsFlipped else flipped triangles do not count, either
	MeanDistortion(const FlatMesh& flat, const PointGroups& groups, bool countsFlipped);

	const NumberedPoints& points() const { return m_points; }

	/// Computes E at \p position [point] and prepares gradient(), stiffness().
	/// \return infinity where a triangle that counts is not turned as it was, by an exact test
	double evaluate(const Eigen::VectorXcd& position);

	/// dE / d conj(unknown), half of the gradient by real and imaginary parts, where E was last
	/// evaluated.
	void gradient(Eigen::VectorXcd& gradient) const;

	/// By which E changes with |f_zbar|^2 of a triangle: dE / d |f_zbar|^2 where its shape is nearly
	/// kept. Elsewhere more, as E bends upwards, so that the square is no lower than E for steps that
	/// do not turn it.
	double stiffness(int triangle) const;

	/// The points at the corners of a triangle, and how f_zbar depends on them.
	const Triangle& corners(int triangle) const { return m_corners[triangle]; }
	std::array<Complex, 3> slopes(int triangle) const
	{
		const Shape& s = m_shape[triangle];
		return {-(s.first + s.second), s.first, s.second};
	}

	int size() const { return m_shape.size(); }

private:
	/// f_zbar = first e1 + second e2, and f_z with the conjugate coefficients.
	struct Shape
	{
		Complex first, second;
		double weight;
	};

	void setShapes(const FlatMesh& flat, const Array<int>& side);
	void evaluate(int triangle, const Eigen::VectorXcd& position);
	Complex pull(int point) const;

	const NumberedPoints m_points;
	Array<Shape> m_shape;
	Array<Triangle> m_corners;
	Adjacency<int, Corner> m_cornersOf; // [moving point]

	Array<double> m_energy, m_stiffness;
	Array<std::array<Complex, 2>> m_pull; // of the triangle at its corners 1 and 2
};

} // namespace ricci

#endif
