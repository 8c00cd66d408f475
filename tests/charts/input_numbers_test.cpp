// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/shapes.h"

#include <ricci/charts/input_numbers.h>
#include <ricci/math/orientation.h>
#include <ricci/measure/distortion.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace ricci::testing {
namespace {

/// A map of \p mesh whose every value is another number: corners drawn at (face, corner) of the opened
/// mesh.
Parametrization numbered(const SurfaceMesh& mesh)
{
	Parametrization map;
	std::vector<std::string> notes;
	map.opened = openMesh(mesh, notes);
	const SurfaceMesh& opened = map.opened.mesh;
	Chart chart;
	for (std::size_t f = 0; f < opened.triangles.size(); ++f) {
		const double x = static_cast<double>(f);
		map.uv.push_back({Point2{x, 0.0}, Point2{x, 1.0}, Point2{x, 2.0}});
		map.faceQC.push_back(10.0 + x);
		map.reversed.push_back(static_cast<char>(f % 2));
		chart.faces.push_back(static_cast<int>(f));
	}
	for (std::size_t v = 0; v < opened.positions.size(); ++v) {
		const double x = static_cast<double>(v);
		map.vertexQC.push_back(1.0 + x * x);
		map.u.push_back(100.0 + x);
		map.targetCurvature.push_back(200.0 + x);
	}
	map.charts.push_back(chart);
	map.report.qcMean = 7.0;
	return map;
}

/// The same with the opened mesh for its refinement, and a crossing on a side of its last face.
Parametrization refined(const SurfaceMesh& mesh)
{
	Parametrization map = numbered(mesh);
	const SurfaceMesh& opened = map.opened.mesh;
	RefinedMesh& r = map.refined;
	for (std::size_t v = 0; v < opened.positions.size(); ++v) {
		SurfacePoint p;
		p.vertex[0] = static_cast<int>(v);
		r.points.push_back(p);
	}
	r.vertexQC = map.vertexQC;
	r.triangles = opened.triangles;
	r.uv = map.uv;
	r.faceQC = map.faceQC;
	for (std::size_t f = 0; f < opened.triangles.size(); ++f)
		r.inputFace.push_back(static_cast<int>(f));
	const Triangle last = r.triangles.back();
	const int crossing = static_cast<int>(r.points.size());
	SurfacePoint p;
	p.vertex = {last[0], last[1], 0, 0};
	p.weight = {0.25, 0.75, 0, 0};
	r.points.push_back(p);
	r.vertexQC.push_back(5.0);
	r.triangles.back() = {last[0], crossing, last[2]};
	r.triangles.push_back({crossing, last[1], last[2]});
	r.uv.push_back(r.uv.back());
	r.faceQC.push_back(3.0);
	r.inputFace.push_back(r.inputFace.back());
	return map;
}

double areaOf(const SurfaceMesh& mesh, std::size_t f)
{
	const Triangle& t = mesh.triangles[f];
	return triangleArea(
		{mesh.positions[at(t[0])], mesh.positions[at(t[1])], mesh.positions[at(t[2])]});
}

/// Two triangles of areas 1 and 3 that share the vertex 0 only.
SurfaceMesh bowTie()
{
	return {{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {-3, 0, 0}, {0, -2, 0}}, {{0, 1, 2}, {3, 4, 0}}};
}

TEST(InputNumbers, LeavesAMapOfAnUncutMeshAlone)
{
	const SurfaceMesh mesh = torus(2, 1, 6, 5);
	Parametrization map = refined(mesh);
	const Parametrization before = map;
	toInputNumbers(mesh, map);
	EXPECT_EQ(map.uv, before.uv);
	EXPECT_EQ(map.vertexQC, before.vertexQC);
	EXPECT_EQ(map.u, before.u);
	EXPECT_EQ(map.refined.triangles, before.refined.triangles);
	EXPECT_EQ(map.refined.inputFace, before.refined.inputFace);
	EXPECT_EQ(map.charts[0].faces, before.charts[0].faces);
}

TEST(InputNumbers, VerticesTakeMeansWeightedByArea)
{
	const SurfaceMesh mesh = bowTie();
	for (const bool isRefined : {false, true}) {
		Parametrization map = isRefined ? refined(mesh) : numbered(mesh);
		ASSERT_EQ(map.opened.vertex, (std::vector<int>{0, 1, 2, 3, 4, 0}));
		const double mean = (1.0 * map.vertexQC[0] + 3.0 * map.vertexQC[5]) / 4.0;
		toInputNumbers(mesh, map);
		ASSERT_EQ(map.vertexQC.size(), 5u);
		EXPECT_NEAR(map.vertexQC[0], mean, 1e-12);
		for (int v = 1; v < 5; ++v)
			EXPECT_NEAR(map.vertexQC[at(v)], 1.0 + v * v, 1e-12);
		// The vertex's own, not its copies'.
		EXPECT_EQ(map.u, (std::vector<double>{100, 101, 102, 103, 104}));
		EXPECT_EQ(map.targetCurvature, (std::vector<double>{200, 201, 202, 203, 204}));
		EXPECT_EQ(map.report.qcMean, 7.0);
		EXPECT_TRUE(map.opened.vertex.empty());
		if (isRefined) {
			EXPECT_NEAR(map.refined.vertexQC[0], mean, 1e-12);
			EXPECT_EQ(map.refined.vertexQC[5], 5.0); // of the crossing
		}
	}
}

TEST(InputNumbers, ThePiecesOfARefinementMeetAtTheVertices)
{
	const SurfaceMesh mesh = bowTie();
	Parametrization map = refined(mesh);
	const std::vector<Triangle2> uv = map.refined.uv;
	toInputNumbers(mesh, map);
	const RefinedMesh& r = map.refined;
	ASSERT_EQ(r.points.size(), 6u); // five vertices, and the crossing behind them
	for (int v = 0; v < 5; ++v)
		EXPECT_EQ(r.points[at(v)].vertex[0], v);
	EXPECT_EQ(r.points[5].vertex, (std::array<int, 4>{3, 4, 0, 0}));
	EXPECT_EQ(r.triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 5, 0}, {5, 4, 0}}));
	EXPECT_EQ(r.inputFace, (std::vector<int>{0, 1, 1}));
	EXPECT_EQ(r.uv, uv);
}

