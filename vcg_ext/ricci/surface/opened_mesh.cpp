// SPDX-License-Identifier: GPL-3.0-or-later
#include "opened_mesh.h"

#include "../base/tolerances.h"
#include "../error.h"
#include "../math/disjoint_sets.h"
#include "face_gluing.h"
#include "one_sided.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace ricci {

namespace {

/// One-sided components that so many loops have not made two-sided are cut wherever they need it.
constexpr int kMaxOneSidedCuts = 64;

/// "1 face was", "12 faces were".
std::string counted(std::size_t n, const std::string& one, const std::string& many)
{
	return std::to_string(n) + " " + (n == 1 ? one : many);
}

/// \throw InvalidMesh if \p count is not 0
void requireNone(std::size_t count, InvalidMesh::Problem problem)
{
	if (count > 0)
		throw InvalidMesh(problem, count);
}

void checkElements(const SurfaceMesh& mesh)
{
	if (mesh.triangles.empty()) {
		const std::size_t vertices = mesh.positions.size() - mesh.absent;
		throw InvalidMesh(vertices == 0 ? InvalidMesh::Empty : InvalidMesh::NoFaces, vertices);
	}
	std::size_t notFinite = 0, huge = 0;
	for (const Point3& p : mesh.positions)
		notFinite += !(std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]));
	requireNone(notFinite, InvalidMesh::NotFinite);
	for (const Point3& p : mesh.positions)
		huge += std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}) > kMaxCoordinate;
	requireNone(huge, InvalidMesh::OutOfRange);
}

/// Opens one mesh, step by step.
class Opening
{
public:
	explicit Opening(const SurfaceMesh& input) : m_input(input)
	{
		for (std::size_t f = 0; f < input.triangles.size(); ++f) {
			const Triangle& t = input.triangles[f];
			if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
				m_opened.degenerate.push_back(static_cast<int>(f));
			else {
				m_opened.face.push_back(static_cast<int>(f));
				m_triangles.push_back(t);
			}
		}
	}

	void cutEdges()
	{
		FaceGluing gluing = glueFaces(m_input.positions, m_triangles);
		m_glued = std::move(gluing.glued);
		m_opened.cutEdges = gluing.cutEdges;
		m_opened.duplicateFaces = gluing.duplicateFaces;
		do
			splitVertices();
		while (m_opened.cutEdges > 0 && !separateEdges());
	}

	/// Opens the seams that the caller wants.
	/// \pre cutEdges()
	void openSeams()
	{
		if (m_input.seam.empty())
			return;
		markHoles();
		m_across.assign(m_glued.size(), -1);
		forEachEdge(sortedSides(m_triangles), [&](const Side* sides, std::size_t count) {
			bool isSeam = false;
			for (std::size_t i = 0; i < count; ++i)
				isSeam =
					isSeam || m_input.seam[positionOf(m_opened.face[positionOf(sides[i].face)])]
										  [positionOf(sides[i].corner)] != 0;
			bool opens = false;
			for (std::size_t i = 0; isSeam && i < count; ++i)
				opens = open(sides[i].index()) || opens;
			m_opened.seamEdges += opens;
			m_opened.seamLength += opens ? lengthOf(sides->index()) : 0.0;
		});
		splitVertices();
		lengthenLoneSeams();
	}

	void cutOneSidedComponents()
	{
		m_partition = partitionFaces(m_opened.mesh.triangles, m_glued);
		m_opened.oneSidedComponents = static_cast<int>(
			std::count(m_partition.isOneSided.begin(), m_partition.isOneSided.end(), 1));
		for (int cuts = 0; !m_partition.contradicted.empty(); ++cuts) {
			const bool everywhere = cuts == kMaxOneSidedCuts;
			cutOneSided(
				m_opened.mesh.positions, m_opened.mesh.triangles, m_partition, everywhere, m_glued);
			do
				splitVertices();
			while (!separateEdges());
			m_partition = partitionFaces(m_opened.mesh.triangles, m_glued);
		}
	}

