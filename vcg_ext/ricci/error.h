// SPDX-License-Identifier: GPL-3.0-or-later
// Typed errors of the algorithm. Each carries what is wrong as data, from which a caller makes a
// sentence for its user; what() states the same in plain words, without a remedy, for programmers.
#ifndef RICCI_ERROR_H
#define RICCI_ERROR_H

#include "base/surface_type.h"
#include "options.h"

#include <array>
#include <cstddef>
#include <exception>
#include <string>
#include <utility>

namespace ricci {

/// Base of everything the algorithm throws on purpose.
class Error : public std::exception
{
public:
	const char* what() const noexcept override { return m_what.c_str(); }

	/// Where the mesh has several components: the lowest face of the one that failed, and its number
	/// of faces. Else -1 and 0.
	int componentFace = -1;
	std::size_t componentFaces = 0;

protected:
	Error() = default;
	explicit Error(std::string what) : m_what(std::move(what)) {}
	void describe(std::string what) { m_what = std::move(what); }

private:
	std::string m_what;
};

/// The mesh cannot be used.
class InvalidMesh : public Error
{
public:
	enum Problem {
		Empty,        ///< neither vertices nor faces
		NoFaces,      ///< count: vertices
		ArrayLength,  ///< count: length of \ref array; wanted: what it has to be, or 0
		DamagedFaces, ///< count: faces that use vertices which are not in the mesh
		NotFinite,    ///< count: vertices with coordinates that are NaN or infinite
		OutOfRange,   ///< count: vertices with coordinates beyond 1e50
		NoTriangle,   ///< count: faces whose lengths are those of no triangle
		UnequalSides, ///< count: edges with two lengths
		ScalesApart,  ///< vertices: one so far away that doubles give the faces elsewhere no area
		TooSmall,     ///< count: components smaller than 1e-50
		NoArea,       ///< count: faces; the vertices of each component lie on one line
		EdgesWithoutLength, ///< count; where no flips are allowed
		FacesWithoutArea,   ///< count; where no flips are allowed
		IncoherentEdge,     ///< vertices: its ends; its triangles are not two of opposite direction
		NotPuncturable,     ///< map to the sphere: the surface touches itself at its best vertices
		BeyondFloats        ///< texture coordinates too large or too small for float
	};

	explicit InvalidMesh(
		Problem problem, std::size_t count = 1, std::array<int, 2> vertices = {-1, -1});

	/// ArrayLength
	InvalidMesh(const char* array, std::size_t length, std::size_t wanted);

	Problem problem;
	std::size_t count;
	std::array<int, 2> vertices;
	const char* array = ""; ///< name of a member of SurfaceMesh or VertexInput
	std::size_t wanted = 0;
};

/// An option or a prescribed value is out of range, or contradicts the topology of the mesh.
class InvalidOption : public Error
{
public:
	enum Problem {
		NoSuchChoice,           ///< value of \ref name; its choices have the numbers below bound
		TimeLimit,              ///< value in seconds; must not be negative
		MemoryLimit,            ///< value in bytes; must not be negative
		Epsilon,                ///< value; must be above 0
		SharpAngle,             ///< value in radians; must be above 0 and at most pi
		ConeCount,              ///< value; must not be negative
		ConeDistortion,         ///< value; must be finite and not negative
		ConeAngle,              ///< value in radians; must be above 0 and finite
		SeamHiding,             ///< value; must be in [0, 1]
		ChartMargin,            ///< value; must be in [0, bound]
		TileSide,               ///< value; 0 would do, or one on the other side of bound
		TilesInOwnScale,        ///< tiles belong to PackOptions::normalizeUV
		WithoutFlips,           ///< the common refinement and capped holes belong to flips
		WithoutPositions,       ///< of a surface given by lengths; see flatten()
		HyperbolicMethod,       ///< the hyperbolic flow has no edge swaps and no Thurston packing
		NotADisk,               ///< target (Disk, Rectangle) and surface
		TooFewBoundaryVertices, ///< count; a rectangle needs 4
		CornerCount,            ///< count of selected vertices; a rectangle needs 4 or none
		CornersOffBoundary,     ///< count of selected vertices on one boundary loop; must be 4
		NothingSelected,        ///< cones at selected vertices
		TooFewCones,            ///< value: cones asked for; the surface needs bound at least
		TooFewVertices, ///< value: cones asked for; bound are needed, count inner vertices there
		SphereOfComponents, ///< count: components; the map to the sphere takes one
		NotASphere,         ///< surface
		NoMap,              ///< count: faces for which SurfaceMesh::map has no coordinates
		MapWithoutArea,     ///< SurfaceMesh::map, to be kept, takes every face to a line or a point
		CoverTooLarge       ///< value: rings; would need more than count faces
	};

