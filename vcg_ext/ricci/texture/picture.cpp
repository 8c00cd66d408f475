// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture.h"

#include "../base/indexed.h"
#include "../base/parallel.h"
#include "../base/task.h"

#include <cstdint>
#include <cstdlib>
#include <limits>

namespace ricci {

namespace {

/// Rows or columns of one task.
constexpr int kRows = 64, kColumns = 512;

/// Rows from a texel to the nearest covered one of its column where there is none.
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

/// [x] The column whose covered texel is the nearest one of a row, of those with \p offsets, which not all are kNone: by
/// the lower envelope of the parabolas (x - column)^2 + offset^2.
std::vector<int> nearestColumns(const std::int16_t* offsets, int width)
{
	const auto height = [&](int x) {
		const double offset = offsets[x];
		return offset * offset + static_cast<double>(x) * x;
	};
	std::vector<int> columns;
	std::vector<double> begin; // [of columns] where its parabola becomes the lowest
	for (int x = 0; x < width; ++x) {
		if (offsets[x] == kNone)
			continue;
		double from = 0.0;
		while (!columns.empty()) {
			const int other = columns.back();
			from = (height(x) - height(other)) / (2.0 * (x - other));
			if (from > begin.back())
				break;
			columns.pop_back();
			begin.pop_back();
			from = 0.0;
		}
		columns.push_back(x);
		begin.push_back(columns.size() == 1 ? -1.0 : from);
	}
	std::vector<int> nearest;
	nearest.reserve(static_cast<std::size_t>(width));
	std::size_t place = 0;
	for (int x = 0; x < width; ++x) {
		while (place + 1 < columns.size() && begin[place + 1] < x)
			++place;
		nearest.push_back(columns[place]);
	}
	return nearest;
}

} // namespace

template<class Sample>
void fillFromNearest(
	const std::vector<char>& covered, const PictureView<Sample>& picture, int threads)
{
	const std::vector<std::int16_t> offsets = offsetsInColumns(covered, picture, threads);
	const int tasks = (picture.height + kRows - 1) / kRows;
	tasksInParallel(tasks, threads, [&](int task) {
		const int last = std::min((task + 1) * kRows, picture.height);
		for (int y = task * kRows; y < last; ++y) {
			checkpoint();
			const std::int16_t* row = &offsets[picture.index(0, y)];
			const auto areAll = [&](std::int16_t offset) {
				return std::all_of(row, row + picture.width, [&](auto o) { return o == offset; });
			};
			if (areAll(0) || areAll(kNone))
				continue;
			const std::vector<int> nearest = nearestColumns(row, picture.width);
			for (int x = 0; x < picture.width; ++x)
				if (const int column = nearest[positionOf(x)]; row[x] != 0)
					std::copy_n(
						picture.rgba + 4 * picture.index(column, y + row[column]),
						4,
						picture.rgba + 4 * picture.index(x, y));
		}
	});
}

template void fillFromNearest(const std::vector<char>&, const PictureView<unsigned char>&, int);
template void fillFromNearest(const std::vector<char>&, const PictureView<unsigned short>&, int);

} // namespace ricci
