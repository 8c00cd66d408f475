// SPDX-License-Identifier: GPL-3.0-or-later
#include "untangle.h"

#include "../numerics/line_search.h"
#include "patch_energy.h"

#include <algorithm>
#include <cmath>

namespace ricci {

namespace {

using Complex = std::complex<double>;

/// Values of eps that are tried, and Newton steps with each of them; the steps that follow once all
/// triangles are valid.
constexpr int kMaxRounds = 40, kStepsPerRound = 3, kLastSteps = 10;

/// Newton steps of ease(), and the share of the energy that a step must not leave to be followed by
/// another.
constexpr int kEasingSteps = 40;
constexpr double kMinImprovement = 0.9999;

/// Rounds without a gain after which a patch is given up; the weight of triangles that are not valid
/// after such a round grows by this factor.
constexpr int kMaxIdleRounds = 6;
constexpr double kStress = 8.0;

/// A round that leaves more than this share of the energy has gained nothing.
constexpr double kMinGain = 0.99;

/// A round whose least determinant stays below this share of the one before has hardly brought it nearer to 0.
constexpr double kMaxLeft = 0.9;

/// Steps of a search are halved, 29 times at most.
constexpr LineSearch kHalving{0x1p-29, 0.5, 0.5};

/// The search for a valid patch.
class Untangler
{
public:
	explicit Untangler(const PatchProblem& problem) :
			m_problem(problem), m_patch(problem.patch),
			m_energy(problem.flat, problem.groups, m_patch, problem.shapes),
			m_x(Eigen::VectorXd::Zero(m_energy.size()))
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
		double soft = kFirstEps; // determinants above it do not need it
		double least = m_energy.minDeterminant(m_x), last = least;
		std::size_t before = m_patch.triangles.size();
		m_eps = std::max(soft, -kEpsShare * least);
		for (int round = 0; round < kMaxRounds; ++round) {
			// A positive determinant of the size of eps is as good as with eps = 0.
			if (least > soft)
				m_eps = kMinEps;
			else if (round > 0)
				m_eps = std::max(
					std::min(
						std::max(soft, -kEpsShare * least),
						gained && least > kMaxLeft * last ? m_eps : kEpsFall * m_eps),
					kMinEps);
			last = least;
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
			const std::size_t bad = m_invalid.size();
			bool isIdle = false;
			if (least > m_eps) { // all are the right way round, but some too low
				for (const int i : m_invalid)
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
			if (m_found.steps == m_problem.maxSteps)
				break;
		}
		return m_found;
	}

private:
	/// One Newton step that lowers the energy.
	/// \param validOnly the step must leave the patch valid
	bool descend(double& value, bool validOnly)
	{
		if (m_found.steps == m_problem.maxSteps)
			return false;
		++m_found.steps;
		if (!m_energy.newtonStep(m_x, m_eps, m_gradient, m_step))
			return false;
		double next = value;
		const double length = kHalving.run(
			1.0,
			m_step.dot(m_gradient),
			value,
			[&](double trial) {
				m_trial = m_x + trial * m_step;
				return next = m_energy.value(m_trial, m_eps);
			},
			[&] { return !validOnly || place(m_trial); });
		if (length == 0.0)
			return false;
		m_x.swap(m_trial);
		value = next;
		return true;
	}

	/// Goes on from a valid patch to a better one.
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

	/// Lists the triangles that are not valid at \p x, and takes the places of the points over if there
	/// are none.
	/// \return whether all are valid
	bool place(const Eigen::VectorXd& x)
	{
		m_places.clear();
		for (std::size_t i = 0; i < m_patch.points.size(); ++i) {
			const int p = m_patch.points[i], variable = m_patch.variable[static_cast<int>(i)];
			m_places.push_back(
				variable < 0
					? m_problem.flat.place[p]
					: m_problem.validity.stored(m_problem.groups.displaced(
						  p, m_problem.flat.place, Complex(x[2 * variable], x[2 * variable + 1]))));
		}
		m_invalid.clear();
		for (const int i : m_patch.corners.indices()) {
			const Triangle& t = m_patch.corners[i];
			if (!m_problem.validity.isValid(
					{m_places[positionOf(t[0])],
					 m_places[positionOf(t[1])],
					 m_places[positionOf(t[2])]}))
				m_invalid.push_back(i);
		}
		if (m_invalid.empty())
			m_found.points = m_places;
		return m_invalid.empty();
	}

	static constexpr double kEpsShare = 0.2, kMinEps = 1e-9;
	static constexpr double kFirstEps = 0.1, kEpsFall = 0.2, kSmallEps = 0.02;

	const PatchProblem& m_problem;
	const Patch& m_patch;
	PatchEnergy m_energy;
	Eigen::VectorXd m_x, m_trial, m_gradient, m_step;
	double m_eps = 1.0;
	std::vector<Point2> m_places; // of the last trial
	std::vector<int> m_invalid;   // triangles of the patch there
	Untangled m_found;
};

} // namespace

Untangled untangle(const PatchProblem& problem)
{
	return Untangler(problem).run();
}

Untangled ease(const PatchProblem& problem)
{
	return Untangler(problem).ease();
}

} // namespace ricci
