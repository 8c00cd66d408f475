// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/expect.h"
#include "support/intrinsic.h"
#include "support/random.h"
#include "support/random_surface.h"
#include "support/run_flow.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/base/numbers.h>
#include <ricci/base/tolerances.h>
#include <ricci/curvature/area_change.h>
#include <ricci/curvature/rectangle_corners.h>
#include <ricci/curvature/target_curvature.h>
#include <ricci/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace ricci::testing {
namespace {

/// A mesh with what chooseTarget() asks for.
struct TestSurface : EmbeddedSurface
{
	SurfaceMesh mesh;

	explicit TestSurface(const SurfaceMesh& m) :
			EmbeddedSurface(embeddedSurface(VertexArray<Point3>(m.positions), m.triangles)), mesh(m)
	{
	}

	TargetRequest request(TargetCurvature mode, const std::vector<Vertex>& selected = {}) const
	{
		TargetRequest r;
		r.options.target = mode;
		r.selected.assign(mesh.positions.size(), 0);
		for (const Vertex v : selected)
			r.selected[v] = 1;
		r.prescribed.assign(mesh.positions.size(), 0.0);
		r.prescribedPrecision = std::numeric_limits<float>::epsilon();
		return r;
	}
	Target choose(const TargetRequest& r) const
	{
		InitialPacking start = initialPacking(*this, FlowOptions());
		return chooseTarget(*this, start, r);
	}
	Target choose(TargetCurvature mode, const std::vector<Vertex>& selected = {}) const
	{
		return choose(request(mode, selected));
	}

	/// 2 pi chi
	double totalCurvature() const { return 2 * kPi * topology.type.eulerCharacteristic(); }

