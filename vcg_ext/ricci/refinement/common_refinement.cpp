// SPDX-License-Identifier: GPL-3.0-or-later
#include "overlay_pieces.h"

#include "../base/graphs.h"
#include "../base/task.h"

#include <cmath>
#include <complex>
#include <tuple>
#include <utility>
#include <vector>

namespace ricci {

namespace {

/// Whether the side of a piece that begins at this corner is on the cut.
bool isOnCut(const PieceCorner& c, const EdgeArray<char>& isCut)
{
	return c.input.isValid() && isCut[c.input.edge()];
}

/// The sheets that belong to the pieces of an overlay, glued along end edges where the pieces meet off the cut: a
/// surface without a cut.
/// \param isCut 1 on input edges
EndSheets
sheetsOf(const OverlayPieces& pieces, const Triangulation& end, const EdgeArray<char>& isCut)
{
	DisjointSets sets(pieces.count()); // of pieces: those of one sheet
	EndSheets sheets;
	std::vector<Triangle> triangles; // [sheet]
	CornerArray<Corner> glued;       // [side of a sheet] the side across it
	const auto listSheets = [&] {
		triangles.clear();
		sheets.endFace.clear();
		sheets.of.assign(pieces.count(), Face());
		for (const int p : sheets.of.indices()) {
			if (sets.find(p) != p)
				continue;
			const Face f = pieces.endFace[p];
			const auto corner = end.vertices(f);
			sheets.of[p] = Face(sheets.endFace.size());
			sheets.endFace.push_back(f);
			triangles.push_back({corner[0].number(), corner[1].number(), corner[2].number()});
		}
		for (const int p : sheets.of.indices())
			sheets.of[p] = sheets.of[sets.find(p)];
	};
	// The side of a piece's sheet that is end halfedge h.
	const auto sideOf = [&](int piece, Halfedge h) {
		return Corner(sheets.of[piece].number(), static_cast<int>(end.corner(h).index()));
	};
	// The cut is straight in another metric than the end edges and may cross one of them twice with no vertex
	// between: it then cuts parts off that lie across one side of one sheet. They have one place in the layout
	// and become one set. \return false if there are such parts
	const auto glue = [&] {
		CornerArray<int> pieceAcross(3 * sheets.endFace.size(), -1); // [side] of the other sheet
		glued.assign(3 * sheets.endFace.size(), Corner());
		bool fits = true;
		for (const auto& link : pieces.links) {
			if (!link[1].isValid())
				continue;
			const PieceCorner& side = pieces.at(link[0]);
			if (isOnCut(side, isCut) || !side.end.isValid())
				continue;
			const Corner a = sideOf(link[0].piece, side.end);
			const Corner b = sideOf(link[1].piece, side.end.twin());
			for (const auto& [from, to, piece] :
				 {std::tuple(a, b, link[1].piece), std::tuple(b, a, link[0].piece)}) {
				Corner& known = glued[from];
				if (known.isValid() && known != to) {
					sets.merge(pieceAcross[from], piece);
					fits = false;
				}
				known = to;
				pieceAcross[from] = piece;
			}
		}
		return fits;
	};
	for (const auto& link : pieces.links)
		if (link[1].isValid())
			if (const PieceCorner& side = pieces.at(link[0]);
				!isOnCut(side, isCut) && !side.end.isValid())
				sets.merge(link[0].piece, link[1].piece);
	do
		listSheets();
	while (!glue());
	sheets.triangulation = Triangulation(end.vertexCount(), triangles, glued);
	return sheets;
}

/// The edges of the input on which the overlay is open: the cut, and the border of the wanted part.
EdgeArray<char>
opened(const FlowDomain& domain, const FlowResult& flow, const EdgeArray<char>& isCut)
{
	EdgeArray<char> open = isCut;
	const Triangulation& t = domain.surface.triangulation;
	if (flow.doubled || domain.holes > 0)
		for (const Edge e : t.edges())
			if (t.isBoundary(e))
				open[e] = 1;
	open.resize(flow.metric->triangulation().edgeCount(), 0); // the surface's edges come first
	return open;
}

/// A vector of R^{2,1} that stands for the point of the hyperbolic plane on its line.
struct HyperboloidVector
{
	double x0 = 0.0;
	std::complex<double> x = 0.0;
	double length = 0.0; // the root of x0^2 - |x|^2

