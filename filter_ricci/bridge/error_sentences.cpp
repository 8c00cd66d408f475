// SPDX-License-Identifier: GPL-3.0-or-later
#include "error_sentences.h"

#include <ricci/base/numbers.h>

#include <exception>
#include <new>

namespace filter_ricci {

namespace {

using ricci::numberText;

/// For what only the authors can mend. Programmers may have ended their words with a period.
std::string reported(const ricci::Error& e)
{
	std::string what = e.what();
	if (!what.empty() && what.back() == '.')
		what.pop_back();
	return what + ": please report the mesh.";
}

/// What follows the problem in the words of the error.
const char* remedy(const ricci::InvalidMesh& e)
{
	using Error = ricci::InvalidMesh;
	switch (e.problem) {
	case Error::Empty:
		return ": open or create a triangle mesh first.";
	case Error::NoFaces:
		return ": reconstruct a surface from the points first.";
	case Error::ArrayLength:
	case Error::NoTriangle:
	case Error::UnequalSides:
	case Error::IncoherentEdge:
		return ": report the mesh.";
	case Error::ScalesApart:
		return ": delete it first.";
	case Error::DamagedFaces:
		return ": open its file again.";
	case Error::NotFinite:
		return ": delete them first.";
	case Error::OutOfRange:
		return ": run 'Transform: Scale, Normalize' first.";
	case Error::TooSmall:
		return ": run 'Transform: Scale, Normalize' first, or delete such pieces.";
	case Error::NoArea:
		return ": choose a mesh with a surface.";
	case Error::EdgesWithoutLength:
		return ": run 'Merge Close Vertices' and 'Remove Zero Area Faces' first.";
	case Error::FacesWithoutArea:
		return ": run 'Remove Zero Area Faces' or 'Remove T-Vertices' first.";
	case Error::NotPuncturable:
		return ". Remesh it, or separate its sheets.";
	case Error::BeyondFloats:
		return ": choose {normalize_uv}, or run 'Transform: Scale, Normalize' first.";
	}
	return ".";
}

std::string inWords(const ricci::InvalidOption& e)
{
	using Error = ricci::InvalidOption;
	const std::string count = std::to_string(e.count);
	const auto number = [&](const char* parameter, const char* use, double unit = 1.0) {
		return unusable(numberText(unit * e.value, 6), parameter, use);
	};
	switch (e.problem) {
	case Error::NoSuchChoice:
	case Error::MemoryLimit:
	case Error::ChartMargin:
	case Error::WithoutPositions:
		return reported(e);
	case Error::TimeLimit:
		return number("time_limit", "a number of seconds, or 0 for no limit");
	case Error::Epsilon:
		return number("epsilon", "a number of radians greater than 0, for example 1e-8");
	case Error::SharpAngle:
		return number("sharp_angle", "degrees above 0, at most 180", 180.0 / ricci::kPi);
	case Error::ConeCount:
		return unusable(
			numberText(e.value, 10),
			"cone_count",
			"the number of cones, or 0 to have it chosen by {cone_distortion}");
	case Error::ConeDistortion:
		return number("cone_distortion", "0, or a number greater than 0, for example 0.25");
	case Error::ConeAngle:
		return "{cone_angle} must be greater than 0 degrees, not " +
			   numberText(e.value * 180.0 / ricci::kPi, 9) + ".";
	case Error::SeamHiding:
		return number("seam_hiding", "a number from 0 to 1");
	case Error::TileSide:
		if (e.bound > 0.0 && e.value > e.bound)
			return "With this {texel_density} the whole layout is only a few texels wide: raise it "
				   "by "
				   "a factor of " +
				   numberText(1.001 * e.value / e.bound, 4) + " at least.";
		return "With this {texel_density} a tile is " + numberText(e.value, 4) +
			   " units of length wide, but a chart that cannot be cut, or the " +
			   std::to_string(ricci::kMaxTiles) + " tiles at most, need " + numberText(e.bound, 4) +
			   ": lower {texel_density} to " + numberText(100.0 * e.value / e.bound, 3) +
			   " % of what it is, or raise {texture_size}.";
	case Error::TilesInOwnScale:
		return "{texel_density} divides the layout into tiles of the unit square: choose "
			   "{normalize_uv}, or leave {texel_density} 0.";
	case Error::WithoutFlips:
		return "The output 'Common refinement' and the holes 'Capped' need the method 'Intrinsic "
			   "flips': choose it, or 'Keep the mesh' and 'Boundaries'.";
	case Error::HyperbolicMethod:
		return "The hyperbolic flow has no such method: choose 'Intrinsic flips' or "
			   "'Fixed triangles'.";
	case Error::NotADisk:
		return std::string(
				   e.target == ricci::TargetCurvature::Rectangle ? "'Rectangle'" : "'Disk'") +
			   " needs a topological disk (genus 0, one boundary loop), but the surface is " +
			   e.surface.name() +
			   ": choose seams that open it to disks, or another {target_curvature}.";
	case Error::TooFewBoundaryVertices:
		return "'Rectangle' needs four boundary vertices, but the boundary has " + count + ".";
	case Error::CornerCount:
		return "'Rectangle' needs four selected boundary vertices, or none, but " + count +
			   " are selected. One on a seam counts at each of its places.";
	case Error::CornersOffBoundary:
		return "'Rectangle' needs four selected vertices on one boundary loop, but only " + count +
			   " of the selected vertices lie on it.";
	case Error::NothingSelected:
		return "'Cones at selected vertices' needs selected vertices, but none is selected: "
			   "select some on every component.";
	case Error::TooFewCones:
		return "The surface needs at least " + numberText(e.bound, 10) +
			   " placed cones, but {cone_count} is " + numberText(e.value, 10) + ".";
	case Error::TooFewVertices:
		return "The surface has " + count +
			   " interior vertices, too few for the wanted cones: {cone_count} is " +
			   numberText(e.value, 10) + ".";
	case Error::SphereOfComponents:
		return std::string(e.what()) + ": separate them first.";
	case Error::NotASphere:
		return std::string(e.what()) + ".";
	case Error::NoMap:
		return count + (e.count == 1 ? " face has" : " faces have") +
			   " no texture coordinates, and only a map of all faces can be packed as it is: "
			   "choose other {charts}.";
	case Error::MapWithoutArea:
		return "The texture coordinates take every face to a line or a point, so there are no "
			   "charts to pack: choose other {charts}.";
	case Error::CoverTooLarge:
		return "{universal_cover}: " + numberText(e.value, 10) + " rings would need more than " +
			   count + " faces. Ask for fewer rings, or simplify the mesh.";
	}
	return std::string(e.what()) + ".";
}

std::string inWords(const ricci::InadmissibleCurvature& e)
{
	using Error = ricci::InadmissibleCurvature;
	const std::string what = e.what();
	switch (e.problem) {
	case Error::NotFinite:
		return std::to_string(e.count) + (e.count == 1 ? " vertex has" : " vertices have") +
			   " a quality that is not a finite number: 'From vertex quality' needs the target "
			   "curvature in radians at every vertex.";
	case Error::Flat:
		return "'Flat everywhere' needs total curvature 2 pi chi = 0, but the surface is " +
			   e.surface.name() + " with 2 pi chi = " + numberText(e.bound, 9) +
			   ": choose another {target_curvature}.";
	case Error::GaussBonnet:
		return "The vertex qualities add up to " + numberText(e.value, 9) +
			   ", but a metric on this surface has total curvature 2 pi chi = " +
			   numberText(e.bound, 9) + " (Gauss-Bonnet): correct the qualities.";
	case Error::TooLargeInside:
	case Error::TooLargeOnBoundary:
		return what + ". Choose more or weaker cones.";
	case Error::FreeBoundary:
		return what + ".";
	case Error::ScalesApart:
		return what + ". The quality of each vertex must be its curvature in radians, and not far "
					  "from that of the mesh.";
	case Error::HyperbolicSurface:
		return what + ": use 'Generalized Ricci Flow (Euclidean)', or choose "
					  "'Cones at selected vertices' with small angles.";
	case Error::HyperbolicSum:
		return what + ": choose more or sharper cones, or 'Generalized Ricci Flow (Euclidean)'.";
	}
	return what + ".";
}

std::string remedy(const ricci::NotConverged& e)
{
	using Error = ricci::NotConverged;
	switch (e.problem) {
	case Error::StepsUsedUp:
		return ": raise {epsilon}.";
	case Error::BrokenTriangles:
		return (e.method == ricci::Method::EdgeSwaps
					? ", with " + std::to_string(e.swaps) + " edges swapped"
					: std::string()) +
			   (e.method == ricci::Method::IntrinsicFlips
					? ": remesh the worst triangles."
					: ": choose the method 'Intrinsic flips', or remesh the worst triangles.");
	case Error::LostInRounding:
		return ". Choose a {target_curvature} nearer to the curvature of the mesh.";
	case Error::FlipsUsedUp:
		return ": remesh the worst triangles.";
	case Error::CircleUnsettled:
		return ". Remesh the boundary, or choose another {target_curvature}.";
	case Error::FlatTriangles:
		return ". Choose the method 'Intrinsic flips', or another {target_curvature}.";
	case Error::SplitsUsedUp:
		return ": remesh the boundary.";
	case Error::NoCut:
		return ": choose the method 'Intrinsic flips'.";
	case Error::OutsideDisk:
		return ": choose larger cone angles, or 'Generalized Ricci Flow (Euclidean)'.";
	case Error::PiecesLost:
		return ": choose the output 'Keep the mesh'.";
	case Error::CheckFailed:
		return ": remesh the worst triangles, and report the mesh.";
	}
	return ".";
}

const char* remedy(const ricci::SolverFailed& e)
{
	switch (e.stage) {
	case ricci::SolverFailed::Flow:
		return ". Remesh the worst triangles.";
	case ricci::SolverFailed::SeamCost:
		return ". Set {seam_hiding} to 0, or remesh the worst triangles.";
	}
	return ".";
}

const char* remedy(const ricci::TooLarge& e)
{
	using Error = ricci::TooLarge;
	switch (e.problem) {
	case Error::Faces:
	case Error::Memory:
	case Error::Unknowns:
		return ": simplify it first ('Simplification: Quadric Edge Collapse Decimation'), or cut "
			   "it "
			   "into pieces.";
	case Error::DoubleMemory:
		return ": simplify the mesh first ('Simplification: Quadric Edge Collapse Decimation'), or "
			   "cut it into pieces.";
	case Error::Crossings:
	case Error::OverlayMemory:
		return ": divide long triangles and large fans first ('Remeshing: Isotropic Explicit "
			   "Remeshing').";
	}
	return ".";
}

/// Of the classes that have a remedy().
template<class Known>
auto inWords(const Known& e) -> decltype(std::string(remedy(e)))
{
	return e.what() + std::string(remedy(e));
}

std::string inWords(const ricci::Cancelled&)
{
	return "Cancelled: the mesh is unchanged.";
}

std::string inWords(const ricci::TimeOut& e)
{
	return "The run was stopped after " + numberText(e.elapsed, 3) + " seconds, with about " +
		   numberText(100.0 * e.done, 2) + "% done ({time_limit}: " + numberText(e.limit, 6) +
		   "): raise {time_limit}, or simplify the mesh. The mesh is unchanged.";
}

/// inWords() of the first of the classes that \p error belongs to.
template<class First, class... Others>
std::string inWordsOf(const ricci::Error& error)
{
	if (const auto* known = dynamic_cast<const First*>(&error))
		return inWords(*known);
	if constexpr (sizeof...(Others) > 0)
		return inWordsOf<Others...>(error);
	else
		return reported(error);
}

} // namespace

std::string unusable(const std::string& value, const char* parameter, const std::string& use)
{
	return "The value " + value + " of {" + parameter + "} cannot be used. Use " + use + ".";
}

std::string sentence(const ricci::Error& error)
{
	const std::string component =
		error.componentFaces == 0 ? std::string()
								  : "Component with face " + std::to_string(error.componentFace) +
										" (" + std::to_string(error.componentFaces) + " faces): ";
	return component + inWordsOf<
						   ricci::InvalidMesh,
						   ricci::InvalidOption,
						   ricci::InadmissibleCurvature,
						   ricci::NotConverged,
						   ricci::SolverFailed,
						   ricci::TooLarge,
						   ricci::Cancelled,
						   ricci::TimeOut>(error);
}

std::string currentErrorSentence()
{
	try {
		throw;
	}
	catch (const ricci::Error& error) {
		return sentence(error);
	}
	catch (const Refusal& refusal) {
		return refusal.what();
	}
	catch (const std::bad_alloc&) {
		return "There is not enough memory for this mesh. The mesh is unchanged.";
	}
	catch (const std::exception& error) {
		return std::string("The filter failed unexpectedly (") + error.what() +
			   "). Please report this, with the mesh if you can.";
	}
	catch (...) {
		return "The filter failed unexpectedly, for an unknown reason. Please report this, with "
			   "the mesh if you can.";
	}
}

} // namespace filter_ricci
