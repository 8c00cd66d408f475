// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperbolic_layout.h"

#include "../base/task.h"
#include "../metric/area.h"
#include "planar_layout.h"

namespace ricci {

namespace {

/// The triangle with most triangles between it and the cut or the boundary. Of several the one that
/// a breadth-first search from there meets last.
Face deepestFace(const Triangulation& t, const EdgeArray<char>& isCut)
{
	FaceArray<char> seen(t.faceCount(), 0);
	std::vector<Face> queue;
	const auto enter = [&](Face f) {
		if (!seen[f]) {
			seen[f] = 1;
			queue.push_back(f);
		}
	};
	for (const Halfedge h : t.interiorHalfedges())
		if (isCut[h.edge()] || t.isBoundary(h.edge()))
			enter(t.face(h));
	for (std::size_t next = 0; next < queue.size(); ++next)
		for (const Halfedge h : t.halfedges(queue[next]))
			if (!t.isExterior(h.twin()))
				enter(t.face(h.twin()));
	return queue.empty() ? Face(0) : queue.back();
}

/// The frame at the other end of an edge that looks back along it.
ExtendedIsometry turned(const ExtendedIsometry& frame, double length)
{
	return frame * ExtendedIsometry::translation(length) * ExtendedIsometry::rotation(kExtendedPi);
}

/// Moves a point of the disk to 0 along the straight line between them: that for which the weighted mean of
/// cosh(distance) to some points is least, the direction of their weighted mean on the hyperboloid
/// x0^2 - |x|^2 = 1. The identity where there is no weight, or the points are farther from each other than extended
/// precision can tell.
/// \param forPoints forPoints(add) calls add(weight, frame) for the points, each the origin of a frame
template<class ForPoints>
ExtendedIsometry meanToZero(const ForPoints& forPoints)
{
	DoubleDouble x0; // of the mean, up to the sum of the weights
	ExtendedComplex x;
	forPoints([&](double weight, const ExtendedIsometry& frame) {
		x0 += weight * (norm(frame.a) + norm(frame.b));
		x += 2 * weight * (frame.a * frame.b);
	});
	const DoubleDouble r = abs(x);
	if (!(x0 > r))
		return {};
	// The point of the disk in that direction: z = x / (x0 + sqrt(x0^2 - |x|^2)).
	return ExtendedIsometry::translationTo(x / (x0 + sqrt((x0 - r) * (x0 + r)))).inverse();
}

/// Lays out one surface.
class DiskUnfolding
{
public:
	DiskUnfolding(
		const Triangulation& t,
		const EdgeArray<double>& lengths,
		const HalfedgeArray<double>& angles,
		const EdgeArray<char>& isCut) :
			m_t(t),
			m_lengths(lengths), m_angles(angles), m_isCut(isCut), m_alongEdge(t.edgeCount())
	{
		for (const Edge e : t.edges()) {
			checkpointNowAndThen(positionOf(e));
			m_alongEdge[e] = ExtendedIsometry::translation(lengths[e]);
		}
	}

	/// The layout with \p root at 0.
	HyperbolicLayout from(Face root) const
	{
		HyperbolicLayout layout;
		layout.resize(m_t.halfedgeCount());
		place(layout, m_t.halfedge(root), ExtendedIsometry());
		std::size_t placed = 0;
		for (const Halfedge h : layoutTree(m_t, m_lengths, m_isCut, root)) {
			checkpointNowAndThen(placed++);
			place(layout, h, layout[h.twin()] * along(h) * m_turn);
		}
		return layout;
	}

	/// Moves the middle to 0. \return the triangle next to it
	Face moveMiddleToZero(HyperbolicLayout& layout) const
	{
		const ExtendedIsometry back = meanToZero([&](const auto& add) {
			for (const Face f : m_t.faces()) {
				checkpointNowAndThen(positionOf(f));
				// By the sides: what the angles are short of pi is rounding where triangles are tiny.
				const double area = hyperbolicArea(sidesOf(m_t, m_lengths, f));
				for (const Halfedge h : m_t.halfedges(f))
					add(area, layout[h]);
			}
		});
		Face nearest(0);
		DoubleDouble minSpread;
		for (const Face f : m_t.faces()) {
			checkpointNowAndThen(positionOf(f));
			DoubleDouble spread; // grows with the distances of the corners from 0
			for (const Halfedge h : m_t.halfedges(f)) {
				ExtendedIsometry& g = layout[h];
				g = (back * g).normalised();
				spread += norm(g.b);
			}
			if (f == Face(0) || spread < minSpread) {
				minSpread = spread;
				nearest = f;
			}
		}
		return nearest;
	}

private:
	double length(Halfedge h) const { return m_lengths[h.edge()]; }

	const ExtendedIsometry& along(Halfedge h) const { return m_alongEdge[h.edge()]; }

	/// Places the triangle of \p h, whose frame is known.
	void place(HyperbolicLayout& layout, Halfedge h, const ExtendedIsometry& frame) const
	{
		using Isometry = ExtendedIsometry;
		const Halfedge second = m_t.next(h), third = m_t.previous(h);
		layout[h] = frame.normalised();
		layout[second] =
			(frame * along(h) * Isometry::rotation(kExtendedPi - m_angles[second])).normalised();
		// The apex from the nearer end of the base.
		layout[third] = (length(second) < length(third)
							 ? layout[second] * along(second) *
								   Isometry::rotation(kExtendedPi - m_angles[third])
							 : layout[h] * Isometry::rotation(m_angles[h]) * along(third) * m_turn)
							.normalised();
	}

	const Triangulation& m_t;
	const EdgeArray<double>& m_lengths;
	const HalfedgeArray<double>& m_angles;
	const EdgeArray<char>& m_isCut;
	EdgeArray<ExtendedIsometry> m_alongEdge; // translations by the lengths
	const ExtendedIsometry m_turn = ExtendedIsometry::rotation(kExtendedPi);
};

} // namespace

ExtendedIsometry toMiddle(const FlatMesh& mesh, const std::vector<int>& triangles)
{
	return meanToZero([&](const auto& add) {
		for (const int f : triangles)
			for (const Point2& p : mesh.at(f))
				add(1.0, ExtendedIsometry::translationTo(asComplex(p)));
	});
}

HyperbolicLayout layOutInDisk(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const HalfedgeArray<double>& angles,
	const EdgeArray<char>& isCut)
{
	const DiskUnfolding unfolding(t, lengths, angles, isCut);
	// The first layout shows where the middle is. Only the second is exact there.
	HyperbolicLayout layout = unfolding.from(deepestFace(t, isCut));
	layout = unfolding.from(unfolding.moveMiddleToZero(layout));
	unfolding.moveMiddleToZero(layout);
	return layout;
}

void offerPairing(
	const HyperbolicLayout& layout, double length, Halfedge h, Halfedge twin, SidePairing& pairing)
{
	pairing.offer(turned(layout[h], length), layout[twin]);
}

int hyperbolicOrientation(std::complex<double> p, std::complex<double> q, std::complex<double> r)
{
	// With p moved to 0 the sides at p are straight.
	const auto seenFromP = [&](std::complex<double> z) {
		return (z - p) / (1.0 - std::conj(p) * z);
	};
	const std::complex<double> x = seenFromP(q), y = seenFromP(r);
	const double cross = x.real() * y.imag() - x.imag() * y.real();
	return cross > 0.0 ? 1 : cross < 0.0 ? -1 : 0;
}

} // namespace ricci
