// SPDX-License-Identifier: GPL-3.0-or-later
#include "../error.h"

#include "numbers.h"

namespace ricci {

namespace {

std::string number(double x)
{
	return numberText(x, 9);
}

std::string gigabytes(double bytes)
{
	return numberText(bytes / 1e9, 3) + " GB";
}

std::string words(InvalidMesh::Problem problem, std::size_t n, const std::array<int, 2>& vertices)
{
	switch (problem) {
	case InvalidMesh::Empty:
		return "The mesh is empty";
	case InvalidMesh::NoFaces:
		return "The mesh has " + counted(n, "vertex", "vertices") + " but no faces";
	case InvalidMesh::ArrayLength:
		return "An array has the wrong length, " + std::to_string(n);
	case InvalidMesh::NoTriangle:
		return counted(n, "face has", "faces have") + " lengths that are those of no triangle";
	case InvalidMesh::UnequalSides:
		return counted(n, "edge has", "edges have") + " two lengths, one in each of its faces";
	case InvalidMesh::ScalesApart:
		return "The coordinates differ by more than doubles hold: vertex " +
			   std::to_string(vertices[0]) + " is so far away that other faces have no area";
	case InvalidMesh::DamagedFaces:
		return counted(n, "face uses", "faces use") +
			   " vertices that are deleted or not in the mesh";
	case InvalidMesh::NotFinite:
		return counted(n, "vertex has", "vertices have") +
			   " coordinates that are not finite numbers (NaN or infinite)";
	case InvalidMesh::OutOfRange:
		return counted(n, "vertex has", "vertices have") + " coordinates beyond 1e50";
	case InvalidMesh::TooSmall:
		return counted(n, "component is", "components are") + " smaller than 1e-50";
	case InvalidMesh::NoArea:
		return "The mesh has " + counted(n, "face", "faces") +
			   " but no area (each component lies on one line, or in one point)";
	case InvalidMesh::EdgesWithoutLength:
		return counted(n, "edge has", "edges have") + " no length";
	case InvalidMesh::FacesWithoutArea:
		return counted(n, "face has", "faces have") + " no area";
	case InvalidMesh::IncoherentEdge:
		return "The edge between vertices " + std::to_string(vertices[0]) + " and " +
			   std::to_string(vertices[1]) + " is not shared by two coherent triangles";
	case InvalidMesh::NotPuncturable:
		return "The surface cannot be punctured for the map to the sphere: near its best vertices "
			   "it touches itself";
	case InvalidMesh::BeyondFloats:
		return "The mesh is too large or too small for texture coordinates in its own scale";
	}
	return "";
}

std::string words(const InvalidOption& e)
{
	switch (e.problem) {
	case InvalidOption::NoSuchChoice:
		return "The option " + std::string(e.name) + " has no choice of the number " +
			   number(e.value) + ": its choices are 0 to " + number(e.bound - 1.0);
	case InvalidOption::TimeLimit:
		return "The time limit must be 0 seconds or more, not " + number(e.value);
	case InvalidOption::MemoryLimit:
		return "The memory limit must be 0 bytes or more, not " + number(e.value);
	case InvalidOption::Epsilon:
		return "The requested curvature error must be greater than 0 radians, not " +
			   number(e.value);
	case InvalidOption::SharpAngle:
		return "The angle of sharp edges must be greater than 0 and at most pi, not " +
			   number(e.value) + " radians";
	case InvalidOption::ConeCount:
		return "The number of cones must be 0 or more, not " + number(e.value);
	case InvalidOption::ConeDistortion:
		return "The distortion that cones may leave must be 0 or more and finite, not " +
			   number(e.value);
	case InvalidOption::ConeAngle:
		return "The angle of cones must be finite and greater than 0, not " + number(e.value) +
			   " radians";
	case InvalidOption::SeamHiding:
		return "Seam hiding must be between 0 and 1, not " + number(e.value);
	case InvalidOption::ChartMargin:
		return "The margin between charts must be between 0 and " + number(e.bound) + ", not " +
			   number(e.value);
	case InvalidOption::TileSide:
		return "The side of tiles must be 0, or finite and at " +
			   std::string(e.bound > 0.0 && e.value > e.bound ? "most " : "least ") +
			   number(e.bound) + ", not " + number(e.value);
	case InvalidOption::TilesInOwnScale:
		return "Tiles are squares of side 1, in which coordinates cannot keep the scale of the "
			   "mesh";
	case InvalidOption::WithoutFlips:
		return "The common refinement and capped holes need intrinsic flips";
	case InvalidOption::WithoutPositions:
		return "Automatic corners of a rectangle, edge swaps, the common refinement, "
			   "hidden seams, sharp edges, quarter "
			   "turns and the sphere need positions, but the surface is given by edge lengths";
	case InvalidOption::HyperbolicMethod:
		return "The hyperbolic flow has no edge swaps and no Thurston packing";
	case InvalidOption::NotADisk:
		return std::string(e.target == TargetCurvature::Rectangle ? "A rectangle" : "A disk") +
			   " is the image of a topological disk (genus 0, one boundary loop), but the surface "
			   "is " +
			   e.surface.name();
	case InvalidOption::TooFewBoundaryVertices:
		return "A rectangle needs four boundary vertices, but the boundary has " +
			   std::to_string(e.count);
	case InvalidOption::CornerCount:
		return "A rectangle needs four selected boundary vertices, or none, but " +
			   std::to_string(e.count) + " are selected";
	case InvalidOption::CornersOffBoundary:
		return "A rectangle needs four selected vertices on one boundary loop, but only " +
			   std::to_string(e.count) + " of the selected vertices lie on it";
	case InvalidOption::NothingSelected:
		return "Cones at selected vertices need selected vertices, but none is selected";
	case InvalidOption::TooFewCones:
		return "The surface needs at least " + number(e.bound) + " placed cones, but " +
			   number(e.value) + " were requested";
	case InvalidOption::TooFewVertices:
		return "The surface has " + std::to_string(e.count) + " interior vertices, too few for " +
			   number(e.bound) + " cones";
	case InvalidOption::SphereOfComponents:
		return "The map to the sphere needs one closed surface of genus 0, but the mesh has " +
			   std::to_string(e.count) + " components";
	case InvalidOption::NotASphere:
		return "The map to the sphere needs a closed surface of genus 0, but the surface is " +
			   e.surface.name();
	case InvalidOption::NoMap:
		return "The map to be kept has no coordinates for " + counted(e.count, "face", "faces");
	case InvalidOption::MapWithoutArea:
		return "The map to be kept takes every face to a line or a point";
	case InvalidOption::CoverTooLarge:
		return number(e.value) + " rings of the universal cover would need more than " +
			   std::to_string(e.count) + " faces";
	}
	return "";
}

std::string words(const InadmissibleCurvature& e)
{
	switch (e.problem) {
	case InadmissibleCurvature::NotFinite:
		return counted(e.count, "vertex has", "vertices have") +
			   " a target curvature that is not a finite number";
	case InadmissibleCurvature::Flat:
		return "A flat metric needs total curvature 2 pi chi = 0, but the surface is " +
			   e.surface.name() + " with 2 pi chi = " + number(e.bound);
	case InadmissibleCurvature::GaussBonnet:
		return "The target curvature adds up to " + number(e.value) +
			   ", but a metric on this surface has total curvature 2 pi chi = " + number(e.bound) +
			   " (Gauss-Bonnet)";
	case InadmissibleCurvature::TooLargeInside:
		return "No metric has curvature " + number(e.value) + " at an interior vertex (" +
			   std::to_string(e.count) + " such): it must be less than 2 pi = 6.28318531 inside";
	case InadmissibleCurvature::TooLargeOnBoundary:
		return "No metric has curvature " + number(e.value) + " at a boundary vertex (" +
			   std::to_string(e.count) +
			   " such): it must be less than pi = 3.14159265 on the "
			   "boundary";
	case InadmissibleCurvature::FreeBoundary:
		return "The curvature inside adds up to " + number(e.value) +
			   ", but with a free boundary of " + std::to_string(e.count) +
			   " vertices it must be more than 2 pi chi - pi (boundary vertices) = " +
			   number(e.bound);
	case InadmissibleCurvature::ScalesApart:
		return "The target curvature would make parts of the surface about 1e" + number(e.value) +
			   " times as large as others";
	case InadmissibleCurvature::HyperbolicSurface:
		return "A hyperbolic metric without cones needs an Euler characteristic below 0, but the "
			   "surface is " +
			   e.surface.name() + " with Euler characteristic " +
			   std::to_string(e.surface.eulerCharacteristic());
	case InadmissibleCurvature::HyperbolicSum:
		return "The target curvature adds up to " + number(e.value) +
			   ", but a hyperbolic metric on this surface needs more than 2 pi chi = " +
			   number(e.bound) + " (Gauss-Bonnet: the difference is the area)";
	}
	return "";
}

std::string words(const NotConverged& e)
{
	const auto n = std::to_string(e.count);
	switch (e.problem) {
	case NotConverged::StepsUsedUp:
		return "The flow stopped after " + std::to_string(e.iterations) +
			   " Newton steps with a curvature error of " + numberText(e.residual, 3) +
			   " (wanted: " + numberText(e.epsilon, 3) +
			   ", rounding floor: " + numberText(e.floor, 3) + ")";
	case NotConverged::BrokenTriangles:
		return counted(e.count, "triangle breaks", "triangles break") +
			   " the triangle inequality at the end of the flow";
	case NotConverged::LostInRounding:
		if (e.count == 0)
			return "The flow is lost in rounding: it makes parts of the surface 1e" +
				   number(e.value) + " times as large as others";
		return counted(e.count, "triangle is", "triangles are") +
			   " lost in rounding: the flow makes parts of the surface 1e" + number(e.value) +
			   " times as large as others";
	case NotConverged::FlipsUsedUp:
		return "After " + n + " flips there are still edges that are not Delaunay";
	case NotConverged::CircleUnsettled:
		return "The boundary did not settle on a circle: its points still move by " +
			   numberText(e.value, 3) + " radians";
	case NotConverged::FlatTriangles:
		return counted(e.count, "triangle is", "triangles are") +
			   " flat at the end of the flow: the target curvature is the limit of what these "
			   "triangles can reach";
	case NotConverged::SplitsUsedUp:
		return "Triangles on the boundary kept breaking after " + n + " boundary edges were split";
	case NotConverged::NoCut:
		return "The surface cannot be cut open without crossing a swapped edge";
	case NotConverged::OutsideDisk:
		return n + " corners of faces lie so far from the middle of the layout that rounding puts "
				   "them on the border of the Poincaré disk";
	case NotConverged::PiecesLost:
		return n + " of the " + numberText(e.value, 9) +
			   " pieces of the common refinement are smaller than floats can hold";
	case NotConverged::CheckFailed:
		return "The finished map failed its check (" + e.finding + ")";
	}
	return "";
}

std::string words(TooLarge::Problem problem, std::size_t count, double needed, double limit)
{
	const auto n = std::to_string(count);
	switch (problem) {
	case TooLarge::Faces:
		return "The mesh has " + n + " faces, but at most " + number(limit) + " can be numbered";
	case TooLarge::Memory:
		return "The mesh has " + n + " faces and needs about " + gigabytes(needed) +
			   " of memory, but only " + gigabytes(limit) + " are free";
	case TooLarge::DoubleMemory:
		return "Boundary edges have to flip, and the double of the surface with " + n +
			   " faces needs about " + gigabytes(needed) + " of memory, but only " +
			   gigabytes(limit) + " were free";
	case TooLarge::Unknowns:
		return "The linear system of " + n + " unknowns is too large for the solver";
	case TooLarge::Crossings:
		return "The edges after the flow cross those of the mesh at more than " + n +
			   " points, but at most " + number(limit) + " can be numbered";
	case TooLarge::OverlayMemory:
		return "The edges after the flow cross those of the mesh at more than " + n +
			   " points, whose overlay needs over " + gigabytes(needed) + " of memory, but only " +
			   gigabytes(limit) + " were free";
	}
	return "";
}

} // namespace

InvalidMesh::InvalidMesh(Problem p, std::size_t n, std::array<int, 2> v) :
		Error(words(p, n, v)), problem(p), count(n), vertices(v)
{
}

InvalidMesh::InvalidMesh(const char* name, std::size_t length, std::size_t needed) :
		Error(
			"The array " + std::string(name) + " has " + counted(length, "entry", "entries") +
			", but needs " + std::to_string(needed) + ", or none"),
		problem(ArrayLength), count(length), vertices{-1, -1}, array(name), wanted(needed)
{
}

InvalidOption::InvalidOption(const char* option, int v, int choices) :
		problem(NoSuchChoice), value(v), bound(choices), name(option)
{
	describe(words(*this));
}

InvalidOption::InvalidOption(Problem p, double v, double b, std::size_t n) :
		problem(p), value(v), bound(b), count(n)
{
	describe(words(*this));
}

InvalidOption::InvalidOption(Problem p, TargetCurvature t, const SurfaceType& s) :
		problem(p), target(t), surface(s)
{
	describe(words(*this));
}

InadmissibleCurvature::InadmissibleCurvature(
	Problem p, double v, double b, std::size_t n, const SurfaceType& s) :
		problem(p),
		value(v), bound(b), count(n), surface(s)
{
	describe(words(*this));
}

NotConverged::NotConverged(Problem p, std::size_t n, double v) : problem(p), count(n), value(v)
{
	describe(words(*this));
}

NotConverged::NotConverged(const std::string& f) : problem(CheckFailed), finding(f)
{
	describe(words(*this));
}

NotConverged::NotConverged(int steps, double r, double e, double f) :
		problem(StepsUsedUp), iterations(steps), residual(r), epsilon(e), floor(f)
{
	describe(words(*this));
}

SolverFailed::SolverFailed(Stage s) :
		Error("The linear solver failed: its matrix is not positive definite"), stage(s)
{
}

TooLarge::TooLarge(Problem p, std::size_t n, double bytes, double bound) :
		Error(words(p, n, bytes, bound)), problem(p), count(n), needed(bytes), limit(bound)
{
}

TimeOut::TimeOut(double seconds, double share, double bound) :
		Stopped(
			"The run was stopped after " + numberText(seconds, 3) + " seconds, with about " +
			numberText(100.0 * share, 2) + "% done (limit: " + numberText(bound, 6) + " seconds)"),
		elapsed(seconds), done(share), limit(bound)
{
}

} // namespace ricci
