// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_EDGE_CROSSINGS_H
#define RICCI_EDGE_CROSSINGS_H

#include "../mesh/normal_coordinates.h"
#include "overlay_pieces.h"

#include <vector>

namespace ricci {

/// Crossing of an input edge with a start edge.
struct InputCrossing
{
	Edge edge;            ///< of the input
	double onInput = 0.0; ///< share on the input edge
	double onStart = 0.0; ///< share on the start edge
};

/// Crossing of an end edge with a start edge: one vector of R^{2,1}, in the basis of the two vertices
/// of either edge.
struct EndCrossing
{
	Edge edge; ///< of the end
	EdgeWeights onStart, onEnd;
};

/// The numbers 0, 1, 2, ... divided into consecutive ranges, one for each edge.
class EdgeRanges
{
public:
	EdgeRanges() : m_first(1, 0) {}

	/// Edge e gets the next \p size(e) numbers.
	template<class Size>
	EdgeRanges(IndexRange<Edge> edges, Size size) : EdgeRanges()
	{
		m_first.reserve(positionOf(edges.size()) + 1);
		for (const Edge e : edges)
			append(size(e));
	}

	/// Adds the range of one more edge.
	void append(int size) { m_first.push_back(m_first.back() + size); }

	int first(Edge e) const { return m_first[positionOf(e)]; }
	int last(Edge e) const { return m_first[positionOf(e) + 1]; } ///< one past the range
	int size(Edge e) const { return last(e) - first(e); }
	int total() const { return m_first.back(); }

private:
	std::vector<int> m_first;
};

/// Where the edges of the input and of the end cross those of the start. Which and in what order:
/// by integers. Where: straight lines in the input's metric, and planes through the origin of
/// R^{2,1} for the conformal flips.
class EdgeCrossings
{
public:
	using Curve = NormalCoordinates::Curve;

	/// Asks requireOverlayMemory() before there is an array of crossings.
	EdgeCrossings(const Triangulation& inputTriangles, const FlowResult& flow);

	/// Number of a crossing of an input edge in inputCrossings, of an end edge in endCrossings.
	int inputNumber(const NormalCoordinates::Crossing& x) const;
	int endNumber(const NormalCoordinates::Crossing& x) const;

	const Triangulation& input;
	NormalCoordinates inputOnStart, endOnStart;
	EdgeArray<Curve> inputCurves; ///< [input edge] on the start triangulation
	EdgeArray<Curve> endCurves;   ///< [end edge] on the start triangulation
	EdgeArray<Curve> startCurves; ///< [start edge] on the end triangulation

	/// The crossings on each start edge, in order from the origin of its halfedge().
	EdgeRanges inputOn, endOn;
	Array<InputCrossing> inputCrossings;
	Array<EndCrossing> endCrossings;

private:
	void placeInputCrossings();
	void placeEndCrossings();
	template<class Real>
	bool placeOnEndEdge(Edge e);

	const FlowResult& m_flow;
	const Triangulation& m_start;
	const EdgeArray<double> m_delta; // at the start
};

/// The point with \p share of edge \p e of the input, \p t.
SurfacePoint pointOfEdge(const Triangulation& t, Edge e, double share);

/// The nodes of the overlay that lie on start edges. A crossing with an input edge and one with an end
/// edge that are closer to each other than rounding can tell are one node.
class StartEdgeNodes
{
public:
	/// Puts the crossings of both families in order on each start edge. Fills \p nodes: first the
	/// vertices, then the nodes of each start edge, each with its point on the input and on the end.
	StartEdgeNodes(
		const FlowResult& flow, const EdgeCrossings& crossings, Array<OverlayNode>& nodes);

	/// Nodes on a start edge, without its ends.
	int count(Edge e) const { return m_on.size(e); }

	/// The index of a node on a start edge counts from the origin of a halfedge. From that of the
	/// edge's halfedge() to that of \p h, or back:
	int index(Halfedge h, int fromEdge) const
	{
		return h.isFirst() ? fromEdge : count(h.edge()) - 1 - fromEdge;
	}

	/// Number of a node, by its index from the origin of \p h.
	int node(Halfedge h, int index) const { return m_vertexCount + slot(h, index); }

	/// Its share, counted from the origin of \p h too.
	double share(Halfedge h, int index) const
	{
		const double fromEdge = m_share[slot(h, index)];
		return h.isFirst() ? fromEdge : 1.0 - fromEdge;
	}

	/// Index, from the origin of the edge's halfedge(), of the node that a crossing is or is part of.
	int indexOfInput(int crossing) const { return m_indexOfInput[crossing]; }
	int indexOfEnd(int crossing) const { return m_indexOfEnd[crossing]; }

private:
	int slot(Halfedge h, int i) const { return m_on.first(h.edge()) + index(h, i); }

	int m_vertexCount;
	EdgeRanges m_on;
	Array<double> m_share;                   // [node less m_vertexCount]
	Array<int> m_indexOfInput, m_indexOfEnd; // [crossing]
};

} // namespace ricci

#endif
