// SPDX-License-Identifier: GPL-3.0-or-later
#include "overlay_pieces.h"

#include "../base/numbers.h"
#include "../base/task.h"
#include "../error.h"
#include "chord_arrangement.h"
#include "edge_crossings.h"

#include <utility>

namespace ricci {

namespace {

/// Triangles and sides of pieces in them between two checkpoints.
constexpr int kWorkBetweenCalls = 1 << 14;

constexpr const char* kDividing = "Overlay of the two triangulations";

/// The families of chords.
constexpr std::size_t kInput = 0, kEnd = 1;

/// Where a chord meets the border of its start triangle.
struct ChordEnd
{
	Halfedge halfedge;  ///< start halfedge whose origin, or inside which, it is
	int index = -1;     ///< among the nodes of that halfedge, from its origin; -1: at the origin
	double share = 0.0; ///< on the input or end edge
};

/// The part of an input or end edge inside one start triangle, in the direction of the edge.
struct Chord
{
	Edge edge;
	ChordEnd from, to;
};

/// Divides the start triangles by the chords of input and end edges.
class PieceMaker
{
public:
	PieceMaker(const Triangulation& input, const FlowResult& flow) :
			m_start(flow.start.mesh.triangulation), m_end(flow.metric->triangulation()),
			m_crossings(input, flow), m_edgeNodes(flow, m_crossings, m_result.nodes)
	{
	}

	OverlayPieces run()
	{
		m_chords = {
			chordsOf(m_crossings.inputCurves, kInput), chordsOf(m_crossings.endCurves, kEnd)};
		m_sidesOn = {m_start.edges(), [&](Edge e) { return m_edgeNodes.count(e) + 1; }};
		m_result.sideCount = m_sidesOn.total();
		int unheard = 0; // work since the last checkpoint
		for (const Face f : m_start.faces()) {
			const int before = m_result.sideCount;
			divide(f);
			unheard += 1 + (m_result.sideCount - before);
			if (unheard < kWorkBetweenCalls)
				continue;
			unheard = 0;
			advance(static_cast<double>(f.number()) / m_start.faceCount(), kDividing);
			requireOverlayMemory(
				static_cast<std::size_t>(m_result.nodes.size() - m_start.vertexCount()), true);
		}
		return std::move(m_result);
	}

private:
	using Curve = NormalCoordinates::Curve;

	/// The chords of one family, by start triangle.
	Adjacency<Face, Chord> chordsOf(const EdgeArray<Curve>& curves, std::size_t family) const
	{
		const auto forFaces = [&](const auto& count) {
			for (const Curve& curve : curves) {
				if (curve.crossings.empty())
					continue;
				for (const auto& x : curve.crossings)
					count(m_start.face(x.halfedge));
				count(m_start.face(curve.last));
			}
		};
		const auto forChords = [&](const auto& add) {
			for (const Edge e : curves.indices()) {
				const Curve& curve = curves[e];
				if (curve.crossings.empty())
					continue;
				Chord chord;
				chord.edge = e;
				chord.from = {curve.first, -1, 0.0};
				for (const auto& x : curve.crossings) {
					const auto [index, share] = nodeAt(x, family);
					chord.to = {x.halfedge, m_edgeNodes.index(x.halfedge, index), share};
					add(m_start.face(x.halfedge), chord);
					const Halfedge beyond = x.halfedge.twin();
					chord.from = {beyond, m_edgeNodes.index(beyond, index), share};
				}
				chord.to = {curve.last, -1, 1.0};
				add(m_start.face(chord.from.halfedge), chord);
			}
		};
		return {m_start.faceCount(), forFaces, forChords};
	}

	/// The node of a crossing: index on its start edge, and share on the input or end edge.
	std::pair<int, double> nodeAt(const NormalCoordinates::Crossing& x, std::size_t family) const
	{
		if (family == kInput) {
			const int number = m_crossings.inputNumber(x);
			return {m_edgeNodes.indexOfInput(number), m_crossings.inputCrossings[number].onInput};
		}
		const int index = m_edgeNodes.indexOfEnd(m_crossings.endNumber(x));
		const int node = m_edgeNodes.node(x.halfedge.edge().halfedge(), index);
		return {index, m_result.nodes[node].end.share};
	}

