// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/error.h>
#include <ricci/flow/target_curvature.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>
#include <string>

namespace ricci::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// A mesh with what chooseTarget() asks for.
struct Surface
{
	SurfaceMesh mesh;
	Triangulation t;
	Topology topology;
	std::vector<double> lengths;

	explicit Surface(SurfaceMesh m) :
			mesh(std::move(m)), t(static_cast<int>(mesh.positions.size()), mesh.triangles),
			topology(topologyOf(t)), lengths(edgeLengths(t, mesh.positions))
	{
	}

	TargetRequest request(TargetCurvature mode, const std::vector<int>& selected = {}) const
	{
		TargetRequest r;
		r.mode = mode;
		r.selected.assign(mesh.positions.size(), 0);
		for (int v : selected)
			r.selected[at(v)] = 1;
		r.prescribed.assign(mesh.positions.size(), 0.0);
		r.prescribedPrecision = std::numeric_limits<float>::epsilon();
		return r;
	}
	Target choose(const TargetRequest& r) const
	{
		return chooseTarget(t, topology, lengths, mesh.positions, r);
	}
	Target choose(TargetCurvature mode, const std::vector<int>& selected = {}) const
	{
		return choose(request(mode, selected));
	}
};

std::string number(double x)
{
	char text[32];
	std::snprintf(text, sizeof text, "%.9g", x);
	return text;
}

template<class ErrorType>
void expectRefusal(
	const Surface& surface, const TargetRequest& r, const std::vector<std::string>& parts)
{
	try {
		surface.choose(r);
		ADD_FAILURE() << "accepted";
	}
	catch (const ErrorType& error) {
		const std::string sentence = error.what();
		for (const std::string& part : parts)
			EXPECT_NE(sentence.find(part), std::string::npos)
				<< "'" << part << "' is missing in: " << sentence;
		EXPECT_EQ(sentence.back(), '.');
	}
}

bool isPrescribed(const Target& target)
{
	return std::count(target.fixed.begin(), target.fixed.end(), 1) == 0;
}

int cornerOf(const SurfaceMesh& mesh, double x, double y)
{
	for (std::size_t v = 0; v < mesh.positions.size(); ++v)
		if (mesh.positions[v][0] == x && mesh.positions[v][1] == y)
			return static_cast<int>(v);
	return -1;
}

const Surface& sphere()
{
	static const Surface s(perforatedSlab(0, 2));
	return s;
}
const Surface& flatDisk()
{
	static const Surface s(rectangle(5, 4, 5, 4));
	return s;
}
const Surface& annulus()
{
	static const Surface s(ring(1, 2, 9, 3));
	return s;
}
const Surface& torusSurface()
{
	static const Surface s(torus(3, 1, 9, 7));
	return s;
}
const Surface& genus2()
{
	static const Surface s(perforatedSlab(2, 1));
	return s;
}

TEST(Topology, OfSurfacesWithAndWithoutBoundary)
{
	const struct
	{
		const Surface& surface;
		int genus;
		std::size_t loops;
		const char* name;
	} cases[] = {
		{sphere(), 0, 0, "a closed surface of genus 0 (a sphere)"},
		{torusSurface(), 1, 0, "a closed surface of genus 1 (a torus)"},
		{genus2(), 2, 0, "a closed surface of genus 2"},
		{flatDisk(), 0, 1, "a disk"},
		{annulus(), 0, 2, "an annulus"}};
	for (const auto& c : cases) {
		EXPECT_EQ(c.surface.topology.genus, c.genus);
		EXPECT_EQ(c.surface.topology.loops.size(), c.loops);
		EXPECT_EQ(c.surface.topology.name(), c.name);
	}
	const Surface pierced(withoutStars(torus(3, 1, 9, 9), {0}));
	EXPECT_EQ(pierced.topology.name(), "a surface of genus 1 with 1 boundary loop");
}

