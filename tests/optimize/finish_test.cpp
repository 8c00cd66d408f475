// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat_maps.h"
#include "support/random.h"

#include <ricci/base/orientation.h>
#include <ricci/optimize/finish.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace ricci::testing {
namespace {

FinishCounts finishSquare(FlatMesh& flat, bool freeBoundary, Finish finish)
{
	const VertexArray<char> none(flat.vertexCount(), 0);
	return finishInPlane(flat, none, freeBoundary, {}, finish, true);
}

/// Energy at a scale that does not change, and a twentieth of the length of the sides between triangles that are
/// counter-clockwise and those that are not, which are cut off.
double costWithCuts(const FlatMesh& flat)
{
	double energy = 0.0, cut = 0.0, area = 0.0;
	const FlatMesh surface = square();
	for (const int f : flat.points.indices()) {
		const auto side = [&](const FlatMesh& mesh, std::size_t k) {
			return asComplex(mesh.at(f)[k]) - asComplex(mesh.at(f)[0]);
		};
		// z -> alpha z + beta conj(z) has the singular values | |alpha| +- |beta| |.
		const std::complex<double> a = side(surface, 1), b = side(surface, 2);
		const std::complex<double> c = side(flat, 1), d = side(flat, 2);
		const std::complex<double> size = a * std::conj(b) - std::conj(a) * b;
		const double alpha = std::abs((c * std::conj(b) - d * std::conj(a)) / size);
		const double beta = std::abs((a * d - b * c) / size);
		const double sum = (alpha + beta) * (alpha + beta),
					 difference = (alpha - beta) * (alpha - beta);
		energy += 0.25 * std::abs(size) * (sum + difference + 1.0 / sum + 1.0 / difference);
		area += 0.25 * std::abs(size);
		for (const Corner own : cornersOf(f))
			if (const Corner other = flat.joined(own); other.isValid() &&
													   orientation(flat.at(f)) <= 0 &&
													   orientation(flat.at(other.face())) > 0)
				cut += flat.lengths[own];
	}
	return energy / area + 0.05 * cut / std::sqrt(area);
}

/// Where flipped triangles may be cut off, they are mended only if that costs less; else at any price.
TEST(FinishInPlane, RepairsWhatIsCheaperThanACut)
{
	Random random(7);
	int mended = 0, left = 0;
	for (int i = 0; i < 40; ++i) {
		const bool movesBorder = i % 2 > 0;
		const double cells = movesBorder ? 2.0 : 0.8;
		FlatMesh flat = square();
		for (const int v : flat.place.indices())
			if (movesBorder || isInside(v))
				flat.place[v] =
					flat.place[v] + Point2{random.real(-cells, cells), random.real(-cells, cells)};
		FlatMesh kept = flat;
		const double before = costWithCuts(flat);
		const int flipped = notCounterClockwise(flat);
		finishSquare(flat, false, Finish::Repair);
		mended += flipped - notCounterClockwise(flat);
		left += notCounterClockwise(flat);
		EXPECT_LE(costWithCuts(flat), before * (1.0 + 1e-9));
		const VertexArray<char> none(kept.vertexCount(), 0);
		finishInPlane(kept, none, false, {}, Finish::Repair, false);
		EXPECT_LE(notCounterClockwise(kept), movesBorder ? notCounterClockwise(flat) : 0);
	}
	EXPECT_GT(mended, 40);
	EXPECT_GT(left, 0);
}

} // namespace
} // namespace ricci::testing
