// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONFORMAL_FLIP_H
#define RICCI_CONFORMAL_FLIP_H

#include "circle_packing.h"

#include <vector>

namespace ricci {

/// Flips of an edge ij of a packing that keep its discrete conformal class: a
/// circle is a unit spacelike vector x of R^{2,1}, <x_i, x_j> = -I_ij, two
/// triangles glued along ij lie on opposite sides of span(x_i, x_j), and the
/// new inversive distance is -<x_k, x_l>. Nothing here depends on the radii,
/// and the background geometry enters only through the curvatures kappa of the
/// circles, so that everything stays defined where triangles break. Needs I >=
/// 1 (delta >= 0).

/// Inversive distance, less one, of the other diagonal kl of the two triangles
/// at edge \p e = ij: I_kl = [I_ik I_il + I_jk I_jl + I_ij (I_ik I_jl + I_jk
/// I_il) + sqrt(D_k D_l)] / (I_ij^2 - 1). All terms are positive. \p e must be
/// flippable and delta[e] > 0.
double flippedDelta(const Triangulation& t, const std::vector<double>& delta, int e);

/// Whether edge \p e is locally weighted Delaunay for circles of curvature \p
/// kappa: T_k + T_l >= 0, T_k = [kappa_i (I_ik + I_ij I_jk) + kappa_j (I_jk +
/// I_ij I_ik) - kappa_k (I_ij^2 - 1)] / sqrt(D_k). Once all triangles exist
/// this says that the weight of the edge in the Hessian is not negative.
/// Equality within rounding counts as Delaunay; boundary edges and edges with
/// the same triangle on both sides are Delaunay.
bool isWeightedDelaunay(
	const Triangulation& t,
	const std::vector<double>& delta,
	const std::vector<double>& kappa,
	int e);

/// Edges flipped, in order, with what is needed to go back.
class FlipJournal
{
public:
	void clear() { m_flips.clear(); }
	void record(int e, double delta) { m_flips.push_back({e, delta}); }
	int size() const { return static_cast<int>(m_flips.size()); }

	/// Appends the recorded edges to \p edges, in order.
	void appendTo(std::vector<int>& edges) const
	{
		for (const Flip& flip : m_flips)
			edges.push_back(flip.edge);
	}

	/// Undoes every recorded flip, last first, bit for bit, and clears the
	/// journal.
	void rewind(Triangulation& t, std::vector<double>& delta);

private:
	struct Flip
	{
		int edge;
		double delta;
	};
	std::vector<Flip> m_flips;
};

/// Reusable work space of makeWeightedDelaunay().
struct DelaunayQueue
{
	std::vector<int> edges;
	std::vector<char> queued;
};

/// Flips edges until every one is weighted Delaunay, in an order that depends
/// on the input alone and not on the number of \p threads, which test the edges
/// beforehand. \return number of flips
int makeWeightedDelaunay(
	Triangulation& t,
	std::vector<double>& delta,
	const std::vector<double>& kappa,
	FlipJournal& journal,
	DelaunayQueue& queue,
	int threads = 1);

} // namespace ricci

#endif
