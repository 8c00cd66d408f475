// SPDX-License-Identifier: GPL-3.0-or-later
#include "patch_energy.h"

#include "../base/numbers.h"
#include "../base/task.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ricci {

namespace {

using Complex = std::complex<double>;

/// Weight of the area against the shape.
constexpr double kAreaWeight = 0.1;

/// Least share of a triangle of the mean one's weight.
constexpr double kMinWeight = 1e-3;

/// Multiple of the identity that is added to a Hessian, as a share of its mean diagonal, and how it grows
/// until the sum can be factored.
constexpr double kShift = 1e-10, kShiftGrowth = 1e3;
constexpr int kMaxShifts = 4;

/// The energy of one triangle by a = |f_z|^2 and b = |f_zbar|^2, where d = det J = a - b and
/// |J|^2 = 2 s, s = a + b, and its derivatives.
struct Density
{
	double value, da, db, daa, dab, dbb;

	static Density of(PatchCost cost, double a, double b, double eps)
	{
		return cost == PatchCost::Untangling ? untangling(a, b, eps) : symmetricDirichlet(a, b);
	}

	static Density untangling(double a, double b, double eps)
	{
		const double d = a - b, r = std::sqrt(eps * eps + d * d);
		const double chi = d > 0.0 ? 0.5 * (d + r) : 0.5 * eps * eps / (r - d);
		const double n = 2.0 * (a + b) + kAreaWeight * (1.0 + d * d);
		// d chi / dd = chi / r.
		const double vs = 2.0 / chi, vd = (2.0 * kAreaWeight * d - n / r) / chi;
		const double vsd = -2.0 / (chi * r);
		const double vdd =
			(2.0 * kAreaWeight * (1.0 - 2.0 * d / r) + n * (d / r + 1.0) / (r * r)) / chi;
		return {n / chi, vs, vd, vsd, vdd};
	}

private:
	static Density symmetricDirichlet(double a, double b)
	{
		const double s = a + b, d = a - b, over = 1.0 / d, square = over * over;
		if (!(d > 0.0))
			return {kInfinity, 0.0, 0.0, 0.0, 0.0};
		return {
			2.0 * s * (1.0 + square),
			2.0 * (1.0 + square),
			-4.0 * s * square * over,
			-4.0 * square * over,
			12.0 * s * square * square};
	}

	/// By s and d; the energies are linear in s.
	Density(double v, double vs, double vd, double vsd, double vdd) :
			value(v), da(vs + vd), db(vs - vd), daa(vdd + 2.0 * vsd), dab(-vdd),
			dbb(vdd - 2.0 * vsd)
	{
	}
};

/// How f_z of the linear map of a triangle changes with the places of its corners; f_zbar with the conjugates.
std::array<Complex, 3> weightsOf(const TriangleShape& shape)
{
	const double b = shape.base, x = shape.apex.real(), y = shape.apex.imag();
	const Complex first(0.5 / b, 0.5 * x / (b * y)), second(0.0, -0.5 / y);
	return {-first - second, first, second};
}

/// f_z and f_zbar of the map that takes its corners to \p p.
std::array<Complex, 2> derivativesOf(const std::array<Complex, 3>& weights, const Triangle2& p)
{
	const Complex first = asComplex(p[1]) - asComplex(p[0]);
	const Complex second = asComplex(p[2]) - asComplex(p[0]);
	return {
		weights[1] * first + weights[2] * second,
		std::conj(weights[1]) * first + std::conj(weights[2]) * second};
}

/// The matrix (xx, xy; xy, yy) made positive semidefinite: xx, xy, yy.
std::array<double, 3> semidefinite(double xx, double xy, double yy)
{
	const double mean = 0.5 * (xx + yy), half = 0.5 * (xx - yy), root = std::hypot(half, xy);
	const double high = mean + root, low = mean - root;
	if (low >= 0.0)
		return {xx, xy, yy};
	if (high <= 0.0)
		return {0.0, 0.0, 0.0};
	// high times the projection on its eigenvector.
	const double c = root > 0.0 ? half / root : 1.0, s = root > 0.0 ? xy / root : 0.0;
	return {0.5 * high * (1.0 + c), 0.5 * high * s, 0.5 * high * (1.0 - c)};
}

} // namespace

