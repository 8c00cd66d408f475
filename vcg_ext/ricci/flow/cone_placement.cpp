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
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <string>
#include <utility>

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

/// Trials of one cone's move for shorter seams.
constexpr int kMostAttempts = 3;

/// Exponent of the mean square in the product with the length that such moves lower: distortion
/// counts half as much as length.
constexpr double kDistortionWeight = 0.25;

/// A move for shorter seams must lower the product by this share.
constexpr double kLeastSeamGain = 0.005;

/// Branches of the tree at one cone for which its moves are weighed: all that short trees have.
constexpr int kMostBranches = 5;

/// Rounds in which every cone may move towards the others.
constexpr int kMostSeamRounds = 6;

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
		listNeighbours(t, lengths);
	}

	/// Whether the curvatures of the cones have a fixed sum.
	bool hasFixedSum() const { return m_sink.size() == 0 && !m_fixed; }
	bool isCandidate(int v) const { return v < m_candidates && !m_boundary[at(v)]; }
	const int* neighboursBegin(int v) const { return &m_neighbours[at(m_firstNeighbour[at(v)])]; }
	const int* neighboursEnd(int v) const
	{
		return m_neighbours.data() + m_firstNeighbour[at(v) + 1];
	}
	/// Shortest distances along edges from \p v.
	std::vector<double> distancesFrom(int v) const
	{
		std::vector<double> distance(m_boundary.size(), std::numeric_limits<double>::infinity());
		using Entry = std::pair<double, int>;
		std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
		distance[at(v)] = 0.0;
		queue.push({0.0, v});
		while (!queue.empty()) {
			const auto [d, from] = queue.top();
			queue.pop();
			if (d > distance[at(from)])
				continue;
			for (int k = m_firstNeighbour[at(from)]; k < m_firstNeighbour[at(from) + 1]; ++k) {
				const int to = m_neighbours[at(k)];
				const double there = d + m_edgeLength[at(k)];
				if (there < distance[at(to)]) {
					distance[at(to)] = there;
					queue.push({there, to});
				}
			}
		}
		return distance;
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

	double meanSquare(const VectorXd& u) const { return m_area.dot(u.cwiseProduct(u)); }

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
		const auto layOut = [&] { hessian.layOut(map, m_unknown, count); };
		layOut();
		m_cholesky.analyze(hessian.matrix(), m_unknown, layOut);
		hessian.fill(map, 0.0);
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

	void listNeighbours(const Triangulation& t, const std::vector<double>& lengths)
	{
		m_firstNeighbour.assign(at(t.vertexCount()) + 1, 0);
		for (int h = 0; h < t.halfedgeCount(); ++h)
			++m_firstNeighbour[at(t.origin(h)) + 1];
		std::partial_sum(
			m_firstNeighbour.begin(), m_firstNeighbour.end(), m_firstNeighbour.begin());
		m_neighbours.resize(at(t.halfedgeCount()));
		m_edgeLength.resize(m_neighbours.size());
		std::vector<int> cursor(m_firstNeighbour.begin(), m_firstNeighbour.end() - 1);
		for (int h = 0; h < t.halfedgeCount(); ++h) {
			const auto place = at(cursor[at(t.origin(h))]++);
			m_neighbours[place] = t.target(h);
			m_edgeLength[place] = lengths[at(Triangulation::edge(h))];
		}
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
	std::vector<double> m_edgeLength;                // to each of m_neighbours
	bool m_fixed = false;
	std::vector<int> m_unknown;
	VectorXd m_curvature, m_area, m_sink;
	SparseCholesky m_cholesky;
	VectorXd m_rhs, m_solution;
};

/// The cones of the moment, with the quadratic function that their curvatures k minimise:
/// E(k) = k G k + 2 b k + E(0), the mean square of u.
///
/// The products of two fields u are values of the fields phi: with u_v the factor of a unit of
/// curvature at v and phi_j the gradient field of u_j, the mean of u_v u_j is phi_j(v). So a trial of
/// a vertex costs one solution, that of its own u for the diagonal of G, and only if it was never
/// tried before.
class Cones
{
public:
	Cones(LinearFlow& flow, double total) :
			m_flow(flow), m_total(total), m_isCone(at(flow.vertexCount()), 0)
	{
		const VectorXd start = m_flow.solve(-flow.curvature());
		m_startEnergy = m_flow.meanSquare(start);
		m_start = m_flow.gradient(start);
		m_uniform = m_flow.gradient(m_flow.solve(flow.area()));
	}

	int size() const { return static_cast<int>(m_now.vertices.size()); }
	const std::vector<int>& vertices() const { return m_now.vertices; }
	const VectorXd& values() const { return m_now.values; }

	/// Fits the curvatures anew.
	void setRounding(ConeRounding rounding)
	{
		m_rounding = rounding;
		fit();
	}

	double energy() const
	{
		const VectorXd& k = m_now.values;
		return std::max(0.0, k.dot(m_now.gram * k) + 2.0 * m_now.linear.dot(k) + m_startEnergy);
	}
	double distortion() const { return 2.0 * std::sqrt(energy()); }

	/// The same from the factor itself, which has all digits where the sum above cancels.
	double exactDistortion()
	{
		VectorXd rhs = -m_flow.curvature();
		for (int i = 0; i < size(); ++i)
			rhs[m_now.vertices[at(i)]] += m_now.values[i];
		return 2.0 * std::sqrt(m_flow.meanSquare(m_flow.solve(std::move(rhs))));
	}

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
			VectorXd phi = m_start + (m_total - share * i) * m_uniform;
			for (const VectorXd& cone : m_phi)
				phi += share * cone;
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
		const int v = mostGain();
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
				moved |= std::abs(m_now.values[i]) > kNegligible ? relocate(i, present)
																 : replant(i, present);
			if (!moved)
				return;
		}
	}

	/// Moves the cones towards each other where that shortens the least tree that joins them by a
	/// larger share than it raises the distortion, up to \p distortion.
	void shortenTree(double distortion)
	{
		const double most = 0.25 * distortion * distortion;
		std::vector<std::vector<double>> distance;
		for (int v : m_now.vertices)
			distance.push_back(m_flow.distancesFrom(v));
		for (int round = 0; round < kMostSeamRounds; ++round) {
			bool moved = false;
			for (int i = 0; i < size(); ++i)
				moved |= shortenTree(i, most, distance);
			if (!moved)
				return;
		}
	}

	void removeWeak()
	{
		const VectorXd values = m_now.values;
		for (int i = size() - 1; i >= 0; --i)
			if (std::abs(values[i]) <= kLeastCurvature && size() > leastCount())
				remove(i);
		fit();
	}

