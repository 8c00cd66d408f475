// SPDX-License-Identifier: GPL-3.0-or-later
#include "component.h"

#include "../base/graphs.h"
#include "../error.h"

#include <algorithm>
#include <set>
#include <utility>

namespace ricci {

namespace {

/// What is known of a triangle's sides, when it is turned if it is \p reversed.
template<class T>
std::array<T, 3> inOrder(std::array<T, 3> sides, char reversed)
{
	if (reversed)
		std::swap(sides[0], sides[2]);
	return sides;
}

/// Sorts what is known of each element; no \p items: it is known of none.
template<class Item, class Index>
void reorder(const std::vector<Index>& order, std::vector<Item>& items)
{
	if (items.empty())
		return;
	std::vector<Item> ordered;
	ordered.reserve(order.size());
	for (const Index i : order)
		ordered.push_back(items[positionOf(i)]);
	items.swap(ordered);
}

void reorderFaces(const std::vector<Face>& order, Component& component)
{
	reorder(order, component.face.values());
	reorder(order, component.reversed.values());
	reorder(order, component.triangles);
	reorder(order, component.lengths);
	reorder(order, component.diagonal);
	reorder(order, component.hole);
	reorder(order, component.map);
}

/// Numbers the faces breadth first from the first one, and the vertices as these meet them: neighbours then
/// lie near each other in memory, whatever the order of the input [Cuthill, McKee 1969].
void numberBreadthFirst(Component& component)
{
	std::vector<Triangle>& triangles = component.triangles;
	const Adjacency<int, Face> facesAt(component.vertex.size(), [&](const auto& add) {
		for (const Face f : component.face.indices())
			for (const int v : triangles[positionOf(f)])
				add(v, f);
	});
	FaceArray<char> isMet(component.face.size(), 0);
	VertexArray<int> number(component.vertex.size(), -1);
	std::vector<Face> faces{Face(0)};
	std::vector<Vertex> vertices;
	isMet[Face(0)] = 1;
	for (std::size_t next = 0; next < faces.size(); ++next)
		for (int& v : triangles[positionOf(faces[next])]) {
			int& known = number[Vertex(v)];
			if (known < 0) {
				known = static_cast<int>(vertices.size());
				vertices.push_back(Vertex(v));
				for (const Face f : facesAt[v])
					if (!std::exchange(isMet[f], 1))
						faces.push_back(f);
			}
			v = known;
		}
	reorder(vertices, component.vertex.values());
	reorder(vertices, component.positions.values());
	reorderFaces(faces, component);
}

} // namespace

std::vector<Component> splitIntoComponents(const OpenedMesh& opened)
{
	const SurfaceMesh& mesh = opened.mesh;
	std::vector<Component> components(positionOf(opened.componentCount));
	std::vector<Vertex> local(mesh.positions.size()); // of each vertex of the mesh
	for (const Face f : opened.component.indices()) {
		Component& c = components[positionOf(opened.component[f])];
		c.face.push_back(f.number());
		c.reversed.push_back(opened.reversed[f]);
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
		if (!mesh.lengths.empty())
			c.lengths.push_back(inOrder(mesh.lengths[positionOf(f)], opened.reversed[f]));
		if (!mesh.diagonal.empty())
			c.diagonal.push_back(inOrder(mesh.diagonal[positionOf(f)], opened.reversed[f]));
		if (!mesh.map.empty()) {
			const Triangle2& uv = mesh.map[positionOf(f)].uv;
			const Face own(c.face.size() - 1);
			c.map.push_back(
				{uv[c.inputCorner(own, 0)], uv[c.inputCorner(own, 1)], uv[c.inputCorner(own, 2)]});
		}
		if (!opened.border.empty()) {
			c.hole.push_back(inOrder(opened.border[positionOf(f)], opened.reversed[f]));
			for (char& side : c.hole.back()) {
				c.hasSeam = c.hasSeam || side == OpenedMesh::OnSeam;
				side = side == OpenedMesh::OnHole;
			}
		}
	}
	for (Component& component : components)
		numberBreadthFirst(component);
	return components;
}

Component turnedOver(Component component, const CornerOrder& order)
{
	const auto reorderCorners = [&](auto& ofTriangles) {
		for (auto& t : ofTriangles)
			t = {t[order[0]], t[order[1]], t[order[2]]};
	};
	const auto reorderSides = [&](auto& ofTriangles) {
		for (auto& t : ofTriangles)
			t = {t[order[1]], t[order[2]], t[order[0]]};
	};
	std::vector<Face> faces;
	for (const Face f : component.face.indices())
		faces.push_back(f);
	std::sort(faces.begin(), faces.end(), [&](Face f, Face g) {
		return component.face[f] < component.face[g];
	});
	reorderFaces(faces, component);
	reorderCorners(component.triangles);
	reorderCorners(component.map);
	reorderSides(component.lengths);
	reorderSides(component.diagonal);
	reorderSides(component.hole);
	numberBreadthFirst(component);
	return component;
}

void requireAreaEverywhere(const std::vector<Component>& components)
{
	std::size_t noLength = 0, noArea = 0;
	for (const Component& c : components) {
		std::set<std::pair<int, int>> edgesWithoutLength; // an edge inside has two sides
		for (const Face f : c.face.indices()) {
			const std::array<double, 3> l = c.sides(f);
			for (std::size_t k = 0; k < 3; ++k)
				if (l[k] == 0.0) {
					const Triangle& t = c.triangles[positionOf(f)];
					edgesWithoutLength.insert(std::minmax({t[k], t[(k + 1) % 3]}));
				}
			const double longest = *std::max_element(l.begin(), l.end());
			noArea += !(l[0] + l[1] + l[2] - 2 * longest > 0.0);
		}
		noLength += edgesWithoutLength.size();
	}
	if (noLength > 0)
		throw InvalidMesh(InvalidMesh::EdgesWithoutLength, noLength);
	if (noArea > 0)
		throw InvalidMesh(InvalidMesh::FacesWithoutArea, noArea);
}

} // namespace ricci
