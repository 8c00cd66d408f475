// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever goes wrong in the middle of a run, the mesh is bit for bit what it was.
#include "support/decimal_commas.h"
#include "support/expect.h"
#include "support/failing_malloc.h"
#include "support/listener.h"
#include "support/mesh_contents.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/vcg_mesh.h"

#include <vcg/complex/algorithms/parametrization/ricci_flow_layers.h>

#include <ricci/base/memory_estimate.h>
#include <ricci/base/numbers.h>
#include <ricci/base/parallel.h>
#include <ricci/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cfenv>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif
namespace ricci::testing {
namespace {

using Mesh = FloatMesh;
using Flow = vcg::tri::RicciFlow<Mesh>;
using Layers = vcg::tri::RicciFlowLayers<Mesh>;

struct Case
{
	const char* name;
	SurfaceMesh mesh;
	Flow::Params params;
};

Flow::Params
params(TargetCurvature target, OutputTriangulation output, Method method = Method::IntrinsicFlips)
{
	Flow::Params p;
	p.target = target;
	p.output = output;
	p.method = method;
	p.charts = Charts::WithoutOverlap;
	return p;
}

/// Small meshes that between them reach every stage: flips, the double, splits, seams, packing. Cuts for room,
/// for which charts are packed again and again, are left to one of the ways().
std::vector<Case> cases()
{
	Random random(500);
	const SurfaceMesh torus = shaken(bumpyTorus(5, 4, random), 0.4, random);
	const SurfaceMesh sheet = shaken(rectangle(3, 3, 3, 3), 0.35, random);
	return {
		{"torus, refined",
		 torus,
		 params(TargetCurvature::Automatic, OutputTriangulation::CommonRefinement)},
		{"torus, kept",
		 bumpyTorus(5, 4, random),
		 params(TargetCurvature::Automatic, OutputTriangulation::KeepMesh, Method::FixedTriangles)},
		{"disk, round",
		 sheet,
		 params(TargetCurvature::Disk, OutputTriangulation::CommonRefinement)},
		{"disk, swaps",
		 sheet,
		 params(TargetCurvature::Automatic, OutputTriangulation::KeepMesh, Method::EdgeSwaps)},
		{"two disks",
		 sideBySide(sheet, rectangle(1, 2, 1, 1), 9),
		 params(TargetCurvature::Automatic, OutputTriangulation::KeepMesh)}};
}

void build(const SurfaceMesh& shape, Mesh& m)
{
	toVcg(shape, m);
	float value = 0.0f;
	for (auto& v : m.vert)
		v.Q() = value += 0.25f;
	for (auto& f : m.face)
		for (int k = 0; k < 3; ++k) {
			f.WT(k).U() = value += 0.125f;
			f.WT(k).N() = 3;
		}
}

void write(Mesh& m, const Flow::Params& params, const Flow::Result& result)
{
	if (params.output == OutputTriangulation::CommonRefinement) {
		Flow::WriteRefinement(m, result);
		return;
	}
	Flow::WriteVertexQuality(m, result);
	Flow::WriteWedgeTexCoord(m, result);
}

/// Fails the n-th allocation of \p action, for n = 0, 1, ... until it runs through without one.
/// \param check is called after each try, with whether the action came to its end, the number of
/// failures, and n
/// \return how many n were tried
template<class Prepare, class Action, class Check>
long failEveryAllocation(Failing which, Prepare prepare, Action action, Check check)
{
	for (long n = 0;; ++n) {
		prepare();
		bool completed = false, expected = true;
		FailingMalloc failing(n, which);
		try {
			action();
			completed = true;
		}
		catch (const std::bad_alloc&) {
		}
		catch (...) {
			expected = false;
		}
		failing.end();
		EXPECT_EQ(failing.freedTwice(), 0) << "freed twice after the failure of allocation " << n;
		EXPECT_TRUE(expected) << "another exception than bad_alloc at allocation " << n;
		check(completed, failing.failures(), n);
		if (failing.failures() == 0 || ::testing::Test::HasFailure())
			return n;
	}
}

class CancelAt : public Progress
{
public:
	explicit CancelAt(int call) : m_call(call) {}
	bool update(double fraction, const std::string& what) override
	{
		EXPECT_GE(fraction, m_fraction) << what;
		EXPECT_LE(fraction, 1.0) << what;
		EXPECT_FALSE(what.empty());
		newtonSteps += what.rfind("Newton step", 0) == 0;
		m_fraction = fraction;
		return calls++ != m_call;
	}
	int calls = 0, newtonSteps = 0;

private:
	int m_call;
	double m_fraction = 0.0;
};

/// A way through the façade that reads \p m and writes nothing; it returns the Newton steps it tells of.
struct Way
{
	const char* name;
	SurfaceMesh mesh;
	std::function<int(const Mesh& m)> run;
};

std::vector<Way> ways()
{
	std::vector<Way> all;
	for (const Case& c : cases())
		all.push_back({c.name, c.mesh, [p = c.params](const Mesh& m) {
						   return Flow::Compute(m, p).report.iterations;
					   }});
	const auto hyperbolic = [](const Mesh& m) {
		Flow::HyperbolicParams p;
		p.output = OutputTriangulation::CommonRefinement;
		p.canonicalGenerators = true;
		const Flow::Result result = Flow::ComputeHyperbolic(m, p);
		Mesh flat, cover, axes, polygon;
		Layers::BuildFlatMesh(result, flat);
		Layers::BuildUniversalCover(result, 1, 100000, cover);
		Layers::BuildAxes(result, 10, axes);
		Layers::BuildCanonicalPolygons(result, 10, polygon);
		return result.report.iterations;
	};
	const auto euclidean = [](Flow::Params p) {
		return [p](const Mesh& m) {
			Mesh flat;
			const Flow::Result result = Flow::Compute(m, p);
			Layers::BuildFlatMesh(result, flat);
			return result.report.iterations;
		};
	};
	Flow::Params cones, capped;
	cones.cones.count = 5;
	capped.holes = Holes::Capped;
	capped.charts = Charts::WithoutOverlap;
	all.push_back({"hyperbolic", perforatedSlab(2, 1), hyperbolic});
	all.push_back({"placed cones", perforatedSlab(0, 1), euclidean(cones)});
	all.push_back({"capped ring", ring(1, 2, 5, 2), euclidean(capped)});
	all.push_back({"sphere", perforatedSlab(0, 1), [](const Mesh& m) {
					   Mesh sphere;
					   Layers::BuildSphereMesh(m, Flow::ComputeSphere(m, {}), sphere);
					   return 0;
				   }});
	return all;
}

TEST(Faults, TheNthAllocationFailsAndABlockFreedTwiceIsSeen)
{
	RICCI_NEEDS_FAILING_MALLOC();
	// By way of pointers, so that the compiler knows nothing of what they do.
	void* (*volatile allocate)(std::size_t) = std::malloc;
	void (*volatile release)(void*) = std::free;
	for (Failing which : {Failing::One, Failing::AllThatFollow}) {
		FailingMalloc failing(2, which);
		void* blocks[5];
		for (void*& block : blocks)
			block = allocate(100);
		release(blocks[0]);
		release(blocks[0]);
		release(blocks[1]);
		failing.end();
		for (int i : {0, 1})
			EXPECT_NE(blocks[i], nullptr);
		EXPECT_EQ(blocks[2], nullptr);
		for (int i : {3, 4}) {
			EXPECT_EQ(blocks[i] == nullptr, which == Failing::AllThatFollow);
			release(blocks[i]);
		}
		EXPECT_EQ(failing.failures(), which == Failing::One ? 1 : 3);
		EXPECT_EQ(failing.freedTwice(), 1);
	}
}

/// Every way, with memory that runs out at each allocation in turn.
class OutOfMemory : public ::testing::TestWithParam<Failing>
{
};

TEST_P(OutOfMemory, OnAnyWayLeavesTheMesh)
{
	RICCI_NEEDS_FAILING_MALLOC();
	for (const Way& way : ways()) {
		Mesh m;
		build(way.mesh, m);
		const std::string before = contents(m);
		const long tried = failEveryAllocation(
			GetParam(),
			[] {},
			[&] { way.run(m); },
			[&](bool completed, long failures, long n) {
				EXPECT_EQ(contents(m) == before, true) << way.name << ", allocation " << n;
				// What goes on after a failure had a way round it (CHOLMOD's).
				if (GetParam() == Failing::AllThatFollow && failures > 0) {
					EXPECT_FALSE(completed) << way.name << ", allocation " << n;
				}
			});
		EXPECT_GT(tried, 100) << way.name;
	}
}

INSTANTIATE_TEST_SUITE_P(
	Faults,
	OutOfMemory,
	::testing::Values(Failing::One, Failing::AllThatFollow),
	[](const auto& which) {
		return which.param == Failing::One ? "AtOneAllocation" : "AtAllThatFollow";
	});

TEST(Faults, OutOfMemoryWhileWritingLeavesTheMesh)
{
	RICCI_NEEDS_FAILING_MALLOC();
	for (const Case& c : cases())
		for (Failing which : {Failing::One, Failing::AllThatFollow}) {
			Mesh original;
			build(c.mesh, original);
			const Flow::Result result = Flow::Compute(original, c.params);
			std::unique_ptr<Mesh> m;
			std::string before;
			const long tried = failEveryAllocation(
				which,
				[&] {
					m = std::make_unique<Mesh>();
					build(c.mesh, *m);
					before = contents(*m);
				},
				[&] { write(*m, c.params, result); },
				[&](bool completed, long, long n) {
					if (!completed) {
						EXPECT_EQ(contents(*m) == before, true) << c.name << ", allocation " << n;
					}
				});
			EXPECT_GT(tried, 1) << c.name;
		}
}

TEST(Faults, WithoutMemoryForThreadsTheWorkIsDoneAllTheSame)
{
	RICCI_NEEDS_FAILING_MALLOC();
	constexpr int kCount = 100000;
	std::vector<int> done;
	const long tried = failEveryAllocation(
		Failing::AllThatFollow,
		[&] { done.assign(kCount, 0); },
		[&] {
			inParallel(kCount, 4, [&](int first, int last) {
				for (int i = first; i < last; ++i)
					++done[at(i)];
			});
		},
		[&](bool completed, long, long n) {
			EXPECT_TRUE(completed) << "allocation " << n;
			EXPECT_EQ(std::count(done.begin(), done.end(), 1), kCount) << "allocation " << n;
		});
	EXPECT_GT(tried, 1);
}

TEST(Faults, WithoutMemoryForAThreadBothAreDoneAllTheSame)
{
	RICCI_NEEDS_FAILING_MALLOC();
	int main = 0, aside = 0;
	const long tried = failEveryAllocation(
		Failing::AllThatFollow,
		[&] { main = aside = 0; },
		[&] {
			besides(
				2, [&] { ++main; }, [&] { ++aside; });
		},
		[&](bool completed, long, long n) {
			EXPECT_TRUE(completed) << "allocation " << n;
			EXPECT_EQ(main, 1) << "allocation " << n;
			EXPECT_EQ(aside, 1) << "allocation " << n;
		});
	EXPECT_GT(tried, 1);
}

TEST(Faults, WhatIsThrownBesidesIsThrownOn)
{
	struct Main
	{
	};
	struct Aside
	{
	};
	for (const int threads : {1, 2}) {
		bool done = false;
		EXPECT_THROW(
			besides(
				threads, [] { throw Main(); }, [&] { done = true; }),
			Main);
		EXPECT_THROW(
			besides(
				threads, [] {}, [] { throw Aside(); }),
			Aside);
		// The tick of the other thread ends it once the main one has thrown.
		if (threads == 1)
			continue;
		std::atomic<bool> isRunning{false};
		EXPECT_THROW(
			besides(
				threads,
				[&] {
					while (!isRunning)
						std::this_thread::yield();
					throw Main();
				},
				[&] {
					isRunning = true;
					for (;;)
						checkpoint();
				}),
			Main);
		// While it waits, the calling thread hears Cancel.
		Listener impatient(1);
		const Task task(impatient);
		EXPECT_THROW(
			besides(
				threads,
				[] {},
				[] {
					for (;;)
						checkpoint();
				}),
			Cancelled);
	}
}

TEST(Faults, CancellingAnyWayAtAnyCallLeavesTheMesh)
{
	for (const Way& way : ways()) {
		Mesh m;
		build(way.mesh, m);
		const std::string before = contents(m);
		CancelAt never(-1);
		EXPECT_GE(never.newtonSteps, heard(never, [&] { return way.run(m); })) << way.name;
		EXPECT_GT(never.calls, 3) << way.name;
		for (int call = 0; call < never.calls; ++call) {
			CancelAt cancel(call);
			EXPECT_THROW(heard(cancel, [&] { return way.run(m); }), Cancelled) << way.name;
			EXPECT_EQ(cancel.calls, call + 1) << "called again after a refusal to go on";
			EXPECT_EQ(contents(m) == before, true) << way.name << ", call " << call;
		}
	}
}

/// The error of type \p Refusal with which \p run refuses \p m; the mesh must stay as it was.
template<class Refusal, class Run>
Refusal refusalOf(const Mesh& m, const Run& run)
{
	const std::string before = contents(m);
	const std::optional<Refusal> refused = errorOf<Refusal>(run);
	EXPECT_EQ(contents(m) == before, true);
	return refused.value(); // throws if the mesh was accepted
}
template<class Refusal>
Refusal refusal(const Mesh& m, const Flow::Params& p)
{
	return refusalOf<Refusal>(m, [&] { Flow::Compute(m, p); });
}

TEST(Faults, ASolverThatDoesNotConvergeLeavesTheMesh)
{
	// All the negative curvature of many handles is moved to one small hole.
	Mesh m;
	build(withoutStars(perforatedSlab(40, 3), {0}), m);
	for (auto& v : m.vert)
		v.Q() = 0.0f;
	Flow::Params p;
	p.target = TargetCurvature::Prescribed;
	EXPECT_EQ(refusal<InadmissibleCurvature>(m, p).problem, InadmissibleCurvature::ScalesApart);
	p.target = TargetCurvature::Automatic;
	p.cones.distortion = 1e9; // none
	EXPECT_EQ(refusal<NotConverged>(m, p).problem, NotConverged::LostInRounding);

	// More than a straight angle for each triangle at one vertex.
	Mesh slab;
	build(perforatedSlab(4, 1), slab);
	for (auto& v : slab.vert)
		v.Q() = 0.0f;
	slab.vert[0].Q() = static_cast<float>(-11.9 * kPi);
	Flow::HyperbolicParams kept;
	kept.method = Method::FixedTriangles;
	kept.target = HyperbolicTarget::Prescribed;
	const auto broken = refusalOf<NotConverged>(slab, [&] { Flow::ComputeHyperbolic(slab, kept); });
	EXPECT_EQ(broken.problem, NotConverged::BrokenTriangles);
}

TEST(Faults, ATimeLimitLeavesTheMesh)
{
	/// Takes a while over its first call.
	class Slow : public Progress
	{
	public:
		bool update(double, const std::string&) override
		{
			if (calls++ == 0)
				std::this_thread::sleep_for(std::chrono::milliseconds(20));
			return true;
		}
		int calls = 0;
	};
	for (const Case& c : cases()) {
		Mesh m;
		build(c.mesh, m);
		const std::string before = contents(m);
		Slow slow;
		try {
			const Task task(slow, 0.01);
			Flow::Compute(m, c.params);
			ADD_FAILURE() << c.name << " takes no time";
		}
		catch (const TimeOut& late) {
			EXPECT_EQ(late.limit, 0.01);
			EXPECT_GT(late.elapsed, late.limit);
			EXPECT_LT(late.done, 1.0);
			EXPECT_NE(std::string(late.what()).find("limit: 0.01 seconds)"), std::string::npos);
		}
		EXPECT_EQ(slow.calls, 1) << c.name;
		EXPECT_EQ(contents(m) == before, true) << c.name;
	}
}

/// A time limit ends runs that are not done: until the coordinates are finished, none is.
TEST(Faults, TheWorkIsDoneAtTheLastUpdateOnly)
{
	const auto expectDoneAtTheEnd = [](const auto& run) {
		Listener record;
		heard(record, run);
		ASSERT_GT(record.calls(), 2);
		EXPECT_EQ(record.fractions.front(), 0.0);
		EXPECT_EQ(record.fractions.back(), 1.0);
		EXPECT_LT(*std::prev(record.fractions.end(), 2), 1.0);
	};
	for (const Case& c : cases()) {
		SCOPED_TRACE(c.name);
		Mesh m;
		build(c.mesh, m);
		expectDoneAtTheEnd([&] { return Flow::Compute(m, c.params); });
	}
	Mesh m;
	build(perforatedSlab(2, 1), m);
	expectDoneAtTheEnd([&] { return Flow::ComputeHyperbolic(m, {}); });
}

TEST(Faults, ATimeLimitThatIsNotReachedChangesNothing)
{
	for (const Case& c : cases())
		for (double seconds : {0.0, 1e6}) {
			Mesh m;
			build(c.mesh, m);
			const auto expected = Flow::Compute(m, c.params).mesh.corners();
			Progress silent;
			const Task task(silent, seconds);
			EXPECT_EQ(Flow::Compute(m, c.params).mesh.corners(), expected) << c.name;
		}
}

bool startsWith(const Error& error, const char* words)
{
	return std::string(error.what()).rfind(words, 0) == 0;
}

TEST(Faults, AnEstimateAboveTheMemoryIsRefused)
{
	Mesh m;
	build(rectangle(20, 20, 1, 1), m);
	Flow::Params p;
	Progress silent;
	Task task(silent);
	task.setMemoryLimit(1000);
	const TooLarge refused = refusal<TooLarge>(m, p);
	EXPECT_EQ(refused.problem, TooLarge::Memory);
	EXPECT_EQ(refused.count, 800u);
	EXPECT_EQ(refused.needed, estimatedMemory(800, 800, false));
	EXPECT_EQ(refused.limit, 1000.0);
	EXPECT_TRUE(startsWith(refused, "The mesh has 800 faces")) << refused.what();
	task.setMemoryLimit(1e9);
	EXPECT_NO_THROW(Flow::Compute(m, p));
	EXPECT_NO_THROW(requireMemory(10000, 10000, false));
	EXPECT_THROW(requireMemory(400000000, 400000000, false), TooLarge);
}

TEST(Faults, ADoubleAboveTheMemoryIsRefused)
{
	// A strip that becomes a round disk: its boundary edges have to flip.
	const SurfaceMesh strip = rectangle(60, 1, 60, 2);
	const std::size_t faces = strip.triangles.size();
	Mesh m;
	build(strip, m);
	Flow::Params p = params(TargetCurvature::Disk, OutputTriangulation::KeepMesh);
	const double limit = 1.1 * estimatedMemory(faces, faces, false);
	Progress silent;
	Task task(silent);
	task.setMemoryLimit(limit);
	const TooLarge tooLarge = refusal<TooLarge>(m, p);
	EXPECT_EQ(tooLarge.problem, TooLarge::DoubleMemory);
	EXPECT_EQ(tooLarge.count, 2 * faces);
	EXPECT_GT(tooLarge.needed, tooLarge.limit);
	EXPECT_EQ(tooLarge.limit, limit);
	EXPECT_TRUE(startsWith(tooLarge, "Boundary edges have to flip")) << tooLarge.what();
	task.setMemoryLimit(0.0);
	// The disk's ends are e^-47 of its middle (crowding).
	const NotConverged lost = refusal<NotConverged>(m, p);
	EXPECT_EQ(lost.problem, NotConverged::LostInRounding);
	EXPECT_GT(lost.count, 0u);
	EXPECT_NE(std::string(lost.what()).find("lost in rounding"), std::string::npos) << lost.what();
}

/// A cylinder closed by two fans of \p n triangles, which the flow's edges cross about n^2 / 2 times.
SurfaceMesh drum(int n)
{
	return revolved({{0, 0}, {1, 0}, {1, 3}, {0, 3}}, n);
}

TEST(Faults, AnOverlayAboveTheMemoryIsRefused)
{
	Mesh m;
	const SurfaceMesh shape = drum(200);
	build(shape, m);
	Flow::Params p = params(TargetCurvature::PlacedCones, OutputTriangulation::CommonRefinement);
	Progress silent;
	Task task(silent);
	task.setMemoryLimit(
		1.2 * estimatedMemory(shape.triangles.size(), shape.triangles.size(), true));
	const TooLarge refused = refusal<TooLarge>(m, p);
	EXPECT_EQ(refused.problem, TooLarge::OverlayMemory);
	EXPECT_GT(refused.needed, refused.limit);
	EXPECT_TRUE(startsWith(refused, "The edges after the flow cross")) << refused.what();
	task.setMemoryLimit(1e9);
	EXPECT_NO_THROW(Flow::Compute(m, p));
	EXPECT_THROW(requireOverlayMemory(1000000000, false), TooLarge);
}

/// The overlay is heard while it grows, not only before and after.
TEST(Faults, CancellingWithinTheOverlayLeavesTheMesh)
{
	Mesh m;
	build(drum(300), m);
	const std::string before = contents(m);
	const Flow::Params p =
		params(TargetCurvature::PlacedCones, OutputTriangulation::CommonRefinement);
	Listener all(1000000, "verlay");
	EXPECT_NO_THROW(heard(all, [&] { return Flow::Compute(m, p); }));
	EXPECT_GE(all.calls(), 5);
	for (int n = 1; n <= all.calls(); ++n) {
		Listener progress(n, "verlay");
		EXPECT_THROW(heard(progress, [&] { return Flow::Compute(m, p); }), Cancelled);
		EXPECT_EQ(progress.calls(), n);
		EXPECT_EQ(contents(m) == before, true);
	}
}

TEST(Faults, TheMemoryEstimateGrowsWithTheMeshAndTheRefinement)
{
	const bool kept = false, refined = true;
	for (std::size_t n : {1000u, 100000u, 10000000u}) {
		EXPECT_GE(estimatedMemory(2 * n, 2 * n, kept), 2 * estimatedMemory(n, n, kept));
		EXPECT_LT(estimatedMemory(2 * n, 2 * n, kept), 3 * estimatedMemory(n, n, kept));
		EXPECT_GT(estimatedMemory(n, n, refined), estimatedMemory(n, n, kept));
		EXPECT_LT(estimatedMemory(n / 100, n, kept), estimatedMemory(n, n, kept));
	}
}

TEST(Faults, AHostThatTrapsFloatingPointExceptionsGetsTheSameResult)
{
#ifdef __GLIBC__
	for (const Case& c : cases()) {
		Mesh m;
		build(c.mesh, m);
		const auto expected = Flow::Compute(m, c.params);
		const int traps = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
		std::fesetround(FE_UPWARD);
		feclearexcept(FE_ALL_EXCEPT);
		feenableexcept(traps);
		const auto found = Flow::Compute(m, c.params);
		const int trapsLeft = fegetexcept(), rounding = std::fegetround();
		fedisableexcept(traps);
		std::fesetround(FE_TONEAREST);
		EXPECT_EQ(trapsLeft, traps) << c.name;
		EXPECT_EQ(rounding, FE_UPWARD) << c.name;
		EXPECT_EQ(found.u, expected.u) << c.name;
		EXPECT_EQ(found.mesh.corners(), expected.mesh.corners()) << c.name;
		EXPECT_EQ(found.report.maxCurvatureError, expected.report.maxCurvatureError) << c.name;
	}
#else
	GTEST_SKIP() << "SKIPPED: floating-point traps can be set with glibc only";
#endif
}

TEST(Faults, AHostWithDecimalCommasGetsTheSame)
{
	const auto all = [] {
		std::string text;
		for (const Case& c : cases()) {
			Mesh m;
			build(c.mesh, m);
			const std::string before = contents(m);
			Listener listener;
			const Flow::Result result = heard(listener, [&] { return Flow::Compute(m, c.params); });
			Flow::Params refused = c.params;
			refused.epsilon = -0.5;
			try {
				heard(listener, [&] { return Flow::Compute(m, refused); });
			}
			catch (const Error& error) {
				listener.log(error.what());
			}
			EXPECT_EQ(contents(m) == before, true) << c.name;
			write(m, c.params, result);
			for (const std::string& line : listener.lines)
				text += line + "\n";
			text += contents(m);
		}
		return text;
	};
	const std::string wanted = all();
	EXPECT_NE(wanted.find("must be greater than 0 radians, not -0.5\n"), std::string::npos);
	const DecimalCommas commas;
	if (!commas.found())
		GTEST_SKIP() << "SKIPPED: this machine has no locale with decimal commas, nor localedef "
						"and Debian's package locales to make one";
	EXPECT_EQ(all() == wanted, true);
}

#ifdef __linux__
/// While it lives the whole pages of a vector's storage cannot be written: an attempt ends the
/// process. The pages at both ends, which the vector shares with others, stay as they are.
template<class T>
class ReadOnly
{
public:
	explicit ReadOnly(std::vector<T>& items)
	{
		const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
		const auto first = reinterpret_cast<std::uintptr_t>(items.data());
		const auto last = first + items.size() * sizeof(T);
		m_begin = (first + page - 1) / page * page;
		m_size = last / page * page - m_begin;
		m_works = protect(PROT_READ);
	}
	~ReadOnly() { protect(PROT_READ | PROT_WRITE); }
	ReadOnly(const ReadOnly&) = delete;
	ReadOnly& operator=(const ReadOnly&) = delete;

