// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuchsian_group.h"

#include "../error.h"
#include "../numbers.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <utility>

namespace ricci {

namespace {

/// Copies of the fundamental domain beyond this distance from 0 are smaller than a float can show.
constexpr double kFurthestTile = 12.0;

/// Two copies whose images of 0 are nearer than this (hyperbolic) are the same.
constexpr double kSameTile = 1e-3;

/// Newton steps of closeRelation(): the first removes all that is not rounding.
constexpr int kClosingSteps = 3;

/// Ways to make a word canonical that are followed at the same time.
constexpr std::size_t kFollowed = 64;

/// A generator or its inverse in a word.
struct Letter
{
	int generator;
	bool inverse;
};

using Word = std::vector<Letter>;

/// Walks round the spanning tree of the cut.
class Walk
{
public:
	Walk(
		const Triangulation& t,
		const CutGraph& cut,
		const std::vector<Transition>& transition,
		const std::vector<char>& cones) :
			m_t(t),
			m_cut(cut), m_transition(transition), m_cones(cones),
			m_generatorOf(at(t.edgeCount()), -1), m_loop(at(t.vertexCount()), -1)
	{
		for (std::size_t g = 0; g < cut.generators.size(); ++g)
			m_generatorOf[at(cut.generators[g])] = static_cast<int>(g);
		for (int first : t.boundaryLoops()) {
			int h = first;
			do {
				m_loop[at(t.origin(h))] = t.origin(first);
				h = t.next(h);
			} while (h != first);
		}
	}

	void run()
	{
		const int start = startOfWalk();
		if (start < 0)
			return; // nothing is cut, nothing is open
		m_stack.push_back({node(start), -1, -1, ExtendedIsometry(), ExtendedIsometry()});
		int h = start;
		do
			h = step(h);
		while (h != start);
		leave(m_stack.back().here);
	}

	Word word;
	std::vector<ExtendedIsometry> ends; // conjugated so that their product is the word's
	std::vector<int> endVertex;
	double closingError = 0.0;

	/// The motion of crossing halfedge h from its left.
	ExtendedIsometry across(int h) const
	{
		const ExtendedIsometry& m = m_transition[at(Triangulation::edge(h))].motion;
		return h % 2 == 0 ? m : m.inverse();
	}

private:
	/// A vertex of the cut, or boundary loop, on the way down from the root.
	struct Visit
	{
		int node;
		int parentEdge;
		int down;               ///< halfedge that turning on at the parent would cross
		ExtendedIsometry place; ///< of the sector in which the node was entered
		ExtendedIsometry here;  ///< crossings since then, turning counter-clockwise round the node
	};

	int node(int h) const
	{
		const int v = m_t.origin(h);
		return m_loop[at(v)] >= 0 ? m_loop[at(v)] : v;
	}

	int startOfWalk() const
	{
		int loop = -1; // all that is cut where the tree is one vertex
		for (int h = 0; h < m_t.halfedgeCount(); ++h) {
			const int e = Triangulation::edge(h);
			if (m_t.isOuter(h) || !(m_t.isBoundaryEdge(e) || m_cut.isCut[at(e)]))
				continue;
			if (m_t.isBoundaryEdge(e) || m_generatorOf[at(e)] < 0)
				return h;
			loop = h;
		}
		return loop;
	}

	/// From the sector on the left of h, turning counter-clockwise about its origin.
	int step(int h)
	{
		const int in = m_t.previous(h), e = Triangulation::edge(in);
		const int out = Triangulation::twin(in);
		if (m_t.isOuter(out))
			return in; // along the boundary to its next vertex
		if (!m_cut.isCut[at(e)])
			return out;
		Visit& top = m_stack.back();
		if (m_generatorOf[at(e)] >= 0) {
			word.push_back({m_generatorOf[at(e)], in % 2 != 0});
			top.here = top.here * across(in);
			return out;
		}
		// Along the edge to its other end.
		if (e == top.parentEdge) {
			leave(top.here * across(in));
			const int down = top.down;
			m_stack.pop_back();
			m_stack.back().here = m_stack.back().here * across(down);
		}
		else {
			const ExtendedIsometry place = top.place * top.here;
			m_stack.push_back({node(in), e, in, place, ExtendedIsometry()});
		}
		return in;
	}