	explicit InvalidOption(
		Problem problem, double value = 0.0, double bound = 0.0, std::size_t count = 0);
	InvalidOption(Problem problem, TargetCurvature target, const SurfaceType& surface);
	/// NoSuchChoice
	InvalidOption(const char* name, int value, int choices);

	Problem problem;
	double value = 0.0, bound = 0.0;
	std::size_t count = 0;
	const char* name = ""; ///< of the option
	TargetCurvature target = TargetCurvature::Automatic;
	SurfaceType surface;
};

/// No metric has the prescribed curvature. Curvatures in radians.
class InadmissibleCurvature : public Error
{
public:
	enum Problem {
		NotFinite,          ///< count: vertices whose prescribed curvature is NaN or infinite
		Flat,               ///< flat everywhere, but bound = 2 pi chi of the surface is not 0
		GaussBonnet,        ///< value: sum of the prescribed curvature; must be bound = 2 pi chi
		TooLargeInside,     ///< value at the worst of count vertices; must be below bound = 2 pi
		TooLargeOnBoundary, ///< the same on the boundary, bound = pi
		FreeBoundary,      ///< value: sum inside; must be above bound, with count boundary vertices
		ScalesApart,       ///< value: orders of magnitude between scale factors; at most bound
		HyperbolicSurface, ///< surface: Euler characteristic not negative, no cones
		HyperbolicSum      ///< value: sum; must be above bound = 2 pi chi
	};

	explicit InadmissibleCurvature(
		Problem problem,
		double value = 0.0,
		double bound = 0.0,
		std::size_t count = 0,
		const SurfaceType& surface = SurfaceType());

	Problem problem;
	double value, bound;
	std::size_t count;
	SurfaceType surface;
};

/// The flow stopped before it reached the prescribed curvature, or its result failed a check.
class NotConverged : public Error
{
public:
	enum Problem {
		StepsUsedUp,     ///< residual, epsilon, floor
		BrokenTriangles, ///< count; swaps: edges swapped before
		LostInRounding, ///< count: broken triangles; value: orders of magnitude between scale factors
		FlipsUsedUp,    ///< count: flips; edges are still not Delaunay
		CircleUnsettled, ///< value: last change of the points on the circle, radians
		FlatTriangles,   ///< count: triangles that end flat
		SplitsUsedUp,    ///< count: boundary edges that were split
		NoCut,           ///< no cut graph avoids the swapped edges
		OutsideDisk,     ///< count: corners that rounding puts on the border of the Poincaré disk
		PiecesLost, ///< count: pieces of the common refinement, of value, that floats cannot hold
		CheckFailed ///< finding: what the check of the result found
	};

	explicit NotConverged(Problem problem, std::size_t count = 0, double value = 0.0);
	explicit NotConverged(const std::string& finding);
	/// StepsUsedUp
	NotConverged(int iterations, double residual, double epsilon, double floor);

	Problem problem;
	std::size_t count = 0;
	double value = 0.0;
	int iterations = 0; ///< Newton steps made
	double residual = 0.0, epsilon = 0.0, floor = 0.0;
	int swaps = 0;
	Method method = Method::IntrinsicFlips;
	std::string finding;
};

/// A matrix of a linear problem is not positive definite.
class SolverFailed : public Error
{
public:
	enum Stage { Flow, SeamCost };

	explicit SolverFailed(Stage stage);

	Stage stage;
};

/// The mesh needs more memory than there is, or more elements than int can number.
class TooLarge : public Error
{
public:
	enum Problem {
		Faces,         ///< count; limit: how many can be numbered
		Memory,        ///< count: faces; bytes needed, limit
		DoubleMemory,  ///< count: faces of the double; bytes needed, limit
		Unknowns,      ///< count of a linear system whose factor the solver cannot number
		Crossings,     ///< count of the overlay; limit: how many can be numbered
		OverlayMemory, ///< count: crossings of the overlay; bytes needed, limit
	};

	TooLarge(Problem problem, std::size_t count, double needed, double limit);

	Problem problem;
	std::size_t count;
	double needed, limit;
};

/// What cannot happen by the mathematics has happened.
class InternalError : public Error
{
public:
	explicit InternalError(const std::string& what) : Error(what) {}
};

/// The listener asked the run to stop (progress.h). Nothing is tried again after it.
class Stopped : public Error
{
protected:
	using Error::Error;
};

/// The caller's progress callback asked to stop.
class Cancelled : public Stopped
{
public:
	Cancelled() : Stopped("Cancelled.") {}
};

/// The run took longer than its caller allows (base/task.h).
class TimeOut : public Stopped
{
public:
	/// \param elapsed, limit seconds; \param done share of the work, in [0, 1]
	TimeOut(double elapsed, double done, double limit);

	double elapsed, done, limit;
};

} // namespace ricci

#endif
