// SPDX-License-Identifier: GPL-3.0-or-later
#include "overlay_pieces.h"

#include "../error.h"
#include "../metric/euclidean.h"
#include "../metric/hyperbolic.h"
#include "../numbers.h"
#include "chord_arrangement.h"
#include "edge_crossings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace ricci {

namespace {

/// A crossing with an input edge and one with an end edge that are this near to each other on a
/// start edge, relative to its length, are one point.
constexpr double kMergeGap = 1e-12;

/// Triangles and sides of pieces in them between two calls of the listener.
constexpr std::size_t kWorkBetweenCalls = 1 << 14;

/// Affine combination of two points, merging equal vertices.
SurfacePoint between(const SurfacePoint& a, const SurfacePoint& b, double t)
{
	SurfacePoint p;
	p.weight = {0, 0, 0, 0};
	int used = 0;
	auto gather = [&](const SurfacePoint& q, double share) {
		for (std::size_t i = 0; i < 4; ++i) {
			if (q.weight[i] == 0.0)
				continue;
			int k = 0;
			while (k < used && p.vertex[at(k)] != q.vertex[i])
				++k;
			if (k == 4)
				continue;
			if (k == used)
				p.vertex[at(used++)] = q.vertex[i];
			p.weight[at(k)] += share * q.weight[i];
		}
	};
	gather(a, 1.0 - t);
	gather(b, t);
	return p;
}

/// A part of an input or end edge inside one start triangle.
struct Chord
{
	int from, to; ///< corner: halfedge with that origin; side: halfedge
	int fromIndex,
		toIndex; ///< on a side: index among its nodes from the halfedge's origin; else -1
	int curve;   ///< input or end edge; runs in the direction of its even halfedge
	double fromAlong, toAlong; ///< position on the curve
};

/// Divides start triangles by the chords of input and end edges.
class Division
{
public:
	Division(const FlippedSurface& s, const OverlayListener& listener) :
			m_s(s), m_input(*s.input), m_start(*s.start), m_end(*s.end), m_crossings(s, listener),
			m_listener(listener)
	{
		m_endRadius.resize(at(m_end.vertexCount()));
		for (int v = 0; v < m_end.vertexCount(); ++v)
			m_endRadius[at(v)] = s.background == Background::EuclideanPlane
									 ? Euclidean::circle((*s.endU)[v]).s
									 : Hyperbolic::circle((*s.endU)[v]).s;
	}

	OverlayPieces run()
	{
		makeNodes();
		collectChords();
		std::size_t unheard = 0; // work since the listener was called
		for (int f = 0; f < m_start.faceCount(); ++f) {
			const int before = m_result.sideCount;
			divide(f);
			unheard += 1 + at(m_result.sideCount - before);
			if (unheard < kWorkBetweenCalls)
				continue;
			unheard = 0;
			m_listener(
				static_cast<double>(f) / m_start.faceCount(),
				m_result.nodes.size() - at(m_start.vertexCount()));
		}
		return std::move(m_result);
	}

private:
	using Curve = NormalCoordinates::Curve;

	static constexpr std::size_t kInput = 0, kEnd = 1; // kinds of chords

	double startRadius(int v) const { return (*m_s.startRadii)[at(v)]; }

	/// Weight of an end vertex: its vector in R^{2,1} is the point of the plane over its radius
	/// (Euclidean), or the point of the hyperboloid over the sinh of its radius.
	double endRadius(int v) const { return m_endRadius[at(v)]; }

	/// Position of a homogeneous point on a start or end edge, from the origin of the even
	/// halfedge.
	static double along(const std::array<double, 2>& w, double gi, double gj)
	{
		const double a = w[0] / gi, b = w[1] / gj;
		return b / (a + b);
	}

	using Node = OverlayNode;

	/// Puts the crossings of both kinds in order on each start edge and makes them nodes.
	void makeNodes()
	{
		const int n = m_start.edgeCount();
		m_result.nodes.resize(at(m_start.vertexCount()));
		for (int v = 0; v < m_start.vertexCount(); ++v) {
			m_result.nodes[at(v)].point.vertex[0] = v;
			m_result.nodes[at(v)].end.element = v;
			m_result.nodes[at(v)].scale = startRadius(v) / endRadius(v);
		}
		m_firstOnEdge.assign(at(n) + 1, 0);
		m_indexOfInput.resize(m_crossings.inputPoints.size());
		m_indexOfEnd.resize(m_crossings.endPoints.size());
		for (int e = 0; e < n; ++e) {
			makeNodesOn(e);
			m_firstOnEdge[at(e) + 1] = static_cast<int>(m_onEdge.size());
		}
	}

