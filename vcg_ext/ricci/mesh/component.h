// SPDX-License-Identifier: GPL-3.0-or-later
// The folder mesh: triangles and half-edges, vertices that are split, opening at non-manifold edges and chosen
// seams, holes, creases, normal coordinates. No curvature, and no place in the plane.
#ifndef RICCI_COMPONENT_H
#define RICCI_COMPONENT_H

#include "elements.h"
#include "opened_mesh.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace ricci {

/// One connected, coherently oriented manifold piece of an OpenedMesh, with numbers of its own.
struct Component
{
	VertexArray<int> vertex;  ///< into the positions of OpenedMesh::mesh
	FaceArray<int> face;      ///< into its triangles
	FaceArray<char> reversed; ///< 1 if the order of the input was reversed
	VertexArray<Point3> positions;
	std::vector<Triangle> triangles; ///< [face] numbers of the component's vertices, coherent order
	std::vector<std::array<double, 3>>
		lengths;        ///< [face] of the sides of these triangles, see SurfaceMesh; may be empty
	SideMarks diagonal; ///< of these triangles, see SurfaceMesh; may be empty
	SideMarks hole;     ///< of these triangles, see OpenedMesh; may be empty
	std::vector<Triangle2> map; ///< of these triangles, see SurfaceMesh; may be empty
	bool hasSeam = false;       ///< see OpenedMesh

	/// Corner of the input face that became corner \p k of face \p f.
	std::size_t inputCorner(Face f, std::size_t k) const { return reversed[f] ? (3 - k) % 3 : k; }

	/// Lengths of the sides of face \p f.
	std::array<double, 3> sides(Face f) const
	{
		return lengths.empty() ? sideLengths(triangles[positionOf(f)], positions.values())
							   : lengths[positionOf(f)];
	}
};

/// The connected components of a mesh, in the order of their lowest faces, with the faces of a
/// minority of incoherent order turned. Each is numbered breadth first from its lowest face.
std::vector<Component> splitIntoComponents(const OpenedMesh& opened);

/// The surface from its other side: all triangles turned over, and numbered as splitIntoComponents() does.
Component turnedOver(Component component, const CornerOrder& order);

/// The component that another one is a copy of.
struct Original
{
	int number = 0;
	/// Where it is its mirror image: the copy turned over, in the numbers of the original, and how its corners are listed.
	std::optional<Component> mirrored;
	CornerOrder order{};
};

/// [component] The first one that it is a copy of, or itself: its sides are as long, triangle by triangle and but for
/// rounding, it is the same by a rigid motion where there are positions, or by one and a reflection, and its vertices have
/// the same values.
/// \param selected, targetCurvature [vertex of the opened mesh] or empty
/// \param mayMirror whether mirror images count
std::vector<Original> originals(
	const std::vector<Component>& components,
	const std::vector<char>& selected,
	const std::vector<double>& targetCurvature,
	bool mayMirror);

/// \throw InvalidMesh if edges have no length or faces no area, as rounding finds them
void requireAreaEverywhere(const std::vector<Component>& components);

} // namespace ricci

#endif
