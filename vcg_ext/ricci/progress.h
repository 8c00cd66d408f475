// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PROGRESS_H
#define RICCI_PROGRESS_H

#include "error.h"

#include <string>

namespace ricci {

/// Receives the log lines and the progress of a run, see Task (base/task.h). The default listener is silent and never cancels.
class Progress
{
public:
	virtual ~Progress() = default;

	/// One line for the user's log, without a line end.
	virtual void log(const std::string&) {}

	/// Called many times a second. \p what is what is being done, \p fraction is the share of the whole work
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
