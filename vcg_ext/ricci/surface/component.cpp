// SPDX-License-Identifier: GPL-3.0-or-later
#include "component.h"

#include "../error.h"
#include "../numbers.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace ricci {

namespace {

/// "1 face", "12 faces".
std::string count(std::size_t n, const std::string& one, const std::string& many)
{
	return std::to_string(n) + " " + (n == 1 ? one : many);
}

/// One side of a triangle, sortable so that the sides of an edge become neighbours.
struct Side
{
	int low, high, face, corner;
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
	std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
		return a.low != b.low     ? a.low < b.low
			   : a.high != b.high ? a.high < b.high
								  : a.face < b.face;
	});
	return sides;
}

std::size_t edgeEnd(const std::vector<Side>& sides, std::size_t first)
{
	std::size_t last = first;
	while (last < sides.size() && sides[last].low == sides[first].low &&
		   sides[last].high == sides[first].high)
		++last;
	return last;
}

/// Products of four lengths must be numbers. Every mesh in single precision is within these.
constexpr double kMostSize = 1e50, kLeastSize = 1e-50;

void checkElements(const SurfaceMesh& mesh)
{
	if (mesh.triangles.empty())
		throw InvalidMesh(
			mesh.positions.size() == mesh.absent
				? "The mesh is empty: open or create a triangle mesh first."
				: "The mesh has " +
					  count(mesh.positions.size() - mesh.absent, "vertex", "vertices") +
					  " but no faces: reconstruct a surface from the points first.");
	std::size_t notFinite = 0;
	for (const Point3& p : mesh.positions)
		notFinite += !(std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]));
	if (notFinite > 0)
		throw InvalidMesh(
			count(notFinite, "vertex has", "vertices have") +
			" coordinates that are not finite numbers (NaN or infinite): delete them first.");
	std::size_t huge = 0;
	for (const Point3& p : mesh.positions)
		huge += std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}) > kMostSize;
	if (huge > 0)
		throw InvalidMesh(
			count(huge, "vertex has", "vertices have") +
			" coordinates beyond 1e50: run 'Transform: Scale, Normalize' first.");
	std::size_t collapsed = 0;
	for (const Triangle& t : mesh.triangles)
		collapsed += t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
	if (collapsed > 0)
		throw InvalidMesh(
			count(collapsed, "face uses", "faces use") +
			" the same vertex twice: run 'Remove Zero Area Faces' first.");
}

void checkDuplicateFaces(const std::vector<Triangle>& triangles)
{
	std::vector<Triangle> sorted = triangles;
	for (Triangle& t : sorted)
		std::sort(t.begin(), t.end());
	std::sort(sorted.begin(), sorted.end());
	std::size_t duplicates = 0;
	for (std::size_t i = 1; i < sorted.size(); ++i)
		duplicates += sorted[i] == sorted[i - 1];
	if (duplicates > 0)
		throw InvalidMesh(
			count(duplicates, "face is", "faces are") +
			" a duplicate of another: run 'Remove Duplicate Faces' first.");
}

void checkManifoldEdges(const std::vector<Side>& sides)
{
	std::size_t nonManifold = 0;
	for (std::size_t first = 0, last; first < sides.size(); first = last) {
		last = edgeEnd(sides, first);
		nonManifold += last - first > 2;
	}
	if (nonManifold > 0)
		throw InvalidMesh(
			count(nonManifold, "non-manifold edge", "non-manifold edges") +
			" (shared by more than two faces): run 'Repair non Manifold Edges' first.");
}

/// Smallest-index representatives of merged items.
class DisjointSets
{
public:
	explicit DisjointSets(int n)
	{
		for (int i = 0; i < n; ++i)
			m_parent.push_back(i);
	}
	int find(int i)
	{
		while (m_parent[at(i)] != i)
			i = m_parent[at(i)] = m_parent[at(m_parent[at(i)])];
		return i;
	}
	void merge(int a, int b)
	{
		a = find(a), b = find(b);
		m_parent[at(std::max(a, b))] = std::min(a, b);
	}

private:
	std::vector<int> m_parent;
};

