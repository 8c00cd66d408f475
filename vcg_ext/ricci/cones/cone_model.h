// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONE_MODEL_H
#define RICCI_CONE_MODEL_H

#include "../flow/target.h"
#include "cone_curvatures.h"
#include "cone_sites.h"
#include "linear_flow.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace ricci {

/// Curvatures of some cones as those of all \p vertexCount vertices.
VertexVector
spreadOut(const std::vector<Vertex>& cones, const Eigen::VectorXd& curvatures, int vertexCount);

/// The smallest number of cones that can carry the curvature \p total on the surface of \p flow.
int minConeCount(const LinearFlow& flow, double total);

/// The cones chosen so far, with the quadratic function that their curvatures k minimise: the mean
/// square of u (the L2 distortion of [Soliman Slepcev Crane 2018]),
///
///     E(k) = k.G k + 2 b.k + E(0).
///
/// Where the sum of the curvatures is fixed, each is taken from the whole surface by area, and without cones
/// the surface has the total in that way: no other vertex plays a part, at which u may be anything. With u_v
/// the factor of a unit of curvature at v, and phi_j the gradient field of u_j (see LinearFlow, with mean 0
/// where it is known up to a constant), the mean of u_v u_j is phi_j(v). A trial of a vertex therefore costs one linear
/// solution, that of its own u for the diagonal of G, and none if the vertex was tried before or a bound
/// tells enough.
class ConeModel
{
public:
	/// No cones yet.
	/// \param total 2 pi chi, what the curvatures add up to where their sum is fixed
	/// \param energyFactor see TargetRequest
	/// \param ofSurface [vertex] curvature of the surface there, which a cone may keep; none: see maxCurvature()
	ConeModel(
		LinearFlow& flow, double total, double energyFactor = 1.0, VertexVector ofSurface = {});

	/// That of a cone at \p v: where the surface itself has more than kMaxConeCurvature, as at the tip of a spire, as
	/// much as it has.
	double maxCurvature(Vertex v) const
	{
		return m_ofSurface.size() > 0 ? std::max(kMaxConeCurvature, m_ofSurface[v])
									  : kMaxConeCurvature;
	}

	int size() const { return m_now.vertices.size(); }
	Vertex vertex(int i) const { return m_now.vertices[i]; }
	const std::vector<Vertex>& vertices() const { return m_now.vertices.values(); }
	bool isCone(Vertex v) const { return m_isCone[v] != 0; }

	/// Curvature of cone \p i in radians, by the last fit.
	double curvature(int i) const { return m_now.fit.values[i]; }
	const Eigen::VectorXd& curvatures() const { return m_now.fit.values; }

	bool hasFixedSum() const { return m_flow.hasFixedSum(); }
	double total() const { return m_total; }

	/// The smallest number of cones that can carry the total curvature.
	int minSize() const { return minConeCount(m_flow, m_total); }

	/// Share of each vertex in the surface's area.
	const VertexVector& area() const { return m_flow.area(); }

	/// E at the curvatures, rounding kept from making it negative.
	double energy() const { return m_now.fit.energy; }

	/// What so much of E costs, see MapCost.
	double priceOf(double energy) const { return m_energyFactor * kEnergyPrice * energy; }

	/// Standard deviation of 2 u by area.
	double distortion() const { return 2.0 * std::sqrt(energy()); }

	/// The factor u of the metric with these cones, with mean 0 by area.
	VertexVector factor();

	/// distortion() from the factor itself, which has all digits where the sum of energy() cancels.
	double exactDistortion() { return 2.0 * std::sqrt(m_flow.meanSquare(factor())); }

	/// Derivative of half the energy by the curvature of a cone at each vertex, up to a constant
	/// where the sum is fixed.
	const VertexVector& gradient();

	/// gradient() as it would be with the curvatures \p k; where the sum is fixed, what they lack of it
	/// would lie on the whole surface in proportion to area.
	VertexVector gradientAt(const Eigen::VectorXd& k);

