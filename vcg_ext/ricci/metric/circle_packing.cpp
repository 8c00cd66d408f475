// SPDX-License-Identifier: GPL-3.0-or-later
#include "circle_packing.h"

#include "../base/graphs.h"
#include "../base/numbers.h"
#include "../base/task.h"
#include "../base/tolerances.h"
#include "../mesh/surface_mesh.h"
#include "area.h"
#include "conformal_flip.h"
#include "geometry.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace ricci {

namespace {

/// Share of the paper's radii that is used. The full radii always make circles touch (I = 1), which
/// bounds the curvature that the flow can reach: the angle at a vertex in a link of n tangent edges
/// stays below n pi however small its circle is, and tangent edges cannot be flipped.
constexpr double kRadiusShare = 0.5;

/// Radii of the ends of an edge with I < 1 are multiplied by this, and the flips start again.
constexpr double kShrink = 0.5;

/// Of a length.
constexpr double kRounding = std::numeric_limits<double>::epsilon();

/// So many flips for each edge from which on rounding may be what keeps them from ending.
constexpr std::int64_t kManyFlips = 100;

/// I - 1 on each edge, between \p lowest and \p highest.
EdgeArray<double> distancesLessOne(
	const Triangulation& t,
	const EdgeArray<double>& lengths,
	const VertexArray<double>& radii,
	double lowest,
	double highest)
{
	EdgeArray<double> delta(t.edgeCount());
	for (const Edge e : t.edges()) {
		const auto [i, j] = t.ends(e);
		delta[e] = std::clamp(Euclidean::delta(lengths[e], radii[i], radii[j]), lowest, highest);
	}
	return delta;
}

/// Apex of the triangle on the left of h, with h along the x axis from 0.
Point2 apexOver(const IntrinsicMesh& mesh, Halfedge h)
{
	const Triangulation& t = mesh.triangulation;
	return triangleApex(
		mesh.lengths[h.edge()], mesh.lengths[t.previous(h).edge()], mesh.lengths[t.next(h).edge()]);
}

/// Whether e passes the weighted Delaunay test for circles of these radii (none: the plain test).
/// The radical axes of the two triangles cross the perpendicular of the edge at heights that add up
/// to the length of the dual edge: Delaunay where that is not negative.
/// \param areRounded whether what the lengths may be off by is allowed for, too: that moves the apex by their quotient
/// with the height as much
bool isDelaunay(
	const IntrinsicMesh& mesh, const VertexArray<double>& radii, Edge e, bool areRounded)
{
	const Triangulation& t = mesh.triangulation;
	if (!t.isFlippable(e))
		return true;
	const double l = mesh.lengths[e];
	double gi = 0.0, gj = 0.0;
	if (!radii.empty()) {
		gi = radii[t.origin(e.halfedge())];
		gj = radii[t.target(e.halfedge())];
	}
	// Foot of the perpendicular bisector (radical axis) on the edge, from its first end.
	const double foot = 0.5 * (l + (gi - gj) * (gi + gj) / l);
	double sum = 0.0, error = 0.0;
	for (const Halfedge h : {e.halfedge(), e.halfedge().twin()}) {
		const auto [along, height] = apexOver(mesh, h);
		const double g = radii.empty() ? 0.0 : radii[t.apex(h)];
		const double own = h.isFirst() ? foot : l - foot; // foot and radius at the origin of h
		const double go = h.isFirst() ? gi : gj;
		// Height of the power centre over the edge: equal powers of apex and origin.
		const double plus = height * height + along * along + go * go;
		const double minus = 2 * along * own + g * g;
		if (!(height > 0.0)) // all or nothing: the apex lies on the edge, or beyond its ends
			return !(plus < minus);
		const double centre = (plus - minus) / (2 * height);
		sum += centre;
		error += kManyRoundings * (plus + std::abs(minus)) / (2 * height);
		if (areRounded)
			error += kRounding * (l * l + plus) / height * (1.0 + std::abs(centre) / height);
	}
	return sum >= -error;
}

/// Length of the other diagonal of the two plane triangles at edge \p e.
/// \pre \p e is flippable
double flippedLength(const IntrinsicMesh& mesh, Edge e)
{
	const Point2 k = apexOver(mesh, e.halfedge()), l = apexOver(mesh, e.halfedge().twin());
	return std::hypot(k[0] - (mesh.lengths[e] - l[0]), k[1] + l[1]);
}

/// Flips edges until all are Delaunay for circles of these radii, and appends them to \p log.
void makeDelaunay(IntrinsicMesh& mesh, const VertexArray<double>& radii, std::vector<Edge>& log)
{
	Triangulation& t = mesh.triangulation;
	std::int64_t flips = 0;
	const auto isGood = [&](Edge e) {
		return isDelaunay(mesh, radii, e, flips > kManyFlips * t.edgeCount());
	};
	const auto flip = [&](Edge e) {
		mesh.lengths[e] = flippedLength(mesh, e);
		t.flip(e);
		log.push_back(e);
	};
	DelaunayQueue queue;
	queue.queued.assign(t.edgeCount(), 0);
	for (const Edge e : t.edges())
		queue.flipFrom(e, t, flips, isGood, flip);
}

/// Radii for the weighted Delaunay triangulation: a share of the initial ones, alike at mirror
/// images.
VertexArray<double> startRadii(const IntrinsicMesh& mesh, const VertexArray<Vertex>& mirror)
{
	VertexArray<double> radii = initialRadii(mesh.triangulation, mesh.lengths);
	for (double& radius : radii)
		radius *= kRadiusShare;
	for (const Vertex v : mirror.indices())
		radii[v] = std::min(radii[v], radii[mirror[v]]);
	for (const Vertex v : mirror.indices())
		radii[v] = radii[mirror[v]] = std::min(radii[v], radii[mirror[v]]);
	return radii;
}

/// Lowers the radii at the ends of edges whose circles touch or overlap.
/// \return whether there were any
bool shrinkOverlapping(
	const IntrinsicMesh& mesh, const VertexArray<Vertex>& mirror, VertexArray<double>& radii)
{
	const Triangulation& t = mesh.triangulation;
	bool overlap = false;
	for (const Edge e : t.edges()) {
		const auto ends = t.ends(e);
		if (!(mesh.lengths[e] > 0.0 && std::isfinite(mesh.lengths[e])))
			throw InternalError("An edge of the Delaunay triangulation has no length");
		if (radii[ends[0]] + radii[ends[1]] < mesh.lengths[e])
			continue;
		overlap = true;
		for (const Vertex v : ends) {
			radii[v] *= kShrink;
			if (!mirror.empty())
				radii[mirror[v]] = radii[v];
		}
	}
	return overlap;
}

/// Half of what the excess of a corner lacks, at its vertex, for the degenerate triangles: the largest of
/// all of them there, and of all vertices at one place. Empty where no triangle is degenerate.
VertexArray<double> missing(const Triangulation& t, const EdgeArray<double>& lengths)
{
	VertexArray<double> half;
	const auto raise = [&](Vertex v, double excess, double wanted) {
		half.resize(t.vertexCount(), 0.0);
		half[v] = std::max(half[v], 0.5 * (wanted - excess));
	};
	for (const Face f : t.faces()) {
		auto side = t.halfedges(f);
		const auto length = [&](std::size_t k) { return lengths[side[k].edge()]; };
		const auto isShorter = [&](Halfedge h, Halfedge k) {
			return lengths[h.edge()] < lengths[k.edge()];
		};
		std::sort(side.begin(), side.end(), isShorter);
		const double excess = (length(0) - length(2)) + length(1);
		// With less for needles, refinements of disks with rounded coordinates have triangles that doubles cannot hold.
		const double needed = 10.0 * kMollification * length(2);
		if (length(0) <= kMinIntrinsicHeight * length(2)) {
			// Both ends of the short side. One scale for a triangle without size: that of its place.
			raise(t.apex(side[2]), excess, needed);
			raise(t.apex(side[1]), (length(2) - length(1)) + length(0), needed);
		}
		else if (excess <= kDegenerateTriangle * length(2))
			raise(t.apex(side[2]), excess, kMollification * length(0));
	}
	if (half.empty())
		return half;
	DisjointSetsOf<Vertex> places(t.vertexCount());
	for (const Edge e : t.edges())
		if (lengths[e] == 0.0)
			places.merge(t.ends(e)[0], t.ends(e)[1]);
	for (const Vertex v : t.vertices())
		half[places.find(v)] = std::max(half[places.find(v)], half[v]);
	for (const Vertex v : t.vertices())
		half[v] = half[places.find(v)];
	return half;
}

} // namespace

