// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperbolic_layout.h"

#include "../metric/area.h"
#include "../numbers.h"
#include "layout_tree.h"

#include <array>
#include <cmath>

namespace ricci {

namespace {

constexpr long double kExtendedPi = static_cast<long double>(kPi) + kPiRest;

/// The triangle with most triangles between it and the cut or the boundary.
int deepestFace(const Triangulation& t, const std::vector<char>& isCut)
{
	std::vector<char> seen(at(t.faceCount()), 0);
	std::vector<int> queue;
	const auto enter = [&](int f) {
		if (!seen[at(f)]) {
			seen[at(f)] = 1;
			queue.push_back(f);
		}
	};
	for (int h = 0; h < t.halfedgeCount(); ++h)
		if (!t.isOuter(h) &&
			(isCut[at(Triangulation::edge(h))] || t.isBoundaryEdge(Triangulation::edge(h))))
			enter(t.face(h));
	for (std::size_t next = 0; next < queue.size(); ++next)
		for (int h : t.halfedges(queue[next]))
			if (!t.isOuter(Triangulation::twin(h)))
				enter(t.face(Triangulation::twin(h)));
	return queue.empty() ? 0 : queue.back();
}

class Layout
{
public:
	Layout(
		const Triangulation& t,
		const std::vector<double>& lengths,
		const std::vector<double>& angles,
		const std::vector<char>& isCut) :
			m_t(t),
			m_lengths(lengths), m_angles(angles), m_isCut(isCut)
	{
	}

	HyperbolicLayout from(int root)
	{
		HyperbolicLayout layout;
		layout.frame.resize(at(m_t.halfedgeCount()));
		place(layout, m_t.halfedge(root), ExtendedIsometry());
		for (int h : layoutTree(m_t, m_lengths, m_isCut, root))
			place(layout, h, turned(layout, Triangulation::twin(h)));
		return layout;
	}

	/// Moves the middle to 0. \return the triangle next to it
	int centre(HyperbolicLayout& layout) const
	{
		long double x0 = 0;
		std::complex<long double> x = 0;
		for (int f = 0; f < m_t.faceCount(); ++f) {
			const auto side = m_t.halfedges(f);
			// By the sides: what the angles are short of pi is rounding where triangles are tiny.
			const double area = hyperbolicArea({length(side[0]), length(side[1]), length(side[2])});
			for (int h : m_t.halfedges(f)) {
				const ExtendedIsometry& g = layout.frame[at(h)];
				x0 += area * (std::norm(g.a) + std::norm(g.b));
				x += 2 * static_cast<long double>(area) * g.a * g.b;
			}
		}
		const long double r = std::abs(x);
		if (!(x0 > r)) // no area at all, or beyond what the frames hold
			return 0;
		// Towards the mean's direction on the hyperboloid: z = x / (x0 + sqrt(x0^2 - |x|^2)).
		const std::complex<long double> middle = x / (x0 + std::sqrt((x0 - r) * (x0 + r)));
		const ExtendedIsometry back = ExtendedIsometry::translationTo(middle).inverse();
		int nearest = 0;
		long double least = 0;
		for (int f = 0; f < m_t.faceCount(); ++f) {
			long double spread = 0;
			for (int h : m_t.halfedges(f)) {
				ExtendedIsometry& g = layout.frame[at(h)];
				g = (back * g).normalised();
				spread += std::norm(g.b);
			}
			if (f == 0 || spread < least) {
				least = spread;
				nearest = f;
			}
		}
		return nearest;
	}

private:
	double length(int h) const { return m_lengths[at(Triangulation::edge(h))]; }

	/// The frame at h, seen from the other end of the edge.
	ExtendedIsometry turned(const HyperbolicLayout& layout, int h) const
	{
		return layout.frame[at(h)] * ExtendedIsometry::translation(length(h)) *
			   ExtendedIsometry::rotation(kExtendedPi);
	}

	void place(HyperbolicLayout& layout, int h, const ExtendedIsometry& frame)
	{
		const int second = m_t.next(h), third = m_t.previous(h);
		layout.frame[at(h)] = frame.normalised();
		layout.frame[at(second)] = (frame * ExtendedIsometry::translation(length(h)) *
									ExtendedIsometry::rotation(kExtendedPi - m_angles[at(second)]))
									   .normalised();
		// The apex from the nearer end of the base.
		layout.frame[at(third)] =
			(length(second) < length(third)
				 ? layout.frame[at(second)] * ExtendedIsometry::translation(length(second)) *
					   ExtendedIsometry::rotation(kExtendedPi - m_angles[at(third)])
				 : layout.frame[at(h)] * ExtendedIsometry::rotation(m_angles[at(h)]) *
					   ExtendedIsometry::translation(length(third)) *
					   ExtendedIsometry::rotation(kExtendedPi))
				.normalised();
	}

	const Triangulation& m_t;
	const std::vector<double>& m_lengths;
	const std::vector<double>& m_angles;
	const std::vector<char>& m_isCut;
};

} // namespace

HyperbolicLayout layOutInDisk(
	const Triangulation& t,
	const std::vector<double>& lengths,
	const std::vector<double>& angles,
	const std::vector<char>& isCut)
{
	Layout maker(t, lengths, angles, isCut);
	HyperbolicLayout layout = maker.from(deepestFace(t, isCut));
	layout = maker.from(maker.centre(layout));
	maker.centre(layout);
	return layout;
}

void offerTransition(
	const HyperbolicLayout& layout, double length, int h, int twin, Transition& transition)
{
	transition.offer(
		layout.frame[at(h)] * ExtendedIsometry::translation(length) *
			ExtendedIsometry::rotation(kExtendedPi),
		layout.frame[at(twin)]);
}

int hyperbolicOrientation(std::complex<double> p, std::complex<double> q, std::complex<double> r)
{
	// With p moved to 0 the sides at p are straight.
	const auto seenFromP = [&](std::complex<double> z) {
		return (z - p) / (1.0 - std::conj(p) * z);
	};
	const std::complex<double> x = seenFromP(q), y = seenFromP(r);
	const double cross = x.real() * y.imag() - x.imag() * y.real();
	return cross > 0.0 ? 1 : cross < 0.0 ? -1 : 0;
}

} // namespace ricci
