// SPDX-License-Identifier: GPL-3.0-or-later
#include "refinement_check.h"

#include "complex.h"
#include "shapes.h"

#include <ricci/layout/distortion.h>
#include <ricci/layout/orientation.h>
#include <ricci/surface/triangulation.h>

#include <algorithm>
#include <cmath>

namespace ricci::testing {

namespace {

constexpr double kPi = 3.14159265358979323846;

/// Rounding of a place in the plane, relative to the size of the map.
constexpr double kPlaceRounding = 1e-15;

/// The refinement as glued triangles with their places in the plane.
struct Glued
{
	Triangulation t;
	std::vector<Complex> place; // [halfedge] of its origin, in its triangle
	std::vector<double> angle;  // [halfedge] at its origin

	Glued(std::size_t pointCount, const RefinedMap& map) :
			t(static_cast<int>(pointCount), map.triangles), place(at(t.halfedgeCount())),
			angle(place.size(), 0.0)
	{
		for (int f = 0; f < t.faceCount(); ++f) {
			const auto h = t.halfedges(f);
			std::array<Complex, 3> p;
			for (std::size_t k = 0; k < 3; ++k)
				place[at(h[k])] = p[k] = asComplex(map.uv[at(f)][k]);
			for (std::size_t k = 0; k < 3; ++k)
				angle[at(h[k])] =
					std::abs(std::arg((p[(k + 2) % 3] - p[k]) / (p[(k + 1) % 3] - p[k])));
		}
	}
	double length(int h) const { return std::abs(place[at(t.next(h))] - place[at(h)]); }
};

/// Least height of a triangle that has hardly any area.
double heightOf(const std::array<Point2, 3>& p)
{
	const Complex a = asComplex(p[1]) - asComplex(p[0]), b = asComplex(p[2]) - asComplex(p[0]);
	const double longest = std::max({std::abs(a), std::abs(b), std::abs(a - b)});
	return longest > 0.0 ? std::abs((std::conj(a) * b).imag()) / longest : 0.0;
}

/// Weight of vertex v in point p.
double weightOf(const SurfacePoint& p, int v)
{
	double weight = 0.0;
	for (std::size_t i = 0; i < 4; ++i)
		if (p.vertex[i] == v)
			weight += p.weight[i];
	return weight;
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

RefinementCheck::RefinementCheck(
	const SurfaceMesh& mesh, const RefinedMap& map, const std::vector<double>& curvature)
{
	std::vector<Point3> space;
	for (const SurfacePoint& p : map.points) {
		space.push_back(placeOnSurface(p, mesh.positions));
		double sum = 0.0;
		for (double w : p.weight)
			sum += w;
		weightError = std::max(weightError, std::abs(sum - 1.0));
	}
	double extent = 0.0;
	for (const auto& triangle : map.uv)
		for (const Point2& p : triangle)
			extent = std::max({extent, std::abs(p[0]), std::abs(p[1])});
	std::vector<double> areas(mesh.triangles.size(), 0.0);
	for (std::size_t f = 0; f < map.triangles.size(); ++f) {
		const Triangle& t = map.triangles[f];
		const Triangle& face = mesh.triangles[at(map.inputFace[f])];
		areas[at(map.inputFace[f])] +=
			triangleArea({space[at(t[0])], space[at(t[1])], space[at(t[2])]});
		for (int point : t) {
			const SurfacePoint& p = map.points[at(point)];
			for (int v : support(p)) {
				const bool inFace = std::find(face.begin(), face.end(), v) != face.end();
				leastWeight = std::min(leastWeight, inFace ? weightOf(p, v) : -1.0);
			}
		}
		if (orientation(map.uv[f][0], map.uv[f][1], map.uv[f][2]) > 0)
			continue;
		++notPositive;
		notPositiveByRounding += heightOf(map.uv[f]) <= kPlaceRounding * extent;
	}
	for (std::size_t f = 0; f < areas.size(); ++f) {
		const Triangle& t = mesh.triangles[f];
		const double own = triangleArea(
			{mesh.positions[at(t[0])], mesh.positions[at(t[1])], mesh.positions[at(t[2])]});
		areaError = std::max(areaError, std::abs(areas[f] / own - 1.0));
	}

	const Glued glued(map.points.size(), map);
	const Triangulation& t = glued.t;
	eulerCharacteristic = t.eulerCharacteristic();
	boundaryLoops = static_cast<int>(t.boundaryLoops().size());
	const std::vector<char> boundary = t.boundaryVertices();
	std::vector<double> defect(map.points.size(), 2 * kPi);
	for (int h = 0; h < t.halfedgeCount(); ++h) {
		if (t.isOuter(h))
			continue;
		defect[at(t.origin(h))] -= glued.angle[at(h)];
		area += 0.5 * (std::conj(glued.place[at(h)]) * glued.place[at(t.next(h))]).imag();
	}
	for (std::size_t v = 0; v < defect.size(); ++v)
		if (!boundary[v])
			angleError = std::max(
				angleError, std::abs(defect[v] - (v < curvature.size() ? curvature[v] : 0.0)));
	for (int e = 0; e < t.edgeCount(); ++e) {
		if (t.isBoundaryEdge(e))
			continue;
		const int h = 2 * e, g = h + 1;
		if (glued.place[at(h)] == glued.place[at(t.next(g))] &&
			glued.place[at(t.next(h))] == glued.place[at(g)])
			continue;
		++seamEdges;
		const double gap = std::abs(glued.length(h) - glued.length(g));
		seamMismatch = std::max(seamMismatch, (gap - kPlaceRounding * extent) / glued.length(h));
		std::vector<int> ends = support(map.points[at(t.origin(h))]);
		for (int v : support(map.points[at(t.target(h))]))
			if (std::find(ends.begin(), ends.end(), v) == ends.end())
				ends.push_back(v);
		seamsInside += ends.size() != 2;
	}
}

std::vector<StraightLine>
straightLines(const SurfaceMesh& mesh, const RefinedMap& map, double angleTolerance)
{
	const Glued glued(map.points.size(), map);
	const Triangulation& t = glued.t;
	const int vertexCount = static_cast<int>(mesh.positions.size());
	const std::vector<char> boundary = t.boundaryVertices();
	/// The halfedge that leaves the end of h most nearly straight on, -1 if there is none.
	const auto straightOn = [&](int h) {
		if (boundary[at(t.target(h))])
			return -1;
		int best = -1;
		double least = angleTolerance, turned = 0.0;
		int g = t.next(h);
		do {
			turned += glued.angle[at(g)];
			if (std::abs(turned - kPi) < least) {
				least = std::abs(turned - kPi);
				best = g;
			}
			g = t.next(Triangulation::twin(g));
		} while (g != t.next(h));
		return best;
	};
	std::vector<Point3> space;
	for (const SurfacePoint& p : map.points)
		space.push_back(placeOnSurface(p, mesh.positions));
	std::vector<StraightLine> lines;
	for (int start = 0; start < t.halfedgeCount(); ++start) {
		if (t.isOuter(start) || t.origin(start) >= vertexCount)
			continue;
		StraightLine line{t.origin(start), -1, 0.0, {t.origin(start)}, {0.0}, {0.0}};
		for (int h = start; h >= 0 && at(t.edgeCount()) > line.points.size(); h = straightOn(h)) {
			line.length += glued.length(h);
			line.points.push_back(t.target(h));
			line.inPlane.push_back(line.length);
			line.inSpace.push_back(
				line.inSpace.back() + distance(space[at(t.origin(h))], space[at(t.target(h))]));
			if (t.target(h) < vertexCount) {
				line.to = t.target(h);
				lines.push_back(line);
				break;
			}
		}
	}
	return lines;
}

} // namespace ricci::testing
