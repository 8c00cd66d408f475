// SPDX-License-Identifier: GPL-3.0-or-later
// Tolerances that users see or that several files share, by kind, with their reasons. Those of one
// computation, limits of work (steps, rounds) and parameters of step control stay beside their code.
#ifndef RICCI_TOLERANCES_H
#define RICCI_TOLERANCES_H

#include <limits>

namespace ricci {

// ---- Visible to the user: what a result is allowed to miss --------------------------------------

/// Residuals above this, in radians, are never called converged because of the rounding floor.
constexpr double kMaxFloor = 1e-8;

/// Largest change of a boundary point's angle on the circle, in radians, at which a round disk is
/// reached.
constexpr double kCircleTolerance = 1e-10;

/// A curvature above this, in radians, makes an interior vertex a cone, which the cut must reach.
/// Weaker ones open the layout by less than kCheckedGap of its extent.
constexpr double kConeCurvature = 1e-9;

/// The check of a finished map allows this gap of seams: a share of the layout's extent, a thousandth
/// of a texel; or a hyperbolic length. Charts may cover themselves as deep, as a share of the largest.
constexpr double kCheckedGap = 1e-6;

/// A canonical polygon whose last side misses the first corner by more than this hyperbolic distance
/// is not drawn.
constexpr double kMaxPolygonGap = 1e-2;

// ---- Rounding: below this, what is seen is the arithmetic's doing -------------------------------

constexpr double kUnitRoundoff = std::numeric_limits<double>::epsilon();

/// What rounding leaves of numbers of order 1: after a few operations; after a hundred, or a solved system; where
/// some digits have cancelled; where a third of them have, so that what is smaller counts as 0; and where more than
/// half of them have, so that two numbers nearer to each other count as equal.
constexpr double kFewRoundings = 1e-15, kManyRoundings = 1e-14, kCancelled = 1e-12, kTiny = 1e-9,
				 kSmall = 1e-6;

/// Coordinates beyond this, and components smaller than its inverse, are refused: products of four
/// lengths must be numbers. Every mesh in single precision is within these.
constexpr double kMaxCoordinate = 1e50, kMinComponentSize = 1e-50;

/// A triangle whose longest side is within this, relative to itself, of the sum of the other two has
/// no shape that rounding respects: some hundred units of roundoff.
constexpr double kDegenerateTriangle = 1e-13;

/// The same for a triangle that is known by the lengths of its sides alone, which say less.
constexpr double kMinIntrinsicHeight = 1e-6;

/// What rounding may make of a prescribed curvature, in units of the precision of its values: the
/// share of sum |K| (and, in double, of 2 pi a vertex) between the sum and Gauss-Bonnet, and values
/// that count as 0.
constexpr double kPrescribedRounding = 4.0;

/// How far the estimate of Newton's rounding floor may be from what is observed.
constexpr double kFloorUncertainty = 20.0;

/// Orders of magnitude between scale factors whose squares the digits of a double still hold.
constexpr double kMaxScales = 7.0;

/// |sum w x| / sum w of points on the sphere where a step of their balancing that gains nothing has reached the limit
/// of rounding.
constexpr double kStalledBalance = 1e-10;

/// The smoothing of a surface for the cost of seams: divisor in place of four times an area of 0;
/// bound of cotangents; smallest weight of an edge, so that the matrix is positive definite.
constexpr double kNoArea = 1e-300, kMaxCotangent = 1e3, kMinCotangentWeight = 1e-6;

/// Least height that triangles are given, relative to the extent of the map: eight steps of a float
/// below 1. And in floats, in steps at the largest coordinate: rounding takes less than two. Triangles
/// that are mended get so many times this height where they can.
constexpr double kMinHeight = 0x1p-21, kMinFloatSteps = 4.0, kWantedHeights = 2.0;

/// Formats of text give coordinates in the unit square with six decimals. So texture coordinates of two faces that
/// differ no more, as a share of the extent of all or in one picture of side 1, are equal.
constexpr double kTextStep = 1e-6, kSameCoordinate = kTextStep;

/// A triangle whose height is a smaller share of a side is too thin to have a normal: its corners are rounded in files
/// to about 1e-6 of their size.
constexpr double kThinTriangle = 1e-4;

/// Room in the box of a chart of a few triangles, as a share of the square that holds all charts, for
/// triangles of those heights, in six decimals too. Sides shorter than kThinSide times the room get it.
constexpr double kBoxRoom = 0x1p-16, kThinSide = 4.0;

/// The sides of a seam have one length up to this, relatively, and one transition up to this in
/// radians: what the curvature that the flow leaves makes of them. A seam vertex that is moved by a
/// side's length opens the seam by this share of it at most.
constexpr double kSeamMatch = 1e-7;

/// The padding between charts is wider than the margin by this share, which rounding must not undercut.
constexpr double kMarginSpare = 1e-6;

/// Outlines of charts, whose boxes may meet, keep at least this distance, as a share of the square:
/// more than the steps of floats by which their points are moved afterwards.
constexpr double kMinPadding = 2e-5;

/// Charts are turned, and placed by their outlines, where the square's side gets shorter by this share:
/// for less, upright charts are worth more.
constexpr double kWorthTurning = 0.01;

/// Rounding that the checks of a result allow for: in a coordinate of the disk; in a determinant of
/// three points of the sphere; in a length, relatively.
constexpr double kDiskRounding = 8 * kUnitRoundoff, kSphereRounding = 16 * kUnitRoundoff,
				 kLengthRounding = 16 * kUnitRoundoff;

// ---- Heuristic: other values would work as well, these were measured to do ----------------------

/// Excess of two sides over the third that a flat triangle is given, relative to the shorter of the two.
constexpr double kMollification = 1e-5;

/// A boundary loop no longer than this share of the square root of the surface's area is a short hole: of the
/// surface it takes less than a thousandth, which no map misses, while its seam, and flat metrics round a point
/// that is not a cone of the shape, are as long and as distorted as those of a large hole. A vertex is missing from
/// some 8000 faces or more then; in a coarser mesh its hole is a feature. With many handles seams pass everywhere
/// and holes cost little: short is divided by the Euler characteristic.
constexpr double kShortHole = 0.1;

/// Spread of the logarithm of the area factor beyond which a linear problem knows nothing of the tails,
/// and above which the mean factor may be larger than kMaxAreaMean. At 1 most areas keep within a factor
/// of e.
constexpr double kWideSpread = 1.0;

/// The spread that comes out may be larger by this factor than what placed cones were asked for,
/// because the linear problem that places them misses about as much on fine meshes. More is what a
/// coarse mesh, or a limb that has few triangles around it, makes of it.
constexpr double kSpreadSlack = 1.1;

/// Largest mean area factor of a metric that is to keep areas: straight triangles of a coarse mesh have
/// up to a sixth more, and 3 is to hold for them.
constexpr double kMaxAreaMean = 2.6;

/// Added to the diagonal of the Hessian, whose typical entries are of order 1, while triangles are
/// broken: their derivatives are 0.
constexpr double kRegularisation = 1e-6;

/// Below this step length Newton's direction has failed.
constexpr double kMinNewtonStep = 1e-10;

/// Canonical generators that move 0 farther than this (hyperbolic distance) are not given: their
/// numbers of about 1e8 no longer hold |a|^2 - |b|^2 = 1 in double precision. The second is the same for extended
/// precision, in which they are found: handle moves make them shorter.
constexpr double kMaxGeneratorDistance = 38.0, kMaxSearchedDistance = 72.0;

/// Copies of a fundamental domain further from 0 than this are smaller than a float can show; two
/// whose images of 0 are nearer to each other are the same (hyperbolic distances).
constexpr double kMaxTileDistance = 12.0, kSameTile = 1e-3;

} // namespace ricci

#endif