TEST(Topology, LoopsHaveTheSurfaceOnTheirLeft)
{
	// Shoelace: the outer loop of a ring runs counter-clockwise, the inner one clockwise.
	std::vector<double> areas;
	for (const auto& loop : annulus().topology.loops) {
		double area = 0.0;
		for (std::size_t i = 0; i < loop.size(); ++i) {
			const Point3& p = annulus().mesh.positions[at(loop[i])];
			const Point3& q = annulus().mesh.positions[at(loop[(i + 1) % loop.size()])];
			area += 0.5 * (p[0] * q[1] - p[1] * q[0]);
		}
		areas.push_back(area);
	}
	std::sort(areas.begin(), areas.end());
	const double unitPolygon = 4.5 * std::sin(2 * kPi / 9);
	EXPECT_NEAR(areas[0], -unitPolygon, 1e-12);
	EXPECT_NEAR(areas[1], 4 * unitPolygon, 1e-12);
}

TEST(TargetCurvature, AutomaticByTopology)
{
	EXPECT_FALSE(isPrescribed(flatDisk().choose(TargetCurvature::Automatic)));
	for (const Surface* s : {&annulus(), &torusSurface()}) {
		const Target target = s->choose(TargetCurvature::Automatic);
		EXPECT_TRUE(isPrescribed(target));
		EXPECT_EQ(target.curvature.lpNorm<Eigen::Infinity>(), 0.0);
	}
	const Surface pierced(withoutStars(torus(3, 1, 9, 9), {0, 40}));
	const Target free = pierced.choose(TargetCurvature::Automatic);
	EXPECT_EQ(free.fixed, pierced.topology.boundary);
	for (const Surface* s : {&sphere(), &genus2()}) { // cones
		const Target target = s->choose(TargetCurvature::Automatic);
		EXPECT_TRUE(isPrescribed(target));
		EXPECT_NEAR(target.curvature.sum(), 2 * kPi * s->topology.eulerCharacteristic, 1e-11);
		EXPECT_LT(target.curvature.maxCoeff(), 2 * kPi);
	}
}

TEST(TargetCurvature, FreeBoundaryFixesTheBoundaryAndAsksForAFlatInside)
{
	const Target target = flatDisk().choose(TargetCurvature::Automatic);
	EXPECT_EQ(target.fixed, flatDisk().topology.boundary);
	for (std::size_t v = 0; v < target.fixed.size(); ++v)
		if (!target.fixed[v]) {
			EXPECT_EQ(target.curvature[static_cast<Eigen::Index>(v)], 0.0);
		}
}

TEST(TargetCurvature, PrescribedBoundariesObeyGaussBonnet)
{
	TargetRequest disk = flatDisk().request(TargetCurvature::Automatic);
	disk.freeBoundary = false;
	const Surface pierced(withoutStars(torus(3, 1, 9, 9), {0, 40}));
	TargetRequest holes = pierced.request(TargetCurvature::Automatic);
	holes.freeBoundary = false;
	const struct
	{
		const Surface& surface;
		TargetRequest request;
	} cases[] = {
		{flatDisk(), disk},
		{flatDisk(), flatDisk().request(TargetCurvature::Disk)},
		{flatDisk(), flatDisk().request(TargetCurvature::Rectangle)},
		{pierced, holes}};
	for (const auto& c : cases) {
		const Target target = c.surface.choose(c.request);
		EXPECT_TRUE(isPrescribed(target));
		EXPECT_NEAR(
			target.curvature.sum(), 2 * kPi * c.surface.topology.eulerCharacteristic, 1e-12);
		for (std::size_t v = 0; v < target.fixed.size(); ++v)
			if (!c.surface.topology.boundary[v]) {
				EXPECT_EQ(target.curvature[static_cast<Eigen::Index>(v)], 0.0);
			}
	}
}

TEST(TargetCurvature, FlatNeedsEulerCharacteristicZero)
{
	const TargetRequest onSphere = sphere().request(TargetCurvature::Flat);
	expectRefusal<InadmissibleCurvature>(sphere(), onSphere, {number(4 * kPi), "genus 0"});
	expectRefusal<InadmissibleCurvature>(
		genus2(), genus2().request(TargetCurvature::Flat), {number(-4 * kPi), "genus 2"});
	expectRefusal<InadmissibleCurvature>(
		flatDisk(), flatDisk().request(TargetCurvature::Flat), {number(2 * kPi), "a disk"});
}