	/// Halfedge of the original triangulation that start halfedge h is, if it is one.
	static Halfedge originalAlong(const NormalCoordinates& onStart, Halfedge h)
	{
		return onStart.isCurve(h.edge()) ? onStart.originalAtOrBefore(h) : Halfedge();
	}

	/// Divides start triangle f by its chords.
	void divide(Face f)
	{
		m_sides = m_start.halfedges(f);
		listBorder();
		for (const std::size_t family : {kInput, kEnd}) {
			m_places[family].clear();
			for (const Chord& chord : m_chords[family][f])
				m_places[family].push_back({placeOf(chord.from), placeOf(chord.to)});
		}
		m_arrangement.divide(m_cornerPlace[3], m_places[kInput], m_places[kEnd]);
		const int firstNode = m_result.nodes.size();
		for (const ChordArrangement::Crossing& x : m_arrangement.crossings())
			makeNodeAt(x, f);
		nameCorners();
		const int firstSide = m_result.sideCount;
		m_result.sideCount += m_arrangement.segmentCount();
		for (int face = 0; face < m_arrangement.faceCount(); ++face) {
			m_result.startPiece();
			for (int i = m_arrangement.firstSide(face); i < m_arrangement.firstSide(face + 1); ++i)
				m_result.append(cornerAt(m_arrangement.side(i), f, firstNode, firstSide));
		}
	}

	/// The places of the start triangle's border, as the arrangement numbers them: the first corner,
	/// the nodes on the first side, the second corner, and so on.
	void listBorder()
	{
		m_border.clear();
		for (std::size_t k = 0; k < 3; ++k) {
			const Halfedge h = m_sides[k];
			const int count = m_edgeNodes.count(h.edge());
			m_cornerPlace[k] = m_border.size();
			PieceCorner c;
			c.input = originalAlong(m_crossings.inputOnStart, h);
			c.end = originalAlong(m_crossings.endOnStart, h);
			for (int i = -1; i < count; ++i) {
				c.node = nodeOf(h, i);
				c.side = m_sidesOn.first(h.edge()) + (h.isFirst() ? i + 1 : count - 1 - i);
				m_border.push_back(c);
			}
		}
		m_cornerPlace[3] = m_border.size();
	}

	/// Node of a place on the border; \p index as in ChordEnd.
	int nodeOf(Halfedge h, int index) const
	{
		return index < 0 ? m_start.origin(h).number() : m_edgeNodes.node(h, index);
	}

	/// Which side of the start triangle a halfedge is.
	std::size_t sideOf(Halfedge h) const
	{
		const auto found = std::find(m_sides.begin(), m_sides.end(), h);
		if (found == m_sides.end())
			throw InternalError("A chord of the overlay ends outside its start triangle.");
		return static_cast<std::size_t>(found - m_sides.begin());
	}

	int placeOf(const ChordEnd& end) const
	{
		return m_cornerPlace[sideOf(end.halfedge)] + 1 + end.index; // a corner has index -1
	}

	const Chord& chordOf(const ChordArrangement::Line& line, std::size_t family, Face f) const
	{
		return m_chords[family][f][line.chord[family]];
	}

	PieceCorner
	cornerAt(const ChordArrangement::Side& side, Face f, int firstNode, int firstSide) const
	{
		const int places = m_cornerPlace[3];
		PieceCorner c;
		if (side.line < 0)
			c = m_border[side.node];
		else {
			const ChordArrangement::Line& line = m_arrangement.line(side.line);
			c.node = side.node < places ? m_border[side.node].node : firstNode + side.node - places;
			c.side = firstSide + side.name - places;
			const auto along = [](const Chord& chord, bool forward) {
				return forward ? chord.edge.halfedge() : chord.edge.halfedge().twin();
			};
			if (line.chord[kInput] >= 0)
				c.input = along(chordOf(line, kInput, f), side.forward);
			if (line.chord[kEnd] >= 0) {
				const bool reversed = line.chord[kInput] >= 0 && line.secondReversed;
				c.end = along(chordOf(line, kEnd, f), side.forward != reversed);
			}
		}
		for (std::size_t k = 0; k < 3; ++k)
			if (side.node == m_cornerPlace[k]) {
				const auto& names = m_cornerNames[k][m_arrangement.rank(side) + 1];
				c.inputCorner = names[kInput];
				c.endCorner = names[kEnd];
			}
		return c;
	}

