// SPDX-License-Identifier: GPL-3.0-or-later
#include "cone_model.h"

#include "../base/numbers.h"
#include "../base/task.h"
#include "../base/tolerances.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <optional>

namespace ricci {

namespace {

/// An entry of the inverse, or what a row adds to the rank, is one of rounding below this share of what
/// it is the difference of.
constexpr double kMinPivot = 1e-8;

/// An inverse that leaves a larger share of the right-hand side after so many refinements is computed again.
constexpr double kMaxRest = 1e-11;
constexpr int kMaxRefinements = 8;

/// By this share the diagonal of G is raised where that does not help, either: cones that do the same are told
/// apart by it.
constexpr double kTwinShare = 1e-6;

/// So many fields add up about as fast as the two linear solutions that give the same sum.
constexpr int kFieldsOfASolution = 64;

} // namespace

VertexVector
spreadOut(const std::vector<Vertex>& cones, const Eigen::VectorXd& curvatures, int vertexCount)
{
	VertexVector whole = VertexVector::Zero(vertexCount);
	for (std::size_t i = 0; i < cones.size(); ++i)
		whole[cones[i]] += curvatures[static_cast<Eigen::Index>(i)];
	return whole;
}

int minConeCount(const LinearFlow& flow, double total)
{
	if (!flow.hasFixedSum() || total == 0.0)
		return 0;
	if (total < 0.0)
		return 1;
	return static_cast<int>(std::ceil(total / kMaxConeCurvature));
}

ConeModel::ConeModel(LinearFlow& flow, double total, double energyFactor, VertexVector ofSurface) :
		m_flow(flow), m_total(total), m_energyFactor(energyFactor),
		m_ofSurface(std::move(ofSurface)), m_isCone(flow.vertexCount(), 0)
{
	checkpoint();
	const VertexVector none = VertexVector::Zero(m_flow.vertexCount());
	const VertexVector u =
		m_flow.factor(hasFixedSum() ? VertexVector(total * m_flow.area()) : none);
	m_startEnergy = m_now.fit.energy = m_flow.meanSquare(u);
	m_start = centred(m_flow.gradient(u));
	if (hasFixedSum())
		m_evenFactor = m_flow.solve(m_flow.area());
}

/// The field less its mean, where it is known up to a constant.
VertexVector ConeModel::centred(VertexVector field) const
{
	if (hasFixedSum())
		field.array() -= m_flow.area().dot(field);
	return field;
}

VertexVector ConeModel::factor()
{
	return m_flow.factor(spreadOut(vertices(), m_now.fit.values, m_flow.vertexCount()));
}

/// From the fields or, where there are many, by solutions that cost the same for any number.
VertexVector ConeModel::gradientAt(const Eigen::VectorXd& k)
{
	if (size() > kFieldsOfASolution)
		return centred(
			m_flow.gradient(m_flow.factor(spreadOut(vertices(), k, m_flow.vertexCount()))));
	VertexVector phi = m_start;
	for (int i = 0; i < size(); ++i)
		phi += k[i] * *m_fields[i];
	return phi;
}

const VertexVector& ConeModel::gradient()
{
	if (m_gradient.size() == 0)
		m_gradient = gradientAt(m_now.fit.values);
	return m_gradient;
}

VertexVector ConeModel::gradientWithout(int i)
{
	Eigen::VectorXd k = m_now.fit.values;
	if (const Eigen::VectorXd step = descent(Eigen::VectorXd::Unit(size(), i)); step[i] > 0.0)
		k -= step * (k[i] / step[i]);
	k[i] = 0.0;
	return gradientAt(k);
}

void ConeModel::append(const std::vector<Vertex>& vertices)
{
	const int before = size();
	for (const Vertex v : vertices) {
		m_now.vertices.push_back(v);
		m_isCone[v] = 1;
	}
	for (std::size_t i = 0; i < vertices.size(); i += 2) {
		const std::vector<Vertex> two(
			vertices.data() + i, vertices.data() + std::min(i + 2, vertices.size()));
		const Eigen::MatrixXd u = unitFactors(two), fields = m_flow.gradient(u);
		for (Eigen::Index k = 0; k < u.cols(); ++k) {
			m_ownProduct[two[static_cast<std::size_t>(k)]] = m_flow.meanSquare(u.col(k));
			m_fields.push_back(std::make_shared<const VertexVector>(centred(fields.col(k))));
		}
	}
	m_now.gram.conservativeResize(size(), size());
	m_now.linear.conservativeResize(size());
	m_now.fit.multipliers.conservativeResize(size());
	m_now.fit.multipliers.tail(size() - before).setZero();
	if (const Eigen::Index rows = m_now.inverse.rows(); rows > 0) {
		const Eigen::Index more = size() - before;
		m_now.inverse.conservativeResize(rows + more, rows + more);
		m_now.inverse.bottomRows(more).setZero();
		m_now.inverse.rightCols(more).setZero();
	}
	for (int i = before; i < size(); ++i)
		setRow(i, vertex(i));
	for (int i = before; i < size(); ++i)
		join(i);
	m_gradient.resize(0);
}

void ConeModel::remove(int i)
{
	m_isCone[vertex(i)] = 0;
	m_fields.values().erase(m_fields.begin() + i);
	m_gradient.resize(0);
	leave(i);
	m_now.vertices.values().erase(m_now.vertices.begin() + i);
	// The last rows and columns move up.
	const auto erase = [](Eigen::MatrixXd& matrix, int row) {
		const Eigen::Index last = matrix.rows() - 1, left = last - row;
		matrix.block(row, 0, left, last + 1) = matrix.bottomRows(left).eval();
		matrix.block(0, row, last + 1, left) = matrix.rightCols(left).eval();
		matrix.conservativeResize(last, last);
	};
	erase(m_now.gram, i);
	if (m_now.inverse.rows() > 0)
		erase(m_now.inverse, i + border());
	const Eigen::Index left = size() - i;
	m_now.linear.segment(i, left) = m_now.linear.tail(left).eval();
	m_now.linear.conservativeResize(size());
	Eigen::VectorXd& m = m_now.fit.multipliers;
	m.segment(i, left) = m.tail(left).eval();
	m.conservativeResize(size());
}

Eigen::VectorXd ConeModel::descent(const Eigen::VectorXd& rest)
{
	if (m_now.inverse.rows() == 0)
		invert();
	Eigen::VectorXd whole = Eigen::VectorXd::Zero(size() + border());
	whole.tail(size()) = rest;
	return change(whole).tail(size());
}

/// The cones that their bound holds.
std::vector<int> ConeModel::heldCones() const
{
	std::vector<int> held;
	for (int i = 0; i < size(); ++i)
		if (m_now.fit.multipliers[i] > 0.0)
			held.push_back(i);
	return held;
}

/// The change of the minimum, as the solution of the fit, if the right side changes by \p rest and cones at their
/// bound stay there.
Eigen::VectorXd ConeModel::change(const Eigen::VectorXd& rest) const
{
	const std::vector<int> held = heldCones();
	const auto inverse = symmetric(m_now.inverse);
	Eigen::VectorXd whole = rest;
	whole.tail(size()) -= multipliers(
		m_now.inverse.bottomRightCorner(size(), size()), held, (inverse * rest).tail(size()));
	Eigen::VectorXd result = inverse * whole;
	for (const int i : held)
		result[i + border()] = 0.0;
	return result;
}

Eigen::VectorXd ConeModel::needs()
{
	if (m_now.inverse.rows() == 0)
		invert();
	const std::vector<int> held = heldCones();
	const Eigen::MatrixXd inverse = m_now.inverse.bottomRightCorner(size(), size());
	const Eigen::LLT<Eigen::MatrixXd> among(inverse(held, held));
	Eigen::VectorXd pivots = inverse.diagonal();
	if (!held.empty()) {
		pivots -=
			among.matrixL().solve(inverse(held, Eigen::all)).colwise().squaredNorm().transpose();
		const auto count = static_cast<Eigen::Index>(held.size());
		pivots(held) =
			among.solve(Eigen::MatrixXd::Identity(count, count)).diagonal().cwiseInverse();
	}
	const Eigen::ArrayXd k = curvatures();
	return (pivots.array() > 0.0)
		.select(k * (k / pivots.array() + 2.0 * m_now.fit.multipliers.array()), kInfinity);
}

void ConeModel::setRounding(ConeRounding rounding)
{
	if (rounding == m_rounding)
		return;
	m_rounding = rounding;
	fit();
}

void ConeModel::fit()
{
	m_gradient.resize(0);
	Fit& fit = m_now.fit;
	findMinimum();
	fit.values = Eigen::VectorXd(fit.minimum); // see restore()
	fit.energy = fit.lowest;
	if (m_rounding == ConeRounding::QuarterTurns && size() > 0) {
		const auto total = hasFixedSum() ? std::optional<double>(m_total) : std::nullopt;
		fit.values = roundToQuarterTurns(m_now.gram, m_now.linear, fit.values, total);
		fit.energy = energyOf(fit.values);
	}
}

/// Finds the minimum without rounding.
void ConeModel::findMinimum()
{
	Fit& fit = m_now.fit;
	if (size() < std::max(1, minSize())) {
		fit.minimum = Eigen::VectorXd(Eigen::VectorXd::Constant(size(), kMaxConeCurvature));
		fit.lowest = energyOf(fit.minimum);
		m_now.inverse.resize(0, 0);
		return;
	}
	Eigen::VectorXd solution = unboundedMinimum();
	Eigen::VectorXd most(size());
	for (int i = 0; i < size(); ++i)
		most[i] = maxCurvature(vertex(i));
	const Eigen::VectorXd excess = solution.tail(size()) - most;
	fit.multipliers = boundMultipliers(
		m_now.inverse.bottomRightCorner(size(), size()), excess, std::move(fit.multipliers));
	if (fit.multipliers.maxCoeff() > 0.0) {
		solution -= m_now.inverse.rightCols(size()) * fit.multipliers;
		for (int i = 0; i < size(); ++i)
			if (fit.multipliers[i] > 0.0)
				solution[i + border()] = most[i];
		solution += change(rightSide() - times(solution));
	}
	fit.minimum = Eigen::VectorXd(solution.tail(size()).cwiseMin(most));
	fit.lowest = energyOf(fit.minimum);
	fit.level = border() > 0 ? solution[0] : 0.0;
}

/// The solution of the fit without bounds, by an inverse that is computed again if it has lost digits, of a matrix
/// with kTwinShare if it loses them at once.
Eigen::VectorXd ConeModel::unboundedMinimum()
{
	const Eigen::VectorXd rhs = rightSide();
	for (int attempt = 0;; ++attempt) {
		if (attempt == 2)
			m_now.gram.diagonal() *= 1.0 + kTwinShare;
		if (attempt > 0 || m_now.inverse.rows() == 0)
			invert();
		const auto inverse = symmetric(m_now.inverse);
		Eigen::VectorXd solution = inverse * rhs, rest = rhs - times(solution);
		for (int step = 0; step < kMaxRefinements && rest.norm() > kMaxRest * rhs.norm(); ++step) {
			solution += inverse * rest;
			rest = rhs - times(solution);
		}
		if (attempt == 2 || rest.norm() <= kMaxRest * rhs.norm())
			return solution;
	}
}

/// The right side of the fit.
Eigen::VectorXd ConeModel::rightSide() const
{
	Eigen::VectorXd rhs(size() + border());
	rhs.head(border()).setConstant(m_total);
	rhs.tail(size()) = -m_now.linear;
	return rhs;
}

/// The matrix of the fit times \p x: G, with a first row and column of ones where the sum is fixed.
Eigen::VectorXd ConeModel::times(const Eigen::VectorXd& x) const
{
	Eigen::VectorXd result(x.size());
	result.tail(size()) = symmetric(m_now.gram) * x.tail(size());
	if (border() > 0) {
		result[0] = x.tail(size()).sum();
		result.tail(size()).array() += x[0];
	}
	return result;
}

/// Inverts the matrix of the fit.
void ConeModel::invert()
{
	const int rows = size() + border();
	Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows, rows);
	matrix.bottomRightCorner(size(), size()) = m_now.gram;
	matrix.topRightCorner(border(), size()).setOnes();
	matrix.bottomLeftCorner(size(), border()).setOnes();
	m_now.inverse = Eigen::MatrixXd(matrix.partialPivLu().inverse());
}

