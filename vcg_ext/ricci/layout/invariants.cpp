// SPDX-License-Identifier: GPL-3.0-or-later
#include "invariants.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ricci {

namespace {

std::complex<double> asComplex(const Point2& p)
{
	return {p[0], p[1]};
}

/// |Re tau| this near to its bound, or |tau| this near to 1, counts as on the border.
constexpr double kBorder = 1e-12;

} // namespace

std::complex<double> period(const Triangulation& t, const PlanarLayout& layout, int e)
{
	const int h = 2 * e, g = h + 1;
	return 0.5 * (asComplex(layout.at(t.next(g))) - asComplex(layout.at(h)) +
				  asComplex(layout.at(g)) - asComplex(layout.at(t.next(h))));
}

std::complex<double> reduceToFundamentalDomain(std::complex<double> tau)
{
	if (tau.imag() < 0.0)
		tau = std::conj(tau);
	for (int step = 0; step < 1000; ++step) {
		tau -= std::round(tau.real());
		if (std::norm(tau) >= 1.0 - kBorder)
			break;
		tau = -1.0 / tau;
	}
	const bool onSide = tau.real() <= -0.5 + kBorder;
	const bool onArc = std::norm(tau) <= 1.0 + kBorder && tau.real() < 0.0;
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
	const auto e = std::find(cut.isCut.begin(), cut.isCut.end(), 1) - cut.isCut.begin();
	return area / std::norm(period(t, layout, static_cast<int>(e)));
}

} // namespace ricci
