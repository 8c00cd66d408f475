// SPDX-License-Identifier: GPL-3.0-or-later
#include "edge_crossings.h"

#include "../base/task.h"
#include "../base/tolerances.h"
#include "../numerics/double_double.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ricci {

namespace {

/// Edges that are crossed more often than so many times for each face are told: a refinement mostly has a few pieces for
/// each, that of a fan of n triangles may have n.
constexpr std::size_t kManyCrossings = 16;

/// Position of a crossing counted from the origin of its edge's halfedge().
int fromEdge(const NormalCoordinates::Crossing& x, int count)
{
	return x.halfedge.isFirst() ? x.position : count - 1 - x.position;
}

bool isPositive(double x)
{
	return x > 0.0 && std::isfinite(x);
}

/// Three linear functions carried along an end edge ab from one start triangle to the next, each as values
/// at the triangle's corners. In the first triangle, at a and at the ends of the side opposite to it, they
/// are 0, 1, 0; 0, 0, 1; and 1, 0, 0.
template<class Real>
class CarriedFunctions
{
public:
	/// Of one function, at the origin of a start halfedge and at its target.
	using Values = std::array<Real, 2>;

	CarriedFunctions(
		const Triangulation& start,
		const EdgeArray<double>& delta,
		const NormalCoordinates::Curve& curve) :
			m_start(start),
			m_delta(delta)
	{
		values[0].assign(1, {Real(1.0), Real(0.0)});
		values[1].assign(1, {Real(0.0), Real(1.0)});
		values[2].assign(1, {Real(0.0), Real(0.0)});
		// At the corner that the next crossed side leaves behind.
		std::array<Real, 3> apex{Real(0.0), Real(0.0), Real(1.0)};
		for (std::size_t i = 0; i < curve.crossings.size(); ++i) {
			const Halfedge x = curve.crossings[i].halfedge;
			const bool isLast = i + 1 == curve.crossings.size();
			// Whether the next crossed side has the origin of x in common with x, or its target.
			const bool fromStays =
				!isLast && curve.crossings[i + 1].halfedge == m_start.next(x.twin());
			const auto valueBeyond = across(x);
			for (std::size_t k = 0; k < 3; ++k) {
				const auto [from, to] = values[k].back();
				const Real next = valueBeyond(from, to, apex[k]);
				if (isLast)
					atB[k] = next;
				else if (fromStays) {
					values[k].push_back({from, next});
					apex[k] = to;
				}
				else {
					values[k].push_back({next, to});
					apex[k] = from;
				}
			}
		}
	}

	std::array<std::vector<Values>, 3> values; ///< [function][crossing] of the start halfedge
	std::array<Real, 3> atB{};                 ///< [function]

private:
	/// How to find the value at l of a linear function on R^{2,1} by those at the corners of a start
	/// triangle ijk; l is the apex on the other side of ij = \p h.
	///
	///          k
	///        /   \         D_k, D_l: of the triangles with apex k and l
	///       i --> j        rootD_l x_k + rootD_k x_l = M_i x_i + M_j x_j
	///        \   /         c2 = I_ij^2 - 1
	///          l
	///
	/// M_i = (P_i + I_ij P_j) / c2, P_i = rootD_l I_ik + rootD_k I_il, and likewise with i and j
	/// exchanged: the products of both sides with x_i and x_j, where <x_i, x_k> = -I_ik. rootD is the root of minus
	/// the Gram determinant of the three vectors of a triangle.
	/// \return value(fi, fj, fk)
	auto across(Halfedge h) const
	{
		const auto inversive = [&](Halfedge side) {
			return Real(1.0) + Real(m_delta[side.edge()]);
		};
		const auto rootD = [](const Real& x, const Real& y, const Real& z) {
			using std::sqrt;
			return sqrt(x * x + y * y + z * z + Real(2.0) * x * y * z - Real(1.0));
		};
		const Real ij = inversive(h);
		const Real jk = inversive(m_start.next(h)), ki = inversive(m_start.previous(h));
		const Real il = inversive(m_start.next(h.twin())),
				   lj = inversive(m_start.previous(h.twin()));
		const Real rootK = rootD(ij, jk, ki), rootL = rootD(ij, il, lj);
		const Real delta(m_delta[h.edge()]), c2 = delta * (delta + Real(2.0));
		const Real pi = rootL * ki + rootK * il, pj = rootL * jk + rootK * lj;
		const Real mi = (pi + ij * pj) / c2, mj = (pj + ij * pi) / c2;
		return [=](Real fi, Real fj, Real fk) { return (mi * fi + mj * fj - rootL * fk) / rootK; };
	}

	const Triangulation& m_start;
	const EdgeArray<double>& m_delta;
};

} // namespace

