// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PROGRESS_SHARE_H
#define RICCI_PROGRESS_SHARE_H

#include "../base/task.h"
#include "../base/text.h"
#include "../report.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace ricci {

/// Share of a component's progress that is spent before the flow, and after it.
constexpr double kBeforeFlow = 0.05, kAfterFlow = 0.1;

/// Share of the part after the flow that the overlay takes.
constexpr double kOverlay = 0.7;

/// The flow's part of the bar: the residual falls by orders of magnitude, so each step closes a part
/// of the distance to epsilon on the logarithmic scale.
class FlowProgress
{
public:
	/// Every state that is passed is appended to \p states, with the steps counted on from those there.
	FlowProgress(double epsilon, std::vector<FlowState>& states) :
			m_epsilon(epsilon), m_states(states)
	{
	}

	void operator()(int step, double residual)
	{
		const bool begins =
			step <= m_step; // another solve, which may go on where the last one ended
		m_step = step;
		const int count = m_states.empty() ? 0 : m_states.back().step + (begins ? 0 : 1);
		const bool isKnown = begins && !m_states.empty() && m_states.back().residual == residual;
		m_states.push_back({0, count, residual});
		if (m_first < 0.0)
			m_first = std::max(residual, 10 * m_epsilon);
		const double done =
			std::log(m_first / std::max(residual, m_epsilon)) / std::log(m_first / m_epsilon);
		m_done = std::max(m_done, std::clamp(done, 0.0, 1.0));
		const std::string line = "Newton step " + std::to_string(count) + ": max |target - K| = " +
								 numberText(residual, 3, std::chars_format::scientific);
		if (!isKnown)
			logLine(line);
		// Rounding must not carry the bar past the stage that follows.
		advance(
			std::min(kBeforeFlow + m_done * (1.0 - kBeforeFlow - kAfterFlow), 1.0 - kAfterFlow),
			line);
	}

private:
	double m_epsilon, m_first = -1.0, m_done = 0.0;
	std::vector<FlowState>& m_states;
	int m_step = 0;
};

} // namespace ricci

#endif