VertexArray<double> initialRadii(const Triangulation& t, const EdgeArray<double>& lengths)
{
	VertexArray<double> radii(t.vertexCount(), kInfinity);
	for (const Face f : t.faces())
		for (const Halfedge h : t.halfedges(f)) {
			const double left = lengths[h.edge()];
			const double opposite = lengths[t.next(h).edge()];
			const double right = lengths[t.previous(h).edge()];
			double& radius = radii[t.origin(h)];
			radius = std::min(radius, 0.5 * (left + right - opposite));
		}
	return radii;
}

EdgeArray<double> inversiveDistancesLessOne(
	const Triangulation& t, const EdgeArray<double>& lengths, const VertexArray<double>& radii)
{
	return distancesLessOne(t, lengths, radii, 0.0, kInfinity);
}

EdgeArray<double> thurstonDistancesLessOne(
	const Triangulation& t, const EdgeArray<double>& lengths, const VertexArray<double>& radii)
{
	return distancesLessOne(t, lengths, radii, -1.0, 0.0);
}

double Lengthening::lengthOf(const Triangulation& t, Edge e, double l) const
{
	const auto [i, j] = t.ends(e);
	return atVertex.empty() ? l : l + (atVertex[i] + atVertex[j]);
}

Lengthening mollify(const Triangulation& t, EdgeArray<double>& lengths)
{
	Lengthening total;
	const EdgeArray<double> original = lengths;
	for (VertexArray<double> more = missing(t, lengths); !more.empty();
		 more = missing(t, lengths)) {
		total.atVertex.resize(t.vertexCount(), 0.0);
		bool isLonger = false;
		for (const Vertex v : t.vertices())
			total.atVertex[v] += more[v];
		for (const Edge e : t.edges()) {
			const double before = lengths[e];
			lengths[e] = total.lengthOf(t, e, original[e]);
			isLonger |= lengths[e] > before;
		}
		if (!isLonger)
			break; // lengths that are not numbers
	}
	for (const Edge e : t.edges())
		if (lengths[e] > original[e])
			total.largest = std::max(total.largest, (lengths[e] - original[e]) / lengths[e]);
	return total;
}

