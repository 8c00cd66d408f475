// SPDX-License-Identifier: GPL-3.0-or-later
// The groups of hyperbolic results: their relations, and the geodesics that they tell.
#include "support/complex.h"
#include "support/random_surface.h"
#include "support/reflected.h"
#include "support/shapes.h"
#include "support/wide.h"

#include <ricci/parametrize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kExtendedEpsilon = 0x1p-66; // of the functions of DoubleDouble

/// Hyperbolic, with this curvature at vertices.
Parametrization
uniformized(const SurfaceMesh& mesh, const std::vector<std::pair<int, double>>& curvature = {})
{
	HyperbolicOptions options;
	options.epsilon = 1e-12;
	options.finish = Finish::None;
	options.canonicalGenerators = true;
	options.target = HyperbolicTarget::Prescribed;
	VertexInput input;
	input.targetCurvature.assign(mesh.positions.size(), 0.0);
	for (const auto& [v, k] : curvature)
		input.targetCurvature[at(v)] = k;
	return parametrizeHyperbolic(mesh, input, options);
}

/// The left-hand side of the canonical relation, from the rounded isometries.
struct Relation
{
	double error = 0.0; ///< against +-1
	/// What a relative change of 1 of every isometry may add: the product's factors are large, and
	/// the product is not.
	double sensitivity = 0.0;

	explicit Relation(const FuchsianGroup& group)
	{
		std::vector<ExtendedIsometry> word;
		for (std::size_t i = 0; i + 1 < group.handles.size(); i += 2) {
			const ExtendedIsometry a = extended(group.handles[i]);
			const ExtendedIsometry b = extended(group.handles[i + 1]);
			word.insert(word.end(), {a, b, a.inverse(), b.inverse()});
		}
		for (const DiskIsometry& e : group.peripheral)
			word.push_back(extended(e));
		std::vector<ExtendedIsometry> suffix(word.size() + 1);
		for (std::size_t i = word.size(); i-- > 0;)
			suffix[i] = word[i] * suffix[i + 1];
		ExtendedIsometry prefix;
		for (std::size_t i = 0; i < word.size(); ++i) {
			sensitivity += size(prefix) * size(word[i]) * size(suffix[i + 1]);
			prefix = prefix * word[i];
		}
		error = static_cast<double>(prefix.distanceFromIdentity());
	}

private:
	static ExtendedIsometry extended(const DiskIsometry& m) { return {m.a, m.b}; }
	static double size(const ExtendedIsometry& m)
	{
		return static_cast<double>(abs(m.a) + abs(m.b));
	}
};

/// The layout closes up, and so does the relation: the isometries that are returned satisfy it as well as doubles
/// can, and before rounding it held as well as extended precision can. Nothing but the identity and cones has a
/// fixed point.
void expectGroup(const Parametrization& map, std::size_t genus, std::size_t peripheral)
{
	ASSERT_EQ(map.charts.size(), 1u);
	const FuchsianGroup& group = map.charts[0].group;
	EXPECT_EQ(map.report.genus, static_cast<int>(genus));
	ASSERT_EQ(group.handles.size(), 2 * genus);
	ASSERT_EQ(group.peripheral.size(), peripheral);
	ASSERT_EQ(group.generators().size(), 2 * genus + peripheral);
	EXPECT_TRUE(group.isCanonical());
	EXPECT_LT(map.report.relationError.value_or(1.0), 1e-10);
	const Relation relation(group);
	EXPECT_LT(relation.error, 4 * kEpsilon * relation.sensitivity + group.relationError);
	if (genus > 0)
		EXPECT_LT(group.relationError, 4 * kExtendedEpsilon * relation.sensitivity);
	else // there is nothing to move so that it holds
		EXPECT_LT(group.relationError, 1e-9);
	ExtendedIsometry product;
	for (const ExtendedIsometry& letter : group.relation)
		product = product * letter;
	EXPECT_LT(static_cast<double>(product.distanceFromIdentity()), 1e-8);
	for (const DiskIsometry& m : group.handles) {
		EXPECT_GT(std::abs(m.trace()), 2.0);
		EXPECT_NEAR(std::norm(m.a) - std::norm(m.b), 1.0, 1e-14 * std::norm(m.a));
	}
	// Sides come in pairs, each followed by its inverse.
	ASSERT_EQ(group.sides.size() % 2, 0u);
	for (std::size_t i = 0; i < group.sides.size(); i += 2)
		EXPECT_LT(
			(group.sides[i] * group.sides[i + 1]).distanceFromIdentity(),
			1e-12 * std::norm(group.sides[i].a));
}

/// |traces| of the words of up to \p length sides that move 0 by at most \p reach, in increasing order.
std::vector<double> tracesOf(const FuchsianGroup& group, int length, double reach)
{
	std::vector<double> traces;
	std::vector<std::pair<DiskIsometry, std::size_t>> ring{{DiskIsometry(), group.sides.size()}},
		next;
	for (; length > 0; --length) {
		next.clear();
		for (const auto& [m, last] : ring)
			for (std::size_t s = 0; s < group.sides.size(); ++s) {
				const DiskIsometry word = m * group.sides[s];
				if (s == (last ^ 1) || word.displacement() > reach)
					continue;
				if (word.distanceFromIdentity() > 1e-3)
					traces.push_back(std::abs(word.trace()));
				next.push_back({word, s});
			}
		ring.swap(next);
	}
	std::sort(traces.begin(), traces.end());
	return traces;
}

