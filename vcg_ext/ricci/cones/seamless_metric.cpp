// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamless_metric.h"

#include "../base/graphs.h"
#include "../base/numbers.h"
#include "../base/task.h"
#include "../base/tolerances.h"
#include "../metric/area.h"
#include "../metric/geometry.h"
#include "../numerics/double_double.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

namespace ricci {

namespace {

/// A spanning tree of the triangles: for each but the first the halfedge of its parent by which it is
/// entered, breadth first.
FaceArray<Halfedge> treeOfFaces(const Triangulation& t)
{
	FaceArray<Halfedge> entry(t.faceCount());
	FaceArray<char> isReached(t.faceCount(), 0);
	std::vector<Face> queue{Face(0)};
	isReached[Face(0)] = 1;
	for (std::size_t i = 0; i < queue.size(); ++i) {
		checkpointNowAndThen(i);
		for (const Halfedge h : t.halfedges(queue[i])) {
			const Face other = t.face(h.twin());
			if (!other.isValid() || isReached[other])
				continue;
			isReached[other] = 1;
			entry[other] = h;
			queue.push_back(other);
		}
	}
	return entry;
}

/// The edges inside that neither the tree of the triangles crosses nor a spanning tree of the
/// vertices contains, in which each boundary loop is one node, or all of them are.
std::vector<Edge>
edgesOffTrees(const Triangulation& t, const FaceArray<Halfedge>& entry, bool joinsHoles)
{
	DisjointSetsOf<Vertex> nodes(t.vertexCount());
	Vertex hole;
	for (const Halfedge first : t.boundaryLoops()) {
		for (const Halfedge h : t.loop(first))
			nodes.merge(t.origin(h), t.target(h));
		if (joinsHoles && hole.isValid())
			nodes.merge(hole, t.origin(first));
		hole = t.origin(first);
	}
	EdgeArray<char> isCrossed(t.edgeCount(), 0);
	for (const Halfedge h : entry)
		if (h.isValid())
			isCrossed[h.edge()] = 1;
	std::vector<Edge> off;
	for (const Edge e : t.edges()) {
		checkpointNowAndThen(positionOf(e));
		if (isCrossed[e] || t.isBoundary(e))
			continue;
		const auto [i, j] = t.ends(e);
		if (!nodes.merge(i, j))
			off.push_back(e);
	}
	return off;
}

/// Leaves out what \p loop does and takes back at once.
void straighten(FaceLoop& loop)
{
	FaceLoop kept;
	for (const Halfedge h : loop)
		if (!kept.empty() && kept.back() == h.twin())
			kept.pop_back();
		else
			kept.push_back(h);
	std::size_t ends = 0;
	while (2 * ends + 1 < kept.size() && kept[ends] == kept[kept.size() - 1 - ends].twin())
		++ends;
	const auto n = static_cast<std::ptrdiff_t>(ends);
	loop.assign(kept.begin() + n, kept.end() - n);
}

} // namespace

std::vector<FaceLoop> homologyLoops(const Triangulation& t, bool roundHoles)
{
	const FaceArray<Halfedge> entry = treeOfFaces(t);
	const auto wayTo = [&](Face f) {
		std::vector<Halfedge> way;
		for (Halfedge h = entry[f]; h.isValid(); h = entry[t.face(h)])
			way.push_back(h);
		std::reverse(way.begin(), way.end());
		return way;
	};
	std::vector<FaceLoop> loops;
	for (const Edge e : edgesOffTrees(t, entry, roundHoles)) {
		const Halfedge h = e.halfedge();
		const std::vector<Halfedge> there = wayTo(t.face(h)), back = wayTo(t.face(h.twin()));
		std::size_t shared = 0;
		while (shared < std::min(there.size(), back.size()) && there[shared] == back[shared])
			++shared;
		FaceLoop loop{h};
		for (std::size_t i = back.size(); i-- > shared;)
			loop.push_back(back[i].twin());
		loop.insert(loop.end(), there.begin() + static_cast<std::ptrdiff_t>(shared), there.end());
		loops.push_back(std::move(loop));
	}
	return loops;
}

void flip(Triangulation& t, std::vector<FaceLoop>& loops, Edge e)
{
	const auto crosses = [e](Halfedge h) { return h.edge() == e; };
	std::vector<FaceLoop*> touched;
	for (FaceLoop& loop : loops) {
		const Face f = t.face(e.halfedge()), g = t.face(e.halfedge().twin());
		if (std::any_of(loop.begin(), loop.end(), [&](Halfedge h) {
				return t.face(h) == f || t.face(h) == g;
			}))
			touched.push_back(&loop);
	}
	t.flip(e);
	for (FaceLoop* loop : touched) {
		loop->erase(std::remove_if(loop->begin(), loop->end(), crosses), loop->end());
		FaceLoop through;
		for (std::size_t i = 0; i < loop->size(); ++i) {
			const Halfedge in = (*loop)[i], out = (*loop)[(i + 1) % loop->size()];
			through.push_back(in);
			if (t.face(in.twin()) != t.face(out)) {
				const Halfedge h = e.halfedge();
				through.push_back(t.face(h) == t.face(in.twin()) ? h : h.twin());
			}
		}
		straighten(through);
		*loop = std::move(through);
	}
}

namespace {

/// The corners round which \p loop turns: 1 where they are on its left, -1 on its right; 0 elsewhere.
/// The sum of their angles is the holonomy of the loop, in radians: the angle by which a direction that
/// goes along with the walk has turned against the walk's own. Across a vertex with curvature K it
/// changes by K, so that loops of one homology class have one holonomy up to sums of curvatures.
HalfedgeArray<double> turnedCorners(const Triangulation& t, const FaceLoop& loop)
{
	HalfedgeArray<double> corners(t.halfedgeCount(), 0.0);
	for (std::size_t i = 0; i < loop.size(); ++i) {
		const Halfedge in = loop[i].twin(), out = loop[(i + 1) % loop.size()];
		if (out == t.next(in))
			corners[out] -= 1.0;
		else
			corners[in] += 1.0;
	}
	return corners;
}

/// Sum of \p weights times \p angles, both at the halfedges' origins.
double sumOfAngles(const HalfedgeArray<double>& weights, const HalfedgeArray<double>& angles)
{
	DoubleDouble sum;
	for (const Halfedge h : weights.indices())
		if (weights[h] != 0.0)
			sum += DoubleDouble::product(weights[h], angles[h]);
	return static_cast<double>(sum);
}

/// The derivative of sumOfAngles() by the logarithms of the lengths, in flat triangles.
EdgeArray<double> derivativeByLengths(
	const Triangulation& t,
	const HalfedgeArray<double>& weights,
	const HalfedgeArray<double>& angles)
{
	EdgeArray<double> derivative(t.edgeCount(), 0.0);
	for (const Halfedge h : t.interiorHalfedges()) {
		const Halfedge next = t.next(h), previous = t.previous(h);
		// The angle at the origin of h grows with the side across, and falls with the other two.
		const double atNext = weights[h] / std::tan(angles[next]);
		const double atPrevious = weights[h] / std::tan(angles[previous]);
		derivative[next.edge()] += atNext + atPrevious;
		derivative[h.edge()] -= atNext;
		derivative[previous.edge()] -= atPrevious;
	}
	return derivative;
}

/// [vertex] The derivative of the holonomy of a loop by the curvature that the flow is to reach there: u
/// follows the curvature, and the holonomy follows u. 0 where u is fixed.
/// \param corners turnedCorners()
/// \param u where \p map was evaluated
/// \param hessian factorised there
VertexVector holonomyByCurvature(
	const CurvatureMap& map,
	const VertexVector& u,
	FactoredHessian& hessian,
	const HalfedgeArray<double>& corners)
{
	const Triangulation& t = map.triangulation();
	const EdgeArray<double> byLength = derivativeByLengths(t, corners, map.angles());
	// Eq. 4: the square of a length changes with u_i by l^2 + g_i^2 - g_j^2.
	VertexVector byU = VertexVector::Zero(t.vertexCount());
	for (const Edge e : t.edges()) {
		if (byLength[e] == 0.0)
			continue;
		const auto [i, j] = t.ends(e);
		const double l2 = map.lengths()[e] * map.lengths()[e];
		const double difference = std::exp(2.0 * u[i]) - std::exp(2.0 * u[j]);
		byU[i] += 0.5 * byLength[e] * (1.0 + difference / l2);
		byU[j] += 0.5 * byLength[e] * (1.0 - difference / l2);
	}
	return hessian.scatter(hessian.cholesky().solve(hessian.gather(byU)));
}

constexpr int kMaxSteps = 12;

/// The logarithm of a length changes by no more in a step.
constexpr double kMaxChange = 0.25;

/// Halvings of a step that breaks triangles or raises the error.
constexpr int kMaxHalvings = 4;

/// A metric with the curvatures of the target.
struct Metric
{
	std::shared_ptr<const CurvatureMap> map;
	VertexVector u;
	NewtonResult solved;
	std::vector<Edge> flips; ///< since the flow
	std::vector<FaceLoop> loops;
	Eigen::VectorXd errors; ///< [loop] holonomy less the nearest multiple of pi / 2

