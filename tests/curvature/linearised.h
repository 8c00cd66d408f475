// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_LINEARISED_H
#define RICCI_TESTS_LINEARISED_H

#include "dense_flow.h"

#include "support/packed.h"

#include <ricci/curvature/linear_flow.h>

#include <string>

namespace ricci::testing {

/// A mesh with a boundary that is to do this while cones are placed.
struct LinearCase
{
	std::string name;
	SurfaceMesh mesh;
	ConeBoundary boundary;
};

/// A linear flow with what it refers to.
struct Linearised
{
	Packed packed;
	EmbeddedSurface surface;
	InitialPacking start;
	LinearFlow flow;

	explicit Linearised(const LinearCase& c) :
			packed(c.mesh), surface(surfaceOf(packed)),
			start(initialPacking(surface, FlowOptions())), flow(surface, start, c.boundary)
	{
	}
};

} // namespace ricci::testing

#endif
