// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_MEAN_DISTORTION_H
#define RICCI_MEAN_DISTORTION_H

#include "movable_points.h"

#include <Eigen/Core>

#include <array>
#include <complex>

namespace ricci {

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

	/// \param lengths of the edges in space. A triangle that has no area there by its lengths has
	/// no shape to keep: the shape that it has in \p layout takes the place. Triangles that are not
	/// counter-clockwise in \p layout do not count.
	/// \pre \p t and \p layout outlive it
	MeanDistortion(
		const Triangulation& t, const EdgeArray<double>& lengths, const PlanarLayout& layout);

	/// Names the points at the corners. To be called before the first evaluation, and when \p
	/// points are numbered anew.
	/// \param points to be kept by the caller as long as they are used
	void usePoints(const MovablePoints& points);

	/// Computes E at \p position [point] and prepares gradient(), stiffness().
	/// \return infinity where a triangle is not counter-clockwise, by an exact test
	double evaluate(const Eigen::VectorXcd& position);

	/// dE / d conj(unknown), half of the gradient by real and imaginary parts, where E was last
	/// evaluated.
	void gradient(Eigen::VectorXcd& gradient) const;

	/// Moves the unknowns one after another to where E is less with all others in place, or a
	/// little beyond: Gauss-Seidel steps with overrelaxation, each along the gradient as far as the
	/// stiffness asks for times \p relaxation, or less. No triangle turns.
	/// \param worth unknowns whose step promises to lower E by less stay, and are looked at again only
	/// when something moves beside them
	/// \param start [point] from where images follow
	/// \param position [point] where E was last evaluated
	/// \pre E is finite there
	/// \return E, as evaluate() gives it
	double relax(
		double relaxation, double worth, const Eigen::VectorXcd& start, Eigen::VectorXcd& position);

	/// By which E changes with |f_zbar|^2 of a face: dE / d |f_zbar|^2 where its shape is nearly
	/// kept. Elsewhere more, as E bends upwards, so that the square is no lower than E for steps that
	/// do not turn it.
	double stiffness(Face f) const;

	/// The points at the corners of a face, and how f_zbar depends on them.
	const std::array<int, 3>& corners(Face f) const { return m_corners[f]; }
	std::array<Complex, 3> slopes(Face f) const
	{
		const Shape& s = m_shape[f];
		return {-(s.first + s.second), s.first, s.second};
	}

	/// Threads that evaluate; the result does not depend on them.
	void useThreads(int threads) { m_threads = threads; }

	int faceCount() const { return m_shape.size(); }

private:
	/// f_zbar = first e1 + second e2, and f_z with the conjugate coefficients.
	struct Shape
	{
		Complex first, second;
		double weight;
	};
	/// A corner that a point has: in which face, at which place there.
	struct Corner
	{
		Face face;
		int place;
	};

	void evaluate(Face f, const Eigen::VectorXcd& position);
	double sum() const;
	Complex pull(int point) const;
	Complex pull(const Corner& corner) const;
	void relax(
		int unknown,
		double relaxation,
		double worth,
		const Eigen::VectorXcd& start,
		Eigen::VectorXcd& position);

	const Triangulation& m_t;
	const PlanarLayout& m_layout;
	int m_threads;
	FaceArray<Shape> m_shape;
	FaceArray<std::array<int, 3>> m_corners;

	const MovablePoints* m_points = nullptr;
	Array<int> m_firstCorner; // [moving point, and one after the last] in m_cornerOf
	std::vector<Corner> m_cornerOf;
	Array<int> m_image;    // [unknown] the point that is its image, or -1
	Array<char> m_settled; // [unknown] 1 where relax() need not look

	FaceArray<double> m_energy, m_stiffness;
	FaceArray<std::array<Complex, 2>> m_pull; // of the face at its corners 1 and 2
};

} // namespace ricci

#endif
