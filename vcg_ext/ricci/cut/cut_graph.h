// SPDX-License-Identifier: GPL-3.0-or-later
// The folder cut: edges along which a surface opens to a disk, short ones. Seams that a caller chooses, and
// creases, are in mesh.
#ifndef RICCI_CUT_GRAPH_H
#define RICCI_CUT_GRAPH_H

#include "../base/points.h"
#include "../mesh/component.h"
#include "../mesh/triangulation.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace ricci {

/// Edges along which a surface is cut open into one topological disk.
struct CutGraph
{
	EdgeArray<char> isCut;   ///< 1 on the cut; boundary edges are never on it
	VertexArray<char> cones; ///< 1 inside where it must pass or end

	/// 2 genus edges of the cut. The loops of the surface that cross one of them once, and the cut
	/// nowhere else, generate the homology of the surface with every boundary loop filled.
	std::vector<Edge> generators;

	bool isMirrored = false; ///< made by mirroredCut()

	int edgeCount() const { return static_cast<int>(std::count(isCut.begin(), isCut.end(), 1)); }
};

/// Finds a short cut graph by a tree and a cotree (greedy system of loops
/// [Erickson Whittlesey 2005]): a tree of shortest paths to the nearest of several roots and of short connections
/// between these, a spanning tree of the dual that crosses the edges with the longest loops first, and the
/// 2 genus edges in neither. Roots are the boundary loops, each of which counts as one point, and the vertices
/// with \p cones, or one vertex where there are none. The cut reaches them; other dead ends are
/// taken back. What is left is shortened by shortenCut().
///
/// A closed sphere with less than two marked vertices gets an empty cut. Deterministic.
/// \param cost of a seam along the edge, positive; the length, or whatever else is to be small in
/// sum; infinite where the cut must not run
/// \param cones see CutGraph
/// \param root where there is none otherwise; any if it is not valid
/// \pre \p t is connected
/// \throw NotConverged (NoCut) if the edges of infinite cost leave no cut
CutGraph cutToDisk(
	const Triangulation& t,
	const EdgeArray<double>& cost,
	VertexArray<char> cones,
	Vertex root = {});

/// What a cut graph with these edges is.
CutGraph cutGraphOf(const Triangulation& t, VertexArray<char> cones, EdgeArray<char> isCut);

/// A short cut graph that \p mirror takes to itself: that of one half through the cones there, its image, and the edges in
/// the plane but for one run of them, across which the halves stay together.
/// \param cost of the edges; those without an image are not used
/// \return none where \p mirror does not take the cones to cones, or no such cut leaves a disk
std::optional<CutGraph> mirroredCut(
	const Triangulation& t,
	const MirrorSymmetry& mirror,
	const EdgeArray<double>& cost,
	const VertexArray<char>& cones);

/// The cut graph far from the middle of the surface, which leaves a disk of a small radius: the edges that a tree
/// of the triangles does not cross, without dead ends. The tree crosses the edges nearest to the middle first. Longer
/// than the cut graph of cutToDisk().
/// \param lengths of the edges
/// \param cones see CutGraph
/// \pre \p t is connected
CutGraph
cutAroundCentre(const Triangulation& t, const EdgeArray<double>& lengths, VertexArray<char> cones);

/// Shortens a cut graph, whose complement is a disk. The complement stays a disk, and the cut still reaches every
/// marked vertex and every boundary loop.
///
/// Segments, the longest first, are exchanged where that gains: paths of the cut between vertices where it branches
/// or ends, marked vertices and those on the boundary. Without one of them the cut leaves an annulus. Any path
/// between the two boundaries A and B of the annulus makes it a disk again, and the shortest is taken. It may
/// start and end anywhere, so the move straightens seams, moves branches, and changes the homotopy class of
/// loops.
///
///        +---------------+        +---------------+
///        | A +---+       |        | A +---+       |
///        |   | B |       |   ->   |---| B |       |
///        |   +---+--. .--|        |   +---+       |
///        |           '   |        |               |
///        +---------------+        +---------------+
///
/// Deterministic: of equally short paths always the same is taken. Between two moves the complement
/// of the cut is a disk.
/// \param cost of the edges, positive; infinite where no path may run
/// \param marked 1 at vertices that the cut reaches, inside
/// \param isCut changed in place
/// \pre the surface opened along the cut is a disk, or nothing is cut; the cut has no dead ends but at
/// marked vertices
void shortenCut(
	const Triangulation& t,
	const EdgeArray<double>& cost,
	const VertexArray<char>& marked,
	EdgeArray<char>& isCut);

/// Takes back the parts of \p cut that end at holes round which the metric closes: the chart goes
/// round them in one piece. Where the cut runs on through such a hole to another place that it has
/// to reach, it stays.
/// \param closes 1 on boundary loops whose holonomy is trivial, in rotation and in translation
void dropSeamsToHoles(const Triangulation& t, const VertexArray<char>& closes, CutGraph& cut);

/// The edges of a cut as seams: chains of halfedges, each from a vertex where the cut branches or ends,
/// at a cone or on the boundary to the next such vertex; or a loop without any, which come last.
std::vector<std::vector<Halfedge>>
seamsOf(const Triangulation& t, const EdgeArray<char>& isCut, const VertexArray<char>& cones);

/// How far each vertex stands out of the surface round it, between 0 (deep in a hollow) and 1 (on a
/// ridge or tip); 1/2 on a plane.
///
/// Measured by the height of the vertex along its normal over the surface after one implicit step
/// of mean curvature flow [Desbrun et al. 1999], which is so long that features of a twentieth of
/// the surface's size vanish. With the root mean square s of all heights, the height h gives
/// (1 + tanh(h / s)) / 2, so that the scale of the surface does not matter.
/// \param lengths of the edges between \p positions, positive
/// \throw SolverFailed (SeamCost)
VertexArray<double> exposure(
	const Triangulation& t, const EdgeArray<double>& lengths, const VertexArray<Point3>& positions);

/// What a seam along each edge costs: its length, times a factor between 1 and 10 that grows
/// linearly with the mean exposure of its ends.
/// \param lengths of the edges between \p positions, positive
/// \param hiding 0: the length alone; 1: the full factor
/// \throw SolverFailed (SeamCost)
EdgeArray<double> seamCost(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const VertexArray<Point3>& positions,
	double hiding);

/// Cost factor of cuts along diagonals of polygons: detours along sides are never so much longer, so that a polygon is
/// divided only where no other path goes round it.
constexpr double kDiagonalFactor = 1e3;

/// Multiplies the cost of seams along diagonals of polygons by kDiagonalFactor.
/// \param isDiagonal see FlowDomain; may be empty
void avoidDiagonals(const EdgeArray<char>& isDiagonal, EdgeArray<double>& cost);

} // namespace ricci

#endif
