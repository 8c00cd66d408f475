// SPDX-License-Identifier: GPL-3.0-or-later
#include "opened_mesh.h"

#include "../base/graphs.h"
#include "../base/tolerances.h"
#include "../error.h"
#include "sides.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace ricci {

namespace {

/// One-sided components that so many loops have not made two-sided are cut wherever they need it.
constexpr int kMaxOneSidedCuts = 64;

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
	requireLength("diagonal", mesh.diagonal.size(), mesh.triangles.size());
	requireLength("seam", mesh.seam.size(), mesh.triangles.size());
	requireLength("map", mesh.map.size(), mesh.triangles.size());
	requireLength("part", mesh.part.size(), mesh.positions.size());
	const auto vertices = static_cast<int>(mesh.positions.size());
	std::size_t damaged = 0, notFinite = 0, huge = 0;
	for (const Triangle& t : mesh.triangles)
		damaged += std::any_of(t.begin(), t.end(), [&](int v) { return v < 0 || v >= vertices; });
	requireNone(damaged, InvalidMesh::DamagedFaces);
	for (const Point3& p : mesh.positions)
		notFinite += !(std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]));
	requireNone(notFinite, InvalidMesh::NotFinite);
	for (const Point3& p : mesh.positions)
		huge += std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}) > kMaxCoordinate;
	requireNone(huge, InvalidMesh::OutOfRange);
	requireLength("lengths", mesh.lengths.size(), mesh.triangles.size());
	std::size_t wrong = 0;
	for (const std::array<double, 3>& sides : mesh.lengths) {
		const double longest = *std::max_element(sides.begin(), sides.end());
		wrong += !std::all_of(sides.begin(), sides.end(), [&](double l) {
			return l > 0.0 && l <= kMaxCoordinate && 2.0 * longest < sides[0] + sides[1] + sides[2];
		});
	}
	requireNone(wrong, InvalidMesh::NoTriangle);
}

/// Opens one mesh, step by step.
class Opening
{
public:
	explicit Opening(const SurfaceMesh& input) : m_input(input) { takeFaces(); }

	/// \throw InvalidMesh UnequalSides
	/// \pre cutEdges()
	void requireEqualSides() const
	{
		std::size_t unequal = 0;
		for (const Corner side : m_glued.indices())
			if (!m_input.lengths.empty() && m_glued[side] > side)
				unequal += lengthOf(side) != lengthOf(m_glued[side]);
		requireNone(unequal, InvalidMesh::UnequalSides);
	}

	void cutEdges(JoinSplitVertices join)
	{
		FaceGluing gluing = glueFaces(m_input.positions, m_triangles);
		const bool mayJoin = join != JoinSplitVertices::Never && m_input.lengths.empty();
		if (mayJoin && joinVertices(join, gluing))
			gluing = glueFaces(m_input.positions, m_triangles);
		m_glued = std::move(gluing.glued);
		m_opened.cutEdges = gluing.cutEdges;
		m_opened.duplicateFaces = gluing.duplicateFaces;
		do
			splitVertices();
		while (m_opened.cutEdges > 0 && !separateEdges());
	}

	/// Opens the seams that the caller wants.
	/// \pre cutEdges()
	void openSeams(double sharpAngle)
	{
		const bool opensSharp = sharpAngle < kPi;
		if (m_input.seam.empty() && m_input.map.empty() && !opensSharp)
			return;
		markHoles();
		m_across.assign(m_glued.size(), Corner());
		const auto jumps = jumpsOf(m_input.map);
		const auto mapJumps = [&](Corner a, Corner b) {
			const bool sameWay = m_triangles[a] == m_triangles[b];
			return !m_input.map.empty() &&
				   (jumps(inInput(a), inInput(sameWay ? b : b.next())) ||
					jumps(inInput(a.next()), inInput(sameWay ? b.next() : b)));
		};
		const Array<Point3> normals =
			opensSharp ? normalsOf(m_input.positions, m_triangles.values(), m_glued)
					   : Array<Point3>();
		const auto isSharp = [&](Corner side) {
			const Corner other = m_glued[side];
			if (!opensSharp || !other.isValid() || isMarked(m_input.diagonal, side) ||
				isMarked(m_input.diagonal, other))
				return false;
			const bool sameWay = m_triangles[side] == m_triangles[other];
			const Point3& n = normals[other.face()];
			return isCrease(normals[side.face()], sameWay ? -1.0 * n : n, std::cos(sharpAngle));
		};
		Sides(m_triangles.values()).forEdges([&](const auto& edge) {
			int pairs = 0; // of sides
			if (std::any_of(edge.begin(), edge.end(), [&](Corner side) {
					return isMarked(m_input.seam, side) || mapJumps(edge[0], side) || isSharp(side);
				}))
				for (const Corner side : edge)
					pairs += open(side);
			m_opened.seamEdges += pairs > 0;
			m_opened.seamLength += pairs * lengthOf(edge[0]);
		});
		splitVertices();
		lengthenLoneSeams();
	}

