// SPDX-License-Identifier: GPL-3.0-or-later
#include "overlay_pieces.h"

#include "../error.h"
#include "../metric/euclidean.h"
#include "../metric/hyperbolic.h"
#include "../numbers.h"
#include "edge_crossings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace ricci {

namespace {

/// A crossing with an input edge and one with an end edge that are this near to each other on a
/// start edge, relative to its length, are one point.
constexpr double kMergeGap = 1e-12;

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
/// A corner of a part of one start triangle, while that is being divided.
struct PartCorner : PieceCorner
{
	int place = -1;   ///< on the start triangle's border, counted counter-clockwise; -1 inside
	int chord = -1;   ///< of the end edge that made an inner node
	int onChord = -1; ///< chord that this side is part of, or -1
};

/// A part of an input or end edge inside one start triangle.
struct Chord
{
	int face;
	int from, to; ///< corner: halfedge with that origin; side: halfedge
	int fromIndex,
		toIndex; ///< on a side: index among its nodes from the halfedge's origin; else -1
	int curve;   ///< input or end edge; runs in the direction of its even halfedge
	double fromAlong, toAlong; ///< position on the curve
	bool ofInput;
};
/// Divides start triangles by the chords of input and end edges.
class Division
{
public:
	explicit Division(const FlippedSurface& s) :
			m_s(s), m_input(*s.input), m_start(*s.start), m_end(*s.end), m_crossings(s)
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
		for (int f = 0; f < m_start.faceCount(); ++f)
			divide(f);
		return std::move(m_result);
	}

private:
	using Curve = NormalCoordinates::Curve;

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

	/// Fills EndPlace and scale of the nodes of start edge e: on end edges, or between two of them.
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
				node.scale = ea + eb;
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
			node.scale = s + r;
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

	void collectChords()
	{
		const auto collect = [&](const std::vector<Curve>& curves, bool ofInput) {
			for (std::size_t c = 0; c < curves.size(); ++c) {
				const Curve& curve = curves[c];
				if (curve.crossings.empty())
					continue;
				Chord chord;
				chord.curve = static_cast<int>(c);
				chord.ofInput = ofInput;
				chord.from = curve.first;
				chord.fromIndex = -1;
				chord.fromAlong = 0.0;
				for (const auto& x : curve.crossings) {
					const int slot = ofInput ? m_crossings.inputSlot(x) : m_crossings.endSlot(x);
					const int index = ofInput ? m_indexOfInput[at(slot)] : m_indexOfEnd[at(slot)];
					const int node =
						m_onEdge[at(m_firstOnEdge[at(Triangulation::edge(x.halfedge))] + index)];
					chord.face = m_start.face(x.halfedge);
					chord.to = x.halfedge;
					chord.toIndex = indexFrom(x.halfedge, index);
					chord.toAlong = ofInput ? m_crossings.inputPoints[at(slot)].along
											: m_result.nodes[at(node)].end.along;
					m_chords.push_back(chord);
					chord.from = Triangulation::twin(x.halfedge);
					chord.fromIndex = indexFrom(chord.from, index);
					chord.fromAlong = chord.toAlong;
				}
				chord.face = m_start.face(chord.from);
				chord.to = curve.last;
				chord.toIndex = -1;
				chord.toAlong = 1.0;
				m_chords.push_back(chord);
			}
		};
		collect(m_crossings.inputCurves, true);
		collect(m_crossings.endCurves, false);
		std::stable_sort(m_chords.begin(), m_chords.end(), [](const Chord& a, const Chord& b) {
			return a.face < b.face;
		});
		m_firstChord.assign(at(m_start.faceCount()) + 1, 0);
		for (const Chord& c : m_chords)
			++m_firstChord[at(c.face) + 1];
		std::partial_sum(m_firstChord.begin(), m_firstChord.end(), m_firstChord.begin());
		// Sides on start edges come first among the names of sides.
		m_firstSide.assign(at(m_start.edgeCount()) + 1, 0);
		for (int e = 0; e < m_start.edgeCount(); ++e)
			m_firstSide[at(e) + 1] = m_firstSide[at(e)] + countOn(e) + 1;
		m_result.sideCount = m_firstSide.back();
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
		std::vector<PartCorner> whole;
		for (std::size_t k = 0; k < 3; ++k) {
			const int e = Triangulation::edge(h[k]), count = countOn(e);
			const int input = inputAlong(h[k]), end = endAlong(h[k]);
			for (int i = -1; i < count; ++i) {
				PartCorner c;
				c.node = i < 0 ? m_start.origin(h[k]) : nodeOn(h[k], i);
				c.place = static_cast<int>(whole.size());
				c.chord = -1;
				c.side = m_firstSide[at(e)] + (h[k] % 2 == 0 ? i + 1 : count - 1 - i);
				c.onChord = -1;
				c.input = input;
				c.end = end;
				whole.push_back(c);
			}
		}
		m_parts.clear();
		m_parts.push_back(std::move(whole));
		for (int c = m_firstChord[at(f)]; c < m_firstChord[at(f) + 1]; ++c)
			if (m_chords[at(c)].ofInput)
				splitBy(c, f);
		for (int c = m_firstChord[at(f)]; c < m_firstChord[at(f) + 1]; ++c)
			if (!m_chords[at(c)].ofInput)
				splitBy(c, f);
		nameCorners(f);
		for (const auto& part : m_parts) {
			m_result.startPiece();
			for (const PartCorner& c : part)
				m_result.append(c);
		}
	}

