// SPDX-License-Identifier: GPL-3.0-or-later
#include "edge_crossings.h"

#include "../base/numbers.h"
#include "../base/tolerances.h"
#include "../metric/geometry.h"

#include <algorithm>

namespace ricci {

namespace {

/// A node of a start edge: a crossing of one family, or one of each.
struct NodeOnEdge
{
	double share = 0.0;
	int input = -1, end = -1; // numbers of the crossings
};

/// The nodes of one start edge, from the origin of its halfedge().
using EdgeNodes = Array<NodeOnEdge>;

/// Radius of each vertex on the end as the geometry's length function sees it. A vertex is a unit
/// vector of R^{2,1}: the point of the plane over its radius, or the point of the hyperboloid over
/// the sinh of its radius.
VertexArray<double> radiiAtEnd(const FlowResult& flow)
{
	VertexArray<double> radius(flow.u.size());
	for (const Vertex v : radius.indices())
		radius[v] = flow.target.background == Background::EuclideanPlane
						? Euclidean::circle(flow.u[v]).s
						: Hyperbolic::circle(flow.u[v]).s;
	return radius;
}

/// Affine combination of two points, equal vertices merged.
SurfacePoint between(const SurfacePoint& a, const SurfacePoint& b, double t)
{
	SurfacePoint p;
	p.weight = {0, 0, 0, 0};
	std::size_t used = 0;
	const auto gather = [&](const SurfacePoint& q, double share) {
		for (std::size_t i = 0; i < 4; ++i) {
			if (q.weight[i] == 0.0)
				continue;
			std::size_t k = 0;
			while (k < used && p.vertex[k] != q.vertex[i])
				++k;
			if (k == 4)
				continue;
			if (k == used)
				p.vertex[used++] = q.vertex[i];
			p.weight[k] += share * q.weight[i];
		}
	};
	gather(a, 1.0 - t);
	gather(b, t);
	return p;
}

SurfacePoint atVertex(Vertex v)
{
	SurfacePoint p;
	p.vertex[0] = v.number();
	return p;
}

/// Where the nodes of start edge \p e are on the input: exact on input edges, straight between them.
/// \param first the first one's overlay node
void locateOnInput(
	const FlowResult& flow,
	const EdgeCrossings& crossings,
	Edge e,
	const EdgeNodes& nodes,
	OverlayNode* first)
{
	const auto ends = flow.start.mesh.triangulation.ends(e);
	const auto onInputEdge = [&](const NodeOnEdge& node) {
		const InputCrossing& x = crossings.inputCrossings[node.input];
		return pointOfEdge(crossings.input, x.edge, x.onInput);
	};
	SurfacePoint before = atVertex(ends[0]);
	double beforeShare = 0.0;
	for (int k = 0; k < nodes.size(); ++k) {
		SurfacePoint& point = first[k].point;
		if (nodes[k].input >= 0) {
			before = point = onInputEdge(nodes[k]);
			beforeShare = nodes[k].share;
			continue;
		}
		int next = k + 1;
		while (next < nodes.size() && nodes[next].input < 0)
			++next;
		const bool isLast = next == nodes.size();
		const SurfacePoint after = isLast ? atVertex(ends[1]) : onInputEdge(nodes[next]);
		const double gap = (isLast ? 1.0 : nodes[next].share) - beforeShare;
		point = between(before, after, gap > 0.0 ? (nodes[k].share - beforeShare) / gap : 0.5);
	}
}

/// Where a node is on the end: exact on end edges; between two of them straight in the homogeneous
/// coordinates of the start edge.
class EndLocator
{
public:
	EndLocator(const FlowResult& flow, const EdgeCrossings& crossings) :
			m_start(flow.start.mesh.triangulation), m_end(flow.metric->triangulation()),
			m_startRadius(flow.start.radii), m_endRadius(radiiAtEnd(flow)), m_crossings(crossings)
	{
	}

	double startRadius(Vertex v) const { return m_startRadius[v]; }

