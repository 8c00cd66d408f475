// SPDX-License-Identifier: GPL-3.0-or-later
#include "cone_placement.h"

#include "../error.h"
#include "../metric/delaunay_start.h"
#include "../metric/euclidean.h"
#include "../numbers.h"
#include "curvature_map.h"
#include "hessian.h"
#include "sparse_cholesky.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace ricci {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kQuarterTurn = 0.5 * kPi;

/// A cone this weak, in radians, is better placed anew than moved.
constexpr double kNegligible = 0.3;

/// Rounds in which every cone may move.
constexpr int kMostRounds = 5;

/// A move must lower the energy by this share.
constexpr double kLeastGain = 0.02;

/// A cone weaker than this, in radians, is not worth its seam.
constexpr double kLeastCurvature = 0.02;

/// Cones move once the distortion is within this of the wanted one.
constexpr double kNearlyEnough = 1.1;

/// Steps of the search for rounded curvatures, for each cone.
constexpr int kRoundingSteps = 50;

/// L u = rhs on the weighted Delaunay triangulation of the surface, where all weights are
/// non-negative inside.
class LinearFlow
{
public:
	LinearFlow(
		const Triangulation& t, const std::vector<double>& lengths, const ConeRequest& request) :
			m_boundary(t.boundaryVertices()),
			m_candidates(request.vertices < 0 ? t.vertexCount() : request.vertices)
	{
		const DelaunayStart start = delaunayStart({t, lengths}, {});
		GeometricCurvatureMap<Euclidean> map(
			inversiveDistancePacking(start.mesh.triangulation, start.mesh.lengths, start.radii));
		VectorXd u(t.vertexCount());
		for (int v = 0; v < t.vertexCount(); ++v)
			u[v] = std::log(start.radii[at(v)]);
		map.evaluate(u);
		m_curvature = map.curvature();
		computeAreas(map);
		m_fixed = request.boundary == ConeBoundary::Fixed &&
				  std::find(m_boundary.begin(), m_boundary.end(), 1) != m_boundary.end();
		m_unknown.assign(m_boundary.size(), -1);
		int count = 0;
		for (std::size_t v = m_fixed ? 0 : 1; v < m_unknown.size(); ++v)
			if (!(m_fixed && m_boundary[v]))
				m_unknown[v] = count++;
		m_rhs.resize(count);
		m_solution.resize(count);
		if (count > 0)
			factorize(map, count);
		spreadSink(t, lengths);
		listNeighbours(t);
	}

	/// Whether the curvatures of the cones have a fixed sum.
	bool hasFixedSum() const { return m_sink.size() == 0 && !m_fixed; }
	bool isCandidate(int v) const { return v < m_candidates && !m_boundary[at(v)]; }
	const int* neighboursBegin(int v) const { return &m_neighbours[at(m_firstNeighbour[at(v)])]; }
	const int* neighboursEnd(int v) const
	{
		return m_neighbours.data() + m_firstNeighbour[at(v) + 1];
	}
	Index vertexCount() const { return m_area.size(); }
	const VectorXd& curvature() const { return m_curvature; }
	const VectorXd& area() const { return m_area; } ///< shares that add up to 1

	/// u for a right-hand side, with mean 0. What the sum of \p rhs lacks goes to the boundary, or,
	/// on a closed surface, to one vertex that is always the same.
	VectorXd solve(VectorXd rhs)
	{
		if (m_sink.size() > 0)
			rhs -= rhs.sum() * m_sink;
		for (std::size_t v = 0; v < m_unknown.size(); ++v)
			if (m_unknown[v] >= 0)
				m_rhs[m_unknown[v]] = rhs[static_cast<Index>(v)];
		if (m_rhs.size() > 0)
			m_cholesky.solve(m_rhs, m_solution);
		VectorXd u = VectorXd::Zero(vertexCount());
		for (std::size_t v = 0; v < m_unknown.size(); ++v)
			if (m_unknown[v] >= 0)
				u[static_cast<Index>(v)] = m_solution[m_unknown[v]];
		u.array() -= m_area.dot(u);
		return u;
	}

