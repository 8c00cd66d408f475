// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_COMMON_REFINEMENT_H
#define RICCI_COMMON_REFINEMENT_H

#include "../options.h"
#include "../surface/triangulation.h"
#include "hyperbolic_layout.h"
#include "planar_layout.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace ricci {

/// Three triangulations of one surface with the same vertices, and the metrics on them: that of the
/// input, the start of the flow (reached by flips in the input's metric, whose edges are straight
/// there), and the end of the flow (reached by flips in the conformal class).
struct FlippedSurface
{
	const Triangulation* input = nullptr;
	const std::vector<int>* startFlips = nullptr; ///< input -> start, in order
	const Triangulation* start = nullptr;
	const std::vector<double>* startLengths = nullptr; ///< [edge] the input's metric
	const std::vector<double>* startDelta = nullptr;   ///< [edge] inversive distance less one
	const std::vector<double>* startRadii = nullptr;   ///< [vertex] in the input's metric
	const std::vector<int>* flowFlips = nullptr;       ///< start -> end, in order
	const Triangulation* end = nullptr;
	const std::vector<double>* endLengths = nullptr;    ///< [edge] the metric found
	const std::vector<double>* endAngles = nullptr;     ///< [halfedge]
	const Eigen::VectorXd* endU = nullptr;              ///< Eq. 6
	Background background = Background::EuclideanPlane; ///< of the end
	/// Only faces of the input below this are wanted, and only vertices that have a position.
	int keptFaces = 0;
	/// The layout of the input's corners is all that is wanted: no points, triangles and uv.
	bool cornersOnly = false;
};

/// A point of the input's surface as an affine combination of the input's vertices. The weights of
/// vertices that are not used are 0.
struct SurfacePoint
{
	std::array<int, 4> vertex{0, 0, 0, 0};
	std::array<double, 4> weight{1, 0, 0, 0};
};

/// The point in space.
Point3 placeOnSurface(const SurfacePoint& p, const std::vector<Point3>& positions);

/// The overlay of all three triangulations, laid out in the plane: every piece lies in one triangle
/// of each, and the map to the plane is the flow's own there.
struct CommonRefinement
{
	std::vector<SurfacePoint> points;      ///< the input's vertices first, in order
	std::vector<Triangle> triangles;       ///< into points, the input's orientation
	std::vector<int> inputFace;            ///< [triangle]
	std::vector<std::array<Point2, 3>> uv; ///< [triangle][corner] in the plane or Poincaré disk
	std::vector<Transition> transition;    ///< [input edge] hyperbolic: across the cut
	PlanarLayout inputLayout;              ///< of the corners of the input's triangles
	std::size_t crossings = 0;             ///< points that are not vertices of the input
};

/// Hears from time to time how the overlay grows: the share of the work that is done, in [0,1], and
/// the number of its crossings so far. What it throws ends the computation.
using OverlayListener = std::function<void(double, std::size_t)>;

/// Computes the overlay and lays it out, cut along the input's edges with \p isCut.
///
/// Which edge crosses which, and in what order, is decided by integers (NormalCoordinates) wherever
/// two of the triangulations are concerned, so that the pieces always fit together. Inside a start
/// triangle an input edge is a straight chord in barycentric coordinates because its flips are
/// isometric. So is an end edge: it is straight in the Klein picture of the decorated triangle, and
/// that chart differs from the barycentric one by a projective map, the diagonal scaling with the
/// radii. The order of the two kinds of crossings along a start edge is that of their numeric
/// positions there, used by both sides; whether two chords cross then follows from the order of
/// their ends.
///
/// Positions: affine on the input's faces; in the plane by the projective map of the decorated
/// discrete conformal equivalence, b'_i ~ b_i exp(-(u_i - u0_i)) between a start triangle and an
/// end triangle with the same vertices (Springborn, Schroeder, Pinkall 2008; Bobenko and Lutz
/// 2023).
CommonRefinement commonRefinement(
	const FlippedSurface& surface,
	const std::vector<Point3>& positions,
	const std::vector<char>& isCut,
	const OverlayListener& listener);

} // namespace ricci

#endif
