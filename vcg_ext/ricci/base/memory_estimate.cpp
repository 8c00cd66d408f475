// SPDX-License-Identifier: GPL-3.0-or-later
#include "memory_estimate.h"

#include "../error.h"
#include "task.h"

#include <algorithm>
#include <cmath>

namespace ricci {

namespace {

/// Bytes for each face of the mesh; for each face of the component at work; and the same for each
/// doubling of their number (the factor). Fitted from above to measured peaks of 5e4 to 1e6 faces
/// (1.2 to 1.4 kB for each, 1.8 with the common refinement). A flow on the double of a surface with
/// boundary cannot be foreseen, see requireMemoryForDouble().
/// Then of the arrays for the output of the common refinement, for each face at work; and for each crossing of the
/// overlay, measured on cylinders whose caps are fans.
constexpr double kEveryFace = 350.0, kFaceAtWork = 450.0, kFaceInFactor = 35.0,
				 kFaceRefined = 400.0, kCrossing = 390.0, kCrossingRefined = 760.0;

/// More faces than this have more halfedges than int has numbers, or could have after refinement; and a crossing
/// makes up to eight corners of pieces, which int has to number.
constexpr std::size_t kMaxFaces = 300000000, kMaxCrossings = 250000000;

void requireBytes(double needed, TooLarge::Problem problem, std::size_t count)
{
	if (!hasRoomFor(needed))
		throw TooLarge(problem, count, needed, Task::memoryLimit());
}

} // namespace

double estimatedMemory(std::size_t faces, std::size_t allFaces, bool refines)
{
	const auto n = static_cast<double>(faces);
	double each = kFaceAtWork + kFaceInFactor * std::log2(std::max(n, 2.0));
	if (refines)
		each += kFaceRefined;
	return kEveryFace * static_cast<double>(allFaces) + each * n;
}

bool hasRoomFor(double bytes)
{
	const double limit = Task::memoryLimit();
	return limit <= 0.0 || bytes <= limit;
}

void requireMemory(std::size_t faces, std::size_t allFaces, bool refines)
{
	if (allFaces > kMaxFaces)
		throw TooLarge(TooLarge::Faces, allFaces, 0.0, static_cast<double>(kMaxFaces));
	requireBytes(estimatedMemory(faces, allFaces, refines), TooLarge::Memory, allFaces);
}

void requireMemoryForDouble(std::size_t faces)
{
	requireBytes(estimatedMemory(2 * faces, faces, false), TooLarge::DoubleMemory, 2 * faces);
}

void requireOverlayMemory(std::size_t crossings, bool refines)
{
	if (crossings > kMaxCrossings)
		throw TooLarge(TooLarge::Crossings, crossings, 0.0, static_cast<double>(kMaxCrossings));
	requireBytes(
		(refines ? kCrossingRefined : kCrossing) * static_cast<double>(crossings),
		TooLarge::OverlayMemory,
		crossings);
}

} // namespace ricci
