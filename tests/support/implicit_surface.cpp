// SPDX-License-Identifier: GPL-3.0-or-later
#include "implicit_surface.h"

#include "random.h"
#include "vcg_mesh.h"

#include <vcg/complex/algorithms/clean.h>
#include <vcg/complex/algorithms/create/marching_cubes.h>
#include <vcg/complex/algorithms/create/mc_trivial_walker.h>

#include <algorithm>
#include <cmath>

namespace ricci::testing {

SurfaceMesh marchingCubes(
	const std::function<double(const Point3&)>& f,
	const Point3& low,
	const Point3& high,
	const std::array<int, 3>& cells)
{
	using Volume = vcg::SimpleVolume<vcg::SimpleVoxel<double>>;
	using Walker = vcg::tri::TrivialWalker<DoubleMesh, Volume>;
	Volume volume;
	// The walker leaves out the last two layers of cells.
	const std::array<int, 3> size{cells[0] + 2, cells[1] + 2, cells[2] + 2};
	Point3 end;
	for (std::size_t k = 0; k < 3; ++k)
		end[k] = low[k] + (high[k] - low[k]) * size[k] / cells[k];
	volume.Init(
		vcg::Point3i(size[0], size[1], size[2]),
		vcg::Box3d(vcg::Point3d(low[0], low[1], low[2]), vcg::Point3d(end[0], end[1], end[2])));
	for (int k = 0; k < size[2]; ++k)
		for (int j = 0; j < size[1]; ++j)
			for (int i = 0; i < size[0]; ++i)
				volume.Val(i, j, k) =
					f({low[0] + (end[0] - low[0]) * i / size[0],
					   low[1] + (end[1] - low[1]) * j / size[1],
					   low[2] + (end[2] - low[2]) * k / size[2]});
	DoubleMesh mesh;
	Walker walker;
	vcg::tri::MarchingCubes<DoubleMesh, Walker> extractor(mesh, walker);
	walker.BuildMesh(mesh, volume, extractor, 0.0f);
	vcg::tri::Clean<DoubleMesh>::RemoveUnreferencedVertex(mesh);
	vcg::tri::Allocator<DoubleMesh>::CompactEveryVector(mesh);
	return fromVcg(mesh);
}

SurfaceMesh implicitClosed(int genus, int cellsPerUnit, std::uint64_t seed)
{
	Random random(seed);
	const Point3 shift{random.real(0, 0.1), random.real(0, 0.1), random.real(0, 0.1)};
	const int circles = std::max(genus, 1);
	const double reach = 1.5 + (circles - 1);
	const auto f = [&](const Point3& p) {
		const double x = p[0] - shift[0], y = p[1] - shift[1], z = p[2] - shift[2];
		if (genus == 0)
			return 1.0 - std::sqrt(x * x + 1.3 * y * y + 2.5 * z * z) + 0.1 * std::sin(3 * x);
		// Smooth union of tubes round touching circles.
		double sum = 0.0;
		for (int c = 0; c < circles; ++c) {
			const double d = std::hypot(x - (2 * c - (circles - 1)), y) - 1.0;
			sum += std::exp(-20 * (d * d + z * z));
		}
		return std::log(sum) / 20 + 0.1;
	};
	const int flat = genus == 0 ? 3 * cellsPerUnit : cellsPerUnit * 3 / 2;
	const double height = 0.5 * flat / cellsPerUnit;
	return marchingCubes(
		f,
		{-reach, -1.5, -height},
		{reach, 1.5, height},
		{static_cast<int>(2 * reach) * cellsPerUnit, 3 * cellsPerUnit, flat});
}

SurfaceMesh implicitDisk(int cells, std::uint64_t seed)
{
	Random random(seed);
	const double a = random.real(1.5, 3.0), b = random.real(1.5, 3.0), c = random.real(-0.1, 0.1);
	return marchingCubes(
		[&](const Point3& p) {
			return p[2] - 0.3 * std::sin(a * p[0]) * std::cos(b * p[1]) - 0.1 * p[0] - c;
		},
		{-1, -1, -0.6},
		{1, 1, 0.6},
		{cells, cells, cells * 6 / 10});
}

SurfaceMesh implicitAnnulus(int cells, std::uint64_t seed)
{
	Random random(seed);
	const double a = random.real(0.4, 0.5), b = random.real(-0.1, 0.1), c = random.real(0.1, 0.2);
	return marchingCubes(
		[&](const Point3& p) {
			return std::hypot(p[0] - b, p[1] - 0.3 * b) - a - c * p[2] * p[2] - 0.05 * p[0];
		},
		{-1, -1, -0.8},
		{1, 1, 0.8},
		{cells, cells, cells * 8 / 10});
}

} // namespace ricci::testing
