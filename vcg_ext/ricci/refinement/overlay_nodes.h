// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_OVERLAY_NODES_H
#define RICCI_OVERLAY_NODES_H

#include "edge_crossings.h"
#include "overlay_pieces.h"

namespace ricci {

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
