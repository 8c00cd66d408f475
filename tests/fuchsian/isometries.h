// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_ISOMETRIES_H
#define RICCI_TESTS_ISOMETRIES_H

#include "support/random.h"

#include <ricci/base/numbers.h>
#include <ricci/fuchsian/canonical_generators.h>

namespace ricci::testing {

inline ExtendedIsometry randomIsometry(double maxLength, Random& random)
{
	return (ExtendedIsometry::rotation(random.real(-kPi, kPi)) *
			ExtendedIsometry::translation(random.real(0.0, maxLength)) *
			ExtendedIsometry::rotation(random.real(-kPi, kPi)))
		.normalised();
}

/// [a1,b1] ... [ag,bg].
inline ExtendedIsometry relationOf(const Handles& handles)
{
	ExtendedIsometry product;
	for (std::size_t i = 0; i + 1 < handles.size(); i += 2) {
		const ExtendedIsometry &a = handles[i], &b = handles[i + 1];
		product = product * a * b * a.inverse() * b.inverse();
	}
	return product;
}

/// The condition of [a1,b1] ... [ag,bg] of which bestConditioned() speaks.
inline double relationCondition(const Handles& handles)
{
	const auto size = [](const ExtendedIsometry& m) {
		return static_cast<double>(abs(m.a) + abs(m.b));
	};
	double sum = 0.0;
	ExtendedIsometry corner;
	for (std::size_t i = 0; i + 1 < handles.size(); i += 2) {
		const ExtendedIsometry &a = handles[i], &b = handles[i + 1];
		for (const ExtendedIsometry& letter : {a, b, a.inverse(), b.inverse()}) {
			const ExtendedIsometry next = corner * letter;
			sum += size(corner) * size(letter) * size(next);
			corner = next;
		}
	}
	return sum;
}

} // namespace ricci::testing

#endif
