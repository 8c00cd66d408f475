// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_BOX_TREE_H
#define RICCI_BOX_TREE_H

#include "indexed.h"
#include "points.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace ricci {

/// Binary tree of boxes, divided at the median centre along the wider direction of the centres. The
/// same boxes always give the same tree.
class BoxTree
{
public:
	explicit BoxTree(const std::vector<Box2>& boxes)
	{
		Array<Item> items;
		items.reserve(boxes.size());
		for (const Box2& b : boxes)
			items.push_back(
				{{0.5 * (b.min[0] + b.max[0]), 0.5 * (b.min[1] + b.max[1])}, items.size()});
		m_order.resize(boxes.size());
		m_boxes.resize(boxes.size());
		if (!boxes.empty())
			build(items, boxes, 0, items.size());
	}

	/// Calls visit(i, j), i != j, once for each pair of boxes that have inner points in common, without those in two nodes
	/// for which areApart(node, node).
	template<class Visit, class AreApart>
	void meetingPairs(const Visit& visit, const AreApart& areApart) const
	{
		if (m_nodes.empty())
			return;
		std::vector<std::array<int, 2>> stack{{0, 0}};
		while (!stack.empty()) {
			const auto [a, b] = stack.back();
			stack.pop_back();
			const Node &x = m_nodes[a], &y = m_nodes[b];
			if (a != b && (!x.box.meets(y.box) || areApart(a, b)))
				continue;
			if (x.isLeaf() && y.isLeaf()) {
				for (int i = x.first; i < x.last; ++i)
					for (int j = a == b ? i + 1 : y.first; j < y.last; ++j)
						if (m_boxes[i].meets(m_boxes[j]))
							visit(m_order[i], m_order[j]);
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

	/// Calls visit(i) for each box that contains \p p, its border included, except for those in nodes for
	/// which isOutside(node).
	template<class Visit, class IsOutside>
	void boxesAround(const Point2& p, const Visit& visit, const IsOutside& isOutside) const
	{
		search(
			[&](const Box2& box) { return box.contains(p); },
			[&](int i) {
				visit(i);
				return false;
			},
			isOutside);
	}

	/// For each node join() of the values of its boxes, from ofBox(i), beginning with Value().
	template<class Value, class OfBox, class Join>
	Array<Value> valuesOfNodes(const OfBox& ofBox, const Join& join) const
	{
		Array<Value> values(m_nodes.size());
		for (int node = m_nodes.size() - 1; node >= 0; --node) { // those below come after it
			const Node& x = m_nodes[node];
			if (!x.isLeaf())
				values[node] = join(values[x.left], values[x.right]);
			else
				for (int i = x.first; i < x.last; ++i)
					values[node] = join(values[node], ofBox(m_order[i]));
		}
		return values;
	}

	/// Whether isFound(i) for a box that has inner points in common with \p box; no other is asked then.
	template<class IsFound>
	bool meetsAny(const Box2& box, const IsFound& isFound) const
	{
		return meetsAny(box, isFound, [](int) { return false; });
	}

	/// The same without the boxes in nodes for which areApart(node).
	template<class IsFound, class AreApart>
	bool meetsAny(const Box2& box, const IsFound& isFound, const AreApart& areApart) const
	{
		return search([&](const Box2& own) { return own.meets(box); }, isFound, areApart);
	}

	/// Longer side of the box round all boxes; 0 where there are none.
	double extent() const { return m_nodes.empty() ? 0.0 : m_nodes[0].box.extent(); }

private:
	struct Node
	{
		Box2 box;
		int first = 0, last = 0; ///< in m_order
		int left = -1, right = -1;

		bool isLeaf() const { return left < 0; }
	};

	using Item = std::pair<Point2, int>; ///< centre and number of a box

	static constexpr int kLeaf = 4; // boxes

	/// Adds the node of items[first .. last - 1], and those below it after it.
	/// \return its number
	int build(Array<Item>& items, const std::vector<Box2>& boxes, int first, int last)
	{
		const int index = m_nodes.size();
		m_nodes.push_back({{}, first, last});
		if (last - first <= kLeaf) {
			for (int i = first; i < last; ++i) {
				m_order[i] = items[i].second;
				m_boxes[i] = boxes[positionOf(m_order[i])];
				m_nodes[index].box.add(m_boxes[i]);
			}
			return index;
		}
		Box2 centres;
		for (int i = first; i < last; ++i)
			centres.add(items[i].first);
		const std::size_t axis = centres.width() >= centres.height() ? 0 : 1;
		const int middle = first + (last - first) / 2;
		std::nth_element(
			items.begin() + first,
			items.begin() + middle,
			items.begin() + last,
			[axis](const Item& x, const Item& y) {
				return std::tie(x.first[axis], x.second) < std::tie(y.first[axis], y.second);
			});
		for (const auto& [from, to] : {std::pair(first, middle), std::pair(middle, last)}) {
			const int half = build(items, boxes, from, to);
			(from == first ? m_nodes[index].left : m_nodes[index].right) = half;
			m_nodes[index].box.add(m_nodes[half].box);
		}
		return index;
	}

	/// Calls isFound(i) for the boxes for which \p concerns holds, as for all round them, until one is;
	/// not for those in nodes that \p isLeftOut.
	template<class Concerns, class IsFound, class IsLeftOut>
	bool search(const Concerns& concerns, const IsFound& isFound, const IsLeftOut& isLeftOut) const
	{
		if (m_nodes.empty())
			return false;
		// One node of each level and one more; halves of ints have at most 32 levels.
		std::array<int, 40> stack{};
		for (std::size_t height = 1; height > 0;) {
			const int node = stack[--height];
			const Node& x = m_nodes[node];
			if (!concerns(x.box) || isLeftOut(node))
				continue;
			if (!x.isLeaf()) {
				stack[height++] = x.left;
				stack[height++] = x.right;
				continue;
			}
			for (int i = x.first; i < x.last; ++i)
				if (concerns(m_boxes[i]) && isFound(m_order[i]))
					return true;
		}
		return false;
	}

	Array<int> m_order;  ///< the boxes, so that those of a node are consecutive
	Array<Box2> m_boxes; ///< in this order
	Array<Node> m_nodes;
};

} // namespace ricci

#endif
