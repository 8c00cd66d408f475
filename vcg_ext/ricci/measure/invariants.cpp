// SPDX-License-Identifier: GPL-3.0-or-later
#include "invariants.h"

#include "../base/numbers.h"
#include "../base/points.h"
#include "../base/task.h"
#include "../base/tolerances.h"
#include "../cones/seamless_metric.h"
#include "../error.h"
#include "../metric/area.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace ricci {

std::complex<double> reduceToFundamentalDomain(std::complex<double> tau)
{
	if (tau.imag() < 0.0)
		tau = std::conj(tau);
	for (int step = 0; step < 1000; ++step) {
		tau -= std::round(tau.real());
		if (std::norm(tau) >= 1.0 - kCancelled)
			break;
		tau = -1.0 / tau;
	}
	const bool onSide = tau.real() <= -0.5 + kCancelled;
	const bool onArc = std::norm(tau) <= 1.0 + kCancelled && tau.real() < 0.0;
	if (onSide)
		tau += 1.0;
	else if (onArc)
		tau = -1.0 / tau;
	return tau;
}

namespace {

/// Translation (in the plane of the layout) between the two sides of cut edge \p e: from the side
/// of its halfedge to that of the twin. Meaningful where the metric's holonomy is a translation.
std::complex<double> period(const Triangulation& t, const PlanarLayout& layout, Edge e)
{
	const Halfedge h = e.halfedge(), g = h.twin();
	return 0.5 * (asComplex(layout[t.next(g)]) - asComplex(layout[h]) + asComplex(layout[g]) -
				  asComplex(layout[t.next(h)]));
}

/// Conformal modulus of a flat torus: the quotient of two periods that span its lattice, reduced.
/// \pre \p cut has two generators
std::complex<double>
torusModulus(const Triangulation& t, const PlanarLayout& layout, const CutGraph& cut)
{
	const std::complex<double> a = period(t, layout, cut.generators[0]);
	const std::complex<double> b = period(t, layout, cut.generators[1]);
	// Either basis of the lattice may be negatively oriented; the lattice itself is oriented.
	const std::complex<double> tau = b / a;
	return reduceToFundamentalDomain(tau.imag() > 0.0 ? tau : 1.0 / tau);
}

/// Conformal modulus ln(r2/r1) / 2 pi of a flat annulus with straight boundaries, a cylinder: its
/// height over its circumference, from its \p area in the layout and the translation across the
/// cut.
/// \pre \p cut has an edge
double
annulusModulus(const Triangulation& t, const PlanarLayout& layout, const CutGraph& cut, double area)
{
	const Edge e(std::find(cut.isCut.begin(), cut.isCut.end(), 1) - cut.isCut.begin());
	return area / std::norm(period(t, layout, e));
}

/// Longer over shorter side of a surface laid out as a rectangle with these \p corners, in boundary
/// order. Opposite sides are averaged.
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

} // namespace

