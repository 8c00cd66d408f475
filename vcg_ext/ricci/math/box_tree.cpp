// SPDX-License-Identifier: GPL-3.0-or-later
#include "box_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace ricci {

namespace {

/// Boxes in a leaf.
constexpr int kMaxLeaf = 4;

} // namespace

BoxTree::BoxTree(std::vector<Box2> boxes) : m_boxes(std::move(boxes)), m_order(m_boxes.size())
{
	std::iota(m_order.begin(), m_order.end(), 0);
	if (!m_boxes.empty())
		build(0, m_boxes.size());
}

/// Appends the node of m_order[first .. last - 1] and those below it. \return its number
int BoxTree::build(int first, int last)
{
	const int index = m_nodes.size();
	m_nodes.push_back({Box2(), first, last});
	Box2 box, centres;
	for (int i = first; i < last; ++i) {
		box.add(m_boxes[m_order[i]]);
		centres.add(centre(m_order[i]));
	}
	m_nodes[index].box = box;
	if (last - first <= kMaxLeaf)
		return index;
	const std::size_t axis = centres.width() >= centres.height() ? 0 : 1;
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
	m_nodes[index].left = left;
	m_nodes[index].right = right;
	return index;
}

Point2 BoxTree::centre(int i) const
{
	const Box2& b = m_boxes[i];
	return {0.5 * (b.min[0] + b.max[0]), 0.5 * (b.min[1] + b.max[1])};
}

} // namespace ricci
