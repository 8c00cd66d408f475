// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_REPORT_H
#define RICCI_REPORT_H

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace ricci {

/// The flow before one of its Newton steps, or at its end.
struct FlowState
{
	int component = 0; ///< number of the component, from 0
	int step = 0;      ///< Newton steps done; another solve begins with the number of the last one
	double residual = 0.0; ///< max |target - K| in radians
};

/// What a component was mapped with in the end. The first ones are those of TargetCurvature, by their
/// numbers, and Automatic ends with one of the others.
enum class TargetUsed {
	Several, ///< those of the components differ
	Flat,
	Disk,
	Rectangle,
	SelectedCones,
	Prescribed,
	PlacedCones,
	FreeBoundary,       ///< no cones; the boundary keeps its metric
	PrescribedBoundary, ///< no cones; the boundary's curvature is in proportion to its length
	Unfolded,           ///< cut along creases, each piece with a free boundary
	GivenMap            ///< the map that the mesh had is kept, see SurfaceMesh::map
};

/// The flow.
struct FlowReport
{
	int iterations = 0; ///< Newton steps, over all solves, also for maps that were not taken
	std::vector<FlowState> flowStates; ///< in the order in which they were passed
	double maxCurvatureError = 0.0;    ///< max |target - K| in radians, where K is prescribed
	double residualFloor = 0.0;        ///< radians: what rounding allows max |target - K| to reach

	/// Largest share of an edge's length that the flow has added to it, because a face at one of its ends has
	/// no area or is a needle: 0 where there is no such face, 1 where an edge has no length.
	double lengthened = 0.0;

	int flips = 0;           ///< intrinsic flips, those to the start's triangulation included
	int edgeSwaps = 0;       ///< paper 5.4
	int boundarySplits = 0;  ///< paper 5.4: boundary edges split before a new start
	int brokenTriangles = 0; ///< faces that break the triangle inequality at the end

	std::optional<TargetUsed> targetUsed; ///< Euclidean flow
	/// What Automatic chose and why, as part of a sentence; empty where there was nothing to choose, or where
	/// the choices of several components differ.
	std::string choice;
	int cones = 0; ///< vertices inside that are not flat
	/// What the linear equation lets expect of areaDistortionSpread, where cones were placed or declined.
	std::optional<double> expectedSpread;
	/// Free boundary: the smallest and the largest length of one of its edges in the map, at the scale of the
	/// flow, over that on the mesh. The flow keeps them; the finish may not.
	std::optional<double> boundaryRatioMin, boundaryRatioMax;

	/// Searches for something better that the bound on their work has ended; the log says which.
	int endedEarly = 0;
};

/// Conformal invariants of one component, and how exactly its metric closes up.
struct InvariantReport
{
	std::optional<double> torusTauRe, torusTauIm; ///< reduced to the fundamental domain
	std::optional<double> annulusModulus;         ///< ln(r2/r1) / 2 pi
	std::optional<double> rectangleAspect;        ///< longer over shorter side

	/// Closed surface of genus 1 to 10: its period matrix, row by row (PeriodMatrix::omega), else empty;
	/// and the bound of its error.
	std::vector<std::complex<double>> periodMatrix;
	std::optional<double> periodError;

	/// ConeRounding::QuarterTurns: largest distance of the rotation across a seam of the flow's cut from
	/// a multiple of pi / 2, radians, in the map as finished.
	std::optional<double> holonomyError;

	/// Hyperbolic flow: area of the metric by its side lengths, which Gauss-Bonnet puts at sum K - 2
	/// pi chi.
	std::optional<double> hyperbolicArea;
	/// Hyperbolic flow: how far the layout is from closing up, see closingError(). The largest of
	/// the angle or hyperbolic length by which the side pairings miss a vertex of the cut on the way
	/// round it, of the same for the |trace| at cones, and for the length of geodesic boundaries. Each
	/// is seen from its own place, so that it means the same at any genus: the rounding of a layout
	/// that reaches the distance d from 0 is about 1e-18 e^d in it. Cones of up to 1e-9, which the seam
	/// need not reach, are left in it.
	std::optional<double> relationError;
};

/// How a map changes angles and areas.
struct DistortionReport
{
	double qcMean = 1.0;       ///< mean of sigma1/sigma2 over the faces
	double qcVertexMean = 1.0; ///< mean over vertices of the area-weighted ring value (paper 5.1)
	double qcAreaMean = 1.0;   ///< mean over the faces, weighted by their 3D area
	double qcP99 = 1.0;        ///< 99th percentile over the faces
	double qcMax = 1.0;
	std::vector<double> qcValues; ///< at the vertices that qcVertexMean runs over

	/// Area factor s of a face: its share of the area in the plane over its share in space. Mean of
	/// max(s, 1/s) over the faces, weighted by their 3D area: 1 where all areas keep their ratios.
	double areaDistortionMean = 1.0;
	double areaDistortionSpread = 0.0; ///< standard deviation of ln s, weighted by 3D area
	std::vector<double> areaFactors;   ///< binary logarithms of s of the faces
};

/// What a run measured. With several components counts are sums, errors maxima, means run over all
/// faces, and the conformal invariants are left empty.
struct Report : FlowReport, InvariantReport, DistortionReport
{
	bool converged = false;

	// The surface, as it was opened for the flow:
	int components = 0;
	/// Hyperbolic flow: components without a hyperbolic metric, which lie beside the disks, in the plane's metric.
	/// Areas and distortion are those of the others.
	int leftOutComponents = 0;
	int eulerCharacteristic = 0;
	int genus = 0;
	int boundaryLoops = 0;
	int cappedHoles = 0; ///< boundary loops closed for the flow

	int joinedEdges =
		0; ///< edges whose faces have vertices of their own there, see JoinSplitVertices
	int piecesApart = 0; ///< pieces of the surface that could be joined to others so, and are not

	int cutNonmanifoldEdges = 0; ///< edges with more than two faces, cut so that each sheet has two
	int splitVertices = 0;       ///< vertices with more than one fan of faces, or on such an edge
	int duplicateFaces = 0;      ///< faces with the vertices of another: sheets of their own
	int oneSidedComponents = 0;  ///< components cut along short one-sided loops
	int degenerateFaces = 0;     ///< faces without area that are drawn as lines or points

	int chosenSeamEdges = 0;       ///< edges opened before the flow, as SurfaceMesh::seam asks for
	double chosenSeamLength = 0.0; ///< of these, by each pair of sides

	// The charts and their seams:
	int charts = 0;
	int seamEdges = 0;       ///< edges of the input along which the layout is cut, except for those
							 ///< that SurfaceMesh::seam asks for
	double seamLength = 0.0; ///< of these edges and of overlapCuts on the mesh, each once
	double seamLengthRelative = 0.0; ///< seamLength over the square root of the mesh's area
	/// Edges of the output cut so that no chart covers itself, across strips, or round triangles that floats
	/// cannot hold in their chart. Where parts are joined elsewhere, seamEdges get fewer.
	int overlapCuts = 0;
	/// Squares that the charts are packed into, see PackOptions::tileSide.
	int tiles = 1;
	/// Share of the unit square, or of all tiles, or of the square that holds all charts and their margins where they
	/// keep their scale, that the charts cover. Known once they are packed.
	double occupancy = 0.0;
	/// Options::chartMargin as it came out.
	double margin = 0.0;

	/// Of a map to the plane: its symmetric Dirichlet energy at the best scale, stretchEnergy(); and with the
	/// price of all seams, MapCost::total().
	std::optional<double> stretch, objective;

	/// Points of the map that the repair moved, see Finish; one that is moved again after rounding to float counts
	/// twice.
	int finishMoved = 0;
	/// Points of the common refinement that are not vertices of the input; 0 where the result keeps the mesh.
	int refinementPoints = 0;

	// Of the coordinates as they are stored, in floats:
	int flippedFaces = 0;      ///< faces whose image in the plane is reversed or has no area
	int flippedByRounding = 0; ///< more of them once the coordinates are rounded to float
	/// Faces that cover a part of the plane together with another one, and charts that these are in: see
	/// overlapsInFloats().
	int overlappingFaces = 0, overlappingCharts = 0;
	/// Edges of seams whose two sides differ in length, in the disk in hyperbolic length: see unequalSeams().
	int unequalSeams = 0;

	/// Adds what the run of one more component has measured: counts add up, the larger of two errors
	/// stays, and the conformal invariants are those of a component alone. What is measured on the whole
	/// map stays as it is.
	Report& operator+=(const Report& next);
};

} // namespace ricci

#endif
