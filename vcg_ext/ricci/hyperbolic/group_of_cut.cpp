// SPDX-License-Identifier: GPL-3.0-or-later
#include "group_of_cut.h"

#include "../base/numbers.h"
#include "../base/points.h"
#include "../base/task.h"
#include "../numerics/disk_isometry.h"
#include "canonical_generators.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <iterator>
#include <utility>

namespace ricci {

namespace {

/// The way round the spanning tree of the cut, which meets every side of the cut surface once.
class CutTreeWalk
{
public:
	/// The generators that are crossed, and the holonomy round each boundary loop and cone, conjugated so that their
	/// product is that of the word.
	using Record = std::pair<GroupWord, std::vector<ExtendedIsometry>>;

	CutTreeWalk(
		const Triangulation& t, const CutGraph& cut, const EdgeArray<SidePairing>& pairing) :
			m_t(t),
			m_cut(cut), m_pairing(pairing), m_generatorOf(t.edgeCount(), -1),
			m_loop(t.vertexCount())
	{
		int generator = 0;
		for (const Edge e : cut.generators)
			m_generatorOf[e] = generator++;
		for (const Halfedge first : t.boundaryLoops())
			for (const Halfedge h : t.loop(first))
				m_loop[t.origin(h)] = t.origin(first);
	}

	Record run()
	{
		const Halfedge start = startOfWalk();
		if (!start.isValid())
			return {}; // nothing is cut, nothing is open
		m_stack.push_back(
			{node(start), Edge(), Halfedge(), ExtendedIsometry(), ExtendedIsometry()});
		Halfedge h = start;
		do
			h = step(h);
		while (h != start);
		leave(m_stack.back().here);
		return std::move(m_record);
	}

private:
	/// A vertex of the cut, or a boundary loop, on the way down from the root.
	struct Visit
	{
		Vertex node;
		Edge parentEdge;
		Halfedge down;          ///< the next one to cross at the parent, on the way on
		ExtendedIsometry place; ///< of the wedge in which the node was entered
		ExtendedIsometry here;  ///< crossings since then, turning counter-clockwise round the node
	};

	/// The vertex that stands for the origin of \p h: one for all of a boundary loop.
	Vertex node(Halfedge h) const
	{
		const Vertex v = m_t.origin(h);
		return m_loop[v].isValid() ? m_loop[v] : v;
	}

	Halfedge startOfWalk() const
	{
		Halfedge loop; // all that is cut where the tree is one vertex
		for (const Halfedge h : m_t.interiorHalfedges()) {
			const Edge e = h.edge();
			if (!m_t.isBoundary(e) && !m_cut.isCut[e])
				continue;
			if (m_t.isBoundary(e) || m_generatorOf[e] < 0)
				return h;
			loop = h;
		}
		return loop;
	}

	/// From the wedge on the left of \p h, turning counter-clockwise about its origin.
	Halfedge step(Halfedge h)
	{
		const Halfedge in = m_t.previous(h), out = in.twin();
		const Edge e = in.edge();
		if (m_t.isExterior(out))
			return in; // along the boundary to its next vertex
		if (!m_cut.isCut[e])
			return out;
		Visit& top = m_stack.back();
		if (m_generatorOf[e] >= 0) {
			m_record.first.push_back({m_generatorOf[e], !in.isFirst()});
			top.here = top.here * across(in, m_pairing).isometry();
			return out;
		}
		// Along the edge to its other end.
		if (e == top.parentEdge) {
			leave(top.here * across(in, m_pairing).isometry());
			const Halfedge down = top.down;
			m_stack.pop_back();
			m_stack.back().here = m_stack.back().here * across(down, m_pairing).isometry();
		}
		else {
			const ExtendedIsometry place = top.place * top.here;
			m_stack.push_back({node(in), e, in, place, ExtendedIsometry()});
		}
		return in;
	}

	/// The way round the top node is complete.
	/// \param round the holonomy round the node
	void leave(const ExtendedIsometry& round)
	{
		const Visit& top = m_stack.back();
		if (!m_loop[top.node].isValid() && !m_cut.cones[top.node])
			return;
		m_record.second.push_back(top.place * round * top.place.inverse());
	}

