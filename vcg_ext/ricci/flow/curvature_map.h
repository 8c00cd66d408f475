// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CURVATURE_MAP_H
#define RICCI_CURVATURE_MAP_H

#include "../mesh/elements.h"
#include "../metric/circle_packing.h"
#include "../metric/conformal_flip.h"
#include "../numerics/sparse_cholesky.h"

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

namespace ricci {

/// The map u -> K(u) of a discrete conformal class (Definition 3.5), which is a triangulation and an inversive
/// distance on each edge, by a circle at each vertex (Eqs 1, 2, 4): the gradient of the convex Ricci energy
/// (Eq. 10; its sign as printed is that of a concave one), together with its derivative, the
/// Hessian of the energy (Eqs 7-9, 11, 12). The one seam between the flow and its background
/// geometry: Newton's method sees only this class.
///
/// Where a triangle breaks the triangle inequality its angles are continued by the constants pi, 0,
/// 0 and its derivatives by 0. The energy then is C^1 and convex for every u, for inversive
/// distances I >= 0 [Luo 2011] as for vertex scaling [Bobenko Pinkall Springborn 2015].
class CurvatureMap
{
public:
	virtual ~CurvatureMap() = default;

	/// Computes everything below at u + \p low: \p low is the part that the doubles of \p u cannot
	/// hold (below their last place), or empty. Radii then are exact to their own last place, not
	/// to that of u. A packing that does not exist at u (hyperbolic u >= 0, nested circles) gives
	/// values that are not finite, or broken triangles; it is not an error.
	/// \throw NotConverged (FlipsUsedUp) where rounding keeps flips from ending
	virtual void evaluate(const VertexVector& u, const VertexVector& low) = 0;

	void evaluate(const VertexVector& u) { evaluate(u, VertexVector()); }

	/// Whether adding a constant to u changes nothing (Euclidean background).
	virtual bool scaleInvariant() const = 0;

	const Triangulation& triangulation() const { return m_triangulation; }
	/// I - 1 for the inversive distance I; at least 0 where circles are tangent or disjoint.
	const EdgeArray<double>& delta() const { return m_delta; }

	/// K in radians: 2 pi (pi on the boundary) less the angles at the vertex (Eq. 2).
	const VertexVector& curvature() const { return m_curvature; }

	/// Lengths in the metric of the last u (Eq. 4).
	const EdgeArray<double>& lengths() const { return m_lengths; }

	/// Angle in radians at the halfedge's origin (Eq. 1); 0 on exterior halfedges.
	const HalfedgeArray<double>& angles() const { return m_angles; }

	/// w_ij of Eq. 12: minus the derivative of K_i by u_j.
	const EdgeArray<double>& weights() const { return m_weights; }

	/// cosh(length) - 1, which the hyperbolic plane adds to the diagonal of the Hessian; 0 in the
	/// Euclidean.
	double cosineLess1(Edge e) const { return m_cosineLess1.empty() ? 0.0 : m_cosineLess1[e]; }

	/// Number of triangles that break the triangle inequality.
	int brokenTriangles() const { return m_broken; }

	/// Largest quotient of two sides of one triangle: the amplification of rounding in its angles.
	double needleRatio() const { return m_needleRatio; }

	/// Changes when the connectivity does; 0 until then. A sparsity pattern stays valid while it is
	/// the same.
	int revision() const { return m_revision; }

	/// Keeps the connectivity that the last evaluate() left.
	void accept();
	/// Returns to the connectivity that was kept last.
	void reject();

	/// Edges that evaluate() flipped since the start, in order, up to the last accept().
	const std::vector<Edge>& flips() const { return m_flips; }

	/// Frees what only evaluate() needs, which must not be called again.
	virtual void releaseWorkSpace() = 0;

	/// Threads that evaluate() may use (by default all of the machine's). Their number does not
	/// change a bit of the result.
	void useThreads(int threads) { m_threads = threads; }

	/// Replaces edge \p e by the other diagonal of its two triangles, with \p delta.
	/// \pre \p e is flippable
	void swapEdge(Edge e, double delta);

protected:
	CurvatureMap(Triangulation triangulation, EdgeArray<double> delta);