/// a and b of a handle cross once, so they do not commute: the commutator is that of a torus with a hole (Fricke).
void expectHandles(const FuchsianGroup& group)
{
	for (std::size_t i = 0; i < group.handles.size(); i += 2) {
		const DiskIsometry &a = group.handles[i], &b = group.handles[i + 1];
		EXPECT_LT((a * b * a.inverse() * b.inverse()).trace(), -2.0);
	}
}

/// Other numbers lead to other cuts, and these to other words.
TEST(FuchsianGroup, OfAClosedSurfaceSatisfiesTheCanonicalRelation)
{
	Random random(650);
	for (int genus : {2, 3, 4, 5}) {
		SCOPED_TRACE(genus);
		expectGroup(uniformized(perforatedSlab(genus, 2)), at(genus), 0);
		const SurfaceMesh mesh = shaken(perforatedSlab(genus, 2), 0.06, random);
		for (int trial = 0; trial < 3; ++trial) {
			const Parametrization other = uniformized(renumbered(mesh, random).mesh);
			expectGroup(other, at(genus), 0);
			expectHandles(other.charts[0].group);
		}
	}
}

/// Rounding differs from scale to scale, and the flow stops elsewhere: each generator has at least the
/// digits in which they agree.
TEST(FuchsianGroup, CanonicalGeneratorsDoNotDependOnTheScale)
{
	Random random(661);
	for (int genus : {2, 3, 4, 5}) {
		SCOPED_TRACE(genus);
		const SurfaceMesh mesh = shaken(perforatedSlab(genus, 2), 0.06, random);
		const FuchsianGroup wanted = uniformized(mesh).charts[0].group;
		for (const double scale : {1e-3, 3.7}) {
			const FuchsianGroup group = uniformized(scaled(mesh, scale)).charts[0].group;
			ASSERT_EQ(group.handles.size(), wanted.handles.size());
			for (std::size_t i = 0; i < group.handles.size(); ++i) {
				const DiskIsometry &m = group.handles[i], &n = wanted.handles[i];
				const double sign = (m.a * std::conj(n.a)).real() < 0.0 ? -1.0 : 1.0;
				EXPECT_LT(std::abs(m.a - sign * n.a), 1e-8 * std::abs(n.a));
				EXPECT_LT(std::abs(m.b - sign * n.b), 1e-8 * std::abs(n.a));
			}
		}
	}
}

/// Lengths of the boundary loops of a map, in the metric found.
std::vector<double> boundaryLengths(const SurfaceMesh& mesh, const Parametrization& map)
{
	std::map<std::pair<int, int>, double> sides;
	const Box2& box = map.charts.at(0).box;
	for (const int f : map.mesh.points.indices())
		for (const Corner c : cornersOf(f)) {
			std::array<Complex, 2> z;
			for (std::size_t k = 0; k < 2; ++k)
				z[k] =
					2.0 / box.width() * (asComplex(map.mesh.ends(c)[k]) - asComplex(box.centre()));
			sides[{map.mesh.vertices[c], map.mesh.vertices[c.next()]}] =
				static_cast<double>(distanceInDisk(z[0], z[1]));
		}
	std::map<int, std::pair<int, double>> next; // [vertex on the boundary]
	for (const auto& [ends, length] : sides)
		if (sides.count({ends.second, ends.first}) == 0)
			next[ends.first] = {ends.second, length};
	EXPECT_LE(next.size(), mesh.positions.size());
	std::vector<double> lengths;
	while (!next.empty()) {
		lengths.push_back(0.0);
		for (auto v = next.begin(); v != next.end();) {
			const auto [to, length] = v->second;
			lengths.back() += length;
			next.erase(v);
			v = next.find(to);
		}
	}
	std::sort(lengths.begin(), lengths.end());
	return lengths;
}

TEST(FuchsianGroup, GeodesicBoundariesAreAxes)
{
	Random random(670);
	const struct
	{
		SurfaceMesh mesh;
		std::size_t genus, loops;
	} cases[] = {
		{withoutStars(shaken(perforatedSlab(1, 4), 0.03, random), {0}), 1, 1},
		{withoutStars(shaken(perforatedSlab(0, 5), 0.03, random), {0, 60, 120}), 0, 3},
		{withoutStars(shaken(perforatedSlab(2, 3), 0.03, random), {5, 70}), 2, 2}};
	for (const auto& c : cases) {
		SCOPED_TRACE(c.genus);
		const Parametrization map = uniformized(c.mesh);
		expectGroup(map, c.genus, c.loops);
		expectHandles(map.charts[0].group);
		std::vector<double> axes;
		for (const DiskIsometry& e : map.charts[0].group.peripheral)
			axes.push_back(2.0 * std::acosh(0.5 * std::abs(e.trace())));
		std::sort(axes.begin(), axes.end());
		const std::vector<double> lengths = boundaryLengths(c.mesh, map);
		ASSERT_EQ(lengths.size(), c.loops);
		for (std::size_t i = 0; i < c.loops; ++i) {
			EXPECT_GT(lengths[i], 0.01);
			EXPECT_NEAR(axes[i], lengths[i], 1e-8);
		}
	}
}

