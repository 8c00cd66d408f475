// SPDX-License-Identifier: GPL-3.0-or-later
#include "canonical_generators.h"

#include "../base/numbers.h"
#include "../base/task.h"
#include "../base/tolerances.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace ricci {

namespace {

/// Newton steps of closeRelation(): the first removes all that is not rounding.
constexpr int kClosingSteps = 3;

/// Ways to make a word canonical that are followed at the same time: at most so many, and only so
/// many that no more than kReadPairs pairs of letters are read in one step. From genus 25 on these
/// are fewer.
constexpr std::size_t kFollowed = 64, kReadPairs = kFollowed * 100 * 100;

std::size_t followed(std::size_t letters)
{
	return std::clamp<std::size_t>(kReadPairs / (letters * letters), 1, kFollowed);
}

ExtendedIsometry isometryOf(const GroupLetter& letter, const Array<ExtendedIsometry>& generators)
{
	const ExtendedIsometry& g = generators[letter.generator];
	return letter.inverse ? g.inverse() : g;
}

/// Product of letters [from, to) of a word.
ExtendedIsometry productOf(
	const GroupWord& word,
	std::size_t from,
	std::size_t to,
	const Array<ExtendedIsometry>& generators)
{
	ExtendedIsometry product;
	for (std::size_t i = from; i < to; ++i)
		product = product * isometryOf(word[i], generators);
	return product;
}

/// How far \p m moves 0: the square of sinh(displacement / 2), infinite where it cannot be told.
double sizeOf(const ExtendedIsometry& m)
{
	const auto size = static_cast<double>(norm(m.b));
	return std::isfinite(size) ? size : kInfinity;
}

/// A word that is partly made canonical: it is [a1,b1] ... [ak,bk] times the open part, conjugated.
struct PartlyCanonical
{
	Handles handles;
	ExtendedIsometry conjugation;
	GroupWord open;
	double size = 0.0; ///< largest of an isometry above
};

/// The open part of a word, rotated so that it begins with letter \p x, as x P y Q x^-1 R y^-1 S.
struct Reading
{
	std::size_t from; ///< number of the word
	std::size_t x, y; ///< y is counted from x
	double size;      ///< of the word with one more handle that this gives
};

/// One more handle (a, b), read as above.
/// \param outer conjugation of the rotated word
/// \return the conjugation with it, a, b
std::array<ExtendedIsometry, 3> handleOf(
	const ExtendedIsometry& outer,
	const ExtendedIsometry& x,
	const ExtendedIsometry& p,
	const ExtendedIsometry& y,
	const ExtendedIsometry& q,
	const ExtendedIsometry& r)
{
	const ExtendedIsometry conjugation = outer * r * q, back = conjugation.inverse();
	return {conjugation, outer * x * back, conjugation * p * y * q * back};
}

/// Position of the inverse of each letter.
std::vector<std::size_t> partnersIn(const GroupWord& word, int generators)
{
	Array<std::size_t> first(generators, word.size());
	std::vector<std::size_t> partner(word.size());
	for (std::size_t i = 0; i < word.size(); ++i) {
		std::size_t& j = first[word[i].generator];
		if (j < word.size()) {
			partner[i] = j;
			partner[j] = i;
		}
		j = i;
	}
	return partner;
}

/// Appends all readings of the open part.
void appendReadings(
	const PartlyCanonical& word,
	std::size_t number,
	const Array<ExtendedIsometry>& generators,
	std::vector<Reading>& readings)
{
	const std::size_t n = word.open.size();
	const std::vector<std::size_t> partner = partnersIn(word.open, generators.size());
	std::vector<ExtendedIsometry> letters; // twice, so that a rotated word is a range
	for (std::size_t i = 0; i < 2 * n; ++i)
		letters.push_back(isometryOf(word.open[i % n], generators));
	ExtendedIsometry outer = word.conjugation; // open = (first letters) rotated (first letters)^-1
	std::vector<ExtendedIsometry> qs(n), rs(n);
	for (std::size_t x = 0; x < n; ++x) {
		const auto turned = [&](std::size_t i) { return (partner[(x + i) % n] + n - x) % n; };
		const ExtendedIsometry* letter = &letters[x];
		const std::size_t x2 = turned(0);
		ExtendedIsometry product;
		for (std::size_t i = x2; i-- > 1;) { // qs[y]: the letters between y and x^-1
			qs[i] = product;
			product = letter[i] * product;
		}
		product = ExtendedIsometry();
		for (std::size_t i = x2 + 1; i < n; ++i) { // rs[y2]: those between x^-1 and y^-1
			rs[i] = product;
			product = product * letter[i];
		}
		ExtendedIsometry p;
		for (std::size_t y = 1; y < x2; ++y) {
			if (const std::size_t y2 = turned(y); y2 > x2) {
				double size = word.size;
				for (const ExtendedIsometry& m :
					 handleOf(outer, letter[0], p, letter[y], qs[y], rs[y2]))
					size = std::max(size, sizeOf(m));
				readings.push_back({number, x, y, size});
			}
			p = p * letter[y];
		}
		outer = outer * letter[0];
		checkpoint();
	}
}

/// The word with the handle of a reading.
PartlyCanonical withHandle(
	const PartlyCanonical& from, const Reading& reading, const Array<ExtendedIsometry>& generators)
{
	GroupWord word = from.open;
	const auto x = word.begin() + static_cast<std::ptrdiff_t>(reading.x);
	const ExtendedIsometry outer =
		from.conjugation * productOf(from.open, 0, reading.x, generators);
	std::rotate(word.begin(), x, word.end());
	const std::vector<std::size_t> partner = partnersIn(word, generators.size());
	const std::size_t y = reading.y, x2 = partner[0], y2 = partner[y];
	const auto [conjugation, a, b] = handleOf(
		outer,
		isometryOf(word[0], generators),
		productOf(word, 1, y, generators),
		isometryOf(word[y], generators),
		productOf(word, y + 1, x2, generators),
		productOf(word, x2 + 1, y2, generators));
	PartlyCanonical step;
	step.handles = from.handles;
	step.handles.push_back(a);
	step.handles.push_back(b);
	step.conjugation = conjugation;
	step.size = reading.size;
	const auto append = [&](std::size_t begin, std::size_t end) {
		for (std::size_t i = begin; i < end; ++i)
			step.open.push_back(word[i]);
	};
	append(1, y);
	append(y2 + 1, word.size());
	append(x2 + 1, y2);
	append(y + 1, x2);
	return step;
}

using Vector3 = Eigen::Matrix<DoubleDouble, 3, 1>;
using Matrix3 = Eigen::Matrix<DoubleDouble, 3, 3>;

/// How far \p m is from +-1, in the Lie algebra of SU(1,1): the matrices
/// (i x0, x1 + i x2; x1 - i x2, -i x0).
Vector3 nearIdentity(const ExtendedIsometry& m)
{
	const double sign = m.a.real() < 0 ? -1 : 1;
	return sign * Vector3(m.a.imag(), m.b.real(), m.b.imag());
}

/// x -> m x m^-1 on the Lie algebra.
Matrix3 adjoint(const ExtendedIsometry& m)
{
	Matrix3 columns;
	const ExtendedIsometry back = m.inverse();
	for (int k = 0; k < 3; ++k) {
		// x is not an isometry, but the product of these pairs is that of the matrices they stand for.
		const ExtendedIsometry x{
			{0.0, k == 0 ? 1.0 : 0.0}, {k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0}};
		const ExtendedIsometry image = m * x * back;
		columns.col(k) = Vector3(image.a.imag(), image.b.real(), image.b.imag());
	}
	return columns;
}

} // namespace