	void add(double weight, double distance, double direction)
	{
		x0 += weight * std::cosh(distance);
		x += std::polar(weight * std::sinh(distance), direction);
	}
	std::complex<double> inDisk() const { return x / (x0 + length); }
	Point2 inKleinModel() const { return {x.real() / x0, x.imag() / x0}; }
};

/// The point with these weights of the corners of a triangle, whose first corner is at 0 and
/// whose second is on the positive real axis. \p side, \p other: sides at the first corner;
/// \p opposite: the third side.
HyperboloidVector hyperbolicPoint(
	const std::array<double, 3>& weight, double side, double other, double opposite, double angle)
{
	HyperboloidVector p;
	p.add(weight[0], 0.0, 0.0);
	p.add(weight[1], side, 0.0);
	p.add(weight[2], other, angle);
	// By the products of the corners, all positive: far from the first corner x0 and |x| have the same
	// digits.
	const auto product = [&](std::size_t i, std::size_t j, double distance) {
		return 2.0 * weight[i] * weight[j] * std::cosh(distance);
	};
	p.length = std::sqrt(
		weight[0] * weight[0] + weight[1] * weight[1] + weight[2] * weight[2] +
		product(0, 1, side) + product(0, 2, other) + product(1, 2, opposite));
	return p;
}

/// Lays the pieces of an overlay out and puts them together.
class RefinementMaker
{
public:
	RefinementMaker(
		const FlowDomain& domain,
		const FlowResult& flow,
		OverlayPieces pieces,
		const EdgeArray<char>& isCut) :
			m_surface(domain.surface),
			m_input(flow.input(domain.solved())), m_flow(flow), m_end(flow.metric->triangulation()),
			m_surfaceCut(isCut), m_isCut(opened(domain, flow, isCut)), m_pieces(std::move(pieces))
	{
	}

	SurfaceLayout run()
	{
		layOut();
		advance(kLaidOut, "Placing the pieces of the overlay");
		m_pieces.links = {};
		numberPoints();
		emitPieces();
		placeSurface();
		return std::move(m_result);
	}

private:
	/// Lays the sheets out and places the pieces in them.
	void layOut()
	{
		EndSheets sheets = sheetsOf(m_pieces, m_end, m_isCut);
		takeMetric(m_flow, sheets);
		if (m_flow.target.background == Background::EuclideanPlane)
			placeInPlane(sheets, layOutInPlane(sheets));
		else {
			const HyperbolicLayout disk = layOutInDisk(sheets);
			placeInDisk(sheets, disk);
			findPairings(sheets, disk);
		}
	}

	void placeInPlane(const EndSheets& sheets, const PlanarLayout& plane)
	{
		placePieces([&](int p, int corner) {
			const auto h = sheets.triangulation.halfedges(sheets.of[p]);
			const auto weight = inEndTriangle(m_pieces, m_end, p, corner);
			Point2 x{0.0, 0.0};
			for (std::size_t k = 0; k < 3; ++k)
				x += weight[k] * plane[h[k]];
			return x;
		});
	}

	void placeInDisk(const EndSheets& sheets, const HyperbolicLayout& disk)
	{
		const Triangulation& t = sheets.triangulation;
		// As seen from the frame of the sheet's halfedge.
		const auto inSheet = [&](int p, int corner) {
			const Halfedge h = t.halfedge(sheets.of[p]);
			return hyperbolicPoint(
				inEndTriangle(m_pieces, m_end, p, corner),
				sheets.lengths[h.edge()],
				sheets.lengths[t.previous(h).edge()],
				sheets.lengths[t.next(h).edge()],
				sheets.angles[h]);
		};
		placePieces([&](int p, int corner) {
			// Rounded once, as the two sides of a seam see their points from afar.
			const ExtendedIsometry& frame = disk[t.halfedge(sheets.of[p])];
			return asPoint(std::complex<double>(frame(inSheet(p, corner).inDisk())));
		});
		m_kleinPoint.reserve(m_point.size());
		for (int p = 0; p < m_pieces.count(); ++p) {
			checkpointNowAndThen(positionOf(p));
			for (int i = 0; i < m_pieces.size(p); ++i)
				m_kleinPoint.push_back(inSheet(p, i).inKleinModel());
		}
	}

	/// Corners of pieces that meet off the cut are one point of the layout.
	/// \p place(piece, corner) gives the point that the corner's own sheet has for it.
	template<class Place>
	void placePieces(Place place)
	{
		DisjointSets sets(m_pieces.cornerCount());
		for (const auto& link : m_pieces.links) {
			const PieceSide &a = link[0], &b = link[1];
			if (!b.isValid() || isOnCut(m_pieces.at(a), m_isCut))
				continue;
			sets.merge(m_pieces.corner(a.piece, a.corner), m_pieces.corner(b.piece, b.corner + 1));
			sets.merge(m_pieces.corner(a.piece, a.corner + 1), m_pieces.corner(b.piece, b.corner));
		}
		m_point.resize(sets.size());
		for (int p = 0; p < m_pieces.count(); ++p) {
			checkpointNowAndThen(positionOf(p));
			for (int i = 0; i < m_pieces.size(p); ++i) {
				const int corner = m_pieces.corner(p, i), first = sets.find(corner);
				m_point[corner] = first == corner ? place(p, i) : m_point[first];
			}
		}
	}