PatchEnergy::PatchEnergy(
	const FlatMesh& flat,
	const PointGroups& groups,
	const Patch& patch,
	const std::vector<TriangleShape>& shapes,
	PatchCost cost) :
		m_size(2 * patch.variables),
		m_cost(cost), m_hessian(m_size, m_size)
{
	double sum = 0.0;
	for (const TriangleShape& s : shapes)
		sum += s.base * s.apex.imag();
	const double minWeight = kMinWeight / static_cast<double>(shapes.size());
	for (std::size_t i = 0; i < shapes.size(); ++i) {
		const std::array<Complex, 3> a = weightsOf(shapes[i]);
		Element element;
		const auto [z, w] = derivativesOf(a, flat.at(patch.triangles[i]));
		element.z0 = z;
		element.w0 = w;
		element.weight = std::max(shapes[i].base * shapes[i].apex.imag() / sum, minWeight);
		for (std::size_t k = 0; k < 3; ++k) {
			const int local = patch.corners[static_cast<int>(i)][k];
			const Complex turn = groups.turn[patch.points[positionOf(local)]];
			element.variable[k] = patch.variable[local];
			element.c[k] = a[k] * turn;
			element.e[k] = std::conj(a[k]) * turn;
		}
		m_elements.push_back(element);
	}
	layOutMatrix();
}

double PatchEnergy::minDeterminant(const Eigen::VectorXd& x) const
{
	double smallest = kInfinity;
	for (const Element& element : m_elements) {
		const auto [z, w] = mapAt(element, x);
		smallest = std::min(smallest, std::norm(z) - std::norm(w));
	}
	return smallest;
}

double PatchEnergy::value(const Eigen::VectorXd& x, double eps) const
{
	double sum = 0.0;
	for (const Element& element : m_elements) {
		const auto [z, w] = mapAt(element, x);
		if (element.weight > 0.0)
			sum += element.weight * Density::of(m_cost, std::norm(z), std::norm(w), eps).value;
	}
	return sum;
}

bool PatchEnergy::newtonStep(
	const Eigen::VectorXd& x, double eps, Eigen::VectorXd& gradient, Eigen::VectorXd& step)
{
	checkpoint();
	gradient.setZero(m_size);
	std::fill_n(m_hessian.valuePtr(), m_hessian.nonZeros(), 0.0);
	const Slots* slot = m_slots.data();
	for (const Element& element : m_elements)
		slot = add(element, x, eps, gradient, slot);
	Eigen::VectorXd diagonals(m_size); // in the order of elimination
	for (int column = 0; column < m_size; ++column)
		diagonals[m_solver.position()[column]] = diagonal(column);
	const double trace = std::accumulate(diagonals.begin(), diagonals.end(), 0.0);
	if (!std::isfinite(trace))
		return false;
	double shift = 0.0, next = kShift * trace / m_size;
	for (int attempt = 0; attempt < kMaxShifts; ++attempt, next *= kShiftGrowth) {
		for (int column = 0; column < m_size; ++column)
			diagonal(column) += next - shift;
		shift = next;
		if (!m_solver.factorize(m_hessian))
			continue;
		step = m_solver.solve(-gradient);
		if (step.allFinite() && step.dot(gradient) < 0.0)
			return true;
	}
	return false;
}

std::array<Complex, 2> PatchEnergy::mapAt(const Element& element, const Eigen::VectorXd& x)
{
	Complex z = element.z0, w = element.w0;
	for (std::size_t k = 0; k < 3; ++k)
		if (const int i = element.variable[k]; i >= 0) {
			const Complex v(x[2 * i], x[2 * i + 1]);
			z += element.c[k] * v;
			w += element.e[k] * v;
		}
	return {z, w};
}