	/// \throw InvalidMesh TooSmall; NoArea if no component has an area
	void leaveOutFlatComponents()
	{
		const std::vector<char> isFlat = flatComponents();
		if (!isFlat.empty() && std::count(isFlat.begin(), isFlat.end(), 1) == 0)
			return;
		std::vector<int> number(m_triangles.size(), -1), kept;
		for (const Face f : m_partition.component.indices()) {
			const std::size_t i = positionOf(f);
			if (isFlat[positionOf(m_partition.component[f])])
				m_opened.degenerate.push_back(m_opened.face[i]);
			else {
				number[i] = static_cast<int>(kept.size());
				kept.push_back(f.number());
			}
		}
		std::sort(m_opened.degenerate.begin(), m_opened.degenerate.end());
		if (kept.empty())
			throw InvalidMesh(InvalidMesh::NoArea, m_opened.degenerate.size());
		for (std::size_t i = 0; i < kept.size(); ++i) {
			const std::size_t f = positionOf(kept[i]);
			m_triangles[i] = m_triangles[f];
			m_opened.face[i] = m_opened.face[f];
			for (std::size_t k = 0; k < 3; ++k) {
				const int other = m_glued[3 * f + k];
				m_glued[3 * i + k] = other < 0 ? -1 : 3 * number[positionOf(other / 3)] + other % 3;
				if (!m_across.empty()) {
					const int a = m_across[3 * f + k];
					const int face = a < 0 ? -1 : number[positionOf(a / 3)];
					m_across[3 * i + k] = face < 0 ? -1 : 3 * face + a % 3;
				}
			}
			if (!m_opened.hole.empty())
				m_opened.hole[i] = m_opened.hole[f];
		}
		m_triangles.resize(kept.size());
		m_opened.face.resize(kept.size());
		m_glued.resize(3 * kept.size());
		if (!m_across.empty()) {
			m_across.resize(m_glued.size());
			m_opened.hole.resize(kept.size());
		}
		splitVertices();
		m_partition = partitionFaces(m_triangles, m_glued);
	}

	OpenedMesh result()
	{
		if (!m_across.empty()) {
			countSplitWithoutSeams();
			m_opened.hasSeam.assign(positionOf(m_partition.componentCount), 0);
			for (std::size_t side = 0; side < m_across.size(); ++side)
				if (m_across[side] >= 0)
					m_opened.hasSeam[positionOf(m_partition.component[Face(side / 3)])] = 1;
		}
		m_opened.component = std::move(m_partition.component);
		m_opened.reversed = std::move(m_partition.reversed);
		m_opened.componentCount = m_partition.componentCount;
		m_opened.mesh.absent = m_input.absent;
		if (!m_input.diagonal.empty())
			for (const int f : m_opened.face)
				m_opened.mesh.diagonal.push_back(m_input.diagonal[positionOf(f)]);
		return std::move(m_opened);
	}

private:
	/// The fans of glued corners, which are numbered like the sides.
	DisjointSets fansOf(const std::vector<int>& glued) const
	{
		DisjointSets fans(static_cast<int>(glued.size()));
		for (int s = 0; s < static_cast<int>(glued.size()); ++s) {
			const int t = glued[positionOf(s)];
			if (t < s)
				continue;
			const bool sameWay = vertexAt(s) == vertexAt(t);
			fans.merge(s, sameWay ? t : nextCorner(t));
			fans.merge(nextCorner(s), sameWay ? nextCorner(t) : t);
		}
		return fans;
	}