	/// A point of a start edge on which something crosses.
	struct EdgePoint
	{
		double along;
		int input = -1, end = -1; // slots
	};

	void makeNodesOn(int e)
	{
		const int i = m_start.origin(2 * e), j = m_start.target(2 * e);
		const double gi = startRadius(i), gj = startRadius(j);
		m_edgePoints.clear();
		int a = m_crossings.firstInput[at(e)], b = m_crossings.firstEnd[at(e)];
		while (a < m_crossings.firstInput[at(e) + 1] || b < m_crossings.firstEnd[at(e) + 1]) {
			const double none = std::numeric_limits<double>::infinity();
			const double ta = a < m_crossings.firstInput[at(e) + 1]
								  ? m_crossings.inputPoints[at(a)].onStart
								  : none;
			const double tb = b < m_crossings.firstEnd[at(e) + 1]
								  ? keepInside(along(m_crossings.endPoints[at(b)].onStart, gi, gj))
								  : none;
			EdgePoint p;
			p.along = std::min(ta, tb);
			const bool takeA = ta <= tb + kMergeGap, takeB = tb <= ta + kMergeGap;
			if (takeA)
				p.input = a++;
			if (takeB)
				p.end = b++;
			m_edgePoints.push_back(p);
		}
		const int base = static_cast<int>(m_onEdge.size());
		for (std::size_t k = 0; k < m_edgePoints.size(); ++k) {
			const EdgePoint& p = m_edgePoints[k];
			if (p.input >= 0)
				m_indexOfInput[at(p.input)] = static_cast<int>(k);
			if (p.end >= 0)
				m_indexOfEnd[at(p.end)] = static_cast<int>(k);
			m_onEdge.push_back(static_cast<int>(m_result.nodes.size()) + static_cast<int>(k));
			m_alongEdge.push_back(p.along);
		}
		m_result.nodes.resize(m_result.nodes.size() + m_edgePoints.size());
		locateOnInput(e, base);
		locateOnEnd(e, base, gi, gj);
	}

	/// Fills SurfacePoint of the nodes of start edge e: exact on input edges, straight between
	/// them.
	void locateOnInput(int e, int base)
	{
		const int count = static_cast<int>(m_edgePoints.size());
		SurfacePoint before, after;
		before.vertex[0] = m_start.origin(2 * e);
		double beforeAlong = 0.0;
		for (int k = 0; k < count; ++k) {
			Node& node = m_result.nodes[at(m_onEdge[at(base + k)])];
			if (m_edgePoints[at(k)].input >= 0) {
				node.point = onInputEdge(m_crossings.inputPoints[at(m_edgePoints[at(k)].input)]);
				before = node.point;
				beforeAlong = m_edgePoints[at(k)].along;
				continue;
			}
			int next = k + 1;
			while (next < count && m_edgePoints[at(next)].input < 0)
				++next;
			double afterAlong = 1.0;
			after = SurfacePoint();
			after.vertex[0] = m_start.target(2 * e);
			if (next < count) {
				after = onInputEdge(m_crossings.inputPoints[at(m_edgePoints[at(next)].input)]);
				afterAlong = m_edgePoints[at(next)].along;
			}
			const double gap = afterAlong - beforeAlong;
			node.point = between(
				before, after, gap > 0.0 ? (m_edgePoints[at(k)].along - beforeAlong) / gap : 0.5);
		}
	}

	SurfacePoint onInputEdge(const InputPoint& p) const
	{
		SurfacePoint x;
		x.vertex = {m_input.origin(2 * p.curve), m_input.target(2 * p.curve), 0, 0};
		x.weight = {1.0 - p.along, p.along, 0.0, 0.0};
		return x;
	}