EdgeCrossings::EdgeCrossings(const Triangulation& inputTriangles, const FlowResult& flow) :
		input(inputTriangles), inputOnStart(input), endOnStart(flow.metric->triangulation()),
		m_flow(flow), m_start(flow.start.mesh.triangulation),
		m_delta(inversiveDistancesLessOne(m_start, flow.start.mesh.lengths, flow.start.radii))
{
	const std::vector<Edge>& flowFlips = flow.flips;
	for (const Edge e : flow.start.flips)
		inputOnStart.flip(e);
	for (auto e = flowFlips.rbegin(); e != flowFlips.rend(); ++e)
		endOnStart.unflip(*e);
	std::size_t count = 0;
	for (const Edge e : m_start.edges())
		count += static_cast<std::size_t>(inputOnStart.crossings(e)) +
				 static_cast<std::size_t>(endOnStart.crossings(e));
	checkpoint();
	requireOverlayMemory(count, true);
	const auto faces = static_cast<std::size_t>(m_start.faceCount());
	if (count > kManyCrossings * faces)
		logLine(
			"The common refinement will have more than " + std::to_string(faces + count) +
			" pieces for " + std::to_string(faces) + " faces.");

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
	std::vector<std::array<Point2, 2>> crossed;
	for (const Edge e : inputCurves.indices()) {
		const Curve& curve = inputCurves[e];
		if (curve.crossings.empty())
			continue;
		const Point2 last = unfold(m_start, m_flow.start.mesh.lengths, curve, crossed);
		const double size2 = dot(last, last);
		double before = 0.0; // share of the crossing before on the input edge
		for (std::size_t i = 0; i < crossed.size(); ++i) {
			const auto& [p, q] = crossed[i];
			const double dp = cross(p, last), dq = cross(q, last);
			const double t = keepInside(dp / (dp - dq));
			const Point2 x{mix(p[0], q[0], t), mix(p[1], q[1], t)};
			double s = keepInside(dot(x, last) / size2);
			s = std::max(s, before);
			before = s;
			inputCrossings[inputNumber(curve.crossings[i])] = {
				e, s, curve.crossings[i].halfedge.isFirst() ? t : 1.0 - t};
		}
	}
}

/// The end edge ab lies in the plane of R^{2,1} through a and b: the crossings are where the linear
/// function that vanishes on it does. An edge that winds round the surface, or passes needles, loses
/// digits on its way.
void EdgeCrossings::placeEndCrossings()
{
	for (const Edge e : endCurves.indices())
		if (!endCurves[e].crossings.empty() && !placeOnEndEdge<double>(e))
			placeOnEndEdge<DoubleDouble>(e);
}

/// \return whether the places have digits enough
template<class Real>
bool EdgeCrossings::placeOnEndEdge(Edge e)
{
	using std::abs;
	const Curve& curve = endCurves[e];
	const std::size_t n = curve.crossings.size();
	using Values = typename CarriedFunctions<Real>::Values;
	const CarriedFunctions<Real> functions(m_start, m_delta, curve);
	const auto& first = functions.values[0];
	const auto& second = functions.values[1];
	const auto& atA = functions.values[2];
	const std::array<Real, 3>& atB = functions.atB;
	bool isExact = true;
	double before = 0.0; // share of the crossing before on the end edge
	for (std::size_t i = 0; i < n; ++i) {
		// atB[1] first - atB[0] second vanishes at a and at b.
		const auto vanishing = [&](Real f, Real g) { return atB[1] * f - atB[0] * g; };
		const auto size = [&](Real f, Real g) { return abs(atB[1] * f) + abs(atB[0] * g); };
		const Real from = vanishing(first[i][0], second[i][0]);
		const Real to = vanishing(first[i][1], second[i][1]);
		const Real terms = size(first[i][0], second[i][0]) + size(first[i][1], second[i][1]);
		// Less has lost the digits that places need.
		isExact = isExact && abs(from) + abs(to) >= Real(kSmall) * terms;
		// The crossing is |to| x_from + |from| x_to, both weights positive.
		Values weight{abs(to), abs(from)};
		if (!isPositive(double(weight[0])) || !isPositive(double(weight[1])) ||
			double(from) * double(to) > 0.0)
			weight = {Real(1.0), Real(1.0)};
		const Real scale = Real(1.0) / (weight[0] + weight[1]);
		weight = {weight[0] * scale, weight[1] * scale};
		const EdgeWeights onStart{double(weight[0]), double(weight[1])};
		const auto valueOf = [&](const Values& v) { return weight[0] * v[0] + weight[1] * v[1]; };
		// It also is onEnd.from x_a + onEnd.to x_b: first + second is 0 at a, and the third
		// function is 1 there.
		const Real toEnd = (valueOf(first[i]) + valueOf(second[i])) / (atB[0] + atB[1]);
		EdgeWeights onEnd{double(valueOf(atA[i]) - toEnd * atB[2]), double(toEnd)};
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
	return isExact;
}

} // namespace ricci
