// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat_map.h"

#include "shapes.h"

#include <ricci/charts/chart_overlap.h>
#include <ricci/error.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ricci::testing {

FlatResult withCorners(const SurfaceMesh& mesh, Parametrization map)
{
	FlatResult result{std::move(map), UV(mesh.triangles.size())};
	for (const int f : result.mesh.points.indices())
		for (const Corner c : cornersOf(f))
			for (std::size_t k = 0; k < 3; ++k)
				if (mesh.triangles[at(result.mesh.face[f])][k] == result.mesh.vertices[c])
					result.uv[at(result.mesh.face[f])][k] = result.mesh.at(c);
	return result;
}

std::vector<std::array<Point3, 3>> inSpace(const SurfaceMesh& mesh, const Parametrization& map)
{
	const std::vector<Point3> places = map.mesh.onSurface(mesh.positions);
	std::vector<std::array<Point3, 3>> triangles;
	for (const Triangle& t : map.mesh.vertices)
		triangles.push_back({places[at(t[0])], places[at(t[1])], places[at(t[2])]});
	return triangles;
}

Distortion::Distortion(const std::vector<std::array<Point3, 3>>& from, const UV& to)
{
	std::vector<double> after, larger; // singular value
	double total = 0.0, totalAfter = 0.0;
	for (std::size_t f = 0; f < to.size(); ++f) {
		// The triangle in a plane of its own, and the map z -> a z + b conj(z) of its sides.
		const Point3 u = from[f][1] - from[f][0], v = from[f][2] - from[f][0];
		const double x = length(u);
		const std::complex<double> w{dot(u, v) / x, length(cross(u, v)) / x};
		const auto p = asComplex(to[f][1] - to[f][0]), q = asComplex(to[f][2] - to[f][0]);
		const std::complex<double> along = p / x; // a + b
		const std::complex<double> a =
			(q - along * std::conj(w)) / std::complex<double>(0.0, 2.0 * w.imag());
		const std::complex<double> b = along - a;
		larger.push_back(std::abs(a) + std::abs(b));
		qc.push_back(larger.back() / std::abs(std::abs(a) - std::abs(b)));
		area.push_back(0.5 * x * w.imag());
		after.push_back(0.5 * std::abs(doubledArea(to[f])));
		total += area.back();
		totalAfter += after.back();
	}
	double mean = 0.0, square = 0.0, energy = 0.0, inverse = 0.0;
	for (std::size_t f = 0; f < to.size(); ++f) {
		const double share = area[f] / total, s = after[f] / totalAfter / share;
		qcMean += qc[f] / static_cast<double>(qc.size());
		qcAreaMean += share * qc[f];
		qcMax = std::max(qcMax, qc[f]);
		areaMean += share * std::max(s, 1.0 / s);
		mean += share * std::log(s);
		square += share * std::log(s) * std::log(s);
		const double squares = (1.0 + 1.0 / (qc[f] * qc[f])) * larger[f] * larger[f];
		energy += share * squares;
		inverse += share * squares / std::pow(larger[f] * larger[f] / qc[f], 2);
	}
	areaSpread = std::sqrt(std::max(0.0, square - mean * mean));
	stretch = 2.0 * std::sqrt(energy * inverse);
}

Distortion::Distortion(const SurfaceMesh& mesh, const Parametrization& map) :
		Distortion(inSpace(mesh, map), map.mesh.corners().values())
{
}

std::size_t overlapsIn(FlatMesh mesh)
{
	connect(mesh);
	std::size_t pairs = 0;
	const int last = *std::max_element(mesh.chart.begin(), mesh.chart.end());
	for (const std::vector<int>& triangles : mesh.trianglesByChart(at(last + 1)))
		pairs += OverlapSearch(mesh.part(triangles).corners()).pairs().size();
	return pairs;
}

FlatResult run(const SurfaceMesh& mesh, const Options& options, const VertexInput& input)
{
	Options unscaled = options;
	unscaled.normalizeUV = false;
	if (options.charts == Charts::CutForPacking)
		unscaled.charts = Charts::WithoutOverlap;
	return withCorners(mesh, parametrizeEuclidean(mesh, input, unscaled));
}

FlatResult
runInDisk(const SurfaceMesh& mesh, const HyperbolicOptions& options, const VertexInput& input)
{
	Parametrization map = parametrizeHyperbolic(mesh, input, options);
	const Array<int> chart = map.mesh.chartOfPoints();
	for (const int i : map.mesh.place.indices()) {
		const Chart& own = map.charts[at(chart[i])];
		const Point2 inDisk = (2.0 / own.box.width()) * (map.mesh.place[i] - own.box.centre());
		map.mesh.place[i] =
			own.middle < 0 ? inDisk : asPoint(rounded(own.place.inverse())(asComplex(inDisk)));
	}
	return withCorners(mesh, std::move(map));
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