	/// Fills EndPlace of the nodes of start edge e: on end edges, also scale, or between two of them.
	void locateOnEnd(int e, int base, double gi, double gj)
	{
		const int count = static_cast<int>(m_edgePoints.size());
		const Curve& way = m_crossings.startCurves[at(e)];
		std::array<double, 2> before{1.0, 0.0};
		double beforeSum = 1.0 / endRadius(m_start.origin(2 * e));
		int passed = 0; // end edges crossed so far
		for (int k = 0; k < count; ++k) {
			Node& node = m_result.nodes[at(m_onEdge[at(base + k)])];
			const double t = m_edgePoints[at(k)].along;
			std::array<double, 2> here{(1.0 - t) * gi, t * gj};
			if (m_edgePoints[at(k)].end >= 0) {
				const HomogeneousPoint& p = m_crossings.endPoints[at(m_edgePoints[at(k)].end)];
				const double ga = endRadius(m_end.origin(2 * p.curve));
				const double gb = endRadius(m_end.target(2 * p.curve));
				node.end.kind = EndPlace::Edge;
				node.end.element = p.curve;
				node.end.along = keepInside(along(p.onEnd, ga, gb));
				before = p.onStart;
				beforeSum = p.onEnd[0] / ga + p.onEnd[1] / gb;
				node.scale = beforeSum / (p.onStart[0] / gi + p.onStart[1] / gj);
				++passed;
				continue;
			}
			if (way.crossings.empty()) { // the start edge is an end edge
				const int c = Triangulation::edge(way.first);
				const double ea = here[0] / endRadius(m_start.origin(2 * e));
				const double eb = here[1] / endRadius(m_start.target(2 * e));
				node.end.kind = EndPlace::Edge;
				node.end.element = c;
				node.end.along = keepInside(way.first % 2 == 0 ? eb / (ea + eb) : ea / (ea + eb));
				continue;
			}
			int next = k + 1;
			while (next < count && m_edgePoints[at(next)].end < 0)
				++next;
			std::array<double, 2> after{0.0, 1.0};
			double afterSum = 1.0 / endRadius(m_start.target(2 * e));
			if (next < count) {
				const HomogeneousPoint& p = m_crossings.endPoints[at(m_edgePoints[at(next)].end)];
				after = p.onStart;
				afterSum = p.onEnd[0] / endRadius(m_end.origin(2 * p.curve)) +
						   p.onEnd[1] / endRadius(m_end.target(2 * p.curve));
			}
			// here = s before + r after.
			const double det = before[0] * after[1] - before[1] * after[0];
			const double s =
				std::max(0.0, (here[0] * after[1] - here[1] * after[0]) / det) * beforeSum;
			const double r =
				std::max(0.0, (before[0] * here[1] - before[1] * here[0]) / det) * afterSum;
			const double share = keepInside(r / (s + r));
			node.end.kind = EndPlace::Face;
			const auto from = startOfInterval(way, passed, e);
			const auto to = endOfInterval(way, passed, e);
			node.end.element = from.face;
			for (std::size_t c = 0; c < 3; ++c)
				node.end.corner[c] = mix(from.weight[c], to.weight[c], share);
		}
	}

	/// The end point of a start edge's way that is number \p index of its crossings, seen from
	/// halfedge g of the end triangulation.
	InFace crossingOn(int g, int index, int e) const
	{
		const HomogeneousPoint& p = m_crossings.endPoints[at(m_crossings.firstEnd[at(e)] + index)];
		const double x = keepInside(along(
			p.onEnd, endRadius(m_end.origin(2 * p.curve)), endRadius(m_end.target(2 * p.curve))));
		return pointOnSide(m_end, g, g % 2 == 0 ? x : 1.0 - x);
	}

	InFace startOfInterval(const Curve& way, int passed, int e) const
	{
		if (passed == 0)
			return pointOnSide(m_end, way.first, 0.0);
		return crossingOn(
			Triangulation::twin(way.crossings[at(passed - 1)].halfedge), passed - 1, e);
	}

	InFace endOfInterval(const Curve& way, int passed, int e) const
	{
		if (passed == static_cast<int>(way.crossings.size()))
			return pointOnSide(m_end, way.last, 0.0);
		return crossingOn(way.crossings[at(passed)].halfedge, passed, e);
	}

	int countOn(int e) const { return m_firstOnEdge[at(e) + 1] - m_firstOnEdge[at(e)]; }