TEST(TargetCurvature, DiskAndRectangleNeedADisk)
{
	for (TargetCurvature mode : {TargetCurvature::Disk, TargetCurvature::Rectangle})
		for (const Surface* s : {&annulus(), &torusSurface(), &sphere()})
			expectRefusal<InvalidOption>(
				*s, s->request(mode), {"needs a topological disk", s->topology.name()});
	EXPECT_TRUE(flatDisk().choose(TargetCurvature::Disk).circular);
}

TEST(TargetCurvature, RectangleCornersBySelection)
{
	const SurfaceMesh& mesh = flatDisk().mesh;
	const std::vector<int> corners{
		cornerOf(mesh, 0, 0), cornerOf(mesh, 3, 0), cornerOf(mesh, 5, 4), cornerOf(mesh, 0, 2)};
	const Target target = flatDisk().choose(TargetCurvature::Rectangle, corners);
	EXPECT_TRUE(target.isRectangle);
	for (int v = 0; v < static_cast<int>(mesh.positions.size()); ++v) {
		const bool corner = std::find(corners.begin(), corners.end(), v) != corners.end();
		EXPECT_EQ(target.curvature[v], corner ? kPi / 2 : 0.0);
	}
	// In boundary order, from anywhere.
	const auto first = std::find(corners.begin(), corners.end(), target.corners[0]);
	ASSERT_NE(first, corners.end());
	for (std::size_t k = 0; k < 4; ++k)
		EXPECT_EQ(
			target.corners[k],
			corners[(static_cast<std::size_t>(first - corners.begin()) + k) % 4]);
}