TEST(FuchsianGroup, ConesAreRotations)
{
	Random random(680);
	const SurfaceMesh sphere = shaken(perforatedSlab(0, 3), 0.05, random);
	const SurfaceMesh donut = bumpyTorus(12, 9, random);
	const struct
	{
		const SurfaceMesh& mesh;
		std::size_t genus;
		std::vector<std::pair<int, double>> cones; // vertex, total angle
	} cases[] = {
		{sphere, 0, {{3, 2 * kPi / 3}, {20, 2 * kPi / 4}, {40, 2 * kPi / 5}}},
		{sphere, 0, {{3, 1.0}, {20, 1.5}, {40, 2.0}, {11, 7.0}}},
		{donut, 1, {{5, 1.0}, {60, 2.5}}},
		{donut, 1, {{17, kPi}}}};
	for (const auto& c : cases) {
		std::vector<std::pair<int, double>> curvature;
		std::vector<double> wanted, found;
		for (const auto& [v, angle] : c.cones) {
			curvature.push_back({v, 2 * kPi - angle});
			wanted.push_back(2 * std::abs(std::cos(angle / 2)));
		}
		const Parametrization map = uniformized(c.mesh, curvature);
		expectGroup(map, c.genus, c.cones.size());
		for (const DiskIsometry& e : map.charts[0].group.peripheral)
			found.push_back(std::abs(e.trace()));
		std::sort(wanted.begin(), wanted.end());
		std::sort(found.begin(), found.end());
		for (std::size_t i = 0; i < found.size(); ++i)
			EXPECT_NEAR(found[i], wanted[i], 1e-9);
	}
}

/// A metric with all symmetries of a curve has it for its uniformization, whatever the triangles are. It is a
/// regular polygon of 4 g or 4 g + 2 sides with opposite sides glued, whose angles add up to 2 pi or 4 pi: the
/// translations that glue them are among its geodesics.
TEST(FuchsianGroup, OfACurveWithSymmetriesIsKnown)
{
	const struct
	{
		int roots;
		Branched branched;
		int sides, genus;
	} cases[] = {
		{4, Branched::Both, 8, 2},
		{5, Branched::One, 10, 2},
		{6, Branched::Both, 12, 3},
		{7, Branched::One, 14, 3}};
	for (const auto& c : cases)
		for (const double stretch : {0.6, 1.0, 2.5}) {
			SCOPED_TRACE(std::to_string(c.roots) + ", stretched by " + std::to_string(stretch));
			const Parametrization map = uniformized(hyperelliptic(c.roots, c.branched, 3, stretch));
			expectGroup(map, at(c.genus), 0);
			EXPECT_NEAR(map.report.hyperbolicArea.value_or(0.0), 4 * kPi * (c.genus - 1), 1e-9);
			const double angle = (c.sides % 4 == 0 ? 2.0 : 4.0) * kPi / c.sides; // at a corner
			const double expected = 2.0 * std::cos(0.5 * angle) / std::sin(kPi / c.sides);
			double nearest = 1.0;
			for (const double x : tracesOf(map.charts[0].group, 6, 7.5))
				nearest = std::min(nearest, std::abs(x - expected));
			EXPECT_LT(nearest, 1e-8);
		}
}

/// The Bolza surface: every |trace| / 2 is an integer m + n sqrt(2), m odd and |m - n sqrt(2)| < 1 (Aurich and Steiner
/// 1988).
TEST(FuchsianGroup, TracesOfTheBolzaSurfaceAreIntegersOfTheFieldOfTheSquareRootOfTwo)
{
	for (const int n : {3, 5}) {
		const Parametrization map = uniformized(hyperelliptic(4, Branched::Both, n));
		std::vector<double> different;
		for (const double trace : tracesOf(map.charts[0].group, 5, 8.0)) {
			const double half = 0.5 * trace;
			if (half > 40.0)
				break;
			if (different.empty() || half > different.back() + 1e-6)
				different.push_back(half);
			double nearest = 1.0;
			for (int k = 0; k < 60; ++k) {
				const double rest = half - k * std::sqrt(2.0);
				const double odd = 2 * std::round((rest - 1) / 2) + 1;
				if (std::abs(odd - k * std::sqrt(2.0)) <= 1.0)
					nearest = std::min(nearest, std::abs(rest - odd));
			}
			EXPECT_LT(nearest, 1e-8) << half;
		}
		ASSERT_GT(different.size(), 8u);
		EXPECT_NEAR(different[0], 1 + std::sqrt(2.0), 1e-9);
		EXPECT_NEAR(different[1], 3 + 2 * std::sqrt(2.0), 1e-9);
		EXPECT_NEAR(different[2], 5 + 3 * std::sqrt(2.0), 1e-9);
	}
}

} // namespace
} // namespace ricci::testing
