// SPDX-License-Identifier: GPL-3.0-or-later
#include "component.h"

#include "../base/graphs.h"
#include "../base/task.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace ricci {

namespace {

/// How far a vertex may be from the image of another, in mean lengths of edges: less than a person would see, and far
/// more than the rounding of coordinates.
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

std::vector<Plane> planesToTry(const VertexArray<Point3>& positions)
{
	Eigen::Vector3d low = Eigen::Vector3d::Constant(kInfinity), high = -low,
					centre = Eigen::Vector3d::Zero();
	const auto vectorOf = [](const Point3& p) { return Eigen::Vector3d::Map(p.data()); };
	for (const Point3& p : positions) {
		low = low.cwiseMin(vectorOf(p));
		high = high.cwiseMax(vectorOf(p));
		centre += vectorOf(p) / positions.size();
	}
	Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
	for (const Point3& p : positions)
		covariance += (vectorOf(p) - centre) * (vectorOf(p) - centre).transpose();
	const Eigen::Matrix3d axes =
		Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors();
	std::vector<Plane> planes;
	for (int k = 0; k < 3; ++k) {
		const Eigen::Vector3d n = Eigen::Vector3d::Unit(k);
		for (const double offset : {0.0, 0.5 * (low[k] + high[k]), centre[k]})
			planes.push_back({{n[0], n[1], n[2]}, offset});
	}
	for (int k = 2; k >= 0; --k) {
		const Eigen::Vector3d n = axes.col(k);
		planes.push_back({{n[0], n[1], n[2]}, n.dot(centre)});
	}
	return planes;
}

/// Finds the vertex nearest to a place, in boxes that are divided at the median of their longest side: however many vertices
/// lie within the noise, where a few edges are much longer than the others, most are left out.
class Nearest
{
public:
	/// \param noise how far it is away at most
	Nearest(const VertexArray<Point3>& positions, double noise) :
			m_positions(positions), m_noise(noise)
	{
		for (const Vertex v : positions.indices())
			m_order.push_back(v);
		build(m_order.begin(), m_order.end());
	}

	/// None if there is none.
	Vertex operator()(const Point3& place) const
	{
		Vertex nearest;
		double least = m_noise;
		search(0, place, nearest, least);
		return nearest;
	}

private:
	using Place = std::vector<Vertex>::iterator;

	/// Behind it come those of the half below, then those of the half above.
	struct Node
	{
		Point3 low, high;
		Place first, last;     // of its vertices
		std::size_t above = 0; // node; 0: it is not divided
	};

	static constexpr int kUndivided = 8; // vertices

	void build(Place first, Place last)
	{
		const std::size_t number = m_nodes.size();
		Node node{m_positions[*first], m_positions[*first], first, last};
		std::size_t axis = 0;
		for (const std::size_t k : {0, 1, 2}) {
			for (Place v = first; v != last; ++v) {
				node.low[k] = std::min(node.low[k], m_positions[*v][k]);
				node.high[k] = std::max(node.high[k], m_positions[*v][k]);
			}
			if (node.high[k] - node.low[k] > node.high[axis] - node.low[axis])
				axis = k;
		}
		m_nodes.push_back(node);
		const bool isOnePlace = !(node.low[axis] < node.high[axis]);
		if (isOnePlace || last - first <= kUndivided) {
			std::sort(first, last);
			if (isOnePlace) // the first of its vertices stands for all
				m_nodes[number].last = first + 1;
			return;
		}
		const Place middle = first + (last - first) / 2;
		std::nth_element(first, middle, last, [&](Vertex v, Vertex w) {
			const double x = m_positions[v][axis], y = m_positions[w][axis];
			return x != y ? x < y : v < w;
		});
		build(first, middle);
		m_nodes[number].above = m_nodes.size();
		build(middle, last);
	}

	double distanceTo(const Node& node, const Point3& place) const
	{
		Point3 nearest;
		for (const std::size_t k : {0, 1, 2})
			nearest[k] = std::max(node.low[k], std::min(place[k], node.high[k]));
		return distance(nearest, place);
	}

	void search(std::size_t number, const Point3& place, Vertex& nearest, double& least) const
	{
		const Node& node = m_nodes[number];
		if (!(distanceTo(node, place) < least))
			return;
		if (node.above == 0) {
			for (Place v = node.first; v != node.last; ++v)
				if (const double d = distance(m_positions[*v], place); d < least) {
					least = d;
					nearest = *v;
				}
			return;
		}
		std::size_t nearer = number + 1, other = node.above;
		if (distanceTo(m_nodes[other], place) < distanceTo(m_nodes[nearer], place))
			std::swap(nearer, other);
		search(nearer, place, nearest, least);
		search(other, place, nearest, least);
	}

	const VertexArray<Point3>& m_positions;
	double m_noise;
	std::vector<Vertex> m_order;
	std::vector<Node> m_nodes;
};

/// A plane is tried on so many vertices first: it is none if a quarter of them have no image.
constexpr int kFirstTried = 64;

/// [vertex] The vertex nearest to its image across \p plane; none where that is not mutual, or one of them alone on the
/// boundary or on a hole that is closed.
/// \return empty if too many have none
VertexArray<Vertex> imagesAcross(
	const Plane& plane,
	const EmbeddedSurface& surface,
	const VertexArray<char>& onHole,
	const Nearest& nearestTo)
{
	const VertexArray<char>& boundary = surface.topology.boundary;
	const auto nearest = [&](Vertex v) {
		const Vertex w = nearestTo(plane.mirrored(surface.positions[v]));
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
	for (const Vertex v : image.indices()) {
		checkpointNowAndThen(positionOf(v));
		image[v] = nearest(v);
	}
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
	for (const Edge e : t.edges()) {
		const auto [a, b] = t.ends(e);
		if (!mirror.image[a].isValid() || !mirror.image[b].isValid())
			continue;
		for (const Halfedge h : t.around(mirror.image[a]))
			if (t.target(h) == mirror.image[b] && t.isBoundary(h.edge()) == t.isBoundary(e) &&
				(h.edge() == e) == isInPlane(t, mirror, e))
				mirror.edgeImage[e] = h.edge();
	}
}

} // namespace

std::shared_ptr<const MirrorSymmetry>
findMirror(const EmbeddedSurface& surface, const VertexArray<char>& onHole)
{
	double length = 0.0;
	for (const double l : surface.lengths)
		length += l / surface.lengths.size();
	const Nearest nearest(surface.positions, kMirrorNoise * length);
	for (const Plane& plane : planesToTry(surface.positions)) {
		auto mirror = std::make_shared<MirrorSymmetry>();
		mirror->image = imagesAcross(plane, surface, onHole, nearest);
		if (mirror->image.empty() || !divides(plane, surface, *mirror))
			continue;
		mirrorEdges(surface.triangulation, *mirror);
		return mirror;
	}
	return nullptr;
}

} // namespace ricci
