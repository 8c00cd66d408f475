// SPDX-License-Identifier: GPL-3.0-or-later
#include "edge_crossings.h"

#include "../metric/unfold.h"

#include <algorithm>
#include <cmath>

namespace ricci {

namespace {

/// Position of a crossing counted from the origin of its edge's halfedge().
int fromEdge(const NormalCoordinates::Crossing& x, int count)
{
	return x.halfedge.isFirst() ? x.position : count - 1 - x.position;
}

bool isPositive(double x)
{
	return x > 0.0 && std::isfinite(x);
}

} // namespace

EdgeCrossings::EdgeCrossings(const FlowResult& flow, const OverlayListener& listener) :
		inputOnStart(flow.history.input), endOnStart(flow.metric->triangulation()), m_flow(flow),
		m_start(flow.history.start.triangulation)
{
	const std::vector<Edge>& flowFlips = flow.history.flowFlips;
	for (const Edge e : flow.history.startFlips)
		inputOnStart.flip(e);
	for (auto e = flowFlips.rbegin(); e != flowFlips.rend(); ++e)
		endOnStart.unflip(*e);
	std::size_t count = 0;
	for (const Edge e : m_start.edges())
		count += static_cast<std::size_t>(inputOnStart.crossings(e)) +
				 static_cast<std::size_t>(endOnStart.crossings(e));
	listener(0.0, count);

	NormalCoordinates startOnEnd(m_start);
	for (const Edge e : flowFlips)
		startOnEnd.flip(e);
	inputCurves = inputOnStart.trace();
	endCurves = endOnStart.trace();
	startCurves = startOnEnd.trace();

	inputOn = {m_start.edges(), [&](Edge e) { return inputOnStart.crossings(e); }};
	endOn = {m_start.edges(), [&](Edge e) { return endOnStart.crossings(e); }};
	inputCrossings.resize(inputOn.total());
	endCrossings.resize(endOn.total());
	placeInputCrossings();
	placeEndCrossings();
}

int EdgeCrossings::inputNumber(const NormalCoordinates::Crossing& x) const
{
	const Edge e = x.halfedge.edge();
	return inputOn.first(e) + fromEdge(x, inputOn.size(e));
}

int EdgeCrossings::endNumber(const NormalCoordinates::Crossing& x) const
{
	const Edge e = x.halfedge.edge();
	return endOn.first(e) + fromEdge(x, endOn.size(e));
}

/// Unfolds the start triangles along each input edge; the edge is straight there.
void EdgeCrossings::placeInputCrossings()
{
	Strip strip;
	for (const Edge e : inputCurves.indices()) {
		const Curve& curve = inputCurves[e];
		if (curve.crossings.empty())
			continue;
		unfold(m_start, m_flow.history.start.lengths, curve, strip);
		const Point2 last = strip.end;
		const double size2 = last[0] * last[0] + last[1] * last[1];
		double before = 0.0; // share of the crossing before on the input edge
		for (std::size_t i = 0; i < strip.sides.size(); ++i) {
			const Point2 &p = strip.sides[i].from, &q = strip.sides[i].to;
			const double dp = p[0] * last[1] - p[1] * last[0], dq = q[0] * last[1] - q[1] * last[0];
			const double t = keepInside(dp / (dp - dq));
			const Point2 x{mix(p[0], q[0], t), mix(p[1], q[1], t)};
			double s = keepInside((x[0] * last[0] + x[1] * last[1]) / size2);
			s = std::max(s, before);
			before = s;
			inputCrossings[inputNumber(curve.crossings[i])] = {
				e, s, curve.crossings[i].halfedge.isFirst() ? t : 1.0 - t};
		}
	}
}

/// The start triangle ijk on the left of h = ij.
EdgeCrossings::StartTriangle EdgeCrossings::startTriangle(Halfedge h) const
{
	const EdgeArray<double>& delta = m_flow.history.startDelta;
	StartTriangle x;
	x.ij = 1.0 + delta[h.edge()];
	x.jk = 1.0 + delta[m_start.next(h).edge()];
	x.ki = 1.0 + delta[m_start.previous(h).edge()];
	x.rootD = std::sqrt(x.ij * x.ij + x.jk * x.jk + x.ki * x.ki + 2.0 * x.ij * x.jk * x.ki - 1.0);
	return x;
}

/// Value at l of a linear function on R^{2,1} that is fi, fj, fk at the vectors x_i, x_j, x_k of the
/// corners of the triangle on the left of h = ij; l is the apex on the other side.
///
///          k
///        /   \         D_k, D_l: of the triangles with apex k and l
///       i --> j        rootD_l x_k + rootD_k x_l = M_i x_i + M_j x_j
///        \   /         c2 = I_ij^2 - 1
///          l
///
/// M_i = (P_i + I_ij P_j) / c2, P_i = rootD_l I_ik + rootD_k I_il, and likewise with i and j
/// exchanged: the products of both sides with x_i and x_j, where <x_i, x_k> = -I_ik.
double EdgeCrossings::across(Halfedge h, double fi, double fj, double fk) const
{
	const StartTriangle a = startTriangle(h), b = startTriangle(h.twin());
	const double d = m_flow.history.startDelta[h.edge()];
	const double c2 = d * (d + 2.0);
	const double pi = b.rootD * a.ki + a.rootD * b.jk; // b has i and j exchanged
	const double pj = b.rootD * a.jk + a.rootD * b.ki;
	const double mi = (pi + a.ij * pj) / c2, mj = (pj + a.ij * pi) / c2;
	return (mi * fi + mj * fj - b.rootD * fk) / a.rootD;
}

/// Carries three functions from triangle to triangle, each as values at the triangle's corners. In
/// the first triangle, at a and at the ends of the side opposite to it, they are 0, 1, 0; 0, 0, 1;
/// and 1, 0, 0.
void EdgeCrossings::carry(const Curve& curve, CarriedFunctions& functions) const
{
	functions.values[0].assign(1, {1, 0});
	functions.values[1].assign(1, {0, 1});
	functions.values[2].assign(1, {0, 0});
	std::array<double, 3> apex{0, 0, 1}; // the corner that the next crossed side leaves behind
	for (std::size_t i = 0; i < curve.crossings.size(); ++i) {
		const Halfedge x = curve.crossings[i].halfedge;
		const bool isLast = i + 1 == curve.crossings.size();
		// Whether the next crossed side has the origin of x in common with x, or its target.
		const bool fromStays = !isLast && curve.crossings[i + 1].halfedge == m_start.next(x.twin());
		for (std::size_t k = 0; k < 3; ++k) {
			const Values v = functions.values[k].back();
			const double next = across(x, v.from, v.to, apex[k]);
			if (isLast)
				functions.atB[k] = next;
			else if (fromStays) {
				functions.values[k].push_back({v.from, next});
				apex[k] = v.to;
			}
			else {
				functions.values[k].push_back({next, v.to});
				apex[k] = v.from;
			}
		}
	}
}

/// The end edge ab lies in the plane of R^{2,1} through a and b: the crossings are where the linear
/// function that vanishes on it does.
void EdgeCrossings::placeEndCrossings()
{
	CarriedFunctions functions;
	const auto& first = functions.values[0];
	const auto& second = functions.values[1];
	const auto& atA = functions.values[2];
	const std::array<double, 3>& atB = functions.atB;
	for (const Edge e : endCurves.indices()) {
		const Curve& curve = endCurves[e];
		const std::size_t n = curve.crossings.size();
		if (n == 0)
			continue;
		carry(curve, functions);
		double before = 0.0; // share of the crossing before on the end edge
		for (std::size_t i = 0; i < n; ++i) {
			// atB[1] first - atB[0] second vanishes at a and at b.
			const double from = atB[1] * first[i].from - atB[0] * second[i].from;
			const double to = atB[1] * first[i].to - atB[0] * second[i].to;
			// The crossing is |to| x_from + |from| x_to, both weights positive.
			EdgeWeights onStart{std::abs(to), std::abs(from)};
			if (!isPositive(onStart.from) || !isPositive(onStart.to) || from * to > 0.0)
				onStart = {1.0, 1.0};
			const double scale = 1.0 / onStart.sum();
			onStart.from *= scale;
			onStart.to *= scale;
			const auto valueOf = [&](const Values& v) {
				return onStart.from * v.from + onStart.to * v.to;
			};
			// It also is onEnd.from x_a + onEnd.to x_b: first + second is 0 at a, and the third
			// function is 1 there.
			EdgeWeights onEnd;
			onEnd.to = (valueOf(first[i]) + valueOf(second[i])) / (atB[0] + atB[1]);
			onEnd.from = valueOf(atA[i]) - onEnd.to * atB[2];
			if (!isPositive(onEnd.from) || !isPositive(onEnd.to)) {
				const double share = static_cast<double>(i + 1) / static_cast<double>(n + 1);
				onEnd = {1.0 - share, share};
			}
			// Order along the end edge, against rounding.
			if (onEnd.affine() < before) {
				const double sum = onEnd.sum();
				onEnd.to = before * sum;
				onEnd.from = sum - onEnd.to;
			}
			before = onEnd.affine();
			endCrossings[endNumber(curve.crossings[i])] = {
				e, curve.crossings[i].halfedge.isFirst() ? onStart : onStart.reversed(), onEnd};
		}
	}
}

} // namespace ricci
