// SPDX-License-Identifier: GPL-3.0-or-later
#include "common_refinement.h"

#include "../error.h"
#include "../metric/euclidean.h"
#include "../metric/hyperbolic.h"
#include "../numbers.h"
#include "edge_crossings.h"
#include "hyperbolic_layout.h"
#include "piece_triangulation.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <memory>
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

/// Integers decide how the triangulations lie on each other, so this is a fault of the program.
constexpr const char* kInconsistent =
	"The overlay of the triangulations is inconsistent: choose the output 'Keep the mesh' with the "
	"surgery 'None' or 'Edge swap', and report the mesh.";

/// Where a node lies on the end triangulation.
struct EndPlace
{
	enum Kind { Vertex, Edge, Face } kind = Vertex;
	int element = -1;                      ///< vertex, edge or face
	double along = 0.0;                    ///< Edge: from the origin of its even halfedge
	std::array<double, 3> corner{0, 0, 0}; ///< Face: weights of the origins of halfedges(face)
};

/// A corner of a piece.
struct PieceCorner
{
	int node;
	int place;            ///< on the start triangle's border, counted counter-clockwise; -1 inside
	int chord;            ///< of the end edge that made an inner node
	int edge;             ///< name of the side to the next corner, shared with the neighbour piece
	int onChord;          ///< chord that this side is part of, or -1
	int input;            ///< input halfedge along this side, or -1
	int end;              ///< end halfedge along this side, or -1
	int inputCorner = -1; ///< at a vertex: input halfedge whose corner this is
	int endCorner = -1;   ///< at a vertex: end halfedge whose corner this is
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

class Overlay
{
public:
	Overlay(
		const FlippedSurface& s,
		const std::vector<Point3>& positions,
		const std::vector<char>& isCut) :
			m_s(s),
			m_positions(positions), m_isCut(isCut), m_input(*s.input), m_start(*s.start),
			m_end(*s.end), m_crossings(s)
	{
		m_endRadius.resize(at(m_end.vertexCount()));
		for (int v = 0; v < m_end.vertexCount(); ++v)
			m_endRadius[at(v)] = s.background == Background::EuclideanPlane
									 ? Euclidean::circle((*s.endU)[v]).s
									 : Hyperbolic::circle((*s.endU)[v]).s;
	}

	CommonRefinement run()
	{
		makeNodes();
		collectChords();
		for (int f = 0; f < m_start.faceCount(); ++f)
			divide(f);
		m_chords = std::vector<Chord>();
		m_onEdge = std::vector<int>();
		m_alongEdge = std::vector<double>();
		linkPieces();
		findFaces();
		dropPieces();
		layOut();
		m_links = std::vector<std::array<Link, 2>>();
		return result();
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

	struct Node
	{
		SurfacePoint point;
		EndPlace end;
		double scale = 1.0; ///< weight sum in the end metric over that in the start metric
	};

	/// Puts the crossings of both kinds in order on each start edge and makes them nodes.
	void makeNodes()
	{
		const int n = m_start.edgeCount();
		m_nodes.resize(at(m_start.vertexCount()));
		for (int v = 0; v < m_start.vertexCount(); ++v) {
			m_nodes[at(v)].point.vertex[0] = v;
			m_nodes[at(v)].end.element = v;
			m_nodes[at(v)].scale = startRadius(v) / endRadius(v);
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
			m_onEdge.push_back(static_cast<int>(m_nodes.size()) + static_cast<int>(k));
			m_alongEdge.push_back(p.along);
		}
		m_nodes.resize(m_nodes.size() + m_edgePoints.size());
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
			Node& node = m_nodes[at(m_onEdge[at(base + k)])];
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
			Node& node = m_nodes[at(m_onEdge[at(base + k)])];
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
			node.end.element = from.first;
			for (std::size_t c = 0; c < 3; ++c)
				node.end.corner[c] = mix(from.second[c], to.second[c], share);
		}
	}

	using InFace = std::pair<int, std::array<double, 3>>;

	/// Weights, in end face face(g), of the point on g at \p x from its origin.
	InFace onSide(int g, double x) const
	{
		InFace p{m_end.face(g), {0, 0, 0}};
		const auto h = m_end.halfedges(p.first);
		for (std::size_t k = 0; k < 3; ++k)
			if (h[k] == g) {
				p.second[k] = 1.0 - x;
				p.second[(k + 1) % 3] = x;
			}
		return p;
	}

