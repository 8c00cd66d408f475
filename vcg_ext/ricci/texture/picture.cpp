// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture.h"

#include "../base/parallel.h"
#include "../base/task.h"

#include <cstdint>
#include <cstdlib>
#include <limits>

namespace ricci {

namespace {

/// Rows or columns of one task.
constexpr int kRows = 64, kColumns = 512;

/// Rows from a texel to the nearest covered one of its column, which no picture is high enough for.
constexpr std::int16_t kNone = std::numeric_limits<std::int16_t>::max();

/// [texel] that offset, of a tie the one above; kNone where the column has none.
template<class Sample>
std::vector<std::int16_t>
offsetsInColumns(const std::vector<char>& covered, const PictureView<Sample>& picture, int threads)
{
	std::vector<std::int16_t> offsets(picture.texels(), kNone);
	const int tasks = (picture.width + kColumns - 1) / kColumns;
	tasksInParallel(tasks, threads, [&](int task) {
		const int first = task * kColumns, last = std::min(first + kColumns, picture.width);
		// Row by row, because that is how the texels lie in memory.
		for (int y = 0; y < picture.height; ++y) {
			if (y % 1024 == 0)
				checkpoint();
			for (int x = first; x < last; ++x) {
				const std::size_t i = picture.index(x, y);
				if (covered[i])
					offsets[i] = 0;
				else if (y > 0 && offsets[picture.index(x, y - 1)] != kNone)
					offsets[i] = static_cast<std::int16_t>(offsets[picture.index(x, y - 1)] - 1);
			}
		}
		for (int y = picture.height - 2; y >= 0; --y)
			for (int x = first; x < last; ++x) {
				std::int16_t& here = offsets[picture.index(x, y)];
				const std::int16_t below = offsets[picture.index(x, y + 1)];
				if (below != kNone && below + 1 < std::abs(here))
					here = static_cast<std::int16_t>(below + 1);
			}
	});
	return offsets;
}

/// The columns whose covered texels are the nearest ones of a row: the lower envelope of the parabolas
/// (x - column)^2 + offset^2.
class Envelope
{
public:
	explicit Envelope(int width)
	{
		m_columns.reserve(static_cast<std::size_t>(width));
		m_from.reserve(static_cast<std::size_t>(width));
	}

	void build(const std::int16_t* offsets, int width)
	{
		m_columns.clear();
		m_from.clear();
		for (int x = 0; x < width; ++x) {
			if (offsets[x] == kNone)
				continue;
			double from = 0.0;
			while (!m_columns.empty()) {
				const int other = m_columns.back();
				from = (height(offsets, x) - height(offsets, other)) / (2.0 * (x - other));
				if (from > m_from.back())
					break;
				m_columns.pop_back();
				m_from.pop_back();
				from = 0.0;
			}
			m_columns.push_back(x);
			m_from.push_back(m_columns.size() == 1 ? -1.0 : from);
		}
	}

	bool empty() const { return m_columns.empty(); }

	/// The columns for x = 0, 1, ... in turn; \p place starts at 0.
	int columnAt(int x, std::size_t& place) const
	{
		while (place + 1 < m_columns.size() && m_from[place + 1] < x)
			++place;
		return m_columns[place];
	}

private:
	static double height(const std::int16_t* offsets, int x)
	{
		const double offset = offsets[x];
		return offset * offset + static_cast<double>(x) * x;
	}

	std::vector<int> m_columns;
	std::vector<double> m_from; // [of m_columns] where its parabola becomes the lowest
};

} // namespace

template<class Sample>
void fillFromNearest(
	const std::vector<char>& covered, const PictureView<Sample>& picture, int threads)
{
	const std::vector<std::int16_t> offsets = offsetsInColumns(covered, picture, threads);
	const int tasks = (picture.height + kRows - 1) / kRows;
	tasksInParallel(tasks, threads, [&](int task) {
		Envelope envelope(picture.width);
		const int last = std::min((task + 1) * kRows, picture.height);
		for (int y = task * kRows; y < last; ++y) {
			checkpoint();
			const std::int16_t* row = &offsets[picture.index(0, y)];
			if (std::all_of(row, row + picture.width, [](std::int16_t o) { return o == 0; }))
				continue;
			envelope.build(row, picture.width);
			std::size_t place = 0;
			for (int x = 0; x < picture.width && !envelope.empty(); ++x) {
				const int column = envelope.columnAt(x, place);
				if (row[x] != 0)
					std::copy_n(
						picture.rgba + 4 * picture.index(column, y + row[column]),
						4,
						picture.rgba + 4 * picture.index(x, y));
			}
		}
	});
}

template void fillFromNearest(const std::vector<char>&, const PictureView<unsigned char>&, int);
template void fillFromNearest(const std::vector<char>&, const PictureView<unsigned short>&, int);

} // namespace ricci
