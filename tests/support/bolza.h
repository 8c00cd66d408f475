// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_BOLZA_H
#define RICCI_TESTS_BOLZA_H

#include <ricci/cut/cut_graph.h>
#include <ricci/mesh/triangulation.h>
#include <ricci/metric/circle_packing.h>

#include <complex>
#include <functional>
#include <vector>

namespace ricci::testing {

/// The Bolza surface, of genus 2: the regular hyperbolic octagon with angles pi / 4, opposite sides
/// glued by translations along the lines through the centre. Eight triangles round the centre, each
/// divided into four by the midpoints of its sides, \p levels times. All of its geometry is known:
/// the area is 4 pi, the shortest closed geodesics have the trace 2 + 2 sqrt(2), and |trace| / 2 is
/// of the form m + n sqrt(2) for every one (Aurich and Steiner 1988).
struct BolzaSurface
{
	using Complex = std::complex<long double>;

	Triangulation triangulation;
	EdgeArray<double> lengths;    ///< hyperbolic
	HalfedgeArray<double> angles; ///< radians, at its origin
	HalfedgeArray<Complex> place; ///< of its origin, in the octagon round 0 in the disk
	CutGraph cut;                 ///< the sides of the octagon

	explicit BolzaSurface(int levels);

	/// The edges' lengths times exp((f_i + f_j) / 2): another metric, of the same conformal class up
	/// to the square of the lengths. \p f gets points of the octagon and must be well defined on
	/// the surface.
	IntrinsicMesh distorted(const std::function<double(Complex)>& f) const;

	/// Half the trace of the shortest closed geodesics, and half the distance of opposite sides.
	static double halfTrace();
	static double inradius();
};

/// Hyperbolic distance of two points of the disk.
long double distanceInDisk(BolzaSurface::Complex z, BolzaSurface::Complex w);

/// Angle at p of the geodesic triangle pqr, in [0, pi].
long double angleInDisk(BolzaSurface::Complex p, BolzaSurface::Complex q, BolzaSurface::Complex r);

} // namespace ricci::testing

#endif
