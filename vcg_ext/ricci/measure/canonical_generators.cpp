// SPDX-License-Identifier: GPL-3.0-or-later
#include "canonical_generators.h"

#include "../error.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace ricci {

namespace {

/// Newton steps of closeRelation(): the first removes all that is not rounding.
constexpr int kClosingSteps = 3;

/// Ways to make a word canonical that are followed at the same time.
constexpr std::size_t kFollowed = 64;

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

/// A word that is partly made canonical: it is [a1,b1] ... [ak,bk] times the open part, conjugated.
struct PartlyCanonical
{
	std::vector<ExtendedIsometry> handles;
	ExtendedIsometry conjugation;
	GroupWord open;
	long double size = 0; ///< largest displacement of an isometry above

	bool operator<(const PartlyCanonical& other) const { return size < other.size; }
};

/// Position of the inverse of letter \p i.
std::size_t partnerOf(const GroupWord& word, std::size_t i)
{
	std::size_t j = 0;
	while (j == i || word[j].generator != word[i].generator)
		++j;
	return j;
}

/// Reads the open part, rotated by every number of letters, as x P y Q x^-1 R y^-1 S in every way,
/// and appends the word with one more handle that each of them gives.
void appendSteps(
	const PartlyCanonical& from,
	const Array<ExtendedIsometry>& generators,
	std::vector<PartlyCanonical>& steps)
{
	GroupWord word = from.open;
	for (std::size_t rotation = 0; rotation < from.open.size(); ++rotation) {
		// open = (its first letters) word (its first letters)^-1
		const ExtendedIsometry outer =
			from.conjugation * productOf(from.open, 0, rotation, generators);
		const std::size_t x2 = partnerOf(word, 0);
		for (std::size_t y = 1; y < x2; ++y) {
			const std::size_t y2 = partnerOf(word, y);
			if (y2 < x2)
				continue;
			const ExtendedIsometry p = productOf(word, 1, y, generators);
			const ExtendedIsometry q = productOf(word, y + 1, x2, generators);
			const ExtendedIsometry r = productOf(word, x2 + 1, y2, generators);
			PartlyCanonical step;
			step.conjugation = outer * r * q;
			const ExtendedIsometry back = step.conjugation.inverse();
			step.handles = from.handles;
			step.handles.push_back(outer * productOf(word, 0, 1, generators) * back);
			step.handles.push_back(
				step.conjugation * p * productOf(word, y, y + 1, generators) * q * back);
			step.size = std::max(from.size, step.conjugation.displacement());
			for (std::size_t i = step.handles.size() - 2; i < step.handles.size(); ++i)
				step.size = std::max(step.size, step.handles[i].displacement());
			const auto append = [&](std::size_t begin, std::size_t end) {
				for (std::size_t i = begin; i < end; ++i)
					step.open.push_back(word[i]);
			};
			append(1, y);
			append(y2 + 1, word.size());
			append(x2 + 1, y2);
			append(y + 1, x2);
			steps.push_back(std::move(step));
		}
		std::rotate(word.begin(), word.begin() + 1, word.end());
	}
}

using Vector3 = Eigen::Matrix<long double, 3, 1>;
using Matrix3 = Eigen::Matrix<long double, 3, 3>;

/// How far \p m is from +-1, in the Lie algebra of SU(1,1): the matrices
/// (i x0, x1 + i x2; x1 - i x2, -i x0).
Vector3 nearIdentity(const ExtendedIsometry& m)
{
	const long double sign = m.a.real() < 0 ? -1 : 1;
	return sign * Vector3(m.a.imag(), m.b.real(), m.b.imag());
}

/// x -> m x m^-1 on the Lie algebra.
Matrix3 adjoint(const ExtendedIsometry& m)
{
	Matrix3 columns;
	const ExtendedIsometry back = m.inverse();
	for (int k = 0; k < 3; ++k) {
		// x is no isometry, but the product of these pairs is that of the matrices they stand for.
		const ExtendedIsometry x{
			{0, k == 0 ? 1.0L : 0.0L}, {k == 1 ? 1.0L : 0.0L, k == 2 ? 1.0L : 0.0L}};
		const ExtendedIsometry image = m * x * back;
		columns.col(k) = Vector3(image.a.imag(), image.b.real(), image.b.imag());
	}
	return columns;
}

} // namespace

ExtendedIsometry productOf(const GroupWord& word, const Array<ExtendedIsometry>& generators)
{
	return productOf(word, 0, word.size(), generators);
}

std::vector<ExtendedIsometry>
canonicalGenerators(const GroupWord& word, const Array<ExtendedIsometry>& generators)
{
	std::vector<PartlyCanonical> best(1), steps;
	best.front().open = word;
	while (!best.front().open.empty()) {
		steps.clear();
		for (const PartlyCanonical& partly : best)
			appendSteps(partly, generators, steps);
		if (steps.empty())
			throw InternalError("The fundamental polygon has more than one corner");
		std::stable_sort(steps.begin(), steps.end());
		steps.resize(std::min(steps.size(), kFollowed));
		best = std::move(steps);
	}
	return best.front().handles;
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

} // namespace ricci