	/// The node where an end edge's chord crosses an input edge's chord.
	void makeNodeAt(const ChordArrangement::Crossing& crossing, Face f)
	{
		const Chord& a = chordOf(m_arrangement.line(crossing.first), kInput, f);
		const Chord& b = chordOf(m_arrangement.line(crossing.second), kEnd, f);
		const Point2 p = pointOf(a.from), q = pointOf(a.to), r = pointOf(b.from), s = pointOf(b.to);
		const double ofP = doubledArea(r, s, p), ofQ = doubledArea(r, s, q);
		const double ofR = doubledArea(p, q, r), ofS = doubledArea(p, q, s);
		const double onA = keepInside(ofP / (ofP - ofQ)), onB = keepInside(ofR / (ofR - ofS));

		OverlayNode node;
		node.point = pointOfEdge(m_crossings.input, a.edge, mix(a.from.share, a.to.share, onA));
		// On the end edge by weights: both ends of the chord are crossings with it, or vertices.
		const EdgeWeights onChord{
			(1.0 - onB) * m_result.nodes[nodeOf(b.from.halfedge, b.from.index)].scale,
			onB * m_result.nodes[nodeOf(b.to.halfedge, b.to.index)].scale};
		node.end = {
			PointOnEnd::OnEdge,
			b.edge.number(),
			keepInside(mix(b.from.share, b.to.share, onChord.affine()))};
		m_result.nodes.push_back(node);
	}

	/// The end of a chord, in affine coordinates of the start triangle.
	Point2 pointOf(const ChordEnd& end) const
	{
		static constexpr Point2 corner[3] = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
		const std::size_t k = sideOf(end.halfedge);
		if (end.index < 0)
			return corner[k];
		const double t = m_edgeNodes.share(end.halfedge, end.index);
		const Point2 &a = corner[k], &b = corner[(k + 1) % 3];
		return {mix(a[0], b[0], t), mix(a[1], b[1], t)};
	}

	/// At the corners of the start triangle, for the piece after so many lines counter-clockwise:
	/// which corner of the input's and of the end's triangles it has.
	void nameCorners()
	{
		for (std::size_t k = 0; k < 3; ++k) {
			std::array<Halfedge, 2> corner{
				m_crossings.inputOnStart.originalAtOrBefore(m_sides[k]),
				m_crossings.endOnStart.originalAtOrBefore(m_sides[k])};
			m_cornerNames[k].assign(1, corner);
			for (const int index : m_arrangement.linesAt(m_cornerPlace[k])) {
				const ChordArrangement::Line& line = m_arrangement.line(index);
				for (const std::size_t family : {kInput, kEnd})
					if (line.chord[family] >= 0) {
						const Triangulation& t = family == kInput ? m_crossings.input : m_end;
						corner[family] = t.previous(corner[family]).twin();
					}
				m_cornerNames[k].push_back(corner);
			}
		}
	}

	const Triangulation& m_start;
	const Triangulation& m_end;
	OverlayPieces m_result;
	const EdgeCrossings m_crossings;
	const StartEdgeNodes m_edgeNodes;

	std::array<Adjacency<Face, Chord>, 2> m_chords; // [family] by start triangle
	EdgeRanges m_sidesOn; // numbers of the sides on each start edge; they come before all others

