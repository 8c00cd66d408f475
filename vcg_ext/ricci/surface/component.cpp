// SPDX-License-Identifier: GPL-3.0-or-later
#include "component.h"

#include "../error.h"

#include <algorithm>
#include <set>
#include <utility>

namespace ricci {

namespace {

/// Marks of a triangle's sides, when it is turned if it is \p reversed.
std::array<char, 3> inOrder(std::array<char, 3> sides, char reversed)
{
	if (reversed)
		std::swap(sides[0], sides[2]);
	return sides;
}

} // namespace

std::vector<Component> splitIntoComponents(const OpenedMesh& opened)
{
	const SurfaceMesh& mesh = opened.mesh;
	std::vector<Component> components(positionOf(opened.componentCount));
	for (std::size_t c = 0; c < opened.hasSeam.size(); ++c)
		components[c].hasSeam = opened.hasSeam[c] != 0;
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
		if (!mesh.diagonal.empty())
			c.diagonal.push_back(inOrder(mesh.diagonal[positionOf(f)], opened.reversed[f]));
		if (!opened.hole.empty())
			c.hole.push_back(inOrder(opened.hole[positionOf(f)], opened.reversed[f]));
	}
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
	if (noLength > 0)
		throw InvalidMesh(InvalidMesh::EdgesWithoutLength, noLength);
	if (noArea > 0)
		throw InvalidMesh(InvalidMesh::FacesWithoutArea, noArea);
}

} // namespace ricci
