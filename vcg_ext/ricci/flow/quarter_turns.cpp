// SPDX-License-Identifier: GPL-3.0-or-later
#include "quarter_turns.h"

#include "../base/numbers.h"
#include "../error.h"
#include "../metric/area.h"
#include "../metric/euclidean.h"
#include "loop_turns.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace ricci {

namespace {

constexpr double kQuarterTurn = 0.5 * kPi;

/// Turns this near to a multiple of pi / 2 are one, radians: what the sums of some thousand angles
/// lose.
constexpr double kTurnRounding = 1e-12;

constexpr int kMaxSteps = 12;

/// The logarithm of a length changes by no more in a step.
constexpr double kMaxChange = 0.25;

/// Halvings of a step that breaks triangles or raises the error.
constexpr int kMaxHalvings = 4;

/// A metric of the flow: what of it changes.
struct Metric
{
	std::shared_ptr<CurvatureMap> map;
	VertexVector u;
	NewtonResult solved;
	Eigen::VectorXd errors; ///< [loop] turn less the nearest multiple of pi / 2

	double error() const { return errors.size() == 0 ? 0.0 : errors.cwiseAbs().maxCoeff(); }
};

class TurnRounder
{
public:
	TurnRounder(const FlowResult& flow, const FlowOptions& options, const Tick& tick) :
			m_flow(flow), m_options(options), m_tick(tick), m_t(flow.metric->triangulation()),
			m_factor(flowFactor(flow))
	{
		for (const FaceLoop& loop : homologyLoops(m_t, flow.target.hasFixed()))
			m_corners.push_back(turnedCorners(m_t, loop));
	}

	Eigen::VectorXd errors(const CurvatureMap& map) const
	{
		Eigen::VectorXd result(m_corners.size());
		for (std::size_t i = 0; i < m_corners.size(); ++i)
			result[Eigen::Index(i)] =
				std::remainder(sumOfAngles(m_corners[i], map.angles()), kQuarterTurn);
		return result;
	}

	/// The derivatives of the turns.
	struct Derivatives
	{
		std::vector<VertexVector> curvatures; // [loop] by those of the target
		std::vector<EdgeArray<double>> lengths; // [loop] by their logarithms, where u follows them
		EdgeArray<double> inverseWeights;
		Eigen::MatrixXd gram; // lengths W^-1 lengths
	};

	Derivatives derivatives(const CurvatureMap& map, const VertexVector& u) const
	{
		FactoredHessian hessian(m_flow.target.fixed, true);
		hessian.factorize(map);
		Derivatives by;
		by.inverseWeights = inverseWeights(map, u);
		for (const HalfedgeArray<double>& corners : m_corners) {
			m_tick();
			by.curvatures.push_back(turnByCurvature(map, u, hessian, corners));
			// A length also changes curvatures, which u takes back, and with it the turn.
			HalfedgeArray<double> all = corners;
			for (const Halfedge h : m_t.interiorHalfedges())
				all[h] += by.curvatures.back()[m_t.origin(h)];
			by.lengths.push_back(derivativeByLengths(m_t, all, map.angles()));
		}
		const std::size_t n = by.lengths.size();
		by.gram.resize(Eigen::Index(n), Eigen::Index(n));
		for (std::size_t i = 0; i < n; ++i)
			for (std::size_t j = 0; j <= i; ++j) {
				double sum = 0.0;
				for (const Edge e : m_t.edges())
					sum += by.inverseWeights[e] * by.lengths[i][e] * by.lengths[j][e];
				by.gram(Eigen::Index(i), Eigen::Index(j)) = sum;
				by.gram(Eigen::Index(j), Eigen::Index(i)) = sum;
			}
		return by;
	}

	/// Area of the surface in space.
	double area() const
	{
		const CurvatureMap& map = *m_flow.metric;
		double area = 0.0;
		for (const Face f : m_t.faces()) {
			const auto h = m_t.halfedges(f);
			double factor = 0.0;
			for (const Vertex v : m_t.vertices(f))
				factor += m_factor[v] / 3.0;
			area += 0.5 * map.lengths()[h[0].edge()] * map.lengths()[h[2].edge()] *
					std::sin(map.angles()[h[0]]) * std::exp(-2.0 * factor);
		}
		return area;
	}

	/// The metric of which the turns are multiples of pi / 2, as far as Newton's method gets there.
	/// \return none where the first step fails
	std::optional<Metric> solve()
	{
		std::optional<Metric> best;
		for (int step = 0; step < kMaxSteps; ++step) {
			const CurvatureMap& map = best ? *best->map : *m_flow.metric;
			const VertexVector& u = best ? best->u : m_flow.u;
			const Eigen::VectorXd present = best ? best->errors : errors(map);
			const double error = present.cwiseAbs().maxCoeff();
			if (error <= kTurnRounding)
				break;
			std::optional<Metric> next = searchAlong(map, u, direction(map, u, present), error);
			if (!next)
				break;
			best = std::move(next);
		}
		return best;
	}

private:
	/// The change of the logarithms of the lengths that removes \p errors to first order.
	EdgeArray<double>
	direction(const CurvatureMap& map, const VertexVector& u, const Eigen::VectorXd& errors) const
	{
		const Derivatives by = derivatives(map, u);
		const Eigen::VectorXd c = by.gram.ldlt().solve(-errors);
		EdgeArray<double> change(m_t.edgeCount(), 0.0);
		for (Eigen::Index i = 0; i < c.size(); ++i)
			for (const Edge e : m_t.edges())
				change[e] += c[i] * by.inverseWeights[e] * by.lengths[std::size_t(i)][e];
		return change;
	}