	int placeOf(int f, int halfedge, int index) const
	{
		const auto h = m_start.halfedges(f);
		for (std::size_t k = 0; k < 3; ++k)
			if (h[k] == halfedge)
				return m_cornerPlace[k] + 1 + index; // a corner has index -1
		throw Error(kInconsistentOverlay);
	}

	/// +1 for places strictly between the chord's ends counter-clockwise, -1 on the other side, 0
	/// at the ends.
	static int sideOf(int place, int from, int to)
	{
		if (place == from || place == to)
			return 0;
		return from < to ? (place > from && place < to ? 1 : -1)
						 : (place > from || place < to ? 1 : -1);
	}

	int sideOf(const PartCorner& c, int f, int from, int to) const
	{
		if (c.place >= 0)
			return sideOf(c.place, from, to);
		// An inner node lies on an end edge's chord, which does not cross this one.
		const Chord& other = m_chords[at(c.chord)];
		const int side = sideOf(placeOf(f, other.from, other.fromIndex), from, to);
		return side != 0 ? side : sideOf(placeOf(f, other.to, other.toIndex), from, to);
	}

	struct SplitSide
	{
		int node, firstHalf, secondHalf; // halves in the direction of the input's even halfedge
	};

	void splitBy(int chordIndex, int f)
	{
		const Chord& chord = m_chords[at(chordIndex)];
		const int from = placeOf(f, chord.from, chord.fromIndex);
		const int to = placeOf(f, chord.to, chord.toIndex);
		m_splitSides.clear();
		const std::size_t partCount = m_parts.size();
		for (std::size_t p = 0; p < partCount; ++p) {
			const auto& piece = m_parts[p];
			m_sides.resize(piece.size());
			bool left = false, right = false;
			for (std::size_t i = 0; i < piece.size(); ++i) {
				m_sides[i] = sideOf(piece[i], f, from, to);
				left |= m_sides[i] > 0;
				right |= m_sides[i] < 0;
			}
			if (!left || !right) {
				labelSide(p, chordIndex, from, to);
				continue;
			}
			splitPiece(p, chordIndex, f);
		}
	}

	/// A chord that joins the same two places as one of an input edge runs along it.
	void labelSide(std::size_t p, int chordIndex, int from, int to)
	{
		const Chord& chord = m_chords[at(chordIndex)];
		if (chord.ofInput)
			return;
		auto& piece = m_parts[p];
		for (std::size_t i = 0; i < piece.size(); ++i) {
			const PartCorner& next = piece[(i + 1) % piece.size()];
			if (piece[i].onChord < 0)
				continue;
			if (piece[i].place == from && next.place == to)
				piece[i].end = 2 * chord.curve;
			else if (piece[i].place == to && next.place == from)
				piece[i].end = 2 * chord.curve + 1;
		}
	}

	void splitPiece(std::size_t p, int chordIndex, int f)
	{
		const Chord chord = m_chords[at(chordIndex)];
		const std::vector<PartCorner> piece = m_parts[p];
		const std::size_t n = piece.size();
		std::vector<PartCorner> left, right; // left: places between from and to
		const int newSide = m_result.sideCount++;
		const auto leaves = [&](PartCorner c, bool ofLeft) {
			// The left part runs back from the chord's end to its beginning.
			const int direction = 2 * chord.curve + (ofLeft ? 1 : 0);
			c.side = newSide;
			c.onChord = chordIndex;
			c.input = chord.ofInput ? direction : -1;
			c.end = chord.ofInput ? -1 : direction;
			(ofLeft ? left : right).push_back(c);
		};
		for (std::size_t i = 0; i < n; ++i) {
			const PartCorner& c = piece[i];
			const int here = m_sides[i], after = m_sides[(i + 1) % n];
			const int before = m_sides[(i + n - 1) % n];
			if (here > 0)
				left.push_back(c);
			else if (here < 0)
				right.push_back(c);
			else {
				// An end of the chord: the left part enters at the beginning and leaves at the end.
				const bool endsLeft = before > 0 || after < 0;
				if (endsLeft) {
					leaves(c, true);
					right.push_back(c);
				}
				else {
					leaves(c, false);
					left.push_back(c);
				}
			}
			if (here * after < 0) {
				const SplitSide split = crossSide(c, chordIndex, f);
				const bool forward = c.input % 2 == 0;
				PartCorner x = c;
				x.node = split.node;
				x.place = -1;
				x.chord = chordIndex;
				x.side = forward ? split.secondHalf : split.firstHalf;
				(here > 0 ? left : right).back().side =
					forward ? split.firstHalf : split.secondHalf;
				if (here > 0) { // from left to right
					leaves(x, true);
					right.push_back(x);
				}
				else {
					leaves(x, false);
					left.push_back(x);
				}
			}
		}
		m_parts[p] = std::move(left);
		m_parts.push_back(std::move(right));
	}

