// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamless_metric.h"

#include "../base/numbers.h"
#include "../base/points.h"
#include "../base/task.h"
#include "../metric/area.h"
#include "area_change.h"
#include "cone_placement.h"
#include "cone_sites.h"
#include "linear_flow.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace ricci {

namespace {

/// Flows after the first one, and those in a row that may bring less than a share of what the
/// holonomies cost.
constexpr int kMaxFlows = 4, kMaxVainRounds = 2;
constexpr double kMinShare = 0.1;

/// How far a cone may move at once, as a share of the square root of the area, and the factor by which
/// that is less after a flow that has brought nothing.
constexpr double kFirstRadius = 0.3, kShorter = 0.3;

/// Holonomies that cost less, by the mean square of the Beltrami coefficient, need no other cones:
/// angles change by about a hundredth.
constexpr double kCheap = 2.5e-5;

/// What areas and one more cone cost, where the mean square of the Beltrami coefficient costs 1.
constexpr double kAreaCost = 0.05, kConeCost = 3e-4;

/// What a metric with placed cones costs whose holonomies are to be multiples of pi / 2.
struct SeamlessCost
{
	double angles = 0.0; ///< mean square of the Beltrami coefficient that the holonomies cost
	double areas = 0.0;  ///< mean square of the logarithm of the scale factor
	int cones = 0;

	double total() const { return angles + kAreaCost * areas + kConeCost * cones; }
};

/// Moves that are tried, and those of which all pairs are.
constexpr std::size_t kMaxTried = 30000, kMaxPaired = 1500;

/// Moves or pairs of them, one after the other, and the share by which each has to lower the cost.
constexpr int kMaxMoves = 8;
constexpr double kMinMoveGain = 0.02;

/// Where moves are not worth what the linear problem for the nearest ones promises, they become
/// shorter by this factor, so many times.
constexpr double kShorterMove = 0.4;
constexpr int kMaxShortenings = 4;

/// Some quarter turns of the cone at one vertex move to another.
struct Move
{
	Vertex from, to;
	int units = 0;
	double cost = 0.0; // of areas and cones
};

class ConeMoves
{
public:
	ConeMoves(
		const EmbeddedSurface& surface,
		const FlowResult& flow,
		const Holonomy& holonomy,
		const TargetRequest& request,
		double radius) :
			m_surface(surface),
			m_holonomy(holonomy), m_sites(surface, request.coneVertices()),
			m_keepsCount(request.goal.kind == ConeGoal::Count),
			m_linear(
				surface,
				flow,
				request.boundary(),
				areaShares(surface.triangulation, surface.lengths)),
			m_units(flow.curvature.size(), 0), m_curvature(flow.curvature),
			m_errors(holonomy.errors), m_root(holonomy.cost.llt().matrixU()),
			m_area(euclideanArea(surface.triangulation, surface.lengths))
	{
		m_radius = radius * std::sqrt(m_area);
		for (const Vertex v : m_units.indices())
			if (m_sites.isAllowed(v))
				m_units[v] = static_cast<int>(std::lround(flow.target.curvature[v] / kQuarterTurn));
		measure();
	}

	/// \return whether anything moved
	bool run()
	{
		bool hasMoved = false;
		int shortenings = 0;
		for (int i = 0; i < kMaxMoves && shortenings <= kMaxShortenings; ++i) {
			const std::vector<Move> moves = best();
			if (moves.empty())
				return hasMoved;
			if (apply(moves))
				hasMoved = true;
			else {
				m_radius *= kShorterMove;
				++shortenings;
			}
		}
		return hasMoved;
	}

	PlacedCones cones() const
	{
		PlacedCones placed;
		for (const Vertex v : m_units.indices())
			if (m_units[v] != 0) {
				placed.vertices.push_back(v);
				placed.curvatures.push_back(kQuarterTurn * m_units[v]);
			}
		placed.seams = SeamTree(m_sites, placed.vertices).length();
		return placed;
	}

private:
	/// The scale factor that the linear problem has for the present cones.
	void measure()
	{
		const VertexVector factor = m_linear.factor(m_curvature);
		m_cost.areas = m_linear.meanSquare(factor);
		m_field = m_linear.gradient(factor);
		m_cost.cones = static_cast<int>(
			std::count_if(m_units.begin(), m_units.end(), [](int n) { return n != 0; }));
	}