	/// [edge] 1 / W; 0 where the length stays. For the sides a, b, c of a triangle with area A and
	/// circumradius R, the change of a by exp(x) alone is a distortion with the energy
	/// 2 a^2 R^2 / A x^2; an area in space is one in the metric times exp(-2 ln factor).
	EdgeArray<double> inverseWeights(const CurvatureMap& map, const VertexVector& u) const
	{
		EdgeArray<double> weights(m_t.edgeCount(), 0.0);
		for (const Face f : m_t.faces()) {
			const auto h = m_t.halfedges(f);
			const double sine = std::sin(map.angles()[h[0]]);
			const double radius = 0.5 * map.lengths()[h[1].edge()] / sine;
			const double area =
				0.5 * map.lengths()[h[0].edge()] * map.lengths()[h[2].edge()] * sine;
			double factor = 0.0;
			for (const Vertex v : m_t.vertices(f))
				factor += (m_factor[v] + u[v] - m_flow.u[v]) / 3.0;
			for (const Halfedge side : h) {
				const double ratio = map.lengths()[side.edge()] * radius;
				weights[side.edge()] += 2.0 * ratio * ratio / area * std::exp(-2.0 * factor);
			}
		}
		const bool keepsBoundary = m_flow.target.hasFixed();
		for (const Edge e : m_t.edges())
			weights[e] = keepsBoundary && m_t.isBoundary(e) ? 0.0 : 1.0 / weights[e];
		return weights;
	}

	/// The metric that is better than \p error by the longest share of \p change.
	std::optional<Metric> searchAlong(
		const CurvatureMap& map,
		const VertexVector& u,
		const EdgeArray<double>& change,
		double error) const
	{
		double largest = 0.0;
		for (const double x : change)
			largest = std::max(largest, std::abs(x));
		double share = std::min(1.0, kMaxChange / largest);
		for (int i = 0; i < kMaxHalvings; ++i, share *= 0.5) {
			std::optional<Metric> next = changed(map, u, change, share);
			if (next && next->error() < error)
				return next;
		}
		return std::nullopt;
	}

	/// The metric with lengths changed by \p share of \p change, and with the curvatures of the
	/// target. \return none where it does not exist
	std::optional<Metric> changed(
		const CurvatureMap& map,
		const VertexVector& u,
		const EdgeArray<double>& change,
		double share) const
	{
		CirclePacking packing;
		packing.triangulation = m_t;
		packing.delta.resize(m_t.edgeCount());
		for (const Edge e : m_t.edges()) {
			const auto [i, j] = m_t.ends(e);
			const double length = map.lengths()[e] * std::exp(share * change[e]);
			packing.delta[e] = change[e] == 0.0
								   ? map.delta()[e]
								   : Euclidean::delta(length, std::exp(u[i]), std::exp(u[j]));
		}
		Metric next;
		if (map.precision() < std::numeric_limits<double>::epsilon())
			next.map = std::make_shared<GeometricCurvatureMap<EuclideanGeometry<long double>>>(
				std::move(packing));
		else
			next.map = std::make_shared<GeometricCurvatureMap<Euclidean>>(std::move(packing));
		next.u = u;
		NewtonSolver newton(*next.map, m_flow.target.fixed);
		NewtonOptions options;
		options.epsilon = m_options.epsilon;
		options.maxIterations = m_options.maxIterations;
		try {
			next.solved = newton.solve(
				next.u, m_flow.target.curvature, options, [&](int, double) { m_tick(); });
		}
		catch (const Stopped&) {
			throw;
		}
		catch (const Error&) {
			return std::nullopt;
		}
		if (!next.solved.converged || next.map->brokenTriangles() > 0)
			return std::nullopt;
		next.errors = errors(*next.map);
		return next;
	}

	const FlowResult& m_flow;
	const FlowOptions& m_options;
	const Tick& m_tick;
	const Triangulation& m_t;
	VertexVector m_factor;
	std::vector<HalfedgeArray<double>> m_corners; // [loop]
};

} // namespace

LoopTurns loopTurns(const FlowResult& flow, const Tick& tick)
{
	static const FlowOptions options;
	const TurnRounder rounder(flow, options, tick);
	LoopTurns result;
	result.errors = rounder.errors(*flow.metric);
	if (result.errors.size() == 0)
		return result;
	TurnRounder::Derivatives by = rounder.derivatives(*flow.metric, flow.u);
	result.byCurvature = std::move(by.curvatures);
	// A metric that changes by h has the Beltrami coefficient mu with |h|^2 = 8 |mu|^2.
	const Eigen::Index n = result.errors.size();
	result.cost =
		by.gram.ldlt().solve(Eigen::MatrixXd::Identity(n, n)) / (8.0 * rounder.area());
	return result;
}

TurnRounding roundTurns(FlowResult& flow, const FlowOptions& options, const Tick& tick)
{
	TurnRounding result;
	if (flow.doubled)
		return result;
	TurnRounder rounder(flow, options, tick);
	const Eigen::VectorXd errors = rounder.errors(*flow.metric);
	if (errors.size() == 0)
		return result;
	result.before = result.after = errors.cwiseAbs().maxCoeff();
	std::optional<Metric> found = rounder.solve();
	if (!found)
		return result;
	result.after = found->error();
	for (const Edge e : flow.metric->triangulation().edges())
		result.change = std::max(
			result.change,
			std::abs(std::log1p(found->map->delta()[e]) - std::log1p(flow.metric->delta()[e])));
	found->map->releaseWorkSpace();
	flow.u = std::move(found->u);
	flow.metric = std::move(found->map);
	flow.residual = found->solved.residual;
	flow.floor = found->solved.floor;
	flow.iterations += found->solved.iterations;
	flow.curvature = flow.metric->curvature();
	flow.area = euclideanArea(flow.metric->triangulation(), flow.metric->lengths());
	return result;
}

} // namespace ricci