	void cutOneSidedComponents(OneSidedCut cut)
	{
		m_partition = partitionFaces(m_corners, m_glued);
		m_opened.oneSidedComponents = static_cast<int>(
			std::count(m_partition.isOneSided.begin(), m_partition.isOneSided.end(), 1));
		for (int cuts = 0; !m_partition.contradicted.empty(); ++cuts) {
			const bool isLast = cuts == kMaxOneSidedCuts;
			cutOneSided(
				places(), m_corners, m_partition, isLast ? OneSidedCut::Everywhere : cut, m_glued);
			do
				splitVertices();
			while (!separateEdges());
			m_partition = partitionFaces(m_corners, m_glued);
		}
	}

	/// \throw InvalidMesh TooSmall; NoArea if no component has an area
	void leaveOutFlatComponents()
	{
		const Array<char> isFlat = flatComponents();
		if (!isFlat.empty() && std::count(isFlat.begin(), isFlat.end(), 1) == 0)
			return;
		Array<int> number(m_triangles.size(), -1), kept;
		for (const int f : m_triangles.indices())
			if (isFlat[m_partition.component[f]])
				m_opened.degenerate.push_back(m_opened.face[positionOf(f)]);
			else {
				number[f] = kept.size();
				kept.push_back(f);
			}
		std::sort(m_opened.degenerate.begin(), m_opened.degenerate.end());
		if (kept.empty())
			throwNoArea();
		const auto renumbered = [&](Corner c) {
			const int face = c.isValid() ? number[c.face()] : -1;
			return face < 0 ? Corner() : Corner(face, static_cast<int>(c.index()));
		};
		const auto keep = [&](auto& values) { // [face]
			for (const int i : kept.indices())
				values[positionOf(i)] = values[positionOf(kept[i])];
			values.resize(positionOf(kept.size()));
		};
		const auto keepSides = [&](CornerArray<Corner>& sides) {
			for (const int i : kept.indices())
				for (const Corner c : cornersOf(i))
					sides[c] = renumbered(sides[Corner(kept[i], static_cast<int>(c.index()))]);
			sides.resize(3 * kept.size());
		};
		keep(m_triangles.values());
		keep(m_opened.face);
		keepSides(m_glued);
		if (!m_across.empty()) {
			keepSides(m_across);
			keep(m_opened.border);
		}
		splitVertices();
		m_partition = partitionFaces(m_triangles, m_glued);
	}

	OpenedMesh result()
	{
		if (!m_across.empty()) {
			CornerArray<Corner> glued = m_glued; // as it would be without seams
			for (const Corner side : m_across.indices())
				if (m_across[side].isValid()) {
					glued[side] = m_across[side];
					m_opened.border[positionOf(side.face())][side.index()] = OpenedMesh::OnSeam;
				}
			DisjointSetsOf<Corner> fans = fansOf(glued);
			countSplit(fans);
		}
		m_opened.mesh.positions = places();
		m_opened.mesh.triangles = std::move(m_corners.values());
		m_opened.component = FaceArray<int>(std::move(m_partition.component.values()));
		m_opened.reversed = FaceArray<char>(std::move(m_partition.reversed.values()));
		m_opened.componentCount = m_partition.componentCount();
		m_opened.mesh.absent = m_input.absent;
		for (const int f : m_opened.face) {
			if (!m_input.diagonal.empty())
				m_opened.mesh.diagonal.push_back(m_input.diagonal[positionOf(f)]);
			if (!m_input.lengths.empty())
				m_opened.mesh.lengths.push_back(m_input.lengths[positionOf(f)]);
			if (!m_input.map.empty())
				m_opened.mesh.map.push_back(m_input.map[positionOf(f)]);
		}
		return std::move(m_opened);
	}

private:
	/// Divides the faces of the input into triangles and degenerate ones.
	void takeFaces()
	{
		m_opened.degenerate.clear();
		m_opened.face.clear();
		m_triangles.clear();
		for (std::size_t f = 0; f < m_input.triangles.size(); ++f) {
			const Triangle t = m_opened.withJoined(m_input.triangles[f]);
			if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
				m_opened.degenerate.push_back(static_cast<int>(f));
			else {
				m_opened.face.push_back(static_cast<int>(f));
				m_triangles.push_back(t);
			}
		}
	}

