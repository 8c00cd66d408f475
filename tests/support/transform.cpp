// SPDX-License-Identifier: GPL-3.0-or-later
#include "transform.h"

#include "shapes.h"

#include <cmath>
#include <numeric>

namespace ricci::testing {

SurfaceMesh scaled(SurfaceMesh mesh, double factor)
{
	for (Point3& p : mesh.positions)
		for (double& x : p)
			x *= factor;
	return mesh;
}

SurfaceMesh inFloats(SurfaceMesh mesh)
{
	for (Point3& p : mesh.positions)
		for (double& x : p)
			x = static_cast<double>(static_cast<float>(x));
	return mesh;
}

SurfaceMesh turned(SurfaceMesh mesh, const std::array<double, 3>& angles)
{
	for (Point3& p : mesh.positions)
		for (std::size_t axis = 0; axis < 3; ++axis) {
			const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
			const double c = std::cos(angles[axis]), s = std::sin(angles[axis]);
			const double x = p[u], y = p[v];
			p[u] = c * x - s * y;
			p[v] = s * x + c * y;
		}
	return mesh;
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
