// SPDX-License-Identifier: GPL-3.0-or-later
// Flattens the surface of a cube, given as arrays, and prints its texture coordinates.
#include <ricci/ricci.h>

#include <algorithm>
#include <cstdio>

int main()
{
	std::vector<std::array<double, 3>> positions;
	for (int i = 0; i < 8; ++i)
		positions.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
	const std::vector<std::array<int, 3>> triangles = {
		{0, 2, 1},
		{1, 2, 3},
		{4, 5, 6},
		{5, 7, 6},
		{0, 1, 4},
		{1, 5, 4},
		{2, 6, 3},
		{3, 6, 7},
		{0, 4, 2},
		{2, 4, 6},
		{1, 3, 5},
		{3, 7, 5}};
	try {
		const ricci::TextureCoordinates map = ricci::flatten(positions, triangles);
		for (std::size_t f = 0; f < triangles.size(); ++f)
			for (std::size_t k = 0; k < 3; ++k) {
				const auto& uv = map.uv[std::size_t(map.triangles[f][k])];
				std::printf("face %zu vertex %d: %g %g\n", f, triangles[f][k], uv[0], uv[1]);
			}
		const int charts = 1 + *std::max_element(map.chart.begin(), map.chart.end());
		std::printf("%d charts, objective %g\n", charts, map.objective);
	}
	catch (const ricci::Error& error) {
		std::fprintf(stderr, "%s\n", error.what());
		return 1;
	}
}
