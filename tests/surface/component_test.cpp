// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/intrinsic.h"
#include "support/random.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/error.h>
#include <ricci/surface/component.h>
#include <ricci/surface/triangulation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace ricci::testing {
namespace {

/// \throw InvalidMesh if the flow on the own triangles of the mesh cannot use it
void requireUsable(const SurfaceMesh& mesh)
{
	requireAreaEverywhere(componentsOf(mesh));
}

/// \p words: how the error states it.
void expectRefusal(
	const SurfaceMesh& mesh,
	InvalidMesh::Problem problem,
	std::size_t count,
	const std::string& words)
{
	const auto error = refusalOf<InvalidMesh>([&] { requireUsable(mesh); });
	EXPECT_EQ(error.problem, problem) << error.what();
	EXPECT_EQ(error.count, count) << error.what();
	EXPECT_EQ(std::string(error.what()).rfind(words, 0), 0u) << "got: " << error.what();
}

Triangle reversed(const Triangle& t)
{
	return {t[0], t[2], t[1]};
}

TEST(Component, AcceptsWhatTheFlowCanUse)
{
	for (const SurfaceMesh& mesh : {tetrahedron(), rectangle(2, 3, 1, 1), perforatedSlab(2, 1)}) {
		std::vector<std::string> notes;
		const auto components = splitIntoComponents(openMesh(mesh, notes));
		ASSERT_EQ(components.size(), 1u);
		EXPECT_TRUE(notes.empty());
		EXPECT_EQ(components[0].triangles.size(), mesh.triangles.size());
		EXPECT_EQ(components[0].positions.values().size(), mesh.positions.size());
	}
}

TEST(Component, RefusesAMeshWithoutFaces)
{
	expectRefusal({}, InvalidMesh::Empty, 0, "The mesh is empty");
	expectRefusal({{{0, 0, 0}}, {}}, InvalidMesh::NoFaces, 1, "The mesh has 1 vertex but no faces");
	expectRefusal(
		{{{0, 0, 0}, {1, 0, 0}}, {}},
		InvalidMesh::NoFaces,
		2,
		"The mesh has 2 vertices but no faces");
}

TEST(Component, RefusesCoordinatesThatAreNotFinite)
{
	SurfaceMesh mesh = tetrahedron();
	mesh.positions[1][2] = std::numeric_limits<double>::quiet_NaN();
	expectRefusal(mesh, InvalidMesh::NotFinite, 1, "1 vertex has coordinates that are not finite");
	mesh.positions[3] = {std::numeric_limits<double>::infinity(), 0.0, 0.0};
	expectRefusal(
		mesh, InvalidMesh::NotFinite, 2, "2 vertices have coordinates that are not finite");
}

TEST(Component, RefusesEdgesWithoutLength)
{
	SurfaceMesh inside = rectangle(3, 3, 1, 1);
	inside.positions[5] = inside.positions[6];
	expectRefusal(inside, InvalidMesh::EdgesWithoutLength, 1, "1 edge has no length");
	inside.positions[10] = inside.positions[6];
	expectRefusal(inside, InvalidMesh::EdgesWithoutLength, 3, "3 edges have no length");
}

TEST(Component, CountsBoundaryEdgesWithoutLengthInEitherDirection)
{
	SurfaceMesh mesh = rectangle(1, 1, 1, 1);
	mesh.positions[2] = mesh.positions[0]; // edge 0-2 runs upwards in its face
	expectRefusal(mesh, InvalidMesh::EdgesWithoutLength, 1, "1 edge has no length");
	mesh = rectangle(1, 1, 1, 1);
	mesh.positions[1] = mesh.positions[0]; // edge 1-0 runs downwards in its face
	expectRefusal(mesh, InvalidMesh::EdgesWithoutLength, 1, "1 edge has no length");
}

TEST(Component, RefusesFacesWithoutArea)
{
	SurfaceMesh mesh = {
		{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}}, {{0, 1, 3}, {1, 2, 3}, {0, 2, 1}}};
	expectRefusal(mesh, InvalidMesh::FacesWithoutArea, 1, "1 face has no area");
	for (Point3& p : mesh.positions)
		p[1] = 0.0;
	mesh.positions[3][0] = 0.5;
	expectRefusal(mesh, InvalidMesh::NoArea, 3, "The mesh has 3 faces but no area");
}

TEST(Component, SplittingLeavesDegenerateFacesToTheCaller)
{
	const SurfaceMesh mesh{
		{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}}, {{0, 1, 3}, {1, 2, 3}, {0, 2, 1}}};
	EXPECT_EQ(componentsOf(mesh).size(), 1u);
}

