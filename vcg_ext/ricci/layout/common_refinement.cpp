// SPDX-License-Identifier: GPL-3.0-or-later
#include "common_refinement.h"

#include "../error.h"
#include "../numbers.h"
#include "hyperbolic_layout.h"
#include "overlay_pieces.h"
#include "piece_triangulation.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>

namespace ricci {

namespace {

/// Lays the pieces of an overlay out and puts them together.
class Overlay
{
public:
	Overlay(
		const FlippedSurface& s,
		const std::vector<Point3>& positions,
		const std::vector<char>& isCut,
		const OverlayListener& listener) :
			m_s(s),
			m_positions(positions), m_isCut(isCut), m_listener(listener), m_input(*s.input),
			m_end(*s.end),
			m_pieces(divideStartTriangles(s, [&](double share, std::size_t crossings) {
				listener(kDivision * share, crossings);
			}))
	{
	}

	CommonRefinement run()
	{
		const std::size_t crossings = m_pieces.nodes.size() - at(m_end.vertexCount());
		m_listener(kDivision, crossings);
		linkPieces();
		findFaces();
		dropPieces();
		m_listener(kLinked, crossings);
		layOut();
		m_listener(kLaidOut, crossings);
		m_links = std::vector<std::array<Link, 2>>();
		return result();
	}

private:
	/// Shares of the work that are done after the division, the faces of the pieces, the layout.
	static constexpr double kDivision = 0.5, kLinked = 0.65, kLaidOut = 0.85;

	/// The two pieces at every side.
	struct Link
	{
		int piece = -1, corner = -1;
	};

	void linkPieces()
	{
		m_links.assign(at(m_pieces.sideCount), {Link(), Link()});
		for (int p = 0; p < m_pieces.count(); ++p)
			for (int i = 0; i < m_pieces.size(p); ++i) {
				auto& link = m_links[at(m_pieces(p, i).side)];
				(link[0].piece < 0 ? link[0] : link[1]) = {p, i};
			}
	}

	Link across(int piece, int corner) const
	{
		const auto& link = m_links[at(m_pieces(piece, corner).side)];
		return link[0].piece == piece && link[0].corner == corner ? link[1] : link[0];
	}

	/// Input and end face of every piece: from its sides, corners or nodes, else from a neighbour.
	void findFaces()
	{
		m_inputFace.assign(at(m_pieces.count()), -1);
		m_endFace.assign(at(m_pieces.count()), -1);
		for (int p = 0; p < m_pieces.count(); ++p)
			for (const PieceCorner& c : m_pieces.corners(p)) {
				if (c.input >= 0)
					m_inputFace[at(p)] = m_input.face(c.input);
				else if (c.inputCorner >= 0)
					m_inputFace[at(p)] = m_input.face(c.inputCorner);
				if (c.end >= 0)
					m_endFace[at(p)] = m_end.face(c.end);
				else if (c.endCorner >= 0)
					m_endFace[at(p)] = m_end.face(c.endCorner);
				else if (m_pieces.nodes[at(c.node)].end.kind == EndPlace::Face)
					m_endFace[at(p)] = m_pieces.nodes[at(c.node)].end.element;
			}
		spread(m_inputFace, [](const PieceCorner& c) { return c.input >= 0; });
		spread(m_endFace, [](const PieceCorner& c) { return c.end >= 0; });
		for (std::size_t p = 0; p < m_inputFace.size(); ++p)
			if (m_inputFace[p] < 0 || m_endFace[p] < 0)
				throw Error(kInconsistentOverlay);
	}

	/// Forgets the pieces of the input's faces that are not wanted.
	void dropPieces()
	{
		if (m_s.keptFaces >= m_input.faceCount())
			return;
		m_pieces.keep([&](int p) { return m_inputFace[at(p)] < m_s.keptFaces; });
		std::size_t kept = 0;
		for (std::size_t p = 0; p < m_inputFace.size(); ++p)
			if (m_inputFace[p] < m_s.keptFaces) {
				m_inputFace[kept] = m_inputFace[p];
				m_endFace[kept++] = m_endFace[p];
			}
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
			for (int i = 0; i < m_pieces.size(queue[head]); ++i) {
				if (isBorder(m_pieces(queue[head], i)))
					continue;
				const Link next = across(queue[head], i);
				if (next.piece >= 0 && face[at(next.piece)] < 0) {
					face[at(next.piece)] = face[at(queue[head])];
					queue.push_back(next.piece);
				}
			}
		}
	}

