// SPDX-License-Identifier: GPL-3.0-or-later
// What every map is whose triangles are the mesh's own, whatever it was asked for: no triangle is flipped, no
// two cover the same part of the square, and seams fit, in the floats that are stored.
#include "support/flat_map.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/parametrize.h>

#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

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
long double doubledAreaOf(const std::array<std::array<float, 2>, 3>& p)
{
	const auto side = [&](std::size_t k, std::size_t i) {
		return static_cast<long double>(p[k][i]) - static_cast<long double>(p[0][i]);
	};
	return side(1, 0) * side(2, 1) - side(1, 1) * side(2, 0);
}

/// A map as floats.
struct Stored
{
	UV uv; ///< [face of the mesh]
	int flipped = 0;

	explicit Stored(const FlatMesh& mesh) : uv(at(mesh.size()))
	{
		for (int f = 0; f < mesh.size(); ++f) {
			std::array<std::array<float, 2>, 3> stored;
			for (std::size_t k = 0; k < 3; ++k)
				for (std::size_t i = 0; i < 2; ++i) {
					stored[k][i] = static_cast<float>(mesh.at(f)[k][i]);
					EXPECT_GE(stored[k][i], 0.0f);
					EXPECT_LE(stored[k][i], 1.0f);
					uv[at(mesh.face[f])][k][i] = static_cast<double>(stored[k][i]);
				}
			flipped += !(doubledAreaOf(stored) > 0.0L);
		}
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
		const Stored stored(map.mesh);
		EXPECT_EQ(stored.flipped, 0);
		EXPECT_EQ(map.report.flippedFaces + map.report.flippedByRounding, stored.flipped);
		const CoveredTwice covered(
			body.mesh, stored.uv, std::vector<char>(body.mesh.triangles.size(), 0));
		EXPECT_EQ(covered.betweenCharts, 0);
		EXPECT_EQ(covered.withinCharts, 0);
		EXPECT_EQ(map.report.overlappingFaces, 0);
		if (options.finish == Finish::LeastStretch) // it leaves both sides free
			continue;
		EXPECT_EQ(map.report.unequalSeams, 0);
		EXPECT_LT(FlatMap(body.mesh, stored.uv).seamMismatch, 1e-3);
	}
	EXPECT_GE(maps, 3);
}

/// Long thin plates with holes, whose pictures are far from what straight triangles can draw.
TEST(ValidDisks, HoldInFloats)
{
	Random random(81);
	for (const int genus : {2, 3, 4, 6})
		for (const double height : {1.0, 0.3, 0.1}) {
			SurfaceMesh plate = shaken(perforatedSlab(genus, 1), 0.2, random);
			for (Point3& p : plate.positions)
				p = {p[0], height * p[1], height * p[2]};
			const Parametrization map =
				parametrizeHyperbolic(plate, VertexInput(), HyperbolicOptions());
			const Stored stored(map.mesh);
			EXPECT_EQ(map.report.flippedFaces + map.report.flippedByRounding, stored.flipped);
			EXPECT_EQ(stored.flipped, 0);
			const CoveredTwice covered(
				plate, stored.uv, std::vector<char>(plate.triangles.size(), 0));
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