	/// Gives every fan of glued corners a vertex of its own: the first at a vertex the vertex itself,
	/// the others copies.
	void splitVertices()
	{
		DisjointSets fans = fansOf(m_glued);
		m_opened.mesh.positions = m_input.positions;
		m_opened.mesh.triangles = m_triangles;
		m_opened.vertex.resize(m_input.positions.size());
		std::iota(m_opened.vertex.begin(), m_opened.vertex.end(), 0);
		std::vector<int> copy(m_glued.size(), -1);           // [fan]
		std::vector<char> uses(m_input.positions.size(), 0); // fans of each vertex: none, one, more
		for (int corner = 0; corner < static_cast<int>(m_glued.size()); ++corner) {
			const int v = vertexAt(corner);
			int& own = copy[positionOf(fans.find(corner))];
			char& used = uses[positionOf(v)];
			if (own < 0 && used == 0) {
				own = v;
				used = 1;
			}
			else if (own < 0) {
				own = static_cast<int>(m_opened.vertex.size());
				m_opened.vertex.push_back(v);
				m_opened.mesh.positions.push_back(m_input.positions[positionOf(v)]);
				used = 2;
			}
			m_opened.mesh.triangles[positionOf(corner / 3)][positionOf(corner % 3)] = own;
		}
		m_opened.splitVertices = static_cast<int>(std::count(uses.begin(), uses.end(), 2));
	}

	/// The vertices that would have copies if the seams were glued.
	void countSplitWithoutSeams()
	{
		std::vector<int> glued = m_glued;
		for (std::size_t s = 0; s < glued.size(); ++s)
			if (m_across[s] >= 0)
				glued[s] = m_across[s];
		DisjointSets fans = fansOf(glued);
		constexpr int kNone = -1, kSeveral = -2;
		std::vector<int> fanAt(m_input.positions.size(), kNone);
		m_opened.splitVertices = 0;
		for (int corner = 0; corner < static_cast<int>(glued.size()); ++corner) {
			int& known = fanAt[positionOf(vertexAt(corner))];
			const int fan = fans.find(corner);
			if (known == kNone)
				known = fan;
			else if (known >= 0 && known != fan) {
				known = kSeveral;
				++m_opened.splitVertices;
			}
		}
	}

	/// Finds the sides of boundary loops other than the longest of each component.
	void markHoles()
	{
		const FacePartition partition = partitionFaces(m_opened.mesh.triangles, m_glued);
		DisjointSets loops = fansOf(m_glued); // of corners, joined along boundaries
		std::vector<int> sides;               // of boundaries
		for (int s = 0; s < static_cast<int>(m_glued.size()); ++s)
			if (m_glued[positionOf(s)] < 0) {
				sides.push_back(s);
				loops.merge(s, nextCorner(s));
			}
		std::vector<double> length(m_glued.size(), 0.0); // [loop]
		for (const int s : sides)
			length[positionOf(loops.find(s))] += lengthOf(s);
		std::vector<int> longest(positionOf(partition.componentCount), -1);
		const auto longestBeside = [&](int side) -> int& {
			return longest[positionOf(partition.component[Face(side / 3)])];
		};
		for (const int s : sides) {
			const int loop = loops.find(s);
			int& known = longestBeside(s);
			if (known < 0 || length[positionOf(loop)] > length[positionOf(known)])
				known = loop;
		}
		m_opened.hole.assign(m_triangles.size(), {0, 0, 0});
		for (const int s : sides)
			m_opened.hole[positionOf(s / 3)][positionOf(s % 3)] = loops.find(s) != longestBeside(s);
	}

	/// Opens a side for a seam.
	/// \return whether it was glued
	bool open(int side)
	{
		const int other = m_glued[positionOf(side)];
		if (other < 0)
			return false;
		m_glued[positionOf(side)] = m_glued[positionOf(other)] = -1;
		m_across[positionOf(side)] = other;
		m_across[positionOf(other)] = side;
		return true;
	}

