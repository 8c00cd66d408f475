// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PATCHES_H
#define RICCI_PATCHES_H

#include "../base/graphs.h"
#include "../base/numbers.h"
#include "../base/points.h"
#include "../layout/flat_mesh.h"
#include "point_groups.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace ricci {

/// What a triangle must be in the plane.
struct Validity
{
	double height = 0.0;   ///< its least height is above this
	double wanted = 0.0;   ///< and should be this at least where it is mended
	bool asFloats = false; ///< with its coordinates rounded to float
	double step = 0.0;     ///< and these to multiples of it, if it is not 0

	/// The point as it is stored.
	Point2 stored(const Point2& p) const
	{
		const Point2 rounded = inSteps(p);
		return step > 0.0 ? Point2{rounded[0] * step, rounded[1] * step} : rounded;
	}

	/// Whether it is counter-clockwise, exactly.
	bool isUpright(const Triangle2& p) const
	{
		return orientation(inSteps(p[0]), inSteps(p[1]), inSteps(p[2])) > 0;
	}

	/// Whether it is counter-clockwise, exactly, and high enough.
	bool isValid(const Triangle2& p) const
	{
		const Point2 a = inMemory(p[0]), b = inMemory(p[1]), c = inMemory(p[2]);
		const auto square = [](const Point2& from, const Point2& to) {
			return std::norm(asComplex(to) - asComplex(from));
		};
		const double longest = std::sqrt(std::max({square(a, b), square(b, c), square(c, a)}));
		return orientation(a, b, c) > 0 && doubledArea(a, b, c) > height * longest &&
			   (step == 0.0 || isUpright(p));
	}

private:
	/// The point as it is stored, in steps if there are any: decimal fractions are not doubles.
	Point2 inSteps(const Point2& p) const
	{
		Point2 rounded = inMemory(p);
		if (step > 0.0)
			for (double& x : rounded)
				x = std::nearbyint(x / step);
		return rounded;
	}

	Point2 inMemory(const Point2& p) const
	{
		return asFloats ? Point2{roundedToFloat(p[0]), roundedToFloat(p[1])} : p;
	}
};

/// A part of a flat mesh whose inner points may move while everything round it stays.
struct Patch
{
	std::vector<int> triangles; ///< of the mesh, in increasing order
	std::vector<int> points;    ///< of the mesh: [local point]
	Array<Triangle> corners;    ///< [triangle of the patch] local points
	Array<int> variable;        ///< [local point] the group that moves it, or -1
	int variables = 0;          ///< groups all of whose triangles are in the patch

	/// Whether nothing holds it: all points move, each by itself.
	bool isFree() const { return variables == static_cast<int>(points.size()); }
};

/// All triangles, with the groups that are not fixed.
Patch wholePatch(const FlatMesh& flat, const PointGroups& groups);

/// Finds patches in one flat mesh.
class PatchFinder
{
public:
	PatchFinder(const FlatMesh& flat, const PointGroups& groups);

	/// The patches that \p rings rings round \p seeds make, k rings being the triangles that the
	/// points of k - 1 rings belong to. Patches that meet in a point are one. So no variable of one
	/// patch moves a triangle of another. A seed with no point that moves makes no patch.
	/// \return the patches in the order of their lowest triangles, those without variables left out
	std::vector<Patch> patches(const std::vector<int>& seeds, int rings);

private:
	Patch makePatch(std::vector<int> triangles);

	const FlatMesh& m_flat;
	const PointGroups& m_groups;
	Adjacency<int, int> m_trianglesOf; // [group] a triangle once for each of its corners
	Array<char> m_taken;               // [triangle] scratch, 0 between calls
	Array<int> m_local;                // [point] scratch, -1 between calls
	Array<int> m_number, m_count;      // [group] scratch, -1 and 0 between calls
};

/// Where the triangles of a patch have their shapes from.
enum class RestShapes {
	OfSurface,       ///< from their sides on the surface, scaled as the map scales them nearby
	OfSurfaceEvenly, ///< from their sides on the surface, all of the patch scaled alike
	OfDrawing        ///< as they are in the plane, if counter-clockwise; else OfSurface
};

/// The shapes of the triangles of \p patch. A triangle without a shape, or with a thin one, gets one that is
/// less thin. All are as high as \p validity wants.
std::vector<TriangleShape>
restShapes(const FlatMesh& flat, const Patch& patch, RestShapes from, const Validity& validity);
/// The shape of one triangle by itself.
TriangleShape
restShape(const FlatMesh& flat, int triangle, RestShapes from, const Validity& validity);

} // namespace ricci

#endif
