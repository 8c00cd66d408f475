// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_MOVABLE_POINTS_H
#define RICCI_MOVABLE_POINTS_H

#include "../layout/planar_layout.h"

#include <complex>

namespace ricci {

/// The points of a layout that may move so that its cone angles and holonomy stay what they are.
///
/// A point inside the chart moves freely. The two copies of a seam vertex move together: the second
/// one is the image of the first under the transition of the seam, z -> turn z + shift with
/// |turn| = 1, so that the two sides of the seam stay isometric. Cones, the vertices where several
/// seams meet or where one ends, and boundary points that a seam touches stay.
///
/// Points are numbered: the unknowns, which move freely, then the images, then those that stay. The
/// unknowns follow a walk over the surface, breadth first from its point farthest from the middle of
/// the layout, and at every vertex to the farthest neighbours first: what takes them one after another
/// does not depend on the numbers of the mesh, and finds neighbours near in memory.
struct MovablePoints
{
	Array<int> number; ///< [wedge of the layout] of its point
	int unknowns = 0;

	/// An image lies where \p source, one of the unknowns, is taken by the transition of its seam.
	struct Image
	{
		int source;
		std::complex<double> turn; ///< of absolute value 1
	};
	std::vector<Image> images; ///< [number of the point - unknowns]

	int moving() const { return unknowns + static_cast<int>(images.size()); }

	/// The unknown that moves the point, or -1.
	int unknownOf(int point) const
	{
		return point < unknowns ? point : point < moving() ? imageOf(point).source : -1;
	}
	/// The derivative of the point by its unknown.
	std::complex<double> turnOf(int point) const
	{
		return point < unknowns ? 1.0 : imageOf(point).turn;
	}

private:
	const Image& imageOf(int point) const { return images[positionOf(point - unknowns)]; }
};

/// Finds them. All seam vertices between two ends of a seam share one transition, that which fits
/// the two sides of the seam best. Where nothing stays, two points far from each other do, which
/// takes away the similarities of the plane.
/// \param cones 1 at cones inside
/// \param boundaryMoves whether boundary points move freely that no seam touches
MovablePoints movablePoints(
	const Triangulation& t,
	const EdgeArray<char>& isCut,
	const VertexArray<char>& cones,
	bool boundaryMoves,
	const PlanarLayout& layout);

} // namespace ricci

#endif
