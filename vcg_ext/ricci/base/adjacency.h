// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_ADJACENCY_H
#define RICCI_ADJACENCY_H

#include "indexed.h"

#include <numeric>
#include <vector>

namespace ricci {

/// Consecutive items of an array.
template<class T>
class ItemRange
{
public:
	ItemRange(T* first, T* last) : m_first(first), m_last(last) {}
	T* begin() const { return m_first; }
	T* end() const { return m_last; }
	int size() const { return static_cast<int>(m_last - m_first); }
	bool empty() const { return m_first == m_last; }
	T& operator[](int i) const { return m_first[i]; }

private:
	T *m_first, *m_last;
};

/// A list of items for each key, all in one array (compressed sparse rows): neighbours by vertex,
/// pieces by face. Filled by a counting sort, so that the items of a key keep the order in which
/// they were given.
template<class Key, class Item>
class Adjacency
{
public:
	Adjacency() = default;

	/// \param forItems forItems(add) calls add(key, item) for every item. It is called twice and must
	/// give the same keys both times.
	template<class ForItems>
	Adjacency(int keyCount, const ForItems& forItems) :
			Adjacency(
				keyCount,
				[&](const auto& count) { forItems([&](Key key, const Item&) { count(key); }); },
				forItems)
	{
	}

	/// For items that take work to make.
	/// \param forKeys forKeys(count) calls count(key) for every item
	/// \param forItems forItems(add) calls add(key, item) for every item, in any order of the keys
	template<class ForKeys, class ForItems>
	Adjacency(int keyCount, const ForKeys& forKeys, const ForItems& forItems) :
			m_first(positionOf(keyCount) + 1, 0)
	{
		forKeys([&](Key key) { ++m_first[positionOf(key) + 1]; });
		std::partial_sum(m_first.begin(), m_first.end(), m_first.begin());
		m_items.resize(positionOf(m_first.back()));
		std::vector<int> next(m_first.begin(), m_first.end() - 1);
		forItems([&](Key key, const Item& item) {
			m_items[positionOf(next[positionOf(key)]++)] = item;
		});
	}

	ItemRange<const Item> operator[](Key key) const
	{
		return {m_items.data() + first(key), m_items.data() + last(key)};
	}
	ItemRange<Item> operator[](Key key)
	{
		return {m_items.data() + first(key), m_items.data() + last(key)};
	}

	int keyCount() const { return static_cast<int>(m_first.size()) - 1; }
	const std::vector<Item>& items() const { return m_items; }

private:
	int first(Key key) const { return m_first[positionOf(key)]; }
	int last(Key key) const { return m_first[positionOf(key) + 1]; }

	std::vector<int> m_first{0}; // [key] in m_items, and behind the last one
	std::vector<Item> m_items;   // by key
};

} // namespace ricci

#endif