	/// The end point of a start edge's way that is number \p index of its crossings, seen from
	/// halfedge g of the end triangulation.
	InFace crossingOn(int g, int index, int e) const
	{
		const HomogeneousPoint& p = m_crossings.endPoints[at(m_crossings.firstEnd[at(e)] + index)];
		const double x = keepInside(along(
			p.onEnd, endRadius(m_end.origin(2 * p.curve)), endRadius(m_end.target(2 * p.curve))));
		return onSide(g, g % 2 == 0 ? x : 1.0 - x);
	}

	InFace startOfInterval(const Curve& way, int passed, int e) const
	{
		if (passed == 0)
			return onSide(way.first, 0.0);
		return crossingOn(
			Triangulation::twin(way.crossings[at(passed - 1)].halfedge), passed - 1, e);
	}

	InFace endOfInterval(const Curve& way, int passed, int e) const
	{
		if (passed == static_cast<int>(way.crossings.size()))
			return onSide(way.last, 0.0);
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
											: m_nodes[at(node)].end.along;
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
		m_sideCount = m_firstSide.back();
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
		std::vector<PieceCorner> whole;
		for (std::size_t k = 0; k < 3; ++k) {
			const int e = Triangulation::edge(h[k]), count = countOn(e);
			const int input = inputAlong(h[k]), end = endAlong(h[k]);
			for (int i = -1; i < count; ++i) {
				PieceCorner c;
				c.node = i < 0 ? m_start.origin(h[k]) : nodeOn(h[k], i);
				c.place = static_cast<int>(whole.size());
				c.chord = -1;
				c.edge = m_firstSide[at(e)] + (h[k] % 2 == 0 ? i + 1 : count - 1 - i);
				c.onChord = -1;
				c.input = input;
				c.end = end;
				whole.push_back(c);
			}
		}
		const std::size_t firstPiece = m_pieces.size();
		m_pieces.push_back(std::move(whole));
		for (int c = m_firstChord[at(f)]; c < m_firstChord[at(f) + 1]; ++c)
			if (m_chords[at(c)].ofInput)
				splitBy(c, f, firstPiece);
		for (int c = m_firstChord[at(f)]; c < m_firstChord[at(f) + 1]; ++c)
			if (!m_chords[at(c)].ofInput)
				splitBy(c, f, firstPiece);
		nameCorners(f, firstPiece);
	}