	/// How the layout goes on across the cut.
	void findPairings(const EndSheets& sheets, const HyperbolicLayout& disk)
	{
		EdgeArray<SidePairing>& pairing = m_result.pairing;
		pairing.resize(m_surface.triangulation.edgeCount());
		for (const auto& link : m_pieces.links) {
			if (!link[1].isValid())
				continue;
			const bool firstIsLeft = m_pieces.at(link[0]).input.isFirst();
			const PieceSide &left = link[firstIsLeft ? 0 : 1], &right = link[firstIsLeft ? 1 : 0];
			const PieceCorner& side = m_pieces.at(left);
			if (!isOnCut(side, m_isCut))
				continue;
			SidePairing& own = pairing[side.input.edge()];
			const auto a = sheets.triangulation.halfedges(sheets.of[left.piece]);
			const auto b = sheets.triangulation.halfedges(sheets.of[right.piece]);
			if (!side.end.isValid()) { // through one end triangle
				own.offer(disk[a[0]], disk[b[0]]);
				continue;
			}
			const Halfedge h = a[m_end.corner(side.end).index()];
			const Halfedge twin = b[m_end.corner(side.end.twin()).index()];
			offerPairing(disk, sheets.lengths[h.edge()], h, twin, own);
		}
	}

	/// Numbers the surface's vertices, which are the first nodes, and the nodes in use.
	void numberPoints()
	{
		const int vertices = m_surface.triangulation.vertexCount();
		Array<int> point(m_pieces.nodes.size(), -1); // [node]
		for (int v = 0; v < vertices; ++v) {
			point[v] = v;
			m_node.push_back(v);
		}
		for (int p = 0; p < m_pieces.count(); ++p)
			for (int i = 0; i < m_pieces.size(p); ++i) {
				PieceCorner& c = m_pieces(p, i);
				if (point[c.node] < 0) {
					point[c.node] = m_node.size();
					m_node.push_back(c.node);
				}
				c.node = point[c.node];
			}
	}

	/// Triangulates all pieces.
	void emitPieces()
	{
		Array<SurfacePoint> points;
		std::vector<Point3> space; // [point]
		points.reserve(m_node.size());
		space.reserve(m_node.values().size());
		for (const int node : m_node) {
			points.push_back(m_pieces.nodes[node].point);
			space.push_back(
				placeOnSurface(m_pieces.nodes[node].point, m_surface.positions.values()));
		}
		Array<Triangle> triangles;
		Array<Triangle2> plane;
		Array<int> face;
		const int triangleCount = m_pieces.cornerCount() - 2 * m_pieces.count();
		triangles.reserve(triangleCount);
		plane.reserve(triangleCount);
		face.reserve(triangleCount);
		for (int p = 0; p < m_pieces.count(); ++p) {
			const int first = m_pieces.corner(p, 0), size = m_pieces.size(p);
			const Point2* placed = m_point.data() + first;
			// Geodesics are straight in the Klein model.
			const Point2* straight = m_kleinPoint.empty() ? placed : m_kleinPoint.data() + first;
			std::vector<Point3> inSpace;
			for (const PieceCorner& c : m_pieces.corners(p))
				inSpace.push_back(space[positionOf(c.node)]);
			for (const auto& t : triangulatePiece({straight, straight + size}, inSpace)) {
				const auto point = [&](std::size_t k) {
					return m_pieces(p, static_cast<int>(t[k])).node;
				};
				triangles.push_back({point(0), point(1), point(2)});
				plane.push_back({placed[t[0]], placed[t[1]], placed[t[2]]});
				face.push_back(m_pieces.inputFace[p].number());
			}
		}
		m_result.refinement = flatMeshOf(std::move(triangles), plane, space);
		m_result.refinement.source = std::move(points);
		m_result.refinement.face = std::move(face);
	}

	/// The layout of the corners of the surface's own triangles.
	void placeSurface()
	{
		const Triangulation& t = m_surface.triangulation;
		PlanarLayout& layout = m_result.corners;
		layout = cornerWedges(t, m_surfaceCut);
		for (int p = 0; p < m_pieces.count(); ++p)
			for (int i = 0; i < m_pieces.size(p); ++i) {
				const Halfedge h = m_pieces(p, i).inputCorner;
				// In a piece of a face that is kept it is a halfedge of the surface, and the same one.
				if (h.isValid() && !m_input.isExterior(h))
					layout[h] = m_point[m_pieces.corner(p, i)];
			}
	}

	const EmbeddedSurface& m_surface;
	const Triangulation& m_input;
	const FlowResult& m_flow;
	const Triangulation& m_end;
	const EdgeArray<char>& m_surfaceCut; // [surface edge]
	const EdgeArray<char> m_isCut;       // [input edge]

	OverlayPieces m_pieces;
	Array<Point2> m_point;      // [corner of a piece] in the plane or the disk
	Array<Point2> m_kleinPoint; // [corner of a piece] as its own sheet sees it; hyperbolic only
	Array<int> m_node;          // [point of the result]
	SurfaceLayout m_result;
};

} // namespace

SurfaceLayout
layOutRefinement(const FlowDomain& domain, const FlowResult& flow, const EdgeArray<char>& isCut)
{
	OverlayPieces pieces = [&] {
		const Task overlay(1.0 - kAfterFlow, 1.0 - kAfterFlow * (1.0 - kOverlay));
		return divideStartTriangles(domain, flow);
	}();
	return RefinementMaker(domain, flow, std::move(pieces), isCut).run();
}

} // namespace ricci
