// SPDX-License-Identifier: GPL-3.0-or-later
#include "closing_error.h"

#include "../base/numbers.h"
#include "../base/points.h"
#include "../base/task.h"
#include "../numerics/disk_isometry.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace ricci {

namespace {

/// The ways round the vertices and the boundary loops.
class WaysRound
{
public:
	WaysRound(const Triangulation& t, const CutGraph& cut, const SurfaceLayout& layout) :
			m_t(t), m_cut(cut), m_pairing(layout.pairing), m_layout(layout.corners)
	{
	}

	/// What remains of the way round the origin of \p first, or round the boundary loop through it, in
	/// the frame at the corner of \p first. No exterior halfedge.
	ExtendedIsometry from(Halfedge first) const
	{
		ExtendedIsometry round;
		Halfedge h = first;
		do
			h = step(h, round);
		while (h != first);
		return round;
	}

	/// Hyperbolic length of the edges of the boundary loop of the exterior halfedge \p first.
	double lengthFrom(Halfedge first) const
	{
		double length = 0.0;
		for (const Halfedge h : m_t.loop(first)) {
			const Halfedge inside = h.twin();
			const double chord =
				chordLength(asComplex(m_layout[inside]), asComplex(m_layout[m_t.next(inside)]));
			length += 2.0 * std::asinh(0.5 * chord);
		}
		return length;
	}

private:
	ExtendedIsometry place(Halfedge h) const
	{
		return ExtendedIsometry::translationTo(asComplex(m_layout[h]));
	}

	/// To the next corner, counter-clockwise; along the boundary to that of its next vertex.
	Halfedge step(Halfedge h, ExtendedIsometry& round) const
	{
		const Halfedge in = m_t.previous(h), out = in.twin();
		if (m_t.isExterior(out)) {
			round = round * (place(h).inverse() * place(in));
			return in;
		}
		if (m_cut.isCut[in.edge()]) {
			const SidePairing side = across(in, m_pairing);
			round =
				round * ((place(h).inverse() * side.left) * (side.right.inverse() * place(out)));
		}
		return out;
	}

	const Triangulation& m_t;
	const CutGraph& m_cut;
	const EdgeArray<SidePairing>& m_pairing;
	const PlanarLayout& m_layout;
};

bool isGeodesic(const std::vector<Vertex>& loop, const Target& target)
{
	return std::all_of(loop.begin(), loop.end(), [&](Vertex v) {
		return !target.fixed[v] && target.curvature[v] == 0.0;
	});
}

} // namespace

double closingError(
	const Triangulation& t, const CutGraph& cut, const SurfaceLayout& layout, const Target& target)
{
	const WaysRound ways(t, cut, layout);
	double error = 0.0;
	VertexArray<char> seen = t.boundaryVertices();
	for (const Halfedge h : t.interiorHalfedges()) {
		const Vertex v = t.origin(h);
		if (!cut.isCut[h.edge()] || seen[v])
			continue;
		seen[v] = 1;
		const ExtendedIsometry round = ways.from(h);
		const DoubleDouble missed =
			cut.cones[v]
				? abs(abs(round.trace()) - 2 * abs(sineAndCosine(0.5 * target.curvature[v]).cosine))
				: 2 * round.distanceFromIdentity();
		error = std::max(error, static_cast<double>(missed));
	}
	for (const Halfedge first : t.boundaryLoops()) {
		std::vector<Vertex> loop;
		for (const Halfedge h : t.loop(first))
			loop.push_back(t.origin(h));
		if (!isGeodesic(loop, target))
			continue;
		// The trace is 2 cosh(L / 2).
		const DoubleDouble half = 0.5 * abs(ways.from(first.twin()).trace());
		const auto sine2 = static_cast<double>((half - 1) * (half + 1));
		const double translation = 2.0 * std::asinh(std::sqrt(std::max(sine2, 0.0)));
		error = std::max(error, std::abs(translation - ways.lengthFrom(first)));
	}
	return error;
}

double closingError(const FlatMesh& disks, const std::vector<double>& curvature)
{
	struct Star
	{
		double angle = 0.0, shortest = kInfinity;
		bool isOnSeam = false, isOnBoundary = false;
	};
	std::vector<Star> stars(positionOf(disks.vertexCount()));
	const auto length = [&](Corner side) {
		return 2.0 *
			   std::asinh(
				   0.5 * chordLength(asComplex(disks.at(side)), asComplex(disks.at(side.next()))));
	};
	double error = 0.0;
	for (const int f : disks.points.indices()) {
		checkpointNowAndThen(positionOf(f));
		for (const Corner c : cornersOf(f)) {
			const double own = length(c);
			const std::complex<double> p = asComplex(disks.at(c));
			const auto seen = [&](Corner end) {
				const std::complex<double> z = asComplex(disks.at(end));
				return (z - p) / (1.0 - std::conj(p) * z);
			};
			Star& star = stars[positionOf(disks.vertices[c])];
			star.angle += std::arg(seen(c.previous()) * std::conj(seen(c.next())));
			for (const Corner end : {c, c.next()}) {
				Star& at = stars[positionOf(disks.vertices[end])];
				const Corner other = disks.across[c];
				at.shortest = std::min(at.shortest, own);
				at.isOnBoundary = at.isOnBoundary || !other.isValid();
				at.isOnSeam = at.isOnSeam || !disks.joined(c).isValid();
			}
			if (const Corner other = disks.across[c]; other > c && !disks.joined(c).isValid())
				error = std::max(error, std::abs(own - length(other)));
		}
	}
	for (std::size_t v = 0; v < stars.size(); ++v)
		if (stars[v].isOnSeam && !stars[v].isOnBoundary) {
			const double wanted = 2.0 * kPi - (v < curvature.size() ? curvature[v] : 0.0);
			error = std::max(
				error,
				std::abs(std::remainder(stars[v].angle - wanted, 2.0 * kPi)) * stars[v].shortest);
		}
	return error;
}

} // namespace ricci
