// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/complex.h"
#include "support/flipped_flow.h"
#include "support/intrinsic.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/base/numbers.h>
#include <ricci/base/tolerances.h>
#include <ricci/fuchsian/fuchsian_group.h>
#include <ricci/fuchsian/tiling.h>
#include <ricci/layout/hyperbolic_layout.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace ricci::testing {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr auto kExtendedEpsilon = static_cast<double>(std::numeric_limits<DoubleDouble>::epsilon());

/// From a mesh to its group.
struct Uniformized
{
	FlippedFlow flow;
	CutGraph cut;
	SurfaceLayout refinement;
	FuchsianGroup group;

	/// \param detour vertices that the cut is to reach although nothing is there
	Uniformized(
		const SurfaceMesh& mesh,
		const HyperbolicRequest& request,
		const std::vector<int>& detour = {}) :
			flow(mesh, request, 1e-12)
	{
		VertexArray<char> marked = flow.cones();
		for (int v : detour)
			marked[Vertex(v)] = 1;
		cut = cutToDisk(flow.base(), flow.surface().lengths, marked);
		refinement = flow.refinement(cut);
		refinement.pairing = pairingOfArcs(flow.base(), cut, refinement.pairing, flow.cones());
		group = fuchsianGroup(flow.base(), cut, refinement.pairing, flow.cones(), true);
	}

	/// In the metric found, of the boundary loop through \p vertex.
	double boundaryLength(Vertex vertex) const
	{
		const Triangulation& t = flow.base();
		double length = 0.0;
		for (const std::vector<Vertex>& loop : flow.surface().topology.loops) {
			if (std::find(loop.begin(), loop.end(), vertex) == loop.end())
				continue;
			for (const Halfedge h : t.interiorHalfedges()) {
				if (!t.isExterior(h.twin()) ||
					std::find(loop.begin(), loop.end(), t.origin(h)) == loop.end())
					continue;
				const auto place = [&](Halfedge g) { return asComplex(refinement.corners[g]); };
				length += 2 * std::asinh(0.5 * chordLength(place(h), place(t.next(h))));
			}
		}
		return length;
	}
};

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

/// Frobenius norm of the difference of the canonical relation of a closed surface from +-1.
double relationDistance(const std::vector<ExtendedIsometry>& generators)
{
	ExtendedIsometry r;
	for (std::size_t i = 0; i + 1 < generators.size(); i += 2) {
		const ExtendedIsometry &a = generators[i], &b = generators[i + 1];
		r = r * a * b * a.inverse() * b.inverse();
	}
	const double sign = r.a.real() < 0.0 ? -1.0 : 1.0;
	return std::sqrt(2.0 * static_cast<double>(norm(r.a - ExtendedComplex(sign)) + norm(r.b)));
}

/// The returned isometries satisfy the relation as well as doubles can, and before rounding it held as
/// well as extended precision can.
void expectRelation(const FuchsianGroup& group)
{
	const Relation relation(group);
	EXPECT_LT(relation.error, 4 * kEpsilon * relation.sensitivity + group.relationError);
	EXPECT_LT(group.relationError, 4 * kExtendedEpsilon * relation.sensitivity);
}

/// The least |traces| of isometries along axes, each once: twice cosh of half the lengths of the
/// shortest closed geodesics.
std::vector<double> traceSpectrum(const FuchsianGroup& group, std::size_t count)
{
	std::vector<double> traces, spectrum;
	for (const DiskIsometry& m : tiling(group.sides, 4, 20000).deck)
		if (m.distanceFromIdentity() > 1e-3)
			traces.push_back(std::abs(m.trace()));
	std::sort(traces.begin(), traces.end());
	for (double x : traces)
		if (spectrum.size() < count && (spectrum.empty() || x > spectrum.back() * (1 + 1e-7)))
			spectrum.push_back(x);
	return spectrum;
}

