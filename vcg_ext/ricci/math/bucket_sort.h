// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_BUCKET_SORT_H
#define RICCI_BUCKET_SORT_H

#include "adjacency.h"

#include <algorithm>
#include <vector>

namespace ricci {

/// Sorts items by \p keyOf(item), an int, and where these are equal by \p less(item, item): in linear
/// time if there are about as many items as keys between the lowest and the highest, and few with one
/// key, like the sides of triangles by their lower vertex.
template<class Item, class KeyOf, class Less>
void bucketSort(std::vector<Item>& items, const KeyOf& keyOf, const Less& less)
{
	if (items.empty())
		return;
	int low = keyOf(items.front()), high = low;
	for (const Item& item : items) {
		low = std::min(low, keyOf(item));
		high = std::max(high, keyOf(item));
	}
	if ((high - low) / 4 >= static_cast<int>(items.size())) {
		std::sort(items.begin(), items.end(), [&](const Item& a, const Item& b) {
			return keyOf(a) != keyOf(b) ? keyOf(a) < keyOf(b) : less(a, b);
		});
		return;
	}
	Adjacency<int, Item> buckets(high - low + 1, [&](const auto& add) {
		for (const Item& item : items)
			add(keyOf(item) - low, item);
	});
	for (int key = 0; key <= high - low; ++key) {
		const ItemRange<Item> bucket = buckets[key];
		std::sort(bucket.begin(), bucket.end(), less);
	}
	items = buckets.items();
}

} // namespace ricci

#endif
