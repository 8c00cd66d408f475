// SPDX-License-Identifier: GPL-3.0-or-later
#include "handle_moves.h"

#include "../base/task.h"
#include "../base/tolerances.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace ricci {

namespace {

using Isometry = ExtendedIsometry;

/// A move has to bring the condition below this share.
constexpr double kWorthMoving = 0.9;

/// Bases at most, and bases times the square of the number of letters in their relation.
constexpr std::size_t kMaxTried = 32, kTriedLetters = 64 * 20 * 20;

/// The operator norm: exp(d / 2) where 0 is moved by d.
double sizeOf(const Isometry& m)
{
	return static_cast<double>(abs(m.a) + abs(m.b));
}

/// The share of one handle in the condition, see bestConditioned().
/// \param corner product of the letters before it; becomes that with its letters
double conditionOf(const Isometry& a, const Isometry& b, Isometry& corner)
{
	double sum = 0.0;
	for (const Isometry& letter : {a, b, a.inverse(), b.inverse()}) {
		const Isometry next = corner * letter;
		sum += sizeOf(corner) * sizeOf(letter) * sizeOf(next);
		corner = next;
	}
	return sum;
}

/// One basis and the best of its moves, in buffers that serve one basis after the other.
class HandleMoves
{
public:
	/// \param letters of every basis
	HandleMoves(std::size_t letters, const std::vector<Isometry>& peripheral) :
			m_isClosed(peripheral.empty()), m_generators(static_cast<int>(letters))
	{
		for (const Isometry& element : peripheral)
			m_tail = m_tail * element;
		for (int a = 0; a < m_generators.size(); a += 2)
			m_word.insert(m_word.end(), {{a, false}, {a + 1, false}, {a, true}, {a + 1, true}});
	}

	void start(const Handles& handles)
	{
		m_handles = handles;
		measure();
	}

	const Handles& handles() const { return m_handles; }
	double condition() const { return m_condition; }

	/// \return false if no move is worth it
	bool improve()
	{
		m_best.letters.clear();
		m_best.condition = kWorthMoving * m_condition;
		for (std::size_t i = 0; i < m_handles.size(); i += 2) {
			considerOnHandle(i);
			if (i + 2 < m_handles.size())
				considerOnPair(i);
		}
		if (m_isClosed)
			considerConjugations();
		if (m_best.letters.empty())
			return false;
		std::copy(
			m_best.letters.begin(),
			m_best.letters.end(),
			m_handles.begin() + static_cast<std::ptrdiff_t>(m_best.first));
		close();
		measure();
		return true;
	}

private:
	/// New letters for those from \p first on.
	struct Move
	{
		std::size_t first = 0;
		Handles letters;
		double condition = 0.0; ///< of the relation with them
	};

	void considerOnHandle(std::size_t i)
	{
		const Isometry &a = m_handles[i], &b = m_handles[i + 1];
		const Isometry back = a.inverse(), down = b.inverse();
		using Letters = std::array<Isometry, 2>;
		for (const Letters& letters :
			 {Letters{a * b, b},
			  Letters{a * down, b},
			  Letters{a, b * a},
			  Letters{a, b * back},
			  Letters{a * b * back, back},
			  Letters{down, b * a * down}})
			consider(i, letters, m_corner[i / 2 + 1]);
	}

	void considerOnPair(std::size_t i)
	{
		const Isometry &a1 = m_handles[i], &b1 = m_handles[i + 1];
		const Isometry &a2 = m_handles[i + 2], &b2 = m_handles[i + 3];
		const Isometry k1 = a1 * b1 * a1.inverse() * b1.inverse(), k1Back = k1.inverse();
		const Isometry k2 = a2 * b2 * a2.inverse() * b2.inverse(), k2Back = k2.inverse();
		const Isometry& after = m_corner[i / 2 + 2];
		using Letters = std::array<Isometry, 4>;
		consider(i, Letters{k1 * a2 * k1Back, k1 * b2 * k1Back, a1, b1}, after);
		consider(i, Letters{a2, b2, k2Back * a1 * k2, k2Back * b1 * k2}, after);
		const Isometry twist = b1.inverse() * a2 * b2 * a2.inverse();
		for (const Isometry& c : {twist, twist.inverse()})
			consider(i, Letters{a1 * c.inverse(), c * b1 * c.inverse(), c * a2, b2}, after);
	}

	void considerConjugations()
	{
		for (const Isometry& letter : m_handles)
			for (const Isometry& c : {letter, letter.inverse()}) {
				m_conjugates.clear();
				for (const Isometry& m : m_handles)
					m_conjugates.push_back(c * m * c.inverse());
				consider(0, m_conjugates, Isometry());
			}
	}

	/// \param after product of all letters up to the last of \p letters, which is to stay
	template<class Letters>
	void consider(std::size_t first, const Letters& letters, const Isometry& after)
	{
		double condition = m_condition, added = 0.0;
		Isometry corner = m_corner[first / 2];
		for (std::size_t i = 0; i < letters.size(); i += 2) {
			condition -= m_share[(first + i) / 2];
			added += conditionOf(letters[i], letters[i + 1], corner);
		}
		condition += added;
		// Short products of long isometries may be nothing but rounding.
		const auto lost = static_cast<double>((after.inverse() * corner).distanceFromIdentity());
		if (condition < m_best.condition && lost <= kUnitRoundoff * added) {
			m_best.first = first;
			m_best.letters.assign(letters.begin(), letters.end());
			m_best.condition = condition;
		}
	}

	void close()
	{
		std::copy(m_handles.begin(), m_handles.end(), m_generators.begin());
		closeRelation(m_word, m_tail, m_generators);
		std::copy(m_generators.begin(), m_generators.end(), m_handles.begin());
	}

	void measure()
	{
		m_condition = 0.0;
		m_share.clear();
		m_corner.assign(1, Isometry());
		for (std::size_t i = 0; i < m_handles.size(); i += 2) {
			Isometry corner = m_corner.back();
			m_share.push_back(conditionOf(m_handles[i], m_handles[i + 1], corner));
			m_condition += m_share.back();
			m_corner.push_back(corner);
		}
	}

	Handles m_handles;
	Isometry m_tail;
	bool m_isClosed;
	GroupWord m_word; // [a1,b1] ... [ag,bg]
	double m_condition = 0.0;
	std::vector<double> m_share;    // of each handle in it
	std::vector<Isometry> m_corner; // products of the letters before each handle, and of all
	Move m_best;
	Handles m_conjugates;
	Array<Isometry> m_generators;
};

} // namespace

Handles bestConditioned(const std::vector<Handles>& bases, const std::vector<Isometry>& peripheral)
{
	Handles best;
	if (bases.empty())
		return best;
	const std::size_t letters = 2 * bases.front().size();
	const std::size_t tried = std::clamp<std::size_t>(
		kTriedLetters / std::max<std::size_t>(1, letters * letters), 1, kMaxTried);
	double lowest = std::numeric_limits<double>::infinity();
	HandleMoves moves(bases.front().size(), peripheral);
	for (std::size_t i = 0; i < std::min(tried, bases.size()); ++i) {
		moves.start(bases[i]);
		do
			checkpoint();
		while (moves.improve());
		const bool isFar =
			std::any_of(moves.handles().begin(), moves.handles().end(), [](const Isometry& m) {
				return !(m.displacement() <= kMaxGeneratorDistance);
			});
		if (!isFar && moves.condition() < lowest) {
			lowest = moves.condition();
			best = moves.handles();
		}
	}
	return best;
}

} // namespace ricci
