// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CURVATURE_MAP_H
#define RICCI_CURVATURE_MAP_H

#include "../metric/circle_packing.h"
#include "../metric/conformal_flip.h"

#include <Eigen/Core>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace ricci {

/// The map u -> K(u) of a circle packing (Eqs 1, 2, 4), the gradient of the
/// convex Ricci energy (Eq. 10; as printed its sign is that of a concave one),
/// together with its derivative, the Hessian of the energy (Eqs 7-9, 11, 12).
/// The one seam between the flow and its background geometry: Newton's method
/// sees only this class.
///
/// Where a triangle breaks the triangle inequality its angles are continued by
/// the constants pi, 0, 0 and its derivatives by 0. The energy then is C^1 and
/// convex for every u.
class CurvatureMap
{
public:
	virtual ~CurvatureMap() = default;

	/// Computes everything below at u + \p rest, one entry for each vertex: \p
	/// rest is what the doubles of \p u cannot hold (below their last place), or
	/// empty. Radii then are exact to their own last place, not to that of u.
	virtual void evaluate(const Eigen::VectorXd& u, const Eigen::VectorXd& rest) = 0;

	void evaluate(const Eigen::VectorXd& u) { evaluate(u, Eigen::VectorXd()); }

	/// Whether adding a constant to u changes nothing (Euclidean background).
	virtual bool scaleInvariant() const = 0;

	const CirclePacking& packing() const { return m_packing; }

	/// Gives the packing away, for a map of other precision; nothing else may be asked of this one
	/// afterwards but revision() and flips().
	CirclePacking releasePacking() { return std::move(m_packing); }
	const Triangulation& triangulation() const { return m_packing.triangulation; }
	const std::vector<double>& delta() const { return m_packing.delta; }

	/// K in radians: 2 pi (pi on the boundary) less the angles at the vertex (Eq.
	/// 2).
	const Eigen::VectorXd& curvature() const { return m_curvature; }

	/// [edge] Length in the metric of the last u.
	const std::vector<double>& lengths() const { return m_lengths; }

	/// [halfedge] Angle in radians at the halfedge's origin; 0 on outer
	/// halfedges.
	const std::vector<double>& angles() const { return m_angles; }

	/// [edge] w_ij of Eq. 12: minus the derivative of K_i by u_j.
	const std::vector<double>& weights() const { return m_weights; }

	/// [edge] cosh(length) - 1, what the hyperbolic plane adds to the diagonal; 0
	/// in the Euclidean.
	const std::vector<double>& cosineLess1() const { return m_cosineLess1; }

	/// Number of triangles that break the triangle inequality.
	int brokenTriangles() const { return m_broken; }

	/// Unit of rounding of the arithmetic in which the map is evaluated.
	virtual double precision() const = 0;

	/// Largest quotient of two sides of one triangle: the amplification of
	/// rounding in its angles.
	double needleRatio() const { return m_needleRatio; }

	/// Changes when the connectivity does, so that a sparsity pattern can be kept
	/// as long as possible.
	int revision() const { return m_revision; }

	/// Keeps the connectivity that the last evaluate() left; reject() returns to
	/// the one last kept.
	virtual void accept() {}
	virtual void reject() {}

	/// Edges that evaluate() flipped since the start, in order, up to the last
	/// accept().
	const std::vector<int>& flips() const { return m_flips; }

	/// Frees what only evaluate() needs, which must not be called again.
	virtual void releaseWorkSpace() = 0;

	/// Threads that evaluate() may use (all of the machine's unless told
	/// otherwise). Their number does not change a bit of the result.
	void useThreads(int threads) { m_threads = threads; }

	/// Replaces interior edge \p e by the other diagonal of its two triangles,
	/// with \p delta.
	void swapEdge(int e, double delta);

protected:
	explicit CurvatureMap(CirclePacking packing);

	CirclePacking m_packing;
	std::vector<char> m_boundary; // by vertex
	Eigen::VectorXd m_curvature;
	std::vector<double> m_lengths, m_weights, m_cosineLess1, m_angles;
	int m_threads;
	int m_broken = 0;
	std::vector<int> m_flips;
	double m_needleRatio = 1.0;
	int m_revision = 0;
};

/// CurvatureMap of the background geometry \p Geometry (see Euclidean,
/// Hyperbolic).
template<class Geometry>
class GeometricCurvatureMap : public CurvatureMap
{
public:
	explicit GeometricCurvatureMap(CirclePacking packing);

	using CurvatureMap::evaluate;
	void evaluate(const Eigen::VectorXd& u, const Eigen::VectorXd& rest) override;
	bool scaleInvariant() const override { return Geometry::scaleInvariant; }
	void releaseWorkSpace() override;
	double precision() const override
	{
		return static_cast<double>(std::numeric_limits<typename Geometry::Real>::epsilon());
	}

protected:
	void evaluateCircles(const Eigen::VectorXd& u, const Eigen::VectorXd& rest);
	void evaluateEdges();
	void evaluateTriangles();
	bool evaluateTriangle(int f, double& needleRatio);

	std::vector<typename Geometry::Circle> m_circles; // by vertex
	std::vector<typename Geometry::Real> m_excess;    // by edge: length less the radii
	std::vector<double> m_ratio;                      // by edge: s_i s_j / S_ij^2
	std::vector<double> m_halfWeights; // by halfedge: its triangle's share of the weight
};

/// The same map on the weighted Delaunay triangulation of every u, reached by
/// flips that keep the conformal class (conformal_flip.h). K(u) then is
/// continuously differentiable for all u, no triangle breaks, and all weights
/// are non-negative (off the boundary, whose edges stay).
template<class Geometry>
class FlippingCurvatureMap : public GeometricCurvatureMap<Geometry>
{
public:
	using GeometricCurvatureMap<Geometry>::GeometricCurvatureMap;

	using CurvatureMap::evaluate;
	void evaluate(const Eigen::VectorXd& u, const Eigen::VectorXd& rest) override;
	void releaseWorkSpace() override;
	void accept() override;
	void reject() override;

private:
	std::vector<double> m_kappa; // by vertex
	FlipJournal m_journal;
	DelaunayQueue m_queue;
};

} // namespace ricci

#endif