	/// Whether there is such a page, and the system protects it.
	bool works() const { return m_works && m_size > 0; }

private:
	bool protect(int access) const
	{
		return mprotect(reinterpret_cast<void*>(m_begin), m_size, access) == 0;
	}

	std::uintptr_t m_begin = 0;
	std::size_t m_size = 0;
	bool m_works = false;
};
TEST(Faults, AReadOnlyMeshIsOnlyRead)
{
	Random random(503);
	for (const SurfaceMesh& shape : {bumpyTorus(40, 30, random), rectangle(30, 30, 1, 1)})
		for (OutputTriangulation output :
			 {OutputTriangulation::KeepMesh, OutputTriangulation::CommonRefinement}) {
			Mesh m;
			build(shape, m);
			const std::string before = contents(m);
			{
				const ReadOnly vertices(m.vert);
				const ReadOnly faces(m.face);
				ASSERT_TRUE(vertices.works() && faces.works());
				Flow::Compute(m, params(TargetCurvature::Automatic, output));
				EXPECT_EQ(
					refusal<InvalidOption>(m, params(TargetCurvature::SelectedCones, output))
						.problem,
					InvalidOption::NothingSelected);
			}
			EXPECT_EQ(contents(m) == before, true);
		}
}
#endif

TEST(Faults, ASecondRunGivesTheSame)
{
	int compared = 0;
	for (const Case& c : cases()) {
		if (c.params.output == OutputTriangulation::CommonRefinement)
			continue; // the second run has another mesh
		++compared;
		Mesh m;
		build(c.mesh, m);
		const auto first = Flow::Compute(m, c.params);
		write(m, c.params, first);
		const std::string after = contents(m);
		const auto second = Flow::Compute(m, c.params);
		write(m, c.params, second);
		EXPECT_EQ(second.u, first.u) << c.name;
		EXPECT_EQ(contents(m) == after, true) << c.name;
	}
	EXPECT_GT(compared, 0);
}

/// What is written on a mesh, and the numbers of the report behind it.
template<class AnyMesh>
std::string written(AnyMesh& m, const typename vcg::tri::RicciFlow<AnyMesh>::Result& result)
{
	vcg::tri::RicciFlow<AnyMesh>::WriteVertexQuality(m, result);
	vcg::tri::RicciFlow<AnyMesh>::WriteWedgeTexCoord(m, result);
	const auto& r = result.report;
	std::string all = contents(m);
	for (double value :
		 {r.maxCurvatureError, r.residualFloor, r.qcMean, r.qcVertexMean, r.seamLength})
		all.append(reinterpret_cast<const char*>(&value), sizeof value);
	return all;
}

TEST(Faults, TwoMeshesInTurnGetWhatEachGetsAlone)
{
	using DoubleFlow = vcg::tri::RicciFlow<DoubleMesh>;
	Random random(504);
	const SurfaceMesh torus = shaken(bumpyTorus(8, 6, random), 0.3, random);
	const SurfaceMesh slab = perforatedSlab(2, 1);
	DoubleFlow::Params placed;
	placed.cones.count = 4;
	DoubleFlow::Params refused;
	refused.target = TargetCurvature::Disk;

	std::string torusAlone, slabAlone, conesAlone;
	{
		Mesh m;
		build(torus, m);
		torusAlone = written(m, Flow::Compute(m, {}));
	}
	{
		DoubleMesh m;
		toVcg(slab, m);
		slabAlone = written(m, DoubleFlow::ComputeHyperbolic(m, {}));
		conesAlone = written(m, DoubleFlow::Compute(m, placed));
	}

	Mesh a;
	DoubleMesh b;
	build(torus, a);
	toVcg(slab, b);
	const std::string before = contents(b);
	EXPECT_THROW(DoubleFlow::Compute(b, refused), Error);
	const auto first = Flow::Compute(a, {});
	const auto disk = DoubleFlow::ComputeHyperbolic(b, {});
	EXPECT_EQ(contents(b) == before, true);
	EXPECT_EQ(written(a, first) == torusAlone, true);
	EXPECT_EQ(contents(b) == before, true);
	const auto again = Flow::Compute(a, {});
	EXPECT_EQ(written(b, disk) == slabAlone, true);
	EXPECT_THROW(DoubleFlow::Compute(b, refused), Error);
	EXPECT_EQ(written(a, again) == torusAlone, true);
	EXPECT_EQ(written(b, DoubleFlow::Compute(b, placed)) == conesAlone, true);
}

TEST(Faults, AnAttributeOfAnotherTypeIsReplaced)
{
	Mesh m;
	build(rectangle(2, 2, 1, 1), m);
	using Allocator = vcg::tri::Allocator<Mesh>;
	Allocator::AddPerVertexAttribute<vcg::Point3d>(m, "ricci_u");
	auto old = Allocator::AddPerVertexAttribute<float>(m, "ricci_target_curvature");
	for (std::size_t v = 0; v < m.vert.size(); ++v)
		old[v] = 7.0f;
	const auto result = Flow::Compute(m, {});
	Flow::WriteVertexQuality(m, result);
	EXPECT_EQ(m.vert_attr.size(), 2u);
	auto u = Allocator::FindPerVertexAttribute<float>(m, "ricci_u");
	auto target = Allocator::FindPerVertexAttribute<float>(m, "ricci_target_curvature");
	ASSERT_TRUE(Allocator::IsValidHandle(m, u));
	ASSERT_TRUE(Allocator::IsValidHandle(m, target));
	for (std::size_t v = 0; v < m.vert.size(); ++v) {
		EXPECT_EQ(u[v], static_cast<float>(result.u[v]));
		EXPECT_EQ(target[v], static_cast<float>(result.targetCurvature[v]));
	}
}

} // namespace
} // namespace ricci::testing
