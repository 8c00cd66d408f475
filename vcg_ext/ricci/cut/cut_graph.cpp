// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut_graph.h"

#include "../base/graphs.h"
#include "../base/numbers.h"
#include "../base/tolerances.h"
#include "../error.h"
#include "../metric/area.h"
#include "../numerics/sparse_cholesky.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace ricci {

namespace {

using NodePaths = SearchFront<Vertex, Halfedge>;

/// The edges of a surface that a cut may use, as a graph in which every boundary loop is drawn
/// together into one node. A node has the number of a vertex: its own, or one of its loop.
class ContractedGraph
{
public:
	/// \param cost must outlive the graph
	ContractedGraph(const Triangulation& t, const EdgeArray<double>& cost) :
			m_t(t), m_cost(cost), m_node(t.vertexCount())
	{
		for (const Vertex v : t.vertices())
			m_node[v] = v;
		for (const Halfedge first : t.boundaryLoops()) {
			for (const Halfedge h : t.loop(first))
				m_node[t.origin(h)] = t.origin(first);
			m_loopNodes.push_back(t.origin(first));
		}
		m_halfedges = Adjacency<Vertex, Halfedge>(t.vertexCount(), [&](const auto& add) {
			for (const Halfedge h : t.halfedges())
				if (isUsable(h.edge()))
					add(node(t.origin(h)), h);
		});
	}

	const Triangulation& surface() const { return m_t; }
	double cost(Edge e) const { return m_cost[e]; }
	bool isUsable(Edge e) const { return !m_t.isBoundary(e) && m_cost[e] < kInfinity; }

	Vertex node(Vertex v) const { return m_node[v]; }
	Vertex from(Edge e) const { return node(m_t.origin(e.halfedge())); }
	Vertex to(Edge e) const { return node(m_t.target(e.halfedge())); }
	ItemRange<const Halfedge> halfedges(Vertex node) const { return m_halfedges[node]; }
	const std::vector<Vertex>& loopNodes() const { return m_loopNodes; }

	/// [node] 1 where the cut must arrive: boundary loops and marked vertices.
	VertexArray<char> terminals(const VertexArray<char>& marked) const
	{
		VertexArray<char> terminal(m_t.vertexCount(), 0);
		for (const Vertex n : m_loopNodes)
			terminal[n] = 1;
		for (const Vertex v : marked.indices())
			if (marked[v])
				terminal[node(v)] = 1;
		return terminal;
	}

	NodePaths pathsFrom(const std::vector<Vertex>& roots) const
	{
		return shortestPaths<Vertex, Halfedge>(
			m_t.vertexCount(), roots, [&](Vertex n, const auto& visit) {
				for (const Halfedge h : halfedges(n))
					visit(node(m_t.target(h)), cost(h.edge()), h);
			});
	}

private:
	const Triangulation& m_t;
	const EdgeArray<double>& m_cost;
	VertexArray<Vertex> m_node;
	std::vector<Vertex> m_loopNodes;
	Adjacency<Vertex, Halfedge> m_halfedges;
};

/// The edges of a spanning tree of the graph, and those that neither it nor a spanning tree of the dual crosses. The
/// first tree consists of shortest paths to the nearest terminal, joined by edges of which those that belong to
/// the shortest connections of two terminals come first. Without its dead ends it is at most twice as long as
/// the shortest tree through the terminals [Mehlhorn 1988].
EdgeArray<char>
treeAndLoops(const ContractedGraph& graph, const VertexArray<char>& terminal, Vertex root)
{
	const Triangulation& t = graph.surface();
	std::vector<Vertex> roots;
	for (const Vertex n : t.vertices())
		if (terminal[n])
			roots.push_back(n);
	if (roots.empty())
		roots.push_back(root.isValid() ? root : t.origin(t.halfedge(Face(0))));
	const NodePaths paths = graph.pathsFrom(roots);
	EdgeArray<char> isCut(t.edgeCount(), 0);
	DisjointSetsOf<Vertex> joined(t.vertexCount());
	for (const Halfedge h : paths.parents())
		if (h.isValid()) {
			isCut[h.edge()] = 1;
			joined.merge(graph.node(t.origin(h)), graph.node(t.target(h)));
		}
	// Of the path or loop that an edge closes. The dual tree crosses first what the cut must not use.
	EdgeArray<double> length(t.edgeCount(), kInfinity);
	std::vector<std::pair<double, Edge>> connections;
	for (const Edge e : t.edges()) {
		const Vertex a = graph.from(e), b = graph.to(e);
		if (graph.isUsable(e))
			length[e] = paths[a] + graph.cost(e) + paths[b];
		if (length[e] < kInfinity && joined.find(a) != joined.find(b))
			connections.push_back({length[e], e});
	}
	std::sort(connections.begin(), connections.end());
	for (const auto& [d, e] : connections)
		if (joined.merge(graph.from(e), graph.to(e)))
			isCut[e] = 1;
	const std::vector<Edge> rest = edgesBesideCotree(t, isCut, length);
	if (!rest.empty() && length[rest.front()] == kInfinity) // the longest
		throw NotConverged(NotConverged::NoCut);
	for (const Edge e : rest)
		isCut[e] = 1;
	return isCut;
}

/// Removes dead ends that are not terminals.
void prune(const ContractedGraph& graph, const VertexArray<char>& terminal, EdgeArray<char>& isCut)
{
	const Triangulation& t = graph.surface();
	VertexArray<int> degree(t.vertexCount(), 0); // [node]
	for (const Edge e : t.edges())
		if (isCut[e]) {
			++degree[graph.from(e)];
			++degree[graph.to(e)];
		}
	std::vector<Vertex> leaves;
	for (const Vertex n : t.vertices())
		if (degree[n] == 1 && !terminal[n])
			leaves.push_back(n);
	while (!leaves.empty()) {
		const Vertex leaf = leaves.back();
		leaves.pop_back();
		for (const Halfedge h : graph.halfedges(leaf)) {
			if (!isCut[h.edge()])
				continue;
			isCut[h.edge()] = 0;
			const Vertex other = graph.node(t.target(h));
			--degree[leaf];
			if (--degree[other] == 1 && !terminal[other])
				leaves.push_back(other);
		}
	}
}

/// Edges of the cut outside a spanning tree of it.
std::vector<Edge> generators(const ContractedGraph& graph, const CutGraph& cut)
{
	DisjointSetsOf<Vertex> joined(graph.surface().vertexCount());
	std::vector<Edge> edges;
	for (const Edge e : cut.isCut.indices())
		if (cut.isCut[e] && !joined.merge(graph.from(e), graph.to(e)))
			edges.push_back(e);
	return edges;
}

Vertex farthest(const ContractedGraph& graph, const NodePaths& paths)
{
	Vertex far = graph.node(Vertex(0));
	for (const Vertex v : graph.surface().vertices())
		if (paths[graph.node(v)] > paths[far])
			far = graph.node(v);
	return far;
}

/// The middle of a way that is about as long as any.
Vertex centreOf(const ContractedGraph& graph)
{
	Vertex end = farthest(graph, graph.pathsFrom({graph.node(Vertex(0))}));
	const NodePaths paths = graph.pathsFrom({end});
	end = farthest(graph, paths);
	const double half = 0.5 * paths[end];
	while (paths[end] > half)
		end = graph.node(graph.surface().origin(paths.parent(end)));
	return end;
}

} // namespace

