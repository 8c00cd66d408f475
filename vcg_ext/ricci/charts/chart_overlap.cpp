// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart_overlap.h"

#include "../base/convex_hull.h"
#include "../base/task.h"
#include "../base/tolerances.h"

#include <algorithm>
#include <cstddef>
#include <unordered_set>
#include <utility>

namespace ricci {

namespace {

/// Steps for each triangle from which on hulls save more than they cost: boxes of triangles of
/// good shape meet in about ten pairs.
constexpr std::int64_t kManySteps = 64;

/// Pairs for each triangle from which on they are not listed: those of triangles of good shape in some six
/// sheets.
constexpr std::size_t kManyPairs = 16;

/// Sheets in the mean over the box of all triangles from which on it takes no search to know that there are
/// more pairs.
constexpr double kManySheets = 8.0;

/// Sides at the border for each triangle from which on all triangles are compared.
constexpr double kLongBorder = 0.125;

/// Corners of the polygon round a node.
constexpr std::size_t kMaxCorners = 8;

/// Whether a point lies deeper than so much to the left of a line through two others.
auto deeperThan(double touching)
{
	return [=](const Point2& p, const Point2& q, const Point2& r) {
		const double area = doubledArea(p, q, r);
		const double x = std::abs(q[0] - p[0]), y = std::abs(q[1] - p[1]);
		// distance(p, q) lies between max(x, y) and x + y.
		return area > touching * std::max(x, y) &&
			   (area > touching * (x + y) || area > touching * distance(p, q));
	};
}

/// Whether a side of \p a has \p b on its outer side, or no deeper inside than isDeeper(), or there is
/// no side. Both are corners of counter-clockwise convex polygons, b of a point, too.
template<class PolygonA, class PolygonB, class IsDeeper>
bool separates(const PolygonA& a, const PolygonB& b, const IsDeeper& isDeeper)
{
	for (std::size_t k = 0; k < a.size(); ++k) {
		const Point2 &p = a[k], &q = a[k + 1 < a.size() ? k + 1 : 0];
		if (std::none_of(b.begin(), b.end(), [&](const Point2& r) { return isDeeper(p, q, r); }))
			return true;
	}
	return a.empty();
}

/// Whether inner points of a counter-clockwise triangle lie on a segment, exactly.
bool crosses(const std::array<Point2, 2>& segment, const Triangle2& triangle)
{
	const auto isLeft = [](const Point2& p, const Point2& q, const Point2& r) {
		return orientation(p, q, r) > 0;
	};
	return boxAround(segment).meets(boxAround(triangle)) && !separates(segment, triangle, isLeft) &&
		   !separates(triangle, segment, isLeft);
}

/// Mean of the corners of the common part of two counter-clockwise triangles.
/// \return false if rounding leaves no common part
bool commonPoint(const Triangle2& a, const Triangle2& b, Point2& point)
{
	std::vector<Point2> part(a.begin(), a.end()), next;
	for (std::size_t k = 0; k < 3; ++k) {
		next.clear();
		for (std::size_t i = 0; i < part.size(); ++i) {
			const Point2 &x = part[i], &y = part[(i + 1) % part.size()];
			const double u = doubledArea(b[k], b[(k + 1) % 3], x);
			const double v = doubledArea(b[k], b[(k + 1) % 3], y);
			if (u >= 0.0)
				next.push_back(x);
			if ((u > 0.0 && v < 0.0) || (u < 0.0 && v > 0.0)) {
				const double t = u / (u - v);
				next.push_back({x[0] + t * (y[0] - x[0]), x[1] + t * (y[1] - x[1])});
			}
		}
		part.swap(next);
	}
	if (part.size() < 3)
		return false;
	point = {0.0, 0.0};
	for (const Point2& p : part)
		for (std::size_t k = 0; k < 2; ++k)
			point[k] += p[k] / static_cast<double>(part.size());
	return true;
}

} // namespace

BoxTree boxTreeOf(const Array<Triangle2>& triangles)
{
	std::vector<Box2> boxes;
	boxes.reserve(triangles.values().size());
	for (const Triangle2& triangle : triangles)
		boxes.push_back(boxAround(triangle));
	return BoxTree(boxes);
}

bool overlap(const Triangle2& a, const Triangle2& b, double touching)
{
	const auto isDeeper = deeperThan(touching);
	return !separates(a, b, isDeeper) && !separates(b, a, isDeeper);
}

OverlapSearch::OverlapSearch(Array<Triangle2> triangles, double touching) :
		OverlapSearch(std::move(triangles), touching, nullptr)
{
}

OverlapSearch::OverlapSearch(const FlatMesh& charts, double touching) :
		OverlapSearch(charts.corners(), touching, &charts)
{
}

/// \param charts of the triangles, or none
OverlapSearch::OverlapSearch(Array<Triangle2> triangles, double touching, const FlatMesh* charts) :
		m_plane(std::move(triangles)), m_isProper(m_plane.size()), m_tree(boxTreeOf(m_plane)),
		m_touching(touching >= 0.0 ? touching : kTiny * m_tree.extent())
{
	Box2 box;
	double area = 0.0; // that the sheets cover together
	for (const int i : m_plane.indices()) {
		const Triangle2& p = m_plane[i];
		m_isProper[i] = orientation(p) > 0;
		area += 0.5 * doubledArea(p);
		box.add(boxAround(p));
	}
	m_hasFolds = std::find(m_isProper.begin(), m_isProper.end(), 0) != m_isProper.end();
	m_isComplete = area <= kManySheets * box.width() * box.height();
	if (m_isComplete && (!charts || m_hasFolds || !growPairs(*charts)))
		listPairs();
	if (m_isComplete)
		return;
	m_pairs.clear();
	m_pairs.shrink_to_fit();
	for (int i = 0, other = -1; i < m_plane.size() && other < 0; ++i)
		if ((other = partner(i)) >= 0)
			m_pairs.push_back({std::min(i, other), std::max(i, other)});
}

/// Follows pairs from the border, without folds: a point that two triangles cover can be moved on in any
/// direction, over their neighbours, until one of its two ways ends at the border.
/// \return false if the border is so long, or so many pairs are met, deeper than touching or not, that it is
/// better to compare all
bool OverlapSearch::growPairs(const FlatMesh& chart)
{
	std::vector<Corner> border;
	for (const Corner side : chart.across.indices())
		if (!chart.joined(side).isValid())
			border.push_back(side);
	if (static_cast<double>(border.size()) > kLongBorder * m_plane.size())
		return false;
	std::unordered_set<std::int64_t> known;
	std::vector<TrianglePair> open;
	const auto add = [&](int i, int j) {
		const TrianglePair pair{std::min(i, j), std::max(i, j)};
		if (known.insert(std::int64_t(pair[0]) * m_plane.size() + pair[1]).second)
			open.push_back(pair);
	};
	const auto follow = [&](const TrianglePair& pair) {
		if (overlap(m_plane[pair[0]], m_plane[pair[1]], m_touching))
			m_pairs.push_back(pair);
		for (const auto& [i, other] : {pair, TrianglePair{pair[1], pair[0]}})
			for (const Corner side : cornersOf(i)) {
				step();
				if (const Corner across = chart.joined(side);
					across.isValid() && crosses(chart.ends(side), m_plane[other]))
					add(across.face(), other);
			}
	};
	const auto isTooMany = [&] { return known.size() > mostPairs(); };
	for (const Corner side : border)
		if (m_tree.meetsAny(
				boxAround(chart.ends(side)),
				[&](int j) {
					step();
					if (crosses(chart.ends(side), m_plane[j]))
						add(side.face(), j);
					while (!open.empty() && !isTooMany()) {
						const TrianglePair pair = open.back();
						open.pop_back();
						follow(pair);
					}
					return isTooMany();
				},
				[&](int node) {
					step();
					return isApart(chart.ends(side), node, -nothing());
				})) {
			m_pairs.clear();
			return false;
		}
	std::sort(m_pairs.begin(), m_pairs.end());
	return true;
}

std::size_t OverlapSearch::mostPairs() const
{
	return kManyPairs * m_plane.values().size();
}

void OverlapSearch::listPairs()
{
	m_tree.meetingPairs(
		[&](int i, int j) {
			step();
			Point2 common;
			const Meeting found = m_isComplete ? meeting(i, j, common) : Meeting::None;
			const TrianglePair pair{std::min(i, j), std::max(i, j)};
			if (found == Meeting::Overlap)
				m_pairs.push_back(pair);
			else if (found == Meeting::Hidden)
				m_hidden.push_back({pair, common});
			m_isComplete = m_pairs.size() <= mostPairs();
		},
		[&](int a, int b) {
			step();
			return !m_isComplete || (!m_hulls.empty() && isApart(m_hulls[a], b, nothing()));
		});
	std::sort(m_pairs.begin(), m_pairs.end());
}

/// A triangle that overlaps another one; -1: there is none.
int OverlapSearch::partner(int i) const
{
	int found = -1;
	const auto overlapsWith = [&](int j) {
		step();
		Point2 common;
		if (i == j || meeting(i, j, common) != Meeting::Overlap)
			return false;
		found = j;
		return true;
	};
	if (m_isProper[i])
		m_tree.meetsAny(boxAround(m_plane[i]), overlapsWith, [&](int node) {
			step();
			return isApart(m_plane[i], node, nothing());
		});
	return found;
}

void OverlapSearch::step() const
{
	checkpointNowAndThen(static_cast<std::size_t>(++m_steps));
	if (m_hulls.empty() && m_steps > kManySteps * m_plane.size())
		makeHulls();
}

/// Whether it is known that a convex counter-clockwise polygon lies no deeper in the triangles of a node.
template<class Polygon>
bool OverlapSearch::isApart(const Polygon& polygon, int node, double depth) const
{
	const auto isDeeper = deeperThan(depth);
	return !m_hulls.empty() && (separates(polygon, m_hulls[node], isDeeper) ||
								separates(m_hulls[node], polygon, isDeeper));
}

/// \param common takes a point of both where folds are asked
OverlapSearch::Meeting OverlapSearch::meeting(int i, int j, Point2& common) const
{
	if (!m_isProper[i] || !m_isProper[j] || !overlap(m_plane[i], m_plane[j], m_touching))
		return Meeting::None;
	if (!m_hasFolds)
		return Meeting::Overlap;
	if (!commonPoint(m_plane[i], m_plane[j], common))
		return Meeting::None;
	return cover(common, [](int) { return true; }) > 1 ? Meeting::Overlap : Meeting::Hidden;
}

Array<char> OverlapSearch::overlapping() const
{
	Array<char> isIn(m_plane.size(), 0);
	for (const TrianglePair& pair : m_pairs)
		for (const int i : pair)
			isIn[i] = 1;
	if (m_isComplete)
		return isIn;
	for (const int i : isIn.indices())
		isIn[i] = partner(i) >= 0;
	return isIn;
}

/// A convex polygon round the triangles of each node that are not flat. Two triangles overlap no deeper
/// than such polygons do: the least depth of two convex polygons is that along a side of one of them.
void OverlapSearch::makeHulls() const
{
	std::size_t joins = 0;
	using Polygon = std::vector<Point2>;
	m_hulls = m_tree.valuesOfNodes<Polygon>(
		[&](int i) {
			Polygon corners(m_plane[i].begin(), m_plane[i].end());
			const int turn = orientation(corners[0], corners[1], corners[2]);
			if (turn < 0)
				std::swap(corners[1], corners[2]);
			return turn == 0 ? Polygon() : corners;
		},
		[&](const Polygon& a, const Polygon& b) {
			checkpointNowAndThen(++joins);
			Polygon both = a;
			both.insert(both.end(), b.begin(), b.end());
			return enclosingPolygon(convexHull(std::move(both)), kMaxCorners);
		});
}

/// Triangles round \p p less the flipped ones, of those that are counted: the winding number of
/// their boundary, where p lies on no edge.
template<class IsCounted>
int OverlapSearch::cover(const Point2& p, const IsCounted& isCounted) const
{
	int sum = 0;
	const auto add = [&](int i) {
		step();
		const Triangle2& c = m_plane[i];
		const int first = isCounted(i) ? orientation(c[0], c[1], p) : 0;
		if (first != 0 && orientation(c[1], c[2], p) == first &&
			orientation(c[2], c[0], p) == first)
			sum += first;
	};
	m_tree.boxesAround(p, add, [&](int node) {
		step();
		return !m_hulls.empty() &&
			   separates(m_hulls[node], std::array<Point2, 1>{p}, deeperThan(-nothing()));
	});
	return sum;
}

std::vector<TrianglePair> OverlapSearch::uncovered(const Array<int>& part) const
{
	std::vector<TrianglePair> pairs;
	for (const auto& [pair, common] : m_hidden) {
		const int own = part[pair[0]];
		const auto isOwn = [&](int i) { return part[i] == own; };
		if (isOwn(pair[1]) && cover(common, isOwn) > 1)
			pairs.push_back(pair);
	}
	std::sort(pairs.begin(), pairs.end());
	return pairs;
}

} // namespace ricci
