// SPDX-License-Identifier: GPL-3.0-or-later
// A run that reports to a listener and is ended: at every call of its listener it leaves at once, because of the
// listener's answer or of the clock, and the mesh is bit for bit what it was. What a listener itself throws passes
// through.
#include "support/calls.h"
#include "support/expect.h"
#include "support/facade_runs.h"
#include "support/listener.h"
#include "support/mesh_contents.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <set>
#include <thread>

namespace ricci::testing {
namespace {

/// Receives all calls, and does something at one of them.
class Caller : public Progress
{
public:
	explicit Caller(
		int call = -1, std::function<bool()> act = [] { return false; }) :
			m_call(call),
			m_act(std::move(act))
	{
	}

	bool update(double fraction, const std::string& what) override
	{
		fractions.push_back(fraction);
		stages.push_back(what.substr(0, what.find_first_of("0123456789")));
		return static_cast<int>(fractions.size()) - 1 != m_call || m_act();
	}

	std::vector<double> fractions;
	std::vector<std::string> stages; ///< [call] what it names, up to the first number

private:
	int m_call;
	std::function<bool()> m_act;
};

/// Those of facadeRuns(), and one for each further stage.
std::vector<FacadeRun> runs()
{
	using Facade = vcg::tri::RicciFlow<FloatMesh>;
	std::vector<FacadeRun> all = facadeRuns();
	const auto add = [&](const char* name, const SurfaceMesh& mesh, const Options& options) {
		all.push_back({name, mesh, [options](const FloatMesh& m) {
						   return Facade::Compute(m, options).report.iterations;
					   }});
	};
	Random random(501);
	Options quarters, stretch, hidden, rectangle;
	quarters.target = TargetCurvature::PlacedCones;
	quarters.cones.rounding = ConeRounding::QuarterTurns;
	stretch.finish = Finish::LeastStretch;
	hidden.seamHiding = 1.0;
	rectangle.target = TargetCurvature::Rectangle;
	const SurfaceMesh handle = shaken(perforatedSlab(1, 1), 0.1, random);
	add("Unfolded", perforatedSlab(0, 2), {});
	add("QuarterTurns", handle, quarters);
	add("LeastStretch", handle, stretch);
	add("HiddenSeams", bumpyTorus(6, 5, random), hidden);
	add("Rectangle", randomPlanarDisk(4, random), rectangle);
	add("ManyComponents", sideBySide(handle, sideBySide(tetrahedron(), tetrahedron(), 9), 9), {});
	add("KeptAreas", sphereWithTube(0.1, 2.0, 0.4, 5, 4), {});
	all.push_back({"WideDisk", perforatedSlab(8, 1), [](const FloatMesh& m) {
					   return Facade::ComputeHyperbolic(m, {}).report.iterations;
				   }});
	return all;
}

class Cancel : public ::testing::TestWithParam<FacadeRun>
{
protected:
	void SetUp() override
	{
		build(GetParam().mesh, m_mesh);
		m_before = contents(m_mesh);
		withListener(m_all, [&] { return GetParam().run(m_mesh); });
	}

	/// The mesh is what it was.
	void expectUntouched() const { EXPECT_EQ(contents(m_mesh) == m_before, true); }

	/// The first call of each stage, and so many more.
	std::vector<int> calls(int more) const
	{
		const int count = static_cast<int>(m_all.fractions.size());
		std::set<int> chosen;
		std::set<std::string> known;
		for (int i = 0; i < count; ++i)
			if (known.insert(m_all.stages[at(i)]).second)
				chosen.insert(i);
		for (int i = 0; i < more; ++i)
			chosen.insert(static_cast<int>(static_cast<long>(count) * i / more));
		return {chosen.begin(), chosen.end()};
	}