CutGraph
cutAroundCentre(const Triangulation& t, const EdgeArray<double>& lengths, VertexArray<char> cones)
{
	const ContractedGraph graph(t, lengths);
	const NodePaths paths = graph.pathsFrom({centreOf(graph)});
	EdgeArray<double> nearness(t.edgeCount());
	for (const Edge e : t.edges())
		nearness[e] = -std::max(paths[graph.from(e)], paths[graph.to(e)]);
	EdgeArray<char> isCut(t.edgeCount(), 0);
	for (const Edge e : edgesBesideCotree(t, isCut, nearness))
		isCut[e] = 1;
	prune(graph, graph.terminals(cones), isCut);
	return cutGraphOf(t, std::move(cones), std::move(isCut));
}

CutGraph cutToDisk(
	const Triangulation& t, const EdgeArray<double>& cost, VertexArray<char> cones, Vertex root)
{
	const ContractedGraph graph(t, cost);
	const VertexArray<char> terminal = graph.terminals(cones);
	EdgeArray<char> isCut = treeAndLoops(graph, terminal, root);
	prune(graph, terminal, isCut);
	shortenCut(t, cost, cones, isCut);
	return cutGraphOf(t, std::move(cones), std::move(isCut));
}

CutGraph cutGraphOf(const Triangulation& t, VertexArray<char> cones, EdgeArray<char> isCut)
{
	const EdgeArray<double> noCost(t.edgeCount(), 0.0);
	const ContractedGraph graph(t, noCost);
	CutGraph cut;
	cut.isCut = std::move(isCut);
	cut.generators = generators(graph, cut);
	cut.cones = std::move(cones);
	return cut;
}

void dropSeamsToHoles(const Triangulation& t, const VertexArray<char>& closes, CutGraph& cut)
{
	const EdgeArray<double> noCost(t.edgeCount(), 0.0);
	const ContractedGraph graph(t, noCost);
	VertexArray<char> terminal(t.vertexCount(), 0); // [node]
	for (const Vertex v : t.vertices())
		if (cut.cones[v])
			terminal[graph.node(v)] = 1;
	for (const Vertex n : graph.loopNodes())
		if (!closes[n])
			terminal[n] = 1;
	prune(graph, terminal, cut.isCut);
}

