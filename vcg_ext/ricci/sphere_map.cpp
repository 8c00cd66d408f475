// SPDX-License-Identifier: GPL-3.0-or-later
#include "sphere_map.h"

#include "base/crew.h"
#include "base/numbers.h"
#include "base/task.h"
#include "base/tolerances.h"
#include "error.h"
#include "flatten.h"
#include "measure/distortion.h"
#include "measure/map_check.h"
#include "mesh/component.h"
#include "mesh/triangulation.h"
#include "numerics/moebius_balancing.h"
#include "parametrize.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ricci {

namespace {

using Vector = Eigen::Vector3d;

/// Another vertex this much nearer to the puncture than its neighbours would dominate the inverted
/// surface.
constexpr double kNearest = 0.5;

Vector vec(const Point3& p)
{
	return {p[0], p[1], p[2]};
}

/// The vertex whose star has the largest smallest angle, among those that no other vertex comes near
/// in space; where there is none, the one that others come least near.
Vertex choosePole(const Component& c)
{
	const int n = c.positions.size();
	VertexArray<double> minAngle(n, kInfinity);
	VertexArray<double> nearest(n, kInfinity); // neighbour
	for (const Triangle& t : c.triangles) {
		double angle = kInfinity;
		for (std::size_t k = 0; k < 3; ++k) {
			const Vertex v(t[k]), next(t[(k + 1) % 3]);
			const Vector o = vec(c.positions[v]);
			const Vector a = vec(c.positions[next]) - o;
			const Vector b = vec(c.positions[Vertex(t[(k + 2) % 3])]) - o;
			angle = std::min(angle, std::atan2(a.cross(b).norm(), a.dot(b)));
			const double side = a.norm();
			nearest[v] = std::min(nearest[v], side);
			nearest[next] = std::min(nearest[next], side);
		}
		for (const int v : t)
			minAngle[Vertex(v)] = std::min(minAngle[Vertex(v)], angle);
	}
	std::vector<Vertex> order;
	for (const Vertex v : c.positions.indices())
		order.push_back(v);
	std::sort(order.begin(), order.end(), [&](Vertex a, Vertex b) {
		return minAngle[a] != minAngle[b] ? minAngle[a] > minAngle[b] : a < b;
	});
	const PointsOnLine points(c.positions.values());
	Vertex best;
	double mostAlone = 0.0;
	for (const Vertex pole : order) {
		checkpoint();
		const double reach = kNearest * nearest[pole];
		double least = reach;
		points.visitNear(c.positions[pole], reach, [&](int v, double d) {
			if (v != pole.number())
				least = std::min(least, d);
		});
		const double alone = reach > 0.0 ? least / nearest[pole] : 0.0;
		if (alone > mostAlone) {
			mostAlone = alone;
			best = pole;
		}
		if (mostAlone >= kNearest)
			break;
	}
	if (!best.isValid())
		throw InvalidMesh(InvalidMesh::NotPuncturable);
	return best;
}

/// The component inverted about its pole, whose star is taken out.
SurfaceMesh punctured(const Component& c, Vertex pole)
{
	const Vector centre = vec(c.positions[pole]);
	SurfaceMesh disk;
	double radius = 0.0, count = 0.0;
	for (const Triangle& t : c.triangles) {
		if (std::find(t.begin(), t.end(), pole.number()) == t.end()) {
			disk.triangles.push_back(t);
			continue;
		}
		for (const int v : t)
			if (v != pole.number()) {
				radius += (vec(c.positions[Vertex(v)]) - centre).norm();
				count += 1.0;
			}
	}
	radius /= count;
	for (const Point3& p : c.positions) {
		const Vector x = vec(p) - centre;
		const double square = x.squaredNorm();
		const Vector y = square > 0.0 ? Vector(x * (radius * radius / square)) : Vector::Zero();
		disk.positions.push_back({y[0], y[1], y[2]});
	}
	return disk;
}

/// Inverse stereographic projection with half of the vertices on either side of the equator. The plane is seen
/// from inside the sphere, so it is reflected.
VertexArray<Point3> toSphere(const VertexArray<Point2>& plane, Vertex pole)
{
	std::vector<double> x, y, r;
	for (const Vertex v : plane.indices())
		if (v != pole) {
			x.push_back(plane[v][0]);
			y.push_back(plane[v][1]);
		}
	const double cx = median(x), cy = median(y);
	for (std::size_t i = 0; i < x.size(); ++i)
		r.push_back(std::hypot(x[i] - cx, y[i] - cy));
	double unit = median(r);
	if (!(unit > 0.0))
		unit = *std::max_element(r.begin(), r.end());
	VertexArray<Point3> sphere(plane.size(), {0.0, 0.0, 1.0});
	for (const Vertex v : plane.indices()) {
		if (v == pole)
			continue;
		const double a = (plane[v][0] - cx) / unit, b = (cy - plane[v][1]) / unit;
		const double square = a * a + b * b;
		sphere[v] = {2 * a / (1 + square), 2 * b / (1 + square), (square - 1) / (1 + square)};
	}
	return sphere;
}

/// Turns the points most nearly towards \p places, seen from their weighted mean [Kabsch 1976].
void alignWith(
	const VertexArray<Point3>& places,
	const VertexArray<double>& weights,
	VertexArray<Point3>& points)
{
	Vector mean = Vector::Zero();
	double total = 0.0;
	for (const Vertex v : places.indices()) {
		mean += weights[v] * vec(places[v]);
		total += weights[v];
	}
	mean /= total;
	Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
	for (const Vertex v : places.indices())
		covariance += weights[v] * (vec(places[v]) - mean) * vec(points[v]).transpose();
	const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
		covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
	Eigen::Matrix3d sign = Eigen::Matrix3d::Identity();
	sign(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() > 0.0 ? 1.0 : -1.0;
	const Eigen::Matrix3d rotation = svd.matrixU() * sign * svd.matrixV().transpose();
	for (Point3& p : points) {
		const Vector q = (rotation * vec(p)).normalized();
		p = {q[0], q[1], q[2]};
	}
}

/// Distortion and orientation of the straight triangles.
/// \param areas in space
/// \throw NotConverged LostInRounding where most of the surface has no picture left
void measure(
	const Component& c,
	const std::vector<double>& areas,
	const VertexArray<Point3>& sphere,
	SphereMap& map)
{
	Array<Triangle2> flat;
	double flippedArea = 0.0;
	for (std::size_t f = 0; f < areas.size(); ++f) {
		const Triangle& t = c.triangles[f];
		const Vector first = vec(sphere[Vertex(t[0])]);
		const Vector a = vec(sphere[Vertex(t[1])]) - first, b = vec(sphere[Vertex(t[2])]) - first;
		const Vector normal = a.cross(b);
		const bool isFlipped = !(first.dot(normal) > 0.0);
		const double base = a.norm();
		map.flippedFaces += isFlipped;
		flippedArea += isFlipped ? areas[f] : 0.0;
		flat.push_back(
			base > 0.0
				? Triangle2{{{0.0, 0.0}, {base, 0.0}, {a.dot(b) / base, normal.norm() / base}}}
				: Triangle2{});
	}
	std::vector<double> ofVertices;
	static_cast<DistortionReport&>(map) =
		measureDistortion(Array<Triangle>(c.triangles), c.positions.values(), flat, ofVertices);
	const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
	if (map.qcValues.empty() || 2.0 * flippedArea > total)
		throw NotConverged(
			NotConverged::LostInRounding, positionOf(map.flippedFaces), scalesApart(map));
	if (map.flippedFaces > 0)
		logLine(
			counted(
				positionOf(map.flippedFaces), "face of the sphere is", "faces of the sphere are") +
			" flipped: parts of the surface become too small there for straight faces or for "
			"doubles.");
}

/// Takes over the numbers of the opened mesh, and draws the faces that it leaves out.
void placeVertices(
	const SurfaceMesh& mesh,
	const OpenedMesh& opened,
	const Component& c,
	const VertexArray<Point3>& sphere,
	SphereMap& map)
{
	map.positions.assign(opened.vertex.size(), {0.0, 0.0, 0.0});
	map.vertex = opened.vertex;
	map.triangles = mesh.triangles;
	std::vector<char> isPlaced(opened.vertex.size(), 0);
	for (const Vertex v : c.vertex.indices()) {
		map.positions[positionOf(c.vertex[v])] = sphere[v];
		isPlaced[positionOf(c.vertex[v])] = 1;
	}
	for (std::size_t f = 0; f < opened.face.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k) // a given vertex, or a copy
			if (const int v = opened.mesh.triangles[f][k]; positionOf(v) >= mesh.positions.size())
				map.triangles[positionOf(opened.face[f])][k] = v;
	for (const int f : opened.degenerate) {
		const Triangle t = opened.withJoined(mesh.triangles[positionOf(f)]);
		int known = map.pole;
		for (const int v : t)
			if (isPlaced[positionOf(v)])
				known = v;
		for (const int v : t)
			if (!isPlaced[positionOf(v)]) {
				map.positions[positionOf(v)] = map.positions[positionOf(known)];
				isPlaced[positionOf(v)] = 1;
			}
	}
	for (std::size_t v = 0; v < opened.joined.size(); ++v)
		map.positions[v] = map.positions[positionOf(opened.joined[v])];
}

} // namespace

SphereMap mapToSphere(const SurfaceMesh& mesh, const Options& options)
{
	const Crew crew;
	if (!mesh.lengths.empty())
		throw InvalidOption(InvalidOption::WithoutPositions);
	Options flow;
	flow.epsilon = options.epsilon;
	flow.join = options.join;
	flow.cones.onlyWhereNeeded = true;
	flow.finish = Finish::None;
	checkOptions(flow);
	const OpenedMesh opened = openMesh(mesh, OneSidedCut::Shortest, flow.join);
	const std::vector<Component> components = splitIntoComponents(opened);
	const Component& c = components.front();
	if (components.size() > 1)
		throw InvalidOption(InvalidOption::SphereOfComponents, 0.0, 0.0, components.size());
	const SurfaceType type = topologyOf(Triangulation(c.positions.size(), c.triangles)).type;
	if (!type.isSphere())
		throw InvalidOption(InvalidOption::NotASphere, TargetCurvature::Automatic, type);

	const Vertex pole = choosePole(c);
	const Component disk = splitIntoComponents(openMesh(punctured(c, pole))).front();
	requireMemory(disk.triangles.size(), disk.triangles.size(), false);
	const Parametrization flat = [&] {
		const Task quiet(0.0, kMapped, true); // the log would speak of the punctured surface
		return flattenToPlane(disk, flow);
	}();
	VertexArray<Point2> plane(c.positions.size(), {0.0, 0.0});
	for (const int f : flat.mesh.points.indices())
		for (const Corner corner : cornersOf(f))
			plane[Vertex(disk.vertex[Vertex(flat.mesh.vertices[corner])])] = flat.mesh.at(corner);

	VertexArray<double> weights(c.positions.size(), 0.0);
	const std::vector<double> areas = triangleAreas(c.positions.values(), c.triangles, {});
	for (std::size_t f = 0; f < areas.size(); ++f)
		for (const int v : c.triangles[f])
			weights[Vertex(v)] += areas[f] / 3.0;
	VertexArray<Point3> sphere = toSphere(plane, pole);
	SphereMap map;
	map.pole = opened.vertex[positionOf(c.vertex[pole])];
	map.iterations = flat.report.iterations;
	map.maxCurvatureError = flat.report.maxCurvatureError;
	map.offset = balanceByMoebius(sphere.values(), weights.values());
	alignWith(c.positions, weights, sphere);
	measure(c, areas, sphere, map);
	const SphereCheck check = checkSphere(c.triangles, sphere.values());
	// A face that spans more than a hemisphere is a straight triangle on the other side, flipped:
	// one covering less.
	const double coverings = std::round(check.degree);
	if (!(check.radiusError <= kCancelled) || !(std::abs(check.degree - coverings) <= kTiny) ||
		std::abs(coverings - 1.0) > map.flippedFaces || check.turned > map.flippedFaces)
		throw NotConverged(
			"the sphere is covered " + numberText(check.degree, 9) + " times, radii " +
			numberText(check.radiusError, 3) + " off, " + std::to_string(check.turned) +
			" faces flipped");
	placeVertices(mesh, opened, c, sphere, map);
	return map;
}

} // namespace ricci
