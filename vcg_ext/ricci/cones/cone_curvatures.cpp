// SPDX-License-Identifier: GPL-3.0-or-later
#include "cone_curvatures.h"

#include "../base/tolerances.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ricci {

namespace {

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
			m_turns[i] = std::min(kMaxQuarterTurns, std::round(values[i] / kQuarterTurn));
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
			const auto [up, down] = best(keepSum);
			if (up < 0 && down < 0)
				return;
			if (up >= 0)
				step(up, 1.0);
			if (down >= 0)
				step(down, -1.0);
		}
	}

	Eigen::VectorXd values() const { return kQuarterTurn * m_turns; }

private:
	int size() const { return static_cast<int>(m_turns.size()); }

	/// Half of what the energy rises by if curvature \p i changes by one quarter turn.
	double cost(int i, double by) const
	{
		return m_turns[i] + by > kMaxQuarterTurns ? kInfinity
												  : by * m_slope[i] + 0.5 * m_gram(i, i);
	}

	void step(int i, double by)
	{
		m_turns[i] += by;
		m_slope += by * m_gram.col(i);
	}

	/// The cones whose curvatures are to grow and to fall to lower the energy most; -1: none.
	std::pair<int, int> best(bool keepSum) const
	{
		std::pair<int, int> found{-1, -1};
		double lowest = -kCancelled * (1.0 + std::abs(m_gram(0, 0)));
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

	Eigen::VectorXd m_turns;
	Eigen::MatrixXd m_gram;  // of energies by quarter turns
	Eigen::VectorXd m_slope; // half the derivative of the energy by m_turns
};

} // namespace

Eigen::VectorXd multipliers(
	const Eigen::Ref<const Eigen::MatrixXd>& inverse,
	const std::vector<int>& held,
	const Eigen::VectorXd& excess)
{
	Eigen::VectorXd result = Eigen::VectorXd::Zero(excess.size());
	const Eigen::MatrixXd among = inverse(held, held);
	const Eigen::VectorXd there = excess(held);
	if (!held.empty())
		result(held) = among.ldlt().solve(there).eval();
	return result;
}

Eigen::VectorXd boundMultipliers(
	const Eigen::Ref<const Eigen::MatrixXd>& inverse,
	const Eigen::VectorXd& excess,
	Eigen::VectorXd start)
{
	Eigen::VectorXd m = std::move(start);
	std::vector<int> held;
	for (int i = 0; i < m.size(); ++i)
		if (m[i] > 0.0)
			held.push_back(i);
	double last = -kInfinity;
	for (;;) {
		// Towards the minimum with these at the bound, until one is pushed against it no longer.
		const Eigen::VectorXd wanted = multipliers(inverse, held, excess);
		auto released = held.end();
		double step = 1.0;
		for (auto i = held.begin(); i != held.end(); ++i)
			if (wanted[*i] < 0.0 && m[*i] / (m[*i] - wanted[*i]) < step) {
				step = m[*i] / (m[*i] - wanted[*i]);
				released = i;
			}
		m += step * (wanted - m);
		if (released != held.end()) {
			m[*released] = 0.0;
			held.erase(released);
			continue;
		}
		// The energy rises with each set, so that none comes twice.
		const double rise = m.dot(excess);
		Eigen::VectorXd above = excess - inverse * m;
		above(held).setZero();
		int first = 0;
		if (!(rise > last) || m.size() == 0 || above.maxCoeff(&first) <= kCancelled)
			return m;
		last = rise;
		held.push_back(first);
	}
}

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
