// SPDX-License-Identifier: GPL-3.0-or-later
#include "cone_model.h"

#include "../base/task.h"
#include "bounded_minimum.h"
#include "cone_rounding.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <numeric>
#include <optional>

namespace ricci {

namespace {

/// The share of a bound that rounding must not add to it; and the least that the cone that moves must
/// give to it, so that the quadratic function stays convex.
constexpr double kBoundSlack = 1e-6, kMinBeyond = 1e-4;

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
	if (hasFields()) {
		setRow(i, v, ownProduct(v));
		m_fields.push_back(std::make_shared<const VertexVector>(m_flow.gradient(factor)));
	}
	else {
		for (int k = 0; k < i; ++k)
			m_now.gram(i, k) = m_now.gram(k, i) = m_flow.meanProduct(m_factors[k], factor);
		m_now.gram(i, i) = ownProduct(v);
		m_now.linear[i] = m_flow.meanProduct(m_startFactor, factor);
		m_factors.push_back(std::move(factor));
	}
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

std::vector<int> ConeModel::byNeed() const
{
	const int n = size(), rows = n + (hasFixedSum() ? 1 : 0);
	Eigen::MatrixXd system = Eigen::MatrixXd::Zero(rows, rows);
	system.topLeftCorner(n, n) = m_now.gram;
	if (rows > n) {
		system.row(n).head(n).setOnes();
		system.col(n).head(n).setOnes();
	}
	const Eigen::MatrixXd inverse = system.fullPivLu().inverse();
	std::vector<int> cones(positionOf(n));
	std::iota(cones.begin(), cones.end(), 0);
	std::stable_sort(cones.begin(), cones.end(), [&](int a, int b) {
		return curvature(a) * curvature(a) / inverse(a, a) <
			   curvature(b) * curvature(b) / inverse(b, b);
	});
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
	const auto total = hasFixedSum() ? std::optional<double>(m_total) : std::nullopt;
	m_now.values = boundedMinimum(m_now.gram, m_now.linear, kMaxConeCurvature, total);
	if (m_rounding == ConeRounding::QuarterTurns && size() > 0)
		m_now.values = roundToQuarterTurns(m_now.gram, m_now.linear, m_now.values, total);
}

/// A bound of ownProduct(\p v) from below without a linear solution, with which cone \p i has a lowest
/// energy at \p v that is no higher than the true one: u_v is no shorter than its projection to the span
/// of the factors of the cones.
/// \return 0 where there is nothing to gain: the product is known, curvatures are rounded, which are not
/// at the minimum, or the span is about that of the other cones
double ConeModel::minOwnProduct(int i, Vertex v) const
{
	if (m_rounding != ConeRounding::Free || v == m_lastVertex ||
		m_ownProduct.find(v) != m_ownProduct.end())
		return 0.0;
	Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(size(), 2);
	for (int k = 0; k < size(); ++k)
		rhs(k, 0) = (*m_fields[k])[v];
	rhs(i, 1) = 1.0;
	const Eigen::MatrixXd solution = m_now.gram.ldlt().solve(rhs);
	const double bound = rhs.col(0).dot(solution.col(0));
	const double beyondOthers = solution(i, 0) * solution(i, 0) / solution(i, 1);
	return beyondOthers > kMinBeyond * bound ? (1.0 - kBoundSlack) * bound : 0.0;
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
	m_now = state;
	m_fields = fields;
	for (const Vertex v : m_now.vertices)
		m_isCone[v] = 1;
	m_gradient.resize(0);
}

/// Puts cone \p i to \p v: row and column i of G, and entry i of b.
/// \pre all other cones have their fields in m_fields
void ConeModel::setRow(int i, Vertex v, double ownProduct)
{
	m_now.vertices[i] = v;
	for (int k = 0; k < size(); ++k)
		if (k != i)
			m_now.gram(i, k) = m_now.gram(k, i) = (*m_fields[k])[v];
	m_now.gram(i, i) = ownProduct;
	m_now.linear[i] = m_start[v];
}

void ConeModel::removeRow(int i)
{
	std::vector<int> kept;
	for (int k = 0; k < size(); ++k)
		if (k != i)
			kept.push_back(k);
	const auto n = static_cast<int>(kept.size());
	State smaller;
	smaller.values = Eigen::VectorXd::Zero(n);
	smaller.gram.resize(n, n);
	smaller.linear.resize(n);
	for (int a = 0; a < n; ++a) {
		const int from = kept[positionOf(a)];
		smaller.vertices.push_back(m_now.vertices[from]);
		smaller.linear[a] = m_now.linear[from];
		for (int b = 0; b < n; ++b)
			smaller.gram(a, b) = m_now.gram(from, kept[positionOf(b)]);
	}
	m_now = std::move(smaller);
}

} // namespace ricci
