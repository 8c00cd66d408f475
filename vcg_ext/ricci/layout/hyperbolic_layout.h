// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_HYPERBOLIC_LAYOUT_H
#define RICCI_HYPERBOLIC_LAYOUT_H

#include "../surface/triangulation.h"
#include "disk_isometry.h"

#include <complex>
#include <limits>
#include <vector>

namespace ricci {

/// A metric of curvature -1 laid out in the Poincaré disk (paper 4.3).
struct HyperbolicLayout
{
	/// [halfedge] Frame at its origin, looking along it, as seen from the triangle on its left. Two
	/// frames of one triangle always fit together; the frames at one edge do so to rounding, off
	/// the cut.
	std::vector<ExtendedIsometry> frame;

	std::complex<double> at(int h) const
	{
		return std::complex<double>(frame[static_cast<std::size_t>(h)].origin());
	}
};

/// Lays the triangles out one after another across the edges with isCut 0, which must leave the
/// surface connected and simply connected. Counter-clockwise triangles stay counter-clockwise.
///
/// Motions are carried as frames in SU(1,1), which keep a direction as exactly as a position. All
/// coordinates of the disk lose digits like the exponential of the distance from 0, so the layout
/// starts from a triangle near the middle, and the middle is moved to 0: the point whose mean of
/// cosh(distance) over the surface is least, which is the direction of the area-weighted mean of
/// the hyperboloid's points.
/// \param lengths [edge] hyperbolic
/// \param angles [halfedge] radians, at the halfedge's origin
HyperbolicLayout layOutInDisk(
	const Triangulation& t,
	const std::vector<double>& lengths,
	const std::vector<double>& angles,
	const std::vector<char>& isCut);

/// The motion that continues a layout across an edge of its cut: it takes the layout of the
/// triangle on the right of the edge's even halfedge to where the one on the left would have it.
struct Transition
{
	ExtendedIsometry motion;
	/// Units of rounding by which the motion may be wrong: products of frames lose digits like the
	/// exponential of their distance from 0.
	double loss = std::numeric_limits<double>::infinity();

	/// Keeps \p left times the inverse of \p right, two frames of one place, if it is the better
	/// one.
	void offer(const ExtendedIsometry& left, const ExtendedIsometry& right)
	{
		const auto lost = static_cast<double>(std::norm(left.a) + std::norm(right.a));
		if (lost < loss) {
			loss = lost;
			motion = (left * right.inverse()).normalised();
		}
	}
};

/// Offers the frames at halfedge \p h of the layout on its left, and of that on its right.
void offerTransition(
	const HyperbolicLayout& layout, double length, int h, int twin, Transition& transition);

/// +1 if the geodesic triangle of the three points of the disk is counter-clockwise, -1 if it is
/// clockwise, 0 if rounding cannot tell.
int hyperbolicOrientation(std::complex<double> p, std::complex<double> q, std::complex<double> r);

} // namespace ricci

#endif