/// Takes row and column \p i out of what is inverted: they become 0 in the inverse.
void ConeModel::leave(int i)
{
	if (m_now.inverse.rows() == 0)
		return;
	const int row = i + border();
	const Eigen::VectorXd own = m_now.inverse.col(row);
	if (!(own[row] > kMinPivot * own.cwiseAbs().maxCoeff())) {
		m_now.inverse.resize(0, 0);
		return;
	}
	m_now.inverse.noalias() -= own * (own.transpose() / own[row]);
	m_now.inverse.row(row).setZero();
	m_now.inverse.col(row).setZero();
}

/// Takes row and column \p i of G into what is inverted, where the inverse has zeros.
void ConeModel::join(int i)
{
	if (m_now.inverse.rows() == 0)
		return;
	const int row = i + border();
	Eigen::VectorXd column(m_now.inverse.rows());
	column.head(border()).setOnes();
	column.tail(size()) = m_now.gram.col(i);
	column[row] = 0.0;
	Eigen::VectorXd moved = symmetric(m_now.inverse) * column;
	const double own = m_now.gram(i, i), beyond = own - column.dot(moved);
	if (!(beyond > kMinPivot * own)) {
		m_now.inverse.resize(0, 0);
		return;
	}
	moved[row] = -1.0;
	m_now.inverse.noalias() += moved * (moved.transpose() / beyond);
}