	/// Derivative of half the mean square of \p u by the curvature of a cone at each vertex, up to
	/// a constant where the sum of the curvatures is fixed.
	VectorXd gradient(const VectorXd& u)
	{
		const VectorXd rhs = m_area.cwiseProduct(u);
		VectorXd phi = solveTransposed(rhs);
		if (m_sink.size() > 0)
			phi.array() -= m_sink.dot(phi);
		return phi;
	}

private:
	/// As solve(), without the shift of the mean where that has a meaning.
	VectorXd solveTransposed(const VectorXd& rhs)
	{
		for (std::size_t v = 0; v < m_unknown.size(); ++v)
			if (m_unknown[v] >= 0)
				m_rhs[m_unknown[v]] = rhs[static_cast<Index>(v)];
		if (m_rhs.size() > 0)
			m_cholesky.solve(m_rhs, m_solution);
		VectorXd phi = VectorXd::Zero(vertexCount());
		for (std::size_t v = 0; v < m_unknown.size(); ++v)
			if (m_unknown[v] >= 0)
				phi[static_cast<Index>(v)] = m_solution[m_unknown[v]];
		return phi;
	}

	void computeAreas(const CurvatureMap& map)
	{
		const Triangulation& t = map.triangulation();
		m_area.setZero(t.vertexCount());
		for (int f = 0; f < t.faceCount(); ++f) {
			const auto h = t.halfedges(f);
			const double area = 0.5 * map.lengths()[at(Triangulation::edge(h[0]))] *
								map.lengths()[at(Triangulation::edge(h[2]))] *
								std::sin(map.angles()[at(h[0])]);
			for (int k : h)
				m_area[t.origin(k)] += area / 3.0;
		}
		m_area /= m_area.sum();
	}

	void factorize(const CurvatureMap& map, int count)
	{
		Hessian hessian;
		hessian.layOut(map, m_unknown, count);
		hessian.fill(map, 0.0);
		m_cholesky.analyze(hessian.matrix());
		const double scale = std::max(hessian.largestDiagonal(), 1.0);
		double shift = 0.0;
		while (!m_cholesky.factorize(hessian.matrix())) {
			shift = std::max(100.0 * shift, 1e-14 * scale);
			if (!(shift <= scale) || std::isinf(shift))
				throw Error(
					"The linear solver failed: its matrix is not positive definite. Remesh the "
					"worst triangles.");
			hessian.fill(map, shift);
		}
	}

	void listNeighbours(const Triangulation& t)
	{
		m_firstNeighbour.assign(at(t.vertexCount()) + 1, 0);
		for (int h = 0; h < t.halfedgeCount(); ++h)
			++m_firstNeighbour[at(t.origin(h)) + 1];
		std::partial_sum(
			m_firstNeighbour.begin(), m_firstNeighbour.end(), m_firstNeighbour.begin());
		m_neighbours.resize(at(t.halfedgeCount()));
		std::vector<int> cursor(m_firstNeighbour.begin(), m_firstNeighbour.end() - 1);
		for (int h = 0; h < t.halfedgeCount(); ++h)
			m_neighbours[at(cursor[at(t.origin(h))]++)] = t.target(h);
	}

	/// Shares of the boundary vertices in the curvature of a prescribed boundary.
	void spreadSink(const Triangulation& t, const std::vector<double>& lengths)
	{
		if (m_fixed || std::find(m_boundary.begin(), m_boundary.end(), 1) == m_boundary.end())
			return;
		m_sink.setZero(t.vertexCount());
		for (int h = 0; h < t.halfedgeCount(); ++h)
			if (t.isOuter(h))
				for (int v : {t.origin(h), t.target(h)})
					m_sink[v] += lengths[at(Triangulation::edge(h))];
		m_sink /= m_sink.sum();
	}

