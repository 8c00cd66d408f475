// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_ATTEMPT_H
#define RICCI_ATTEMPT_H

#include "../error.h"
#include "task.h"

#include <optional>
#include <string>

namespace ricci {

/// What \p action() returns. An error is no result, but is logged; a stop of the run is a stop.
/// \param otherwise what is done without the result, for the log
/// \throw Stopped
template<class Action>
auto attempt(const std::string& otherwise, Action action) -> std::optional<decltype(action())>
{
	try {
		return action();
	}
	catch (const Stopped&) {
		throw;
	}
	catch (const Error& error) {
		logLine(error.what() + (": " + otherwise) + ".");
		return std::nullopt;
	}
}

} // namespace ricci

#endif
