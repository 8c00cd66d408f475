// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces given by the lengths of their edges alone, and the headers ricci.h and hyperbolic.h.
#include "support/expect.h"
#include "support/random_surface.h"

#include <ricci/hyperbolic.h>
#include <ricci/parametrize.h>
#include <ricci/ricci.h>
#include <ricci/sphere_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <complex>
#include <limits>
#include <vector>

namespace ricci::testing {
namespace {

using Lengths = std::vector<std::array<double, 3>>;
using Complex = std::complex<double>;

Lengths lengthsOf(const SurfaceMesh& mesh)
{
	Lengths lengths;
	for (const Triangle& t : mesh.triangles)
		lengths.push_back(sideLengths(t, mesh.positions));
	return lengths;
}

/// The quotient of the plane by the lattice of 1 and \p tau, in n by m cells. It has no place in space.
struct FlatTorus
{
	std::vector<Triangle> triangles;
	Lengths lengths;

	FlatTorus(Complex tau, int n, int m)
	{
		triangles = cells(n, m, [&](int i, int j) { return i % n + n * (j % m); });
		const Complex along = 1.0 / n, up = tau / double(m);
		for (std::size_t f = 0; f < triangles.size(); f += 2) // as cells() divides them
			for (const auto& sides : {std::array{along, up, along + up}, {along + up, along, up}})
				lengths.push_back({std::abs(sides[0]), std::abs(sides[1]), std::abs(sides[2])});
	}
};

TEST(FromLengths, AFlatTorusThatIsNotInSpaceIsUnrolled)
{
	for (const Complex tau : {Complex(0.0, 1.0), Complex(0.3, 1.2), Complex(-0.45, 2.5)}) {
		const FlatTorus torus(tau, 9, 7);
		const TextureCoordinates map = flattenFromLengths(torus.triangles, torus.lengths);
		ASSERT_EQ(map.triangles.size(), torus.triangles.size());
		std::vector<double> scales;
		for (std::size_t f = 0; f < map.triangles.size(); ++f)
			for (std::size_t k = 0; k < 3; ++k) {
				const Point2 &p = map.uv[at(map.triangles[f][k])],
							 &q = map.uv[at(map.triangles[f][(k + 1) % 3])];
				scales.push_back(distance(p, q) / torus.lengths[f][k]);
			}
		const auto [least, most] = std::minmax_element(scales.begin(), scales.end());
		EXPECT_NEAR(*most / *least, 1.0, 1e-11);
		EXPECT_EQ(map.flippedFaces + map.overlappingFaces, 0);
	}
}

/// The flow sees lengths only.
/// Only positions tell that a surface is its own mirror image: these are none.
TEST(FromLengths, TheMapIsThatOfASurfaceInSpaceWithTheseLengths)
{
	Options options;
	options.target = TargetCurvature::PlacedCones;
	Random random(3);
	for (const SurfaceMesh& shape :
		 {torus(2, 0.7, 14, 9), perforatedSlab(2, 1), rectangle(7, 4, 3, 2)}) {
		const SurfaceMesh mesh = shaken(shape, 0.02, random);
		const TextureCoordinates own = flatten(mesh.positions, mesh.triangles, options);
		const TextureCoordinates map = flattenFromLengths(mesh.triangles, lengthsOf(mesh), options);
		EXPECT_EQ(map.uv, own.uv);
		EXPECT_EQ(map.triangles, own.triangles);
		EXPECT_EQ(map.objective, own.objective);
	}
	const SurfaceMesh slab = perforatedSlab(2, 1);
	const DiskCoordinates own = uniformize(slab.positions, slab.triangles);
	const DiskCoordinates disk = uniformizeFromLengths(slab.triangles, lengthsOf(slab));
	EXPECT_EQ(disk.points, own.points);
	EXPECT_EQ(disk.triangles, own.triangles);
}

/// Its distortion is measured by the lengths, too: that of the positions, as far as rounding goes.
TEST(FromLengths, TheDistortionIsThatOfTheSurfaceInSpace)
{
	Random random(4);
	const SurfaceMesh inSpace = shaken(torus(2, 0.7, 20, 11), 0.02, random);
	SurfaceMesh mesh = inSpace;
	const Parametrization own = parametrizeEuclidean(mesh, {}, {});
	mesh.lengths = lengthsOf(mesh);
	mesh.positions.assign(mesh.positions.size(), {0, 0, 0});
	Options options;
	options.target = TargetCurvature::Flat;
	const Parametrization map = parametrizeEuclidean(mesh, {}, options);
	const Parametrization flat = parametrizeEuclidean(inSpace, {}, options);
	EXPECT_NEAR(map.report.qcAreaMean, flat.report.qcAreaMean, 1e-12);
	EXPECT_NEAR(map.report.qcMax, flat.report.qcMax, 1e-10);
	EXPECT_NEAR(map.report.areaDistortionMean, flat.report.areaDistortionMean, 1e-12);
	ASSERT_EQ(map.vertexQC.size(), flat.vertexQC.size());
	for (std::size_t v = 0; v < map.vertexQC.size(); ++v)
		EXPECT_NEAR(map.vertexQC[v], flat.vertexQC[v], 1e-10);
}

/// A ring whose hole is closed by a cap of about the plane's lengths is a round disk already.
TEST(FromLengths, AHoleIsCappedByACircleOfItsLength)
{
	const SurfaceMesh mesh = ring(0.3, 1.0, 48, 10);
	Options options;
	options.target = TargetCurvature::Disk;
	options.holes = Holes::Capped;
	const TextureCoordinates map = flattenFromLengths(mesh.triangles, lengthsOf(mesh), options);
	EXPECT_EQ(*std::max_element(map.chart.begin(), map.chart.end()), 0);
	double scale = 0.0; // the square holds a polygon
	for (std::size_t f = 0; f < map.triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k) {
			const Point2 p = map.uv[at(map.triangles[f][k])] - Point2{0.5, 0.5};
			const Point3& q = mesh.positions[at(mesh.triangles[f][k])];
			scale = scale == 0.0 ? length(p) / length(q) : scale;
			EXPECT_NEAR(length(p) / length(q) / scale, 1.0, 2e-3);
		}
}

/// The hyperbolic area of a surface of genus 2 is 4 pi, and its group has the relation of canonical generators.
TEST(Uniformize, GivesPointsOfTheDiskAndTheIsometriesOfItsGroup)
{
	const SurfaceMesh mesh = perforatedSlab(2, 1);
	HyperbolicOptions options;
	options.canonicalGenerators = true;
	options.output = OutputTriangulation::CommonRefinement; // whose triangles are geodesic
	const DiskCoordinates disk = uniformize(mesh.positions, mesh.triangles, options);
	double area = 0.0;
	for (const std::array<int, 3>& t : disk.triangles) {
		double angles = 0.0;
		for (std::size_t k = 0; k < 3; ++k) {
			// Seen from a point that is moved to 0, geodesics from it are straight.
			const Complex z = disk.points[at(t[k])];
			const auto seen = [&](int p) {
				const Complex w = disk.points[at(p)];
				return (w - z) / (1.0 - std::conj(z) * w);
			};
			EXPECT_LT(std::abs(z), 1.0);
			angles += std::arg(seen(t[(k + 2) % 3]) / seen(t[(k + 1) % 3]));
		}
		area += kPi - angles;
	}
	EXPECT_NEAR(area, 4.0 * kPi, 1e-8);
	ASSERT_EQ(disk.groups.size(), 1u);
	const FuchsianGroup& group = disk.groups.front();
	ASSERT_EQ(group.handles.size(), 4u);
	DiskIsometry relation;
	for (const std::size_t i : {std::size_t(0), std::size_t(2)}) {
		const DiskIsometry &a = group.handles[i], &b = group.handles[i + 1];
		for (const DiskIsometry& letter : {a, b, a.inverse(), b.inverse()})
			relation = relation * letter;
	}
	double size = 1.0; // by which products magnify rounding
	for (const DiskIsometry& p : group.handles)
		size *= std::norm(std::abs(p.a) + std::abs(p.b));
	EXPECT_LT(std::abs(relation.b), 1e-14 * size);
	EXPECT_LT(std::abs(std::abs(relation.a) - 1.0), 1e-14 * size);
	for (std::size_t i = 0; i + 1 < group.sides.size(); i += 2) {
		const DiskIsometry one = group.sides[i] * group.sides[i + 1];
		EXPECT_NEAR(std::abs(one.a), 1.0, 1e-9);
		EXPECT_NEAR(std::norm(group.sides[i].a) - std::norm(group.sides[i].b), 1.0, 1e-9);
	}
	EXPECT_EQ(disk.flippedFaces + disk.overlappingFaces + disk.unequalSeams, 0);
}

/// The problem of the error that is thrown.
template<class E, class Run>
int problemOf(const Run& run)
{
	return refusalOf<E>(run).problem;
}

TEST(FromLengths, WhatNoSurfaceHasIsRefused)
{
	const SurfaceMesh mesh = rectangle(3, 2, 3, 2);
	const Lengths right = lengthsOf(mesh);
	const auto problem = [&](const Lengths& lengths) {
		const int inPlane =
			problemOf<InvalidMesh>([&] { flattenFromLengths(mesh.triangles, lengths); });
		const int inDisk =
			problemOf<InvalidMesh>([&] { uniformizeFromLengths(mesh.triangles, lengths); });
		EXPECT_EQ(inPlane, inDisk);
		return inPlane;
	};
	for (const double wrong : {0.0, -1.0, 1e60, std::nan(""), HUGE_VAL, 2.5}) {
		Lengths lengths = right;
		lengths[3][1] = wrong;
		EXPECT_EQ(problem(lengths), InvalidMesh::NoTriangle) << wrong;
	}
	Lengths unequal = right;
	unequal[3] = {1.0, 1.1, 1.2};
	EXPECT_EQ(problem(unequal), InvalidMesh::UnequalSides);
	EXPECT_EQ(problem({}), InvalidMesh::ArrayLength);
	EXPECT_EQ(problem(Lengths(right.begin(), right.end() - 1)), InvalidMesh::ArrayLength);
	for (const int number : {2000000000, std::numeric_limits<int>::max()})
		EXPECT_EQ(
			problemOf<InvalidMesh>([&] {
				flattenFromLengths({{0, 1, number}}, {{1, 1, 1}});
			}),
			InvalidMesh::DamagedFaces);
	EXPECT_EQ(problemOf<InvalidMesh>([&] { flattenFromLengths({}, {}); }), InvalidMesh::Empty);
}

TEST(FromLengths, WhatNeedsPositionsIsRefused)
{
	SurfaceMesh mesh = rectangle(3, 2, 3, 2);
	mesh.lengths = lengthsOf(mesh);
	const auto refused = [&](auto set) {
		Options options;
		set(options);
		const auto error = errorOf<InvalidOption>([&] { parametrizeEuclidean(mesh, {}, options); });
		return error && error->problem == InvalidOption::WithoutPositions;
	};
	EXPECT_TRUE(refused([](Options& o) { o.target = TargetCurvature::Rectangle; }));
	EXPECT_TRUE(refused([](Options& o) { o.method = Method::EdgeSwaps; }));
	EXPECT_TRUE(refused([](Options& o) { o.output = OutputTriangulation::CommonRefinement; }));
	EXPECT_TRUE(refused([](Options& o) { o.seamHiding = 0.5; }));
	EXPECT_TRUE(refused([](Options& o) { o.sharpAngle = 0.5; }));
	EXPECT_TRUE(refused([](Options& o) { o.cones.rounding = ConeRounding::QuarterTurns; }));
	EXPECT_FALSE(refused([](Options& o) { o.target = TargetCurvature::Disk; }));
	EXPECT_EQ(
		problemOf<InvalidOption>([&] { mapToSphere(mesh, {}); }), InvalidOption::WithoutPositions);
	HyperbolicOptions refined;
	refined.output = OutputTriangulation::CommonRefinement;
	EXPECT_EQ(
		problemOf<InvalidOption>([&] { parametrizeHyperbolic(mesh, {}, refined); }),
		InvalidOption::WithoutPositions);
	// The corners of a rectangle may be chosen by hand.
	VertexInput input;
	for (const Point3& p : mesh.positions)
		input.selected.push_back((p[0] == 0.0 || p[0] == 3.0) && (p[1] == 0.0 || p[1] == 2.0));
	Options options;
	options.target = TargetCurvature::Rectangle;
	const Parametrization map = parametrizeEuclidean(mesh, input, options);
	EXPECT_NEAR(
		std::max(*map.report.rectangleAspect, 1.0 / *map.report.rectangleAspect), 1.5, 1e-9);
}

} // namespace
} // namespace ricci::testing
