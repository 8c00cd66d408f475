// SPDX-License-Identifier: GPL-3.0-or-later
#include "cut_graph.h"

#include "../error.h"
#include "../numbers.h"
#include "seams.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <queue>

namespace ricci {

namespace {

/// Roots tried on a closed surface.
constexpr int kRoots = 4;

constexpr double kFar = std::numeric_limits<double>::infinity();

/// The edge graph of the surface with every boundary loop drawn together into one node.
class ContractedGraph
{
public:
	ContractedGraph(const Triangulation& t, const std::vector<char>& forbidden) :
			m_node(at(t.vertexCount())), m_fixed(at(t.vertexCount()), 0)
	{
		std::iota(m_node.begin(), m_node.end(), 0);
		for (int first : t.boundaryLoops()) {
			int h = first;
			do {
				m_node[at(t.origin(h))] = t.origin(first);
				h = t.next(h);
			} while (h != first);
			m_fixed[at(t.origin(first))] = 1;
			m_loops.push_back(t.origin(first));
		}
		// Halfedges by the node they start from.
		m_start.assign(at(t.vertexCount()) + 1, 0);
		const auto usable = [&](int h) {
			const int e = Triangulation::edge(h);
			return !t.isBoundaryEdge(e) && (forbidden.empty() || !forbidden[at(e)]);
		};
		for (int h = 0; h < t.halfedgeCount(); ++h)
			if (usable(h))
				++m_start[at(m_node[at(t.origin(h))]) + 1];
		std::partial_sum(m_start.begin(), m_start.end(), m_start.begin());
		m_halfedges.resize(at(m_start.back()));
		std::vector<int> cursor(m_start.begin(), m_start.end() - 1);
		for (int h = 0; h < t.halfedgeCount(); ++h)
			if (usable(h))
				m_halfedges[at(cursor[at(m_node[at(t.origin(h))])]++)] = h;
	}

	int node(int vertex) const { return m_node[at(vertex)]; }
	const std::vector<int>& loopNodes() const { return m_loops; }

	/// Nodes that the cut must reach: boundary loops and marked vertices.
	std::vector<char> terminals(const std::vector<char>& marked) const
	{
		std::vector<char> terminal = m_fixed;
		for (std::size_t v = 0; v < marked.size(); ++v)
			if (marked[v])
				terminal[at(m_node[v])] = 1;
		return terminal;
	}

