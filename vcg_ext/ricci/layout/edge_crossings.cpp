// SPDX-License-Identifier: GPL-3.0-or-later
#include "edge_crossings.h"

#include "../numbers.h"
#include "unfold.h"

namespace ricci {

namespace {

/// Position of a crossing counted from the origin of its edge's even halfedge.
int fromEven(const NormalCoordinates::Crossing& x, int count)
{
	return x.halfedge % 2 == 0 ? x.position : count - 1 - x.position;
}

} // namespace

EdgeCrossings::EdgeCrossings(const FlippedSurface& surface, const OverlayListener& listener) :
		inputOnStart(*surface.input), endOnStart(*surface.end), m_surface(surface),
		m_start(*surface.start)
{
	for (int e : *surface.startFlips)
		inputOnStart.flip(e);
	for (auto e = surface.flowFlips->rbegin(); e != surface.flowFlips->rend(); ++e)
		endOnStart.unflip(*e);
	const int n = m_start.edgeCount();
	std::size_t count = 0;
	for (int e = 0; e < n; ++e)
		count += at(inputOnStart.crossings(e)) + at(endOnStart.crossings(e));
	listener(0.0, count);

	NormalCoordinates startOnEnd(m_start);
	for (int e : *surface.flowFlips)
		startOnEnd.flip(e);
	inputCurves = inputOnStart.trace();
	endCurves = endOnStart.trace();
	startCurves = startOnEnd.trace();

	firstInput.assign(at(n) + 1, 0);
	firstEnd.assign(at(n) + 1, 0);
	for (int e = 0; e < n; ++e) {
		firstInput[at(e) + 1] = firstInput[at(e)] + inputOnStart.crossings(e);
		firstEnd[at(e) + 1] = firstEnd[at(e)] + endOnStart.crossings(e);
	}
	inputPoints.resize(at(firstInput.back()));
	endPoints.resize(at(firstEnd.back()));
	placeInputCrossings();
	placeEndCrossings();
}

int EdgeCrossings::inputSlot(const NormalCoordinates::Crossing& x) const
{
	const int e = Triangulation::edge(x.halfedge);
	return firstInput[at(e)] + fromEven(x, inputOnStart.crossings(e));
}

int EdgeCrossings::endSlot(const NormalCoordinates::Crossing& x) const
{
	const int e = Triangulation::edge(x.halfedge);
	return firstEnd[at(e)] + fromEven(x, endOnStart.crossings(e));
}

/// Unfolds the start triangles along each input edge; the edge is straight there.
void EdgeCrossings::placeInputCrossings()
{
	Strip strip;
	for (int e = 0; e < m_surface.input->edgeCount(); ++e) {
		const Curve& curve = inputCurves[at(e)];
		if (curve.crossings.empty())
			continue;
		unfold(m_start, *m_surface.startLengths, curve, strip);
		const Point2 last = strip.end;
		const double size2 = last[0] * last[0] + last[1] * last[1];
		double below = 0.0;
		for (std::size_t i = 0; i < strip.sides.size(); ++i) {
			const Point2 &p = strip.sides[i].from, &q = strip.sides[i].to;
			const double dp = p[0] * last[1] - p[1] * last[0], dq = q[0] * last[1] - q[1] * last[0];
			const double t = keepInside(dp / (dp - dq));
			const Point2 x{mix(p[0], q[0], t), mix(p[1], q[1], t)};
			double s = keepInside((x[0] * last[0] + x[1] * last[1]) / size2);
			s = std::max(s, below);
			below = s;
			const int halfedge = curve.crossings[i].halfedge;
			inputPoints[at(inputSlot(curve.crossings[i]))] = {
				e, s, halfedge % 2 == 0 ? t : 1.0 - t};
		}
	}
}

/// Inversive distances of the start triangle on the left of h = ij, apex k.
EdgeCrossings::StartTriangle EdgeCrossings::startTriangle(int h) const
{
	const auto& d = *m_surface.startDelta;
	StartTriangle x;
	x.ij = 1.0 + d[at(Triangulation::edge(h))];
	x.jk = 1.0 + d[at(Triangulation::edge(m_start.next(h)))];
	x.ki = 1.0 + d[at(Triangulation::edge(m_start.previous(h)))];
	x.rootD = std::sqrt(x.ij * x.ij + x.jk * x.jk + x.ki * x.ki + 2.0 * x.ij * x.jk * x.ki - 1.0);
	return x;
}

/// Value at the apex of the triangle across h = ij of a linear function on R^{2,1} that is
/// fi, fj, fk at i, j and the apex k on the left of h:
/// rootD_l x_k + rootD_k x_l = M_i x_i + M_j x_j.
double EdgeCrossings::across(int h, double fi, double fj, double fk) const
{
	const StartTriangle a = startTriangle(h), b = startTriangle(Triangulation::twin(h));
	const double d = (*m_surface.startDelta)[at(Triangulation::edge(h))];
	const double c2 = d * (d + 2.0);
	const double pi = b.rootD * a.ki + a.rootD * b.jk; // pairs with x_i: I_ik, I_il
	const double pj = b.rootD * a.jk + a.rootD * b.ki;
	const double mi = (pi + a.ij * pj) / c2, mj = (pj + a.ij * pi) / c2;
	return (mi * fi + mj * fj - b.rootD * fk) / a.rootD;
}

/// The end edges on the start triangulation: along the strip of start triangles of an end edge
/// ab, linear functions on R^{2,1} are carried from triangle to triangle, each a triple of
/// values at the present corners. The one that vanishes at a and b gives the crossings.
void EdgeCrossings::placeEndCrossings()
{
	struct Values
	{
		double from, to; // at the ends of the crossed halfedge
	};
	std::vector<Values> first, second, atA;
	for (int e = 0; e < m_surface.end->edgeCount(); ++e) {
		const Curve& curve = endCurves[at(e)];
		const int n = static_cast<int>(curve.crossings.size());
		if (n == 0)
			continue;
		// first: 0 at a, (1, 0) on the first side; second: (0, 1); atA: 1 at a, (0, 0).
		first.assign(1, {1, 0});
		second.assign(1, {0, 1});
		atA.assign(1, {0, 0});
		double apex[3] = {0, 0, 1};
		for (int i = 0; i < n; ++i) {
			const int x = curve.crossings[at(i)].halfedge, y = Triangulation::twin(x);
			double next[3];
			std::vector<Values>* functions[3] = {&first, &second, &atA};
			const bool fromStays =
				i + 1 < n && curve.crossings[at(i) + 1].halfedge == m_start.next(y);
			for (int k = 0; k < 3; ++k) {
				const Values v = functions[k]->back();
				next[k] = across(x, v.from, v.to, apex[k]);
				if (i + 1 == n)
					continue;
				if (fromStays) { // the triangle's third corner is the old "to"
					functions[k]->push_back({v.from, next[k]});
					apex[k] = v.to;
				}
				else {
					functions[k]->push_back({next[k], v.to});
					apex[k] = v.from;
				}
			}
			if (i + 1 == n)
				std::copy(next, next + 3, apex);
		}
		// l = apex[1] first - apex[0] second vanishes at a and b; apex holds the values at b.
		double below = 0.0;
		for (int i = 0; i < n; ++i) {
			const double from = apex[1] * first[at(i)].from - apex[0] * second[at(i)].from;
			const double to = apex[1] * first[at(i)].to - apex[0] * second[at(i)].to;
			// y = |to| x_from + |from| x_to, both weights positive.
			double wf = std::abs(to), wt = std::abs(from);
			if (!(wf > 0.0) || !(wt > 0.0) || !std::isfinite(wf) || !std::isfinite(wt) ||
				from * to > 0.0)
				wf = wt = 1.0;
			const double scale = 1.0 / (wf + wt);
			wf *= scale, wt *= scale;
			// y = wa x_a + wb x_b: evaluate atA and the function that is 1 on the side's sum.
			const double ya = wf * atA[at(i)].from + wt * atA[at(i)].to;
			const double y1 = wf * first[at(i)].from + wt * first[at(i)].to;
			const double y2 = wf * second[at(i)].from + wt * second[at(i)].to;
			// first + second is 0 at a and apex[0] + apex[1] at b.
			double wb = (y1 + y2) / (apex[0] + apex[1]);
			double wa = ya - wb * apex[2];
			if (!(wb > 0.0) || !(wa > 0.0) || !std::isfinite(wa) || !std::isfinite(wb)) {
				const double share = static_cast<double>(i + 1) / (n + 1);
				wa = 1.0 - share, wb = share;
			}
			// Order along the end edge, against rounding.
			if (wb / (wa + wb) < below) {
				const double sum = wa + wb;
				wb = below * sum, wa = sum - wb;
			}
			below = wb / (wa + wb);
			const int halfedge = curve.crossings[at(i)].halfedge;
			HomogeneousPoint p;
			p.curve = e;
			p.onStart =
				halfedge % 2 == 0 ? std::array<double, 2>{wf, wt} : std::array<double, 2>{wt, wf};
			p.onEnd = {wa, wb};
			endPoints[at(endSlot(curve.crossings[at(i)]))] = p;
		}
	}
}

} // namespace ricci
