// SPDX-License-Identifier: GPL-3.0-or-later
// What the report says of a map, measured on the map itself by other formulas.
#include "support/bolza.h"
#include "support/flat_map.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/parametrize.h>

#include <Eigen/LU>
#include <Eigen/SVD>

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

/// A triangle by the lengths of its sides from corners 0 and 1, as the matrix of these two sides.
Eigen::Matrix2d bySides(double a, double b, double c)
{
	const double x = (a * a + c * c - b * b) / (2 * a), y = std::sqrt(c * c - x * x);
	Eigen::Matrix2d sides;
	sides << a, x, 0.0, y; // from corner 0 to 1 and to 2
	return sides;
}

template<class Point>
Eigen::Matrix2d flattened(const std::array<Point, 3>& p)
{
	return bySides(distance(p[0], p[1]), distance(p[1], p[2]), distance(p[2], p[0]));
}

/// Singular values and areas of the maps of the faces.
struct Numbers
{
	std::vector<double> qc, before, after, large, small; // [face]

	void add(const Eigen::Matrix2d& surface, const Eigen::Matrix2d& image)
	{
		const Eigen::JacobiSVD<Eigen::Matrix2d> svd(image * surface.inverse());
		large.push_back(svd.singularValues()[0]);
		small.push_back(svd.singularValues()[1]);
		qc.push_back(large.back() / small.back());
		before.push_back(0.5 * surface.determinant());
		after.push_back(0.5 * std::abs(image.determinant()));
	}

	/// Mean of f(face), weighted by the areas in space.
	template<class F>
	double mean(const F& f) const
	{
		double sum = 0.0, area = 0.0;
		for (std::size_t i = 0; i < qc.size(); ++i) {
			sum += before[i] * f(i);
			area += before[i];
		}
		return sum / area;
	}
};

std::array<Point3, 3> inSpace(const std::vector<Point3>& surface, const Triangle& t)
{
	return {surface[at(t[0])], surface[at(t[1])], surface[at(t[2])]};
}

/// Means over faces and vertices, and those of the area factors s: of max(s, 1/s) and the deviation of ln s.
void expectDistortion(const Numbers& n, const Parametrization& map, double tolerance)
{
	const Report& r = map.report;
	const auto expectNear = [&](double value, double own) {
		EXPECT_NEAR(value / own, 1.0, tolerance);
	};
	double sum = 0.0, before = 0.0, after = 0.0;
	std::vector<double> ring(map.vertexQC.size(), 0.0), area = ring;
	for (std::size_t f = 0; f < n.qc.size(); ++f) {
		sum += n.qc[f];
		before += n.before[f];
		after += n.after[f];
		for (const int v : map.mesh.vertices[static_cast<int>(f)]) {
			ring[at(v)] += n.before[f] * n.qc[f];
			area[at(v)] += n.before[f];
		}
	}
	std::vector<double> sorted = n.qc;
	std::sort(sorted.begin(), sorted.end());
	const auto count = static_cast<double>(sorted.size());
	expectNear(r.qcMean, sum / count);
	expectNear(r.qcAreaMean, n.mean([&](std::size_t i) { return n.qc[i]; }));
	expectNear(r.qcMax, sorted.back());
	expectNear(r.qcP99, sorted[static_cast<std::size_t>(std::ceil(0.99 * count)) - 1]);
	double rings = 0.0, used = 0.0;
	for (std::size_t v = 0; v < ring.size(); ++v) {
		const double own = area[v] > 0.0 ? ring[v] / area[v] : 1.0;
		expectNear(map.vertexQC[v], own);
		rings += area[v] > 0.0 ? own : 0.0;
		used += area[v] > 0.0;
	}
	if (r.chosenSeamEdges == 0) // else it runs over the copies of vertices on seams
		expectNear(r.qcVertexMean, rings / used);
	const auto factor = [&](std::size_t i) { return n.after[i] / after / (n.before[i] / before); };
	const auto log = [&](std::size_t i) { return std::log(factor(i)); };
	expectNear(r.areaDistortionMean, n.mean([&](std::size_t i) {
		return std::max(factor(i), 1.0 / factor(i));
	}));
	const double mean = n.mean(log);
	EXPECT_NEAR(
		r.areaDistortionSpread,
		std::sqrt(n.mean([&](std::size_t i) { return std::pow(log(i) - mean, 2); })),
		1e-7 + tolerance);
}

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

