// SPDX-License-Identifier: GPL-3.0-or-later
// Flattens the surface of a cube, given as arrays, and prints its texture coordinates.
#include <ricci/error.h>
#include <ricci/parametrize.h>

#include <cstdio>

int main()
{
	ricci::SurfaceMesh cube;
	for (int i = 0; i < 8; ++i)
		cube.positions.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
	cube.triangles = {
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
		const ricci::Parametrization map =
			ricci::parametrizeEuclidean(cube, ricci::VertexInput(), ricci::Options());
		for (int t = 0; t < map.mesh.size(); ++t)
			for (int k = 0; k < 3; ++k) {
				const ricci::Point2& uv = map.mesh.at(ricci::Corner(t, k));
				std::printf(
					"face %d vertex %d: %g %g\n",
					map.mesh.face[t],
					map.mesh.vertices[t][k],
					uv[0],
					uv[1]);
			}
		std::printf("%zu charts, distortion %g\n", map.charts.size(), map.report.qcAreaMean);
	}
	catch (const ricci::Error& error) {
		std::fprintf(stderr, "%s\n", error.what());
		return 1;
	}
}