TEST(FuchsianGroup, ClosedSurfacesSatisfyTheCanonicalRelation)
{
	Random random(650);
	struct Case
	{
		int genus;
		SurfaceMesh mesh;
	};
	std::vector<Case> cases{{2, perforatedSlab(2, 2)}, {3, perforatedSlab(3, 2)}};
	// Other numbers lead to other cuts, and these to other words.
	for (int genus : {2, 3, 4, 5})
		for (int trial = 0; trial < 4; ++trial)
			cases.push_back(
				{genus, renumbered(shaken(perforatedSlab(genus, 2), 0.06, random), random).mesh});
	for (const Case& c : cases) {
		SCOPED_TRACE(c.genus);
		const Uniformized surface(c.mesh, hyperbolicMetric());
		const FuchsianGroup& group = surface.group;
		ASSERT_EQ(group.handles.size(), at(2 * c.genus));
		EXPECT_TRUE(group.peripheral.empty());
		if (c.genus < 5) { // as seen from 0, farther on
			EXPECT_LT(group.polygonError, 1e-9);
		}
		EXPECT_LT(group.closingError, 1e-9);
		EXPECT_LT(relationDistance(group.generators()), 1e-8);
		expectRelation(group);
		// Nothing but the identity has a fixed point: all isometries are along axes.
		for (const std::vector<DiskIsometry>& isometries : {group.handles, group.sides})
			for (const DiskIsometry& m : isometries) {
				EXPECT_GT(std::abs(m.trace()), 2.0);
				EXPECT_NEAR(std::norm(m.a) - std::norm(m.b), 1.0, 1e-14 * std::norm(m.a));
			}
		// a and b of a handle cross once, so they do not commute.
		for (std::size_t i = 0; i < group.handles.size(); i += 2) {
			const DiskIsometry &a = group.handles[i], &b = group.handles[i + 1];
			const double trace = (a * b * a.inverse() * b.inverse()).trace();
			EXPECT_LT(trace, -2.0); // Fricke: of a torus with a hole
		}
	}
}

/// Sum of cosh d(p, g p) over the canonical generators.
double sumOfCosh(const FuchsianGroup& group, Complex p)
{
	const DiskIsometry toPoint = DiskIsometry::translationTo(p);
	double sum = 0.0;
	for (const DiskIsometry& g : group.handles)
		sum += std::cosh((toPoint.inverse() * g * toPoint).displacement());
	return sum;
}

/// Sum of the angles inside a polygon that runs counter-clockwise.
double sumOfAngles(const std::vector<Complex>& corners)
{
	double sum = 0.0;
	const std::size_t n = corners.size();
	for (std::size_t i = 0; i < n; ++i) {
		const DiskIsometry toCorner = DiskIsometry::translationTo(corners[i]).inverse();
		const Complex next = toCorner(corners[(i + 1) % n]);
		const Complex before = toCorner(corners[(i + n - 1) % n]);
		const double angle = std::arg(before / next);
		sum += angle < 0.0 ? angle + 2.0 * kPi : angle;
	}
	return sum;
}

TEST(CanonicalPolygon, IsAFundamentalPolygonWithPairedSides)
{
	Random random(652);
	for (int genus : {2, 3})
		for (int trial = 0; trial < 3; ++trial) {
			SCOPED_TRACE(genus);
			const SurfaceMesh mesh =
				renumbered(shaken(perforatedSlab(genus, 2), 0.06, random), random).mesh;
			const FuchsianGroup group = Uniformized(mesh, hyperbolicMetric()).group;
			const CanonicalPolygon polygon = canonicalPolygon(group);
			const auto& corners = polygon.corners;
			ASSERT_EQ(corners.size(), at(4 * genus));
			EXPECT_TRUE(polygon.isSimple);
			// The rounding of the generators, as it is seen from the base point, in products that
			// reach the corners.
			const Complex base = corners[corners.size() / 2];
			const DiskIsometry toBase = DiskIsometry::translationTo(base);
			double largest = 1.0, farthest = 1.0;
			for (const DiskIsometry& g : group.handles)
				largest = std::max(largest, std::abs(g.a));
			for (const Complex& z : corners)
				farthest = std::max(farthest, 0.5 * chordLength(base, z));
			const double tolerance =
				16.0 * genus * kEpsilon * largest * std::norm(toBase.a) * farthest * farthest;
			EXPECT_LT(tolerance, 1e-3);
			EXPECT_LT(polygon.gap, tolerance);
			EXPECT_NEAR(sumOfAngles(corners), 2.0 * kPi, tolerance);
			const auto side = [&](std::size_t k) {
				return chordLength(corners[k], corners[(k + 1) % corners.size()]);
			};
			for (std::size_t k = 0; k < corners.size(); k += 4)
				for (std::size_t letter : {k, k + 1})
					EXPECT_NEAR(side(letter), side(letter + 2), tolerance * side(letter));
			// The base point cannot be improved.
			for (int k = 0; k < 8; ++k)
				EXPECT_LT(
					sumOfCosh(group, base),
					sumOfCosh(group, toBase(std::polar(1e-3, 0.25 * kPi * k))));
		}
}

