// SPDX-License-Identifier: GPL-3.0-or-later
// Typed errors of the algorithm. Every what() is one or more full sentences meant for the user:
// the problem, how many or which elements, and what to do.
#ifndef RICCI_ERROR_H
#define RICCI_ERROR_H

#include <stdexcept>

namespace ricci {

/// Base of everything the algorithm throws on purpose.
class Error : public std::runtime_error
{
	using std::runtime_error::runtime_error;
};

/// The mesh cannot be used: not a manifold, not orientable, degenerate, not finite, empty.
class InvalidMesh : public Error
{
	using Error::Error;
};

/// An option or a prescribed value is out of range, or contradicts the topology of the mesh.
class InvalidOption : public Error
{
	using Error::Error;
};

/// No metric has the prescribed curvature (Gauss–Bonnet, or a curvature beyond its bound).
class InadmissibleCurvature : public Error
{
	using Error::Error;
};

/// The flow stopped before it reached the prescribed curvature.
class NotConverged : public Error
{
	using Error::Error;
};

/// The mesh needs more memory than there is, or more elements than int can number.
class TooLarge : public Error
{
	using Error::Error;
};

/// The listener asked the run to stop (progress.h). Nothing is tried again after it.
class Stopped : public Error
{
	using Error::Error;
};

/// The caller's progress callback asked to stop.
class Cancelled : public Stopped
{
public:
	Cancelled() : Stopped("Cancelled: the mesh is unchanged.") {}
};

/// The run took longer than its caller allows (time_limit.h).
class TimeOut : public Stopped
{
	using Stopped::Stopped;
};

} // namespace ricci

#endif