IntrinsicMesh
doubleOf(const Triangulation& t, const EdgeArray<double>& lengths, VertexArray<Vertex>& mirror)
{
	const int faceCount = t.faceCount();
	const VertexArray<char> boundary = t.boundaryVertices();
	int vertexCount = t.vertexCount();
	mirror.resize(vertexCount);
	for (const Vertex v : t.vertices())
		mirror[v] = boundary[v] ? v : Vertex(vertexCount++);
	mirror.resize(vertexCount);
	for (const Vertex v : t.vertices())
		mirror[mirror[v]] = v;

	// Side k of a face runs from corner k to k + 1; side 2 - k of its image mirrors it.
	HalfedgeArray<Corner> side(t.halfedgeCount());
	Array<Triangle> triangles(2 * faceCount);
	for (const Face f : t.faces()) {
		const auto h = t.halfedges(f);
		const auto v = t.vertices(f);
		for (const Corner c : cornersOf(f.number())) {
			side[h[c.index()]] = c;
			triangles[c] = v[c.index()].number();
		}
		triangles[faceCount + f.number()] = {
			mirror[v[0]].number(), mirror[v[2]].number(), mirror[v[1]].number()};
	}
	const auto image = [&](Corner c) {
		return Corner(faceCount + c.face(), 2 - static_cast<int>(c.index()));
	};
	CornerArray<Corner> glued(6 * faceCount);
	for (const Halfedge h : t.interiorHalfedges()) {
		const Corner s = side[h], across = side[h.twin()];
		glued[s] = across.isValid() ? across : image(s);
		glued[image(s)] = across.isValid() ? image(across) : s;
	}
	IntrinsicMesh d{Triangulation(vertexCount, triangles.values(), glued), {}};
	d.lengths.resize(d.triangulation.edgeCount());
	for (const Face f : t.faces()) {
		const auto h = d.triangulation.halfedges(f);
		const auto mirrored = d.triangulation.halfedges(Face(faceCount + f.number()));
		for (std::size_t k = 0; k < 3; ++k) {
			const Edge e = h[k].edge();
			d.lengths[e] = d.lengths[mirrored[2 - k].edge()] = lengths[e];
		}
	}
	return d;
}

InitialPacking delaunayPacking(IntrinsicMesh mesh, const VertexArray<Vertex>& mirror)
{
	InitialPacking packing;
	packing.isDelaunay = true;
	packing.lengthened = mollify(mesh.triangulation, mesh.lengths);
	makeDelaunay(mesh, {}, packing.flips);
	packing.radii = startRadii(mesh, mirror);
	do {
		checkpoint();
		makeDelaunay(mesh, packing.radii, packing.flips);
	} while (shrinkOverlapping(mesh, mirror, packing.radii));
	packing.delta = inversiveDistancesLessOne(mesh.triangulation, mesh.lengths, packing.radii);
	packing.mesh = std::move(mesh);
	return packing;
}

InitialPacking inputPacking(IntrinsicMesh mesh)
{
	InitialPacking packing;
	packing.radii = initialRadii(mesh.triangulation, mesh.lengths);
	packing.delta = inversiveDistancesLessOne(mesh.triangulation, mesh.lengths, packing.radii);
	packing.mesh = std::move(mesh);
	return packing;
}

} // namespace ricci
