// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/error.h>
#include <ricci/surface/component.h>
#include <ricci/surface/triangulation.h>

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace ricci::testing {
namespace {

/// The sentence with which a mesh is refused; empty if it is accepted.
std::string refusal(const SurfaceMesh& mesh)
{
	std::vector<std::string> notes;
	try {
		requireAreaEverywhere(splitIntoComponents(mesh, notes));
	}
	catch (const InvalidMesh& error) {
		return error.what();
	}
	return {};
}

void expectRefusal(
	const SurfaceMesh& mesh, const std::string& countedFault, const std::string& remedy)
{
	const std::string sentence = refusal(mesh);
	EXPECT_EQ(sentence.rfind(countedFault, 0), 0u) << "got: " << sentence;
	EXPECT_NE(sentence.find(remedy), std::string::npos) << "got: " << sentence;
	EXPECT_EQ(sentence.back(), '.');
}

Triangle reversed(const Triangle& t)
{
	return {t[0], t[2], t[1]};
}

TEST(Component, AcceptsWhatTheFlowCanUse)
{
	for (const SurfaceMesh& mesh : {tetrahedron(), rectangle(2, 3, 1, 1), perforatedSlab(2, 1)}) {
		std::vector<std::string> notes;
		const auto components = splitIntoComponents(mesh, notes);
		ASSERT_EQ(components.size(), 1u);
		EXPECT_TRUE(notes.empty());
		EXPECT_EQ(components[0].triangles.size(), mesh.triangles.size());
		EXPECT_EQ(components[0].positions.size(), mesh.positions.size());
	}
}

TEST(Component, RefusesAnEmptyMesh)
{
	expectRefusal({}, "The mesh is empty", "open or create a triangle mesh");
}

TEST(Component, RefusesAPointCloud)
{
	expectRefusal({{{0, 0, 0}}, {}}, "The mesh has 1 vertex but no faces", "reconstruct a surface");
	expectRefusal(
		{{{0, 0, 0}, {1, 0, 0}}, {}},
		"The mesh has 2 vertices but no faces",
		"reconstruct a surface");
}

TEST(Component, RefusesCoordinatesThatAreNotFinite)
{
	SurfaceMesh mesh = tetrahedron();
	mesh.positions[1][2] = std::numeric_limits<double>::quiet_NaN();
	expectRefusal(mesh, "1 vertex has coordinates that are not finite", "delete");
	mesh.positions[3] = {std::numeric_limits<double>::infinity(), 0.0, 0.0};
	expectRefusal(mesh, "2 vertices have coordinates that are not finite", "delete");
}

TEST(Component, RefusesFacesThatUseAVertexTwice)
{
	SurfaceMesh mesh = rectangle(1, 1, 1, 1);
	mesh.triangles.push_back({0, 1, 1});
	expectRefusal(mesh, "1 face uses the same vertex twice", "Remove Zero Area Faces");
	mesh.triangles.push_back({2, 2, 2});
	expectRefusal(mesh, "2 faces use the same vertex twice", "Remove Zero Area Faces");
}

TEST(Component, RefusesDuplicateFaces)
{
	const SurfaceMesh original = rectangle(2, 2, 1, 1);
	SurfaceMesh mesh = original;
	const Triangle t = mesh.triangles[3];
	mesh.triangles.push_back({t[1], t[2], t[0]});
	expectRefusal(mesh, "1 face is a duplicate", "Remove Duplicate Faces");
	mesh.triangles.push_back(reversed(mesh.triangles[0]));
	expectRefusal(mesh, "2 faces are a duplicate", "Remove Duplicate Faces");
}

TEST(Component, RefusesNonManifoldEdges)
{
	// Fins on inner edges of a rectangle.
	SurfaceMesh mesh = rectangle(2, 2, 1, 1);
	mesh.positions.push_back({0.3, 0.3, 1.0});
	mesh.triangles.push_back({mesh.triangles[0][0], mesh.triangles[0][2], 9});
	expectRefusal(mesh, "1 non-manifold edge ", "Repair non Manifold Edges");
	mesh.positions.push_back({0.7, 0.7, 1.0});
	mesh.triangles.push_back({mesh.triangles[6][0], mesh.triangles[6][2], 10});
	expectRefusal(mesh, "2 non-manifold edges ", "Repair non Manifold Edges");
}

TEST(Component, RefusesNonManifoldVertices)
{
	SurfaceMesh bowTie;
	for (int i = 0; i < 5; ++i)
		bowTie.positions.push_back({double(i % 3), double(i / 3), double(i * i)});
	bowTie.triangles = {{0, 1, 2}, {0, 3, 4}};
	expectRefusal(bowTie, "1 non-manifold vertex ", "Repair non Manifold Vertices");
	bowTie.positions.push_back({7, 8, 9});
	bowTie.positions.push_back({9, 8, 9});
	bowTie.triangles.push_back({4, 5, 6});
	expectRefusal(bowTie, "2 non-manifold vertices ", "Repair non Manifold Vertices");
	// Two closed surfaces that touch in one vertex.
	SurfaceMesh kiss = sideBySide(tetrahedron(), tetrahedron(), 4.0);
	for (Triangle& t : kiss.triangles)
		for (int& v : t)
			v = v == 7 ? 0 : v;
	expectRefusal(kiss, "1 non-manifold vertex ", "Repair non Manifold Vertices");
}

TEST(Component, RefusesOneSidedSurfaces)
{
	const SurfaceMesh band = moebiusBand(9);
	expectRefusal(band, "1 component is not orientable", "cut the mesh");
	expectRefusal(sideBySide(band, band, 10), "2 components are not orientable", "cut the mesh");
	expectRefusal(
		sideBySide(tetrahedron(), band, 10), "1 component is not orientable", "cut the mesh");
}

TEST(Component, RefusesEdgesWithoutLength)
{
	SurfaceMesh inside = rectangle(3, 3, 1, 1);
	inside.positions[5] = inside.positions[6];
	expectRefusal(inside, "1 edge has no length", "Merge Close Vertices");
	inside.positions[10] = inside.positions[6];
	expectRefusal(inside, "3 edges have no length", "Merge Close Vertices");
}

TEST(Component, CountsBoundaryEdgesWithoutLengthInEitherDirection)
{
	SurfaceMesh mesh = rectangle(1, 1, 1, 1);
	mesh.positions[2] = mesh.positions[0]; // edge 0-2 runs upwards in its face
	expectRefusal(mesh, "1 edge has no length", "Merge Close Vertices");
	mesh = rectangle(1, 1, 1, 1);
	mesh.positions[1] = mesh.positions[0]; // edge 1-0 runs downwards in its face
	expectRefusal(mesh, "1 edge has no length", "Merge Close Vertices");
}

TEST(Component, RefusesFacesWithoutArea)
{
	SurfaceMesh mesh = {
		{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}}, {{0, 1, 3}, {1, 2, 3}, {0, 2, 1}}};
	expectRefusal(mesh, "1 face has no area", "Remove T-Vertices");
	for (Point3& p : mesh.positions)
		p[1] = 0.0;
	mesh.positions[3][0] = 0.5;
	expectRefusal(mesh, "1 component has no area at all", "delete such pieces");
}

TEST(Component, SplittingLeavesDegenerateFacesToTheCaller)
{
	const SurfaceMesh mesh{
		{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}}, {{0, 1, 3}, {1, 2, 3}, {0, 2, 1}}};
	std::vector<std::string> notes;
	EXPECT_EQ(splitIntoComponents(mesh, notes).size(), 1u);
}