/// A bound from below of the energy with cone \p i at \p v instead, by the minimum without bounds of
/// curvatures and without rounding.
/// \return the lowest number where there is none: that minimum is not known, or the vertex adds nothing to
/// the other cones
double ConeModel::minEnergyAt(int i, Vertex v) const
{
	const Fit& fit = m_now.fit;
	const int row = i + border();
	const double pivot = m_now.inverse.rows() > 0 ? m_now.inverse(row, row) : 0.0;
	const double unknown = -kInfinity;
	if (!(pivot > 0.0))
		return unknown;
	// Of the vertex' u with those of the cones, as a column of the matrix of the fit.
	Eigen::VectorXd products(size() + border());
	products.head(border()).setOnes();
	for (int k = 0; k < size(); ++k)
		products[k + border()] = (*m_fields[k])[v];
	// The mean square of what of it lies in what the cones span: all of it has no less, and where no linear
	// solution has told more, that is the bound. Rounding must not raise it.
	const double span = products.dot(symmetric(m_now.inverse) * products);
	const auto known = m_ownProduct.find(v);
	const double own = known != m_ownProduct.end() ? known->second : (1.0 - kSmall) * span;
	const double along = m_now.inverse.col(row).dot(products), k = fit.minimum[i];
	const double beyond = own - span + along * along / pivot;
	if (!(beyond > kMinPivot * own))
		return unknown;
	// Half the slope at the vertex when the others have made up for cone i.
	double slope = m_start[v] + products.tail(size()).dot(fit.minimum) - along * k / pivot;
	slope += border() > 0 ? fit.level : 0.0;
	return fit.lowest + k * (k / pivot + 2.0 * fit.multipliers[i]) - slope * slope / beyond;
}

