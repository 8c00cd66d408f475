// SPDX-License-Identifier: GPL-3.0-or-later
#include "untangle.h"

#include "../base/tolerances.h"
#include "../math/sparse_cholesky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace ricci {

namespace {

using Complex = std::complex<double>;

/// Weight of the area against the shape.
constexpr double kAreaWeight = 0.1;

/// Values of eps that are tried, and Newton steps with each of them; the steps that follow once all
/// triangles are sound.
constexpr int kMaxRounds = 40, kStepsPerRound = 3, kLastSteps = 10;

/// Newton steps of ease(), and the share of the energy that a step must not leave to be followed by
/// another.
constexpr int kEasingSteps = 40;
constexpr double kMinImprovement = 0.9999;

/// Rounds without a gain after which a patch is given up; the weight of triangles that are not sound
/// after such a round grows by this factor.
constexpr int kMaxIdleRounds = 6;
constexpr double kStress = 8.0;

/// A round that leaves more than this share of the energy has gained nothing.
constexpr double kMinGain = 0.99;

/// Halvings of a step.
constexpr int kMaxHalvings = 30;

/// The energy of one triangle by a = |f_z|^2 and b = |f_zbar|^2, where det J = a - b and
/// |J|^2 = 2 (a + b), and its derivatives.
struct Density
{
	double value, da, db, daa, dab, dbb;

	Density(double a, double b, double eps)
	{
		const double d = a - b, r = std::sqrt(eps * eps + d * d);
		const double chi = d > 0.0 ? 0.5 * (d + r) : 0.5 * eps * eps / (r - d);
		const double n = 2.0 * (a + b) + kAreaWeight * (1.0 + d * d);
		value = n / chi;
		// By s = a + b and d; d chi / dd = chi / r.
		const double vs = 2.0 / chi, vd = (2.0 * kAreaWeight * d - n / r) / chi;
		const double vsd = -2.0 / (chi * r);
		const double vdd =
			(2.0 * kAreaWeight * (1.0 - 2.0 * d / r) + n * (d / r + 1.0) / (r * r)) / chi;
		da = vs + vd, db = vs - vd;
		daa = vdd + 2.0 * vsd, dab = -vdd, dbb = vdd - 2.0 * vsd;
	}
};

/// f_z and f_zbar of a linear map, and their derivatives by the places of the corners, those of f_zbar
/// conjugate to those of f_z.
struct Derivatives
{
	std::array<Complex, 3> byCorner;
	Complex z, w;

	Derivatives(const RestShape& shape, const Triangle2& p)
	{
		const double b = shape.base, x = shape.apex.real(), y = shape.apex.imag();
		const Complex first(0.5 / b, 0.5 * x / (b * y)), second(0.0, -0.5 / y);
		byCorner = {-first - second, first, second};
		const Complex d1 = asComplex(p[1]) - asComplex(p[0]);
		const Complex d2 = asComplex(p[2]) - asComplex(p[0]);
		z = first * d1 + second * d2;
		w = std::conj(first) * d1 + std::conj(second) * d2;
	}
};

/// A triangle's map from its rest shape: f_z = z0 + sum c v, f_zbar = w0 + sum e v over its corners
/// with displacements v of their variables.
struct Element
{
	Complex z0, w0;
	std::array<Complex, 3> c, e;
	std::array<int, 3> variable; // -1: does not move
	double weight;
};

/// (x, y) -> (xx x + xy y, xy x + yy y), made positive semidefinite.
struct Symmetric2
{
	double xx, xy, yy;

