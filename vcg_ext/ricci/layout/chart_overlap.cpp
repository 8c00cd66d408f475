// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart_overlap.h"

#include "../numbers.h"
#include "orientation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace ricci {

namespace {

using Corners = std::array<Point2, 3>;
using Pairs = std::vector<std::array<int, 2>>;

/// Triangles in a leaf of the tree of boxes.
constexpr int kLeaf = 4;

/// Pairs of boxes that are looked at between two ticks.
constexpr int kPairsBetweenTicks = 1 << 20;

/// Units of capacity for the longest edge of a cut.
constexpr double kCapacity = 1e6;

struct Box
{
	Point2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
	Point2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

	void add(const Point2& p)
	{
		for (std::size_t k = 0; k < 2; ++k) {
			low[k] = std::min(low[k], p[k]);
			high[k] = std::max(high[k], p[k]);
		}
	}
	void add(const Box& b)
	{
		add(b.low);
		add(b.high);
	}
	bool meets(const Box& b) const
	{
		return low[0] < b.high[0] && b.low[0] < high[0] && low[1] < b.high[1] && b.low[1] < high[1];
	}
	bool contains(const Point2& p) const
	{
		return low[0] <= p[0] && p[0] <= high[0] && low[1] <= p[1] && p[1] <= high[1];
	}
};

/// Binary tree of the bounding boxes of triangles, divided at the median of the wider direction.
class BoxTree
{
public:
	explicit BoxTree(const std::vector<Corners>& triangles) : m_box(triangles.size())
	{
		for (std::size_t i = 0; i < triangles.size(); ++i)
			for (const Point2& p : triangles[i])
				m_box[i].add(p);
		m_order.resize(triangles.size());
		std::iota(m_order.begin(), m_order.end(), 0);
		if (!triangles.empty())
			build(0, static_cast<int>(triangles.size()));
	}

	/// Calls \p visit(i, j), i != j, once for each pair whose boxes meet.
	template<class Visit>
	void pairs(Visit visit) const
	{
		if (m_nodes.empty())
			return;
		std::vector<std::array<int, 2>> stack{{0, 0}};
		while (!stack.empty()) {
			const auto [a, b] = stack.back();
			stack.pop_back();
			const Node &x = m_nodes[at(a)], &y = m_nodes[at(b)];
			if (a != b && !x.box.meets(y.box))
				continue;
			if (x.isLeaf() && y.isLeaf()) {
				for (int i = x.first; i < x.last; ++i)
					for (int j = a == b ? i + 1 : y.first; j < y.last; ++j)
						if (m_box[at(m_order[at(i)])].meets(m_box[at(m_order[at(j)])]))
							visit(m_order[at(i)], m_order[at(j)]);
			}
			else if (a == b) {
				stack.push_back({x.left, x.left});
				stack.push_back({x.right, x.right});
				stack.push_back({x.left, x.right});
			}
			else if (y.isLeaf() || (!x.isLeaf() && x.last - x.first >= y.last - y.first)) {
				stack.push_back({x.left, b});
				stack.push_back({x.right, b});
			}
			else {
				stack.push_back({a, y.left});
				stack.push_back({a, y.right});
			}
		}
	}

	/// Calls \p visit(i) for each triangle whose box contains \p p.
	template<class Visit>
	void around(const Point2& p, Visit visit) const
	{
		std::vector<int> stack{0};
		while (!stack.empty()) {
			const Node& x = m_nodes[at(stack.back())];
			stack.pop_back();
			if (!x.box.contains(p))
				continue;
			if (!x.isLeaf()) {
				stack.push_back(x.left);
				stack.push_back(x.right);
				continue;
			}
			for (int i = x.first; i < x.last; ++i)
				if (m_box[at(m_order[at(i)])].contains(p))
					visit(m_order[at(i)]);
		}
	}