	/// Makes \p moves. \return false, with nothing changed, where the linear problem sees no gain
	bool apply(const std::vector<Move>& moves)
	{
		m_cost.angles = holonomyCost(m_errors);
		const double before = m_cost.total(), enough = 0.25 * kMinMoveGain * m_cost.angles;
		const Eigen::VectorXd errors = m_errors;
		const auto move = [&](int sign) {
			for (const Move& m : moves) {
				m_units[m.from] -= sign * m.units;
				m_units[m.to] += sign * m.units;
				m_curvature[m.from] -= kQuarterTurn * sign * m.units;
				m_curvature[m.to] += kQuarterTurn * sign * m.units;
			}
			measure();
		};
		for (const Move& m : moves)
			m_errors = wrapped(m_errors + holonomyChange(m));
		move(1);
		m_cost.angles = holonomyCost(m_errors);
		if (m_cost.total() < before - enough)
			return true;
		move(-1);
		m_errors = errors;
		return false;
	}

	/// What the holonomies cost with these errors.
	double holonomyCost(const Eigen::VectorXd& errors) const
	{
		return (m_root * wrapped(errors)).squaredNorm();
	}

	static Eigen::VectorXd wrapped(Eigen::VectorXd errors)
	{
		for (double& r : errors)
			r -= kQuarterTurn * std::round(r / kQuarterTurn);
		return errors;
	}

	Eigen::VectorXd holonomyChange(const Move& move) const
	{
		Eigen::VectorXd change(m_errors.size());
		for (Eigen::Index j = 0; j < change.size(); ++j) {
			const VertexVector& by = m_holonomy.byCurvature[std::size_t(j)];
			change[j] = kQuarterTurn * move.units * (by[move.to] - by[move.from]);
		}
		return change;
	}

	/// Every move that may be worth it: of a cone as a whole, or of one quarter turn of it.
	std::vector<Move> moves(double limit) const
	{
		std::vector<Move> found;
		const auto add = [&](Vertex from, Vertex to, int units) {
			const int left = m_units[from] - units, there = m_units[to] + units;
			if (left > kMaxQuarterTurns || there > kMaxQuarterTurns)
				return;
			const double way = distance(m_surface.positions[from], m_surface.positions[to]);
			if (way > m_radius)
				return;
			const double curvature = kQuarterTurn * units;
			// The derivative, and the second one about as in the plane.
			double cost = kAreaCost * (2.0 * curvature * (m_field[to] - m_field[from]) +
									   0.25 * curvature * curvature * way * way / m_area);
			const int more = (left != 0) - 1 + (there != 0) - (m_units[to] != 0);
			if (more > 0 && m_keepsCount)
				return;
			cost += kConeCost * more;
			if (cost < limit)
				found.push_back({from, to, units, cost});
		};
		for (const Vertex from : m_units.indices()) {
			if (m_units[from] == 0)
				continue;
			checkpoint();
			for (const Vertex to : m_units.indices()) {
				if (to == from || !m_sites.isAllowed(to))
					continue;
				add(from, to, m_units[from]);
				if (m_units[from] != 1)
					add(from, to, 1);
				if (m_units[from] != -1)
					add(from, to, -1);
			}
		}
		std::stable_sort(found.begin(), found.end(), [](const Move& a, const Move& b) {
			return a.cost < b.cost;
		});
		return found;
	}

	/// At most \p count of \p moves, more of them among the cheap ones.
	static std::vector<Move> denserAtStart(const std::vector<Move>& moves, std::size_t count)
	{
		if (moves.size() <= count)
			return moves;
		std::vector<Move> some;
		for (std::size_t i = 0; i < count; ++i) {
			const double share = double(i) / double(count);
			some.push_back(moves[std::max(i, std::size_t(share * share * double(moves.size())))]);
		}
		return some;
	}

	/// The move, or the two, with the most gain by the derivatives; empty if there is none.
	std::vector<Move> best()
	{
		const double present = holonomyCost(m_errors);
		const std::vector<Move> all = moves(present);
		double lowest = (1.0 - kMinMoveGain) * present;
		std::vector<Move> chosen;
		for (const Move& move : denserAtStart(all, kMaxTried)) {
			if (move.cost >= lowest)
				break;
			const double cost = move.cost + holonomyCost(m_errors + holonomyChange(move));
			if (cost < lowest) {
				lowest = cost;
				chosen = {move};
			}
		}
		const std::vector<Move> some = denserAtStart(all, kMaxPaired);
		std::vector<Eigen::VectorXd> changes;
		changes.reserve(some.size());
		for (const Move& move : some)
			changes.push_back(holonomyChange(move));
		for (std::size_t i = 0; i < some.size(); ++i) {
			checkpoint();
			const Eigen::VectorXd first = m_errors + changes[i];
			for (std::size_t k = i + 1; k < some.size(); ++k) {
				if (some[i].cost + some[k].cost >= lowest)
					break;
				if (some[i].from == some[k].from || some[i].to == some[k].to ||
					some[i].from == some[k].to || some[i].to == some[k].from)
					continue;
				const double cost = some[i].cost + some[k].cost + holonomyCost(first + changes[k]);
				if (cost < lowest) {
					lowest = cost;
					chosen = {some[i], some[k]};
				}
			}
		}
		return chosen;
	}

