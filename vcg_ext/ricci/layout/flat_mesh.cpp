// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat_mesh.h"

#include "../base/numbers.h"
#include "../base/tolerances.h"
#include "../mesh/sides.h"
#include "../metric/area.h"

#include <algorithm>

namespace ricci {

int FlatMesh::vertexCount() const
{
	int count = 0;
	for (const Triangle& t : vertices)
		count = std::max({count, t[0] + 1, t[1] + 1, t[2] + 1});
	return count;
}

void FlatMesh::append(FlatMesh other)
{
	if (!isDiagonal.empty() || !other.isDiagonal.empty()) {
		isDiagonal.resize(3 * points.size(), 0);
		other.isDiagonal.resize(3 * other.points.size(), 0);
	}
	for (Triangle& corners : other.points)
		for (int& p : corners)
			p += place.size();
	for (Corner& side : other.across)
		side = side.isValid() ? Corner(across.size() + side.number()) : Corner();
	vertices.append(std::move(other.vertices));
	across.append(std::move(other.across));
	points.append(std::move(other.points));
	place.append(std::move(other.place));
	lengths.append(std::move(other.lengths));
	isDiagonal.append(std::move(other.isDiagonal));
	chart.append(std::move(other.chart));
	face.append(std::move(other.face));
}

double FlatMesh::area() const
{
	double sum = 0.0;
	for (const std::array<double, 3>& sides : lengths)
		sum += euclideanArea(sides);
	return sum;
}

double FlatMesh::planeArea() const
{
	double doubled = 0.0;
	for (const int f : points.indices())
		doubled += std::abs(doubledArea(at(f)));
	return 0.5 * doubled;
}

std::array<double, 2> FlatMesh::stretch(int triangle) const
{
	const std::array<double, 3>& l = lengths[triangle];
	const double area = euclideanArea(l);
	const double longest = std::max({l[0], l[1], l[2]});
	if (!(2.0 * area > kTiny * longest * longest))
		return {0.0, 0.0};
	// On the surface from corner 0 along side 0, which has length a: the others end at (x, h).
	const double a = l[0], h = 2.0 * area / a;
	const double x = (a * a + l[2] * l[2] - l[1] * l[1]) / (2.0 * a);
	const Triangle2 p = at(triangle);
	const Point2 along = (1.0 / a) * (p[1] - p[0]);
	const Point2 up = (1.0 / h) * ((p[2] - p[0]) - x * along);
	const double square = dot(along, along) + dot(up, up);
	const double determinant = cross(along, up) * cross(along, up);
	return {area * square, determinant > 0.0 ? area * (square / determinant) : kInfinity};
}

Box2 FlatMesh::box() const
{
	return boxAround(place);
}

std::vector<Box2> FlatMesh::boxes(std::size_t chartCount) const
{
	std::vector<Box2> boxes(chartCount);
	for (const int f : points.indices())
		for (const Point2& p : at(f))
			boxes[positionOf(chart[f])].add(p);
	return boxes;
}

Array<Triangle2> FlatMesh::corners() const
{
	Array<Triangle2> corners;
	corners.reserve(size());
	for (const int f : points.indices())
		corners.push_back(at(f));
	return corners;
}

Array<int> FlatMesh::chartOfPoints() const
{
	Array<int> chartOf(place.size(), -1);
	for (const int f : points.indices())
		for (const int p : points[f])
			chartOf[p] = chart[f];
	return chartOf;
}

std::vector<std::vector<int>> FlatMesh::pointsByChart(std::size_t chartCount) const
{
	std::vector<std::vector<int>> byChart(chartCount);
	const Array<int> chartOf = chartOfPoints();
	for (const int p : chartOf.indices())
		if (chartOf[p] >= 0)
			byChart[positionOf(chartOf[p])].push_back(p);
	return byChart;
}

std::vector<std::vector<int>> FlatMesh::trianglesByChart(std::size_t chartCount) const
{
	std::vector<std::vector<int>> triangles(chartCount);
	for (const int f : chart.indices())
		if (chart[f] >= 0)
			triangles[positionOf(chart[f])].push_back(f);
	return triangles;
}

FlatMesh FlatMesh::part(const std::vector<int>& triangles) const
{
	FlatMesh part;
	int low = place.size(), high = -1; // points of a chart mostly have numbers near each other
	for (const int f : triangles)
		for (const int p : points[f]) {
			low = std::min(low, p);
			high = std::max(high, p);
		}
	Array<int> number(std::max(0, high + 1 - low), -1); // [point - low]
	for (const int f : triangles)
		for (const int p : points[f])
			number[p - low] = 0;
	for (const int p : number.indices())
		if (number[p] == 0) {
			number[p] = part.place.size();
			part.place.push_back(place[low + p]);
		}
	part.points.reserve(triangles.size());
	part.vertices.reserve(triangles.size());
	part.lengths.reserve(triangles.size());
	part.face.reserve(triangles.size());
	for (const int f : triangles) {
		const Triangle& p = points[f];
		part.points.push_back({number[p[0] - low], number[p[1] - low], number[p[2] - low]});
		part.vertices.push_back(vertices[f]);
		part.lengths.push_back(lengths[f]);
		part.face.push_back(face[f]);
	}
	for (const int f : isDiagonal.empty() ? std::vector<int>() : triangles)
		for (const Corner side : cornersOf(f))
			part.isDiagonal.push_back(isDiagonal[side]);
	part.chart.assign(triangles.size(), 0);
	if (across.empty() || triangles.empty())
		return part;
	const auto [first, last] = std::minmax_element(triangles.begin(), triangles.end());
	Array<int> numberOf(*last + 1 - *first, -1); // [triangle - first]
	for (std::size_t i = 0; i < triangles.size(); ++i)
		numberOf[triangles[i] - *first] = static_cast<int>(i);
	part.across.reserve(3 * triangles.size());
	for (const int f : triangles)
		for (const Corner side : cornersOf(f)) {
			const Corner other = across[side];
			const int in = other.isValid() ? other.face() - *first : -1;
			part.across.push_back(
				in >= 0 && in < numberOf.size() && numberOf[in] >= 0
					? Corner(numberOf[in], static_cast<int>(other.index()))
					: Corner());
		}
	return part;
}

std::vector<Point3> FlatMesh::onSurface(const std::vector<Point3>& positions) const
{
	std::vector<Point3> places;
	places.reserve(source.values().size());
	for (const SurfacePoint& p : source)
		places.push_back(placeOnSurface(p, positions));
	return places;
}

EdgeSet seams(const FlatMesh& mesh)
{
	EdgeSet sum;
	for (const Corner side : mesh.across.indices())
		if (mesh.across[side] > side && !mesh.joined(side).isValid()) {
			sum.sides.push_back(side);
			sum.length += mesh.lengths[side];
		}
	return sum;
}

void mirror(const CornerOrder& order, std::size_t chartCount, FlatMesh& mesh)
{
	const std::vector<Box2> boxes = mesh.boxes(chartCount);
	const Array<int> chart = mesh.chartOfPoints();
	for (const int p : mesh.place.indices())
		if (chart[p] >= 0) {
			const Box2& box = boxes[positionOf(chart[p])];
			mesh.place[p][0] = box.min[0] + box.max[0] - mesh.place[p][0];
		}
	const FlatMesh before = mesh;
	const auto cornerAt = [&](Corner c) {
		return Corner(c.face(), static_cast<int>(order[c.index()]));
	};
	// A side ends where it began.
	const auto sideAt = [&](Corner side) { return cornerAt(side.next()); };
	const auto placeOf = [&](Corner side) {
		return side.isValid() ? cornerAt(side).previous() : side;
	};
	for (const Corner c : IndexRange<Corner>(3 * mesh.size())) {
		mesh.vertices[c] = before.vertices[cornerAt(c)];
		mesh.points[c] = before.points[cornerAt(c)];
		mesh.lengths[c] = before.lengths[sideAt(c)];
		mesh.across[c] = placeOf(before.across[sideAt(c)]);
		if (!mesh.isDiagonal.empty())
			mesh.isDiagonal[c] = before.isDiagonal[sideAt(c)];
	}
}

void splitPoints(FlatMesh& mesh)
{
	numberPoints(
		[&](Corner c) { return mesh.at(c); },
		[&](Corner a, Corner b) {
			return mesh.chart[a.face()] == mesh.chart[b.face()] && mesh.joined(a) == b;
		},
		mesh);
}

void scaleToSurface(FlatMesh& mesh)
{
	if (const double plane = mesh.planeArea(); plane > 0.0) {
		const double scale = std::sqrt(mesh.area() / plane);
		for (Point2& p : mesh.place)
			p *= scale;
	}
}

void connect(FlatMesh& mesh)
{
	mesh.across = Sides(mesh.vertices.values()).across();
}

CornerArray<char> sidesOf(const SideMarks& marks)
{
	CornerArray<char> sides;
	for (const std::array<char, 3>& triangle : marks)
		for (const char mark : triangle)
			sides.push_back(mark);
	return sides;
}

FlatMesh flatMeshOf(
	Array<Triangle> vertices, const Array<Triangle2>& plane, const std::vector<Point3>& positions)
{
	FlatMesh mesh;
	mesh.lengths.resize(vertices.size());
	mesh.face.resize(vertices.size());
	for (const int f : vertices.indices()) {
		mesh.lengths[f] = sideLengths(vertices[f], positions);
		mesh.face[f] = f;
	}
	mesh.vertices = std::move(vertices);
	mesh.chart.assign(mesh.face.size(), 0);
	mesh.source = verticesOf(positions.size());
	connect(mesh);
	numberPoints(
		[&](Corner c) { return plane[c]; },
		[&](Corner a, Corner b) {
			return plane[a] == plane[b.next()] && plane[a.next()] == plane[b];
		},
		mesh);
	return mesh;
}

Array<SurfacePoint> verticesOf(std::size_t count)
{
	Array<SurfacePoint> points(count);
	for (const int v : points.indices())
		points[v].vertex[0] = v;
	return points;
}

} // namespace ricci
