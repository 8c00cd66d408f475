// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_DISK_ISOMETRY_H
#define RICCI_DISK_ISOMETRY_H

#include "double_double.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <type_traits>

namespace ricci {

/// Orientation-preserving isometry of the Poincaré disk, z -> (a z + b) / (conj(b) z + conj(a)) with
/// |a|^2 - |b|^2 = 1: an element of SU(1,1) [Beardon 1983, 7]. Its negative is the same isometry. It
/// also stands for a frame: the image of the point 0 and of the direction of the positive real axis
/// there. A product p q is p after q. \p T is the precision.
template<class T>
struct BasicDiskIsometry
{
	using Complex =
		std::conditional_t<std::is_same_v<T, DoubleDouble>, ExtendedComplex, std::complex<T>>;

	Complex a{1, 0}, b{0, 0};

	/// Turns the disk round 0 by \p angle radians, counter-clockwise.
	static BasicDiskIsometry rotation(T angle)
	{
		using std::polar;
		return {polar(T(1), angle / 2), Complex()};
	}

	/// Moves 0 by the hyperbolic \p length along the positive real axis, and the axis along itself.
	static BasicDiskIsometry translation(T length)
	{
		using std::cosh, std::sinh;
		return {cosh(length / 2), sinh(length / 2)};
	}

	/// Moves 0 to \p z, |z| < 1, along the straight line between them.
	static BasicDiskIsometry translationTo(Complex z)
	{
		using std::abs, std::sqrt;
		const T r = abs(z), scale = 1 / sqrt((1 - r) * (1 + r));
		return {scale, scale * z};
	}

	BasicDiskIsometry inverse() const
	{
		using std::conj;
		return {conj(a), -b};
	}

	friend BasicDiskIsometry operator*(const BasicDiskIsometry& p, const BasicDiskIsometry& q)
	{
		using std::conj;
		return {p.a * q.a + p.b * conj(q.b), p.a * q.b + p.b * conj(q.a)};
	}

	Complex operator()(Complex z) const
	{
		using std::conj;
		return (a * z + b) / (conj(b) * z + conj(a));
	}

	/// Image of 0.
	Complex origin() const
	{
		using std::conj;
		return b / conj(a);
	}

	/// Hyperbolic distance from 0 to its image.
	T displacement() const
	{
		using std::abs, std::asinh;
		return 2 * asinh(abs(b));
	}

	/// Sum of the eigenvalues, real: |trace| = 2 cosh(L / 2) where points of an axis move by L, and
	/// 2 |cos(angle / 2)| for a rotation.
	T trace() const { return 2 * a.real(); }

	/// End points on the unit circle of the axis: the geodesic whose points the isometry moves along
	/// it, from \p from towards \p to.
	/// \return false if there is none (rotations, and isometries with one fixed point on the circle)
	bool axis(Complex& from, Complex& to) const
	{
		using std::abs, std::conj, std::sqrt;
		// Fixed points: conj(b) z^2 - 2 i Im(a) z - b = 0.
		const T sine = a.imag(), root = abs(b) * abs(b) - sine * sine;
		if (!(root > 0) || !(abs(a.real()) > 1))
			return false;
		const T along = a.real() < 0 ? -sqrt(root) : sqrt(root);
		to = Complex(along, sine) / conj(b);
		from = Complex(-along, sine) / conj(b);
		return true;
	}

	/// The same with a and b divided by the root of |a|^2 - |b|^2, which rounded products keep at 1
	/// only nearly; unchanged where rounding has made it 0 or negative (|a| above 1e8 in double).
	BasicDiskIsometry normalised() const
	{
		using std::abs, std::sqrt;
		const T x = abs(a), y = abs(b), determinant = (x - y) * (x + y);
		if (!(determinant > 0))
			return *this;
		const T scale = 1 / sqrt(determinant);
		return {scale * a, scale * b};
	}

	/// Largest entry of the difference from the identity or its negative, whichever is nearer.
	T distanceFromIdentity() const
	{
		using std::abs;
		return std::max(std::min(abs(a - T(1)), abs(a + T(1))), abs(b));
	}
};

using DiskIsometry = BasicDiskIsometry<double>;

/// Frames and deck transformations are products of thousands of isometries, whose relative errors
/// grow with the exponential of the distance: they are computed in extended precision.
using ExtendedIsometry = BasicDiskIsometry<DoubleDouble>;

inline DiskIsometry rounded(const ExtendedIsometry& p)
{
	return {std::complex<double>(p.a), std::complex<double>(p.b)};
}

/// 2 sinh(d / 2) of the hyperbolic distance d of two points of the disk: the length of their chord in
/// the hyperboloid model. sinh(d / 2) = |z - w| / sqrt((1 - |z|^2) (1 - |w|^2))
/// [Beardon 1983, 7.2].
inline double chordLength(std::complex<double> z, std::complex<double> w)
{
	const auto gap = [](std::complex<double> p) {
		const double r = std::abs(p);
		return (1.0 - r) * (1.0 + r);
	};
	return 2.0 * std::abs(z - w) / std::sqrt(gap(z) * gap(w));
}

/// The hyperbolic distance of two points of the disk.
inline double distanceInDisk(std::complex<double> z, std::complex<double> w)
{
	return 2.0 * std::asinh(0.5 * chordLength(z, w));
}

} // namespace ricci

#endif
