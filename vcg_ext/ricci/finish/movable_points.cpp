// SPDX-License-Identifier: GPL-3.0-or-later
#include "movable_points.h"

#include "../base/tolerances.h"

#include <algorithm>
#include <cmath>

namespace ricci {

namespace {

using Complex = std::complex<double>;

enum class Role : char { Stays, Free, Image };

/// Decides for every wedge of a layout what its point may do.
class PointRoles
{
public:
	PointRoles(
		const Triangulation& t,
		const EdgeArray<char>& isCut,
		const VertexArray<char>& cones,
		bool boundaryMoves,
		const PlanarLayout& layout) :
			m_t(t),
			m_isCut(isCut), m_layout(layout), m_role(layout.points.size(), Role::Stays),
			m_source(layout.points.size(), -1), m_turn(layout.points.size(), 1.0),
			m_onSeam(t.vertexCount(), 0)
	{
		const VertexArray<char> boundary = t.boundaryVertices();
		for (const Vertex v : t.vertices()) {
			if (cones[v] || !t.halfedge(v).isValid())
				continue;
			int cuts = 0;
			for (const Halfedge h : t.around(v))
				cuts += isCut[h.edge()];
			if (cuts == 0 && (boundaryMoves || !boundary[v]))
				m_role[layout.wedges.of[t.halfedge(v)]] = Role::Free;
			m_onSeam[v] = cuts == 2 && !boundary[v];
		}
		Box2 box;
		for (const Point2& p : layout.points)
			box.add(p);
		m_allowedGap = kCheckedGap * box.extent();
		VertexArray<char> seen(t.vertexCount(), 0);
		for (const Vertex v : t.vertices())
			if (m_onSeam[v] && !seen[v]) {
				const std::vector<Halfedge> seam = seamThrough(v);
				for (const Halfedge h : seam)
					seen[t.origin(h)] = 1;
				joinSides(seam);
			}
	}

	/// Makes two points stay that are far from each other, by distances alone, where all are free.
	/// (Where there are seams, points at their ends stay.)
	void pinFarPoints()
	{
		if (std::any_of(m_role.begin(), m_role.end(), [](Role r) { return r != Role::Free; }))
			return;
		const int first = farthestFrom(centre()), second = farthestFrom(m_layout.points[first]);
		m_role[first] = m_role[second] = Role::Stays;
	}

	MovablePoints numbered() const
	{
		MovablePoints points;
		points.number.assign(m_role.size(), -1);
		for (const int wedge : freeWedges())
			points.number[wedge] = points.unknowns++;
		int count = points.unknowns;
		for (const Role role : {Role::Image, Role::Stays})
			for (const int wedge : m_role.indices())
				if (m_role[wedge] == role)
					points.number[wedge] = count++;
		for (const int wedge : m_role.indices())
			if (m_role[wedge] == Role::Image)
				points.images.push_back({points.number[m_source[wedge]], m_turn[wedge]});
		return points;
	}

private:
	/// The cut edge after \p h, where the seam runs through its end.
	Halfedge onward(Halfedge h) const
	{
		for (const Halfedge out : m_t.around(m_t.target(h)))
			if (m_isCut[out.edge()] && out != h.twin())
				return out;
		return h; // an edge that is a seam by itself, closed
	}

	/// The cut edges one after another, from one end of the seam to the other, or round it.
	std::vector<Halfedge> seamThrough(Vertex v) const
	{
		std::vector<Halfedge> out;
		for (const Halfedge h : m_t.around(v))
			if (m_isCut[h.edge()])
				out.push_back(h);
		Halfedge first = out[0];
		while (m_onSeam[m_t.target(first)] && m_t.target(first) != v)
			first = onward(first);
		std::vector<Halfedge> seam;
		const bool closed = m_onSeam[m_t.target(first)];
		for (Halfedge h = closed ? out[0] : first.twin();; h = onward(h)) {
			seam.push_back(h);
			const Vertex next = m_t.target(h);
			if (!m_onSeam[next] || (closed && next == v))
				return seam;
		}
	}