	/// Weights of the corners of a piece's end triangle, in the order of halfedges(), at a corner
	/// of the piece.
	std::array<double, 3> inEndTriangle(int p, int corner) const
	{
		const PieceCorner& c = m_pieces(p, corner);
		const int f = m_endFace[at(p)];
		const EndPlace& end = m_pieces.nodes[at(c.node)].end;
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
				throw Error(kInconsistentOverlay);
			return pointOnSide(m_end, g, 0.0).weight;
		}
		const auto offer = [&](int other) {
			if (other >= 0 && Triangulation::edge(other) == end.element && m_end.face(other) == f)
				g = other;
		};
		for (int other : m_end.halfedges(f))
			offer(other);
		offer(m_pieces(p, corner + m_pieces.size(p) - 1).end);
		offer(c.end);
		if (g < 0)
			throw Error(kInconsistentOverlay);
		return pointOnSide(m_end, g, g % 2 == 0 ? end.along : 1.0 - end.along).weight;
	}

	bool isClosed(const PieceCorner& c) const
	{
		return c.input >= 0 && m_isCut[at(Triangulation::edge(c.input))];
	}

	/// The end triangles as they are laid out. The cut runs on input edges, through end triangles: a
	/// triangle that it divides is drawn once for each of its parts.
	struct Sheets
	{
		std::vector<int> of; ///< [piece]
		std::vector<Triangle> triangles;
		std::vector<int> endFace; ///< [sheet]
		std::vector<int> glued;   ///< [3 sheet + side] side across it, or -1
	};

	Sheets makeSheets() const
	{
		std::vector<int> parent(m_endFace.size());
		std::iota(parent.begin(), parent.end(), 0);
		for (const auto& link : m_links) {
			if (link[1].piece < 0)
				continue;
			const PieceCorner& side = m_pieces(link[0].piece, link[0].corner);
			if (!isClosed(side) && side.end < 0)
				mergeSets(parent, link[0].piece, link[1].piece);
		}
		Sheets sheets;
		do
			sheets = sheetsOf(parent);
		while (!glue(sheets, parent));
		return sheets;
	}

	/// One sheet for each set of pieces.
	Sheets sheetsOf(std::vector<int>& parent) const
	{
		Sheets sheets;
		sheets.of.assign(parent.size(), -1);
		for (std::size_t p = 0; p < parent.size(); ++p) {
			if (findSet(parent, static_cast<int>(p)) != static_cast<int>(p))
				continue;
			sheets.of[p] = static_cast<int>(sheets.triangles.size());
			const auto h = m_end.halfedges(m_endFace[p]);
			sheets.triangles.push_back(
				{m_end.origin(h[0]), m_end.origin(h[1]), m_end.origin(h[2])});
			sheets.endFace.push_back(m_endFace[p]);
		}
		for (std::size_t p = 0; p < parent.size(); ++p)
			sheets.of[p] = sheets.of[at(findSet(parent, static_cast<int>(p)))];
		return sheets;
	}

	/// Glues the sheets. The cut is straight in another metric than the end edges and may cross one
	/// of them twice with no vertex between: it then cuts parts off that lie across one side of one
	/// sheet. They have one place in the layout and become one set of \p parent.
	/// \return false if there are such
	bool glue(Sheets& sheets, std::vector<int>& parent) const
	{
		const auto sideOf = [&](int piece, int halfedge) {
			const int s = sheets.of[at(piece)];
			const auto h = m_end.halfedges(sheets.endFace[at(s)]);
			return 3 * s + static_cast<int>(std::find(h.begin(), h.end(), halfedge) - h.begin());
		};
		std::vector<int> pieceAt(3 * sheets.triangles.size(), -1); // [side] one across it
		sheets.glued.assign(3 * sheets.triangles.size(), -1);
		bool fits = true;
		for (const auto& link : m_links) {
			if (link[1].piece < 0)
				continue;
			const PieceCorner& side = m_pieces(link[0].piece, link[0].corner);
			if (isClosed(side) || side.end < 0)
				continue;
			const int a = sideOf(link[0].piece, side.end);
			const int b = sideOf(link[1].piece, Triangulation::twin(side.end));
			for (const auto& [from, to, piece] :
				 {std::array<int, 3>{a, b, link[1].piece}, {b, a, link[0].piece}}) {
				int& known = sheets.glued[at(from)];
				if (known >= 0 && known != to) {
					mergeSets(parent, pieceAt[at(from)], piece);
					fits = false;
				}
				known = to;
				pieceAt[at(from)] = piece;
			}
		}
		return fits;
	}

