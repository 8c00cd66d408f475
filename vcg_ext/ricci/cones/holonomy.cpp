// SPDX-License-Identifier: GPL-3.0-or-later
#include "holonomy.h"

#include "../base/disjoint_sets.h"
#include "../base/task.h"
#include "../numerics/double_double.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace ricci {

namespace {

/// A spanning tree of the triangles: for each but the first the halfedge of its parent by which it is
/// entered, breadth first.
FaceArray<Halfedge> treeOfFaces(const Triangulation& t)
{
	FaceArray<Halfedge> entry(t.faceCount());
	FaceArray<char> isReached(t.faceCount(), 0);
	std::vector<Face> queue{Face(0)};
	isReached[Face(0)] = 1;
	for (std::size_t i = 0; i < queue.size(); ++i) {
		checkpointNowAndThen(i);
		for (const Halfedge h : t.halfedges(queue[i])) {
			const Face other = t.face(h.twin());
			if (!other.isValid() || isReached[other])
				continue;
			isReached[other] = 1;
			entry[other] = h;
			queue.push_back(other);
		}
	}
	return entry;
}

/// The edges inside that neither the tree of the triangles crosses nor a spanning tree of the
/// vertices contains, in which each boundary loop is one node, or all of them are.
std::vector<Edge>
edgesOffTrees(const Triangulation& t, const FaceArray<Halfedge>& entry, bool joinsHoles)
{
	DisjointSetsOf<Vertex> nodes(t.vertexCount());
	Vertex hole;
	for (const Halfedge first : t.boundaryLoops()) {
		for (const Halfedge h : t.loop(first))
			nodes.merge(t.origin(h), t.target(h));
		if (joinsHoles && hole.isValid())
			nodes.merge(hole, t.origin(first));
		hole = t.origin(first);
	}
	EdgeArray<char> isCrossed(t.edgeCount(), 0);
	for (const Halfedge h : entry)
		if (h.isValid())
			isCrossed[h.edge()] = 1;
	std::vector<Edge> off;
	for (const Edge e : t.edges()) {
		checkpointNowAndThen(positionOf(e));
		if (isCrossed[e] || t.isBoundary(e))
			continue;
		const auto [i, j] = t.ends(e);
		if (!nodes.merge(i, j))
			off.push_back(e);
	}
	return off;
}

/// Leaves out what \p loop does and takes back at once.
void straighten(FaceLoop& loop)
{
	FaceLoop kept;
	for (const Halfedge h : loop)
		if (!kept.empty() && kept.back() == h.twin())
			kept.pop_back();
		else
			kept.push_back(h);
	std::size_t ends = 0;
	while (2 * ends + 1 < kept.size() && kept[ends] == kept[kept.size() - 1 - ends].twin())
		++ends;
	const auto n = static_cast<std::ptrdiff_t>(ends);
	loop.assign(kept.begin() + n, kept.end() - n);
}

} // namespace

std::vector<FaceLoop> homologyLoops(const Triangulation& t, bool roundHoles)
{
	const FaceArray<Halfedge> entry = treeOfFaces(t);
	const auto wayTo = [&](Face f) {
		std::vector<Halfedge> way;
		for (Halfedge h = entry[f]; h.isValid(); h = entry[t.face(h)])
			way.push_back(h);
		std::reverse(way.begin(), way.end());
		return way;
	};
	std::vector<FaceLoop> loops;
	for (const Edge e : edgesOffTrees(t, entry, roundHoles)) {
		const Halfedge h = e.halfedge();
		const std::vector<Halfedge> there = wayTo(t.face(h)), back = wayTo(t.face(h.twin()));
		std::size_t shared = 0;
		while (shared < std::min(there.size(), back.size()) && there[shared] == back[shared])
			++shared;
		FaceLoop loop{h};
		for (std::size_t i = back.size(); i-- > shared;)
			loop.push_back(back[i].twin());
		loop.insert(loop.end(), there.begin() + static_cast<std::ptrdiff_t>(shared), there.end());
		loops.push_back(std::move(loop));
	}
	return loops;
}