	const EmbeddedSurface& m_surface;
	const Holonomy& m_holonomy;
	ConeSites m_sites;
	bool m_keepsCount; // the number of cones was asked for
	LinearFlow m_linear;
	VertexArray<int> m_units; // quarter turns of the cones
	VertexVector m_curvature; // with the present cones
	VertexVector m_field;     // derivative of half the mean square of the factor by curvature
	Eigen::VectorXd m_errors; // of the holonomies, at the present cones
	Eigen::MatrixXd m_root;   // of the cost of holonomies
	double m_area, m_radius;
	SeamlessCost m_cost; // by the linear problem
};

/// That of \p flow.
SeamlessCost
seamlessCost(const EmbeddedSurface& surface, const FlowResult& flow, const Holonomy& holonomy)
{
	SeamlessCost cost;
	cost.angles =
		holonomy.errors.size() == 0 ? 0.0 : holonomy.errors.dot(holonomy.cost * holonomy.errors);
	const double spread = areaChange(surface, flowFactor(flow)).spread; // of 2 u
	cost.areas = 0.25 * spread * spread;
	for (const Vertex v : flow.target.curvature.indices())
		cost.cones += !surface.topology.boundary[v] && flow.target.curvature[v] != 0.0;
	return cost;
}

/// Cones near those of \p flow with holonomies nearer to multiples of pi / 2. Curvature that moves from p
/// to q changes a holonomy by (y(q) - y(p)) times as much, where y is its derivative by curvature
/// (Holonomy::byCurvature), and areas as the linear problem at the metric of \p flow says. Greedy:
/// one cone or quarter turn, or two, move to where SeamlessCost::total() falls most, again and again.
/// \param flow on \p surface, with intrinsic flips, the boundary of \p request, and cones with
/// curvatures that are multiples of pi / 2
/// \param radius how far a cone may move at once, as a share of the square root of the area
/// \return none where nothing is better
/// \throw SolverFailed
std::optional<PlacedCones> seamlessCones(
	const EmbeddedSurface& surface,
	const FlowResult& flow,
	const Holonomy& holonomy,
	const TargetRequest& request,
	double radius)
{
	if (holonomy.errors.size() == 0)
		return std::nullopt;
	ConeMoves search(surface, flow, holonomy, request, radius);
	if (!search.run())
		return std::nullopt;
	PlacedCones placed = search.cones();
	placed.distortion = areaChange(surface, flowFactor(flow)).spread;
	return placed;
}

} // namespace

int makeSeamless(
	const EmbeddedSurface& surface,
	const TargetRequest& request,
	double epsilon,
	const FlowTo& flowTo,
	FlowResult& flow)
{
	if (!flow.target.isSeamless || flow.doubled)
		return 0;
	Holonomy present = holonomy(flow);
	SeamlessCost lowest = seamlessCost(surface, flow, present);
	double radius = kFirstRadius;
	const auto propose = [&]() -> std::optional<FlowResult> {
		if (lowest.angles <= kCheap)
			return std::nullopt;
		const auto target = attempt("the cones stay", [&]() -> std::optional<Target> {
			const auto cones = seamlessCones(surface, flow, present, request, radius);
			return cones ? std::optional(targetWithCones(surface, *cones, request)) : std::nullopt;
		});
		std::optional<FlowResult> next = target && *target ? flowTo(**target) : std::nullopt;
		return next && !next->doubled ? std::move(next) : std::nullopt;
	};
	const auto take = [&](FlowResult next) {
		Holonomy other = holonomy(next);
		const SeamlessCost cost = seamlessCost(surface, next, other);
		const double gain = lowest.total() - cost.total();
		const bool isEnough = gain >= kMinShare * lowest.angles;
		if (gain > 0.0) {
			flow = std::move(next);
			present = std::move(other);
			lowest = cost;
		}
		else
			radius *= kShorter; // the linear problem reaches no farther
		return isEnough;
	};
	improve(kMaxFlows, kMaxVainRounds, propose, take);
	advance(0.0, "Rounding the rotations");
	return roundHolonomy(flow, epsilon);
}

} // namespace ricci