std::vector<std::vector<Halfedge>>
seamsOf(const Triangulation& t, const EdgeArray<char>& isCut, const VertexArray<char>& cones)
{
	VertexArray<int> degree(t.vertexCount(), 0);
	for (const Halfedge h : t.halfedges())
		degree[t.origin(h)] += isCut[h.edge()];
	const VertexArray<char> boundary = t.boundaryVertices();
	const auto endsAt = [&](Vertex v) { return degree[v] != 2 || boundary[v] || cones[v]; };
	std::vector<std::vector<Halfedge>> seams;
	EdgeArray<char> isDone(t.edgeCount(), 0);
	const auto walk = [&](Halfedge h) {
		seams.emplace_back();
		for (;;) {
			seams.back().push_back(h);
			isDone[h.edge()] = 1;
			if (endsAt(t.target(h)))
				return;
			Halfedge next;
			for (const Halfedge g : t.around(t.target(h)))
				if (g != h.twin() && isCut[g.edge()])
					next = g;
			if (isDone[next.edge()])
				return;
			h = next;
		}
	};
	for (const bool fromEnds : {true, false})
		for (const Halfedge h : t.halfedges())
			if (isCut[h.edge()] && !isDone[h.edge()] && (!fromEnds || endsAt(t.origin(h))))
				walk(h);
	return seams;
}

namespace {

/// Cost factor at exposure 1, less 1.
constexpr double kMaxFactor = 9.0;

/// Time of the smoothing step as a share of the area: features up to sqrt(this) of the size go.
constexpr double kSmoothing = 1.0 / 400.0;

/// The places after one implicit step of mean curvature flow, by rows: the solution x of
/// (M + L) x = M place, with the masses M and the Laplacian L with the \p weights of the edges.
Eigen::MatrixX3d smoothedPlaces(
	const Triangulation& t,
	const EdgeArray<double>& weights,
	const VertexVector& mass,
	const Eigen::MatrixX3d& place)
{
	VertexArray<int> row(t.vertexCount());
	std::iota(row.begin(), row.end(), 0);
	SparseCholesky cholesky;
	if (!cholesky.factorize(laplacian(t, weights, row, mass)))
		throw SolverFailed(SolverFailed::SeamCost);
	Eigen::MatrixX3d smooth(place.rows(), 3);
	for (int k = 0; k < 3; ++k)
		smooth.col(k) = cholesky.solve(mass.cwiseProduct(place.col(k)));
	return smooth;
}

} // namespace

VertexArray<double> exposure(
	const Triangulation& t, const EdgeArray<double>& lengths, const VertexArray<Point3>& positions)
{
	VertexArray<double> result(t.vertexCount(), 0.5);
	const double area = euclideanArea(t, lengths);
	if (!(area > 0.0))
		return result;
	VertexVector mass = areaShares(t, lengths);
	mass.array() += kTiny / static_cast<double>(t.vertexCount());
	EdgeArray<double> weights = cotangentWeights(t, lengths, kMaxCotangent);
	for (double& w : weights)
		w = kSmoothing * std::max(w, kMinCotangentWeight);
	Eigen::MatrixX3d place(t.vertexCount(), 3), normal = Eigen::MatrixX3d::Zero(t.vertexCount(), 3);
	for (const Vertex v : t.vertices())
		place.row(v.number()) = Eigen::RowVector3d::Map(positions[v].data());
	for (const Face f : t.faces()) { // sum of the faces' normals, twice as long as their areas
		const auto [a, b, c] = t.vertices(f);
		const Eigen::RowVector3d p = place.row(a.number());
		const Eigen::RowVector3d twice =
			(place.row(b.number()) - p).cross(place.row(c.number()) - p);
		for (const Vertex v : {a, b, c})
			normal.row(v.number()) += twice;
	}
	const Eigen::MatrixX3d smooth = smoothedPlaces(t, weights, mass, place);
	VertexArray<double> height(t.vertexCount(), 0.0);
	double square = 0.0;
	for (const Vertex v : t.vertices()) {
		const auto n = normal.row(v.number());
		const double length = n.norm();
		if (length > 0.0)
			height[v] = (place.row(v.number()) - smooth.row(v.number())).dot(n) / length;
		square += mass[v] * height[v] * height[v];
	}
	const double typical = std::sqrt(square);
	// A sphere stands out everywhere alike; a plane not at all except for rounding.
	if (typical > kTiny * std::sqrt(area))
		for (const Vertex v : t.vertices())
			result[v] = 0.5 * (1.0 + std::tanh(height[v] / typical));
	return result;
}

EdgeArray<double> seamCost(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const VertexArray<Point3>& positions,
	double hiding)
{
	EdgeArray<double> cost = lengths;
	if (hiding == 0.0)
		return cost;
	const VertexArray<double> exposed = exposure(t, lengths, positions);
	for (const Edge e : t.edges()) {
		const auto [a, b] = t.ends(e);
		cost[e] *= 1.0 + 0.5 * kMaxFactor * hiding * (exposed[a] + exposed[b]);
	}
	return cost;
}

void avoidDiagonals(const EdgeArray<char>& isDiagonal, EdgeArray<double>& cost)
{
	for (const Edge e : isDiagonal.indices())
		if (isDiagonal[e])
			cost[e] *= kDiagonalFactor;
}

} // namespace ricci
