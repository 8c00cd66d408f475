// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CHART_OVERLAP_H
#define RICCI_CHART_OVERLAP_H

#include "../base/box_tree.h"
#include "../base/indexed.h"
#include "../base/points.h"
#include "../layout/flat_mesh.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace ricci {

/// Two triangles of a chart, the lower number first.
using TrianglePair = std::array<int, 2>;

/// Parts of a chart: the triangles of each.
using Parts = std::vector<std::vector<int>>;

/// Boxes of triangles, in their order.
BoxTree boxTreeOf(const Array<Triangle2>& triangles);

/// Whether two counter-clockwise triangles cover a part of the plane twice, deeper than \p touching:
/// no side of either then has the other triangle on its outer side (separating axes of convex
/// polygons).
/// \param touching above what rounding adds to the distances of points from lines
bool overlap(const Triangle2& a, const Triangle2& b, double touching);

/// Finds pairs of triangles that cover a part of the plane twice.
///
/// These overlap() by more than kTiny. Candidates come from a tree of bounding boxes; where these
/// meet in many more pairs than there are triangles, as they do round a vertex of many long triangles,
/// convex polygons round the tree's nodes are compared, too. So neither the chart's topology nor its
/// boundary matters: holes, slits whose sides coincide, and parts that
/// touch in points or along lines are not an overlap; a cone of more than 2 pi at a boundary vertex is.
///
/// Where triangles are flipped, the fold covers points three times although the chart goes on
/// behind it. Folds are counted elsewhere (Report::flippedFaces). Here triangles that are not
/// counter-clockwise count as negative cover, and a pair is an overlap only if a point of its common
/// part is covered more than once in the sum, which is the winding number of the chart's boundary
/// about that point. A part of the chart may have lost the fold that hides an overlap.
class OverlapSearch
{
public:
	/// Compares all triangles.
	/// \param triangles in the plane; counter-clockwise where they are right
	/// \param touching depth to which triangles only touch; -1: kTiny of their extent
	explicit OverlapSearch(Array<Triangle2> triangles, double touching = -1.0);

	/// The same pairs. They are followed from the borders of the charts where these are short and no triangle
	/// is flipped: the search then depends on their length and on the number of pairs.
	explicit OverlapSearch(const FlatMesh& charts, double touching = -1.0);

	/// In increasing order.
	const std::vector<TrianglePair>& pairs() const { return m_pairs; }

	/// Whether pairs() and uncovered() are all that there are. Where many sheets lie over each other, so
	/// that pairs are many times as many as triangles, only one is listed.
	bool isComplete() const { return m_isComplete; }

	/// [triangle] whether it is in a pair, listed or not.
	Array<char> overlapping() const;

	/// Pairs of triangles of one part that only the folds of other parts hide, in increasing order.
	/// \param part [triangle]
	std::vector<TrianglePair> uncovered(const Array<int>& part) const;

	/// Pairs of boxes, of nodes and of triangles, and boxes round points, that have been looked at.
	std::int64_t steps() const { return m_steps; }

private:
	enum class Meeting { None, Hidden, Overlap };

	OverlapSearch(Array<Triangle2> triangles, double touching, const FlatMesh* charts);

	bool growPairs(const FlatMesh& chart);
	void listPairs();
	std::size_t mostPairs() const;
	int partner(int i) const;
	void step() const;
	void makeHulls() const;
	Meeting meeting(int i, int j, Point2& common) const;

	template<class Polygon>
	bool isApart(const Polygon& polygon, int node, double depth) const;

	/// Depth that polygons have in common where they are apart.
	double nothing() const { return 0.5 * m_touching; }

	template<class IsCounted>
	int cover(const Point2& p, const IsCounted& isCounted) const;

	Array<Triangle2> m_plane;
	Array<char> m_isProper; ///< [triangle] counter-clockwise
	bool m_hasFolds = false;
	BoxTree m_tree;
	double m_touching;
	mutable Array<std::vector<Point2>> m_hulls; ///< [node of the tree], or none
	mutable std::int64_t m_steps = 0;
	bool m_isComplete = true;
	std::vector<TrianglePair> m_pairs;
	std::vector<std::pair<TrianglePair, Point2>> m_hidden; ///< with a point of both
};

} // namespace ricci

#endif