	/// Longer side of the whole.
	double size() const
	{
		if (m_nodes.empty())
			return 0.0;
		const Box& b = m_nodes.front().box;
		return std::max(b.high[0] - b.low[0], b.high[1] - b.low[1]);
	}

private:
	struct Node
	{
		Box box;
		int first, last; // in m_order
		int left = -1, right = -1;

		bool isLeaf() const { return left < 0; }
	};

	int build(int first, int last)
	{
		const int index = static_cast<int>(m_nodes.size());
		m_nodes.push_back({Box(), first, last});
		Box box, centres;
		for (int i = first; i < last; ++i) {
			box.add(m_box[at(m_order[at(i)])]);
			centres.add(centre(m_order[at(i)]));
		}
		m_nodes[at(index)].box = box;
		if (last - first <= kLeaf)
			return index;
		const std::size_t axis =
			centres.high[0] - centres.low[0] >= centres.high[1] - centres.low[1] ? 0 : 1;
		const int middle = first + (last - first) / 2;
		std::nth_element(
			m_order.begin() + first,
			m_order.begin() + middle,
			m_order.begin() + last,
			[&](int i, int j) {
				const double a = centre(i)[axis], b = centre(j)[axis];
				return a != b ? a < b : i < j;
			});
		const int left = build(first, middle), right = build(middle, last);
		m_nodes[at(index)].left = left;
		m_nodes[at(index)].right = right;
		return index;
	}

	Point2 centre(int i) const
	{
		const Box& b = m_box[at(i)];
		return {0.5 * (b.low[0] + b.high[0]), 0.5 * (b.low[1] + b.high[1])};
	}

	std::vector<Box> m_box;
	std::vector<int> m_order;
	std::vector<Node> m_nodes;
};

/// How far \p r lies to the left of the line from \p p to \p q; at most 0 exactly if it does not.
double depth(const Point2& p, const Point2& q, const Point2& r)
{
	if (orientation(p, q, r) <= 0)
		return 0.0;
	const double x = q[0] - p[0], y = q[1] - p[1];
	return (x * (r[1] - p[1]) - y * (r[0] - p[0])) / std::hypot(x, y);
}

/// Whether a side of \p a has \p b on its outer side, or no deeper inside than \p touching.
bool separates(const Corners& a, const Corners& b, double touching)
{
	for (std::size_t k = 0; k < 3; ++k) {
		bool outside = true;
		for (std::size_t i = 0; i < 3 && outside; ++i)
			outside = depth(a[k], a[(k + 1) % 3], b[i]) <= touching;
		if (outside)
			return true;
	}
	return false;
}

/// Mean of the corners of the common part of two counter-clockwise triangles, as far as rounding
/// finds one; \return false if not.
bool commonPoint(const Corners& a, const Corners& b, Point2& point)
{
	std::vector<Point2> part(a.begin(), a.end()), next;
	for (std::size_t k = 0; k < 3; ++k) {
		const Point2 &p = b[k], &q = b[(k + 1) % 3];
		const auto side = [&](const Point2& r) {
			return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
		};
		next.clear();
		for (std::size_t i = 0; i < part.size(); ++i) {
			const Point2 &x = part[i], &y = part[(i + 1) % part.size()];
			const double u = side(x), v = side(y);
			if (u >= 0.0)
				next.push_back(x);
			if ((u > 0.0 && v < 0.0) || (u < 0.0 && v > 0.0)) {
				const double t = u / (u - v);
				next.push_back({x[0] + t * (y[0] - x[0]), x[1] + t * (y[1] - x[1])});
			}
		}
		part.swap(next);
	}
	if (part.size() < 3)
		return false;
	point = {0.0, 0.0};
	for (const Point2& p : part)
		for (std::size_t k = 0; k < 2; ++k)
			point[k] += p[k] / static_cast<double>(part.size());
	return true;
}

/// Triangles round \p p less those turned round: the winding number of the chart's boundary, where
/// p lies on no edge.
int cover(const BoxTree& tree, const std::vector<Corners>& plane, const Point2& p)
{
	int sum = 0;
	tree.around(p, [&](int i) {
		const Corners& c = plane[at(i)];
		const int first = orientation(c[0], c[1], p);
		if (first != 0 && orientation(c[1], c[2], p) == first &&
			orientation(c[2], c[0], p) == first)
			sum += first;
	});
	return sum;
}

/// For each side of each triangle the side on its other side within the chart, or -1.
std::vector<int> joinedSides(const DrawnChart& chart)
{
	struct Side
	{
		int low, high, index;
	};
	std::vector<Side> sides;
	for (std::size_t f = 0; f < chart.triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k) {
			const int a = chart.triangles[f][k], b = chart.triangles[f][(k + 1) % 3];
			sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(3 * f + k)});
		}
	std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
		return a.low != b.low     ? a.low < b.low
			   : a.high != b.high ? a.high < b.high
								  : a.index < b.index;
	});
	std::vector<int> joined(sides.size(), -1);
	for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
		const Side &s = sides[i], &t = sides[i + 1];
		if (s.low != t.low || s.high != t.high)
			continue;
		const auto end = [&](int side, int k) -> const Point2& {
			return chart.plane[at(side / 3)][at((side % 3 + k) % 3)];
		};
		if (end(s.index, 0) == end(t.index, 1) && end(s.index, 1) == end(t.index, 0)) {
			joined[at(s.index)] = t.index;
			joined[at(t.index)] = s.index;
		}
	}
	return joined;
}

