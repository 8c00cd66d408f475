// SPDX-License-Identifier: GPL-3.0-or-later
#include "map_check.h"

#include "complex.h"
#include "shapes.h"

#include <ricci/base/points.h>
#include <ricci/measure/distortion.h>
#include <ricci/mesh/triangulation.h>

#include <cmath>

namespace ricci::testing {

namespace {

/// Rounding of a place in the plane, relative to the size of the map.
constexpr double kPlaceRounding = 1e-15;

/// The refinement as glued triangles with their places in the plane.
struct Glued
{
	Triangulation t;
	HalfedgeArray<Complex> place; // of its origin, in its triangle
	HalfedgeArray<double> angle;  // at its origin

	explicit Glued(const FlatMesh& map) :
			t(map.source.size(), map.vertices.values()), place(t.halfedgeCount()),
			angle(t.halfedgeCount(), 0.0)
	{
		for (const Face f : t.faces()) {
			const auto h = t.halfedges(f);
			std::array<Complex, 3> p;
			for (std::size_t k = 0; k < 3; ++k)
				place[h[k]] = p[k] = asComplex(map.at(f.number())[k]);
			for (std::size_t k = 0; k < 3; ++k)
				angle[h[k]] = std::abs(std::arg((p[(k + 2) % 3] - p[k]) / (p[(k + 1) % 3] - p[k])));
		}
	}
	double length(Halfedge h) const { return std::abs(place[t.next(h)] - place[h]); }
};

/// Least height of a triangle that has hardly any area.
double heightOf(const Triangle2& p)
{
	const Complex a = asComplex(p[1]) - asComplex(p[0]), b = asComplex(p[2]) - asComplex(p[0]);
	const double longest = std::max({std::abs(a), std::abs(b), std::abs(a - b)});
	return longest > 0.0 ? std::abs((std::conj(a) * b).imag()) / longest : 0.0;
}

/// Vertices of the input with a share in point p.
std::vector<int> support(const SurfacePoint& p)
{
	std::vector<int> vertices;
	for (std::size_t i = 0; i < 4; ++i)
		if (p.weight[i] != 0.0)
			vertices.push_back(p.vertex[i]);
	return vertices;
}

} // namespace

MapCheck::MapCheck(
	const SurfaceMesh& mesh, const FlatMesh& map, const std::vector<double>& curvature)
{
	std::vector<Point3> space;
	for (const SurfacePoint& p : map.source) {
		space.push_back(placeOnSurface(p, mesh.positions));
		double sum = 0.0;
		for (double w : p.weight)
			sum += w;
		weightError = std::max(weightError, std::abs(sum - 1.0));
	}
	double extent = 0.0;
	for (const Point2& p : map.place)
		extent = std::max({extent, std::abs(p[0]), std::abs(p[1])});
	std::vector<double> areas(mesh.triangles.size(), 0.0);
	for (const int f : map.points.indices()) {
		const Triangle& t = map.vertices[f];
		const Triangle& face = mesh.triangles[at(map.face[f])];
		areas[at(map.face[f])] += triangleArea({space[at(t[0])], space[at(t[1])], space[at(t[2])]});
		for (int point : t) {
			const SurfacePoint& p = map.source[point];
			for (int v : support(p)) {
				const bool inFace = std::find(face.begin(), face.end(), v) != face.end();
				minWeight = std::min(minWeight, inFace ? weightOf(p, Vertex(v)) : -1.0);
			}
		}
		const Triangle2 p = map.at(f);
		if (orientation(p[0], p[1], p[2]) > 0)
			continue;
		++notPositive;
		notPositiveByRounding += heightOf(p) <= kPlaceRounding * extent;
	}
	for (std::size_t f = 0; f < areas.size(); ++f) {
		const Triangle& t = mesh.triangles[f];
		const double own = triangleArea(
			{mesh.positions[at(t[0])], mesh.positions[at(t[1])], mesh.positions[at(t[2])]});
		areaError = std::max(areaError, std::abs(areas[f] / own - 1.0));
	}

	const Glued glued(map);
	const Triangulation& t = glued.t;
	eulerCharacteristic = t.eulerCharacteristic();
	boundaryLoops = static_cast<int>(t.boundaryLoops().size());
	const VertexArray<char> boundary = t.boundaryVertices();
	VertexArray<double> defect(map.source.size(), 2 * kPi);
	for (const Halfedge h : t.interiorHalfedges()) {
		defect[t.origin(h)] -= glued.angle[h];
		area += 0.5 * (std::conj(glued.place[h]) * glued.place[t.next(h)]).imag();
	}
	for (const Vertex v : t.vertices())
		if (!boundary[v])
			angleError = std::max(
				angleError,
				std::abs(defect[v] - (at(v) < curvature.size() ? curvature[at(v)] : 0.0)));
	for (const Edge e : t.edges()) {
		if (t.isBoundary(e))
			continue;
		const Halfedge h = e.halfedge(), g = h.twin();
		if (glued.place[h] == glued.place[t.next(g)] && glued.place[t.next(h)] == glued.place[g])
			continue;
		++seamEdges;
		const double gap = std::abs(glued.length(h) - glued.length(g));
		seamMismatch = std::max(seamMismatch, (gap - kPlaceRounding * extent) / glued.length(h));
		std::vector<int> ends = support(map.source[t.origin(h).number()]);
		for (int v : support(map.source[t.target(h).number()]))
			if (std::find(ends.begin(), ends.end(), v) == ends.end())
				ends.push_back(v);
		seamsInside += ends.size() != 2;
	}
}

std::vector<StraightLine>
straightLines(const SurfaceMesh& mesh, const FlatMesh& map, double angleTolerance)
{
	const Glued glued(map);
	const Triangulation& t = glued.t;
	const int vertexCount = static_cast<int>(mesh.positions.size());
	const VertexArray<char> boundary = t.boundaryVertices();
	/// The halfedge that leaves the end of h most nearly straight on, none if there is none.
	const auto straightOn = [&](Halfedge h) {
		if (boundary[t.target(h)])
			return Halfedge();
		Halfedge best;
		double least = angleTolerance, turned = 0.0;
		Halfedge g = t.next(h);
		do {
			turned += glued.angle[g];
			if (std::abs(turned - kPi) < least) {
				least = std::abs(turned - kPi);
				best = g;
			}
			g = t.next(g.twin());
		} while (g != t.next(h));
		return best;
	};
	std::vector<Point3> space;
	for (const SurfacePoint& p : map.source)
		space.push_back(placeOnSurface(p, mesh.positions));
	std::vector<StraightLine> lines;
	for (const Halfedge start : t.interiorHalfedges()) {
		const int first = t.origin(start).number();
		if (first >= vertexCount)
			continue;
		StraightLine line{first, -1, 0.0, {first}, {0.0}, {0.0}};
		for (Halfedge h = start; h.isValid() && at(t.edgeCount()) > line.points.size();
			 h = straightOn(h)) {
			const int last = t.target(h).number();
			line.length += glued.length(h);
			line.points.push_back(last);
			line.inPlane.push_back(line.length);
			line.inSpace.push_back(
				line.inSpace.back() + distance(space[at(t.origin(h))], space[at(t.target(h))]));
			if (last < vertexCount) {
				line.to = last;
				lines.push_back(line);
				break;
			}
		}
	}
	return lines;
}

} // namespace ricci::testing