	void makeSemidefinite()
	{
		const double mean = 0.5 * (xx + yy), half = 0.5 * (xx - yy), root = std::hypot(half, xy);
		const double high = mean + root, low = mean - root;
		if (low >= 0.0)
			return;
		if (high <= 0.0) {
			xx = xy = yy = 0.0;
			return;
		}
		// high times the projection on its eigenvector.
		const double c = root > 0.0 ? half / root : 1.0, s = root > 0.0 ? xy / root : 0.0;
		xx = 0.5 * high * (1.0 + c);
		yy = 0.5 * high * (1.0 - c);
		xy = 0.5 * high * s;
	}
};

/// Where the entries of a block of two by two are in a matrix.
using Slots = std::array<Eigen::Index, 4>;

/// The patch as an optimization problem in the displacements of its variables.
class PatchEnergy
{
public:
	PatchEnergy(
		const DrawnTriangles& drawn,
		const PointGroups& groups,
		const Patch& patch,
		const std::vector<RestShape>& shapes) :
			m_size(2 * patch.variables),
			m_hessian(m_size, m_size), m_row(positionOf(m_size)), m_rhs(m_size)
	{
		double sum = 0.0;
		for (const RestShape& s : shapes)
			sum += s.base * s.apex.imag();
		const double minWeight = kMinWeight / static_cast<double>(shapes.size());
		for (std::size_t i = 0; i < shapes.size(); ++i) {
			const Derivatives derivatives(shapes[i], drawn.at(patch.triangles[i]));
			const std::array<Complex, 3>& a = derivatives.byCorner;
			Element element;
			element.z0 = derivatives.z;
			element.w0 = derivatives.w;
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

	int size() const { return m_size; }

	/// Multiplies the weight of a triangle.
	void stress(int triangle, double factor) { m_elements[positionOf(triangle)].weight *= factor; }

	double minDeterminant(const Eigen::VectorXd& x) const
	{
		double smallest = std::numeric_limits<double>::infinity();
		for (const Element& element : m_elements) {
			const auto [z, w] = mapAt(element, x);
			smallest = std::min(smallest, std::norm(z) - std::norm(w));
		}
		return smallest;
	}

	double value(const Eigen::VectorXd& x, double eps) const
	{
		double sum = 0.0;
		for (const Element& element : m_elements) {
			const auto [z, w] = mapAt(element, x);
			sum += element.weight * Density(std::norm(z), std::norm(w), eps).value;
		}
		return sum;
	}

	/// Newton's step with the projected Hessian.
	/// \param tick called once, and during factorisations as SparseCholesky::factorize() says
	/// \return false where the Hessian cannot be factored
	bool newtonStep(
		const Eigen::VectorXd& x,
		double eps,
		Eigen::VectorXd& gradient,
		Eigen::VectorXd& step,
		const Tick& tick)
	{
		tick();
		gradient.setZero(m_size);
		std::fill_n(m_hessian.valuePtr(), m_hessian.nonZeros(), 0.0);
		const Slots* slot = m_slots.data();
		for (const Element& element : m_elements)
			slot = add(element, x, eps, gradient, slot);
		double trace = 0.0;
		for (int column = 0; column < m_size; ++column)
			trace += diagonal(column);
		if (!std::isfinite(trace))
			return false;
		for (int i = 0; i < m_size; ++i)
			m_rhs[m_row[i]] = -gradient[i];
		double shift = 0.0, next = kShift * trace / m_size;
		for (int attempt = 0; attempt < kMaxShifts; ++attempt, next *= kShiftGrowth) {
			for (int column = 0; column < m_size; ++column)
				diagonal(column) += next - shift;
			shift = next;
			if (!m_solver.factorize(m_hessian, tick))
				continue;
			m_solver.solve(m_rhs, m_solution);
			step.resize(m_size);
			for (int i = 0; i < m_size; ++i)
				step[i] = m_solution[m_row[i]];
			if (step.allFinite() && step.dot(gradient) < 0.0)
				return true;
		}
		return false;
	}

private:
	static constexpr double kMinWeight = 1e-3;
	static constexpr double kShift = 1e-10, kShiftGrowth = 1e3;
	static constexpr int kMaxShifts = 4;

	static std::array<Complex, 2> mapAt(const Element& element, const Eigen::VectorXd& x)
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
	const Slots*
	add(const Element& element,
		const Eigen::VectorXd& x,
		double eps,
		Eigen::VectorXd& gradient,
		const Slots* slot)
	{
		const auto [z, w] = mapAt(element, x);
		const double a = std::norm(z), b = std::norm(w), weight = element.weight;
		const Density density(a, b, eps);
		const Complex gz = 2.0 * weight * density.da * z, gw = 2.0 * weight * density.db * w;
		// In the frames along f_z and f_zbar: the radial directions, and the two across.
		const Complex u = a > 0.0 ? z / std::sqrt(a) : 1.0, v = b > 0.0 ? w / std::sqrt(b) : 1.0;
		Symmetric2 radial{
			2.0 * density.da + 4.0 * a * density.daa,
			4.0 * std::sqrt(a * b) * density.dab,
			2.0 * density.db + 4.0 * b * density.dbb};
		radial.makeSemidefinite();
		const double acrossZ = std::max(2.0 * density.da, 0.0);
		const double acrossW = std::max(2.0 * density.db, 0.0);
		const double pz = 0.5 * weight * (radial.xx + acrossZ);
		const double pw = 0.5 * weight * (radial.yy + acrossW);
		const Complex qz = 0.5 * weight * (radial.xx - acrossZ) * u * u;
		const Complex qw = 0.5 * weight * (radial.yy - acrossW) * v * v;
		const Complex mixed = 0.5 * weight * radial.xy * u * std::conj(v);
		const Complex mixedConj = 0.5 * weight * radial.xy * u * v;
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
				const Complex s =
					ck * (pz * cl + mixed * el) + ek * (std::conj(mixed) * cl + pw * el);
				const Complex t = ck * (qz * std::conj(cl) + mixedConj * std::conj(el)) +
								  ek * (mixedConj * std::conj(cl) + qw * std::conj(el));
				addBlock((*slot++), row == column, s, t);
			}
		}
		return slot;
	}