	/// Joins split vertices, and counts what others would join. \return whether it has joined any
	bool joinVertices(JoinSplitVertices join, const FaceGluing& gluing)
	{
		const auto splitAt = [&](const std::vector<Corner>& sides, DisjointSets& vertices) {
			return findSplitVertices(m_input.positions, m_triangles, sides, m_input.part, vertices);
		};
		const bool all = join == JoinSplitVertices::Always;
		const auto [wanted, others] = sidesToJoin(m_triangles, gluing.alone, m_input.part, all);
		if (!others.empty()) {
			DisjointSets pieces(m_triangles.size());
			for (const Corner side : gluing.glued.indices())
				if (gluing.glued[side].isValid())
					pieces.merge(side.face(), gluing.glued[side].face());
			DisjointSets ignored(m_vertexCount);
			for (const auto& [a, b] : splitAt(others, ignored))
				m_opened.piecesApart += pieces.merge(a.face(), b.face());
		}
		DisjointSets vertices(m_vertexCount);
		m_opened.joinedEdges = static_cast<int>(splitAt(wanted, vertices).size());
		if (m_opened.joinedEdges == 0)
			return false;
		for (int v = 0; v < m_vertexCount; ++v)
			m_opened.joined.push_back(vertices.find(v));
		takeFaces();
		return true;
	}

	/// The fans of glued corners.
	DisjointSetsOf<Corner> fansOf(const CornerArray<Corner>& glued) const
	{
		DisjointSetsOf<Corner> fans(glued.size());
		for (const Corner s : glued.indices()) {
			const Corner t = glued[s];
			if (t < s)
				continue;
			const bool sameWay = m_triangles[s] == m_triangles[t];
			fans.merge(s, sameWay ? t : t.next());
			fans.merge(s.next(), sameWay ? t.next() : t);
		}
		return fans;
	}

	/// Gives every fan of glued corners a vertex of its own: the first at a vertex the vertex itself,
	/// the others copies.
	void splitVertices()
	{
		DisjointSetsOf<Corner> fans = fansOf(m_glued);
		m_corners = m_triangles;
		m_opened.vertex.resize(m_input.positions.size());
		std::iota(m_opened.vertex.begin(), m_opened.vertex.end(), 0);
		CornerArray<int> copy(m_glued.size(), -1); // [fan]
		Array<char> isUsed(m_vertexCount, 0);
		for (const Corner corner : m_glued.indices()) {
			const int v = m_triangles[corner];
			int& own = copy[fans.find(corner)];
			if (own < 0 && !std::exchange(isUsed[v], 1))
				own = v;
			else if (own < 0) {
				own = static_cast<int>(m_opened.vertex.size());
				m_opened.vertex.push_back(v);
			}
			m_corners[corner] = own;
		}
		countSplit(fans);
	}

	/// The vertices with several fans.
	void countSplit(DisjointSetsOf<Corner>& fans)
	{
		Array<int> count(m_vertexCount, 0);
		for (const Corner corner : m_glued.indices())
			count[m_triangles[corner]] += fans.find(corner) == corner;
		m_opened.splitVertices = static_cast<int>(
			std::count_if(count.begin(), count.end(), [](int fansHere) { return fansHere > 1; }));
	}

