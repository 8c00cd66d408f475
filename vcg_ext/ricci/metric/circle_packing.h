// SPDX-License-Identifier: GPL-3.0-or-later
// The folder metric: circles, inversive distances, Delaunay and conformal flips, areas, in both geometries. No
// target.
#ifndef RICCI_CIRCLE_PACKING_H
#define RICCI_CIRCLE_PACKING_H

#include "../mesh/triangulation.h"

#include <memory>
#include <vector>

namespace ricci {

/// Initial radii of paper 4.1: the minimum of (l_ij + l_ki - l_jk) / 2 over the triangles at i,
/// infinite where there is none. They give gamma_i + gamma_j <= l_ij, hence I >= 1 on every edge.
/// Positive if every triangle satisfies the strict triangle inequality.
VertexArray<double> initialRadii(const Triangulation& t, const EdgeArray<double>& lengths);

/// Inversive distances less one (Eq. 3, Euclidean) of circles of these \p radii at this distance, with
/// which the packing metric equals \p lengths. Values below 0, which only rounding makes of radii as
/// of initialRadii(), become 0.
EdgeArray<double> inversiveDistancesLessOne(
	const Triangulation& t, const EdgeArray<double>& lengths, const VertexArray<double>& radii);

/// The same clamped to [-1, 0], for the conventional flow of paper 5.1: the packing metric no longer is
/// that of \p lengths.
EdgeArray<double> thurstonDistancesLessOne(
	const Triangulation& t, const EdgeArray<double>& lengths, const VertexArray<double>& radii);

/// A flat surface with cone points: the metric of a mesh carried by some triangulation of it.
struct IntrinsicMesh
{
	Triangulation triangulation;
	EdgeArray<double> lengths;
};

/// Two copies of a surface with boundary, the second one reversed, glued along the boundary: a
/// closed surface. Vertices, edges, halfedges and faces of the surface keep their numbers in the
/// first copy; an exterior halfedge of the surface is an interior one of the second copy.
/// \param mirror receives [vertex] the image in the other copy; on the boundary the vertex itself
IntrinsicMesh
doubleOf(const Triangulation& t, const EdgeArray<double>& lengths, VertexArray<Vertex>& mirror);

/// What mollify() adds to the edges: atVertex[i] + atVertex[j] to edge ij.
struct Lengthening
{
	VertexArray<double> atVertex; ///< empty where no triangle is degenerate
	double largest =
		0.0; ///< largest share of an edge that is added: 1 where it has no length itself

	/// Length with what is added of edge \p e of \p t, whose own length is \p l.
	double lengthOf(const Triangulation& t, Edge e, double l) const;
};

class FactoredHessian;

/// Where the flow starts (paper 4.1): the mesh's own metric on a triangulation of it, and the
/// circle packing whose metric it is (with Method::Thurston, nearly).
struct InitialPacking
{
	IntrinsicMesh mesh;
	VertexArray<double> radii;
	EdgeArray<double> delta; ///< inversive distance less one; a flow takes it
	std::vector<Edge> flips; ///< edges flipped since the input, in order
	bool isDelaunay = false; ///< from delaunayPacking()
	Lengthening lengthened;  ///< of the input's edges, by delaunayPacking()

	/// The Hessian of the Ricci energy here, where a LinearFlow has used it: the flow from here takes it, if its
	/// unknowns are the same.
	std::shared_ptr<FactoredHessian> hessian;
};

/// Gives degenerate triangles a shape (intrinsic mollification [Sharp Crane 2020], but vertex by vertex): those
/// that satisfy the triangle inequality by less than rounding can tell, or have a side a million times
/// shorter than another. To add e_i + e_j to edge ij, with any e >= 0, changes the excess l_ij + l_ki - l_jk
/// of a corner i by 2 e_i and no other excess. So no triangle inequality is lost, and triangles that touch no
/// degenerate one are left alone, however large that is.
///
/// In a needle the two corners at the short side get an excess of 1e-5 of the longest, which bounds its two
/// large angles away from pi. In a triangle flat on its longest side the corner there gets 1e-5 of the
/// shorter side *at the corner*: its angle then is about pi - 0.0045, whatever the sides' ratio, and no
/// edge changes by more than the angle needs. Less would do for the angle, but a circle's radius is at most
/// half the excess at its corner, and radii of all scales make the flow ill-conditioned. Vertices at one place
/// get the largest of what they need.
Lengthening mollify(const Triangulation& t, EdgeArray<double>& lengths);

/// The start with intrinsic flips: flips to the intrinsic Delaunay triangulation of the metric,
/// then, with half the initial radii of that, to the weighted one. Starting anywhere else would
/// keep a conformal class that is not the surface's: a conformal flip is isometric only where the
/// edge is both in and out of the weighted Delaunay triangulation. Degenerate triangles are given a
/// little area first (mollify()). Radii are lowered further where circles would touch: I > 1 on
/// every edge. That ends: it halves a radius each time that is at least half of an edge, and no edge
/// is shorter than the shortest geodesic between vertices.
/// \param mirror [vertex] the vertex whose radius must be the same (its image in a double, or
/// itself); may be empty
/// \throw InternalError where an edge is left without a length; NotConverged (FlipsUsedUp) where
/// rounding keeps the flips from ending
InitialPacking delaunayPacking(IntrinsicMesh mesh, const VertexArray<Vertex>& mirror);

/// The start on the mesh's own triangles, with the radii of paper 4.1 (initialRadii()).
/// \pre every triangle satisfies the strict triangle inequality
InitialPacking inputPacking(IntrinsicMesh mesh);

} // namespace ricci

#endif
