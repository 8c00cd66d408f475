// SPDX-License-Identifier: GPL-3.0-or-later
#include "piece_faces.h"

#include "../error.h"

#include <utility>
#include <vector>

namespace ricci {

namespace {

void findLinks(LinkedPieces& linked)
{
	const OverlayPieces& pieces = linked.pieces;
	linked.links.assign(pieces.sideCount, {PieceSide(), PieceSide()});
	for (int p = 0; p < pieces.count(); ++p)
		for (int i = 0; i < pieces.size(p); ++i) {
			auto& link = linked.links[pieces(p, i).side];
			(link[0].isValid() ? link[1] : link[0]) = {p, i};
		}
}

/// The piece on the other side of a side, if any.
PieceSide across(const LinkedPieces& linked, int piece, int corner)
{
	const auto& link = linked.links[linked.pieces(piece, corner).side];
	return link[0].piece == piece && link[0].corner == corner ? link[1] : link[0];
}

/// Hands known faces on to neighbours whose face is not known, across the sides that are no border
/// between faces.
template<class IsBorder>
void spread(const LinkedPieces& linked, Array<Face>& face, IsBorder isBorder)
{
	std::vector<int> queue;
	for (const int p : face.indices())
		if (face[p].isValid())
			queue.push_back(p);
	for (std::size_t head = 0; head < queue.size(); ++head) {
		const int p = queue[head];
		for (int i = 0; i < linked.pieces.size(p); ++i) {
			if (isBorder(linked.pieces(p, i)))
				continue;
			const PieceSide next = across(linked, p, i);
			if (next.isValid() && !face[next.piece].isValid()) {
				face[next.piece] = face[p];
				queue.push_back(next.piece);
			}
		}
	}
}

/// Input and end face of every piece: from its sides, corners or nodes, else from a neighbour.
void findFaces(const Triangulation& input, const Triangulation& end, LinkedPieces& linked)
{
	const OverlayPieces& pieces = linked.pieces;
	Array<Face>& inputFace = linked.inputFace;
	Array<Face>& endFace = linked.endFace;
	inputFace.assign(pieces.count(), Face());
	endFace.assign(pieces.count(), Face());
	for (int p = 0; p < pieces.count(); ++p)
		for (const PieceCorner& c : pieces.corners(p)) {
			if (c.input.isValid())
				inputFace[p] = input.face(c.input);
			else if (c.inputCorner.isValid())
				inputFace[p] = input.face(c.inputCorner);
			const PointOnEnd& onEnd = pieces.nodes[c.node].end;
			if (c.end.isValid())
				endFace[p] = end.face(c.end);
			else if (c.endCorner.isValid())
				endFace[p] = end.face(c.endCorner);
			else if (onEnd.kind() == PointOnEnd::InFace)
				endFace[p] = onEnd.face();
		}
	spread(linked, inputFace, [](const PieceCorner& c) { return c.input.isValid(); });
	spread(linked, endFace, [](const PieceCorner& c) { return c.end.isValid(); });
	for (int p = 0; p < pieces.count(); ++p)
		if (!inputFace[p].isValid() || !endFace[p].isValid())
			throw InternalError("A piece of the overlay lies in no triangle.");
}

void dropPieces(Face firstDropped, LinkedPieces& linked)
{
	Array<Face>& inputFace = linked.inputFace;
	Array<Face>& endFace = linked.endFace;
	linked.pieces.keep([&](int p) { return inputFace[p] < firstDropped; });
	int kept = 0;
	for (const int p : inputFace.indices())
		if (inputFace[p] < firstDropped) {
			inputFace[kept] = inputFace[p];
			endFace[kept++] = endFace[p];
		}
	inputFace.resize(kept);
	endFace.resize(kept);
	findLinks(linked);
}

} // namespace

LinkedPieces linkPieces(
	OverlayPieces pieces, const Triangulation& input, const Triangulation& end, int keptFaces)
{
	LinkedPieces linked;
	linked.pieces = std::move(pieces);
	findLinks(linked);
	findFaces(input, end, linked);
	if (keptFaces < input.faceCount())
		dropPieces(Face(keptFaces), linked);
	return linked;
}

FaceWeights
inEndTriangle(const LinkedPieces& linked, const Triangulation& end, int piece, int corner)
{
	const OverlayPieces& pieces = linked.pieces;
	const PieceCorner& c = pieces(piece, corner);
	const Face f = linked.endFace[piece];
	const PointOnEnd& point = pieces.nodes[c.node].end;
	if (point.kind() == PointOnEnd::InFace)
		return point.weight();
	Halfedge g; // halfedge of f at whose origin, or inside which, the point is
	if (point.kind() == PointOnEnd::AtVertex) {
		g = c.endCorner;
		if (!g.isValid() || end.face(g) != f)
			for (const Halfedge h : end.halfedges(f))
				if (end.origin(h) == point.vertex())
					g = h;
		if (!g.isValid())
			throw InternalError("A piece of the overlay is not in its triangle.");
		return pointOnSide(end, g, 0.0);
	}
	// Where both sides of the edge are f, the piece's own sides tell which one it is.
	const auto offer = [&](Halfedge h) {
		if (h.isValid() && h.edge() == point.edge() && end.face(h) == f)
			g = h;
	};
	for (const Halfedge h : end.halfedges(f))
		offer(h);
	offer(pieces(piece, corner + pieces.size(piece) - 1).end);
	offer(c.end);
	if (!g.isValid())
		throw InternalError("A piece of the overlay is not in its triangle.");
	return pointOnSide(end, g, g.isFirst() ? point.share() : 1.0 - point.share());
}

} // namespace ricci
