// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SURFACE_MESH_H
#define RICCI_SURFACE_MESH_H

#include "../base/indexed.h"
#include "../base/points.h"

#include <array>
#include <cstddef>
#include <vector>

namespace ricci {

/// Numbers of the three corners of a triangle.
using Triangle = std::array<int, 3>;

/// Another order of the corners of a triangle: [place] the corner there. One that turns the triangle over is its own inverse.
using CornerOrder = std::array<std::size_t, 3>;

/// [face][k] 1 where the side from corner k is marked. May be empty, else one entry for each triangle.
using SideMarks = std::vector<std::array<char, 3>>;

/// Edges, by one side of each, and their length on the surface, each once.
struct EdgeSet
{
	std::vector<Corner> sides;
	double length = 0.0;
};

/// Where a map that a mesh has puts a face.
struct MappedFace
{
	Triangle2 uv{};  ///< of its corners
	int picture = 0; ///< in which they lie
};

/// A triangle soup with shared vertices, as a caller hands it over. The flow itself sees lengths
/// only; positions are read for the corners of a rectangle, edge swaps, caps, creases, areas and distortion.
struct SurfaceMesh
{
	std::vector<Point3> positions;
	std::vector<Triangle> triangles; ///< indices into positions
	SideMarks diagonal = {};         ///< sides inside polygons that were cut into triangles
	std::size_t absent = 0;          ///< positions that stand for no vertex (deleted elements)
	SideMarks seam = {}; ///< where the caller wants seams; one face of an edge is enough
	/// [face] A map that the mesh has; may be empty. Edges at which it jumps (jumpsOf()) are seams. Where its charts
	/// neither flip nor overlap, Automatic takes no map with further seams or of more objective than theirs.
	std::vector<MappedFace> map = {};

	/// [triangle] Lengths of the sides of a surface that is given by them: positions then only tell how many vertices
	/// there are. Both sides of an edge have one length. Empty: they are distances of positions.
	std::vector<std::array<double, 3>> lengths = {};

	/// [vertex] Vertices of different parts, such as several meshes, are not joined, and JoinSplitVertices::Automatic decides
	/// for each part; may be empty.
	std::vector<int> part = {};
};

/// Values at the vertices of the mesh that some targets read. Empty where the mode has no use for
/// them. Vertices that are joined (JoinSplitVertices) are selected if one of them is, and have the target of the first.
struct VertexInput
{
	std::vector<char> selected;          ///< Rectangle, SelectedCones
	std::vector<double> targetCurvature; ///< Prescribed, radians
	double precision = 2.3e-16;          ///< relative rounding error of targetCurvature
};

/// Lengths of the sides of a triangle of the vertices at \p positions in space.
inline std::array<double, 3> sideLengths(const Triangle& t, const std::vector<Point3>& positions)
{
	const auto length = [&](std::size_t i, std::size_t j) {
		return distance(positions[positionOf(t[i])], positions[positionOf(t[j])]);
	};
	return {length(0, 1), length(1, 2), length(2, 0)};
}

/// A point of a surface as an affine combination of its vertices. The weights of vertices that are
/// not used are 0.
struct SurfacePoint
{
	std::array<int, 4> vertex{0, 0, 0, 0};
	std::array<double, 4> weight{1, 0, 0, 0};
};

/// The point in space. \p positions [vertex].
inline Point3 placeOnSurface(const SurfacePoint& p, const std::vector<Point3>& positions)
{
	Point3 x{0, 0, 0};
	for (std::size_t i = 0; i < 4; ++i)
		if (p.weight[i] != 0.0)
			x += p.weight[i] * positions[positionOf(p.vertex[i])];
	return x;
}

} // namespace ricci

#endif
