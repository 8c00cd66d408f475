// SPDX-License-Identifier: GPL-3.0-or-later
#include "box_tree.h"

#include <algorithm>

namespace ricci {

namespace {

/// Boxes in a leaf.
constexpr int kMaxLeaf = 4;

} // namespace

BoxTree::BoxTree(const std::vector<Box2>& boxes)
{
	Array<Item> items;
	items.reserve(boxes.size());
	for (const Box2& b : boxes)
		items.push_back({{0.5 * (b.min[0] + b.max[0]), 0.5 * (b.min[1] + b.max[1])}, items.size()});
	m_order.reserve(boxes.size());
	m_boxes.reserve(boxes.size());
	m_nodes.reserve(boxes.size());
	if (!boxes.empty())
		build(items, boxes, 0, items.size());
}

/// Appends the node of items[first .. last - 1] and those below it. \return its number
int BoxTree::build(Array<Item>& items, const std::vector<Box2>& boxes, int first, int last)
{
	const int index = m_nodes.size();
	m_nodes.push_back({Box2(), first, last});
	if (last - first <= kMaxLeaf) {
		for (int i = first; i < last; ++i) {
			m_order.push_back(items[i].number);
			m_boxes.push_back(boxes[positionOf(items[i].number)]);
			m_nodes[index].box.add(m_boxes.back());
		}
		return index;
	}
	Box2 centres;
	for (int i = first; i < last; ++i)
		centres.add(items[i].centre);
	const std::size_t axis = centres.width() >= centres.height() ? 0 : 1;
	const int middle = first + (last - first) / 2;
	std::nth_element(
		items.begin() + first,
		items.begin() + middle,
		items.begin() + last,
		[axis](const Item& x, const Item& y) {
			const double a = x.centre[axis], b = y.centre[axis];
			return a != b ? a < b : x.number < y.number;
		});
	const int left = build(items, boxes, first, middle);
	const int right = build(items, boxes, middle, last);
	Node& node = m_nodes[index];
	node.left = left;
	node.right = right;
	node.box.add(m_nodes[left].box);
	node.box.add(m_nodes[right].box);
	return index;
}

} // namespace ricci