	std::vector<char> m_boundary;
	int m_candidates;
	std::vector<int> m_firstNeighbour, m_neighbours; // by vertex
	bool m_fixed = false;
	std::vector<int> m_unknown;
	VectorXd m_curvature, m_area, m_sink;
	SparseCholesky m_cholesky;
	VectorXd m_rhs, m_solution;
};

/// The cones of the moment, with the quadratic function that their curvatures k minimise:
/// E(k) = k G k / 2 + b k + E(0).
class Cones
{
public:
	Cones(LinearFlow& flow, double total) :
			m_flow(flow), m_total(total), m_isCone(at(flow.vertexCount()), 0)
	{
		m_start = fieldOf(-flow.curvature());
		m_uniform = fieldOf(flow.area());
	}

	int size() const { return static_cast<int>(m_vertices.size()); }
	const std::vector<int>& vertices() const { return m_vertices; }
	const VectorXd& values() const { return m_values; }

	/// Fits the curvatures anew.
	void setRounding(ConeRounding rounding)
	{
		m_rounding = rounding;
		fit();
	}

	double energy() const { return meanSquare(factor()); }
	double distortion() const { return 2.0 * std::sqrt(energy()); }

	/// The least number of cones that can carry the total curvature.
	int leastCount() const
	{
		if (!m_flow.hasFixedSum() || m_total == 0.0)
			return 0;
		if (m_total < 0.0)
			return 1;
		return static_cast<int>(std::ceil(m_total / kMostConeCurvature));
	}

	/// The first cones have equal shares of the total, which needs so many; the rest lies on the
	/// whole surface in proportion to area.
	bool start()
	{
		const int count = leastCount();
		const double sign = m_total < 0.0 ? -1.0 : 1.0;
		for (int i = 0; i < count; ++i) {
			const double share = m_total / count;
			VectorXd phi = m_start.phi + (m_total - share * i) * m_uniform.phi;
			for (const Field& cone : m_unit)
				phi += share * cone.phi;
			const int v = best(sign * phi, false);
			if (v < 0)
				return false;
			append(v);
		}
		fit();
		return true;
	}

	/// One more, where it gains most. \return false if no vertex is left
	bool add()
	{
		VectorXd phi = gradient();
		phi.array() -= level(phi);
		const int v = best(phi, true);
		if (v < 0)
			return false;
		append(v);
		fit();
		return true;
	}

	/// Takes every cone out in turn and puts it where it gains most.
	void relocate()
	{
		double present = energy();
		for (int round = 0; round < kMostRounds; ++round) {
			bool moved = false;
			for (int i = 0; i < size(); ++i)
				moved |= std::abs(m_values[i]) > kNegligible ? relocate(i, present)
															 : replant(i, present);
			if (!moved)
				return;
		}
	}

	void removeWeak()
	{
		const VectorXd values = m_values;
		for (int i = size() - 1; i >= 0; --i)
			if (std::abs(values[i]) <= kLeastCurvature && size() > leastCount())
				remove(i);
		fit();
	}

private:
	/// What a curvature does: the conformal factor, and its share in the energy's gradient.
	struct Field
	{
		VectorXd u, phi;
	};

	Field fieldOf(const VectorXd& curvature)
	{
		Field field;
		field.u = m_flow.solve(curvature);
		field.phi = m_flow.gradient(field.u);
		return field;
	}

	Field unitCone(int v)
	{
		VectorXd curvature = VectorXd::Zero(m_flow.vertexCount());
		curvature[v] = 1.0;
		return fieldOf(curvature);
	}

	VectorXd factor() const
	{
		VectorXd u = m_start.u;
		for (int i = 0; i < size(); ++i)
			u += m_values[i] * m_unit[at(i)].u;
		return u;
	}

	VectorXd gradient() const
	{
		VectorXd phi = m_start.phi;
		for (int i = 0; i < size(); ++i)
			phi += m_values[i] * m_unit[at(i)].phi;
		return phi;
	}

