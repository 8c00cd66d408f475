// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperbolic_distortion.h"

#include "../layout/hyperbolic_layout.h"
#include "../math/disk_isometry.h"
#include "../metric/area.h"

#include <complex>

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
	const FlatMesh& mesh, const std::vector<Point3>& surface, Report& report)
{
	Array<Triangle2> chords;
	int flipped = 0;
	for (const int f : mesh.points.indices()) {
		chords.push_back(chordTriangle(mesh.at(f)));
		flipped += orientationInDisk(mesh.at(f)) <= 0;
	}
	DistortionField field = measureDistortion(mesh.vertices, surface, chords, report);
	report.flippedFaces = flipped;
	return field;
}

} // namespace ricci