/// Minimal cut between two sets of nodes of an undirected graph, in integers: shortest augmenting
/// paths with distance labels that are corrected where a search fails (Ahuja and Orlin, Distance-
/// directed augmenting path algorithms, Naval Research Logistics 38, 1991).
class MinimalCut
{
public:
	explicit MinimalCut(int nodes) : m_first(at(nodes), -1) {}

	void join(int a, int b, std::int64_t there, std::int64_t back)
	{
		add(a, b, there);
		add(b, a, back);
	}

	/// [node] 1 on the side of \p source: what it can still reach, the least of the least cuts.
	std::vector<char> run(int source, int sink)
	{
		labelDistances(sink);
		m_next = m_first;
		std::vector<int> path; // arcs from the source to node
		int node = source;
		while (m_distance[at(source)] < nodes()) {
			if (node == sink) {
				augment(path);
				path.clear();
				node = source;
				continue;
			}
			int& a = m_next[at(node)];
			while (a >= 0 && !leadsOn(node, a))
				a = m_arcs[at(a)].next;
			if (a >= 0) {
				path.push_back(a);
				node = m_arcs[at(a)].to;
				continue;
			}
			const int before = m_distance[at(node)];
			relabel(node);
			if (--m_count[at(before)] == 0)
				break; // no path can cross the gap
			if (node != source) {
				node = m_arcs[at(path.back() ^ 1)].to;
				path.pop_back();
			}
		}
		return reachable(source);
	}

private:
	struct Arc
	{
		int to, next;
		std::int64_t capacity;
	};

	int nodes() const { return static_cast<int>(m_first.size()); }

	void add(int from, int to, std::int64_t capacity)
	{
		m_arcs.push_back({to, m_first[at(from)], capacity});
		m_first[at(from)] = static_cast<int>(m_arcs.size()) - 1;
	}

	bool leadsOn(int node, int a) const
	{
		const Arc& arc = m_arcs[at(a)];
		return arc.capacity > 0 && m_distance[at(arc.to)] + 1 == m_distance[at(node)];
	}