	/// The vertex at this place.
	Vertex vertexAt(double x, double y) const
	{
		for (const Vertex v : positions.indices())
			if (positions[v][0] == x && positions[v][1] == y)
				return v;
		return Vertex();
	}
};

std::string number(double x)
{
	char text[32];
	std::snprintf(text, sizeof text, "%.9g", x);
	return text;
}

/// The error \p E with which a request is refused, for \p problem and with \p words in its
/// sentence.
template<class E>
E refusal(
	const TestSurface& surface,
	const TargetRequest& r,
	typename E::Problem problem,
	const std::vector<std::string>& words)
{
	return refusalFor<E>(problem, words, [&] { surface.choose(r); });
}

/// A refused curvature with its numbers.
void expectNumbers(
	const TestSurface& surface,
	const TargetRequest& r,
	InadmissibleCurvature::Problem problem,
	double value,
	double bound,
	std::size_t count,
	const std::vector<std::string>& words)
{
	const InadmissibleCurvature error = refusal<InadmissibleCurvature>(surface, r, problem, words);
	EXPECT_NEAR(error.value, value, 1e-12);
	EXPECT_NEAR(error.bound, bound, 1e-12);
	EXPECT_EQ(error.count, count);
}

bool isPrescribed(const Target& target)
{
	return std::count(target.fixed.begin(), target.fixed.end(), 1) == 0;
}

const TestSurface& sphere()
{
	static const TestSurface s(perforatedSlab(0, 2));
	return s;
}
const TestSurface& flatDisk()
{
	static const TestSurface s(rectangle(5, 4, 5, 4));
	return s;
}
const TestSurface& annulus()
{
	static const TestSurface s(ring(1, 2, 9, 3));
	return s;
}
const TestSurface& torusSurface()
{
	static const TestSurface s(torus(3, 1, 9, 7));
	return s;
}
const TestSurface& genus2()
{
	static const TestSurface s(perforatedSlab(2, 1));
	return s;
}

TEST(TargetCurvature, AutomaticByTopology)
{
	EXPECT_FALSE(isPrescribed(flatDisk().choose(TargetCurvature::Automatic)));
	for (const TestSurface* s : {&annulus(), &torusSurface()}) {
		TargetRequest request = s->request(TargetCurvature::Automatic);
		request.measuresAreas = false;
		const Target target = s->choose(request);
		EXPECT_TRUE(isPrescribed(target));
		EXPECT_EQ(target.curvature.lpNorm<Eigen::Infinity>(), 0.0);
	}
	const TestSurface pierced(withoutStars(torus(3, 1, 9, 9), {0, 40}));
	const Target free = pierced.choose(TargetCurvature::Automatic);
	EXPECT_EQ(free.fixed, pierced.topology.boundary);
	for (const TestSurface* s : {&sphere(), &genus2()}) { // cones
		const Target target = s->choose(TargetCurvature::Automatic);
		EXPECT_TRUE(isPrescribed(target));
		EXPECT_NEAR(target.curvature.sum(), s->totalCurvature(), 1e-11);
		EXPECT_LT(target.curvature.maxCoeff(), 2 * kPi);
	}
}

/// Standard deviation of 2 ln \p x, which has the density \p weight over (0, 1).
double spreadOf(const std::function<double(double)>& x, const std::function<double(double)>& weight)
{
	const int n = 200000;
	double total = 0.0, sum = 0.0, squares = 0.0;
	for (int i = 0; i < n; ++i) {
		const double t = (i + 0.5) / n, w = weight(t), y = 2 * std::log(x(t));
		total += w;
		sum += w * y;
		squares += w * y * y;
	}
	return std::sqrt(squares / total - sum * sum / (total * total));
}

/// Surface of revolution between two loops, whose radius goes from 1 to \p end and back.
SurfaceMesh hourglass(double end, int along, int around)
{
	std::vector<std::array<double, 2>> profile;
	for (int i = 0; i <= along; ++i) {
		const double t = static_cast<double>(i) / along;
		profile.push_back({1.0 + (end - 1.0) * std::sin(kPi * t), 4.0 * t});
	}
	return revolved(profile, around);
}

/// Expected spread of the area factor without cones, by the formula of the smooth surface: the flat
/// metric of a surface of revolution without poles divides lengths by the radius, that of a sphere
/// with a hole is the stereographic projection from the middle of the hole.
struct Plain
{
	std::string name;
	SurfaceMesh mesh;
	double spread;
};

std::vector<Plain> plainSurfaces()
{
	std::vector<Plain> surfaces;
	for (const double R : {3.0, 1.7, 1.1}) {
		const auto radius = [R](double t) { return R + std::cos(2 * kPi * t); };
		surfaces.push_back({"torus", torus(R, 1.0, 60, 60), spreadOf(radius, radius)});
	}
	for (const double end : {0.7, 0.1, 4.0}) {
		const auto radius = [end](double t) { return 1.0 + (end - 1.0) * std::sin(kPi * t); };
		const auto area = [end, &radius](double t) {
			return radius(t) * std::hypot((end - 1.0) * kPi * std::cos(kPi * t), 4.0);
		};
		surfaces.push_back({"annulus", hourglass(end, 80, 60), spreadOf(radius, area)});
	}
	const auto radius = [](double t) { return 1.0 + 3.0 * t; };
	surfaces.push_back({"plane ring", ring(1.0, 4.0, 60, 40), spreadOf(radius, radius)});
	for (const double hole : {1.2, 0.6, 0.3}) {
		const double cap = 0.5 * (1.0 - std::cos(hole)); // its share of the sphere
		std::vector<std::array<double, 2>> profile;
		for (int i = 0; i <= 60; ++i) {
			const double a = hole + (kPi - hole) * i / 60;
			profile.push_back({i < 60 ? std::sin(a) : 0.0, -std::cos(a)});
		}
		surfaces.push_back(
			{"disk",
			 revolved(profile, 60),
			 spreadOf(
				 [cap](double t) { return cap + (1.0 - cap) * t; }, [](double) { return 1.0; })});
	}
	return surfaces;
}

std::string joined(const Target& target)
{
	std::string notes;
	for (const std::string& note : target.notes)
		notes += note + "\n";
	return notes;
}

/// Vertices inside with curvature.
int coneCount(const TestSurface& surface, const Target& target)
{
	int count = 0;
	for (const Vertex v : target.curvature.indices())
		count += !surface.topology.boundary[v] && target.curvature[v] != 0.0;
	return count;
}

TEST(TargetCurvature, AutomaticTakesWhatIsExpectedToCostLess)
{
	int withCones = 0;
	for (const Plain& p : plainSurfaces()) {
		SCOPED_TRACE(p.name + ", " + std::to_string(p.spread));
		const TestSurface surface(p.mesh);
		const Target target = surface.choose(TargetCurvature::Automatic);
		const std::string notes = joined(target);
		ASSERT_TRUE(target.expected);
		EXPECT_FALSE(target.maxSpread);
		const double energy = numberAfter(notes, " expected energy "); // without cones
		const double spread = numberAfter(notes, "area distortion ");
		EXPECT_NEAR(spread / p.spread, 1.0, 0.03) << notes;
		EXPECT_NEAR(energy, expectedEnergy(spread), 0.01 * energy);
		EXPECT_LE(target.expected->energy, 1.005 * energy);
		if (notes.find("No cones: ") != std::string::npos) {
			EXPECT_EQ(coneCount(surface, target), 0);
			EXPECT_EQ(target.fixed == surface.topology.boundary, p.name == "disk");
			continue;
		}
		EXPECT_NE(notes.find("Cones: without them "), std::string::npos);
		++withCones;
		// What the cones save is more than the seams that they need.
		const double seams = numberAfter(notes, ", seams "); // without cones
		EXPECT_LT(
			target.expected->energy + kSeamPrice * target.expected->seams,
			1.005 * energy + kSeamPrice * 1.005 * seams);
		// A plane ring keeps all areas as soon as its boundary is free.
		EXPECT_EQ(coneCount(surface, target) > 0, p.name != "plane ring");
		// The boundary of an annulus comes free with cones, like any other.
		EXPECT_EQ(target.fixed, surface.topology.boundary);
		if (surface.topology.type.isClosed()) {
			EXPECT_NEAR(target.curvature.sum(), 0.0, 1e-11);
		}
	}
	EXPECT_GE(withCones, 4);
}

TEST(TargetCurvature, AutomaticLeavesFlatSurfacesWithoutCones)
{
	// A cylinder is flat, and so is a disk in the plane.
	const SurfaceMesh cylinder = revolved({{1.0, 0.0}, {1.0, 1.0}, {1.0, 2.0}, {1.0, 3.0}}, 24);
	const SurfaceMesh square = grid(12, 12, Ends::Open, Ends::Open, [](int i, int j) {
		return Point3{0.1 * i, 0.1 * j, 0.0};
	});
	for (const SurfaceMesh& mesh : {cylinder, square}) {
		const TestSurface surface(mesh);
		const Target target = surface.choose(TargetCurvature::Automatic);
		EXPECT_EQ(coneCount(surface, target), 0);
		EXPECT_NE(joined(target).find("No cones: "), std::string::npos);
		ASSERT_TRUE(target.expected);
		EXPECT_NEAR(target.expected->energy, 4.0, 1e-9);
		EXPECT_EQ(target.curvature.lpNorm<Eigen::Infinity>(), 0.0);
	}
}

TEST(TargetCurvature, AutomaticDoesWithoutConesWhereMoreDistortionIsAskedFor)
{
	for (const Plain& p : plainSurfaces()) {
		SCOPED_TRACE(p.name + ", " + std::to_string(p.spread));
		const TestSurface surface(p.mesh);
		TargetRequest request = surface.request(TargetCurvature::Automatic);
		for (const double distortion : {1.1 * p.spread, 1e9}) {
			request.options.cones.distortion = distortion;
			const Target target = surface.choose(request);
			EXPECT_EQ(coneCount(surface, target), 0);
			EXPECT_EQ(target.maxSpread, distortion);
		}
		request.options.cones.distortion = 0.9 * p.spread;
		const Target target = surface.choose(request);
		EXPECT_EQ(coneCount(surface, target) > 0, p.name != "plane ring");
		EXPECT_EQ(target.fixed, surface.topology.boundary);
	}
}

TEST(TargetCurvature, AutomaticGoesByTopologyWhereNoAreasAreMeasured)
{
	for (const Plain& p : plainSurfaces()) {
		SCOPED_TRACE(p.name + ", " + std::to_string(p.spread));
		const TestSurface surface(p.mesh);
		const SurfaceType& type = surface.topology.type;
		for (const bool freeBoundary : {true, false})
			for (const bool keepsAreas : {true, false}) {
				if (keepsAreas && (freeBoundary || type.isClosed()))
					continue;
				TargetRequest request = surface.request(TargetCurvature::Automatic);
				request.options.freeBoundary = freeBoundary;
				request.measuresAreas = keepsAreas;
				const Target target = surface.choose(request);
				EXPECT_EQ(coneCount(surface, target), 0);
				EXPECT_FALSE(target.maxSpread);
				EXPECT_FALSE(target.expected);
				EXPECT_EQ(joined(target).find("ones"), std::string::npos); // Cones, No cones
				EXPECT_EQ(target.circular, type.isDisk() && !freeBoundary);
				EXPECT_EQ(isPrescribed(target), !type.isDisk() || !freeBoundary);
				if (!type.isDisk()) {
					EXPECT_EQ(target.curvature.lpNorm<Eigen::Infinity>(), 0.0);
				}
			}
	}
}

TEST(TargetCurvature, OtherChoicesThanAutomaticPromiseNothingOfAreasUnlessConesArePlaced)
{
	const TestSurface surface(torus(1.1, 1.0, 40, 40));
	const Target flat = surface.choose(TargetCurvature::Flat);
	EXPECT_FALSE(flat.maxSpread);
	EXPECT_EQ(flat.curvature.lpNorm<Eigen::Infinity>(), 0.0);
	TargetRequest request = surface.request(TargetCurvature::PlacedCones);
	request.options.cones.distortion = 0.7;
	EXPECT_EQ(surface.choose(request).maxSpread, 0.7);
	request.options.cones.count = 5; // the number is the user's
	EXPECT_FALSE(surface.choose(request).maxSpread);
	request.options.target = TargetCurvature::Automatic;
	const Target five = surface.choose(request);
	EXPECT_FALSE(five.maxSpread);
	EXPECT_EQ(coneCount(surface, five), 5);
}

TEST(TargetCurvature, AutomaticDependsOnNoScaleAndNoNumbers)
{
	// Shaken, so that no two vertices are equally good for a cone.
	Random random(92);
	for (const SurfaceMesh& regular :
		 {torus(1.1, 1.0, 30, 30), hourglass(0.1, 40, 24), sphereWithTube(0.3, 2.0, 0.3, 16, 16)}) {
		const SurfaceMesh mesh = shaken(regular, 0.004, random);
		const Target target = TestSurface(mesh).choose(TargetCurvature::Automatic);
		const Target larger = TestSurface(scaled(mesh, 1024.0)).choose(TargetCurvature::Automatic);
		EXPECT_LT((larger.curvature - target.curvature).lpNorm<Eigen::Infinity>(), 1e-8);
		const Renumbered other = renumbered(mesh, random);
		const Target renamed = TestSurface(other.mesh).choose(TargetCurvature::Automatic);
		EXPECT_GT(target.curvature.lpNorm<Eigen::Infinity>(), 0.1);
		for (const Vertex v : renamed.curvature.indices())
			EXPECT_NEAR(renamed.curvature[v], target.curvature[Vertex(other.vertex[at(v)])], 1e-6);
	}
}

/// The flow to \p target.
FlowResult flowTo(const TestSurface& surface, const Target& target)
{
	return runRicciFlow(surface, initialPacking(surface, FlowOptions()), target, FlowOptions());
}

TEST(TargetToKeepAreas, IsAskedForWhereAreasSpreadMoreThanTheTargetAllows)
{
	int withinSlack = 0;
	for (const Plain& p : plainSurfaces()) {
		SCOPED_TRACE(p.name + ", " + std::to_string(p.spread));
		const TestSurface surface(p.mesh);
		TargetRequest request = surface.request(TargetCurvature::Automatic);
		request.measuresAreas = false;
		FlowResult flow = flowTo(surface, surface.choose(request)); // without cones
		request.measuresAreas = true;
		const auto next = [&]() -> std::optional<Target> {
			if (keepsAreas(surface, flow))
				return std::nullopt;
			InitialPacking start = initialPacking(surface, FlowOptions());
			return targetToKeepAreas(surface, start, flow, request);
		};
		EXPECT_FALSE(next()); // the target promises nothing
		const AreaChange change = areaChange(surface, flowFactor(flow));
		EXPECT_NEAR(change.spread / p.spread, 1.0, 0.03); // the smooth surface's
		// The spread alone may be larger by the slack than what was asked for.
		for (const double allowed : {0.5, 1.0, 1.5, change.spread / 1.05, change.spread / 1.15}) {
			flow.target.maxSpread = allowed;
			request.options.cones.distortion = allowed;
			const bool isKept = areaExcess(change, allowed, kSpreadSlack) <= 1.0;
			const std::optional<Target> target = next();
			ASSERT_EQ(target.has_value(), !isKept) << allowed;
			withinSlack += isKept && change.spread > allowed;
			if (isKept)
				continue;
			// A plane ring keeps all areas as soon as its boundary is free.
			EXPECT_EQ(coneCount(surface, *target) > 0, p.name != "plane ring");
			EXPECT_EQ(target->maxSpread, allowed);
			const std::string notes = joined(*target);
			EXPECT_NEAR(numberAfter(notes, "comes out as "), change.spread, 0.005 * change.spread);
			EXPECT_NEAR(numberAfter(notes, "inverse as "), change.mean, 0.005 * change.mean);
			EXPECT_EQ(target->fixed, surface.topology.boundary);
			if (surface.topology.type.isClosed()) {
				EXPECT_NEAR(target->curvature.sum(), 0.0, 1e-11);
			}
		}
	}
	EXPECT_GE(withinSlack, 3);
}

TEST(TargetCurvature, FreeBoundaryFixesTheBoundaryAndAsksForAFlatInside)
{
	const Target target = flatDisk().choose(TargetCurvature::Automatic);
	EXPECT_EQ(target.fixed, flatDisk().topology.boundary);
	for (const Vertex v : target.fixed.indices())
		if (!target.fixed[v]) {
			EXPECT_EQ(target.curvature[v], 0.0);
		}
}

TEST(TargetCurvature, PrescribedBoundariesObeyGaussBonnet)
{
	TargetRequest disk = flatDisk().request(TargetCurvature::Automatic);
	disk.options.freeBoundary = false;
	const TestSurface pierced(withoutStars(torus(3, 1, 9, 9), {0, 40}));
	TargetRequest holes = pierced.request(TargetCurvature::Automatic);
	holes.options.freeBoundary = false;
	const struct
	{
		const TestSurface& surface;
		TargetRequest request;
	} cases[] = {
		{flatDisk(), disk},
		{flatDisk(), flatDisk().request(TargetCurvature::Disk)},
		{flatDisk(), flatDisk().request(TargetCurvature::Rectangle)},
		{pierced, holes}};
	for (const auto& c : cases) {
		const Target target = c.surface.choose(c.request);
		EXPECT_TRUE(isPrescribed(target));
		EXPECT_NEAR(target.curvature.sum(), c.surface.totalCurvature(), 1e-12);
		for (const Vertex v : target.fixed.indices())
			if (!c.surface.topology.boundary[v]) {
				EXPECT_EQ(target.curvature[v], 0.0);
			}
	}
}

TEST(TargetCurvature, FlatNeedsEulerCharacteristicZero)
{
	const struct
	{
		const TestSurface& surface;
		double total;
		const char* name;
	} cases[] = {
		{sphere(), 4 * kPi, "genus 0"},
		{genus2(), -4 * kPi, "genus 2"},
		{flatDisk(), 2 * kPi, "a disk"}};
	for (const auto& c : cases) {
		const TargetRequest request = c.surface.request(TargetCurvature::Flat);
		expectNumbers(
			c.surface,
			request,
			InadmissibleCurvature::Flat,
			0.0,
			c.total,
			0,
			{number(c.total), c.name});
		const auto error =
			refusal<InadmissibleCurvature>(c.surface, request, InadmissibleCurvature::Flat, {});
		EXPECT_EQ(error.surface.name(), c.surface.topology.type.name());
	}
}

TEST(TargetCurvature, DiskAndRectangleNeedADisk)
{
	for (TargetCurvature mode : {TargetCurvature::Disk, TargetCurvature::Rectangle})
		for (const TestSurface* s : {&annulus(), &torusSurface(), &sphere()}) {
			const std::string name = s->topology.type.name();
			const InvalidOption error = refusal<InvalidOption>(
				*s, s->request(mode), InvalidOption::NotADisk, {"topological disk", name});
			EXPECT_EQ(error.target, mode);
			EXPECT_EQ(error.surface.name(), name);
		}
	EXPECT_TRUE(flatDisk().choose(TargetCurvature::Disk).circular);
}

TEST(TargetCurvature, RectangleCornersBySelection)
{
	const std::vector<Vertex> corners{
		flatDisk().vertexAt(0, 0),
		flatDisk().vertexAt(3, 0),
		flatDisk().vertexAt(5, 4),
		flatDisk().vertexAt(0, 2)};
	const Target target = flatDisk().choose(TargetCurvature::Rectangle, corners);
	ASSERT_TRUE(target.corners);
	for (const Vertex v : target.fixed.indices()) {
		const bool corner = std::find(corners.begin(), corners.end(), v) != corners.end();
		EXPECT_EQ(target.curvature[v], corner ? kPi / 2 : 0.0);
	}
	// In boundary order, from anywhere.
	const auto first = std::find(corners.begin(), corners.end(), (*target.corners)[0]);
	ASSERT_NE(first, corners.end());
	for (std::size_t k = 0; k < 4; ++k)
		EXPECT_EQ(
			(*target.corners)[k],
			corners[(static_cast<std::size_t>(first - corners.begin()) + k) % 4]);
}

TEST(TargetCurvature, RectangleCornersWithoutASelection)
{
	for (int n : {4, 5, 7, 30}) {
		const TestSurface surface(fan(n, 0.0));
		const Target target = surface.choose(TargetCurvature::Rectangle);
		const auto corners = rectangleCorners(surface.topology.loops.front(), surface.positions);
		ASSERT_TRUE(target.corners);
		EXPECT_EQ(*target.corners, corners);
		for (const Vertex v : target.fixed.indices()) {
			const bool corner = std::find(corners.begin(), corners.end(), v) != corners.end();
			EXPECT_EQ(target.curvature[v], corner ? kPi / 2 : 0.0);
		}
		EXPECT_NEAR(target.curvature.sum(), 2 * kPi, 1e-12);
		EXPECT_TRUE(isPrescribed(target));
	}
}

TEST(TargetCurvature, RectangleRefusesOtherSelections)
{
	const Vertex a = flatDisk().vertexAt(0, 0), b = flatDisk().vertexAt(5, 0),
				 c = flatDisk().vertexAt(5, 4);
	const Vertex inside = flatDisk().vertexAt(2, 2), d = flatDisk().vertexAt(0, 4);
	const auto expectCount = [](const TestSurface& surface,
								const std::vector<Vertex>& selected,
								InvalidOption::Problem problem,
								std::size_t count,
								const std::vector<std::string>& words) {
		const TargetRequest request = surface.request(TargetCurvature::Rectangle, selected);
		EXPECT_EQ(refusal<InvalidOption>(surface, request, problem, words).count, count);
	};
	expectCount(
		flatDisk(), {a, b, c}, InvalidOption::CornerCount, 3, {"four selected", "3 are selected"});
	expectCount(
		flatDisk(),
		{a, b, c, d, inside},
		InvalidOption::CornerCount,
		5,
		{"four selected", "5 are selected"});
	expectCount(
		flatDisk(),
		{a, b, c, inside},
		InvalidOption::CornersOffBoundary,
		3,
		{"on one boundary loop", "only 3"});
	expectCount(
		TestSurface({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}),
		{},
		InvalidOption::TooFewBoundaryVertices,
		3,
		{"four boundary vertices", "has 3"});
}

TEST(TargetCurvature, ConesShareTheTotalCurvature)
{
	for (const TestSurface* s : {&sphere(), &genus2()})
		for (std::size_t n : {3u, 5u, 8u}) {
			std::vector<Vertex> cones;
			for (std::size_t i = 0; i < n; ++i)
				cones.push_back(Vertex(2 * i));
			const Target target = s->choose(TargetCurvature::SelectedCones, cones);
			const double share = s->totalCurvature() / static_cast<double>(n);
			for (const Vertex v : target.fixed.indices())
				EXPECT_EQ(
					target.curvature[v],
					std::find(cones.begin(), cones.end(), v) != cones.end() ? share : 0.0);
			EXPECT_NEAR(target.curvature.sum(), s->totalCurvature(), 1e-12);
		}
}

TEST(TargetCurvature, ConesRefused)
{
	refusal<InvalidOption>(
		sphere(),
		sphere().request(TargetCurvature::SelectedCones),
		InvalidOption::NothingSelected,
		{"none is selected"});
	expectNumbers(
		sphere(),
		sphere().request(TargetCurvature::SelectedCones, {Vertex(0)}),
		InadmissibleCurvature::TooLargeInside,
		4 * kPi,
		2 * kPi,
		1,
		{number(4 * kPi), "2 pi = 6.28318531", "1 such"});
	expectNumbers(
		sphere(),
		sphere().request(TargetCurvature::SelectedCones, {Vertex(0), Vertex(3)}),
		InadmissibleCurvature::TooLargeInside,
		2 * kPi,
		2 * kPi,
		2,
		{number(2 * kPi), "2 pi = 6.28318531", "2 such"});
	// On the boundary of a disk the bound is pi.
	const Vertex a = flatDisk().vertexAt(0, 0), b = flatDisk().vertexAt(5, 4);
	expectNumbers(
		flatDisk(),
		flatDisk().request(TargetCurvature::SelectedCones, {a, b}),
		InadmissibleCurvature::TooLargeOnBoundary,
		kPi,
		kPi,
		2,
		{number(kPi), "boundary", "pi = 3.14159265"});
}

TEST(TargetCurvature, ConesOfSurfacesWithBoundary)
{
	const Target free = flatDisk().choose(
		TargetCurvature::SelectedCones, {flatDisk().vertexAt(2, 2), flatDisk().vertexAt(3, 2)});
	EXPECT_EQ(free.fixed, flatDisk().topology.boundary);
	std::vector<Vertex> onBoundary;
	for (double x : {0.0, 2.0, 5.0})
		onBoundary.push_back(flatDisk().vertexAt(x, x == 2.0 ? 4.0 : 0.0));
	const Target triangle = flatDisk().choose(TargetCurvature::SelectedCones, onBoundary);
	EXPECT_TRUE(isPrescribed(triangle));
	for (const Vertex v : onBoundary)
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
	for (const Vertex v : request.prescribed.indices())
		EXPECT_NEAR(
			target.curvature[v],
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
	request.prescribed[Vertex(0)] += 0.01;
	expectNumbers(
		genus2(),
		request,
		InadmissibleCurvature::GaussBonnet,
		-4 * kPi + 0.01,
		-4 * kPi,
		0,
		{number(-4 * kPi + 0.01), number(-4 * kPi), "Gauss-Bonnet"});
	std::fill(request.prescribed.begin(), request.prescribed.end(), 0.0);
	expectNumbers(
		genus2(),
		request,
		InadmissibleCurvature::GaussBonnet,
		0.0,
		-4 * kPi,
		0,
		{"adds up to 0,", number(-4 * kPi)});
}

TEST(TargetCurvature, PrescribedRefusesWhatNoMetricHas)
{
	TargetRequest request = sphere().request(TargetCurvature::Prescribed);
	request.prescribed[Vertex(2)] = 6.5;
	request.prescribed[Vertex(7)] = 4 * kPi - 6.5;
	expectNumbers(
		sphere(),
		request,
		InadmissibleCurvature::TooLargeInside,
		6.5,
		2 * kPi,
		1,
		{"6.5", "1 such", "2 pi = 6.28318531 inside"});
	request.prescribed[Vertex(2)] = std::numeric_limits<double>::quiet_NaN();
	expectNumbers(
		sphere(),
		request,
		InadmissibleCurvature::NotFinite,
		0.0,
		0.0,
		1,
		{"1 vert", "not a finite number"});
	TargetRequest disk = flatDisk().request(TargetCurvature::Prescribed);
	disk.options.freeBoundary = false;
	disk.prescribed[flatDisk().vertexAt(0, 0)] = 3.5;
	disk.prescribed[flatDisk().vertexAt(5, 4)] = 2 * kPi - 3.5;
	expectNumbers(
		flatDisk(),
		disk,
		InadmissibleCurvature::TooLargeOnBoundary,
		3.5,
		kPi,
		1,
		{"3.5", "boundary vertex", "pi = 3.14159265"});
}

TEST(TargetCurvature, FreeBoundaryBoundsTheInsideFromBelow)
{
	// 18 boundary vertices: sum K inside > 2 pi - 18 pi.
	TargetRequest request = flatDisk().request(TargetCurvature::Prescribed);
	const Vertex inside = flatDisk().vertexAt(2, 2);
	request.prescribed[inside] = -16 * kPi + 1e-3;
	EXPECT_NO_THROW(flatDisk().choose(request));
	request.prescribed[inside] = -16 * kPi - 1e-3;
	expectNumbers(
		flatDisk(),
		request,
		InadmissibleCurvature::FreeBoundary,
		-16 * kPi - 1e-3,
		-16 * kPi,
		18,
		{number(-16 * kPi - 1e-3), number(-16 * kPi), "18 vertices"});
	// The values on the boundary are not read: it is free.
	request.prescribed[inside] = 0.0;
	request.prescribed[flatDisk().vertexAt(0, 0)] = 100.0;
	EXPECT_NO_THROW(flatDisk().choose(request));
}

/// A free boundary takes the rest of the curvature, whatever it is; but no coordinates hold what that makes of
/// lengths.
TEST(TargetCurvature, MuchCurvatureInsideAFreeBoundaryIsRefused)
{
	const TestSurface disk(rectangle(40, 40, 1, 1));
	TargetRequest request = disk.request(TargetCurvature::Prescribed);
	for (double& k : request.prescribed)
		k = 1e-3;
	EXPECT_NO_THROW(disk.choose(request));
	for (double& k : request.prescribed)
		k = 1.0;
	const auto error = refusal<InadmissibleCurvature>(
		disk, request, InadmissibleCurvature::ScalesApart, {"times as large as others"});
	// u = (1 - r^2) / 4 per unit of curvature in a round disk; the density is 1600.
	EXPECT_GT(error.value, 0.25 * 1600 * 0.25 / std::log(10.0));
	EXPECT_LT(error.value, 0.25 * 1600 * 0.5 / std::log(10.0));
}

TEST(TargetCurvature, TellsWhenFreeBoundaryHasNoEffect)
{
	for (TargetCurvature mode : {TargetCurvature::Disk, TargetCurvature::Rectangle}) {
		TargetRequest request = flatDisk().request(mode);
		const auto said = [&] {
			const Target target = flatDisk().choose(request);
			return std::any_of(target.notes.begin(), target.notes.end(), [](const std::string& s) {
				return s.find("the choice of a free boundary has no effect") != std::string::npos;
			});
		};
		EXPECT_TRUE(said());
		request.options.freeBoundary = false;
		EXPECT_FALSE(said());
	}
}

} // namespace
} // namespace ricci::testing