	FloatMesh m_mesh;
	std::string m_before;
	Caller m_all;
};

TEST_P(Cancel, ProgressRunsFromNoneToAll)
{
	const std::vector<double>& fractions = m_all.fractions;
	ASSERT_GT(fractions.size(), 10u);
	EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
	EXPECT_EQ(fractions.front(), 0.0);
	// A time limit ends runs that are not done: until the result is there, none is. Layers are built after it.
	for (std::size_t i = 0; i < fractions.size(); ++i) {
		EXPECT_FALSE(m_all.stages[i].empty());
		EXPECT_EQ(fractions[i] == 1.0, m_all.stages[i] == "Done");
	}
	EXPECT_EQ(m_all.stages.back() == "Done", GetParam().name != "Sphere");
	expectUntouched();
}

TEST_P(Cancel, AtAnyCallTheRunEndsAtOnce)
{
	constexpr int kMost = 50;
	for (const int call : calls(kMost)) {
		Caller cancel(call);
		EXPECT_THROW(withListener(cancel, [&] { return GetParam().run(m_mesh); }), Cancelled)
			<< call;
		EXPECT_EQ(static_cast<int>(cancel.fractions.size()), call + 1)
			<< "called again after a refusal to go on";
		// Calls at which nothing is counted are the same in each run.
		EXPECT_TRUE(
			std::equal(cancel.fractions.begin(), cancel.fractions.end(), m_all.fractions.begin()))
			<< call;
	}
	expectUntouched();
}

TEST_P(Cancel, ATimeLimitEndsTheRunInEveryStage)
{
	constexpr double kLimit = 0.02;
	for (const int call : calls(0)) {
		if (m_all.fractions[at(call)] == 1.0)
			continue;
		Caller slow(call, [&] {
			std::this_thread::sleep_for(std::chrono::duration<double>(1.5 * kLimit));
			return true;
		});
		try {
			const Task task(slow, kLimit);
			GetParam().run(m_mesh);
			ADD_FAILURE() << "not ended after " << m_all.stages[at(call)];
		}
		catch (const TimeOut& late) {
			EXPECT_EQ(late.limit, kLimit);
			EXPECT_GT(late.elapsed, kLimit);
			EXPECT_LT(late.done, 1.0);
			EXPECT_GE(late.done, slow.fractions.empty() ? 0 : slow.fractions.back());
			expectWords(late.what(), {"limit: 0.02 seconds)"});
		}
		EXPECT_LE(static_cast<int>(slow.fractions.size()), call + 1);
	}
	expectUntouched();
}

TEST_P(Cancel, ATimeLimitThatIsNotReachedChangesNothing)
{
	for (const double seconds : {0.0, 1e6}) {
		Caller all;
		const Task task(all, seconds);
		GetParam().run(m_mesh);
		EXPECT_EQ(all.fractions, m_all.fractions);
		EXPECT_EQ(all.stages, m_all.stages);
	}
}

/// What a listener throws.
struct FullDisk
{
};

TEST_P(Cancel, WhatTheListenerThrowsPassesThrough)
{
	for (const int call : calls(10)) {
		Caller broken(call, []() -> bool { throw FullDisk(); });
		EXPECT_THROW(withListener(broken, [&] { return GetParam().run(m_mesh); }), FullDisk)
			<< call;
	}
	struct Writer : Progress
	{
		void log(const std::string&) override { throw FullDisk(); }
	} writer;
	if (GetParam().name != "Sphere") { // of which nothing is logged
		EXPECT_THROW(withListener(writer, [&] { return GetParam().run(m_mesh); }), FullDisk);
	}
	expectUntouched();
}

INSTANTIATE_TEST_SUITE_P(Runs, Cancel, ::testing::ValuesIn(runs()), CallName());

#ifdef __linux__
/// Larger runs, between whose calls no long time passes: a fan whose overlay has many pieces, and ten thousand
/// faces for other ways.
Call largeRun(const std::string& name)
{
	Random random(502);
	Options options;
	if (name == "Fans") {
		options.target = TargetCurvature::PlacedCones;
		options.output = OutputTriangulation::CommonRefinement;
		return {name, revolved({{0, 0}, {1, 0}, {1, 3}, {0, 3}}, 300), options};
	}
	if (name == "Box")
		return {name, perforatedSlab(1, 12), options};
	if (name == "Sphere")
		return {name, shaken(perforatedSlab(0, 18), 0.01, random), SphereOptions()};
	if (name == "RoundDisk") {
		options.target = TargetCurvature::Disk;
		SurfaceMesh sheet = randomPlanarDisk(70, random);
		for (Point3& p : sheet.positions)
			p[2] = 0.1 * std::sin(9 * p[0]) * std::cos(7 * p[1]);
		return {name, sheet, options};
	}
	const SurfaceMesh handles = shaken(perforatedSlab(2, 10), 0.02, random);
	if (name == "Hyperbolic")
		return {name, handles, HyperbolicOptions()};
	return {name, handles, options};
}

/// Notes the longest time of its thread between two calls.
class Clock : public Progress
{
public:
	bool update(double, const std::string& what) override
	{
		const double now = seconds();
		if (now - m_last > longest) {
			longest = now - m_last;
			before = what;
		}
		m_last = now;
		return true;
	}

	/// That the thread has worked so far, whatever else the machine does.
	static double seconds()
	{
		timespec time;
		clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
		return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
	}

	double longest = 0.0;
	std::string before;

private:
	double m_last = seconds();
};

class Pauses : public ::testing::TestWithParam<std::string>
{
};

TEST_P(Pauses, AreShort)
{
	const Call call = largeRun(GetParam());
	const double start = Clock::seconds();
	Clock clock;
	withListener(clock, [&] { return outcomeOf(call); });
	EXPECT_LT(clock.longest, (Clock::seconds() - start) / 3) << "before " << clock.before;
}

INSTANTIATE_TEST_SUITE_P(
	Runs,
	Pauses,
	::testing::Values("Fans", "Genus2", "Hyperbolic", "Box", "RoundDisk", "Sphere"),
	[](const auto& name) { return name.param; });
#endif

} // namespace
} // namespace ricci::testing
