// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_LINEAR_FLOW_H
#define RICCI_LINEAR_FLOW_H

#include "../flow/ricci_flow.h"

#include <memory>

namespace ricci {

/// What the boundary does while cones are placed. A closed surface has none.
enum class ConeBoundary {
	Fixed,     ///< u = 0 on the boundary
	Prescribed ///< the boundary takes what Gauss-Bonnet leaves, in proportion to its length
};

/// Shares of the boundary vertices in the curvature of a boundary, by the length of their two boundary edges; of
/// all alike where the boundary has no length.
VertexVector boundaryShares(const EmbeddedSurface& surface);

/// The equation L u = k - K of a LinearFlow on the vertices where u is unknown.
struct LinearSystem
{
	Eigen::SparseMatrix<double> laplacian; ///< L, both triangles
	VertexVector curvature;                ///< K, radians
	VertexVector area;                     ///< shares in the whole area, which add up to 1
	VertexVector factor;                   ///< u where the flow is linearised; empty: 0
	VertexVector sink;          ///< shares of what the sum of k - K lacks; empty: no such
	bool fixesBoundary = false; ///< u is 0 on a boundary, which is not among the vertices
};

/// The flow to a target curvature k, linearised at its start: L u = k - K, where K is the curvature
/// of the surface and L the derivative of K by u, the Hessian of the Ricci energy (a Laplacian). It
/// is the equation of Newton's first step, and that by which [Ben-Chen Gotsman Bunin 2008] estimate
/// the conformal factor of a metric with cones. Or linearised where another flow has led, from which
/// u goes on: L (u - u') = k - K' for the factor u' and the curvature K' there.
///
/// L belongs to the weighted Delaunay triangulation of the metric, where no weight inside is
/// negative.
class LinearFlow
{
public:
	/// If \p start is a Delaunay start, L is the Hessian there, which it then keeps for the flow; else L is
	/// that of a Delaunay start made here.
	/// \param start the start of the flow on \p surface
	LinearFlow(const EmbeddedSurface& surface, InitialPacking& start, ConeBoundary boundary);

	/// L is the Hessian where \p flow has led. Where that ran on the double of the surface, L is that of
	/// a Delaunay start.
	/// \param flow on \p surface, with intrinsic flips
	/// \param weights of the vertices, which take the place of area() everywhere; they add up to 1
	LinearFlow(
		const EmbeddedSurface& surface,
		const FlowResult& flow,
		ConeBoundary boundary,
		VertexVector weights);
	/// The flow with the equation \p system.
	/// \throw SolverFailed
	explicit LinearFlow(LinearSystem system);
	LinearFlow(LinearFlow&&) = default;

	/// Factorises L, unless that has been done. The first solution does it otherwise: every function that is
	/// not const may.
	/// \throw SolverFailed
	void factorize();

	/// Whether the curvatures of the cones have a fixed sum: on closed surfaces, by Gauss-Bonnet.
	bool hasFixedSum() const { return m_sink.size() == 0 && !m_fixesBoundary; }

	int vertexCount() const { return static_cast<int>(m_area.size()); }

	/// K where the flow is linearised, radians.
	const VertexVector& curvature() const { return m_curvature; }

	/// Share of each vertex in the surface's area: a third of its triangles. They add up to 1.
	const VertexVector& area() const { return m_area; }

	/// The factor u of the metric with the curvatures \p k, with mean 0 by area. As solve(k - K) on
	/// what \p k misses.
	VertexVector factor(VertexVector k);

	/// The u, with mean 0 by area, that L maps to \p rhs. What is missing from the sum of \p rhs is
	/// taken from the boundary or, on a closed surface, from one vertex that is always the same. Two
	/// columns at once take little more than half as long as two calls, as in gradient().
	Eigen::MatrixXd solve(Eigen::MatrixXd rhs);

	/// Mean of u^2 by area.
	double meanSquare(const VertexVector& u) const { return m_area.dot(u.cwiseProduct(u)); }

	/// The adjoint problem: the field phi with L phi = A u, where A holds the areas. phi(v) is the
	/// derivative of half the mean square of \p u = solve(k - K) by the curvature k of a cone at v,
	/// up to a constant where the sum of the curvatures is fixed.
	Eigen::MatrixXd gradient(const Eigen::MatrixXd& u);

	/// The equation on the vertices where u is unknown, which are put into \p vertices, increasing.
	/// Where no u is fixed, the vertex that solve() holds is left out like a hole, and its curvature
	/// and area go to its neighbours.
	/// \pre not made from a LinearSystem
	LinearSystem system(VertexArray<Vertex>& vertices) const;

private:
	void computeAreas(const CurvatureMap& map);
	void layOut(const EmbeddedSurface& surface, const CurvatureMap& map, ConeBoundary boundary);
	Eigen::MatrixXd solveRows(const Eigen::MatrixXd& rhs);

	std::shared_ptr<FactoredHessian> m_hessian; // L
	bool m_fixesBoundary;
	VertexVector m_curvature, m_area;
	VertexVector m_factor; // u where the flow is linearised; empty: 0
	VertexVector m_sink;   // shares of the boundary vertices in a prescribed boundary; else empty
};

/// The linear problem of a surface on aggregates of its vertices, where the search for cones costs
/// little. Its Laplacian is that of functions which are constant on every aggregate, weakened evenly
/// so that the factors u get the right size (overcorrection [Braess 1995]). They are those of the surface to
/// about a tenth for each time that vertices are taken together, except for a cone's own aggregate.
/// \param system of a LinearFlow, which need not be factorised
/// \param vertices to take together until there are at most so many
/// \param roots the vertices of \p system; receives by aggregate the one from which it grew
/// \return the flow with arrays by aggregate in place of arrays by vertex
/// \throw SolverFailed
LinearFlow onAggregates(LinearSystem system, int vertices, VertexArray<Vertex>& roots);

} // namespace ricci

#endif
