// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONFORMAL_FLIP_H
#define RICCI_CONFORMAL_FLIP_H

#include "../base/task.h"
#include "../error.h"
#include "../mesh/triangulation.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace ricci {

/// Flips end by themselves in exact arithmetic: each one raises the function whose creases the edges
/// are, so that no triangulation comes twice. But their number has no bound by that of the edges: a
/// strip of triangles wound k times round a torus of one vertex takes k flips, and k may be about
/// 1 / kMinIntrinsicHeight. More than this many are rounding's, which goes round in circles.
inline std::int64_t maxFlips(int edgeCount)
{
	return std::max<std::int64_t>(10000000, std::int64_t(1000) * edgeCount);
}

/// Edges that wait for their test, and the work space of the searches that flip them.
struct DelaunayQueue
{
	std::vector<Edge> edges; ///< a stack
	EdgeArray<char> queued;  ///< 1 where the edge waits, on the stack or for its turn by number

	/// Tests \p first and, last come first served, the sides of the quad of every edge that is
	/// flipped, until no edge is left on the stack. \p isGood(e) tells whether edge e stays, \p
	/// flip(e) flips it in \p t and in what belongs to it.
	/// \param flips counts the flips of all calls
	/// \pre the stack is empty, queued[first] is 0; edges that are queued wait for a later call
	/// \throw NotConverged (FlipsUsedUp) beyond maxFlips()
	template<class IsGood, class Flip>
	void flipFrom(Edge first, const Triangulation& t, std::int64_t& flips, IsGood isGood, Flip flip)
	{
		edges.push_back(first);
		while (!edges.empty()) {
			const Edge e = edges.back();
			edges.pop_back();
			queued[e] = 0;
			if (isGood(e))
				continue;
			if (flips >= maxFlips(t.edgeCount()))
				throw NotConverged(NotConverged::FlipsUsedUp, static_cast<std::size_t>(flips));
			checkpointNowAndThen(static_cast<std::size_t>(flips));
			const auto quad = t.quad(e);
			flip(e);
			++flips;
			for (const Halfedge side : quad)
				if (!queued[side.edge()]) {
					queued[side.edge()] = 1;
					edges.push_back(side.edge());
				}
		}
	}
};

/// Flips of an edge ij of a packing that keep its discrete conformal class [Bobenko Lutz 2023]:
///
///             k                          k
///           /   \                      / | \             .
///     I_ki /     \ I_jk          I_ki /  |  \ I_jk
///         /  I_ij \                  /   |   \           .
///        i ------> j       ->       i  I_kl   j
///         \       /                  \   |   /
///     I_il \     / I_lj          I_il \  |  / I_lj
///           \   /                      \ | /
///             l                          l
///
/// A circle is a unit spacelike vector x of R^{2,1} with <x_i, x_j> = -I_ij. The two triangles
/// glued along ij lie on opposite sides of span(x_i, x_j), and the new inversive distance is -<x_k,
/// x_l>. The radii do not enter, and the background geometry enters only through the curvatures
/// kappa of the circles, so that everything stays defined where triangles break. D below is minus
/// the Gram determinant of a triangle's three vectors,
///
///   D_k = I_ij^2 + I_ki^2 + I_jk^2 + 2 I_ij I_ki I_jk - 1,    D_l likewise.
///
/// Needs I >= 1 (delta = I - 1 >= 0) on every edge.

/// Inversive distance, less one, of the other diagonal kl of the two triangles at edge \p e = ij:
///
///   I_kl = [I_ki I_il + I_jk I_lj + I_ij (I_ki I_lj + I_jk I_il) + sqrt(D_k D_l)] / (I_ij^2 - 1).
///
/// All terms are positive: nothing cancels. Where they are out of range the result is infinite or NaN.
/// \pre \p e is flippable and delta[e] > 0
double flippedDelta(const Triangulation& t, const EdgeArray<double>& delta, Edge e);

/// Whether edge \p e is locally weighted Delaunay for circles of curvature \p kappa: T_k + T_l >=
/// 0,
///
///   T_k = [kappa_i (I_ki + I_ij I_jk) + kappa_j (I_jk + I_ij I_ki) - kappa_k (I_ij^2 - 1)]
///         / sqrt(D_k),    T_l likewise.
///
/// Where both triangles exist this says that the weight of the edge in the Hessian is not negative.
/// Equality within rounding counts as Delaunay. Boundary edges and edges with the same triangle on
/// both sides are Delaunay.
bool isWeightedDelaunay(
	const Triangulation& t,
	const EdgeArray<double>& delta,
	const VertexArray<double>& kappa,
	Edge e);

/// Edges flipped, in order, each with its delta before the flip.
using FlipJournal = std::vector<std::pair<Edge, double>>;

/// Undoes every flip of \p journal, last first, bit for bit, and clears it.
void rewind(FlipJournal& journal, Triangulation& t, EdgeArray<double>& delta);

/// Flips edges until every one is weighted Delaunay, in an order that depends on the input alone
/// and not on the number of \p threads, which test the edges beforehand. The flips are appended to
/// \p journal; \p queue is work space.
/// \return number of flips
/// \throw NotConverged (FlipsUsedUp) where rounding keeps the flips from ending
int makeWeightedDelaunay(
	Triangulation& t,
	EdgeArray<double>& delta,
	const VertexArray<double>& kappa,
	FlipJournal& journal,
	DelaunayQueue& queue,
	int threads = 1);

} // namespace ricci

#endif