	// Of the start triangle that is being divided:
	std::array<Halfedge, 3> m_sides;
	std::array<int, 4> m_cornerPlace{0, 0, 0, 0}; // of its corners; the number of places
	Array<PieceCorner> m_border;                  // [place]
	std::array<std::vector<ChordArrangement::Chord>, 2> m_places; // [family] ends of the chords
	ChordArrangement m_arrangement;
	std::array<Array<std::array<Halfedge, 2>>, 3> m_cornerNames; // [corner][lines before the piece]
};

/// Twice the area over the square of the longest side: in the plane (negative if clockwise) or in
/// space, whichever is lower.
double quality(const std::array<const Point2*, 3>& plane, const std::array<const Point3*, 3>& space)
{
	const double area = doubledArea(*plane[0], *plane[1], *plane[2]);
	double longest = 0.0, longestInSpace = 0.0;
	for (std::size_t k = 0; k < 3; ++k) {
		longest = std::max(longest, distance(*plane[k], *plane[(k + 1) % 3]));
		longestInSpace = std::max(longestInSpace, distance(*space[k], *space[(k + 1) % 3]));
	}
	const double inPlane = longest > 0.0 ? area / (longest * longest) : 0.0;
	if (!(longestInSpace > 0.0))
		return inPlane;
	const double inSpace = length(cross(*space[1] - *space[0], *space[2] - *space[0]));
	return std::min(inPlane, inSpace / (longestInSpace * longestInSpace));
}

} // namespace

void OverlayPieces::findLinks()
{
	links.assign(sideCount, {PieceSide(), PieceSide()});
	for (int p = 0; p < count(); ++p)
		for (int i = 0; i < size(p); ++i) {
			auto& link = links[(*this)(p, i).side];
			(link[0].isValid() ? link[1] : link[0]) = {p, i};
		}
}

/// Hands known faces on to neighbours whose face is not known, across the sides that are not a border
/// between faces.
template<class IsBorder>
void OverlayPieces::spread(Array<Face>& face, const IsBorder& isBorder) const
{
	std::vector<int> queue;
	for (const int p : face.indices())
		if (face[p].isValid())
			queue.push_back(p);
	for (std::size_t head = 0; head < queue.size(); ++head) {
		const int p = queue[head];
		for (int i = 0; i < size(p); ++i) {
			const PieceCorner& c = (*this)(p, i);
			if (isBorder(c))
				continue;
			const auto& link = links[c.side];
			const PieceSide& next = link[link[0].piece == p && link[0].corner == i ? 1 : 0];
			if (next.isValid() && !face[next.piece].isValid()) {
				face[next.piece] = face[p];
				queue.push_back(next.piece);
			}
		}
	}
}

/// Input and end face of every piece: from its sides, corners or nodes, else from a neighbour.
void OverlayPieces::findFaces(const Triangulation& input, const Triangulation& end)
{
	inputFace.assign(count(), Face());
	endFace.assign(count(), Face());
	for (int p = 0; p < count(); ++p)
		for (const PieceCorner& c : corners(p)) {
			if (c.input.isValid())
				inputFace[p] = input.face(c.input);
			else if (c.inputCorner.isValid())
				inputFace[p] = input.face(c.inputCorner);
			const PointOnEnd& onEnd = nodes[c.node].end;
			if (c.end.isValid())
				endFace[p] = end.face(c.end);
			else if (c.endCorner.isValid())
				endFace[p] = end.face(c.endCorner);
			else if (onEnd.kind == PointOnEnd::InFace)
				endFace[p] = Face(onEnd.element);
		}
	spread(inputFace, [](const PieceCorner& c) { return c.input.isValid(); });
	spread(endFace, [](const PieceCorner& c) { return c.end.isValid(); });
	for (int p = 0; p < count(); ++p)
		if (!inputFace[p].isValid() || !endFace[p].isValid())
			throw InternalError("A piece of the overlay lies in no triangle.");
}

void OverlayPieces::keepFacesBelow(Face firstDropped)
{
	int kept = 0, corners = 0;
	for (int p = 0; p < count(); ++p) {
		const int first = m_first[p], last = m_first[p + 1];
		if (inputFace[p] >= firstDropped)
			continue;
		inputFace[kept] = inputFace[p];
		endFace[kept] = endFace[p];
		m_first[kept++] = corners;
		for (int c = first; c < last; ++c)
			m_corners[corners++] = m_corners[c];
	}
	m_first[kept] = corners;
	m_first.resize(kept + 1);
	m_corners.resize(corners);
	inputFace.resize(kept);
	endFace.resize(kept);
}

void OverlayPieces::link(const Triangulation& input, const Triangulation& end, int keptFaces)
{
	findLinks();
	findFaces(input, end);
	if (keptFaces < input.faceCount()) {
		keepFacesBelow(Face(keptFaces));
		findLinks();
	}
}

OverlayPieces divideStartTriangles(const FlowDomain& domain, const FlowResult& flow)
{
	const Triangulation& input = flow.input(domain.solved());
	advance(0.0, kDividing);
	OverlayPieces pieces = [&] {
		const Task dividing(0.0, kDivided);
		return PieceMaker(input, flow).run();
	}();
	advance(kDivided, kDividing);
	const Triangulation& end = flow.metric->triangulation();
	requireOverlayMemory(static_cast<std::size_t>(pieces.nodes.size() - end.vertexCount()), true);
	pieces.link(input, end, domain.surface.triangulation.faceCount());
	return pieces;
}

FaceWeights
inEndTriangle(const OverlayPieces& pieces, const Triangulation& end, int piece, int corner)
{
	const PieceCorner& c = pieces(piece, corner);
	const Face f = pieces.endFace[piece];
	const PointOnEnd& point = pieces.nodes[c.node].end;
	if (point.kind == PointOnEnd::InFace)
		return point.weight;
	Halfedge g; // halfedge of f at whose origin, or inside which, the point is
	if (point.kind == PointOnEnd::AtVertex) {
		g = c.endCorner;
		if (!g.isValid() || end.face(g) != f)
			for (const Halfedge h : end.halfedges(f))
				if (end.origin(h) == Vertex(point.element))
					g = h;
		if (!g.isValid())
			throw InternalError("A piece of the overlay is not in its triangle.");
		return pointOnSide(end, g, 0.0);
	}
	// Where both sides of the edge are f, the piece's own sides tell which one it is.
	const auto offer = [&](Halfedge h) {
		if (h.isValid() && h.edge() == Edge(point.element) && end.face(h) == f)
			g = h;
	};
	for (const Halfedge h : end.halfedges(f))
		offer(h);
	offer(pieces(piece, corner + pieces.size(piece) - 1).end);
	offer(c.end);
	if (!g.isValid())
		throw InternalError("A piece of the overlay is not in its triangle.");
	return pointOnSide(end, g, g.isFirst() ? point.share : 1.0 - point.share);
}

std::vector<std::array<std::size_t, 3>>
triangulatePiece(const std::vector<Point2>& plane, const std::vector<Point3>& space)
{
	const std::size_t n = plane.size();
	std::vector<std::array<std::size_t, 3>> triangles;
	if (n == 3)
		return {{0, 1, 2}};
	// best[i n + j]: lowest quality in the best triangulation of corners i .. j; apex: of side ij there.
	std::vector<double> best(n * n, kInfinity);
	std::vector<std::size_t> apex(n * n, 0);
	for (std::size_t span = 2; span < n; ++span)
		for (std::size_t i = 0; i + span < n; ++i) {
			const std::size_t j = i + span;
			best[i * n + j] = -kInfinity;
			for (std::size_t k = i + 1; k < j; ++k) {
				const double own =
					quality({&plane[i], &plane[k], &plane[j]}, {&space[i], &space[k], &space[j]});
				const double worst = std::min({own, best[i * n + k], best[k * n + j]});
				if (worst > best[i * n + j] || k == i + 1) {
					best[i * n + j] = worst;
					apex[i * n + j] = k;
				}
			}
		}
	std::vector<std::pair<std::size_t, std::size_t>> stack{{0, n - 1}};
	while (!stack.empty()) {
		const auto [i, j] = stack.back();
		stack.pop_back();
		if (j - i < 2)
			continue;
		const std::size_t k = apex[i * n + j];
		triangles.push_back({i, k, j});
		stack.push_back({i, k});
		stack.push_back({k, j});
	}
	return triangles;
}

} // namespace ricci
