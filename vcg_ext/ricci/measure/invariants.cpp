// SPDX-License-Identifier: GPL-3.0-or-later
#include "invariants.h"

#include "../base/numbers.h"
#include "../base/points.h"
#include "../base/tolerances.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ricci {

std::complex<double> period(const Triangulation& t, const PlanarLayout& layout, Edge e)
{
	const Halfedge h = e.halfedge(), g = h.twin();
	return 0.5 * (asComplex(layout[t.next(g)]) - asComplex(layout[h]) + asComplex(layout[g]) -
				  asComplex(layout[t.next(h)]));
}

std::complex<double> reduceToFundamentalDomain(std::complex<double> tau)
{
	if (tau.imag() < 0.0)
		tau = std::conj(tau);
	for (int step = 0; step < 1000; ++step) {
		tau -= std::round(tau.real());
		if (std::norm(tau) >= 1.0 - kDomainBorder)
			break;
		tau = -1.0 / tau;
	}
	const bool onSide = tau.real() <= -0.5 + kDomainBorder;
	const bool onArc = std::norm(tau) <= 1.0 + kDomainBorder && tau.real() < 0.0;
	if (onSide)
		tau += 1.0;
	else if (onArc)
		tau = -1.0 / tau;
	return tau;
}

std::complex<double>
torusModulus(const Triangulation& t, const PlanarLayout& layout, const CutGraph& cut)
{
	const std::complex<double> a = period(t, layout, cut.generators[0]);
	const std::complex<double> b = period(t, layout, cut.generators[1]);
	// Either basis of the lattice may be negatively oriented; the lattice itself is oriented.
	const std::complex<double> tau = b / a;
	return reduceToFundamentalDomain(tau.imag() > 0.0 ? tau : 1.0 / tau);
}

double
annulusModulus(const Triangulation& t, const PlanarLayout& layout, const CutGraph& cut, double area)
{
	const Edge e(std::find(cut.isCut.begin(), cut.isCut.end(), 1) - cut.isCut.begin());
	return area / std::norm(period(t, layout, e));
}

double quarterTurnError(const FlowDomain& domain, const FlatMesh& map, const CutGraph& cut)
{
	const Triangulation& t = domain.surface.triangulation;
	HalfedgeArray<Corner> corner(t.halfedgeCount());
	for (const int f : map.points.indices())
		for (const Corner c : cornersOf(f))
			corner[domain.halfedges(Face(f))[c.index()]] = c;
	const auto along = [&](Halfedge h) {
		return asComplex(map.at(corner[h].next())) - asComplex(map.at(corner[h]));
	};
	double error = 0.0;
	for (const std::vector<Halfedge>& seam : seamsOf(t, cut.isCut, cut.cones)) {
		std::complex<double> sum = 0.0;
		for (const Halfedge h : seam)
			sum -= std::conj(along(h)) * along(h.twin());
		error = std::max(error, std::abs(std::remainder(std::arg(sum), 0.5 * kPi)));
	}
	return error;
}

double rectangleAspect(
	const Triangulation& t, const PlanarLayout& layout, const std::array<Vertex, 4>& corners)
{
	std::array<Point2, 4> place{};
	for (const Halfedge h : t.interiorHalfedges())
		for (std::size_t k = 0; k < 4; ++k)
			if (t.origin(h) == corners[k])
				place[k] = layout[h];
	std::array<double, 4> side{};
	for (std::size_t k = 0; k < 4; ++k)
		side[k] = distance(place[k], place[(k + 1) % 4]);
	const double a = side[0] + side[2], b = side[1] + side[3];
	return std::max(a, b) / std::min(a, b);
}

} // namespace ricci