/// Degenerate faces are drawn on a side of a face with that edge, at a vertex, or nowhere.
TEST(InputNumbers, DegenerateFacesAreDrawnAsLines)
{
	SurfaceMesh mesh = rectangle(2, 2, 1, 1);
	const std::size_t faces = mesh.triangles.size();
	const Triangle next = mesh.triangles[3];
	for (double x : {5.0, 6.0, 7.0, 8.0})
		mesh.positions.push_back({x, 0.0, 0.0}); // 9, 10, 11, 12
	mesh.triangles.insert(mesh.triangles.begin(), {next[1], next[2], next[2]});
	mesh.triangles.push_back({next[2], next[2], next[2]});
	mesh.triangles.push_back({next[0], 9, 9});
	mesh.triangles.push_back({9, 10, 11});
	mesh.triangles.push_back({12, 12, 12});
	for (const bool isRefined : {false, true}) {
		Parametrization map = isRefined ? refined(mesh) : numbered(mesh);
		const std::vector<Triangle2> before = map.uv;
		ASSERT_EQ(map.opened.degenerate, (std::vector<int>{0, 9, 10, 11, 12}));
		const std::size_t pieces = map.refined.triangles.size();
		toInputNumbers(mesh, map);
		ASSERT_EQ(map.uv.size(), faces + 5);
		for (std::size_t f = 0; f < faces; ++f) {
			EXPECT_EQ(map.uv[f + 1], before[f]);
			EXPECT_EQ(map.faceQC[f + 1], 10.0 + static_cast<double>(f));
			EXPECT_EQ(map.reversed[f + 1], static_cast<char>(f % 2));
			EXPECT_EQ(map.charts[0].faces[f], static_cast<int>(f) + 1);
		}
		EXPECT_EQ(map.charts.size(), 1u); // of no chart
		EXPECT_EQ(map.charts[0].faces.size(), faces);
		const auto isCornerOf = [&](const Point2& p, int v) {
			for (std::size_t f = 1; f <= faces; ++f)
				for (std::size_t k = 0; k < 3; ++k)
					if (mesh.triangles[f][k] == v && map.uv[f][k] == p)
						return true;
			return false;
		};
		for (const std::size_t f : {std::size_t(0), faces + 1, faces + 2, faces + 3, faces + 4}) {
			EXPECT_EQ(orientation(map.uv[f][0], map.uv[f][1], map.uv[f][2]), 0);
			EXPECT_EQ(map.faceQC[f], 1.0);
			EXPECT_EQ(areaOf(mesh, f), 0.0);
		}
		// Along the edge: both ends at corners of one face.
		EXPECT_TRUE(isCornerOf(map.uv[0][0], next[1]));
		EXPECT_TRUE(isCornerOf(map.uv[0][1], next[2]));
		EXPECT_EQ(map.uv[0][0][0], map.uv[0][1][0]); // its number is the first coordinate
		EXPECT_NE(map.uv[0][0], map.uv[0][1]);
		EXPECT_EQ(map.uv[0][1], map.uv[0][2]);
		// A point, and an edge that no face has.
		EXPECT_TRUE(isCornerOf(map.uv[faces + 1][0], next[2]));
		EXPECT_TRUE(isCornerOf(map.uv[faces + 2][0], next[0]));
		EXPECT_EQ(map.uv[faces + 2][0], map.uv[faces + 2][1]);
		for (const std::size_t f : {faces + 3, faces + 4})
			for (const Point2& p : map.uv[f])
				EXPECT_EQ(p, (Point2{0.0, 0.0}));
		if (!isRefined)
			continue;
		const RefinedMesh& r = map.refined;
		ASSERT_EQ(r.triangles.size(), pieces + 5);
		for (std::size_t i = 0; i < 5; ++i) {
			const std::size_t f = i == 0 ? 0 : faces + i;
			EXPECT_EQ(r.inputFace[pieces + i], static_cast<int>(f));
			EXPECT_EQ(r.triangles[pieces + i], mesh.triangles[f]);
			EXPECT_EQ(r.uv[pieces + i], map.uv[f]);
		}
	}
}

/// Whichever corners have the same vertex, they are drawn at one point, the third at the other end.
TEST(InputNumbers, CornersAtOneVertexAreDrawnAtOnePoint)
{
	const SurfaceMesh plain = rectangle(1, 1, 1, 1);
	const int a = plain.triangles[0][0], b = plain.triangles[0][1];
	for (const Triangle& line : {Triangle{a, a, b}, Triangle{a, b, a}, Triangle{b, a, a}}) {
		SurfaceMesh mesh = plain;
		mesh.triangles.push_back(line);
		Parametrization map = refined(mesh);
		toInputNumbers(mesh, map);
		const Triangle2& drawn = map.uv.back();
		for (std::size_t k = 0; k < 3; ++k)
			for (std::size_t j = 0; j < 3; ++j)
				EXPECT_EQ(drawn[k] == drawn[j], line[k] == line[j]) << k << j;
		EXPECT_EQ(map.refined.uv.back(), drawn);
		EXPECT_EQ(map.refined.faceQC.back(), 1.0);
		EXPECT_EQ(map.refined.inputFace.back(), 2);
	}
}

} // namespace
} // namespace ricci::testing