/// A vertex is manifold if its corners form a single fan. Edges must be manifold already.
void checkManifoldVertices(const SurfaceMesh& mesh, const std::vector<Side>& sides)
{
	const int faceCount = static_cast<int>(mesh.triangles.size());
	DisjointSets fans(3 * faceCount);
	const auto cornerAt = [&](const Side& s, int vertex) {
		const bool atStart = mesh.triangles[at(s.face)][at(s.corner)] == vertex;
		return 3 * s.face + (s.corner + (atStart ? 0 : 1)) % 3;
	};
	for (std::size_t first = 0, last; first < sides.size(); first = last) {
		last = edgeEnd(sides, first);
		if (last - first < 2)
			continue;
		for (int vertex : {sides[first].low, sides[first].high})
			fans.merge(cornerAt(sides[first], vertex), cornerAt(sides[first + 1], vertex));
	}
	std::vector<int> fanCount(mesh.positions.size(), 0);
	for (int f = 0; f < faceCount; ++f)
		for (int k = 0; k < 3; ++k)
			if (fans.find(3 * f + k) == 3 * f + k)
				++fanCount[at(mesh.triangles[at(f)][at(k)])];
	const auto nonManifold =
		std::count_if(fanCount.begin(), fanCount.end(), [](int n) { return n > 1; });
	if (nonManifold > 0)
		throw InvalidMesh(
			count(
				static_cast<std::size_t>(nonManifold),
				"non-manifold vertex",
				"non-manifold vertices") +
			" (with more than one fan of faces): run 'Repair non Manifold Vertices by splitting' "
			"first.");
}

/// Breadth-first walk over face adjacency: component and relative orientation of every face.
struct FacePartition
{
	std::vector<int> component;
	std::vector<char> reversed;
	int componentCount = 0;
};

FacePartition walkFaces(std::size_t faceCount, const std::vector<Side>& sides)
{
	struct Neighbour
	{
		int face = -1;
		bool agrees = true;
	};
	std::vector<Neighbour> neighbours(3 * faceCount);
	for (std::size_t first = 0, last; first < sides.size(); first = last) {
		last = edgeEnd(sides, first);
		if (last - first < 2)
			continue;
		const Side &a = sides[first], &b = sides[first + 1];
		const bool agrees = a.ascending != b.ascending;
		neighbours[at(3 * a.face + a.corner)] = {b.face, agrees};
		neighbours[at(3 * b.face + b.corner)] = {a.face, agrees};
	}
	FacePartition part;
	std::vector<int> queue;
	std::size_t oneSided = 0;
	part.component.assign(faceCount, -1);
	part.reversed.assign(faceCount, 0);
	for (std::size_t seed = 0; seed < faceCount; ++seed) {
		if (part.component[seed] >= 0)
			continue;
		bool orientable = true;
		std::size_t turned = 0;
		queue.assign(1, static_cast<int>(seed));
		part.component[seed] = part.componentCount;
		for (std::size_t head = 0; head < queue.size(); ++head) {
			const int f = queue[head];
			for (int k = 0; k < 3; ++k) {
				const Neighbour& n = neighbours[at(3 * f + k)];
				if (n.face < 0)
					continue;
				const char wanted = static_cast<char>(part.reversed[at(f)] ^ (n.agrees ? 0 : 1));
				if (part.component[at(n.face)] < 0) {
					part.component[at(n.face)] = part.componentCount;
					part.reversed[at(n.face)] = wanted;
					turned += wanted != 0;
					queue.push_back(n.face);
				}
				else if (part.reversed[at(n.face)] != wanted)
					orientable = false;
			}
		}
		if (2 * turned > queue.size())
			for (int f : queue)
				part.reversed[at(f)] ^= 1;
		oneSided += !orientable;
		++part.componentCount;
	}
	if (oneSided > 0)
		throw InvalidMesh(
			count(oneSided, "component is", "components are") +
			" not orientable (one-sided, like a Moebius band): cut the mesh into an orientable "
			"surface "
			"first.");
	return part;
}

