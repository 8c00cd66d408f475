// SPDX-License-Identifier: GPL-3.0-or-later
#include "component.h"

#include "../base/tolerances.h"
#include "../error.h"
#include "../math/bucket_sort.h"
#include "../math/disjoint_sets.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

namespace ricci {

namespace {

/// "1 face", "12 faces".
std::string counted(std::size_t n, const std::string& one, const std::string& many)
{
	return std::to_string(n) + " " + (n == 1 ? one : many);
}

/// \throw InvalidMesh if \p count is not 0
void requireNone(std::size_t count, InvalidMesh::Problem problem)
{
	if (count > 0)
		throw InvalidMesh(problem, count);
}

/// One side of a triangle, sortable so that the sides of an edge become neighbours.
struct Side
{
	int low, high, face, corner; // low < high: the vertices
	bool ascending;
};

std::vector<Side> sortedSides(const std::vector<Triangle>& triangles)
{
	std::vector<Side> sides;
	sides.reserve(3 * triangles.size());
	for (std::size_t f = 0; f < triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k) {
			const int a = triangles[f][k], b = triangles[f][(k + 1) % 3];
			sides.push_back(
				{std::min(a, b), std::max(a, b), static_cast<int>(f), static_cast<int>(k), a < b});
		}
	bucketSort(
		sides,
		[](const Side& s) { return s.low; },
		[](const Side& a, const Side& b) {
			return a.high != b.high ? a.high < b.high : a.face < b.face;
		});
	return sides;
}

/// Calls \p visit(sides, count) with the sides of every edge: \p count of them from \p sides on.
template<class Visit>
void forEachEdge(const std::vector<Side>& sorted, Visit visit)
{
	for (std::size_t first = 0, last; first < sorted.size(); first = last) {
		for (last = first; last < sorted.size() && sorted[last].low == sorted[first].low &&
						   sorted[last].high == sorted[first].high;)
			++last;
		visit(&sorted[first], last - first);
	}
}

void checkElements(const SurfaceMesh& mesh)
{
	if (mesh.triangles.empty()) {
		const std::size_t vertices = mesh.positions.size() - mesh.absent;
		throw InvalidMesh(vertices == 0 ? InvalidMesh::Empty : InvalidMesh::NoFaces, vertices);
	}
	std::size_t notFinite = 0, huge = 0, collapsed = 0;
	for (const Point3& p : mesh.positions)
		notFinite += !(std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]));
	requireNone(notFinite, InvalidMesh::NotFinite);
	for (const Point3& p : mesh.positions)
		huge += std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}) > kMaxCoordinate;
	requireNone(huge, InvalidMesh::OutOfRange);
	for (const Triangle& t : mesh.triangles)
		collapsed += t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
	requireNone(collapsed, InvalidMesh::CollapsedFaces);
}

void checkDuplicateFaces(const std::vector<Triangle>& triangles)
{
	std::vector<Triangle> sorted = triangles;
	for (Triangle& t : sorted)
		std::sort(t.begin(), t.end());
	bucketSort(
		sorted, [](const Triangle& t) { return t[0]; }, std::less<Triangle>());
	std::size_t duplicates = 0;
	for (std::size_t i = 1; i < sorted.size(); ++i)
		duplicates += sorted[i] == sorted[i - 1];
	requireNone(duplicates, InvalidMesh::DuplicateFaces);
}

void checkManifoldEdges(const std::vector<Side>& sorted)
{
	std::size_t nonManifold = 0;
	forEachEdge(sorted, [&](const Side*, std::size_t count) { nonManifold += count > 2; });
	requireNone(nonManifold, InvalidMesh::NonManifoldEdges);
}

/// A vertex is manifold if its corners form a single fan.
/// \pre edges are manifold
void checkManifoldVertices(const SurfaceMesh& mesh, const std::vector<Side>& sorted)
{
	const int faceCount = static_cast<int>(mesh.triangles.size());
	DisjointSets fans(3 * faceCount); // of corners
	const auto cornerAt = [&](const Side& s, int vertex) {
		const bool atStart = mesh.triangles[positionOf(s.face)][positionOf(s.corner)] == vertex;
		return 3 * s.face + (s.corner + (atStart ? 0 : 1)) % 3;
	};
	forEachEdge(sorted, [&](const Side* sides, std::size_t count) {
		if (count == 2)
			for (int vertex : {sides[0].low, sides[0].high})
				fans.merge(cornerAt(sides[0], vertex), cornerAt(sides[1], vertex));
	});
	std::vector<int> fanCount(mesh.positions.size(), 0);
	for (int f = 0; f < faceCount; ++f)
		for (int k = 0; k < 3; ++k)
			if (fans.find(3 * f + k) == 3 * f + k)
				++fanCount[positionOf(mesh.triangles[positionOf(f)][positionOf(k)])];
	const auto nonManifold =
		std::count_if(fanCount.begin(), fanCount.end(), [](int n) { return n > 1; });
	requireNone(static_cast<std::size_t>(nonManifold), InvalidMesh::NonManifoldVertices);
}

/// Component and orientation of every face, by a breadth-first search through the sides.
struct FacePartition
{
	FaceArray<int> component;
	FaceArray<char> reversed;
	int componentCount = 0;
};

