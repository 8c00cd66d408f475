// SPDX-License-Identifier: GPL-3.0-or-later
#include "flipped_triangles.h"

#include "../base/tolerances.h"
#include "../math/orientation.h"
#include "separate_charts.h"

#include <complex>
#include <cstddef>
#include <vector>

namespace ricci {

namespace {

/// Corner \p k of the triangle reflected in the opposite side.
Point2 reflected(const Triangle2& p, std::size_t k)
{
	const std::complex<double> a = asComplex(p[(k + 1) % 3]), b = asComplex(p[(k + 2) % 3]);
	return asPoint(a + (b - a) * std::conj((asComplex(p[k]) - a) / (b - a)));
}

std::size_t oppositeLongest(const Triangle2& p)
{
	std::size_t best = 0;
	for (std::size_t k = 1; k < 3; ++k)
		if (distance(p[(k + 1) % 3], p[(k + 2) % 3]) >
			distance(p[(best + 1) % 3], p[(best + 2) % 3]))
			best = k;
	return best;
}

} // namespace

void reflectFlipped(Parametrization& map)
{
	FlatMesh& mesh = map.mesh;
	const std::vector<Box2> boxes = mesh.boxes(map.charts.size());
	std::vector<int> flipped;
	for (const int f : mesh.points.indices()) {
		const Triangle2 p = mesh.at(f);
		if (orientation(p) >= 0)
			continue;
		const std::size_t k = oppositeLongest(p);
		if (distance(reflected(p, k), p[k]) > kOnePlace * boxes[positionOf(mesh.chart[f])].extent())
			flipped.push_back(f);
	}
	if (flipped.empty())
		return;
	const Seams before = seams(mesh);
	std::vector<Triangle2> corners;
	corners.reserve(flipped.size());
	for (const int f : flipped)
		corners.push_back(mesh.at(f));
	for (std::size_t i = 0; i < flipped.size(); ++i) {
		const std::size_t k = oppositeLongest(corners[i]);
		mesh.points[flipped[i]][k] = mesh.place.size();
		mesh.place.push_back(reflected(corners[i], k));
	}
	splitPoints(mesh);
	countCuts(before, map);
}

} // namespace ricci