	/// Of a vertex, see OverlayNode.
	double scale(Vertex v) const { return m_startRadius[v] / m_endRadius[v]; }

	/// \p nodes are those of start edge e, \p first is the first one's overlay node.
	void locate(Edge e, const EdgeNodes& nodes, OverlayNode* first) const
	{
		const auto [i, j] = m_start.ends(e);
		const double gi = m_startRadius[i], gj = m_startRadius[j];
		const Curve& curve = m_crossings.startCurves[e];
		// Of the last crossing with an end edge, or the end of the start edge: the weight sum is in the end metric.
		EdgeWeights before{1.0, 0.0};
		double sumBefore = 1.0 / m_endRadius[i];
		int passed = 0; // end edges crossed so far
		for (int k = 0; k < nodes.size(); ++k) {
			PointOnEnd& end = first[k].end;
			if (nodes[k].end >= 0) {
				const EndCrossing& x = m_crossings.endCrossings[nodes[k].end];
				end = {PointOnEnd::OnEdge, x.edge.number(), shareOnEnd(x)};
				before = x.onStart;
				sumBefore = onEndMetric(x).sum();
				first[k].scale = sumBefore / x.onStart.over(gi, gj).sum();
				++passed;
				continue;
			}
			const EdgeWeights here = EdgeWeights::ofShare(nodes[k].share, gi, gj);
			if (curve.crossings.empty()) { // the start edge is an end edge
				const EdgeWeights onEnd = here.over(m_endRadius[i], m_endRadius[j]);
				end = {
					PointOnEnd::OnEdge,
					curve.first.edge().number(),
					keepInside(curve.first.isFirst() ? onEnd.affine() : onEnd.reversed().affine())};
				continue;
			}
			int next = k + 1;
			while (next < nodes.size() && nodes[next].end < 0)
				++next;
			EdgeWeights after{0.0, 1.0};
			double sumAfter = 1.0 / m_endRadius[j];
			if (next < nodes.size()) {
				const EndCrossing& x = m_crossings.endCrossings[nodes[next].end];
				after = x.onStart;
				sumAfter = onEndMetric(x).sum();
			}
			// here = s before + r after, in weights of the start's metric.
			const double det = determinant(before, after);
			const double s = std::max(0.0, determinant(here, after) / det) * sumBefore;
			const double r = std::max(0.0, determinant(before, here) / det) * sumAfter;
			const double share = keepInside(EdgeWeights{s, r}.affine());
			const FaceWeights from = startOfInterval(e, passed), to = endOfInterval(e, passed);
			FaceWeights weights;
			for (std::size_t c = 0; c < 3; ++c)
				weights[c] = mix(from[c], to[c], share);
			end = {PointOnEnd::InFace, faceOfInterval(e, passed).number(), 0.0, weights};
		}
	}

private:
	using Curve = EdgeCrossings::Curve;

	/// Weights of the ends of the end edge in the end metric.
	EdgeWeights onEndMetric(const EndCrossing& x) const
	{
		const auto [a, b] = m_end.ends(x.edge);
		return x.onEnd.over(m_endRadius[a], m_endRadius[b]);
	}

	double shareOnEnd(const EndCrossing& x) const { return keepInside(onEndMetric(x).affine()); }

	/// Crossing number \p index of start edge e with end edges, in the triangle on the left of end
	/// halfedge h.
	FaceWeights crossingOn(Halfedge h, Edge e, int index) const
	{
		const double share =
			shareOnEnd(m_crossings.endCrossings[m_crossings.endOn.first(e) + index]);
		return pointOnSide(m_end, h, h.isFirst() ? share : 1.0 - share);
	}

	/// The end triangle that start edge e is in after \p passed crossings.
	Face faceOfInterval(Edge e, int passed) const
	{
		const Curve& curve = m_crossings.startCurves[e];
		return m_end.face(
			passed == 0 ? curve.first : curve.crossings[positionOf(passed - 1)].halfedge.twin());
	}

