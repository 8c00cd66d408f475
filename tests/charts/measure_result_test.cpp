// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/shapes.h"

#include <ricci/charts/measure_result.h>

#include <gtest/gtest.h>

#include <vector>

namespace ricci::testing {
namespace {

/// A rectangle of 3 by 2 unit cells that is drawn as it is, \p stretch times as wide.
Parametrization stretched(const SurfaceMesh& mesh, double stretch)
{
	Parametrization map;
	for (const Triangle& t : mesh.triangles) {
		Triangle2 p;
		for (std::size_t k = 0; k < 3; ++k)
			p[k] = {stretch * mesh.positions[at(t[k])][0], mesh.positions[at(t[k])][1]};
		map.uv.push_back(p);
	}
	map.reversed.assign(map.uv.size(), 0);
	return map;
}

/// Each triangle in three round its middle, drawn \p stretch times as wide.
void refine(const SurfaceMesh& mesh, double stretch, Parametrization& map)
{
	RefinedMesh& refined = map.refined;
	std::vector<Point3> places = mesh.positions;
	for (std::size_t v = 0; v < mesh.positions.size(); ++v)
		refined.points.push_back({{static_cast<int>(v), 0, 0, 0}, {1, 0, 0, 0}});
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
		const Triangle& t = mesh.triangles[f];
		const int middle = static_cast<int>(refined.points.size());
		refined.points.push_back({{t[0], t[1], t[2], 0}, {1.0 / 3, 1.0 / 3, 1.0 / 3, 0}});
		places.push_back(placeOnSurface(refined.points.back(), mesh.positions));
		for (std::size_t k = 0; k < 3; ++k) {
			const Triangle part{t[k], t[(k + 1) % 3], middle};
			Triangle2 p;
			for (std::size_t i = 0; i < 3; ++i)
				p[i] = {stretch * places[at(part[i])][0], places[at(part[i])][1]};
			refined.triangles.push_back(part);
			refined.inputFace.push_back(static_cast<int>(f));
			refined.uv.push_back(p);
		}
	}
}

void expectAll(const std::vector<double>& field, std::size_t size, double value)
{
	ASSERT_EQ(field.size(), size);
	for (const double x : field)
		EXPECT_NEAR(x, value, 1e-12);
}

/// The quotient of the singular values of a map that is twice as wide is 2.
TEST(MeasureResult, OfAMapOfTheMeshIsItsOwnDistortion)
{
	const SurfaceMesh mesh = rectangle(3, 2, 3.0, 2.0);
	Parametrization map = stretched(mesh, 2.0);
	map.report.charts = 7;
	measureResult(mesh, measureDistortion, map);
	expectAll(map.faceQC, mesh.triangles.size(), 2.0);
	expectAll(map.vertexQC, mesh.positions.size(), 2.0);
	EXPECT_NEAR(map.report.qcAreaMean, 2.0, 1e-12);
	EXPECT_EQ(map.report.charts, 7);
	EXPECT_TRUE(map.refined.faceQC.empty());
}

TEST(MeasureResult, OfARefinementReportsTheRefinement)
{
	const SurfaceMesh mesh = rectangle(3, 2, 3.0, 2.0);
	Parametrization map = stretched(mesh, 2.0);
	refine(mesh, 0.2, map);
	map.report.charts = 7;
	measureResult(mesh, measureDistortion, map);
	expectAll(map.faceQC, mesh.triangles.size(), 2.0);
	expectAll(map.vertexQC, mesh.positions.size(), 2.0);
	expectAll(map.refined.faceQC, 3 * mesh.triangles.size(), 5.0);
	expectAll(map.refined.vertexQC, mesh.positions.size() + mesh.triangles.size(), 5.0);
	EXPECT_NEAR(map.report.qcAreaMean, 5.0, 1e-12);
	EXPECT_EQ(map.report.flippedFaces, 0);
	EXPECT_EQ(map.report.charts, 7);
}

/// Parts of a face that was turned round are wanted clockwise as it is.
TEST(MeasureResult, PartsAreReversedWhereTheirFacesAre)
{
	const SurfaceMesh mesh = rectangle(3, 2, 3.0, 2.0);
	Parametrization map = stretched(mesh, 1.0);
	refine(mesh, 1.0, map);
	map.reversed[1] = map.reversed[4] = 1; // drawn counter-clockwise none the less
	measureResult(mesh, measureDistortion, map);
	EXPECT_EQ(map.report.flippedFaces, 2 * 3);
	map.refined = {};
	measureResult(mesh, measureDistortion, map);
	EXPECT_EQ(map.report.flippedFaces, 2);
}

/// What measures gets the mesh first and then the refinement in space.
TEST(MeasureResult, AsksForEachTriangulationOnce)
{
	const SurfaceMesh mesh = rectangle(3, 2, 3.0, 2.0);
	for (const bool isRefined : {false, true}) {
		Parametrization map = stretched(mesh, 1.0);
		if (isRefined)
			refine(mesh, 1.0, map);
		std::vector<SurfaceMesh> measured;
		measureResult(
			mesh,
			[&](const SurfaceMesh& m,
				const std::vector<Triangle2>& plane,
				const std::vector<char>& reversed,
				Report&) {
				EXPECT_EQ(plane.size(), m.triangles.size());
				EXPECT_EQ(reversed.size(), m.triangles.size());
				measured.push_back(m);
				return DistortionField();
			},
			map);
		ASSERT_EQ(measured.size(), isRefined ? 2u : 1u);
		EXPECT_EQ(measured[0].triangles, mesh.triangles);
		if (isRefined) {
			EXPECT_NEAR(surfaceArea(measured[1].positions, measured[1].triangles), 6.0, 1e-12);
		}
	}
}

} // namespace
} // namespace ricci::testing
