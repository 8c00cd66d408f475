// SPDX-License-Identifier: GPL-3.0-or-later
#include "cone_model.h"

#include "../base/task.h"
#include "bounded_minimum.h"
#include "cone_rounding.h"

#include <Eigen/LU>

#include <limits>
#include <numeric>
#include <optional>

namespace ricci {

namespace {

/// The share of a bound that rounding must not add to it.
constexpr double kBoundSlack = 1e-6;

/// An entry of the inverse, or what a row adds to the rank, is one of rounding below this share of what
/// it is the difference of.
constexpr double kMinPivot = 1e-8;

/// An inverse that leaves a larger share of the right-hand side is made anew.
constexpr double kMaxDrift = 1e-6;

constexpr double kUnknown = -std::numeric_limits<double>::infinity();

} // namespace

ConeModel::ConeModel(LinearFlow& flow, double total) :
		m_flow(flow), m_total(total), m_isCone(flow.vertexCount(), 0)
{
	checkpoint();
	m_startFactor = m_flow.factor(VertexVector::Zero(m_flow.vertexCount()));
	m_startEnergy = m_flow.meanSquare(m_startFactor);
}

/// Makes the gradient fields of what is there. From now on cones come with theirs.
void ConeModel::makeFields()
{
	if (hasFields())
		return;
	checkpoint();
	m_uniform = m_flow.gradient(m_flow.solve(m_flow.area()));
	int i = 0;
	for (; i + 1 < size(); i += 2) {
		checkpoint();
		LinearFlow::Pair fields =
			m_flow.gradient({std::move(m_factors[i]), std::move(m_factors[i + 1])});
		for (VertexVector& field : fields)
			m_fields.push_back(std::make_shared<const VertexVector>(std::move(field)));
	}
	if (i < size())
		m_fields.push_back(std::make_shared<const VertexVector>(m_flow.gradient(m_factors[i])));
	m_factors.clear();
	m_start = m_flow.gradient(m_startFactor);
	m_startFactor.resize(0);
}

int ConeModel::minSize() const
{
	if (!hasFixedSum() || m_total == 0.0)
		return 0;
	if (m_total < 0.0)
		return 1;
	return static_cast<int>(std::ceil(m_total / kMaxConeCurvature));
}

VertexVector ConeModel::factor()
{
	VertexVector k = VertexVector::Zero(m_flow.vertexCount());
	for (int i = 0; i < size(); ++i)
		k[vertex(i)] += curvature(i);
	return m_flow.factor(std::move(k));
}

const VertexVector& ConeModel::gradient()
{
	makeFields();
	if (m_gradient.size() == 0) {
		m_gradient = m_start;
		for (int i = 0; i < size(); ++i)
			m_gradient += curvature(i) * *m_fields[i];
	}
	return m_gradient;
}

VertexVector ConeModel::gradientWithShares(double share)
{
	makeFields();
	VertexVector phi = m_start + (m_total - share * size()) * m_uniform;
	for (const Field& field : m_fields)
		phi += share * *field;
	return phi;
}

void ConeModel::append(Vertex v)
{
	append(v, unitFactor(v));
}

void ConeModel::append(const std::vector<Vertex>& vertices)
{
	std::size_t i = 0;
	for (; i + 1 < vertices.size(); i += 2) {
		checkpoint();
		LinearFlow::Pair u = m_flow.solve({unit(vertices[i]), unit(vertices[i + 1])});
		for (std::size_t k = 0; k < 2; ++k) {
			m_ownProduct[vertices[i + k]] = m_flow.meanSquare(u[k]);
			append(vertices[i + k], std::move(u[k]));
		}
	}
	if (i < vertices.size())
		append(vertices[i]);
}

/// \param factor of a unit of curvature at \p v
void ConeModel::append(Vertex v, VertexVector factor)
{
	const int i = size();
	m_isCone[v] = 1;
	m_now.vertices.push_back(v);
	m_now.gram.conservativeResize(size(), size());
	m_now.linear.conservativeResize(size());
	const int rows = size() + border();
	if (m_now.inverse.rows() == rows - 1) {
		m_now.inverse.conservativeResize(rows, rows);
		m_now.inverse.row(rows - 1).setZero();
		m_now.inverse.col(rows - 1).setZero();
	}
	if (hasFields()) {
		setRow(i, v);
		m_fields.push_back(std::make_shared<const VertexVector>(m_flow.gradient(factor)));
	}
	else {
		for (int k = 0; k < i; ++k)
			m_now.gram(i, k) = m_now.gram(k, i) = m_flow.meanProduct(m_factors[k], factor);
		m_now.gram(i, i) = ownProduct(v);
		m_now.linear[i] = m_flow.meanProduct(m_startFactor, factor);
		m_factors.push_back(std::move(factor));
	}
	join(i);
	m_gradient.resize(0);
}

void ConeModel::remove(int i)
{
	m_isCone[vertex(i)] = 0;
	removeRow(i);
	if (hasFields())
		m_fields.values().erase(m_fields.begin() + i);
	else
		m_factors.values().erase(m_factors.begin() + i);
	m_gradient.resize(0);
}

double ConeModel::need(int i)
{
	if (m_now.inverse.rows() == 0)
		invert();
	const double pivot = m_now.inverse(i + border(), i + border());
	return pivot > 0.0 ? curvature(i) * curvature(i) / pivot : std::numeric_limits<double>::max();
}

std::vector<int> ConeModel::byNeed()
{
	std::vector<int> cones(positionOf(size()));
	std::iota(cones.begin(), cones.end(), 0);
	std::stable_sort(cones.begin(), cones.end(), [&](int a, int b) { return need(a) < need(b); });
	return cones;
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
	m_now.isFree = false;
	const auto total = hasFixedSum() ? std::optional<double>(m_total) : std::nullopt;
	if (size() > 0) {
		Eigen::VectorXd rhs(size() + border()), solution;
		rhs.head(border()).setConstant(m_total);
		rhs.tail(size()) = -m_now.linear;
		for (const bool isNew : {false, true}) {
			if (isNew || m_now.inverse.rows() == 0)
				invert();
			solution = m_now.inverse * rhs;
			const Eigen::VectorXd rest = rhs - times(solution);
			if (rest.norm() <= kMaxDrift * rhs.norm()) {
				solution += m_now.inverse * rest;
				break;
			}
		}
		m_now.values = Eigen::VectorXd(solution.tail(size()));
		m_now.level = border() > 0 ? solution[0] : 0.0;
		m_now.isFree = m_rounding == ConeRounding::Free && solution.allFinite() &&
					   m_now.values.maxCoeff() <= kMaxConeCurvature;
	}
	if (!m_now.isFree)
		m_now.values = boundedMinimum(m_now.gram, m_now.linear, kMaxConeCurvature, total);
	if (m_rounding == ConeRounding::QuarterTurns && size() > 0)
		m_now.values = roundToQuarterTurns(m_now.gram, m_now.linear, m_now.values, total);
}

/// The matrix of the fit times \p x: G, with a first row and column of ones where the sum is fixed.
Eigen::VectorXd ConeModel::times(const Eigen::VectorXd& x) const
{
	Eigen::VectorXd result(x.size());
	result.tail(size()) = m_now.gram * x.tail(size());
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
	Eigen::VectorXd moved = m_now.inverse * column;
	const double own = m_now.gram(i, i), beyond = own - column.dot(moved);
	if (!(beyond > kMinPivot * own)) {
		m_now.inverse.resize(0, 0);
		return;
	}
	moved[row] = -1.0;
	m_now.inverse.noalias() += moved * (moved.transpose() / beyond);
}

/// Products of the factor of a unit of curvature at \p v with those of the cones, as a column of the
/// matrix of the fit.
Eigen::VectorXd ConeModel::column(Vertex v) const
{
	Eigen::VectorXd result(size() + border());
	result.head(border()).setOnes();
	for (int k = 0; k < size(); ++k)
		result[k + border()] = (*m_fields[k])[v];
	return result;
}

/// A bound of ownProduct(\p v) from below without a linear solution: u_v is no shorter than its
/// distance from what the cones span.
double ConeModel::minOwnProduct(Vertex v) const
{
	const auto known = m_ownProduct.find(v);
	if (known != m_ownProduct.end())
		return known->second;
	if (!m_now.isFree || m_now.inverse.rows() == 0)
		return 0.0;
	const Eigen::VectorXd products = column(v);
	return (1.0 - kBoundSlack) * products.dot(m_now.inverse * products);
}

/// A bound from below of the energy with cone \p i at \p v instead, by the minimum without bounds of
/// curvatures.
/// \param ownProduct of \p v, or less
/// \return the lowest number where there is none: the curvatures are not at that minimum, or \p v adds
/// nothing to the other cones
double ConeModel::minEnergyAt(int i, Vertex v, double ownProduct) const
{
	if (!m_now.isFree || m_now.inverse.rows() == 0)
		return kUnknown;
	const int row = i + border();
	const Eigen::VectorXd products = column(v), left = m_now.inverse.col(row);
	if (!(left[row] > 0.0))
		return kUnknown;
	const double along = left.dot(products), k = curvature(i);
	const double beyond =
		ownProduct - products.dot(m_now.inverse * products) + along * along / left[row];
	if (!(beyond > kMinPivot * ownProduct))
		return kUnknown;
	// Half the slope at v when the others have made up for cone i.
	double slope = m_start[v] + products.tail(size()).dot(m_now.values) - along * k / left[row];
	slope += border() > 0 ? m_now.level : 0.0;
	return energy() + k * k / left[row] - slope * slope / beyond;
}

/// Mean square of the factor of a unit of curvature at \p v.
double ConeModel::ownProduct(Vertex v)
{
	const auto known = m_ownProduct.find(v);
	if (known != m_ownProduct.end())
		return known->second;
	return m_ownProduct[v] = m_flow.meanSquare(unitFactor(v));
}

/// A unit of curvature at \p v.
VertexVector ConeModel::unit(Vertex v) const
{
	VertexVector k = VertexVector::Zero(m_flow.vertexCount());
	k[v] = 1.0;
	return k;
}

/// Factor of a unit of curvature at \p v.
const VertexVector& ConeModel::unitFactor(Vertex v)
{
	if (m_lastVertex != v) {
		checkpoint();
		m_lastFactor = m_flow.solve(unit(v));
		m_lastVertex = v;
	}
	return m_lastFactor;
}

ConeModel::Field ConeModel::fieldOf(Vertex v)
{
	return std::make_shared<const VertexVector>(m_flow.gradient(unitFactor(v)));
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

/// Puts cone \p i to \p v: row and column i of G, and entry i of b.
/// \pre all other cones have their fields in m_fields
void ConeModel::setRow(int i, Vertex v)
{
	m_now.vertices[i] = v;
	for (int k = 0; k < size(); ++k)
		if (k != i)
			m_now.gram(i, k) = m_now.gram(k, i) = (*m_fields[k])[v];
	m_now.gram(i, i) = ownProduct(v);
	m_now.linear[i] = m_start[v];
}

void ConeModel::removeRow(int i)
{
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
	m_now.values = Eigen::VectorXd(Eigen::VectorXd::Zero(size()));
	m_now.isFree = false;
}

} // namespace ricci
