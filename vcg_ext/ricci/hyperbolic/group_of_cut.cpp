// SPDX-License-Identifier: GPL-3.0-or-later
#include "group_of_cut.h"

#include "canonical_generators.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace ricci {

namespace {

/// The way round the spanning tree of the cut, which meets every side of the cut surface once.
class CutTreeWalk
{
public:
	struct Record
	{
		GroupWord word; ///< of the generators that are crossed
		/// Holonomy round each boundary loop and cone, conjugated so that their product is that of
		/// the word.
		std::vector<ExtendedIsometry> peripheral;
		std::vector<Vertex> peripheralVertex;
		double closingError = 0.0;
	};

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
			m_record.word.push_back({m_generatorOf[e], !in.isFirst()});
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
		if (!m_loop[top.node].isValid() && !m_cut.cones[top.node]) {
			m_record.closingError =
				std::max(m_record.closingError, static_cast<double>(round.distanceFromIdentity()));
			return;
		}
		m_record.peripheral.push_back(top.place * round * top.place.inverse());
		m_record.peripheralVertex.push_back(top.node);
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
	const CutTreeWalk::Record walk = CutTreeWalk(t, cut, pairing).run();

	Array<ExtendedIsometry> generators;
	for (const Edge e : cut.generators)
		generators.push_back(pairing[e].isometry());
	// The relation is the word times the inverses of the peripheral elements, last first.
	std::vector<ExtendedIsometry> peripheral(walk.peripheral.rbegin(), walk.peripheral.rend());
	ExtendedIsometry tail;
	for (ExtendedIsometry& element : peripheral) {
		element = element.inverse();
		tail = tail * element;
	}
	group.polygonError =
		static_cast<double>((productOf(walk.word, generators) * tail).distanceFromIdentity());
	group.closingError = walk.closingError;
	group.peripheral = allRounded(peripheral);
	group.peripheralVertex.assign(walk.peripheralVertex.rbegin(), walk.peripheralVertex.rend());
	if (canonical)
		addCanonicalBasis(walk.word, std::move(generators), peripheral, tail, group);
	return group;
}

} // namespace ricci
