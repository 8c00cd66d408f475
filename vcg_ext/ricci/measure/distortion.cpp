// SPDX-License-Identifier: GPL-3.0-or-later
#include "distortion.h"

#include "../base/indexed.h"
#include "../base/numbers.h"
#include "../base/parallel.h"
#include "../base/tolerances.h"
#include "../layout/hyperbolic_layout.h"
#include "../metric/area.h"
#include "../numerics/disk_isometry.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <utility>

namespace ricci {

namespace {

/// Of the root of a surface's area: a texel of the largest texture, of 16384 texels, whose charts fill it.
constexpr double kTexel = 0x1p-14;

/// The apex is no number where the base is 0.
TriangleShape shapeOf(const std::array<Point3, 3>& p)
{
	const Point3 a = p[1] - p[0], b = p[2] - p[0], normal = cross(a, b);
	const double base = length(a);
	return {base, {dot(a, b) / base, std::hypot(normal[0], normal[1], normal[2]) / base}};
}

double distortionOf(const TriangleShape& own, const Triangle2& plane)
{
	const double longest = own.longestSide();
	if (!(own.base > 0.0 && own.base * own.apex.imag() > kTiny * longest * longest))
		return std::numeric_limits<double>::quiet_NaN();
	// The map z -> alpha z + beta conj(z) sends base to b and the apex to c.
	const std::complex<double> b(plane[1][0] - plane[0][0], plane[1][1] - plane[0][1]);
	const std::complex<double> c(plane[2][0] - plane[0][0], plane[2][1] - plane[0][1]);
	const std::complex<double> alongBase = b / own.base;
	const std::complex<double> across = (c - alongBase * own.apex.real()) / own.apex.imag();
	const std::complex<double> i(0.0, 1.0);
	const double alpha = std::abs(alongBase - i * across);
	const double beta = std::abs(alongBase + i * across);
	const double smaller = std::abs(alpha - beta);
	return smaller > 0.0 ? (alpha + beta) / smaller : kInfinity;
}

int orientationInDisk(const Triangle2& p)
{
	return hyperbolicOrientation(asComplex(p[0]), asComplex(p[1]), asComplex(p[2]));
}

/// The flat triangle whose sides are the chords of a geodesic triangle of the disk, with the
/// triangle's orientation. Where no flat triangle has these sides its height is 0.
Triangle2 chordTriangle(const Triangle2& p)
{
	const std::complex<double> x = asComplex(p[0]), y = asComplex(p[1]), z = asComplex(p[2]);
	const double base = chordLength(x, y), left = chordLength(x, z), right = chordLength(y, z);
	if (!(base > 0.0))
		return {};
	const auto [along, height] = triangleApex(base, left, right);
	return {{{0.0, 0.0}, {base, 0.0}, {along, orientationInDisk(p) < 0 ? -height : height}}};
}

} // namespace

double triangleArea(const std::array<Point3, 3>& p)
{
	const TriangleShape shape = shapeOf(p);
	return shape.base > 0.0 ? shape.area() : 0.0;
}

std::vector<double> triangleAreas(
	const std::vector<Point3>& positions,
	const std::vector<Triangle>& triangles,
	const std::vector<std::array<double, 3>>& lengths)
{
	std::vector<double> areas;
	areas.reserve(triangles.size());
	for (const std::array<double, 3>& sides : lengths)
		areas.push_back(euclideanArea(sides));
	for (std::size_t f = areas.size(); f < triangles.size(); ++f) {
		const Triangle& t = triangles[f];
		areas.push_back(triangleArea(
			{positions[positionOf(t[0])],
			 positions[positionOf(t[1])],
			 positions[positionOf(t[2])]}));
	}
	return areas;
}

double quasiConformalDistortion(const std::array<Point3, 3>& surface, const Triangle2& plane)
{
	return distortionOf(shapeOf(surface), plane);
}

double percentile(std::vector<double> values, double share)
{
	if (values.empty())
		return std::numeric_limits<double>::quiet_NaN();
	const double rank = std::ceil(share * static_cast<double>(values.size())) - 1.0;
	const auto nth = values.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 0.0));
	std::nth_element(values.begin(), nth, values.end());
	return *nth;
}

