// SPDX-License-Identifier: GPL-3.0-or-later
// All that it takes to map a mesh of arrays to the Poincaré disk by its hyperbolic metric. ricci.h is its like for the
// plane.
#ifndef RICCI_HYPERBOLIC_H
#define RICCI_HYPERBOLIC_H

#include "error.h"
#include "layout/parametrization.h"
#include "options.h"
#include "progress.h"

#include <array>
#include <complex>
#include <vector>

namespace ricci {

/// A mesh in the Poincaré disk.
struct DiskCoordinates
{
	/// In the unit disk of its chart. A vertex has one for each chart, and for each side of a seam.
	std::vector<std::complex<double>> points;

	/// [triangle][corner] into points. Those of the mesh, in its order and with its corners; with CommonRefinement pieces
	/// of them.
	std::vector<std::array<int, 3>> triangles;
	std::vector<int> face; ///< [triangle] of the mesh in which it lies
	std::vector<int>
		chart; ///< [triangle] from 0; -1: a face without area, drawn as a line or a point

	/// [chart] Isometries that generate the group by which the disk covers the component. Empty where the chart has no metric of its own: components without a hyperbolic metric lie in the last
	/// chart as the plane has them, and parts of a disk that is divided lie where their motion takes them.
	std::vector<FuchsianGroup> groups;

	/// The largest angle (radians) or hyperbolic length by which the layout does not close up round a vertex or
	/// along a seam.
	double relationError = 0.0;
	int flippedFaces = 0;     ///< reversed or without area, once coordinates are rounded to float
	int overlappingFaces = 0; ///< that cover a part of the disk together with another one, likewise
	int unequalSeams = 0;     ///< edges whose two sides differ in length by more than rounding
};

/// Maps a mesh to the Poincaré disk by the one conformal metric of curvature -1 with the curvature that is asked for
/// [Yang et al. 2009, 4.4], for surfaces of negative Euler characteristic, or with cones that make up for it.
/// \param positions [vertex] in space
/// \param triangles [face] three vertices each; any triangles, see parametrizeHyperbolic()
/// \param progress is told what is done, and may end it; may be null
/// \throw Error, of a kind that error.h lists; Cancelled
DiskCoordinates uniformize(
	const std::vector<std::array<double, 3>>& positions,
	const std::vector<std::array<int, 3>>& triangles,
	const HyperbolicOptions& options = {},
	Progress* progress = nullptr);

/// The same of a surface of given edge lengths, see flattenFromLengths().
DiskCoordinates uniformizeFromLengths(
	const std::vector<std::array<int, 3>>& triangles,
	const std::vector<std::array<double, 3>>& lengths,
	const HyperbolicOptions& options = {},
	Progress* progress = nullptr);

} // namespace ricci

#endif
