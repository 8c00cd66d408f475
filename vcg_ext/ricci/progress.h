// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PROGRESS_H
#define RICCI_PROGRESS_H

#include "error.h"

#include <cstddef>
#include <functional>
#include <string>

namespace ricci {

/// Called now and then by a long computation, many times a second. What it throws ends it.
using Tick = std::function<void()>;

/// Calls \p tick, if there is one, at every 65536th of a loop's short steps.
inline void tickNowAndThen(const Tick& tick, std::size_t step)
{
	if (tick && step % 65536 == 0)
		tick();
}

/// The algorithm's only way to speak while it runs. The default listener is silent and never
/// cancels.
class Progress
{
public:
	virtual ~Progress() = default;

	/// One line for the user's log, without a line end.
	virtual void log(const std::string&) {}

	/// Called between stages and at every Newton step. \p fraction is the share of the whole work
	/// done so far, in [0,1], non-decreasing. Return false to cancel.
	virtual bool update(double /*fraction*/, const std::string& /*what*/) { return true; }

	/// update(), with a false turned into \throw Cancelled.
	void step(double fraction, const std::string& what)
	{
		if (!update(fraction, what))
			throw Cancelled();
	}
};

} // namespace ricci

#endif