InvariantReport conformalInvariants(
	const EmbeddedSurface& surface,
	const PlanarLayout& layout,
	const FlowResult& flow,
	const CutGraph& cut,
	double area)
{
	InvariantReport report;
	const Triangulation& t = surface.triangulation;
	const SurfaceType& type = surface.topology.type;
	const Target& target = flow.target;
	const bool flat = target.curvature.lpNorm<Eigen::Infinity>() == 0.0;
	if (type.isTorus() && flat) {
		const std::complex<double> tau = torusModulus(t, layout, cut);
		report.torusTauRe = tau.real();
		report.torusTauIm = tau.imag();
	}
	// A large epsilon can stop the flow where the metric closes round a hole, without a seam.
	if (type.isAnnulus() && flat && !target.hasFixed() && cut.edgeCount() > 0)
		report.annulusModulus = annulusModulus(t, layout, cut, area);
	if (target.corners)
		report.rectangleAspect = rectangleAspect(t, layout, *target.corners);
	return report;
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

namespace {

/// Adds \p factor times the closed form of a loop, which is 1 on its halfedges, -1 on their twins and else 0.
void addForm(const FaceLoop& loop, int factor, HalfedgeArray<int>& form)
{
	for (const Halfedge h : loop) {
		form[h] += factor;
		form[h.twin()] -= factor;
	}
}

/// Integrals of the wedge products of the forms. On a triangle with the values a, b on one side and a',
/// b' on the next, the integral is (a b' - a' b) / 2.
Eigen::MatrixXi wedgeProducts(const Triangulation& t, const std::vector<FaceLoop>& loops)
{
	const auto n = static_cast<Eigen::Index>(loops.size());
	Eigen::MatrixXi twice = Eigen::MatrixXi::Zero(n, n);
	HalfedgeArray<int> form(t.halfedgeCount(), 0);
	for (Eigen::Index j = 0; j < n; ++j) {
		const FaceLoop& first = loops[static_cast<std::size_t>(j)];
		addForm(first, 1, form);
		for (Eigen::Index k = 0; k < n; ++k) {
			const FaceLoop& second = loops[static_cast<std::size_t>(k)];
			Halfedge entry = second.back().twin();
			for (const Halfedge h : second) {
				const Halfedge next = t.next(h);
				twice(j, k) -= form[next] + (entry == next ? form[h] : 0);
				entry = h.twin();
			}
		}
		addForm(first, -1, form);
	}
	return twice / 2;
}

/// Integer combinations of forms, in columns, whose wedge products are [[0, 1], [-1, 0]]. Two that are
/// +-1 are taken out, and the others made orthogonal to them, again and again. Such two are always
/// found: the loops cross like chords of a circle, and a skew-symmetric matrix of such crossings has no
/// principal minors but 0 and 1, so that the products stay 0 and +-1.
/// \throw InternalError unless \p wedge is such a matrix
Eigen::MatrixXd canonicalBasis(Eigen::MatrixXi wedge)
{
	const Eigen::Index n = wedge.rows(), genus = n / 2;
	Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(n, n);
	const auto swap = [&](Eigen::Index i, Eigen::Index j) {
		basis.col(i).swap(basis.col(j));
		wedge.row(i).swap(wedge.row(j));
		wedge.col(i).swap(wedge.col(j));
	};
	for (Eigen::Index i = 0; i < n; i += 2) {
		Eigen::Index j = i + 1;
		while (j < n && std::abs(wedge(i, j)) != 1)
			++j;
		if (j >= n)
			throw InternalError("The intersection form is not unimodular.");
		swap(i + 1, j);
		if (wedge(i, i + 1) < 0)
			swap(i, i + 1);
		for (Eigen::Index k = i + 2; k < n; ++k) {
			const int a = wedge(k, i + 1), b = wedge(i, k);
			basis.col(k) -= a * basis.col(i) + b * basis.col(i + 1);
			wedge.col(k) -= a * wedge.col(i) + b * wedge.col(i + 1);
			wedge.row(k) -= a * wedge.row(i) + b * wedge.row(i + 1);
		}
	}
	Eigen::MatrixXd ordered(n, n);
	for (Eigen::Index i = 0; i < genus; ++i) {
		ordered.col(i) = basis.col(2 * i);
		ordered.col(genus + i) = basis.col(2 * i + 1);
	}
	return ordered;
}

/// Inner products of the harmonic forms that are cohomologous to those of the loops; empty if the
/// Laplacian has no factor. With the forms t and the functions f that make them harmonic, they are
/// <t_j, t_k + df_k>.
Eigen::MatrixXd energies(
	const Triangulation& t, const EdgeArray<double>& weights, const std::vector<FaceLoop>& loops)
{
	checkpoint();
	const int unknowns = t.vertexCount() - 1; // the value at the first vertex is held
	VertexArray<int> row(t.vertexCount());
	for (const Vertex v : t.vertices())
		row[v] = v.number() - 1;
	SparseCholesky cholesky;
	if (!cholesky.factorize(laplacian(t, weights, row, Eigen::VectorXd::Zero(unknowns))))
		return {};
	const auto n = static_cast<Eigen::Index>(loops.size());
	Eigen::MatrixXd functions = Eigen::MatrixXd::Zero(unknowns, n);
	for (Eigen::Index k = 0; k < n; ++k)
		for (const Halfedge h : loops[static_cast<std::size_t>(k)])
			for (const Halfedge side : {h, h.twin()})
				if (const int i = row[t.origin(side)]; i >= 0)
					functions(i, k) += side == h ? weights[h.edge()] : -weights[h.edge()];
	functions = cholesky.solve(functions);
	checkpoint();
	Eigen::MatrixXd energy(n, n);
	HalfedgeArray<int> form(t.halfedgeCount(), 0);
	for (Eigen::Index i = 0; i < n; ++i) {
		const auto at = [&](Vertex v) { return row[v] >= 0 ? functions(row[v], i) : 0.0; };
		addForm(loops[static_cast<std::size_t>(i)], 1, form);
		for (Eigen::Index j = 0; j <= i; ++j) {
			double sum = 0.0;
			for (const Halfedge h : loops[static_cast<std::size_t>(j)])
				sum += weights[h.edge()] * (form[h] + at(t.target(h)) - at(t.origin(h)));
			energy(i, j) = energy(j, i) = sum;
		}
		addForm(loops[static_cast<std::size_t>(i)], -1, form);
	}
	return energy;
}

/// The period matrix from the energies in a canonical basis.
PeriodMatrix fromEnergies(const Eigen::MatrixXd& energy)
{
	const Eigen::Index n = energy.rows(), genus = n / 2;
	const Eigen::LLT<Eigen::MatrixXd> cholesky(energy);
	if (cholesky.info() != Eigen::Success)
		return {};
	// The discrete star is J^-1 E = J^-1 L L^T, and holomorphic forms v have the eigenvalues -i k: w =
	// L^T v is an eigenvector of the Hermitian matrix i L^T J^-1 L for the eigenvalue k.
	const Eigen::MatrixXd lower = cholesky.matrixL();
	Eigen::MatrixXd inverseOnLower(n, n);
	inverseOnLower << -lower.bottomRows(genus), lower.topRows(genus);
	const Eigen::MatrixXcd hermitian =
		std::complex<double>(0.0, 1.0) * (lower.transpose() * inverseOnLower);
	const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(hermitian);
	const Eigen::MatrixXcd forms =
		lower.transpose().cast<std::complex<double>>().triangularView<Eigen::Upper>().solve(
			solver.eigenvectors().rightCols(genus));
	const Eigen::MatrixXcd omega = forms.bottomRows(genus) * forms.topRows(genus).inverse();
	PeriodMatrix result;
	result.omega = siegelReduced(0.5 * (omega + omega.transpose()));
	result.error = std::max(0.0, std::log(solver.eigenvalues().maxCoeff()));
	return result;
}

/// Makes vector \p i of the lattice with the Gram matrix Im \p omega shorter by up to three others, each with
/// the factor +-1.
/// \return whether that was possible
bool shorten(Eigen::MatrixXcd& omega, Eigen::Index i)
{
	std::vector<std::pair<Eigen::Index, double>> added;
	// With up to so many terms more, from first on; change is what has been added to the square of the length.
	const std::function<bool(Eigen::Index, int, double)> add =
		[&](Eigen::Index first, int terms, double change) {
			if (change < -kCancelled * omega(i, i).imag()) {
				for (const auto& [j, factor] : added) {
					omega.row(i) += factor * omega.row(j);
					omega.col(i) += factor * omega.col(j);
				}
				return true;
			}
			for (Eigen::Index j = first; terms > 0 && j < omega.rows(); ++j)
				for (const double factor : {-1.0, 1.0}) {
					if (j == i)
						continue;
					double product = omega(i, j).imag();
					for (const auto& [k, other] : added)
						product += other * omega(k, j).imag();
					added.emplace_back(j, factor);
					if (add(j + 1, terms - 1, change + 2.0 * factor * product + omega(j, j).imag()))
						return true;
					added.pop_back();
				}
			return false;
		};
	return add(0, 3, 0.0);
}

/// Minkowski reduction of the imaginary part, by single steps. Up to g = 4 vectors none of which the
/// others make shorter with factors 0 and +-1 are reduced.
void reduceImaginaryPart(Eigen::MatrixXcd& omega)
{
	const Eigen::Index genus = omega.rows();
	for (Eigen::Index i = 0; i < genus;)
		i = shorten(omega, i) ? 0 : i + 1;
	for (Eigen::Index i = 0; i < genus; ++i) { // the shortest first
		Eigen::Index least = i;
		for (Eigen::Index j = i + 1; j < genus; ++j)
			if (omega(j, j).imag() < (1.0 - kCancelled) * omega(least, least).imag())
				least = j;
		omega.row(i).swap(omega.row(least));
		omega.col(i).swap(omega.col(least));
	}
	for (Eigen::Index i = 1; i < genus; ++i)
		if (omega(i - 1, i).imag() < 0.0) {
			omega.row(i) *= -1.0;
			omega.col(i) *= -1.0;
		}
}

} // namespace

PeriodMatrix periodMatrix(const Triangulation& t, const EdgeArray<double>& lengths)
{
	const std::vector<FaceLoop> loops = homologyLoops(t, false);
	const Eigen::MatrixXd energy = energies(t, cotangentWeights(t, lengths), loops);
	if (energy.size() == 0)
		return {};
	const Eigen::MatrixXd basis = canonicalBasis(wedgeProducts(t, loops));
	return fromEnergies(basis.transpose() * energy * basis);
}

Eigen::MatrixXcd siegelReduced(Eigen::MatrixXcd omega)
{
	if (omega.rows() == 1) {
		omega(0, 0) = reduceToFundamentalDomain(omega(0, 0));
		return omega;
	}
	for (int step = 0; step < 1000; ++step) {
		reduceImaginaryPart(omega);
		omega.real() =
			omega.real().unaryExpr([](double x) { return x - std::ceil(x - 0.5 - kCancelled); });
		const std::complex<double> corner = omega(0, 0);
		if (std::norm(corner) >= 1.0 - kCancelled)
			break;
		// a1 and b1 change places, which multiplies the imaginary part's determinant by 1 / |corner|^2.
		const Eigen::VectorXcd row = omega.row(0);
		omega -= row * row.transpose() / corner;
		omega.row(0) = row.transpose() / corner;
		omega.col(0) = row / corner;
		omega(0, 0) = -1.0 / corner;
	}
	return omega;
}

} // namespace ricci
