// SPDX-License-Identifier: GPL-3.0-or-later
#include "outline_packing.h"

#include "../base/numbers.h"

#include <algorithm>

namespace ricci {

Outline outlineOf(const FlatMesh& mesh, const std::vector<int>& triangles)
{
	const auto isFlipped = [&](int f) {
		const Triangle2 t = mesh.at(f);
		return doubledArea(t) < 0.0;
	};
	Outline outline;
	for (const int f : triangles)
		for (const Corner side : cornersOf(f)) {
			const auto [a, b] = mesh.ends(side);
			const Corner other = mesh.joined(side);
			if (a != b && !(other.isValid() && isFlipped(f) == isFlipped(other.face())))
				outline.push_back(isFlipped(f) ? std::array{b, a} : std::array{a, b});
		}
	std::sort(outline.begin(), outline.end());
	return outline;
}

std::complex<double> uprightTurn(const Outline& outline)
{
	constexpr int kDegrees = 90; // directions modulo a right angle
	// Fourth powers of directions: those at right angles are one.
	std::vector<std::complex<double>> fourth;
	std::array<double, kDegrees> lengths{};
	double total = 0.0;
	for (const auto& s : outline) {
		const std::complex<double> side = asComplex(s[1] - s[0]);
		const double length = std::abs(side);
		const std::complex<double> square = length > 0.0 ? side / length * (side / length) : 0.0;
		fourth.push_back(length * square * square);
		total += length;
		const double angle = kDegrees * (0.5 + std::arg(fourth.back()) / (2.0 * kPi));
		lengths[positionOf(std::clamp(static_cast<int>(angle), 0, kDegrees - 1))] += length;
	}
	const auto around = [&](int degree) {
		return lengths[positionOf((degree + kDegrees - 1) % kDegrees)] +
			   lengths[positionOf(degree)] + lengths[positionOf((degree + 1) % kDegrees)];
	};
	int best = 0;
	for (int degree = 1; degree < kDegrees; ++degree)
		if (around(degree) > around(best))
			best = degree;
	std::complex<double> mean = std::polar(1.0, 2.0 * kPi * ((best + 0.5) / kDegrees - 0.5));
	double straight = 0.0;
	for (const double degrees : {2.0, 1.0}) { // about the middle of these three, then their mean
		const std::complex<double> middle = mean / std::abs(mean);
		mean = 0.0;
		straight = 0.0;
		for (const std::complex<double>& side : fourth)
			if ((side * std::conj(middle)).real() >
				std::cos(4.0 * degrees * kPi / 180.0) * std::abs(side)) {
				mean += side;
				straight += std::abs(side);
			}
		if (!(2.0 * straight > total))
			return 0.0;
	}
	return std::conj(std::sqrt(std::sqrt(mean / std::abs(mean))));
}

} // namespace ricci
