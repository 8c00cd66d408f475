// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_COVERED_TWICE_H
#define RICCI_TESTS_COVERED_TWICE_H

#include "flat_map.h"

namespace ricci::testing {

/// What lies on each other in a finished texture, found without knowing how it was made: charts are
/// faces joined by edges that have the same place on both sides.
struct CoveredTwice
{
	int charts = 0;
	long betweenCharts = 0; ///< pairs of faces of different charts with a common inner point
	long withinCharts = 0;  ///< pairs of one chart whose common part is wider than kContact

	/// Rounding of texture coordinates, which are floats, on both sides of a seam.
	static constexpr double kContact = 3e-7;

	/// \param uv in the unit square; taken as floats. Faces that are flipped, or have no area,
	/// are left out.
	CoveredTwice(const SurfaceMesh& mesh, const UV& uv, const std::vector<char>& reversed);
};

} // namespace ricci::testing

#endif
