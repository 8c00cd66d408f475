// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/graphs.h"
#include "measure/distortion.h"
#include "whole_map.h"

#include <array>
#include <cstddef>

namespace ricci {

namespace {

/// Takes the means over the copies of each vertex of the input, weighted by the area of their faces.
/// \param vertexCount of the input
/// \param values [vertex of the opened mesh, and more that are kept as they are]
void averageCopies(const OpenedMesh& opened, std::size_t vertexCount, std::vector<double>& values)
{
	std::vector<double> ofCopies(opened.vertex.size(), 0.0); // areas
	const std::vector<Triangle>& triangles = opened.mesh.triangles;
	const std::vector<double> areas =
		triangleAreas(opened.mesh.positions, triangles, opened.mesh.lengths);
	for (std::size_t f = 0; f < triangles.size(); ++f)
		for (const int v : triangles[f])
			ofCopies[positionOf(v)] += areas[f];
	std::vector<double> sum(vertexCount, 0.0), area(vertexCount, 0.0);
	for (std::size_t c = 0; c < ofCopies.size(); ++c) {
		const std::size_t v = positionOf(opened.vertex[c]);
		sum[v] += ofCopies[c] * values[c];
		area[v] += ofCopies[c];
	}
	for (std::size_t v = 0; v < vertexCount; ++v)
		if (area[v] > 0.0)
			values[v] = sum[v] / area[v];
	values.erase(
		values.begin() + static_cast<std::ptrdiff_t>(vertexCount),
		values.begin() + static_cast<std::ptrdiff_t>(ofCopies.size()));
}

/// Corners of one face of a map at whose places the corners of the degenerate face \p t lie; or none.
/// \param cornersAt [vertex of the input] of the map
std::array<Corner, 3>
cornersFor(const Triangle& t, const FlatMesh& mesh, const Adjacency<int, Corner>& cornersAt)
{
	for (std::size_t k = 0; k < 3; ++k) {
		const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
		if (t[next] == t[k])
			continue;
		for (const Corner p : cornersAt[t[k]])
			for (const Corner q : cornersAt[t[next]])
				if (mesh.face[p.face()] == mesh.face[q.face()]) {
					std::array<Corner, 3> line;
					line[k] = p;
					line[next] = q;
					line[last] = t[last] == t[k] ? p : q;
					return line;
				}
	}
	for (const int v : t)
		for (const Corner corner : cornersAt[v])
			return {corner, corner, corner};
	return {};
}

/// Lays degenerate faces out beside the triangles that a map has.
void addDegenerate(const SurfaceMesh& input, const OpenedMesh& opened, FlatMesh& mesh)
{
	const Adjacency<int, Corner> cornersAt(
		static_cast<int>(input.positions.size()), [&](const auto& add) {
			for (const int f : mesh.vertices.indices())
				for (const Corner c : cornersOf(f))
					if (const int v = mesh.vertices[c]; positionOf(v) < input.positions.size())
						add(v, c);
		});
	for (const int face : opened.degenerate) {
		const Triangle t = opened.withJoined(input.triangles[positionOf(face)]);
		const std::array<Corner, 3> corners = cornersFor(t, mesh, cornersAt);
		Triangle points{-1, -1, -1};
		for (std::size_t k = 0; k < 3; ++k) {
			if (corners[k].isValid() && mesh.vertices[corners[k]] == t[k])
				points[k] = mesh.points[corners[k]];
			for (std::size_t j = 0; j < k; ++j)
				if (t[j] == t[k])
					points[k] = points[j];
			if (points[k] >= 0)
				continue;
			points[k] = mesh.place.size();
			mesh.place.push_back(corners[k].isValid() ? mesh.at(corners[k]) : Point2{0.0, 0.0});
		}
		mesh.vertices.push_back(t);
		mesh.points.push_back(points);
		mesh.lengths.push_back(sideLengths(t, input.positions));
		mesh.face.push_back(face);
		mesh.chart.push_back(-1);
	}
}

/// Swaps two corners of the triangles of reversed faces.
void orientLikeInput(const OpenedMesh& opened, FlatMesh& mesh)
{
	for (const int f : mesh.face.indices())
		if (opened.reversed[Face(mesh.face[f])]) {
			std::swap(mesh.vertices[f][1], mesh.vertices[f][2]);
			std::swap(mesh.points[f][1], mesh.points[f][2]);
			std::swap(mesh.lengths[f][0], mesh.lengths[f][2]);
		}
}

/// Puts the triangles in the order of the faces that they are or lie in.
void sortByFace(std::size_t faceCount, FlatMesh& mesh)
{
	const Adjacency<int, int> trianglesOf(static_cast<int>(faceCount), [&](const auto& add) {
		for (const int f : mesh.face.indices())
			add(mesh.face[f], f);
	});
	const auto sort = [&](auto& ofTriangles) {
		auto sorted = ofTriangles;
		int next = 0;
		for (const int f : trianglesOf.items())
			sorted[next++] = ofTriangles[f];
		ofTriangles.swap(sorted);
	};
	sort(mesh.vertices);
	sort(mesh.points);
	sort(mesh.lengths);
	sort(mesh.chart);
	sort(mesh.face);
}

/// Gives vertices that were joined the values of the one, and each face its own vertices.
/// \pre numbers are the input's
void separateJoined(const SurfaceMesh& input, const OpenedMesh& opened, Parametrization& map)
{
	for (std::size_t v = 0; v < opened.joined.size(); ++v)
		for (std::vector<double>* values : {&map.vertexQC, &map.u, &map.targetCurvature})
			(*values)[v] = (*values)[positionOf(opened.joined[v])];
	FlatMesh& mesh = map.mesh;
	for (const Corner c : IndexRange<Corner>(opened.joined.empty() ? 0 : 3 * mesh.size())) {
		const Triangle& given = input.triangles[positionOf(mesh.face[c.face()])];
		const Triangle joined = opened.withJoined(given);
		const auto separate = [&](int& v) {
			for (const Corner own : {c, c.next(), c.previous()})
				if (joined[own.index()] == v) {
					v = given[own.index()];
					return;
				}
		};
		int& vertex = mesh.vertices[c];
		if (positionOf(vertex) < input.positions.size())
			separate(vertex);
		else // a point of the refinement, on this face or its border
			for (int& v : mesh.source[vertex].vertex)
				separate(v);
	}
}

} // namespace

void toInputIndices(const SurfaceMesh& input, const OpenedMesh& opened, Parametrization& map)
{
	FlatMesh& mesh = map.mesh;
	mesh.across.clear();
	mesh.isDiagonal.clear();
	orientLikeInput(opened, mesh);
	if (opened.isAsGiven()) {
		sortByFace(input.triangles.size(), mesh);
		separateJoined(input, opened, map);
		return;
	}
	const std::size_t vertexCount = input.positions.size();
	const std::size_t copies = opened.vertex.size() - vertexCount;
	averageCopies(opened, vertexCount, map.vertexQC);
	map.u.resize(vertexCount);
	map.targetCurvature.resize(vertexCount);
	for (int& v : map.placedCones)
		v = opened.vertex[positionOf(v)];
	for (Triangle& t : mesh.vertices)
		for (int& v : t)
			v = positionOf(v) < opened.vertex.size() ? opened.vertex[positionOf(v)]
													 : v - static_cast<int>(copies);
	std::vector<SurfacePoint>& source = mesh.source.values();
	const auto first = source.begin() + static_cast<std::ptrdiff_t>(vertexCount);
	source.erase(first, first + static_cast<std::ptrdiff_t>(copies));
	for (SurfacePoint& p : source)
		for (int& v : p.vertex)
			v = opened.vertex[positionOf(v)];
	for (int& f : mesh.face)
		f = opened.face[positionOf(f)];
	addDegenerate(input, opened, mesh);
	sortByFace(input.triangles.size(), mesh);
	separateJoined(input, opened, map);
}

} // namespace ricci
