// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/decimal_commas.h"

#include <bridge/error_sentences.h>

#include <ricci/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using filter_ricci::Refusal;
using filter_ricci::sentence;
using ricci::InadmissibleCurvature;
using ricci::InternalError;
using ricci::InvalidMesh;
using ricci::InvalidOption;
using ricci::Method;
using ricci::NotConverged;
using ricci::SolverFailed;
using ricci::SurfaceType;
using ricci::TargetCurvature;
using ricci::TooLarge;

namespace {

constexpr double kPi = 3.14159265358979323846;

bool contains(const std::string& text, const std::string& part)
{
	return text.find(part) != std::string::npos;
}

/// Words that say what to do, or what the run needs.
bool namesARemedy(const std::string& text)
{
	for (const char* words :
		 {" run '",    "hoose ",  "elete ",  "open ",    "reconstruct ", "cut ",    "emesh ",
		  "Use ",      "use ",    " needs ", "must be",  " takes ",      "raise ",  "separate ",
		  "simplify ", "report ", "divide ", "correct ", "Ask for ",     "too few "})
		if (contains(text, words))
			return true;
	return false;
}

/// A sentence for the user that has all of \p numbers in it.
void expectSentence(const ricci::Error& error, const std::vector<std::string>& numbers)
{
	const std::string text = sentence(error);
	SCOPED_TRACE(text);
	ASSERT_FALSE(text.empty());
	EXPECT_EQ(text.back(), '.');
	EXPECT_FALSE(contains(text, ".."));
	EXPECT_FALSE(contains(text, ".:"));
	EXPECT_FALSE(contains(text, "  "));
	EXPECT_TRUE(namesARemedy(text));
	for (const std::string& number : numbers)
		EXPECT_TRUE(contains(text, number)) << number;
}

std::string currentSentenceOf(void (*call)())
{
	try {
		call();
	}
	catch (...) {
		return filter_ricci::currentErrorSentence();
	}
	return "";
}

TEST(Sentences, EveryInvalidMeshHasOne)
{
	const std::vector<int> withoutCount = {
		InvalidMesh::Empty,
		InvalidMesh::IncoherentEdge,
		InvalidMesh::NotPuncturable,
		InvalidMesh::ScalesApart,
		InvalidMesh::BeyondFloats};
	for (int i = InvalidMesh::Empty; i <= InvalidMesh::BeyondFloats; ++i) {
		const auto problem = static_cast<InvalidMesh::Problem>(i);
		const bool counts =
			std::find(withoutCount.begin(), withoutCount.end(), i) == withoutCount.end();
		for (std::size_t count : {std::size_t(1), std::size_t(7123)})
			expectSentence(
				InvalidMesh(problem, count),
				counts ? std::vector<std::string>{std::to_string(count)}
					   : std::vector<std::string>());
	}
	expectSentence(InvalidMesh(InvalidMesh::IncoherentEdge, 3, {41, 1052}), {"41", "1052"});
}

TEST(Sentences, EveryInvalidOptionHasOne)
{
	std::map<int, std::vector<std::string>> numbers = {
		{InvalidOption::TimeLimit, {"-17"}},
		{InvalidOption::MemoryLimit, {"-17"}},
		{InvalidOption::Epsilon, {"-17"}},
		{InvalidOption::SharpAngle, {"-974.0"}},
		{InvalidOption::ConeCount, {"-17"}},
		{InvalidOption::ConeDistortion, {"-17"}},
		{InvalidOption::SeamHiding, {"-17"}},
		{InvalidOption::ChartMargin, {"-17", "23"}},
		{InvalidOption::TileSide, {"-17", "23"}},
		{InvalidOption::ConeAngle, {"-974.0"}},
		{InvalidOption::TooFewCones, {"-17", "23"}},
		{InvalidOption::TooFewVertices, {"-17", "61"}},
		{InvalidOption::CoverTooLarge, {"-17", "61"}},
		{InvalidOption::NoMap, {"61"}},
		{InvalidOption::TooFewBoundaryVertices, {"61"}},
		{InvalidOption::CornerCount, {"61"}},
		{InvalidOption::CornersOffBoundary, {"61"}},
		{InvalidOption::SphereOfComponents, {"61"}}};
	expectSentence(InvalidOption("method", 99, 4), {"method", "99", "3"});
	expectSentence(InvalidOption(InvalidOption::TileSide, 5000.0, 1000.0), {"5.005"});
	for (int i = InvalidOption::TimeLimit; i <= InvalidOption::CoverTooLarge; ++i) {
		const auto problem = static_cast<InvalidOption::Problem>(i);
		expectSentence(InvalidOption(problem, -17.0, 23.0, 61), numbers[i]);
		for (TargetCurvature target : {TargetCurvature::Disk, TargetCurvature::Rectangle})
			expectSentence(InvalidOption(problem, target, SurfaceType{2, 3}), {});
	}
}

TEST(Sentences, EveryInadmissibleCurvatureHasOne)
{
	std::map<int, std::vector<std::string>> numbers = {
		{InadmissibleCurvature::NotFinite, {"61"}},
		{InadmissibleCurvature::Flat, {"2.25", "genus 4"}},
		{InadmissibleCurvature::GaussBonnet, {"7.5", "2.25"}},
		{InadmissibleCurvature::HyperbolicSum, {"7.5", "2.25"}},
		{InadmissibleCurvature::TooLargeInside, {"7.5", "61", "6.28318531"}},
		{InadmissibleCurvature::TooLargeOnBoundary, {"7.5", "61", "3.14159265"}},
		{InadmissibleCurvature::FreeBoundary, {"7.5", "2.25", "61"}},
		{InadmissibleCurvature::ScalesApart, {"1e7.5"}},
		{InadmissibleCurvature::HyperbolicSurface, {"genus 4", "5 boundary loops", "-11"}}};
	for (int i = InadmissibleCurvature::NotFinite; i <= InadmissibleCurvature::HyperbolicSum; ++i) {
		const auto problem = static_cast<InadmissibleCurvature::Problem>(i);
		expectSentence(
			InadmissibleCurvature(problem, 7.5, 2.25, 61, SurfaceType{4, 5}), numbers[i]);
	}
}

TEST(Sentences, EveryNotConvergedHasOne)
{
	std::map<int, std::vector<std::string>> numbers = {
		{NotConverged::BrokenTriangles, {"61"}},
		{NotConverged::FlatTriangles, {"61"}},
		{NotConverged::SplitsUsedUp, {"61"}},
		{NotConverged::OutsideDisk, {"61"}},
		{NotConverged::PiecesLost, {"61"}},
		{NotConverged::FlipsUsedUp, {"61"}},
		{NotConverged::LostInRounding, {"61", "1e17 times"}},
		{NotConverged::CircleUnsettled, {"17"}}};
	for (int i = NotConverged::BrokenTriangles; i < NotConverged::CheckFailed; ++i) {
		const auto problem = static_cast<NotConverged::Problem>(i);
		for (Method method : {Method::FixedTriangles, Method::EdgeSwaps, Method::IntrinsicFlips}) {
			NotConverged error(problem, 61, 17.0);
			error.method = method;
			expectSentence(error, numbers[i]);
		}
	}
	expectSentence(NotConverged(200, 1e-3, 1e-8, 2e-13), {"200", "0.001", "1e-08", "2e-13"});
	expectSentence(NotConverged("seams 0.5 of the chart apart"), {"seams 0.5 of the chart apart"});
}

TEST(Sentences, EveryOtherErrorHasOne)
{
	for (TooLarge::Problem problem : {TooLarge::Faces, TooLarge::Crossings})
		expectSentence(TooLarge(problem, 61, 0.0, 300000000.0), {"61", "300000000"});
	for (TooLarge::Problem problem :
		 {TooLarge::Memory, TooLarge::DoubleMemory, TooLarge::OverlayMemory})
		expectSentence(TooLarge(problem, 61, 12.5e9, 3e9), {"61", "12.5 GB", "3 GB"});
	expectSentence(TooLarge(TooLarge::Unknowns, 61, 0.0, 0.0), {"61"});
	expectSentence(SolverFailed(SolverFailed::Flow), {});
	expectSentence(SolverFailed(SolverFailed::SeamCost), {});
	for (const char* end : {"", "."})
		EXPECT_EQ(
			sentence(InternalError(std::string("The fundamental polygon is inconsistent") + end)),
			"The fundamental polygon is inconsistent: please report the mesh.");
	expectSentence(ricci::TimeOut(12.25, 0.5, 10.0), {"12.2", "50%", "{time_limit}: 10"});
	EXPECT_EQ(sentence(ricci::Cancelled()), "Cancelled: the mesh is unchanged.");
}

/// Of one and of several, with numbers as they were typed, angles in degrees, and what the run needs in its own words.
TEST(Sentences, AreTheseWords)
{
	const auto mesh = [](InvalidMesh::Problem problem, std::size_t count) {
		return sentence(InvalidMesh(problem, count));
	};
	const auto option = [](InvalidOption::Problem problem, double value, double bound = 0.0) {
		return sentence(InvalidOption(problem, value, bound));
	};
	const auto broken = [](Method method) {
		NotConverged error(NotConverged::BrokenTriangles, 1);
		error.method = method;
		error.swaps = 25;
		return sentence(error);
	};
	InvalidOption ofComponent(InvalidOption::NothingSelected);
	ofComponent.componentFace = 0;
	ofComponent.componentFaces = 4;
	const double infinity = std::numeric_limits<double>::infinity();
	const std::string epsilon =
		" of {epsilon} cannot be used. Use a number of radians greater than 0, for example 1e-8.";
	const std::pair<std::string, std::string> cases[] = {
		{mesh(InvalidMesh::DamagedFaces, 1),
		 "1 face uses vertices that are deleted or not in the mesh: open its file again."},
		{mesh(InvalidMesh::EdgesWithoutLength, 6),
		 "6 edges have no length: run 'Merge Close Vertices' and 'Remove Zero Area Faces' first."},
		{option(InvalidOption::Epsilon, -1.0), "The value -1" + epsilon},
		{option(InvalidOption::Epsilon, infinity), "The value inf" + epsilon},
		{option(InvalidOption::ConeDistortion, double(-0.1f)),
		 "The value -0.1 of {cone_distortion} cannot be used. Use 0, or a number greater than 0, "
		 "for "
		 "example 0.25."},
		{option(InvalidOption::SharpAngle, -5.0 * (kPi / 180.0)),
		 "The value -5 of {sharp_angle} cannot be used. Use degrees above 0, at most 180."},
		{option(InvalidOption::ConeAngle, -5.0 * (kPi / 180.0)),
		 "{cone_angle} must be greater than 0 degrees, not -5."},
		{sentence(InvalidOption(InvalidOption::NotADisk, TargetCurvature::Disk, SurfaceType{1, 0})),
		 "'Disk' needs a topological disk (genus 0, one boundary loop), but the surface is a "
		 "closed surface of genus 1 (a torus): choose seams that open it to disks, or another "
		 "{target_curvature}."},
		{sentence(
			 InadmissibleCurvature(InadmissibleCurvature::TooLargeInside, 4.0 * kPi, 2.0 * kPi, 1)),
		 "No metric has curvature 12.5663706 at an interior vertex (1 such): it must be less than "
		 "2 pi = 6.28318531 inside. Choose more or weaker cones."},
		{broken(Method::EdgeSwaps),
		 "1 triangle breaks the triangle inequality at the end of the flow, with 25 edges swapped: "
		 "choose the method 'Intrinsic flips', or remesh the worst triangles."},
		{broken(Method::IntrinsicFlips),
		 "1 triangle breaks the triangle inequality at the end of the flow: remesh the worst "
		 "triangles."},
		{broken(Method::FixedTriangles),
		 "1 triangle breaks the triangle inequality at the end of the flow: choose the method "
		 "'Intrinsic flips', or remesh the worst triangles."},
		{sentence(NotConverged(NotConverged::LostInRounding, 3, 17.0)),
		 "3 triangles are lost in rounding: the flow makes parts of the surface 1e17 times as "
		 "large as others. Choose a {target_curvature} nearer to the curvature of the mesh."},
		{sentence(NotConverged(NotConverged::LostInRounding, 0, 35.0)),
		 "The flow is lost in rounding: it makes parts of the surface 1e35 times as large as "
		 "others. Choose a {target_curvature} nearer to the curvature of the mesh."},
		{sentence(ricci::TimeOut(61.25, 0.254, 60.0)),
		 "The run was stopped after 61.2 seconds, with about 25% done ({time_limit}: 60): raise "
		 "{time_limit}, or simplify the mesh. The mesh is unchanged."},
		{sentence(TooLarge(TooLarge::Memory, 5000000, 6.6e9, 2.5e9)),
		 "The mesh has 5000000 faces and needs about 6.6 GB of memory, but only 2.5 GB are free: "
		 "simplify it first ('Simplification: Quadric Edge Collapse Decimation'), or cut it into "
		 "pieces."},
		{sentence(ofComponent),
		 "Component with face 0 (4 faces): 'Cones at selected vertices' needs selected vertices, "
		 "but none is selected: select some on every component."}};
	for (const auto& [found, wanted] : cases)
		EXPECT_EQ(found, wanted);
}

TEST(Sentences, AreTheSameInAHostWithDecimalCommas)
{
	const auto all = [] {
		return sentence(InvalidOption(InvalidOption::Epsilon, -0.5)) +
			   sentence(InvalidOption(InvalidOption::ConeAngle, -0.5)) +
			   sentence(InvalidOption(InvalidOption::ConeDistortion, -0.25)) +
			   sentence(InadmissibleCurvature(InadmissibleCurvature::GaussBonnet, 0.96, -12.5)) +
			   sentence(NotConverged(2, 0.01234, 1e-8, 3e-14)) +
			   sentence(TooLarge(TooLarge::Memory, 5000000, 6.6e9, 2.5e9)) +
			   sentence(ricci::TimeOut(6.125, 0.25, 5.5));
	};
	const std::string wanted = all();
	EXPECT_TRUE(contains(wanted, "-0.5 of {epsilon}"));
	const ricci::testing::DecimalCommas commas;
	if (!commas.found())
		GTEST_SKIP() << "SKIPPED: this machine has no locale with decimal commas, nor localedef "
						"and Debian's package locales to make one";
	EXPECT_EQ(all(), wanted);
}

TEST(Sentences, OfTheExceptionBeingHandled)
{
	EXPECT_EQ(
		currentSentenceOf([] { throw Refusal("There is no mesh. Open one first."); }),
		"There is no mesh. Open one first.");
	EXPECT_EQ(
		currentSentenceOf([] { throw ricci::Cancelled(); }), "Cancelled: the mesh is unchanged.");
	EXPECT_EQ(
		currentSentenceOf([] { throw std::bad_alloc(); }),
		"There is not enough memory for this mesh. The mesh is unchanged.");
	EXPECT_EQ(
		currentSentenceOf([] { throw std::logic_error("a reason"); }),
		"The filter failed unexpectedly (a reason). Please report this, with the mesh if you can.");
	EXPECT_EQ(
		currentSentenceOf([] { throw 1; }),
		"The filter failed unexpectedly, for an unknown reason. Please report this, with the mesh "
		"if you can.");
}

} // namespace