TEST(ReportNumbers, AreThoseOfTheMap)
{
	int flipped = 0, seams = 0;
	for (const Case& c : cases()) {
		SCOPED_TRACE(c.name);
		const Parametrization map = parametrizeEuclidean(c.mesh, c.input, c.options);
		const Report& r = map.report;
		const std::vector<Point3> surface = map.mesh.onSurface(c.mesh.positions);
		Numbers n;
		int reversed = 0, byRounding = 0;
		double covered = 0.0;
		for (const int f : map.mesh.points.indices()) {
			const Triangle2 p = map.mesh.at(f);
			const std::array<Point3, 3> face = inSpace(surface, map.mesh.vertices[f]);
			Eigen::Matrix2d image;
			image << p[1][0] - p[0][0], p[2][0] - p[0][0], p[1][1] - p[0][1], p[2][1] - p[0][1];
			n.add(flattened(face), image);
			reversed += isFlipped(p);
			byRounding += !isFlipped(p) && isFlipped(asFloats(p));
			covered += n.after.back();
			for (std::size_t k = 0; k < 3; ++k)
				EXPECT_NEAR(map.mesh.lengths[f][k], distance(face[k], face[(k + 1) % 3]), 1e-9);
		}
		expectDistortion(n, map, 1e-6);
		EXPECT_EQ(r.flippedFaces, reversed);
		EXPECT_EQ(r.flippedByRounding, byRounding);
		flipped += reversed;
		const double forth = n.mean(
			[&](std::size_t i) { return std::pow(n.large[i], 2) + std::pow(n.small[i], 2); });
		const double back = n.mean([&](std::size_t i) {
			return 1.0 / std::pow(n.large[i], 2) + 1.0 / std::pow(n.small[i], 2);
		});
		EXPECT_NEAR(r.stretch.value_or(0.0) / (2.0 * std::sqrt(forth * back)), 1.0, 1e-6);

		// Seams: edges whose two sides are not joined.
		std::map<std::pair<int, int>, std::vector<Corner>> sides;
		for (const int f : map.mesh.points.indices())
			for (const Corner side : cornersOf(f))
				sides[std::minmax(map.mesh.vertices[side], map.mesh.vertices[side.next()])]
					.push_back(side);
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
			++seams;
		}
		for (const double x : n.before)
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

/// Straight triangles with the chords of the hyperboloid model as sides, 2 sinh(d / 2), take the place of geodesic
/// ones.
TEST(ReportNumbers, OfTheDiskAreThoseOfTheChords)
{
	Random random(701);
	const SurfaceMesh slab = shaken(perforatedSlab(2, 3), 0.05, random);
	for (const SurfaceMesh& mesh :
		 {slab,
		  withoutStars(slab, {0}),
		  sideBySide(slab, withoutStars(shaken(perforatedSlab(1, 3), 0.05, random), {0, 40}), 9.0)})
		for (const Finish finish : {Finish::None, Finish::LeastDistortion}) {
			HyperbolicOptions options;
			options.finish = finish;
			const Parametrization map = parametrizeHyperbolic(mesh, {}, options);
			Numbers n;
			for (const int f : map.mesh.points.indices()) {
				const Box2& box = map.charts[at(map.mesh.chart[f])].box;
				std::array<double, 3> chord;
				std::array<BolzaSurface::Complex, 3> z;
				for (std::size_t k = 0; k < 3; ++k)
					z[k] = {
						2.0 * (map.mesh.at(f)[k][0] - box.centre()[0]) / box.width(),
						2.0 * (map.mesh.at(f)[k][1] - box.centre()[1]) / box.width()};
				for (std::size_t k = 0; k < 3; ++k)
					chord[k] =
						2.0 *
						std::sinh(0.5 * static_cast<double>(distanceInDisk(z[k], z[(k + 1) % 3])));
				n.add(
					flattened(inSpace(mesh.positions, map.mesh.vertices[f])),
					bySides(chord[0], chord[1], chord[2]));
			}
			expectDistortion(n, map, 1e-5);
		}
}

} // namespace
} // namespace ricci::testing
