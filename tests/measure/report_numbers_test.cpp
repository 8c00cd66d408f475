// SPDX-License-Identifier: GPL-3.0-or-later
// What the report says of a map, measured on the map itself by other formulas. parametrize_hyperbolic_test.cpp has maps
// to the disk.
#include "support/flat_map.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/parametrize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

struct Case
{
	std::string name;
	SurfaceMesh mesh;
	Options options;
	VertexInput input;
};

std::vector<Case> cases()
{
	Random random(700);
	std::vector<Case> all;
	const auto add = [&](std::string name, SurfaceMesh mesh) -> Case& {
		all.push_back({std::move(name), std::move(mesh), {}, {}});
		return all.back();
	};
	const SurfaceMesh slab = shaken(perforatedSlab(2, 3), 0.05, random);
	const SurfaceMesh hill = sphereWithTube(0.3, 1.0, 0.5, 12, 16);
	add("slab", slab);
	add("hill", hill);
	add("unfolded", perforatedSlab(1, 2));
	add("two surfaces, one unused vertex", sideBySide(hill, bumpyTorus(12, 9, random), 9.0))
		.mesh.positions.push_back({0, 0, 0});
	for (const Finish finish : {Finish::None, Finish::Repair, Finish::LeastStretch})
		add("finish", hill).options.finish = finish;
	for (const Method method : {Method::FixedTriangles, Method::EdgeSwaps, Method::Thurston})
		add("method", shaken(rectangle(9, 9, 9, 9), 0.2, random)).options.method = method;
	for (const TargetCurvature target : {TargetCurvature::Disk, TargetCurvature::Rectangle})
		add("disk", sliverDisk(7, 1.0, random)).options.target = target;
	for (int i = 0; i < 3; ++i) {
		Case& folded = add("folded", foldedTorus(4, 4, 0.1, random)); // with flipped faces
		folded.options.target = TargetCurvature::Flat;
		folded.options.finish = Finish::None;
	}
	Case& cones = add("cones", slab);
	cones.options.target = TargetCurvature::SelectedCones;
	cones.input = selecting(slab, {3, 50, 99});
	Case& refined = add("refined", hill);
	refined.options.output = OutputTriangulation::CommonRefinement;
	Case& seams = add("seams", bumpyTorus(12, 9, random));
	seams.mesh.seam.assign(seams.mesh.triangles.size(), {0, 0, 0});
	for (std::size_t f = 0; f < 18; f += 2)
		seams.mesh.seam[f][2] = 1; // once round the tube
	add("refined components", sideBySide(hill, slab, 9.0)).options.output =
		OutputTriangulation::CommonRefinement;
	// Its faces have the size of a few steps of floats, which turn some round.
	add("one much smaller", sideBySide(slab, scaled(slab, 1e-3), 9.0));
	Case& unscaled = add("unscaled", sideBySide(hill, scaled(hill, 0.1), 5.0));
	unscaled.options.normalizeUV = false;
	return all;
}

bool isFlipped(const Triangle2& t)
{
	return !(doubledArea(t[0], t[1], t[2]) > 0.0);
}

Triangle2 asFloats(Triangle2 t)
{
	for (Point2& p : t)
		for (double& x : p)
			x = static_cast<double>(static_cast<float>(x));
	return t;
}

/// The values at vertices, their mean over the vertices of faces, and the percentile of the faces'.
void expectVertexValues(const Parametrization& map, const Distortion& found)
{
	std::vector<double> qc(map.vertexQC.size(), 0.0), area = qc;
	for (const int f : map.mesh.points.indices())
		for (const int v : map.mesh.vertices[f])
			if (std::isfinite(found.qc[at(f)])) {
				qc[at(v)] += found.area[at(f)] * found.qc[at(f)];
				area[at(v)] += found.area[at(f)];
			}
	double mean = 0.0, count = 0.0;
	for (std::size_t v = 0; v < qc.size(); ++v)
		if (area[v] > 0.0) {
			EXPECT_NEAR(map.vertexQC[v], qc[v] / area[v], 1e-6 * qc[v] / area[v]);
			mean += qc[v] / area[v];
			count += 1.0;
		}
	if (map.report.chosenSeamEdges == 0) { // else vertices on the seam count once for each side
		EXPECT_NEAR(map.report.qcVertexMean, mean / count, 1e-9 * mean / count);
	}
	std::vector<double> sorted = found.qc;
	std::sort(sorted.begin(), sorted.end());
	const auto rank = static_cast<std::size_t>(0.99 * static_cast<double>(sorted.size()));
	EXPECT_GE(map.report.qcP99, sorted[rank - 1] * (1 - 1e-9));
	EXPECT_LE(map.report.qcP99, sorted[std::min(rank + 1, sorted.size() - 1)] * (1 + 1e-9));
}