void flip(Triangulation& t, std::vector<FaceLoop>& loops, Edge e)
{
	const auto crosses = [e](Halfedge h) { return h.edge() == e; };
	std::vector<FaceLoop*> touched;
	for (FaceLoop& loop : loops) {
		const Face f = t.face(e.halfedge()), g = t.face(e.halfedge().twin());
		if (std::any_of(loop.begin(), loop.end(), [&](Halfedge h) {
				return t.face(h) == f || t.face(h) == g;
			}))
			touched.push_back(&loop);
	}
	t.flip(e);
	for (FaceLoop* loop : touched) {
		loop->erase(std::remove_if(loop->begin(), loop->end(), crosses), loop->end());
		FaceLoop through;
		for (std::size_t i = 0; i < loop->size(); ++i) {
			const Halfedge in = (*loop)[i], out = (*loop)[(i + 1) % loop->size()];
			through.push_back(in);
			if (t.face(in.twin()) != t.face(out)) {
				const Halfedge h = e.halfedge();
				through.push_back(t.face(h) == t.face(in.twin()) ? h : h.twin());
			}
		}
		straighten(through);
		*loop = std::move(through);
	}
}

HalfedgeArray<double> turnedCorners(const Triangulation& t, const FaceLoop& loop)
{
	HalfedgeArray<double> corners(t.halfedgeCount(), 0.0);
	for (std::size_t i = 0; i < loop.size(); ++i) {
		const Halfedge in = loop[i].twin(), out = loop[(i + 1) % loop.size()];
		if (out == t.next(in))
			corners[out] -= 1.0;
		else
			corners[in] += 1.0;
	}
	return corners;
}

double sumOfAngles(const HalfedgeArray<double>& weights, const HalfedgeArray<double>& angles)
{
	DoubleDouble sum;
	for (const Halfedge h : weights.indices())
		if (weights[h] != 0.0)
			sum += DoubleDouble::product(weights[h], angles[h]);
	return static_cast<double>(sum);
}

EdgeArray<double> derivativeByLengths(
	const Triangulation& t,
	const HalfedgeArray<double>& weights,
	const HalfedgeArray<double>& angles)
{
	EdgeArray<double> derivative(t.edgeCount(), 0.0);
	for (const Halfedge h : t.interiorHalfedges()) {
		const Halfedge next = t.next(h), previous = t.previous(h);
		// The angle at the origin of h grows with the side across, and falls with the other two.
		const double atNext = weights[h] / std::tan(angles[next]);
		const double atPrevious = weights[h] / std::tan(angles[previous]);
		derivative[next.edge()] += atNext + atPrevious;
		derivative[h.edge()] -= atNext;
		derivative[previous.edge()] -= atPrevious;
	}
	return derivative;
}

VertexVector holonomyByCurvature(
	const CurvatureMap& map,
	const VertexVector& u,
	FactoredHessian& hessian,
	const HalfedgeArray<double>& corners)
{
	const Triangulation& t = map.triangulation();
	const EdgeArray<double> byLength = derivativeByLengths(t, corners, map.angles());
	// Eq. 4: the square of a length changes with u_i by l^2 + g_i^2 - g_j^2.
	VertexVector byU = VertexVector::Zero(t.vertexCount());
	for (const Edge e : t.edges()) {
		if (byLength[e] == 0.0)
			continue;
		const auto [i, j] = t.ends(e);
		const double l2 = map.lengths()[e] * map.lengths()[e];
		const double difference = std::exp(2.0 * u[i]) - std::exp(2.0 * u[j]);
		byU[i] += 0.5 * byLength[e] * (1.0 + difference / l2);
		byU[j] += 0.5 * byLength[e] * (1.0 - difference / l2);
	}
	return hessian.scatter(hessian.cholesky().solve(hessian.gather(byU)));
}

} // namespace ricci
