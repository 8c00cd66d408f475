// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut_graph.h"

#include "../base/graphs.h"
#include "../base/numbers.h"
#include "../base/task.h"
#include "../base/tolerances.h"
#include "../error.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace ricci {

namespace {

/// Of the places where the cut of a half meets the plane, so many are tried as the only one.
constexpr int kMaxMeetings = 8;

/// Cuts of a surface that its mirror takes to themselves.
class MirroredCuts
{
public:
	MirroredCuts(
		const Triangulation& t,
		const MirrorSymmetry& mirror,
		const EdgeArray<double>& cost,
		const VertexArray<char>& cones) :
			m_t(t),
			m_mirror(mirror), m_cost(cost), m_cones(cones), m_loop(t.vertexCount())
	{
		VertexArray<Vertex> inHalf(t.vertexCount());
		std::vector<Triangle> triangles;
		for (const Face f : t.faces()) {
			if (mirror.isAboveFace(t, f))
				continue;
			triangles.emplace_back();
			for (std::size_t k = 0; k < 3; ++k) {
				const Vertex v = t.vertices(f)[k];
				if (!inHalf[v].isValid()) {
					inHalf[v] = Vertex(m_vertex.size());
					m_vertex.push_back(v);
				}
				triangles.back()[k] = inHalf[v].number();
			}
		}
		m_half = Triangulation(m_vertex.size(), triangles);
		m_edge.resize(m_half.edgeCount(), Edge());
		Face own(0);
		for (const Face f : t.faces())
			if (!mirror.isAboveFace(t, f)) {
				for (std::size_t k = 0; k < 3; ++k)
					m_edge[m_half.halfedges(own)[k].edge()] = t.halfedges(f)[k].edge();
				own = Face(own.number() + 1);
			}
		m_coneOfHalf.resize(m_half.vertexCount(), 0);
		for (const Vertex v : m_half.vertices())
			m_coneOfHalf[v] = cones[m_vertex[v]] && mirror.image[m_vertex[v]] != m_vertex[v];
		for (const double c : cost)
			m_barred += c < kInfinity ? c : 0.0;
		for (const Edge e : t.edges())
			if (isInPlane(e))
				m_loop.merge(t.ends(e)[0], t.ends(e)[1]);
	}

	/// \param meeting the only vertex in the plane, beside cones, at which the cut of the half may end on its loop or line;
	/// none: it may anywhere
	/// \return empty if there is none, or it leaves no disk
	EdgeArray<char> cut(Vertex meeting)
	{
		EdgeArray<double> cost(m_half.edgeCount(), m_barred);
		for (const Edge e : m_half.edges())
			if (m_mirror.edgeImage[m_edge[e]].isValid() && mayEnd(e, meeting))
				cost[e] = m_cost[m_edge[e]];
		const auto ofHalf = attempt(
			"another cut is taken", [&] { return cutToDisk(m_half, cost, m_coneOfHalf).isCut; });
		if (!ofHalf)
			return {};
		EdgeArray<char> isCut(m_t.edgeCount(), 0);
		m_isMet.assign(m_t.vertexCount(), 0);
		for (const Edge e : m_half.edges()) {
			if (!(*ofHalf)[e])
				continue;
			if (cost[e] == m_barred)
				return {};
			isCut[m_edge[e]] = isCut[m_mirror.edgeImage[m_edge[e]]] = 1;
			for (const Vertex v : m_t.ends(m_edge[e]))
				m_isMet[v] = m_mirror.image[v] == v;
		}
		cutPlane(isCut);
		return leavesDisk(isCut) ? std::move(isCut) : EdgeArray<char>();
	}

	/// Where the last cut has met the plane.
	std::vector<Vertex> meetings() const
	{
		std::vector<Vertex> met;
		for (const Vertex v : m_isMet.indices())
			if (m_isMet[v])
				met.push_back(v);
		return met;
	}

private:
	bool isInPlane(Edge e) const { return m_mirror.edgeImage[e] == e; }