	void addBlock(const Slots& slot, bool diagonal, Complex s, Complex t)
	{
		double* values = m_hessian.valuePtr();
		values[slot[0]] += s.real() + t.real();
		values[slot[1]] += s.imag() + t.imag();
		if (!diagonal)
			values[slot[2]] += t.imag() - s.imag();
		values[slot[3]] += s.real() - t.real();
	}

	/// The first entry of a column of the lower triangle.
	double& diagonal(int column) { return m_hessian.valuePtr()[m_hessian.outerIndexPtr()[column]]; }

	/// The pattern of the lower triangle, and where every block of every triangle lies in it.
	void layOutMatrix()
	{
		const auto forBlocks = [&](const auto& use) {
			for (const Element& element : m_elements)
				for (const int i : element.variable)
					for (const int j : element.variable)
						if (i >= 0 && j >= 0 && j <= i)
							use(2 * i, 2 * j);
		};
		std::iota(m_row.begin(), m_row.end(), 0);
		const auto layOut = [&] {
			std::vector<Eigen::Triplet<double>> entries;
			forBlocks([&](int i, int j) {
				for (int k = 0; k < 2; ++k)
					for (int l = 0; l < 2; ++l)
						if (i != j || k >= l) {
							const auto [column, row] = std::minmax(m_row[i + k], m_row[j + l]);
							entries.emplace_back(row, column, 0.0);
						}
			});
			m_hessian.setFromTriplets(entries.begin(), entries.end());
		};
		layOut();
		m_solver.analyze(m_hessian, m_row, layOut);
		const auto find = [&](int i, int j) {
			const auto [column, row] = std::minmax(m_row[i], m_row[j]);
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

	int m_size; // two for each variable
	std::vector<Element> m_elements;
	SparseCholesky::Matrix m_hessian; // lower triangle
	Array<int> m_row;                 // [unknown] of the matrix
	std::vector<Slots> m_slots;       // in the order of the triangles
	SparseCholesky m_solver;
	Eigen::VectorXd m_rhs, m_solution; // by rows
};

/// The search for a sound patch.
class Untangler
{
public:
	Untangler(
		const DrawnTriangles& drawn,
		const PointGroups& groups,
		const Patch& patch,
		const std::vector<RestShape>& shapes,
		const Soundness& soundness,
		const Tick& tick) :
			m_drawn(drawn),
			m_groups(groups), m_patch(patch), m_soundness(soundness), m_tick(tick),
			m_energy(drawn, groups, patch, shapes),
			m_x(Eigen::VectorXd::Zero(m_energy.size())), m_least{
															 patch.triangles.size() + 1,
															 patch.triangles.size() + 1}
	{
	}

	Untangled ease()
	{
		if (place(m_x))
			improve(kEasingSteps);
		return m_found;
	}

	Untangled run()
	{
		int idle = 0;
		bool gained = true;
		double soft = kFirstEps, least = m_energy.minDeterminant(m_x);
		std::size_t before = m_patch.triangles.size();
		place(m_x);
		m_found.points.clear(); // they are where they were
		m_eps = std::max(soft, -kEpsShare * least);
		for (int round = 0; round < kMaxRounds; ++round) {
			// A positive determinant of the size of eps is as good as with eps = 0.
			if (least > soft)
				m_eps = kMinEps;
			else if (round > 0)
				m_eps = std::max(
					std::min(std::max(soft, -kEpsShare * least), gained ? m_eps : kEpsFall * m_eps),
					kMinEps);
			soft = std::max(kEpsFall * soft, kMinEps);
			double value = m_energy.value(m_x, m_eps);
			const double first = value;
			for (int i = 0; i < kStepsPerRound && descend(value, false); ++i)
				;
			if (place(m_x)) {
				improve(kLastSteps);
				break;
			}
			least = m_energy.minDeterminant(m_x);
			gained = value < kMinGain * first;
			const std::size_t bad = m_unsound.size();
			bool isIdle = false;
			if (least > m_eps) { // all are the right way round, but some too low
				for (const int i : m_unsound)
					m_energy.stress(i, kStress);
				isIdle = 10 * bad >= 9 * before;
			}
			else // more has been asked than can be had
				isIdle = !gained && m_eps < -kSmallEps * least;
			const bool many = 8 * bad > m_patch.triangles.size();
			idle = isIdle ? idle + 1 : 0;
			if (idle >= (many ? kMaxIdleRounds / 3 : kMaxIdleRounds))
				break;
			before = bad;
		}
		return m_found;
	}

private:
	/// One Newton step that lowers the energy.
	/// \param soundOnly the step must leave the patch sound
	bool descend(double& value, bool soundOnly)
	{
		++m_found.steps;
		if (!m_energy.newtonStep(m_x, m_eps, m_gradient, m_step, m_tick))
			return false;
		const double slope = m_step.dot(m_gradient);
		double length = 1.0;
		for (int i = 0; i < kMaxHalvings; ++i, length *= 0.5) {
			m_trial = m_x + length * m_step;
			const double next = m_energy.value(m_trial, m_eps);
			if (!(next <= value + kArmijo * length * slope) || (soundOnly && !place(m_trial)))
				continue;
			m_x.swap(m_trial);
			value = next;
			return true;
		}
		return false;
	}

	/// Goes on from a sound patch to a better one.
	void improve(int steps)
	{
		m_eps = kMinEps;
		double value = m_energy.value(m_x, m_eps);
		for (int i = 0; i < steps; ++i) {
			const double before = value;
			if (!descend(value, true) || value > kMinImprovement * before)
				return;
		}
	}

	/// Lists the triangles that are not sound at \p x, and takes the places of the points over if that
	/// is better than what is known.
	/// \return whether all are sound
	bool place(const Eigen::VectorXd& x)
	{
		m_places.clear();
		for (std::size_t i = 0; i < m_patch.points.size(); ++i) {
			const int p = m_patch.points[i], variable = m_patch.variable[static_cast<int>(i)];
			m_places.push_back(
				variable < 0
					? m_drawn.points[p]
					: m_soundness.stored(m_groups.displaced(
						  p, m_drawn.points, Complex(x[2 * variable], x[2 * variable + 1]))));
		}
		m_unsound.clear();
		std::size_t turned = 0;
		for (const int i : m_patch.corners.indices()) {
			const Triangle& t = m_patch.corners[i];
			const Triangle2 corners{
				m_places[positionOf(t[0])], m_places[positionOf(t[1])], m_places[positionOf(t[2])]};
			if (m_soundness.isSound(corners))
				continue;
			m_unsound.push_back(i);
			turned += !m_soundness.isUpright(corners);
		}
		const std::array<std::size_t, 2> counts{turned, m_unsound.size()};
		const bool sound = m_unsound.empty();
		if (sound || counts < m_least) {
			m_least = counts;
			m_found.points = m_places;
			m_found.sound = sound;
		}
		return sound;
	}

	static constexpr double kArmijo = 1e-4, kEpsShare = 0.2, kMinEps = 1e-9;
	static constexpr double kFirstEps = 0.1, kEpsFall = 0.2, kSmallEps = 0.02;

	const DrawnTriangles& m_drawn;
	const PointGroups& m_groups;
	const Patch& m_patch;
	const Soundness& m_soundness;
	const Tick& m_tick;
	PatchEnergy m_energy;
	Eigen::VectorXd m_x, m_trial, m_gradient, m_step;
	double m_eps = 1.0;
	std::vector<Point2> m_places;       // of the last trial
	std::vector<int> m_unsound;         // triangles of the patch there
	std::array<std::size_t, 2> m_least; // turned and unsound ones at the best places
	Untangled m_found;
};

} // namespace

Untangled untangle(
	const DrawnTriangles& drawn,
	const PointGroups& groups,
	const Patch& patch,
	const std::vector<RestShape>& shapes,
	const Soundness& soundness,
	const Tick& tick)
{
	return Untangler(drawn, groups, patch, shapes, soundness, tick).run();
}

Untangled ease(
	const DrawnTriangles& drawn,
	const PointGroups& groups,
	const Patch& patch,
	const std::vector<RestShape>& shapes,
	const Soundness& soundness,
	const Tick& tick)
{
	return Untangler(drawn, groups, patch, shapes, soundness, tick).ease();
}

double strain(const RestShape& shape, const Triangle2& plane)
{
	const Derivatives d(shape, plane);
	const double a = std::norm(d.z), b = std::norm(d.w);
	if (!(a > b))
		return std::numeric_limits<double>::infinity();
	return Density(a, b, 0.0).value / (2.0 + 2.0 * kAreaWeight);
}

} // namespace ricci
