// SPDX-License-Identifier: GPL-3.0-or-later
#include "untangle.h"

#include "../math/line_search.h"
#include "convex_layout.h"
#include "patch_energy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

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

/// A patch that is laid out anew is enlarged to so many of the least heights at most, a hundredth of what
/// floats reach.
constexpr double kMaxExtent = 1e4;

/// The search for a valid patch.
class Untangler
{
public:
	explicit Untangler(const PatchProblem& problem, int stepsBefore = 0) :
			m_problem(problem), m_patch(problem.patch),
			m_energy(problem.flat, problem.groups, m_patch, problem.shapes),
			m_x(Eigen::VectorXd::Zero(m_energy.size())), m_least{
															 m_patch.triangles.size() + 1,
															 m_patch.triangles.size() + 1}
	{
		m_found.steps = stepsBefore;
	}

	Untangled ease()
	{
		if (place(m_x))
			improve(kEasingSteps);
		return m_found;
	}

	/// The same from other places of the points, where all triangles are the right way round.
	/// \param goOn if they are valid there, too
	Untangled runFrom(const std::vector<Point2>& places, bool goOn)
	{
		for (std::size_t i = 0; i < places.size(); ++i) {
			const int p = m_patch.points[i], variable = m_patch.variable[static_cast<int>(i)];
			const Complex moved = (asComplex(places[i]) - asComplex(m_problem.flat.place[p])) /
								  m_problem.groups.turn[p];
			m_x[2 * variable] = moved.real();
			m_x[2 * variable + 1] = moved.imag();
		}
		if (!place(m_x))
			search(0.0);
		else if (goOn)
			improve(kEasingSteps);
		return m_found;
	}

	Untangled run()
	{
		place(m_x);
		m_found.points.clear(); // they are where they were
		search(kFirstEps);
		return m_found;
	}

private:
	/// \param soft eps that determinants above it do not need
	void search(double soft)
	{
		int idle = 0;
		bool gained = true;
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
	}

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

	/// Lists the triangles that are not valid at \p x, and takes the places of the points over if that
	/// is better than what is known.
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
		std::size_t flipped = 0;
		for (const int i : m_patch.corners.indices()) {
			const Triangle& t = m_patch.corners[i];
			const Triangle2 corners{
				m_places[positionOf(t[0])], m_places[positionOf(t[1])], m_places[positionOf(t[2])]};
			if (m_problem.validity.isValid(corners))
				continue;
			m_invalid.push_back(i);
			flipped += !m_problem.validity.isUpright(corners);
		}
		const std::array<std::size_t, 2> counts{flipped, m_invalid.size()};
		const bool valid = m_invalid.empty();
		if (valid || counts < m_least) {
			m_least = counts;
			m_found.points = m_places;
			m_found.valid = valid;
		}
		return valid;
	}

	static constexpr double kEpsShare = 0.2, kMinEps = 1e-9;
	static constexpr double kFirstEps = 0.1, kEpsFall = 0.2, kSmallEps = 0.02;

	const PatchProblem& m_problem;
	const Patch& m_patch;
	PatchEnergy m_energy;
	Eigen::VectorXd m_x, m_trial, m_gradient, m_step;
	double m_eps = 1.0;
	std::vector<Point2> m_places;       // of the last trial
	std::vector<int> m_invalid;         // triangles of the patch there
	std::array<std::size_t, 2> m_least; // flipped and invalid ones at the best places
	Untangled m_found;
};

double squareOfSides(const Point2& a, const Point2& b, const Point2& c)
{
	const Complex p = asComplex(a), q = asComplex(b), r = asComplex(c);
	return std::norm(q - p) + std::norm(r - q) + std::norm(p - r);
}

/// convexLayout() about where the patch is, as large as its shapes, or as its lowest triangle needs.
std::vector<Point2> unfolded(const PatchProblem& problem)
{
	const Patch& patch = problem.patch;
	const std::vector<RestShape>& shapes = problem.shapes;
	std::vector<Point2> places = convexLayout(patch);
	if (places.empty())
		return places;
	double wanted = 0.0, has = 0.0, lowest = std::numeric_limits<double>::infinity();
	for (std::size_t i = 0; i < shapes.size(); ++i) {
		const Triangle& t = patch.corners[static_cast<int>(i)];
		wanted += squareOfSides({0.0, 0.0}, {shapes[i].base, 0.0}, asPoint(shapes[i].apex));
		const Triangle2 p{
			places[positionOf(t[0])], places[positionOf(t[1])], places[positionOf(t[2])]};
		has += squareOfSides(p[0], p[1], p[2]);
		const double longest =
			std::max({distance(p[0], p[1]), distance(p[1], p[2]), distance(p[2], p[0])});
		lowest = std::min(lowest, doubledArea(p) / longest);
	}
	double scale = std::sqrt(wanted / has);
	if (const double least = problem.validity.wanted / lowest; least > scale)
		scale = std::clamp(least, scale, std::max(scale, kMaxExtent * problem.validity.height));
	const double share = 1.0 / static_cast<double>(places.size());
	Complex middle = 0.0;
	for (const int p : patch.points)
		middle += share * asComplex(problem.flat.place[p]);
	for (Point2& p : places)
		p = asPoint(middle + scale * asComplex(p));
	return places;
}

} // namespace

Untangled untangle(const PatchProblem& problem)
{
	Untangled found = Untangler(problem).run();
	if (found.valid || found.steps == problem.maxSteps || !problem.patch.isFree())
		return found;
	const std::vector<Point2> places = unfolded(problem);
	if (places.empty())
		return found;
	Untangled next = Untangler(problem, found.steps).runFrom(places, true);
	if (next.valid)
		return next;
	found.steps = next.steps;
	return found;
}

Untangled unfold(const PatchProblem& problem)
{
	const std::vector<Point2> places = unfolded(problem);
	return places.empty() ? Untangled{} : Untangler(problem).runFrom(places, false);
}

Untangled ease(const PatchProblem& problem)
{
	return Untangler(problem).ease();
}

} // namespace ricci