/// A component none of whose triangles has this share of a square is a line.
constexpr double kLeastArea = 1e-12;

void requireSize(const std::vector<Component>& components)
{
	std::size_t flat = 0, tiny = 0;
	for (const Component& c : components) {
		// Twice the largest area of a triangle against the square of the longest side.
		double area = 0.0, longest = 0.0;
		for (const Triangle& t : c.triangles) {
			const Point3 &p = c.positions[at(t[0])], &q = c.positions[at(t[1])],
						 &r = c.positions[at(t[2])];
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
		if (longest > 0.0 && longest < kLeastSize)
			++tiny;
		else
			flat += !(area > kLeastArea * longest * longest);
	}
	if (tiny > 0)
		throw InvalidMesh(
			count(tiny, "component is", "components are") +
			" smaller than 1e-50: run 'Transform: Scale, Normalize' first, or delete such pieces.");
	if (flat > 0)
		throw InvalidMesh(
			count(flat, "component has", "components have") +
			" no area at all (all vertices on one line, or in one point): delete such pieces "
			"first.");
}

} // namespace

std::vector<Component> splitIntoComponents(const SurfaceMesh& mesh, std::vector<std::string>& notes)
{
	checkElements(mesh);
	checkDuplicateFaces(mesh.triangles);
	const std::vector<Side> sides = sortedSides(mesh.triangles);
	checkManifoldEdges(sides);
	checkManifoldVertices(mesh, sides);
	const FacePartition part = walkFaces(mesh.triangles.size(), sides);

	std::vector<Component> components(at(part.componentCount));
	std::vector<int> localVertex(mesh.positions.size(), -1);
	std::size_t turned = 0;
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
		Component& c = components[at(part.component[f])];
		const Triangle t = mesh.triangles[f];
		const char reversed = part.reversed[f];
		turned += reversed != 0;
		c.face.push_back(static_cast<int>(f));
		c.reversed.push_back(reversed);
		Triangle local;
		for (std::size_t k = 0; k < 3; ++k) {
			const int v = t[reversed ? (3 - k) % 3 : k];
			if (localVertex[at(v)] < 0) {
				localVertex[at(v)] = static_cast<int>(c.vertex.size());
				c.vertex.push_back(v);
				c.positions.push_back(mesh.positions[at(v)]);
			}
			local[k] = localVertex[at(v)];
		}
		c.triangles.push_back(local);
	}
	requireSize(components);

	const auto unreferenced = std::count(localVertex.begin(), localVertex.end(), -1) -
							  static_cast<std::ptrdiff_t>(mesh.absent);
	if (unreferenced > 0)
		notes.push_back(
			count(static_cast<std::size_t>(unreferenced), "vertex belongs", "vertices belong") +
			" to no face: left out.");
	if (turned > 0)
		notes.push_back(
			count(turned, "face was", "faces were") +
			" oriented against the rest of the surface and counted as turned round; 'Re-Orient all "
			"faces coherently' makes that permanent.");
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
				l[k] = distance(c.positions[at(a)], c.positions[at(b)]);
				if (l[k] == 0.0)
					edgesWithoutLength.insert({std::min(a, b), std::max(a, b)});
			}
			const double longest = *std::max_element(l.begin(), l.end());
			noArea += !(l[0] + l[1] + l[2] - 2 * longest > 0.0);
		}
		noLength += edgesWithoutLength.size();
	}
	if (noLength > 0)
		throw InvalidMesh(
			count(noLength, "edge has", "edges have") +
			" no length: run 'Merge Close Vertices' and 'Remove Zero Area Faces' first.");
	if (noArea > 0)
		throw InvalidMesh(
			count(noArea, "face has", "faces have") +
			" no area: run 'Remove Zero Area Faces' or 'Remove T-Vertices' first.");
}

} // namespace ricci