namespace {

/// What a map of triangles does to their areas, each relative to its total. Of the report, nothing else is set.
/// \param before, after [triangle] areas, not negative. Triangles where either is 0 are left out,
/// of the totals too, and those whose shares of the totals are below the normal numbers.
DistortionReport areaDistortion(const std::vector<double>& before, const std::vector<double>& after)
{
	double totalBefore = 0.0, totalAfter = 0.0;
	const auto counts = [&](std::size_t f) { return before[f] > 0.0 && after[f] > 0.0; };
	for (std::size_t f = 0; f < before.size(); ++f)
		if (counts(f)) {
			totalBefore += before[f];
			totalAfter += after[f];
		}
	DistortionReport distortion;
	if (!(totalBefore > 0.0))
		return distortion;
	double mean = 0.0, logMean = 0.0, logSquare = 0.0;
	for (std::size_t f = 0; f < before.size(); ++f) {
		const double weight = before[f] / totalBefore, share = after[f] / totalAfter;
		if (!counts(f) || std::min(weight, share) < std::numeric_limits<double>::min())
			continue;
		const double logFactor = std::log(share) - std::log(weight);
		distortion.areaFactors.push_back(logFactor / std::log(2.0));
		mean += weight * std::exp(std::abs(logFactor));
		logMean += weight * logFactor;
		logSquare += weight * logFactor * logFactor;
	}
	distortion.areaDistortionMean = mean;
	distortion.areaDistortionSpread = std::sqrt(std::max(0.0, logSquare - logMean * logMean));
	return distortion;
}

/// \param own own(triangle) on the surface
template<class Own>
DistortionReport measured(
	const Array<Triangle>& vertices,
	const Own& own,
	const Array<Triangle2>& plane,
	std::vector<double>& vertexQC)
{
	const std::vector<Triangle>& triangles = vertices.values();
	std::vector<double> faceQC(triangles.size());
	std::vector<double> ringArea(vertexQC.size(), 0.0), measured;
	double sum = 0.0, areaSum = 0.0, weightedSum = 0.0;
	std::vector<double> areaBefore(triangles.size(), 0.0), areaAfter = areaBefore;
	inParallel(vertices.size(), defaultThreads(), [&](int first, int last) {
		for (std::size_t f = positionOf(first); f < positionOf(last); ++f) {
			const TriangleShape triangle = own(f);
			faceQC[f] = distortionOf(triangle, plane.values()[f]);
			if (!std::isfinite(faceQC[f]))
				continue;
			areaBefore[f] = triangle.area();
			areaAfter[f] = 0.5 * std::abs(doubledArea(plane.values()[f]));
		}
	});
	for (std::size_t f = 0; f < triangles.size(); ++f) {
		const double qc = faceQC[f], area = areaBefore[f];
		if (!std::isfinite(qc))
			continue;
		measured.push_back(qc);
		sum += qc;
		areaSum += area;
		weightedSum += area * qc;
		for (const int v : triangles[f]) {
			vertexQC[positionOf(v)] += area * qc;
			ringArea[positionOf(v)] += area;
		}
	}
	DistortionReport result = areaDistortion(areaBefore, areaAfter);
	double vertexSum = 0.0;
	std::vector<double> measuredVertices;
	for (std::size_t v = 0; v < vertexQC.size(); ++v) {
		if (ringArea[v] > 0.0) {
			vertexQC[v] /= ringArea[v];
			vertexSum += vertexQC[v];
			measuredVertices.push_back(vertexQC[v]);
		}
		else
			vertexQC[v] = 1.0;
	}
	if (measured.empty())
		return result;
	result.qcMean = sum / static_cast<double>(measured.size());
	result.qcAreaMean = weightedSum / areaSum;
	result.qcVertexMean = vertexSum / static_cast<double>(measuredVertices.size());
	result.qcValues = std::move(measuredVertices);
	result.qcMax = *std::max_element(measured.begin(), measured.end());
	result.qcP99 = percentile(std::move(measured), 0.99);
	return result;
}

} // namespace

DistortionReport measureDistortion(
	const Array<Triangle>& vertices,
	const std::vector<Point3>& surface,
	const Array<Triangle2>& plane,
	std::vector<double>& vertexQC)
{
	const auto own = [&](std::size_t f) {
		const Triangle& t = vertices.values()[f];
		return shapeOf(
			{surface[positionOf(t[0])], surface[positionOf(t[1])], surface[positionOf(t[2])]});
	};
	vertexQC.assign(surface.size(), 0.0);
	return measured(vertices, own, plane, vertexQC);
}