	/// Lets a seam whose two sides still share both their vertices go on straight ahead, by one edge.
	void lengthenLoneSeams()
	{
		struct Way
		{
			int from, to;           // vertices of the opened mesh
			int side = -1;          // that goes on
			double straight = -2.0; // cosine of the angle by which it turns
		};
		const std::vector<Triangle>& triangles = m_opened.mesh.triangles;
		const auto ends = [&](int side) -> std::pair<int, int> {
			const Triangle& t = triangles[positionOf(side / 3)];
			return std::minmax(t[positionOf(side % 3)], t[positionOf(nextCorner(side) % 3)]);
		};
		std::vector<Way> ways;
		std::vector<int> wayAt(m_opened.vertex.size(), -1); // [vertex]
		for (int s = 0; s < static_cast<int>(m_across.size()); ++s) {
			const int t = m_across[positionOf(s)];
			const auto [a, b] = ends(s);
			if (t < s || ends(s) != ends(t))
				continue;
			wayAt[positionOf(a)] = wayAt[positionOf(b)] = static_cast<int>(ways.size());
			ways.push_back({a, b});
		}
		for (int s = 0; !ways.empty() && s < static_cast<int>(m_glued.size()); ++s) {
			const auto [a, b] = ends(s);
			for (const auto& [v, next] : {std::pair(a, b), std::pair(b, a)}) {
				if (m_glued[positionOf(s)] < s || wayAt[positionOf(v)] < 0)
					continue;
				Way& way = ways[positionOf(wayAt[positionOf(v)])];
				const double straight = cosineOfTurn(way.from == v ? way.to : way.from, v, next);
				if (straight > way.straight) {
					way.straight = straight;
					way.side = s;
				}
			}
		}
		for (const Way& way : ways)
			if (way.side >= 0 && open(way.side)) {
				++m_opened.seamEdgesAdded;
				m_opened.seamLengthAdded += lengthOf(way.side);
			}
		if (!ways.empty())
			splitVertices();
	}

	/// Of the angle between the ways from \p a to \p b and on to \p c; 0 where they have no direction.
	double cosineOfTurn(int a, int b, int c) const
	{
		const std::vector<Point3>& p = m_opened.mesh.positions;
		double dot = 0.0;
		for (std::size_t k = 0; k < 3; ++k)
			dot += (p[positionOf(b)][k] - p[positionOf(a)][k]) *
				   (p[positionOf(c)][k] - p[positionOf(b)][k]);
		const double lengths = distance(p[positionOf(a)], p[positionOf(b)]) *
							   distance(p[positionOf(b)], p[positionOf(c)]);
		return lengths > 0.0 ? dot / lengths : 0.0;
	}

	/// Cuts edges that share both vertices with another edge: first both edges, and where that has been
	/// done, the next side of every triangle there but one, whose corner between its two cut sides then
	/// is a vertex of its own.
	/// \return whether there were none
	bool separateEdges()
	{
		std::vector<int> cut;
		forEachEdge(
			sortedSides(m_opened.mesh.triangles), [&](const Side* sides, std::size_t count) {
				if (count == 1 ||
					(count == 2 && m_glued[positionOf(sides[0].index())] == sides[1].index()))
					return;
				const std::size_t before = cut.size();
				for (std::size_t i = 0; i < count; ++i)
					if (m_glued[positionOf(sides[i].index())] >= 0)
						cut.push_back(sides[i].index());
				if (cut.size() > before)
					return;
				for (std::size_t i = 1; i < count; ++i)
					cut.push_back(nextCorner(sides[i].index()));
			});
		for (const int s : cut) {
			int& other = m_glued[positionOf(s)];
			if (other >= 0)
				m_glued[positionOf(other)] = -1;
			other = -1;
		}
		return cut.empty();
	}

	/// [component] whether no triangle has an area.
	/// \throw InvalidMesh TooSmall
	std::vector<char> flatComponents() const
	{
		// Twice the largest area of a triangle, and the longest side of all.
		std::vector<double> area(positionOf(m_partition.componentCount), 0.0), longest = area;
		for (const Face f : m_partition.component.indices()) {
			const Triangle& t = m_triangles[positionOf(f)];
			const Point3 &p = m_input.positions[positionOf(t[0])],
						 &q = m_input.positions[positionOf(t[1])],
						 &r = m_input.positions[positionOf(t[2])];
			double a[3], b[3];
			for (std::size_t k = 0; k < 3; ++k)
				a[k] = q[k] - p[k], b[k] = r[k] - p[k];
			const std::size_t c = positionOf(m_partition.component[f]);
			area[c] = std::max(
				area[c],
				std::hypot(
					a[1] * b[2] - a[2] * b[1],
					a[2] * b[0] - a[0] * b[2],
					a[0] * b[1] - a[1] * b[0]));
			longest[c] = std::max({longest[c], distance(p, q), distance(q, r), distance(r, p)});
		}
		std::size_t tiny = 0;
		std::vector<char> isFlat(area.size(), 0);
		for (std::size_t c = 0; c < area.size(); ++c) {
			isFlat[c] = !(area[c] > kMinComponentArea * longest[c] * longest[c]);
			tiny += longest[c] > 0.0 && longest[c] < kMinComponentSize;
		}
		requireNone(tiny, InvalidMesh::TooSmall);
		return isFlat;
	}

