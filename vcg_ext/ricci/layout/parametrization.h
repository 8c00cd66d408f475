// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PARAMETRIZATION_H
#define RICCI_PARAMETRIZATION_H

#include "../base/points.h"
#include "../numerics/disk_isometry.h"
#include "../report.h"
#include "flat_mesh.h"

#include <cstddef>
#include <string>
#include <vector>

namespace ricci {

/// The deck transformations of the universal cover of a hyperbolic surface, which is the quotient
/// of the disk by them, with the conjugation in which the layout of the surface cut open sees them.
struct FuchsianGroup
{
	/// a1, b1, ..., ag, bg: a canonical basis, if asked for. With [a,b] = a b a^-1 b^-1,
	/// [a1,b1] ... [ag,bg] e1 ... en = +-1.
	std::vector<DiskIsometry> handles;

	/// e1, ..., en: one generator for each boundary loop and each cone, in the order of the
	/// relation. A geodesic boundary of length L has |trace| = 2 cosh(L / 2); a cone of angle t is
	/// a rotation, |trace| = 2 |cos(t / 2)| [Beardon 1983].
	std::vector<DiskIsometry> peripheral;

	/// The canonical relation letter by letter, a1, b1, a1^-1, b1^-1, ..., e1, ..., en, in extended
	/// precision: the last place of a double is magnified by the condition (see bestConditioned()). Empty
	/// where it was not asked for, or moves points too far (see kMaxGeneratorDistance).
	std::vector<ExtendedIsometry> relation;

	bool isCanonical() const { return !relation.empty(); }

	/// a1, b1, ..., ag, bg, e1, ..., en: the letters of the relation, each once.
	std::vector<ExtendedIsometry> generators() const
	{
		std::vector<ExtendedIsometry> result;
		const std::size_t commutators = 2 * handles.size(); // letters
		for (std::size_t i = 0; i < relation.size(); ++i)
			if (i >= commutators || i % 4 < 2)
				result.push_back(relation[i]);
		return result;
	}

	/// Side pairings of the polygon into which the cut opens the surface, each followed by its
	/// inverse: they take the fundamental domain to its neighbours. One pair for each arc of the
	/// cut.
	std::vector<DiskIsometry> sides;

	/// Largest entry of the difference of the canonical relation from +-1, in extended precision.
	/// Its generators have been moved by what the layout leaves, so that the relation holds. It multiplies
	/// large isometries, so that rounding leaves more of it where the genus is higher or the surface
	/// longer: 2^-101 of the condition (see bestConditioned()), to the order of magnitude.
	double relationError = 0.0;
};

/// One component laid out by its own metric, or a part of one.
struct Chart
{
	FuchsianGroup group; ///< hyperbolic flow
	Box2 box;            ///< what packing has given it; hyperbolic flow: the square round its disk

	/// Hyperbolic flow, a part of a disk that is divided (divideDisks()): the chart in the middle, which has
	/// the group, and what takes its disk to that of the part. -1: itself.
	int middle = -1;
	ExtendedIsometry place;

	/// Of a surface whose seams mirror each other, which cuts for packing do not (kMirroredSurcharge).
	bool isMirrored = false;
};

/// A map of the whole mesh to the plane. Vertices and faces have the numbers of the opened mesh (see
/// OpenedMesh), and triangles the order in which they are counter-clockwise, until toInputIndices() gives
/// them those of the input.
struct Parametrization
{
	/// In the plane each chart from the origin, with its smallest bounding rectangle along the axes
	/// unless turns by right angles only are kept; in the disk as the group acts; until they are packed.
	FlatMesh mesh;
	std::vector<Chart> charts; ///< [FlatMesh::chart]
	Report report;
	std::vector<std::string> notes; ///< what was done or chosen without being asked
	/// [vertex of mesh] sigma1 / sigma2: area-weighted mean over the triangles at the vertex
	std::vector<double> vertexQC;
	std::vector<double> u;               ///< [vertex of the input] Eq. 6; 0 at unused vertices
	std::vector<double> targetCurvature; ///< [vertex of the input] radians, as reached
	std::vector<int> placedCones;        ///< vertices of the input at which cones were placed
};

} // namespace ricci

#endif
