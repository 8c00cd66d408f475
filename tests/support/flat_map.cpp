// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat_map.h"

#include "complex.h"
#include "shapes.h"

#include <ricci/charts/chart_overlap.h>
#include <ricci/charts/input_indices.h>
#include <ricci/error.h>
#include <ricci/measure/distortion.h>
#include <ricci/pipeline/whole_map.h>
#include <ricci/surface/triangulation.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ricci::testing {

namespace {

constexpr double kPi = 3.14159265358979323846;

} // namespace

FlatMap::FlatMap(const SurfaceMesh& mesh, const UV& uv)
{
	const Triangulation t(static_cast<int>(mesh.positions.size()), mesh.triangles);
	boundary = t.boundaryVertices().values();
	for (char b : boundary)
		curvature.push_back(b ? kPi : 2 * kPi);
	HalfedgeArray<Complex> place(t.halfedgeCount());
	for (const Face f : t.faces()) {
		const auto h = t.halfedges(f);
		std::array<Complex, 3> p;
		for (std::size_t k = 0; k < 3; ++k)
			place[h[k]] = p[k] = asComplex(uv[at(f)][k]);
		area += 0.5 * (std::conj(p[1] - p[0]) * (p[2] - p[0])).imag();
		for (std::size_t k = 0; k < 3; ++k)
			curvature[at(t.origin(h[k]))] -=
				std::abs(std::arg((p[(k + 2) % 3] - p[k]) / (p[(k + 1) % 3] - p[k])));
	}
	// What the coordinates' own last places make of a length.
	double rounding = 0.0;
	for (const Complex& p : place)
		rounding = std::max(rounding, 8 * std::numeric_limits<double>::epsilon() * std::abs(p));
	for (const Edge e : t.edges()) {
		if (t.isBoundary(e))
			continue;
		const Halfedge h = e.halfedge(), g = h.twin();
		const Complex a = place[h], b = place[t.next(h)];
		const Complex c = place[t.next(g)], d = place[g];
		if (a == c && b == d)
			continue;
		++seamEdges;
		const double difference = std::abs(std::abs(b - a) - std::abs(d - c));
		seamMismatch = std::max(seamMismatch, (difference - rounding) / std::abs(d - c));
	}
}

double FlatMap::insideError(const std::vector<double>& target) const
{
	double largest = 0.0;
	for (std::size_t v = 0; v < curvature.size(); ++v)
		if (!boundary[v])
			largest = std::max(largest, std::abs(curvature[v] - target[v]));
	return largest;
}

double FlatMap::error(const std::vector<double>& target) const
{
	double largest = 0.0;
	for (std::size_t v = 0; v < curvature.size(); ++v)
		largest = std::max(largest, std::abs(curvature[v] - target[v]));
	return largest;
}

namespace {

FlatResult withInputIndices(const SurfaceMesh& mesh, const OpenedMesh& opened, Parametrization map)
{
	toInputIndices(mesh, opened, map);
	FlatResult result{std::move(map), UV(mesh.triangles.size())};
	for (const int f : result.mesh.points.indices())
		for (const Corner c : cornersOf(f))
			for (std::size_t k = 0; k < 3; ++k)
				if (mesh.triangles[at(result.mesh.face[f])][k] == result.mesh.vertices[c])
					result.uv[at(result.mesh.face[f])][k] = result.mesh.at(c);
	return result;
}

} // namespace

double qcOf(const SurfaceMesh& mesh, const FlatResult& map, std::size_t face)
{
	const Triangle& t = mesh.triangles[face];
	return quasiConformalDistortion(
		{mesh.positions[at(t[0])], mesh.positions[at(t[1])], mesh.positions[at(t[2])]},
		map.uv[face]);
}

std::size_t overlapsIn(const FlatMesh& mesh)
{
	std::size_t pairs = 0;
	const int last = *std::max_element(mesh.chart.begin(), mesh.chart.end());
	for (const std::vector<int>& triangles : mesh.trianglesByChart(positionOf(last + 1)))
		pairs += overlappingPairs(mesh.part(triangles)).size();
	return pairs;
}

FlatResult run(const SurfaceMesh& mesh, const Options& options, const VertexInput& input)
{
	OpenedMesh opened;
	Parametrization map = chartsInPlane(mesh, input, options, opened);
	return withInputIndices(mesh, opened, std::move(map));
}

FlatResult
runInDisk(const SurfaceMesh& mesh, const HyperbolicOptions& options, const VertexInput& input)
{
	OpenedMesh opened;
	Parametrization map = chartsInDisk(mesh, input, options, opened);
	return withInputIndices(mesh, opened, std::move(map));
}

VertexInput selecting(const SurfaceMesh& mesh, const std::vector<int>& vertices)
{
	VertexInput input;
	input.selected.assign(mesh.positions.size(), 0);
	for (int v : vertices)
		input.selected[at(v)] = 1;
	return input;
}

Options fixedTriangulation(TargetCurvature target)
{
	Options options;
	options.target = target;
	options.method = Method::FixedTriangles;
	return options;
}

std::string reason(const SurfaceMesh& mesh, const Options& options, const VertexInput& input)
{
	try {
		run(mesh, options, input);
	}
	catch (const Error& error) {
		return error.what();
	}
	return {};
}

} // namespace ricci::testing