	double lengthOf(int side) const
	{
		return distance(
			m_input.positions[positionOf(vertexAt(side))],
			m_input.positions[positionOf(vertexAt(nextCorner(side)))]);
	}

	/// The vertex of the input at a corner: where the side of the same number starts.
	int vertexAt(int corner) const
	{
		return m_triangles[positionOf(corner / 3)][positionOf(corner % 3)];
	}

	static int nextCorner(int corner) { return corner - corner % 3 + (corner + 1) % 3; }

	const SurfaceMesh& m_input;
	std::vector<Triangle> m_triangles; // those not degenerate, with the vertices of the input
	std::vector<int> m_glued;          // see FaceGluing
	std::vector<int> m_across;         // the side beyond a seam, or -1; empty without seams
	FacePartition m_partition;
	OpenedMesh m_opened;
};

void describe(const OpenedMesh& opened, const SurfaceMesh& mesh, std::vector<std::string>& notes)
{
	std::vector<char> isUsed(mesh.positions.size(), 0);
	for (const Triangle& t : mesh.triangles)
		for (const int v : t)
			isUsed[positionOf(v)] = 1;
	const auto note = [&](std::ptrdiff_t n,
						  const std::string& one,
						  const std::string& many,
						  const std::string& rest) {
		if (n > 0)
			notes.push_back(counted(static_cast<std::size_t>(n), one, many) + rest);
	};
	const std::ptrdiff_t unused =
		std::count(isUsed.begin(), isUsed.end(), 0) - static_cast<std::ptrdiff_t>(mesh.absent);
	note(
		unused,
		"vertex belongs to no face and is",
		"vertices belong to no face and are",
		" left out.");
	note(
		std::count(opened.reversed.begin(), opened.reversed.end(), 1),
		"face was",
		"faces were",
		" oriented against the rest of the surface and counted as turned round.");
	note(
		opened.duplicateFaces,
		"face has the vertices of another and is a sheet of its",
		"faces have the vertices of another and are sheets of their",
		" own.");
	note(
		opened.cutEdges,
		"edge of more than two faces was",
		"edges of more than two faces were",
		" cut: sheets go on where they are smoothest.");
	note(opened.seamEdges, "edge is a seam", "edges are seams", ", as chosen.");
	note(
		opened.seamEdgesAdded,
		"seam of one edge alone goes on along one more",
		"seams of one edge alone go on along one more",
		": without it, nothing would come apart there.");
	note(
		opened.oneSidedComponents,
		"one-sided component was",
		"one-sided components were",
		" cut along short one-sided loops.");
	note(
		opened.splitVertices,
		"vertex has",
		"vertices have",
		" more than one fan of faces, each with a place of its own in the map.");
	note(
		static_cast<std::ptrdiff_t>(opened.degenerate.size()),
		"face has no area and is drawn as the line or the point that it is",
		"faces have no area and are drawn as the lines or the points that they are",
		".");
}

} // namespace

OpenedMesh openMesh(const SurfaceMesh& mesh, std::vector<std::string>& notes)
{
	checkElements(mesh);
	Opening opening(mesh);
	opening.cutEdges();
	opening.openSeams();
	opening.cutOneSidedComponents();
	opening.leaveOutFlatComponents();
	OpenedMesh opened = opening.result();
	describe(opened, mesh, notes);
	return opened;
}

} // namespace ricci
