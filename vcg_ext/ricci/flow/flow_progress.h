// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FLOW_PROGRESS_H
#define RICCI_FLOW_PROGRESS_H

#include "../base/task.h"
#include "../base/text.h"
#include "../report.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace ricci {

/// Tells the task of each Newton step of a flow. The residual falls by orders of magnitude, so each step
/// closes a part of the distance to epsilon on the logarithmic scale.
class FlowProgress
{
public:
	/// Every state that is passed is appended to \p states, with the steps counted on from those there.
	FlowProgress(double epsilon, std::vector<FlowState>& states) :
			m_epsilon(epsilon), m_states(states)
	{
	}

	/// \param step of the flow; a number that is no larger than the last one begins another solve, which
	/// may go on where that ended
	/// \param residual before it
	void operator()(int step, double residual)
	{
		const bool begins = step <= m_step;
		m_step = step;
		const int count = m_states.empty() ? 0 : m_states.back().step + (begins ? 0 : 1);
		const bool isKnown = begins && !m_states.empty() && m_states.back().residual == residual;
		m_states.push_back({0, count, residual});
		if (m_first < 0.0)
			m_first = std::max(residual, 10 * m_epsilon);
		const std::string line = "Newton step " + std::to_string(count) + ": max |target - K| = " +
								 numberText(residual, 3, std::chars_format::scientific);
		if (!isKnown)
			logLine(line);
		advance(
			std::log(m_first / std::max(residual, m_epsilon)) / std::log(m_first / m_epsilon),
			line);
	}

private:
	double m_epsilon, m_first = -1.0;
	std::vector<FlowState>& m_states;
	int m_step = 0;
};

} // namespace ricci

#endif
