// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ricci::testing {

double areaOf(const SurfaceMesh& mesh, std::size_t face)
{
	const Triangle& t = mesh.triangles[face];
	const Point3& origin = mesh.positions[at(t[0])];
	return 0.5 *
		   length(cross(mesh.positions[at(t[1])] - origin, mesh.positions[at(t[2])] - origin));
}

double areaOf(const SurfaceMesh& mesh)
{
	double area = 0.0;
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
		area += areaOf(mesh, f);
	return area;
}

std::vector<Triangle> cells(int nu, int nv, const std::function<int(int, int)>& vertex)
{
	std::vector<Triangle> triangles;
	for (int i = 0; i < nu; ++i)
		for (int j = 0; j < nv; ++j) {
			const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
					  d = vertex(i, j + 1);
			triangles.push_back({a, b, c});
			triangles.push_back({a, c, d});
		}
	return triangles;
}

SurfaceMesh
grid(int nu, int nv, Ends alongU, Ends alongV, const std::function<Point3(int, int)>& point)
{
	const int columns = nu + (alongU == Ends::Open), rows = nv + (alongV == Ends::Open);
	SurfaceMesh mesh;
	for (int i = 0; i < columns; ++i)
		for (int j = 0; j < rows; ++j)
			mesh.positions.push_back(point(i, j));
	mesh.triangles = cells(nu, nv, [&](int i, int j) { return (i % columns) * rows + j % rows; });
	return mesh;
}

SurfaceMesh rectangle(int nx, int ny, double width, double height)
{
	return grid(nx, ny, Ends::Open, Ends::Open, [&](int i, int j) {
		return Point3{width * i / nx, height * j / ny, 0.0};
	});
}

SurfaceMesh hill(int n, double height)
{
	return grid(n, n, Ends::Open, Ends::Open, [=](int i, int j) {
		const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
		return Point3{x, y, height * std::sin(3 * x + 1) * std::cos(4 * y)};
	});
}

SurfaceMesh bumpyPatch(int n)
{
	return grid(n, n, Ends::Open, Ends::Open, [&](int i, int j) {
		const double x = 2.0 * i / n - 1, y = 2.0 * j / n - 1;
		return Point3{
			x * std::sqrt(1 - 0.5 * y * y) + 0.1 * y,
			y * std::sqrt(1 - 0.5 * x * x),
			0.4 * std::exp(-2 * (x - 0.3) * (x - 0.3) - 3 * y * y)};
	});
}

SurfaceMesh withFlatTail(SurfaceMesh mesh, int i, int j, double length)
{
	const int apex = static_cast<int>(mesh.positions.size()), middle = apex + 1;
	const Point3 start = mesh.positions[at(j)];
	mesh.positions.push_back(start + Point3{length, 0, 0});
	mesh.positions.push_back(start + Point3{length / 2, 0, 0});
	mesh.triangles.push_back({j, i, apex});
	mesh.triangles.push_back({j, apex, middle});
	return mesh;
}

SurfaceMesh torus(double R, double r, int nu, int nv)
{
	return grid(nu, nv, Ends::Joined, Ends::Joined, [&](int i, int j) {
		const double u = 2 * kPi * i / nu, v = 2 * kPi * j / nv, d = R + r * std::cos(v);
		return Point3{d * std::cos(u), d * std::sin(u), r * std::sin(v)};
	});
}

SurfaceMesh ring(double r1, double r2, int around, int across)
{
	return grid(across, around, Ends::Open, Ends::Joined, [&](int i, int j) {
		const double r = r1 * std::pow(r2 / r1, static_cast<double>(i) / across);
		const double a = 2 * kPi * j / around;
		return Point3{r * std::cos(a), r * std::sin(a), 0.0};
	});
}

SurfaceMesh revolved(const std::vector<std::array<double, 2>>& profile, int around)
{
	SurfaceMesh mesh;
	std::vector<int> first; // vertex of each ring or pole
	for (const auto& [radius, z] : profile) {
		first.push_back(static_cast<int>(mesh.positions.size()));
		for (int j = 0; j < (radius > 0.0 ? around : 1); ++j) {
			const double a = 2 * kPi * j / around;
			mesh.positions.push_back({radius * std::cos(a), radius * std::sin(a), z});
		}
	}
	for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
		const bool fromPole = !(profile[i][0] > 0.0), toPole = !(profile[i + 1][0] > 0.0);
		for (int j = 0; j < around; ++j) {
			const int k = (j + 1) % around, above = first[i + 1];
			const int a = first[i] + j, b = first[i] + k, c = above + k, d = above + j;
			if (fromPole)
				mesh.triangles.push_back({first[i], c, d});
			else if (toPole)
				mesh.triangles.push_back({a, b, above});
			else {
				mesh.triangles.push_back({a, b, c});
				mesh.triangles.push_back({a, c, d});
			}
		}
	}
	return mesh;
}