	double error() const { return errors.size() == 0 ? 0.0 : errors.cwiseAbs().maxCoeff(); }
};

Eigen::VectorXd errorsOf(const CurvatureMap& map, const std::vector<FaceLoop>& loops)
{
	Eigen::VectorXd errors(loops.size());
	for (std::size_t i = 0; i < loops.size(); ++i)
		errors[Eigen::Index(i)] = std::remainder(
			sumOfAngles(turnedCorners(map.triangulation(), loops[i]), map.angles()), kQuarterTurn);
	return errors;
}

Metric metricOf(const FlowResult& flow)
{
	Metric metric;
	metric.map = flow.metric;
	metric.u = flow.u;
	metric.loops = homologyLoops(flow.metric->triangulation(), flow.target.hasFixed());
	metric.errors = errorsOf(*flow.metric, metric.loops);
	return metric;
}

/// The derivatives of the holonomies.
struct Derivatives
{
	std::vector<VertexVector> curvatures;   // [loop] by those of the target
	std::vector<EdgeArray<double>> lengths; // [loop] by their logarithms, where u follows them
	EdgeArray<double> inverseWeights;       // 1 / W; 0 where the length stays
	Eigen::MatrixXd gram;                   // lengths W^-1 lengths
	double area = 0.0;                      // in space
};

/// Of the metric of \p flow or one near it, where u was startU at the start. For the sides a, b, c of a triangle
/// with area A and circumradius R, the change of a by exp(x) alone is a distortion with the energy
/// 2 a^2 R^2 / A x^2.
void setWeights(const Metric& metric, const VertexVector& startU, Derivatives& by)
{
	const CurvatureMap& map = *metric.map;
	const Triangulation& t = map.triangulation();
	by.inverseWeights.assign(t.edgeCount(), 0.0);
	for (const Face f : t.faces()) {
		const auto h = t.halfedges(f);
		const auto length = [&](std::size_t k) { return map.lengths()[h[k].edge()]; };
		const double sine = std::sin(map.angles()[h[0]]);
		const double area = 0.5 * length(0) * length(2) * sine;
		double factor = 0.0;
		for (const Vertex v : t.vertices(f))
			factor += (metric.u[v] - startU[v]) / 3.0;
		const double scale = std::exp(2.0 * factor);
		by.area += area / scale;
		const double radius = 0.5 * length(1) / sine;
		for (std::size_t k = 0; k < 3; ++k) {
			const double product = length(k) * radius;
			by.inverseWeights[h[k].edge()] += 2.0 * product * product / (area * scale);
		}
	}
	for (const Edge e : t.edges())
		by.inverseWeights[e] = t.isBoundary(e) ? 0.0 : 1.0 / by.inverseWeights[e];
}

Derivatives derivatives(const FlowResult& flow, const Metric& metric)
{
	const CurvatureMap& map = *metric.map;
	const Triangulation& t = map.triangulation();
	FactoredHessian hessian(flow.target.fixed, true);
	hessian.fill(map);
	hessian.factorize();
	Derivatives by;
	setWeights(metric, flow.u - flowFactor(flow), by);
	for (const FaceLoop& loop : metric.loops) {
		checkpoint();
		HalfedgeArray<double> corners = turnedCorners(t, loop);
		by.curvatures.push_back(holonomyByCurvature(map, metric.u, hessian, corners));
		// A length also changes curvatures, which u takes back, and with them the holonomy.
		for (const Halfedge h : t.interiorHalfedges())
			corners[h] += by.curvatures.back()[t.origin(h)];
		by.lengths.push_back(derivativeByLengths(t, corners, map.angles()));
	}
	const std::size_t n = by.lengths.size();
	by.gram.resize(Eigen::Index(n), Eigen::Index(n));
	for (std::size_t i = 0; i < n; ++i)
		for (std::size_t j = 0; j <= i; ++j) {
			double sum = 0.0;
			for (const Edge e : t.edges())
				sum += by.inverseWeights[e] * by.lengths[i][e] * by.lengths[j][e];
			by.gram(Eigen::Index(i), Eigen::Index(j)) = sum;
			by.gram(Eigen::Index(j), Eigen::Index(i)) = sum;
		}
	return by;
}

/// The change of the logarithms of the lengths that removes the errors to first order.
EdgeArray<double> changeOfLengths(const FlowResult& flow, const Metric& metric)
{
	const Derivatives by = derivatives(flow, metric);
	const Eigen::VectorXd c = by.gram.ldlt().solve(-metric.errors);
	EdgeArray<double> change(by.inverseWeights.size(), 0.0);
	for (std::size_t i = 0; i < by.lengths.size(); ++i)
		for (const Edge e : change.indices())
			change[e] += c[Eigen::Index(i)] * by.inverseWeights[e] * by.lengths[i][e];
	return change;
}

/// The metric with lengths changed by \p share of \p change, and with the curvatures of the target.
/// \return none where Newton's method does not find it, after \p steps more
std::optional<Metric> changed(
	const FlowResult& flow,
	double epsilon,
	const Metric& metric,
	const EdgeArray<double>& change,
	double share,
	int& steps)
{
	const CurvatureMap& map = *metric.map;
	EdgeArray<double> delta = map.delta();
	for (const Edge e : change.indices()) {
		if (change[e] == 0.0)
			continue;
		const auto [i, j] = map.triangulation().ends(e);
		const double length = map.lengths()[e] * std::exp(share * change[e]);
		delta[e] = Euclidean::delta(length, std::exp(metric.u[i]), std::exp(metric.u[j]));
		if (!(delta[e] >= 0.0))
			return std::nullopt;
	}
	const std::shared_ptr<CurvatureMap> next =
		curvatureMap(map.triangulation(), std::move(delta), Background::EuclideanPlane, true);
	Metric result;
	result.u = metric.u;
	const std::optional<NewtonResult> solved = attempt("a shorter step is tried", [&] {
		return NewtonSolver(*next, flow.target.fixed)
			.solve(
				result.u, flow.target.curvature, epsilon, NewtonSolver::kMaxSteps, [](int, double) {
					checkpoint();
				});
	});
	steps += solved ? solved->iterations : 0;
	if (!solved || !solved->converged || next->brokenTriangles() > 0)
		return std::nullopt;
	result.solved = *solved;
	result.flips = metric.flips;
	result.loops = metric.loops;
	Triangulation t = map.triangulation();
	for (const Edge e : next->flips()) {
		result.flips.push_back(e);
		flip(t, result.loops, e);
	}
	result.errors = errorsOf(*next, result.loops);
	next->releaseWorkSpace();
	result.map = next;
	return result;
}

/// Goes from \p metric one step of Newton's method towards the one of which the holonomies are multiples of pi / 2,
/// or a share of it: the longest that makes it better.
/// \return whether there is one
bool round(const FlowResult& flow, double epsilon, Metric& metric, int& steps)
{
	const EdgeArray<double> change = changeOfLengths(flow, metric);
	double largest = 0.0;
	for (const double x : change)
		largest = std::max(largest, std::abs(x));
	double share = std::min(1.0, kMaxChange / largest);
	for (int i = 0; i < kMaxHalvings; ++i, share *= 0.5) {
		std::optional<Metric> next = changed(flow, epsilon, metric, change, share, steps);
		if (next && next->error() < metric.error()) {
			metric = std::move(*next);
			return true;
		}
	}
	return false;
}

} // namespace

Holonomy holonomy(const FlowResult& flow)
{
	const Metric metric = metricOf(flow);
	Holonomy result;
	result.errors = metric.errors;
	if (result.errors.size() == 0)
		return result;
	Derivatives by = derivatives(flow, metric);
	result.byCurvature = std::move(by.curvatures);
	// A metric that changes by h has the Beltrami coefficient mu with |h|^2 = 8 |mu|^2.
	const Eigen::Index n = result.errors.size();
	result.cost = by.gram.ldlt().solve(Eigen::MatrixXd::Identity(n, n)) / (8.0 * by.area);
	return result;
}

int roundHolonomy(FlowResult& flow, double epsilon)
{
	Metric metric = metricOf(flow);
	const double before = metric.error();
	int steps = 0; // of Newton's method, for the metrics
	for (int i = 0; i < kMaxSteps && metric.error() > kCancelled; ++i)
		if (!round(flow, epsilon, metric, steps))
			break;
	if (before > 0.0)
		logLine(
			"The rotations across seams are up to " + numberText(before, 3) +
			" from a multiple of a quarter turn, and " + numberText(metric.error(), 3) +
			" once the metric has changed.");
	if (metric.map == flow.metric)
		return steps;
	flow.metric = std::move(metric.map);
	flow.u = std::move(metric.u);
	flow.residual = metric.solved.residual;
	flow.floor = metric.solved.floor;
	flow.curvature = flow.metric->curvature();
	flow.area = euclideanArea(flow.metric->triangulation(), flow.metric->lengths());
	flow.flips.insert(flow.flips.end(), metric.flips.begin(), metric.flips.end());
	return steps;
}

} // namespace ricci