private:
	/// The quadratic function, and where it is least.
	struct Quadratic
	{
		std::vector<int> vertices;
		VectorXd values; // [cone] radians
		MatrixXd gram;
		VectorXd linear;
	};

	/// Mean square of the factor of a unit of curvature at \p v.
	double ownProduct(int v)
	{
		const auto known = m_ownProduct.find(v);
		if (known != m_ownProduct.end())
			return known->second;
		return m_ownProduct[v] = m_flow.meanSquare(unitFactor(v));
	}

	const VectorXd& unitFactor(int v)
	{
		if (m_lastVertex != v) {
			VectorXd curvature = VectorXd::Zero(m_flow.vertexCount());
			curvature[v] = 1.0;
			m_lastFactor = m_flow.solve(std::move(curvature));
			m_lastVertex = v;
		}
		return m_lastFactor;
	}

	VectorXd gradient() const
	{
		VectorXd phi = m_start;
		for (int i = 0; i < size(); ++i)
			phi += m_now.values[i] * m_phi[at(i)];
		return phi;
	}

	/// The value of the gradient that gains nothing: that at the cones where the sum is fixed.
	double level(const VectorXd& phi) const
	{
		if (!m_flow.hasFixedSum())
			return 0.0;
		if (m_now.vertices.empty())
			return m_flow.area().dot(phi);
		double sum = 0.0;
		int count = 0;
		for (int i = 0; i < size(); ++i)
			if (m_now.values[i] < kMostConeCurvature - 1e-9) {
				sum += phi[m_now.vertices[at(i)]];
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

	/// Where one more cone gains most, or -1.
	int mostGain() const
	{
		VectorXd phi = gradient();
		phi.array() -= level(phi);
		return best(phi, true);
	}

	void append(int v)
	{
		m_isCone[at(v)] = 1;
		insertRow(size(), v);
		m_phi.push_back(m_flow.gradient(unitFactor(v)));
	}

	void remove(int i)
	{
		m_isCone[at(m_now.vertices[at(i)])] = 0;
		removeRow(i);
		m_phi.erase(m_phi.begin() + i);
	}

	/// Vertex, row and column \p i of G, entry i of b; the curvatures stay to be fitted.
	void setRow(int i, int v)
	{
		m_now.vertices[at(i)] = v;
		for (int k = 0; k < size(); ++k)
			if (k != i)
				m_now.gram(i, k) = m_now.gram(k, i) = m_phi[at(k)][v];
		m_now.gram(i, i) = ownProduct(v);
		m_now.linear[i] = m_start[v];
	}

	/// \p i = size() only.
	void insertRow(int i, int v)
	{
		m_now.vertices.push_back(v);
		m_now.gram.conservativeResize(size(), size());
		m_now.linear.conservativeResize(size());
		setRow(i, v);
	}

	void removeRow(int i)
	{
		std::vector<int> kept;
		for (int k = 0; k < size(); ++k)
			if (k != i)
				kept.push_back(k);
		Quadratic smaller;
		const auto n = static_cast<Index>(kept.size());
		smaller.values = VectorXd::Zero(n);
		smaller.gram.resize(n, n);
		smaller.linear.resize(n);
		for (Index a = 0; a < n; ++a) {
			smaller.vertices.push_back(m_now.vertices[at(kept[at(a)])]);
			smaller.linear[a] = m_now.linear[kept[at(a)]];
			for (Index b = 0; b < n; ++b)
				smaller.gram(a, b) = m_now.gram(kept[at(a)], kept[at(b)]);
		}
		m_now = std::move(smaller);
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
		// Moved, not copied: where memory ends, Eigen's resize() leaves what is freed twice.
		m_now.values = VectorXd(VectorXd::Zero(size()));
		for (int attempt = 0; attempt <= size(); ++attempt) {
			std::vector<int> free;
			double total = m_total;
			for (int i = 0; i < size(); ++i) {
				if (!atMost[at(i)])
					free.push_back(i);
				else
					total -= m_now.values[i] = kMostConeCurvature;
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
					system(a, b) = m_now.gram(i, free[at(b)]);
				rhs[a] = -m_now.linear[i];
				for (int k = 0; k < size(); ++k)
					if (atMost[at(k)])
						rhs[a] -= m_now.gram(i, k) * kMostConeCurvature;
			}
			if (rows > n) {
				system.row(n).head(n).setOnes();
				system.col(n).head(n).setOnes();
				rhs[n] = total;
			}
			const VectorXd solution = system.fullPivLu().solve(rhs);
			bool excess = false;
			for (Index a = 0; a < n; ++a) {
				m_now.values[free[at(a)]] = solution[a];
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
			turns[i] = std::min(most, std::round(m_now.values[i] / kQuarterTurn));
		const MatrixXd gram = kQuarterTurn * kQuarterTurn * m_now.gram;
		const VectorXd linear = kQuarterTurn * m_now.linear;
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
		m_now.values = kQuarterTurn * turns;
	}

	/// Moves cone \p i to where it gains most, or else to the best vertex beside it.
	bool relocate(int i, double& present)
	{
		const double own = m_now.values[i];
		const int old = m_now.vertices[at(i)];
		// Half the mean square changes by about own (phi[new] - phi[old]): far away with the field
		// of the others, as the cone's own is alike everywhere, or next to it with the whole field.
		const double enough = 0.5 * kLeastGain * present;
		const VectorXd whole = gradient();
		VectorXd phi = whole - own * m_phi[at(i)];
		if (m_flow.hasFixedSum()) // the cone's curvature lies on the whole surface by area
			phi += own * m_uniform;
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
		return tryMove(i, v, [&](double energy) {
			if (!(energy < (1.0 - kLeastGain) * present))
				return false;
			present = energy;
			return true;
		});
	}

	/// Moves cone \p i to \p v if \p accept takes the energy there.
	template<class Accept>
	bool tryMove(int i, int v, Accept accept)
	{
		Quadratic before = m_now;
		setRow(i, v);
		fit();
		if (!accept(energy())) {
			m_now = std::move(before);
			return false;
		}
		m_isCone[at(before.vertices[at(i)])] = 0;
		m_isCone[at(v)] = 1;
		m_phi[at(i)] = m_flow.gradient(unitFactor(v));
		return true;
	}

	/// Takes a weak cone out and puts it where one more gains most.
	bool replant(int i, double& present)
	{
		if (size() <= leastCount())
			return false;
		const int old = m_now.vertices[at(i)];
		Quadratic before = m_now;
		VectorXd phi = std::move(m_phi[at(i)]);
		remove(i);
		fit();
		const int v = mostGain(); // there is at least the old vertex
		m_now = std::move(before);
		m_phi.insert(m_phi.begin() + i, std::move(phi));
		m_isCone[at(old)] = 1;
		return v != old && move(i, v, present);
	}

	/// Length of the least tree that joins the cones by paths, cone \p skipped left out, or put to
	/// vertex \p instead.
	double
	treeLength(const std::vector<std::vector<double>>& distance, int skipped, int instead) const
	{
		const auto vertexOf = [&](int k) { return k == skipped ? instead : m_now.vertices[at(k)]; };
		std::vector<double> nearest(at(size()), std::numeric_limits<double>::infinity());
		std::vector<char> joined(at(size()), 0);
		int last = skipped == 0 && instead < 0 ? 1 : 0;
		double length = 0.0;
		for (;;) {
			joined[at(last)] = 1;
			int next = -1;
			for (int k = 0; k < size(); ++k) {
				if (joined[at(k)] || (k == skipped && instead < 0))
					continue;
				const double d = last == skipped ? distance[at(k)][at(instead)]
												 : distance[at(last)][at(vertexOf(k))];
				nearest[at(k)] = std::min(nearest[at(k)], d);
				if (next < 0 || nearest[at(k)] < nearest[at(next)])
					next = k;
			}
			if (next < 0)
				return length;
			length += nearest[at(next)];
			last = next;
		}
	}

	bool shortenTree(int i, double most, std::vector<std::vector<double>>& distance)
	{
		const double own = m_now.values[i], present = energy();
		const int old = m_now.vertices[at(i)];
		const double length = treeLength(distance, -1, -1);
		const auto cost = [](double energy, double l) {
			return std::pow(energy, kDistortionWeight) * l;
		};
		const double before = cost(present, length);
		// As in relocate(): the field of the others, as the cone's own is alike everywhere.
		VectorXd phi = gradient() - own * m_phi[at(i)];
		if (m_flow.hasFixedSum())
			phi += own * m_uniform;
		// A prediction that is too good is followed by one with half the room.
		double room = most - present;
		for (int attempt = 0; attempt < kMostAttempts && room > 0.0; ++attempt, room *= 0.5) {
			double least = (1.0 - kLeastSeamGain) * before, expected = 0.0;
			int to = -1;
			for (int v = 0; v < static_cast<int>(phi.size()); ++v) {
				const double energy = present + 2.0 * own * (phi[v] - phi[old]);
				if (m_isCone[at(v)] || !m_flow.isCandidate(v) || energy > present + room)
					continue;
				// Each branch at the cone becomes shorter by no more than the way that it goes.
				const double e = std::max(energy, present);
				if (cost(e, length - kMostBranches * distance[at(i)][at(v)]) >= least)
					continue;
				const double l = treeLength(distance, i, v);
				if (cost(e, l) < least) {
					least = cost(e, l);
					expected = l;
					to = v;
				}
			}
			if (to < 0)
				return false;
			if (tryMove(i, to, [&](double energy) {
					return energy <= most &&
						   cost(energy, expected) < (1.0 - kLeastSeamGain) * before;
				})) {
				distance[at(i)] = m_flow.distancesFrom(to);
				return true;
			}
		}
		return false;
	}

	LinearFlow& m_flow;
	double m_total; ///< 2 pi chi
	ConeRounding m_rounding = ConeRounding::Free;
	std::vector<char> m_isCone; // [vertex]
	Quadratic m_now;
	double m_startEnergy = 0.0;         // without cones
	VectorXd m_start;                   // gradient field without cones
	VectorXd m_uniform;                 // of a unit of curvature spread by area
	std::vector<VectorXd> m_phi;        // of each cone's unit of curvature
	std::map<int, double> m_ownProduct; // of vertices that were tried
	int m_lastVertex = -1;
	VectorXd m_lastFactor;
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
	// The cut of a sphere is the tree of its cones and nothing else.
	if (request.shortSeams && t.eulerCharacteristic() == 2) {
		cones.shortenTree(
			request.count > 0 ? kSeamAllowance * cones.distortion() : request.distortion);
		cones.removeWeak();
	}
	PlacedCones placed;
	placed.distortion = cones.exactDistortion();
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
