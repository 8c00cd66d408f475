// SPDX-License-Identifier: GPL-3.0-or-later
#include "input_numbers.h"

#include "../math/adjacency.h"
#include "../measure/distortion.h"

#include <algorithm>
#include <utility>

namespace ricci {

namespace {

/// Means over the copies of each vertex of the input, weighted by the area of their faces.
class VertexMeans
{
public:
	VertexMeans(const OpenedMesh& opened, std::size_t vertexCount) :
			m_opened(opened), m_vertexCount(vertexCount), m_area(opened.vertex.size(), 0.0)
	{
		for (const Triangle& t : opened.mesh.triangles) {
			const double area = triangleArea(
				{opened.mesh.positions[positionOf(t[0])],
				 opened.mesh.positions[positionOf(t[1])],
				 opened.mesh.positions[positionOf(t[2])]});
			for (const int v : t)
				m_area[positionOf(v)] += area;
		}
	}

	/// \param values [vertex of the opened mesh, and more that are kept as they are]
	void operator()(std::vector<double>& values) const
	{
		std::vector<double> sum(m_vertexCount, 0.0), area(m_vertexCount, 0.0);
		for (std::size_t c = 0; c < m_area.size(); ++c) {
			const std::size_t v = positionOf(m_opened.vertex[c]);
			sum[v] += m_area[c] * values[c];
			area[v] += m_area[c];
		}
		for (std::size_t v = 0; v < m_vertexCount; ++v)
			if (area[v] > 0.0)
				values[v] = sum[v] / area[v];
		values.erase(
			values.begin() + static_cast<std::ptrdiff_t>(m_vertexCount),
			values.begin() + static_cast<std::ptrdiff_t>(m_area.size()));
	}

private:
	const OpenedMesh& m_opened;
	std::size_t m_vertexCount;
	std::vector<double> m_area; // [vertex of the opened mesh]
};

/// Where degenerate faces are drawn.
class DegenerateFaces
{
public:
	DegenerateFaces(
		const SurfaceMesh& mesh, const OpenedMesh& opened, const std::vector<Triangle2>& uv) :
			m_mesh(mesh),
			m_opened(opened), m_uv(uv),
			m_corners(static_cast<int>(mesh.positions.size()), [&](const auto& add) {
				for (std::size_t f = 0; f < opened.face.size(); ++f)
					for (int k = 0; k < 3; ++k)
						add(vertexAt(static_cast<int>(f), k), 3 * static_cast<int>(f) + k);
			})
	{
	}

	Triangle2 draw(int face) const
	{
		const Triangle& t = m_mesh.triangles[positionOf(face)];
		for (std::size_t k = 0; k < 3; ++k)
			for (const int corner : m_corners[t[k]])
				for (int j = 0; j < 3; ++j)
					if (t[(k + 1) % 3] != t[k] && vertexAt(corner / 3, j) == t[(k + 1) % 3]) {
						const Point2 p = pointAt(corner), q = pointAt(3 * (corner / 3) + j);
						Triangle2 line;
						line[k] = p;
						line[(k + 1) % 3] = q;
						line[(k + 2) % 3] = t[(k + 2) % 3] == t[k] ? p : q;
						return line;
					}
		for (const int v : t)
			for (const int corner : m_corners[v])
				return {pointAt(corner), pointAt(corner), pointAt(corner)};
		return {Point2{0.0, 0.0}, Point2{0.0, 0.0}, Point2{0.0, 0.0}};
	}

private:
	int vertexAt(int openedFace, int k) const
	{
		return m_opened
			.vertex[positionOf(m_opened.mesh.triangles[positionOf(openedFace)][positionOf(k)])];
	}
	Point2 pointAt(int corner) const
	{
		return m_uv[positionOf(corner / 3)][positionOf(corner % 3)];
	}

	const SurfaceMesh& m_mesh;
	const OpenedMesh& m_opened;
	const std::vector<Triangle2>& m_uv;
	Adjacency<int, int> m_corners; // [vertex of the input]
};

/// [face of the opened mesh] -> [face of the input]
template<class T>
void spread(const OpenedMesh& opened, std::size_t faceCount, T rest, std::vector<T>& values)
{
	std::vector<T> spread(faceCount, rest);
	for (std::size_t f = 0; f < values.size(); ++f)
		spread[positionOf(opened.face[f])] = values[f];
	values = std::move(spread);
}

void renumberRefinement(
	const OpenedMesh& opened,
	std::size_t vertexCount,
	const VertexMeans& means,
	RefinedMesh& refined)
{
	const std::size_t copies = opened.vertex.size() - vertexCount;
	for (Triangle& t : refined.triangles)
		for (int& p : t)
			p = positionOf(p) < opened.vertex.size() ? opened.vertex[positionOf(p)]
													 : p - static_cast<int>(copies);
	const auto first = refined.points.begin() + static_cast<std::ptrdiff_t>(vertexCount);
	refined.points.erase(first, first + static_cast<std::ptrdiff_t>(copies));
	for (SurfacePoint& p : refined.points)
		for (int& v : p.vertex)
			v = opened.vertex[positionOf(v)];
	for (int& f : refined.inputFace)
		f = opened.face[positionOf(f)];
	means(refined.vertexQC);
}

} // namespace

void toInputNumbers(const SurfaceMesh& mesh, Parametrization& map)
{
	const OpenedMesh& opened = map.opened;
	if (opened.isAsGiven())
		return;
	const std::size_t vertexCount = mesh.positions.size(), faceCount = mesh.triangles.size();
	const VertexMeans means(opened, vertexCount);
	const bool isRefined = map.isRefined();
	const DegenerateFaces lines(mesh, opened, map.uv);
	std::vector<Triangle2> drawn;
	for (const int f : opened.degenerate)
		drawn.push_back(lines.draw(f));
	means(map.vertexQC);
	map.u.resize(vertexCount);
	map.targetCurvature.resize(vertexCount);
	if (isRefined)
		renumberRefinement(opened, vertexCount, means, map.refined);
	for (Chart& chart : map.charts)
		for (int& f : chart.faces)
			f = opened.face[positionOf(f)];
	spread(opened, faceCount, Triangle2(), map.uv);
	spread(opened, faceCount, char(0), map.reversed);
	spread(opened, faceCount, 1.0, map.faceQC);
	for (std::size_t i = 0; i < drawn.size(); ++i) {
		const int face = opened.degenerate[i];
		map.uv[positionOf(face)] = drawn[i];
		if (isRefined) {
			map.refined.triangles.push_back(mesh.triangles[positionOf(face)]);
			map.refined.uv.push_back(drawn[i]);
			map.refined.inputFace.push_back(face);
			map.refined.faceQC.push_back(1.0);
		}
	}
	map.opened = OpenedMesh();
}

} // namespace ricci
