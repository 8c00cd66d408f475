// SPDX-License-Identifier: GPL-3.0-or-later
#include "face_gluing.h"

#include "../base/numbers.h"
#include "../math/disjoint_sets.h"
#include "sides.h"

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
	Corner side;
	double angle; // of the triangle about the edge, in [-pi, pi]
};

/// Two sides that could be glued.
struct Candidate
{
	double fold; // radians
	int layers;  // how many sheets of equal triangles they are apart
	Corner a, b; // the sides

	bool operator<(const Candidate& other) const
	{
		return std::tie(fold, layers, a, b) < std::tie(other.fold, other.layers, other.a, other.b);
	}
};

/// Of length 1; as it is where it has no length.
Point3 normalized(const Point3& p)
{
	const double size = length(p);
	return size > 0.0 ? p / size : p;
}

/// The pages of an edge. Equal triangles have the same angle, bit for bit; one without area takes that
/// of the first.
std::vector<Page> pagesOf(
	const Array<Point3>& positions, const Array<Triangle>& triangles, ItemRange<const Corner> sides)
{
	const auto [a, b] = std::minmax({triangles[sides[0]], triangles[sides[0].next()]});
	const Point3 &low = positions[a], &high = positions[b];
	const Point3 axis = normalized(high - low);
	std::vector<Page> pages;
	Point3 first{0, 0, 0};
	for (const Corner side : sides) {
		const Point3 arm = normalized(positions[triangles[side.previous()]] - low);
		const Point3 away = arm - dot(arm, axis) * axis;
		if (dot(first, first) == 0.0)
			first = away;
		pages.push_back({side, std::atan2(dot(cross(first, away), axis), dot(first, away))});
	}
	return pages;
}

/// 0 where one page goes straight on in the other, pi where both lie on each other.
double foldBetween(const Page& p, const Page& q)
{
	return std::abs(kPi - std::abs(p.angle - q.angle)); // the same for the gap round the other way
}

/// [triangle] how many before it have the same vertices.
Array<int> layersOf(const Array<Triangle>& triangles, int& duplicates)
{
	struct Face
	{
		Triangle vertices;
		int number;
	};
	std::vector<Face> faces;
	faces.reserve(positionOf(triangles.size()));
	for (const int f : triangles.indices()) {
		faces.push_back({triangles[f], f});
		std::sort(faces.back().vertices.begin(), faces.back().vertices.end());
	}
	bucketSort(
		faces,
		[](const Face& f) { return f.vertices[0]; },
		[](const Face& a, const Face& b) {
			return std::tie(a.vertices, a.number) < std::tie(b.vertices, b.number);
		});
	Array<int> layer(triangles.size(), 0);
	for (std::size_t i = 1; i < faces.size(); ++i)
		if (faces[i].vertices == faces[i - 1].vertices) {
			layer[faces[i].number] = layer[faces[i - 1].number] + 1;
			++duplicates;
		}
	return layer;
}

/// Pairs the sides of edges that have more than two, given what is glued already.
class Pairing
{
public:
	Pairing(const Array<Triangle>& triangles, FaceGluing& gluing) :
			m_triangles(triangles), m_layer(layersOf(triangles, gluing.duplicateFaces)),
			m_gluing(gluing), m_orientation(triangles.size()), m_reversed(triangles.size(), 0)
	{
	}

	/// The orientation that most of each patch of glued triangles has is taken for the patch's.
	void orientPatches(const Sides& sides)
	{
		sides.forEdges([&](const auto& edge) {
			if (m_gluing.glued[edge[0]].isValid())
				m_orientation.merge(edge[0].face(), edge[1].face(), parityOf(edge[0], edge[1]));
		});
		Array<int> surplus(m_triangles.size(), 0); // of faces like the patch's first
		for (const int f : m_triangles.indices())
			surplus[m_orientation.find(f)] += m_orientation.parity(f) ? -1 : 1;
		for (const int f : m_triangles.indices()) {
			const bool firstIsRare = surplus[m_orientation.find(f)] < 0;
			m_reversed[f] = static_cast<char>(m_orientation.parity(f) ^ (firstIsRare ? 1 : 0));
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
			Corner &a = m_gluing.glued[c.a], &b = m_gluing.glued[c.b];
			if (a.isValid() || b.isValid() ||
				!m_orientation.merge(c.a.face(), c.b.face(), parityOf(c.a, c.b)))
				continue;
			a = c.b;
			b = c.a;
		}
	}

private:
	/// 1 where the triangles of two sides of an edge have opposite orders.
	char parityOf(Corner a, Corner b) const { return m_triangles[a] == m_triangles[b]; }

	void offer(const Page& p, const Page& q)
	{
		const auto [a, b] = std::minmax({p.side, q.side});
		const int f = a.face(), g = b.face();
		if (f == g || m_triangles[a.previous()] == m_triangles[b.previous()])
			return;
		if ((parityOf(a, b) ^ m_reversed[f] ^ m_reversed[g]) != 0)
			return; // of a sheet that went on there a part would have to be turned
		m_candidates.push_back({foldBetween(p, q), std::abs(m_layer[f] - m_layer[g]), a, b});
	}

	const Array<Triangle>& m_triangles;
	Array<int> m_layer;
	FaceGluing& m_gluing;
	ParitySets m_orientation; // of triangles
	Array<char> m_reversed;
	std::vector<Candidate> m_candidates;
};

} // namespace

FaceGluing glueFaces(const Array<Point3>& positions, const Array<Triangle>& triangles)
{
	FaceGluing gluing;
	gluing.glued.assign(3 * triangles.size(), Corner());
	const Sides sides(triangles.values());
	sides.forEdges([&](const auto& edge) {
		if (edge.size() == 1)
			return;
		const Corner a = edge[0], b = edge[1];
		if (edge.size() == 2 && triangles[a.previous()] != triangles[b.previous()]) {
			gluing.glued[a] = b;
			gluing.glued[b] = a;
		}
		else
			++gluing.cutEdges;
	});
	if (gluing.cutEdges == 0)
		return gluing;
	Pairing pairing(triangles, gluing);
	pairing.orientPatches(sides);
	sides.forEdges([&](const auto& edge) {
		if (edge.size() > 2)
			pairing.offer(pagesOf(positions, triangles, edge));
	});
	pairing.glue();
	return gluing;
}

} // namespace ricci
