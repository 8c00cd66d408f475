// SPDX-License-Identifier: GPL-3.0-or-later
#include "memory.h"

#include "error.h"
#include "text.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ricci {

namespace {

/// Bytes for each face of the mesh; for each face of the component at work; and the same for each
/// doubling of their number (the factor). Fitted from above to measured peaks of 5e4 to 1e6 faces
/// (1.2 to 1.4 kB for each, 1.8 with the common refinement). A flow on the double of a surface with
/// boundary cannot be foreseen, see requireMemoryForDouble().
constexpr double kEveryFace = 350.0, kFaceAtWork = 450.0, kFaceInFactor = 35.0;

/// Of the arrays for the output of the common refinement, for each face at work.
constexpr double kFaceRefined = 400.0;

/// For each crossing of the overlay, measured on cylinders whose caps are fans.
constexpr double kCrossing = 390.0, kCrossingRefined = 760.0;

/// More faces than this have more halfedges than int has numbers, or could have after refinement.
constexpr std::size_t kMostFaces = 300000000;

/// A crossing makes up to eight corners of pieces, which int has to number.
constexpr std::size_t kMostCrossings = 250000000;

constexpr double kGigabyte = 1e9;

} // namespace

double estimatedMemory(std::size_t faces, std::size_t allFaces, bool refines)
{
	const auto n = static_cast<double>(faces);
	double each = kFaceAtWork + kFaceInFactor * std::log2(std::max(n, 2.0));
	if (refines)
		each += kFaceRefined;
	return kEveryFace * static_cast<double>(allFaces) + each * n;
}

void requireMemory(std::size_t faces, std::size_t allFaces, bool refines, double limit)
{
	const std::string remedy = ": simplify it first ('Simplification: Quadric Edge Collapse "
							   "Decimation'), or cut it into pieces.";
	if (allFaces > kMostFaces)
		throw TooLarge(
			"The mesh has " + std::to_string(allFaces) + " faces, but at most " +
			std::to_string(kMostFaces) + " can be numbered" + remedy);
	const double needed = estimatedMemory(faces, allFaces, refines);
	if (limit > 0.0 && needed > limit)
		throw TooLarge(
			"The mesh has " + std::to_string(allFaces) + " faces and needs about " +
			numberText(needed / kGigabyte, 3) + " GB of memory, but only " +
			numberText(limit / kGigabyte, 3) + " GB are free" + remedy);
}

void requireMemoryForDouble(std::size_t faces, double limit)
{
	const double needed = estimatedMemory(2 * faces, faces, false);
	if (limit > 0.0 && needed > limit)
		throw TooLarge(
			"Boundary edges have to flip, and the double of the surface with " +
			std::to_string(2 * faces) + " faces needs about " + numberText(needed / kGigabyte, 3) +
			" GB of memory, but only " + numberText(limit / kGigabyte, 3) +
			" GB were free: simplify the mesh first ('Simplification: Quadric Edge Collapse "
			"Decimation'), or cut it into pieces.");
}

void requireOverlayMemory(std::size_t crossings, bool refines, double limit)
{
	const std::string remedy =
		": divide long triangles and large fans first ('Remeshing: Isotropic "
		"Explicit Remeshing').";
	const std::string points = "The edges after the flow cross those of the mesh at more than " +
							   std::to_string(crossings) + " points, ";
	if (crossings > kMostCrossings)
		throw TooLarge(
			points + "but at most " + std::to_string(kMostCrossings) + " can be numbered" + remedy);
	const double needed = (refines ? kCrossingRefined : kCrossing) * static_cast<double>(crossings);
	if (limit > 0.0 && needed > limit)
		throw TooLarge(
			points + "whose overlay needs over " + numberText(needed / kGigabyte, 3) +
			" GB of memory, but only " + numberText(limit / kGigabyte, 3) + " GB were free" +
			remedy);
}

std::size_t largestComponent(const std::vector<Component>& components)
{
	std::size_t largest = 0;
	for (const Component& component : components)
		largest = std::max(largest, component.triangles.size());
	return largest;
}

} // namespace ricci
