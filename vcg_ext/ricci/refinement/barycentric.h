// SPDX-License-Identifier: GPL-3.0-or-later
// Points of edges and triangles by barycentric coordinates.
//
// An affine coordinate of a point of an edge is its share: 0 at the origin of the edge's halfedge(),
// 1 at the target. Homogeneous coordinates are weights, of which only the ratio counts.
#ifndef RICCI_BARYCENTRIC_H
#define RICCI_BARYCENTRIC_H

#include "../base/tolerances.h"
#include "../mesh/triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ricci {

inline double keepInside(double share)
{
	return std::min(std::max(std::isfinite(share) ? share : 0.5, kEndGap), 1.0 - kEndGap);
}

inline double mix(double a, double b, double t)
{
	return (1.0 - t) * a + t * b;
}

/// Homogeneous coordinates of a point of an edge.
struct EdgeWeights
{
	double from = 0.0, to = 0.0; ///< weights of the edge's ends

	/// The point with \p share, in the coordinates for which over(radii).affine() is the share.
	static EdgeWeights ofShare(double share, double fromRadius, double toRadius)
	{
		return {(1.0 - share) * fromRadius, share * toRadius};
	}

	/// From coordinates in the basis of the ends' unit vectors of R^{2,1}, which belong to their
	/// circles, to those in the basis of the points themselves.
	EdgeWeights over(double fromRadius, double toRadius) const
	{
		return {from / fromRadius, to / toRadius};
	}
	/// The same point, the edge seen from its other end.
	EdgeWeights reversed() const { return {to, from}; }

	double sum() const { return from + to; }
	double affine() const { return to / (from + to); }
};

inline double determinant(const EdgeWeights& a, const EdgeWeights& b)
{
	return a.from * b.to - a.to * b.from;
}

/// Affine coordinates of a point of a triangle, in the order of its halfedges().
using FaceWeights = std::array<double, 3>;

/// The point of halfedge \p h of \p t with \p share, counted from the origin of \p h, in the triangle
/// on its left.
/// \pre \p h is not exterior
inline FaceWeights pointOnSide(const Triangulation& t, Halfedge h, double share)
{
	FaceWeights p{0, 0, 0};
	const std::size_t k = t.corner(h).index();
	p[k] = 1.0 - share;
	p[(k + 1) % 3] = share;
	return p;
}

} // namespace ricci

#endif