/// Adds one triangle's gradient and Hessian.
/// \param slot where its blocks are; \return those of the next triangle
const PatchEnergy::Slots* PatchEnergy::add(
	const Element& element,
	const Eigen::VectorXd& x,
	double eps,
	Eigen::VectorXd& gradient,
	const Slots* slot)
{
	const auto [z, w] = mapAt(element, x);
	const double a = std::norm(z), b = std::norm(w), weight = element.weight;
	const Density density = Density::of(m_cost, a, b, eps);
	const Complex gz = 2.0 * weight * density.da * z, gw = 2.0 * weight * density.db * w;
	// In the frames along f_z and f_zbar: the radial directions, and the two across.
	const Complex u = a > 0.0 ? z / std::sqrt(a) : 1.0, v = b > 0.0 ? w / std::sqrt(b) : 1.0;
	const auto [xx, xy, yy] = semidefinite(
		2.0 * density.da + 4.0 * a * density.daa,
		4.0 * std::sqrt(a * b) * density.dab,
		2.0 * density.db + 4.0 * b * density.dbb);
	const double acrossZ = std::max(2.0 * density.da, 0.0);
	const double acrossW = std::max(2.0 * density.db, 0.0);
	const double pz = 0.5 * weight * (xx + acrossZ);
	const double pw = 0.5 * weight * (yy + acrossW);
	const Complex qz = 0.5 * weight * (xx - acrossZ) * u * u;
	const Complex qw = 0.5 * weight * (yy - acrossW) * v * v;
	const Complex mixed = 0.5 * weight * xy * u * std::conj(v);
	const Complex mixedConj = 0.5 * weight * xy * u * v;
	for (std::size_t k = 0; k < 3; ++k) {
		const int row = element.variable[k];
		if (row < 0)
			continue;
		const Complex ck = std::conj(element.c[k]), ek = std::conj(element.e[k]);
		const Complex g = ck * gz + ek * gw;
		gradient[2 * row] += g.real();
		gradient[2 * row + 1] += g.imag();
		for (std::size_t l = 0; l < 3; ++l) {
			const int column = element.variable[l];
			if (column < 0 || column > row)
				continue;
			const Complex cl = element.c[l], el = element.e[l];
			// The block takes a displacement d to s d + t conj(d).
			const Complex s = ck * (pz * cl + mixed * el) + ek * (std::conj(mixed) * cl + pw * el);
			const Complex t = ck * (qz * std::conj(cl) + mixedConj * std::conj(el)) +
							  ek * (mixedConj * std::conj(cl) + qw * std::conj(el));
			addBlock((*slot++), row == column, s, t);
		}
	}
	return slot;
}

void PatchEnergy::addBlock(const Slots& slot, bool diagonal, Complex s, Complex t)
{
	double* values = m_hessian.valuePtr();
	values[slot[0]] += s.real() + t.real();
	values[slot[1]] += s.imag() + t.imag();
	if (!diagonal)
		values[slot[2]] += t.imag() - s.imag();
	values[slot[3]] += s.real() - t.real();
}

/// The first entry of a column of the lower triangle.
double& PatchEnergy::diagonal(int column)
{
	return m_hessian.valuePtr()[m_hessian.outerIndexPtr()[column]];
}

/// The pattern of the lower triangle, and where every block of every triangle lies in it.
void PatchEnergy::layOutMatrix()
{
	const auto forBlocks = [&](const auto& use) {
		for (const Element& element : m_elements)
			for (const int i : element.variable)
				for (const int j : element.variable)
					if (i >= 0 && j >= 0 && j <= i)
						use(2 * i, 2 * j);
	};
	std::vector<Eigen::Triplet<double>> entries;
	forBlocks([&](int i, int j) {
		for (int k = 0; k < 2; ++k)
			for (int l = 0; l < 2; ++l)
				if (i != j || k >= l)
					entries.emplace_back(i + k, j + l, 0.0);
	});
	m_hessian.setFromTriplets(entries.begin(), entries.end());
	m_solver.analyze(m_hessian);
	const auto find = [&](int row, int column) {
		const int* rows = m_hessian.innerIndexPtr();
		const int* first = rows + m_hessian.outerIndexPtr()[column];
		const int* last = rows + m_hessian.outerIndexPtr()[column + 1];
		return Eigen::Index(std::lower_bound(first, last, row) - rows);
	};
	forBlocks([&](int i, int j) {
		m_slots.push_back(
			{find(i, j), find(i + 1, j), i == j ? -1 : find(i, j + 1), find(i + 1, j + 1)});
	});
}

double strain(const TriangleShape& shape, const Triangle2& plane)
{
	const auto [z, w] = derivativesOf(weightsOf(shape), plane);
	const double a = std::norm(z), b = std::norm(w);
	if (!(a > b))
		return kInfinity;
	return Density::untangling(a, b, 0.0).value / (2.0 + 2.0 * kAreaWeight);
}

} // namespace ricci
