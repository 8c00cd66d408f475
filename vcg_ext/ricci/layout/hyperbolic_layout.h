// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_HYPERBOLIC_LAYOUT_H
#define RICCI_HYPERBOLIC_LAYOUT_H

#include "../base/numbers.h"
#include "../mesh/triangulation.h"
#include "../numerics/disk_isometry.h"
#include "flat_mesh.h"

#include <complex>
#include <vector>

namespace ricci {

/// A metric of curvature -1 laid out in the Poincaré disk (paper 4.3): the frame at each halfedge's origin, the
/// corner of its triangle, that looks along it, as seen from the triangle on its left; without meaning for
/// exterior halfedges. Two frames of one triangle always fit together; those on both sides of an edge off the
/// cut fit to rounding.
using HyperbolicLayout = HalfedgeArray<ExtendedIsometry>;

/// Lays the triangles out one after another across the edges with isCut 0, which must leave the
/// surface connected and simply connected. Counter-clockwise triangles stay counter-clockwise.
///
/// Places are carried as frames in SU(1,1), which keep a direction as exactly as a position. All
/// coordinates in the disk lose digits like the exponential of the distance from 0, so the layout
/// starts from a triangle near the middle, and the middle is moved to 0. The middle is the point
/// for which the mean of cosh(distance) over the surface is least: the direction of the
/// area-weighted mean of the surface's points on the hyperboloid.
/// \param lengths hyperbolic
/// \param angles radians, at the halfedge's origin
HyperbolicLayout layOutInDisk(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const HalfedgeArray<double>& angles,
	const EdgeArray<char>& isCut);

/// The isometry that continues a layout across an edge of its cut: it takes the layout of the
/// triangle on the right of the edge's halfedge to where the triangle on the left would have it.
/// Several places along the edge may offer it: the one that loses least to rounding is kept.
struct SidePairing
{
	/// Frames of one place of the surface as seen from both sides of the cut.
	ExtendedIsometry left, right;

	/// About how many units of rounding the isometry may be wrong by: the sum of |a|^2 =
	/// cosh^2(d / 2) over the two frames, where d is the frame's distance from 0. Products of
	/// frames lose digits like the exponential of these distances. Infinite while nothing has been
	/// offered.
	double loss = kInfinity;

	ExtendedIsometry isometry() const { return (left * right.inverse()).normalised(); }

	/// The same, from the right to the left.
	SidePairing reversed() const { return {right, left, loss}; }

	/// Takes two frames if they are more exact than what is known.
	void offer(const ExtendedIsometry& onLeft, const ExtendedIsometry& onRight)
	{
		const auto lost = static_cast<double>(norm(onLeft.a) + norm(onRight.a));
		if (lost < loss) {
			loss = lost;
			left = onLeft;
			right = onRight;
		}
	}
};

/// The side pairing where \p h is crossed from its left.
/// \param pairing [edge] known on the cut
inline SidePairing across(Halfedge h, const EdgeArray<SidePairing>& pairing)
{
	return h.isFirst() ? pairing[h.edge()] : pairing[h.edge()].reversed();
}

/// Offers \p pairing two frames of one place on an edge of the cut: that of the halfedge \p h, on
/// the left of the cut, turned round at the other end of the edge; and that of \p twin, which is
/// the same edge seen from the right.
/// \param length of the edge, hyperbolic
void offerPairing(
	const HyperbolicLayout& layout, double length, Halfedge h, Halfedge twin, SidePairing& pairing);

/// The image of a point of the disk.
inline Point2 moved(const ExtendedIsometry& isometry, const Point2& p)
{
	return asPoint(std::complex<double>(isometry(asComplex(p))));
}

/// Moves the middle of the corners of some triangles in the disk to 0.
ExtendedIsometry toMiddle(const FlatMesh& mesh, const std::vector<int>& triangles);

/// +1 if the geodesic triangle of the three points of the disk is counter-clockwise, -1 if it is
/// clockwise, 0 if rounding cannot tell.
int hyperbolicOrientation(std::complex<double> p, std::complex<double> q, std::complex<double> r);

} // namespace ricci

#endif