std::vector<Handles>
canonicalBases(const GroupWord& word, const Array<ExtendedIsometry>& generators)
{
	const double farthest = std::pow(std::sinh(kMaxSearchedDistance / 2), 2);
	std::vector<PartlyCanonical> best(1);
	best.front().open = word;
	while (!best.front().open.empty()) {
		std::vector<Reading> readings;
		for (std::size_t i = 0; i < best.size(); ++i)
			appendReadings(best[i], i, generators, readings);
		if (readings.empty())
			throw InternalError("The fundamental polygon has more than one corner");
		std::stable_sort(readings.begin(), readings.end(), [](const auto& r, const auto& s) {
			return r.size < s.size;
		});
		readings.resize(std::min(readings.size(), followed(best.front().open.size())));
		std::vector<PartlyCanonical> steps;
		for (const Reading& reading : readings)
			if (reading.size <= farthest)
				steps.push_back(withHandle(best[reading.from], reading, generators));
		if (steps.empty())
			return {};
		best = std::move(steps);
	}
	std::vector<Handles> bases;
	bases.reserve(best.size());
	for (PartlyCanonical& done : best)
		bases.push_back(std::move(done.handles));
	return bases;
}

void closeRelation(
	const GroupWord& word, const ExtendedIsometry& tail, Array<ExtendedIsometry>& generators)
{
	for (int step = 0; step < kClosingSteps; ++step) {
		Array<Matrix3> derivative(generators.size(), Matrix3::Zero());
		ExtendedIsometry prefix;
		for (const GroupLetter& letter : word) {
			// A generator g becomes exp(x) g, and its inverse g^-1 exp(-x).
			const ExtendedIsometry after = prefix * isometryOf(letter, generators);
			derivative[letter.generator] += letter.inverse ? -adjoint(after) : adjoint(prefix);
			prefix = after;
		}
		Matrix3 normal = Matrix3::Zero();
		for (const Matrix3& d : derivative)
			normal += d * d.transpose();
		const Vector3 multiplier = -normal.ldlt().solve(nearIdentity(prefix * tail));
		for (int g = 0; g < generators.size(); ++g) {
			const Vector3 x = derivative[g].transpose() * multiplier;
			generators[g] =
				(ExtendedIsometry{{1, x[0]}, {x[1], x[2]}} * generators[g]).normalised();
		}
	}
}

