// SPDX-License-Identifier: GPL-3.0-or-later
// What a result does not depend on: where the mesh lies, how large it is, how its elements are numbered, what
// else the mesh has, what ran before, and the number of threads. Bit for bit where no rounding has a part in it,
// else as far as rounding of the coordinates goes.
#include "support/calls.h"
#include "support/flat_map.h"
#include "support/listener.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>

#ifdef __linux__
#include <sched.h>

/// In place of the system's: as many processors as the environment says, or two.
extern "C" int sched_getaffinity(pid_t, std::size_t bytes, cpu_set_t* allowed) noexcept
{
	const char* count = std::getenv("RICCI_TEST_THREADS");
	CPU_ZERO_S(bytes, allowed);
	for (int i = 0; i < (count ? std::atoi(count) : 2); ++i)
		CPU_SET_S(static_cast<std::size_t>(i), bytes, allowed);
	return 0;
}
#endif

namespace ricci::testing {
namespace {

/// The coordinates as multiples of 2^-20, to which integers are added without rounding.
SurfaceMesh onGrid(SurfaceMesh mesh)
{
	for (Point3& p : mesh.positions)
		for (double& x : p)
			x = std::round(x * 0x1p20) * 0x1p-20;
	return mesh;
}

SurfaceMesh bumpySphere(Random& random)
{
	std::vector<std::array<double, 2>> profile{{0.0, -2.0}};
	for (int i = 1; i < 12; ++i)
		profile.push_back(
			{std::sin(kPi * i / 12) * (1 + 0.3 * std::sin(kPi * i / 4)),
			 -2 * std::cos(kPi * i / 12)});
	profile.push_back({0.0, 2.0});
	return onGrid(shaken(revolved(profile, 14), 0.03, random));
}

SurfaceMesh bumpySheet(Random& random)
{
	SurfaceMesh mesh = randomPlanarDisk(10, random);
	for (Point3& p : mesh.positions)
		p[2] = 0.4 * std::exp(-2 * std::pow(p[0] - 0.3, 2) - 3 * std::pow(p[1] - 0.5, 2)) +
			   0.1 * std::sin(5 * p[0]);
	return onGrid(mesh);
}

/// Surfaces of every kind with all that is done to them.
std::vector<Call> calls()
{
	Random random(77);
	const SurfaceMesh sphere = bumpySphere(random), sheet = bumpySheet(random);
	const SurfaceMesh donut = onGrid(bumpyTorus(14, 9, random));
	const SurfaceMesh handles = onGrid(shaken(perforatedSlab(2, 2), 0.06, random));
	const SurfaceMesh tube = onGrid(shaken(ring(1, 2.5, 16, 5), 0.05, random));
	const SurfaceMesh box = onGrid(shaken(perforatedSlab(1, 3), 0.01, random));
	const VertexInput three = selecting(sphere, {0, 40, 90});
	const auto method = [&](Method m) {
		return with([=](Options& o) {
			o.target = TargetCurvature::Flat;
			o.method = m;
		});
	};
	const auto target = [&](TargetCurvature t) { return with([=](Options& o) { o.target = t; }); };
	const auto refine = [](FlowOptions& o) { o.output = OutputTriangulation::CommonRefinement; };
	const auto quarters = [](Options& o) {
		o.target = TargetCurvature::PlacedCones;
		o.cones.rounding = ConeRounding::QuarterTurns;
	};
	VertexInput curved;
	for (std::size_t v = 0; v < donut.positions.size(); ++v)
		curved.targetCurvature.push_back(v % 2 == 0 ? 0.25 : -0.25);
	return {
		{"Sphere", sphere, Options()},
		{"SphereSixCones", sphere, with([](Options& o) {
			 o.target = TargetCurvature::PlacedCones;
			 o.cones.count = 6;
		 })},
		{"SphereQuarterTurns", sphere, with(quarters)},
		{"SphereSelectedCones", sphere, target(TargetCurvature::SelectedCones), three},
		{"Torus", donut, Options()},
		{"TorusRefined", donut, with(refine)},
		{"TorusFixed", donut, method(Method::FixedTriangles)},
		{"TorusThurston", donut, method(Method::Thurston)},
		{"TorusEdgeSwaps", donut, method(Method::EdgeSwaps)},
		{"TorusPrescribed", donut, target(TargetCurvature::Prescribed), curved},
		{"TorusHiddenSeams", donut, with([](Options& o) { o.seamHiding = 0.7; })},
		{"Genus2", handles, Options()},
		{"Genus2Refined", handles, with(refine)},
		{"Genus2QuarterTurns", handles, with(quarters)},
		{"Genus2LeastStretch", handles, with([](Options& o) { o.finish = Finish::LeastStretch; })},
		{"Genus2Unfinished", handles, with([](Options& o) { o.finish = Finish::None; })},
		{"Disk", sheet, Options()},
		{"DiskRound", sheet, target(TargetCurvature::Disk)},
		{"DiskRectangle", sheet, target(TargetCurvature::Rectangle)},
		{"DiskRefined", sheet, with(refine)},
		{"Annulus", tube, Options()},
		{"AnnulusFlat", tube, target(TargetCurvature::Flat)},
		{"AnnulusCapped", tube, with([](Options& o) { o.holes = Holes::Capped; })},
		// It has nets of one length but of several shapes, which are not cut alike for packing.
		{"Box", perforatedSlab(1, 3), with([](Options& o) { o.charts = Charts::WithoutOverlap; })},
		{"BoxShaken", box, Options()},
		{"ManyComponents",
		 sideBySide(sideBySide(sideBySide(donut, sphere, 10), sheet, 20), tube, 30),
		 Options()},
		{"Hyperbolic", handles, HyperbolicOptions()},
		{"HyperbolicRefined", handles, inDisk([&](HyperbolicOptions& o) {
			 refine(o);
			 o.canonicalGenerators = true;
		 })},
		{"HyperbolicFixed", perforatedSlab(2, 2), inDisk([](HyperbolicOptions& o) {
			 o.method = Method::FixedTriangles;
		 })},
		{"HyperbolicCones",
		 sphere,
		 inDisk([](HyperbolicOptions& o) {
			 o.target = HyperbolicTarget::SelectedCones;
			 o.coneAngle = 0.5;
		 }),
		 three},
		{"HyperbolicDisk", sheet, inDisk([](HyperbolicOptions& o) { o.freeBoundary = true; })},
		{"HyperbolicHoles", withoutStars(handles, {0, 30}), HyperbolicOptions()},
		{"ToSphere", sphere, SphereOptions()}};
}

class Invariance : public ::testing::TestWithParam<Call>
{
protected:
	Invariance() : m_call(GetParam()), m_reference(outcomeOf(m_call)), m_bits(bitsOf(m_reference))
	{
	}