/// \pre edges are manifold
FacePartition partitionFaces(int faceCount, const std::vector<Side>& sorted)
{
	struct Neighbour
	{
		Face face;
		bool agrees = true; // in orientation
	};
	FaceArray<std::array<Neighbour, 3>> neighbours(faceCount);
	forEachEdge(sorted, [&](const Side* sides, std::size_t count) {
		if (count < 2)
			return;
		const Side &a = sides[0], &b = sides[1];
		const bool agrees = a.ascending != b.ascending;
		neighbours[Face(a.face)][positionOf(a.corner)] = {Face(b.face), agrees};
		neighbours[Face(b.face)][positionOf(b.corner)] = {Face(a.face), agrees};
	});
	FacePartition part;
	std::vector<Face> queue;
	std::size_t oneSided = 0;
	part.component.assign(faceCount, -1);
	part.reversed.assign(faceCount, 0);
	for (const Face seed : neighbours.indices()) {
		if (part.component[seed] >= 0)
			continue;
		bool orientable = true;
		std::size_t turned = 0;
		queue.assign(1, seed);
		part.component[seed] = part.componentCount;
		for (std::size_t head = 0; head < queue.size(); ++head) {
			const Face f = queue[head];
			for (const Neighbour& n : neighbours[f]) {
				if (!n.face.isValid())
					continue;
				const char wanted = static_cast<char>(part.reversed[f] ^ (n.agrees ? 0 : 1));
				if (part.component[n.face] < 0) {
					part.component[n.face] = part.componentCount;
					part.reversed[n.face] = wanted;
					turned += wanted != 0;
					queue.push_back(n.face);
				}
				else if (part.reversed[n.face] != wanted)
					orientable = false;
			}
		}
		if (2 * turned > queue.size())
			for (const Face f : queue)
				part.reversed[f] ^= 1;
		oneSided += !orientable;
		++part.componentCount;
	}
	requireNone(oneSided, InvalidMesh::NotOrientable);
	return part;
}

void requireSize(const std::vector<Component>& components)
{
	std::size_t flat = 0, tiny = 0;
	for (const Component& c : components) {
		// Twice the largest area of a triangle against the square of the longest side of all.
		double area = 0.0, longest = 0.0;
		for (const Triangle& t : c.triangles) {
			const Point3 &p = c.positions[Vertex(t[0])], &q = c.positions[Vertex(t[1])],
						 &r = c.positions[Vertex(t[2])];
			double a[3], b[3];
			for (std::size_t k = 0; k < 3; ++k)
				a[k] = q[k] - p[k], b[k] = r[k] - p[k];
			area = std::max(
				area,
				std::hypot(
					a[1] * b[2] - a[2] * b[1],
					a[2] * b[0] - a[0] * b[2],
					a[0] * b[1] - a[1] * b[0]));
			longest = std::max({longest, distance(p, q), distance(q, r), distance(r, p)});
		}
		if (longest > 0.0 && longest < kMinComponentSize)
			++tiny;
		else
			flat += !(area > kMinComponentArea * longest * longest);
	}
	requireNone(tiny, InvalidMesh::TooSmall);
	requireNone(flat, InvalidMesh::NoArea);
}

} // namespace

std::vector<Component> splitIntoComponents(const SurfaceMesh& mesh, std::vector<std::string>& notes)
{
	checkElements(mesh);
	checkDuplicateFaces(mesh.triangles);
	const std::vector<Side> sorted = sortedSides(mesh.triangles);
	checkManifoldEdges(sorted);
	checkManifoldVertices(mesh, sorted);
	const FacePartition part = partitionFaces(static_cast<int>(mesh.triangles.size()), sorted);

	std::vector<Component> components(positionOf(part.componentCount));
	std::vector<Vertex> local(mesh.positions.size()); // of each vertex of the mesh
	std::size_t turned = 0;
	for (const Face f : part.component.indices()) {
		Component& c = components[positionOf(part.component[f])];
		turned += part.reversed[f] != 0;
		c.face.push_back(f.number());
		c.reversed.push_back(part.reversed[f]);
		Triangle triangle;
		for (std::size_t k = 0; k < 3; ++k) {
			const int v = mesh.triangles[positionOf(f)][c.inputCorner(Face(c.face.size() - 1), k)];
			Vertex& known = local[positionOf(v)];
			if (!known.isValid()) {
				known = Vertex(c.vertex.size());
				c.vertex.push_back(v);
				c.positions.push_back(mesh.positions[positionOf(v)]);
			}
			triangle[k] = known.number();
		}
		c.triangles.push_back(triangle);
	}
	requireSize(components);

	const auto withoutFace =
		std::count(local.begin(), local.end(), Vertex()) - static_cast<std::ptrdiff_t>(mesh.absent);
	if (withoutFace > 0)
		notes.push_back(
			counted(static_cast<std::size_t>(withoutFace), "vertex belongs", "vertices belong") +
			" to no face and " + (withoutFace == 1 ? "is" : "are") + " left out.");
	if (turned > 0)
		notes.push_back(
			counted(turned, "face was", "faces were") +
			" oriented against the rest of the surface and counted as turned round.");
	return components;
}

void requireAreaEverywhere(const std::vector<Component>& components)
{
	std::size_t noLength = 0, noArea = 0;
	for (const Component& c : components) {
		std::set<std::pair<int, int>> edgesWithoutLength; // an edge inside has two sides
		for (const Triangle& t : c.triangles) {
			std::array<double, 3> l;
			for (std::size_t k = 0; k < 3; ++k) {
				const int a = t[k], b = t[(k + 1) % 3];
				l[k] = distance(c.positions[Vertex(a)], c.positions[Vertex(b)]);
				if (l[k] == 0.0)
					edgesWithoutLength.insert({std::min(a, b), std::max(a, b)});
			}
			const double longest = *std::max_element(l.begin(), l.end());
			noArea += !(l[0] + l[1] + l[2] - 2 * longest > 0.0);
		}
		noLength += edgesWithoutLength.size();
	}
	requireNone(noLength, InvalidMesh::EdgesWithoutLength);
	requireNone(noArea, InvalidMesh::FacesWithoutArea);
}

} // namespace ricci
