// SPDX-License-Identifier: GPL-3.0-or-later
// Rest shapes, and the energy that untangles.
#include "flat_maps.h"

#include <ricci/base/numbers.h>
#include <ricci/optimize/patch_energy.h>
#include <ricci/optimize/patches.h>
#include <ricci/optimize/repair.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace ricci::testing {
namespace {

using Complex = std::complex<double>;

const Validity kValid{1e-4, 1e-2, false};

/// More than any of them takes.
constexpr int kMaxSteps = 1000;

/// The whole of a drawing as one patch, with the shapes of the surface.
struct Whole
{
	FlatMesh flat;
	PointGroups groups;
	Patch patch;
	std::vector<TriangleShape> shapes;

	explicit Whole(FlatMesh d) : flat(std::move(d)), groups(insidePoints(flat))
	{
		const int middle = vertexAt(kSide / 2, kSide / 2);
		std::vector<int> seeds;
		for (const int f : flat.points.indices())
			for (const int p : flat.points[f])
				if (p == middle)
					seeds.push_back(f);
		std::vector<Patch> patches = PatchFinder(flat, groups).patches(seeds, 2 * kSide);
		patch = patches.at(0);
		shapes = restShapes(flat, patch, RestShapes::OfSurfaceEvenly, kValid);
	}

	Untangled solvedBy(decltype(untangle)& solve, int maxSteps = kMaxSteps) const
	{
		return solve({flat, groups, {RestShapes::OfSurfaceEvenly, kValid}}, patch, maxSteps);
	}

	/// The drawing with the patch's points at \p places.
	FlatMesh with(const std::vector<Point2>& places) const
	{
		FlatMesh moved = flat;
		for (std::size_t i = 0; i < places.size(); ++i)
			moved.place[patch.points[i]] = places[i];
		return moved;
	}

