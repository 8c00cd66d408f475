// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/flat_meshes.h"

#include <ricci/charts/input_indices.h>
#include <ricci/math/orientation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace ricci::testing {
namespace {

/// A map of \p mesh whose every value is another number: corners lie at (face, corner) of the opened mesh.
struct Numbered
{
	OpenedMesh opened;
	Parametrization map;

	explicit Numbered(const SurfaceMesh& mesh)
	{
		std::vector<std::string> notes;
		opened = openMesh(mesh, notes);
		std::vector<Triangle2> plane;
		for (std::size_t f = 0; f < opened.mesh.triangles.size(); ++f) {
			const double x = static_cast<double>(f);
			plane.push_back({Point2{x, 0.0}, Point2{x, 1.0}, Point2{x, 2.0}});
		}
		map = mapWith(flatMesh(opened.mesh, plane));
		for (std::size_t v = 0; v < opened.mesh.positions.size(); ++v) {
			const double x = static_cast<double>(v);
			map.vertexQC.push_back(1.0 + x * x);
			map.u.push_back(100.0 + x);
			map.targetCurvature.push_back(200.0 + x);
		}
		map.report.qcMean = 7.0;
	}

	/// A crossing on the first side of the last face divides it.
	void refine()
	{
		FlatMesh& flat = map.mesh;
		const Triangle last = flat.vertices.back();
		const int crossing = flat.source.size();
		flat.source.push_back({{last[0], last[1], 0, 0}, {0.25, 0.75, 0, 0}});
		map.vertexQC.push_back(5.0);
		flat.vertices.back()[1] = crossing;
		flat.vertices.push_back({crossing, last[1], last[2]});
		flat.points.push_back({});
		for (int& p : flat.points.back()) {
			p = flat.place.size();
			flat.place.push_back({-1.0 * p, 0.0});
		}
		flat.lengths.push_back({});
		flat.chart.push_back(0);
		flat.face.push_back(flat.face.back());
	}
};

/// Two triangles of areas 1 and 3 that share the vertex 0 only.
SurfaceMesh bowTie()
{
	return {{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {-3, 0, 0}, {0, -2, 0}}, {{0, 1, 2}, {3, 4, 0}}};
}

TEST(InputIndices, LeaveAMapOfAnUncutMeshAlone)
{
	const SurfaceMesh mesh = torus(2, 1, 6, 5);
	Numbered n(mesh);
	n.refine();
	const Parametrization before = n.map;
	toInputIndices(mesh, n.opened, n.map);
	EXPECT_EQ(n.map.mesh.corners(), before.mesh.corners());
	EXPECT_EQ(n.map.mesh.vertices, before.mesh.vertices);
	EXPECT_EQ(n.map.mesh.face, before.mesh.face);
	EXPECT_EQ(n.map.vertexQC, before.vertexQC);
	EXPECT_EQ(n.map.u, before.u);
}

/// The input's order of corners, with what belongs to corners and sides.
TEST(InputIndices, ReversedFacesGetTheirOrderBack)
{
	SurfaceMesh mesh = torus(2, 1, 6, 5);
	const std::vector<Triangle> coherent = mesh.triangles;
	for (const std::size_t f : {3u, 4u, 17u})
		std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
	Numbered n(mesh);
	n.map.mesh = flatMesh({mesh.positions, coherent}, n.map.mesh.corners().values());
	toInputIndices(mesh, n.opened, n.map);
	EXPECT_EQ(n.map.mesh.vertices.values(), mesh.triangles);
	for (const int f : n.map.mesh.points.indices())
		for (std::size_t k = 0; k < 3; ++k) {
			const Triangle& t = mesh.triangles[at(f)];
			const auto own = std::find(coherent[at(f)].begin(), coherent[at(f)].end(), t[k]);
			EXPECT_EQ(n.map.mesh.at(f)[k][1], static_cast<double>(own - coherent[at(f)].begin()));
			EXPECT_EQ(
				n.map.mesh.lengths[f][k],
				distance(mesh.positions[at(t[k])], mesh.positions[at(t[(k + 1) % 3])]));
		}
}

TEST(InputIndices, VerticesTakeMeansWeightedByArea)
{
	const SurfaceMesh mesh = bowTie();
	for (const bool isRefined : {false, true}) {
		Numbered n(mesh);
		if (isRefined)
			n.refine();
		ASSERT_EQ(n.opened.vertex, (std::vector<int>{0, 1, 2, 3, 4, 0}));
		const double mean = (1.0 * n.map.vertexQC[0] + 3.0 * n.map.vertexQC[5]) / 4.0;
		toInputIndices(mesh, n.opened, n.map);
		ASSERT_EQ(n.map.vertexQC.size(), isRefined ? 6u : 5u);
		EXPECT_NEAR(n.map.vertexQC[0], mean, 1e-12);
		for (int v = 1; v < 5; ++v)
			EXPECT_NEAR(n.map.vertexQC[at(v)], 1.0 + v * v, 1e-12);
		// The vertex's own, not its copies'.
		EXPECT_EQ(n.map.u, (std::vector<double>{100, 101, 102, 103, 104}));
		EXPECT_EQ(n.map.targetCurvature, (std::vector<double>{200, 201, 202, 203, 204}));
		EXPECT_EQ(n.map.report.qcMean, 7.0);
		if (isRefined) {
			EXPECT_EQ(n.map.vertexQC[5], 5.0); // of the crossing
		}
	}
}

TEST(InputIndices, ThePiecesOfARefinementMeetAtTheVertices)
{
	const SurfaceMesh mesh = bowTie();
	Numbered n(mesh);
	n.refine();
	const Array<Triangle2> plane = n.map.mesh.corners();
	toInputIndices(mesh, n.opened, n.map);
	const FlatMesh& flat = n.map.mesh;
	ASSERT_EQ(flat.source.size(), 6); // five vertices, and the crossing behind them
	for (int v = 0; v < 5; ++v)
		EXPECT_EQ(flat.source[v].vertex[0], v);
	EXPECT_EQ(flat.source[5].vertex, (std::array<int, 4>{3, 4, 0, 0}));
	EXPECT_EQ(flat.vertices.values(), (std::vector<Triangle>{{0, 1, 2}, {3, 5, 0}, {5, 4, 0}}));
	EXPECT_EQ(flat.face.values(), (std::vector<int>{0, 1, 1}));
	EXPECT_EQ(flat.corners(), plane);
}

/// Degenerate faces lie on a side of a face with that edge, at a vertex, or nowhere.
TEST(InputIndices, DegenerateFacesBecomeLines)
{
	SurfaceMesh mesh = rectangle(2, 2, 1, 1);
	const int faces = static_cast<int>(mesh.triangles.size());
	const Triangle next = mesh.triangles[3];
	for (double x : {5.0, 6.0, 7.0, 8.0})
		mesh.positions.push_back({x, 0.0, 0.0}); // 9, 10, 11, 12
	mesh.triangles.insert(mesh.triangles.begin(), {next[1], next[2], next[2]});
	mesh.triangles.push_back({next[2], next[2], next[2]});
	mesh.triangles.push_back({next[0], 9, 9});
	mesh.triangles.push_back({9, 10, 11});
	mesh.triangles.push_back({12, 12, 12});
	Numbered n(mesh);
	const Array<Triangle2> before = n.map.mesh.corners();
	ASSERT_EQ(n.opened.degenerate, (std::vector<int>{0, 9, 10, 11, 12}));
	toInputIndices(mesh, n.opened, n.map);
	const FlatMesh& flat = n.map.mesh;
	ASSERT_EQ(flat.size(), faces + 5);
	for (int f = 0; f < flat.size(); ++f)
		EXPECT_EQ(flat.face[f], f);
	for (int f = 0; f < faces; ++f) {
		EXPECT_EQ(flat.at(f + 1), before[f]);
		EXPECT_EQ(flat.chart[f + 1], 0);
	}
	for (const int f : n.opened.degenerate) {
		EXPECT_EQ(flat.chart[f], -1);
		EXPECT_EQ(flat.vertices[f], mesh.triangles[at(f)]);
		EXPECT_EQ(orientation(flat.at(f)[0], flat.at(f)[1], flat.at(f)[2]), 0);
	}
	for (const Corner c : cornersOf(0)) // a point has one vertex
		for (int other = 0; other < 3 * flat.size(); ++other)
			if (flat.points[c] == flat.points[Corner(other)]) {
				EXPECT_EQ(flat.vertices[c], flat.vertices[Corner(other)]);
			}
	const auto isCornerOf = [&](const Point2& p, int v) {
		for (int c = 3; c < 3 * (1 + faces); ++c)
			if (flat.vertices[Corner(c)] == v && flat.at(Corner(c)) == p)
				return true;
		return false;
	};
	// Along the edge: both ends at corners of one face.
	const Triangle2 line = flat.at(0), point = flat.at(faces + 1), end = flat.at(faces + 2);
	EXPECT_TRUE(isCornerOf(line[0], next[1]));
	EXPECT_TRUE(isCornerOf(line[1], next[2]));
	EXPECT_EQ(line[0][0], line[1][0]); // its number is the first coordinate
	EXPECT_NE(line[0], line[1]);
	EXPECT_EQ(line[1], line[2]);
	// A point, and an edge that no face has.
	EXPECT_TRUE(isCornerOf(point[0], next[2]));
	EXPECT_TRUE(isCornerOf(end[0], next[0]));
	EXPECT_EQ(end[0], end[1]);
	for (const int f : {faces + 3, faces + 4})
		for (const Point2& p : flat.at(f))
			EXPECT_EQ(p, (Point2{0.0, 0.0}));
}

/// Whichever corners have the same vertex, they lie at one point, the third at the other end.
TEST(InputIndices, CornersAtOneVertexLieAtOnePoint)
{
	const SurfaceMesh plain = rectangle(1, 1, 1, 1);
	const int a = plain.triangles[0][0], b = plain.triangles[0][1];
	for (const Triangle& line : {Triangle{a, a, b}, Triangle{a, b, a}, Triangle{b, a, a}}) {
		SurfaceMesh mesh = plain;
		mesh.triangles.push_back(line);
		Numbered n(mesh);
		toInputIndices(mesh, n.opened, n.map);
		const Triangle& points = n.map.mesh.points.back();
		for (std::size_t k = 0; k < 3; ++k)
			for (std::size_t j = 0; j < 3; ++j)
				EXPECT_EQ(points[k] == points[j], line[k] == line[j]) << k << j;
		EXPECT_EQ(n.map.mesh.face.back(), 2);
	}
}

} // namespace
} // namespace ricci::testing
