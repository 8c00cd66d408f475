// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut_graph.h"

#include "../base/graphs.h"
#include "../base/numbers.h"
#include "../base/task.h"
#include "../base/tolerances.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace ricci {

namespace {

/// The half of a surface that is not above its mirror.
/// \param vertex receives [vertex of the half] that of the surface
/// \param edge receives [edge of the half] that of the surface
Triangulation halfOf(
	const Triangulation& t,
	const MirrorSymmetry& mirror,
	VertexArray<Vertex>& vertex,
	EdgeArray<Edge>& edge)
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
				inHalf[v] = Vertex(vertex.size());
				vertex.push_back(v);
			}
			triangles.back()[k] = inHalf[v].number();
		}
	}
	Triangulation half(vertex.size(), triangles);
	edge.resize(half.edgeCount(), Edge());
	Face own(0);
	for (const Face f : t.faces())
		if (!mirror.isAboveFace(t, f)) {
			for (std::size_t k = 0; k < 3; ++k)
				edge[half.halfedges(own)[k].edge()] = t.halfedges(f)[k].edge();
			own = Face(own.number() + 1);
		}
	return half;
}

/// Cuts along the plane, but for the most costly run of edges between vertices that are \p ends.
void cutPlane(
	const Triangulation& t,
	const MirrorSymmetry& mirror,
	const EdgeArray<double>& cost,
	const VertexArray<char>& ends,
	EdgeArray<char>& isCut)
{
	const auto isInPlane = [&](Edge e) { return mirror.edgeImage[e] == e; };
	DisjointSetsOf<Edge> runs(t.edgeCount());
	VertexArray<Edge> last(t.vertexCount());
	for (const Edge e : t.edges())
		if (isInPlane(e))
			for (const Vertex v : t.ends(e)) {
				if (last[v].isValid() && !ends[v])
					runs.merge(last[v], e);
				last[v] = e;
			}
	EdgeArray<double> ofRun(t.edgeCount(), 0.0); // [first edge]
	Edge most(0);
	for (const Edge e : t.edges())
		if (isInPlane(e)) {
			const Edge run = runs.find(e);
			ofRun[run] += cost[e];
			if (ofRun[run] > (1.0 + kTiny) * ofRun[most]) // of equal ones the first
				most = run;
		}
	for (const Edge e : t.edges())
		if (isInPlane(e) && runs.find(e) != most)
			isCut[e] = 1;
}

/// A vertex inside where n edges of a cut meet becomes n vertices, if there are any, and one on the boundary n + 1.
bool leavesDisk(const Triangulation& t, const EdgeArray<char>& isCut)
{
	DisjointSetsOf<Face> parts(t.faceCount());
	int count = t.faceCount(), characteristic = t.eulerCharacteristic();
	VertexArray<int> degree(t.vertexCount(), 0);
	for (const Edge e : t.edges())
		if (isCut[e]) {
			--characteristic;
			for (const Vertex v : t.ends(e))
				++degree[v];
		}
		else if (!t.isBoundary(e))
			count -= parts.merge(t.face(e.halfedge()), t.face(e.halfedge().twin()));
	const VertexArray<char> boundary = t.boundaryVertices();
	for (const Vertex v : t.vertices())
		characteristic += boundary[v] ? degree[v] : std::max(0, degree[v] - 1);
	return count == 1 && characteristic == 1;
}

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
	VertexArray<Vertex> vertex;
	EdgeArray<Edge> edge;
	const Triangulation half = halfOf(t, mirror, vertex, edge);
	VertexArray<char> conesOfHalf(half.vertexCount(), 0);
	for (const Vertex v : half.vertices())
		conesOfHalf[v] = cones[vertex[v]] && mirror.image[vertex[v]] != vertex[v];
	double barred = 0.0; // costs more than any way
	for (const double c : cost)
		barred += c < kInfinity ? c : 0.0;
	EdgeArray<double> costOfHalf(half.edgeCount(), barred);
	for (const Edge e : half.edges())
		if (mirror.edgeImage[edge[e]].isValid())
			costOfHalf[e] = cost[edge[e]];
	const auto ofHalf = attempt(
		"another cut is taken", [&] { return cutToDisk(half, costOfHalf, conesOfHalf).isCut; });
	if (!ofHalf)
		return std::nullopt;
	EdgeArray<char> isCut(t.edgeCount(), 0);
	VertexArray<char> ends = cones; // and where the cut meets the plane
	for (const Edge e : half.edges()) {
		if (!(*ofHalf)[e])
			continue;
		if (costOfHalf[e] == barred)
			return std::nullopt;
		isCut[edge[e]] = isCut[mirror.edgeImage[edge[e]]] = 1;
		for (const Vertex v : t.ends(edge[e]))
			ends[v] = ends[v] || mirror.image[v] == v;
	}
	cutPlane(t, mirror, cost, ends, isCut);
	if (!leavesDisk(t, isCut))
		return std::nullopt;
	CutGraph cut = cutGraphOf(t, cones, std::move(isCut));
	cut.isMirrored = true;
	return cut;
}

} // namespace ricci
