// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformal_flip.h"

#include "../numbers.h"
#include "../parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace ricci {

namespace {

/// An edge counts as Delaunay while T_k + T_l is above minus this share of its
/// terms' magnitude.
constexpr double kTieTolerance = 1e-15;

/// The flips end by themselves; this bounds them where values run out of range.
constexpr std::int64_t kMostFlipsPerEdge = 1000;

/// Inversive distances of the triangle on the left of halfedge h = ij, apex k.
struct Apex
{
	double ik, jk;
	double rootD; ///< sqrt(I_ij^2 + I_ik^2 + I_jk^2 + 2 I_ij I_ik I_jk - 1)

	Apex(const Triangulation& t, const std::vector<double>& delta, int h)
	{
		const double c = 1.0 + delta[at(Triangulation::edge(h))];
		jk = 1.0 + delta[at(Triangulation::edge(t.next(h)))];
		ik = 1.0 + delta[at(Triangulation::edge(t.previous(h)))];
		rootD = std::sqrt(c * c + ik * ik + jk * jk + 2.0 * c * ik * jk - 1.0);
	}
};

} // namespace

double flippedDelta(const Triangulation& t, const std::vector<double>& delta, int e)
{
	const double d = delta[at(e)], c = 1.0 + d, c2 = d * (d + 2.0);
	const Apex k(t, delta, 2 * e);
	const Apex reversed(t, delta, 2 * e + 1); // its i is our j
	const double il = reversed.jk, jl = reversed.ik;
	const double numerator =
		k.ik * il + k.jk * jl + c * (k.ik * jl + k.jk * il) + k.rootD * reversed.rootD;
	return std::max(0.0, (numerator - c2) / c2);
}

bool isWeightedDelaunay(
	const Triangulation& t,
	const std::vector<double>& delta,
	const std::vector<double>& kappa,
	int e)
{
	if (!t.isFlippable(e))
		return true;
	const double d = delta[at(e)], c = 1.0 + d, c2 = d * (d + 2.0);
	double positive = 0.0, negative = 0.0;
	for (int h : {2 * e, 2 * e + 1}) {
		const Apex k(t, delta, h);
		const double ki = kappa[at(t.origin(h))], kj = kappa[at(t.target(h))];
		const double kk = kappa[at(t.origin(t.previous(h)))];
		positive += (ki * (k.ik + c * k.jk) + kj * (k.jk + c * k.ik)) / k.rootD;
		negative += kk * c2 / k.rootD;
	}
	// Written so that values out of range count as Delaunay and end the flips.
	return !(positive - negative < -kTieTolerance * (positive + negative));
}

void FlipJournal::rewind(Triangulation& t, std::vector<double>& delta)
{
	for (auto flip = m_flips.rbegin(); flip != m_flips.rend(); ++flip) {
		t.unflip(flip->edge);
		delta[at(flip->edge)] = flip->delta;
	}
	m_flips.clear();
}

int makeWeightedDelaunay(
	Triangulation& t,
	std::vector<double>& delta,
	const std::vector<double>& kappa,
	FlipJournal& journal,
	DelaunayQueue& queue,
	int threads)
{
	const int edgeCount = t.edgeCount();
	auto& edges = queue.edges;
	auto& queued = queue.queued;
	edges.clear();
	// Most edges are good already. Those that are not wait for their turn below;
	// one that a flip makes bad is queued by that flip.
	queued.resize(at(edgeCount));
	inParallel(edgeCount, threads, [&](int first, int last) {
		for (int e = first; e < last; ++e)
			queued[at(e)] = !isWeightedDelaunay(t, delta, kappa, e);
	});
	int flips = 0;
	const std::int64_t mostFlips = kMostFlipsPerEdge * edgeCount;
	const auto visit = [&](int e) {
		if (isWeightedDelaunay(t, delta, kappa, e) || flips >= mostFlips)
			return;
		const std::array<int, 4> quad{
			t.next(2 * e), t.previous(2 * e), t.next(2 * e + 1), t.previous(2 * e + 1)};
		journal.record(e, delta[at(e)]);
		delta[at(e)] = flippedDelta(t, delta, e);
		t.flip(e);
		++flips;
		for (int h : quad) {
			const int side = Triangulation::edge(h);
			if (!queued[at(side)]) {
				queued[at(side)] = 1;
				edges.push_back(side);
			}
		}
	};
	for (int e = 0; e < edgeCount; ++e) {
		if (!queued[at(e)])
			continue;
		queued[at(e)] = 0;
		visit(e);
		while (!edges.empty()) {
			const int side = edges.back();
			edges.pop_back();
			queued[at(side)] = 0;
			visit(side);
		}
	}
	return flips;
}

} // namespace ricci