	const Triangulation& m_t;
	const CutGraph& m_cut;
	const EdgeArray<SidePairing>& m_pairing;
	EdgeArray<int> m_generatorOf;
	VertexArray<Vertex> m_loop; // a vertex of the boundary loop, or none
	std::vector<Visit> m_stack;
	Record m_record;
};

std::vector<DiskIsometry> allRounded(const std::vector<ExtendedIsometry>& isometries)
{
	std::vector<DiskIsometry> result;
	std::transform(isometries.begin(), isometries.end(), std::back_inserter(result), rounded);
	return result;
}

/// Fills in what rests on the canonical basis.
/// \param generators letters of the polygon's \p word
/// \param tail product of the \p peripheral elements
void addCanonicalBasis(
	const GroupWord& word,
	Array<ExtendedIsometry> generators,
	const std::vector<ExtendedIsometry>& peripheral,
	const ExtendedIsometry& tail,
	FuchsianGroup& group)
{
	if (!generators.empty())
		closeRelation(word, tail, generators);
	const Handles handles = bestConditioned(canonicalBases(word, generators), peripheral);
	if (handles.size() != positionOf(generators.size()))
		return;
	for (std::size_t i = 0; i + 1 < handles.size(); i += 2) {
		const ExtendedIsometry &a = handles[i], &b = handles[i + 1];
		for (const ExtendedIsometry& letter : {a, b, a.inverse(), b.inverse()})
			group.relation.push_back(letter);
	}
	ExtendedIsometry product;
	for (const ExtendedIsometry& letter : group.relation)
		product = product * letter;
	group.relationError = static_cast<double>((product * tail).distanceFromIdentity());
	group.relation.insert(group.relation.end(), peripheral.begin(), peripheral.end());
	group.handles = allRounded(handles);
}

} // namespace

EdgeArray<SidePairing>
pairingOfArcs(const Triangulation& t, const CutGraph& cut, const EdgeArray<SidePairing>& pairing)
{
	EdgeArray<SidePairing> exact(t.edgeCount());
	for (const std::vector<Halfedge>& arc : seamsOf(t, cut.isCut, cut.cones)) {
		const Halfedge least =
			*std::min_element(arc.begin(), arc.end(), [&](Halfedge g, Halfedge h) {
				return pairing[g.edge()].loss < pairing[h.edge()].loss;
			});
		const SidePairing best = across(least, pairing);
		for (const Halfedge h : arc)
			exact[h.edge()] = h.isFirst() ? best : best.reversed();
	}
	return exact;
}

FuchsianGroup fuchsianGroup(
	const Triangulation& t,
	const CutGraph& cut,
	const EdgeArray<SidePairing>& pairing,
	bool canonical)
{
	FuchsianGroup group;
	for (const std::vector<Halfedge>& arc : seamsOf(t, cut.isCut, cut.cones)) {
		const ExtendedIsometry side = across(arc.front(), pairing).isometry();
		group.sides.push_back(rounded(side));
		group.sides.push_back(rounded(side.inverse()));
	}
	const auto [word, holonomies] = CutTreeWalk(t, cut, pairing).run();

	Array<ExtendedIsometry> generators;
	for (const Edge e : cut.generators)
		generators.push_back(pairing[e].isometry());
	// The relation is the word times the inverses of the peripheral elements, last first.
	std::vector<ExtendedIsometry> peripheral(holonomies.rbegin(), holonomies.rend());
	ExtendedIsometry tail;
	for (ExtendedIsometry& element : peripheral) {
		element = element.inverse();
		tail = tail * element;
	}
	group.peripheral = allRounded(peripheral);
	if (canonical)
		addCanonicalBasis(word, std::move(generators), peripheral, tail, group);
	return group;
}

namespace {

/// What remains of the way round the origin of \p first, or round the boundary loop through it, in the frame at the
/// corner of \p first, which is not exterior.
ExtendedIsometry
wayRound(const Triangulation& t, const CutGraph& cut, const SurfaceLayout& layout, Halfedge first)
{
	const auto place = [&](Halfedge h) {
		return ExtendedIsometry::translationTo(asComplex(layout.corners[h]));
	};
	ExtendedIsometry round;
	Halfedge h = first;
	do { // to the next corner, counter-clockwise; along the boundary to that of its next vertex
		const Halfedge in = t.previous(h), out = in.twin();
		const bool isAlong = t.isExterior(out);
		if (isAlong)
			round = round * (place(h).inverse() * place(in));
		else if (cut.isCut[in.edge()]) {
			const SidePairing side = across(in, layout.pairing);
			round =
				round * ((place(h).inverse() * side.left) * (side.right.inverse() * place(out)));
		}
		h = isAlong ? in : out;
	} while (h != first);
	return round;
}

/// Hyperbolic length of the edges of the boundary loop of the exterior halfedge \p first.
double loopLength(const Triangulation& t, const PlanarLayout& layout, Halfedge first)
{
	double length = 0.0;
	for (const Halfedge h : t.loop(first))
		length += distanceInDisk(asComplex(layout[h.twin()]), asComplex(layout[t.next(h.twin())]));
	return length;
}

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
	double error = 0.0;
	VertexArray<char> seen = t.boundaryVertices();
	for (const Halfedge h : t.interiorHalfedges()) {
		const Vertex v = t.origin(h);
		if (!cut.isCut[h.edge()] || seen[v])
			continue;
		seen[v] = 1;
		const ExtendedIsometry round = wayRound(t, cut, layout, h);
		const DoubleDouble missed =
			cut.cones[v]
				? abs(abs(round.trace()) - 2 * abs(turnBy(0.5 * target.curvature[v]).real()))
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
		const DoubleDouble half = 0.5 * abs(wayRound(t, cut, layout, first.twin()).trace());
		const auto sine2 = static_cast<double>((half - 1) * (half + 1));
		const double translation = 2.0 * std::asinh(std::sqrt(std::max(sine2, 0.0)));
		error = std::max(error, std::abs(translation - loopLength(t, layout.corners, first)));
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
		return distanceInDisk(asComplex(disks.at(side)), asComplex(disks.at(side.next())));
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