SurfaceMesh sphere(int rings, int around)
{
	std::vector<std::array<double, 2>> profile;
	for (int i = 0; i <= rings; ++i)
		profile.push_back({std::sin(kPi * i / rings), -std::cos(kPi * i / rings)});
	profile.front()[0] = profile.back()[0] = 0.0;
	return revolved(profile, around);
}

SurfaceMesh sphereWithTube(double radius, double length, double hole, int rings, int around)
{
	std::vector<std::array<double, 2>> profile;
	if (!(hole > 0.0))
		profile.push_back({0.0, -1.0});
	const double top = kPi - std::asin(radius), step = (top - hole) / rings;
	for (int i = hole > 0.0 ? 0 : 1; i <= rings; ++i) {
		const double a = hole + i * step; // from the south pole
		profile.push_back({std::sin(a), -std::cos(a)});
	}
	const double base = -std::cos(top);
	const int along = static_cast<int>(std::ceil(length / step));
	for (int i = 1; i <= along; ++i)
		profile.push_back({radius, base + length * i / along});
	const int over = 4; // rings of the half sphere at the end
	for (int i = 1; i < over; ++i) {
		const double a = 0.5 * kPi * i / over;
		profile.push_back({radius * std::cos(a), base + length + radius * std::sin(a)});
	}
	profile.push_back({0.0, base + length + radius});
	return revolved(profile, around);
}