	/// Index of a node of a side counted from the origin of halfedge h.
	int indexFrom(int h, int index) const
	{
		return h % 2 == 0 ? index : countOn(Triangulation::edge(h)) - 1 - index;
	}

	int nodeOn(int h, int index) const
	{
		return m_onEdge[at(m_firstOnEdge[at(Triangulation::edge(h))] + indexFrom(h, index))];
	}

	double alongOn(int h, int index) const
	{
		const double t =
			m_alongEdge[at(m_firstOnEdge[at(Triangulation::edge(h))] + indexFrom(h, index))];
		return h % 2 == 0 ? t : 1.0 - t;
	}

	/// The chords of both kinds, by start triangle.
	void collectChords()
	{
		collectChords(m_crossings.inputCurves, kInput);
		collectChords(m_crossings.endCurves, kEnd);
		// Sides on start edges come first among the names of sides.
		m_firstSide.assign(at(m_start.edgeCount()) + 1, 0);
		for (int e = 0; e < m_start.edgeCount(); ++e)
			m_firstSide[at(e) + 1] = m_firstSide[at(e)] + countOn(e) + 1;
		m_result.sideCount = m_firstSide.back();
	}

	void collectChords(const std::vector<Curve>& curves, std::size_t kind)
	{
		std::vector<int>& first = m_firstChord[kind];
		first.assign(at(m_start.faceCount()) + 1, 0);
		for (const Curve& curve : curves) {
			if (curve.crossings.empty())
				continue;
			for (const auto& x : curve.crossings)
				++first[at(m_start.face(x.halfedge)) + 1];
			++first[at(m_start.face(curve.last)) + 1];
		}
		std::partial_sum(first.begin(), first.end(), first.begin());
		m_chords[kind].resize(at(first.back()));
		std::vector<int> fill(first.begin(), first.end() - 1);
		const auto add = [&](const Chord& chord, int face) {
			m_chords[kind][at(fill[at(face)]++)] = chord;
		};
		for (std::size_t c = 0; c < curves.size(); ++c) {
			const Curve& curve = curves[c];
			if (curve.crossings.empty())
				continue;
			Chord chord;
			chord.curve = static_cast<int>(c);
			chord.from = curve.first;
			chord.fromIndex = -1;
			chord.fromAlong = 0.0;
			for (const auto& x : curve.crossings) {
				const int slot = kind == kInput ? m_crossings.inputSlot(x) : m_crossings.endSlot(x);
				const int index =
					kind == kInput ? m_indexOfInput[at(slot)] : m_indexOfEnd[at(slot)];
				chord.to = x.halfedge;
				chord.toIndex = indexFrom(x.halfedge, index);
				chord.toAlong =
					kind == kInput
						? m_crossings.inputPoints[at(slot)].along
						: m_result.nodes[at(nodeOn(x.halfedge, chord.toIndex))].end.along;
				add(chord, m_start.face(x.halfedge));
				chord.from = Triangulation::twin(x.halfedge);
				chord.fromIndex = indexFrom(chord.from, index);
				chord.fromAlong = chord.toAlong;
			}
			chord.to = curve.last;
			chord.toIndex = -1;
			chord.toAlong = 1.0;
			add(chord, m_start.face(chord.from));
		}
	}

	/// Input halfedge that start halfedge h coincides with, or -1; likewise for the end.
	int inputAlong(int h) const
	{
		return m_crossings.inputOnStart.isCurve(Triangulation::edge(h))
				   ? m_crossings.inputOnStart.originalAtOrBefore(h)
				   : -1;
	}

	int endAlong(int h) const
	{
		return m_crossings.endOnStart.isCurve(Triangulation::edge(h))
				   ? m_crossings.endOnStart.originalAtOrBefore(h)
				   : -1;
	}

