// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/listener.h"
#include "support/random.h"
#include "support/shapes.h"

#include <ricci/finish/finish.h>
#include <ricci/math/orientation.h>
#include <ricci/measure/distortion.h>
#include <ricci/surface/opened_mesh.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <stdexcept>
#include <vector>

namespace ricci::testing {
namespace {

constexpr int kSide = 8; // cells of a square
constexpr double kStep = 1.0 / kSide;

/// A flat square with a layout of its own triangles, that need not be cut.
struct LaidOut
{
	FlowDomain domain;
	EdgeArray<char> isCut;
	VertexArray<char> cones;
	PlanarLayout layout;

	/// \param place [vertex] in the plane
	template<class Place>
	explicit LaidOut(const Place& place)
	{
		const SurfaceMesh mesh = rectangle(kSide, kSide, 1.0, 1.0);
		domain.surface = embeddedSurface(VertexArray<Point3>(mesh.positions), mesh.triangles);
		const Triangulation& t = domain.surface.triangulation;
		isCut.assign(t.edgeCount(), 0);
		cones.assign(t.vertexCount(), 0);
		layout.wedges = cornerWedges(t, isCut);
		layout.points.resize(layout.wedges.count);
		for (const Halfedge h : t.interiorHalfedges())
			layout.points[layout.wedges.of[h]] = place(t.origin(h));
	}

	Point2 onSurface(Vertex v) const
	{
		const Point3& p = domain.surface.positions[v];
		return {p[0], p[1]};
	}

	Point2 inPlane(Vertex v) const
	{
		const Triangulation& t = domain.surface.triangulation;
		for (const Halfedge h : t.interiorHalfedges())
			if (t.origin(h) == v)
				return layout[h];
		return {};
	}

	std::vector<Triangle2> triangles() const
	{
		std::vector<Triangle2> plane;
		for (const Face f : domain.surface.triangulation.faces()) {
			const auto h = domain.surface.triangulation.halfedges(f);
			plane.push_back({layout[h[0]], layout[h[1]], layout[h[2]]});
		}
		return plane;
	}