	/// The way round the top node is complete.
	void leave(const ExtendedIsometry& round)
	{
		const Visit& top = m_stack.back();
		if (m_loop[at(top.node)] < 0 && !m_cones[at(top.node)]) {
			closingError =
				std::max(closingError, static_cast<double>(round.distanceFromIdentity()));
			return;
		}
		ends.push_back(top.place * round * top.place.inverse());
		endVertex.push_back(top.node);
	}

	const Triangulation& m_t;
	const CutGraph& m_cut;
	const std::vector<Transition>& m_transition;
	const std::vector<char>& m_cones;
	std::vector<int> m_generatorOf; // [edge]
	std::vector<int> m_loop;        // [vertex] a vertex of its boundary loop, or -1
	std::vector<Visit> m_stack;
};

/// The arcs of the cut: they end where it branches, at cones and at the boundary. All edges of an
/// arc have the same transition but for rounding.
class Arcs
{
public:
	Arcs(const Triangulation& t, const CutGraph& cut, const std::vector<char>& cones) : m_t(t)
	{
		std::vector<int> degree(at(t.vertexCount()), 0);
		for (int h = 0; h < t.halfedgeCount(); ++h)
			degree[at(t.origin(h))] += cut.isCut[at(Triangulation::edge(h))];
		const std::vector<char> boundary = t.boundaryVertices();
		const auto isNode = [&](int v) {
			return degree[at(v)] != 2 || boundary[at(v)] || cones[at(v)];
		};
		std::vector<char> seen(at(t.edgeCount()), 0);
		// From the nodes first; what is left are closed curves without one.
		for (bool fromNodes : {true, false})
			for (int h = 0; h < t.halfedgeCount(); ++h) {
				const int e = Triangulation::edge(h);
				if (!cut.isCut[at(e)] || seen[at(e)] || (fromNodes && !isNode(t.origin(h))))
					continue;
				std::vector<int> arc;
				int next = h;
				while (true) {
					seen[at(Triangulation::edge(next))] = 1;
					arc.push_back(next);
					if (isNode(t.target(next)))
						break;
					next = onward(cut, next);
					if (seen[at(Triangulation::edge(next))])
						break;
				}
				arcs.push_back(std::move(arc));
			}
	}

	std::vector<std::vector<int>> arcs; ///< halfedges, one behind the other

private:
	/// The other halfedge of the cut at the end of h.
	int onward(const CutGraph& cut, int h) const
	{
		int g = Triangulation::twin(h);
		do
			g = Triangulation::twin(m_t.previous(g));
		while (!cut.isCut[at(Triangulation::edge(g))]);
		return g;
	}

	const Triangulation& m_t;
};

/// Product of letters [from, to) of a word.
ExtendedIsometry product(
	const Word& word,
	std::size_t from,
	std::size_t to,
	const std::vector<ExtendedIsometry>& generators)
{
	ExtendedIsometry result;
	for (std::size_t i = from; i < to; ++i) {
		const ExtendedIsometry& g = generators[at(word[i].generator)];
		result = result * (word[i].inverse ? g.inverse() : g);
	}
	return result;
}

/// A word that is partly made canonical: word = [a1,b1] ... [ak,bk] times the rest, conjugated.
struct PartlyCanonical
{
	std::vector<ExtendedIsometry> handles;
	ExtendedIsometry conjugation;
	Word rest;
	long double size = 0; ///< largest displacement of a motion above