/// Two handles of a group whose relation does not hold, and far isometries, which no double can hold.
TEST(CanonicalPolygon, HasNoCornersWhereTheSidesDoNotCloseUp)
{
	FuchsianGroup group;
	EXPECT_TRUE(canonicalPolygon(group).corners.empty());
	const auto along = [](double direction, double length) {
		return DiskIsometry::rotation(direction) * DiskIsometry::translation(length) *
			   DiskIsometry::rotation(-direction);
	};
	for (double length : {0.5, 3.0, 40.0, 80.0, 700.0}) {
		SCOPED_TRACE(length);
		group.handles = {
			along(0.1, length), along(1.3, length), along(2.1, length), along(2.9, length)};
		group.relation.clear();
		for (std::size_t i = 0; i < 4; i += 2) {
			const DiskIsometry &a = group.handles[i], &b = group.handles[i + 1];
			for (const DiskIsometry& g : {a, b, a.inverse(), b.inverse()})
				group.relation.push_back(
					{ExtendedIsometry::Complex(g.a), ExtendedIsometry::Complex(g.b)});
		}
		const CanonicalPolygon polygon = canonicalPolygon(group);
		EXPECT_FALSE(polygon.gap <= kMaxPolygonGap);
		EXPECT_TRUE(polygon.corners.empty());
		EXPECT_FALSE(polygon.isSimple);
	}
}

/// Signed area of the geodesic triangle: with p at 0, tan(area / 2) = Im(conj(x) y) / (1 - Re(conj(x)
/// y)).
double signedArea(Complex p, Complex q, Complex r)
{
	const DiskIsometry toOrigin = DiskIsometry::translationTo(p).inverse();
	const Complex product = std::conj(toOrigin(q)) * toOrigin(r);
	return 2.0 * std::atan2(product.imag(), 1.0 - product.real());
}

/// Any isometries whose product is the identity spell a closed polygon. Its crossings are known from the
/// orientations of triangles of corners, its angles from its area.
TEST(CanonicalPolygon, CrossingsAndAnglesAreThoseOfAnyClosedPolygon)
{
	Random random(653);
	int simple = 0, clockwise = 0;
	for (int trial = 0; trial < 400; ++trial) {
		SCOPED_TRACE(trial);
		FuchsianGroup group;
		ExtendedIsometry product;
		const auto append = [&](const ExtendedIsometry& g) {
			group.relation.push_back(g);
			group.peripheral.push_back(rounded(g));
			product = product * g;
		};
		const int letters = 3 + random.index(4);
		for (int i = 0; i < letters; ++i)
			append(
				ExtendedIsometry::rotation(random.real(-kPi, kPi)) *
				ExtendedIsometry::translation(random.real(0.2, 3.0)) *
				ExtendedIsometry::rotation(random.real(-kPi, kPi)));
		append(product.inverse());
		const CanonicalPolygon polygon = canonicalPolygon(group);
		const auto& z = polygon.corners;
		const std::size_t n = group.relation.size();
		ASSERT_EQ(z.size(), n);
		EXPECT_LT(polygon.gap, 1e-12);
		bool crosses = false;
		for (std::size_t i = 0; i < n; ++i)
			for (std::size_t j = i + 2; j < n; ++j) {
				const Complex a = z[i], b = z[i + 1], c = z[j], d = z[(j + 1) % n];
				if (j + 1 < n || i > 0)
					crosses |=
						hyperbolicOrientation(a, b, c) * hyperbolicOrientation(a, b, d) < 0 &&
						hyperbolicOrientation(c, d, a) * hyperbolicOrientation(c, d, b) < 0;
			}
		EXPECT_EQ(polygon.isSimple, !crosses);
		double area = 0.0;
		for (std::size_t k = 1; k + 1 < n; ++k)
			area += signedArea(z[0], z[k], z[k + 1]);
		if (crosses)
			continue;
		++simple;
		// Clockwise ones are seen from outside.
		const double sides = static_cast<double>(n) + (area > 0.0 ? -2.0 : 2.0);
		EXPECT_NEAR(sumOfAngles(z), sides * kPi - area, 1e-9);
		clockwise += area < 0.0;
	}
	EXPECT_GT(simple, 50);
	EXPECT_LT(simple, 350);
	EXPECT_GT(clockwise, 10);
}