namespace {

using Isometry = ExtendedIsometry;

/// A move has to bring the condition below this share.
constexpr double kWorthMoving = 0.9;

/// Bases at most, and bases times the square of the number of letters in their relation.
constexpr std::size_t kMaxTried = 32, kTriedLetters = 64 * 20 * 20;

/// The operator norm: exp(d / 2) where 0 is moved by d.
double operatorNorm(const Isometry& m)
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
		sum += operatorNorm(corner) * operatorNorm(letter) * operatorNorm(next);
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
		m_letters.clear();
		m_best = kWorthMoving * m_condition;
		for (std::size_t i = 0; i < m_handles.size(); i += 2) {
			considerOnHandle(i);
			if (i + 2 < m_handles.size())
				considerOnPair(i);
		}
		if (m_isClosed)
			considerConjugations();
		if (m_letters.empty())
			return false;
		std::copy(
			m_letters.begin(),
			m_letters.end(),
			m_handles.begin() + static_cast<std::ptrdiff_t>(m_first));
		std::copy(m_handles.begin(), m_handles.end(), m_generators.begin());
		closeRelation(m_word, m_tail, m_generators);
		std::copy(m_generators.begin(), m_generators.end(), m_handles.begin());
		measure();
		return true;
	}

private:
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
		if (condition < m_best && lost <= kUnitRoundoff * added) {
			m_first = first;
			m_letters.assign(letters.begin(), letters.end());
			m_best = condition;
		}
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
	Handles m_letters;              // of the best move, for those from m_first on
	std::size_t m_first = 0;
	double m_best = 0.0; // the condition after it
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
	double lowest = kInfinity;
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
