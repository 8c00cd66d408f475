// SPDX-License-Identifier: GPL-3.0-or-later
// What several test programs expect.
#ifndef RICCI_TESTS_EXPECT_H
#define RICCI_TESTS_EXPECT_H

#include "map_check.h"
#include "shapes.h"

#include <ricci/error.h>
#include <ricci/layout/planar_layout.h>
#include <ricci/report.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ricci::testing {

/// The error \p E with which a call ends; none if it ends without one.
template<class E, class Call>
std::optional<E> errorOf(const Call& call)
{
	try {
		call();
	}
	catch (const E& error) {
		return error;
	}
	catch (const Error& error) {
		ADD_FAILURE() << "another kind of error: " << error.what();
	}
	return std::nullopt;
}

/// The same of a call that has to end with one: the test fails if it does not.
template<class E, class Call>
E refusalOf(const Call& call)
{
	return errorOf<E>(call).value();
}

inline void expectWords(const std::string& sentence, const std::vector<std::string>& words)
{
	for (const std::string& word : words)
		EXPECT_NE(sentence.find(word), std::string::npos) << word << " is not in: " << sentence;
}

/// The number after \p words, which have to be there.
inline double numberAfter(const std::string& text, const std::string& words)
{
	const std::size_t place = text.find(words);
	if (place == std::string::npos) {
		ADD_FAILURE() << words << " is not in: " << text;
		return 0.0;
	}
	return std::stod(text.substr(place + words.size()));
}

/// refusalOf() for \p problem, with \p words in its sentence.
template<class E, class Call>
E refusalFor(typename E::Problem problem, const std::vector<std::string>& words, const Call& call)
{
	const E refused = refusalOf<E>(call);
	EXPECT_EQ(refused.problem, problem);
	expectWords(refused.what(), words);
	return refused;
}

/// A refinement is one of a surface of this kind, its seams fit, and no triangle is flipped.
/// \param curvatureError radians, of the metric: an angle moves what is up to ten thousand edges away
inline void expectSurface(const MapCheck& check, int chi, int loops, double curvatureError = 0.0)
{
	EXPECT_EQ(check.notPositive, 0);
	EXPECT_LT(check.seamMismatch, std::max(1e-9, 1e4 * curvatureError));
	EXPECT_GE(check.minWeight, -1e-12);
	EXPECT_LT(check.weightError, 1e-14);
	EXPECT_EQ(check.seamsInside, 0);
	EXPECT_EQ(check.eulerCharacteristic, chi);
	EXPECT_EQ(check.boundaryLoops, loops);
}

/// The surface cut open is connected and has Euler characteristic 1: a disk, with every marked vertex on its
/// boundary. Boundary edges are not cuts.
inline void expectDiskThroughMarks(
	const Triangulation& t, const EdgeArray<char>& isCut, const VertexArray<char>& marked)
{
	ASSERT_EQ(isCut.size(), t.edgeCount());
	FaceArray<char> seen(t.faceCount(), 0);
	std::vector<Face> queue{Face(0)};
	seen[Face(0)] = 1;
	for (std::size_t head = 0; head < queue.size(); ++head)
		for (const Halfedge h : t.halfedges(queue[head])) {
			const Halfedge g = h.twin();
			if (isCut[h.edge()] || t.isExterior(g) || seen[t.face(g)])
				continue;
			seen[t.face(g)] = 1;
			queue.push_back(t.face(g));
		}
	EXPECT_EQ(static_cast<int>(queue.size()), t.faceCount());
	int cutEdges = 0;
	VertexArray<char> onCut = t.boundaryVertices();
	for (const Edge e : t.edges())
		if (isCut[e]) {
			++cutEdges;
			EXPECT_FALSE(t.isBoundary(e));
			for (const Vertex v : t.ends(e))
				onCut[v] = 1;
		}
	for (const Vertex v : t.vertices())
		EXPECT_TRUE(!marked[v] || onCut[v]) << "vertex " << v.number();
	EXPECT_EQ(cornerWedges(t, isCut).points.size() - (t.edgeCount() + cutEdges) + t.faceCount(), 1);
}

inline double lengthOf(const EdgeArray<char>& isCut, const EdgeArray<double>& lengths)
{
	double sum = 0.0;
	for (const Edge e : lengths.indices())
		sum += isCut[e] ? lengths[e] : 0.0;
	return sum;
}

/// Length of the side of a triangle from corner \p k.
inline double sideLength(const Triangle2& t, std::size_t k)
{
	return distance(t[k], t[(k + 1) % 3]);
}
inline double sideLength(const SurfaceMesh& mesh, std::size_t face, std::size_t k)
{
	const Triangle& t = mesh.triangles[face];
	return distance(mesh.positions[at(t[k])], mesh.positions[at(t[(k + 1) % 3])]);
}

/// The map \p uv draws every triangle congruent to itself, to what floats of the coordinates' size can.
inline void
expectIsometric(const SurfaceMesh& mesh, const std::vector<Triangle2>& uv, const Report& report)
{
	ASSERT_EQ(uv.size(), mesh.triangles.size());
	double extent = 0.0;
	for (const Triangle2& t : uv)
		for (const Point2& p : t)
			extent = std::max({extent, std::abs(p[0]), std::abs(p[1])});
	for (std::size_t f = 0; f < uv.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k)
			EXPECT_NEAR(sideLength(uv[f], k), sideLength(mesh, f, k), 1e-6 * extent);
	EXPECT_NEAR(report.qcMax, 1.0, 1e-4);
	EXPECT_NEAR(report.areaDistortionMean, 1.0, 1e-5);
	EXPECT_EQ(report.flippedFaces + report.flippedByRounding, 0);
}

} // namespace ricci::testing

#endif