	bool operator<(const PartlyCanonical& other) const { return size < other.size; }
};

std::size_t partnerOf(const Word& word, std::size_t i)
{
	std::size_t j = 0;
	while (j == i || word[j].generator != word[i].generator)
		++j;
	return j;
}

/// Reads the rest, turned by every number of letters, as x P y Q x^-1 R y^-1 S in every way.
void appendSteps(
	const PartlyCanonical& from,
	const std::vector<ExtendedIsometry>& generators,
	std::vector<PartlyCanonical>& steps)
{
	Word turned = from.rest;
	for (std::size_t turn = 0; turn < from.rest.size(); ++turn) {
		// rest = (first letters) turned (first letters)^-1
		const ExtendedIsometry outer = from.conjugation * product(from.rest, 0, turn, generators);
		const std::size_t x2 = partnerOf(turned, 0);
		for (std::size_t y = 1; y < x2; ++y) {
			const std::size_t y2 = partnerOf(turned, y);
			if (y2 < x2)
				continue;
			const ExtendedIsometry p = product(turned, 1, y, generators);
			const ExtendedIsometry q = product(turned, y + 1, x2, generators);
			const ExtendedIsometry r = product(turned, x2 + 1, y2, generators);
			PartlyCanonical step;
			step.conjugation = outer * r * q;
			const ExtendedIsometry back = step.conjugation.inverse();
			step.handles = from.handles;
			step.handles.push_back(outer * product(turned, 0, 1, generators) * back);
			step.handles.push_back(
				step.conjugation * p * product(turned, y, y + 1, generators) * q * back);
			step.size = std::max(from.size, step.conjugation.displacement());
			for (std::size_t i = step.handles.size() - 2; i < step.handles.size(); ++i)
				step.size = std::max(step.size, step.handles[i].displacement());
			const auto append = [&](std::size_t begin, std::size_t end) {
				for (std::size_t i = begin; i < end; ++i)
					step.rest.push_back(turned[i]);
			};
			append(1, y);
			append(y2 + 1, turned.size());
			append(x2 + 1, y2);
			append(y + 1, x2);
			steps.push_back(std::move(step));
		}
		std::rotate(turned.begin(), turned.begin() + 1, turned.end());
	}
}

/// Canonical generators whose commutators multiply to the word. Products of large motions lose
/// digits, so of the many ways to read the word those with the least motions are followed.
std::vector<ExtendedIsometry>
canonical(const Word& word, const std::vector<ExtendedIsometry>& generators)
{
	std::vector<PartlyCanonical> best(1), steps;
	best.front().rest = word;
	while (!best.front().rest.empty()) {
		steps.clear();
		for (const PartlyCanonical& partly : best)
			appendSteps(partly, generators, steps);
		if (steps.empty()) // not the word of a polygon with one corner
			throw Error("The fundamental polygon is inconsistent: please report the mesh.");
		std::stable_sort(steps.begin(), steps.end());
		steps.resize(std::min(steps.size(), kFollowed));
		best = std::move(steps);
	}
	return best.front().handles;
}

using Vector3 = Eigen::Matrix<long double, 3, 1>;
using Matrix3 = Eigen::Matrix<long double, 3, 3>;

/// The Lie algebra of SU(1,1), matrices (i x0, x1 + i x2; x1 - i x2, -i x0): what a motion near +-1
/// is away from it.
Vector3 nearIdentity(const ExtendedIsometry& m)
{
	const long double sign = m.a.real() < 0 ? -1 : 1;
	return sign * Vector3(m.a.imag(), m.b.real(), m.b.imag());
}

/// x -> m x m^-1 on the Lie algebra.
Matrix3 adjoint(const ExtendedIsometry& m)
{
	Matrix3 columns;
	const ExtendedIsometry back = m.inverse();
	for (int k = 0; k < 3; ++k) {
		// Not a motion, but products of such pairs are those of the matrices they stand for.
		const ExtendedIsometry x{
			{0, k == 0 ? 1.0L : 0.0L}, {k == 1 ? 1.0L : 0.0L, k == 2 ? 1.0L : 0.0L}};
		const ExtendedIsometry image = m * x * back;
		columns.col(k) = Vector3(image.a.imag(), image.b.real(), image.b.imag());
	}
	return columns;
}

/// Moves the generators by as little as possible so that word times \p rest is +-1: the rounding of
/// the metric is larger than that of this arithmetic, and the canonical generators are long words.
void closeRelation(
	const Word& word, const ExtendedIsometry& rest, std::vector<ExtendedIsometry>& generators)
{
	for (int step = 0; step < kClosingSteps; ++step) {
		std::vector<Matrix3> derivative(generators.size(), Matrix3::Zero());
		ExtendedIsometry prefix;
		for (const Letter& letter : word) {
			const ExtendedIsometry& g = generators[at(letter.generator)];
			// g becomes exp(x) g, and its inverse g^-1 exp(-x).
			const ExtendedIsometry after = prefix * (letter.inverse ? g.inverse() : g);
			derivative[at(letter.generator)] += letter.inverse ? -adjoint(after) : adjoint(prefix);
			prefix = after;
		}
		Matrix3 normal = Matrix3::Zero();
		for (const Matrix3& d : derivative)
			normal += d * d.transpose();
		const Vector3 multiplier = -normal.ldlt().solve(nearIdentity(prefix * rest));
		for (std::size_t g = 0; g < generators.size(); ++g) {
			const Vector3 x = derivative[g].transpose() * multiplier;
			generators[g] =
				(ExtendedIsometry{{1, x[0]}, {x[1], x[2]}} * generators[g]).normalised();
		}
	}
}

} // namespace

FuchsianGroup fuchsianGroup(
	const Triangulation& t,
	const CutGraph& cut,
	const std::vector<Transition>& transition,
	const std::vector<char>& cones)
{
	FuchsianGroup group;
	std::vector<Transition> best = transition;
	const Arcs arcs(t, cut, cones);
	for (const std::vector<int>& arc : arcs.arcs) {
		const int exact = *std::min_element(arc.begin(), arc.end(), [&](int g, int h) {
			return transition[at(Triangulation::edge(g))].loss <
				   transition[at(Triangulation::edge(h))].loss;
		});
		const Transition& found = transition[at(Triangulation::edge(exact))];
		const ExtendedIsometry m = exact % 2 == 0 ? found.motion : found.motion.inverse();
		for (int h : arc)
			best[at(Triangulation::edge(h))].motion = h % 2 == 0 ? m : m.inverse();
		group.sides.push_back(rounded(m));
		group.sides.push_back(rounded(m.inverse()));
	}
	Walk walk(t, cut, best, cones);
	walk.run();
	std::vector<ExtendedIsometry> generators;
	for (int e : cut.generators)
		generators.push_back(best[at(e)].motion);
	std::vector<ExtendedIsometry> ends(walk.ends.rbegin(), walk.ends.rend());
	ExtendedIsometry rest;
	for (ExtendedIsometry& end : ends) {
		end = end.inverse();
		rest = rest * end;
	}
	group.polygonError = static_cast<double>(
		(product(walk.word, 0, walk.word.size(), generators) * rest).distanceFromIdentity());
	if (!generators.empty())
		closeRelation(walk.word, rest, generators);
	const std::vector<ExtendedIsometry> handles = canonical(walk.word, generators);
	group.endVertex.assign(walk.endVertex.rbegin(), walk.endVertex.rend());
	group.closingError = walk.closingError;

	for (std::size_t i = 0; i + 1 < handles.size(); i += 2) {
		const ExtendedIsometry &a = handles[i], &b = handles[i + 1];
		for (const ExtendedIsometry& letter : {a, b, a.inverse(), b.inverse()})
			group.relation.push_back(letter);
	}
	ExtendedIsometry word;
	for (const ExtendedIsometry& letter : group.relation)
		word = word * letter;
	group.relationError = static_cast<double>((word * rest).distanceFromIdentity());
	group.relation.insert(group.relation.end(), ends.begin(), ends.end());
	std::transform(handles.begin(), handles.end(), std::back_inserter(group.handles), rounded);
	std::transform(ends.begin(), ends.end(), std::back_inserter(group.ends), rounded);
	return group;
}

Tiling tiling(const std::vector<DiskIsometry>& sides, int rings, int most)
{
	Tiling result;
	result.motions.push_back(DiskIsometry());
	result.ring.push_back(0);
	// Images of 0 by their place on the hyperboloid, in cells as wide as the tolerance.
	const auto cell = [](const DiskIsometry& m) {
		const std::complex<double> x = 2.0 * m.a * m.b;
		return std::pair(
			static_cast<std::int64_t>(std::floor(x.real() / kSameTile)),
			static_cast<std::int64_t>(std::floor(x.imag() / kSameTile)));
	};
	std::multimap<std::pair<std::int64_t, std::int64_t>, std::size_t> cells;
	const auto isKnown = [&](const DiskIsometry& m) {
		const auto centre = cell(m);
		for (std::int64_t i = -1; i <= 1; ++i)
			for (std::int64_t j = -1; j <= 1; ++j) {
				const auto range = cells.equal_range({centre.first + i, centre.second + j});
				for (auto known = range.first; known != range.second; ++known) {
					const DiskIsometry difference = result.motions[known->second].inverse() * m;
					if (difference.distanceFromIdentity() < kSameTile)
						return true;
				}
			}
		return false;
	};
	cells.emplace(cell(result.motions[0]), 0);
	for (std::size_t next = 0; next < result.motions.size(); ++next) {
		if (result.ring[next] == rings)
			break;
		for (const DiskIsometry& side : sides) {
			const DiskIsometry m = (result.motions[next] * side).normalised();
			if (isKnown(m))
				continue;
			if (m.displacement() > kFurthestTile ||
				result.motions.size() >= static_cast<std::size_t>(most)) {
				result.complete = false;
				continue;
			}
			cells.emplace(cell(m), result.motions.size());
			result.motions.push_back(m);
			result.ring.push_back(result.ring[next] + 1);
		}
	}
	return result;
}

} // namespace ricci
