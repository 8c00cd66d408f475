// SPDX-License-Identifier: GPL-3.0-or-later
#include "hostile_mesh.h"

#include "support/shapes.h"

#include <ricci/base/numbers.h>

#include <utility>

namespace ricci::testing {

namespace {

int anyVertex(const SurfaceMesh& mesh, ByteSource& bytes)
{
	return bytes.below(vertexCount(mesh));
}

int add(SurfaceMesh& mesh, const Point3& p)
{
	mesh.positions.push_back(p);
	return vertexCount(mesh) - 1;
}

int addRandom(SurfaceMesh& mesh, ByteSource& bytes)
{
	return add(mesh, randomPoint(bytes));
}

/// Sheets with a row of edges in common.
SurfaceMesh book(ByteSource& bytes)
{
	const int sheets = bytes.oneIn(32) ? 60 + bytes.below(40) : 3 + bytes.below(6);
	const int n = 1 + bytes.below(4);
	const bool turns = bytes.oneIn(2);
	std::vector<Page> pages;
	for (int s = 0; s < sheets; ++s) {
		const double angle = bytes.oneIn(4) ? bytes.real(0, 2 * kPi) : 2 * kPi * s / sheets;
		pages.push_back({angle, turns && bytes.oneIn(2)});
	}
	return bookOf(pages, n);
}

/// A square with opposite sides glued, with or without a twist: torus, Klein bottle, projective plane,
/// some with too few vertices for that.
SurfaceMesh gluedSquare(ByteSource& bytes)
{
	const int nu = 2 + bytes.below(6), nv = 2 + bytes.below(6);
	const bool both = bytes.oneIn(2);
	SurfaceMesh mesh;
	for (int i = 0; i < nu; ++i)
		for (int j = 0; j <= nv; ++j)
			addRandom(mesh, bytes);
	const auto vertex = [&](int i, int j) {
		if (i == nu) {
			i = 0;
			j = nv - j;
		}
		if (j == nv) {
			j = 0;
			i = both ? (nu - i) % nu : i;
		}
		return i * (nv + 1) + j;
	};
	mesh.triangles = cells(nu, nv, vertex);
	return mesh;
}

/// Triangles that share nothing, or any of a few vertices.
SurfaceMesh triangles(ByteSource& bytes)
{
	SurfaceMesh mesh;
	const int faces = 1 + bytes.below(30), vertices = bytes.below(12);
	if (vertices > 2)
		for (int v = 0; v < vertices; ++v)
			addRandom(mesh, bytes);
	const auto corner = [&] {
		return vertices > 2 ? anyVertex(mesh, bytes) : addRandom(mesh, bytes);
	};
	for (int f = 0; f < faces; ++f) {
		const int a = corner(), b = corner(), c = corner();
		mesh.triangles.push_back({a, b, c});
	}
	return mesh;
}

/// Two faces, or more, on three vertices.
SurfaceMesh pillow(ByteSource& bytes)
{
	SurfaceMesh mesh;
	for (int v = 0; v < 3; ++v)
		addRandom(mesh, bytes);
	const int faces = bytes.oneIn(4) ? 3 + bytes.below(4) : 2;
	for (int f = 0; f < faces; ++f)
		mesh.triangles.push_back(f % 2 == 0 ? Triangle{0, 1, 2} : Triangle{0, 2, 1});
	return mesh;
}

/// Vertices become one with others.
void pinch(SurfaceMesh& mesh, ByteSource& bytes)
{
	const bool moves = bytes.oneIn(2); // or else faces are drawn along
	for (int i = bytes.below(4); i >= 0; --i) {
		const int from = anyVertex(mesh, bytes), to = anyVertex(mesh, bytes);
		if (moves)
			mesh.positions[at(to)] = mesh.positions[at(from)];
		for (Triangle& t : mesh.triangles)
			for (int& v : t)
				v = v == from ? to : v;
	}
}

/// Faces become equal to others, in one order or the other.
void doubleFaces(SurfaceMesh& mesh, ByteSource& bytes)
{
	const int faces = faceCount(mesh);
	const int turned = bytes.below(3); // none, all, any
	const int share = bytes.oneIn(2) ? 1 : 2 + bytes.below(6);
	for (int times = bytes.oneIn(4) ? 2 : 1; times > 0; --times)
		for (int f = 0; f < faces; ++f) {
			Triangle t = mesh.triangles[at(f)];
			if (turned == 1 || (turned == 2 && bytes.oneIn(2)))
				std::swap(t[1], t[2]);
			if (share == 1 || bytes.oneIn(share))
				mesh.triangles.push_back(t);
		}
}

/// Faces at edges of others.
void addFins(SurfaceMesh& mesh, ByteSource& bytes)
{
	for (int i = bytes.below(6); i >= 0; --i) {
		const Triangle t = mesh.triangles[at(bytes.below(faceCount(mesh)))];
		const int k = bytes.below(3);
		const int tip = bytes.oneIn(3) ? anyVertex(mesh, bytes) : addRandom(mesh, bytes);
		Triangle fin{t[at(k)], t[at((k + 1) % 3)], tip};
		if (bytes.oneIn(2))
			std::swap(fin[0], fin[1]);
		mesh.triangles.push_back(fin);
	}
}

/// Faces that use a vertex twice, faces between three vertices of a line, and components of such.
void addFlatFaces(SurfaceMesh& mesh, ByteSource& bytes)
{
	for (int i = bytes.below(4); i >= 0; --i) {
		const int a = anyVertex(mesh, bytes), b = anyVertex(mesh, bytes);
		switch (bytes.below(4)) {
		case 0:
			mesh.triangles.push_back({a, b, b});
			break;
		case 1:
			mesh.triangles.push_back({a, a, a});
			break;
		case 2:
			mesh.triangles.push_back(
				{a, b, add(mesh, 0.5 * (mesh.positions[at(a)] + mesh.positions[at(b)]))});
			break;
		default: {
			const int n = 1 + bytes.below(4), first = vertexCount(mesh);
			for (int v = 0; v < n + 2; ++v)
				add(mesh, {5.0 + v, 0.0, 0.0});
			for (int f = 0; f < n; ++f)
				mesh.triangles.push_back({first + f, first + f + 1, first + f + 2});
			break;
		}
		}
	}
}

void change(SurfaceMesh& mesh, ByteSource& bytes)
{
	if (mesh.triangles.empty())
		return;
	switch (bytes.below(5)) {
	case 0:
	case 1:
		pinch(mesh, bytes);
		break;
	case 2:
		doubleFaces(mesh, bytes);
		break;
	case 3:
		addFins(mesh, bytes);
		break;
	default:
		addFlatFaces(mesh, bytes);
		break;
	}
}

} // namespace

SurfaceMesh anyTriangles(const SurfaceMesh& base, ByteSource& bytes)
{
	const auto shape = [&] {
		switch (bytes.below(9)) {
		case 0:
			return book(bytes);
		case 1:
			return gluedSquare(bytes);
		case 2:
			return triangles(bytes);
		case 3:
			return pillow(bytes);
		case 4:
			return moebiusBand(3 + bytes.below(8));
		default:
			return base;
		}
	};
	SurfaceMesh mesh = shape();
	for (int i = bytes.below(4); i > 0; --i)
		change(mesh, bytes);
	if (bytes.oneIn(4))
		mesh = sideBySide(mesh, bytes.oneIn(2) ? base : shape(), 10.0);
	return mesh;
}

} // namespace ricci::testing