TEST(TargetCurvature, RectangleRefusesOtherSelections)
{
	const SurfaceMesh& mesh = flatDisk().mesh;
	const int a = cornerOf(mesh, 0, 0), b = cornerOf(mesh, 5, 0), c = cornerOf(mesh, 5, 4);
	const int inside = cornerOf(mesh, 2, 2), d = cornerOf(mesh, 0, 4);
	const auto request = [&](const std::vector<int>& selected) {
		return flatDisk().request(TargetCurvature::Rectangle, selected);
	};
	expectRefusal<InvalidOption>(
		flatDisk(), request({a, b, c}), {"four selected", "3 are selected"});
	expectRefusal<InvalidOption>(
		flatDisk(), request({a, b, c, d, inside}), {"four selected", "5 are selected"});
	expectRefusal<InvalidOption>(
		flatDisk(), request({a, b, c, inside}), {"on one boundary loop", "only 3"});
	const Surface triangle({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
	expectRefusal<InvalidOption>(
		triangle,
		triangle.request(TargetCurvature::Rectangle),
		{"four boundary vertices", "has 3"});
}

TEST(TargetCurvature, RectangleCornersByShape)
{
	// A rectangular patch, turned in space, bent a little, shuffled: its own four corners.
	Random random(90);
	for (int trial = 0; trial < 20; ++trial) {
		const int nx = 4 + random.index(8), ny = 4 + random.index(8);
		SurfaceMesh patch = rectangle(nx, ny, random.real(1, 4), random.real(1, 4));
		std::vector<std::size_t> wanted{0, at(ny), at(nx * (ny + 1)), at(nx * (ny + 1) + ny)};
		for (Point3& p : patch.positions)
			p[2] = 0.1 * std::sin(p[0] + 2 * p[1]);
		patch = turned(patch, {random.real(-3, 3), random.real(-3, 3), random.real(-3, 3)});
		const Renumbered other = renumbered(patch, random);
		const Surface surface(other.mesh);
		const Target target = surface.choose(TargetCurvature::Rectangle);
		std::set<int> found, expected;
		for (int v : target.corners)
			found.insert(other.vertex[at(v)]);
		for (std::size_t v : wanted)
			expected.insert(static_cast<int>(v));
		EXPECT_EQ(found, expected);
		// Boundary order.
		const auto& loop = surface.topology.loops.front();
		std::array<std::ptrdiff_t, 4> place;
		for (std::size_t k = 0; k < 4; ++k)
			place[k] = std::find(loop.begin(), loop.end(), target.corners[k]) - loop.begin();
		EXPECT_TRUE(std::is_sorted(place.begin(), place.end()));
	}
}

TEST(TargetCurvature, RectangleCornersOfARoundPatchAreFourDifferentVertices)
{
	for (int n : {4, 5, 7, 30}) { // a fan: every boundary vertex is like the others
		SurfaceMesh fan;
		fan.positions.push_back({0, 0, 0});
		for (int i = 0; i < n; ++i) {
			fan.positions.push_back({std::cos(2 * kPi * i / n), std::sin(2 * kPi * i / n), 0});
			fan.triangles.push_back({0, i + 1, (i + 1) % n + 1});
		}
		const Surface surface(fan);
		const Target target = surface.choose(TargetCurvature::Rectangle);
		EXPECT_EQ(std::set<int>(target.corners.begin(), target.corners.end()).size(), 4u);
		EXPECT_NEAR(target.curvature.sum(), 2 * kPi, 1e-12);
	}
}

TEST(TargetCurvature, ConesShareTheTotalCurvature)
{
	for (const Surface* s : {&sphere(), &genus2()})
		for (std::size_t n : {3, 5, 8}) {
			std::vector<int> cones;
			for (std::size_t i = 0; i < n; ++i)
				cones.push_back(static_cast<int>(2 * i));
			const Target target = s->choose(TargetCurvature::SelectedCones, cones);
			const double share = 2 * kPi * s->topology.eulerCharacteristic / static_cast<double>(n);
			for (int v = 0; v < static_cast<int>(target.fixed.size()); ++v)
				EXPECT_EQ(
					target.curvature[v],
					std::find(cones.begin(), cones.end(), v) != cones.end() ? share : 0.0);
			EXPECT_NEAR(target.curvature.sum(), 2 * kPi * s->topology.eulerCharacteristic, 1e-12);
		}
}

TEST(TargetCurvature, ConesRefused)
{
	expectRefusal<InvalidOption>(
		sphere(), sphere().request(TargetCurvature::SelectedCones), {"none is selected"});
	expectRefusal<InadmissibleCurvature>(
		sphere(),
		sphere().request(TargetCurvature::SelectedCones, {0}),
		{number(4 * kPi), "2 pi = 6.28318531", "1 such", "more or weaker cones"});
	expectRefusal<InadmissibleCurvature>(
		sphere(),
		sphere().request(TargetCurvature::SelectedCones, {0, 3}),
		{number(2 * kPi), "2 pi = 6.28318531", "2 such"});
	// On the boundary of a disk the bound is pi.
	const int a = cornerOf(flatDisk().mesh, 0, 0), b = cornerOf(flatDisk().mesh, 5, 4);
	expectRefusal<InadmissibleCurvature>(
		flatDisk(),
		flatDisk().request(TargetCurvature::SelectedCones, {a, b}),
		{number(kPi), "boundary", "pi = 3.14159265"});
}

TEST(TargetCurvature, ConesOfSurfacesWithBoundary)
{
	const int inside = cornerOf(flatDisk().mesh, 2, 2);
	const Target free = flatDisk().choose(flatDisk().request(
		TargetCurvature::SelectedCones, {inside, cornerOf(flatDisk().mesh, 3, 2)}));
	EXPECT_EQ(free.fixed, flatDisk().topology.boundary);
	std::vector<int> onBoundary;
	for (double x : {0.0, 2.0, 5.0})
		onBoundary.push_back(cornerOf(flatDisk().mesh, x, x == 2.0 ? 4.0 : 0.0));
	const Target triangle = flatDisk().choose(TargetCurvature::SelectedCones, onBoundary);
	EXPECT_TRUE(isPrescribed(triangle));
	for (int v : onBoundary)
		EXPECT_NEAR(triangle.curvature[v], 2 * kPi / 3, 1e-15);
}

TEST(TargetCurvature, PrescribedSpreadsADefectOfRoundingSize)
{
	Random random(91);
	TargetRequest request = genus2().request(TargetCurvature::Prescribed);
	double sum = 0.0;
	for (double& K : request.prescribed)
		sum += K = random.real(-1, 1);
	for (double& K : request.prescribed) { // as a float of the host holds it
		K += (-4 * kPi - sum) / static_cast<double>(request.prescribed.size());
		K = static_cast<double>(static_cast<float>(K));
	}
	double total = 0.0;
	for (double K : request.prescribed)
		total += K;
	ASSERT_GT(std::abs(total + 4 * kPi), 1e-9); // there is a defect to spread
	const Target target = genus2().choose(request);
	EXPECT_NEAR(target.curvature.sum(), -4 * kPi, 1e-13);
	for (std::size_t v = 0; v < request.prescribed.size(); ++v)
		EXPECT_NEAR(
			target.curvature[static_cast<Eigen::Index>(v)],
			request.prescribed[v],
			4 * std::numeric_limits<float>::epsilon() * 2 *
				static_cast<double>(request.prescribed.size()));
}

TEST(TargetCurvature, PrescribedRefusesALargeDefectWithBothNumbers)
{
	TargetRequest request = genus2().request(TargetCurvature::Prescribed);
	const double K = -4 * kPi / static_cast<double>(request.prescribed.size());
	std::fill(request.prescribed.begin(), request.prescribed.end(), K);
	EXPECT_NO_THROW(genus2().choose(request));
	request.prescribed[0] += 0.01;
	expectRefusal<InadmissibleCurvature>(
		genus2(), request, {number(-4 * kPi + 0.01), number(-4 * kPi), "Gauss-Bonnet"});
	std::fill(request.prescribed.begin(), request.prescribed.end(), 0.0);
	expectRefusal<InadmissibleCurvature>(genus2(), request, {"add up to 0,", number(-4 * kPi)});
}

TEST(TargetCurvature, PrescribedRefusesWhatNoMetricHas)
{
	TargetRequest request = sphere().request(TargetCurvature::Prescribed);
	request.prescribed[2] = 6.5;
	request.prescribed[7] = 4 * kPi - 6.5;
	expectRefusal<InadmissibleCurvature>(
		sphere(), request, {"6.5", "1 such", "2 pi = 6.28318531 inside"});
	request.prescribed[2] = std::numeric_limits<double>::quiet_NaN();
	expectRefusal<InadmissibleCurvature>(sphere(), request, {"1 vert", "not a finite number"});
	TargetRequest disk = flatDisk().request(TargetCurvature::Prescribed);
	disk.freeBoundary = false;
	disk.prescribed[at(cornerOf(flatDisk().mesh, 0, 0))] = 3.5;
	disk.prescribed[at(cornerOf(flatDisk().mesh, 5, 4))] = 2 * kPi - 3.5;
	expectRefusal<InadmissibleCurvature>(
		flatDisk(), disk, {"3.5", "boundary vertex", "pi = 3.14159265"});
}

TEST(TargetCurvature, FreeBoundaryBoundsTheInsideFromBelow)
{
	// 18 boundary vertices: sum K inside > 2 pi - 18 pi.
	TargetRequest request = flatDisk().request(TargetCurvature::Prescribed);
	const int inside = cornerOf(flatDisk().mesh, 2, 2);
	request.prescribed[at(inside)] = -16 * kPi + 1e-3;
	EXPECT_NO_THROW(flatDisk().choose(request));
	request.prescribed[at(inside)] = -16 * kPi - 1e-3;
	expectRefusal<InadmissibleCurvature>(
		flatDisk(), request, {number(-16 * kPi - 1e-3), number(-16 * kPi), "18 vertices"});
	// The values on the boundary are not read: it is free.
	request.prescribed[at(inside)] = 0.0;
	request.prescribed[at(cornerOf(flatDisk().mesh, 0, 0))] = 100.0;
	EXPECT_NO_THROW(flatDisk().choose(request));
}

TEST(TargetCurvature, TellsWhenFreeBoundaryHasNoEffect)
{
	for (TargetCurvature mode : {TargetCurvature::Disk, TargetCurvature::Rectangle}) {
		TargetRequest request = flatDisk().request(mode);
		const auto said = [&] {
			const Target target = flatDisk().choose(request);
			return std::any_of(target.notes.begin(), target.notes.end(), [](const std::string& s) {
				return s.find("free_boundary has no effect") != std::string::npos;
			});
		};
		EXPECT_TRUE(said());
		request.freeBoundary = false;
		EXPECT_FALSE(said());
	}
}

} // namespace
} // namespace ricci::testing
