// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay_start.h"

#include "../numbers.h"
#include "circle_packing.h"
#include "euclidean.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace ricci {

namespace {

/// Ties within this share of the terms' magnitude count as Delaunay.
constexpr double kTieTolerance = 1e-14;

/// Share of the paper's radii that is used. Circles that touch (I = 1), which the full radii always
/// produce, bound the curvature that the flow can reach: the angle at a vertex in a link of n
/// tangent edges stays below n pi however small its circle is, and tangent edges cannot be flipped.
constexpr double kRadiusShare = 0.5;

/// Radii of the ends of an edge with I < 1 are multiplied by this, and the flips start anew.
constexpr double kShrink = 0.5;

constexpr int kMostShrinks = 60;

/// The flips end by themselves; this bounds them where rounding decides.
constexpr std::int64_t kMostFlipsPerEdge = 1000;

/// A triangle whose longest side is within this of the other two together, relative to it, has no
/// shape that rounding respects.
constexpr double kDegenerate = 1e-13;

/// Nor has one whose sides differ by more than this factor: rounding moves its angles by as many
/// units of the last place.
constexpr double kNeedle = 1e6;

/// Excess of two sides over the third that a degenerate triangle is given, in its longest sides.
/// Less leaves needles whose rounding floor is above what counts as converged.
constexpr double kMargin = 1e-5;

/// Apex of the triangle on the left of h, with the origin of h at 0 and h on the x axis.
struct Apex
{
	double along, height;
};

Apex apexOf(const IntrinsicMesh& mesh, int h)
{
	const Triangulation& t = mesh.triangulation;
	const double l = mesh.lengths[at(Triangulation::edge(h))];
	const double right = mesh.lengths[at(Triangulation::edge(t.next(h)))];
	const double left = mesh.lengths[at(Triangulation::edge(t.previous(h)))];
	const double heron =
		(l + left + right) * (l + left - right) * (l + right - left) * (left + right - l);
	return {
		0.5 * ((left - right) * (left + right) / l + l), std::sqrt(std::max(0.0, heron)) / (2 * l)};
}

/// Whether e passes the weighted Delaunay test for circles of these radii (none: the plain test).
/// The radical axes of the two triangles cross the edge's perpendicular at heights whose sum is the
/// dual edge's length: Delaunay where that is not negative.
bool isDelaunay(const IntrinsicMesh& mesh, const std::vector<double>& radii, int e)
{
	const Triangulation& t = mesh.triangulation;
	if (!t.isFlippable(e))
		return true;
	const double l = mesh.lengths[at(e)];
	// Foot of the perpendicular bisector (radical axis) on the edge, from the origin of 2 e.
	double gi = 0.0, gj = 0.0;
	if (!radii.empty()) {
		gi = radii[at(t.origin(2 * e))];
		gj = radii[at(t.target(2 * e))];
	}
	double sum = 0.0, magnitude = 0.0;
	for (int h : {2 * e, 2 * e + 1}) {
		const Apex apex = apexOf(mesh, h);
		const double g = radii.empty() ? 0.0 : radii[at(t.origin(t.previous(h)))];
		const double foot = 0.5 * (l + (gi - gj) * (gi + gj) / l);
		const double own = h == 2 * e ? foot : l - foot;
		const double go = h == 2 * e ? gi : gj;
		// Height of the power centre over the edge: equal powers of apex and origin.
		const double plus = apex.height * apex.height + apex.along * apex.along + go * go;
		const double minus = 2 * apex.along * own + g * g;
		if (!(apex.height > 0.0)) // all or nothing: the apex lies on the edge, or beyond its ends
			return !(plus < minus);
		sum += (plus - minus) / (2 * apex.height);
		magnitude += (plus + std::abs(minus)) / (2 * apex.height);
	}
	return sum >= -kTieTolerance * magnitude;
}

template<class Test>
void flipUntil(IntrinsicMesh& mesh, std::vector<int>& log, Test isGood)
{
	Triangulation& t = mesh.triangulation;
	std::vector<int> stack;
	std::vector<char> queued(at(t.edgeCount()), 0);
	std::int64_t flipsLeft = kMostFlipsPerEdge * t.edgeCount();
	const auto visit = [&](int e) {
		if (flipsLeft <= 0 || isGood(e))
			return;
		--flipsLeft;
		const std::array<int, 4> quad{
			t.next(2 * e), t.previous(2 * e), t.next(2 * e + 1), t.previous(2 * e + 1)};
		mesh.lengths[at(e)] = flippedLength(mesh, e);
		t.flip(e);
		log.push_back(e);
		for (int h : quad)
			if (!queued[at(Triangulation::edge(h))]) {
				queued[at(Triangulation::edge(h))] = 1;
				stack.push_back(Triangulation::edge(h));
			}
	};
	for (int e = 0; e < t.edgeCount(); ++e) {
		visit(e);
		while (!stack.empty()) {
			const int side = stack.back();
			stack.pop_back();
			queued[at(side)] = 0;
			visit(side);
		}
	}
}

} // namespace

double mollify(const Triangulation& t, std::vector<double>& lengths)
{
	double added = 0.0;
	for (int f = 0; f < t.faceCount(); ++f) {
		std::array<double, 3> l;
		for (std::size_t k = 0; k < 3; ++k)
			l[k] = lengths[at(Triangulation::edge(t.halfedges(f)[k]))];
		std::sort(l.begin(), l.end());
		const double excess = (l[0] - l[2]) + l[1];
		if (excess <= kDegenerate * l[2] || l[0] * kNeedle <= l[2])
			added = std::max(added, kMargin * l[2] - excess);
	}
	for (double& l : lengths)
		l += added;
	return added;
}

double flippedLength(const IntrinsicMesh& mesh, int e)
{
	const Apex k = apexOf(mesh, 2 * e), l = apexOf(mesh, 2 * e + 1);
	return std::hypot(k.along - (mesh.lengths[at(e)] - l.along), k.height + l.height);
}

DelaunayStart delaunayStart(IntrinsicMesh mesh, const std::vector<int>& mirror)
{
	DelaunayStart start;
	start.lengthened = mollify(mesh.triangulation, mesh.lengths);
	flipUntil(mesh, start.flips, [&](int e) { return isDelaunay(mesh, {}, e); });
	start.radii = initialRadii(mesh.triangulation, mesh.lengths);
	for (double& radius : start.radii)
		radius *= kRadiusShare;
	for (std::size_t v = 0; v < mirror.size(); ++v)
		start.radii[v] = std::min(start.radii[v], start.radii[at(mirror[v])]);
	for (std::size_t v = 0; v < mirror.size(); ++v)
		start.radii[v] = start.radii[at(mirror[v])] =
			std::min(start.radii[v], start.radii[at(mirror[v])]);

	for (int attempt = 0; attempt < kMostShrinks; ++attempt) {
		flipUntil(mesh, start.flips, [&](int e) { return isDelaunay(mesh, start.radii, e); });
		const Triangulation& t = mesh.triangulation;
		bool overlap = false;
		for (int e = 0; e < t.edgeCount(); ++e) {
			double &gi = start.radii[at(t.origin(2 * e))], &gj = start.radii[at(t.target(2 * e))];
			if (gi + gj < mesh.lengths[at(e)])
				continue;
			overlap = true;
			for (int v : {t.origin(2 * e), t.target(2 * e)}) {
				start.radii[at(v)] *= kShrink;
				if (!mirror.empty())
					start.radii[at(mirror[at(v)])] = start.radii[at(v)];
			}
		}
		if (!overlap)
			break;
	}
	start.mesh = std::move(mesh);
	return start;
}

} // namespace ricci
