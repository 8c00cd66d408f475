// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_OPTIONS_H
#define RICCI_OPTIONS_H

#include "base/numbers.h"

namespace ricci {

/// Which curvature the flow is asked to reach (paper 5.2). The order is that of the filter's menu.
enum class TargetCurvature {
	Automatic,     ///< annulus, torus: flat; other boundaries, and all at chosen seams: free; but
				   ///< placed cones where areas would change much without them (with flips, and on
				   ///< surfaces with boundary a free one), and on other closed surfaces
	Flat,          ///< K = 0 at every vertex, boundary included; needs Euler characteristic 0
	Disk,          ///< the image of a topological disk is a round disk
	Rectangle,     ///< four corners of pi/2 on the boundary of a topological disk
	SelectedCones, ///< equal shares of 2 pi chi at the selected vertices, 0 elsewhere
	Prescribed,    ///< one value for each vertex, in radians
	PlacedCones    ///< cones where they lower the distortion of area, see placeCones()
};

/// Which curvatures placed cones may have.
enum class ConeRounding {
	Free,        ///< any up to 3 pi / 2
	QuarterTurns ///< multiples of pi / 2, and so are the rotations across all seams, see
				 ///< makeSeamless()
};

/// What the flow runs on, and what happens if it would break the triangle inequality. The order is
/// that of the filters' menus.
enum class Method {
	/// Weighted-Delaunay flips that keep the conformal class: no triangle breaks.
	IntrinsicFlips,
	/// The mesh's triangles; the energy is extended past broken ones.
	FixedTriangles,
	/// In the plane only: swap the edge, its inversive distance from the 3D distance (paper 5.4).
	EdgeSwaps,
	/// In the plane only: the conventional flow, on the mesh's triangles with inversive distances
	/// clamped to [0,1] (acute angles).
	Thurston
};

/// What the boundary loops other than the longest are. The order is that of the filter's menu.
enum class Holes {
	Boundaries, ///< boundary like the longest loop: free or prescribed, with seams that join them
	Capped,     ///< closed by caps that take part in the flow and are not written, see flowDomain()
	ShortCapped ///< capped where they are short, see flowDomain(); the others are boundaries
};

/// The mesh on which the result is returned.
enum class OutputTriangulation {
	KeepMesh,        ///< the input's faces; each takes the flow's map at its corners
	CommonRefinement ///< the overlay of the input's and the flow's triangles, on which the map is
					 ///< exact
};

/// Whether the charts of the flow are cut further. The order is that of the filter's menu.
enum class Charts {
	OfTheFlow,      ///< they are not
	WithoutOverlap, ///< a chart that covers a part of the plane more than once becomes several
	///< that do not; the others stay as they are, and so do disks and rectangles
	CutForPacking, ///< and of Automatic, a chart that leaves most of the square empty is cut where that is worth
	///< the seam, see packWithCuts(), unless the mesh has a map or chosen seams. A cut counts as one of an overlap
	AsGiven ///< there is no flow: those of the map that the mesh has (SurfaceMesh::map) keep their shapes, and are
			///< only turned and packed, all scaled by one factor
};

/// What is done to a map that the flow has found, which is exact on its own triangles, for the
/// straight triangles that are given back. Only maps found with flips are finished, see isFinished().
enum class Finish {
	None,            ///< the map is drawn as it is
	Repair,          ///< no triangle is flipped or has no area
	LeastDistortion, ///< and on the mesh's own triangles, the conformal distortion is the least that
	///< seams and cones allow; or the energy, where cones were chosen for it and straight
	///< triangles have more, see keepPromise()
	LeastStretch ///< and they keep lengths as well as they can, with the two sides of each seam, and the
				 ///< boundary, let go: least symmetric Dirichlet energy, see leastStretch(). For
				 ///< LeastDistortion where boundary or quarter turns are prescribed
};

/// Which vertices of the mesh are one vertex of its surface although they have numbers of their own: formats that
/// cannot share vertices, or split them for normals and texture coordinates, give each face its own. Results are for
/// the vertices as they are given. See findSplitVertices() for the rule.
enum class JoinSplitVertices {
	/// Those that lie on each other along edges, where nine tenths of all sides of faces are no other face's by the
	/// numbers of their vertices; else none, because the cuts of a mesh that shares vertices may be meant.
	Automatic,
	Never,
	Always
};

/// Geometry of the plane that triangles are cut from (Definition 3.1).
enum class Background {
	EuclideanPlane, ///< flat triangles
	HyperbolicPlane ///< triangles of curvature -1
};

/// What the flow itself needs to know.
struct FlowOptions
{
	/// Stop when max |target - K| falls below this, in radians. Must be positive.
	double epsilon = 1e-8;

	Method method = Method::IntrinsicFlips;

	JoinSplitVertices join = JoinSplitVertices::Automatic;