	bool mayEnd(Edge ofHalf, Vertex meeting)
	{
		for (const Vertex v : m_t.ends(m_edge[ofHalf]))
			if (meeting.isValid() && v != meeting && m_mirror.image[v] == v && !m_cones[v] &&
				m_loop.find(v) == m_loop.find(meeting))
				return false;
		return true;
	}

	/// Cuts along the plane, but for the most costly run of edges between places where the cut meets it, and cones.
	void cutPlane(EdgeArray<char>& isCut) const
	{
		DisjointSetsOf<Edge> runs(m_t.edgeCount());
		VertexArray<Edge> last(m_t.vertexCount());
		for (const Edge e : m_t.edges())
			if (isInPlane(e))
				for (const Vertex v : m_t.ends(e)) {
					if (last[v].isValid() && !m_isMet[v] && !m_cones[v])
						runs.merge(last[v], e);
					last[v] = e;
				}
		EdgeArray<double> cost(m_t.edgeCount(), 0.0); // [first edge of a run]
		Edge most(0);
		for (const Edge e : m_t.edges())
			if (isInPlane(e)) {
				const Edge run = runs.find(e);
				cost[run] += m_cost[e];
				if (cost[run] > (1.0 + kTiny) * cost[most]) // of equal ones the first
					most = run;
			}
		for (const Edge e : m_t.edges())
			if (isInPlane(e) && runs.find(e) != most)
				isCut[e] = 1;
	}

	/// A vertex inside where n edges of a cut meet becomes n vertices, if there are any, and one on the boundary n + 1.
	bool leavesDisk(const EdgeArray<char>& isCut) const
	{
		DisjointSetsOf<Face> parts(m_t.faceCount());
		int count = m_t.faceCount(), characteristic = m_t.eulerCharacteristic();
		VertexArray<int> degree(m_t.vertexCount(), 0);
		for (const Edge e : m_t.edges())
			if (isCut[e]) {
				--characteristic;
				for (const Vertex v : m_t.ends(e))
					++degree[v];
			}
			else if (!m_t.isBoundary(e))
				count -= parts.merge(m_t.face(e.halfedge()), m_t.face(e.halfedge().twin()));
		const VertexArray<char> boundary = m_t.boundaryVertices();
		for (const Vertex v : m_t.vertices())
			characteristic += boundary[v] ? degree[v] : std::max(0, degree[v] - 1);
		return count == 1 && characteristic == 1;
	}

	const Triangulation& m_t;
	const MirrorSymmetry& m_mirror;
	const EdgeArray<double>& m_cost;
	const VertexArray<char>& m_cones;
	DisjointSetsOf<Vertex> m_loop; // the loops and lines in the plane
	Triangulation m_half;          // that is number 0
	VertexArray<Vertex> m_vertex;  // [vertex of the half]
	EdgeArray<Edge> m_edge;        // [edge of the half]
	VertexArray<char> m_coneOfHalf;
	double m_barred = 0.0;     // costs more than any way
	VertexArray<char> m_isMet; // by the last cut
};

} // namespace

std::optional<CutGraph> mirroredCut(
	const Triangulation& t,
	const MirrorSymmetry& mirror,
	const EdgeArray<double>& cost,
	const VertexArray<char>& cones)
{
	for (const Vertex v : cones.indices())
		if (cones[v] && !(mirror.image[v].isValid() && cones[mirror.image[v]]))
			return std::nullopt;
	MirroredCuts cuts(t, mirror, cost, cones);
	std::optional<CutGraph> best;
	const auto take = [&](EdgeArray<char> isCut) {
		if (isCut.empty())
			return;
		CutGraph cut = cutGraphOf(t, cost, cones, std::move(isCut));
		cut.isMirrored = true;
		if (!best || cut.length < (1.0 - kTiny) * best->length)
			best = std::move(cut);
	};
	take(cuts.cut(Vertex()));
	std::vector<Vertex> meetings = cuts.meetings();
	if (meetings.size() > kMaxMeetings)
		meetings.resize(kMaxMeetings);
	for (const Vertex v : meetings)
		take(cuts.cut(v));
	return best;
}

} // namespace ricci