	/// Lays the end triangles out and places the pieces in them.
	void layOut()
	{
		const Sheets drawn = makeSheets();
		const std::vector<int>& sheet = drawn.of;
		const std::vector<int>& faceOfSheet = drawn.endFace;
		const Triangulation sheets(m_end.vertexCount(), drawn.triangles, drawn.glued);
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
			placePieces([&](int p, int corner) {
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
		placePieces([&](int p, int corner) {
			const int h = sheets.halfedge(sheet[at(p)]);
			const double side = lengths[at(Triangulation::edge(h))];
			const double other = lengths[at(Triangulation::edge(sheets.previous(h)))];
			const std::complex<double> z = rounded(disk.frame[at(h)])(
				hyperbolicPlace(inEndTriangle(p, corner), side, other, angles[at(h)]).inDisk());
			return Point2{z.real(), z.imag()};
		});
		m_kleinPoint.reserve(m_point.size());
		for (int p = 0; p < m_pieces.count(); ++p) {
			const int h = sheets.halfedge(sheet[at(p)]);
			const double side = lengths[at(Triangulation::edge(h))];
			const double other = lengths[at(Triangulation::edge(sheets.previous(h)))];
			for (int i = 0; i < m_pieces.size(p); ++i)
				m_kleinPoint.push_back(
					hyperbolicPlace(inEndTriangle(p, i), side, other, angles[at(h)])
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
			const bool firstIsLeft = m_pieces(link[0].piece, link[0].corner).input % 2 == 0;
			const Link &left = link[firstIsLeft ? 0 : 1], &right = link[firstIsLeft ? 1 : 0];
			const PieceCorner& side = m_pieces(left.piece, left.corner);
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
		std::vector<int> parent(at(m_pieces.cornerCount()));
		std::iota(parent.begin(), parent.end(), 0);
		for (const auto& link : m_links) {
			const Link &a = link[0], &b = link[1];
			if (b.piece < 0 || isClosed(m_pieces(a.piece, a.corner)))
				continue;
			mergeSets(
				parent, m_pieces.corner(a.piece, a.corner), m_pieces.corner(b.piece, b.corner + 1));
			mergeSets(
				parent, m_pieces.corner(a.piece, a.corner + 1), m_pieces.corner(b.piece, b.corner));
		}
		m_point.resize(parent.size());
		for (int p = 0; p < m_pieces.count(); ++p)
			for (int i = 0; i < m_pieces.size(p); ++i) {
				const int corner = m_pieces.corner(p, i), first = findSet(parent, corner);
				m_point[at(corner)] = first == corner ? place(p, i) : m_point[at(first)];
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
		std::vector<int> point(m_pieces.nodes.size(), -1), nodes; // node of each point
		for (int v = 0; v < vertices; ++v) {
			point[at(v)] = v;
			nodes.push_back(v);
		}
		for (int p = 0; p < m_pieces.count(); ++p)
			for (int i = 0; i < m_pieces.size(p); ++i) {
				PieceCorner& c = m_pieces(p, i);
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
				r.points.push_back(m_pieces.nodes[at(node)].point);
				space.push_back(placeOnSurface(r.points.back(), m_positions));
			}
			for (int p = 0; p < m_pieces.count(); ++p)
				emit(p, space, r);
		}

		r.transition = m_transition;
		int sectorCount = 0;
		r.inputLayout.sector = cornerSectors(m_input, m_isCut, sectorCount);
		r.inputLayout.position.assign(at(sectorCount), {0.0, 0.0});
		for (int p = 0; p < m_pieces.count(); ++p)
			for (int i = 0; i < m_pieces.size(p); ++i) {
				const int h = m_pieces(p, i).inputCorner;
				if (h >= 0 && !m_input.isOuter(h))
					r.inputLayout.position[at(r.inputLayout.sector[at(h)])] =
						m_point[at(m_pieces.corner(p, i))];
			}
		return r;
	}

	/// Triangles of a piece, into the result.
	void emit(int p, const std::vector<Point3>& space, CommonRefinement& r) const
	{
		const int first = m_pieces.corner(p, 0), size = m_pieces.size(p);
		const Point2* plane = &m_point[at(first)];
		// Geodesics are straight in the Klein model.
		const Point2* straight = m_kleinPoint.empty() ? plane : &m_kleinPoint[at(first)];
		const std::vector<Point2> inPlane(straight, straight + size);
		std::vector<Point3> inSpace;
		for (const PieceCorner& c : m_pieces.corners(p))
			inSpace.push_back(space[at(c.node)]);
		for (const auto& t : triangulatePiece(inPlane, inSpace)) {
			const auto node = [&](std::size_t k) {
				return m_pieces(p, static_cast<int>(t[k])).node;
			};
			r.triangles.push_back({node(0), node(1), node(2)});
			r.inputFace.push_back(m_inputFace[at(p)]);
			r.uv.push_back({plane[t[0]], plane[t[1]], plane[t[2]]});
		}
	}

	const FlippedSurface& m_s;
	const std::vector<Point3>& m_positions;
	const std::vector<char>& m_isCut;
	const OverlayListener& m_listener;
	const Triangulation& m_input;
	const Triangulation& m_end;

	OverlayPieces m_pieces;
	std::vector<std::array<Link, 2>> m_links;
	std::vector<int> m_inputFace, m_endFace;
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
	const std::vector<char>& isCut,
	const OverlayListener& listener)
{
	return Overlay(surface, positions, isCut, listener).run();
}

} // namespace ricci