	/// Edges at which the surface bends by more than this are seams, as those that SurfaceMesh::seam marks: radians
	/// between the normals of the two faces, above 0. pi: none. Needs positions.
	double sharpAngle = kPi;

	/// CommonRefinement belongs to intrinsic flips.
	OutputTriangulation output = OutputTriangulation::KeepMesh;

	/// The hyperbolic flow takes what is above Repair for Repair: its deck transformations, which the
	/// map of least distortion would have to keep, are not rigid motions of the plane.
	Finish finish = Finish::LeastDistortion;
};

/// Whether a map is to be finished: those of the other methods are there to compare with.
inline bool isFinished(const FlowOptions& options)
{
	return options.finish != Finish::None && options.method == Method::IntrinsicFlips;
}

/// Which cones are placed, see placeCones().
struct ConeOptions
{
	/// If count > 0: that many cones. Else, if distortion > 0: as many as bring the expected
	/// Report::areaDistortionSpread below it, which is also the spread up to which Automatic places none.
	/// If both are 0: as many as minimise the expected MapCost, which is energy plus the price of seams.
	/// With flips the resulting areas count as well, see keepAreas().
	int count = 0;
	double distortion = 0.0;
	ConeRounding rounding = ConeRounding::Free;

	/// Automatic places cones on surfaces alone that have no flat metric without them, however areas change.
	bool onlyWhereNeeded = false;
};

/// The widest margin that charts are packed with.
constexpr double kMaxChartMargin = 0.25;

/// Tiles side by side, and at most.
constexpr int kTilesInRow = 10, kMaxTiles = 100;

/// How charts may be turned while they are packed.
enum class ChartTurns {
	None,    ///< as the layout leaves them
	Quarter, ///< charts whose outline is straight lie along the axes; all turn by right angles besides
	Free     ///< charts whose outline is straight lie along the axes, others in any direction
};

/// How the charts of a map are packed.
struct PackOptions
{
	/// Fit the charts into [0,1]^2, all with one scale and their aspect kept; false: the same charts in a square
	/// from the origin, at the scale at which a chart has the area of its component (or its boundary the input's
	/// length).
	bool normalizeUV = true;

	/// Least distance of two charts, and of a chart from the border of the square that holds all, or of its tile, as a
	/// share of its side, between 0 and kMaxChartMargin. Less where so many charts do not fit with it: Report::margin.
	double chartMargin = 0.0;

	/// Rectangle allows none, quarter turns across seams right angles only.
	ChartTurns turns = ChartTurns::Free;

	/// Side of a tile, in the unit of the surface's lengths: the charts, which together have the surface's area, are
	/// packed into as many tiles as they need, and those that are too long for one are cut if they may be. Tile n is
	/// the square from (n mod kTilesInRow, n / kTilesInRow), of side 1: UDIM 1001 + n. 0: one square that holds all
	/// charts.
	double tileSide = 0.0;
};

/// Options of the Euclidean flow.
struct Options : FlowOptions, PackOptions
{
	TargetCurvature target = TargetCurvature::Automatic;
	ConeOptions cones;

	/// Fix u on the boundary (paper 5.3: du = 0), so that the boundary keeps its metric; the
	/// prescribed curvature then holds at interior vertices only. Disk, Rectangle and the flat
	/// annulus prescribe the boundary and ignore this.
	bool freeBoundary = true;

	/// How much longer a seam may be to run in hollows, 0 to 1; see seamCost().
	double seamHiding = 0.0;

	/// Capped belongs to intrinsic flips. ShortCapped is Boundaries with the other methods, and where the
	/// target gives values for the surface's own boundary: Flat and Prescribed.
	Holes holes = Holes::ShortCapped;

	Charts charts = Charts::CutForPacking;
};

/// Which curvature the hyperbolic flow is asked to reach. The order is that of the filter's menu.
enum class HyperbolicTarget {
	HyperbolicMetric, ///< K = 0 at every vertex; a boundary becomes geodesic
	SelectedCones,    ///< one total angle at each selected vertex, K = 0 elsewhere
	Prescribed        ///< one value for each vertex, in radians
};

/// What the target of the hyperbolic flow is chosen by.
struct HyperbolicTargetOptions
{
	HyperbolicTarget target = HyperbolicTarget::HyperbolicMetric;

	/// Total angle at each cone of SelectedCones, in radians.
	double coneAngle = kPi;

	/// Fix u on the boundary; the curvature then is prescribed inside only. The boundary's circles
	/// keep the radii that they have where the surface is scaled to the area 2 pi max(1, |chi|), so
	/// that finely triangulated boundaries keep their lengths at that scale.
	bool freeBoundary = false;
};

/// Options of the hyperbolic flow.
struct HyperbolicOptions : FlowOptions, HyperbolicTargetOptions
{
	/// Find canonical generators of the Fuchsian group, too, see FuchsianGroup::handles.
	bool canonicalGenerators = false;
};

} // namespace ricci

#endif
