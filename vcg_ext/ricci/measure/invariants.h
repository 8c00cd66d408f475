// SPDX-License-Identifier: GPL-3.0-or-later
// Conformal invariants: read off a flat metric laid out in the plane, and the period matrix of a closed surface.
#ifndef RICCI_INVARIANTS_H
#define RICCI_INVARIANTS_H

#include "../cut/cut_graph.h"
#include "../flow/ricci_flow.h"
#include "../layout/planar_layout.h"
#include "../mesh/triangulation.h"
#include "../numerics/sparse_cholesky.h"
#include "../report.h"

#include <Eigen/Core>
#include <complex>

namespace ricci {

/// Moves a quotient of two periods into the fundamental domain of the modular group [Serre 1973]:
/// Im > 0, |Re| <= 1/2, |tau| >= 1, with Re >= 0 where both signs are possible on its border.
std::complex<double> reduceToFundamentalDomain(std::complex<double> tau);

/// Largest distance of the rotation across a seam from a multiple of pi / 2, radians. The rotation is the
/// one that takes the edges of one side, from one end of the seam to the other, nearest to those of the
/// other side [Kabsch 1976].
/// \param cut of the domain's surface
double quarterTurnError(const FlowDomain& domain, const FlatMesh& map, const CutGraph& cut);

/// The modulus of a flat torus or annulus and the aspect of a rectangle, where the map is one.
/// \param layout of \p surface, open along \p cut
/// \param area of \p layout
InvariantReport conformalInvariants(
	const EmbeddedSurface& surface,
	const PlanarLayout& layout,
	const FlowResult& flow,
	const CutGraph& cut,
	double area);

/// The Riemann period matrix of a closed surface of genus g: with a homology basis a1, ..., ag, b1,
/// ..., bg in which ai meets bi once and nothing else meets, and the holomorphic differentials wj
/// whose integral along ai is 1 for i = j and else 0, the integral of wj along bi. It determines the
/// conformal structure up to the choice of the basis, which changes it by an element of Sp(2g,Z).
struct PeriodMatrix
{
	/// g x g, symmetric, with positive definite imaginary part; see siegelReduced(). Empty where the
	/// Laplacian has no factor in floating point numbers.
	Eigen::MatrixXcd omega;

	/// Bound of the distance from the period matrix of the flat triangles themselves, for its basis:
	/// of the logarithms of the eigenvalues of one energy (of the differentials, in the basis of their
	/// periods) against the other the largest, which for g = 1 is the distance in the hyperbolic
	/// plane. Rounding is not in it.
	double error = 0.0;
};

/// The period matrix of the conformal structure of flat triangles, with their cones.
///
/// The harmonic forms of least energy among the piecewise linear ones (Whitney forms on triangles,
/// cotangent weights) give a matrix E_h >= E to the energy E of the exact ones. With the intersection
/// form J, which the wedge product gives as integers, E is symplectic, E = J^T E^-1 J; so J^T E_h^-1 J
/// <= E. The period matrix is that of the geometric mean of both bounds, which is symplectic: of the
/// eigenspaces of J^-1 E_h, whose eigenvalues are +-i k where those of the Hodge star are +-i. The
/// largest ln k is the error. It falls with the square of the edges' lengths; slower near a cone of an
/// angle a > 2 pi, with their power 4 pi / a [Bobenko Mercat Schmies 2011], [Bobenko Buecking 2021].
/// Where there is no cone, as on flat tori, it is rounding alone.
///
/// \param lengths of the edges; the bound is best on the Delaunay triangulation [Rippa 1990]
/// \pre \p t is connected, closed and of genus 1 at least; its triangles have an area
PeriodMatrix periodMatrix(const Triangulation& t, const EdgeArray<double>& lengths);

/// The period matrix in another basis [Siegel 1989], [Deconinck et al. 2004]: its imaginary part is
/// reduced in the sense of Minkowski up to g = 4 (beyond that, no vector of the basis is made shorter
/// by three others), real parts are in [-1/2, 1/2], and |omega(0,0)| >= 1. For g = 1 that is the
/// fundamental domain. For larger g different matrices can be reduced and yet of one surface.
/// \pre \p omega is symmetric, with positive definite imaginary part
Eigen::MatrixXcd siegelReduced(Eigen::MatrixXcd omega);

} // namespace ricci

#endif