	double meanSquare(const VectorXd& u) const { return m_flow.area().dot(u.cwiseProduct(u)); }

	/// The value of the gradient that gains nothing: that at the cones where the sum is fixed.
	double level(const VectorXd& phi) const
	{
		if (!m_flow.hasFixedSum())
			return 0.0;
		if (m_vertices.empty())
			return m_flow.area().dot(phi);
		double sum = 0.0;
		int count = 0;
		for (int i = 0; i < size(); ++i)
			if (m_values[i] < kMostConeCurvature - 1e-9) {
				sum += phi[m_vertices[at(i)]];
				++count;
			}
		return count > 0 ? sum / count : m_flow.area().dot(phi);
	}

	/// Candidate with the lowest \p phi, or the largest |phi|; the first of equals. -1 if none.
	int best(const VectorXd& phi, bool absolute) const
	{
		int found = -1;
		double least = std::numeric_limits<double>::infinity();
		for (int v = 0; v < static_cast<int>(phi.size()); ++v) {
			const double x = absolute ? -std::abs(phi[v]) : phi[v];
			if (!m_isCone[at(v)] && m_flow.isCandidate(v) && x < least) {
				least = x;
				found = v;
			}
		}
		return found;
	}

	void append(int v)
	{
		m_vertices.push_back(v);
		m_isCone[at(v)] = 1;
		m_unit.push_back(unitCone(v));
		refreshProducts(size() - 1);
	}

	void replace(int i, int v, Field unit)
	{
		m_isCone[at(m_vertices[at(i)])] = 0;
		m_isCone[at(v)] = 1;
		m_vertices[at(i)] = v;
		m_unit[at(i)] = std::move(unit);
		refreshProducts(i);
	}

	void remove(int i)
	{
		m_isCone[at(m_vertices[at(i)])] = 0;
		m_vertices.erase(m_vertices.begin() + i);
		m_unit.erase(m_unit.begin() + i);
		for (int k = i; k < size(); ++k)
			refreshProducts(k);
		m_gram.conservativeResize(size(), size());
		m_linear.conservativeResize(size());
		m_values = VectorXd::Zero(size());
	}

	/// Row and column \p i of G, entry i of b.
	void refreshProducts(int i)
	{
		const Index n = size();
		m_gram.conservativeResize(n, n);
		m_linear.conservativeResize(n);
		const VectorXd weighted = m_flow.area().cwiseProduct(m_unit[at(i)].u);
		for (Index k = 0; k < n; ++k)
			m_gram(i, k) = m_gram(k, i) = weighted.dot(m_unit[at(k)].u);
		m_linear[i] = weighted.dot(m_start.u);
	}

	/// Puts the curvatures to their best values.
	void fit()
	{
		std::vector<char> atMost(at(size()), 0);
		fitFree(atMost);
		if (m_rounding == ConeRounding::QuarterTurns && size() > 0)
			fitRounded();
	}

	/// Least squares with the sum fixed where it is, and no curvature above the largest.
	void fitFree(std::vector<char>& atMost)
	{
		m_values = VectorXd::Zero(size());
		for (int attempt = 0; attempt <= size(); ++attempt) {
			std::vector<int> free;
			double total = m_total;
			for (int i = 0; i < size(); ++i) {
				if (!atMost[at(i)])
					free.push_back(i);
				else
					total -= m_values[i] = kMostConeCurvature;
			}
			const auto n = static_cast<Index>(free.size());
			if (n == 0)
				return;
			const Index rows = n + (m_flow.hasFixedSum() ? 1 : 0);
			MatrixXd system = MatrixXd::Zero(rows, rows);
			VectorXd rhs = VectorXd::Zero(rows);
			for (Index a = 0; a < n; ++a) {
				const int i = free[at(a)];
				for (Index b = 0; b < n; ++b)
					system(a, b) = m_gram(i, free[at(b)]);
				rhs[a] = -m_linear[i];
				for (int k = 0; k < size(); ++k)
					if (atMost[at(k)])
						rhs[a] -= m_gram(i, k) * kMostConeCurvature;
			}
			if (rows > n) {
				system.row(n).head(n).setOnes();
				system.col(n).head(n).setOnes();
				rhs[n] = total;
			}
			const VectorXd solution = system.fullPivLu().solve(rhs);
			bool excess = false;
			for (Index a = 0; a < n; ++a) {
				m_values[free[at(a)]] = solution[a];
				if (solution[a] > kMostConeCurvature) {
					atMost[at(free[at(a)])] = 1;
					excess = true;
				}
			}
			if (!excess)
				return;
		}
	}

