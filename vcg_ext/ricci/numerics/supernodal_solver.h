// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SUPERNODAL_SOLVER_H
#define RICCI_SUPERNODAL_SOLVER_H

#include "../base/indexed.h"
#include "../base/parallel.h"

#include <Eigen/Core>

#include <cholmod.h>

#include <algorithm>
#include <vector>

namespace ricci {

/// CHOLMOD's numbers of entries. The factor of ten million unknowns has more of them than int can
/// tell; below that nothing but the analysis takes longer, by half.
using Long = SuiteSparse_long;

/// Solutions with a real supernodal factor of CHOLMOD, in its order of elimination. CHOLMOD's own
/// function calls BLAS for each supernode, most of which are so small that the calls take as long as the
/// arithmetic: this is 1.5 to 1.8 times as fast for one column, 1.6 to 2.6 times for two.
///
/// Subtrees of the elimination tree do not depend on each other. They are put into a fixed number of groups,
/// which threads share; what a group leaves to the rows above all groups is summed apart and added in the
/// order of the groups. So the result has the same bits for any number of threads.
class SupernodalSolver
{
public:
	/// Groups the supernodes of a factor whose solutions follow, after each symbolic factorisation.
	void plan(const cholmod_factor& factor)
	{
		const auto count = static_cast<int>(factor.nsuper);
		std::vector<int> parent(positionOf(count), -1);
		std::vector<double> weight(positionOf(count), 0.0); // entries in the subtree
		for (int k = 0; k < count; ++k) {
			const Supernode node = supernode(factor, k);
			if (node.height > 0)
				parent[positionOf(k)] = supernodeOf(factor, node.below[0]);
			weight[positionOf(k)] += double(node.width) * (node.width + node.height);
			if (parent[positionOf(k)] >= 0)
				weight[positionOf(parent[positionOf(k)])] += weight[positionOf(k)];
		}
		double whole = 0.0;
		for (int k = 0; k < count; ++k)
			whole += parent[positionOf(k)] < 0 ? weight[positionOf(k)] : 0.0;

		m_groups.assign(whole < kWorthGroups ? 0 : kGroups, {});
		m_above.clear();
		std::vector<int> group(positionOf(count), -1);
		std::vector<double> load(m_groups.size(), 0.0);
		m_numberAbove.assign(factor.n, -1);
		m_rowsAbove.clear();
		for (int k = count; k-- > 0;) { // parents first
			const auto at = positionOf(k);
			if (parent[at] >= 0 && group[positionOf(parent[at])] >= 0)
				group[at] = group[positionOf(parent[at])];
			else if (weight[at] * 2 * kGroups < whole && !m_groups.empty()) {
				const auto least = std::min_element(load.begin(), load.end());
				*least += weight[at];
				group[at] = static_cast<int>(least - load.begin());
			}
			if (group[at] >= 0)
				continue;
			const Supernode node = supernode(factor, k);
			for (int c = 0; c < node.width; ++c) {
				m_numberAbove[positionOf(node.first + c)] = static_cast<int>(m_rowsAbove.size());
				m_rowsAbove.push_back(node.first + c);
			}
		}
		for (int k = 0; k < count; ++k)
			(group[positionOf(k)] < 0 ? m_above : m_groups[positionOf(group[positionOf(k)])])
				.push_back(k);
	}

	void solve(const cholmod_factor& factor, Eigen::VectorXd& x) { solve<1>(factor, x.data()); }

	/// Two columns, as real and imaginary parts, in one pass over the factor.
	void solve(const cholmod_factor& factor, Eigen::VectorXcd& x)
	{
		solve<2>(factor, reinterpret_cast<double*>(x.data())); // std::complex is two doubles
	}

private:
	static constexpr int kGroups = 16;
	/// Entries of a factor with which a solution takes longer than a thread's start.
	static constexpr double kWorthGroups = 3e5;

	/// Columns first .. first + width - 1 of the factor, which have the same rows: their own, and
	/// \p height others below. Stored by columns, each from the diagonal block's first row.
	struct Supernode
	{
		int first, width, height;
		const Long* below; ///< [height] rows below the diagonal block
		const double* values;

		const double* column(int c) const
		{
			return values + positionOf(c) * (positionOf(width) + positionOf(height));
		}
		using Vector = Eigen::Map<const Eigen::VectorXd>;
		Vector columnBelow(int c) const { return {column(c) + width, height}; }
	};

