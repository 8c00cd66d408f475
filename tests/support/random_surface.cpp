// SPDX-License-Identifier: GPL-3.0-or-later
#include "random_surface.h"

#include "shapes.h"

#include <cmath>
#include <numeric>

namespace ricci::testing {

namespace {

std::vector<double> randomSteps(int n, double decades, Random& random)
{
	std::vector<double> at{0.0};
	for (int i = 0; i < n; ++i)
		at.push_back(at.back() + std::pow(10.0, random.real(-decades, 0.0)));
	return at;
}

} // namespace

void swapDiagonalsAtRandom(SurfaceMesh& mesh, Random& random)
{
	for (std::size_t f = 0; f + 1 < mesh.triangles.size(); f += 2) {
		if (random.coin())
			continue;
		const auto [a, b, c] = mesh.triangles[f];
		const int d = mesh.triangles[f + 1][2];
		mesh.triangles[f] = {a, b, d};
		mesh.triangles[f + 1] = {b, c, d};
	}
}

SurfaceMesh randomPlanarDisk(int n, Random& random)
{
	SurfaceMesh mesh = rectangle(n, n, 1.0, 1.0);
	for (Point3& p : mesh.positions)
		for (std::size_t k = 0; k < 2; ++k)
			p[k] += random.real(-0.24, 0.24) / n;
	swapDiagonalsAtRandom(mesh, random);
	return mesh;
}

SurfaceMesh sliverDisk(int n, double decades, Random& random)
{
	const std::vector<double> x = randomSteps(n, decades, random);
	const std::vector<double> y = randomSteps(n, decades, random);
	SurfaceMesh mesh = grid(n, n, Ends::Open, Ends::Open, [&](int i, int j) {
		const double u = x[at(i)], v = y[at(j)];
		return Point3{u, v, 0.1 * std::sin(2.0 * u) * std::cos(1.5 * v)};
	});
	swapDiagonalsAtRandom(mesh, random);
	return mesh;
}

SurfaceMesh bumpyTorus(int nu, int nv, Random& random)
{
	SurfaceMesh mesh = grid(nu, nv, Ends::Joined, Ends::Joined, [&](int i, int j) {
		const double u = 2 * kPi * (i + random.real(-0.25, 0.25)) / nu;
		const double v = 2 * kPi * (j + random.real(-0.25, 0.25)) / nv;
		const double r = 1.0 + 0.1 * random.real(-1.0, 1.0), d = 3.0 + r * std::cos(v);
		return Point3{d * std::cos(u), d * std::sin(u), r * std::sin(v)};
	});
	swapDiagonalsAtRandom(mesh, random);
	return mesh;
}

SurfaceMesh foldedTorus(int nu, int nv, double height, Random& random)
{
	return grid(nu, nv, Ends::Joined, Ends::Joined, [&](int, int) {
		const double x = random.real(0.0, 1.0), y = random.real(0.0, height);
		return Point3{x, y, 0.0};
	});
}

SurfaceMesh shaken(SurfaceMesh mesh, double amount, Random& random)
{
	for (Point3& p : mesh.positions)
		for (double& x : p)
			x += random.real(-amount, amount);
	return mesh;
}

std::vector<SurfaceMesh> surfacesOfEveryKind(Random& random)
{
	std::vector<SurfaceMesh> meshes;
	for (int genus = 0; genus <= 3; ++genus) {
		meshes.push_back(shaken(perforatedSlab(genus, 3), 0.03, random));
		meshes.push_back(withoutStars(meshes.back(), {0}));
		meshes.push_back(withoutStars(perforatedSlab(genus, 3), {0, 40}));
	}
	meshes.push_back(bumpyTorus(14, 9, random));
	meshes.push_back(ring(1, 4, 12, 5));
	return meshes;
}

Renumbered renumbered(const SurfaceMesh& mesh, Random& random)
{
	Renumbered result;
	result.vertex.resize(mesh.positions.size());
	result.face.resize(mesh.triangles.size());
	std::iota(result.vertex.begin(), result.vertex.end(), 0);
	std::iota(result.face.begin(), result.face.end(), 0);
	random.shuffle(result.vertex);
	random.shuffle(result.face);
	std::vector<int> place(mesh.positions.size());
	for (std::size_t i = 0; i < result.vertex.size(); ++i) {
		place[at(result.vertex[i])] = static_cast<int>(i);
		result.mesh.positions.push_back(mesh.positions[at(result.vertex[i])]);
	}
	for (int f : result.face) {
		const Triangle& t = mesh.triangles[at(f)];
		const std::size_t turn = at(random.index(3));
		result.mesh.triangles.push_back(
			{place[at(t[turn])], place[at(t[(turn + 1) % 3])], place[at(t[(turn + 2) % 3])]});
	}
	return result;
}

} // namespace ricci::testing
