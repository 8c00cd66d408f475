// SPDX-License-Identifier: GPL-3.0-or-later
#include "component.h"

#include "../base/graphs.h"
#include "../base/parallel.h"
#include "../base/task.h"
#include "../base/tolerances.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace ricci {

namespace {

/// How far a vertex may be from the image of another, in medians of the triangles' shortest sides: less than a person would
/// see, and far more than the rounding of coordinates. The long sides of needles do not tell how far vertices are apart.
constexpr double kMirrorNoise = 1e-3;

/// Share of the vertices that may have no image: models have small parts on one side only.
constexpr double kMaxUnmirrored = 0.1;

/// normal . p = offset
struct Plane
{
	Point3 normal;
	double offset;

	double height(const Point3& p) const { return dot(normal, p) - offset; }
	Point3 mirrored(const Point3& p) const { return p + (-2.0 * height(p)) * normal; }
};

/// So many planes are tried, until so many mirror the surface: on a round body there may be one for each two vertices.
constexpr std::size_t kMaxPlanes = 1000;
constexpr int kMaxFound = 8;

/// Planes through the centroid c of the vertices: every one that mirrors them all takes the vertex v farthest from c to one
/// as far away, or leaves it there and takes another one, w, to one as far from c and from v, or leaves that there, too.
/// Then planes normal to the axes of the coordinates, x first, through 0 and the middle of the extent: those of most models.
/// \param noise by which distances may differ
std::vector<Plane> planesToTry(const VertexArray<Point3>& positions, double noise)
{
	Point3 centroid{0, 0, 0};
	for (const Point3& p : positions)
		centroid += p / positions.size();
	std::vector<Plane> planes;
	const auto add = [&](const Point3& direction) {
		if (const double size = length(direction); size > noise) {
			const Point3 normal = direction / size;
			planes.push_back({normal, dot(normal, centroid)});
		}
	};
	const auto firstLargest = [&](const auto& size) {
		double largest = 0.0;
		for (const Point3& p : positions)
			largest = std::max(largest, size(p));
		return *std::find_if(positions.begin(), positions.end(), [&](const Point3& p) {
			return size(p) >= largest - noise;
		});
	};
	const auto fromCentroid = [&](const Point3& p) { return distance(p, centroid); };
	const Point3 v = firstLargest(fromCentroid), axis = v - centroid;
	const Point3 w = firstLargest([&](const Point3& p) {
		return length(cross(axis, p - centroid)) / std::max(length(axis), noise);
	});
	const auto addThoseTo = [&](const Point3& from, const Point3& fixed) {
		for (const Point3& p : positions)
			if (planes.size() < kMaxPlanes &&
				std::abs(fromCentroid(p) - fromCentroid(from)) <= noise &&
				std::abs(distance(p, fixed) - distance(from, fixed)) <= noise)
				add(p - from);
	};
	addThoseTo(v, centroid);
	addThoseTo(w, v);
	add(cross(axis, w - centroid));
	for (std::size_t k = 0; k < 3; ++k) {
		const auto [low, high] = std::minmax_element(
			positions.begin(), positions.end(), [&](const Point3& p, const Point3& q) {
				return p[k] < q[k];
			});
		Point3 normal{0, 0, 0};
		normal[k] = 1.0;
		for (const double offset : {0.0, 0.5 * ((*low)[k] + (*high)[k])})
			planes.push_back({normal, offset});
	}
	return planes;
}

/// The vertex nearest to a place, the first of several; none if it is farther away than the noise.
Vertex nearestTo(const Point3& place, double noise, const PointsOnLine& points)
{
	Vertex nearest;
	double least = noise;
	points.visitNear(place, noise, [&](int i, double d) {
		if (d < least || (d == least && nearest.isValid() && Vertex(i) < nearest)) {
			least = d;
			nearest = Vertex(i);
		}
	});
	return nearest;
}

/// A plane is tried on so many vertices first: it is none if a quarter of them have no image.
constexpr int kFirstTried = 64;

/// [vertex] The vertex nearest to its image across \p plane; none where that is not mutual, or one of them alone on the
/// boundary or on a hole that is closed.
/// \return empty if too many have none
VertexArray<Vertex> imagesAcross(
	const Plane& plane,
	const EmbeddedSurface& surface,
	const VertexArray<char>& onHole,
	double noise,
	const PointsOnLine& points)
{
	const VertexArray<char>& boundary = surface.topology.boundary;
	const auto nearest = [&](Vertex v) {
		const Vertex w = nearestTo(plane.mirrored(surface.positions[v]), noise, points);
		const bool isLike =
			w.isValid() && boundary[w] == boundary[v] && (onHole.empty() || onHole[w] == onHole[v]);
		return isLike ? w : Vertex();
	};
	const int count = boundary.size(), step = std::max(1, count / kFirstTried);
	int missing = 0;
	for (int i = 0; i < count; i += step)
		missing += !nearest(Vertex(i)).isValid();
	if (4 * step * missing > count)
		return {};
	VertexArray<Vertex> image(count);
	checkpoint();
	inParallel(count, defaultThreads(), [&](int first, int last) {
		for (int i = first; i < last; ++i)
			image[Vertex(i)] = nearest(Vertex(i));
	});
	missing = 0;
	for (const Vertex v : image.indices()) {
		if (image[v].isValid() && image[image[v]] != v)
			image[v] = Vertex();
		missing += !image[v].isValid();
	}
	return missing <= kMaxUnmirrored * count ? image : VertexArray<Vertex>();
}

bool isInPlane(const Triangulation& t, const MirrorSymmetry& mirror, Edge e)
{
	return !t.isBoundary(e) && mirror.isAboveFace(t, t.face(e.halfedge())) !=
								   mirror.isAboveFace(t, t.face(e.halfedge().twin()));
}

/// Fills in the halves.
/// \return whether the plane divides the surface along edges into two that are connected, each vertex of these edges
/// on two of them, on the boundary on one
bool divides(const Plane& plane, const EmbeddedSurface& surface, MirrorSymmetry& mirror)
{
	const Triangulation& t = surface.triangulation;
	const auto sideOf = [&](Vertex v) {
		return mirror.image[v] == v ? 0 : plane.height(surface.positions[v]) > 0.0 ? 1 : -1;
	};
	for (const Vertex v : t.vertices()) {
		if (mirror.image[v].isValid())
			continue;
		bool isBesideAbove = false, isBesideBelow = false;
		for (const Halfedge h : t.around(v)) {
			if (!mirror.image[t.target(h)].isValid())
				continue;
			isBesideAbove |= sideOf(t.target(h)) > 0;
			isBesideBelow |= sideOf(t.target(h)) < 0;
		}
		if (isBesideAbove && isBesideBelow)
			mirror.image[v] = v; // meant to be in the plane
	}
	mirror.isAbove.resize(t.vertexCount(), 0);
	for (const Vertex v : t.vertices())
		mirror.isAbove[v] = sideOf(v) > 0;
	for (const Face f : t.faces()) {
		int above = 0, inPlane = 0;
		for (const Vertex v : t.vertices(f)) {
			above += mirror.isAbove[v];
			inPlane += mirror.image[v] == v;
		}
		if (inPlane == 3 || (above > 0 && above + inPlane < 3))
			return false;
	}
	VertexArray<int> degree(t.vertexCount(), 0);
	DisjointSetsOf<Face> halves(t.faceCount());
	int parts = t.faceCount();
	for (const Edge e : t.edges()) {
		if (t.isBoundary(e))
			continue;
		if (!isInPlane(t, mirror, e))
			parts -= halves.merge(t.face(e.halfedge()), t.face(e.halfedge().twin()));
		else
			for (const Vertex v : t.ends(e))
				++degree[v];
	}
	for (const Vertex v : t.vertices())
		if (degree[v] == 0 && mirror.image[v] == v)
			mirror.image[v] = Vertex(); // it only touches the plane
		else if (degree[v] != 0 && degree[v] != (surface.topology.boundary[v] ? 1 : 2))
			return false;
	return parts == 2;
}

void mirrorEdges(const Triangulation& t, MirrorSymmetry& mirror)
{
	mirror.edgeImage.resize(t.edgeCount(), Edge());
	VertexArray<int> degree(t.vertexCount(), 0);
	for (const Halfedge h : t.halfedges())
		++degree[t.origin(h)];
	for (const Edge e : t.edges()) {
		Vertex a = mirror.image[t.ends(e)[0]], b = mirror.image[t.ends(e)[1]];
		if (!a.isValid() || !b.isValid())
			continue;
		if (degree[b] < degree[a]) // the middle of a fan has many
			std::swap(a, b);
		for (const Halfedge h : t.around(a))
			if (t.target(h) == b && t.isBoundary(h.edge()) == t.isBoundary(e) &&
				(h.edge() == e) == isInPlane(t, mirror, e))
				mirror.edgeImage[e] = h.edge();
	}
}

} // namespace

