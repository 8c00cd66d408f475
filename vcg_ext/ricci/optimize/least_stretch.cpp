// SPDX-License-Identifier: GPL-3.0-or-later
#include "least_distortion.h"

#include "../base/points.h"
#include "../base/task.h"
#include "../base/tolerances.h"
#include "../flow/target.h"
#include "../numerics/iteration.h"
#include "patch_energy.h"

#include <algorithm>
#include <cmath>

namespace ricci {

namespace {

/// Steps at most, and the share of what is above an isometry's energy that one must gain.
constexpr int kMaxStretchSteps = 40;
constexpr double kMinStretchGain = 1e-3;

constexpr double kMinStretchStep = 1e-8;

/// A map on its way to less stretch.
class StretchDescent
{
public:
	StretchDescent(const FlatMesh& flat, const std::vector<TriangleShape>& shapes) :
			m_start(flat), m_trial(flat),
			m_energy(
				flat, allPoints(flat), wholePatch(flat), shapes, PatchCost::SymmetricDirichlet),
			m_x(Eigen::VectorXd::Zero(m_energy.size()))
	{
		for (const int f : flat.points.indices())
			if (orientation(flat.at(f)) > 0)
				m_counted.push_back(f);
			else
				m_energy.stress(f, 0.0);
		m_value = m_energy.value(m_x, 0.0);
	}

	/// \return whether the bound on its steps has ended it
	bool descend()
	{
		if (!std::isfinite(m_value))
			return false;
		for (int i = 0; i < kMaxStretchSteps; ++i)
			if (const double gain = step();
				!(gain > std::max(0.0, kMinStretchGain * (m_value - MapCost().energy))))
				return false;
		return true;
	}

	Array<Point2> places() const { return placesAt(m_x); }

private:
	Array<Point2> placesAt(const Eigen::VectorXd& x) const
	{
		Array<Point2> places = m_start.place;
		for (const int p : places.indices())
			places[p] = {places[p][0] + x[2 * p], places[p][1] + x[2 * p + 1]};
		return places;
	}

	/// \return by how much the energy falls; 0 where there is no way down
	double step()
	{
		if (!m_energy.newtonStep(m_x, 0.0, m_gradient, m_step))
			return 0.0;
		double value = m_value;
		Eigen::VectorXd x;
		const double length = LineSearch{kMinStretchStep}.run(
			1.0,
			m_step.dot(m_gradient),
			m_value,
			[&](double trial) {
				x = m_x + trial * m_step;
				return value = m_energy.value(x, 0.0);
			},
			[&] {
				m_trial.place = placesAt(x);
				for (const int f : m_counted)
					if (orientation(m_trial.at(f)) <= 0)
						return false;
				return true;
			});
		if (length == 0.0)
			return 0.0;
		m_x.swap(x);
		const double gain = m_value - value;
		m_value = value;
		return gain;
	}

	const FlatMesh& m_start;
	FlatMesh m_trial;
	PatchEnergy m_energy;
	std::vector<int> m_counted; // triangles
	Eigen::VectorXd m_x, m_gradient, m_step;
	double m_value;
};

} // namespace

bool leastStretch(FlatMesh& flat)
{
	checkpoint();
	scaleToSurface(flat);
	const double height = kMinHeight * flat.box().extent();
	const Validity validity{height, kWantedHeights * height};
	const std::vector<TriangleShape> shapes =
		restShapes(flat, wholePatch(flat), RestShapes::OfSurfaceEvenly, validity);
	StretchDescent descent(flat, shapes);
	const bool endedEarly = descent.descend();
	flat.place = descent.places();
	return endedEarly;
}

} // namespace ricci
