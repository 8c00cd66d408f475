// SPDX-License-Identifier: GPL-3.0-or-later
// The folder base: arrays by index, points of the plane, graphs, threads, cancelling, errors. Nothing that knows a
// mesh, and no matrix.
#ifndef RICCI_INDEXED_H
#define RICCI_INDEXED_H

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <type_traits>
#include <utility>
#include <vector>

namespace ricci {

/// Number of an element of one kind. \p Self is the kind: kinds do not convert into each other, and
/// to and from integers by name only, so that a halfedge cannot stand where an edge is meant.
template<class Self>
class Index
{
public:
	constexpr Index() = default; ///< no element
	template<class Integer, class = std::enable_if_t<std::is_integral_v<Integer>>>
	constexpr explicit Index(Integer number) : m_number(static_cast<int>(number))
	{
	}

	constexpr int number() const { return m_number; }
	constexpr bool isValid() const { return m_number >= 0; }

	friend constexpr bool operator==(Self a, Self b) { return a.number() == b.number(); }
	friend constexpr bool operator!=(Self a, Self b) { return a.number() != b.number(); }
	friend constexpr bool operator<(Self a, Self b) { return a.number() < b.number(); }
	friend constexpr bool operator>(Self a, Self b) { return a.number() > b.number(); }
	friend constexpr bool operator<=(Self a, Self b) { return a.number() <= b.number(); }
	friend constexpr bool operator>=(Self a, Self b) { return a.number() >= b.number(); }

private:
	int m_number = -1;
};

/// Position of an index in an array.
constexpr std::size_t positionOf(int index)
{
	return static_cast<std::size_t>(index);
}
template<class Self>
constexpr std::size_t positionOf(const Index<Self>& index)
{
	return static_cast<std::size_t>(index.number());
}

/// The elements with numbers first .. last - 1, for range-based loops. What is left of them is the iterator, too.
template<class I>
class IndexRange
{
public:
	constexpr IndexRange(int first, int last) : m_first(first), m_last(last) {}
	constexpr explicit IndexRange(int count) : m_first(0), m_last(count) {}
	constexpr IndexRange begin() const { return *this; }
	constexpr IndexRange end() const { return {m_last, m_last}; }
	constexpr int size() const { return m_last - m_first; }

	constexpr I operator*() const { return I(m_first); }
	constexpr IndexRange& operator++()
	{
		++m_first;
		return *this;
	}
	constexpr bool operator!=(const IndexRange& other) const { return m_first != other.m_first; }

private:
	int m_first, m_last;
};

/// A corner of a triangle in a list of triangles, and the side that begins there: number 3 f + k.
struct Corner : Index<Corner>
{
	using Index::Index;
	constexpr Corner(int face, int k) : Index(3 * face + k) {}

	constexpr int face() const { return number() / 3; }
	/// 0, 1 or 2: which corner of its triangle.
	constexpr std::size_t index() const { return static_cast<std::size_t>(number() % 3); }

	/// The next corner of the triangle, where the side ends, and the one before.
	constexpr Corner next() const { return Corner(number() + (number() % 3 < 2 ? 1 : -2)); }
	constexpr Corner previous() const { return Corner(number() - (number() % 3 > 0 ? 1 : -2)); }
};

/// The corners of a triangle.
constexpr IndexRange<Corner> cornersOf(int face)
{
	return {3 * face, 3 * face + 3};
}

/// A std::vector whose elements are found by indices of the type \p I.
template<class I, class T>
class IndexedArray
{
public:
	using value_type = T;
	using iterator = typename std::vector<T>::iterator;
	using const_iterator = typename std::vector<T>::const_iterator;

	IndexedArray() = default;
	template<class Integer, class = std::enable_if_t<std::is_integral_v<Integer>>>
	explicit IndexedArray(Integer size, const T& value = T()) :
			m_values(static_cast<std::size_t>(size), value)
	{
	}
	explicit IndexedArray(std::vector<T> values) : m_values(std::move(values)) {}
	IndexedArray(std::initializer_list<T> values) : m_values(values) {}

	T& operator[](I i) { return m_values[positionOf(i)]; }
	const T& operator[](I i) const { return m_values[positionOf(i)]; }

	/// What belongs to one corner, where \p T has three entries, one for each corner of a triangle.
	template<class Three = T>
	typename Three::value_type& operator[](Corner c)
	{
		return m_values[static_cast<std::size_t>(c.face())][c.index()];
	}
	template<class Three = T>
	const typename Three::value_type& operator[](Corner c) const
	{
		return m_values[static_cast<std::size_t>(c.face())][c.index()];
	}

	int size() const { return static_cast<int>(m_values.size()); }
	bool empty() const { return m_values.empty(); }
	IndexRange<I> indices() const { return IndexRange<I>(size()); }

	template<class Integer>
	void assign(Integer size, const T& value)
	{
		m_values.assign(static_cast<std::size_t>(size), value);
	}
	template<class Integer>
	void resize(Integer size, const T& value = T())
	{
		m_values.resize(static_cast<std::size_t>(size), value);
	}
	template<class Integer>
	void reserve(Integer size)
	{
		m_values.reserve(static_cast<std::size_t>(size));
	}
	void clear() { m_values.clear(); }
	void push_back(const T& value) { m_values.push_back(value); }
	void push_back(T&& value) { m_values.push_back(std::move(value)); }
	/// All of \p values, which are taken over where there have been none.
	void append(IndexedArray values)
	{
		if (m_values.empty())
			swap(values);
		else
			m_values.insert(m_values.end(), values.begin(), values.end());
	}
	void swap(IndexedArray& other) { m_values.swap(other.m_values); }

	const T& front() const { return m_values.front(); }
	T& back() { return m_values.back(); }
	const T& back() const { return m_values.back(); }
	iterator begin() { return m_values.begin(); }
	iterator end() { return m_values.end(); }
	const_iterator begin() const { return m_values.begin(); }
	const_iterator end() const { return m_values.end(); }
	T* data() { return m_values.data(); }
	const T* data() const { return m_values.data(); }

	/// The array as a plain vector, in the order of the indices.
	std::vector<T>& values() { return m_values; }
	const std::vector<T>& values() const { return m_values; }

	friend bool operator==(const IndexedArray& a, const IndexedArray& b)
	{
		return a.m_values == b.m_values;
	}
	friend bool operator!=(const IndexedArray& a, const IndexedArray& b) { return !(a == b); }

private:
	std::vector<T> m_values;
};

/// Brings items into their order, each once.
template<class T>
void sortUnique(std::vector<T>& items)
{
	std::sort(items.begin(), items.end());
	items.erase(std::unique(items.begin(), items.end()), items.end());
}

/// A std::vector of elements numbered by int (-1: none).
template<class T>
using Array = IndexedArray<int, T>;
template<class T>
using CornerArray = IndexedArray<Corner, T>;

} // namespace ricci

#endif