std::shared_ptr<const MirrorSymmetry>
findMirror(const EmbeddedSurface& surface, const VertexArray<char>& onHole)
{
	std::vector<double> shortest;
	for (const Face f : surface.triangulation.faces()) {
		const auto sides = surface.triangulation.halfedges(f);
		shortest.push_back(std::min(
			{surface.lengths[sides[0].edge()],
			 surface.lengths[sides[1].edge()],
			 surface.lengths[sides[2].edge()]}));
	}
	const double noise = kMirrorNoise * median(std::move(shortest));
	const PointsOnLine points(surface.positions.values());
	std::shared_ptr<MirrorSymmetry> best;
	double least = kInfinity;
	int found = 0;
	for (const Plane& plane : planesToTry(surface.positions, noise)) {
		auto mirror = std::make_shared<MirrorSymmetry>();
		mirror->image = imagesAcross(plane, surface, onHole, noise, points);
		if (mirror->image.empty() || !divides(plane, surface, *mirror))
			continue;
		double inPlane = 0.0;
		for (const Edge e : surface.triangulation.edges())
			if (isInPlane(surface.triangulation, *mirror, e))
				inPlane += surface.lengths[e];
		if (inPlane < (1.0 - kTiny) * least) {
			least = inPlane;
			best = std::move(mirror);
		}
		if (++found == kMaxFound)
			break;
	}
	if (best)
		mirrorEdges(surface.triangulation, *best);
	return best;
}

} // namespace ricci