	/// Makes the points on the right of a seam images of those on its left, if its sides fit.
	void joinSides(const std::vector<Halfedge>& seam)
	{
		const auto right = [&](Halfedge h) { return m_t.next(h.twin()); };
		const auto count = static_cast<double>(seam.size() + 1);
		Complex leftMean = asComplex(m_layout[m_t.next(seam.back())]) / count;
		Complex rightMean = asComplex(m_layout[seam.back().twin()]) / count;
		for (const Halfedge h : seam) {
			leftMean += asComplex(m_layout[h]) / count;
			rightMean += asComplex(m_layout[right(h)]) / count;
		}
		Complex product = 0.0;
		const auto pairs = [&](const auto& use) {
			use(asComplex(m_layout[m_t.next(seam.back())]) - leftMean,
				asComplex(m_layout[seam.back().twin()]) - rightMean);
			for (const Halfedge h : seam)
				use(asComplex(m_layout[h]) - leftMean, asComplex(m_layout[right(h)]) - rightMean);
		};
		pairs([&](Complex a, Complex b) { product += b * std::conj(a); });
		const Complex turn = product / std::abs(product);
		double gap = 0.0;
		pairs([&](Complex a, Complex b) { gap = std::max(gap, std::abs(b - turn * a)); });
		if (!(gap <= m_allowedGap)) // also where the turn is no number
			return;
		for (const Halfedge h : seam)
			if (m_onSeam[m_t.origin(h)]) {
				const int source = m_layout.wedges.of[h], image = m_layout.wedges.of[right(h)];
				m_role[source] = Role::Free;
				m_role[image] = Role::Image;
				m_source[image] = source;
				m_turn[image] = turn;
			}
	}

	/// The wedges that move freely, in the order of a walk (see MovablePoints).
	std::vector<int> freeWedges() const
	{
		const Point2 middle = centre();
		VertexArray<double> reach(m_t.vertexCount(), -1.0); // from the middle
		VertexArray<int> freeAt(m_t.vertexCount(), -1);
		for (const Halfedge h : m_t.interiorHalfedges()) {
			const Vertex v = m_t.origin(h);
			const int wedge = m_layout.wedges.of[h];
			reach[v] = std::max(reach[v], distance(middle, m_layout.points[wedge]));
			if (m_role[wedge] == Role::Free)
				freeAt[v] = wedge;
		}
		const auto isBefore = [&](Vertex a, Vertex b) {
			return reach[a] != reach[b] ? reach[a] > reach[b] : a < b;
		};
		std::vector<int> wedges;
		std::vector<Vertex> walk;
		VertexArray<char> seen(m_t.vertexCount(), 0);
		const auto visit = [&](Vertex v) {
			if (seen[v])
				return;
			seen[v] = 1;
			walk.push_back(v);
		};
		Vertex farthest(0);
		for (const Vertex v : m_t.vertices())
			if (isBefore(v, farthest))
				farthest = v;
		visit(farthest);
		for (std::size_t i = 0; i < walk.size(); ++i) {
			const Vertex v = walk[i];
			if (freeAt[v] >= 0)
				wedges.push_back(freeAt[v]);
			if (!m_t.halfedge(v).isValid())
				continue;
			const std::size_t first = walk.size();
			for (const Halfedge h : m_t.around(v))
				visit(m_t.target(h));
			std::sort(walk.begin() + static_cast<std::ptrdiff_t>(first), walk.end(), isBefore);
		}
		return wedges;
	}

	Point2 centre() const
	{
		Point2 sum{0.0, 0.0};
		for (const Point2& p : m_layout.points)
			for (std::size_t k = 0; k < 2; ++k)
				sum[k] += p[k] / static_cast<double>(m_layout.points.size());
		return sum;
	}

	int farthestFrom(const Point2& from) const
	{
		int farthest = 0;
		for (const int wedge : m_layout.points.indices())
			if (distance(from, m_layout.points[wedge]) > distance(from, m_layout.points[farthest]))
				farthest = wedge;
		return farthest;
	}

	const Triangulation& m_t;
	const EdgeArray<char>& m_isCut;
	const PlanarLayout& m_layout;
	Array<Role> m_role;         // [wedge]
	Array<int> m_source;        // [wedge]
	Array<Complex> m_turn;      // [wedge]
	VertexArray<char> m_onSeam; // 1 where exactly one seam runs through, inside and without a cone
	double m_allowedGap = 0.0;
};

} // namespace

MovablePoints movablePoints(
	const Triangulation& t,
	const EdgeArray<char>& isCut,
	const VertexArray<char>& cones,
	bool boundaryMoves,
	const PlanarLayout& layout)
{
	PointRoles roles(t, isCut, cones, boundaryMoves, layout);
	roles.pinFarPoints();
	return roles.numbered();
}

} // namespace ricci
