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
	const auto size = static_cast<int>(values.size());
	const Eigen::MatrixXd ofTurns = kQuarterTurn * kQuarterTurn * gram;
	Eigen::VectorXd turns(size);
	for (int i = 0; i < size; ++i)
		turns[i] = std::min(kMaxQuarterTurns, std::round(values[i] / kQuarterTurn));
	const Eigen::VectorXd scaled = kQuarterTurn * linear;
	Eigen::VectorXd slope = ofTurns * turns + scaled; // half the derivative of the energy by turns
	// Half of what the energy rises by if a curvature changes by one quarter turn.
	const auto cost = [&](int i, double by) {
		return turns[i] + by > kMaxQuarterTurns ? kInfinity : by * slope[i] + 0.5 * ofTurns(i, i);
	};
	const auto step = [&](int i, double by) {
		turns[i] += by;
		slope += by * ofTurns.col(i);
	};
	// The sum first, by the cheapest steps.
	double missing = total ? std::round(*total / kQuarterTurn) - turns.sum() : 0.0;
	while (missing != 0.0) {
		const double by = missing > 0.0 ? 1.0 : -1.0;
		int cheapest = 0;
		for (int i = 1; i < size; ++i)
			if (cost(i, by) < cost(cheapest, by))
				cheapest = i;
		step(cheapest, by);
		missing -= by;
	}
	for (int s = 0; s < kStepsPerCone * size; ++s) {
		// The curvatures that are to grow and to fall to lower the energy most; -1: none.
		int up = -1, down = -1;
		double lowest = -kCancelled * (1.0 + std::abs(ofTurns(0, 0)));
		const auto consider = [&](int grows, int falls, double change) {
			if (change < lowest) {
				lowest = change;
				up = grows;
				down = falls;
			}
		};
		for (int i = 0; i < size; ++i) {
			if (!total) {
				consider(i, -1, cost(i, 1.0));
				consider(-1, i, cost(i, -1.0));
			}
			for (int j = 0; j < size; ++j)
				if (i != j)
					consider(i, j, cost(i, 1.0) + cost(j, -1.0) - ofTurns(i, j));
		}
		if (up < 0 && down < 0)
			break;
		if (up >= 0)
			step(up, 1.0);
		if (down >= 0)
			step(down, -1.0);
	}
	return kQuarterTurn * turns;
}

} // namespace ricci
