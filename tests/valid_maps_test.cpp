// SPDX-License-Identifier: GPL-3.0-or-later
// What every map is whose triangles are the mesh's own, whatever it was asked for: no triangle is flipped, no
// two cover the same part of the square, and seams fit, in the floats that are stored.
#include "support/flat_map.h"
#include "support/map_check.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <map>
#include <set>
#include <tuple>

namespace ricci::testing {
namespace {

struct Body
{
	std::string name;
	SurfaceMesh mesh;
};

std::vector<Body> bodies()
{
	Random random(20261128);
	std::vector<Body> all{
		{"Box", perforatedSlab(0, 2)},
		{"Plate", shaken(perforatedSlab(2, 2), 0.08, random)},
		{"Torus", bumpyTorus(14, 10, random)},
		{"Slivers", sliverDisk(10, 2.0, random)},
		{"Sheet", shaken(rectangle(9, 7, 2.0, 1.0), 0.05, random)},
		{"Tube", sphereWithTube(0.08, 2.0, 0.6, 12, 12)}};
	const std::vector<SurfaceMesh> kinds = surfacesOfEveryKind(random);
	for (std::size_t i = 0; i < kinds.size(); ++i)
		all.push_back({"Kind" + std::to_string(i), kinds[i]});
	return all;
}

struct Asked
{
	std::string name;
	TargetCurvature target;
	ConeRounding rounding = ConeRounding::Free;
	bool needsDisk = false;
};

const std::vector<Asked>& asked()
{
	static const std::vector<Asked> all{
		{"Automatic", TargetCurvature::Automatic},
		{"PlacedCones", TargetCurvature::PlacedCones},
		{"QuarterTurns", TargetCurvature::PlacedCones, ConeRounding::QuarterTurns},
		{"Disk", TargetCurvature::Disk, ConeRounding::Free, true},
		{"Rectangle", TargetCurvature::Rectangle, ConeRounding::Free, true}};
	return all;
}

/// Twice the signed area. Floats have exact differences here.
long double doubledAreaOf(const Triangle2& p)
{
	const auto side = [&](std::size_t k, std::size_t i) {
		return static_cast<long double>(p[k][i]) - static_cast<long double>(p[0][i]);
	};
	return side(1, 0) * side(2, 1) - side(1, 1) * side(2, 0);
}

/// A map as floats.
struct Stored
{
	FlatResult map;
	int flipped = 0;