DistortionReport measureDistortion(
	const FlatMesh& mesh, const Array<Triangle2>& plane, std::vector<double>& vertexQC)
{
	const auto own = [&](std::size_t f) -> TriangleShape {
		const std::array<double, 3>& sides = mesh.lengths.values()[f];
		return {sides[0], asComplex(triangleApex(sides[0], sides[2], sides[1]))};
	};
	vertexQC.assign(mesh.source.values().size(), 0.0);
	return measured(mesh.vertices, own, plane, vertexQC);
}

double scalesApart(const DistortionReport& distortion)
{
	const std::vector<double>& factors = distortion.areaFactors;
	if (factors.empty())
		return 0.0;
	const auto [least, most] = std::minmax_element(factors.begin(), factors.end());
	return std::round(0.5 * std::log10(2.0) * (*most - *least));
}

Array<Triangle2> chordTriangles(const FlatMesh& mesh)
{
	Array<Triangle2> chords;
	for (const int f : mesh.points.indices())
		chords.push_back(chordTriangle(mesh.at(f)));
	return chords;
}

int flippedInDisk(const FlatMesh& mesh)
{
	int flipped = 0;
	for (const int f : mesh.points.indices())
		flipped += orientationInDisk(mesh.at(f)) <= 0;
	return flipped;
}

int countFlipped(const FlatMesh& mesh)
{
	int flipped = 0;
	for (const int f : mesh.points.indices())
		flipped += orientation(mesh.at(f)) <= 0;
	return flipped;
}

int countFlippedByRounding(const FlatMesh& mesh)
{
	const auto rounded = [](const Point2& p) {
		return Point2{roundedToFloat(p[0]), roundedToFloat(p[1])};
	};
	int flipped = 0;
	for (const int f : mesh.points.indices()) {
		const Triangle2 p = mesh.at(f);
		flipped +=
			orientation(p) > 0 && orientation(rounded(p[0]), rounded(p[1]), rounded(p[2])) <= 0;
	}
	return flipped;
}

std::vector<int> unseenTriangles(const FlatMesh& mesh)
{
	const double area = mesh.area(), least = kTexel * std::sqrt(area);
	std::vector<std::pair<double, int>> low; // heights
	for (const int f : mesh.points.indices()) {
		const std::array<double, 3>& l = mesh.lengths[f];
		const double doubled = 2.0 * euclideanArea(l), longest = std::max({l[0], l[1], l[2]});
		if (doubled < least * longest && doubled > kTiny * longest * longest)
			low.emplace_back(doubled / longest, f);
	}
	std::sort(low.begin(), low.end());
	double own = 0.0;
	std::vector<int> unseen;
	for (const auto& [height, f] : low) {
		own += euclideanArea(mesh.lengths[f]);
		if (!(own < kTexel * area))
			break;
		unseen.push_back(f);
	}
	std::sort(unseen.begin(), unseen.end());
	return unseen;
}

std::array<double, 3> stretchIntegrals(const FlatMesh& mesh)
{
	double forth = 0.0, back = 0.0, area = 0.0;
	const std::vector<int> unseen = unseenTriangles(mesh);
	auto next = unseen.begin();
	for (const int f : mesh.points.indices()) {
		if (next != unseen.end() && *next == f) {
			++next;
			continue;
		}
		const auto [ahead, behind] = mesh.stretch(f);
		forth += ahead;
		back += behind;
		if (behind > 0.0)
			area += euclideanArea(mesh.lengths[f]);
	}
	return {forth, back, area};
}

double stretchEnergy(const FlatMesh& mesh)
{
	const auto [forth, back, total] = stretchIntegrals(mesh);
	if (!(back < kInfinity))
		return back;
	return total > 0.0 ? energyAtBestScale(forth, back, total) : 4.0;
}

MapCost costOf(const FlatMesh& mesh, double seamLength)
{
	const double area = mesh.area();
	return {stretchEnergy(mesh), area > 0.0 ? seamLength / std::sqrt(area) : 0.0};
}

} // namespace ricci
