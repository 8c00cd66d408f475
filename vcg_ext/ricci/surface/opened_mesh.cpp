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
			}
		}
		m_triangles.resize(kept.size());
		m_opened.face.resize(kept.size());
		m_glued.resize(3 * kept.size());
		splitVertices();
		m_partition = partitionFaces(m_triangles, m_glued);
	}

	OpenedMesh result()
	{
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
	/// Gives every fan of glued corners a vertex of its own: the first at a vertex the vertex itself,
	/// the others copies.
	void splitVertices()
	{
		DisjointSets fans(static_cast<int>(m_glued.size())); // of corners, numbered like the sides
		for (int s = 0; s < static_cast<int>(m_glued.size()); ++s) {
			const int t = m_glued[positionOf(s)];
			if (t < s)
				continue;
			const bool sameWay = vertexAt(s) == vertexAt(t);
			fans.merge(s, sameWay ? t : nextCorner(t));
			fans.merge(nextCorner(s), sameWay ? nextCorner(t) : t);
		}
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

	/// The vertex of the input at a corner: where the side of the same number starts.
	int vertexAt(int corner) const
	{
		return m_triangles[positionOf(corner / 3)][positionOf(corner % 3)];
	}

	static int nextCorner(int corner) { return corner - corner % 3 + (corner + 1) % 3; }

	const SurfaceMesh& m_input;
	std::vector<Triangle> m_triangles; // those not degenerate, with the vertices of the input
	std::vector<int> m_glued;          // see FaceGluing
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
	opening.cutOneSidedComponents();
	opening.leaveOutFlatComponents();
	OpenedMesh opened = opening.result();
	describe(opened, mesh, notes);
	return opened;
}

} // namespace ricci