	/// gradient() as it would be without cone \p i, if those at their bound stay there and no other comes to it.
	VertexVector gradientWithout(int i);

	/// What a unit of curvature at cone \p i adds to the gradient. Where the sum is fixed, it is taken from the
	/// whole surface in proportion to area.
	const VertexVector& field(int i) const { return *m_fields[i]; }

	/// Takes more cones in; curvatures have to be fitted. Two take little longer than one.
	void append(const std::vector<Vertex>& vertices);

	/// Takes cone \p i out; the curvatures of the others have to be fitted.
	void remove(int i);

	/// Sets how curvatures are rounded, and fits them again if that is not how they were.
	void setRounding(ConeRounding rounding);

	/// Puts the curvatures to their best values, with the sum fixed where it is and none above
	/// maxCurvature(), rounded as set. All have kMaxConeCurvature if they are fewer than minSize().
	void fit();

	/// Moves cone \p i to the first of \p places with \p isLow(place, energy there), with the curvatures fitted.
	/// Most trials fail, and nearly all of those by bounds of the energy that need no fit, and many no
	/// linear solution.
	/// \param isLow holds for every energy below one for which it holds at the same place
	/// \return whether the cone has moved
	template<class IsLow>
	bool tryMove(int i, const std::vector<Vertex>& places, const IsLow& isLow)
	{
		std::vector<Vertex> likely;
		for (const Vertex v : places)
			if (isLow(v, minEnergyAt(i, v)))
				likely.push_back(v);
		const Vertex old = vertex(i);
		for (std::size_t k = 0; k < likely.size(); ++k) {
			const Vertex v = likely[k];
			if (k % 2 == 0)
				learn(v, likely[std::min(k + 1, likely.size() - 1)]);
			if (!isLow(v, minEnergyAt(i, v)))
				continue;
			const Fit before = m_now.fit;
			VertexVector gradient = std::move(m_gradient);
			put(i, v);
			fit();
			if (isLow(v, energy())) {
				m_isCone[old] = 0;
				m_isCone[v] = 1;
				m_fields[i] = fieldOf(v);
				return true;
			}
			put(i, old);
			m_now.fit = Fit(before);
			m_gradient = std::move(gradient);
		}
		return false;
	}

	/// The change of the curvatures below their bound that has the slope \p rest of half the energy, up to a
	/// constant where the sum is fixed: that then stays.
	Eigen::VectorXd descent(const Eigen::VectorXd& rest);

	/// By how much the lowest energy rises without each cone, if the others at their bound stay there and no
	/// other comes to it: k_i^2 over entry i of the diagonal of the inverse of G, bordered by the sum where it
	/// is fixed, less what those at their bound span, and 2 k_i times the multiplier of its bound.
	Eigen::VectorXd needs();

	/// Takes cone \p i out, fits the others, and undoes that and whatever \p accept has done to the
	/// model unless it returns true.
	/// \return whether the cone is out
	template<class Accept>
	bool tryWithout(int i, const Accept& accept)
	{
		const State before = m_now;
		const Array<Field> fields = m_fields;
		remove(i);
		fit();
		if (accept())
			return true;
		restore(before, fields);
		return false;
	}

private:
	/// The curvatures, radians, by cone.
	struct Fit
	{
		Eigen::VectorXd values;
		double energy = 0.0;
		Eigen::VectorXd minimum; // before rounding
		double lowest = 0.0;     // the energy there
		double level = 0.0;      // of half its slope by that of a cone below its bound, times -1
		Eigen::VectorXd multipliers; // of the bounds, see boundMultipliers()
	};

	/// The quadratic function, and where it is lowest. Arrays by cone.
	struct State
	{
		Array<Vertex> vertices;
		Eigen::MatrixXd gram;    // G
		Eigen::VectorXd linear;  // b
		Eigen::MatrixXd inverse; // of G, with a first row and column for the sum where it is fixed;
								 // empty: not known
		Fit fit;
	};