	/// Finds the sides of boundary loops other than the longest of each component.
	void markHoles()
	{
		const FacePartition partition = partitionFaces(m_corners, m_glued);
		DisjointSetsOf<Corner> loops = fansOf(m_glued); // of corners, joined along boundaries
		std::vector<Corner> sides;                      // of boundaries
		for (const Corner s : m_glued.indices())
			if (!m_glued[s].isValid()) {
				sides.push_back(s);
				loops.merge(s, s.next());
			}
		CornerArray<double> length(m_glued.size(), 0.0); // [loop]
		for (const Corner s : sides)
			length[loops.find(s)] += lengthOf(s);
		Array<Corner> longest(partition.componentCount());
		for (const Corner s : sides) {
			Corner& known = longest[partition.component[s.face()]];
			if (const Corner loop = loops.find(s); !known.isValid() || length[loop] > length[known])
				known = loop;
		}
		m_opened.border.assign(positionOf(m_triangles.size()), {});
		for (const Corner s : sides)
			if (loops.find(s) != longest[partition.component[s.face()]])
				m_opened.border[positionOf(s.face())][s.index()] = OpenedMesh::OnHole;
	}

	Corner inInput(Corner c) const
	{
		return {m_opened.face[positionOf(c.face())], static_cast<int>(c.index())};
	}

	bool isMarked(const SideMarks& ofInput, Corner side) const
	{
		return !ofInput.empty() && ofInput[positionOf(inInput(side).face())][side.index()] != 0;
	}

	/// Opens a side for a seam.
	/// \return whether it was glued
	bool open(Corner side)
	{
		const Corner other = m_glued[side];
		if (!other.isValid())
			return false;
		unglue(side, m_glued);
		m_across[side] = other;
		m_across[other] = side;
		return true;
	}

	/// Lets a seam whose two sides still share both their vertices go on straight ahead, by one edge.
	void lengthenLoneSeams()
	{
		struct Way
		{
			int from, to;           // vertices of the opened mesh
			Corner side = {};       // that goes on
			double straight = -2.0; // cosine of the angle by which it turns
		};
		const auto ends = [&](Corner side) -> std::pair<int, int> {
			return std::minmax(m_corners[side], m_corners[side.next()]);
		};
		Array<Way> ways;
		Array<int> wayAt(static_cast<int>(m_opened.vertex.size()), -1); // [vertex]
		for (const Corner s : m_across.indices()) {
			const Corner t = m_across[s];
			const auto [a, b] = ends(s);
			if (t < s || ends(s) != ends(t))
				continue;
			wayAt[a] = wayAt[b] = ways.size();
			ways.push_back({a, b});
		}
		if (ways.empty())
			return;
		for (const Corner s : m_glued.indices()) {
			const auto [a, b] = ends(s);
			for (const auto& [v, next] : {std::pair(a, b), std::pair(b, a)}) {
				if (m_glued[s] < s || wayAt[v] < 0)
					continue;
				Way& way = ways[wayAt[v]];
				const double straight = cosineOfTurn(way.from == v ? way.to : way.from, v, next);
				if (straight > way.straight) {
					way.straight = straight;
					way.side = s;
				}
			}
		}
		for (const Way& way : ways)
			if (way.side.isValid() && open(way.side)) {
				++m_opened.seamEdgesAdded;
				m_opened.seamLengthAdded += lengthOf(way.side);
			}
		splitVertices();
	}

	/// Of the angle between the ways from \p a to \p b and on to \p c; 0 where they have no direction.
	double cosineOfTurn(int a, int b, int c) const
	{
		const auto placeOf = [&](int v) { return at(m_opened.vertex[positionOf(v)]); };
		const Point3 p = placeOf(a), q = placeOf(b), r = placeOf(c);
		const double size = distance(p, q) * distance(q, r);
		return size > 0.0 ? dot(q - p, r - q) / size : 0.0;
	}

	/// Cuts edges that share both vertices with another edge: first both edges, and where that has been
	/// done, the next side of every triangle there but one, whose corner between its two cut sides then
	/// is a vertex of its own.
	/// \return whether there were none
	bool separateEdges()
	{
		std::vector<Corner> cut;
		Sides(m_corners.values()).forEdges([&](const auto& edge) {
			if (edge.size() == 1 || (edge.size() == 2 && m_glued[edge[0]] == edge[1]))
				return;
			const std::size_t before = cut.size();
			for (const Corner side : edge)
				if (m_glued[side].isValid())
					cut.push_back(side);
			if (cut.size() > before)
				return;
			for (int i = 1; i < edge.size(); ++i)
				cut.push_back(edge[i].next());
		});
		for (const Corner s : cut)
			unglue(s, m_glued);
		return cut.empty();
	}

