// SPDX-License-Identifier: GPL-3.0-or-later
#include "face_gluing.h"

#include "../base/numbers.h"
#include "../math/bucket_sort.h"
#include "../math/parity_sets.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ricci {

namespace {

/// Edges with more sides than this pair each only with the kNearest nearest to its continuation.
constexpr std::size_t kAllPairs = 64, kNearest = 8;

/// Sides that meet at an edge with more than two.
struct Page
{
	Side side;
	double angle; // of the triangle about the edge, in [-pi, pi]
};

/// Two sides that could be glued.
struct Candidate
{
	double fold; // radians
	int layers;  // how many sheets of equal triangles they are apart
	int a, b;    // the sides

	bool operator<(const Candidate& other) const
	{
		return std::tie(fold, layers, a, b) < std::tie(other.fold, other.layers, other.a, other.b);
	}
};

Point3 difference(const Point3& p, const Point3& q)
{
	return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

double dot(const Point3& p, const Point3& q)
{
	return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

Point3 cross(const Point3& p, const Point3& q)
{
	return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

/// Of length 1; as it is where it has no length.
Point3 normalized(const Point3& p)
{
	const double length = hypotOfThree(p[0], p[1], p[2]);
	return length > 0.0 ? Point3{p[0] / length, p[1] / length, p[2] / length} : p;
}

int oppositeVertex(const std::vector<Triangle>& triangles, const Side& s)
{
	return triangles[positionOf(s.face)][positionOf((s.corner + 2) % 3)];
}

/// The pages of an edge. Equal triangles have the same angle, bit for bit; one without area takes that
/// of the first.
std::vector<Page> pagesOf(
	const std::vector<Point3>& positions,
	const std::vector<Triangle>& triangles,
	const Side* sides,
	std::size_t count)
{
	const Point3 &low = positions[positionOf(sides->low)],
				 &high = positions[positionOf(sides->high)];
	const Point3 axis = normalized(difference(high, low));
	std::vector<Page> pages;
	Point3 first{0, 0, 0};
	for (std::size_t i = 0; i < count; ++i) {
		const Point3 arm =
			normalized(difference(positions[positionOf(oppositeVertex(triangles, sides[i]))], low));
		const double along = dot(arm, axis);
		const Point3 away{
			arm[0] - along * axis[0], arm[1] - along * axis[1], arm[2] - along * axis[2]};
		if (dot(first, first) == 0.0)
			first = away;
		pages.push_back({sides[i], std::atan2(dot(cross(first, away), axis), dot(first, away))});
	}
	return pages;
}

/// 0 where one page goes straight on in the other, pi where both lie on each other.
double foldBetween(const Page& p, const Page& q)
{
	return std::abs(kPi - std::abs(p.angle - q.angle)); // the same for the gap round the other way
}

/// [triangle] how many before it have the same vertices.
std::vector<int> layersOf(const std::vector<Triangle>& triangles, int& duplicates)
{
	struct Face
	{
		Triangle vertices;
		int number;
	};
	std::vector<Face> faces;
	faces.reserve(triangles.size());
	for (const Triangle& t : triangles) {
		faces.push_back({t, static_cast<int>(faces.size())});
		std::sort(faces.back().vertices.begin(), faces.back().vertices.end());
	}
	bucketSort(
		faces,
		[](const Face& f) { return f.vertices[0]; },
		[](const Face& a, const Face& b) {
			return std::tie(a.vertices, a.number) < std::tie(b.vertices, b.number);
		});
	std::vector<int> layer(triangles.size(), 0);
	for (std::size_t i = 1; i < faces.size(); ++i)
		if (faces[i].vertices == faces[i - 1].vertices) {
			layer[positionOf(faces[i].number)] = layer[positionOf(faces[i - 1].number)] + 1;
			++duplicates;
		}
	return layer;
}

/// Pairs the sides of edges that have more than two, given what is glued already.
class Pairing
{
public:
	Pairing(const std::vector<Triangle>& triangles, FaceGluing& gluing) :
			m_triangles(triangles), m_layer(layersOf(triangles, gluing.duplicateFaces)),
			m_gluing(gluing), m_orientation(static_cast<int>(triangles.size())),
			m_reversed(triangles.size(), 0)
	{
	}

	/// The orientation that most of each patch of glued triangles has is taken for the patch's.
	void orientPatches(const std::vector<Side>& sorted)
	{
		forEachEdge(sorted, [&](const Side* s, std::size_t count) {
			if (count == 2 && m_gluing.glued[positionOf(s[0].index())] >= 0)
				m_orientation.merge(s[0].face, s[1].face, s[0].ascending == s[1].ascending);
		});
		std::vector<int> surplus(m_triangles.size(), 0); // of faces like the patch's first
		for (std::size_t f = 0; f < m_triangles.size(); ++f)
			surplus[positionOf(m_orientation.find(static_cast<int>(f)))] +=
				m_orientation.parity(static_cast<int>(f)) ? -1 : 1;
		for (std::size_t f = 0; f < m_triangles.size(); ++f) {
			const int face = static_cast<int>(f);
			const bool firstIsRare = surplus[positionOf(m_orientation.find(face))] < 0;
			m_reversed[f] = static_cast<char>(m_orientation.parity(face) ^ (firstIsRare ? 1 : 0));
		}
	}

	void offer(const std::vector<Page>& pages)
	{
		if (pages.size() <= kAllPairs) {
			for (std::size_t i = 0; i < pages.size(); ++i)
				for (std::size_t j = i + 1; j < pages.size(); ++j)
					offer(pages[i], pages[j]);
			return;
		}
		std::vector<Page> sorted = pages;
		std::stable_sort(sorted.begin(), sorted.end(), [](const Page& p, const Page& q) {
			return p.angle < q.angle;
		});
		for (const Page& p : sorted) {
			const double onward = p.angle > 0.0 ? p.angle - kPi : p.angle + kPi;
			const auto at = std::lower_bound(
				sorted.begin(), sorted.end(), onward, [](const Page& q, double angle) {
					return q.angle < angle;
				});
			const std::size_t n = sorted.size(),
							  start =
								  static_cast<std::size_t>(at - sorted.begin()) + n - kNearest / 2;
			for (std::size_t i = 0; i < kNearest; ++i)
				offer(p, sorted[(start + i) % n]);
		}
	}

	/// The best pairs first.
	void glue()
	{
		std::sort(m_candidates.begin(), m_candidates.end());
		for (const Candidate& c : m_candidates) {
			int &a = m_gluing.glued[positionOf(c.a)], &b = m_gluing.glued[positionOf(c.b)];
			if (a >= 0 || b >= 0 || !m_orientation.merge(c.a / 3, c.b / 3, parityOf(c.a, c.b)))
				continue;
			a = c.b;
			b = c.a;
		}
	}

private:
	/// 1 where the triangles of two sides of an edge have opposite orders.
	char parityOf(int a, int b) const
	{
		const auto start = [&](int side) {
			return m_triangles[positionOf(side / 3)][positionOf(side % 3)];
		};
		return start(a) == start(b);
	}

	void offer(const Page& p, const Page& q)
	{
		const Side &s = p.side, &t = q.side;
		if (s.face == t.face || oppositeVertex(m_triangles, s) == oppositeVertex(m_triangles, t))
			return;
		const int a = std::min(s.index(), t.index()), b = std::max(s.index(), t.index());
		if ((parityOf(a, b) ^ m_reversed[positionOf(s.face)] ^ m_reversed[positionOf(t.face)]) != 0)
			return; // of a sheet that went on there a part would have to be turned
		m_candidates.push_back(
			{foldBetween(p, q),
			 std::abs(m_layer[positionOf(s.face)] - m_layer[positionOf(t.face)]),
			 a,
			 b});
	}

	const std::vector<Triangle>& m_triangles;
	std::vector<int> m_layer;
	FaceGluing& m_gluing;
	ParitySets m_orientation; // of triangles
	std::vector<char> m_reversed;
	std::vector<Candidate> m_candidates;
};

} // namespace

std::vector<Side> sortedSides(const std::vector<Triangle>& triangles)
{
	std::vector<Side> sides;
	sides.reserve(3 * triangles.size());
	for (std::size_t f = 0; f < triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k) {
			const int a = triangles[f][k], b = triangles[f][(k + 1) % 3];
			sides.push_back(
				{std::min(a, b), std::max(a, b), static_cast<int>(f), static_cast<int>(k), a < b});
		}
	bucketSort(
		sides,
		[](const Side& s) { return s.low; },
		[](const Side& a, const Side& b) {
			return a.high != b.high ? a.high < b.high : a.face < b.face;
		});
	return sides;
}

FaceGluing glueFaces(const std::vector<Point3>& positions, const std::vector<Triangle>& triangles)
{
	FaceGluing gluing;
	gluing.glued.assign(3 * triangles.size(), -1);
	const std::vector<Side> sorted = sortedSides(triangles);
	forEachEdge(sorted, [&](const Side* s, std::size_t count) {
		if (count == 1)
			return;
		if (count == 2 && oppositeVertex(triangles, s[0]) != oppositeVertex(triangles, s[1])) {
			gluing.glued[positionOf(s[0].index())] = s[1].index();
			gluing.glued[positionOf(s[1].index())] = s[0].index();
		}
		else
			++gluing.cutEdges;
	});
	if (gluing.cutEdges == 0)
		return gluing;
	Pairing pairing(triangles, gluing);
	pairing.orientPatches(sorted);
	forEachEdge(sorted, [&](const Side* s, std::size_t count) {
		if (count > 2)
			pairing.offer(pagesOf(positions, triangles, s, count));
	});
	pairing.glue();
	return gluing;
}

} // namespace ricci