	/// Numbers of arcs to the sink; nodes() where there is no way.
	void labelDistances(int sink)
	{
		m_distance.assign(m_first.size(), nodes());
		m_distance[at(sink)] = 0;
		std::vector<int> queue{sink};
		for (std::size_t head = 0; head < queue.size(); ++head)
			for (int a = m_first[at(queue[head])]; a >= 0; a = m_arcs[at(a)].next) {
				int& distance = m_distance[at(m_arcs[at(a)].to)];
				if (m_arcs[at(a ^ 1)].capacity > 0 && distance == nodes()) {
					distance = m_distance[at(queue[head])] + 1;
					queue.push_back(m_arcs[at(a)].to);
				}
			}
		m_count.assign(m_first.size() + 1, 0);
		for (int d : m_distance)
			++m_count[at(d)];
	}

	void relabel(int node)
	{
		int least = nodes();
		for (int a = m_first[at(node)]; a >= 0; a = m_arcs[at(a)].next)
			if (m_arcs[at(a)].capacity > 0)
				least = std::min(least, m_distance[at(m_arcs[at(a)].to)] + 1);
		m_distance[at(node)] = least;
		++m_count[at(least)];
		m_next[at(node)] = m_first[at(node)];
	}

	void augment(const std::vector<int>& path)
	{
		std::int64_t least = std::numeric_limits<std::int64_t>::max();
		for (int a : path)
			least = std::min(least, m_arcs[at(a)].capacity);
		for (int a : path) {
			m_arcs[at(a)].capacity -= least;
			m_arcs[at(a ^ 1)].capacity += least;
		}
	}

	std::vector<char> reachable(int source) const
	{
		std::vector<char> side(m_first.size(), 0);
		side[at(source)] = 1;
		std::vector<int> queue{source};
		for (std::size_t head = 0; head < queue.size(); ++head)
			for (int a = m_first[at(queue[head])]; a >= 0; a = m_arcs[at(a)].next)
				if (m_arcs[at(a)].capacity > 0 && !side[at(m_arcs[at(a)].to)]) {
					side[at(m_arcs[at(a)].to)] = 1;
					queue.push_back(m_arcs[at(a)].to);
				}
		return side;
	}

	std::vector<Arc> m_arcs; // arc a ^ 1 runs the other way
	std::vector<int> m_first, m_next;
	std::vector<int> m_distance, m_count; // [node]; [distance] nodes
};

class Division
{
public:
	Division(
		const DrawnChart& chart,
		const Pairs& pairs,
		const std::vector<std::array<double, 3>>& edgeLength) :
			m_chart(chart),
			m_edgeLength(edgeLength), m_joined(joinedSides(chart)),
			m_part(chart.triangles.size(), 0), m_start(chart.triangles.size() + 1, 0)
	{
		for (const auto& pair : pairs)
			for (int i : pair)
				++m_start[at(i) + 1];
		std::partial_sum(m_start.begin(), m_start.end(), m_start.begin());
		m_rivals.resize(2 * pairs.size());
		std::vector<int> cursor(m_start.begin(), m_start.end() - 1);
		for (const auto& pair : pairs)
			for (std::size_t k = 0; k < 2; ++k)
				m_rivals[at(cursor[at(pair[k])]++)] = pair[1 - k];
	}

	std::vector<std::vector<int>> run(ChartCuts& cuts)
	{
		std::vector<int> whole(m_chart.triangles.size());
		std::iota(whole.begin(), whole.end(), 0);
		std::vector<std::vector<int>> open{std::move(whole)};
		while (!open.empty()) {
			const std::vector<int> part = std::move(open.back());
			open.pop_back();
			const int seed = largestWithRival(part);
			if (seed < 0)
				continue;
			cut(part, seed);
			for (std::vector<int>& piece : connectedPieces(part))
				open.push_back(std::move(piece));
		}
		rejoin();
		std::map<int, std::vector<int>> byNumber;
		for (std::size_t i = 0; i < m_part.size(); ++i)
			byNumber[m_part[i]].push_back(static_cast<int>(i));
		std::vector<std::vector<int>> parts;
		parts.reserve(byNumber.size());
		for (auto& part : byNumber)
			parts.push_back(std::move(part.second));
		std::sort(parts.begin(), parts.end());
		cuts = ChartCuts();
		for (std::size_t s = 0; s < m_joined.size(); ++s)
			if (m_joined[s] > static_cast<int>(s) && m_part[s / 3] != m_part[at(m_joined[s] / 3)]) {
				++cuts.edges;
				cuts.length += m_edgeLength[s / 3][s % 3];
			}
		return parts;
	}

private:
	bool hasRival(int i) const
	{
		for (int k = m_start[at(i)]; k < m_start[at(i) + 1]; ++k)
			if (m_part[at(m_rivals[at(k)])] == m_part[at(i)])
				return true;
		return false;
	}

