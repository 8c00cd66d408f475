// SPDX-License-Identifier: GPL-3.0-or-later
#include "least_distortion.h"

#include "../base/task.h"
#include "../numerics/line_search.h"
#include "distortion_laplacian.h"
#include "limited_memory_bfgs.h"
#include "mean_distortion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ricci {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Steps at most: a few are enough for most maps, CAD with long triangles takes a hundred. They end when two
/// in a row gain less than this change of K in all triangles is worth: it is not seen in the fourth decimal of
/// a mean.
constexpr int kMaxSteps = 100;
constexpr double kSeen = 2.5e-5;

/// Steps that the direction remembers; steps with the same stiffness; and the residual of a direction.
constexpr int kDepth = 5, kSameStiffness = 8;
constexpr double kResidual = 0.1;

constexpr double kMinStep = 1e-6;

/// [number of a point]
Eigen::VectorXcd positionsOf(const NumberedPoints& points, const FlatMesh& flat)
{
	Eigen::VectorXcd positions(points.number.size());
	for (const int p : flat.place.indices())
		positions[points.number[p]] = asComplex(flat.place[p]);
	return positions;
}

/// A flat mesh on its way to less distortion. Nothing is allocated between steps along directions.
class DistortionDescent
{
public:
	DistortionDescent(const FlatMesh& flat, const PointGroups& groups, bool countsFlipped) :
			m_energy(flat, groups, countsFlipped), m_points(m_energy.points()),
			m_bfgs(m_points.unknowns, kDepth), m_start(positionsOf(m_points, flat)),
			m_position(m_start), m_trial(m_start), m_direction(m_points.unknowns)
	{
		m_value = m_energy.evaluate(m_position);
	}

	Descent descend()
	{
		Descent result{0, m_value, m_value};
		if (!std::isfinite(m_value) || m_points.unknowns == 0)
			return result;
		DistortionLaplacian laplacian(m_energy);
		m_energy.gradient(m_gradient);
		double gain = kInfinity, lastGain = kInfinity;
		for (int i = 0; i < kMaxSteps; ++i, lastGain = gain) {
			checkpoint();
			if (i % kSameStiffness == 0 && !laplacian.factorize())
				break;
			m_bfgs.direction(
				m_gradient,
				[&](const Eigen::VectorXcd& rhs, Eigen::VectorXcd& x) {
					laplacian.solve(rhs, x, kResidual);
				},
				m_direction);
			gain = step(2.0 * LimitedMemoryBfgs::dot(m_gradient, m_direction));
			if (!(gain > 0.0))
				break;
			++result.steps;
			result.after = m_value;
			if (gain + lastGain < worthOf(kSeen))
				break;
			result.endedEarly = i + 1 == kMaxSteps;
		}
		return result;
	}

	void write(FlatMesh& flat) const
	{
		for (const int p : flat.place.indices())
			flat.place[p] = asPoint(m_position[m_points.number[p]]);
	}

private:
	/// How much E = mean of (K - 1)^(5/4) changes where K changes by \p change everywhere.
	double worthOf(double change) const { return 1.25 * std::pow(m_value, 0.2) * change; }

	/// Goes along the direction, down which E falls by -\p slope at first, as far as it falls.
	/// \return by how much it falls; not positive where the direction does not lead down
	double step(double slope)
	{
		if (!(slope < 0.0 && std::isfinite(slope)))
			return 0.0;
		double value = m_value;
		const double length = LineSearch{kMinStep}.run(1.0, slope, m_value, [&](double trial) {
			setTrial(trial);
			return value = m_energy.evaluate(m_trial);
		});
		if (length == 0.0)
			return 0.0;
		const double gain = m_value - value;
		m_value = value;
		m_position.swap(m_trial);
		m_energy.gradient(m_nextGradient);
		m_gradient = m_nextGradient - m_gradient;
		m_direction *= length;
		m_bfgs.remember(m_direction, m_gradient);
		m_gradient.swap(m_nextGradient);
		return gain;
	}

	void setTrial(double length)
	{
		const int unknowns = m_points.unknowns;
		m_trial.head(unknowns) = m_position.head(unknowns) + length * m_direction;
		// From the start on, so that the sides of a seam differ as they did there.
		for (int p = unknowns; p < m_points.moving; ++p) {
			const int source = m_points.unknown[p];
			m_trial[p] = m_start[p] + m_points.turn[p] * (m_trial[source] - m_start[source]);
		}
	}

	MeanDistortion m_energy;
	const NumberedPoints& m_points;
	LimitedMemoryBfgs m_bfgs;
	Eigen::VectorXcd m_start, m_position, m_trial;            // [number of a point]
	Eigen::VectorXcd m_direction, m_gradient, m_nextGradient; // [unknown]
	double m_value;
};

} // namespace

Descent leastDistortion(
	FlatMesh& flat, const VertexArray<char>& cones, bool boundaryMoves, bool countsFlipped)
{
	DistortionDescent descent(
		flat, joinedPoints(flat, cones, [&](int) { return boundaryMoves; }), countsFlipped);
	const Descent result = descent.descend();
	if (result.steps > 0)
		descent.write(flat);
	return result;
}

} // namespace ricci