	/// Where nothing has an area beside the whole, though a face has one by itself, a vertex is too far away.
	[[noreturn]] void throwNoArea() const
	{
		for (const Triangle& t : m_input.triangles) {
			const Point3 a = at(t[1]) - at(t[0]), b = at(t[2]) - at(t[0]), normal = cross(a, b);
			const double longest = std::max({length(a), length(b), length(b - a)});
			if (!(std::hypot(normal[0], normal[1], normal[2]) > kCancelled * longest * longest))
				continue;
			int farthest = t[0];
			for (const Triangle& other : m_input.triangles)
				for (const int v : other)
					if (distance(at(v), at(t[0])) > distance(at(farthest), at(t[0])))
						farthest = v;
			throw InvalidMesh(InvalidMesh::ScalesApart, 1, {farthest, -1});
		}
		throw InvalidMesh(InvalidMesh::NoArea, m_opened.degenerate.size());
	}

	/// [component] whether no triangle has an area.
	/// \throw InvalidMesh TooSmall
	Array<char> flatComponents() const
	{
		if (!m_input.lengths.empty())
			return Array<char>(m_partition.componentCount(), 0);
		// Twice the largest area of a triangle, and the longest side of all.
		Array<double> area(m_partition.componentCount(), 0.0), longest = area;
		for (const int f : m_triangles.indices()) {
			const Triangle& t = m_triangles[f];
			const Point3 &p = at(t[0]), &q = at(t[1]), &r = at(t[2]);
			const Point3 normal = cross(q - p, r - p);
			const int c = m_partition.component[f];
			area[c] = std::max(area[c], std::hypot(normal[0], normal[1], normal[2]));
			longest[c] = std::max({longest[c], distance(p, q), distance(q, r), distance(r, p)});
		}
		std::size_t tiny = 0;
		Array<char> isFlat(area.size(), 0);
		for (const int c : area.indices()) {
			isFlat[c] = !(area[c] > kCancelled * longest[c] * longest[c]);
			tiny += longest[c] > 0.0 && longest[c] < kMinComponentSize;
		}
		requireNone(tiny, InvalidMesh::TooSmall);
		return isFlat;
	}

	double lengthOf(Corner side) const
	{
		if (!m_input.lengths.empty())
			return m_input.lengths[positionOf(inInput(side).face())][side.index()];
		return distance(at(m_triangles[side]), at(m_triangles[side.next()]));
	}

	const Point3& at(int v) const { return m_input.positions[positionOf(v)]; } // of the input
	/// [vertex of the opened mesh]
	std::vector<Point3> places() const
	{
		std::vector<Point3> places;
		for (const int v : m_opened.vertex)
			places.push_back(at(v));
		return places;
	}

	const SurfaceMesh& m_input;
	const int m_vertexCount = static_cast<int>(m_input.positions.size());
	Array<Triangle> m_triangles;  // those not degenerate, with the vertices of the input
	Array<Triangle> m_corners;    // of the opened mesh
	CornerArray<Corner> m_glued;  // see FaceGluing
	CornerArray<Corner> m_across; // the side beyond a seam, or none; empty without seams
	FacePartition m_partition;
	OpenedMesh m_opened;
};

} // namespace

void requireLength(const char* array, std::size_t length, std::size_t wanted)
{
	if (length != 0 && length != wanted)
		throw InvalidMesh(array, length, wanted);
}

OpenedMesh
openMesh(const SurfaceMesh& mesh, OneSidedCut cut, JoinSplitVertices join, double sharpAngle)
{
	checkElements(mesh);
	Opening opening(mesh);
	opening.cutEdges(join);
	opening.requireEqualSides();
	opening.openSeams(sharpAngle);
	opening.cutOneSidedComponents(cut);
	opening.leaveOutFlatComponents();
	return opening.result();
}

} // namespace ricci
