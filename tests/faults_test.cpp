// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever goes wrong in the middle of a run, the mesh is bit for bit what it was.
#include "support/decimal_commas.h"
#include "support/expect.h"
#include "support/facade_runs.h"
#include "support/failing_malloc.h"
#include "support/flat_map.h"
#include "support/listener.h"
#include "support/mesh_contents.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <cstdint>
#include <memory>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace ricci::testing {
namespace {

using Flow = vcg::tri::RicciFlow<FloatMesh>;

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
	for (const FacadeRun& way : facadeRuns()) {
		FloatMesh m;
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
	for (const FacadeCase& c : facadeCases())
		for (Failing which : {Failing::One, Failing::AllThatFollow}) {
			FloatMesh original;
			build(c.mesh, original);
			const Flow::Result result = Flow::Compute(original, c.params);
			std::unique_ptr<FloatMesh> m;
			std::string before;
			const long tried = failEveryAllocation(
				which,
				[&] {
					m = std::make_unique<FloatMesh>();
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

/// The refusal of a run that may use so many bytes.
TooLarge refusalWithin(double bytes, const SurfaceMesh& mesh, const Options& options = {})
{
	FloatMesh m;
	build(mesh, m);
	const std::string before = contents(m);
	Progress silent;
	Task task(silent);
	task.setMemoryLimit(bytes);
	const auto refused = refusalOf<TooLarge>([&] { Flow::Compute(m, options); });
	EXPECT_EQ(refused.limit, bytes);
	EXPECT_GT(refused.needed, bytes);
	EXPECT_EQ(contents(m) == before, true);
	task.setMemoryLimit(1e9);
	if (refused.problem != TooLarge::DoubleMemory) { // whose disk is lost in rounding
		EXPECT_NO_THROW(Flow::Compute(m, options));
	}
	return refused;
}

Options with(TargetCurvature target, OutputTriangulation output)
{
	Options options;
	options.target = target;
	options.output = output;
	options.charts = Charts::WithoutOverlap;
	return options;
}

constexpr auto kKept = OutputTriangulation::KeepMesh;
constexpr auto kRefined = OutputTriangulation::CommonRefinement;

TEST(Memory, GrowsWithTheMeshItsLargestComponentAndTheRefinement)
{
	const auto needed = [](const SurfaceMesh& mesh, OutputTriangulation output) {
		const TooLarge refused =
			refusalWithin(1000.0, mesh, with(TargetCurvature::Automatic, output));
		EXPECT_EQ(refused.problem, TooLarge::Memory);
		EXPECT_EQ(refused.count, mesh.triangles.size());
		expectWords(
			refused.what(), {"The mesh has " + std::to_string(mesh.triangles.size()) + " faces"});
		return refused.needed;
	};
	const SurfaceMesh one = rectangle(20, 20, 1, 1);
	const double small = needed(one, kKept), large = needed(rectangle(40, 20, 2, 1), kKept);
	EXPECT_GE(large, 2 * small);
	EXPECT_LT(large, 3 * small);
	EXPECT_GT(needed(one, kRefined), small);
	const double apart = needed(sideBySide(one, one, 5), kKept);
	EXPECT_GT(apart, small);
	EXPECT_LT(apart, large);
}

TEST(Memory, OfTheSphereIsLimitedToo)
{
	Progress silent;
	Task task(silent);
	task.setMemoryLimit(1000.0);
	EXPECT_EQ(
		refusalOf<TooLarge>([] { mapToSphere(perforatedSlab(0, 3), {}); }).problem,
		TooLarge::Memory);
}

/// A strip that becomes a round disk: its boundary edges have to flip.
TEST(Memory, ForTheDoubleIsRefusedOnceItIsNeeded)
{
	const SurfaceMesh strip = rectangle(60, 1, 60, 2);
	const double alone = refusalWithin(1000.0, strip).needed;
	const TooLarge refused = refusalWithin(1.1 * alone, strip, with(TargetCurvature::Disk, kKept));
	EXPECT_EQ(refused.problem, TooLarge::DoubleMemory);
	EXPECT_EQ(refused.count, 2 * strip.triangles.size());
	expectWords(refused.what(), {"Boundary edges have to flip"});
}

/// A cylinder closed by two fans of n triangles, which the flow's edges cross about n^2 / 2 times.
TEST(Memory, ForTheOverlayIsRefusedWhileItGrows)
{
	const SurfaceMesh drum = revolved({{0, 0}, {1, 0}, {1, 3}, {0, 3}}, 200);
	const Options refined = with(TargetCurvature::PlacedCones, kRefined);
	const double before = refusalWithin(1000.0, drum, refined).needed;
	const TooLarge refused = refusalWithin(1.2 * before, drum, refined);
	EXPECT_EQ(refused.problem, TooLarge::OverlayMemory);
	EXPECT_GT(refused.count, drum.triangles.size());
	expectWords(refused.what(), {"The edges after the flow cross"});
}

TEST(Faults, AHostThatTrapsFloatingPointExceptionsGetsTheSameResult)
{
#ifdef __GLIBC__
	for (const FacadeCase& c : facadeCases()) {
		FloatMesh m;
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
		for (const FacadeCase& c : facadeCases()) {
			FloatMesh m;
			build(c.mesh, m);
			const std::string before = contents(m);
			Listener listener;
			const Flow::Result result =
				withListener(listener, [&] { return Flow::Compute(m, c.params); });
			Options refused = c.params;
			refused.epsilon = -0.5;
			try {
				withListener(listener, [&] { return Flow::Compute(m, refused); });
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
		for (const OutputTriangulation output : kOutputs) {
			FloatMesh m;
			build(shape, m);
			const std::string before = contents(m);
			{
				const ReadOnly vertices(m.vert);
				const ReadOnly faces(m.face);
				ASSERT_TRUE(vertices.works() && faces.works());
				Options options;
				options.output = output;
				Flow::Compute(m, options);
				options.target = TargetCurvature::SelectedCones;
				EXPECT_EQ(
					refusalOf<InvalidOption>([&] { Flow::Compute(m, options); }).problem,
					InvalidOption::NothingSelected);
			}
			EXPECT_EQ(contents(m) == before, true);
		}
}
#endif

TEST(Faults, ASecondRunGivesTheSame)
{
	int compared = 0;
	for (const FacadeCase& c : facadeCases()) {
		if (c.params.output == OutputTriangulation::CommonRefinement)
			continue; // the second run has another mesh
		++compared;
		FloatMesh m;
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

TEST(Faults, AnAttributeOfAnotherTypeIsReplaced)
{
	FloatMesh m;
	build(rectangle(2, 2, 1, 1), m);
	using Allocator = vcg::tri::Allocator<FloatMesh>;
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