/// Finds m_ownProduct of two vertices, or of one that is given twice: two take little longer than one.
void ConeModel::learn(Vertex v, Vertex w)
{
	std::vector<Vertex> unknown;
	for (const Vertex next : {v, w})
		if (m_ownProduct.count(next) == 0 && (unknown.empty() || next != v))
			unknown.push_back(next);
	if (unknown.empty())
		return;
	m_lastFactors = unitFactors(unknown);
	m_lastVertices = std::move(unknown);
	for (std::size_t k = 0; k < m_lastVertices.size(); ++k)
		m_ownProduct[m_lastVertices[k]] =
			m_flow.meanSquare(m_lastFactors.col(static_cast<Eigen::Index>(k)));
}

/// Factors of a unit of curvature at each of one or two vertices, taken from the whole surface by area where
/// the sum is fixed. Right sides of one entry reach few rows.
Eigen::MatrixXd ConeModel::unitFactors(const std::vector<Vertex>& vertices)
{
	checkpoint();
	const auto count = static_cast<Eigen::Index>(vertices.size());
	Eigen::MatrixXd units = Eigen::MatrixXd::Zero(m_flow.vertexCount(), count);
	for (Eigen::Index k = 0; k < count; ++k)
		units(vertices[static_cast<std::size_t>(k)].number(), k) = 1.0;
	Eigen::MatrixXd u = m_flow.solve(std::move(units));
	if (hasFixedSum())
		u.colwise() -= m_evenFactor;
	return u;
}

ConeModel::Field ConeModel::fieldOf(Vertex v)
{
	const auto known = std::find(m_lastVertices.begin(), m_lastVertices.end(), v);
	const VertexVector u = known != m_lastVertices.end()
							   ? m_lastFactors.col(known - m_lastVertices.begin())
							   : unitFactors({v}).col(0);
	return std::make_shared<const VertexVector>(centred(m_flow.gradient(u)));
}

/// Back to what the cones were.
void ConeModel::restore(const State& state, const Array<Field>& fields)
{
	for (const Vertex v : m_now.vertices)
		m_isCone[v] = 0;
	// Eigen frees what it assigns to before it asks for other memory, which may fail.
	m_now = State(state);
	m_fields = fields;
	for (const Vertex v : m_now.vertices)
		m_isCone[v] = 1;
	m_gradient.resize(0);
}

/// Puts cone \p i to \p v, except for its field.
void ConeModel::put(int i, Vertex v)
{
	leave(i);
	setRow(i, v);
	join(i);
}

/// Puts cone \p i to \p v: row and column i of G, and entry i of b.
/// \pre all other cones have their fields in m_fields
void ConeModel::setRow(int i, Vertex v)
{
	m_now.vertices[i] = v;
	for (int k = 0; k < size(); ++k)
		if (k != i)
			m_now.gram(i, k) = m_now.gram(k, i) = (*m_fields[k])[v];
	learn(v, v);
	m_now.gram(i, i) = m_ownProduct.at(v);
	m_now.linear[i] = m_start[v];
}

} // namespace ricci