	int placeOf(int f, int halfedge, int index) const
	{
		const auto h = m_start.halfedges(f);
		for (std::size_t k = 0; k < 3; ++k)
			if (h[k] == halfedge)
				return m_cornerPlace[k] + 1 + index; // a corner has index -1
		throw Error(kInconsistent);
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

	int sideOf(const PieceCorner& c, int f, int from, int to) const
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

	void splitBy(int chordIndex, int f, std::size_t firstPiece)
	{
		const Chord& chord = m_chords[at(chordIndex)];
		const int from = placeOf(f, chord.from, chord.fromIndex);
		const int to = placeOf(f, chord.to, chord.toIndex);
		m_splitSides.clear();
		const std::size_t pieceCount = m_pieces.size();
		for (std::size_t p = firstPiece; p < pieceCount; ++p) {
			const auto& piece = m_pieces[p];
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
		auto& piece = m_pieces[p];
		for (std::size_t i = 0; i < piece.size(); ++i) {
			const PieceCorner& next = piece[(i + 1) % piece.size()];
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
		const std::vector<PieceCorner> piece = m_pieces[p];
		const std::size_t n = piece.size();
		std::vector<PieceCorner> left, right; // left: places between from and to
		const int newSide = m_sideCount++;
		const auto leaves = [&](PieceCorner c, bool ofLeft) {
			// The left part runs back from the chord's end to its beginning.
			const int direction = 2 * chord.curve + (ofLeft ? 1 : 0);
			c.edge = newSide;
			c.onChord = chordIndex;
			c.input = chord.ofInput ? direction : -1;
			c.end = chord.ofInput ? -1 : direction;
			(ofLeft ? left : right).push_back(c);
		};
		for (std::size_t i = 0; i < n; ++i) {
			const PieceCorner& c = piece[i];
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
				PieceCorner x = c;
				x.node = split.node;
				x.place = -1;
				x.chord = chordIndex;
				x.edge = forward ? split.secondHalf : split.firstHalf;
				(here > 0 ? left : right).back().edge =
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
		m_pieces[p] = std::move(left);
		m_pieces.push_back(std::move(right));
	}

	/// The node where an end edge's chord crosses a part of an input edge's chord.
	SplitSide crossSide(const PieceCorner& side, int endChord, int f)
	{
		const auto known = m_splitSides.find(side.edge);
		if (known != m_splitSides.end())
			return known->second;
		const Chord &a = m_chords[at(side.onChord)], &b = m_chords[at(endChord)];
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
		const double w0 = (1.0 - onB) * m_nodes[at(nodeAt(b.from, b.fromIndex))].scale;
		const double w1 = onB * m_nodes[at(nodeAt(b.to, b.toIndex))].scale;
		node.end.kind = EndPlace::Edge;
		node.end.element = b.curve;
		node.end.along = keepInside(mix(b.fromAlong, b.toAlong, w1 / (w0 + w1)));
		SplitSide split{static_cast<int>(m_nodes.size()), m_sideCount, m_sideCount + 1};
		m_sideCount += 2;
		m_nodes.push_back(node);
		m_splitSides.emplace(side.edge, split);
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
	void nameCorners(int f, std::size_t firstPiece)
	{
		const auto h = m_start.halfedges(f);
		const int places = m_cornerPlace[3];
		for (std::size_t p = firstPiece; p < m_pieces.size(); ++p) {
			auto& piece = m_pieces[p];
			for (PieceCorner& c : piece) {
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

	int cornerAfter(const PieceCorner& c, int f, int halfedge, int places, bool ofInput) const
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

	/// The two pieces at every side.
	struct Link
	{
		int piece = -1, corner = -1;
	};

	void linkPieces()
	{
		m_links.assign(at(m_sideCount), {Link(), Link()});
		for (std::size_t p = 0; p < m_pieces.size(); ++p)
			for (std::size_t i = 0; i < m_pieces[p].size(); ++i) {
				auto& link = m_links[at(m_pieces[p][i].edge)];
				(link[0].piece < 0 ? link[0]
								   : link[1]) = {static_cast<int>(p), static_cast<int>(i)};
			}
	}

	Link across(int piece, int corner) const
	{
		const auto& link = m_links[at(m_pieces[at(piece)][at(corner)].edge)];
		return link[0].piece == piece && link[0].corner == corner ? link[1] : link[0];
	}

	/// Input and end face of every piece: from its sides, corners or nodes, else from a neighbour.
	void findFaces()
	{
		m_inputFace.assign(m_pieces.size(), -1);
		m_endFace.assign(m_pieces.size(), -1);
		for (std::size_t p = 0; p < m_pieces.size(); ++p)
			for (const PieceCorner& c : m_pieces[p]) {
				if (c.input >= 0)
					m_inputFace[p] = m_input.face(c.input);
				else if (c.inputCorner >= 0)
					m_inputFace[p] = m_input.face(c.inputCorner);
				if (c.end >= 0)
					m_endFace[p] = m_end.face(c.end);
				else if (c.endCorner >= 0)
					m_endFace[p] = m_end.face(c.endCorner);
				else if (m_nodes[at(c.node)].end.kind == EndPlace::Face)
					m_endFace[p] = m_nodes[at(c.node)].end.element;
			}
		spread(m_inputFace, [](const PieceCorner& c) { return c.input >= 0; });
		spread(m_endFace, [](const PieceCorner& c) { return c.end >= 0; });
		for (std::size_t p = 0; p < m_pieces.size(); ++p)
			if (m_inputFace[p] < 0 || m_endFace[p] < 0)
				throw Error(kInconsistent);
	}

	/// Forgets the pieces of the input's faces that are not wanted.
	void dropPieces()
	{
		if (m_s.keptFaces >= m_input.faceCount())
			return;
		std::size_t kept = 0;
		for (std::size_t p = 0; p < m_pieces.size(); ++p) {
			if (m_inputFace[p] >= m_s.keptFaces)
				continue;
			if (kept != p) {
				m_pieces[kept] = std::move(m_pieces[p]);
				m_inputFace[kept] = m_inputFace[p];
				m_endFace[kept] = m_endFace[p];
			}
			++kept;
		}
		m_pieces.resize(kept);
		m_inputFace.resize(kept);
		m_endFace.resize(kept);
		linkPieces();
	}

	template<class IsBorder>
	void spread(std::vector<int>& face, IsBorder isBorder) const
	{
		std::vector<int> queue;
		for (std::size_t p = 0; p < face.size(); ++p)
			if (face[p] >= 0)
				queue.push_back(static_cast<int>(p));
		for (std::size_t head = 0; head < queue.size(); ++head) {
			const auto& piece = m_pieces[at(queue[head])];
			for (std::size_t i = 0; i < piece.size(); ++i) {
				if (isBorder(piece[i]))
					continue;
				const Link next = across(queue[head], static_cast<int>(i));
				if (next.piece >= 0 && face[at(next.piece)] < 0) {
					face[at(next.piece)] = face[at(queue[head])];
					queue.push_back(next.piece);
				}
			}
		}
	}

	/// Weights of the corners of a piece's end triangle, in the order of halfedges(), at a corner
	/// of the piece.
	std::array<double, 3> inEndTriangle(int p, std::size_t corner) const
	{
		const auto& piece = m_pieces[at(p)];
		const PieceCorner& c = piece[corner];
		const int f = m_endFace[at(p)];
		const EndPlace& end = m_nodes[at(c.node)].end;
		if (end.kind == EndPlace::Face)
			return end.corner;
		int g = -1;
		if (end.kind == EndPlace::Vertex) {
			g = c.endCorner;
			if (g < 0 || m_end.face(g) != f)
				for (int other : m_end.halfedges(f))
					if (m_end.origin(other) == end.element)
						g = other;
			if (g < 0)
				throw Error(kInconsistent);
			return onSide(g, 0.0).second;
		}
		const auto offer = [&](int other) {
			if (other >= 0 && Triangulation::edge(other) == end.element && m_end.face(other) == f)
				g = other;
		};
		for (int other : m_end.halfedges(f))
			offer(other);
		offer(piece[(corner + piece.size() - 1) % piece.size()].end);
		offer(c.end);
		if (g < 0)
			throw Error(kInconsistent);
		return onSide(g, g % 2 == 0 ? end.along : 1.0 - end.along).second;
	}

	bool isClosed(const PieceCorner& c) const
	{
		return c.input >= 0 && m_isCut[at(Triangulation::edge(c.input))];
	}

	/// Lays the end triangles out and places the pieces in them. The cut runs on input edges,
	/// through end triangles: a triangle that it divides is drawn once for each of its parts
	/// ("sheets").
	void layOut()
	{
		std::vector<int> parent(m_pieces.size());
		std::iota(parent.begin(), parent.end(), 0);
		for (const auto& link : m_links) {
			if (link[1].piece < 0)
				continue;
			const PieceCorner& side = m_pieces[at(link[0].piece)][at(link[0].corner)];
			if (!isClosed(side) && side.end < 0)
				mergeSets(parent, link[0].piece, link[1].piece);
		}
		std::vector<int> sheet(m_pieces.size(), -1);
		std::vector<Triangle> triangles;
		std::vector<int> faceOfSheet;
		for (std::size_t p = 0; p < m_pieces.size(); ++p) {
			if (findSet(parent, static_cast<int>(p)) != static_cast<int>(p))
				continue;
			sheet[p] = static_cast<int>(triangles.size());
			const auto h = m_end.halfedges(m_endFace[p]);
			triangles.push_back({m_end.origin(h[0]), m_end.origin(h[1]), m_end.origin(h[2])});
			faceOfSheet.push_back(m_endFace[p]);
		}
		for (std::size_t p = 0; p < m_pieces.size(); ++p)
			sheet[p] = sheet[at(findSet(parent, static_cast<int>(p)))];

		const auto sideOfSheet = [&](int s, int halfedge) {
			const auto h = m_end.halfedges(faceOfSheet[at(s)]);
			return 3 * s + static_cast<int>(std::find(h.begin(), h.end(), halfedge) - h.begin());
		};
		std::vector<int> glued(3 * triangles.size(), -1);
		for (const auto& link : m_links) {
			if (link[1].piece < 0)
				continue;
			const PieceCorner& side = m_pieces[at(link[0].piece)][at(link[0].corner)];
			if (isClosed(side) || side.end < 0)
				continue;
			const int a = sideOfSheet(sheet[at(link[0].piece)], side.end);
			const int b = sideOfSheet(sheet[at(link[1].piece)], Triangulation::twin(side.end));
			glued[at(a)] = b;
			glued[at(b)] = a;
		}
		const Triangulation sheets(m_end.vertexCount(), triangles, glued);
		std::vector<double> lengths(at(sheets.edgeCount())),
			angles(at(sheets.halfedgeCount()), 0.0);
		for (int s = 0; s < sheets.faceCount(); ++s) {
			const auto h = sheets.halfedges(s), original = m_end.halfedges(faceOfSheet[at(s)]);
			for (std::size_t k = 0; k < 3; ++k) {
				lengths[at(Triangulation::edge(h[k]))] =
					(*m_s.endLengths)[at(Triangulation::edge(original[k]))];
				angles[at(h[k])] = (*m_s.endAngles)[at(original[k])];
			}
		}
		const std::vector<char> noCut(lengths.size(), 0);
		if (m_s.background == Background::EuclideanPlane) {
			const PlanarLayout plane = layOutInPlane(sheets, lengths, angles, noCut);
			placePieces([&](int p, std::size_t corner) {
				const auto h = sheets.halfedges(sheet[at(p)]);
				const auto weight = inEndTriangle(p, corner);
				Point2 x{0.0, 0.0};
				for (std::size_t k = 0; k < 3; ++k)
					for (std::size_t j = 0; j < 2; ++j)
						x[j] += weight[k] * plane.at(h[k])[j];
				return x;
			});
			return;
		}
		const HyperbolicLayout disk = layOutInDisk(sheets, lengths, angles, noCut);
		placePieces([&](int p, std::size_t corner) {
			const int h = sheets.halfedge(sheet[at(p)]);
			const double side = lengths[at(Triangulation::edge(h))];
			const double other = lengths[at(Triangulation::edge(sheets.previous(h)))];
			const std::complex<double> z = rounded(disk.frame[at(h)])(
				hyperbolicPlace(inEndTriangle(p, corner), side, other, angles[at(h)]).inDisk());
			return Point2{z.real(), z.imag()};
		});
		m_kleinPoint.reserve(m_point.size());
		for (std::size_t p = 0; p < m_pieces.size(); ++p) {
			const int h = sheets.halfedge(sheet[p]);
			const double side = lengths[at(Triangulation::edge(h))];
			const double other = lengths[at(Triangulation::edge(sheets.previous(h)))];
			for (std::size_t i = 0; i < m_pieces[p].size(); ++i)
				m_kleinPoint.push_back(
					hyperbolicPlace(
						inEndTriangle(static_cast<int>(p), i), side, other, angles[at(h)])
						.inKleinModel());
		}
		findTransitions(sheet, sheets, lengths, disk);
	}

	/// A vector of R^{2,1} that stands for the point of the hyperbolic plane on its line.
	struct HyperboloidVector
	{
		double x0 = 0.0;
		std::complex<double> x = 0.0;

		void add(double weight, double distance, double direction)
		{
			x0 += weight * std::cosh(distance);
			x += std::polar(weight * std::sinh(distance), direction);
		}
		std::complex<double> inDisk() const
		{
			const double r = std::abs(x);
			return x / (x0 + std::sqrt((x0 - r) * (x0 + r)));
		}
		Point2 inKleinModel() const { return {x.real() / x0, x.imag() / x0}; }
	};

	/// The point with these weights of the corners of a triangle, whose first corner is at 0 and
	/// whose second is on the positive real axis. \p side, \p other: sides at the first corner.
	static HyperboloidVector
	hyperbolicPlace(const std::array<double, 3>& weight, double side, double other, double angle)
	{
		HyperboloidVector p;
		p.add(weight[0], 0.0, 0.0);
		p.add(weight[1], side, 0.0);
		p.add(weight[2], other, angle);
		return p;
	}

	/// How the layout goes on across the cut.
	void findTransitions(
		const std::vector<int>& sheet,
		const Triangulation& sheets,
		const std::vector<double>& lengths,
		const HyperbolicLayout& disk)
	{
		m_transition.resize(at(m_input.edgeCount()));
		for (const auto& link : m_links) {
			if (link[1].piece < 0)
				continue;
			const bool firstIsLeft = m_pieces[at(link[0].piece)][at(link[0].corner)].input % 2 == 0;
			const Link &left = link[firstIsLeft ? 0 : 1], &right = link[firstIsLeft ? 1 : 0];
			const PieceCorner& side = m_pieces[at(left.piece)][at(left.corner)];
			if (!isClosed(side))
				continue;
			Transition& transition = m_transition[at(Triangulation::edge(side.input))];
			const auto a = sheets.halfedges(sheet[at(left.piece)]);
			const auto b = sheets.halfedges(sheet[at(right.piece)]);
			if (side.end < 0) { // through one end triangle
				transition.offer(disk.frame[at(a[0])], disk.frame[at(b[0])]);
				continue;
			}
			const auto position = [&](int piece, int halfedge) {
				const auto h = m_end.halfedges(m_endFace[at(piece)]);
				return std::find(h.begin(), h.end(), halfedge) - h.begin();
			};
			const int h = a[at(position(left.piece, side.end))];
			const int twin = b[at(position(right.piece, Triangulation::twin(side.end)))];
			offerTransition(disk, lengths[at(Triangulation::edge(h))], h, twin, transition);
		}
	}

	/// Corners of pieces that meet off the cut are one point of the layout.
	/// \p place(piece, corner) gives the point that the corner's own sheet has for it.
	template<class Place>
	void placePieces(Place place)
	{
		m_firstCorner.assign(m_pieces.size() + 1, 0);
		for (std::size_t p = 0; p < m_pieces.size(); ++p)
			m_firstCorner[p + 1] = m_firstCorner[p] + static_cast<int>(m_pieces[p].size());
		const auto cornerOf = [&](int p, int i) {
			return m_firstCorner[at(p)] + i % static_cast<int>(m_pieces[at(p)].size());
		};
		std::vector<int> parent(at(m_firstCorner.back()));
		std::iota(parent.begin(), parent.end(), 0);
		for (const auto& link : m_links) {
			const Link &a = link[0], &b = link[1];
			if (b.piece < 0 || isClosed(m_pieces[at(a.piece)][at(a.corner)]))
				continue;
			mergeSets(parent, cornerOf(a.piece, a.corner), cornerOf(b.piece, b.corner + 1));
			mergeSets(parent, cornerOf(a.piece, a.corner + 1), cornerOf(b.piece, b.corner));
		}
		m_point.resize(at(m_firstCorner.back()));
		for (std::size_t p = 0; p < m_pieces.size(); ++p)
			for (std::size_t i = 0; i < m_pieces[p].size(); ++i) {
				const int corner = cornerOf(static_cast<int>(p), static_cast<int>(i));
				const int first = findSet(parent, corner);
				m_point[at(corner)] =
					first == corner ? place(static_cast<int>(p), i) : m_point[at(first)];
			}
	}

	static int findSet(std::vector<int>& parent, int i)
	{
		while (parent[at(i)] != i)
			i = parent[at(i)] = parent[at(parent[at(i)])];
		return i;
	}

	/// The lowest member stands for its set.
	static void mergeSets(std::vector<int>& parent, int a, int b)
	{
		a = findSet(parent, a), b = findSet(parent, b);
		parent[at(std::max(a, b))] = std::min(a, b);
	}

	CommonRefinement result()
	{
		CommonRefinement r;
		// The input's vertices (of the kept faces, which come first) and the crossings in use.
		const int vertices = static_cast<int>(m_positions.size());
		std::vector<int> point(m_nodes.size(), -1), nodes; // node of each point
		for (int v = 0; v < vertices; ++v) {
			point[at(v)] = v;
			nodes.push_back(v);
		}
		for (auto& piece : m_pieces)
			for (PieceCorner& c : piece) {
				if (point[at(c.node)] < 0) {
					point[at(c.node)] = static_cast<int>(nodes.size());
					nodes.push_back(c.node);
				}
				c.node = point[at(c.node)];
			}
		r.crossings = nodes.size() - at(vertices);
		if (!m_s.cornersOnly) {
			std::vector<Point3> space;
			for (int node : nodes) {
				r.points.push_back(m_nodes[at(node)].point);
				space.push_back(placeOnSurface(r.points.back(), m_positions));
			}
			for (std::size_t p = 0; p < m_pieces.size(); ++p)
				emit(p, space, r);
		}

		r.transition = m_transition;
		int sectorCount = 0;
		r.inputLayout.sector = cornerSectors(m_input, m_isCut, sectorCount);
		r.inputLayout.position.assign(at(sectorCount), {0.0, 0.0});
		for (std::size_t p = 0; p < m_pieces.size(); ++p)
			for (std::size_t i = 0; i < m_pieces[p].size(); ++i) {
				const int h = m_pieces[p][i].inputCorner;
				if (h >= 0 && !m_input.isOuter(h))
					r.inputLayout.position[at(r.inputLayout.sector[at(h)])] =
						m_point[at(m_firstCorner[p]) + i];
			}
		return r;
	}

	/// Triangles of a piece, into the result.
	void emit(std::size_t p, const std::vector<Point3>& space, CommonRefinement& r) const
	{
		const auto& piece = m_pieces[p];
		const Point2* plane = &m_point[at(m_firstCorner[p])];
		// Geodesics are straight in the Klein model.
		const Point2* straight = m_kleinPoint.empty() ? plane : &m_kleinPoint[at(m_firstCorner[p])];
		const std::vector<Point2> inPlane(straight, straight + piece.size());
		std::vector<Point3> inSpace;
		for (const PieceCorner& c : piece)
			inSpace.push_back(space[at(c.node)]);
		for (const auto& t : triangulatePiece(inPlane, inSpace)) {
			r.triangles.push_back({piece[t[0]].node, piece[t[1]].node, piece[t[2]].node});
			r.inputFace.push_back(m_inputFace[p]);
			r.uv.push_back({plane[t[0]], plane[t[1]], plane[t[2]]});
		}
	}

	const FlippedSurface& m_s;
	const std::vector<Point3>& m_positions;
	const std::vector<char>& m_isCut;
	const Triangulation& m_input;
	const Triangulation& m_start;
	const Triangulation& m_end;

	const EdgeCrossings m_crossings;
	std::vector<double> m_endRadius; // [vertex]

	std::vector<Node> m_nodes;
	std::vector<int> m_firstOnEdge, m_onEdge; // [start edge] its inner nodes, in order
	std::vector<double> m_alongEdge;
	std::vector<int> m_indexOfInput, m_indexOfEnd; // [slot] index on its start edge
	std::vector<EdgePoint> m_edgePoints;

	std::vector<Chord> m_chords; // by start face
	std::vector<int> m_firstChord, m_firstSide;
	int m_sideCount = 0;

	std::array<int, 4> m_cornerPlace{0, 0, 0, 0};
	std::vector<std::vector<PieceCorner>> m_pieces;
	std::vector<int> m_sides;
	std::unordered_map<int, SplitSide> m_splitSides;
	std::vector<std::array<Link, 2>> m_links;
	std::vector<int> m_inputFace, m_endFace;
	std::vector<int> m_firstCorner;
	std::vector<Point2> m_point;          // [corner of a piece]
	std::vector<Point2> m_kleinPoint;     // [corner of a piece] as its own end triangle sees it
	std::vector<Transition> m_transition; // [input edge] in the hyperbolic plane
};

} // namespace

Point3 placeOnSurface(const SurfacePoint& p, const std::vector<Point3>& positions)
{
	Point3 x{0, 0, 0};
	for (std::size_t i = 0; i < 4; ++i)
		if (p.weight[i] != 0.0)
			for (std::size_t k = 0; k < 3; ++k)
				x[k] += p.weight[i] * positions[at(p.vertex[i])][k];
	return x;
}

CommonRefinement commonRefinement(
	const FlippedSurface& surface,
	const std::vector<Point3>& positions,
	const std::vector<char>& isCut)
{
	return Overlay(surface, positions, isCut).run();
}

} // namespace ricci
