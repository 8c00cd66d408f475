// SPDX-License-Identifier: GPL-3.0-or-later
#include "cone_rounding.h"

#include "../base/numbers.h"
#include "../base/tolerances.h"
#include "cone_request.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ricci {

namespace {

constexpr double kQuarterTurn = 0.5 * kPi;

/// Steps of the search, for each cone.
constexpr int kStepsPerCone = 50;

/// Curvatures in quarter turns, and the search for better ones.
class QuarterTurnSearch
{
public:
	QuarterTurnSearch(
		const Eigen::MatrixXd& gram, const Eigen::VectorXd& linear, const Eigen::VectorXd& values) :
			m_turns(values.size()),
			m_gram(kQuarterTurn * kQuarterTurn * gram)
	{
		for (int i = 0; i < size(); ++i)
			m_turns[i] = std::min(m_max, std::round(values[i] / kQuarterTurn));
		const Eigen::VectorXd scaled = kQuarterTurn * linear;
		m_slope = m_gram * m_turns + scaled;
	}

	/// Brings the sum to \p total, in quarter turns, by the cheapest steps.
	void correctSum(double total)
	{
		double missing = total - m_turns.sum();
		while (missing != 0.0) {
			const double by = missing > 0.0 ? 1.0 : -1.0;
			int cheapest = 0;
			for (int i = 1; i < size(); ++i)
				if (cost(i, by) < cost(cheapest, by))
					cheapest = i;
			step(cheapest, by);
			missing -= by;
		}
	}

	/// Makes the best step or exchange again and again, while there is one that lowers the energy.
	void improve(bool keepSum)
	{
		for (int s = 0; s < kStepsPerCone * size(); ++s) {
			const Change change = best(keepSum);
			if (change.up < 0 && change.down < 0)
				return;
			if (change.up >= 0)
				step(change.up, 1.0);
			if (change.down >= 0)
				step(change.down, -1.0);
		}
	}

	Eigen::VectorXd values() const { return kQuarterTurn * m_turns; }

private:
	struct Change
	{
		int up = -1, down = -1; // cones whose curvature grows and falls; -1: none
	};

	int size() const { return static_cast<int>(m_turns.size()); }

	/// Half of what the energy rises by if curvature \p i changes by one quarter turn.
	double cost(int i, double by) const
	{
		return m_turns[i] + by > m_max ? std::numeric_limits<double>::infinity()
									   : by * m_slope[i] + 0.5 * m_gram(i, i);
	}

	void step(int i, double by)
	{
		m_turns[i] += by;
		m_slope += by * m_gram.col(i);
	}

	/// The change that lowers the energy most; none if no change lowers it.
	Change best(bool keepSum) const
	{
		Change found;
		double lowest = -kMinRoundingGain * (1.0 + std::abs(m_gram(0, 0)));
		const auto consider = [&](int up, int down, double change) {
			if (change < lowest) {
				lowest = change;
				found = {up, down};
			}
		};
		for (int i = 0; i < size(); ++i) {
			if (!keepSum) {
				consider(i, -1, cost(i, 1.0));
				consider(-1, i, cost(i, -1.0));
			}
			for (int j = 0; j < size(); ++j)
				if (i != j)
					consider(i, j, cost(i, 1.0) + cost(j, -1.0) - m_gram(i, j));
		}
		return found;
	}

	double m_max = std::floor(kMaxConeCurvature / kQuarterTurn + 1e-9);
	Eigen::VectorXd m_turns;
	Eigen::MatrixXd m_gram;  // of energies by quarter turns
	Eigen::VectorXd m_slope; // half the derivative of the energy by m_turns
};

} // namespace

Eigen::VectorXd roundToQuarterTurns(
	const Eigen::MatrixXd& gram,
	const Eigen::VectorXd& linear,
	const Eigen::VectorXd& values,
	std::optional<double> total)
{
	QuarterTurnSearch search(gram, linear, values);
	if (total)
		search.correctSum(std::round(*total / kQuarterTurn));
	search.improve(total.has_value());
	return search.values();
}

} // namespace ricci