	Triangulation m_triangulation;
	EdgeArray<double> m_delta;
	FlipJournal m_journal; // since the last accept()
	VertexArray<char> m_boundary;
	VertexVector m_curvature;
	EdgeArray<double> m_lengths, m_weights, m_cosineLess1;
	HalfedgeArray<double> m_angles;
	int m_threads;
	int m_broken = 0;
	std::vector<Edge> m_flips;
	double m_needleRatio = 1.0;
	int m_revision = 0;
};

/// CurvatureMap in the background geometry \p Geometry (Euclidean, Hyperbolic).
template<class Geometry>
class GeometricCurvatureMap : public CurvatureMap
{
public:
	/// \param flips whether the triangulation becomes the weighted Delaunay one of every u, by flips that
	/// keep the conformal class (conformal_flip.h); else it stays. K(u) then is continuously differentiable
	/// for all u, no triangle breaks, and all weights are non-negative (off the boundary, whose edges stay):
	/// in the Euclidean plane [Bobenko Lutz 2023], in the hyperbolic plane [Bobenko Lutz 2023b].
	GeometricCurvatureMap(Triangulation triangulation, EdgeArray<double> delta, bool flips = false);

	using CurvatureMap::evaluate;
	void evaluate(const VertexVector& u, const VertexVector& low) override;
	bool scaleInvariant() const override { return Geometry::scaleInvariant; }
	void releaseWorkSpace() override;

private:
	void evaluateCircles(const VertexVector& u, const VertexVector& low);
	void flipToDelaunay();
	void evaluateEdges();
	void evaluateTriangles();
	bool evaluateTriangle(Face f, double& needleRatio);

	const bool m_flipsEdges;
	VertexArray<typename Geometry::Circle> m_circles;
	EdgeArray<double> m_excess;          // length less the radii
	HalfedgeArray<double> m_halfWeights; // the triangle's share of the weight
	VertexArray<double> m_kappa;         // where edges flip
	DelaunayQueue m_queue;
};

/// The map in \p background.
/// \param flips see GeometricCurvatureMap
std::shared_ptr<CurvatureMap> curvatureMap(
	Triangulation triangulation, EdgeArray<double> delta, Background background, bool flips);

/// The derivative of the curvature by u (Eq. 11), the Hessian of the Ricci energy, restricted to
/// the unknown vertices: -w_ij off the diagonal, the sum of w_ij cosh l_ij on it (in the Euclidean
/// plane of w_ij). Symmetric, positive semi-definite wherever all triangles exist. With a Cholesky factor.
class FactoredHessian
{
public:
	using Matrix = Eigen::SparseMatrix<double>;

	/// \p fixed: 1 where u is not an unknown. Where nothing is fixed and \p scaleInvariant, one row is
	/// redundant: the first vertex is not an unknown either.
	/// \param mirror images of the vertices of a symmetric surface, or empty. A vertex and its image
	/// share an unknown: where u is symmetric, so is Newton's step, and half the equations give it.
	FactoredHessian(
		const VertexArray<char>& fixed,
		bool scaleInvariant,
		const VertexArray<Vertex>& mirror = {});

	int unknowns() const { return m_unknowns; }

	/// Row of the vertex's unknown, or -1.
	const VertexArray<int>& row() const { return m_row; }

	/// Its lower triangle.
	const Matrix& matrix() const { return m_matrix; }
	SparseCholesky& cholesky() { return m_cholesky; }

	/// Fills the matrix at the state of \p map, for a new pattern where the connectivity has another
	/// revision than at the last call. The factor stays.
	void fill(const CurvatureMap& map);

	/// Takes another matrix of these unknowns.
	void fill(const Matrix& lower) { m_matrix = lower; }

	/// Factorises the matrix as it is filled. Where it is not positive definite, and where triangles
	/// were broken (their derivatives are 0), a shift is added to the diagonal.
	/// \throw SolverFailed where no shift makes it positive definite
	void factorize();

	bool isFactored() const { return m_isFactored; }

	/// Whether the last factor has a shift on the diagonal of its matrix.
	bool isShifted() const { return m_isShifted; }

	/// Entries of \p values by unknown, those of images added up, and back (0 elsewhere).
	Eigen::VectorXd gather(const VertexVector& values) const;
	VertexVector scatter(const Eigen::VectorXd& rows) const;

private:
	void layOut(const CurvatureMap& map);

	VertexArray<int> m_row;
	int m_unknowns = 0;
	int m_revision = -1;      // of the map, when the pattern was laid out
	bool m_hasBroken = false; // triangles, as it is filled
	bool m_isFactored = false;
	bool m_isShifted = false;
	Matrix m_matrix;
	EdgeArray<int> m_offDiagonal; // slot, or -1
	SparseCholesky m_cholesky;
};

} // namespace ricci

#endif
