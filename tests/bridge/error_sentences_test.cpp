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

SurfaceType surface(int genus, int boundaryLoops)
{
	SurfaceType type;
	type.genus = genus;
	type.boundaryLoops = boundaryLoops;
	return type;
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
		{InvalidOption::BoxPlaces, {"-17", "61"}},
		{InvalidOption::Epsilon, {"-17"}},
		{InvalidOption::SharpAngle, {"-974.0"}},
		{InvalidOption::ConeCount, {"-17"}},
		{InvalidOption::ConeDistortion, {"-17"}},
		{InvalidOption::SeamHiding, {"-17"}},
		{InvalidOption::ChartMargin, {"-17", "23"}},
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
	for (int i = InvalidOption::TimeLimit; i <= InvalidOption::CoverTooLarge; ++i) {
		const auto problem = static_cast<InvalidOption::Problem>(i);
		expectSentence(InvalidOption(problem, -17.0, 23.0, 61), numbers[i]);
		for (TargetCurvature target : {TargetCurvature::Disk, TargetCurvature::Rectangle})
			expectSentence(InvalidOption(problem, target, surface(2, 3)), {});
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
		expectSentence(InadmissibleCurvature(problem, 7.5, 2.25, 61, surface(4, 5)), numbers[i]);
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
		{mesh(InvalidMesh::Empty, 1), "The mesh is empty: open or create a triangle mesh first."},
		{mesh(InvalidMesh::NoFaces, 8),
		 "The mesh has 8 vertices but no faces: reconstruct a surface from the points first."},
		{mesh(InvalidMesh::DamagedFaces, 1),
		 "1 face uses vertices that are deleted or not in the mesh: open its file again."},
		{mesh(InvalidMesh::NotFinite, 2),
		 "2 vertices have coordinates that are not finite numbers (NaN or infinite): delete them "
		 "first."},
		{mesh(InvalidMesh::OutOfRange, 2),
		 "2 vertices have coordinates beyond 1e50: run 'Transform: Scale, Normalize' first."},
		{mesh(InvalidMesh::TooSmall, 2),
		 "2 components are smaller than 1e-50: run 'Transform: Scale, Normalize' first, or delete "
		 "such pieces."},
		{mesh(InvalidMesh::NoArea, 1),
		 "The mesh has 1 face but no area (each component lies on one line, or in one point): "
		 "choose a mesh with a surface."},
		{mesh(InvalidMesh::EdgesWithoutLength, 6),
		 "6 edges have no length: run 'Merge Close Vertices' and 'Remove Zero Area Faces' first."},
		{mesh(InvalidMesh::FacesWithoutArea, 1),
		 "1 face has no area: run 'Remove Zero Area Faces' or 'Remove T-Vertices' first."},
		{mesh(InvalidMesh::BeyondFloats, 1),
		 "The mesh is too large or too small for texture coordinates in its own scale: choose "
		 "{normalize_uv}, or run 'Transform: Scale, Normalize' first."},
		{option(InvalidOption::Epsilon, -1.0), "The value -1" + epsilon},
		{option(InvalidOption::Epsilon, infinity), "The value inf" + epsilon},
		{option(InvalidOption::ConeCount, -2147483648.0),
		 "The value -2147483648 of {cone_count} cannot be used. Use the number of cones, or 0 to "
		 "have it chosen by {cone_distortion}."},
		{option(InvalidOption::ConeDistortion, double(-0.1f)),
		 "The value -0.1 of {cone_distortion} cannot be used. Use 0, or a number greater than 0, "
		 "for "
		 "example 0.25."},
		{option(InvalidOption::SeamHiding, double(1.1f)),
		 "The value 1.1 of {seam_hiding} cannot be used. Use a number from 0 to 1."},
		{option(InvalidOption::SharpAngle, -5.0 * (kPi / 180.0)),
		 "The value -5 of {sharp_angle} cannot be used. Use degrees above 0, at most 180."},
		{option(InvalidOption::ConeAngle, -5.0 * (kPi / 180.0)),
		 "{cone_angle} must be greater than 0 degrees, not -5."},
		{sentence(InvalidOption(InvalidOption::CoverTooLarge, 9.0, 0.0, 5000000)),
		 "{universal_cover}: 9 rings would need more than 5000000 faces. Ask for fewer rings, or "
		 "simplify the mesh."},
		{sentence(InvalidOption(InvalidOption::WithoutFlips)),
		 "The output 'Common refinement' and the holes 'Capped' need the method 'Intrinsic flips': "
		 "choose it, or 'Keep the mesh' and 'Boundaries'."},
		{sentence(InvalidOption(InvalidOption::HyperbolicMethod)),
		 "The hyperbolic flow has no such method: choose 'Intrinsic flips' or 'Fixed triangles'."},
		{sentence(InvalidOption(InvalidOption::NotADisk, TargetCurvature::Disk, surface(1, 0))),
		 "'Disk' needs a topological disk (genus 0, one boundary loop), but the surface is a "
		 "closed surface of genus 1 (a torus): choose seams that open it to disks, or another "
		 "{target_curvature}."},
		{sentence(
			 InvalidOption(InvalidOption::NotADisk, TargetCurvature::Rectangle, surface(0, 2))),
		 "'Rectangle' needs a topological disk (genus 0, one boundary loop), but the surface is an "
		 "annulus: choose seams that open it to disks, or another {target_curvature}."},
		{sentence(InvalidOption(InvalidOption::CornerCount, 0.0, 0.0, 3)),
		 "'Rectangle' needs four selected boundary vertices, or none, but 3 are selected. One on a "
		 "seam counts at each of its places."},
		{sentence(InvalidOption(InvalidOption::CornersOffBoundary, 0.0, 0.0, 2)),
		 "'Rectangle' needs four selected vertices on one boundary loop, but only 2 of the "
		 "selected vertices lie on it."},
		{sentence(InvalidOption(InvalidOption::TooFewCones, 2.0, 3.0)),
		 "The surface needs at least 3 placed cones, but {cone_count} is 2."},
		{sentence(InvalidOption(InvalidOption::TooFewVertices, 40.0, 0.0, 12)),
		 "The surface has 12 interior vertices, too few for the wanted cones: {cone_count} is 40."},
		{sentence(InvalidOption(InvalidOption::SphereOfComponents, 0.0, 0.0, 2)),
		 "The map to the sphere needs one closed surface of genus 0, but the mesh has 2 "
		 "components: separate them first."},
		{sentence(
			 InvalidOption(InvalidOption::NotASphere, TargetCurvature::Automatic, surface(0, 1))),
		 "The map to the sphere needs a closed surface of genus 0, but the surface is a disk."},
		{sentence(
			 InadmissibleCurvature(InadmissibleCurvature::Flat, 0.0, 4.0 * kPi, 0, surface(0, 0))),
		 "'Flat everywhere' needs total curvature 2 pi chi = 0, but the surface is a closed "
		 "surface of genus 0 (a sphere) with 2 pi chi = 12.5663706: choose another "
		 "{target_curvature}."},
		{sentence(InadmissibleCurvature(InadmissibleCurvature::GaussBonnet, 0.96, 0.0)),
		 "The vertex qualities add up to 0.96, but a metric on this surface has total curvature 2 "
		 "pi chi = 0 (Gauss-Bonnet): correct the qualities."},
		{sentence(InadmissibleCurvature(InadmissibleCurvature::NotFinite, 0.0, 0.0, 1)),
		 "1 vertex has a quality that is not a finite number: 'From vertex quality' needs the "
		 "target curvature in radians at every vertex."},
		{sentence(
			 InadmissibleCurvature(InadmissibleCurvature::TooLargeInside, 4.0 * kPi, 2.0 * kPi, 1)),
		 "No metric has curvature 12.5663706 at an interior vertex (1 such): it must be less than "
		 "2 pi = 6.28318531 inside. Choose more or weaker cones."},
		{sentence(
			 InadmissibleCurvature(InadmissibleCurvature::TooLargeOnBoundary, 1.5 * kPi, kPi, 2)),
		 "No metric has curvature 4.71238898 at a boundary vertex (2 such): it must be less than "
		 "pi = 3.14159265 on the boundary. Choose more or weaker cones."},
		{sentence(InadmissibleCurvature(
			 InadmissibleCurvature::HyperbolicSurface, 0.0, 0.0, 0, surface(1, 0))),
		 "A hyperbolic metric without cones needs an Euler characteristic below 0, but the surface "
		 "is a closed surface of genus 1 (a torus) with Euler characteristic 0: use 'Generalized "
		 "Ricci Flow (Euclidean)', or choose 'Cones at selected vertices' with small angles."},
		{sentence(InadmissibleCurvature(InadmissibleCurvature::HyperbolicSum, 1.5, 4.0 * kPi)),
		 "The target curvature adds up to 1.5, but a hyperbolic metric on this surface needs more "
		 "than 2 pi chi = 12.5663706 (Gauss-Bonnet: the difference is the area): choose more or "
		 "sharper cones, or 'Generalized Ricci Flow (Euclidean)'."},
		{sentence(NotConverged(2, 0.01234, 1e-8, 3e-14)),
		 "The flow stopped after 2 Newton steps with a curvature error of 0.0123 (wanted: 1e-08, "
		 "rounding floor: 3e-14): raise {epsilon}."},
		{broken(Method::EdgeSwaps),
		 "1 triangle breaks the triangle inequality at the end of the flow, with 25 edges swapped: "
		 "choose the method 'Intrinsic flips', or remesh the worst triangles."},
		{broken(Method::IntrinsicFlips),
		 "1 triangle breaks the triangle inequality at the end of the flow: remesh the worst "
		 "triangles."},
		{broken(Method::FixedTriangles),
		 "1 triangle breaks the triangle inequality at the end of the flow: choose the method "
		 "'Intrinsic flips', or remesh the worst triangles."},
		{sentence(NotConverged(NotConverged::FlatTriangles, 2)),
		 "2 triangles are flat at the end of the flow: the target curvature is the limit of what "
		 "these triangles can reach. Choose the method 'Intrinsic flips', or another "
		 "{target_curvature}."},
		{sentence(NotConverged(NotConverged::SplitsUsedUp, 9)),
		 "Triangles on the boundary kept breaking after 9 boundary edges were split: remesh the "
		 "boundary."},
		{sentence(NotConverged(NotConverged::OutsideDisk, 12)),
		 "12 corners of faces lie so far from the middle of the layout that rounding puts them on "
		 "the border of the Poincaré disk: choose larger cone angles, or 'Generalized Ricci Flow "
		 "(Euclidean)'."},
		{sentence(NotConverged(NotConverged::LostInRounding, 3, 17.0)),
		 "3 triangles are lost in rounding: the flow makes parts of the surface 1e17 times as "
		 "large as others. Choose a {target_curvature} nearer to the curvature of the mesh."},
		{sentence(NotConverged(NotConverged::LostInRounding, 0, 35.0)),
		 "The flow is lost in rounding: it makes parts of the surface 1e35 times as large as "
		 "others. Choose a {target_curvature} nearer to the curvature of the mesh."},
		{sentence(NotConverged("2 points lie outside the disk")),
		 "The finished map failed its check (2 points lie outside the disk): remesh the worst "
		 "triangles, and report the mesh."},
		{sentence(ricci::TimeOut(61.25, 0.254, 60.0)),
		 "The run was stopped after 61.2 seconds, with about 25% done ({time_limit}: 60): raise "
		 "{time_limit}, or simplify the mesh. The mesh is unchanged."},
		{sentence(TooLarge(TooLarge::Memory, 5000000, 6.6e9, 2.5e9)),
		 "The mesh has 5000000 faces and needs about 6.6 GB of memory, but only 2.5 GB are free: "
		 "simplify it first ('Simplification: Quadric Edge Collapse Decimation'), or cut it into "
		 "pieces."},
		{sentence(TooLarge(TooLarge::Faces, 400000000, 0.0, 300000000.0)),
		 "The mesh has 400000000 faces, but at most 300000000 can be numbered: simplify it first "
		 "('Simplification: Quadric Edge Collapse Decimation'), or cut it into pieces."},
		{sentence(TooLarge(TooLarge::DoubleMemory, 2400, 2.5e9, 1.25e9)),
		 "Boundary edges have to flip, and the double of the surface with 2400 faces needs about "
		 "2.5 GB of memory, but only 1.25 GB were free: simplify the mesh first ('Simplification: "
		 "Quadric Edge Collapse Decimation'), or cut it into pieces."},
		{sentence(TooLarge(TooLarge::OverlayMemory, 250000, 3e9, 1e9)),
		 "The edges after the flow cross those of the mesh at more than 250000 points, whose "
		 "overlay needs over 3 GB of memory, but only 1 GB were free: divide long triangles and "
		 "large fans first ('Remeshing: Isotropic Explicit Remeshing')."},
		{sentence(TooLarge(TooLarge::Crossings, 1000000000, 0.0, 250000000.0)),
		 "The edges after the flow cross those of the mesh at more than 1000000000 points, but at "
		 "most 250000000 can be numbered: divide long triangles and large fans first ('Remeshing: "
		 "Isotropic Explicit Remeshing')."},
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