	int largestWithRival(const std::vector<int>& part) const
	{
		int best = -1;
		double most = -1.0;
		for (int i : part) {
			if (m_start[at(i)] == m_start[at(i) + 1] || !hasRival(i))
				continue;
			const Corners& p = m_chart.plane[at(i)];
			const double area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) -
								(p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
			if (area > most) {
				most = area;
				best = i;
			}
		}
		return best;
	}

	template<class Visit>
	void neighbours(int i, Visit visit) const
	{
		for (int k = 0; k < 3; ++k) {
			const int across = m_joined[at(3 * i + k)];
			if (across >= 0 && m_part[at(across / 3)] == m_part[at(i)])
				visit(across / 3, k);
		}
	}

	/// Gives the sheet of \p seed, with what the minimal cut leaves to it, a new number of its own.
	void cut(const std::vector<int>& part, int seed)
	{
		std::vector<int> node(m_part.size(), 0); // 1: the sheet, 2: what it covers
		const auto isIn = [&](int i) { return m_part[at(i)] == m_part[at(seed)]; };
		std::vector<int> sheet{seed};
		const auto claim = [&](int i) {
			node[at(i)] = 1;
			for (int k = m_start[at(i)]; k < m_start[at(i) + 1]; ++k)
				if (isIn(m_rivals[at(k)]))
					node[at(m_rivals[at(k)])] = 2;
		};
		claim(seed);
		for (std::size_t head = 0; head < sheet.size(); ++head)
			neighbours(sheet[head], [&](int i, int) {
				if (node[at(i)] == 0 && m_start[at(i)] < m_start[at(i) + 1] && hasRival(i)) {
					claim(i);
					sheet.push_back(i);
				}
			});
		double longest = 0.0;
		for (int i : part)
			for (double l : m_edgeLength[at(i)])
				longest = std::max(longest, l);
		int count = 2;
		for (int i : part)
			node[at(i)] = node[at(i)] > 0 ? node[at(i)] - 1 : count++;
		MinimalCut minimal(count);
		for (int i : part)
			neighbours(i, [&](int j, int k) {
				if (i > j || node[at(i)] == node[at(j)])
					return;
				const double share = longest > 0.0 ? m_edgeLength[at(i)][at(k)] / longest : 0.0;
				const auto capacity = static_cast<std::int64_t>(share * kCapacity) + 1;
				minimal.join(node[at(i)], node[at(j)], capacity, capacity);
			});
		const std::vector<char> side = minimal.run(0, 1);
		++m_partCount;
		for (int i : part)
			if (side[at(node[at(i)])])
				m_part[at(i)] = m_partCount;
	}

