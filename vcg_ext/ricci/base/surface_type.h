// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SURFACE_TYPE_H
#define RICCI_SURFACE_TYPE_H

#include "numbers.h"

#include <string>

namespace ricci {

/// Topological type of a connected, oriented, compact surface.
struct SurfaceType
{
	int genus = 0;
	int boundaryLoops = 0;

	int eulerCharacteristic() const { return 2 - 2 * genus - boundaryLoops; }
	/// Of a metric on it, by Gauss-Bonnet.
	double totalCurvature() const { return 2 * kPi * eulerCharacteristic(); }
	bool isClosed() const { return boundaryLoops == 0; }
	bool isSphere() const { return genus == 0 && boundaryLoops == 0; }
	bool isDisk() const { return genus == 0 && boundaryLoops == 1; }
	bool isAnnulus() const { return genus == 0 && boundaryLoops == 2; }
	bool isTorus() const { return genus == 1 && boundaryLoops == 0; }

	/// "a closed surface of genus 2", "an annulus", ...
	std::string name() const
	{
		if (isClosed())
			return "a closed surface of genus " + std::to_string(genus) +
				   (genus == 0   ? " (a sphere)"
					: genus == 1 ? " (a torus)"
								 : "");
		if (isDisk())
			return "a disk";
		if (isAnnulus())
			return "an annulus";
		return "a surface of genus " + std::to_string(genus) + " with " +
			   std::to_string(boundaryLoops) + " boundary loop" + (boundaryLoops == 1 ? "" : "s");
	}
};

} // namespace ricci

#endif
