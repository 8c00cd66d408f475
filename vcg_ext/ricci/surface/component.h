// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_COMPONENT_H
#define RICCI_COMPONENT_H

#include "surface_mesh.h"

#include <string>
#include <vector>

namespace ricci {

/// One connected, coherently oriented manifold piece of a SurfaceMesh, with indices of its own.
struct Component
{
	std::vector<int> vertex;         ///< [local vertex] -> index into SurfaceMesh::positions
	std::vector<int> face;           ///< [local face] -> index into SurfaceMesh::triangles
	std::vector<char> reversed;      ///< [local face] 1 if the input's order was reversed
	std::vector<Point3> positions;   ///< by local vertex
	std::vector<Triangle> triangles; ///< by local face, local vertices, coherent order

	/// Corner of the input face that became corner \p k of local face \p f.
	std::size_t inputCorner(std::size_t f, std::size_t k) const
	{
		return reversed[f] ? (3 - k) % 3 : k;
	}
};

/// Checks a triangle soup and splits it into its connected components, ordered by their lowest
/// face. Two safe repairs are made and told in \p notes: faces of incoherent order are turned (the
/// majority of each component keeps its order), and vertices without a face are left out.
/// \throw InvalidMesh naming what is wrong, how often, and the MeshLab filter that mends it: no
/// faces; coordinates that are not finite or beyond 1e50; faces that use a vertex twice; duplicate faces;
/// non-manifold edges or vertices; a component that is not orientable, has no area at all, or is
/// smaller than 1e-50.
std::vector<Component>
splitIntoComponents(const SurfaceMesh& mesh, std::vector<std::string>& notes);

/// \throw InvalidMesh if edges have no length or faces no area
void requireAreaEverywhere(const std::vector<Component>& components);

} // namespace ricci

#endif
