// SPDX-License-Identifier: GPL-3.0-or-later
// All that it takes to flatten a mesh of arrays, or a surface of given edge lengths. hyperbolic.h is its like for the
// Poincaré disk. parametrize.h, sphere_map.h and report.h have the rest: cones at chosen vertices, seams, the map to the
// sphere, and everything that a run measures.
#ifndef RICCI_RICCI_H
#define RICCI_RICCI_H

#include "error.h"
#include "options.h"
#include "progress.h"

#include <array>
#include <vector>

namespace ricci {

/// Texture coordinates of a mesh.
struct TextureCoordinates
{
	/// In [0,1]^2, unless Options::normalizeUV is off or Options::tileSide is set. A vertex has one for each chart, and for each side of a seam.
	std::vector<std::array<double, 2>> uv;

	/// [triangle][corner] into uv. Those of the mesh, in its order and with its corners; with CommonRefinement pieces of
	/// them.
	std::vector<std::array<int, 3>> triangles;
	std::vector<int>
		face; ///< [triangle] of the mesh in which it lies: its own number but with CommonRefinement
	std::vector<int>
		chart; ///< [triangle] from 0; -1: a face without area, drawn as a line or a point

	/// Symmetric Dirichlet energy at the best scale, 4 for an isometry, and a twentieth of the length of all seams in
	/// units of the square root of the area: what Automatic makes small.
	double objective = 0.0;

	int flippedFaces = 0; ///< reversed or without area, once coordinates are rounded to float
	int overlappingFaces =
		0; ///< that cover a part of the plane together with another one, likewise
};

/// Maps a mesh conformally to the plane [Yang et al. 2009], cuts it where it must, and packs the charts.
/// \param positions [vertex] in space
/// \param triangles [face] three vertices each; any triangles, see parametrizeEuclidean()
/// \param progress is told what is done, and may end it; may be null
/// \throw Error, of a kind that error.h lists, which says what is wrong with the mesh or the options; Cancelled
TextureCoordinates flatten(
	const std::vector<std::array<double, 3>>& positions,
	const std::vector<std::array<int, 3>>& triangles,
	const Options& options = {},
	Progress* progress = nullptr);

/// The same of a surface that no positions are known of: its triangles are those of the plane with these sides.
/// \param triangles numbers of vertices are below three times that of triangles
/// \param lengths [face] of the sides from corner 0 to 1, 1 to 2 and 2 to 0. Both faces of an edge have the same.
/// \throw also InvalidMesh NoTriangle, UnequalSides; InvalidOption WithoutPositions for what is chosen by looking at
/// positions: the corners of Rectangle, EdgeSwaps, CommonRefinement, seamHiding, sharpAngle, QuarterTurns
TextureCoordinates flattenFromLengths(
	const std::vector<std::array<int, 3>>& triangles,
	const std::vector<std::array<double, 3>>& lengths,
	const Options& options = {},
	Progress* progress = nullptr);

} // namespace ricci

#endif