	double strainOf(const FlatMesh& d) const
	{
		double sum = 0.0;
		for (std::size_t i = 0; i < shapes.size(); ++i)
			sum += strain(shapes[i], d.at(patch.triangles[i]));
		return sum;
	}
};

/// The rest shapes fit together inside the border: there the energy is least.
TEST(Untangle, FindsTheSurfaceWhereItIsFlat)
{
	for (std::uint64_t seed = 1; seed <= 4; ++seed) {
		const Whole whole(tangled(20, seed));
		const Untangled valid = whole.solvedBy(untangle);
		ASSERT_FALSE(valid.points.empty());
		const Whole moved(whole.with(valid.points));
		const FlatMesh flat = square();
		const Untangled eased = moved.solvedBy(ease);
		ASSERT_FALSE(eased.points.empty());
		const FlatMesh last = moved.with(eased.points);
		EXPECT_LE(moved.strainOf(last), moved.strainOf(moved.flat));
		EXPECT_LT(moved.strainOf(last), 1.002 * (2.0 * kSide * kSide)); // the least: 1 each
		for (const int p : last.place.indices())
			EXPECT_LT(distance(last.place[p], flat.place[p]), 0.03);
	}
}

/// Three corners on the border decide: no point that moves can mend the triangle.
TEST(Untangle, SaysWhatItCannotMend)
{
	FlatMesh flat = tangled(20, 3);
	flat.place[vertexAt(kSide, 0)] = {kSide - 2.0, 2.0};
	const Untangled result = Whole(flat).solvedBy(untangle);
	EXPECT_TRUE(result.points.empty());
	EXPECT_GT(result.steps, 0);
}

TEST(Untangle, TakesNoMoreStepsThanItMay)
{
	const Whole whole(tangled(20, 5));
	const auto steps = [&](int maxSteps) { return whole.solvedBy(untangle, maxSteps).steps; };
	const int all = steps(kMaxSteps);
	ASSERT_GT(all, 3);
	for (int maxSteps = 0; maxSteps <= all + 2; ++maxSteps)
		EXPECT_EQ(steps(maxSteps), std::min(maxSteps, all));
}

TEST(Ease, LeavesWhatIsNotValidAlone)
{
	const Whole whole(tangled(20, 7));
	const Untangled result = whole.solvedBy(ease);
	EXPECT_TRUE(result.points.empty());
	EXPECT_EQ(result.steps, 0);
}

/// (|J|^2 + lambda (1 + det^2 J)) / det J over its value for the rest shape, with lambda = 0.1.
TEST(Strain, IsThatOfTheSingularValues)
{
	Random random(931);
	for (int trial = 0; trial < 200; ++trial) {
		const TriangleShape shape{
			random.real(0.1, 3.0), Complex(random.real(-2.0, 2.0), random.real(0.05, 2.0))};
		const double s = random.real(0.2, 4.0), t = random.real(0.2, 4.0);
		const Complex before = std::polar(1.0, random.real(0.0, 2 * kPi));
		const Complex after = std::polar(1.0, random.real(0.0, 2 * kPi));
		const Complex shift(random.real(-5, 5), random.real(-5, 5));
		const auto mapped = [&](Complex z, double sign) {
			z *= before;
			return asPoint(after * Complex(s * z.real(), sign * t * z.imag()) + shift);
		};
		const auto triangle = [&](double sign) {
			return Triangle2{mapped(0.0, sign), mapped(shape.base, sign), mapped(shape.apex, sign)};
		};
		const double expected = (s * s + t * t + 0.1 * (1.0 + s * s * t * t)) / (s * t) / 2.2;
		EXPECT_NEAR(strain(shape, triangle(1.0)), expected, 1e-9 * expected);
		EXPECT_EQ(strain(shape, triangle(-1.0)), std::numeric_limits<double>::infinity());
	}
	const TriangleShape unit{1.0, Complex(0.0, 1.0)};
	EXPECT_NEAR(strain(unit, {{{0, 0}, {1, 0}, {0, 1}}}), 1.0, 1e-15);
	EXPECT_EQ(strain(unit, {{{0, 0}, {1, 0}, {2, 0}}}), std::numeric_limits<double>::infinity());
}

constexpr Validity kLow{1e-6, 2e-6, false};

/// Three triangles round a point inside the triangle of three others, and the shapes that they get
/// where the four points lie at \p places in space.
std::vector<TriangleShape> shapesOf(const std::vector<Point2>& places)
{
	FlatMesh flat;
	flat.place = Array<Point2>(std::vector<Point2>{{0.0, 0.0}, {4.0, 0.0}, {2.0, 3.0}, {2.0, 1.0}});
	Patch patch;
	for (const Triangle& t : {Triangle{0, 1, 3}, Triangle{1, 2, 3}, Triangle{2, 0, 3}}) {
		const auto side = [&](std::size_t i, std::size_t j) {
			return distance(places[positionOf(t[i])], places[positionOf(t[j])]);
		};
		patch.triangles.push_back(flat.points.size());
		patch.corners.push_back(t);
		flat.vertices.push_back(t);
		flat.points.push_back(t);
		flat.lengths.push_back({side(0, 1), side(1, 2), side(2, 0)});
	}
	patch.points = {0, 1, 2, 3};
	patch.variable = Array<int>(4, -1);
	return restShapes(flat, patch, RestShapes::OfSurface, kLow);
}

double longest(const TriangleShape& s)
{
	return std::max({s.base, std::abs(s.apex), std::abs(s.apex - s.base)});
}

TEST(RestShapes, HaveTheScaleOfTheDrawing)
{
	// The drawing is a quarter of the surface.
	for (const TriangleShape& s : shapesOf({{0.0, 0.0}, {16.0, 0.0}, {8.0, 12.0}, {8.0, 4.0}})) {
		EXPECT_GE(longest(s), 3.0 - 1e-9);
		EXPECT_LE(longest(s), 4.0 + 1e-9);
	}
}

TEST(RestShapes, TrianglesWithoutAreaHaveTheScaleOfTheirSides)
{
	// All on a line, of lengths near to those in the drawing: areas would tell a scale of hundreds.
	for (const double height : {0.0, 1e-18, 1e-9}) {
		SCOPED_TRACE(height);
		for (const TriangleShape& s :
			 shapesOf({{0.0, 0.0}, {4.0, 0.0}, {2.5, height}, {1.5, 0.0}})) {
			EXPECT_GE(longest(s), 1.0);
			EXPECT_LE(longest(s), 6.0);
			EXPECT_GE(s.apex.imag() * s.base, kLow.wanted * (1.0 - 1e-9) * longest(s));
		}
	}
}

} // namespace
} // namespace ricci::testing