	const int* begin(int node) const { return m_halfedges.data() + m_start[at(node)]; }
	const int* end(int node) const { return m_halfedges.data() + m_start[at(node) + 1]; }

private:
	std::vector<int> m_node;   // [vertex]
	std::vector<char> m_fixed; // [node] a boundary loop
	std::vector<int> m_loops;
	std::vector<int> m_start, m_halfedges;
};

struct ShortestPaths
{
	std::vector<double> distance; // [node]
	std::vector<int> parent;      // [node] halfedge that arrives, or -1
	std::vector<int> bridges;     // edges that join the trees of several roots
};

ShortestPaths dijkstra(
	const Triangulation& t,
	const ContractedGraph& graph,
	const std::vector<double>& lengths,
	const std::vector<int>& roots)
{
	ShortestPaths paths;
	paths.distance.assign(at(t.vertexCount()), kFar);
	paths.parent.assign(at(t.vertexCount()), -1);
	using Entry = std::pair<double, int>; // ties by node, so that the tree is always the same
	std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
	for (int root : roots) {
		paths.distance[at(root)] = 0.0;
		queue.push({0.0, root});
	}
	while (!queue.empty()) {
		const auto [d, node] = queue.top();
		queue.pop();
		if (d > paths.distance[at(node)])
			continue;
		for (const int* h = graph.begin(node); h != graph.end(node); ++h) {
			const int to = graph.node(t.target(*h));
			const double there = d + lengths[at(Triangulation::edge(*h))];
			if (there < paths.distance[at(to)]) {
				paths.distance[at(to)] = there;
				paths.parent[at(to)] = *h;
				queue.push({there, to});
			}
		}
	}
	return paths;
}

int findSet(std::vector<int>& parent, int i)
{
	while (parent[at(i)] != i)
		i = parent[at(i)] = parent[at(parent[at(i)])];
	return i;
}

/// Shortest paths to the nearest terminal, and the edges that join them to a spanning tree, those
/// that belong to the shortest connections first: what is left of it without its dead ends is at
/// most twice as long as the shortest tree through the terminals (Mehlhorn 1988).
ShortestPaths treeOfTerminals(
	const Triangulation& t,
	const ContractedGraph& graph,
	const std::vector<double>& lengths,
	const std::vector<char>& forbidden,
	const std::vector<int>& terminals)
{
	ShortestPaths paths = dijkstra(t, graph, lengths, terminals);
	std::vector<int> parent(at(t.vertexCount()));
	std::iota(parent.begin(), parent.end(), 0);
	for (int h : paths.parent)
		if (h >= 0)
			parent[at(findSet(parent, graph.node(t.target(h))))] =
				findSet(parent, graph.node(t.origin(h)));
	std::vector<std::pair<double, int>> connections;
	for (int e = 0; e < t.edgeCount(); ++e) {
		const int a = graph.node(t.origin(2 * e)), b = graph.node(t.target(2 * e));
		if (!t.isBoundaryEdge(e) && (forbidden.empty() || !forbidden[at(e)]) &&
			findSet(parent, a) != findSet(parent, b))
			connections.push_back(
				{paths.distance[at(a)] + lengths[at(e)] + paths.distance[at(b)], e});
	}
	std::sort(connections.begin(), connections.end());
	for (const auto& [length, e] : connections) {
		const int a = findSet(parent, graph.node(t.origin(2 * e)));
		const int b = findSet(parent, graph.node(t.target(2 * e)));
		if (a == b)
			continue;
		parent[at(std::max(a, b))] = std::min(a, b);
		paths.bridges.push_back(e);
	}
	return paths;
}

/// Interior edges that are neither in the shortest-path tree nor crossed by the cotree.
std::vector<int> leftOver(
	const Triangulation& t,
	const ContractedGraph& graph,
	const std::vector<double>& lengths,
	const std::vector<char>& forbidden,
	const ShortestPaths& paths,
	const std::vector<char>& inTree)
{
	std::vector<int> edges;
	std::vector<double> loopLength(at(t.edgeCount()), 0.0);
	for (int e = 0; e < t.edgeCount(); ++e) {
		if (t.isBoundaryEdge(e) || inTree[at(e)])
			continue;
		const bool passable = forbidden.empty() || !forbidden[at(e)];
		loopLength[at(e)] = passable ? paths.distance[at(graph.node(t.origin(2 * e)))] +
										   paths.distance[at(graph.node(t.target(2 * e)))] +
										   lengths[at(e)]
									 : kFar;
		edges.push_back(e);
	}
	std::sort(edges.begin(), edges.end(), [&](int a, int b) {
		return loopLength[at(a)] != loopLength[at(b)] ? loopLength[at(a)] > loopLength[at(b)]
													  : a < b;
	});
	std::vector<int> parent(at(t.faceCount())), rest;
	std::iota(parent.begin(), parent.end(), 0);
	for (int e : edges) {
		const int a = findSet(parent, t.face(2 * e)), b = findSet(parent, t.face(2 * e + 1));
		if (a != b)
			parent[at(std::max(a, b))] = std::min(a, b);
		else if (loopLength[at(e)] == kFar)
			throw Error("The surface cannot be cut open without crossing a swapped edge.");
		else
			rest.push_back(e);
	}
	return rest;
}

/// Removes dead ends that are not terminals.
void prune(
	const Triangulation& t,
	const ContractedGraph& graph,
	const std::vector<char>& terminal,
	std::vector<char>& isCut)
{
	std::vector<int> degree(at(t.vertexCount()), 0);
	for (int e = 0; e < t.edgeCount(); ++e)
		if (isCut[at(e)])
			for (int h : {2 * e, 2 * e + 1})
				++degree[at(graph.node(t.origin(h)))];
	std::vector<int> leaves;
	for (int n = 0; n < t.vertexCount(); ++n)
		if (degree[at(n)] == 1 && !terminal[at(n)])
			leaves.push_back(n);
	while (!leaves.empty()) {
		const int leaf = leaves.back();
		leaves.pop_back();
		for (const int* h = graph.begin(leaf); h != graph.end(leaf); ++h) {
			if (!isCut[at(Triangulation::edge(*h))])
				continue;
			isCut[at(Triangulation::edge(*h))] = 0;
			const int other = graph.node(t.target(*h));
			--degree[at(leaf)];
			if (--degree[at(other)] == 1 && !terminal[at(other)])
				leaves.push_back(other);
		}
	}
}

void measure(const Triangulation& t, const std::vector<double>& lengths, CutGraph& cut)
{
	cut.edgeCount = 0;
	cut.length = 0.0;
	for (int e = 0; e < t.edgeCount(); ++e)
		if (cut.isCut[at(e)]) {
			++cut.edgeCount;
			cut.length += lengths[at(e)];
		}
}

CutGraph cutFrom(
	const Triangulation& t,
	const ContractedGraph& graph,
	const std::vector<double>& lengths,
	const std::vector<char>& forbidden,
	const std::vector<char>& terminal,
	const ShortestPaths& paths)
{
	CutGraph cut;
	cut.isCut.assign(at(t.edgeCount()), 0);
	for (int h : paths.parent)
		if (h >= 0)
			cut.isCut[at(Triangulation::edge(h))] = 1;
	for (int e : paths.bridges)
		cut.isCut[at(e)] = 1;
	for (int e : leftOver(t, graph, lengths, forbidden, paths, cut.isCut))
		cut.isCut[at(e)] = 1;
	prune(t, graph, terminal, cut.isCut);
	measure(t, lengths, cut);
	return cut;
}

/// Edges of the cut outside a spanning tree of it.
std::vector<int>
generators(const Triangulation& t, const ContractedGraph& graph, const CutGraph& cut)
{
	std::vector<int> parent(at(t.vertexCount())), edges;
	std::iota(parent.begin(), parent.end(), 0);
	for (int e = 0; e < t.edgeCount(); ++e) {
		if (!cut.isCut[at(e)])
			continue;
		const int a = findSet(parent, graph.node(t.origin(2 * e)));
		const int b = findSet(parent, graph.node(t.target(2 * e)));
		if (a != b)
			parent[at(std::max(a, b))] = std::min(a, b);
		else
			edges.push_back(e);
	}
	return edges;
}

} // namespace

CutGraph cutToDisk(
	const Triangulation& t,
	const std::vector<double>& lengths,
	const std::vector<char>& marked,
	const std::vector<char>& forbidden,
	const std::function<void()>& tick)
{
	const ContractedGraph graph(t, forbidden);
	const std::vector<char> terminal = graph.terminals(marked);
	// On a surface with boundary the first loop is the root. On a closed one every next root is the
	// node furthest from the roots before it.
	const bool closed = graph.loopNodes().empty();
	int root = closed ? t.origin(t.halfedge(0)) : graph.loopNodes().front();
	const auto firstMark = std::find(terminal.begin(), terminal.end(), 1);
	if (closed && firstMark != terminal.end())
		root = static_cast<int>(firstMark - terminal.begin());
	std::vector<double> fromRoots;
	CutGraph best;
	std::vector<int> terminals;
	for (std::size_t n = 0; n < terminal.size(); ++n)
		if (terminal[n])
			terminals.push_back(static_cast<int>(n));
	const bool hasTree = terminals.size() > 1;
	if (hasTree)
		best = cutFrom(
			t,
			graph,
			lengths,
			forbidden,
			terminal,
			treeOfTerminals(t, graph, lengths, forbidden, terminals));
	// A tree through the terminals is all that a sphere with holes needs.
	const bool planar =
		hasTree && t.eulerCharacteristic() + static_cast<int>(graph.loopNodes().size()) == 2;
	for (int attempt = 0; !planar && attempt < (closed ? kRoots : 1); ++attempt) {
		const ShortestPaths paths = dijkstra(t, graph, lengths, {root});
		CutGraph cut = cutFrom(t, graph, lengths, forbidden, terminal, paths);
		if ((attempt == 0 && !hasTree) || cut.length < best.length)
			best = std::move(cut);
		if (attempt == 0)
			fromRoots = paths.distance;
		double furthest = -1.0;
		for (std::size_t n = 0; n < fromRoots.size(); ++n) {
			fromRoots[n] = std::min(fromRoots[n], paths.distance[n]);
			if (fromRoots[n] < kFar && fromRoots[n] > furthest) {
				furthest = fromRoots[n];
				root = static_cast<int>(n);
			}
		}
	}
	shortenCut(t, lengths, marked, forbidden, best.isCut, tick);
	measure(t, lengths, best);
	best.generators = generators(t, graph, best);
	return best;
}

} // namespace ricci
