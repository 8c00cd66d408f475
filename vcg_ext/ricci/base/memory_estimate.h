// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_MEMORY_ESTIMATE_H
#define RICCI_MEMORY_ESTIMATE_H

#include <cstddef>

namespace ricci {

/// Bytes that a run needs at its peak for a surface of \p faces triangles in its largest component
/// and \p allFaces in all, with the common refinement as output if it \p refines, estimated on the
/// safe side from measured runs: arrays in proportion to the faces, and the factor of the Hessian,
/// which grows like n log n on surfaces.
double estimatedMemory(std::size_t faces, std::size_t allFaces, bool refines);

/// Whether \p bytes are below Task::memoryLimit(), if there is one.
bool hasRoomFor(double bytes);

/// \throw TooLarge if the estimate is above Task::memoryLimit(), or if int cannot number the elements
void requireMemory(std::size_t faces, std::size_t allFaces, bool refines);

/// For the flow on the double of a surface with boundary, which \p faces are one half of.
/// \throw TooLarge if that needs more than Task::memoryLimit()
void requireMemoryForDouble(std::size_t faces);

/// For the overlay of two triangulations, whose size the faces do not tell: a fan of n triangles at
/// one vertex can make n^2 crossings.
/// \throw TooLarge if \p crossings need more than Task::memoryLimit(), or are too many for int
void requireOverlayMemory(std::size_t crossings, bool refines);

} // namespace ricci

#endif