	/// Where start edge e enters the end triangle that it is in after \p passed crossings.
	FaceWeights startOfInterval(Edge e, int passed) const
	{
		const Curve& curve = m_crossings.startCurves[e];
		if (passed == 0)
			return pointOnSide(m_end, curve.first, 0.0);
		const auto& x = curve.crossings[positionOf(passed - 1)];
		return crossingOn(x.halfedge.twin(), e, passed - 1);
	}

	/// Where it leaves it.
	FaceWeights endOfInterval(Edge e, int passed) const
	{
		const Curve& curve = m_crossings.startCurves[e];
		if (positionOf(passed) == curve.crossings.size())
			return pointOnSide(m_end, curve.last, 0.0);
		return crossingOn(curve.crossings[positionOf(passed)].halfedge, e, passed);
	}

	const Triangulation& m_start;
	const Triangulation& m_end;
	const VertexArray<double>& m_startRadius;
	const VertexArray<double> m_endRadius;
	const EdgeCrossings& m_crossings;
};

/// Crossings of both families on start edge ij in order, by their shares of it.
void merge(Edge e, double gi, double gj, const EdgeCrossings& crossings, EdgeNodes& nodes)
{
	nodes.clear();
	int a = crossings.inputOn.first(e), b = crossings.endOn.first(e);
	const int lastA = crossings.inputOn.last(e), lastB = crossings.endOn.last(e);
	while (a < lastA || b < lastB) {
		const double ta = a < lastA ? crossings.inputCrossings[a].onStart : kInfinity;
		const double tb = b < lastB
							  ? keepInside(crossings.endCrossings[b].onStart.over(gi, gj).affine())
							  : kInfinity;
		NodeOnEdge node;
		// Their order is known, their shares are rounded.
		node.share = std::max(std::min(ta, tb), nodes.empty() ? 0.0 : nodes.back().share);
		const bool takeA = ta <= tb + kCancelled, takeB = tb <= ta + kCancelled;
		if (takeA)
			node.input = a++;
		if (takeB)
			node.end = b++;
		nodes.push_back(node);
	}
}

} // namespace

SurfacePoint pointOfEdge(const Triangulation& t, Edge e, double share)
{
	const auto ends = t.ends(e);
	SurfacePoint p;
	p.vertex = {ends[0].number(), ends[1].number(), 0, 0};
	p.weight = {1.0 - share, share, 0.0, 0.0};
	return p;
}

StartEdgeNodes::StartEdgeNodes(
	const FlowResult& flow, const EdgeCrossings& crossings, Array<OverlayNode>& nodes)
{
	const Triangulation& start = flow.start.mesh.triangulation;
	const EndLocator end(flow, crossings);
	m_vertexCount = start.vertexCount();
	m_indexOfInput.resize(crossings.inputCrossings.size());
	m_indexOfEnd.resize(crossings.endCrossings.size());
	nodes.resize(m_vertexCount);
	for (const Vertex v : start.vertices())
		nodes[v.number()] = {atVertex(v), {PointOnEnd::AtVertex, v.number()}, end.scale(v)};
	EdgeNodes onEdge;
	for (const Edge e : start.edges()) {
		const auto [i, j] = start.ends(e);
		merge(e, end.startRadius(i), end.startRadius(j), crossings, onEdge);
		for (int k = 0; k < onEdge.size(); ++k) {
			if (onEdge[k].input >= 0)
				m_indexOfInput[onEdge[k].input] = k;
			if (onEdge[k].end >= 0)
				m_indexOfEnd[onEdge[k].end] = k;
			m_share.push_back(onEdge[k].share);
		}
		m_on.append(onEdge.size());
		const int first = nodes.size();
		nodes.resize(first + onEdge.size());
		locateOnInput(flow, crossings, e, onEdge, nodes.data() + first);
		end.locate(e, onEdge, nodes.data() + first);
	}
}

} // namespace ricci