	/// The node where an end edge's chord crosses a part of an input edge's chord.
	SplitSide crossSide(const PartCorner& from, int endChord, int f)
	{
		const auto known = m_splitSides.find(from.side);
		if (known != m_splitSides.end())
			return known->second;
		const Chord &a = m_chords[at(from.onChord)], &b = m_chords[at(endChord)];
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
		SplitSide split{
			static_cast<int>(m_result.nodes.size()), m_result.sideCount, m_result.sideCount + 1};
		m_result.sideCount += 2;
		m_result.nodes.push_back(node);
		m_splitSides.emplace(from.side, split);
		return split;
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

	/// At the vertices of start triangle f: which corner of the input's and of the end's triangles
	/// each piece has, by counting the chords that leave the vertex clockwise before the piece.
	void nameCorners(int f)
	{
		const auto h = m_start.halfedges(f);
		const int places = m_cornerPlace[3];
		for (std::size_t p = 0; p < m_parts.size(); ++p) {
			auto& piece = m_parts[p];
			for (PartCorner& c : piece) {
				if (c.place < 0)
					continue;
				const auto corner =
					std::find(m_cornerPlace.begin(), m_cornerPlace.begin() + 3, c.place) -
					m_cornerPlace.begin();
				if (corner == 3)
					continue;
				const int halfedge = h[static_cast<std::size_t>(corner)];
				c.inputCorner = cornerAfter(c, f, halfedge, places, true);
				c.endCorner = cornerAfter(c, f, halfedge, places, false);
			}
		}
	}

	int cornerAfter(const PartCorner& c, int f, int halfedge, int places, bool ofInput) const
	{
		const int along = ofInput ? c.input : c.end;
		if (along >= 0)
			return along;
		const NormalCoordinates& coordinates =
			ofInput ? m_crossings.inputOnStart : m_crossings.endOnStart;
		const Triangulation& t = ofInput ? m_input : m_end;
		int corner = coordinates.originalAtOrBefore(halfedge);
		if (c.onChord < 0)
			return corner;
		const auto distanceTo = [&](const Chord& chord) {
			const int from = placeOf(f, chord.from, chord.fromIndex);
			const int to = placeOf(f, chord.to, chord.toIndex);
			const int far = from == c.place ? to : to == c.place ? from : -1;
			return far < 0 ? -1 : (far - c.place + places) % places;
		};
		const int mine = distanceTo(m_chords[at(c.onChord)]);
		for (int k = m_firstChord[at(f)]; k < m_firstChord[at(f) + 1]; ++k) {
			const Chord& other = m_chords[at(k)];
			if (other.ofInput != ofInput)
				continue;
			const int distance = distanceTo(other);
			if (distance >= 0 && distance < mine)
				corner = Triangulation::twin(t.previous(corner));
		}
		return corner;
	}

	const FlippedSurface& m_s;
	const Triangulation& m_input;
	const Triangulation& m_start;
	const Triangulation& m_end;
	const EdgeCrossings m_crossings;
	std::vector<double> m_endRadius; // [vertex]
	OverlayPieces m_result;

	std::vector<int> m_firstOnEdge, m_onEdge; // [start edge] its inner nodes, in order
	std::vector<double> m_alongEdge;
	std::vector<int> m_indexOfInput, m_indexOfEnd; // [slot] index on its start edge
	std::vector<EdgePoint> m_edgePoints;

	std::vector<Chord> m_chords; // by start face
	std::vector<int> m_firstChord, m_firstSide;

	// Of the start triangle that is being divided:
	std::array<int, 4> m_cornerPlace{0, 0, 0, 0};
	std::vector<std::vector<PartCorner>> m_parts;
	std::vector<int> m_sides;
	std::unordered_map<int, SplitSide> m_splitSides;
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

OverlayPieces divideStartTriangles(const FlippedSurface& surface)
{
	return Division(surface).run();
}

} // namespace ricci
