// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONE_WEDGES_H
#define RICCI_CONE_WEDGES_H

#include "cut_segments.h"

#include <vector>

namespace ricci {

/// Angles of the corners at cones as they will be laid out: those of the surface, scaled to the angle
/// that the cone will have. A conformal map scales them so in the limit of small triangles.
/// \param lengths of the surface
/// \param coneAngle [vertex] its total angle, radians; 0 where it does not matter
/// \return [halfedge] radians, at the halfedge's origin; 0 elsewhere
HalfedgeArray<double> coneCorners(
	const Triangulation& t, const EdgeArray<double>& lengths, const VertexArray<double>& coneAngle);

/// The wedges into which a cut divides the angles of cones. A wedge wider than 2 pi covers itself in
/// the plane, so that a sliver of its chart has to be cut off; none is wider where the cut passes
/// through cones of negative curvature instead of ending there.
class ConeWedges
{
public:
	/// \param corners from coneCorners(); empty: no wedge is too wide
	ConeWedges(
		const Triangulation& t, const CutSegments& cut, const HalfedgeArray<double>& corners);

	/// The cones with more than one wedge's angle.
	const std::vector<Vertex>& cones() const { return m_cones; }

	/// By how much the wedges at \p v are too wide, radians.
	double excess(Vertex v) const;

	/// The same of all cones together.
	double excess() const;

	/// The halfedges within the widest wedge at \p v that divide it best: both parts are narrow enough,
	/// or need as few more cuts as can be. One in the middle if there are none.
	std::vector<Halfedge> dividing(Vertex v) const;

	/// Whether the cut may lose the edge of \p h, which leaves the node \p v, with no wedge becoming
	/// too wide there.
	bool canLose(Vertex v, Halfedge h) const;

private:
	struct Wedge
	{
		double angle = 0.0;
		std::vector<Halfedge> inside; ///< clockwise
		std::vector<double> at;       ///< angle from the start of the wedge to each of these
	};
	std::vector<Wedge> wedges(Vertex v) const;

	const CutSegments& m_cut;
	const HalfedgeArray<double>& m_corners;
	std::vector<Vertex> m_cones;
	VertexArray<char> m_isWide; ///< 1 at cones()
};

} // namespace ricci

#endif