TEST(Component, RefusesComponentsWithoutExtent)
{
	SurfaceMesh mesh = sideBySide(tetrahedron(), tetrahedron(), 5);
	for (std::size_t v = 4; v < 8; ++v)
		mesh.positions[v] = {1, 2, 3};
	expectRefusal(mesh, "1 component has no area at all", "delete such pieces");
}

TEST(Component, OrientsTheMinorityLikeTheMajorityAndTellsIt)
{
	Random random(3);
	const SurfaceMesh original = perforatedSlab(1, 2);
	SurfaceMesh mixed = original;
	std::size_t turned = 0;
	std::vector<char> isTurned(mixed.triangles.size(), 0);
	for (std::size_t f = 0; f < mixed.triangles.size(); ++f)
		if (random.real(0, 1) < 0.3) {
			mixed.triangles[f] = reversed(mixed.triangles[f]);
			isTurned[f] = 1;
			++turned;
		}
	std::vector<std::string> notes;
	const auto components = splitIntoComponents(mixed, notes);
	ASSERT_EQ(components.size(), 1u);
	const Component& c = components[0];
	EXPECT_EQ(c.reversed, isTurned);
	EXPECT_NO_THROW(Triangulation(static_cast<int>(c.positions.size()), c.triangles));
	for (std::size_t f = 0; f < c.triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k)
			EXPECT_EQ(
				c.vertex[at(c.triangles[f][k])],
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
	const auto components = splitIntoComponents(mesh, notes);
	ASSERT_EQ(components.size(), 1u);
	EXPECT_EQ(components[0].positions.size(), 4u);
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
	const auto components = splitIntoComponents(mesh, notes);
	ASSERT_EQ(components.size(), 2u);
	EXPECT_TRUE(notes.empty());
	EXPECT_EQ(components[0].face.front(), 0);
	EXPECT_LT(components[0].face.front(), components[1].face.front());
	std::vector<char> seen(mesh.triangles.size(), 0);
	for (const Component& c : components) {
		const bool tetra = c.triangles.size() == 4;
		EXPECT_TRUE(tetra || c.triangles.size() == 8);
		for (std::size_t f = 0; f < c.face.size(); ++f) {
			++seen[at(c.face[f])];
			for (std::size_t k = 0; k < 3; ++k) {
				EXPECT_EQ(c.vertex[at(c.triangles[f][k])], mesh.triangles[at(c.face[f])][k]);
				EXPECT_EQ(c.positions[at(c.triangles[f][k])][0] > 4.0, !tetra);
			}
		}
	}
	EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(seen.size()));
}

TEST(Component, RefusesSizesWhoseProductsAreNoNumbers)
{
	SurfaceMesh mesh = tetrahedron();
	mesh.positions[2][1] = -2e50;
	expectRefusal(mesh, "1 vertex has coordinates beyond 1e50", "Scale, Normalize");
	for (double size : {3.4e38, 1e-38}) { // what single precision has
		mesh = tetrahedron();
		for (Point3& p : mesh.positions)
			for (double& x : p)
				x *= size;
		EXPECT_EQ(refusal(mesh), "") << size;
	}
	for (Point3& p : mesh.positions)
		for (double& x : p)
			x *= 1e-20;
	expectRefusal(mesh, "1 component is smaller than 1e-50", "Scale, Normalize");
}

} // namespace
} // namespace ricci::testing