TEST(ReportNumbers, AreThoseOfTheMap)
{
	int flipped = 0, seams = 0;
	for (const Case& c : cases()) {
		SCOPED_TRACE(c.name);
		const Parametrization map = parametrizeEuclidean(c.mesh, c.input, c.options);
		const Report& r = map.report;
		const Distortion found(c.mesh, map);
		const auto surface = inSpace(c.mesh, map);
		const auto expectNear = [](double value, double own) {
			EXPECT_NEAR(value / own, 1.0, 1e-6);
		};
		expectNear(r.qcMean, found.qcMean);
		expectNear(r.qcAreaMean, found.qcAreaMean);
		expectNear(r.qcMax, found.qcMax);
		expectNear(r.areaDistortionMean, found.areaMean);
		EXPECT_NEAR(r.areaDistortionSpread, found.areaSpread, 1.1e-6);
		expectVertexValues(map, found);
		expectNear(*r.stretch, found.stretch);
		int reversed = 0, byRounding = 0;
		double covered = 0.0;
		for (const int f : map.mesh.points.indices()) {
			const Triangle2 p = map.mesh.at(f);
			const std::array<Point3, 3>& face = surface[at(f)];
			reversed += isFlipped(p);
			byRounding += !isFlipped(p) && isFlipped(asFloats(p));
			covered += 0.5 * std::abs(doubledArea(p));
			for (std::size_t k = 0; k < 3; ++k)
				EXPECT_NEAR(map.mesh.lengths[f][k], distance(face[k], face[(k + 1) % 3]), 1e-9);
		}
		EXPECT_EQ(r.flippedFaces, reversed);
		EXPECT_EQ(r.flippedByRounding, byRounding);
		flipped += reversed;

		// Seams: edges whose two sides are not joined.
		std::map<std::pair<int, int>, std::vector<Corner>> sides;
		for (const int f : map.mesh.points.indices())
			for (const Corner side : cornersOf(f))
				sides[std::minmax(map.mesh.vertices[side], map.mesh.vertices[side.next()])]
					.push_back(side);
		int edges = 0;
		double length = 0.0, area = 0.0;
		for (const auto& [ends, both] : sides) {
			if (both.size() != 2)
				continue;
			const auto &points = map.mesh.points, &vertices = map.mesh.vertices;
			const bool isSame = vertices[both[0]] == vertices[both[1]];
			const Corner a = isSame ? both[1] : both[1].next(),
						 b = isSame ? both[1].next() : both[1];
			if (points[both[0]] == points[a] && points[both[0].next()] == points[b])
				continue;
			length += map.mesh.lengths[both[0].face()][both[0].index()];
			++edges;
		}
		seams += edges;
		if (c.options.output ==
			OutputTriangulation::KeepMesh) { // else edges of the mesh are counted
			EXPECT_EQ(r.seamEdges + r.chosenSeamEdges + r.overlapCuts, edges);
		}
		for (const double x : found.area)
			area += x;
		EXPECT_NEAR(r.seamLength + r.chosenSeamLength, length, 1e-9 * (1.0 + length));
		EXPECT_NEAR(r.seamLengthRelative, r.seamLength / std::sqrt(area), 1e-9);
		const double price = length / std::sqrt(area) / 20.0; // of the seams
		EXPECT_NEAR(r.objective.value_or(0.0) / (*r.stretch + price), 1.0, 1e-9);
		EXPECT_EQ(at(r.charts), std::set<int>(map.mesh.chart.begin(), map.mesh.chart.end()).size());
		if (c.options.normalizeUV) {
			EXPECT_NEAR(r.occupancy, covered, 1e-9);
		}
	}
	EXPECT_GT(seams, 500);
	EXPECT_GT(flipped, 0);
}

} // namespace
} // namespace ricci::testing
