// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_COMPONENT_H
#define RICCI_COMPONENT_H

#include "elements.h"
#include "surface_mesh.h"

#include <cstddef>
#include <string>
#include <vector>

namespace ricci {

/// One connected, coherently oriented manifold piece of a SurfaceMesh, with numbers of its own.
struct Component
{
	VertexArray<int> vertex;  ///< into SurfaceMesh::positions
	FaceArray<int> face;      ///< into SurfaceMesh::triangles
	FaceArray<char> reversed; ///< 1 if the order of the input was reversed
	VertexArray<Point3> positions;
	std::vector<Triangle> triangles; ///< [face] numbers of the component's vertices, coherent order

	/// Corner of the input face that became corner \p k of face \p f.
	std::size_t inputCorner(Face f, std::size_t k) const { return reversed[f] ? (3 - k) % 3 : k; }
};

/// Checks a triangle soup and splits it into its connected components, in the order of their lowest
/// faces. Two repairs are made, and told in \p notes: faces of incoherent order are turned (the
/// majority of each component keeps its order), and vertices without a face are left out.
/// \throw InvalidMesh for the first of these that is found, with its number: no faces; coordinates
/// that are not finite or beyond 1e50; faces that use a vertex twice; duplicate faces; non-manifold
/// edges or vertices; components that are not orientable, are smaller than 1e-50, or have no area
/// at all.
std::vector<Component>
splitIntoComponents(const SurfaceMesh& mesh, std::vector<std::string>& notes);

/// \throw InvalidMesh if edges have no length or faces no area, as rounding finds them
void requireAreaEverywhere(const std::vector<Component>& components);

} // namespace ricci

#endif
