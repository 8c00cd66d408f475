// SPDX-License-Identifier: GPL-3.0-or-later
#include "intrinsic.h"

#include <algorithm>
#include <ricci/mesh/component.h>

#include <array>
#include <cmath>

namespace ricci::testing {

namespace {

constexpr long double kPi = 3.14159265358979323846264338327950288L;

/// Angle between sides a and b of a triangle, opposite c; 0 where there is no such triangle. The products are formed
/// so that nothing is lost to cancellation (Kahan).
long double angleOf(long double a, long double b, long double c)
{
	if (a < b)
		std::swap(a, b);
	const long double difference = a - b;
	const long double mu = c > b ? b - (a - c) : c - difference;
	const long double sine = (difference + c) * mu, cosine = (a + (b + c)) * ((a - c) + b);
	return sine > 0 && cosine > 0 ? 2 * std::atan(std::sqrt(sine / cosine)) : 0;
}

Point3 onCircle(int i, int n)
{
	const double a = 2 * static_cast<double>(kPi) * i / n;
	return {std::cos(a), std::sin(a), 0.0};
}

} // namespace

Triangulation glued(const SurfaceMesh& mesh)
{
	return Triangulation(static_cast<int>(mesh.positions.size()), mesh.triangles);
}

OpenedMesh opened(const SurfaceMesh& mesh)
{
	return openMesh(mesh);
}

std::vector<Component> componentsOf(const SurfaceMesh& mesh)
{
	return splitIntoComponents(opened(mesh));
}

Triangulation
glued(int vertexCount, const std::vector<Triangle>& triangles, const std::vector<int>& sides)
{
	CornerArray<ricci::Corner> across;
	for (const int side : sides)
		across.push_back(ricci::Corner(side));
	return Triangulation(vertexCount, triangles, across);
}

Edge edgeBetween(const Triangulation& t, Vertex a, Vertex b)
{
	for (const Edge e : t.edges())
		if (const auto [i, j] = t.ends(e); std::minmax(i, j) == std::minmax(a, b))
			return e;
	return Edge();
}

EdgeArray<double> edgeLengths(const Triangulation& t, const SurfaceMesh& mesh)
{
	return ricci::edgeLengths(t, VertexArray<Point3>(mesh.positions));
}

IntrinsicMesh intrinsicMesh(const SurfaceMesh& mesh)
{
	const Triangulation t = glued(mesh);
	return {t, edgeLengths(t, mesh)};
}

Triangulation oneVertexTorus()
{
	// Sides 0..2 of the first triangle are bottom, right, diagonal; of the second: top, left,
	// diagonal.
	return glued(1, {{0, 0, 0}, {0, 0, 0}}, {3, 4, 5, 0, 1, 2});
}

MetricMeasure::MetricMeasure(const Triangulation& t, const EdgeArray<double>& lengths) :
		curvature(t.vertexCount(), 2 * kPi)
{
	const VertexArray<char> boundary = t.boundaryVertices();
	for (const Vertex v : t.vertices())
		if (boundary[v])
			curvature[v] = kPi;
	for (const Face f : t.faces()) {
		const auto h = t.halfedges(f);
		std::array<long double, 3> l;
		for (std::size_t k = 0; k < 3; ++k)
			l[k] = lengths[h[k].edge()];
		for (std::size_t k = 0; k < 3; ++k) {
			const long double angle = angleOf(l[k], l[(k + 2) % 3], l[(k + 1) % 3]);
			curvature[t.origin(h[k])] -= angle;
			if (k == 0)
				area += l[0] * l[2] * std::sin(angle) / 2;
		}
	}
}

std::vector<double> curvatureInSpace(const SurfaceMesh& mesh)
{
	const IntrinsicMesh m = intrinsicMesh(mesh);
	const MetricMeasure measure(m.triangulation, m.lengths);
	std::vector<double> curvature;
	for (const long double k : measure.curvature)
		curvature.push_back(static_cast<double>(k));
	return curvature;
}

SurfaceMesh fan(int sides, double height)
{
	SurfaceMesh mesh;
	for (int i = 0; i < sides; ++i) {
		mesh.positions.push_back(onCircle(i, sides));
		mesh.triangles.push_back({i, (i + 1) % sides, sides});
	}
	mesh.positions.push_back({0.0, 0.0, height});
	return mesh;
}

SurfaceMesh bipyramid(int sides, double height)
{
	SurfaceMesh mesh = fan(sides, height);
	mesh.positions.push_back({0.0, 0.0, -height});
	for (int i = 0; i < sides; ++i)
		mesh.triangles.push_back({(i + 1) % sides, i, sides + 1});
	return mesh;
}

} // namespace ricci::testing