	static Supernode supernode(const cholmod_factor& factor, int number)
	{
		const auto k = positionOf(number);
		const auto* first = static_cast<const Long*>(factor.super);
		const auto* rows = static_cast<const Long*>(factor.pi);
		const auto* start = static_cast<const Long*>(factor.px);
		const auto width = static_cast<int>(first[k + 1] - first[k]);
		return {
			static_cast<int>(first[k]),
			width,
			static_cast<int>(rows[k + 1] - rows[k]) - width,
			static_cast<const Long*>(factor.s) + rows[k] + width,
			static_cast<const double*>(factor.x) + start[k]};
	}

	static int supernodeOf(const cholmod_factor& factor, Long column)
	{
		const auto* first = static_cast<const Long*>(factor.super);
		return static_cast<int>(std::upper_bound(first, first + factor.nsuper, column) - first) - 1;
	}

	/// x = L^-T L^-1 x for \p Columns columns, whose entries of one row lie beside each other.
	template<int Columns>
	void solve(const cholmod_factor& factor, double* x)
	{
		const auto groups = static_cast<int>(m_groups.size());
		const std::size_t room = Columns * factor.maxesize, sums = Columns * m_rowsAbove.size();
		m_work.resize((room + sums) * positionOf(groups) + room);
		const auto workOf = [&](int group) {
			return m_work.data() + (room + sums) * positionOf(group);
		};
		const auto inGroups = [&](const auto& work) {
			inParallel(
				groups,
				defaultThreads(),
				[&](int first, int last) {
					for (int g = first; g < last; ++g)
						work(m_groups[positionOf(g)], workOf(g));
				},
				1);
		};
		const std::integral_constant<int, Columns> columns;
		inGroups([&](const std::vector<int>& nodes, double* below) {
			double* above = below + room;
			std::fill(above, above + sums, 0.0);
			for (const int k : nodes)
				solveForward(columns, supernode(factor, k), x, below, above);
		});
		for (int g = 0; g < groups; ++g)
			for (std::size_t i = 0; i < m_rowsAbove.size(); ++i)
				for (int c = 0; c < Columns; ++c)
					x[Columns * m_rowsAbove[i] + c] -=
						workOf(g)[room + Columns * i + positionOf(c)];
		for (const int k : m_above)
			solveForward(columns, supernode(factor, k), x, workOf(groups), nullptr);
		for (std::size_t i = m_above.size(); i-- > 0;)
			solveBackward(columns, supernode(factor, m_above[i]), x, workOf(groups));
		inGroups([&](const std::vector<int>& nodes, double* below) {
			for (std::size_t i = nodes.size(); i-- > 0;)
				solveBackward(columns, supernode(factor, nodes[i]), x, below);
		});
	}

	using One = std::integral_constant<int, 1>;
	using Two = std::integral_constant<int, 2>;

	/// Calls inX(r, row) for the rows below \p node up to the first one above its group, above(r, number) from
	/// there on. They are ancestors: none of the group comes after one above it.
	template<class InX, class Above>
	void
	forRowsBelow(const Supernode& node, bool hasAbove, const InX& inX, const Above& above) const
	{
		int r = 0;
		for (; r < node.height &&
			   (!hasAbove || m_numberAbove[static_cast<std::size_t>(node.below[r])] < 0);
			 ++r)
			inX(r, node.below[r]);
		for (; r < node.height; ++r)
			above(r, m_numberAbove[static_cast<std::size_t>(node.below[r])]);
	}

	/// x = L^-1 x for the rows of a supernode and what it subtracts from those below it, from \p above where
	/// they are above its group. A right side of few entries reaches few supernodes.
	void solveForward(One, const Supernode& node, double* x, double* workspace, double* above) const
	{
		double* own = x + node.first;
		if (std::all_of(own, own + node.width, [](double value) { return value == 0.0; }))
			return;
		for (int c = 0; c < node.width; ++c) {
			const double* column = node.column(c);
			own[c] /= column[c];
			for (int r = c + 1; r < node.width; ++r)
				own[r] -= column[r] * own[c];
		}
		Eigen::Map<Eigen::VectorXd> below(workspace, node.height);
		below.setZero();
		int c = 0;
		for (; c + 4 <= node.width; c += 4) // a quarter of the passes over the sums
			below += node.columnBelow(c) * own[c] + node.columnBelow(c + 1) * own[c + 1] +
					 node.columnBelow(c + 2) * own[c + 2] + node.columnBelow(c + 3) * own[c + 3];
		for (; c < node.width; ++c)
			below += node.columnBelow(c) * own[c];
		forRowsBelow(
			node,
			above,
			[&](int r, Long row) { x[row] -= below[r]; },
			[&](int r, int number) { above[number] += below[r]; });
	}

