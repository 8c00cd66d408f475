// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TIME_LIMIT_H
#define RICCI_TIME_LIMIT_H

#include "../progress.h"

#include <chrono>
#include <string>

namespace ricci {

/// A listener that passes everything on to another one and ends the run after a time, at the places
/// where the run could be cancelled: between stages and at every Newton step.
class TimeLimit : public Progress
{
public:
	/// The time starts with the construction.
	/// \param seconds of wall-clock time; 0: no limit
	TimeLimit(Progress& listener, double seconds) :
			m_listener(listener), m_seconds(seconds), m_start(Clock::now())
	{
	}

	void log(const std::string& line) override { m_listener.log(line); }

	/// \throw TimeOut
	bool update(double fraction, const std::string& what) override
	{
		const std::chrono::duration<double> elapsed = Clock::now() - m_start;
		if (m_seconds > 0.0 && elapsed.count() > m_seconds && fraction < 1.0)
			throw TimeOut(elapsed.count(), fraction, m_seconds);
		return m_listener.update(fraction, what);
	}

private:
	using Clock = std::chrono::steady_clock;

	Progress& m_listener;
	double m_seconds;
	Clock::time_point m_start;
};

} // namespace ricci

#endif