TEST(Component, OrientsTheMinorityLikeTheMajorityAndTellsIt)
{
	Random random(3);
	const SurfaceMesh original = perforatedSlab(1, 2);
	SurfaceMesh mixed = original;
	std::size_t turned = 0;
	FaceArray<char> isTurned(mixed.triangles.size(), 0);
	for (std::size_t f = 0; f < mixed.triangles.size(); ++f)
		if (random.real(0, 1) < 0.3) {
			mixed.triangles[f] = reversed(mixed.triangles[f]);
			isTurned[Face(f)] = 1;
			++turned;
		}
	std::vector<std::string> notes;
	const auto components = splitIntoComponents(openMesh(mixed, notes));
	ASSERT_EQ(components.size(), 1u);
	const Component& c = components[0];
	for (const Face f : c.face.indices())
		EXPECT_EQ(c.reversed[f], isTurned[Face(c.face[f])]);
	EXPECT_NO_THROW(Triangulation(c.positions.size(), c.triangles));
	ASSERT_EQ(c.face.size(), static_cast<int>(c.triangles.size()));
	for (const Face f : c.face.indices())
		for (std::size_t k = 0; k < 3; ++k)
			EXPECT_EQ(
				c.vertex[Vertex(c.triangles[at(f)][k])],
				mixed.triangles[at(c.face[f])][c.inputCorner(f, k)]);
	ASSERT_EQ(notes.size(), 1u);
	EXPECT_EQ(notes[0].rfind(std::to_string(turned) + " faces were oriented against", 0), 0u)
		<< notes[0];
}

TEST(Component, LeavesOutUnreferencedVerticesAndTellsIt)
{
	SurfaceMesh mesh = tetrahedron();
	mesh.positions.insert(mesh.positions.begin(), {9, 9, 9});
	for (Triangle& t : mesh.triangles)
		for (int& v : t)
			++v;
	mesh.positions.push_back({8, 8, 8});
	std::vector<std::string> notes;
	const auto components = splitIntoComponents(openMesh(mesh, notes));
	ASSERT_EQ(components.size(), 1u);
	EXPECT_EQ(components[0].positions.size(), 4);
	for (int v : components[0].vertex)
		EXPECT_TRUE(v >= 1 && v <= 4);
	ASSERT_EQ(notes.size(), 1u);
	EXPECT_EQ(notes[0].rfind("2 vertices belong to no face", 0), 0u) << notes[0];
}

TEST(Component, SeparatesComponentsInTheOrderOfTheirLowestFace)
{
	const SurfaceMesh both = sideBySide(tetrahedron(), rectangle(2, 2, 1, 1), 5);
	SurfaceMesh mesh = both;
	Random random(4);
	std::vector<int> order(mesh.triangles.size());
	for (std::size_t f = 0; f < order.size(); ++f)
		order[f] = static_cast<int>(f);
	random.shuffle(order);
	for (std::size_t f = 0; f < order.size(); ++f)
		mesh.triangles[f] = both.triangles[at(order[f])];
	std::vector<std::string> notes;
	const auto components = splitIntoComponents(openMesh(mesh, notes));
	ASSERT_EQ(components.size(), 2u);
	EXPECT_TRUE(notes.empty());
	EXPECT_EQ(components[0].face.front(), 0);
	EXPECT_LT(components[0].face.front(), components[1].face.front());
	std::vector<char> seen(mesh.triangles.size(), 0);
	for (const Component& c : components) {
		const bool tetra = c.triangles.size() == 4;
		EXPECT_TRUE(tetra || c.triangles.size() == 8);
		ASSERT_EQ(c.face.size(), static_cast<int>(c.triangles.size()));
		for (const Face f : c.face.indices()) {
			++seen[at(c.face[f])];
			for (std::size_t k = 0; k < 3; ++k) {
				EXPECT_EQ(
					c.vertex[Vertex(c.triangles[at(f)][k])], mesh.triangles[at(c.face[f])][k]);
				EXPECT_EQ(c.positions[Vertex(c.triangles[at(f)][k])][0] > 4.0, !tetra);
			}
		}
	}
	EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(seen.size()));
}

TEST(Component, RefusesSizesWhoseProductsAreNoNumbers)
{
	SurfaceMesh mesh = tetrahedron();
	mesh.positions[2][1] = -2e50;
	expectRefusal(mesh, InvalidMesh::OutOfRange, 1, "1 vertex has coordinates beyond 1e50");
	for (double size : {3.4e38, 1e-38}) { // what single precision has
		mesh = scaled(tetrahedron(), size);
		EXPECT_NO_THROW(requireUsable(mesh)) << size;
	}
	expectRefusal(
		scaled(mesh, 1e-20), InvalidMesh::TooSmall, 1, "1 component is smaller than 1e-50");
}

} // namespace
} // namespace ricci::testing