SurfaceMesh tetrahedron()
{
	const double s = 1.0 / std::sqrt(3.0);
	return {
		{{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}},
		{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
}

SurfaceMesh perforatedSlab(int genus, int subdivision)
{
	const std::array<int, 3> size{2 * genus + 1, 3, 1};
	const auto solid = [&](std::array<int, 3> c) {
		for (std::size_t k = 0; k < 3; ++k)
			if (c[k] < 0 || c[k] >= size[k])
				return false;
		return !(c[1] == 1 && c[0] % 2 == 1);
	};
	SurfaceMesh mesh;
	const int rows = size[1] * subdivision + 1, layers = size[2] * subdivision + 1;
	// Of lattice points, in units of 1 / subdivision.
	std::vector<int> index(at((size[0] * subdivision + 1) * rows * layers), -1);
	const auto vertex = [&](std::array<int, 3> p) {
		int& v = index[at((p[0] * rows + p[1]) * layers + p[2])];
		if (v < 0) {
			v = static_cast<int>(mesh.positions.size());
			mesh.positions.push_back(
				{double(p[0]) / subdivision,
				 double(p[1]) / subdivision,
				 double(p[2]) / subdivision});
		}
		return v;
	};
	const auto addSquare = [&](std::array<int, 3> cube, std::size_t axis, int side) {
		const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
		for (int i = 0; i < subdivision; ++i)
			for (int j = 0; j < subdivision; ++j) {
				std::array<int, 4> corner;
				for (int k = 0; k < 4; ++k) {
					std::array<int, 3> p;
					p[axis] = (cube[axis] + side) * subdivision;
					p[u] = cube[u] * subdivision + i + (k == 1 || k == 2);
					p[v] = cube[v] * subdivision + j + (k >= 2);
					corner[at(k)] = vertex(p);
				}
				if (side == 0)
					std::swap(corner[1], corner[3]);
				mesh.triangles.push_back({corner[0], corner[1], corner[2]});
				mesh.triangles.push_back({corner[0], corner[2], corner[3]});
			}
	};
	for (int x = 0; x < size[0]; ++x)
		for (int y = 0; y < size[1]; ++y) {
			const std::array<int, 3> cube{x, y, 0};
			if (!solid(cube))
				continue;
			for (std::size_t axis = 0; axis < 3; ++axis)
				for (int side : {0, 1}) {
					std::array<int, 3> beyond = cube;
					beyond[axis] += 2 * side - 1;
					if (!solid(beyond))
						addSquare(cube, axis, side);
				}
		}
	return mesh;
}

SurfaceMesh bookOf(const std::vector<Page>& sheets, int n)
{
	SurfaceMesh mesh;
	for (int j = 0; j <= n; ++j)
		mesh.positions.push_back({0.0, 0.0, double(j)});
	for (const auto& [angle, isTurned] : sheets) {
		const int first = static_cast<int>(mesh.positions.size());
		for (int i = 1; i <= n; ++i)
			for (int j = 0; j <= n; ++j)
				mesh.positions.push_back({i * std::cos(angle), i * std::sin(angle), double(j)});
		const auto vertex = [&](int i, int j) {
			return i == 0 ? j : first + (i - 1) * (n + 1) + j;
		};
		for (Triangle t : cells(n, n, vertex)) {
			if (isTurned)
				std::swap(t[0], t[1]);
			mesh.triangles.push_back(t);
		}
	}
	return mesh;
}

SurfaceMesh book(int sheets, int n)
{
	std::vector<Page> all;
	for (int s = 0; s < sheets; ++s)
		all.push_back({2 * kPi * s / sheets, 2 * s >= sheets});
	return bookOf(all, n);
}

SurfaceMesh kleinBottle(int nu, int nv, const std::function<Point3(int, int)>& point)
{
	SurfaceMesh mesh;
	for (int i = 0; i < nu; ++i)
		for (int j = 0; j < nv; ++j)
			mesh.positions.push_back(point(i, j));
	mesh.triangles =
		cells(nu, nv, [&](int i, int j) { return i < nu ? i * nv + j % nv : (nv - j % nv) % nv; });
	return mesh;
}

SurfaceMesh moebiusBand(int n)
{
	SurfaceMesh mesh;
	for (int i = 0; i < n; ++i)
		for (int side : {-1, 1}) {
			const double u = 2 * kPi * i / n, w = 0.3 * side, d = 1.0 + w * std::cos(0.5 * u);
			mesh.positions.push_back({d * std::cos(u), d * std::sin(u), w * std::sin(0.5 * u)});
		}
	for (int i = 0; i < n; ++i) {
		const bool last = i + 1 == n; // there the two sides change places
		const int a = 2 * i, b = 2 * i + 1;
		const int c = last ? 1 : a + 2, d = last ? 0 : a + 3;
		mesh.triangles.push_back({a, c, d});
		mesh.triangles.push_back({a, d, b});
	}
	return mesh;
}

SurfaceMesh fanWithGap(double gap)
{
	SurfaceMesh fan;
	fan.positions.push_back({0, 0, 0});
	for (int i = 0; i < 7; ++i) {
		const double angle = (gap + (360 - gap) * i / 6) * kPi / 180;
		fan.positions.push_back({std::cos(angle), std::sin(angle), 0});
		fan.triangles.push_back({0, i + 1, (i + 1) % 7 + 1});
	}
	return fan;
}

SurfaceMesh withReversedFaces(SurfaceMesh mesh, std::size_t step)
{
	for (std::size_t f = 0; f < mesh.triangles.size(); f += step)
		std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
	return mesh;
}

SurfaceMesh sideBySide(const SurfaceMesh& a, const SurfaceMesh& b, double shift)
{
	SurfaceMesh both = a;
	const int offset = static_cast<int>(a.positions.size());
	for (const Point3& p : b.positions)
		both.positions.push_back({p[0] + shift, p[1], p[2]});
	for (const Triangle& t : b.triangles)
		both.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
	return both;
}

SurfaceMesh withoutStars(const SurfaceMesh& mesh, const std::vector<int>& vertices)
{
	return partOf(mesh, [&](std::size_t f) {
		const Triangle& t = mesh.triangles[f];
		return std::none_of(t.begin(), t.end(), [&](int v) {
			return std::find(vertices.begin(), vertices.end(), v) != vertices.end();
		});
	});
}

SurfaceMesh partOf(const SurfaceMesh& mesh, const std::function<bool(std::size_t)>& isKept)
{
	SurfaceMesh part;
	std::vector<int> number(mesh.positions.size(), -1);
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
		if (!isKept(f))
			continue;
		part.triangles.push_back(mesh.triangles[f]);
		for (int& v : part.triangles.back()) {
			int& own = number[at(v)];
			if (own < 0) {
				own = static_cast<int>(part.positions.size());
				part.positions.push_back(mesh.positions[at(v)]);
			}
			v = own;
		}
	}
	return part;
}

SurfaceMesh scaled(SurfaceMesh mesh, double factor)
{
	return stretched(std::move(mesh), {factor, factor, factor});
}

SurfaceMesh stretched(SurfaceMesh mesh, const Point3& factors)
{
	for (Point3& p : mesh.positions)
		for (std::size_t k = 0; k < 3; ++k)
			p[k] *= factors[k];
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

SurfaceMesh screw(double turns, int around, int across, double pitch)
{
	return grid(across, around, Ends::Open, Ends::Open, [=](int i, int j) {
		const double r = 1.0 + static_cast<double>(i) / across, a = 2 * kPi * turns * j / around;
		return Point3{r * std::cos(a), r * std::sin(a), pitch * a};
	});
}

} // namespace ricci::testing
