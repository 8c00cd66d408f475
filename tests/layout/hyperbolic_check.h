// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_HYPERBOLIC_CHECK_H
#define RICCI_TESTS_HYPERBOLIC_CHECK_H

#include "support/bolza.h"
#include "support/complex.h"
#include "support/shapes.h"

#include <ricci/parametrize.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace ricci::testing {

/// Triangles in the Poincaré disk as a surface of curvature -1.
struct HyperbolicCheck
{
	std::vector<long double> defect; ///< [vertex] 2 pi, pi on the boundary, less the angles
	long double area = 0.0L;
	int flipped = 0; ///< geodesic triangles that are not counter-clockwise
	/// Both sides of the edges that are not joined, which have to be as long as each other.
	std::vector<std::array<std::array<Complex, 2>, 2>> seams;

	/// \param mesh places are points of the disk, triangles coherent
	explicit HyperbolicCheck(const FlatMesh& mesh) :
			defect(at(mesh.vertexCount()), 2 * std::acos(-1.0L))
	{
		const long double pi = std::acos(-1.0L);
		std::map<std::pair<int, int>, std::array<Complex, 2>> sides;
		for (const int f : mesh.points.indices()) {
			std::array<Complex, 3> p;
			for (std::size_t k = 0; k < 3; ++k)
				p[k] = asComplex(mesh.at(f)[k]);
			flipped += hyperbolicOrientation(p[0], p[1], p[2]) != 1;
			area += pi;
			for (std::size_t k = 0; k < 3; ++k) {
				const long double angle = angleInDisk(p[k], p[(k + 1) % 3], p[(k + 2) % 3]);
				area -= angle;
				defect[at(mesh.vertices[f][k])] -= angle;
				const int v = mesh.vertices[f][k], w = mesh.vertices[f][(k + 1) % 3];
				EXPECT_TRUE(sides.insert({{v, w}, {p[k], p[(k + 1) % 3]}}).second);
			}
		}
		for (const auto& [ends, here] : sides) {
			const auto across = sides.find({ends.second, ends.first});
			if (across == sides.end()) {
				// A vertex of the boundary begins one edge of it. Its other points lie on a straight line.
				defect[at(ends.first)] -= pi;
				continue;
			}
			const std::array<Complex, 2> there{across->second[1], across->second[0]};
			if (ends.first > ends.second || here == there)
				continue;
			seams.push_back({here, there});
			const double left = chordLength(here[0], here[1]),
						 right = chordLength(there[0], there[1]);
			double rounding = 0.0;
			for (const Complex z : {here[0], here[1], there[0], there[1]})
				rounding += 4e-16 / (1.0 - std::norm(z));
			EXPECT_NEAR(left, right, 1e-9 * left + rounding);
		}
	}

	/// Of a surface with this curvature at its first vertices, and 0 at all others.
	void expectCurvature(const std::vector<double>& curvature) const
	{
		EXPECT_EQ(flipped, 0);
		for (std::size_t v = 0; v < defect.size(); ++v)
			EXPECT_NEAR(
				static_cast<double>(defect[v]), v < curvature.size() ? curvature[v] : 0.0, 1e-8)
				<< "point " << v;
	}
};

} // namespace ricci::testing

#endif
