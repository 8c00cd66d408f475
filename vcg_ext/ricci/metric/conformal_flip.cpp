// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformal_flip.h"

#include "../base/parallel.h"
#include "../base/tolerances.h"

#include <cmath>

namespace ricci {

namespace {

/// Inversive distances of an edge ij and of the sides of its quad, as in the figure of the header.
struct QuadDistances
{
	double ij, jk, ki, il, lj;
	double ij2Less1; ///< I_ij^2 - 1

	QuadDistances(const Triangulation& t, const EdgeArray<double>& delta, Edge e)
	{
		const double d = delta[e];
		const auto quad = t.quad(e);
		ij = 1.0 + d;
		ij2Less1 = d * (d + 2.0);
		jk = 1.0 + delta[quad[0].edge()];
		ki = 1.0 + delta[quad[1].edge()];
		il = 1.0 + delta[quad[2].edge()];
		lj = 1.0 + delta[quad[3].edge()];
	}

	double rootDk() const { return rootD(ki, jk); }
	double rootDl() const { return rootD(lj, il); }

private:
	double rootD(double a, double b) const
	{
		return std::sqrt(ij * ij + a * a + b * b + 2.0 * ij * a * b - 1.0);
	}
};

} // namespace

double flippedDelta(const Triangulation& t, const EdgeArray<double>& delta, Edge e)
{
	const QuadDistances q(t, delta, e);
	const double numerator =
		q.ki * q.il + q.jk * q.lj + q.ij * (q.ki * q.lj + q.jk * q.il) + q.rootDk() * q.rootDl();
	const double flipped = (numerator - q.ij2Less1) / q.ij2Less1;
	return flipped < 0.0 ? 0.0 : flipped; // a NaN stays one: 0 is that of tangent circles
}

bool isWeightedDelaunay(
	const Triangulation& t,
	const EdgeArray<double>& delta,
	const VertexArray<double>& kappa,
	Edge e)
{
	if (!t.isFlippable(e))
		return true;
	const QuadDistances q(t, delta, e);
	const Halfedge h = e.halfedge();
	const double i = kappa[t.origin(h)], j = kappa[t.target(h)];
	const double k = kappa[t.apex(h)], l = kappa[t.apex(h.twin())];
	const double rootDk = q.rootDk(), rootDl = q.rootDl();
	const double positive = (i * (q.ki + q.ij * q.jk) + j * (q.jk + q.ij * q.ki)) / rootDk +
							(j * (q.lj + q.ij * q.il) + i * (q.il + q.ij * q.lj)) / rootDl;
	const double negative = k * q.ij2Less1 / rootDk + l * q.ij2Less1 / rootDl;
	// Written so that values out of range count as Delaunay and end the flips.
	return !(positive - negative < -kFewRoundings * (positive + negative));
}

void rewind(FlipJournal& journal, Triangulation& t, EdgeArray<double>& delta)
{
	for (; !journal.empty(); journal.pop_back()) {
		const auto [e, before] = journal.back();
		t.unflip(e);
		delta[e] = before;
	}
}

int makeWeightedDelaunay(
	Triangulation& t,
	EdgeArray<double>& delta,
	const VertexArray<double>& kappa,
	FlipJournal& journal,
	DelaunayQueue& queue,
	int threads)
{
	const auto isGood = [&](Edge e) { return isWeightedDelaunay(t, delta, kappa, e); };
	const auto flip = [&](Edge e) {
		journal.emplace_back(e, delta[e]);
		delta[e] = flippedDelta(t, delta, e);
		t.flip(e);
	};
	// Most edges are good already. Those that are not wait for their turn below; one that a flip
	// makes bad is queued by that flip.
	queue.edges.clear();
	queue.queued.resize(t.edgeCount());
	inParallel(t.edgeCount(), threads, [&](int first, int last) {
		for (const Edge e : IndexRange<Edge>(first, last))
			queue.queued[e] = !isGood(e);
	});
	std::int64_t flips = 0;
	for (const Edge e : t.edges()) {
		if (!queue.queued[e])
			continue;
		queue.queued[e] = 0;
		queue.flipFrom(e, t, flips, isGood, flip);
	}
	return static_cast<int>(flips);
}

} // namespace ricci
