// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles that do not form an oriented manifold.
#ifndef RICCI_TESTS_BAD_SURFACES_H
#define RICCI_TESTS_BAD_SURFACES_H

#include "shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/mesh/surface_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace ricci::testing {

inline Triangle reversed(const Triangle& t)
{
	return {t[0], t[2], t[1]};
}

/// A square with a triangle on one of its inner edges.
inline SurfaceMesh squareWithFin()
{
	SurfaceMesh mesh = rectangle(4, 4, 1, 1);
	const int a = mesh.triangles[14][0], b = mesh.triangles[14][1];
	mesh.positions.push_back({0.5, 0.5, 1.0});
	mesh.triangles.insert(
		mesh.triangles.begin(), {b, a, static_cast<int>(mesh.positions.size()) - 1});
	return mesh;
}

/// Every face twice, the second time in its other order if \p turn.
inline SurfaceMesh doubled(const SurfaceMesh& mesh, bool turn)
{
	SurfaceMesh result = mesh;
	for (const Triangle& t : mesh.triangles)
		result.triangles.push_back(turn ? reversed(t) : t);
	return result;
}

/// Two triangles of areas 1 and 3 that share the vertex 0 only.
inline SurfaceMesh bowTie()
{
	return {{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {-3, 0, 0}, {0, -2, 0}}, {{0, 1, 2}, {3, 4, 0}}};
}

/// A sphere whose poles touch, with a ring of 24 faces without area at the pole.
inline SurfaceMesh pinchedSphere()
{
	SurfaceMesh mesh = torus(1, 1, 12, 8);
	const int pole = 4; // at v = pi, where the rings have the radius 0
	for (Triangle& t : mesh.triangles)
		for (int& v : t)
			if (std::hypot(mesh.positions[at(v)][0], mesh.positions[at(v)][1]) < 1e-9)
				v = pole;
	return mesh;
}

/// Two tetrahedra that touch at a vertex.
inline SurfaceMesh touchingTetrahedra()
{
	SurfaceMesh mesh = tetrahedron();
	for (Triangle t : tetrahedron().triangles) {
		for (int& v : t)
			v = v == 0 ? 0 : v + 3;
		mesh.triangles.push_back(t);
	}
	for (int v = 1; v < 4; ++v)
		mesh.positions.push_back({2.0 + v, v * 0.3, v == 2 ? 1.0 : 0.0});
	return mesh;
}

/// Two tetrahedra that touch along an edge in such a way that their sheets cross straight on there.
/// \param first the corner that each face begins with
inline SurfaceMesh crossingTetrahedra(int first)
{
	SurfaceMesh mesh;
	mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0.5}, {-1, 0, 0.5}, {0, -1, 0.5}, {0, 1, 0.5}};
	const std::vector<Triangle> outward = {{0, 1, 2}, {1, 0, 5}, {1, 5, 2}, {0, 2, 5}};
	mesh.triangles = outward;
	for (Triangle t : outward) { // its image under half a turn, inward
		for (int& v : t)
			v = v == 2 ? 3 : v == 5 ? 4 : v;
		mesh.triangles.push_back(reversed(t));
	}
	for (Triangle& t : mesh.triangles)
		std::rotate(t.begin(), t.begin() + first, t.end());
	return mesh;
}

/// The figure-eight immersion of the Klein bottle.
inline SurfaceMesh figureEightBottle(int nu, int nv)
{
	return kleinBottle(nu, nv, [&](int i, int j) {
		const double u = 2 * kPi * i / nu, v = 2 * kPi * j / nv;
		const double c = std::cos(u / 2), s = std::sin(u / 2);
		const double r = 3 + c * std::sin(v) - s * std::sin(2 * v);
		return Point3{r * std::cos(u), r * std::sin(u), s * std::sin(v) + c * std::sin(2 * v)};
	});
}

/// The projective plane: half of a cube of n^2 cells on each side, opposite points identified.
inline SurfaceMesh projectivePlane(int n)
{
	std::map<std::array<int, 3>, int> number;
	SurfaceMesh mesh;
	const auto vertex = [&](std::array<int, 3> p) { // coordinates from -n to n, step 2
		p = std::max(p, std::array<int, 3>{-p[0], -p[1], -p[2]});
		const auto [place, isNew] = number.insert({p, static_cast<int>(number.size())});
		if (isNew) {
			const double x = double(p[0]) / n, y = double(p[1]) / n, z = double(p[2]) / n;
			mesh.positions.push_back({x * x + 0.3 * y * z, x * y - 0.1 * z * z, y * z + z * x});
		}
		return place->second;
	};
	for (std::size_t axis = 0; axis < 3; ++axis)
		for (const Triangle& t : cells(n, n, [&](int i, int j) {
				 std::array<int, 3> p{};
				 p[axis] = n;
				 p[(axis + 1) % 3] = 2 * i - n;
				 p[(axis + 2) % 3] = 2 * j - n;
				 return vertex(p);
			 }))
			mesh.triangles.push_back(t);
	return mesh;
}

/// A row of \p count crosscaps in a rectangle of 8 count x 8 cells: stars of vertices are taken out, and
/// opposite points of each hole identified, which leaves three edges round it.
inline SurfaceMesh crosscaps(int count)
{
	const int apart = 8, nx = apart * count;
	SurfaceMesh mesh = rectangle(nx, apart, nx, apart);
	const auto vertexAt = [&](int x, int y) { return x * (apart + 1) + y; };
	std::map<int, int> joined;
	std::set<int> centres;
	for (int i = 0; i < count; ++i) {
		const int x = apart * i + apart / 2, y = apart / 2;
		centres.insert(vertexAt(x, y));
		// The diagonals of the cells run from (x, y) to (x + 1, y + 1).
		for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)})
			joined[vertexAt(x - dx, y - dy)] = vertexAt(x + dx, y + dy);
	}
	std::vector<Triangle> kept;
	for (Triangle t : mesh.triangles) {
		if (std::any_of(t.begin(), t.end(), [&](int v) { return centres.count(v) > 0; }))
			continue;
		for (int& v : t)
			if (const auto other = joined.find(v); other != joined.end())
				v = other->second;
		kept.push_back(t);
	}
	mesh.triangles = kept;
	return mesh;
}

/// Three strips of three triangles at an edge from 0 to 1. The first and the second go straight on but have
/// the edge in the same direction; the third is coherent with the first, at 120 degrees.
inline SurfaceMesh threeStrips()
{
	SurfaceMesh mesh;
	mesh.positions = {{0, 0, 0}, {0, 0, 1}};
	for (const double degrees : {0.0, 180.0, 120.0}) {
		const double angle = degrees * kPi / 180.0;
		const int first = static_cast<int>(mesh.positions.size());
		for (const auto& [r, z] : {std::pair(1.0, 0.5), std::pair(1.0, 1.5), std::pair(2.0, 1.0)})
			mesh.positions.push_back({r * std::cos(angle), r * std::sin(angle), z});
		for (const Triangle& t :
			 {Triangle{0, 1, first}, {1, first + 1, first}, {first, first + 1, first + 2}})
			mesh.triangles.push_back(degrees == 120.0 ? reversed(t) : t);
	}
	return mesh;
}

} // namespace ricci::testing

#endif