	/// Joins neighbouring parts that do not cover each other again, those with the longest common
	/// border first: a later cut can make an earlier one needless.
	void rejoin()
	{
		using Neighbours = std::array<int, 2>; // part numbers, the lower first
		std::set<Neighbours> rivals;
		for (std::size_t i = 0; i < m_part.size(); ++i)
			for (int k = m_start[i]; k < m_start[i + 1]; ++k) {
				const int a = m_part[i], b = m_part[at(m_rivals[at(k)])];
				rivals.insert({std::min(a, b), std::max(a, b)});
			}
		for (;;) {
			std::map<Neighbours, double> borders;
			for (std::size_t s = 0; s < m_joined.size(); ++s) {
				if (m_joined[s] <= static_cast<int>(s))
					continue;
				const int a = m_part[s / 3], b = m_part[at(m_joined[s] / 3)];
				const Neighbours pair{std::min(a, b), std::max(a, b)};
				if (a != b && !rivals.count(pair))
					borders[pair] += m_edgeLength[s / 3][s % 3];
			}
			if (borders.empty())
				return;
			const Neighbours best =
				std::max_element(borders.begin(), borders.end(), [](const auto& x, const auto& y) {
					return x.second < y.second;
				})->first;
			for (int& part : m_part)
				if (part == best[1])
					part = best[0];
			std::set<Neighbours> renamed;
			for (Neighbours pair : rivals) {
				for (int& part : pair)
					if (part == best[1])
						part = best[0];
				renamed.insert({std::min(pair[0], pair[1]), std::max(pair[0], pair[1])});
			}
			rivals.swap(renamed);
		}
	}

	/// Pieces of \p part, each under a number of its own.
	std::vector<std::vector<int>> connectedPieces(const std::vector<int>& part)
	{
		std::vector<std::vector<int>> pieces;
		std::vector<char> seen(m_part.size(), 0);
		for (int first : part) {
			if (seen[at(first)])
				continue;
			std::vector<int> piece{first};
			seen[at(first)] = 1;
			for (std::size_t head = 0; head < piece.size(); ++head)
				neighbours(piece[head], [&](int i, int) {
					if (!seen[at(i)]) {
						seen[at(i)] = 1;
						piece.push_back(i);
					}
				});
			std::sort(piece.begin(), piece.end());
			pieces.push_back(std::move(piece));
		}
		for (const std::vector<int>& piece : pieces) {
			++m_partCount;
			for (int i : piece)
				m_part[at(i)] = m_partCount;
		}
		return pieces;
	}

	const DrawnChart& m_chart;
	const std::vector<std::array<double, 3>>& m_edgeLength;
	std::vector<int> m_joined;
	std::vector<int> m_part; // [triangle]
	int m_partCount = 0;
	std::vector<int> m_start, m_rivals; // of each triangle
};

} // namespace

std::vector<std::array<int, 2>>
overlappingPairs(const DrawnChart& chart, const std::function<void()>& tick)
{
	const std::vector<Corners>& plane = chart.plane;
	const BoxTree tree(plane);
	std::vector<char> proper(plane.size());
	for (std::size_t i = 0; i < plane.size(); ++i)
		proper[i] = orientation(plane[i][0], plane[i][1], plane[i][2]) > 0;
	const bool hasFolds = std::find(proper.begin(), proper.end(), 0) != proper.end();
	const double touching = kTouching * tree.size();
	Pairs pairs;
	int untilTick = kPairsBetweenTicks;
	tree.pairs([&](int i, int j) {
		if (--untilTick == 0) {
			untilTick = kPairsBetweenTicks;
			tick();
		}
		const Corners &a = plane[at(i)], &b = plane[at(j)];
		if (!proper[at(i)] || !proper[at(j)] || separates(a, b, touching) ||
			separates(b, a, touching))
			return;
		Point2 p;
		if (hasFolds && (!commonPoint(a, b, p) || cover(tree, plane, p) < 2))
			return;
		pairs.push_back({std::min(i, j), std::max(i, j)});
	});
	std::sort(pairs.begin(), pairs.end());
	return pairs;
}

std::vector<std::vector<int>> divideChart(
	const DrawnChart& chart,
	const std::vector<std::array<int, 2>>& pairs,
	const std::vector<std::array<double, 3>>& edgeLength,
	ChartCuts& cuts)
{
	return Division(chart, pairs, edgeLength).run(cuts);
}

} // namespace ricci