	/// Gradient field of a unit of curvature at one vertex.
	using Field = std::shared_ptr<const VertexVector>;

	/// Half of it tells all.
	static auto symmetric(const Eigen::MatrixXd& matrix)
	{
		return matrix.selfadjointView<Eigen::Lower>();
	}
	double energyOf(const Eigen::VectorXd& k) const
	{
		return std::max(
			0.0, k.dot(symmetric(m_now.gram) * k) + 2.0 * m_now.linear.dot(k) + m_startEnergy);
	}
	int border() const { return hasFixedSum() ? 1 : 0; }
	double minEnergyAt(int i, Vertex v) const;
	Eigen::VectorXd times(const Eigen::VectorXd& x) const;
	void invert();
	void findMinimum();
	Eigen::VectorXd unboundedMinimum();
	Eigen::VectorXd rightSide() const;
	std::vector<int> heldCones() const;
	Eigen::VectorXd change(const Eigen::VectorXd& rest) const;
	void leave(int i);
	void join(int i);
	void learn(Vertex v, Vertex w);
	Eigen::MatrixXd unitFactors(const std::vector<Vertex>& vertices);
	Field fieldOf(Vertex v);
	VertexVector centred(VertexVector field) const;
	void put(int i, Vertex v);
	void restore(const State& state, const Array<Field>& fields);
	void setRow(int i, Vertex v);

	LinearFlow& m_flow;
	double m_total, m_energyFactor;
	VertexVector m_ofSurface;
	ConeRounding m_rounding = ConeRounding::Free;
	VertexArray<char> m_isCone;
	State m_now;
	Array<Field> m_fields;                 // by cone
	VertexVector m_gradient;               // empty: not known
	double m_startEnergy = 0.0;            // without cones
	VertexVector m_start;                  // gradient without cones
	VertexVector m_evenFactor;             // of a curvature of 1 on the whole surface by area
	std::map<Vertex, double> m_ownProduct; // mean squares of u of vertices that were tried
	std::vector<Vertex> m_lastVertices;    // of the last learn()
	Eigen::MatrixXd m_lastFactors;
};

/// Places the ConeModel::minSize() cones that the total curvature needs: one after another where
/// equal shares of it gain most, the rest of the total on the whole surface by area.
void startCones(ConeModel& model, const ConeSites& sites);

/// Places one more cone where it gains most, and others where they gain most of all places around, \p
/// count at most; then fits all curvatures again (a step of orthogonal matching pursuit
/// [Pati Rezaiifar Krishnaprasad 1993]).
/// \return false if no vertex is left
bool addCones(ConeModel& model, const ConeSites& sites, int count = 1);

/// Takes every cone in turn out and puts it where it gains most, or moves it down the gradient, in
/// \p rounds at most, while that lowers the energy.
void relocateCones(ConeModel& model, const ConeSites& sites, int rounds = 5);

/// Takes the cones that are needed least out, one after another, while the others can move so that
/// the distortion stays below \p distortion.
void dropCones(ConeModel& model, const ConeSites& sites, double distortion);

/// Takes cones out that save less energy than they and their seams cost, see MapCost.
/// \param tree of the cones
/// \return whether there were any
bool dropCostlyCones(ConeModel& model, SeamTree& tree);

/// Takes out cones that are too weak to be worth a seam, down to ConeModel::minSize().
void removeWeakCones(ConeModel& model);

/// Moves cones towards the tree of their seams where that lowers the energy of the map and the price of
/// its seams together (see MapCost), in several rounds, and keeps the distortion (see
/// ConeModel::distortion()) at or below \p maxDistortion.
/// \param tree of the cones of \p model
void shortenConeTree(
	ConeModel& model, SeamTree& tree, const ConeSites& sites, double maxDistortion);

} // namespace ricci

#endif
