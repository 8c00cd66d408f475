// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperbolic_distortion.h"

#include "../layout/hyperbolic_layout.h"
#include "../math/disk_isometry.h"
#include "../metric/triangle.h"

#include <algorithm>
#include <complex>
#include <cstddef>

namespace ricci {

namespace {

int orientationInDisk(const Triangle2& p)
{
	return hyperbolicOrientation(asComplex(p[0]), asComplex(p[1]), asComplex(p[2]));
}

/// The flat triangle whose sides are the chords of a geodesic triangle of the disk, with the
/// triangle's orientation. Where no flat triangle has these sides its height is 0.
Triangle2 chordTriangle(const Triangle2& p)
{
	const std::complex<double> x = asComplex(p[0]), y = asComplex(p[1]), z = asComplex(p[2]);
	const double base = chordLength(x, y), left = chordLength(x, z), right = chordLength(y, z);
	if (!(base > 0.0))
		return {};
	const TriangleApex apex = triangleApex(base, left, right);
	const double height = orientationInDisk(p) < 0 ? -apex.height : apex.height;
	return {{{0.0, 0.0}, {base, 0.0}, {apex.along, height}}};
}

} // namespace

DistortionField measureHyperbolicDistortion(
	const SurfaceMesh& mesh,
	const std::vector<Triangle2>& uv,
	const std::vector<char>& reversed,
	Report& report)
{
	std::vector<Triangle2> chords(uv.size());
	std::transform(uv.begin(), uv.end(), chords.begin(), chordTriangle);
	DistortionField field = measureDistortion(mesh, chords, reversed, report);
	report.flippedFaces = 0;
	for (std::size_t f = 0; f < uv.size(); ++f)
		report.flippedFaces += orientationInDisk(uv[f]) != (reversed[f] ? -1 : 1);
	return field;
}

} // namespace ricci