	/// x = L^-T x for the rows of a supernode.
	static void solveBackward(One, const Supernode& node, double* x, double* workspace)
	{
		double* own = x + node.first;
		Eigen::Map<Eigen::VectorXd> below(workspace, node.height);
		for (int r = 0; r < node.height; ++r)
			below[r] = x[node.below[r]];
		for (int c = node.width - 1; c >= 0; --c) {
			const double* column = node.column(c);
			double sum = own[c] - node.columnBelow(c).dot(below);
			for (int r = c + 1; r < node.width; ++r)
				sum -= column[r] * own[r];
			own[c] = sum / column[c];
		}
	}

	/// A complex number among the real and imaginary parts of many, for the machine's vectors.
	using Pair = Eigen::Array2d;
	static Eigen::Map<Pair> at(double* parts, Long i) { return Eigen::Map<Pair>(parts + 2 * i); }
	/// By hand: clang's code for Eigen's product waits for it, and takes up to twice as long.
	static Pair times(double factor, const Pair& pair)
	{
		return {factor * pair[0], factor * pair[1]};
	}

	void solveForward(Two, const Supernode& node, double* x, double* below, double* above) const
	{
		double* own = x + 2 * node.first;
		if (std::all_of(own, own + 2 * node.width, [](double value) { return value == 0.0; }))
			return;
		for (int c = 0; c < node.width; ++c) {
			const double* column = node.column(c);
			const Pair solved = at(own, c) / column[c];
			at(own, c) = solved;
			for (int r = c + 1; r < node.width; ++r)
				at(own, r) -= times(column[r], solved);
		}
		std::fill(below, below + 2 * node.height, 0.0);
		int c = 0;
		for (; c + 4 <= node.width; c += 4)
			addColumns<4>(node, c, own, below);
		for (; c < node.width; ++c)
			addColumns<1>(node, c, own, below);
		forRowsBelow(
			node,
			above,
			[&](int r, Long row) { at(x, row) -= at(below, r); },
			[&](int r, int number) { at(above, number) += at(below, r); });
	}

	/// Adds what columns first .. first + Count - 1 contribute to the rows below.
	template<int Count>
	static void addColumns(const Supernode& node, int first, double* own, double* below)
	{
		const double* values[Count];
		Pair solved[Count];
		for (int i = 0; i < Count; ++i) {
			values[i] = node.column(first + i) + node.width;
			solved[i] = at(own, first + i);
		}
		for (int r = 0; r < node.height; ++r) {
			Pair sum = at(below, r);
			for (int i = 0; i < Count; ++i)
				sum += times(values[i][r], solved[i]);
			at(below, r) = sum;
		}
	}

	static void solveBackward(Two, const Supernode& node, double* x, double* below)
	{
		double* own = x + 2 * node.first;
		for (int r = 0; r < node.height; ++r)
			at(below, r) = at(x, node.below[r]);
		for (int c = node.width - 1; c >= 0; --c) {
			const double *column = node.column(c), *values = column + node.width;
			Pair sum = at(own, c), others = Pair::Zero(); // two, which do not wait for each other
			int r = 0;
			for (; r + 2 <= node.height; r += 2) {
				sum -= times(values[r], at(below, r));
				others -= times(values[r + 1], at(below, r + 1));
			}
			if (r < node.height)
				sum -= times(values[r], at(below, r));
			sum += others;
			for (r = c + 1; r < node.width; ++r)
				sum -= times(column[r], at(own, r));
			at(own, c) = sum / column[c];
		}
	}

	std::vector<std::vector<int>> m_groups; // supernodes, children first
	std::vector<int> m_above;               // those above all groups, children first
	std::vector<int> m_rowsAbove;           // of these
	std::vector<int> m_numberAbove;         // [row] among m_rowsAbove, or -1
	/// Work space. Not an Eigen vector: memory is freed twice if its resize() fails.
	std::vector<double> m_work;
};

} // namespace ricci

#endif