	FinishCounts finish(
		bool freeBoundary, Finish how)
	{
		return finishMap(domain, isCut, cones, freeBoundary, how, layout);
	}
};

int notCounterClockwise(const std::vector<Triangle2>& plane)
{
	int count = 0;
	for (const Triangle2& p : plane)
		count += orientation(p[0], p[1], p[2]) != 1;
	return count;
}

bool isBorder(int v)
{
	const int i = v % (kSide + 1), j = v / (kSide + 1);
	return i == 0 || j == 0 || i == kSide || j == kSide;
}

Point2 gridPoint(Vertex v)
{
	return {kStep * (v.number() / (kSide + 1)), kStep * (v.number() % (kSide + 1))};
}

constexpr int kMiddle = (kSide / 2) * (kSide + 1) + kSide / 2;

/// The square with its middle moved \p by cells to the right.
Point2 folded(Vertex v, double by)
{
	Point2 p = gridPoint(v);
	if (v.number() == kMiddle)
		p[0] += by * kStep;
	return p;
}

TEST(FinishMap, LeavesASoundMapAsItIs)
{
	LaidOut map(gridPoint);
	const std::vector<Point2> before = map.layout.points.values();
	const FinishCounts counts = map.finish(true, Finish::Repair);
	EXPECT_EQ(counts.moved, 0);
	EXPECT_EQ(counts.left, 0);
	EXPECT_EQ(map.layout.points.values(), before);
}

TEST(FinishMap, RepairsATurnedTriangleAndCountsWhatItMoved)
{
	LaidOut map([](Vertex v) { return folded(v, 1.6); });
	ASSERT_GT(notCounterClockwise(map.triangles()), 0);
	const std::vector<Point2> before = map.layout.points.values();
	const FinishCounts counts = map.finish(false, Finish::Repair);
	EXPECT_EQ(notCounterClockwise(map.triangles()), 0);
	EXPECT_EQ(counts.left, 0);
	int moved = 0;
	for (const int p : map.layout.points.indices())
		moved += map.layout.points[p] != before[at(p)];
	EXPECT_EQ(counts.moved, moved);
	EXPECT_GT(moved, 0);
	for (const Vertex v : map.domain.surface.triangulation.vertices())
		if (isBorder(v.number())) {
			EXPECT_EQ(map.inPlane(v), gridPoint(v));
		}
}

/// A sheared square has an isometric map of all its faces, which is that of no distortion: it is found
/// where the boundary moves. Where it is kept, distortion stays.
TEST(FinishMap, OfLeastDistortionIsConformalWhereTheSurfaceIsFlat)
{
	const auto sheared = [](Vertex v) {
		const Point2 p = gridPoint(v);
		return Point2{p[0] + 0.7 * p[1], p[1]};
	};
	const double qc =
		quasiConformalDistortion({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {{{0, 0}, {1, 0}, {0.7, 1}}});
	for (const bool freeBoundary : {true, false}) {
		LaidOut map(sheared);
		const FinishCounts counts = map.finish(freeBoundary, Finish::LeastDistortion);
		EXPECT_EQ(counts.left, 0);
		double mean = 0.0;
		const std::vector<Triangle2> plane = map.triangles();
		const Triangulation& t = map.domain.surface.triangulation;
		for (const Face f : t.faces()) {
			const auto v = t.vertices(f);
			const auto& x = map.domain.surface.positions;
			mean +=
				quasiConformalDistortion({x[v[0]], x[v[1]], x[v[2]]}, plane[at(f)]) / t.faceCount();
		}
		if (freeBoundary) {
			EXPECT_LT(mean - 1.0, 0.01 * (qc - 1.0));
		}
		else {
			EXPECT_GT(mean - 1.0, 0.1 * (qc - 1.0));
			EXPECT_EQ(notCounterClockwise(plane), 0);
			for (const Vertex v : t.vertices())
				if (isBorder(v.number())) {
					EXPECT_EQ(map.inPlane(v), sheared(v));
				}
		}
	}
}

TEST(FinishMap, CanBeCancelled)
{
	LaidOut map([](Vertex v) { return folded(v, 1.6); });
	Listener impatient(1);
	EXPECT_THROW(heard(impatient, [&] { map.finish(false, Finish::Repair); }), Cancelled);
}

/// A square inside the unit disk.
Point2 inDisk(Vertex v, double by)
{
	const Point2 p = folded(v, by);
	return {1.2 * (p[0] - 0.5), 1.2 * (p[1] - 0.5)};
}

TEST(FinishDisk, RepairsInsideTheDisk)
{
	for (const bool freeBoundary : {false, true}) {
		LaidOut map([](Vertex v) { return inDisk(v, 1.6); });
		ASSERT_GT(notCounterClockwise(map.triangles()), 0);
		const FinishCounts counts = finishDisk(map.domain, freeBoundary, map.layout);
		EXPECT_EQ(counts.left, 0);
		EXPECT_GT(counts.moved, 0);
		EXPECT_EQ(notCounterClockwise(map.triangles()), 0);
		for (const Vertex v : map.domain.surface.triangulation.vertices()) {
			EXPECT_LT(std::abs(asComplex(map.inPlane(v))), 1.0);
			if (isBorder(v.number())) {
				EXPECT_EQ(map.inPlane(v), inDisk(v, 0.0)); // what is inside was enough
			}
		}
	}
}

/// The triangles of the square as a refinement of themselves.
CommonRefinement refinementOf(const LaidOut& map)
{
	CommonRefinement refinement;
	const Triangulation& t = map.domain.surface.triangulation;
	for (const Vertex v : t.vertices())
		refinement.points.push_back({{v.number(), 0, 0, 0}, {1, 0, 0, 0}});
	for (const Face f : t.faces()) {
		const auto v = t.vertices(f);
		refinement.triangles.push_back({v[0].number(), v[1].number(), v[2].number()});
		refinement.inputFace.push_back(f);
	}
	refinement.uv = map.triangles();
	return refinement;
}

TEST(FinishDisk, RepairsARefinementAndLeavesASoundOne)
{
	const LaidOut sound([](Vertex v) { return inDisk(v, 0.0); });
	CommonRefinement refinement = refinementOf(sound);
	const FinishCounts none = finishDisk(sound.domain, false, refinement);
	EXPECT_EQ(none.moved, 0);
	EXPECT_EQ(none.left, 0);
	EXPECT_EQ(refinement.uv, sound.triangles());

	const LaidOut map([](Vertex v) { return inDisk(v, 1.6); });
	refinement = refinementOf(map);
	const FinishCounts counts = finishDisk(map.domain, false, refinement);
	EXPECT_GT(counts.moved, 0);
	EXPECT_EQ(counts.left, 0);
	EXPECT_EQ(notCounterClockwise(refinement.uv), 0);
	// Corners that met still meet, and the border stays.
	std::vector<Point2> places(refinement.points.size(), {2.0, 2.0});
	for (std::size_t f = 0; f < refinement.uv.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k) {
			const int v = refinement.triangles[f][k];
			if (places[at(v)][0] > 1.0)
				places[at(v)] = refinement.uv[f][k];
			EXPECT_EQ(places[at(v)], refinement.uv[f][k]);
			if (isBorder(v)) {
				EXPECT_EQ(refinement.uv[f][k], inDisk(Vertex(v), 0.0));
			}
		}
}

} // namespace
} // namespace ricci::testing