	/// Multiples of a quarter turn near the fitted values: rounded, corrected to the right sum, and
	/// changed by single steps or by exchanges between two cones while that lowers the energy.
	void fitRounded()
	{
		const double most = std::floor(kMostConeCurvature / kQuarterTurn + 1e-9);
		VectorXd turns(size());
		for (int i = 0; i < size(); ++i)
			turns[i] = std::min(most, std::round(m_values[i] / kQuarterTurn));
		const MatrixXd gram = kQuarterTurn * kQuarterTurn * m_gram;
		const VectorXd linear = kQuarterTurn * m_linear;
		VectorXd slope = gram * turns + linear;
		const auto step = [&](int i, double by) {
			turns[i] += by;
			slope += by * gram.col(i);
		};
		const auto cost = [&](int i, double by) {
			return turns[i] + by > most ? std::numeric_limits<double>::infinity()
										: by * slope[i] + 0.5 * gram(i, i);
		};
		if (m_flow.hasFixedSum()) {
			double missing = std::round(m_total / kQuarterTurn) - turns.sum();
			while (missing != 0.0) {
				const double by = missing > 0.0 ? 1.0 : -1.0;
				int cheapest = 0;
				for (int i = 1; i < size(); ++i)
					if (cost(i, by) < cost(cheapest, by))
						cheapest = i;
				step(cheapest, by);
				missing -= by;
			}
		}
		for (int s = 0; s < kRoundingSteps * size(); ++s) {
			double least = -1e-12 * (1.0 + std::abs(gram(0, 0)));
			int up = -1, down = -1;
			const auto consider = [&](int i, int j, double change) {
				if (change < least) {
					least = change;
					up = i;
					down = j;
				}
			};
			for (int i = 0; i < size(); ++i) {
				if (!m_flow.hasFixedSum()) {
					consider(i, -1, cost(i, 1.0));
					consider(-1, i, cost(i, -1.0));
				}
				for (int j = 0; j < size(); ++j)
					if (i != j)
						consider(i, j, cost(i, 1.0) + cost(j, -1.0) - gram(i, j));
			}
			if (up < 0 && down < 0)
				break;
			if (up >= 0)
				step(up, 1.0);
			if (down >= 0)
				step(down, -1.0);
		}
		m_values = kQuarterTurn * turns;
	}

	/// Moves cone \p i to where it gains most, or else to the best vertex beside it.
	bool relocate(int i, double& present)
	{
		const double own = m_values[i];
		const int old = m_vertices[at(i)];
		// Half the mean square changes by about own (phi[new] - phi[old]): far away with the field
		// of the others, as the cone's own is alike everywhere, or next to it with the whole field.
		const double enough = 0.5 * kLeastGain * present;
		const VectorXd whole = gradient();
		VectorXd phi = whole - own * m_unit[at(i)].phi;
		if (m_flow.hasFixedSum()) // the cone's curvature lies on the whole surface by area
			phi += own * m_uniform.phi;
		m_isCone[at(old)] = 0;
		const int far = best(own > 0.0 ? phi : VectorXd(-phi), false);
		m_isCone[at(old)] = 1;
		if (far >= 0 && own * (phi[old] - phi[far]) > enough && move(i, far, present))
			return true;
		int near = old;
		for (const int* v = m_flow.neighboursBegin(old); v != m_flow.neighboursEnd(old); ++v)
			if (!m_isCone[at(*v)] && m_flow.isCandidate(*v) && own * whole[*v] < own * whole[near])
				near = *v;
		return near != far && own * (whole[old] - whole[near]) > enough && move(i, near, present);
	}