TEST(FuchsianGroup, LengthsOfGeodesicsDoNotDependOnTheCutOrTheNumbers)
{
	Random random(660);
	for (int genus : {2, 3}) {
		const SurfaceMesh mesh = shaken(perforatedSlab(genus, 2), 0.06, random);
		const std::vector<double> wanted =
			traceSpectrum(Uniformized(mesh, hyperbolicMetric()).group, 8);
		ASSERT_EQ(wanted.size(), 8u);
		EXPECT_GT(wanted.front(), 2.0);
		const Uniformized detour(mesh, hyperbolicMetric(), {3, 11});
		EXPECT_LT(detour.group.closingError, 1e-9); // regular points, although the cut ends there
		const Uniformized other(renumbered(mesh, random).mesh, hyperbolicMetric());
		for (const Uniformized* same : {&detour, &other}) {
			const std::vector<double> found = traceSpectrum(same->group, 8);
			ASSERT_EQ(found.size(), 8u);
			for (std::size_t i = 0; i < 8; ++i)
				EXPECT_NEAR(found[i] / wanted[i], 1.0, 1e-8);
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
		const FuchsianGroup wanted = Uniformized(mesh, hyperbolicMetric()).group;
		ASSERT_EQ(wanted.generators().size(), at(2 * genus));
		for (const double scale : {1e-3, 3.7}) {
			SurfaceMesh other = mesh;
			for (Point3& p : other.positions)
				for (double& x : p)
					x *= scale;
			const FuchsianGroup group = Uniformized(other, hyperbolicMetric()).group;
			ASSERT_EQ(group.handles.size(), wanted.handles.size());
			EXPECT_LT(relationDistance(group.generators()), 1e-8);
			for (std::size_t i = 0; i < group.handles.size(); ++i) {
				const DiskIsometry &m = group.handles[i], &n = wanted.handles[i];
				const double sign = (m.a * std::conj(n.a)).real() < 0.0 ? -1.0 : 1.0;
				EXPECT_LT(std::abs(m.a - sign * n.a), 1e-8 * std::abs(n.a));
				EXPECT_LT(std::abs(m.b - sign * n.b), 1e-8 * std::abs(n.a));
			}
		}
	}
}

TEST(FuchsianGroup, GeodesicBoundariesAreAxes)
{
	Random random(670);
	const struct
	{
		SurfaceMesh mesh;
		std::size_t loops;
	} cases[] = {
		{withoutStars(shaken(perforatedSlab(1, 4), 0.03, random), {0}), 1},
		{withoutStars(shaken(perforatedSlab(0, 5), 0.03, random), {0, 60, 120}), 3},
		{withoutStars(shaken(perforatedSlab(2, 3), 0.03, random), {5, 70}), 2}};
	for (const auto& c : cases) {
		const Uniformized surface(c.mesh, hyperbolicMetric());
		SCOPED_TRACE(surface.flow.surface().topology.type.name());
		ASSERT_EQ(surface.flow.surface().topology.loops.size(), c.loops);
		const FuchsianGroup& group = surface.group;
		ASSERT_EQ(group.peripheral.size(), surface.flow.surface().topology.loops.size());
		EXPECT_EQ(group.handles.size(), at(2 * surface.flow.surface().topology.type.genus));
		EXPECT_LT(group.polygonError, 1e-9);
		EXPECT_LT(group.closingError, 1e-9);
		EXPECT_LT(group.relationError, 1e-8);
		expectRelation(group);
		std::vector<int> loops;
		for (std::size_t i = 0; i < group.peripheral.size(); ++i) {
			const double length = surface.boundaryLength(group.peripheralVertex[i]);
			EXPECT_GT(length, 0.01);
			EXPECT_NEAR(
				std::abs(group.peripheral[i].trace()),
				2 * std::cosh(length / 2),
				1e-9 * std::cosh(length / 2));
			for (std::size_t j = 0; j < surface.flow.surface().topology.loops.size(); ++j) {
				const auto& loop = surface.flow.surface().topology.loops[j];
				if (std::find(loop.begin(), loop.end(), group.peripheralVertex[i]) != loop.end())
					loops.push_back(static_cast<int>(j));
			}
		}
		std::sort(loops.begin(), loops.end()); // each once
		for (std::size_t j = 0; j < loops.size(); ++j)
			EXPECT_EQ(loops[j], static_cast<int>(j));
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
		std::vector<std::pair<int, double>> cones; // vertex, total angle
	} cases[] = {
		{sphere, {{3, 2 * kPi / 3}, {20, 2 * kPi / 4}, {40, 2 * kPi / 5}}},
		{sphere, {{3, 1.0}, {20, 1.5}, {40, 2.0}, {11, 7.0}}},
		{donut, {{5, 1.0}, {60, 2.5}}},
		{donut, {{17, kPi}}}};
	for (const auto& c : cases) {
		std::vector<double> curvature(c.mesh.positions.size(), 0.0);
		for (const auto& [v, angle] : c.cones)
			curvature[at(v)] = 2 * kPi - angle;
		const Uniformized surface(c.mesh, hyperbolicPrescribed(curvature));
		const FuchsianGroup& group = surface.group;
		ASSERT_EQ(group.peripheral.size(), c.cones.size());
		EXPECT_LT(group.polygonError, 1e-9);
		EXPECT_LT(group.closingError, 1e-9);
		EXPECT_LT(group.relationError, 1e-9);
		expectRelation(group);
		for (const auto& [v, angle] : c.cones) {
			const auto i = static_cast<std::size_t>(
				std::find(group.peripheralVertex.begin(), group.peripheralVertex.end(), Vertex(v)) -
				group.peripheralVertex.begin());
			ASSERT_LT(i, group.peripheral.size());
			EXPECT_NEAR(
				std::abs(group.peripheral[i].trace()), 2 * std::abs(std::cos(angle / 2)), 1e-9);
		}
	}
}

} // namespace
} // namespace ricci::testing