	Stored(const SurfaceMesh& mesh, Parametrization whole)
	{
		for (Point2& p : whole.mesh.place)
			for (double& x : p) {
				x = static_cast<double>(static_cast<float>(x));
				EXPECT_GE(x, 0.0);
				EXPECT_LE(x, 1.0);
			}
		map = withCorners(mesh, std::move(whole));
		for (const Triangle2& t : map.uv)
			flipped += !(doubledAreaOf(t) > 0.0L);
	}
};

using Finished = std::tuple<std::size_t, Finish>;

class ValidMaps : public ::testing::TestWithParam<Finished>
{
};

TEST_P(ValidMaps, HoldInFloats)
{
	const Asked& how = asked()[std::get<0>(GetParam())];
	int maps = 0;
	for (const Body& body : bodies()) {
		SCOPED_TRACE(body.name);
		Options options;
		options.target = how.target;
		options.cones.rounding = how.rounding;
		options.finish = std::get<1>(GetParam());
		Parametrization map;
		try {
			map = parametrizeEuclidean(body.mesh, VertexInput(), options);
		}
		catch (const InvalidOption& refusal) {
			EXPECT_TRUE(how.needsDisk && refusal.problem == InvalidOption::NotADisk);
			continue;
		}
		++maps;
		ASSERT_EQ(at(map.mesh.size()), body.mesh.triangles.size());
		const Stored stored(body.mesh, map);
		EXPECT_EQ(stored.flipped, 0);
		EXPECT_EQ(map.report.flippedFaces + map.report.flippedByRounding, stored.flipped);
		const CoveredTwice covered(body.mesh, stored.map.uv);
		EXPECT_EQ(covered.betweenCharts, 0);
		EXPECT_EQ(covered.withinCharts, 0);
		EXPECT_EQ(map.report.overlappingFaces, 0);
		if (options.finish == Finish::LeastStretch) // it leaves both sides free
			continue;
		EXPECT_EQ(map.report.unequalSeams, 0);
		EXPECT_LT(MapCheck(body.mesh, stored.map).seamMismatch, 1e-3);
	}
	EXPECT_GE(maps, 3);
}

/// The boundary loop of a disk: its points in the map, in order.
std::vector<Point2> borderOf(const SurfaceMesh& mesh, const FlatMesh& map)
{
	std::map<int, std::pair<int, Point2>> next; // [vertex] the one after it, and its own place
	std::set<std::array<int, 2>> sides;
	for (const Triangle& t : mesh.triangles)
		for (std::size_t k = 0; k < 3; ++k)
			sides.insert({t[k], t[(k + 1) % 3]});
	for (int f = 0; f < map.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k)
			if (const Triangle& t = map.vertices[f]; sides.count({t[(k + 1) % 3], t[k]}) == 0)
				next[t[k]] = {t[(k + 1) % 3], map.at(f)[k]};
	std::vector<Point2> border;
	int v = next.begin()->first;
	do {
		border.push_back(next.at(v).second);
		v = next.at(v).first;
	} while (v != next.begin()->first);
	EXPECT_EQ(border.size(), next.size());
	return border;
}

/// Three points of a circle span an area if they are in their order, so that a disk can be both: round as far as its
/// numbers tell, and without flipped triangles, with two edges of a triangle on its boundary, too, which straight lines
/// make flat.
TEST(ValidRoundDisks, StayRound)
{
	Random random(60);
	std::vector<SurfaceMesh> disks{
		rectangle(1, 1, 1, 1),
		sliverDisk(10, 2.0, random),
		randomPlanarDisk(20, random),
		sphereWithTube(0.08, 2.0, 0.6, 12, 12)};
	disks.push_back({{{0, 0, 0}, {3, 0, 0}, {1, 1, 0}}, {{0, 1, 2}}}); // three edges on it
	for (const int n : {8, 20, 60, 60, 60}) {
		disks.push_back(shaken(rectangle(n, n, 1, 1), 0.3 / n, random));
		for (Point3& p : disks.back().positions)
			p[2] = 0.0;
	}
	for (const SurfaceMesh& mesh : disks)
		for (const bool isImplied : {false, true})
			for (const Finish finish : {Finish::None, Finish::Repair, Finish::LeastDistortion}) {
				SCOPED_TRACE(mesh.triangles.size());
				Options options;
				options.finish = finish;
				options.freeBoundary = !isImplied; // Automatic then takes a disk
				if (isImplied)
					options.charts = Charts::OfTheFlow; // not cut
				options.target = isImplied ? TargetCurvature::Automatic : TargetCurvature::Disk;
				const Parametrization map = parametrizeEuclidean(mesh, VertexInput(), options);
				if (finish != Finish::None) {
					EXPECT_EQ(Stored(mesh, map).flipped, 0);
					EXPECT_EQ(map.charts.size(), 1u);
				}
				const std::vector<Point2> border = borderOf(mesh, map.mesh);
				const auto n = border.size();
				using Complex = std::complex<double>;
				const Complex a = asComplex(border[0]), u = asComplex(border[n / 3]) - a;
				const Complex v = asComplex(border[2 * n / 3]) - a;
				const Complex toCentre = Complex(0, 0.5) * (std::norm(v) * u - std::norm(u) * v) /
										 (std::conj(u) * v).imag();
				const double radius = std::abs(toCentre);
				double turned = 0.0;
				for (std::size_t i = 0; i < n; ++i) {
					const Complex p = asComplex(border[i]) - a - toCentre;
					const Complex q = asComplex(border[(i + 1) % n]) - a - toCentre;
					EXPECT_NEAR(std::abs(p), radius, 1e-12 * radius);
					const Point2 stored{roundedToFloat(border[i][0]), roundedToFloat(border[i][1])};
					EXPECT_NEAR( // half a step below 1 along both axes
						std::abs(asComplex(stored) - a - toCentre),
						radius,
						std::sqrt(2.0) * 0x1p-25 * (1 + 1e-6));
					EXPECT_GT(std::arg(q / p), 0.0);
					turned += std::arg(q / p);
				}
				EXPECT_NEAR(turned, 2 * kPi, 1e-9);
			}
}

/// Long thin plates with holes, whose pictures are far from what straight triangles can draw.
TEST(ValidDisks, HoldInFloats)
{
	Random random(81);
	for (const int genus : {2, 3, 4, 6})
		for (const double height : {1.0, 0.3, 0.1}) {
			const SurfaceMesh plate =
				stretched(shaken(perforatedSlab(genus, 1), 0.2, random), {1, height, height});
			const Parametrization map =
				parametrizeHyperbolic(plate, VertexInput(), HyperbolicOptions());
			const Stored stored(plate, map);
			EXPECT_EQ(map.report.flippedFaces + map.report.flippedByRounding, stored.flipped);
			EXPECT_EQ(stored.flipped, 0);
			const CoveredTwice covered(plate, stored.map.uv);
			EXPECT_EQ(covered.betweenCharts, 0);
			EXPECT_EQ(covered.withinCharts, 0);
			EXPECT_EQ(map.report.overlappingFaces, 0);
			EXPECT_EQ(map.report.unequalSeams, 0);
			EXPECT_NEAR(map.report.hyperbolicArea.value_or(0.0), 4 * kPi * (genus - 1), 1e-9);
		}
}

std::string nameOf(const ::testing::TestParamInfo<Finished>& info)
{
	const char* finishes[] = {"None", "Repair", "LeastDistortion", "LeastStretch"};
	return asked()[std::get<0>(info.param)].name +
		   finishes[static_cast<int>(std::get<1>(info.param))];
}

INSTANTIATE_TEST_SUITE_P(
	Asked,
	ValidMaps,
	::testing::Combine(
		::testing::Range(std::size_t(0), asked().size()),
		::testing::Values(Finish::Repair, Finish::LeastDistortion, Finish::LeastStretch)),
	nameOf);

} // namespace
} // namespace ricci::testing