	/// Divides start triangle f by its chords.
	void divide(int f)
	{
		const auto h = m_start.halfedges(f);
		m_cornerPlace[0] = 0;
		for (std::size_t k = 0; k < 3; ++k)
			m_cornerPlace[k + 1] = m_cornerPlace[k] + 1 + countOn(Triangulation::edge(h[k]));
		m_border.clear();
		for (std::size_t k = 0; k < 3; ++k) {
			const int e = Triangulation::edge(h[k]), count = countOn(e);
			PieceCorner c;
			c.input = inputAlong(h[k]);
			c.end = endAlong(h[k]);
			for (int i = -1; i < count; ++i) {
				c.node = i < 0 ? m_start.origin(h[k]) : nodeOn(h[k], i);
				c.side = m_firstSide[at(e)] + (h[k] % 2 == 0 ? i + 1 : count - 1 - i);
				m_border.push_back(c);
			}
		}
		for (std::size_t kind : {kInput, kEnd}) {
			m_places[kind].clear();
			for (int c = m_firstChord[kind][at(f)]; c < m_firstChord[kind][at(f) + 1]; ++c) {
				const Chord& chord = m_chords[kind][at(c)];
				m_places[kind].push_back(
					{placeOf(h, chord.from, chord.fromIndex), placeOf(h, chord.to, chord.toIndex)});
			}
		}
		m_arrangement.divide(m_cornerPlace[3], m_places[kInput], m_places[kEnd]);
		const int firstNode = static_cast<int>(m_result.nodes.size());
		for (const ChordArrangement::Crossing& x : m_arrangement.crossings())
			makeNodeAt(x, f);
		nameCorners(f);
		const int firstSide = m_result.sideCount;
		m_result.sideCount += m_arrangement.segmentCount();
		for (int face = 0; face < m_arrangement.faceCount(); ++face) {
			m_result.startPiece();
			for (int i = m_arrangement.firstSide(face); i < m_arrangement.firstSide(face + 1); ++i)
				m_result.append(cornerAt(m_arrangement.side(i), f, firstNode, firstSide));
		}
	}

	int placeOf(const std::array<int, 3>& sides, int halfedge, int index) const
	{
		for (std::size_t k = 0; k < 3; ++k)
			if (sides[k] == halfedge)
				return m_cornerPlace[k] + 1 + index; // a corner has index -1
		throw Error(kInconsistentOverlay);
	}

	const Chord& chordOf(const ChordArrangement::Line& line, std::size_t kind, int f) const
	{
		return m_chords[kind][at(m_firstChord[kind][at(f)] + line.chord[kind])];
	}

	PieceCorner
	cornerAt(const ChordArrangement::Side& side, int f, int firstNode, int firstSide) const
	{
		const int places = m_cornerPlace[3];
		PieceCorner c;
		if (side.line < 0)
			c = m_border[at(side.node)];
		else {
			const ChordArrangement::Line& line = m_arrangement.line(side.line);
			c.node =
				side.node < places ? m_border[at(side.node)].node : firstNode + side.node - places;
			c.side = firstSide + side.name - places;
			if (line.chord[kInput] >= 0)
				c.input = 2 * chordOf(line, kInput, f).curve + (side.forward ? 0 : 1);
			if (line.chord[kEnd] >= 0) {
				const bool reversed = line.chord[kInput] >= 0 && line.secondReversed;
				c.end = 2 * chordOf(line, kEnd, f).curve + (side.forward != reversed ? 0 : 1);
			}
		}
		for (std::size_t k = 0; k < 3; ++k)
			if (side.node == m_cornerPlace[k]) {
				const auto& names = m_cornerNames[k][at(m_arrangement.rank(side) + 1)];
				c.inputCorner = names[kInput];
				c.endCorner = names[kEnd];
			}
		return c;
	}

	/// The node where an end edge's chord crosses an input edge's chord.
	void makeNodeAt(const ChordArrangement::Crossing& crossing, int f)
	{
		const Chord& a = chordOf(m_arrangement.line(crossing.first), kInput, f);
		const Chord& b = chordOf(m_arrangement.line(crossing.second), kEnd, f);
		const Point2 p = pointOf(f, a.from, a.fromIndex), q = pointOf(f, a.to, a.toIndex);
		const Point2 r = pointOf(f, b.from, b.fromIndex), s = pointOf(f, b.to, b.toIndex);
		const auto cross = [](const Point2& o, const Point2& x, const Point2& y) {
			return (x[0] - o[0]) * (y[1] - o[1]) - (x[1] - o[1]) * (y[0] - o[0]);
		};
		const double onA = keepInside(cross(r, s, p) / (cross(r, s, p) - cross(r, s, q)));
		const double onB = keepInside(cross(p, q, r) / (cross(p, q, r) - cross(p, q, s)));

		Node node;
		InputPoint x;
		x.curve = a.curve;
		x.along = mix(a.fromAlong, a.toAlong, onA);
		node.point = onInputEdge(x);
		const double w0 = (1.0 - onB) * m_result.nodes[at(nodeAt(b.from, b.fromIndex))].scale;
		const double w1 = onB * m_result.nodes[at(nodeAt(b.to, b.toIndex))].scale;
		node.end.kind = EndPlace::Edge;
		node.end.element = b.curve;
		node.end.along = keepInside(mix(b.fromAlong, b.toAlong, w1 / (w0 + w1)));
		m_result.nodes.push_back(node);
	}

