// SPDX-License-Identifier: GPL-3.0-or-later
#include "cone_curvatures.h"

#include "../base/indexed.h"
#include "../base/numbers.h"
#include "../base/tolerances.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace ricci {

namespace {

constexpr double kTiny = std::numeric_limits<double>::min();

/// A sum that is off by less than this share of its terms is so by rounding.
constexpr double kSumSlack = 1e-9;

class ActiveSet
{
public:
	ActiveSet(
		const Eigen::MatrixXd& gram,
		const Eigen::VectorXd& linear,
		double max,
		std::optional<double> total) :
			m_gram(gram),
			m_linear(linear), m_max(max), m_total(total), m_size(static_cast<int>(linear.size())),
			m_isBound(m_size, 0)
	{
	}

	Eigen::VectorXd minimum(const Eigen::VectorXd& start)
	{
		Eigen::VectorXd k =
			Eigen::VectorXd::Constant(m_size, m_total ? *m_total / m_size : std::min(m_max, 0.0));
		if (m_size == 0 || (m_total && k[0] >= m_max))
			return Eigen::VectorXd::Constant(m_size, m_max);
		if (isAllowed(start)) {
			k = start;
			for (int i = 0; i < m_size; ++i)
				m_isBound[i] = k[i] == m_max;
		}
		double last = std::numeric_limits<double>::infinity();
		for (;;) {
			const Eigen::VectorXd wanted = unbounded();
			if (const int reached = stepTo(wanted, k); reached >= 0) {
				m_isBound[reached] = 1;
				continue;
			}
			// The minima of the sets become lower each time, so that no set comes twice.
			const Eigen::VectorXd slope = m_gram * k + m_linear;
			const double energy = k.dot(slope + m_linear);
			const int released = energy < last ? steepest(slope) : -1;
			if (released < 0)
				return k;
			last = energy;
			m_isBound[released] = 0;
		}
	}

private:
	bool isAllowed(const Eigen::VectorXd& k) const
	{
		return k.size() == m_size && k.maxCoeff() <= m_max &&
			   (!m_total || std::abs(k.sum() - *m_total) <= kSumSlack * k.cwiseAbs().sum());
	}

	/// Moves \p k towards \p wanted, up to the first bound of a free entry.
	/// \return the entry, the first of several; -1 if \p k has become \p wanted
	int stepTo(const Eigen::VectorXd& wanted, Eigen::VectorXd& k) const
	{
		int first = -1;
		double step = 1.0;
		for (int i = 0; i < m_size; ++i) {
			if (m_isBound[i] || wanted[i] <= m_max)
				continue;
			const double room = (m_max - k[i]) / (wanted[i] - k[i]);
			if (first < 0 || room < step) {
				first = i;
				step = room;
			}
		}
		if (first < 0) {
			k = wanted;
			return -1;
		}
		k += step * (wanted - k);
		k = k.cwiseMin(m_max);
		k[first] = m_max;
		return first;
	}

	/// The bound entry whose release lowers the energy at the highest rate, -1 if none does.
	/// \param slope half the gradient of the energy
	int steepest(const Eigen::VectorXd& slope) const
	{
		int found = -1;
		for (int i = 0; i < m_size; ++i)
			if (m_isBound[i] && slope[i] + m_level > 0.0 && (found < 0 || slope[i] > slope[found]))
				found = i;
		return found;
	}

	/// The minimum among all k whose bound entries are at the bound; sets the multiplier of the sum,
	/// which makes up for the slope of free entries.
	Eigen::VectorXd unbounded()
	{
		Eigen::VectorXd k(m_size);
		std::vector<int> free;
		double total = m_total.value_or(0.0);
		for (int i = 0; i < m_size; ++i) {
			if (!m_isBound[i]) {
				free.push_back(i);
				continue;
			}
			k[i] = m_max;
			total -= m_max;
		}
		m_level = 0.0;
		const auto n = static_cast<int>(free.size());
		if (n == 0)
			return k;
		// Where the sum is fixed, any multiple of its square can be added, which makes the matrix
		// positive definite.
		const double sumWeight = m_total ? std::max(m_gram.trace() / m_size, kTiny) : 0.0;
		Eigen::MatrixXd system(n, n);
		Eigen::MatrixXd rhs = Eigen::MatrixXd::Ones(n, 2); // of the minimum, and of the sum
		for (int a = 0; a < n; ++a) {
			const int i = free[positionOf(a)];
			for (int b = 0; b < n; ++b)
				system(a, b) = m_gram(i, free[positionOf(b)]) + sumWeight;
			rhs(a, 0) = -m_linear[i];
			for (int j = 0; j < m_size; ++j)
				if (m_isBound[j])
					rhs(a, 0) -= m_gram(i, j) * m_max;
		}
		const Eigen::MatrixXd solution = system.ldlt().solve(rhs);
		const double lacking =
			m_total ? (total - solution.col(0).sum()) / solution.col(1).sum() : 0.0;
		for (int a = 0; a < n; ++a)
			k[free[positionOf(a)]] = solution(a, 0) + lacking * solution(a, 1);
		if (m_total)
			m_level = sumWeight * total - lacking;
		return k;
	}

	const Eigen::MatrixXd& m_gram;
	const Eigen::VectorXd& m_linear;
	double m_max;
	std::optional<double> m_total;
	int m_size;
	Array<char> m_isBound;
	double m_level = 0.0;
};

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
			m_turns[i] = std::min<double>(kMaxQuarterTurns, std::round(values[i] / kQuarterTurn));
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
		return m_turns[i] + by > kMaxQuarterTurns ? std::numeric_limits<double>::infinity()
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

	Eigen::VectorXd m_turns;
	Eigen::MatrixXd m_gram;  // of energies by quarter turns
	Eigen::VectorXd m_slope; // half the derivative of the energy by m_turns
};

} // namespace

Eigen::VectorXd boundedMinimum(
	const Eigen::MatrixXd& gram,
	const Eigen::VectorXd& linear,
	double max,
	std::optional<double> total,
	const Eigen::VectorXd& start)
{
	return ActiveSet(gram, linear, max, total).minimum(start);
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