	const FlowOptions* flowOptions() const
	{
		return std::visit(
			[](const auto& options) { return static_cast<const FlowOptions*>(&options); },
			m_call.options);
	}
	bool isToSphere() const { return std::holds_alternative<SphereOptions>(m_call.options); }
	bool isHyperbolic() const { return std::holds_alternative<HyperbolicOptions>(m_call.options); }
	bool isRefined() const
	{
		return flowOptions()->output == OutputTriangulation::CommonRefinement;
	}

	/// Whether places are read beside lengths: on the sphere, of caps and of pieces of faces.
	bool readsPlaces() const
	{
		return isToSphere() || isRefined() || m_reference.map.report.cappedHoles > 0;
	}

	/// What one more rounding of all coordinates makes of a measure: of lengths the last digit of the extent
	/// over the shortest, and of the solution of the flow's linear equations at most as many times that as
	/// there are vertices.
	double rounding(const SurfaceMesh& mesh) const
	{
		double extent = 0.0, shortest = std::numeric_limits<double>::infinity();
		for (const Point3& p : mesh.positions)
			extent = std::max({extent, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
		for (const Triangle& t : mesh.triangles)
			for (std::size_t k = 0; k < 3; ++k)
				shortest = std::min(
					shortest,
					distance(mesh.positions[at(t[k])], mesh.positions[at(t[(k + 1) % 3])]));
		return 16 * std::numeric_limits<double>::epsilon() * (extent / shortest) *
			   static_cast<double>(mesh.positions.size());
	}

	void expectSameBits(const SurfaceMesh& mesh) const
	{
		EXPECT_EQ(
			bitsOf(outcomeOf({m_call.name, mesh, m_call.options, m_call.input})) == m_bits, true);
	}

	/// All the same except for rounding, decisions included.
	Outcome expectAlike(const SurfaceMesh& mesh) const
	{
		const Outcome other = outcomeOf({m_call.name, mesh, m_call.options, m_call.input});
		const double tolerance = rounding(mesh);
		const auto now = figuresOf(other), before = figuresOf(m_reference);
		for (std::size_t i = 0; i < now.size(); ++i) {
			SCOPED_TRACE(now[i].name);
			// On a lattice many cuts are as good as each other, and rounding decides.
			if (now[i].kind == Figure::Count) {
				EXPECT_EQ(now[i].value, before[i].value);
			}
			const bool isLattice = m_call.name == "Box" || m_call.name == "Genus2LeastStretch";
			if (now[i].kind == Figure::Measure || (now[i].kind == Figure::Cut && !isLattice)) {
				EXPECT_NEAR(
					now[i].value,
					before[i].value,
					tolerance * std::max(1.0, std::abs(before[i].value)));
			}
		}
		expectSameFlow(other, tolerance, [](std::size_t v) { return v; });
		return other;
	}

	/// What the flow finds at vertices, except for the scale of a Euclidean metric.
	/// \param old the number of a vertex before
	void expectSameFlow(
		const Outcome& other,
		double tolerance,
		const std::function<std::size_t(std::size_t)>& old) const
	{
		const std::vector<double>&u = other.map.u, &before = m_reference.map.u;
		ASSERT_EQ(u.size(), before.size());
		const double shift = isHyperbolic() || u.empty() ? 0.0 : u[0] - before[old(0)];
		for (std::size_t v = 0; v < u.size(); ++v) {
			if (m_call.name != "ManyComponents") {
				EXPECT_NEAR(u[v] - before[old(v)], shift, tolerance) << v;
			}
			EXPECT_NEAR(
				other.map.targetCurvature[v], m_reference.map.targetCurvature[old(v)], tolerance)
				<< v;
		}
	}

	/// The same map on a mesh with other numbers or the other orientation: cuts may run elsewhere, and the
	/// finish ends a little earlier or later.
	void expectSameMap(
		const Call& call, const std::function<std::size_t(std::size_t)>& old, bool isMirrored) const
	{
		const Outcome other = outcomeOf(call);
		const double tolerance = rounding(call.mesh);
		const bool isFinishedHere =
			isFinished(*flowOptions()) && !isRefined() && !isHyperbolic() && !isToSphere();
		const auto now = figuresOf(other), before = figuresOf(m_reference);
		for (std::size_t i = 0; i < now.size(); ++i) {
			SCOPED_TRACE(now[i].name);
			const double size = std::max(1.0, std::abs(before[i].value));
			const std::string name = now[i].name;
			if (now[i].kind == Figure::Count) {
				EXPECT_EQ(now[i].value, before[i].value);
			}
			if (name == "torus_tau_re" && isMirrored && before[i].value != -1) {
				EXPECT_NEAR(now[i].value, -before[i].value, tolerance);
			}
			else if (now[i].kind == Figure::Measure) {
				EXPECT_NEAR(
					now[i].value, before[i].value, (isFinishedHere ? 5e-3 : tolerance) * size);
			}
			if (name == "objective") {
				EXPECT_NEAR(now[i].value, before[i].value, 0.01 * size);
			}
		}
		expectSameFlow(other, tolerance, old);
	}

	Call m_call;
	Outcome m_reference;
	std::string m_bits;
};

TEST_P(Invariance, AgainAfterOtherRuns)
{
	outcomeOf({"", torus(2, 1, 6, 5), Options()});
	outcomeOf({"", perforatedSlab(2, 1), HyperbolicOptions()});
	Options refused;
	refused.target = TargetCurvature::Disk;
	EXPECT_THROW(outcomeOf({"", tetrahedron(), refused}), InvalidOption);
	expectSameBits(m_call.mesh);
}

TEST_P(Invariance, InAMirror)
{
	// The flow sees lengths, which are the same to the bit.
	const SurfaceMesh mesh = stretched(m_call.mesh, {-1, 1, 1});
	if (isToSphere())
		expectAlike(mesh);
	else if (m_call.name != "TorusHiddenSeams") // whose hollows are ridges there
		expectSameBits(mesh);
	// With the faces seen from the other side as well, the surface is its mirror image.
	expectSameMap(
		{m_call.name, withReversedFaces(mesh, 1), m_call.options, m_call.input},
		[](std::size_t v) { return v; },
		true);
}

TEST_P(Invariance, Moved)
{
	SurfaceMesh mesh = m_call.mesh;
	for (Point3& p : mesh.positions)
		p = p + Point3{3, -5, 7};
	if (readsPlaces() || m_call.name == "Box") // whose thirds are not multiples of 2^-20
		expectAlike(mesh);
	else
		expectSameBits(mesh);
	expectAlike(turned(m_call.mesh, {0.4, 2.0, -0.7}));
}

TEST_P(Invariance, Scaled)
{
	for (const double factor : {1024.0, 0x1p-20})
		if (isHyperbolic()) // whose metric has a scale of its own
			expectSameBits(scaled(m_call.mesh, factor));
		else
			expectAlike(scaled(m_call.mesh, factor));
	for (const double factor : {1e9, 1e-9}) {
		const Outcome other = expectAlike(scaled(m_call.mesh, factor));
		if (m_call.name == "Box")
			continue;
		EXPECT_NEAR(
			other.map.report.seamLength,
			factor * m_reference.map.report.seamLength,
			1e-12 * factor * m_reference.map.report.seamLength);
	}
}

TEST_P(Invariance, Renumbered)
{
	Random random(78);
	const Renumbered other = renumbered(m_call.mesh, random);
	VertexInput input;
	for (const int v : other.vertex) {
		if (!m_call.input.selected.empty())
			input.selected.push_back(m_call.input.selected[at(v)]);
		if (!m_call.input.targetCurvature.empty())
			input.targetCurvature.push_back(m_call.input.targetCurvature[at(v)]);
	}
	expectSameMap(
		{m_call.name, other.mesh, m_call.options, input},
		[&](std::size_t v) { return at(other.vertex[v]); },
		false);
}

/// A vertex that no face uses, faces in the other order and faces without area change nothing for the others.
TEST_P(Invariance, WithStrayElements)
{
	const int count = static_cast<int>(m_call.mesh.positions.size());
	const std::size_t faces = m_call.mesh.triangles.size();
	Call stray = m_call;
	stray.mesh = withReversedFaces(m_call.mesh, 5);
	stray.mesh.positions.push_back({9, 9, 9});
	stray.mesh.triangles.push_back({3, 3, 3});
	stray.mesh.triangles.push_back(stray.mesh.triangles[0]);
	stray.mesh.triangles.back()[2] = stray.mesh.triangles.back()[1];
	if (!stray.input.selected.empty())
		stray.input.selected.push_back(0);
	if (!stray.input.targetCurvature.empty())
		stray.input.targetCurvature.push_back(0.0);
	const Outcome other = outcomeOf(stray);
	const std::vector<Point3>& onSphere = m_reference.sphere.positions;
	EXPECT_EQ(
		std::vector<Point3>(
			other.sphere.positions.begin(),
			other.sphere.positions.begin() + std::min<std::ptrdiff_t>(count, onSphere.size())),
		onSphere);
	if (isToSphere())
		return;
	const Parametrization &map = other.map, &before = m_reference.map;
	EXPECT_EQ(map.report.degenerateFaces, 2);
	EXPECT_EQ(map.report.charts, before.report.charts);
	EXPECT_NEAR(map.report.qcAreaMean, before.report.qcAreaMean, 1e-12);
	EXPECT_EQ(std::vector<double>(map.u.begin(), map.u.begin() + count), before.u);
	ASSERT_EQ(map.mesh.size(), before.mesh.size() + 2);
	for (const int f : before.mesh.points.indices()) {
		EXPECT_EQ(map.mesh.face[f], before.mesh.face[f]);
		const bool isReversed = map.mesh.face[f] % 5 == 0;
		Triangle2 triangle = map.mesh.at(f);
		if (isReversed)
			std::swap(triangle[1], triangle[2]);
		EXPECT_EQ(triangle, before.mesh.at(f)) << f;
	}
	EXPECT_EQ(map.mesh.face.values().back(), static_cast<int>(faces) + 1);
}

INSTANTIATE_TEST_SUITE_P(Runs, Invariance, ::testing::ValuesIn(calls()), CallName());

/// Each component is mapped as the mesh that it is.
TEST(Invariance, OfAComponentFromTheRestOfTheMesh)
{
	Random random(79);
	const SurfaceMesh donut = onGrid(bumpyTorus(10, 7, random)), sheet = bumpySheet(random);
	const SurfaceMesh two = onGrid(shaken(perforatedSlab(2, 2), 0.05, random));
	const SurfaceMesh three = onGrid(shaken(perforatedSlab(3, 1), 0.05, random));
	Options options, refined;
	options.normalizeUV = refined.normalizeUV = false;
	options.charts = refined.charts = Charts::OfTheFlow;
	refined.output = OutputTriangulation::CommonRefinement;
	HyperbolicOptions inDisk, refinedInDisk;
	inDisk.finish = refinedInDisk.finish = Finish::None; // of floats, which are others elsewhere
	refinedInDisk.output = OutputTriangulation::CommonRefinement;
	const Call pairs[] = {
		{"plane", donut, options},
		{"plane, refined", donut, refined},
		{"disk", two, inDisk},
		{"disk, refined", two, refinedInDisk}};
	for (const Call& call : pairs) {
		SCOPED_TRACE(call.name);
		const bool isHyperbolic = std::holds_alternative<HyperbolicOptions>(call.options);
		const SurfaceMesh& second = isHyperbolic ? three : sheet;
		const Parametrization pair =
			outcomeOf({call.name, sideBySide(call.mesh, second, 20), call.options}).map;
		const Parametrization alone[] = {
			outcomeOf(call).map, outcomeOf({call.name, second, call.options}).map};
		EXPECT_EQ(pair.report.components, 2);
		ASSERT_EQ(pair.charts.size(), 2u);
		std::vector<double> u, curvature;
		int triangle = 0;
		double areas = 0.0, qc = 0.0;
		for (std::size_t i = 0; i < 2; ++i) {
			u.insert(u.end(), alone[i].u.begin(), alone[i].u.end());
			curvature.insert(
				curvature.end(), alone[i].targetCurvature.begin(), alone[i].targetCurvature.end());
			areas += alone[i].mesh.size();
			qc += alone[i].mesh.size() * alone[i].report.qcMean;
			const FlatMesh& mesh = alone[i].mesh;
			const double scale = isHyperbolic ? pair.charts[i].box.width() : 1.0; // alone it is 1
			for (const int f : mesh.points.indices()) {
				EXPECT_EQ(pair.mesh.chart[triangle], static_cast<int>(i));
				const Triangle2 drawn = pair.mesh.at(triangle++);
				for (std::size_t k = 0; k < 3; ++k)
					EXPECT_NEAR(
						distance(drawn[k], drawn[(k + 1) % 3]),
						scale * distance(mesh.at(f)[k], mesh.at(f)[(k + 1) % 3]),
						1e-13 * (1.0 + pair.mesh.box().extent()));
			}
		}
		EXPECT_EQ(triangle, pair.mesh.size());
		EXPECT_EQ(pair.u, u);
		EXPECT_EQ(pair.targetCurvature, curvature);
		const Report &a = alone[0].report, &b = alone[1].report, &both = pair.report;
		EXPECT_EQ(both.iterations, a.iterations + b.iterations);
		EXPECT_EQ(both.genus, a.genus + b.genus);
		EXPECT_EQ(both.eulerCharacteristic, a.eulerCharacteristic + b.eulerCharacteristic);
		EXPECT_EQ(both.boundaryLoops, a.boundaryLoops + b.boundaryLoops);
		EXPECT_EQ(both.seamEdges, a.seamEdges + b.seamEdges);
		EXPECT_EQ(both.cones, a.cones + b.cones);
		EXPECT_EQ(both.flips, a.flips + b.flips);
		EXPECT_EQ(both.refinementPoints, a.refinementPoints + b.refinementPoints);
		EXPECT_EQ(both.flowStates.size(), a.flowStates.size() + b.flowStates.size());
		EXPECT_EQ(both.maxCurvatureError, std::max(a.maxCurvatureError, b.maxCurvatureError));
		EXPECT_EQ(both.residualFloor, std::max(a.residualFloor, b.residualFloor));
		EXPECT_NEAR(both.seamLength, a.seamLength + b.seamLength, 1e-12);
		EXPECT_NEAR(both.qcMean, qc / areas, 1e-9);
		if (isHyperbolic) {
			EXPECT_EQ(both.hyperbolicArea, *a.hyperbolicArea + *b.hyperbolicArea);
			EXPECT_EQ(both.relationError, std::max(*a.relationError, *b.relationError));
		}
		EXPECT_TRUE(isHyperbolic || a.torusTauIm || a.cones > 0);
		EXPECT_FALSE(both.torusTauIm) << "of a component alone";
		EXPECT_TRUE(both.periodMatrix.empty());
		EXPECT_TRUE(both.choice.empty());
	}
}

#ifdef __linux__
/// Runs that share their work among threads.
std::vector<Call> threadedRuns()
{
	Random random(80);
	SurfaceMesh many;
	for (int i = 0; i < 40; ++i)
		many = sideBySide(many, bumpyTorus(8, 5 + i % 3, random), 12.0 * i);
	const SurfaceMesh handles = shaken(perforatedSlab(2, 4), 0.02, random);
	Options refined, placed;
	refined.output = OutputTriangulation::CommonRefinement;
	placed.target = TargetCurvature::PlacedCones;
	placed.cones.count = 8;
	HyperbolicOptions inDisk;
	inDisk.output = OutputTriangulation::CommonRefinement;
	inDisk.canonicalGenerators = true;
	return {
		{"Large", bumpyTorus(110, 90, random), placed},
		{"Unfolded", perforatedSlab(1, 6), Options()},
		{"Refined", handles, refined},
		{"Hyperbolic", handles, inDisk},
		{"ManyComponents", many, Options()}};
}

/// Threads are counted once, so that each number of them takes a process.
class Threads : public ::testing::TestWithParam<Call>
{
protected:
	static constexpr const char* kFile = "RICCI_TEST_BITS";

	/// The bits that this very test finds in another process.
	static std::string bitsWith(int threads)
	{
		const std::string file = ::testing::TempDir() + "ricci_bits_" + std::to_string(getpid());
		const std::string command =
			"RICCI_TEST_THREADS=" + std::to_string(threads) + " " + kFile + "='" + file +
			"' /proc/self/exe --gtest_brief=1 --gtest_filter='" +
			"Runs/Threads.TheirNumberChangesNoBit/" + GetParam().name + "' >/dev/null";
		char self[4096];
		const ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
		if (length <= 0)
			return "";
		std::string own = command;
		own.replace(
			own.find("/proc/self/exe"), 14, "'" + std::string(self, std::size_t(length)) + "'");
		EXPECT_EQ(std::system(own.c_str()), 0) << own;
		std::ifstream in(file, std::ios::binary);
		const std::string bits((std::istreambuf_iterator<char>(in)), {});
		std::remove(file.c_str());
		return bits;
	}
};

TEST_P(Threads, TheirNumberChangesNoBit)
{
	if (const char* file = std::getenv(kFile)) {
		std::ofstream(file, std::ios::binary) << bitsOf(outcomeOf(GetParam()));
		return;
	}
	const std::string one = bitsWith(1);
	EXPECT_GT(one.size(), 1000u);
	EXPECT_EQ(bitsWith(3) == one, true);
}

INSTANTIATE_TEST_SUITE_P(Runs, Threads, ::testing::ValuesIn(threadedRuns()), CallName());
#endif

} // namespace
} // namespace ricci::testing