	int nodeAt(int h, int index) const { return index < 0 ? m_start.origin(h) : nodeOn(h, index); }

	/// A place on the border of start triangle f, in affine coordinates of the triangle.
	Point2 pointOf(int f, int h, int index) const
	{
		static constexpr Point2 corner[3] = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
		const auto halfedges = m_start.halfedges(f);
		const auto k = static_cast<std::size_t>(
			std::find(halfedges.begin(), halfedges.end(), h) - halfedges.begin());
		if (index < 0)
			return corner[k];
		const double t = alongOn(h, index);
		const Point2 &a = corner[k], &b = corner[(k + 1) % 3];
		return {mix(a[0], b[0], t), mix(a[1], b[1], t)};
	}

	/// At the vertices of start triangle f, for the piece after so many lines counter-clockwise:
	/// which corner of the input's and of the end's triangles it has.
	void nameCorners(int f)
	{
		const auto h = m_start.halfedges(f);
		for (std::size_t k = 0; k < 3; ++k) {
			std::array<int, 2> corner{
				m_crossings.inputOnStart.originalAtOrBefore(h[k]),
				m_crossings.endOnStart.originalAtOrBefore(h[k])};
			m_cornerNames[k].assign(1, corner);
			for (int index : m_arrangement.linesAt(m_cornerPlace[k])) {
				const ChordArrangement::Line& line = m_arrangement.line(index);
				for (std::size_t kind : {kInput, kEnd})
					if (line.chord[kind] >= 0) {
						const Triangulation& t = kind == kInput ? m_input : m_end;
						corner[kind] = Triangulation::twin(t.previous(corner[kind]));
					}
				m_cornerNames[k].push_back(corner);
			}
		}
	}

	const FlippedSurface& m_s;
	const Triangulation& m_input;
	const Triangulation& m_start;
	const Triangulation& m_end;
	const EdgeCrossings m_crossings;
	const OverlayListener& m_listener;
	std::vector<double> m_endRadius; // [vertex]
	OverlayPieces m_result;

	std::vector<int> m_firstOnEdge, m_onEdge; // [start edge] its inner nodes, in order
	std::vector<double> m_alongEdge;
	std::vector<int> m_indexOfInput, m_indexOfEnd; // [slot] index on its start edge
	std::vector<EdgePoint> m_edgePoints;

	std::array<std::vector<Chord>, 2> m_chords; // [kind] by start triangle
	std::array<std::vector<int>, 2> m_firstChord;
	std::vector<int> m_firstSide; // [start edge] names of its sides

	// Of the start triangle that is being divided:
	std::array<int, 4> m_cornerPlace{0, 0, 0, 0};
	std::vector<PieceCorner> m_border; // [place]
	std::array<std::vector<ChordArrangement::Chord>, 2> m_places;
	ChordArrangement m_arrangement;
	std::array<std::vector<std::array<int, 2>>, 3>
		m_cornerNames; // [corner][lines before the piece]
};

} // namespace

InFace pointOnSide(const Triangulation& t, int h, double x)
{
	InFace p;
	p.face = t.face(h);
	const auto sides = t.halfedges(p.face);
	for (std::size_t k = 0; k < 3; ++k)
		if (sides[k] == h) {
			p.weight[k] = 1.0 - x;
			p.weight[(k + 1) % 3] = x;
		}
	return p;
}

OverlayPieces divideStartTriangles(const FlippedSurface& surface, const OverlayListener& listener)
{
	return Division(surface, listener).run();
}

} // namespace ricci
