// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PROGRESS_SHARE_H
#define RICCI_PROGRESS_SHARE_H

#include "../base/memory_estimate.h"
#include "../base/text.h"
#include "../overlay/overlay_pieces.h"
#include "../progress.h"
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

/// Progress of one component among several: a range of the whole.
class ProgressRange
{
public:
	/// \param isSilent whether lines are not logged
	ProgressRange(Progress& progress, double from, double to, bool isSilent = false) :
			m_progress(progress), m_from(from), m_to(to), m_isSilent(isSilent)
	{
	}
	/// The bar never goes back: a stage that starts again leaves it where it is.
	void step(double fraction, const std::string& what)
	{
		m_done = std::max(m_done, fraction);
		m_progress.step(std::min(m_to, m_from + m_done * (m_to - m_from)), what);
	}
	void log(const std::string& line)
	{
		if (!m_isSilent)
			m_progress.log(line);
	}

private:
	Progress& m_progress;
	double m_from, m_to, m_done = 0.0;
	bool m_isSilent;
};

/// The flow's part of the bar: the residual falls by orders of magnitude, so each step closes a part
/// of the distance to epsilon on the logarithmic scale.
class FlowProgress
{
public:
	/// Every state that is passed is appended to \p states.
	FlowProgress(ProgressRange& range, double epsilon, std::vector<FlowState>& states) :
			m_range(range), m_epsilon(epsilon), m_states(states)
	{
	}

	void operator()(int step, double residual)
	{
		m_states.push_back({0, step, residual});
		if (m_first < 0.0)
			m_first = std::max(residual, 10 * m_epsilon);
		const double done =
			std::log(m_first / std::max(residual, m_epsilon)) / std::log(m_first / m_epsilon);
		m_done = std::max(m_done, std::clamp(done, 0.0, 1.0));
		const std::string line = "Newton step " + std::to_string(step) + ": max |target - K| = " +
								 numberText(residual, 3, std::chars_format::scientific);
		if (step != m_step) // a repeated number: a step that only polishes
			m_range.log(line);
		m_step = step;
		// Rounding must not carry the bar past the stage that follows.
		m_range.step(
			std::min(kBeforeFlow + m_done * (1.0 - kBeforeFlow - kAfterFlow), 1.0 - kAfterFlow),
			line);
	}

private:
	ProgressRange& m_range;
	double m_epsilon, m_first = -1.0, m_done = 0.0;
	std::vector<FlowState>& m_states;
	int m_step = -1;
};

/// For commonRefinement(): moves the bar within the part after the flow, and checks that the overlay
/// fits into the memory, see requireOverlayMemory(). \p range must outlive it.
inline OverlayListener overlayListener(ProgressRange& range, bool refines, double memoryLimit)
{
	return [&range, refines, memoryLimit](double share, std::size_t crossings) {
		range.step(
			1.0 - kAfterFlow * (1.0 - kOverlay * share), "Overlay of the two triangulations");
		requireOverlayMemory(crossings, refines, memoryLimit);
	};
}

} // namespace ricci

#endif
