// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces tiled by mirror images of one polygon, folded onto it: of their metric nothing is lost, and their
// symmetries tell their conformal structure.
#ifndef RICCI_TESTS_REFLECTED_H
#define RICCI_TESTS_REFLECTED_H

#include "shapes.h"

#include <ricci/base/graphs.h>
#include <ricci/base/numbers.h>
#include <ricci/mesh/surface_mesh.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace ricci::testing {

/// A triangulated polygon, counter-clockwise, and the vertices on each of its sides.
struct Tile
{
	SurfaceMesh mesh;
	std::vector<std::vector<int>> sides;
};

/// \p count copies of the tile, each glued to copy across(copy, side), as its mirror image, along each side. All
/// lie on the tile.
/// \param across an involution for each side, under which copies have two colours
inline SurfaceMesh
reflected(const Tile& tile, int count, const std::function<int(int, int)>& across)
{
	const int own = static_cast<int>(tile.mesh.positions.size());
	DisjointSets vertices(count * own);
	std::vector<int> colour(at(count), -1), queue{0};
	colour[0] = 0;
	for (std::size_t head = 0; head < queue.size(); ++head)
		for (int side = 0; side < static_cast<int>(tile.sides.size()); ++side) {
			const int copy = queue[head], other = across(copy, side);
			for (const int v : tile.sides[at(side)])
				vertices.merge(copy * own + v, other * own + v);
			if (colour[at(other)] < 0) {
				colour[at(other)] = 1 - colour[at(copy)];
				queue.push_back(other);
			}
		}
	SurfaceMesh surface;
	std::vector<int> number(at(count * own), -1);
	for (const int copy : queue)
		for (Triangle t : tile.mesh.triangles) {
			for (int& v : t) {
				int& n = number[at(vertices.find(copy * own + v))];
				if (n < 0) {
					n = static_cast<int>(surface.positions.size());
					surface.positions.push_back(tile.mesh.positions[at(v)]);
				}
				v = n;
			}
			if (colour[at(copy)] == 1)
				std::swap(t[1], t[2]);
			surface.triangles.push_back(t);
		}
	return surface;
}

/// The triangle abc with sides divided by \p n >= 3. Side 0 lies opposite to a, and so on.
inline Tile triangleTile(const Point2& a, const Point2& b, const Point2& c, int n)
{
	Tile tile;
	tile.sides.resize(3);
	const auto number = [&](int i, int j) { return j * (n + 1) - j * (j - 1) / 2 + i; };
	for (int j = 0; j <= n; ++j)
		for (int i = 0; i + j <= n; ++i) {
			const double x = double(i) / n, y = double(j) / n; // weights of b and c
			const int v = static_cast<int>(tile.mesh.positions.size());
			const Point2 p = (1 - x - y) * a + x * b + y * c;
			tile.mesh.positions.push_back({p[0], p[1], 0.0});
			if (i + j == n)
				tile.sides[0].push_back(v);
			if (i == 0)
				tile.sides[1].push_back(v);
			if (j == 0)
				tile.sides[2].push_back(v);
			if (i + j == n)
				continue;
			tile.mesh.triangles.push_back({v, number(i + 1, j), number(i, j + 1)});
			if (i + j + 1 < n)
				tile.mesh.triangles.push_back(
					{number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)});
		}
	return tile;
}

/// A rectangle of nx x ny cells from the origin. Sides: left, right, below, above.
inline Tile rectangleTile(int nx, int ny, double width, double height)
{
	Tile tile{rectangle(nx, ny, width, height), std::vector<std::vector<int>>(4)};
	for (int i = 0; i <= nx; ++i)
		for (int j = 0; j <= ny; ++j) {
			const int v = i * (ny + 1) + j;
			for (const auto& [side, isOn] :
				 {std::pair(0, i == 0),
				  std::pair(1, i == nx),
				  std::pair(2, j == 0),
				  std::pair(3, j == ny)})
				if (isOn)
					tile.sides[at(side)].push_back(v);
		}
	return tile;
}

/// Squares of 2 x 2 tiles. \p right and \p above give each square's neighbours.
inline SurfaceMesh
squareTiled(const Tile& quarter, const std::vector<int>& right, const std::vector<int>& above)
{
	const int count = static_cast<int>(right.size());
	return reflected(quarter, 4 * count, [&](int copy, int side) {
		const int square = copy / 4, x = copy % 2, y = copy / 2 % 2;
		const auto before = [&](const std::vector<int>& next) {
			int other = 0;
			while (next[at(other)] != square)
				++other;
			return other;
		};
		if (side == 1 || side == 3) // to the other half
			return side == 1 ? copy ^ 1 : copy ^ 2;
		if (side == 0)
			return 4 * (x == 0 ? before(right) : right[at(square)]) + 2 * y + 1 - x;
		return 4 * (y == 0 ? before(above) : above[at(square)]) + 2 * (1 - y) + x;
	});
}

/// The torus of 2 nx x 2 ny tiles, of which the row above the last is the first, moved by 2 \p shift tiles. With tiles
/// of this width and height its modulus is (shift width + i ny height) / (nx width).
inline SurfaceMesh tiledTorus(const Tile& tile, int nx, int ny, int shift)
{
	std::vector<int> right, above;
	for (int y = 0; y < ny; ++y)
		for (int x = 0; x < nx; ++x) {
			right.push_back(y * nx + (x + 1) % nx);
			above.push_back(y + 1 < ny ? (y + 1) * nx + x : (x + nx - shift) % nx);
		}
	return squareTiled(tile, right, above);
}

/// Which of the points at 0 and infinity are branched.
enum class Branched {
	Neither, ///< y^2 = x^n - 1, n even
	One,     ///< y^2 = x^n - 1, n odd
	Both     ///< y^2 = x^(n+1) - x, n even
};

/// The hyperelliptic curve that is branched at the n-th roots of unity. The sphere is tiled by 4 n triangles with
/// their corners at 0 or infinity, at a root, and at the middle between two of them; each is on two sheets. Sides
/// are divided by \p divisions. The triangles are those of regular polygons, \p stretch times as wide.
inline SurfaceMesh hyperelliptic(int n, Branched branched, int divisions, double stretch = 1.0)
{
	const double angle = kPi / n, x = stretch * std::cos(angle);
	const Tile tile = triangleTile({0, 0}, {x, -std::sin(angle)}, {x, 0}, divisions);
	// A copy: pole, sector, half and sheet. The sheets cross over along edges from a pole to the roots.
	return reflected(tile, 8 * n, [=](int copy, int side) {
		const int sheet = copy % 2, half = copy / 2 % 2, pole = copy / 4 % 2, sector = copy / 8;
		const auto number = [](int k, int p, int h, int s) { return 8 * k + 4 * p + 2 * h + s; };
		if (side == 0)
			return number(sector, 1 - pole, half, sheet);
		if (side == 1)
			return number(sector, pole, 1 - half, sheet);
		const int root = (sector + half) % n, other = half == 0 ? (sector + n - 1) % n : root;
		const bool crosses = pole == (branched == Branched::Both && root == 0 ? 1 : 0);
		return number(other, pole, 1 - half, crosses ? 1 - sheet : sheet);
	});
}

} // namespace ricci::testing

#endif