	/// Moves cone \p i to \p v if that lowers the energy enough.
	bool move(int i, int v, double& present)
	{
		const int old = m_vertices[at(i)];
		const VectorXd oldValues = m_values;
		Field before = m_unit[at(i)];
		replace(i, v, unitCone(v));
		fit();
		const double now = energy();
		if (now < (1.0 - kLeastGain) * present) {
			present = now;
			return true;
		}
		replace(i, old, std::move(before));
		m_values = oldValues;
		return false;
	}

	/// Takes a weak cone out and adds one where that gains most.
	bool replant(int i, double& present)
	{
		if (size() <= leastCount())
			return false;
		const int old = m_vertices[at(i)];
		Field before = m_unit[at(i)];
		remove(i);
		fit();
		add(); // there is at least the old vertex
		const double now = energy();
		if (now < (1.0 - kLeastGain) * present) {
			present = now;
			return true;
		}
		replace(size() - 1, old, std::move(before));
		fit();
		return false;
	}

	LinearFlow& m_flow;
	double m_total; ///< 2 pi chi
	ConeRounding m_rounding = ConeRounding::Free;
	std::vector<char> m_isCone; // [vertex]
	std::vector<int> m_vertices;
	VectorXd m_values;         // [cone] radians
	Field m_start;             // without cones
	Field m_uniform;           // of a unit of curvature spread by area
	std::vector<Field> m_unit; // of each cone's unit of curvature
	MatrixXd m_gram;
	VectorXd m_linear;
};

} // namespace

PlacedCones
placeCones(const Triangulation& t, const std::vector<double>& lengths, const ConeRequest& request)
{
	LinearFlow flow(t, lengths, request);
	Cones cones(flow, 2 * kPi * t.eulerCharacteristic());
	int inside = 0;
	for (int v = 0; v < t.vertexCount(); ++v)
		inside += flow.isCandidate(v);
	if (request.count > 0 && request.count < cones.leastCount())
		throw InvalidOption(
			"The surface needs at least " + std::to_string(cones.leastCount()) +
			" placed cones, but cone_count is " + std::to_string(request.count) + ".");
	if (std::max(request.count, cones.leastCount()) > inside)
		throw InvalidOption(
			"The surface has " + std::to_string(inside) +
			" interior vertices, too few for the wanted cones: cone_count is " +
			std::to_string(request.count) + ".");
	cones.start();
	if (request.count > 0) {
		while (cones.size() < request.count && cones.add()) {
		}
		cones.relocate();
		cones.setRounding(request.rounding);
	}
	else {
		// Free curvatures show the way; the rounded ones have to reach the distortion.
		cones.setRounding(request.rounding);
		while (cones.distortion() > request.distortion && cones.size() < kMostPlacedCones) {
			cones.setRounding(ConeRounding::Free);
			if (!cones.add())
				break;
			if (cones.distortion() <= kNearlyEnough * request.distortion)
				cones.relocate();
			cones.setRounding(request.rounding);
		}
	}
	if (request.rounding != ConeRounding::Free) {
		cones.setRounding(request.rounding);
		cones.relocate();
	}
	cones.removeWeak();
	PlacedCones placed;
	placed.distortion = cones.distortion();
	std::vector<int> order(at(cones.size()));
	std::iota(order.begin(), order.end(), 0);
	std::sort(order.begin(), order.end(), [&](int a, int b) {
		return cones.vertices()[at(a)] < cones.vertices()[at(b)];
	});
	for (int i : order)
		if (cones.values()[i] != 0.0) {
			placed.vertices.push_back(cones.vertices()[at(i)]);
			placed.curvatures.push_back(cones.values()[i]);
		}
	return placed;
}

} // namespace ricci
